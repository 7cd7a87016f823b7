/* thin.c - what a small mask may miss: things, and shadows, that are seen less than a few of its pixels wide.
 *
 * Whatever is wider than a mask's pixel covers the middle of some wherever it goes, and masks around its borders are not
 * unanimous: refining finds it. What is thinner may pass between. A mesh is as thin as the thinnest of its parts
 * (parts.c); and any is thin that is seen edge-on: as wide as its box is across. */
#include "gni_plan.h"

#include <math.h>

#define LEAST 3.0 /* pixels of a mask */

/* The least width of eight points of a box on a plane: across one of its edges, as of any hull of them. */
static double width_of(double points[8][2])
{
    double least = INFINITY;

    for (int edge = 0; edge < 3; edge++) {
        const double *first = points[0], *last = points[1 << edge];
        const double across[2] = {first[1] - last[1], last[0] - first[0]}, length = hypot(across[0], across[1]);
        double low = INFINITY, high = -INFINITY;

        if (length == 0.0)
            continue;
        for (int i = 0; i < 8; i++) {
            const double at = (across[0] * points[i][0] + across[1] * points[i][1]) / length;

            low = fmin(low, at);
            high = fmax(high, at);
        }
        least = fmin(least, high - low);
    }
    return least < INFINITY ? least : 0.0;
}

static double pixels_of_one(const gni_draft *d, double distance)
{
    const gn_camera *c = &d->scene->camera;
    const double across = d->whole[2] / (c->right - c->left), up = d->whole[3] / (c->top - c->bottom);

    return fmin(across, up) / (c->orthographic ? 1.0 : distance);
}

/* The least that a matrix does to a length, or less: its volume over the most that it does to areas. */
static double least_stretch(const double model[16])
{
    const double most = gni_stretch(model);

    return most > 0.0 ? fabs(gn_mat4_determinant3(model)) / (most * most) : 0.0;
}

static double thickness_of(const gni_draft *d, uint32_t object)
{
    const gn_object *o = &d->scene->objects[object];

    return o->mesh->thickness * least_stretch(o->model);
}

static double limit(const gni_draft *d)
{
    return LEAST * d->plan->scale;
}

int gni_is_thin_image(const gni_draft *d, uint32_t object)
{
    const gn_camera *c = &d->scene->camera;
    const gni_hull *box = &d->boxes[object];
    double points[8][2], farthest = 0.0;

    for (int i = 0; i < 8; i++) {
        const double *p = box->points[i], distance = -p[2];

        if (!c->orthographic && !(distance >= c->znear))
            return 0; /* as large as the frame */
        farthest = fmax(farthest, distance);
        points[i][0] = p[0] * d->whole[2] / (c->right - c->left) / (c->orthographic ? 1.0 : distance);
        points[i][1] = p[1] * d->whole[3] / (c->top - c->bottom) / (c->orthographic ? 1.0 : distance);
    }
    return fmin(thickness_of(d, object) * pixels_of_one(d, farthest), width_of(points)) < limit(d);
}

/* How wide the light sees it, at the distance of its middle. */
static double width_for_light(const gni_draft *d, uint32_t object, const double axis[3], double distance)
{
    const double *light = d->bounds.light;
    const double other[3] = {fabs(axis[0]) < 0.5, fabs(axis[0]) >= 0.5, 0.0};
    double u[3], v[3], points[8][2];

    gni_cross(u, axis, other);
    gni_cross(v, axis, u);
    for (int i = 0; i < 8; i++) {
        const double *p = d->boxes[object].points[i];
        const double from[3] = {p[0] - light[0], p[1] - light[1], p[2] - light[2]};
        const double *q = light[3] == 0.0 ? p : from, along = light[3] == 0.0 ? 1.0 : gni_dot(from, axis) / distance;

        if (!(along > 0.0))
            return INFINITY; /* all around the light */
        points[i][0] = gni_dot(q, u) / sqrt(gni_dot(u, u)) / along;
        points[i][1] = gni_dot(q, v) / sqrt(gni_dot(v, v)) / along;
    }
    return width_of(points);
}

int gni_is_thin_shadow(const gni_draft *d, uint32_t object, const gni_extent *extent)
{
    const double *light = d->bounds.light, *ball = d->balls[object], *normal = extent->end_plane;
    double axis[3], length, distance, width, grown, end;

    for (int k = 0; k < 3; k++)
        axis[k] = light[3] == 0.0 ? -light[k] : ball[k] - light[k];
    length = sqrt(gni_dot(axis, axis));
    if (length == 0.0)
        return 0;
    distance = light[3] == 0.0 ? 1.0 : length;
    for (int k = 0; k < 3; k++)
        axis[k] /= length;
    width = fmin(width_for_light(d, object, axis, distance), thickness_of(d, object));
    if (width * pixels_of_one(d, fmax(-ball[2], d->scene->camera.znear)) < limit(d))
        return 1;
    if (!extent->is_ended)
        return 0;
    /* where the ray through its middle meets the end: so many times as wide, and so far from the eye */
    grown = (gni_dot(normal, ball) + normal[3]) / -gni_dot(normal, axis);
    end = -(ball[2] + grown * axis[2]);
    grown = light[3] == 0.0 ? 1.0 : (distance + grown) / distance;
    return grown >= 1.0 && end > d->scene->camera.znear && width * grown * pixels_of_one(d, end) < limit(d);
}
