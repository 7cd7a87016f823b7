/* clusters.c - runs of 64 triangles, and a tree over them: what a light needs to look at many triangles at once.
 *
 * A cluster has its planes as floats in lanes, for facing_floats.c; the corners whose neighbour is in another cluster; and a
 * node: a ball around its vertices and a cone around its normals. Eight nodes are a node of the next level. Where ball
 * and cone say that a light sees all fronts, or all backs, nothing below is looked at: the cost of a silhouette then
 * follows the silhouette's length, not the triangles' number (Sander et al., Silhouette Clipping, 2000, search such a
 * tree of cones). */
#include "gni.h"

#include <math.h>
#include <string.h>

/* fmax() is a call. */
static double greatest(double a, double b)
{
    return a > b ? a : b;
}

static void fill_lanes(const gn_mesh *mesh, uint32_t index)
{
    gni_cluster *c = &mesh->clusters[index];
    const uint32_t first = index * GNI_CLUSTER;
    double of_last = 0.0;

    memset(c, 0, sizeof *c);
    for (uint32_t i = 0; i < GNI_CLUSTER; i++)
        c->planes[3][i] = 1e36f; /* of what is no triangle: in no doubt */
    for (uint32_t i = 0; i < GNI_CLUSTER && first + i < mesh->info.triangle_count; i++) {
        const double *plane = mesh->facing_planes + 4 * (size_t)(first + i);
        const double most = greatest(fabs(plane[0]), greatest(fabs(plane[1]), fabs(plane[2])));
        const double scale = most > 0.0 ? 1.0 / most : 0.0; /* one more rounding, of double: nothing to float's */
        const float last = (float)(plane[3] * scale);
        /* bit 8 l + j of a word is lane l of vector 7 - j */
        float *lane = &c->planes[0][(7u - i % 8u) * 8u + i / 8u];

        lane[0] = (float)(plane[0] * scale);
        lane[GNI_CLUSTER] = (float)(plane[1] * scale);
        lane[2 * GNI_CLUSTER] = (float)(plane[2] * scale);
        lane[3 * GNI_CLUSTER] = last;
        if (!(fabs((double)last) <= of_last))
            of_last = fabs((double)last);
    }
    c->most = of_last;
}

static void unit(double v[3])
{
    const double square = v[0] * v[0] + v[1] * v[1] + v[2] * v[2], scale = square > 0.0 ? 1.0 / sqrt(square) : 0.0;

    for (int k = 0; k < 3; k++)
        v[k] *= scale;
}

/* A cone of half angle 90 degrees or more says nothing. */
static void open_cone(gni_node *n, double cosine)
{
    n->cosine = cosine > 1e-3 ? cosine : 0.0;
    n->sine = sqrt(1.0 - n->cosine * n->cosine); /* of an open one 1: nothing is beyond its doubt */
}

static void make_leaf(const gn_mesh *mesh, uint32_t index)
{
    gni_node *n = &mesh->nodes[index];
    const uint32_t first = index * GNI_CLUSTER, rest = mesh->info.triangle_count - first;
    const uint32_t count = rest < GNI_CLUSTER ? rest : GNI_CLUSTER;
    const uint32_t *corners = mesh->triangles + 3 * (size_t)first;
    const double *planes = mesh->facing_planes + 4 * (size_t)first;
    double cosine, lowest = 1.0, square = 0.0; /* lowest: square of a cosine, and its sign */
    double a[3] = {0, 0, 0}, middle[3];

    for (const double *p = planes; p < planes + 4 * (size_t)count; p += 4) {
        a[0] += p[0];
        a[1] += p[1];
        a[2] += p[2];
    }
    unit(a);
    memcpy(n->axis, a, sizeof a);
    for (const double *p = planes; p < planes + 4 * (size_t)count; p += 4) {
        const double along = p[0] * a[0] + p[1] * a[1] + p[2] * a[2];
        const double length = p[0] * p[0] + p[1] * p[1] + p[2] * p[2];

        if (along * fabs(along) < lowest * length || length == 0.0) /* of no area: the cone is open */
            lowest = length == 0.0 ? -1.0 : along * fabs(along) / length;
    }
    cosine = lowest > 0.0 ? sqrt(lowest) : 0.0;
    for (int axis = 0; axis < 3; axis++) { /* about the middle: a third of the corners tell */
        const float *p = mesh->positions + axis;
        float low = INFINITY, high = -INFINITY;

        for (uint32_t i = 0; i < count; i++) {
            const float x = p[3 * (size_t)corners[3 * i]];

            low = x < low ? x : low;
            high = x > high ? x : high;
        }
        n->centre[axis] = middle[axis] = 0.5 * (double)low + 0.5 * (double)high;
    }
    for (uint32_t i = 0; i < 3 * count; i++) {
        const float *p = mesh->positions + 3 * (size_t)corners[i];
        const double x = (double)p[0] - middle[0], y = (double)p[1] - middle[1], z = (double)p[2] - middle[2];
        const double of_corner = x * x + y * y + z * z;

        square = of_corner > square ? of_corner : square;
    }
    n->radius = sqrt(square);
    open_cone(n, cosine);
}

static void make_inner(gni_node *n, const gni_node *children, uint32_t count)
{
    double cosine = 1.0, low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};

    memset(n, 0, sizeof *n);
    for (uint32_t i = 0; i < count; i++)
        for (int k = 0; k < 3; k++) {
            n->axis[k] += children[i].axis[k];
            low[k] = fmin(low[k], children[i].centre[k] - children[i].radius);
            high[k] = fmax(high[k], children[i].centre[k] + children[i].radius);
        }
    unit(n->axis);
    for (int k = 0; k < 3; k++)
        n->centre[k] = 0.5 * low[k] + 0.5 * high[k];
    for (uint32_t i = 0; i < count; i++) {
        const gni_node *c = &children[i];
        const double d[3] = {c->centre[0] - n->centre[0], c->centre[1] - n->centre[1], c->centre[2] - n->centre[2]};
        const double between = fmin(gni_dot(c->axis, n->axis), 1.0);

        n->radius = fmax(n->radius, sqrt(gni_dot(d, d)) + c->radius);
        /* the cosine of the sum of the angles, if that is below 90 degrees */
        cosine = c->cosine > 0.0 && between > 0.0
                     ? fmin(cosine, between * c->cosine - sqrt(1.0 - between * between) * c->sine)
                     : 0.0;
        if (!(cosine > 0.0))
            break;
    }
    open_cone(n, cosine);
}

static void make_tree(gn_mesh *mesh)
{
    uint32_t level_first = 0, level_count = mesh->cluster_count;

    mesh->level_count = 1;
    mesh->levels[0] = 0;
    for (uint32_t i = 0; i < level_count; i++)
        make_leaf(mesh, i);
    while (level_count > 1) {
        const uint32_t next = level_first + level_count, count = (level_count + 7u) / 8u;

        for (uint32_t i = 0; i < count; i++)
            make_inner(&mesh->nodes[next + i], &mesh->nodes[level_first + 8u * i],
                       level_count - 8u * i < 8u ? level_count - 8u * i : 8u);
        mesh->levels[mesh->level_count++] = next;
        level_first = next;
        level_count = count;
    }
}

/* Which corners are on a cluster's border; how many in all. borders: [triangle_count * 3]. */
static uint32_t find_borders(gn_mesh *mesh, uint8_t *borders)
{
    const uint32_t triangles = mesh->info.triangle_count;
    uint32_t count = 0;

    for (uint32_t c = 0; c < mesh->cluster_count; c++) {
        const uint32_t first = c * GNI_CLUSTER, rest = triangles - first;
        const uint32_t own = rest < GNI_CLUSTER ? rest : GNI_CLUSTER, *across = mesh->across + 3 * (size_t)first;

        mesh->border_starts[c] = count;
        for (uint32_t i = 0; i < 3 * own; i++) {
            borders[count] = (uint8_t)i;
            count += across[i] - first >= own;
        }
    }
    mesh->border_starts[mesh->cluster_count] = count;
    return count;
}

void gni_fill_clusters(gn_mesh *mesh)
{
    for (uint32_t c = 0; c < mesh->cluster_count; c++)
        fill_lanes(mesh, c);
    if (mesh->cluster_count)
        make_tree(mesh);
}

gn_result gni_make_clusters(gn_mesh *mesh)
{
    gn_context *context = mesh->context;
    const uint32_t count = (mesh->info.triangle_count + GNI_CLUSTER - 1) / GNI_CLUSTER;
    uint8_t *found;

    mesh->cluster_count = count;
    mesh->clusters = gni_alloc(context, count, sizeof *mesh->clusters);
    mesh->nodes = gni_alloc(context, (size_t)count + count / 7 + 16, sizeof *mesh->nodes);
    mesh->border_starts = gni_alloc(context, (size_t)count + 1, sizeof *mesh->border_starts);
    found = gni_alloc(context, 3 * (size_t)mesh->info.triangle_count + 1, 1);
    if (mesh->clusters && mesh->nodes && mesh->border_starts && found) {
        const uint32_t borders = find_borders(mesh, found);

        mesh->borders = gni_alloc(context, borders, 1);
        if (mesh->borders)
            memcpy(mesh->borders, found, borders);
    }
    gni_free(context, found);
    if (!mesh->borders)
        return gn_fail(context, GN_E_MEMORY, "mesh: no memory for %lu clusters", (unsigned long)count);
    gni_fill_clusters(mesh);
    return GN_OK;
}
