/* star.c - closed parts that a point inside sees all of: they pass nowhere through themselves.
 *
 * A part every triangle of which a point sees from the same side, and in whose sight some direction is covered once, is
 * seen in every direction once: its projection on a ball around the point covers that everywhere alike. Cheap, without
 * memory, and true of much that is modelled; for what is not it says nothing (embedded.c goes on from there). Few
 * triangles are not wholly on one side of the way, seen along two axes. */
#include "gni.h"

#include <math.h>

#define SURE 1e-9 /* of the terms, for a point seen from a triangle's plane: far more than rounding */

/* How often a triangle, seen from the side `side` of its plane at 0, is in the way from there: 0 or 1; -1 where that is
 * not sure. square: no less than a quarter of any two sides' product. */
static int covers(double v[3][3], const double way[3], int side, double square)
{
    int inside = gni_dot(v[0], way) > 0.0 || gni_dot(v[1], way) > 0.0 || gni_dot(v[2], way) > 0.0;

    for (int k = 0; k < 3 && inside; k++) {
        double normal[3], along;

        gni_cross(normal, v[k], v[(k + 1) % 3]);
        along = gni_dot(normal, way);
        if (!(fabs(along) > SURE * square))
            return -1;
        inside = (along > 0.0) == (side < 0);
    }
    return inside;
}

/* Whether three numbers are all beyond a limit, on one side of 0. */
static inline int are_beside(double a, double b, double c, double limit)
{
    return a > limit ? b > limit && c > limit : a < -limit && b < -limit && c < -limit;
}

int gni_part_is_star(const gn_mesh *mesh, const gni_part *part)
{
    static const double way[3] = {0.5773, 0.4637, 0.6719}; /* across no grid */
    const uint32_t *list = mesh->part_triangles + part->first_triangle;
    double m[3], square = 0.0, beside, of_m[2]; /* m: the middle; of_m: what it is along the two axes */
    uint32_t covered = 0;
    int side = 0;

    for (int axis = 0; axis < 3; axis++) {
        const double half = 0.5 * (double)part->box_max[axis] - 0.5 * (double)part->box_min[axis];

        m[axis] = 0.5 * (double)part->box_min[axis] + 0.5 * (double)part->box_max[axis];
        square += half * half;
    }
    beside = SURE * (sqrt(square) + fabs(m[0]) + fabs(m[1]) + fabs(m[2]));
    of_m[0] = way[1] * m[0] - way[0] * m[1];
    of_m[1] = way[2] * m[1] - way[1] * m[2];
    for (uint32_t i = 0; i < part->triangle_count; i++) {
        const uint32_t *c = mesh->triangles + 3 * (size_t)list[i];
        const double *plane = mesh->planes + 4 * (size_t)list[i];
        const double x = plane[0] * m[0], y = plane[1] * m[1], z = plane[2] * m[2], of_middle = x + y + z + plane[3];
        const double doubt = SURE * (fabs(x) + fabs(y) + fabs(z) + fabs(plane[3]));
        const float *p = mesh->positions + 3 * (size_t)c[0], *q = mesh->positions + 3 * (size_t)c[1];
        const float *r = mesh->positions + 3 * (size_t)c[2];
        double v[3][3];
        int own;

        if (!(fabs(of_middle) > doubt))
            return 0;
        own = of_middle > 0.0 ? 1 : -1;
        if (own == -side)
            return 0;
        side = own;
        if (GNI_HAS_SOLIDS && (are_beside(way[1] * (double)p[0] - way[0] * (double)p[1] - of_m[0],
                                          way[1] * (double)q[0] - way[0] * (double)q[1] - of_m[0],
                                          way[1] * (double)r[0] - way[0] * (double)r[1] - of_m[0], beside) ||
                               are_beside(way[2] * (double)p[1] - way[1] * (double)p[2] - of_m[1],
                                          way[2] * (double)q[1] - way[1] * (double)q[2] - of_m[1],
                                          way[2] * (double)r[1] - way[1] * (double)r[2] - of_m[1], beside)))
            continue;
        for (int axis = 0; axis < 3; axis++) {
            v[0][axis] = (double)p[axis] - m[axis];
            v[1][axis] = (double)q[axis] - m[axis];
            v[2][axis] = (double)r[axis] - m[axis];
        }
        own = covers(v, way, side, square);
        if (own < 0)
            return 0;
        covered += (uint32_t)own;
    }
    return covered == 1;
}
