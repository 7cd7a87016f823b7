/* batches_color.c - batches of counts in colour, which stop at the ends of their channel: as many casters as surely keep
 * within it at every pixel.
 *
 * The target is cut into tiles; a caster's volume adds its bound (fragments.c) to the tiles of its scissor, and where a
 * tile would have too much the batch ends. Counting fronts and backs, and steps up and down, go on casters cut into
 * pieces if one alone is too much. Halving and doubling keep few, a piece would be a batch: there the plan warns. */
#include "gni_plan.h"

#include <string.h>

void gni_start_color(gni_draft *d)
{
    memset(d->tiles, 0, GNI_TILES * GNI_TILES * sizeof *d->tiles);
}

/* First and last tile of a row or a column. */
static void find_tiles(uint32_t first_px, uint32_t count_px, uint32_t of_px, uint32_t tiles[2])
{
    tiles[0] = (uint32_t)((uint64_t)first_px * GNI_TILES / of_px);
    tiles[1] = (uint32_t)(((uint64_t)first_px + count_px - 1) * GNI_TILES / of_px);
}

void gni_make_room(gni_draft *d, const uint32_t scissor[4], uint32_t fragments)
{
    const gn_target *target = &d->scene->target;
    gn_plan_light *about = &d->lights[d->light];
    uint32_t columns[2], rows[2], most = 0;

    if (scissor[2] == 0 || scissor[3] == 0)
        return;
    find_tiles(scissor[0], scissor[2], target->width, columns);
    find_tiles(scissor[1], scissor[3], target->height, rows);
    for (uint32_t y = rows[0]; y <= rows[1]; y++)
        for (uint32_t x = columns[0]; x <= columns[1]; x++)
            most = most > d->tiles[GNI_TILES * y + x] ? most : d->tiles[GNI_TILES * y + x];
    if (most && most + fragments > (uint32_t)about->color.limit) {
        gni_end_batch(d, 1);
        gni_start_color(d);
        most = 0;
    }
    for (uint32_t y = rows[0]; y <= rows[1]; y++)
        for (uint32_t x = columns[0]; x <= columns[1]; x++)
            d->tiles[GNI_TILES * y + x] += fragments;
    about->fragments = about->fragments > most + fragments ? about->fragments : most + fragments;
}

void gni_add_colored(gni_draft *d, const gni_volume *v, const gni_casting *casting)
{
    gn_plan_light *about = &d->lights[d->light];
    const uint32_t fragments = gni_most_fragments(d, v, casting), limit = (uint32_t)about->color.limit;

    if (fragments > limit && gni_cuts_casters(about->method)) {
        gni_add_batched(d, v, casting);
        return;
    }
    if (fragments > limit)
        d->plan->warnings |= 1u << GN_WARN_RANGE;
    gni_make_room(d, v->extent->scissor, fragments);
    if (!gni_has_slot(d) || casting != &d->casting || !gni_add_kept_records(d, v, 1))
        gni_add_records(d, v, 1, casting);
}

void gni_fold_color(gni_draft *d, int more_follows)
{
    const gn_plan_light *about = &d->lights[d->light];

    if (about->color.place != GN_PLACE_IMAGE) {
        if (more_follows)
            gni_add_step(d, GN_STEP_FOLD, GN_DRAW_NOTHING, d->light, 0);
        return;
    }
    gni_add_step(d, GN_STEP_RESOLVE, GN_DRAW_NOTHING, d->light, 0);
    if (more_follows)
        gni_add_step(d, GN_STEP_ZERO, GN_DRAW_NOTHING, d->light, 0);
}
