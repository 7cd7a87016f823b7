/* thin.c - what a small mask may miss: things, and shadows, that are seen less than a few of its pixels wide.
 *
 * Whatever is wider than a mask's pixel covers the middle of some wherever it goes, and masks around its borders are not
 * unanimous: refining finds it. What is thinner may pass between. A mesh is as thin as the thinnest of its parts
 * (parts.c); and any is thin that is seen edge-on: as wide as its box is across. */
#include "gni_plan.h"

#include <math.h>

#define LEAST 3.0 /* pixels of a mask */

/* The least width of the image of a box, of which points[i] and points[i | 1 << k] are an edge's ends: the least of a convex
 * outline is across one of its edges, and they are images of the box's. */
static double width_of(double points[8][2])
{
    double least = INFINITY;

    for (int edge = 0; edge < 24; edge++) {
        const int from = edge & 7, to = from | 1 << (edge >> 3);
        const double across[2] = {points[from][1] - points[to][1], points[to][0] - points[from][0]};
        const double length = hypot(across[0], across[1]);
        double low = INFINITY, high = -INFINITY;

        if (length == 0.0) /* of no length, or no edge: both ends are the same */
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

/* Pixels that a length has at a distance from the eye. */
static double in_pixels(const gni_draft *d, double length, double distance)
{
    const gn_camera *c = &d->scene->camera;
    const double across = d->whole[2] / (c->right - c->left), up = d->whole[3] / (c->top - c->bottom);

    return length * fmin(across, up) / (c->orthographic ? 1.0 : fmax(distance, c->znear));
}

static int is_thin(const gni_draft *d, double length, double distance)
{
    return in_pixels(d, length, distance) < LEAST * d->plan->scale;
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

static double farthest_of(const gni_draft *d, uint32_t object)
{
    double farthest = 0.0;

    for (int i = 0; i < 8; i++)
        farthest = fmax(farthest, -d->boxes[object].points[i][2]);
    return farthest;
}

int gni_is_thin_image(const gni_draft *d, uint32_t object)
{
    const gn_camera *c = &d->scene->camera;
    const gni_hull *box = &d->boxes[object];
    double points[8][2];

    if (is_thin(d, thickness_of(d, object), farthest_of(d, object)))
        return 1;
    for (int i = 0; i < 8; i++) {
        const double *p = box->points[i], distance = c->orthographic ? 1.0 : -p[2];

        if (!c->orthographic && !(distance >= c->znear))
            return 0; /* it is across the frame */
        points[i][0] = p[0] * d->whole[2] / (c->right - c->left) / distance;
        points[i][1] = p[1] * d->whole[3] / (c->top - c->bottom) / distance;
    }
    return width_of(points) < LEAST * d->plan->scale;
}

/* How wide the light sees its box, at the distance of its middle. */
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

/* Shadows are as wide as the caster where they start, and wider the farther from a point light; seen from the eye they are
 * thinnest there or where they end. */
int gni_is_thin_shadow(const gni_draft *d, uint32_t object, const gni_extent *extent)
{
    const double *light = d->bounds.light, *ball = d->balls[object], *normal = extent->end_plane;
    double axis[3], length, distance, width = thickness_of(d, object), behind, end;

    for (int k = 0; k < 3; k++)
        axis[k] = light[3] == 0.0 ? -light[k] : ball[k] - light[k];
    length = sqrt(gni_dot(axis, axis));
    distance = light[3] == 0.0 ? 1.0 : length;
    for (int k = 0; k < 3 && length > 0.0; k++)
        axis[k] /= length;
    if (length > 0.0)
        width = fmin(width, width_for_light(d, object, axis, distance));
    if (is_thin(d, width, farthest_of(d, object)))
        return 1;
    if (!extent->is_ended || length == 0.0) /* as far as what it may fall on, and no wider for all that is known */
        return is_thin(d, width, extent->touched ? extent->deepest : d->plan->deepest_receiver);
    /* where the ray through its middle meets the end */
    behind = (gni_dot(normal, ball) + normal[3]) / -gni_dot(normal, axis);
    end = -(ball[2] + behind * axis[2]);
    return behind > 0.0 && is_thin(d, width * (light[3] == 0.0 ? 1.0 : (distance + behind) / distance), end);
}
