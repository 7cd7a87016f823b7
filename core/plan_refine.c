/* plan_refine.c - the passes of the method refine: masks of all lights at a half or a quarter of the frame's size, then the
 * frame, in whose stencil each light's volumes are counted again where its small mask is contested.
 *
 * The idea is that of Chan and Durand 2004 (in Rautenbach 2008), who let a shadow map say where volumes are needed; a
 * small mask by the same volumes says it without a map's bias, and for lights all around. All small masks come before
 * the frame: a change of framebuffer in its middle costs a tile-based board a load and a store. */
#include "gni_plan.h"

void gni_start_refined(gni_draft *d)
{
    gni_add_step(d, GN_STEP_CLEAR_IMAGE, GN_DRAW_NOTHING, GN_NO_LIGHT, 0);
    gni_add_step(d, GN_STEP_DRAW, GN_DRAW_DEPTH, GN_NO_LIGHT, 0);
}

/* The volumes of a light's small mask, once more, in the target. */
static void count_again(gni_draft *d, uint32_t light, uint32_t first, uint32_t end)
{
    for (uint32_t i = first; i < end; i++) {
        const gn_step *step = &d->steps[i];

        if (step->light != light || (step->kind != GN_STEP_VOLUMES && step->kind != GN_STEP_FOLD))
            continue;
        d->steps[d->plan->step_count] = *step;
        d->steps[d->plan->step_count++].into = GN_INTO_TARGET;
    }
}

void gni_refine(gni_draft *d, uint32_t first_step)
{
    const uint32_t end = d->plan->step_count;

    d->is_refining = 1;
    gni_start_stain(d);
    if (d->mask_count == 0) {
        gni_need_no_masks(d, first_step);
    } else {
        d->plan->mask_count = 1 + (d->mask_count + d->choice.lights_per_mask - 1) / d->choice.lights_per_mask;
        if (gn_target_can(&d->scene->target, GN_CAN_DISCARD))
            gni_add_step(d, GN_STEP_DISCARD, GN_DRAW_NOTHING, GN_NO_LIGHT, 0)->into = GN_INTO_IMAGE;
    }
    gni_start_frame(d);
    for (uint32_t light = 0; light < d->scene->light_count; light++) {
        if (d->lights[light].skip != GN_SKIP_NOT)
            continue;
        if (d->lights[light].is_shadowed) {
            gni_add_step(d, GN_STEP_REFINE, GN_DRAW_NOTHING, light, 0);
            count_again(d, light, first_step, end);
            gni_stain_stencil(d, light);
        } else {
            gni_clean_stencil(d, light);
            if (d->scene->blend_once)
                gni_stain_stencil(d, light);
        }
        gni_add_own_passes(d, light);
    }
}
