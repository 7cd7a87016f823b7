/* walk.c - walks a plan: decides nothing, does each step as data says, and stops where the host is to draw.
 *
 * Counting (Everitt 2002, section 3.3, with two-sided, wrapping stencil): a volume's surface faces outward. z-fail
 * counts what lies behind the visible surface, back faces up and front faces down; z-pass what lies before it, the
 * other way round. Depth is compared LESS: a light cap that is the visible surface itself counts as behind it, and that
 * is why a surface is unlit on the side turned away from the light and lit on the other. Wrapping keeps the order of
 * draws from mattering.
 *
 * Volumes are moved away from the eye by one step of the depth buffer. Beside a silhouette edge a side, or the other
 * face of a fold, lies less than a step behind the visible surface, and interpolation may put it before: the cap
 * that shares the edge is then counted and the side is not. One step back, what is behind stays behind; the visible
 * cap counts as behind as it did; and receivers move by less than depth can tell. With no offset 2 certain pixels
 * of the test scenes are wrong by either method on llvmpipe, with it none (make truth). */
#include "gni_gles.h"

/* clang-format off */
#define UP         GL_INCR_WRAP
#define DOWN       GL_DECR_WRAP
#define NO_STENCIL 0, 0, {GL_KEEP, GL_KEEP}, {GL_KEEP, GL_KEEP}
#define LIT        GL_EQUAL, 0, {GL_KEEP, GL_KEEP}, {GL_KEEP, GL_KEEP}
/* clang-format on */

static const gni_state ambient = {GL_TRUE, GL_TRUE, GL_LESS, NO_STENCIL, 0, 0, 0};
static const gni_state light_masked = {GL_TRUE, GL_FALSE, GL_EQUAL, LIT, GL_ONE, GL_ONE, 0};
static const gni_state light_unmasked = {GL_TRUE, GL_FALSE, GL_EQUAL, NO_STENCIL, GL_ONE, GL_ONE, 0};
static const gni_state final = {GL_TRUE, GL_FALSE, GL_LESS, NO_STENCIL, GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, 0};
static const gni_state zero = {GL_FALSE, GL_FALSE, 0, GL_ALWAYS, ~0u, {GL_ZERO, GL_ZERO}, {GL_ZERO, GL_ZERO}, 0, 0, 0};

/* [z-pass, z-fail][upright, swapped: mirrored or turned, not both] */
static const gni_state count[2][2] = {
    {{GL_FALSE, GL_FALSE, GL_LESS, GL_ALWAYS, ~0u, {GL_KEEP, UP}, {GL_KEEP, DOWN}, 0, 0, 1},
     {GL_FALSE, GL_FALSE, GL_LESS, GL_ALWAYS, ~0u, {GL_KEEP, DOWN}, {GL_KEEP, UP}, 0, 0, 1}},
    {{GL_FALSE, GL_FALSE, GL_LESS, GL_ALWAYS, ~0u, {DOWN, GL_KEEP}, {UP, GL_KEEP}, 0, 0, 1},
     {GL_FALSE, GL_FALSE, GL_LESS, GL_ALWAYS, ~0u, {UP, GL_KEEP}, {DOWN, GL_KEEP}, 0, 0, 1}},
};

gn_result gn_gles_begin(gn_gles *g, const gn_plan *plan)
{
    if (!g || !plan)
        return gn_fail(g ? g->context : NULL, GN_E_ARG, "gn_gles_begin: NULL argument");
    if (g->forgotten)
        return gn_fail(g->context, GN_E_ARG, "gn_gles_begin: the GL context was lost");
    for (uint32_t i = 0; i < plan->record_count; i++)
        if (!gni_find_upload(g, plan->objects[plan->records[i].object].mesh))
            return gn_fail(g->context, GN_E_ARG, "gn_gles_begin: the mesh of object %lu was not uploaded",
                           (unsigned long)plan->records[i].object);
    g->plan = plan;
    g->at = 0;
    if (plan->index_count) {
        g->gl.glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, g->indices);
        g->gl.glBufferData(GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)(plan->index_count * sizeof(uint16_t)), plan->indices,
                           GL_STREAM_DRAW);
        g->gl.glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, 0);
    }
    return GN_OK;
}

static void clear(gn_gles *g)
{
    static const gni_state unmasked = {GL_TRUE, GL_TRUE, 0, 0, ~0u, {GL_KEEP, GL_KEEP}, {GL_KEEP, GL_KEEP}, 0, 0, 0};

    gni_set_state(g, &unmasked);
    g->gl.glClearDepthf((GLfloat)g->plan->clear_depth);
    g->gl.glClearStencil(0);
    g->gl.glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
}

static void zero_stencil(gn_gles *g)
{
    static const float identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, none[4] = {0, 0, 0, 0};
    const gn_gl *gl = &g->gl;

    gni_set_state(g, &zero);
    gni_begin_volumes(g, none);
    gl->glBindBuffer(GL_ARRAY_BUFFER, g->quad);
    gl->glVertexAttribPointer(0, 4, GL_FLOAT, GL_FALSE, 4 * sizeof(float), NULL);
    gl->glUniformMatrix4fv(g->near_matrix, 1, GL_FALSE, identity);
    gl->glDrawArrays(GL_TRIANGLES, 0, 6);
    gni_end_volumes(g);
}

static void count_volumes(gn_gles *g, const gn_step *step)
{
    static const float none[4] = {0, 0, 0, 0};
    const gn_plan *plan = g->plan;
    const int zfail = plan->lights[step->light].method == GN_METHOD_ZFAIL;

    gni_begin_volumes(g, none);
    for (uint32_t i = step->first_record; i < step->first_record + step->record_count; i++)
        for (int turned = 0; turned < 2; turned++) {
            if (turned && !plan->records[i].turned_cap_count)
                continue;
            gni_set_state(g, &count[zfail][plan->records[i].mirrored ^ turned]);
            gni_draw_record(g, plan, &plan->records[i], turned);
        }
    gni_end_volumes(g);
}

static const gni_state *state_for(const gn_step *step)
{
    switch (step->draw) {
    case GN_DRAW_AMBIENT:
        return &ambient;
    case GN_DRAW_LIGHT:
        return step->receivers ? &light_masked : &light_unmasked;
    default:
        return &final;
    }
}

int gn_gles_next(gn_gles *g, gn_step *out)
{
    if (!g || !g->plan || g->forgotten)
        return 0;
    gni_reset_state(g);
    g->gl.glViewport(0, 0, (GLsizei)g->plan->target.width, (GLsizei)g->plan->target.height);
    while (g->at < g->plan->step_count) {
        const gn_step *step = &g->plan->steps[g->at++];

        switch (step->kind) {
        case GN_STEP_CLEAR:
            clear(g);
            break;
        case GN_STEP_ZERO:
            zero_stencil(g);
            break;
        case GN_STEP_VOLUMES:
            count_volumes(g, step);
            break;
        case GN_STEP_DRAW:
            gni_set_state(g, state_for(step));
            g->gl.glUseProgram(0);
            g->gl.glBindBuffer(GL_ARRAY_BUFFER, 0);
            g->gl.glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, 0);
            *out = *step;
            return 1;
        }
    }
    g->plan = NULL;
    gni_leave_state(g);
    return 0;
}
