/* plan_volumes.c - the records of one caster in one light: which parts of its volume are drawn, where it ends, and its
 * index stream.
 *
 * z-pass alone, and so McGuire's case 1, leaves the light cap out where the caster itself is seen in its place: every
 * triangle of it drawn to depth, whichever side the eye sees (DESIGN.md, decision 4). Hosts that cull draw none of the
 * slivers that turn over when their vertices are rounded, and such a hole would be counted. */
#include "gni_plan.h"

#include <math.h>
#include <string.h>

/* z-pass: a line of sight may pass through the end of a volume, into it or out of it (DESIGN.md, decision 6): where the
 * near rectangle, or something that is seen, is not wholly before it. */
static int is_end_crossed(const gni_draft *d, const gni_volume *v)
{
    gni_view view;

    if (v->far_end != GN_FAR_ENDED)
        return 0;
    if (d->region || !d->receivers_are_known)
        return 1;
    if (v->extent->end_image[2] == 0 || v->extent->end_image[3] == 0)
        return 0;
    gni_make_view(&view, &d->scene->camera, &d->scene->target, v->extent->end_image);
    if (!gni_is_before(&view.near_rectangle, v->end_plane))
        return 1;
    for (uint32_t i = 0; i < d->scene->object_count; i++)
        if (d->is_in[i] & GNI_IN_LIT && d->scene->objects[i].flags & GN_RECEIVES &&
            !(v->unpatched && d->objects[i].patch) && gni_do_rectangles_meet(d->rectangles[i], v->extent->end_image) && !gni_is_object_before(d, i, v->end_plane))
            return 1;
    return 0;
}

/* Which parts of a volume its way of counting takes. */
static unsigned choose_parts(const gni_draft *d, const gni_volume *v, int *mcguire_case)
{
    const int is_stencil = d->lights[d->light].method == GN_METHOD_STENCIL;
    gni_case c = *v->at_hand;
    unsigned parts = 0;

    if (is_stencil && v->far_end == GN_FAR_CLAMPED && c.number == 1)
        c.number = c.seen & GNI_SEES_CASTER ? 3 : 2; /* what lies before the near plane would be drawn, and counted */
    if (c.seen & GNI_SEES_VOLUME)
        parts |= GN_SIDES;
    if (c.seen & (v->far_end == GN_FAR_ENDED && d->region ? GNI_SEES_VOLUME : GNI_SEES_FAR) &&
        (c.number != 1 || is_end_crossed(d, v)))
        parts |= GN_DARK_CAP;
    if (c.seen & GNI_SEES_CASTER && (c.number != 1 || !c.is_drawn))
        parts |= GN_LIGHT_CAP;
    *mcguire_case = c.number;
    return parts;
}

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

/* Homogeneous matrices mean the same at any scale, and a power of two keeps every bit: far vertices get the magnitude
 * of near ones. A light far away stays within float, and clipping a side between the two rounds alike in every unit of
 * length. */
static void scale_like(double m[16], const double near_matrix[16])
{
    const int shift = greatest_exponent(near_matrix) - greatest_exponent(m);

    for (int i = 0; i < 16; i++)
        m[i] = ldexp(m[i], shift);
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
    gn_mat4_multiply(far_matrix, d->projection, extrusion);
    gn_mat4_multiply(far_matrix, far_matrix, model_view);
    gn_mat4_multiply(near_matrix, d->projection, model_view);
    scale_like(far_matrix, near_matrix);
    gn_mat4_to_float(r->far_matrix, far_matrix);
    r->light = d->light;
    r->object = v->object;
    r->chunk = chunk;
    r->mirrored = d->objects[v->object].mirrored;
    r->far_end = v->far_end;
    r->end_reach = v->end_reach;
    r->unpatched = v->unpatched;
    r->first_index = d->plan->index_count;
    memcpy(r->scissor, scissor, sizeof r->scissor);
}

/* Whether the dark cap of a volume that ends on a plane is better a fan. In several chunks it must be so in all, or in
 * none: closed meshes have the fewer edges. */
static int is_better_fan(const gn_mesh *mesh, uint32_t edges, uint32_t triangles)
{
    return mesh->info.chunk_count > 1 ? mesh->info.solid_part_count == mesh->info.part_count : edges < triangles;
}

static int is_fan(const gni_draft *d, const gni_volume *v, const gn_record *r, uint32_t triangles,
                  const uint16_t *sides, uint32_t of_a_side)
{
    const gn_object *object = &d->scene->objects[v->object];
    const gn_mesh *mesh = object->mesh;
    const double *light = d->bounds.light;
    double model_view[16];

    if (d->lights[d->light].method != GN_METHOD_STENCIL || v->end_reach > 0.0 || v->far_end == GN_FAR_CLAMPED ||
        !is_better_fan(mesh, r->side_count / of_a_side, triangles))
        return 0;
    if (v->far_end == GN_FAR_ENDED)
        return !d->region;
    if (light[3] == 0.0 || mesh->info.chunk_count > 1 || !gni_light_is_outside(&d->boxes[v->object], light))
        return 0;
    gni_model_view(model_view, &d->scene->camera, object->model, mesh->info.centre);
    return gni_runs_round_hub(mesh, r->chunk, sides, r->side_count, of_a_side, model_view, light);
}

uint32_t gni_add_records(gni_draft *d, const gni_volume *v, const gni_casting *casting)
{
    const gn_mesh *mesh = d->scene->objects[v->object].mesh;
    gn_plan_caster *caster = &d->casters[(size_t)d->light * d->scene->object_count + v->object];
    const int converges = v->far_end != GN_FAR_ENDED && d->bounds.light[3] == 0.0;
    const uint32_t of_a_side = converges ? 3 : 6;
    int mcguire_case;
    const unsigned parts = choose_parts(d, v, &mcguire_case);
    uint32_t silhouette = parts & GN_SIDES ? 0 : GNI_NONE;
    double eye[4], limit = 0.0;
    const int slivers = mcguire_case == 1 && parts & GN_LIGHT_CAP && d->lights[d->light].method == GN_METHOD_STENCIL &&
                        gni_find_slivers(d, v->object, eye, &limit);

    for (uint32_t c = 0; c < mesh->info.chunk_count; c++) {
        gn_record *r = &d->records[d->plan->record_count];
        uint16_t *const out = d->indices + d->plan->index_count, *at = out;

        start_record(r, d, v, v->extent->scissor, c);
        r->mcguire_case = mcguire_case;
        if (parts & GN_SIDES)
            at += r->side_count = gni_put_sides(mesh, c, casting, converges, at);
        if (parts & GN_DARK_CAP && !converges) {
            r->fan = is_fan(d, v, r, casting->count, out, of_a_side);
            r->dark_cap_count = r->fan ? gni_put_fan(mesh, c, out, r->side_count, of_a_side, at)
                                       : gni_put_dark_cap(mesh, c, casting, at);
            at += r->dark_cap_count;
        }
        if (parts & GN_LIGHT_CAP && slivers) {
            at += r->light_cap_count = gni_put_slivers(mesh, c, casting, eye, limit, at);
            r->slivers = 1;
        } else if (parts & GN_LIGHT_CAP) {
            at += r->light_cap_count = gni_put_light_cap(mesh, c, casting, 1, at);
            at += r->turned_cap_count = gni_put_light_cap(mesh, c, casting, -1, at);
        }
        if (silhouette != GNI_NONE)
            silhouette += r->side_count / of_a_side;
        if (at == out)
            continue;
        r->parts = (r->side_count ? GN_SIDES : 0u) | (r->dark_cap_count ? GN_DARK_CAP : 0u) |
                   (r->light_cap_count + r->turned_cap_count ? GN_LIGHT_CAP : 0u);
        d->plan->index_count += (uint32_t)(at - out);
        d->plan->record_count++;
        caster->mcguire_case = (uint8_t)mcguire_case;
        caster->parts |= (uint8_t)r->parts;
        caster->fan |= (uint8_t)r->fan;
        caster->is_ended |= r->far_end == GN_FAR_ENDED && !d->region;
    }
    return silhouette;
}

/* A bound on the layers of a caster that costs no more than to look: half the silhouette, seen from outside. */
static void note_layers(gni_draft *d, uint32_t object, uint32_t triangles, uint32_t silhouette)
{
    uint32_t cheap = triangles;

    if (silhouette != GNI_NONE && silhouette / 2 < triangles && gni_light_is_outside(&d->boxes[object], d->bounds.light))
        cheap = silhouette / 2;
    d->cheap_layers += cheap;
    if (d->layers)
        d->cheap_of[object] += cheap;
}

/* The fan of a chunk among its volume's records; 0 where it has none. */
static int find_fan(const gni_draft *d, uint32_t first_record, uint32_t chunk, gn_record *fan)
{
    for (uint32_t i = first_record; i < d->plan->record_count; i++)
        if (d->records[i].chunk == chunk && d->records[i].fan) {
            fan->first_index = d->records[i].first_index + d->records[i].side_count;
            fan->dark_cap_count = d->records[i].dark_cap_count;
            fan->fan = 1;
            return 1;
        }
    return 0;
}

void gni_add_flats(gni_draft *d, uint32_t object, const gni_extent *extent, uint32_t first_record)
{
    const gn_mesh *mesh = d->scene->objects[object].mesh;
    const uint32_t triangles = d->casting.count;
    uint32_t silhouette = 0;

    for (uint32_t c = 0; c < mesh->info.chunk_count && triangles; c++) {
        uint16_t *const out = d->indices + d->plan->index_count;
        gn_record shared = {0};

        if (!find_fan(d, first_record, c, &shared)) {
            const uint32_t sides = gni_put_sides(mesh, c, &d->casting, 1, out);

            shared.first_index = d->plan->index_count;
            shared.fan = is_better_fan(mesh, sides / 3, triangles);
            shared.dark_cap_count =
                shared.fan ? gni_put_fan(mesh, c, out, sides, 3, out) : gni_put_dark_cap(mesh, c, &d->casting, out);
            d->plan->index_count += shared.dark_cap_count;
        }
        silhouette += shared.dark_cap_count / 3;
        for (uint32_t p = 0; p < d->patch_count && shared.dark_cap_count; p++)
            if (extent->on[p] == GNI_FANS_PATCH) {
                const gni_volume v = {object, NULL, extent, GN_FAR_ENDED, d->patches[p].plane, 0.0, 0};
                gn_record *r = &d->flats[d->flat_count++];

                start_record(r, d, &v, extent->shadow[p], c);
                r->first_index = shared.first_index;
                r->dark_cap_count = shared.dark_cap_count;
                r->parts = GN_DARK_CAP;
                r->patch = p + 1;
                r->fan = shared.fan;
            }
    }
    note_layers(d, object, triangles, silhouette);
}

static void add_volume(gni_draft *d, const gni_volume *v, const gni_casting *casting)
{
    d->casting_count += casting->count;
    if (d->is_batched)
        gni_add_batched(d, v, casting);
    else
        note_layers(d, v->object, casting->count, gni_add_records(d, v, casting));
}

static void add_endless(gni_draft *d, uint32_t object, const gni_case *at_hand, const gni_extent *extent, gn_far far_end,
                        int unpatched)
{
    static const double infinity[4] = {0, 0, 0, 1};
    const gni_volume v = {object, at_hand, extent, far_end, infinity, 0.0, unpatched};

    add_volume(d, &v, &d->casting);
}

/* Whether a plane of the camera cuts the object's box. Its surfaces are clipped there; drawn under depth clamp they
 * would not be, and their depths would be others by more than a step: its light cap would shadow it. */
static int is_cut(const gni_draft *d, uint32_t object_index)
{
    const gn_camera *camera = &d->scene->camera;
    double nearest = INFINITY, farthest = -INFINITY;

    for (int corner = 0; corner < 8; corner++) {
        nearest = fmin(nearest, -d->boxes[object_index].points[corner][2]);
        farthest = fmax(farthest, -d->boxes[object_index].points[corner][2]);
    }
    return (nearest <= camera->znear * (1.0 + 1e-6) && farthest >= camera->znear * (1.0 - 1e-6)) ||
           (camera->finite_far && nearest <= camera->zfar * (1.0 + 1e-6) && farthest >= camera->zfar * (1.0 - 1e-6));
}

/* Nothing ends the volume: an orthographic camera's is left out with a warning, since a light among casters must not
 * stop the frame; elsewhere depth clamp does where it can, or the frame is refused. */
static gn_result clamp_or_refuse(gni_draft *d, uint32_t object, const gni_case *at_hand, const gni_extent *extent)
{
    const gn_camera *camera = &d->scene->camera;
    const gn_target *target = &d->scene->target;
    const int clamps = gn_target_can(target, GN_CAN_DEPTH_CLAMP);

    if (camera->orthographic) {
        d->plan->endless_casters++;
        d->plan->warnings |= 1u << GN_WARN_ENDLESS;
        d->casters[(size_t)d->light * d->scene->object_count + object].skip = GN_SKIP_ENDLESS;
        return GN_OK;
    }
    if (clamps && !is_cut(d, object)) {
        add_endless(d, object, at_hand, extent, GN_FAR_CLAMPED, 0);
        return GN_OK;
    }
    if (camera->finite_far)
        return gn_fail(
            d->context, GN_E_DEVICE,
            "object %lu, light %lu: no end of the volume lies before the far plane at %g, and depth-clamp %s",
            (unsigned long)object, (unsigned long)d->light, camera->zfar,
            clamps ? "is no help where a plane of the camera cuts the object"
                   : gni_why_not(target, GN_CAN_DEPTH_CLAMP));
    return gn_fail(
        d->context, GN_E_DEVICE,
        "object %lu, light %lu: the light touches the object, its volume has no end; w0 %s, and depth-clamp %s",
        (unsigned long)object, (unsigned long)d->light, gni_why_not(target, GN_CAN_W0),
        clamps ? "is no help where a plane of the camera cuts the object" : gni_why_not(target, GN_CAN_DEPTH_CLAMP));
}

/* A caster's volumes, one for each end. */
static gn_result add_ended(gni_draft *d, uint32_t object_index, const gni_case *at_hand, const gni_extent *extent)
{
    const gn_object *object = &d->scene->objects[object_index];
    const gn_mesh *mesh = object->mesh;
    double model_view[16];

    gni_model_view(model_view, &d->scene->camera, object->model, mesh->info.centre);
    if (!gni_choose_ends(d->ends, d->region, mesh, model_view, d->bounds.light, d->casting.of, d->end_of))
        return clamp_or_refuse(d, object_index, at_hand, extent);
    for (uint32_t p = 0; p < d->ends->count; p++) {
        const gni_volume v = {object_index, at_hand, extent, GN_FAR_ENDED, d->ends->planes[p], d->ends->reach, 0};
        int any = 0;

        for (uint32_t t = 0; t < mesh->info.triangle_count; t++) {
            d->group.of[t] = d->casting.of[t] && d->end_of[t] == p ? d->casting.of[t] : 0;
            any |= d->group.of[t];
        }
        if (!any)
            continue;
        gni_find_bits(mesh, &d->group);
        add_volume(d, &v, &d->group);
    }
    return GN_OK;
}

gn_result gni_add_caster(gni_draft *d, uint32_t object, const gni_case *at_hand, const gni_extent *extent)
{
    int unpatched = d->uses_patches;

    for (uint32_t p = 0; p < d->patch_count; p++)
        unpatched &= extent->on[p] != GNI_FILLS_PATCH;
    if (d->region)
        return add_ended(d, object, at_hand, extent);
    if (extent->is_ended) {
        const gni_volume v = {object, at_hand, extent, GN_FAR_ENDED, extent->end_plane, 0.0, unpatched};

        add_volume(d, &v, &d->casting);
    } else {
        add_endless(d, object, at_hand, extent, GN_FAR_INFINITE, unpatched);
    }
    return GN_OK;
}
