/* records.c - records of a volume: where its indices are, chunk by chunk, and where its far vertices go.
 *
 * Indices are made for this frame, of the parts that its way of counting takes; or they are in the cache, all parts of
 * them, and a record is a run of these. The fan that closes a volume on a plane is also its projection on any patch: it
 * is made once. */
#include "gni_plan.h"

#include <math.h>
#include <string.h>

/* Planes go the other way: a plane p of view space is p m in object space, row times matrix. */
void gni_plane_before(double out[4], const double plane[4], const double m[16])
{
    double r[4];

    for (int column = 0; column < 4; column++)
        r[column] = plane[0] * m[4 * column] + plane[1] * m[4 * column + 1] + plane[2] * m[4 * column + 2] +
                    plane[3] * m[4 * column + 3];
    memcpy(out, r, sizeof r);
}

static int greatest_exponent(const double m[16])
{
    double most = 0.0;
    int exponent;

    for (int i = 0; i < 16; i++)
        most = fmax(most, fabs(m[i]));
    frexp(most, &exponent);
    return exponent;
}

/* projection * extrusion * model_view, like near_matrix. Homogeneous matrices mean the same at any scale, and a power
 * of two keeps every bit: far vertices get the magnitude of near ones. A light far away stays within float, and
 * clipping a side between the two rounds alike in every unit of length. */
static void multiply_like(double out[16], const double projection[16], const double extrusion[16],
                          const double model_view[16], const double near_matrix[16])
{
    int shift;

    gn_mat4_multiply(out, projection, extrusion);
    gn_mat4_multiply(out, out, model_view);
    shift = greatest_exponent(near_matrix) - greatest_exponent(out);
    for (int i = 0; i < 16; i++)
        out[i] = ldexp(out[i], shift);
}

/* A record of a volume before its indices. */
static void start_record(gn_record *r, const gni_draft *d, const gni_volume *v, const uint32_t scissor[4],
                         uint32_t chunk)
{
    const gn_object *object = &d->scene->objects[v->object];
    double model_view[16], near_matrix[16], extrusion[16], far_matrix[16];

    memset(r, 0, sizeof *r);
    gni_model_view(model_view, &d->scene->camera, object->model, object->mesh->info.centre);
    if (v->end_reach > 0.0) {
        gni_extrusion_by(extrusion, d->bounds.light, v->end_reach);
    } else {
        gni_extrusion(extrusion, d->bounds.light, v->end_plane);
        gni_plane_before(r->end_plane, v->end_plane, d->view);
    }
    gn_mat4_multiply(near_matrix, d->projection, model_view);
    multiply_like(far_matrix, d->projection, extrusion, model_view, near_matrix);
    gn_mat4_to_float(r->far_matrix, far_matrix);
    memcpy(r->near_matrix, d->objects[v->object].matrix, sizeof r->near_matrix);
    if (v->start_plane) {
        gni_extrusion(extrusion, d->bounds.light, v->start_plane);
        multiply_like(far_matrix, d->projection, extrusion, model_view, near_matrix);
        gn_mat4_to_float(r->near_matrix, far_matrix);
        gni_plane_before(r->start_plane, v->start_plane, d->view);
        r->detached = 1;
    }
    r->light = d->light;
    r->object = v->object;
    r->chunk = chunk;
    r->mirrored = d->objects[v->object].mirrored;
    r->far_end = v->far_end;
    r->end_reach = v->end_reach;
    r->unpatched = v->unpatched || d->choice.is_refined; /* what has no name */
    r->thin = d->choice.is_refined && gni_is_thin_shadow(d, v->object, v->extent);
    memcpy(r->scissor, scissor, sizeof r->scissor);
}

/* Whether the dark cap of a volume that ends on a plane is better a fan. In several chunks it must be so in all, or in
 * none: closed meshes have the fewer edges. */
static int is_better_fan(const gn_mesh *mesh, uint32_t edges, uint32_t triangles)
{
    return mesh->info.chunk_count > 1 ? mesh->info.solid_part_count == mesh->info.part_count : edges < triangles;
}

static int is_fan(const gni_draft *d, const gni_volume *v, uint32_t count, uint32_t chunk, uint32_t triangles,
                  const uint16_t *sides, uint32_t side_count, uint32_t of_a_side)
{
    const gn_object *object = &d->scene->objects[v->object];
    const gn_mesh *mesh = object->mesh;
    const double *light = d->bounds.light;
    double model_view[16];

    if (v[count - 1].start_plane)
        return 1;
    if (!gni_models_less(d->lights[d->light].method) || v->end_reach > 0.0 || v->far_end == GN_FAR_CLAMPED ||
        !is_better_fan(mesh, side_count / of_a_side, triangles))
        return 0;
    if (v->far_end == GN_FAR_ENDED)
        return !d->region;
    if (light[3] == 0.0 || mesh->info.chunk_count > 1 || !gni_light_is_outside(&d->boxes[v->object], light))
        return 0;
    gni_model_view(model_view, &d->scene->camera, object->model, mesh->info.centre);
    return gni_runs_round_hub(mesh, chunk, sides, side_count, of_a_side, model_view, light);
}

static gn_plan_caster *caster_of(gni_draft *d, uint32_t object)
{
    return &d->casters[(size_t)d->light * d->scene->object_count + object];
}

/* A record whose counts are known is one of the plan's. */
static void keep_record(gni_draft *d, gn_record *r)
{
    gn_plan_caster *caster = caster_of(d, r->object);

    r->parts = (r->side_count ? GN_SIDES : 0u) | (r->dark_cap_count ? GN_DARK_CAP : 0u) |
               (r->light_cap_count + r->turned_cap_count ? GN_LIGHT_CAP : 0u) | (r->near_cap_count ? GN_NEAR_CAP : 0u);
    if (!r->parts)
        return;
    d->plan->record_count++;
    caster->mcguire_case = (uint8_t)r->mcguire_case;
    caster->parts |= (uint8_t)r->parts;
    caster->fan |= (uint8_t)r->fan;
    caster->is_ended |= r->far_end == GN_FAR_ENDED && !d->region;
}

/* Where the parts of a chunk are, one behind the other, the turned cap wherever. */
typedef struct run {
    uint32_t first, first_turned, light_cap, sides, dark_cap, near_cap, turned_cap; /* indices */
    int fan;
} run;

/* What a volume takes of them. */
static void use_run(gn_record *r, const run *u, unsigned parts)
{
    r->light_cap_count = parts & GN_LIGHT_CAP ? u->light_cap : 0;
    r->turned_cap_count = parts & GN_LIGHT_CAP ? u->turned_cap : 0;
    r->side_count = parts & GN_SIDES || r->light_cap_count ? u->sides : 0;
    r->dark_cap_count = parts & GN_DARK_CAP ? u->dark_cap : 0;
    r->near_cap_count = r->detached ? u->near_cap : 0;
    r->first_side = u->first + u->light_cap;
    r->first_dark_cap = r->first_side + u->sides;
    r->first_turned_cap = u->first_turned;
    r->first_index = r->light_cap_count ? u->first : r->side_count ? r->first_side : r->first_dark_cap;
    r->fan = u->fan && r->dark_cap_count;
}

uint32_t gni_add_records(gni_draft *d, const gni_volume *v, uint32_t count, const gni_casting *casting)
{
    const gn_mesh *mesh = d->scene->objects[v->object].mesh;
    const int converges = v->far_end != GN_FAR_ENDED && d->bounds.light[3] == 0.0;
    const uint32_t of_a_side = converges ? 3 : 6;
    const int is_cut = v[count - 1].start_plane != NULL;
    unsigned parts[GNI_MOST_INTERVALS], all = 0;
    int mcguire_case, slivers = 0;
    uint32_t silhouette;
    double eye[4], heights[2];

    for (uint32_t i = 0; i < count; i++)
        all |= parts[i] = gni_choose_parts(d, &v[i], &mcguire_case);
    if (mcguire_case == 1 && all & GN_LIGHT_CAP && gni_models_less(d->lights[d->light].method))
        slivers = gni_find_slivers(d, v, eye, heights);
    silhouette = all & GN_SIDES ? 0 : GNI_NONE;
    for (uint32_t c = 0; c < mesh->info.chunk_count; c++) {
        uint16_t *const out = d->indices + d->plan->index_count, *at = out, *sides;
        run u = {d->plan->index_count, 0, 0, 0, 0, 0, 0, 0};

        if (all & GN_LIGHT_CAP && slivers)
            at += u.light_cap = gni_put_slivers(mesh, c, casting, eye, heights, at);
        else if (all & GN_LIGHT_CAP)
            at += u.light_cap = gni_put_light_cap(mesh, c, casting, 1, at);
        sides = at;
        if (all & GN_SIDES)
            at += u.sides = gni_put_sides(mesh, c, casting, converges, at);
        if (all & GN_DARK_CAP && !converges) {
            u.fan = is_fan(d, v, count, c, casting->count, sides, u.sides, of_a_side);
            u.dark_cap = u.fan ? gni_put_fan(mesh, c, sides, u.sides, of_a_side, &d->walk, at)
                               : gni_put_dark_cap(mesh, c, casting, at);
            if (is_cut)
                gni_put_near_fan(at, u.near_cap = u.dark_cap, at + u.dark_cap);
            at += u.dark_cap + u.near_cap;
        }
        u.first_turned = d->plan->index_count + (uint32_t)(at - out);
        if (all & GN_LIGHT_CAP && !slivers)
            at += u.turned_cap = gni_put_light_cap(mesh, c, casting, -1, at);
        d->plan->index_count += (uint32_t)(at - out);
        for (uint32_t i = 0; i < count; i++) {
            gn_record *r = &d->records[d->plan->record_count];

            start_record(r, d, &v[i], v[i].extent->scissor, c);
            r->mcguire_case = mcguire_case;
            r->slivers = slivers && parts[i] & GN_LIGHT_CAP;
            use_run(r, &u, parts[i]);
            keep_record(d, r);
        }
        if (silhouette != GNI_NONE)
            silhouette += u.sides / of_a_side;
    }
    return silhouette;
}

/* Of closed meshes a fan; but counts in colour stop at the ends, and a fan's triangles may lie on each other. */
static int kind_of_cap(const gni_draft *d, const gn_mesh *mesh)
{
    return mesh->info.solid_part_count == mesh->info.part_count && !d->is_colored ? GNI_STREAM_FAN : GNI_STREAM_CAP;
}

/* The stream of the slot at hand that a volume needs; NULL where there is no room. */
static const gni_stream *stream_for(gni_draft *d, const gni_volume *v, int *kind)
{
    const gn_mesh *mesh = d->scene->objects[v->object].mesh;
    const gni_stream *stream;

    *kind = v->far_end != GN_FAR_ENDED && d->bounds.light[3] == 0.0 ? GNI_STREAM_CONVERGING : kind_of_cap(d, mesh);
    stream = gni_make_stream(d, v->object, *kind);
    if (!stream || *kind != GNI_STREAM_FAN || v->far_end == GN_FAR_ENDED ||
        (v->far_end == GN_FAR_INFINITE && d->slot->runs_round && gni_models_less(d->lights[d->light].method) &&
         gni_light_is_outside(&d->boxes[v->object], d->bounds.light)))
        return stream;
    *kind = GNI_STREAM_CAP; /* a fan at infinity would not do */
    return gni_make_stream(d, v->object, *kind);
}

/* What a stream has of a chunk. *at: where that starts; on return where it ends. */
static run find_run(const gni_stream *stream, int kind, uint32_t chunk, uint32_t *at)
{
    run u = {*at,
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
        const run u = find_run(stream, kind, c, &at);

        for (uint32_t i = 0; i < count; i++) {
            gn_record *r = &d->records[d->plan->record_count];
            int mcguire_case;
            const unsigned parts = gni_choose_parts(d, &v[i], &mcguire_case);

            start_record(r, d, &v[i], v[i].extent->scissor, c);
            r->mcguire_case = mcguire_case;
            r->is_cached = 1;
            use_run(r, &u, parts | GN_SIDES);
            keep_record(d, r);
        }
    }
    return 1;
}

void gni_note_layers(gni_draft *d, uint32_t object, uint32_t triangles, uint32_t silhouette)
{
    uint32_t cheap = triangles;

    if (silhouette != GNI_NONE && silhouette / 2 < triangles &&
        gni_light_is_outside(&d->boxes[object], d->bounds.light))
        cheap = silhouette / 2;
    d->cheap_layers += cheap;
    if (d->layers)
        d->cheap_of[object] += cheap;
}

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
    run u = find_run(stream, kind, 0, &at);

    for (uint32_t c = 1; c <= chunk; c++)
        u = find_run(stream, kind, c, &at);
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
    cap->fan = is_better_fan(mesh, outline->count / outline->of_a_side, d->casting.count);
    cap->dark_cap_count = cap->fan ? gni_put_fan(mesh, chunk, d->indices + outline->first, outline->count,
                                                 outline->of_a_side, &d->walk, at)
                                   : gni_put_dark_cap(mesh, chunk, &d->casting, at);
    d->plan->index_count = cap->first_index + cap->dark_cap_count;
}

void gni_add_flats(gni_draft *d, uint32_t object, const gni_extent *extent, uint32_t first_record)
{
    const gn_mesh *mesh = d->scene->objects[object].mesh;
    const int kind = kind_of_cap(d, mesh);
    const gni_stream *stream = d->slot ? gni_make_stream(d, object, kind) : NULL;
    uint32_t silhouette = 0;

    if (!stream)
        gni_know_casting(d, object);
    for (uint32_t c = 0; c < mesh->info.chunk_count; c++) {
        gn_record cap = {0};
        gni_outline outline = {0, 0, 6};

        if (stream)
            share_stream(stream, kind, c, &cap, &outline);
        else if (!share_record(d, first_record, c, &cap, &outline))
            make_cap(d, mesh, c, &cap, &outline);
        silhouette += outline.count / outline.of_a_side;
        for (uint32_t p = 0; p < d->patch_count && cap.dark_cap_count; p++)
            if (extent->on[p] == GNI_FANS_PATCH) {
                const gni_volume v = {object, NULL, extent, GN_FAR_ENDED, NULL, d->patches[p].plane, 0.0, 0};
                gn_record *r = &d->flats[d->flat_count];

                d->outlines[d->flat_count++] = outline;
                start_record(r, d, &v, extent->shadow[p], c);
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
