/* proofs.c - runs the proofs: those in cells of the target, as many at a time as it holds, then those alone, most of
 * them with framebuffer objects of their own. What fails is told to the port's log, with the driver's name and the
 * symptom. */
#include "proofs.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "shaders/volume.vert.h"

const float gni_red[4] = {1, 0, 0, 1}, gni_green[4] = {0, 1, 0, 1}, gni_blue[4] = {0, 0, 1, 1},
            gni_white[4] = {1, 1, 1, 1};

int gni_proofs_can(const gni_proofs *p, gn_capability c)
{
    return p->offered >> c & 1;
}

int gni_failed(gni_proofs *p, const char *format, ...)
{
    va_list args;

    va_start(args, format);
    vsnprintf(p->symptom, GNI_SYMPTOM, format, args);
    va_end(args);
    return 0;
}

void gni_fresh_state(gni_proofs *p)
{
    gni_leave_state(p->g);
    p->gl->glDisable(GL_DITHER);
}

int gni_use_shader(gni_proofs *p, const char *name, const char *defines, const char *fragment)
{
    const GLuint program = gni_make_program(p->g, name, defines, gni_shader_volume_vert, fragment);

    if (!program)
        return 0;
    p->program = program;
    p->near_matrix = gni_uniform(p, "u_near");
    p->color = gni_uniform(p, "u_color");
    p->gl->glUseProgram(program);
    return 1;
}

GLint gni_uniform(const gni_proofs *p, const char *name)
{
    return p->gl->glGetUniformLocation(p->program, name);
}

void gni_use_own_shader(gni_proofs *p)
{
    p->gl->glUseProgram(0);
    if (p->program != p->g->colored.name)
        p->gl->glDeleteProgram(p->program);
    p->program = p->g->colored.name;
    p->near_matrix = p->g->colored.near_matrix;
    p->color = p->g->colored.color;
}

void gni_draw_rectangle(gni_proofs *p, int x, int y, int width, int height, float depth, int back, const float color[4])
{
    const float matrix[16] = {back ? -1.0f : 1.0f, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, depth, 1};

    gni_draw_quad(p, x, y, width, height, matrix, color);
}

void gni_draw_quad(gni_proofs *p, int x, int y, int width, int height, const float matrix[16], const float color[4])
{
    const gn_gl *gl = p->gl;

    gl->glUseProgram(p->program);
    if (p->color >= 0)
        gl->glUniform4fv(p->color, 1, color);
    gl->glUniformMatrix4fv(p->near_matrix, 1, GL_FALSE, matrix);
    gl->glBindBuffer(GL_ARRAY_BUFFER, p->g->quad);
    gl->glEnableVertexAttribArray(0);
    gl->glVertexAttribPointer(0, 4, GL_FLOAT, GL_FALSE, 4 * sizeof(float), NULL);
    gl->glViewport(p->x + x, p->y + y, width, height);
    gl->glDrawArrays(GL_TRIANGLES, GNI_QUAD, 6);
    gl->glDisableVertexAttribArray(0);
}

int gni_is_color(gni_proofs *p, int x, int y, int width, int height, const int rgba[4], const char *what)
{
    for (int row = y; row < y + height && row < p->height; row++)
        for (int column = x; column < x + width && column < p->width; column++) {
            const uint8_t *pixel = p->pixels + 4 * (row * p->width + column);

            for (int i = 0; i < 4; i++)
                if (rgba[i] >= 0 && rgba[i] != pixel[i])
                    return gni_failed(p, "%s (%d %d %d %d)", what, pixel[0], pixel[1], pixel[2], pixel[3]);
        }
    return 1;
}

static void take_errors(const gn_gl *gl)
{
    for (int i = 0; i < 16 && gl->glGetError() != GL_NO_ERROR; i++)
        continue;
}

static const char *name_of_first(uint32_t set)
{
    int c = 0;

    while (c < GN_CAPABILITY_COUNT && !(set >> c & 1))
        c++;
    return gn_capability_name((gn_capability)c);
}

/* Whether a proof may be drawn. What is offered and not tried is for want of another capability. */
static int is_possible(gni_proofs *p, gn_capability c, uint32_t uses, uint32_t touches)
{
    const uint32_t missing = (uses & ~p->offered) | (touches & p->target->hidden);

    if (c == GN_CAPABILITY_COUNT)
        return 1; /* a trial: it has no symptom */
    if (!gni_proofs_can(p, c))
        return 0;
    p->symptom = p->g->symptoms[c];
    if (missing) {
        gni_failed(p, "it needs %s", name_of_first(missing));
        p->untried |= 1u << c;
    }
    return !missing;
}

/* What came out of one proof. */
static void settle(gni_proofs *p, gn_capability c, uint32_t uses, int holds)
{
    const uint32_t missing = uses & ~p->target->proven;

    if (c == GN_CAPABILITY_COUNT)
        return;
    if (missing) {
        gni_failed(p, "it needs %s", name_of_first(missing));
        p->untried |= 1u << c;
    } else if (holds) {
        p->target->proven |= 1u << c;
    }
}

static const gni_cell_proof *const cell_proofs[] = {
    &gni_proofs_of_depth[0], /* others ask whether it holds */
    &gni_proofs_of_depth[1],    &gni_proofs_of_depth[2],    &gni_proofs_of_stencil[0],  &gni_proofs_of_stencil[1],
    &gni_proofs_of_stencil[2],  &gni_proofs_of_blending[0], &gni_proofs_of_blending[1], &gni_proofs_of_blending[2],
    &gni_proofs_of_blending[3], &gni_trial_of_shaders,      &gni_proofs_of_shaders[0],  &gni_proofs_of_shaders[1],
    &gni_proofs_of_shaders[2],
};
enum { CELLS = sizeof cell_proofs / sizeof cell_proofs[0] };

static void clear_target(gni_proofs *p)
{
    const gn_gl *gl = p->gl;

    gni_fresh_state(p);
    gl->glClearColor(0.0f, 0.0f, 0.0f, 0.0f);
    gl->glClear(GL_COLOR_BUFFER_BIT | (gni_proofs_can(p, GN_CAN_DEPTH) ? GL_DEPTH_BUFFER_BIT : 0u) |
                (gni_proofs_can(p, GN_CAN_STENCIL) ? GL_STENCIL_BUFFER_BIT : 0u));
}

/* Cells in a row of the target, or in all: no more than there are proofs. */
static uint32_t cells_in(uint32_t pixels)
{
    const uint32_t n = pixels / CELL;

    return n == 0 ? 1 : n < CELLS ? n : CELLS;
}

static void place_cell(gni_proofs *p, uint32_t n)
{
    const uint32_t columns = cells_in(p->target->width), x = n % columns * CELL, y = n / columns * CELL;

    p->x = (GLint)x;
    p->y = (GLint)y;
    p->width = p->target->width - x < CELL ? (int)(p->target->width - x) : CELL;
    p->height = p->target->height - y < CELL ? (int)(p->target->height - y) : CELL;
}

static void prove_in_cells(gni_proofs *p)
{
    const gn_target *t = p->target;
    const uint32_t held = cells_in(t->width) * cells_in(t->height);
    const int batch = held < CELLS ? (int)held : CELLS;

    for (int first = 0; first < CELLS; first += batch) {
        clear_target(p);
        for (int i = first; i < first + batch && i < CELLS; i++) {
            const gni_cell_proof *proof = cell_proofs[i];

            if (!is_possible(p, proof->capability, proof->uses, 0))
                continue;
            place_cell(p, (uint32_t)(i - first));
            gni_fresh_state(p);
            proof->draw(p);
            take_errors(p->gl);
        }
        for (int i = first; i < first + batch && i < CELLS; i++) {
            const gni_cell_proof *proof = cell_proofs[i];

            if (!is_possible(p, proof->capability, proof->uses, 0))
                continue;
            place_cell(p, (uint32_t)(i - first));
            p->gl->glReadPixels(p->x, p->y, p->width, p->height, GL_RGBA, GL_UNSIGNED_BYTE, p->pixels);
            settle(p, proof->capability, proof->uses, proof->holds(p));
        }
    }
}

static void prove_alone(gni_proofs *p, const gni_lone_proof *list, int count, GLuint framebuffer)
{
    for (int i = 0; i < count; i++) {
        if (!is_possible(p, list[i].capability, list[i].uses, list[i].touches))
            continue;
        gni_fresh_state(p);
        settle(p, list[i].capability, list[i].uses, list[i].holds(p));
        take_errors(p->gl);
        p->gl->glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    }
}

/* Framebuffers that cannot be read as plain levels of red, green and blue (multisampled objects, floats, integers,
 * sRGB), and those smaller than a cell, are proven on one of 8 bits a channel, 24 of depth and 8 of stencil. */
typedef struct stand_in {
    GLuint framebuffer, texture, depth;
} stand_in;

static int make_stand_in(gni_proofs *p, stand_in *s, gn_target *target)
{
    const gn_gl *gl = p->gl;

    if (!gni_proofs_can(p, GN_CAN_PACKED_DEPTH_STENCIL))
        return 0;
    gl->glGenTextures(1, &s->texture);
    gl->glBindTexture(GL_TEXTURE_2D, s->texture);
    gl->glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 4 * CELL, 4 * CELL, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
    gl->glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl->glGenRenderbuffers(1, &s->depth);
    gl->glBindRenderbuffer(GL_RENDERBUFFER, s->depth);
    gl->glRenderbufferStorage(GL_RENDERBUFFER, GNI_DEPTH24_STENCIL8, 4 * CELL, 4 * CELL);
    gl->glGenFramebuffers(1, &s->framebuffer);
    gl->glBindFramebuffer(GL_FRAMEBUFFER, s->framebuffer);
    gl->glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, s->texture, 0);
    gl->glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, s->depth);
    gl->glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_STENCIL_ATTACHMENT, GL_RENDERBUFFER, s->depth);
    target->width = target->height = 4 * CELL;
    target->red_bits = 8;
    return gl->glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
}

static void drop_stand_in(gni_proofs *p, const stand_in *s)
{
    p->gl->glDeleteFramebuffers(1, &s->framebuffer);
    p->gl->glDeleteTextures(1, &s->texture);
    p->gl->glDeleteRenderbuffers(1, &s->depth);
}

/* Whether colours come back as they are written, at both ends and in the middle. */
static int is_plain(gni_proofs *p)
{
    uint8_t *pixel = p->pixels;

    take_errors(p->gl);
    gni_fresh_state(p);
    p->gl->glClearColor(1.0f, 0.5f, 0.0f, 1.0f);
    p->gl->glClear(GL_COLOR_BUFFER_BIT);
    p->gl->glReadPixels(0, 0, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel);
    return p->gl->glGetError() == GL_NO_ERROR && pixel[0] == 255 && pixel[1] > 110 && pixel[1] < 145 && pixel[2] == 0;
}

static void refuse_cells(gni_proofs *p)
{
    for (int i = 0; i < CELLS; i++)
        if (cell_proofs[i]->capability != GN_CAPABILITY_COUNT) {
            p->symptom = p->g->symptoms[cell_proofs[i]->capability];
            gni_failed(p, "the framebuffer cannot be read, and nothing stands in for it");
        }
}

static void warn(const gni_proofs *p)
{
    const char *const renderer = (const char *)p->gl->glGetString(GL_RENDERER);
    const gn_port *port = &p->g->port;
    char line[320];

    for (int c = 0; c < GN_CAPABILITY_COUNT; c++)
        if ((p->offered & ~p->target->proven & ~p->untried) >> c & 1 && port->log) {
            snprintf(line, sizeof line, "%.128s advertises %s, but %s", renderer ? renderer : "the GL",
                     gn_capability_name((gn_capability)c), p->g->symptoms[c]);
            port->log(port->user, GN_LOG_WARNING, line);
        }
}

/* What blending does depends on the levels of the colour buffer. */
#define PLAIN_LEVELS                                                                                                   \
    (1u << GN_CAN_ALPHA | 1u << GN_CAN_BLEND_SUBTRACT | 1u << GN_CAN_BLEND_MINMAX | 1u << GN_CAN_BLEND_ROUNDING)

void gni_prove(gn_gles *g, gn_target *target)
{
    gn_target seen = *target; /* what cells are drawn into */
    const stand_in none = {0, 0, 0};
    stand_in replacement = none;
    GLuint drawn_into;
    GLint bound = 0;
    gni_proofs p;
    int ok = 1, plain;

    memset(&p, 0, sizeof p);
    p.g = g;
    p.gl = &g->gl;
    p.target = &seen;
    p.offered = target->advertised & ~target->hidden;
    gni_use_own_shader(&p);
    g->gl.glDisable(GL_SAMPLE_ALPHA_TO_COVERAGE);
    g->gl.glDisable(GL_SAMPLE_COVERAGE);
    g->gl.glDepthRangef(0.0f, 1.0f);
    g->gl.glPixelStorei(GL_PACK_ALIGNMENT, 4);
    g->gl.glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    g->gl.glActiveTexture(GL_TEXTURE0);
    g->gl.glGetIntegerv(GL_FRAMEBUFFER_BINDING, &bound);
    plain = is_plain(&p);
    if (!plain || target->width < CELL || target->height < CELL)
        ok = make_stand_in(&p, &replacement, &seen);
    if (!ok && plain) { /* it must do as it is, small as it is */
        drop_stand_in(&p, &replacement);
        replacement = none;
        seen = *target;
        ok = 1;
        g->gl.glBindFramebuffer(GL_FRAMEBUFFER, (GLuint)bound);
    }
    if (!plain && target->samples == 0) /* its levels are not those of the stand-in */
        target->advertised = seen.advertised &= ~PLAIN_LEVELS;
    p.offered = target->advertised & ~target->hidden;
    if (ok) {
        prove_in_cells(&p);
        place_cell(&p, 0);
        drawn_into = replacement.framebuffer ? replacement.framebuffer : (GLuint)bound;
        prove_alone(&p, gni_proofs_of_extensions, 3, drawn_into);
        prove_alone(&p, gni_proof_of_partial_clears, 1, drawn_into);
    } else {
        refuse_cells(&p);
    }
    p.x = p.y = 0;
    p.width = p.height = CELL;
    prove_alone(&p, gni_proofs_of_framebuffers, 7, (GLuint)bound);
    if (replacement.framebuffer)
        drop_stand_in(&p, &replacement);
    target->proven = seen.proven;
    target->mediump_bits = seen.mediump_bits;
    p.target = target;
    warn(&p);
}
