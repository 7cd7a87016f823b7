/* proof_shaders.c - what fragment shaders know of facing, how finely they count, and indices of 32 bits. */
#include "proofs.h"

#include <string.h>

#include "shaders/facing.frag.h"
#include "shaders/mantissa.frag.h"

static const int is_red[4] = {255, 0, 0, -1}, is_green[4] = {0, 255, 0, -1};

static void draw_facing(gni_proofs *p)
{
    if (!gni_use_shader(p, "facing", "", gni_shader_facing_frag))
        return;
    gni_draw_rectangle(p, 0, 0, 8, CELL, 0.0f, 0, gni_white);
    gni_draw_rectangle(p, 8, 0, 8, CELL, 0.0f, 1, gni_white);
    gni_use_own_shader(p);
}

static int knows_facing(gni_proofs *p)
{
    return gni_is_color(p, 0, 0, 8, CELL, is_red, "a front says that it is a back") &&
           gni_is_color(p, 8, 0, 8, CELL, is_green, "a back says that it is a front");
}

static void draw_mantissa(gni_proofs *p, const char *defines)
{
    static const float ones[2] = {1, 1};

    if (!gni_use_shader(p, "mantissa", defines, gni_shader_mantissa_frag))
        return;
    p->gl->glUniform2fv(gni_uniform(p, "u_ones"), 1, ones);
    gni_draw_rectangle(p, 0, 0, CELL, CELL, 0.0f, 0, gni_white);
    gni_use_own_shader(p);
}

static void draw_highp(gni_proofs *p)
{
    draw_mantissa(p, "#define HIGHP\n");
}

static int is_high(gni_proofs *p)
{
    return p->pixels[0] >= 16 ? 1 : gni_failed(p, "it keeps %d bits of mantissa", p->pixels[0]);
}

static void draw_mediump(gni_proofs *p)
{
    draw_mantissa(p, "");
}

/* No proof, a measurement: the channel must hold 24 levels, 5 bits. */
static int measure_mediump(gni_proofs *p)
{
    if (p->target->red_bits >= 8)
        p->target->mediump_bits = p->pixels[0];
    return 1;
}

/* The last triangles of a buffer past the 65,536th vertex. Indices cut to 16 bits reach the first ones, which are a
 * point. */
static void draw_by_uint(gni_proofs *p)
{
    enum { PAST = 65536, COUNT = PAST + 4 };
    static const int8_t corners[4][4] = {{-1, -1, 0, 1}, {1, -1, 0, 1}, {1, 1, 0, 1}, {-1, 1, 0, 1}};
    static const GLuint indices[6] = {PAST, PAST + 1, PAST + 2, PAST, PAST + 2, PAST + 3};
    static const float identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    const gn_gl *gl = p->gl;
    int8_t zeros[256][4];
    GLuint buffers[2];

    memset(zeros, 0, sizeof zeros);
    for (int i = 0; i < 256; i++)
        zeros[i][3] = 1;
    gl->glGenBuffers(2, buffers);
    gl->glBindBuffer(GL_ARRAY_BUFFER, buffers[0]);
    gl->glBufferData(GL_ARRAY_BUFFER, COUNT * sizeof corners[0], NULL, GL_STATIC_DRAW);
    for (int at = 0; at < PAST; at += 256)
        gl->glBufferSubData(GL_ARRAY_BUFFER, (GLintptr)((size_t)at * sizeof zeros[0]), sizeof zeros, zeros);
    gl->glBufferSubData(GL_ARRAY_BUFFER, PAST * sizeof corners[0], sizeof corners, corners);
    gl->glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers[1]);
    gl->glBufferData(GL_ELEMENT_ARRAY_BUFFER, sizeof indices, indices, GL_STATIC_DRAW);
    gl->glUseProgram(p->program);
    gl->glUniform4fv(p->color, 1, gni_red);
    gl->glUniformMatrix4fv(p->near_matrix, 1, GL_FALSE, identity);
    gl->glEnableVertexAttribArray(0);
    gl->glVertexAttribPointer(0, 4, GL_BYTE, GL_FALSE, 4, NULL);
    gl->glViewport(p->x, p->y, CELL, CELL);
    gl->glDrawElements(GL_TRIANGLES, 6, GL_UNSIGNED_INT, NULL);
    gl->glDisableVertexAttribArray(0);
    gl->glBindBuffer(GL_ARRAY_BUFFER, 0);
    gl->glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, 0);
    gl->glDeleteBuffers(2, buffers);
}

static int reaches_past(gni_proofs *p)
{
    return gni_is_color(p, 0, 0, CELL, CELL, is_red, "vertex 65536 is not reached");
}

const gni_cell_proof gni_proofs_of_shaders[3] = {
    {GN_CAN_FRONT_FACING, 0, draw_facing, knows_facing},
    {GN_CAN_FRAGMENT_HIGHP, 0, draw_highp, is_high},
    {GN_CAN_UINT_INDICES, 0, draw_by_uint, reaches_past},
};
const gni_cell_proof gni_measurement_of_mediump = {GN_CAPABILITY_COUNT, 0, draw_mediump, measure_mediump};
