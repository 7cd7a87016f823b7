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

/* Depth is proven first: where it is broken, that is not the stencil's fault. */
static int depth_works(const gni_proofs *p)
{
    return p->target->proven >> GN_CAN_DEPTH & 1;
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
           (!depth_works(p) || gni_is_color(p, 4, 0, 4, CELL, is_red, "0 + 1 by failing depth is not 1")) &&
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

static void set_sides(gni_proofs *p, GLenum front, GLenum back, int fails)
{
    const GLenum keep = GL_KEEP;

    p->gl->glStencilOpSeparate(GL_FRONT, keep, fails ? front : keep, fails ? keep : front);
    p->gl->glStencilOpSeparate(GL_BACK, keep, fails ? back : keep, fails ? keep : back);
}

/* Fronts up, backs down. Lower half of the cell: by passing and by failing depth, from 128. Upper half, where wrapping is
 * offered: from 0 down and up again, so that backs come to 255 and fronts, drawn after backs, to 0. */
static void draw_sides(gni_proofs *p)
{
    const gn_gl *gl = p->gl;

    gl->glEnable(GL_STENCIL_TEST);
    gl->glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    gl->glStencilFunc(GL_ALWAYS, 128, ~0u);
    gl->glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
    gni_draw_rectangle(p, 0, 0, CELL, 8, 0.0f, 0, gni_white);
    set_sides(p, GL_INCR, GL_DECR, 0);
    gni_draw_rectangle(p, 0, 0, 4, 8, 0.0f, 0, gni_white);
    gni_draw_rectangle(p, 4, 0, 4, 8, 0.0f, 1, gni_white);
    if (gni_proofs_can(p, GN_CAN_STENCIL_WRAP)) {
        set_sides(p, GL_INCR_WRAP, GL_DECR_WRAP, 0);
        gni_draw_rectangle(p, 0, 8, CELL, 8, 0.0f, 1, gni_white);
        gni_draw_rectangle(p, 8, 8, 8, 8, 0.0f, 0, gni_white);
    }
    if (gni_proofs_can(p, GN_CAN_DEPTH)) {
        set_sides(p, GL_INCR, GL_DECR, 1);
        gl->glEnable(GL_DEPTH_TEST);
        gl->glDepthFunc(GL_NEVER);
    }
    gni_draw_rectangle(p, 8, 0, 4, 8, 0.0f, 0, gni_white);
    gni_draw_rectangle(p, 12, 0, 4, 8, 0.0f, 1, gni_white);
    gl->glDisable(GL_DEPTH_TEST);
    show(p, 129, gni_red);
    show(p, 127, gni_green);
    show(p, 255, gni_blue);
    show(p, 0, gni_white);
}

static int has_sides(gni_proofs *p)
{
    static const int is_white[4] = {255, 255, 255, -1};
    const int wraps_too = p->target->proven >> GN_CAN_STENCIL_WRAP & 1;

    return gni_is_color(p, 0, 0, 4, 8, is_red, "a front does not count up") &&
           gni_is_color(p, 4, 0, 4, 8, is_green, "a back does not count down") &&
           (!wraps_too || (gni_is_color(p, 0, 8, 8, 8, is_blue, "a back does not count 0 - 1 = 255") &&
                           gni_is_color(p, 8, 8, 8, 8, is_white, "a front does not count 255 + 1 = 0"))) &&
           (!depth_works(p) || (gni_is_color(p, 8, 0, 4, 8, is_red, "a front that fails depth does not count up") &&
                                gni_is_color(p, 12, 0, 4, 8, is_green, "a back that fails depth does not count down")));
}

const gni_cell_proof gni_proofs_of_stencil[3] = {
    {GN_CAN_STENCIL, 0, draw_counts, counts},
    {GN_CAN_STENCIL_WRAP, 1u << GN_CAN_STENCIL, draw_wraps, wraps},
    {GN_CAN_TWO_SIDED_STENCIL, 1u << GN_CAN_STENCIL, draw_sides, has_sides},
};
