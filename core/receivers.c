/* receivers.c - whether a caster's volume touches anything that is there to be shadowed.
 *
 * A floor on which all stands shadows nothing: flat casters that the eye and the light see from the same side shadow
 * nothing on that side, nor themselves. Their volumes are left out where their border is out of view. On the border
 * itself rasterised depths of surface and side may disagree; there both ways of counting do alike, and the volume is
 * drawn. */
#include "gni_plan.h"

#include <math.h>

/* The plane of a planar mesh in view space; 0 when it has none. */
static int plane_in_view(const gn_object *object, const gn_camera *camera, double plane[4])
{
    const gn_mesh *mesh = object->mesh;
    double model_view[16], v[3][3], a[3], b[3];
    uint32_t t = 0;

    if (!mesh->info.planar)
        return 0;
    for (uint32_t i = 0; i < mesh->info.triangle_count; i++) /* the largest: a sliver's plane is all rounding */
        if (gni_dot(mesh->planes + 4 * (size_t)i, mesh->planes + 4 * (size_t)i) >
            gni_dot(mesh->planes + 4 * (size_t)t, mesh->planes + 4 * (size_t)t))
            t = i;
    gni_model_view(model_view, camera, object->model, mesh->info.centre);
    for (int k = 0; k < 3; k++)
        gni_vertex(v[k], mesh, mesh->triangles[3 * (size_t)t + (size_t)k], model_view);
    for (int k = 0; k < 3; k++) {
        a[k] = v[1][k] - v[0][k];
        b[k] = v[2][k] - v[0][k];
    }
    gni_cross(plane, a, b);
    plane[3] = -gni_dot(plane, v[0]);
    return gni_dot(plane, plane) > 0.0;
}

int gni_lit_side(const gni_draft *d, uint32_t object_index, double plane[4])
{
    const gn_camera *camera = &d->scene->camera;
    const gn_object *object = &d->scene->objects[object_index];
    const double *light = d->bounds.light;
    const double front = d->objects[object_index].mirrored ? -1.0 : 1.0;
    double of_light, of_eye;

    if (!(object->flags & GN_DRAWN) || !plane_in_view(object, camera, plane))
        return 0;
    of_light = gni_dot(plane, light) + plane[3] * light[3];
    of_eye = camera->orthographic ? plane[2] : plane[3]; /* the eye is at 0 0 0, or infinitely far along z */
    if (!(object->flags & GN_DRAWN_BACKS) && !(object->mesh->info.planar == 2 && front * of_eye > 0.0))
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

static int lies_before(const gni_hull *box, const double plane[4])
{
    double least = INFINITY, scale = fabs(plane[3]);

    for (int i = 0; i < 8; i++) {
        least = fmin(least, gni_dot(plane, box->points[i]) + plane[3]);
        for (int k = 0; k < 3; k++)
            scale = fmax(scale, fabs(plane[k] * box->points[i][k]));
    }
    return least >= -GNI_MARGIN * scale;
}

int gni_shadows_anything(const gni_draft *d, uint32_t object, const gni_hull *volume, const double *plane)
{
    const double *light = d->bounds.light;
    int is_flat;

    if (!d->receivers_are_known)
        return 1;
    is_flat = plane && border_is_unseen(d, object);
    if (!is_flat && d->is_in[object] & GNI_IN_LIT && d->scene->objects[object].flags & GN_RECEIVES)
        return 1; /* itself */
    if (gni_volume_misses(volume, light, &d->all_lit))
        return 0;
    for (uint32_t i = 0; i < d->scene->object_count; i++)
        if (i != object && d->is_in[i] & GNI_IN_LIT && d->scene->objects[i].flags & GN_RECEIVES &&
            !(is_flat && lies_before(&d->boxes[i], plane)) && !gni_volume_misses(volume, light, &d->boxes[i]))
            return 1;
    return 0;
}
