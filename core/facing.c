/* facing.c - which triangles show their fronts to a light, and which their backs: a bit each.
 *
 * The truth of a bit is the sign of one expression in double (DESIGN.md, decision 1). It is found in floats, 8 at a
 * time, wherever these are further from 0 than they can be wrong; the few others are asked in double. So the bits are the
 * same whatever floats do, on any processor: with fused multiply-add or without, in vectors or one by one.
 *
 * The bound: plane and light are rounded to float (two relative errors of 2^-24), multiplied (one), and summed (three at
 * most): under 7 * 2^-24 of the sum of the terms' magnitudes. Normals are scaled below 1 in every component, so that this
 * sum is at most |x| + |y| + |z| of the light and the greatest distance of the cluster's planes. 2^-21 is 8 * 2^-24: the
 * rest is room for the double's own rounding.
 *
 * The tree of clusters.c says of most triangles which way they face without a look. */
#include "gni.h"

#include <math.h>
#include <string.h>

#define FLOAT_ERROR 0x1p-21
#define ANGLE       1e-3 /* radians by which ball and cone must be clear of the light's rim: more than doubles round */
#define MOST        1e30 /* of the bound: floats hold what comes before it */
#define CLOSE       1e-6 /* of the mesh's radius: nearer to a node's ball the tree says nothing */

/* 1: all fronts. -1: all backs. 0: who knows. */
static int side_of(const gn_mesh *mesh, const gni_node *n, const double light[4])
{
    const double u[3] = {light[0] - n->centre[0] * light[3], light[1] - n->centre[1] * light[3],
                         light[2] - n->centre[2] * light[3]};
    const double square = gni_dot(u, u), along = gni_dot(n->axis, u), distance = sqrt(square);
    double sine, cosine, limit;

    if (n->cosine == 0.0)
        return 0;
    if (light[3] == 0.0) {
        sine = 0.0;
        cosine = 1.0;
    } else {
        if (!(distance > 1.001 * n->radius + CLOSE * mesh->radius))
            return 0;
        sine = n->radius / distance;
        cosine = sqrt(1.0 - sine * sine);
    }
    if (!(n->cosine * cosine - n->sine * sine > 0.0))
        return 0;
    limit = (n->sine * cosine + n->cosine * sine + ANGLE) * distance;
    return (along > limit) - (along < -limit);
}

static int exact_side(const double plane[4], const double light[4])
{
    const double side = plane[0] * light[0] + plane[1] * light[1] + plane[2] * light[2] + plane[3] * light[3];

    return (side > 0.0) - (side < 0.0);
}

#if defined(__GNUC__)
/* One source for SSE, AVX and NEON: the compiler makes of eight lanes what there is. */
typedef float floats __attribute__((vector_size(32)));
typedef int32_t masks __attribute__((vector_size(32)));

/* Bits of what is surely in front and surely behind. */
static void rate(const gni_cluster *c, const float l[4], float bound, uint64_t *front, uint64_t *back)
{
    masks before = {0}, behind = {0};
    uint64_t f = 0, b = 0;

    for (int j = 0; j < 8; j++) {
        floats x, y, z, d, s;
        const int32_t bit = 1 << j;

        memcpy(&x, c->planes[0] + 8 * j, sizeof x);
        memcpy(&y, c->planes[1] + 8 * j, sizeof y);
        memcpy(&z, c->planes[2] + 8 * j, sizeof z);
        memcpy(&d, c->planes[3] + 8 * j, sizeof d);
        s = x * l[0] + y * l[1] + z * l[2] + d * l[3];
        before |= (masks)(s > bound) & bit;
        behind |= (masks)(s < -bound) & bit;
    }
    for (int lane = 0; lane < 8; lane++) {
        f |= (uint64_t)(uint32_t)before[lane] << (8 * lane);
        b |= (uint64_t)(uint32_t)behind[lane] << (8 * lane);
    }
    *front = f;
    *back = b;
}
#else
static void rate(const gni_cluster *c, const float l[4], float bound, uint64_t *front, uint64_t *back)
{
    *front = *back = 0;
    for (int slot = 0; slot < 64; slot++) {
        const float s = c->planes[0][slot] * l[0] + c->planes[1][slot] * l[1] + c->planes[2][slot] * l[2] +
                        c->planes[3][slot] * l[3];
        const uint64_t bit = (uint64_t)1 << (8 * (slot % 8) + slot / 8);

        *front |= s > bound ? bit : 0;
        *back |= s < -bound ? bit : 0;
    }
}
#endif

static uint64_t mask_of(const gn_mesh *mesh, uint32_t cluster)
{
    const uint32_t rest = mesh->info.triangle_count - cluster * GNI_CLUSTER;

    return rest < GNI_CLUSTER ? ((uint64_t)1 << rest) - 1 : ~(uint64_t)0;
}

static void look(const gn_mesh *mesh, uint32_t cluster, const double light[4], const float l[4], double light_size,
                 uint64_t *front, uint64_t *back)
{
    const gni_cluster *c = &mesh->clusters[cluster];
    const double bound = FLOAT_ERROR * (light_size + c->most * fabs(light[3])) + 1e-37;
    uint64_t doubt;

    *front = *back = 0;
    if (bound < MOST) /* else all is in doubt */
        rate(c, l, (float)bound, front, back);
    for (doubt = ~(*front | *back) & mask_of(mesh, cluster); doubt; doubt &= doubt - 1) {
        const uint32_t i = gni_lowest_bit(doubt);
        const int side = exact_side(mesh->planes + 4 * (size_t)(cluster * GNI_CLUSTER + i), light);

        *front |= (uint64_t)(side > 0) << i;
        *back |= (uint64_t)(side < 0) << i;
    }
}

/* What no float holds is not used: the bound is beyond MOST then. */
static void to_floats(float out[4], const double light[4])
{
    for (int k = 0; k < 4; k++)
        out[k] = fabs(light[k]) < 1e38 ? (float)light[k] : 0.0f;
}

typedef struct query {
    const gn_mesh *mesh;
    const double *light;
    float l[4];
    double size;
    uint64_t *front, *back;
    uint32_t looked_at;
} query;

static void visit(query *q, uint32_t level, uint32_t index)
{
    const gn_mesh *mesh = q->mesh;
    const int side = side_of(mesh, &mesh->nodes[mesh->levels[level] + index], q->light);

    if (side != 0) {
        const uint32_t first = index << (3 * level), span = 1u << (3 * level);
        const uint32_t end = mesh->cluster_count - first < span ? mesh->cluster_count : first + span;

        memset(q->front + first, side > 0 ? 0xff : 0, (end - first) * sizeof *q->front);
        memset(q->back + first, side < 0 ? 0xff : 0, (end - first) * sizeof *q->back);
        return;
    }
    if (level == 0) {
        look(mesh, index, q->light, q->l, q->size, &q->front[index], &q->back[index]);
        q->looked_at++;
        return;
    }
    {
        const uint32_t below = mesh->levels[level] - mesh->levels[level - 1];

        for (uint32_t i = 8 * index; i < 8 * index + 8 && i < below; i++)
            visit(q, level - 1, i);
    }
}

uint32_t gni_find_facing(const gn_mesh *mesh, const double light[4], uint64_t *front, uint64_t *back)
{
    query q = {mesh, light, {0}, fabs(light[0]) + fabs(light[1]) + fabs(light[2]), front, back, 0};

    to_floats(q.l, light);
    if (mesh->cluster_count == 0)
        return 0;
    visit(&q, mesh->level_count - 1, 0);
    front[mesh->cluster_count - 1] &= mask_of(mesh, mesh->cluster_count - 1);
    back[mesh->cluster_count - 1] &= mask_of(mesh, mesh->cluster_count - 1);
    return q.looked_at * GNI_CLUSTER;
}

uint32_t gni_scan_facing(const gn_mesh *mesh, const double light[4], uint64_t *front, uint64_t *back)
{
    const double size = fabs(light[0]) + fabs(light[1]) + fabs(light[2]);
    float l[4];

    to_floats(l, light);
    for (uint32_t c = 0; c < mesh->cluster_count; c++) {
        look(mesh, c, light, l, size, &front[c], &back[c]);
        front[c] &= mask_of(mesh, c);
        back[c] &= mask_of(mesh, c);
    }
    return mesh->info.triangle_count;
}
