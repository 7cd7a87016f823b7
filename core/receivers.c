/* receivers.c - what a caster's volume touches of all that is there to be shadowed.
 *
 * A floor on which all stands shadows nothing: flat casters that the eye and the light see from the same side shadow
 * nothing on that side, nor themselves. Their volumes are left out where their border is out of view. On the border
 * itself rasterised depths of surface and side may disagree; there both ways of counting do alike, and the volume is
 * drawn. */
#include "gni_plan.h"

#include <math.h>

int gni_lit_side(const gni_draft *d, uint32_t object_index, double plane[4])
{
    const gn_camera *camera = &d->scene->camera;
    const gn_object *object = &d->scene->objects[object_index];
    const double *light = d->bounds.light;
    double of_light, of_eye;

    if (!gni_plane_in_view(object, camera, plane))
        return 0;
    of_light = gni_dot(plane, light) + plane[3] * light[3];
    of_eye = gni_eye_side(camera, plane);
    if (!gni_shows_side(object, d->objects[object_index].mirrored, of_eye))
        return 0;
    if (of_light < 0.0)
        for (int k = 0; k < 4; k++)
            plane[k] = -plane[k];
    return (of_light > 0.0 && of_eye > 0.0) || (of_light < 0.0 && of_eye < 0.0);
}

/* Whether the border of a flat caster, all of which casts, is out of view. */
static int border_is_unseen(const gni_draft *d, uint32_t object)
{
    const gn_mesh *mesh = d->scene->objects[object].mesh;
    double model_view[16];

    gni_model_view(model_view, &d->scene->camera, d->scene->objects[object].model, mesh->info.centre);
    for (uint32_t e = 0; e < mesh->info.edge_count; e++) {
        const uint32_t uses = mesh->edge_uses[e + 1] - mesh->edge_uses[e];
        const uint32_t *use = mesh->uses + mesh->edge_uses[e], corner = use[0] & GNI_USE_CORNER;
        gni_hull edge = {{{0}}, 2, {{0}}, 0, {{0}}};

        if (mesh->info.planar == 2 && uses == 2 && (use[0] ^ use[1]) & GNI_USE_DOWN)
            continue; /* inside: the two lie beside each other */
        for (uint32_t i = 0; i < 2; i++) {
            const uint32_t end = i == 0 ? corner : gni_next_corner(corner);

            gni_vertex(edge.points[i], mesh, mesh->triangles[end], model_view);
        }
        if (gni_may_be_seen(&d->seen, &edge))
            return 0;
    }
    return 1;
}

/* Whether the ball around a box lies outside the cone of rays through another, or beside its cylinder if the light is
 * directional, or before it: cheap, and mostly the answer. */
static int ball_misses(const double caster[4], const double light[4], const double other[4])
{
    double axis[3], to[3], along, square, sine, across;

    for (int k = 0; k < 3; k++) {
        axis[k] = caster[k] * light[3] - light[k];
        to[k] = other[k] - (light[3] == 0.0 ? caster[k] : light[k]);
    }
    square = gni_dot(axis, axis);
    along = gni_dot(axis, to) / sqrt(square);
    across = sqrt(fmax(gni_dot(to, to) - along * along, 0.0));
    if (light[3] == 0.0)
        return across > (caster[3] + other[3]) * (1.0 + GNI_MARGIN) ||
               along < -(caster[3] + other[3]) * (1.0 + GNI_MARGIN);
    sine = caster[3] / sqrt(square);
    if (!(sine < 0.95))
        return 0;
    /* from the other's middle to the cone, at right angles to its side */
    return across * sqrt(1.0 - sine * sine) - along * sine > other[3] * (1.0 + GNI_MARGIN);
}

static int is_touched(const gni_draft *d, uint32_t caster, const gni_hull *volume, uint32_t other)
{
    return !ball_misses(d->balls[caster], d->bounds.light, d->balls[other]) &&
           !gni_volume_misses(volume, d->bounds.light, &d->fronts[other].box) &&
           !gni_volume_misses(volume, d->bounds.light, &d->boxes[other]);
}

/* Whether the caster's volume need not cover the object: it is a patch, and the caster spares or fans it. */
static int is_patched(const gni_extent *e, const gni_draft *d, uint32_t object)
{
    const uint32_t patch = d->objects[object].patch;

    return patch && e->on[patch - 1] != GNI_FILLS_PATCH;
}

int gni_find_extent(gni_extent *e, const gni_draft *d, uint32_t object, gni_hull *volume, const double *plane)
{
    int is_flat;

    gni_start_extent(e, d, object);
    if (!d->receivers_are_known)
        return 1;
    is_flat = plane && border_is_unseen(d, object);
    if (!is_flat && d->is_in[object] & GNI_IN_LIT && d->scene->objects[object].flags & GN_RECEIVES &&
        !is_patched(e, d, object))
        gni_touch(e, d, object); /* itself */
    if (e->touched == 0 && gni_volume_misses(volume, d->bounds.light, &d->all_lit))
        return 0;
    for (uint32_t i = 0; i < d->scene->object_count; i++)
        if (i != object && d->is_in[i] & GNI_IN_LIT && d->scene->objects[i].flags & GN_RECEIVES &&
            !is_patched(e, d, i) && !(is_flat && gni_lies_before(&d->boxes[i], plane)) &&
            is_touched(d, object, volume, i))
            gni_touch(e, d, i);
    return e->touched > 0 && gni_end_extent(e, d, object, volume);
}
