/* proof_shaders.c - what fragment shaders know of facing, how finely they count, and indices of 32 bits.
 *
 * One shader tries what shaders can, since a program costs more than any drawing here; the proofs read what it left. */
#include "proofs.h"

#include "shaders/trial.frag.h"

/* A front in the left half of the cell, a back in the right. */
static void draw_trial(gni_proofs *p)
{
    static const float ones[2] = {1, 1};
    static const char *const defines[4] = {"", "#define HIGHP\n", "#define FACING\n",
                                           "#define HIGHP\n#define FACING\n"};
    const int which = gni_proofs_can(p, GN_CAN_FRAGMENT_HIGHP) + 2 * gni_proofs_can(p, GN_CAN_FRONT_FACING);

    if (!gni_use_shader(p, "trial", defines[which], gni_shader_trial_frag))
        return;
    p->gl->glUniform2fv(gni_uniform(p, "u_ones"), 1, ones);
    p->gl->glUniform2fv(gni_uniform(p, "u_high_ones"), 1, ones);
    gni_draw_rectangle(p, 0, 0, 8, CELL, 0.0f, 0, gni_white);
    gni_draw_rectangle(p, 8, 0, 8, CELL, 0.0f, 1, gni_white);
    gni_use_own_shader(p);
}

/* Channels must hold 24 levels. A target that is too narrow for the right half shows no back, and none is asked for. */
static int read_trial(gni_proofs *p)
{
    const uint8_t *front = p->pixels, *back = p->pixels + 4 * (size_t)(p->width - 1);

    p->target->mediump_bits = p->target->red_bits >= 8 ? front[0] : 0;
    p->highp_bits = front[1];
    p->front_is_front = front[2] == 255;
    p->back_is_back = p->width <= 8 || back[2] == 0;
    return 1;
}

static void draw_nothing(gni_proofs *p)
{
    (void)p; /* the trial has drawn it */
}

static int is_high(gni_proofs *p)
{
    return p->highp_bits >= 16 ? 1 : gni_failed(p, "it keeps %d bits of mantissa", p->highp_bits);
}

static int knows_facing(gni_proofs *p)
{
    if (!p->front_is_front)
        return gni_failed(p, "a front says that it is a back");
    return p->back_is_back ? 1 : gni_failed(p, "a back says that it is a front");
}

/* The last triangles of a buffer past the 65,536th vertex. Indices cut to 16 bits reach the first ones, which are a
 * point. */
static void draw_by_uint(gni_proofs *p)
{
    enum { PAST = 65536 };
    static const int8_t corners[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, point[4][2] = {{0, 0}};
    static const GLuint indices[6] = {PAST, PAST + 1, PAST + 2, PAST, PAST + 2, PAST + 3};
    static const float identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    const gn_gl *gl = p->gl;
    GLuint buffers[2];

    gl->glGenBuffers(2, buffers);
    gl->glBindBuffer(GL_ARRAY_BUFFER, buffers[0]);
    gl->glBufferData(GL_ARRAY_BUFFER, (PAST + 4) * sizeof corners[0], NULL, GL_STATIC_DRAW);
    gl->glBufferSubData(GL_ARRAY_BUFFER, 0, sizeof point, point);
    gl->glBufferSubData(GL_ARRAY_BUFFER, PAST * sizeof corners[0], sizeof corners, corners);
    gl->glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers[1]);
    gl->glBufferData(GL_ELEMENT_ARRAY_BUFFER, sizeof indices, indices, GL_STATIC_DRAW);
    gl->glUseProgram(p->program);
    gl->glUniform4fv(p->color, 1, gni_red);
    gl->glUniformMatrix4fv(p->near_matrix, 1, GL_FALSE, identity);
    gl->glEnableVertexAttribArray(0);
    gl->glVertexAttribPointer(0, 2, GL_BYTE, GL_FALSE, 2, NULL);
    gl->glViewport(p->x, p->y, CELL, CELL);
    gl->glDrawElements(GL_TRIANGLES, 6, GL_UNSIGNED_INT, NULL);
    gl->glDisableVertexAttribArray(0);
    gl->glBindBuffer(GL_ARRAY_BUFFER, 0);
    gl->glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, 0);
    gl->glDeleteBuffers(2, buffers);
}

static int reaches_past(gni_proofs *p)
{
    static const int is_red[4] = {255, 0, 0, -1};

    return gni_is_color(p, 0, 0, CELL, CELL, is_red, "vertex 65536 is not reached");
}

const gni_cell_proof gni_proofs_of_shaders[3] = {
    {GN_CAN_FRONT_FACING, 0, draw_nothing, knows_facing},
    {GN_CAN_FRAGMENT_HIGHP, 0, draw_nothing, is_high},
    {GN_CAN_UINT_INDICES, 0, draw_by_uint, reaches_past},
};
const gni_cell_proof gni_trial_of_shaders = {GN_CAPABILITY_COUNT, 0, draw_trial, read_trial};
