/* proof_stencil.c - stencil that tests, replaces and counts; that wraps; that knows two sides.
 *
 * Some boards advertise stencil bits that do nothing: the test then always passes. Parts of the cell hold counts that
 * should be there; then a quad over all passes where the count is the one asked for. Every operation that the walk
 * counts with is tried, by the function that it uses, on passing and on failing depth. */
#include "proofs.h"

static const int is_red[4] = {255, 0, 0, -1}, is_green[4] = {0, 255, 0, -1}, is_blue[4] = {0, 0, 255, -1};

/* Where counts are drawn: a rectangle of the cell. */
typedef struct place {
    int x, y, width, height;
} place;

static void draw_at(gni_proofs *p, place at, int fails, int back)
{
    p->gl->glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    p->gl->glStencilFunc(GL_ALWAYS, 128, ~0u);
    if (fails) {
        p->gl->glEnable(GL_DEPTH_TEST);
        p->gl->glDepthFunc(GL_NEVER);
    }
    gni_draw_rectangle(p, at.x, at.y, at.width, at.height, 0.0f, back, gni_white);
    p->gl->glDisable(GL_DEPTH_TEST);
}

/* With `fails` by failing the depth test, as z-fail counts. */
static void count(gni_proofs *p, place at, GLenum operation, int fails)
{
    p->gl->glStencilOp(GL_KEEP, fails ? operation : GL_KEEP, fails ? GL_KEEP : operation);
    draw_at(p, at, fails, 0);
}

/* Colours the pixels of that count. */
static void show(gni_proofs *p, GLint value, const float color[4])
{
    p->gl->glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    p->gl->glStencilFunc(GL_EQUAL, value, ~0u);
    p->gl->glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
    gni_draw_rectangle(p, 0, 0, CELL, CELL, 0.0f, 0, color);
}

/* Depth is proven first: where it is broken, that is not the stencil's fault, and only passing depth is looked at. */
static int ways_to_count(const gni_proofs *p)
{
    return p->target->proven >> GN_CAN_DEPTH & 1 ? 2 : 1;
}

/* Lower half by passing, upper half by failing depth. */
static void draw_counts(gni_proofs *p)
{
    p->gl->glEnable(GL_STENCIL_TEST);
    for (int fails = 0; fails <= gni_proofs_can(p, GN_CAN_DEPTH); fails++) {
        const place first = {0, 8 * fails, 4, 8}, second = {4, 8 * fails, 4, 8};

        count(p, first, GL_INCR, fails);
        count(p, first, GL_INCR, fails);
        count(p, first, GL_DECR, fails);
        count(p, second, GL_REPLACE, fails);
    }
    show(p, 1, gni_red);
    show(p, 128, gni_blue);
    show(p, 0, gni_green);
}

static int counts(gni_proofs *p)
{
    for (int fails = 0; fails < ways_to_count(p); fails++)
        if (!gni_is_color(p, 0, 8 * fails, 4, 8, is_red,
                          fails ? "0 + 1 + 1 - 1 by failing depth is not 1" : "0 + 1 + 1 - 1 is not 1") ||
            !gni_is_color(p, 4, 8 * fails, 4, 8, is_blue, "128 cannot be put there") ||
            !gni_is_color(p, 8, 8 * fails, 8, 8, is_green, "what was cleared is not 0"))
            return 0;
    return 1;
}

static void draw_wraps(gni_proofs *p)
{
    p->gl->glEnable(GL_STENCIL_TEST);
    for (int fails = 0; fails <= gni_proofs_can(p, GN_CAN_DEPTH); fails++) {
        const place both = {0, 8 * fails, 8, 8}, second = {4, 8 * fails, 4, 8}, third = {8, 8 * fails, 4, 8};

        count(p, both, GL_DECR_WRAP, fails);
        count(p, second, GL_INCR_WRAP, fails);
        count(p, third, GL_INCR_WRAP, fails);
    }
    show(p, 255, gni_red);
    show(p, 0, gni_green);
    show(p, 1, gni_blue);
}

static int wraps(gni_proofs *p)
{
    for (int fails = 0; fails < ways_to_count(p); fails++)
        if (!gni_is_color(p, 0, 8 * fails, 4, 8, is_red,
                          fails ? "0 - 1 by failing depth is not 255" : "0 - 1 is not 255") ||
            !gni_is_color(p, 4, 8 * fails, 4, 8, is_green, "255 + 1 is not 0") ||
            !gni_is_color(p, 8, 8 * fails, 4, 8, is_blue, "0 + 1 is not 1") ||
            !gni_is_color(p, 12, 8 * fails, 4, 8, is_green, "what was cleared is not 0"))
            return 0;
    return 1;
}

static void set_sides(gni_proofs *p, GLenum front, GLenum back, int fails)
{
    const GLenum keep = GL_KEEP;

    p->gl->glStencilOpSeparate(GL_FRONT, keep, fails ? front : keep, fails ? keep : front);
    p->gl->glStencilOpSeparate(GL_BACK, keep, fails ? back : keep, fails ? keep : back);
}

/* Fronts up in the left half, backs down in the right, from 128; above that, where wrapping is offered, backs down from
 * 0 everywhere, then fronts up in the right half. By passing depth in the lower rows, by failing it in the upper. */
static void draw_sides(gni_proofs *p)
{
    const int all_wrap = gni_proofs_can(p, GN_CAN_STENCIL_WRAP);

    p->gl->glEnable(GL_STENCIL_TEST);
    for (int fails = 0; fails <= gni_proofs_can(p, GN_CAN_DEPTH); fails++) {
        const place left = {0, 8 * fails, 8, 4}, right = {8, 8 * fails, 8, 4}, row = {0, 8 * fails, CELL, 4};
        const place wrapped = {0, 8 * fails + 4, CELL, 4}, twice = {8, 8 * fails + 4, 8, 4};

        count(p, row, GL_REPLACE, 0);
        set_sides(p, GL_INCR, GL_DECR, fails);
        draw_at(p, left, fails, 0);
        draw_at(p, right, fails, 1);
        if (all_wrap) {
            set_sides(p, GL_INCR_WRAP, GL_DECR_WRAP, fails);
            draw_at(p, wrapped, fails, 1);
            draw_at(p, twice, fails, 0);
        }
    }
    show(p, 129, gni_red);
    show(p, 127, gni_green);
    show(p, 255, gni_blue);
    show(p, 0, gni_white);
}

static int has_sides(gni_proofs *p)
{
    static const int is_white[4] = {255, 255, 255, -1};
    const int wraps_too = p->target->proven >> GN_CAN_STENCIL_WRAP & 1;

    for (int fails = 0; fails < ways_to_count(p); fails++) {
        if (!gni_is_color(p, 0, 8 * fails, 8, 4, is_red,
                          fails ? "a front that fails depth does not count up" : "a front does not count up") ||
            !gni_is_color(p, 8, 8 * fails, 8, 4, is_green,
                          fails ? "a back that fails depth does not count down" : "a back does not count down"))
            return 0;
        if (wraps_too && (!gni_is_color(p, 0, 8 * fails + 4, 8, 4, is_blue, "a back does not count 0 - 1 = 255") ||
                          !gni_is_color(p, 8, 8 * fails + 4, 8, 4, is_white, "a front does not count 255 + 1 = 0")))
            return 0;
    }
    return 1;
}

const gni_cell_proof gni_proofs_of_stencil[3] = {
    {GN_CAN_STENCIL, 0, draw_counts, counts},
    {GN_CAN_STENCIL_WRAP, 1u << GN_CAN_STENCIL, draw_wraps, wraps},
    {GN_CAN_TWO_SIDED_STENCIL, 1u << GN_CAN_STENCIL, draw_sides, has_sides},
};
