/* bounds.c - what a light can reach: its distance, its box and its cone, and where they are seen.
 *
 * A light's reach is the distance from which on the largest of its channels adds less than half a step of the target's
 * bits (McGuire 2003, section 4): such a sum rounds to what was there. The host adds one light in each of its passes,
 * so that no two such rests add up before they are rounded. Reach, box and cone are each projected to the image,
 * clipped to the near plane, and what they have in common is the scissor (section 6, lines 5 and 6; Lengyel 2002).
 *
 * A body with corners projects to the box around its corners and around the points where its edges, and all lines
 * between its corners, meet the near plane. A sphere's outermost points along an axis are those where a line from the
 * eye touches its outline, a circle in the plane of that axis and the view's; or, where the near plane cuts them off,
 * those on the near plane. */
#include "gni.h"

#include <math.h>
#include <string.h>

#define SIDES 8    /* of the pyramid around a cone */
#define LOOSE 1e-6 /* of the reach: rounding stays inside */

/* The distance at which an attenuation has come down to 1 / factor; INFINITY when it never does. */
static double distance_of(const double k[3], double factor)
{
    const double rest = factor - k[0];

    if (k[1] == 0.0 && k[2] == 0.0)
        return k[0] == 0.0 ? (factor > 1.0 ? INFINITY : 0.0) : rest > 0.0 ? INFINITY : 0.0;
    return rest > 0.0 ? 2.0 * rest / (k[1] + sqrt(k[1] * k[1] + 4.0 * k[2] * rest)) : 0.0;
}

static double find_reach(const gn_light *light, const gn_target *target)
{
    const int bits[3] = {target->red_bits, target->green_bits, target->blue_bits};
    double reach = 0.0;

    if (light->kind == GN_LIGHT_DIRECTIONAL)
        return INFINITY;
    for (int c = 0; c < 3; c++) { /* a target of unknown bits has as good as none that round */
        const double half = bits[c] > 0 && bits[c] <= 16 ? 0.5 / (ldexp(1.0, bits[c]) - 1.0) : 0.0;

        if (light->color[c] > 0.0)
            reach = fmax(reach, half > 0.0 ? distance_of(light->attenuation, light->color[c] / half) : INFINITY);
    }
    if (light->color[0] == 0.0 && light->color[1] == 0.0 && light->color[2] == 0.0)
        reach = INFINITY; /* not known */
    return (light->range > 0.0 ? fmin(reach, light->range) : reach) * (1.0 + LOOSE);
}

/* A rectangle of the image, at distance 1 from the eye, and the view distances of what is seen in it. */
typedef struct patch {
    double low[2], high[2], nearest, farthest;
} patch;

static const patch nothing = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}, INFINITY, -INFINITY};
static const patch everything = {{-INFINITY, -INFINITY}, {INFINITY, INFINITY}, -INFINITY, INFINITY};

static void hold(patch *p, const double at[2], double distance)
{
    for (int i = 0; i < 2; i++) {
        p->low[i] = fmin(p->low[i], at[i]);
        p->high[i] = fmax(p->high[i], at[i]);
    }
    p->nearest = fmin(p->nearest, distance);
    p->farthest = fmax(p->farthest, distance);
}

static void meet(patch *p, const patch *other)
{
    for (int i = 0; i < 2; i++) {
        p->low[i] = fmax(p->low[i], other->low[i]);
        p->high[i] = fmin(p->high[i], other->high[i]);
    }
    p->nearest = fmax(p->nearest, other->nearest);
    p->farthest = fmin(p->farthest, other->farthest);
}

/* x, y, view distance and w of a corner (w = 1) or a direction (w = 0), seen by a perspective camera. */
static void hold_corner(patch *p, const double c[4])
{
    const double at[2] = {c[0] / c[2], c[1] / c[2]};

    if (c[2] > 0.0 && isfinite(at[0]) && isfinite(at[1]))
        hold(p, at, c[3] > 0.0 ? c[2] / c[3] : INFINITY);
    else
        *p = everything;
}

/* The body's part before the near plane. */
static patch project_hull(const gni_hull *h, const gn_camera *camera)
{
    const int count = h->point_count + h->direction_count;
    double corners[GNI_HULL_POINTS + 8][4], above[GNI_HULL_POINTS + 8];
    patch p = nothing;

    for (int i = 0; i < count; i++) {
        const double *from = i < h->point_count ? h->points[i] : h->directions[i - h->point_count];

        corners[i][0] = from[0];
        corners[i][1] = from[1];
        corners[i][2] = -from[2];
        corners[i][3] = i < h->point_count;
        above[i] = corners[i][2] - camera->znear * corners[i][3];
    }
    if (camera->orthographic) {
        for (int i = 0; i < count && h->direction_count == 0; i++)
            hold(&p, corners[i], corners[i][2]);
        return h->direction_count ? everything : p.farthest < camera->znear ? nothing : p;
    }
    for (int i = 0; i < count; i++) {
        if (above[i] >= 0.0)
            hold_corner(&p, corners[i]);
        for (int j = 0; j < i; j++)
            if ((above[i] < 0.0) != (above[j] < 0.0)) {
                double c[4];

                for (int k = 0; k < 4; k++)
                    c[k] = (corners[i][k] * above[j] - corners[j][k] * above[i]) / (above[j] - above[i]);
                hold_corner(&p, c);
            }
    }
    return p;
}

static patch project_sphere(const double centre[3], double radius, const gn_camera *camera)
{
    const double n = camera->znear, d = -centre[2];
    patch p = nothing;

    if (!(radius < INFINITY))
        return everything;
    if (d + radius < n)
        return nothing;
    for (int axis = 0; axis < 2; axis++) {
        const double c = centre[axis], square = c * c + d * d - radius * radius;
        const double chord = radius * radius - (d - n) * (d - n);

        if (camera->orthographic) {
            p.low[axis] = c - radius;
            p.high[axis] = c + radius;
            continue;
        }
        for (int side = -1; side <= 1; side += 2) {
            if (square > 0.0) { /* where a line from the eye touches the circle */
                const double s = side * radius / sqrt(square);
                const double touch[2] = {c + s * d, d - s * c}; /* a multiple of the touching point */
                const double distance = touch[1] * square / (c * c + d * d);

                if (distance >= n) {
                    p.low[axis] = fmin(p.low[axis], touch[0] / touch[1]);
                    p.high[axis] = fmax(p.high[axis], touch[0] / touch[1]);
                }
            }
            if (chord >= 0.0) {
                const double at = (c + side * sqrt(chord)) / n;

                p.low[axis] = fmin(p.low[axis], at);
                p.high[axis] = fmax(p.high[axis], at);
            }
        }
    }
    p.nearest = d - radius;
    p.farthest = d + radius;
    return p;
}

static int box_of(gni_hull *out, const gn_light *light, const double view[16])
{
    int is_given = 0;

    memset(out, 0, sizeof *out);
    out->point_count = 8;
    for (int i = 0; i < 3; i++)
        is_given |= light->box_min[i] != 0.0 || light->box_max[i] != 0.0;
    for (int c = 0; c < 8 && is_given; c++) {
        double p[3];

        for (int axis = 0; axis < 3; axis++)
            p[axis] = c >> axis & 1 ? light->box_max[axis] : light->box_min[axis];
        gn_mat4_transform(out->points[c], view, p, 1.0);
    }
    return is_given;
}

/* From the world, where the box is along the axes: n of the plane is column `axis` of the view's rotation. */
static void add_box(gni_bounds *b, const gn_light *light, const gni_hull *box, const double view[16])
{
    for (int axis = 0; axis < 3; axis++)
        for (int side = 0; side < 2; side++) {
            double *plane = b->planes[b->plane_count++];

            for (int k = 0; k < 3; k++)
                plane[k] = (side ? -1.0 : 1.0) * view[4 * axis + k];
            plane[3] = -gni_dot(plane, box->points[side ? 7 : 0]);
        }
    if (light->kind == GN_LIGHT_DIRECTIONAL)
        return;
    for (int axis = 0; axis < 3; axis++) /* a light inside lights along lines that stay inside */
        if (light->position[axis] < light->box_min[axis] || light->position[axis] > light->box_max[axis])
            return;
    b->caster_planes = b->plane_count;
}

/* The pyramid around the cone; its tip is the light. */
static void cone_hull(gni_hull *out, const gn_light *light, const double at[4], double reach, const double view[16])
{
    const double wide = tan(light->cone) / cos(3.14159265358979323846 / SIDES) * (1.0 + LOOSE);
    double axis[3], axes[3][3];

    gni_towards(axis, light);
    gn_mat4_transform(axis, view, axis, 0.0);
    for (int i = 0; i < 3; i++)
        axis[i] = -axis[i];
    gni_make_axes(axes, axis);
    memset(out, 0, sizeof *out);
    memcpy(out->points[0], at, sizeof out->points[0]);
    out->point_count = reach < INFINITY ? 1 + SIDES : 1;
    out->direction_count = reach < INFINITY ? 0 : SIDES;
    for (int i = 0; i < SIDES; i++) {
        const double turn = 6.283185307179586 * i / SIDES;

        for (int k = 0; k < 3; k++) {
            const double d = axes[2][k] + wide * (cos(turn) * axes[0][k] + sin(turn) * axes[1][k]);

            if (reach < INFINITY)
                out->points[1 + i][k] = at[k] + reach * d;
            else
                out->directions[i][k] = d;
        }
    }
}

/* The sides of the pyramid. What blocks light on its way to something inside is inside itself. */
static void add_cone(gni_bounds *b, const gni_hull *cone)
{
    for (int i = 0; i < SIDES; i++) {
        double spokes[3][3], *plane = b->planes[b->plane_count++];

        for (int s = 0; s < 3; s++) { /* two beside each other, and one opposite */
            const int j = (i + (s < 2 ? s : SIDES / 2)) % SIDES;

            for (int k = 0; k < 3; k++)
                spokes[s][k] =
                    cone->direction_count ? cone->directions[j][k] : cone->points[1 + j][k] - cone->points[0][k];
        }
        gni_cross(plane, spokes[0], spokes[1]);
        if (gni_dot(plane, spokes[2]) < 0.0)
            gni_cross(plane, spokes[1], spokes[0]);
        plane[3] = -gni_dot(plane, cone->points[0]);
    }
    b->caster_planes = b->plane_count;
}

/* Pixels whose centres may lie in the patch, and one more on each side. 0 when there is none. */
static int find_pixels(uint32_t out[4], const patch *p, const gn_camera *camera, const gn_target *target)
{
    const double low[2] = {camera->left, camera->bottom}, high[2] = {camera->right, camera->top};
    const uint32_t size[2] = {target->width, target->height};
    int any = 1;

    for (int i = 0; i < 2; i++) {
        const double scale = size[i] / (high[i] - low[i]);
        const double first = floor((p->low[i] - low[i]) * scale) - 1.0, end = ceil((p->high[i] - low[i]) * scale) + 1.0;
        const double from = fmin(fmax(first, 0.0), size[i]), to = fmin(fmax(end, 0.0), size[i]);

        out[i] = (uint32_t)from;
        out[2 + i] = (uint32_t)fmax(to - from, 0.0);
        any &= p->low[i] <= p->high[i] && to > from;
    }
    return any;
}

void gni_find_rectangle(uint32_t out[4], const gni_hull *hull, const gn_camera *camera, const gn_target *target)
{
    const patch p = project_hull(hull, camera);

    if (!find_pixels(out, &p, camera, target))
        memset(out, 0, 4 * sizeof *out);
}

void gni_find_balls_rectangle(uint32_t out[4], const double a[4], const double b[4], const gn_camera *camera,
                              const gn_target *target)
{
    const patch q = project_sphere(b, b[3], camera);
    patch p = project_sphere(a, a[3], camera);

    for (int i = 0; i < 2; i++) {
        p.low[i] = fmin(p.low[i], q.low[i]);
        p.high[i] = fmax(p.high[i], q.high[i]);
    }
    if (!find_pixels(out, &p, camera, target))
        memset(out, 0, 4 * sizeof *out);
}

static void find_scissor(gni_bounds *b, const patch *p, const gn_camera *camera, const gn_target *target)
{
    if (!find_pixels(b->scissor, p, camera, target))
        b->skip = GN_SKIP_OUT_OF_VIEW;
    b->distances[0] = fmax(p->nearest, camera->znear);
    b->distances[1] = p->farthest;
    if (!(b->distances[0] <= b->distances[1]) || (camera->zfar != 0.0 && b->distances[0] > camera->zfar))
        b->skip = GN_SKIP_OUT_OF_VIEW;
}

void gni_find_bounds(gni_bounds *out, const gn_scene *scene, uint32_t light_index, const double light[4],
                     const double view[16])
{
    const gn_light *l = &scene->lights[light_index];
    const gn_camera *camera = &scene->camera;
    patch seen = everything, part;
    gni_hull hull;

    gni_no_bounds(out, scene, light);
    out->reach = find_reach(l, &scene->target);
    if (out->reach == 0.0) {
        out->skip = GN_SKIP_FAINT;
        return;
    }
    if (out->reach < INFINITY) {
        part = project_sphere(light, out->reach, camera);
        meet(&seen, &part);
    }
    if (l->kind == GN_LIGHT_SPOT && l->cone > 0.0) {
        cone_hull(&hull, l, light, out->reach, view);
        add_cone(out, &hull);
        part = project_hull(&hull, camera);
        meet(&seen, &part);
    }
    if (box_of(&hull, l, view)) {
        add_box(out, l, &hull, view);
        part = project_hull(&hull, camera);
        meet(&seen, &part);
    }
    find_scissor(out, &seen, camera, &scene->target);
}

/* How far the light lies outside a box along an axis of unit length. */
static double gap_along(const double axis[3], const double light[4], const gni_hull *box)
{
    const double of_light = gni_dot(axis, light);
    double low = INFINITY, high = -INFINITY;

    for (int i = 0; i < box->point_count; i++) {
        low = fmin(low, gni_dot(axis, box->points[i]));
        high = fmax(high, gni_dot(axis, box->points[i]));
    }
    return fmax(fmax(low - of_light, of_light - high), 0.0);
}

/* From the light to a box, no farther than it is: to the box around it along view space's axes, or to the plane of a
 * face. */
static double distance_to(const double light[4], const gni_hull *box)
{
    double square = 0.0, farthest;

    for (int k = 0; k < 3; k++) {
        const double axis[3] = {k == 0, k == 1, k == 2}, gap = gap_along(axis, light, box);

        square += gap * gap;
    }
    farthest = sqrt(square);
    for (int k = 0; k < 3; k++) {
        double axis[3], length;

        gni_cross(axis, box->edges[k], box->edges[(k + 1) % 3]);
        length = sqrt(gni_dot(axis, axis));
        for (int i = 0; i < 3 && length > 0.0; i++)
            axis[i] /= length;
        if (length > 0.0)
            farthest = fmax(farthest, gap_along(axis, light, box) * (1.0 - GNI_MARGIN));
    }
    return farthest;
}

static int is_inside(const gni_bounds *b, const gni_hull *box, uint32_t plane_count)
{
    if (b->light[3] != 0.0 && distance_to(b->light, box) > b->reach)
        return 0;
    for (uint32_t p = 0; p < plane_count; p++)
        if (gni_is_outside(box, b->planes[p]))
            return 0;
    return 1;
}

int gni_may_be_lit(const gni_bounds *bounds, const gni_hull *box)
{
    return is_inside(bounds, box, bounds->plane_count);
}

int gni_may_cast(const gni_bounds *bounds, const gni_hull *box)
{
    return is_inside(bounds, box, bounds->caster_planes);
}

double gni_most_light(const gni_bounds *bounds, const gn_light *light, const gni_hull *box)
{
    const double color = fmax(light->color[0], fmax(light->color[1], light->color[2])), *k = light->attenuation;
    const double d = bounds->light[3] != 0.0 ? distance_to(bounds->light, box) : 0.0;
    const double attenuation = k[0] == 0.0 && k[1] == 0.0 && k[2] == 0.0 ? 1.0 : k[0] + (k[1] + k[2] * d) * d;

    return color == 0.0 ? INFINITY : color / attenuation;
}
