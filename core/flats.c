/* flats.c - records of caps alone, on patches: the fan that closes a volume on a plane is also its projection on any
 * other. It is made once, for a volume's record, or in the cache, or here. */
#include "gni_plan.h"

/* What a volume's record has of a cap on patches. Returns 1 where that is a cap too. */
static int share_record(const gni_draft *d, uint32_t first_record, uint32_t chunk, gn_record *cap, gni_outline *outline)
{
    for (uint32_t i = first_record; i < d->plan->record_count; i++) {
        const gn_record *r = &d->records[i];

        if (r->chunk != chunk || r->side_count == 0 || r->is_cached)
            continue;
        outline->first = r->first_side;
        outline->count = r->side_count;
        outline->of_a_side = r->far_end != GN_FAR_ENDED && d->bounds.light[3] == 0.0 ? 3 : 6;
        cap->first_index = r->first_dark_cap;
        cap->dark_cap_count = r->dark_cap_count;
        cap->fan = r->fan;
        return r->fan;
    }
    return 0;
}

/* The same from the cache. */
static void share_stream(const gni_stream *stream, int kind, uint32_t chunk, gn_record *cap, gni_outline *outline)
{
    uint32_t at = stream->first;
    gni_run u = gni_find_run(stream, kind, 0, &at);

    for (uint32_t c = 1; c <= chunk; c++)
        u = gni_find_run(stream, kind, c, &at);
    cap->first_index = u.first + u.light_cap + u.sides;
    cap->dark_cap_count = u.dark_cap;
    cap->is_cached = 1;
    cap->fan = u.fan;
    outline->first = u.first + u.light_cap;
    outline->count = u.sides;
    outline->of_a_side = 6;
}

/* Or made for this frame, behind an outline unless there is one. */
static void make_cap(gni_draft *d, const gn_mesh *mesh, uint32_t chunk, gn_record *cap, gni_outline *outline)
{
    uint16_t *at = d->indices + d->plan->index_count;

    if (outline->count == 0) {
        outline->first = d->plan->index_count;
        outline->of_a_side = 3;
        at += outline->count = gni_put_sides(mesh, chunk, &d->casting, 1, at);
    }
    cap->first_index = (uint32_t)(at - d->indices);
    cap->fan = gni_is_better_fan(mesh, outline->count / outline->of_a_side, d->casting.count);
    cap->dark_cap_count = cap->fan ? gni_put_fan(mesh, chunk, d->indices + outline->first, outline->count,
                                                 outline->of_a_side, &d->walk, at)
                                   : gni_put_dark_cap(mesh, chunk, &d->casting, at);
    d->plan->index_count = cap->first_index + cap->dark_cap_count;
}

void gni_add_flats(gni_draft *d, uint32_t object, const gni_extent *extent, uint32_t first_record)
{
    const gn_mesh *mesh = d->scene->objects[object].mesh;
    const int kind = gni_has_slot(d) ? gni_kind_of_cap(d, mesh) : GNI_STREAM_FAN;
    const gni_stream *stream = gni_has_slot(d) ? gni_make_stream(d, object, kind) : NULL;
    uint32_t silhouette = 0;

    if (!stream)
        gni_know_casting(d, object);
    for (uint32_t c = 0; c < mesh->info.chunk_count; c++) {
        gn_record cap = {0};
        gni_outline outline = {0, 0, 6};

        if (GNI_HAS_CACHE && stream)
            share_stream(stream, kind, c, &cap, &outline);
        else if (!share_record(d, first_record, c, &cap, &outline))
            make_cap(d, mesh, c, &cap, &outline);
        silhouette += outline.count / outline.of_a_side;
        for (uint32_t p = 0; p < d->patch_count && cap.dark_cap_count; p++)
            if (extent->on[p] == GNI_FANS_PATCH) {
                const gni_volume v = {object, NULL, extent, GN_FAR_ENDED, NULL, d->patches[p].plane, 0.0, 0};
                gn_record *r = &d->flats[d->flat_count];

                d->outlines[d->flat_count++] = outline;
                gni_start_record(r, d, &v, extent->shadow[p], c);
                r->first_index = r->first_dark_cap = r->first_side = cap.first_index;
                r->dark_cap_count = cap.dark_cap_count;
                r->is_cached = cap.is_cached;
                r->parts = GN_DARK_CAP;
                r->patch = p + 1;
                r->fan = cap.fan;
            }
    }
    gni_note_layers(d, object, stream ? d->slot->triangles : d->casting.count, silhouette);
}
