/* plan_passes.c - the passes of a frame, in order. McGuire's (2003, section 4): depth and ambient light together; for each
 * light its volumes counted, and its light added where the count is zero; last what is transparent.
 *
 * Masks in textures come before all that: offscreen, with depth of their own that the host draws first, or under the
 * frame's if it can be shared; or in the target's own colour, copied. Then one pass adds several lights. A frame that is
 * not GN_SHADE_ADDITIVE is drawn fully lit, and dimmed in each light's shadow (Roettger 2002, section 4.3). */
#include "gni_plan.h"

#include <string.h>

static gn_into into_of(const gni_draft *d, gn_step_kind kind, gn_draw draw)
{
    const gn_plan *plan = d->plan;
    const int has_image = plan->image.format != GN_FORMAT_NONE && !d->is_refining;
    const gn_into counted = has_image                               ? GN_INTO_IMAGE
                            : plan->scale > 1 && !gni_is_refined(d) ? GN_INTO_CORNER
                                                                    : GN_INTO_TARGET;

    switch (kind) {
    case GN_STEP_ZERO:
    case GN_STEP_VOLUMES:
    case GN_STEP_FOLD:
    case GN_STEP_MARK:
    case GN_STEP_DARKEN:
    case GN_STEP_CLEAR_IMAGE:
    case GN_STEP_NORMALISE:
        return counted;
    case GN_STEP_CLEAR_MASK:
    case GN_STEP_RESOLVE: /* the colour of an image with a stencil is the mask */
        return plan->image.stencil_bits ? GN_INTO_IMAGE : GN_INTO_MASK;
    case GN_STEP_DRAW:
        return draw == GN_DRAW_DEPTH ? counted : GN_INTO_TARGET;
    default:
        return GN_INTO_TARGET;
    }
}

gn_step *gni_add_step(gni_draft *d, gn_step_kind kind, gn_draw draw, uint32_t light, int receivers)
{
    gn_step *step = &d->steps[d->plan->step_count++];

    memset(step, 0, sizeof *step);
    step->kind = kind;
    step->draw = draw;
    step->into = into_of(d, kind, draw);
    step->light = light;
    step->receivers = receivers;
    step->mask = light == GN_NO_LIGHT ? GN_NO_MASK : d->lights[light].mask_texture;
    return step;
}

static gn_step *add(gni_draft *d, gn_step_kind kind)
{
    return gni_add_step(d, kind, GN_DRAW_NOTHING, GN_NO_LIGHT, 0);
}

static void add_draw(gni_draft *d, gn_draw draw)
{
    gni_add_step(d, GN_STEP_DRAW, draw, GN_NO_LIGHT, 0);
}

static int is_screen(const gni_draft *d)
{
    return GNI_HAS_FALLBACK && d->choice.color.place == GN_PLACE_COLOR;
}

void gni_add_surfaces(gni_draft *d)
{
    gni_add_step(d, GN_STEP_DRAW, gni_is_additive(d) ? GN_DRAW_AMBIENT : GN_DRAW_LIT, GN_NO_LIGHT, 1);
}

void gni_start_frame(gni_draft *d)
{
    if (d->scene->follows)
        return;
    add(d, GN_STEP_CLEAR);
    gni_add_surfaces(d);
}

/* Whether the light's pass, or what dims its shadow, is needed of the receivers. */
static int is_passed(const gni_draft *d, uint32_t light, unsigned draws)
{
    return d->draws[light] & draws && (gni_is_additive(d) || d->lights[light].is_shadowed);
}

/* Shadows have dimmed what does not receive too: it is drawn again. */
static void redraw_others(gni_draft *d)
{
    const gn_scene *s = d->scene;
    int any = 0;

    for (uint32_t i = 0; i < s->object_count; i++)
        any |= !(s->objects[i].flags & GN_RECEIVES);
    if (any && d->receivers_are_known && !gni_is_additive(d))
        gni_add_step(d, GN_STEP_DRAW, GN_DRAW_LIT, GN_NO_LIGHT, 0);
}

/* Depth, and the frame too where masks are made under its depth. */
static void start_masks(gni_draft *d)
{
    const gn_image *image = &d->plan->image;

    if (image->format == GN_FORMAT_NONE)
        add(d, GN_STEP_CLEAR);
    else if (image->depth_bits == 0)
        gni_start_frame(d);
    if (image->format != GN_FORMAT_NONE)
        add(d, GN_STEP_CLEAR_IMAGE);
    if (image->format == GN_FORMAT_NONE || image->depth_bits > 0)
        add_draw(d, GN_DRAW_DEPTH);
}

/* The mask that was made in the target's colour becomes a texture. */
static void copy_mask(gni_draft *d, uint32_t texture)
{
    add(d, GN_STEP_NORMALISE);
    add(d, GN_STEP_COPY)->mask = texture;
}

void gni_start_mask(gni_draft *d)
{
    const uint32_t texture = d->lights[d->light].mask_texture;

    if (is_screen(d)) {
        if (texture > 0)
            copy_mask(d, texture - 1);
    } else if (texture > 0 || gni_is_refined(d) || !d->plan->image.stencil_bits) {
        gni_add_step(d, GN_STEP_CLEAR_MASK, GN_DRAW_NOTHING, d->light, 0);
    }
}

void gni_need_no_masks(gni_draft *d, uint32_t first_step)
{
    static const gn_image none = {GN_FORMAT_NONE, 0, 0};

    d->plan->step_count = first_step;
    d->plan->image = none;
    d->plan->carries_depth = 0;
}

/* All masks are made: then the frame, where it is not there already. */
static void end_masks(gni_draft *d, uint32_t first_step)
{
    const gn_image *image = &d->plan->image;
    const int is_drawn = image->format != GN_FORMAT_NONE && image->depth_bits == 0;

    d->plan->mask_count = (d->mask_count + d->choice.lights_per_mask - 1) / d->choice.lights_per_mask;
    if (d->mask_count == 0) { /* none was needed */
        gni_need_no_masks(d, first_step);
        gni_start_frame(d);
        return;
    }
    if (is_screen(d))
        copy_mask(d, d->plan->mask_count - 1);
    if (image->format != GN_FORMAT_NONE && gn_target_can(&d->scene->target, GN_CAN_DISCARD))
        add(d, GN_STEP_DISCARD)->into = GN_INTO_IMAGE;
    if (is_drawn)
        return;
    if (is_screen(d) && d->plan->scale == 1) {
        add(d, GN_STEP_CLEAR_COLOR);
        gni_add_surfaces(d);
    } else {
        gni_start_frame(d);
    }
}

/* Lights of one mask texture, or those that need none, in one pass; or each in its own. */
static void add_group(gni_draft *d, uint32_t *first, unsigned draws)
{
    const int receivers = draws == GNI_DRAWS_RECEIVERS, is_additive = gni_is_additive(d);
    const uint32_t most = gni_reads_masks(d) ? d->choice.lights_per_mask : 1;
    gn_step *step = NULL;

    for (; *first < d->scene->light_count; (*first)++) {
        const uint32_t light = *first;

        if (!is_passed(d, light, draws))
            continue;
        if (step && (step->light_count == most ||
                     (receivers && d->lights[light].mask_texture != d->lights[step->light].mask_texture)))
            return;
        if (!step)
            step = gni_add_step(d, is_additive ? GN_STEP_DRAW : GN_STEP_SHADE,
                                is_additive ? GN_DRAW_LIGHT : GN_DRAW_NOTHING, light, receivers);
        step->lights[step->light_count++] = light;
    }
}

static void add_light_passes(gni_draft *d)
{
    const unsigned last = gni_is_additive(d) ? GNI_DRAWS_OTHERS : GNI_DRAWS_RECEIVERS;

    for (unsigned draws = GNI_DRAWS_RECEIVERS; draws <= last; draws <<= 1)
        for (uint32_t light = 0; light < d->scene->light_count;)
            add_group(d, &light, draws);
}

void gni_add_own_passes(gni_draft *d, uint32_t light)
{
    const int is_once = d->scene->blend_once, is_alpha = GNI_HAS_FALLBACK && d->plan->mask == GN_MASK_ALPHA;
    gn_step *step;

    if (is_passed(d, light, GNI_DRAWS_RECEIVERS)) {
        step = gni_is_additive(d) ? gni_add_step(d, GN_STEP_DRAW, GN_DRAW_LIGHT, light, 1)
                                  : gni_add_step(d, GN_STEP_SHADE, GN_DRAW_NOTHING, light, 0);
        step->lights[0] = light;
        step->light_count = 1;
    }
    if (!(d->draws[light] & GNI_DRAWS_OTHERS) || !gni_is_additive(d))
        return;
    if (is_once && is_alpha)
        gni_add_step(d, GN_STEP_OPAQUE, GN_DRAW_NOTHING, light, 0);
    else if (is_once)
        gni_clean_stencil(d, light);
    step = gni_add_step(d, GN_STEP_DRAW, GN_DRAW_LIGHT, light, 0);
    step->lights[0] = light;
    step->light_count = 1;
    if (is_once && !is_alpha)
        gni_stain_stencil(d, light);
}

void gni_end_batch(gni_draft *d, int more_follows)
{
    gn_step *step;

    if (d->plan->record_count == d->first_of_batch)
        return; /* nothing since the last */
    gni_add_step(d, GN_STEP_VOLUMES, GN_DRAW_NOTHING, d->light, 0);
    step = &d->steps[d->plan->step_count - 1];
    step->first_record = d->first_of_batch;
    step->record_count = d->plan->record_count - d->first_of_batch;
    d->first_of_batch = d->plan->record_count;
    d->lights[d->light].batches++;
    if (gni_is_colored(d))
        gni_fold_color(d, more_follows);
    else if (more_follows)
        gni_add_step(d, GN_STEP_FOLD, GN_DRAW_NOTHING, d->light, 0);
}

/* All lights, and what is before, between and behind them. */
static gn_result add_lights(gni_draft *d)
{
    const int are_textures = gni_reads_masks(d) && !d->reuses_masks;
    const uint32_t first_step = d->plan->step_count;
    gn_result result = GN_OK;

    if (gni_is_refined(d)) {
        gni_start_refined(d);
    } else if (are_textures) {
        start_masks(d);
    } else {
        gni_start_frame(d);
    }
    for (uint32_t light = 0; light < d->scene->light_count && result == GN_OK; light++) {
        d->draws[light] = 0;
        result = gni_add_light(d, light);
        if (!gni_reads_masks(d) && !gni_is_refined(d))
            gni_add_own_passes(d, light);
    }
    if (result != GN_OK)
        return result;
    if (gni_is_refined(d))
        gni_refine(d, first_step);
    if (are_textures)
        end_masks(d, first_step);
    if (gni_reads_masks(d))
        add_light_passes(d);
    return GN_OK;
}

gn_result gni_add_passes(gni_draft *d)
{
    gn_result result;

    d->reuses_masks = GNI_HAS_CACHE && gni_may_reuse_masks(d);
    result = add_lights(d);
    if (GNI_HAS_CACHE && result == GN_OK && d->must_remake) {
        memset(d->lights, 0, d->scene->light_count * sizeof *d->lights);
        d->plan->step_count = 0;
        d->reuses_masks = 0;
        result = add_lights(d);
    }
    if (result != GN_OK)
        return result;
    if (GNI_HAS_CACHE && d->reuses_masks)
        gni_reuse_masks(d);
    else if (GNI_HAS_CACHE)
        gni_note_masks(d);
    redraw_others(d);
    if (!d->scene->precedes)
        add_draw(d, GN_DRAW_FINAL);
    if (GNI_HAS_FALLBACK && d->plan->mask == GN_MASK_ALPHA)
        add(d, GN_STEP_OPAQUE);
    if (GNI_HAS_FALLBACK && d->scene->discards && !d->scene->precedes &&
        gn_target_can(&d->scene->target, GN_CAN_DISCARD))
        add(d, GN_STEP_DISCARD);
    return GN_OK;
}
