/* kept_records.c - records of a volume whose indices are in the cache, all parts of them: a record is a run of these. */
#include "gni_plan.h"

int gni_kind_of_cap(const gni_draft *d, const gn_mesh *mesh)
{
    return mesh->info.solid_part_count == mesh->info.part_count && !gni_is_colored(d) ? GNI_STREAM_FAN : GNI_STREAM_CAP;
}

/* The stream of the slot at hand that a volume needs; NULL where there is no room. */
static const gni_stream *stream_for(gni_draft *d, const gni_volume *v, int *kind)
{
    const gn_mesh *mesh = d->scene->objects[v->object].mesh;
    const gni_stream *stream;

    *kind = v->far_end != GN_FAR_ENDED && d->bounds.light[3] == 0.0 ? GNI_STREAM_CONVERGING : gni_kind_of_cap(d, mesh);
    stream = gni_make_stream(d, v->object, *kind);
    if (!stream || *kind != GNI_STREAM_FAN || v->far_end == GN_FAR_ENDED ||
        (v->far_end == GN_FAR_INFINITE && d->slot->runs_round && gni_models_less(d->lights[d->light].method) &&
         gni_light_is_outside(&d->scene->lights[d->light], &d->scene->objects[v->object])))
        return stream;
    *kind = GNI_STREAM_CAP; /* a fan at infinity would not do */
    return gni_make_stream(d, v->object, *kind);
}

gni_run gni_find_run(const gni_stream *stream, int kind, uint32_t chunk, uint32_t *at)
{
    gni_run u = {*at,
                 0,
                 stream->parts[chunk].light_cap,
                 stream->parts[chunk].sides,
                 stream->parts[chunk].dark_cap,
                 stream->parts[chunk].near_cap,
                 stream->parts[chunk].turned_cap,
                 kind == GNI_STREAM_FAN};

    u.first_turned = *at + u.light_cap + u.sides + u.dark_cap + u.near_cap;
    *at = u.first_turned + u.turned_cap;
    return u;
}

int gni_add_kept_records(gni_draft *d, const gni_volume *v, uint32_t count)
{
    const gn_mesh *mesh = d->scene->objects[v->object].mesh;
    int kind;
    const gni_stream *stream = stream_for(d, v, &kind);
    uint32_t at;

    if (!stream)
        return 0;
    at = stream->first;
    for (uint32_t c = 0; c < mesh->info.chunk_count; c++) {
        const gni_run u = gni_find_run(stream, kind, c, &at);

        for (uint32_t i = 0; i < count; i++) {
            gn_record *r = &d->records[d->plan->record_count];
            int mcguire_case;
            const unsigned parts = gni_choose_parts(d, &v[i], &mcguire_case);

            gni_start_record(r, d, &v[i], v[i].extent->scissor, c);
            r->mcguire_case = mcguire_case;
            r->is_cached = 1;
            gni_use_run(r, &u, parts | GN_SIDES);
            gni_keep_record(d, r);
        }
    }
    return 1;
}
