/* show.c - volumes in one colour, to look at or to count. */
#include "gni_gles.h"

void gn_gles_draw_volumes(gn_gles *g, const gn_plan *plan, uint32_t first_record, uint32_t record_count,
                          const float color[4])
{
    gni_begin_volumes(g, &g->colored);
    g->gl.glUniform4fv(g->colored.color, 1, color);
    for (uint32_t i = first_record; i < first_record + record_count && i < plan->record_count; i++) {
        const int clamped = plan->records[i].far_end == GN_FAR_CLAMPED;
        const uint32_t *at = plan->records[i].scissor;

        g->gl.glEnable(GL_SCISSOR_TEST);
        g->gl.glScissor((GLint)at[0], (GLint)at[1], (GLsizei)at[2], (GLsizei)at[3]);
        if (clamped)
            g->gl.glEnable(GNI_DEPTH_CLAMP);
        for (int turned = 0; turned < 2; turned++)
            gni_draw_record(g, plan, &plan->records[i], turned);
        if (clamped)
            g->gl.glDisable(GNI_DEPTH_CLAMP);
    }
    g->gl.glDisable(GL_SCISSOR_TEST);
    g->gl.glScissor(0, 0, (GLsizei)plan->target.width, (GLsizei)plan->target.height);
    gni_end_volumes(g);
}
