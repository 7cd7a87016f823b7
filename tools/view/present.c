/* present.c - see present.h. The stage draws linear light, as `gnomon render` writes it after encoding; here the encoding is a
 * pass over copies of the frames. */
#include "present.h"

#include <string.h>

#include "small_program.h"

#include "shaders/present.frag.h"
#include "shaders/present.vert.h"

static void set_texture(const gn_gl *gl, GLuint name)
{
    gl->glBindTexture(GL_TEXTURE_2D, name);
    gl->glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl->glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl->glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl->glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

int present_open(present *p, const gn_gl *gl)
{
    static const char *const attributes[] = {"a_position", NULL}, *const names[3] = {"u_left", "u_right", "u_marks"};
    static const float corners[4][2] = {{-1, -1}, {1, -1}, {-1, 1}, {1, 1}};

    memset(p, 0, sizeof *p);
    p->gl = gl;
    p->program = small_program(gl, gni_shader_present_vert, gni_shader_present_frag, attributes);
    if (!p->program)
        return 0;
    for (int i = 0; i < 3; i++)
        p->u_textures[i] = gl->glGetUniformLocation(p->program, names[i]);
    p->u_split = gl->glGetUniformLocation(p->program, "u_split");
    p->u_marked = gl->glGetUniformLocation(p->program, "u_marked");
    gl->glGenBuffers(1, &p->buffer);
    gl->glBindBuffer(GL_ARRAY_BUFFER, p->buffer);
    gl->glBufferData(GL_ARRAY_BUFFER, sizeof corners, corners, GL_STATIC_DRAW);
    gl->glBindBuffer(GL_ARRAY_BUFFER, 0);
    gl->glGenTextures(3, p->textures);
    return 1;
}

void present_close(present *p)
{
    if (!p->gl)
        return;
    p->gl->glDeleteProgram(p->program);
    p->gl->glDeleteBuffers(1, &p->buffer);
    p->gl->glDeleteTextures(3, p->textures);
    memset(p, 0, sizeof *p);
}

/* Without alpha: of a target that has none it cannot be copied. */
static void resize(present *p, uint32_t width, uint32_t height)
{
    if (p->width == width && p->height == height)
        return;
    p->width = width;
    p->height = height;
    for (int i = 0; i < 2; i++) {
        set_texture(p->gl, p->textures[i]);
        p->gl->glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, (GLsizei)width, (GLsizei)height, 0, GL_RGB, GL_UNSIGNED_BYTE,
                            NULL);
    }
}

void present_keep(present *p, int side, uint32_t width, uint32_t height)
{
    resize(p, width, height);
    p->gl->glBindTexture(GL_TEXTURE_2D, p->textures[side]);
    p->gl->glCopyTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 0, 0, (GLsizei)width, (GLsizei)height);
    p->gl->glBindTexture(GL_TEXTURE_2D, 0);
}

void present_mark(present *p, const uint8_t *rgba, uint32_t width, uint32_t height)
{
    set_texture(p->gl, p->textures[2]);
    p->gl->glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, (GLsizei)width, (GLsizei)height, 0, GL_RGBA, GL_UNSIGNED_BYTE, rgba);
    p->gl->glBindTexture(GL_TEXTURE_2D, 0);
}

void present_draw(const present *p, double split, int is_marked)
{
    const gn_gl *gl = p->gl;
    const GLuint names[3] = {p->textures[0], split < 1.0 ? p->textures[1] : p->textures[0],
                             is_marked ? p->textures[2] : p->textures[0]};

    gl->glUseProgram(p->program);
    for (GLint i = 2; i >= 0; i--) {
        gl->glActiveTexture(GL_TEXTURE0 + (GLenum)i);
        gl->glBindTexture(GL_TEXTURE_2D, names[i]);
        gl->glUniform1i(p->u_textures[i], i);
    }
    gl->glUniform1f(p->u_split, (GLfloat)split);
    gl->glUniform1f(p->u_marked, is_marked ? 1.0f : 0.0f);
    gl->glBindBuffer(GL_ARRAY_BUFFER, p->buffer);
    gl->glEnableVertexAttribArray(0);
    gl->glVertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, 0, NULL);
    gl->glDisable(GL_DEPTH_TEST);
    gl->glDisable(GL_BLEND);
    gl->glDisable(GL_CULL_FACE);
    gl->glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    gl->glDisableVertexAttribArray(0);
    gl->glBindBuffer(GL_ARRAY_BUFFER, 0);
    for (GLint i = 2; i >= 0; i--) {
        gl->glActiveTexture(GL_TEXTURE0 + (GLenum)i);
        gl->glBindTexture(GL_TEXTURE_2D, 0);
    }
    gl->glUseProgram(0);
}
