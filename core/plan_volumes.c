/* plan_volumes.c - the records of one caster in one light: which parts of its volume are drawn, where it ends, and its
 * index stream.
 *
 * z-pass alone, and so McGuire's case 1, leaves the light cap out where the caster itself is seen in its place: every
 * triangle of it drawn to depth, whichever side the eye sees (DESIGN.md, decision 4). Hosts that cull draw none of the
 * slivers that turn over when their vertices are rounded, and such a hole would be counted. */
#include "gni_plan.h"

#include <math.h>
#include <string.h>

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
    /* z-pass: the eye may look into a volume from behind its end (DESIGN.md, decision 6) */
    if (v->far_end == GN_FAR_ENDED ? c.seen & GNI_SEES_VOLUME : c.number != 1 && c.seen & GNI_SEES_FAR)
        parts |= GN_DARK_CAP;
    if (c.seen & GNI_SEES_CASTER && (c.number != 1 || !c.is_drawn))
        parts |= GN_LIGHT_CAP;
    *mcguire_case = c.number;
    return parts;
}

/* Planes go the other way: a plane p of view space is p m in object space, row times matrix. */
static void plane_before(double out[4], const double plane[4], const double m[16])
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

uint32_t gni_add_records(gni_draft *d, const gni_volume *v, const int8_t *casting)
{
    const gn_object *object = &d->scene->objects[v->object];
    const gn_mesh *mesh = object->mesh;
    const double *light = d->bounds.light;
    gn_plan_caster *caster = &d->casters[(size_t)d->light * d->scene->object_count + v->object];
    int mcguire_case;
    unsigned parts = choose_parts(d, v, &mcguire_case);
    double model_view[16], near_matrix[16], extrusion[16], far_matrix[16], plane_world[4] = {0, 0, 0, 0};
    uint32_t apex = GNI_NONE, silhouette = parts & GN_SIDES ? 0 : GNI_NONE;

    gni_model_view(model_view, &d->scene->camera, object->model, mesh->info.centre);
    if (v->end_reach > 0.0) {
        gni_extrusion_by(extrusion, light, v->end_reach);
    } else {
        gni_extrusion(extrusion, light, v->end_plane);
        plane_before(plane_world, v->end_plane, d->view);
    }
    gn_mat4_multiply(far_matrix, d->projection, extrusion);
    gn_mat4_multiply(far_matrix, far_matrix, model_view);
    gn_mat4_multiply(near_matrix, d->projection, model_view);
    scale_like(far_matrix, near_matrix);
    if (v->far_end != GN_FAR_ENDED && light[3] == 0.0)
        parts |= GNI_CONVERGING;
    else if (v->far_end == GN_FAR_INFINITE && parts & GN_DARK_CAP && d->lights[d->light].method == GN_METHOD_STENCIL &&
             gni_light_is_outside(&d->boxes[v->object], light))
        apex = gni_find_apex(mesh, casting, model_view, light, &d->boxes[v->object]);
    if (apex != GNI_NONE)
        parts |= GNI_FAN;
    for (uint32_t c = 0; c < mesh->info.chunk_count; c++) {
        gn_record *r = &d->records[d->plan->record_count];
        gni_stream stream;
        const uint32_t count =
            gni_volume_indices(mesh, c, casting, parts, apex, d->indices + d->plan->index_count, &stream);

        if (silhouette != GNI_NONE)
            silhouette += stream.sides / (parts & GNI_CONVERGING ? 3 : 6);
        if (count == 0)
            continue;
        memset(r, 0, sizeof *r);
        r->light = d->light;
        r->object = v->object;
        r->chunk = c;
        r->parts = (stream.sides ? GN_SIDES : 0u) | (stream.dark_cap ? GN_DARK_CAP : 0u) |
                   (stream.light_cap + stream.turned_cap ? GN_LIGHT_CAP : 0u);
        r->first_index = d->plan->index_count;
        r->side_count = stream.sides;
        r->dark_cap_count = stream.dark_cap;
        r->light_cap_count = stream.light_cap;
        r->turned_cap_count = stream.turned_cap;
        r->fan = apex != GNI_NONE;
        r->mcguire_case = mcguire_case;
        r->mirrored = d->objects[v->object].mirrored;
        r->far_end = v->far_end;
        memcpy(r->end_plane, plane_world, sizeof r->end_plane);
        r->end_reach = v->end_reach;
        gn_mat4_to_float(r->far_matrix, far_matrix);
        d->plan->index_count += count;
        d->plan->record_count++;
        caster->mcguire_case = (uint8_t)mcguire_case;
        caster->parts |= (uint8_t)r->parts;
        caster->fan |= (uint8_t)r->fan;
    }
    return silhouette;
}

/* A bound on the layers of a caster that costs no more than to look: half the silhouette, seen from outside. */
static void note_layers(gni_draft *d, const gni_volume *v, const int8_t *casting, uint32_t silhouette)
{
    const gn_mesh *mesh = d->scene->objects[v->object].mesh;
    uint32_t count = 0, cheap;

    for (uint32_t t = 0; t < mesh->info.triangle_count; t++)
        count += casting[t] != 0;
    cheap = count;
    if (silhouette != GNI_NONE && silhouette / 2 < count && gni_light_is_outside(&d->boxes[v->object], d->bounds.light))
        cheap = silhouette / 2;
    d->casting_count += count;
    d->cheap_layers += cheap;
    if (d->layers)
        d->cheap_of[v->object] += cheap;
}

static void add_volume(gni_draft *d, const gni_volume *v, const int8_t *casting)
{
    if (d->is_batched) {
        gni_add_batched(d, v, casting);
    } else {
        note_layers(d, v, casting, gni_add_records(d, v, casting));
    }
}

static void add_endless(gni_draft *d, uint32_t object, const gni_case *at_hand, gn_far far_end)
{
    static const double infinity[4] = {0, 0, 0, 1};
    const gni_volume v = {object, at_hand, far_end, infinity, 0.0};

    add_volume(d, &v, d->casting);
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
static gn_result clamp_or_refuse(gni_draft *d, uint32_t object, const gni_case *at_hand)
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
        add_endless(d, object, at_hand, GN_FAR_CLAMPED);
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
static gn_result add_ended(gni_draft *d, uint32_t object_index, const gni_case *at_hand)
{
    const gn_object *object = &d->scene->objects[object_index];
    const gn_mesh *mesh = object->mesh;
    double model_view[16];

    gni_model_view(model_view, &d->scene->camera, object->model, mesh->info.centre);
    if (!gni_choose_ends(d->ends, d->region, mesh, model_view, d->bounds.light, d->casting, d->end_of))
        return clamp_or_refuse(d, object_index, at_hand);
    for (uint32_t p = 0; p < d->ends->count; p++) {
        const gni_volume v = {object_index, at_hand, GN_FAR_ENDED, d->ends->planes[p], d->ends->reach};
        int any = 0;

        for (uint32_t t = 0; t < mesh->info.triangle_count; t++) {
            d->group[t] = d->casting[t] && d->end_of[t] == p ? d->casting[t] : 0;
            any |= d->group[t];
        }
        if (any)
            add_volume(d, &v, d->group);
    }
    return GN_OK;
}

gn_result gni_add_caster(gni_draft *d, uint32_t object, const gni_case *at_hand)
{
    if (d->region)
        return add_ended(d, object, at_hand);
    add_endless(d, object, at_hand, GN_FAR_INFINITE);
    return GN_OK;
}
