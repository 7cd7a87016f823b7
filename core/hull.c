/* hull.c - convex bodies of view space, and whether two of them are apart.
 *
 * Boxes are of object space, so that in view space they are parallelepipeds, sheared ones too. A body is the hull of
 * points and of directions, in which it goes on without end. Two bodies are apart when some axis separates them: the
 * normals of faces, and the products of edges, are tried by those who know them. A margin keeps rounding on the safe
 * side; where no axis can be told, the bodies touch.
 *
 * An axis that was made at right angles to a direction is so but for rounding, and sees no end that way: the shift that
 * the rounding makes is far below the margin wherever the other body, which has an end, can be touched. */
#include "gni.h"

#include <math.h>
#include <string.h>

void gni_make_axes(double axes[3][3], const double axis[3])
{
    const double length = sqrt(gni_dot(axis, axis));
    double across[3] = {0, 0, 0}, size;
    int least = 0;

    for (int i = 0; i < 3; i++)
        least = fabs(axis[i]) < fabs(axis[least]) ? i : least;
    across[least] = 1.0;
    gni_cross(axes[0], axis, across);
    size = sqrt(gni_dot(axes[0], axes[0]));
    for (int i = 0; i < 3; i++) {
        axes[0][i] /= size;
        axes[2][i] = axis[i] / length;
    }
    gni_cross(axes[1], axes[2], axes[0]);
}

/* By the greatest row sum of its square (Gershgorin). */
double gni_stretch(const double m[16])
{
    double most = 0.0;

    for (int i = 0; i < 3; i++) {
        double sum = 0.0;

        for (int j = 0; j < 3; j++)
            sum += fabs(gni_dot(m + 4 * i, m + 4 * j));
        most = fmax(most, sum);
    }
    return sqrt(most) * (1.0 + GNI_MARGIN);
}

void gni_find_ball(double out[4], const gni_hull *box, const gn_mesh *mesh, const double model_view[16])
{
    double square = 0.0;

    for (int k = 0; k < 3; k++)
        out[k] = 0.5 * (box->points[0][k] + box->points[7][k]);
    for (int i = 0; i < box->point_count; i++) {
        const double *p = box->points[i];

        square = fmax(square, (p[0] - out[0]) * (p[0] - out[0]) + (p[1] - out[1]) * (p[1] - out[1]) +
                                  (p[2] - out[2]) * (p[2] - out[2]));
    }
    out[3] = fmin(sqrt(square), gni_stretch(model_view) * mesh->radius);
}

void gni_hull_around(gni_hull *out, const double low[3], const double high[3])
{
    memset(out, 0, sizeof *out);
    out->point_count = 8;
    for (int c = 0; c < 8; c++)
        for (int axis = 0; axis < 3; axis++)
            out->points[c][axis] = c >> axis & 1 ? high[axis] : low[axis];
    for (int axis = 0; axis < 3; axis++)
        out->edges[axis][axis] = 1.0;
}

void gni_volume_hull(gni_hull *out, const gni_hull *box, const double light[4])
{
    *out = *box;
    out->direction_count = light[3] == 0.0 ? 1 : 8;
    for (int i = 0; i < out->direction_count; i++)
        for (int k = 0; k < 3; k++)
            out->directions[i][k] = box->points[i][k] * light[3] - light[k];
    if (light[3] == 0.0)
        for (int k = 0; k < 3; k++)
            out->directions[0][k] = -light[k];
}

/* What the body's points reach along an axis; returns the greatest sum of coordinates that went into it. */
static double extent(double range[2], const double axis[3], const gni_hull *h)
{
    double most = 0.0;

    range[0] = INFINITY;
    range[1] = -INFINITY;
    for (int i = 0; i < h->point_count; i++) {
        const double *p = h->points[i], at = gni_dot(axis, p);
        const double sum = fabs(axis[0] * p[0]) + fabs(axis[1] * p[1]) + fabs(axis[2] * p[2]);

        range[0] = at < range[0] ? at : range[0];
        range[1] = at > range[1] ? at : range[1];
        most = sum > most ? sum : most;
    }
    return most;
}

/* And its directions. */
static void extend(double range[2], const double axis[3], double axis_length, const gni_hull *h)
{
    for (int i = 0; i < h->direction_count; i++) {
        const double along = gni_dot(axis, h->directions[i]);
        const double least = 1e-12 * axis_length * sqrt(gni_dot(h->directions[i], h->directions[i]));

        if (along > least)
            range[1] = INFINITY;
        if (along < -least)
            range[0] = -INFINITY;
    }
}

int gni_separates(const double axis[3], const gni_hull *a, const gni_hull *b)
{
    const double length = sqrt(gni_dot(axis, axis));
    double of_a[2], of_b[2], margin;

    if (!(length > 0.0))
        return 0;
    margin = GNI_MARGIN * (extent(of_a, axis, a) + extent(of_b, axis, b));
    extend(of_a, axis, length, a);
    extend(of_b, axis, length, b);
    return of_a[0] > of_b[1] + margin || of_b[0] > of_a[1] + margin;
}

int gni_volume_misses(const gni_hull *volume, const double light[4], const gni_hull *box)
{
    double axis[3];

    for (int i = 0; i < 3; i++) {
        gni_cross(axis, box->edges[i], box->edges[(i + 1) % 3]);
        if (gni_separates(axis, volume, box))
            return 1;
        gni_cross(axis, volume->edges[i], volume->edges[(i + 1) % 3]);
        if (gni_separates(axis, volume, box))
            return 1;
    }
    for (int i = 0; i < 3; i++) /* the planes through the light and an edge of the caster's box */
        for (int corner = 0; corner < 8; corner++) {
            double spoke[3];

            if (corner >> i & 1)
                continue;
            for (int k = 0; k < 3; k++)
                spoke[k] = volume->points[corner][k] * light[3] - light[k];
            gni_cross(axis, spoke, volume->edges[i]);
            if (gni_separates(axis, volume, box))
                return 1;
        }
    return 0;
}

int gni_is_outside(const gni_hull *hull, const double plane[4])
{
    double most = -INFINITY, scale = fabs(plane[3]);

    for (int i = 0; i < hull->point_count; i++) {
        const double *p = hull->points[i];

        most = fmax(most, gni_dot(plane, p) + plane[3]);
        for (int k = 0; k < 3; k++)
            scale = fmax(scale, fabs(plane[k] * p[k]));
    }
    for (int i = 0; i < hull->direction_count; i++) {
        const double *d = hull->directions[i];
        double reach = 0.0;

        for (int k = 0; k < 3; k++)
            reach = fmax(reach, fabs(plane[k] * d[k]));
        if (gni_dot(plane, d) >= -GNI_MARGIN * reach)
            return 0;
    }
    return most < -GNI_MARGIN * scale;
}

/* The least value of a plane, less what rounding may make of 0: times -1 or 1. */
static double least_side(const gni_hull *hull, const double plane[4], double margin)
{
    double least = INFINITY, scale = fabs(plane[3]);

    for (int i = 0; i < hull->point_count; i++) {
        least = fmin(least, gni_dot(plane, hull->points[i]) + plane[3]);
        for (int k = 0; k < 3; k++)
            scale = fmax(scale, fabs(plane[k] * hull->points[i][k]));
    }
    return least + margin * scale;
}

int gni_lies_before(const gni_hull *hull, const double plane[4])
{
    return least_side(hull, plane, GNI_MARGIN) >= 0.0;
}

int gni_is_before(const gni_hull *hull, const double plane[4])
{
    return least_side(hull, plane, -GNI_MARGIN) > 0.0;
}
