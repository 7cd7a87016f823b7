/* overlay.c - see overlay.h. All is triangles of one texture: the font's, whose last cell is full. */
#include "overlay.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "font.h"
#include "small_program.h"

#include "shaders/overlay.frag.h"
#include "shaders/overlay.vert.h"

enum { MOST_VERTICES = 65536, COLUMNS = 16, ROWS = 6, FIRST = 32, FULL = 95, DISC = 24 };

typedef struct vertex {
    float x, y, u, v, r, g, b, a;
} vertex;

struct overlay {
    const gn_gl *gl;
    GLuint program, buffer, fonts[2];
    GLint u_size, u_font;
    int fine;
    unsigned width, height;
    size_t count;
    vertex vertices[MOST_VERTICES];
};

static GLuint make_font(const gn_gl *gl, const unsigned char *pixels, GLsizei width, GLsizei height)
{
    GLuint name = 0;

    gl->glGenTextures(1, &name);
    gl->glBindTexture(GL_TEXTURE_2D, name);
    gl->glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl->glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl->glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl->glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    gl->glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl->glTexImage2D(GL_TEXTURE_2D, 0, GL_ALPHA, COLUMNS * width, ROWS * height, 0, GL_ALPHA, GL_UNSIGNED_BYTE, pixels);
    gl->glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    gl->glBindTexture(GL_TEXTURE_2D, 0);
    return name;
}

overlay *overlay_create(const gn_gl *gl)
{
    static const char *const attributes[] = {"a_position", "a_uv", "a_color", NULL};
    overlay *o = calloc(1, sizeof *o);

    if (!o)
        return NULL;
    o->gl = gl;
    o->program = small_program(gl, gni_shader_overlay_vert, gni_shader_overlay_frag, attributes);
    if (!o->program) {
        free(o);
        return NULL;
    }
    o->u_size = gl->glGetUniformLocation(o->program, "u_size");
    o->u_font = gl->glGetUniformLocation(o->program, "u_font");
    o->fonts[0] = make_font(gl, small_pixels, small_WIDTH, small_HEIGHT);
    o->fonts[1] = make_font(gl, large_pixels, large_WIDTH, large_HEIGHT);
    gl->glGenBuffers(1, &o->buffer);
    return o;
}

void overlay_destroy(overlay *o)
{
    if (!o)
        return;
    o->gl->glDeleteProgram(o->program);
    o->gl->glDeleteTextures(2, o->fonts);
    o->gl->glDeleteBuffers(1, &o->buffer);
    free(o);
}

void overlay_begin(overlay *o, unsigned width, unsigned height, int fine)
{
    o->width = width;
    o->height = height;
    o->fine = fine;
    o->count = 0;
}

/* ------------------------------------------------------------------ shapes */

static void put(overlay *o, double x, double y, const double uv[2], overlay_color c)
{
    o->vertices[o->count++] = (vertex){(float)x, (float)y, (float)uv[0], (float)uv[1], c.r, c.g, c.b, c.a};
}

static void triangle(overlay *o, const double corners[3][2], overlay_color color)
{
    static const double full[2] = {(FULL % COLUMNS + 0.5) / COLUMNS, (FULL / COLUMNS + 0.5) / ROWS};

    if (o->count + 3 > MOST_VERTICES)
        return;
    for (int i = 0; i < 3; i++)
        put(o, corners[i][0], corners[i][1], full, color);
}

static void quad(overlay *o, const double c[4][2], overlay_color color)
{
    const double first[3][2] = {{c[0][0], c[0][1]}, {c[1][0], c[1][1]}, {c[2][0], c[2][1]}};
    const double second[3][2] = {{c[0][0], c[0][1]}, {c[2][0], c[2][1]}, {c[3][0], c[3][1]}};

    triangle(o, first, color);
    triangle(o, second, color);
}

void overlay_rectangle(overlay *o, double x, double y, double width, double height, overlay_color color)
{
    const double corners[4][2] = {{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}};

    quad(o, corners, color);
}

void overlay_disc(overlay *o, double x, double y, double radius, overlay_color color)
{
    for (int i = 0; i < DISC; i++) {
        const double a = 6.283185307179586 * i / DISC, b = 6.283185307179586 * (i + 1) / DISC;
        const double corners[3][2] = {
            {x, y}, {x + radius * cos(a), y + radius * sin(a)}, {x + radius * cos(b), y + radius * sin(b)}};

        triangle(o, corners, color);
    }
}

/* ------------------------------------------------------------------ text */

double overlay_letter_width(const overlay *o)
{
    return o->fine ? large_WIDTH : small_WIDTH;
}

double overlay_line_height(const overlay *o)
{
    return o->fine ? large_HEIGHT : small_HEIGHT;
}

double overlay_text(overlay *o, double x, double y, overlay_color color, const char *text)
{
    const double width = overlay_letter_width(o), height = overlay_line_height(o), start = x;

    x = floor(x);
    y = floor(y);
    for (; *text; text++, x += width) {
        const unsigned char c = (unsigned char)*text;
        const int cell = (c >= FIRST && c < FIRST + FULL ? c : '?') - FIRST;
        const double u = (double)(cell % COLUMNS) / COLUMNS, v = (double)(cell / COLUMNS) / ROWS;
        const double at[6][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};

        if (o->count + 6 > MOST_VERTICES)
            break;
        for (int i = 0; i < 6; i++) {
            const double uv[2] = {u + at[i][0] / COLUMNS, v + at[i][1] / ROWS};

            put(o, x + at[i][0] * width, y + at[i][1] * height, uv, color);
        }
    }
    return x - start;
}

void overlay_end(overlay *o)
{
    const gn_gl *gl = o->gl;
    static const GLint sizes[3] = {2, 2, 4};
    const GLfloat size[2] = {(GLfloat)o->width, (GLfloat)o->height};
    size_t offset = 0;

    gl->glUseProgram(o->program);
    gl->glUniform2fv(o->u_size, 1, size);
    gl->glUniform1i(o->u_font, 0);
    gl->glBindTexture(GL_TEXTURE_2D, o->fonts[o->fine]);
    gl->glBindBuffer(GL_ARRAY_BUFFER, o->buffer);
    gl->glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(o->count * sizeof(vertex)), o->vertices, GL_STREAM_DRAW);
    for (GLuint i = 0; i < 3; i++) {
        gl->glEnableVertexAttribArray(i);
        gl->glVertexAttribPointer(i, sizes[i], GL_FLOAT, GL_FALSE, sizeof(vertex), (const char *)NULL + offset);
        offset += (size_t)sizes[i] * sizeof(float);
    }
    gl->glEnable(GL_BLEND);
    gl->glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    gl->glDisable(GL_DEPTH_TEST);
    gl->glDisable(GL_CULL_FACE);
    gl->glDrawArrays(GL_TRIANGLES, 0, (GLsizei)o->count);
    gl->glDisable(GL_BLEND);
    for (GLuint i = 0; i < 3; i++)
        gl->glDisableVertexAttribArray(i);
    gl->glBindBuffer(GL_ARRAY_BUFFER, 0);
    gl->glBindTexture(GL_TEXTURE_2D, 0);
    gl->glUseProgram(0);
}
