/* plan_volumes.c - the volumes of one caster in one light: where they end, and which parts of them are drawn.
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
    if (gni_has_region(d) || !d->receivers_are_known)
        return 1;
    if (v->extent->end_image[2] == 0 || v->extent->end_image[3] == 0)
        return 0;
    gni_make_view(&view, &d->scene->camera, &d->scene->target, v->extent->end_image);
    if (!gni_is_before(&view.near_rectangle, v->end_plane))
        return 1;
    for (uint32_t i = 0; i < d->scene->object_count; i++)
        if (d->is_in[i] & GNI_IN_LIT && d->scene->objects[i].flags & GN_RECEIVES &&
            !(v->unpatched && d->objects[i].patch) && gni_do_rectangles_meet(d->rectangles[i], v->extent->end_image) &&
            !gni_is_object_before(d, i, v->end_plane))
            return 1;
    return 0;
}

unsigned gni_choose_parts(const gni_draft *d, const gni_volume *v, int *mcguire_case)
{
    const int is_stencil = gni_models_less(d->lights[d->light].method);
    gni_case c = *v->at_hand;
    unsigned parts = 0;

    if (GNI_HAS_CULLING && v->start_plane) {
        *mcguire_case = c.number;
        return GN_SIDES | GN_DARK_CAP;
    }
    if (GNI_HAS_CULLING && is_stencil && v->far_end == GN_FAR_CLAMPED && c.number == 1)
        c.number = c.seen & GNI_SEES_CASTER ? 3 : 2; /* what lies before the near plane would be drawn, and counted */
    if (c.seen & GNI_SEES_VOLUME)
        parts |= GN_SIDES;
    if (c.seen & (v->far_end == GN_FAR_ENDED && gni_has_region(d) ? GNI_SEES_VOLUME : GNI_SEES_FAR) &&
        (c.number != 1 || (GNI_HAS_CULLING && is_end_crossed(d, v))))
        parts |= GN_DARK_CAP;
    if (c.seen & GNI_SEES_CASTER && (c.number != 1 || !c.is_drawn))
        parts |= GN_LIGHT_CAP;
    *mcguire_case = c.number;
    return parts;
}

void gni_know_casting(gni_draft *d, uint32_t object)
{
    if (!d->casting_is_known)
        gni_find_object_casting(&d->scene->objects[object], &d->scene->lights[d->light], &d->casting);
    d->casting_is_known = 1;
}

static void add_volumes(gni_draft *d, const gni_volume *v, uint32_t count, const gni_casting *casting)
{
    if (gni_is_colored(d)) {
        if (casting == &d->casting)
            gni_know_casting(d, v->object);
        d->casting_count += casting->count;
        gni_add_colored(d, v, casting);
        return;
    }
    if (gni_has_slot(d) && gni_add_kept_records(d, v, count)) {
        d->casting_count += d->slot->triangles;
        gni_note_layers(d, v->object, d->slot->triangles, d->slot->silhouette);
        return;
    }
    if (casting == &d->casting)
        gni_know_casting(d, v->object);
    d->casting_count += casting->count;
    if (gni_is_batched(d))
        gni_add_batched(d, v, casting);
    else
        gni_note_layers(d, v->object, casting->count, gni_add_records(d, v, count, casting));
}

static void add_endless(gni_draft *d, uint32_t object, const gni_case *at_hand, const gni_extent *extent,
                        gn_far far_end, int unpatched)
{
    static const double infinity[4] = {0, 0, 0, 1};
    const gni_volume v = {object, at_hand, extent, far_end, NULL, infinity, 0.0, unpatched};

    add_volumes(d, &v, 1, &d->casting);
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

    gni_know_casting(d, object_index);
    gni_model_view(model_view, &d->scene->camera, object->model, mesh->info.centre);
    if (!gni_choose_ends(d->ends, d->region, mesh, model_view, d->bounds.light, d->casting.of, d->end_of))
        return clamp_or_refuse(d, object_index, at_hand, extent);
    for (uint32_t p = 0; p < d->ends->count; p++) {
        const gni_volume v = {object_index, at_hand, extent, GN_FAR_ENDED, NULL, d->ends->planes[p], d->ends->reach, 0};
        int any = 0;

        for (uint32_t t = 0; t < mesh->info.triangle_count; t++) {
            d->group.of[t] = d->casting.of[t] && d->end_of[t] == p ? d->casting.of[t] : 0;
            any |= d->group.of[t];
        }
        if (!any)
            continue;
        gni_find_bits(mesh, &d->group);
        add_volumes(d, &v, 1, &d->group);
    }
    return GN_OK;
}

/* Counts that stop at the ends, batches and open meshes, whose caps are none over silhouettes, take a volume in one
 * piece. */
static void add_intervals(gni_draft *d, uint32_t object, const gni_case *at_hand, const gni_extent *extent,
                          int unpatched)
{
    gni_extent intervals[GNI_MOST_INTERVALS];
    gni_volume volumes[GNI_MOST_INTERVALS];
    gni_case of_interval = *at_hand; /* the case was asked of the whole, whose end may be out of view */
    const gn_mesh_info *info = &d->scene->objects[object].mesh->info;
    uint32_t count = 1;

    intervals[0] = *extent;
    if (d->receivers_are_known && info->solid_part_count == info->part_count && d->lights[d->light].stencil.wrap &&
        !gni_is_batched(d) && !(d->scene->without & GN_MEASURE_INTERVALS))
        count = gni_cut_extent(intervals, extent, d, object);
    if (count > 0 && memcmp(intervals[0].end_plane, extent->end_plane, sizeof extent->end_plane) != 0)
        of_interval.seen |= GNI_SEES_FAR;
    for (uint32_t i = 0; i < count; i++) {
        const gni_extent *e = &intervals[i];
        const gni_volume v = {
            object,       &of_interval, e,        GN_FAR_ENDED, e->is_detached ? e->start_plane : NULL,
            e->end_plane, 0.0,          unpatched};

        volumes[i] = v;
    }
    if (count)
        add_volumes(d, volumes, count, &d->casting);
}

gn_result gni_add_caster(gni_draft *d, uint32_t object, const gni_case *at_hand, const gni_extent *extent)
{
    int unpatched = gni_uses_patches(d);

    for (uint32_t p = 0; GNI_HAS_CULLING && p < d->patch_count; p++)
        unpatched &= extent->on[p] != GNI_FILLS_PATCH;
    if (gni_has_region(d))
        return add_ended(d, object, at_hand, extent);
    if (GNI_HAS_CULLING && extent->is_ended)
        add_intervals(d, object, at_hand, extent, unpatched);
    else
        add_endless(d, object, at_hand, extent, GN_FAR_INFINITE, unpatched);
    return GN_OK;
}
