/* stain.c - where the stencil may differ from its reference, so that it is zeroed by a quad only where that matters
 * (DESIGN.md, decision 9). */
#include "gni_plan.h"

#include <string.h>

static void corners_of(const uint32_t scissor[4], uint32_t at[4])
{
    for (int i = 0; i < 2; i++) {
        at[i] = scissor[i];
        at[2 + i] = scissor[i] + scissor[2 + i];
    }
}

static int is_inside(const uint32_t inner[4], const uint32_t outer[4])
{
    return inner[0] >= outer[0] && inner[1] >= outer[1] && inner[2] <= outer[2] && inner[3] <= outer[3];
}

void gni_start_stain(gni_draft *d)
{
    memset(&d->stain, 0, sizeof d->stain);
    d->stain.reference = d->choice.stencil.reference;
    if (!d->scene->follows || (d->choice.image.format != GN_FORMAT_NONE && !d->is_refining))
        return; /* it is cleared */
    d->stain.at[2] = d->scene->target.width;
    d->stain.at[3] = d->scene->target.height;
}

void gni_clean_stencil(gni_draft *d, uint32_t light)
{
    const gn_plan_light *about = &d->lights[light];
    uint32_t *dirty = d->stain.at, at[4];

    if (!GNI_HAS_CULLING) { /* all lights are everywhere */
        if (dirty[2])
            gni_add_step(d, GN_STEP_ZERO, GN_DRAW_NOTHING, light, 0);
        dirty[2] = 0;
        return;
    }
    corners_of(about->scissor, at);
    if (light == 0) /* the clear is to its reference */
        d->stain.reference = about->stencil.reference;
    if (about->stencil.reference != d->stain.reference) { /* then all of it does */
        dirty[0] = dirty[1] = 0;
        dirty[2] = d->scene->target.width;
        dirty[3] = d->scene->target.height;
        d->stain.reference = about->stencil.reference;
    }
    if (at[0] >= dirty[2] || dirty[0] >= at[2] || at[1] >= dirty[3] || dirty[1] >= at[3])
        return;
    gni_add_step(d, GN_STEP_ZERO, GN_DRAW_NOTHING, light, 0);
    if (is_inside(dirty, at))
        memset(dirty, 0, sizeof d->stain.at);
}

void gni_stain_stencil(gni_draft *d, uint32_t light)
{
    uint32_t *dirty = d->stain.at, at[4];

    if (!GNI_HAS_CULLING) {
        dirty[2] = d->scene->target.width;
        return;
    }
    corners_of(d->lights[light].scissor, at);
    if (dirty[0] >= dirty[2]) {
        memcpy(dirty, at, sizeof at);
        return;
    }
    for (int i = 0; i < 2; i++) {
        dirty[i] = dirty[i] < at[i] ? dirty[i] : at[i];
        dirty[2 + i] = dirty[2 + i] > at[2 + i] ? dirty[2 + i] : at[2 + i];
    }
}
