/* proof_extensions.c - functions that only an extension has: a pointer to one proves nothing, its work does. */
#include "proofs.h"

#define TIME_ELAPSED     0x88BF /* GL_TIME_ELAPSED_EXT */
#define RESULT           0x8866 /* GL_QUERY_RESULT_EXT */
#define RESULT_AVAILABLE 0x8867 /* GL_QUERY_RESULT_AVAILABLE_EXT */

/* A query around a rectangle ends, once the GL is idle. */
static int times(gni_proofs *p)
{
    const gn_gl *gl = p->gl;
    GLuint query = 0, available = 0;
    GLenum error;

    if (!gl->glGenQueriesEXT || !gl->glDeleteQueriesEXT || !gl->glBeginQueryEXT || !gl->glEndQueryEXT ||
        !gl->glGetQueryObjectuivEXT)
        return gni_failed(p, "a function of it is missing");
    gl->glGenQueriesEXT(1, &query);
    gl->glBeginQueryEXT(TIME_ELAPSED, query);
    gni_draw_rectangle(p, 0, 0, CELL, CELL, 0.0f, 0, gni_red);
    gl->glEndQueryEXT(TIME_ELAPSED);
    gl->glFinish();
    gl->glGetQueryObjectuivEXT(query, RESULT_AVAILABLE, &available);
    error = gl->glGetError();
    gl->glDeleteQueriesEXT(1, &query);
    if (error != GL_NO_ERROR)
        return gni_failed(p, "the GL says 0x%04X", error);
    return available ? 1 : gni_failed(p, "no result when all is drawn");
}

#define DEPTH_EXT   0x1801 /* of framebuffer 0 */
#define STENCIL_EXT 0x1802

/* Colour outlives a discard of depth and stencil. */
static int discards(gni_proofs *p)
{
    const gn_gl *gl = p->gl;
    static const int is_red[4] = {255, 0, 0, -1};
    GLint bound = 0;
    GLenum names[2] = {DEPTH_EXT, STENCIL_EXT}, error;

    if (!gl->glDiscardFramebufferEXT)
        return gni_failed(p, "its function is missing");
    gl->glGetIntegerv(GL_FRAMEBUFFER_BINDING, &bound);
    if (bound) {
        names[0] = GL_DEPTH_ATTACHMENT;
        names[1] = GL_STENCIL_ATTACHMENT;
    }
    gni_draw_rectangle(p, 0, 0, CELL, CELL, 0.0f, 0, gni_red);
    gl->glDiscardFramebufferEXT(GL_FRAMEBUFFER, 2, names);
    gl->glReadPixels(p->x, p->y, p->width, p->height, GL_RGBA, GL_UNSIGNED_BYTE, p->pixels);
    error = gl->glGetError();
    if (error != GL_NO_ERROR)
        return gni_failed(p, "the GL says 0x%04X", error);
    return gni_is_color(p, 0, 0, CELL, CELL, is_red, "colour is lost with depth and stencil");
}

/* Over depths 0.25 and 0.75 that are there already, a rectangle under bounds of 0.5 to 1 is drawn on the second
 * alone. */
static int bounds_depth(gni_proofs *p)
{
    const gn_gl *gl = p->gl;
    static const int is_green[4] = {0, 255, 0, -1}, is_blue[4] = {0, 0, 255, -1};
    GLenum error;

    if (!gl->glDepthBoundsEXT)
        return gni_failed(p, "its function is missing");
    gl->glEnable(GL_DEPTH_TEST);
    gl->glDepthFunc(GL_ALWAYS);
    gni_draw_rectangle(p, 0, 0, 8, CELL, -0.5f, 0, gni_green);
    gni_draw_rectangle(p, 8, 0, 8, CELL, 0.5f, 0, gni_green);
    gl->glEnable(GNI_DEPTH_BOUNDS);
    gl->glDepthBoundsEXT(0.5, 1.0);
    gl->glDisable(GL_DEPTH_TEST);
    gni_draw_rectangle(p, 0, 0, CELL, CELL, 0.0f, 0, gni_blue);
    gl->glDisable(GNI_DEPTH_BOUNDS);
    gl->glDepthBoundsEXT(0.0, 1.0);
    gl->glReadPixels(p->x, p->y, p->width, p->height, GL_RGBA, GL_UNSIGNED_BYTE, p->pixels);
    error = gl->glGetError();
    if (error != GL_NO_ERROR)
        return gni_failed(p, "the GL says 0x%04X", error);
    return gni_is_color(p, 0, 0, 8, CELL, is_green, "what is out of bounds is drawn") &&
           gni_is_color(p, 8, 0, 8, CELL, is_blue, "what is within bounds is not drawn");
}

const gni_lone_proof gni_proofs_of_extensions[3] = {
    {GN_CAN_TIMER_QUERY, 0, 0, times},
    {GN_CAN_DISCARD, 0, 0, discards},
    {GN_CAN_DEPTH_BOUNDS, 1u << GN_CAN_DEPTH, 0, bounds_depth},
};
