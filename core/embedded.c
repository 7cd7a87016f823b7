/* embedded.c - proves that a closed part does not touch or pass through itself but where its triangles share vertices.
 *
 * Every pair of triangles whose boxes meet is looked at, found by a tree of boxes over the part. The answer is
 * one-sided: a pair counts as apart only where double precision is sure of it, since "not sure" merely makes every
 * triangle of the part cast (parts.c). The first pair that is not surely apart ends the search, and so does a budget.
 *
 * Two triangles without a common vertex: separating axes. With one: two flat sectors that meet at their apex. With
 * two: the fold along the common edge. With three: never apart. */
#include "gni.h"

#include <math.h>
#include <string.h>

#define LEAF 4u
/* Pairs of boxes and of triangles looked at for each triangle before the proof is given up. Many long triangles around
 * one vertex would take the square of their number. */
#define BUDGET 128u
/* Signs are trusted beyond this share of the largest term: coordinates are floats, so that a double product of three
 * differences errs by some 2^-51 of it. */
#define DOUBT 1e-14

typedef struct node {
    float box[6];          /* min, max */
    uint32_t first, count; /* leaf: triangles in order; count 0: inner */
    uint32_t right;        /* inner: the left child stands next */
} node;

typedef struct tree {
    const gn_mesh *mesh;
    float (*box)[6]; /* of each triangle of the part: min, max */
    uint32_t *order; /* positions in the part's list */
    node *nodes;
    uint32_t node_count, first_triangle;
    uint64_t budget; /* pairs that may still be looked at */
} tree;

static void cross(double out[3], const double a[3], const double b[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/* -1, 1, or 0 where the sign of a . b is in doubt. */
static int sign_of_dot(const double a[3], const double b[3])
{
    const double x = a[0] * b[0], y = a[1] * b[1], z = a[2] * b[2], sum = x + y + z;
    double bound = 0.0;

    for (int axis = 0; axis < 3; axis++)
        bound = fmax(bound, fabs(a[axis]));
    bound *= DOUBT * (fabs(b[0]) + fabs(b[1]) + fabs(b[2]));
    return (sum > bound) - (sum < -bound);
}

/* Whether direction d lies in the closed sector from a to b in their plane with normal n; in doubt it does. */
static int in_sector(const double d[3], const double a[3], const double b[3], const double n[3])
{
    double c[3];
    int s, t;

    cross(c, a, d);
    s = sign_of_dot(c, n);
    cross(c, d, b);
    t = sign_of_dot(c, n);
    if (s == 0 && t == 0) /* along both: only where the sector is flat */
        return 1;
    if (s == 0) /* along a: the same way, or the other */
        return a[0] * d[0] + a[1] * d[1] + a[2] * d[2] > 0.0;
    if (t == 0)
        return b[0] * d[0] + b[1] * d[1] + b[2] * d[2] > 0.0;
    return s > 0 && t > 0;
}

/* a, b: the two other vertices of each triangle less the common one. */
static int sectors_apart(double a[2][3], double b[2][3])
{
    double na[3], nb[3];
    int p[2], q[2];

    cross(na, a[0], a[1]);
    cross(nb, b[0], b[1]);
    for (int i = 0; i < 2; i++) {
        p[i] = sign_of_dot(b[i], na);
        q[i] = sign_of_dot(a[i], nb);
    }
    if (p[0] * p[1] > 0 || q[0] * q[1] > 0)
        return 1;
    if (p[0] && p[1] && q[0] && q[1]) /* both reach the line where the planes meet: on opposite rays, or not */
        return p[0] * q[0] > 0;
    for (int i = 0; i < 2; i++)
        if ((p[i] == 0 && in_sector(b[i], a[0], a[1], na)) || (q[i] == 0 && in_sector(a[i], b[0], b[1], nb)))
            return 0;
    return 1;
}

static int apart_along(const double axis[3], double a[3][3], double b[3][3])
{
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY}, reach = 0.0;

    for (int k = 0; k < 6; k++) {
        const double *v = k < 3 ? a[k] : b[k - 3];
        const double d = axis[0] * v[0] + axis[1] * v[1] + axis[2] * v[2];

        low[k / 3] = fmin(low[k / 3], d);
        high[k / 3] = fmax(high[k / 3], d);
        reach = fmax(reach, fabs(axis[0] * v[0]) + fabs(axis[1] * v[1]) + fabs(axis[2] * v[2]));
    }
    return high[0] < low[1] - DOUBT * reach || high[1] < low[0] - DOUBT * reach;
}

static int triangles_apart(double a[3][3], double b[3][3])
{
    double ea[3][3], eb[3][3], na[3], nb[3], axis[3];

    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 3; i++) {
            ea[k][i] = a[(k + 1) % 3][i] - a[k][i];
            eb[k][i] = b[(k + 1) % 3][i] - b[k][i];
        }
    cross(na, ea[0], ea[1]);
    cross(nb, eb[0], eb[1]);
    if (apart_along(na, a, b) || apart_along(nb, a, b))
        return 1;
    for (int k = 0; k < 9; k++) {
        cross(axis, ea[k / 3], eb[k % 3]);
        if (apart_along(axis, a, b))
            return 1;
    }
    for (int k = 0; k < 6; k++) { /* in one plane */
        cross(axis, k < 3 ? na : nb, k < 3 ? ea[k] : eb[k - 3]);
        if (apart_along(axis, a, b))
            return 1;
    }
    return 0;
}

/* Two triangles with a common edge overlap only when folded flat onto each other. */
static int fold_apart(const double edge[3], double apex_a[3], double apex_b[3])
{
    double na[3], nb[3];

    cross(na, edge, apex_a);
    cross(nb, edge, apex_b);
    return sign_of_dot(apex_b, na) != 0 || na[0] * nb[0] + na[1] * nb[1] + na[2] * nb[2] < 0.0;
}

static int pair_apart(const tree *t, uint32_t i, uint32_t j)
{
    const gn_mesh *mesh = t->mesh;
    const uint32_t *list = mesh->part_triangles + t->first_triangle;
    const uint32_t *a = mesh->triangles + 3 * (size_t)list[i], *b = mesh->triangles + 3 * (size_t)list[j];
    uint32_t va[3], vb[3]; /* common vertices first */
    double pa[3][3], pb[3][3];
    int common = 0, na = 0, nb = 0;

    for (int k = 0; k < 3; k++)
        for (int m = 0; m < 3; m++)
            if (a[k] == b[m])
                va[common] = vb[common] = a[k], common++;
    if (common == 3)
        return 0;
    na = nb = common;
    for (int k = 0; k < 3; k++) {
        int in_b = 0, in_a = 0;

        for (int m = 0; m < 3; m++) {
            in_b |= a[k] == b[m];
            in_a |= b[k] == a[m];
        }
        if (!in_b)
            va[na++] = a[k];
        if (!in_a)
            vb[nb++] = b[k];
    }
    for (int k = 0; k < 3; k++) /* relative to one vertex: exact, and small */
        for (int axis = 0; axis < 3; axis++) {
            const double origin = (double)mesh->positions[3 * (size_t)va[0] + (size_t)axis];

            pa[k][axis] = (double)mesh->positions[3 * (size_t)va[k] + (size_t)axis] - origin;
            pb[k][axis] = (double)mesh->positions[3 * (size_t)vb[k] + (size_t)axis] - origin;
        }
    if (common == 0)
        return triangles_apart(pa, pb);
    return common == 1 ? sectors_apart(pa + 1, pb + 1) : fold_apart(pa[1], pa[2], pb[2]);
}

static float key_of(const tree *t, uint32_t at, int axis)
{
    return t->box[t->order[at]][axis] + t->box[t->order[at]][axis + 3];
}

/* Hoare's selection: the middle element in its place, smaller ones before it. */
static void split(tree *t, uint32_t first, uint32_t end, uint32_t middle, int axis)
{
    while (end - first > 1) {
        const float pivot = key_of(t, first + (end - first - 1) / 2, axis); /* never the last: both sides keep some */
        uint32_t i = first, j = end - 1;

        for (;; i++, j--) {
            uint32_t swapped;

            while (key_of(t, i, axis) < pivot)
                i++;
            while (key_of(t, j, axis) > pivot)
                j--;
            if (i >= j)
                break;
            swapped = t->order[i];
            t->order[i] = t->order[j];
            t->order[j] = swapped;
        }
        if (middle <= j)
            end = j + 1;
        else
            first = j + 1;
    }
}

static uint32_t build(tree *t, uint32_t first, uint32_t end)
{
    const uint32_t index = t->node_count++;
    node *n = &t->nodes[index];
    int axis = 0;

    for (int i = 0; i < 3; i++) {
        n->box[i] = INFINITY;
        n->box[i + 3] = -INFINITY;
    }
    for (uint32_t at = first; at < end; at++) {
        const float *box = t->box[t->order[at]];

        for (int i = 0; i < 3; i++) {
            n->box[i] = fminf(n->box[i], box[i]);
            n->box[i + 3] = fmaxf(n->box[i + 3], box[i + 3]);
        }
    }
    n->first = first;
    n->count = end - first <= LEAF ? end - first : 0;
    n->right = 0;
    if (n->count)
        return index;
    for (int i = 1; i < 3; i++)
        if (n->box[i + 3] - n->box[i] > n->box[axis + 3] - n->box[axis])
            axis = i;
    split(t, first, end, first + (end - first) / 2, axis);
    build(t, first, first + (end - first) / 2);
    t->nodes[index].right = build(t, first + (end - first) / 2, end);
    return index;
}

static int meet(const float a[6], const float b[6])
{
    return a[0] <= b[3] && b[0] <= a[3] && a[1] <= b[4] && b[1] <= a[4] && a[2] <= b[5] && b[2] <= a[5];
}

static int spend(tree *t)
{
    t->budget -= t->budget > 0;
    return t->budget > 0;
}

/* 1 when everything below a is apart from everything below b; a may be b. */
static int nodes_apart(tree *t, uint32_t a, uint32_t b)
{
    const node *na = &t->nodes[a], *nb = &t->nodes[b];

    if (!spend(t))
        return 0;
    if (a != b && !meet(na->box, nb->box))
        return 1;
    if (na->count && nb->count) {
        for (uint32_t i = na->first; i < na->first + na->count; i++)
            for (uint32_t j = a == b ? i + 1 : nb->first; j < nb->first + nb->count; j++)
                if (meet(t->box[t->order[i]], t->box[t->order[j]]) &&
                    (!spend(t) || !pair_apart(t, t->order[i], t->order[j])))
                    return 0;
        return 1;
    }
    if (a == b)
        return nodes_apart(t, a + 1, a + 1) && nodes_apart(t, na->right, na->right) && nodes_apart(t, a + 1, na->right);
    if (na->count)
        return nodes_apart(t, a, b + 1) && nodes_apart(t, a, nb->right);
    return nodes_apart(t, a + 1, b) && nodes_apart(t, na->right, b);
}

int gni_part_is_embedded(const gn_mesh *mesh, const gni_part *part)
{
    gn_context *context = mesh->context;
    tree t = {mesh, NULL, NULL, NULL, 0, part->first_triangle, BUDGET * ((uint64_t)part->triangle_count + LEAF)};
    int result = -1;

    if (gni_part_is_star(mesh, part))
        return 1;
    t.box = gni_alloc(context, part->triangle_count, sizeof *t.box);
    t.order = gni_alloc(context, part->triangle_count, sizeof *t.order);
    t.nodes =
        gni_alloc(context, (size_t)part->triangle_count, sizeof *t.nodes); /* leaves hold two at least, or are alone */
    if (t.box && t.order && t.nodes) {
        for (uint32_t i = 0; i < part->triangle_count; i++) {
            const uint32_t *c = mesh->triangles + 3 * (size_t)mesh->part_triangles[part->first_triangle + i];

            t.order[i] = i;
            for (int axis = 0; axis < 3; axis++) {
                const float x = mesh->positions[3 * (size_t)c[0] + (size_t)axis];
                const float y = mesh->positions[3 * (size_t)c[1] + (size_t)axis];
                const float z = mesh->positions[3 * (size_t)c[2] + (size_t)axis];

                t.box[i][axis] = fminf(x, fminf(y, z));
                t.box[i][axis + 3] = fmaxf(x, fmaxf(y, z));
            }
        }
        build(&t, 0, part->triangle_count);
        result = nodes_apart(&t, 0, 0);
    }
    gni_free(context, t.nodes);
    gni_free(context, t.order);
    gni_free(context, t.box);
    return result;
}
