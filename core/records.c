/* records.c - records of a volume: where its indices are, chunk by chunk, and where its far vertices go.
 *
 * Indices are made for this frame, of the parts that its way of counting takes. (kept_records.c: of those in the
 * cache.) */
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

void gni_start_record(gn_record *r, const gni_draft *d, const gni_volume *v, const uint32_t scissor[4], uint32_t chunk)
{
    const gn_object *object = &d->scene->objects[v->object];
    double model_view[16], near_matrix[16], extrusion[16], far_matrix[16];

    memset(r, 0, sizeof *r);
    gni_model_view(model_view, &d->scene->camera, object->model, object->mesh->info.centre);
    if (GNI_HAS_CULLING && v->end_reach > 0.0) {
        gni_extrusion_by(extrusion, d->bounds.light, v->end_reach);
    } else {
        gni_extrusion(extrusion, d->bounds.light, v->end_plane);
        if (GNI_HAS_CULLING)
            gni_plane_before(r->end_plane, v->end_plane, d->view);
        else
            memcpy(r->end_plane, v->end_plane, sizeof r->end_plane); /* at infinity */
    }
    gn_mat4_multiply(near_matrix, d->projection, model_view);
    multiply_like(far_matrix, d->projection, extrusion, model_view, near_matrix);
    gn_mat4_to_float(r->far_matrix, far_matrix);
    memcpy(r->near_matrix, d->objects[v->object].matrix, sizeof r->near_matrix);
    if (GNI_HAS_CULLING && v->start_plane) {
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
    r->unpatched = v->unpatched || gni_is_refined(d); /* what has no name */
    r->thin = gni_is_refined(d) && gni_is_thin_shadow(d, v->object, v->extent);
    memcpy(r->scissor, scissor, sizeof r->scissor);
}

/* Whether the dark cap of a volume that ends on a plane is better a fan. In several chunks it must be so in all, or in
 * none: closed meshes have the fewer edges. */
int gni_is_better_fan(const gn_mesh *mesh, uint32_t edges, uint32_t triangles)
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

    if (!GNI_HAS_CULLING)
        return 0;
    if (v[count - 1].start_plane)
        return 1;
    if (!gni_models_less(d->lights[d->light].method) || v->end_reach > 0.0 || v->far_end == GN_FAR_CLAMPED ||
        !gni_is_better_fan(mesh, side_count / of_a_side, triangles))
        return 0;
    if (v->far_end == GN_FAR_ENDED)
        return !gni_has_region(d);
    if (light[3] == 0.0 || mesh->info.chunk_count > 1 || !gni_light_is_outside(&d->scene->lights[d->light], object))
        return 0;
    gni_model_view(model_view, &d->scene->camera, object->model, mesh->info.centre);
    return gni_runs_round_hub(mesh, chunk, sides, side_count, of_a_side, model_view, light);
}

static gn_plan_caster *caster_of(gni_draft *d, uint32_t object)
{
    return &d->casters[(size_t)d->light * d->scene->object_count + object];
}

void gni_keep_record(gni_draft *d, gn_record *r)
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
    caster->is_ended |= r->far_end == GN_FAR_ENDED && !gni_has_region(d);
}

void gni_use_run(gn_record *r, const gni_run *u, unsigned parts)
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
    const int is_cut = GNI_HAS_CULLING && v[count - 1].start_plane != NULL;
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
        gni_run u = {d->plan->index_count, 0, 0, 0, 0, 0, 0, 0};

        if (all & GN_LIGHT_CAP && slivers)
            at += u.light_cap = gni_put_slivers(mesh, c, casting, eye, heights, at);
        else if (all & GN_LIGHT_CAP)
            at += u.light_cap = gni_put_light_cap(mesh, c, casting, 1, at);
        sides = at;
        if (all & GN_SIDES)
            at += u.sides = gni_put_sides(mesh, c, casting, converges, at);
        if (all & GN_DARK_CAP && !converges) {
            u.fan = is_fan(d, v, count, c, casting->count, sides, u.sides, of_a_side);
            u.dark_cap = GNI_HAS_CULLING && u.fan ? gni_put_fan(mesh, c, sides, u.sides, of_a_side, &d->walk, at)
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

            gni_start_record(r, d, &v[i], v[i].extent->scissor, c);
            r->mcguire_case = mcguire_case;
            r->slivers = slivers && parts[i] & GN_LIGHT_CAP;
            gni_use_run(r, &u, parts[i]);
            gni_keep_record(d, r);
        }
        if (silhouette != GNI_NONE)
            silhouette += u.sides / of_a_side;
    }
    return silhouette;
}

void gni_note_layers(gni_draft *d, uint32_t object, uint32_t triangles, uint32_t silhouette)
{
    uint32_t cheap = triangles;

    if (silhouette != GNI_NONE && silhouette / 2 < triangles &&
        gni_light_is_outside(&d->scene->lights[d->light], &d->scene->objects[object]))
        cheap = silhouette / 2;
    d->cheap_layers += cheap;
    if (gni_has_layers(d))
        d->cheap_of[object] += cheap;
}
