/* patches.c - flat receivers, which need no volume.
 *
 * On a plane that the light and the eye see from the same side, a caster wholly between the two shadows exactly its
 * projection from the light (Blinn's projected shadows), and that is where its dark cap would lie if its volume ended
 * on this very plane: a signed fan over the silhouette, however tangled. Counted only where the plane is what is seen,
 * it needs no depth test, and the caster's volume need reach other receivers only. Where eye and light are on different
 * sides of the plane all that is seen of it is shadow.
 *
 * A patch is the planar objects of one plane, drawn whole. Its pixels are named once a frame in the bits above the
 * count, by drawing it again where its depth is the one that is seen: as the host's passes find their surfaces again.
 * One step of tolerance would name what stands on the plane, along the line where it does. */
#include "gni_plan.h"

#include <math.h>
#include <string.h>

#define FLAT  1e-6         /* of the greatest coordinate: so near to a plane is in it */
#define BELOW (1.0 / 64.0) /* of the light's height: a caster must stay below it by this */
#define LEAST (1.0 / 64.0) /* of the target's pixels, of a patch that is worth its bits */
#define PRICE 1.0          /* of naming a pixel, in pixels of volumes */
#define LEFT  255          /* in gn_plan_object.patch meanwhile: it was tried */

int gni_plane_in_view(const gn_object *object, const gn_camera *camera, double plane[4])
{
    const gn_mesh *mesh = object->mesh;
    double model_view[16], v[3][3], a[3], b[3], length;

    if (!mesh->info.planar)
        return 0;
    gni_model_view(model_view, camera, object->model, mesh->info.centre);
    for (int k = 0; k < 3; k++)
        gni_vertex(v[k], mesh, mesh->triangles[3 * (size_t)mesh->largest + (size_t)k], model_view);
    for (int k = 0; k < 3; k++) {
        a[k] = v[1][k] - v[0][k];
        b[k] = v[2][k] - v[0][k];
    }
    gni_cross(plane, a, b);
    length = sqrt(gni_dot(plane, plane));
    if (!(length > 0.0))
        return 0;
    for (int k = 0; k < 3; k++)
        plane[k] /= length;
    plane[3] = -gni_dot(plane, v[0]);
    return 1;
}

double gni_eye_side(const gn_camera *camera, const double plane[4])
{
    return camera->orthographic ? plane[2] : plane[3]; /* the eye is at 0 0 0, or infinitely far along z */
}

int gni_shows_side(const gn_object *object, int mirrored, double of_eye)
{
    return object->flags & GN_DRAWN &&
           (object->flags & GN_DRAWN_BACKS || (object->mesh->info.planar == 2 && (mirrored ? -of_eye : of_eye) > 0.0));
}

/* The plane of an object that may be a patch, positive where the eye is. */
static int is_flat(const gni_draft *d, uint32_t i, double plane[4])
{
    const gn_object *object = &d->scene->objects[i];
    double of_eye;

    if (!(object->flags & GN_RECEIVES) || !gni_may_be_seen(&d->seen, &d->boxes[i]) ||
        !gni_plane_in_view(object, &d->scene->camera, plane))
        return 0;
    of_eye = gni_eye_side(&d->scene->camera, plane);
    if (of_eye == 0.0 || !gni_shows_side(object, d->objects[i].mirrored, of_eye))
        return 0;
    for (int k = 0; k < 4 && of_eye < 0.0; k++)
        plane[k] = -plane[k];
    return 1;
}

static double scale_of(const gni_hull *box, const double plane[4])
{
    double scale = fabs(plane[3]);

    for (int i = 0; i < box->point_count; i++)
        for (int k = 0; k < 3; k++)
            scale = fmax(scale, fabs(box->points[i][k]));
    return scale;
}

/* The least and the greatest height of a box over a plane. */
static void heights(double range[2], const gni_hull *box, const double plane[4])
{
    range[0] = INFINITY;
    range[1] = -INFINITY;
    for (int i = 0; i < box->point_count; i++) {
        const double h = gni_dot(plane, box->points[i]) + plane[3];

        range[0] = fmin(range[0], h);
        range[1] = fmax(range[1], h);
    }
}

static int lies_in(const gni_hull *box, const double plane[4])
{
    const double near = FLAT * scale_of(box, plane);
    double range[2];

    heights(range, box, plane);
    return range[0] >= -near && range[1] <= near;
}

/* Where the caster's projection is seen on the plane; 0 where a corner of its box has none. */
static int find_shadow(uint32_t out[4], const gni_draft *d, const gni_hull *box, const double plane[4],
                       const double light[4])
{
    const double of_light = gni_dot(plane, light) + plane[3] * light[3];
    gni_hull shadow;
    double extrusion[16];

    gni_extrusion(extrusion, light, plane);
    memset(&shadow, 0, sizeof shadow);
    shadow.point_count = box->point_count;
    for (int i = 0; i < box->point_count; i++) {
        const double w = of_light - light[3] * (gni_dot(plane, box->points[i]) + plane[3]);

        if (!(w > 0.0))
            return 0;
        gn_mat4_transform(shadow.points[i], extrusion, box->points[i], 1.0);
        for (int k = 0; k < 3; k++)
            shadow.points[i][k] /= w;
    }
    gni_find_rectangle(out, &shadow, &d->scene->camera, &d->scene->target);
    return 1;
}

static double area_of(const uint32_t rectangle[4])
{
    return (double)rectangle[2] * rectangle[3];
}

/* About how many pixels a caster's volume covers less when it need not reach the patch: the box around caster and
 * shadow on the image, less the two themselves. */
static double saving_of(const gni_draft *d, uint32_t object, const gni_patch *patch, const double light[4])
{
    const double of_light = gni_dot(patch->plane, light) + patch->plane[3] * light[3];
    uint32_t both[4], shadow[4];
    double range[2];

    heights(range, &d->boxes[object], patch->plane);
    if (!(of_light > 0.0) || !(range[1] > 0.0) || !find_shadow(shadow, d, &d->boxes[object], patch->plane, light))
        return 0.0;
    gni_meet_rectangles(shadow, patch->rectangle);
    memcpy(both, d->rectangles[object], sizeof both);
    gni_join_rectangles(both, shadow);
    return fmax(area_of(both) - area_of(d->rectangles[object]) - area_of(shadow), 0.0);
}

/* Whether all volumes save more than naming the patch costs, which is once its pixels. */
static int is_worth_it(const gni_draft *d, const gni_patch *patch)
{
    const gn_scene *s = d->scene;
    double saved = 0.0;

    for (uint32_t l = 0; l < s->light_count; l++) {
        double light[4];

        gni_light_in_view(&d->scene->camera, &s->lights[l], light);
        for (uint32_t i = 0; i < s->object_count; i++) {
            if (s->objects[i].flags & GN_CASTS)
                saved += saving_of(d, i, patch, light);
            if (saved > PRICE * area_of(patch->rectangle))
                return 1;
        }
    }
    return 0;
}

void gni_find_patches(gni_draft *d)
{
    const gn_scene *s = d->scene;
    const double pixels = (double)s->target.width * s->target.height;

    d->patch_count = 0;
    for (uint32_t i = 0; i < s->object_count; i++) {
        d->objects[i].patch = 0;
        for (int p = 0; p < GN_MOST_PATCHES; p++)
            d->heights[i][p][0] = NAN;
    }
    if (!gni_models_less(d->choice.method) || s->without & GN_MEASURE_PATCHES || !d->choice.stencil.wrap || d->region)
        return;
    while (d->patch_count < GN_MOST_PATCHES) {
        gni_patch *patch = &d->patches[d->patch_count];
        double largest = LEAST * pixels, plane[4];
        uint32_t found = GNI_NONE;

        for (uint32_t i = 0; i < s->object_count; i++) {
            const double area = (double)d->rectangles[i][2] * d->rectangles[i][3];

            if (area > largest && !d->objects[i].patch && is_flat(d, i, plane)) {
                largest = area;
                found = i;
                memcpy(patch->plane, plane, sizeof plane);
            }
        }
        if (found == GNI_NONE)
            break;
        memcpy(patch->rectangle, d->rectangles[found], sizeof patch->rectangle);
        for (uint32_t i = 0; i < s->object_count; i++)
            if (!d->objects[i].patch && (i == found || (is_flat(d, i, plane) && lies_in(&d->boxes[i], patch->plane)))) {
                d->objects[i].patch = (uint8_t)(d->patch_count + 1);
                gni_join_rectangles(patch->rectangle, d->rectangles[i]);
            }
        if (is_worth_it(d, patch)) {
            d->patch_count++;
            continue;
        }
        for (uint32_t i = 0; i < s->object_count; i++)
            if (d->objects[i].patch == d->patch_count + 1)
                d->objects[i].patch = LEFT;
    }
    for (uint32_t i = 0; i < s->object_count; i++)
        if (d->objects[i].patch == LEFT)
            d->objects[i].patch = 0;
}

/* The heights of a caster's own vertices and of its hub, where its box is too large. */
static void find_exact_heights(double range[2], const gni_draft *d, uint32_t object_index, const double plane[4])
{
    const gn_object *object = &d->scene->objects[object_index];
    const gn_mesh *mesh = object->mesh;
    double model_view[16], row[4];

    gni_model_view(model_view, &d->scene->camera, object->model, mesh->info.centre);
    for (int i = 0; i < 4; i++)
        row[i] = gni_dot(plane, model_view + 4 * i) + (i == 3 ? plane[3] : 0.0);
    range[0] = range[1] = row[0] * (double)mesh->info.hub[0] + row[1] * (double)mesh->info.hub[1] +
                          row[2] * (double)mesh->info.hub[2] + row[3];
    for (uint32_t v = 0; v < mesh->info.vertex_count; v++) {
        const float *p = mesh->positions + 3 * (size_t)v;
        const double h = row[0] * (double)p[0] + row[1] * (double)p[1] + row[2] * (double)p[2] + row[3];

        range[0] = h < range[0] ? h : range[0];
        range[1] = h > range[1] ? h : range[1];
    }
}

/* What a caster is to the plane at that range of heights. */
static gni_on_patch judge(const double range[2], double of_light, int is_sun, double near)
{
    if (range[1] <= near)
        return GNI_SPARES_PATCH;
    if (!is_sun && range[0] >= of_light * (1.0 + GNI_MARGIN))
        return GNI_SPARES_PATCH;
    return range[0] >= -near && (is_sun || range[1] <= of_light * (1.0 - BELOW)) ? GNI_FANS_PATCH : GNI_FILLS_PATCH;
}

void gni_light_patches(gni_draft *d)
{
    const double *light = d->bounds.light;

    for (uint32_t p = 0; p < d->patch_count; p++) {
        gni_patch *patch = &d->patches[p];
        const double least = light[3] == 0.0 ? 1e-3 * sqrt(gni_dot(light, light))
                                             : GNI_MARGIN * (fabs(patch->plane[3]) + sqrt(gni_dot(light, light)));

        patch->of_light = gni_dot(patch->plane, light) + patch->plane[3] * light[3];
        patch->use = patch->of_light > least    ? GNI_PATCH_LIT
                     : patch->of_light < -least ? GNI_PATCH_DARK
                                                : GNI_PATCH_NONE;
    }
}

gni_on_patch gni_cast_on_patch(const gni_draft *d, uint32_t object, const gni_patch *patch, uint32_t rectangle[4])
{
    const gni_hull *box = &d->boxes[object];
    const double near = FLAT * scale_of(box, patch->plane);
    const int is_sun = d->bounds.light[3] == 0.0;
    double range[2];
    uint32_t image[4];
    gni_on_patch is;

    if (patch->use == GNI_PATCH_DARK)
        return GNI_SPARES_PATCH;
    if (patch->use != GNI_PATCH_LIT)
        return GNI_FILLS_PATCH;
    heights(range, box, patch->plane);
    is = judge(range, patch->of_light, is_sun, near);
    if (is == GNI_FILLS_PATCH && range[0] < patch->of_light * (1.0 - BELOW)) {
        double *exact = d->heights[object][patch - d->patches];

        if (isnan(exact[0]))
            find_exact_heights(exact, d, object, patch->plane);
        is = judge(exact, patch->of_light, is_sun, near);
    }
    if (is != GNI_FANS_PATCH)
        return is;
    if (!find_shadow(image, d, box, patch->plane, d->bounds.light)) /* the corner is no vertex */
        memcpy(image, patch->rectangle, sizeof image);
    gni_choose_scissor(rectangle, d, image, patch->rectangle);
    return rectangle[2] > 0 && rectangle[3] > 0 ? GNI_FANS_PATCH : GNI_SPARES_PATCH;
}
