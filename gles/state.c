/* state.c - GL state as data: each pass has a gni_state, and only what differs from the last one is sent.
 *
 * The cache holds from one entry of gn_gles_next() to its return: after that the host draws, and may have changed
 * anything, so every entry sends everything once. */
#include "gni_gles.h"

#include <string.h>

static void switch_capability(const gn_gl *gl, GLenum capability, int on)
{
    if (on)
        gl->glEnable(capability);
    else
        gl->glDisable(capability);
}

static void send_face(const gn_gl *gl, GLenum side, const gni_face *face)
{
    gl->glStencilOpSeparate(side, GL_KEEP, face->depth_fail, face->depth_pass);
}

static int faces_differ(const gni_face *a, const gni_face *b)
{
    return a->depth_fail != b->depth_fail || a->depth_pass != b->depth_pass;
}

void gni_set_state(gn_gles *g, const gni_state *wanted)
{
    const gn_gl *gl = &g->gl;
    const unsigned on = (wanted->depth_func ? 1u : 0u) | (wanted->stencil_func ? 2u : 0u) |
                        (wanted->blend_source ? 4u : 0u) | (wanted->offset ? 8u : 0u);
    gni_state *last = &g->state; /* what GL has; a detail never sent since a reset is 0 */
    const int all = !g->state_is_known;

    if (all || on != g->tests_on) {
        const unsigned changed = all ? 15u : on ^ g->tests_on;

        if (changed & 1)
            switch_capability(gl, GL_DEPTH_TEST, (on & 1) != 0);
        if (changed & 2)
            switch_capability(gl, GL_STENCIL_TEST, (on & 2) != 0);
        if (changed & 4)
            switch_capability(gl, GL_BLEND, (on & 4) != 0);
        if (changed & 8)
            switch_capability(gl, GL_POLYGON_OFFSET_FILL, (on & 8) != 0);
    }
    if (all || wanted->color_write != last->color_write)
        gl->glColorMask(wanted->color_write, wanted->color_write, wanted->color_write, wanted->color_write);
    if (all || wanted->depth_write != last->depth_write)
        gl->glDepthMask(wanted->depth_write);
    if (all || wanted->stencil_write != last->stencil_write)
        gl->glStencilMask(wanted->stencil_write);
    if (wanted->depth_func && wanted->depth_func != last->depth_func) {
        gl->glDepthFunc(wanted->depth_func);
        last->depth_func = wanted->depth_func;
    }
    if (wanted->stencil_func) {
        const int never_sent = !last->stencil_func;

        if (wanted->stencil_func != last->stencil_func)
            gl->glStencilFuncSeparate(GL_FRONT_AND_BACK, wanted->stencil_func, 0, ~0u);
        if (never_sent || faces_differ(&wanted->front, &last->front))
            send_face(gl, GL_FRONT, &wanted->front);
        if (never_sent || faces_differ(&wanted->back, &last->back))
            send_face(gl, GL_BACK, &wanted->back);
        last->stencil_func = wanted->stencil_func;
        last->front = wanted->front;
        last->back = wanted->back;
    }
    if (wanted->blend_source &&
        (wanted->blend_source != last->blend_source || wanted->blend_destination != last->blend_destination)) {
        gl->glBlendFunc(wanted->blend_source, wanted->blend_destination);
        last->blend_source = wanted->blend_source;
        last->blend_destination = wanted->blend_destination;
    }
    if (wanted->offset && wanted->offset != last->offset) {
        gl->glPolygonOffset(0.0f, (GLfloat)wanted->offset);
        last->offset = wanted->offset;
    }
    last->color_write = wanted->color_write;
    last->depth_write = wanted->depth_write;
    last->stencil_write = wanted->stencil_write;
    g->tests_on = on;
    g->state_is_known = 1;
}

void gni_reset_state(gn_gles *g)
{
    const gn_gl *gl = &g->gl;

    memset(&g->state, 0, sizeof g->state);
    g->state_is_known = 0;
    gl->glDisable(GL_CULL_FACE);
    gl->glDisable(GL_SCISSOR_TEST);
    gl->glFrontFace(GL_CCW);
    gl->glBlendEquation(GL_FUNC_ADD);
    for (GLuint i = 0; i < g->attribute_arrays; i++)
        gl->glDisableVertexAttribArray(i);
}

void gni_leave_state(gn_gles *g)
{
    static const gni_state fresh = {GL_TRUE, GL_TRUE, GL_LESS, GL_ALWAYS, ~0u, {GL_KEEP, GL_KEEP}, {GL_KEEP, GL_KEEP},
                                    GL_ONE,  GL_ZERO, 0};
    const gn_gl *gl = &g->gl;

    gni_reset_state(g);
    gni_set_state(g, &fresh);
    gl->glDisable(GL_DEPTH_TEST);
    gl->glDisable(GL_STENCIL_TEST);
    gl->glDisable(GL_BLEND);
    gl->glPolygonOffset(0.0f, 0.0f);
    gl->glClearDepthf(1.0f);
    gl->glClearStencil(0);
    gl->glUseProgram(0);
    gl->glBindBuffer(GL_ARRAY_BUFFER, 0);
    gl->glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, 0);
    g->state_is_known = 0;
}
