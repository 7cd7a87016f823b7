/* proof_clears.c - clears that reach a part of the target: under a scissor, under masks. Some tilers turn them into
 * drawing, and some do them wrong. Not in a cell among others: where they go wrong they clear everything. */
#include "proofs.h"

static int clears(gni_proofs *p)
{
    static const int yellow[4] = {255, 255, 0, -1}, magenta[4] = {255, 0, 255, -1}, of_blue[4] = {0, 0, 255, -1};
    static const int black[4] = {0, 0, 0, -1};
    const gn_gl *gl = p->gl;

    gl->glClearColor(0.0f, 0.0f, 0.0f, 0.0f);
    gl->glClear(GL_COLOR_BUFFER_BIT);
    gl->glEnable(GL_SCISSOR_TEST);
    gl->glScissor(p->x, p->y, 8, CELL);
    gl->glClearColor(1.0f, 1.0f, 0.0f, 1.0f);
    gl->glClear(GL_COLOR_BUFFER_BIT);
    gl->glScissor(p->x + 4, p->y, 8, CELL);
    gl->glColorMask(GL_FALSE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl->glClearColor(1.0f, 0.0f, 1.0f, 1.0f);
    gl->glClear(GL_COLOR_BUFFER_BIT);
    gl->glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl->glDisable(GL_SCISSOR_TEST);
    gl->glReadPixels(p->x, p->y, p->width, p->height, GL_RGBA, GL_UNSIGNED_BYTE, p->pixels);
    return gni_is_color(p, 0, 0, 4, CELL, yellow, "a clear under a scissor misses") &&
           gni_is_color(p, 4, 0, 4, CELL, magenta, "a clear under a mask is wrong") &&
           gni_is_color(p, 8, 0, 4, CELL, of_blue, "a clear under scissor and mask is wrong") &&
           gni_is_color(p, 12, 0, 4, CELL, black, "a clear passes its scissor");
}

const gni_lone_proof gni_proof_of_partial_clears[1] = {{GN_CAN_PARTIAL_CLEAR, 0, 0, clears}};
