/* proof_stencil.c - stencil that tests, replaces and counts; that wraps; that knows two sides.
 *
 * Some boards advertise stencil bits that do nothing: the test then always passes. Columns of the cell hold counts that
 * should be there; then a quad over all passes where the count is the one asked for. */
#include "proofs.h"

static const int is_red[4] = {255, 0, 0, -1}, is_green[4] = {0, 255, 0, -1}, is_blue[4] = {0, 0, 255, -1};

/* Adds to a column of four pixels: with `fails` by failing the depth test. */
static void count(gni_proofs *p, int column, GLenum operation, int fails, int back)
{
    p->gl->glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    p->gl->glStencilFunc(GL_ALWAYS, 128, ~0u);
    p->gl->glStencilOp(GL_KEEP, fails ? operation : GL_KEEP, fails ? GL_KEEP : operation);
    if (fails) {
        p->gl->glEnable(GL_DEPTH_TEST);
        p->gl->glDepthFunc(GL_NEVER);
    }
    gni_draw_rectangle(p, 4 * column, 0, 4, CELL, 0.0f, back, gni_white);
    p->gl->glDisable(GL_DEPTH_TEST);
}

/* Colours the pixels of that count. */
static void show(gni_proofs *p, GLint value, const float color[4])
{
    p->gl->glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    p->gl->glStencilFunc(GL_EQUAL, value, ~0u);
    p->gl->glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
    gni_draw_rectangle(p, 0, 0, CELL, CELL, 0.0f, 0, color);
}

static void draw_counts(gni_proofs *p)
{
    const int fails = gni_proofs_can(p, GN_CAN_DEPTH);

    p->gl->glEnable(GL_STENCIL_TEST);
    count(p, 0, GL_INCR, 0, 0);
    count(p, 0, GL_INCR, 0, 0);
    count(p, 0, GL_DECR, 0, 0);
    count(p, 1, GL_INCR, fails, 0);
    count(p, 2, GL_REPLACE, 0, 0);
    show(p, 1, gni_red);
    show(p, 128, gni_blue);
    show(p, 0, gni_green);
}

static int counts(gni_proofs *p)
{
    return gni_is_color(p, 0, 0, 4, CELL, is_red, "0 + 1 + 1 - 1 is not 1") &&
           gni_is_color(p, 4, 0, 4, CELL, is_red, "0 + 1 by failing depth is not 1") &&
           gni_is_color(p, 8, 0, 4, CELL, is_blue, "128 cannot be put there") &&
           gni_is_color(p, 12, 0, 4, CELL, is_green, "what was cleared is not 0");
}

static void draw_wraps(gni_proofs *p)
{
    p->gl->glEnable(GL_STENCIL_TEST);
    count(p, 0, GL_DECR_WRAP, 0, 0);
    count(p, 1, GL_DECR_WRAP, 0, 0);
    count(p, 1, GL_INCR_WRAP, 0, 0);
    count(p, 2, GL_INCR_WRAP, 0, 0);
    show(p, 255, gni_red);
    show(p, 0, gni_green);
    show(p, 1, gni_blue);
}

static int wraps(gni_proofs *p)
{
    return gni_is_color(p, 0, 0, 4, CELL, is_red, "0 - 1 is not 255") &&
           gni_is_color(p, 4, 0, 4, CELL, is_green, "255 + 1 is not 0") &&
           gni_is_color(p, 8, 0, 4, CELL, is_blue, "0 + 1 is not 1") &&
           gni_is_color(p, 12, 0, 4, CELL, is_green, "what was cleared is not 0");
}

/* Fronts up, backs down, by passing and by failing depth, from 128. */
static void draw_sides(gni_proofs *p)
{
    const gn_gl *gl = p->gl;

    gl->glEnable(GL_STENCIL_TEST);
    for (int column = 0; column < 4; column++)
        count(p, column, GL_REPLACE, 0, 0);
    gl->glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    gl->glStencilFunc(GL_ALWAYS, 0, ~0u);
    gl->glStencilOpSeparate(GL_FRONT, GL_KEEP, GL_KEEP, GL_INCR);
    gl->glStencilOpSeparate(GL_BACK, GL_KEEP, GL_KEEP, GL_DECR);
    gni_draw_rectangle(p, 0, 0, 4, CELL, 0.0f, 0, gni_white);
    gni_draw_rectangle(p, 4, 0, 4, CELL, 0.0f, 1, gni_white);
    if (gni_proofs_can(p, GN_CAN_DEPTH)) {
        gl->glStencilOpSeparate(GL_FRONT, GL_KEEP, GL_INCR, GL_KEEP);
        gl->glStencilOpSeparate(GL_BACK, GL_KEEP, GL_DECR, GL_KEEP);
        gl->glEnable(GL_DEPTH_TEST);
        gl->glDepthFunc(GL_NEVER);
    }
    gni_draw_rectangle(p, 8, 0, 4, CELL, 0.0f, 0, gni_white);
    gni_draw_rectangle(p, 12, 0, 4, CELL, 0.0f, 1, gni_white);
    gl->glDisable(GL_DEPTH_TEST);
    show(p, 129, gni_red);
    show(p, 127, gni_green);
}

static int has_sides(gni_proofs *p)
{
    return gni_is_color(p, 0, 0, 4, CELL, is_red, "a front does not count up") &&
           gni_is_color(p, 4, 0, 4, CELL, is_green, "a back does not count down") &&
           gni_is_color(p, 8, 0, 4, CELL, is_red, "a front that fails depth does not count up") &&
           gni_is_color(p, 12, 0, 4, CELL, is_green, "a back that fails depth does not count down");
}

const gni_cell_proof gni_proofs_of_stencil[3] = {
    {GN_CAN_STENCIL, 0, draw_counts, counts},
    {GN_CAN_STENCIL_WRAP, 1u << GN_CAN_STENCIL, draw_wraps, wraps},
    {GN_CAN_TWO_SIDED_STENCIL, 1u << GN_CAN_STENCIL, draw_sides, has_sides},
};
