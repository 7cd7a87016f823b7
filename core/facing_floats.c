/* facing_floats.c - the bits of facing.c in floats, 8 at a time, wherever these are further from 0 than they can be
 * wrong; the few others are asked in double. So the bits are the same whatever floats do, on any processor: with fused
 * multiply-add or without, in vectors or one by one.
 *
 * The bound: plane and light are rounded to float (two relative errors of 2^-24), multiplied (one), and summed (three
 * at most): under 7 * 2^-24 of the sum of the terms' magnitudes. Normals are scaled below 1 in every component, so that
 * this sum is at most |x| + |y| + |z| of the light and the greatest distance of the cluster's planes. 2^-21 is 8 *
 * 2^-24: the rest is room for the double's own rounding.
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
    const double square = gni_dot(u, u), along = gni_dot(n->axis, u);
    double distance, sine, cosine, limit;

    if (!(along * along > n->sine * n->sine * square)) /* as a point it is within the cone's doubt already: often so */
        return 0;
    distance = sqrt(square);
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

/* One source for SSE, AVX2 and NEON: the compiler makes of a vector of LANES what there is. Elsewhere, or where tests
 * define GNI_SCALAR, one by one. */
#if defined(GNI_SCALAR)
#define LANES 1
#elif defined(__GNUC__) && defined(__AVX2__)
#define LANES 8
#elif defined(__GNUC__) && (!defined(__arm__) || defined(__ARM_NEON))
#define LANES 4
#else
#define LANES 1
#endif

#if LANES > 1
typedef float floats __attribute__((vector_size(4 * LANES)));
typedef int32_t masks __attribute__((vector_size(4 * LANES)));
#define ALL(x) ((floats){0} + (x))
#else
typedef float floats;
typedef int32_t masks;
#define ALL(x) (x)
#endif

/* -1 in each lane where the comparison holds, as a compiler's vectors have it. */
#if LANES > 1
#define HOLDS(comparison) ((masks)(comparison))
#define MAGNITUDE(x)      ((floats)((masks)(x)&0x7fffffff))
#else
#define HOLDS(comparison) (-(comparison))
#define MAGNITUDE(x)      fabsf(x)
#endif

/* Eight times, without a loop where that need not be small. */
#define RATE(j)                                                                                                        \
    do {                                                                                                               \
        floats x, y, z, d, s;                                                                                          \
                                                                                                                       \
        memcpy(&x, c->planes[0] + 8 * (j) + first, sizeof x);                                                          \
        memcpy(&y, c->planes[1] + 8 * (j) + first, sizeof y);                                                          \
        memcpy(&z, c->planes[2] + 8 * (j) + first, sizeof z);                                                          \
        memcpy(&d, c->planes[3] + 8 * (j) + first, sizeof d);                                                          \
        s = x * lx + y * ly + z * lz + d * lw;                                                                         \
        bits = bits + bits - HOLDS(s > zero);                                                                          \
        doubt |= HOLDS(MAGNITUDE(s) <= least);                                                                         \
    } while (0)

/* Bits of what is in front; 0 where some triangle's side is in doubt. Each vector shifts its lanes' bits up by one, so
 * that the last one's are the lowest. */
static int rate(const gni_cluster *c, const float l[4], float bound, uint64_t *front)
{
    const floats lx = ALL(l[0]), ly = ALL(l[1]), lz = ALL(l[2]), lw = ALL(l[3]), least = ALL(bound), zero = ALL(0.0f);
    int32_t lanes[2][8];
    uint64_t word = 0;
    int32_t near = 0;

    for (int first = 0; first < 8; first += LANES) {
        masks bits = {0}, doubt = {0};

#ifdef __OPTIMIZE_SIZE__
        for (int j = 0; j < 8; j++)
            RATE(j);
#else
        RATE(0);
        RATE(1);
        RATE(2);
        RATE(3);
        RATE(4);
        RATE(5);
        RATE(6);
        RATE(7);
#endif
        memcpy(lanes[0] + first, &bits, sizeof bits);
        memcpy(lanes[1] + first, &doubt, sizeof doubt);
    }
    for (int i = 0; i < 8; i++) {
        word |= (uint64_t)(uint32_t)lanes[0][i] << (8 * i);
        near |= lanes[1][i];
    }
    *front = word;
    return !near;
}

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

    if (bound < MOST && rate(c, l, (float)bound, front)) {
        *back = ~*front;
        return;
    }
    gni_look_closely(mesh, cluster, light, front, back);
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

    if (side != 0 && level == 0) {
        q->front[index] = side > 0 ? ~(uint64_t)0 : 0;
        q->back[index] = ~q->front[index];
        return;
    }
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

uint32_t gni_search_facing(const gn_mesh *mesh, const double light[4], uint64_t *front, uint64_t *back)
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
