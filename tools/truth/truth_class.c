/* truth_class.c - how far a pixel of the mask may be trusted.
 *
 * BOUNDARY  Do its nine samples disagree? If not, does the shadow edge of something thinner cross the pixel's footprint
 *           (truth_edges.h)? Where the pixel is lit, any edge does. Where it is in shadow, an edge counts only if
 *           points close beside it are lit.
 * SNAPPED   Rasterisers round vertices to 1/256 pixel. Is anything else seen, and is its state another, at eight points
 *           1/256 pixel from the centre? Snapping moves x and y but not depth, so a surface seen at a slope also comes
 *           nearer or recedes by what its depth changes in 1/256 pixel: does that flip it? Does an outline, or a
 *           silhouette edge of the light, come within 1/256 pixel of the centre in plain sight? A triangle that
 *           snapping brings there has the depths of its plane beyond its edge. Or is the surface so nearly edge-on to
 *           the light that a float cannot tell which of its sides is lit?
 * DEPTH     Does it flip when the point is moved along the view ray by 1 or 2 steps of the depth buffer, or is there
 *           another surface of another state within 2 steps, or znear or zfar itself?
 *
 * They are asked in this order, and the first that holds is the class.
 *
 * A point moved behind its own surface is in that surface's shadow, but that is no flip: a method draws the surface and
 * its cap at the very same depth. So the visible triangle never blocks, nor do triangles in whose planes the visible
 * point lies, nor, when vertices are snapped, those that continue the visible one close by around an edge. */
#include "truth_pass.h"

#include <string.h>

#include "truth_vec.h"

#define FLOAT_EDGE_ON 1e-6 /* cosine to the light below which floats may take the wrong side */
#define LAYERS        16   /* surfaces within two depth steps of one another: more are not looked at */
#define PROBE_ASIDE   1e-3 /* of the footprint's size: how far beside an edge to look for light */

/* ------------------------------------------------------------------ footprints */

typedef struct prober {
    truth_pass *p;
    const truth_point *centre;
    const truth_footprint *f;
} prober;

/* A lit footprint: whatever crosses it is a shadow edge. */
static int any_edge(void *user, const double a[3], const double b[3])
{
    (void)user;
    (void)a;
    (void)b;
    return 1;
}

/* Whether a point of the footprint's plane is lit. The plane reaches beyond the triangle: where something quite
 * different is seen in the point's direction, that is asked instead, so that no light shines in from behind a wall. */
static int is_lit_at(const prober *is, const double at[3])
{
    const truth *t = is->p->t;
    const double depth = truth_dot(at, t->axes[2]);
    truth_point seen = *is->centre;
    truth_ray ray;

    if (truth_in_shadow(is->p, at, is->centre->triangle, NULL))
        return 0;
    for (int k = 0; k < 3; k++) {
        seen.from[k] = t->scene->camera.orthographic ? at[k] - depth * t->axes[2][k] : 0.0;
        seen.along[k] = t->scene->camera.orthographic ? t->axes[2][k] : at[k] / depth;
    }
    truth_ray_set(&ray, seen.from, seen.along);
    seen.triangle =
        truth_rays_seen(&t->rays, &ray, t->nearest, t->farthest, TRUTH_NOTHING, is->centre->triangle, &seen.depth);
    if (seen.triangle == TRUTH_NOTHING || fabs(seen.depth - depth) < 0.1 * is->f->size)
        return 1;
    truth_along(seen.at, seen.from, seen.depth, seen.along);
    return truth_is_lit(is->p, &seen);
}

/* A footprint in shadow: is the receiver lit beside the shadow of this part of an edge? Looks at five places, and where
 * it comes closest to the centre. */
static int lit_beside(void *user, const double a[3], const double b[3])
{
    static const double places[] = {0.02, 0.25, 0.5, 0.75, 0.98};
    const prober *is = user;
    double shadow[2][3], along[3], aside[3], to_centre[3], length;

    truth_project(shadow[0], &is->p->lamp, is->f, a);
    truth_project(shadow[1], &is->p->lamp, is->f, b);
    truth_sub(along, shadow[1], shadow[0]);
    length = truth_length(along);
    if (length <= 1e-9 * is->f->size) /* the light looks along the edge: any direction will do */
        truth_sub(along, is->f->corners[0], is->f->centre);
    truth_cross(aside, is->f->normal, along);
    truth_sub(to_centre, is->f->centre, shadow[0]);
    for (int i = 0; i < 6; i++) {
        const double nearest = truth_dot(to_centre, along) / truth_dot(along, along);
        const double place = i < 5 ? places[i] : fmin(fmax(nearest, 0.0), 1.0);

        for (int side = -1; side <= 1; side += 2) {
            double at[3];

            truth_along(at, shadow[0], length <= 1e-9 * is->f->size ? 0.0 : place, along);
            truth_along(at, at, side * PROBE_ASIDE * is->f->size / truth_length(aside), aside);
            if (is_lit_at(is, at))
                return 1;
        }
    }
    return 0;
}

/* The pixel's square on the plane of the triangle seen at its centre. A plane seen at a grazing angle leaves the image
 * within the pixel: there each corner is drawn in towards the centre until its depth is within a factor of two, or, in
 * an orthographic image, until the slope is at most 256. */
static void footprint_set(truth_footprint *f, const truth *t, const truth_point *c, double x, double y)
{
    static const double corners[4][2] = {{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}};
    const double slope_most = 256.0 * t->half[1] / t->height;
    double straight;

    truth_normal(f->normal, &t->rays.triangles[c->triangle]);
    straight = truth_dot(f->normal, c->along);
    memcpy(f->centre, c->at, sizeof f->centre);
    f->size = 0.0;
    for (int i = 0; i < 4; i++) {
        double from[3], along[3], off[3], share = 1.0, depth;

        truth_view_ray(t, x + corners[i][0], y + corners[i][1], from, along);
        if (t->scene->camera.orthographic) {
            truth_sub(off, from, c->from);
            depth = -truth_dot(f->normal, off) / straight;
            if (fabs(depth) > slope_most)
                share = slope_most / fabs(depth);
            truth_along(from, c->from, share, off);
            truth_along(f->corners[i], from, c->depth + share * depth, along);
        } else {
            /* the plane's 1 / depth is linear in the image: this is its ratio to the centre's */
            const double ratio = truth_dot(f->normal, along) / straight;

            if (ratio < 0.5)
                share = 0.5 / (1.0 - ratio);
            else if (ratio > 2.0)
                share = 1.0 / (ratio - 1.0);
            truth_sub(off, along, c->along);
            truth_along(along, c->along, share, off);
            truth_along(f->corners[i], c->from, c->depth / (1.0 + share * (ratio - 1.0)), along);
        }
        truth_sub(off, f->corners[i], f->centre);
        f->size = fmax(f->size, truth_length(off));
    }
}

static int edge_crosses(truth_pass *p, const truth_point *c, double x, double y, int lit)
{
    truth_footprint f;
    prober is = {p, c, &f};
    double up[3], scale;

    footprint_set(&f, p->t, c, x, y);
    truth_to_light(p, f.centre, up);
    scale = (truth_dot(f.normal, up) < 0.0 ? -1.0 : 1.0) / truth_length(f.normal);
    for (int k = 0; k < 3; k++)
        f.normal[k] *= scale;
    return truth_silhouette_cross(&p->silhouette, &f, lit ? any_edge : lit_beside, &is);
}

/* ------------------------------------------------------------------ classes */

/* Whether a point that faces the light flips when it is moved to another depth on the view ray. around_edges: triangles
 * beside the visible one are pardoned too. */
static int flips_when_moved(truth_pass *p, const truth_point *c, double depth, int lit, int around_edges)
{
    truth_pardon pardon = {{c->at[0], c->at[1], c->at[2]}, c->triangle, 0.0};
    double at[3], by[3], along[3];

    truth_along(at, c->from, depth, c->along);
    if (lit && around_edges) {
        /* behind an edge the way to the light leads through the edge's other triangle, farther off if grazing */
        truth_sub(by, at, c->at);
        truth_to_light(p, at, along);
        pardon.reach = 4.0 * truth_length(by) / (truth_length(along) * truth_facing(p, c));
    }
    return truth_in_shadow(p, at, c->triangle, &pardon) == lit;
}

/* How much the depth of the seen plane changes in one pixel across and one pixel down, together. */
static double depth_slope(const truth *t, const truth_point *c, double x, double y)
{
    double n[3], slope = 0.0;

    truth_normal(n, &t->rays.triangles[c->triangle]);
    for (int axis = 0; axis < 2; axis++) {
        double from[3], along[3];

        truth_view_ray(t, x + (axis == 0), y + (axis == 1), from, along);
        truth_sub(from, from, c->from);
        truth_sub(along, along, c->along);
        slope += fabs((truth_dot(n, from) + c->depth * truth_dot(n, along)) / truth_dot(n, c->along));
    }
    return slope;
}

/* A silhouette edge that is not hidden: at most as deep as what is seen around it. */
static int is_in_sight(void *user, const double a[3], const double b[3])
{
    const prober *is = user;
    const double *forward = is->p->t->axes[2];

    return fmin(truth_dot(a, forward), truth_dot(b, forward)) <= is->centre->depth * (1.0 + 1e-6);
}

/* Whether the light's silhouette passes within 1/256 pixel of the centre, in sight: beyond the edge, cap and side
 * come in the wrong order. deepest: of what is seen within 1/256 pixel. */
static int silhouette_near(truth_pass *p, const truth_point *c, double x, double y, double deepest)
{
    static const double corners[5][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {-1, -1}};
    const truth *t = p->t;
    truth_point reach = *c;
    const prober is = {p, &reach, NULL};
    truth_plane planes[5];

    reach.depth = deepest;
    for (int i = 0; i < 4; i++) {
        double from[2][3], along[2][3], beside[3], to_centre[3];

        for (int k = 0; k < 2; k++)
            truth_view_ray(t, x + corners[i + k][0] * TRUTH_SNAP, y + corners[i + k][1] * TRUTH_SNAP, from[k],
                           along[k]);
        for (int k = 0; k < 3; k++)
            beside[k] = from[1][k] + along[1][k] * c->depth - from[0][k] - along[0][k] * c->depth;
        truth_cross(planes[i].normal, along[0], beside);
        truth_sub(to_centre, c->at, from[0]);
        if (truth_dot(planes[i].normal, to_centre) < 0.0)
            for (int k = 0; k < 3; k++)
                planes[i].normal[k] = -planes[i].normal[k];
        planes[i].least = truth_dot(planes[i].normal, from[0]);
    }
    memcpy(planes[4].normal, t->axes[2], sizeof planes[4].normal);
    planes[4].least = t->nearest;
    return truth_silhouette_within(&p->silhouette, planes, is_in_sight, (void *)&is);
}

static int is_snapped(truth_pass *p, const truth_point *c, double x, double y, int lit, uint8_t remarks)
{
    const truth *t = p->t;
    const double cosine = truth_facing(p, c);
    double change, deepest = c->depth, slope = 0.0;

    if ((remarks & TRUTH_SNAP_VISIBLE) || fabs(cosine) < FLOAT_EDGE_ON)
        return 1;
    /* where all eight are of one triangle they differ only if a shadow edge passes, and none does */
    for (int n = 0; (remarks & TRUTH_SNAP_TRIANGLE) && n < 9; n++) {
        const double sx = x + (n % 3 - 1) * TRUTH_SNAP, sy = y + (n / 3 - 1) * TRUTH_SNAP;
        double depth;
        const uint32_t seen = truth_see(t, sx, sy, c->triangle, &depth);
        truth_point beside;

        if (seen == TRUTH_NOTHING)
            return 1;
        truth_point_set(&beside, t, sx, sy, seen, depth);
        if (truth_is_lit(p, &beside) != lit)
            return 1;
        if (seen != c->triangle) {
            if (slope == 0.0)
                slope = depth_slope(t, c, x, y);
            /* an outline: farther apart than two surfaces that meet at an edge can be */
            if (fabs(depth - c->depth) >
                2.0 * TRUTH_SNAP * (slope + depth_slope(t, &beside, sx, sy)) + 1e-6 * fabs(depth))
                return 1;
        }
        deepest = fmax(deepest, depth);
    }
    if ((remarks & TRUTH_SNAP_TRIANGLE) && silhouette_near(p, c, x, y, deepest))
        return 1;
    if (cosine < 0.0 || !(t->rays.triangles[c->triangle].flags & TRUTH_RECEIVES))
        return 0;
    change = fmin(TRUTH_SNAP * depth_slope(t, c, x, y), 0.5 * c->depth);
    return flips_when_moved(p, c, c->depth - change, lit, 1) || flips_when_moved(p, c, c->depth + change, lit, 1);
}

/* Whether the eye meets another surface, of another state, within two steps behind the visible one. */
static int is_other_behind(truth_pass *p, const truth_point *c, int lit)
{
    const truth *t = p->t;
    uint32_t found[LAYERS];
    double depth[LAYERS];
    truth_ray ray;
    size_t count;

    truth_ray_set(&ray, c->from, c->along);
    count = truth_rays_within(&t->rays, &ray, c->depth * (1.0 - 1e-9), fmin(truth_stepped(t, c->depth, 2), t->farthest),
                              c->triangle, found, depth, LAYERS);
    for (size_t i = 0; i < count; i++) {
        truth_point behind = *c;

        behind.triangle = found[i];
        behind.depth = depth[i];
        truth_along(behind.at, c->from, depth[i], c->along);
        if (truth_is_lit(p, &behind) != lit)
            return 1;
    }
    return 0;
}

static int is_depth_limited(truth_pass *p, const truth_point *c, int lit, uint8_t remarks)
{
    const truth *t = p->t;

    if (remarks & TRUTH_CUT_NEAR_BY)
        return 1;
    if ((remarks & TRUTH_BEHIND) && is_other_behind(p, c, lit))
        return 1;
    if (!(truth_facing(p, c) > 0.0) || !(t->rays.triangles[c->triangle].flags & TRUTH_RECEIVES))
        return 0;
    for (int step = -2; step <= 2; step++)
        if (step != 0 && flips_when_moved(p, c, truth_stepped(t, c->depth, step), lit, 0))
            return 1;
    return 0;
}

truth_class truth_classify(truth_pass *p, uint32_t x, uint32_t y)
{
    const truth *t = p->t;
    const size_t first = 2 * (size_t)y * t->columns + 2 * (size_t)x, centre = first + t->columns + 1;
    const uint32_t seen = t->seen[centre];
    const uint8_t remarks = t->remarks[(size_t)y * t->width + x];
    const int lit = p->lit[centre];
    truth_point c;

    for (size_t j = 0; j < 3; j++)
        for (size_t i = 0; i < 3; i++) {
            const size_t n = first + j * t->columns + i;

            if ((t->seen[n] == TRUTH_NOTHING) != (seen == TRUTH_NOTHING) || p->lit[n] != lit)
                return TRUTH_BOUNDARY;
        }
    if (seen == TRUTH_NOTHING && (remarks & TRUTH_SNAP_VISIBLE))
        return TRUTH_SNAPPED;
    if (seen == TRUTH_NOTHING)
        return remarks & TRUTH_CUT_NEAR_BY ? TRUTH_DEPTH_LIMITED : TRUTH_CERTAIN;

    truth_point_set(&c, t, x + 0.5, y + 0.5, seen, t->depth[centre]);
    if ((t->rays.triangles[seen].flags & TRUTH_RECEIVES) && truth_facing(p, &c) > 0.0 &&
        edge_crosses(p, &c, x + 0.5, y + 0.5, lit))
        return TRUTH_BOUNDARY;
    if (is_snapped(p, &c, x + 0.5, y + 0.5, lit, remarks))
        return TRUTH_SNAPPED;
    return is_depth_limited(p, &c, lit, remarks) ? TRUTH_DEPTH_LIMITED : TRUTH_CERTAIN;
}
