/* traffic.c - the bytes that a frame writes and reads, estimated from its plan alone: what memory traffic costs is what a
 * small board spends its power on.
 *
 * The model is of a driver that goes to memory for every fragment: each surface covers its target once, a depth test
 * reads, what blends or counts reads and writes, a volume covers its scissor once with fronts and once with backs. A
 * board that renders in tiles pays less for what stays in a tile; as a measure of one method against another on the same
 * scene it is good enough. */
#include "gni_plan.h"

#include <string.h>

typedef struct buffers {
    double pixels, color, depth, image, image_depth, mask; /* bytes of a pixel */
} buffers;

static double area(const uint32_t at[4])
{
    return (double)at[2] * at[3];
}

static void note(gn_traffic *t, double *where, double written, double read)
{
    *where += written + read;
    t->written += written;
    t->read += read;
}

static double share_of(const gn_plan *plan, gn_into into)
{
    return into == GN_INTO_TARGET ? 1.0 : 1.0 / ((double)plan->scale * plan->scale);
}

static double pixels_of(const gn_plan *plan, const buffers *b, const gn_step *step)
{
    return share_of(plan, step->into) *
           (step->light == GN_NO_LIGHT || step->light_count > 1 ? b->pixels : area(plan->lights[step->light].scissor));
}

static void note_draw(gn_plan *plan, const buffers *b, const gn_step *step)
{
    gn_traffic *t = &plan->traffic;
    double *const color = step->into == GN_INTO_TARGET ? &t->target_color : &t->image_color;
    double *const depth = step->into == GN_INTO_TARGET ? &t->target_depth : &t->image_depth;
    const double depth_bytes = (step->into == GN_INTO_TARGET ? b->depth : b->image_depth) * pixels_of(plan, b, step);
    const double color_bytes = b->color * pixels_of(plan, b, step);

    switch (step->draw) {
    case GN_DRAW_DEPTH:
        note(t, depth, depth_bytes, depth_bytes);
        break;
    case GN_DRAW_AMBIENT:
    case GN_DRAW_LIT:
        note(t, depth, depth_bytes, depth_bytes);
        note(t, color, color_bytes, 0.0);
        break;
    case GN_DRAW_LIGHT:
        note(t, depth, 0.0, depth_bytes);
        note(t, color, color_bytes, color_bytes);
        if (plan->mask == GN_MASK_TEXTURE && step->receivers)
            note(t, &t->masks, 0.0, b->mask * pixels_of(plan, b, step));
        break;
    default:
        break;
    }
}

/* Where the step's count is: depth and stencil are one buffer. */
static void note_count(gn_plan *plan, const buffers *b, const gn_step *step, double pixels, int tests_depth)
{
    gn_traffic *t = &plan->traffic;
    const int is_image = step->into == GN_INTO_IMAGE;
    const double depth = is_image ? b->image_depth : b->depth;
    double *const at_depth = is_image && plan->image.depth_bits ? &t->image_depth : &t->target_depth;

    if (plan->lights[step->light].color.place == GN_PLACE_STENCIL) {
        note(t, at_depth, pixels * depth, pixels * depth);
        return;
    }
    if (tests_depth)
        note(t, at_depth, 0.0, pixels * depth);
    note(t, is_image ? &t->image_color : &t->target_color, pixels * (is_image ? b->image : b->color),
         pixels * (is_image ? b->image : b->color));
}

/* Quads of a fold or a normalisation: one where it is a stencil's. */
static double quads_of(const gn_plan *plan, const gn_step *step)
{
    const gn_color_layout *layout = &plan->lights[step->light == GN_NO_LIGHT ? 0 : step->light].color;

    return layout->quads > 0 ? layout->quads : 1.0;
}

static void note_step(gn_plan *plan, const buffers *b, const gn_step *step)
{
    gn_traffic *t = &plan->traffic;
    const double pixels = pixels_of(plan, b, step);

    switch (step->kind) {
    case GN_STEP_CLEAR:
        note(t, &t->target_color, pixels * b->color, 0.0);
        note(t, &t->target_depth, pixels * b->depth, 0.0);
        break;
    case GN_STEP_CLEAR_COLOR:
    case GN_STEP_OPAQUE:
        note(t, &t->target_color, pixels * b->color, 0.0);
        break;
    case GN_STEP_CLEAR_IMAGE:
        note(t, &t->image_color, pixels * b->image, 0.0);
        note(t, &t->image_depth, plan->image.depth_bits ? pixels * b->image_depth : 0.0, 0.0);
        break;
    case GN_STEP_CLEAR_MASK:
        note(t, &t->masks, b->pixels * b->mask * share_of(plan, step->into), 0.0);
        break;
    case GN_STEP_RESOLVE:
        note(t, &t->masks, pixels * b->mask, pixels * b->mask);
        note(t, &t->image_color, 0.0, pixels * b->image);
        break;
    case GN_STEP_COPY:
        note(t, &t->target_color, 0.0, pixels * b->color);
        note(t, &t->masks, pixels * b->mask, 0.0);
        break;
    case GN_STEP_NORMALISE:
        note(t, &t->target_color, quads_of(plan, step) * pixels * b->color, quads_of(plan, step) * pixels * b->color);
        break;
    case GN_STEP_SHADE:
        note(t, &t->target_color, pixels * b->color, pixels * b->color);
        note(t, &t->masks, 0.0, plan->mask == GN_MASK_TEXTURE ? pixels * b->mask : 0.0);
        break;
    case GN_STEP_DRAW:
        note_draw(plan, b, step);
        break;
    case GN_STEP_REFINE:
        note(t, &t->masks, 0.0, 2.0 * pixels * b->mask); /* a quad each for what is lit and what is not */
        note(t, &t->target_depth, pixels * b->depth, 0.0);
        break;
    case GN_STEP_FOLD:
        note_count(plan, b, step, quads_of(plan, step) * pixels, 0);
        break;
    case GN_STEP_ZERO:
    case GN_STEP_DARKEN:
        note_count(plan, b, step, pixels, 0);
        break;
    case GN_STEP_VOLUMES:
        for (uint32_t i = step->first_record; i < step->first_record + step->record_count; i++)
            note_count(plan, b, step, 2.0 * area(plan->records[i].scissor) * share_of(plan, step->into), 1);
        break;
    default:
        break;
    }
}

void gni_estimate_traffic(gn_plan *plan)
{
    const gn_target *target = &plan->target;
    const buffers b = {(double)target->width * target->height,
                       (target->red_bits + target->green_bits + target->blue_bits + target->alpha_bits) > 16 ? 4.0
                                                                                                             : 2.0,
                       target->depth_bits + target->stencil_bits > 16 ? 4.0 : 2.0,
                       gni_format_bytes(plan->image.format),
                       plan->image.depth_bits + plan->image.stencil_bits > 16 ? 4.0
                       : plan->image.depth_bits                               ? 2.0
                       : target->depth_bits + target->stencil_bits > 16       ? 4.0
                                                                              : 2.0,
                       gni_format_bytes(plan->mask_format)};

    memset(&plan->traffic, 0, sizeof plan->traffic);
    for (uint32_t i = 0; i < plan->step_count; i++)
        note_step(plan, &b, &plan->steps[i]);
}
