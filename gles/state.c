/* state.c - GL state as data: each pass has a gni_state, and only what differs from the last one is sent.
 *
 * The cache holds from one entry of gn_gles_next() to its return: after that the host draws, and may have changed
 * anything, so every entry sends everything once. */
#include "gni_gles.h"

#include <string.h>

/* What is switched on and off, in the order of the bits of gn_gles.tests_on. */
static const GLenum switches[] = {GL_DEPTH_TEST,          GL_STENCIL_TEST, GL_BLEND,
                                  GL_POLYGON_OFFSET_FILL, GL_CULL_FACE,    GL_SCISSOR_TEST,
                                  GNI_DEPTH_BOUNDS,       GNI_DEPTH_CLAMP, GL_DITHER};
enum { SWITCHES = sizeof switches / sizeof switches[0] };

const gni_state gni_unmasked = {.color_mask = 15, .depth_write = GL_TRUE, .stencil_write = ~0u};

static void send_switches(gn_gles *g, const gni_state *wanted)
{
    const unsigned on = (wanted->depth_func ? 1u : 0u) | (wanted->stencil_func ? 2u : 0u) |
                        (wanted->blend_source || wanted->blend_destination ? 4u : 0u) | (wanted->offset ? 8u : 0u) |
                        (GNI_HAS_FALLBACK && wanted->cull ? 16u : 0u) |
                        (GNI_HAS_CULLING && wanted->scissor ? 32u : 0u) |
                        (GNI_HAS_CULLING && wanted->bounds ? GNI_SWITCH_BOUNDS : 0u) |
                        (GNI_HAS_CULLING && wanted->clamp ? GNI_SWITCH_CLAMP : 0u) |
                        (!GNI_HAS_FALLBACK || wanted->undithered ? 0u : g->may_switch & GNI_SWITCH_DITHER);
    const unsigned changed = g->state_is_known ? on ^ g->tests_on : on | g->may_switch | (GNI_SWITCH_BOUNDS - 1u);

    for (int i = 0; i < SWITCHES; i++) {
        if (!(changed >> i & 1))
            continue;
        if (on >> i & 1)
            g->gl.glEnable(switches[i]);
        else
            g->gl.glDisable(switches[i]);
    }
    g->tests_on = on;
}

static int faces_differ(const gni_face *a, const gni_face *b)
{
    return a->depth_fail != b->depth_fail || a->depth_pass != b->depth_pass;
}

static GLenum operation(GLenum given)
{
    return given ? given : GL_KEEP;
}

/* Where both faces do the same the old function says so: it works where two-sided stencil does not. */
static void send_stencil(gn_gles *g, const gni_state *wanted)
{
    const gn_gl *gl = &g->gl;
    gni_state *last = &g->state;
    const int never_sent = !last->stencil_func;

    if (wanted->stencil_func != last->stencil_func || wanted->stencil_reference != last->stencil_reference ||
        wanted->stencil_mask != last->stencil_mask)
        gl->glStencilFunc(wanted->stencil_func, wanted->stencil_reference, wanted->stencil_mask);
    if (never_sent || faces_differ(&wanted->front, &last->front) || faces_differ(&wanted->back, &last->back)) {
        const gni_face *front = &wanted->front, *back = &wanted->back;

        if (faces_differ(front, back)) {
            gl->glStencilOpSeparate(GL_FRONT, GL_KEEP, operation(front->depth_fail), operation(front->depth_pass));
            gl->glStencilOpSeparate(GL_BACK, GL_KEEP, operation(back->depth_fail), operation(back->depth_pass));
        } else {
            gl->glStencilOp(GL_KEEP, operation(front->depth_fail), operation(front->depth_pass));
        }
    }
    last->stencil_func = wanted->stencil_func;
    last->stencil_reference = wanted->stencil_reference;
    last->stencil_mask = wanted->stencil_mask;
    last->front = wanted->front;
    last->back = wanted->back;
}

static GLenum factor(GLenum given)
{
    return given == GNI_ZERO ? GL_ZERO : given;
}

static void send_blending(gn_gles *g, const gni_state *wanted)
{
    const gn_gl *gl = &g->gl;
    gni_state *last = &g->state;

    if (wanted->blend_source != last->blend_source || wanted->blend_destination != last->blend_destination ||
        wanted->alpha_source != last->alpha_source || wanted->alpha_destination != last->alpha_destination) {
        if (GNI_HAS_FALLBACK && wanted->alpha_source)
            gl->glBlendFuncSeparate(wanted->blend_source, wanted->blend_destination, factor(wanted->alpha_source),
                                    factor(wanted->alpha_destination));
        else
            gl->glBlendFunc(wanted->blend_source, wanted->blend_destination);
    }
    last->blend_source = wanted->blend_source;
    last->blend_destination = wanted->blend_destination;
    last->alpha_source = wanted->alpha_source;
    last->alpha_destination = wanted->alpha_destination;
}

/* Of the frame's pixels; where masks are smaller, all of theirs that have one of these, or a neighbour that does. */
static void send_scissor(gn_gles *g, const uint32_t scissor[4])
{
    uint32_t at[4], scale = GNI_HAS_FALLBACK && g->plan && g->into != GN_INTO_TARGET ? g->plan->scale : 1;

    memcpy(at, scissor, sizeof at);
    for (int i = 0; i < 2 && scale > 1; i++) {
        const uint32_t end = (scissor[i] + scissor[2 + i] + scale - 1) / scale + 1;

        at[i] = scissor[i] / scale;
        at[i] -= at[i] > 0;
        at[2 + i] = scissor[2 + i] ? end - at[i] : 0;
    }
    if (!g->state.scissor || memcmp(at, g->scissor, sizeof at) != 0)
        g->gl.glScissor((GLint)at[0], (GLint)at[1], (GLsizei)at[2], (GLsizei)at[3]);
    memcpy(g->scissor, at, sizeof at);
    g->state.scissor = scissor;
}

void gni_set_state(gn_gles *g, const gni_state *wanted)
{
    const gn_gl *gl = &g->gl;
    gni_state *last = &g->state; /* what GL has; a detail never sent since a reset is 0 */
    const int all = !g->state_is_known;

    send_switches(g, wanted);
    if (all || wanted->color_mask != last->color_mask)
        gl->glColorMask(wanted->color_mask & 1, wanted->color_mask >> 1 & 1, wanted->color_mask >> 2 & 1,
                        wanted->color_mask >> 3 & 1);
    if (all || wanted->depth_write != last->depth_write)
        gl->glDepthMask(wanted->depth_write);
    if (all || wanted->stencil_write != last->stencil_write)
        gl->glStencilMask(wanted->stencil_write);
    if (wanted->depth_func && wanted->depth_func != last->depth_func) {
        gl->glDepthFunc(wanted->depth_func);
        last->depth_func = wanted->depth_func;
    }
    if (wanted->stencil_func)
        send_stencil(g, wanted);
    if (wanted->blend_source || wanted->blend_destination)
        send_blending(g, wanted);
    if (GNI_HAS_FALLBACK && wanted->blend_equation != last->blend_equation)
        gl->glBlendEquation(wanted->blend_equation ? wanted->blend_equation : GL_FUNC_ADD);
    last->blend_equation = wanted->blend_equation;
    if (wanted->offset && wanted->offset != last->offset) {
        gl->glPolygonOffset(0.0f, (GLfloat)wanted->offset);
        last->offset = wanted->offset;
    }
    if (GNI_HAS_CULLING && wanted->scissor)
        send_scissor(g, wanted->scissor);
    if (GNI_HAS_CULLING && wanted->bounds && wanted->bounds != last->bounds) {
        gl->glDepthBoundsEXT(wanted->bounds[0], wanted->bounds[1]);
        last->bounds = wanted->bounds;
    }
    if (GNI_HAS_FALLBACK && wanted->cull && wanted->cull != last->cull) {
        gl->glCullFace(wanted->cull);
        last->cull = wanted->cull;
    }
    last->color_mask = wanted->color_mask;
    last->depth_write = wanted->depth_write;
    last->stencil_write = wanted->stencil_write;
    g->state_is_known = 1;
}

void gni_reset_state(gn_gles *g)
{
    const gn_gl *gl = &g->gl;

    memset(&g->state, 0, sizeof g->state);
    g->state_is_known = 0;
    gl->glFrontFace(GL_CCW);
    gl->glBlendEquation(GL_FUNC_ADD);
    for (GLuint i = 0; i < g->attribute_arrays; i++)
        gl->glDisableVertexAttribArray(i);
}

void gni_leave_state(gn_gles *g)
{
    const gn_gl *gl = &g->gl;

    gni_reset_state(g);
    gni_set_state(g, &gni_unmasked);
    gl->glDepthFunc(GL_LESS);
    gl->glStencilFunc(GL_ALWAYS, 0, ~0u);
    gl->glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
    gl->glBlendFunc(GL_ONE, GL_ZERO);
    gl->glCullFace(GL_BACK);
    gl->glPolygonOffset(0.0f, 0.0f);
    gl->glClearDepthf(1.0f);
    gl->glClearStencil(0);
    gl->glUseProgram(0);
    gl->glBindBuffer(GL_ARRAY_BUFFER, 0);
    gl->glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, 0);
    g->state_is_known = 0;
}
