/* truth_edges.c - silhouettes, and the pyramid that asks for those near one pixel.
 *
 * An edge is none of the silhouette if two triangles meet in it and lie on opposite sides of the plane through light
 * and edge: then one continues the other's shadow. All else counts: borders, folds, edges of three triangles and more,
 * edges of triangles that the light sees edge-on. Some of these bear no shadow edge, because both their sides are in
 * shadow anyway; truth_class.c finds that out by probing. What must not happen is that one is missed.
 *
 * Crow. Shadow Algorithms for Computer Graphics. SIGGRAPH 1977. */
#include "truth_edges.h"

#include <stdlib.h>
#include <string.h>

#include "truth_vec.h"

/* Open addressing over a power of two that leaves half the slots empty; 0 is an empty slot, n + 1 is item n. */
typedef struct table {
    uint32_t *slots;
    size_t mask;
} table;

static int table_make(table *t, size_t items)
{
    size_t size = 16;

    while (size < 2 * items)
        size *= 2;
    t->slots = calloc(size, sizeof *t->slots);
    t->mask = size - 1;
    return t->slots != NULL;
}

static uint64_t mixed(uint64_t h, uint64_t with)
{
    h = (h ^ with) * UINT64_C(0x9E3779B97F4A7C15);
    return h ^ (h >> 29);
}

static uint32_t welded(truth_edges *e, const table *t, const double v[3])
{
    uint64_t h = 0;
    size_t slot;

    for (int k = 0; k < 3; k++) {
        uint64_t bits;

        memcpy(&bits, &v[k], sizeof bits);
        h = mixed(h, bits);
    }
    for (slot = (size_t)h & t->mask; t->slots[slot] != 0; slot = (slot + 1) & t->mask)
        if (memcmp(e->vertices[t->slots[slot] - 1], v, sizeof e->vertices[0]) == 0)
            return t->slots[slot] - 1;
    memcpy(e->vertices[e->vertex_count], v, sizeof e->vertices[0]);
    t->slots[slot] = (uint32_t)++e->vertex_count;
    return t->slots[slot] - 1;
}

static void add_edge(truth_edges *e, const table *t, uint32_t a, uint32_t b, uint32_t apex)
{
    const uint32_t low = a < b ? a : b, high = a < b ? b : a;
    struct truth_edge *edge;
    size_t slot;

    for (slot = (size_t)mixed(mixed(0, low), high) & t->mask; t->slots[slot] != 0; slot = (slot + 1) & t->mask) {
        edge = &e->edges[t->slots[slot] - 1];
        if (edge->ends[0] == low && edge->ends[1] == high) {
            if (edge->uses < 2)
                edge->apex[edge->uses] = apex;
            edge->uses++;
            return;
        }
    }
    e->edges[e->edge_count] = (struct truth_edge){{low, high}, {apex, apex}, 1};
    t->slots[slot] = (uint32_t)++e->edge_count;
}

int truth_edges_build(truth_edges *out, const truth_rays *r)
{
    table vertex_table = {NULL, 0}, edge_table = {NULL, 0};
    size_t casting = 0;
    int ok = 0;

    memset(out, 0, sizeof *out);
    for (size_t i = 0; i < r->count; i++)
        casting += r->triangles[i].flags & TRUTH_CASTS ? 1 : 0;
    if (casting == 0)
        return 1;
    out->vertices = malloc(3 * casting * sizeof *out->vertices);
    out->edges = malloc(3 * casting * sizeof *out->edges);
    if (out->vertices && out->edges && table_make(&vertex_table, 3 * casting) && table_make(&edge_table, 3 * casting)) {
        for (size_t i = 0; i < r->count; i++) {
            const truth_triangle *f = &r->triangles[i];
            uint32_t v[3];

            if (!(f->flags & TRUTH_CASTS))
                continue;
            for (int c = 0; c < 3; c++)
                v[c] = welded(out, &vertex_table, f->v[c]);
            for (int c = 0; c < 3; c++)
                add_edge(out, &edge_table, v[c], v[(c + 1) % 3], v[(c + 2) % 3]);
        }
        ok = 1;
    }
    free(vertex_table.slots);
    free(edge_table.slots);
    if (!ok)
        truth_edges_free(out);
    return ok;
}

void truth_edges_free(truth_edges *e)
{
    free(e->vertices);
    free(e->edges);
    memset(e, 0, sizeof *e);
}

/* From p towards the light: all the way there, or the light's direction. */
static void to_lamp(double out[3], const truth_lamp *lamp, const double p[3])
{
    if (lamp->directional)
        memcpy(out, lamp->at, 3 * sizeof out[0]);
    else
        truth_sub(out, lamp->at, p);
}

/* On which side of the plane through light and edge the apex lies: -1, 1, or 0 where it cannot be told. */
static int side_of(const truth_lamp *lamp, const double a[3], const double b[3], const double apex[3])
{
    double along[3], up[3], to[3], n[3], d;

    truth_sub(along, b, a);
    truth_sub(to, apex, a);
    to_lamp(up, lamp, a);
    truth_cross(n, along, up);
    d = truth_dot(n, to);
    if (fabs(d) <= 1e-12 * truth_length(along) * truth_length(up) * truth_length(to))
        return 0;
    return d < 0.0 ? -1 : 1;
}

static int is_silhouette(const truth_edges *e, const struct truth_edge *edge, const truth_lamp *lamp)
{
    const double *a = e->vertices[edge->ends[0]], *b = e->vertices[edge->ends[1]];

    return edge->uses != 2 ||
           side_of(lamp, a, b, e->vertices[edge->apex[0]]) * side_of(lamp, a, b, e->vertices[edge->apex[1]]) >= 0;
}

int truth_silhouette_build(truth_silhouette *out, const truth_edges *e, const truth_lamp *lamp)
{
    double(*boxes)[6] = NULL, (*loose)[2][3] = NULL;
    size_t count = 0, used = 0;

    memset(out, 0, sizeof *out);
    out->lamp = *lamp;
    for (size_t i = 0; i < e->edge_count; i++)
        count += is_silhouette(e, &e->edges[i], lamp) ? 1 : 0;
    if (count == 0)
        return 1;
    out->segments = malloc(count * sizeof *out->segments);
    loose = malloc(count * sizeof *loose);
    boxes = malloc(count * sizeof *boxes);
    if (!out->segments || !loose || !boxes)
        goto failed;
    for (size_t i = 0; i < e->edge_count; i++) {
        if (!is_silhouette(e, &e->edges[i], lamp))
            continue;
        for (int end = 0; end < 2; end++)
            memcpy(loose[used][end], e->vertices[e->edges[i].ends[end]], sizeof loose[used][end]);
        for (int k = 0; k < 3; k++) {
            boxes[used][k] = fmin(loose[used][0][k], loose[used][1][k]);
            boxes[used][3 + k] = fmax(loose[used][0][k], loose[used][1][k]);
        }
        used++;
    }
    if (!truth_bvh_build(&out->bvh, (const double(*)[6])boxes, used))
        goto failed;
    for (size_t i = 0; i < used; i++)
        memcpy(out->segments[i], loose[out->bvh.order[i]], sizeof out->segments[i]);
    out->count = used;
    free(loose);
    free(boxes);
    return 1;

failed:
    free(loose);
    free(boxes);
    truth_silhouette_free(out);
    return 0;
}

void truth_silhouette_free(truth_silhouette *s)
{
    free(s->segments);
    truth_bvh_free(&s->bvh);
    memset(s, 0, sizeof *s);
}

void truth_project(double out[3], const truth_lamp *lamp, const truth_footprint *f, const double p[3])
{
    double from_centre[3], up[3];

    truth_sub(from_centre, p, f->centre);
    to_lamp(up, lamp, p);
    truth_along(out, p, -truth_dot(f->normal, from_centre) / truth_dot(f->normal, up), up);
}

/* Four sides through the light, and the receiver's plane, raised. */
static void pyramid(truth_plane out[5], const truth_lamp *lamp, const truth_footprint *f)
{
    double up[3];

    for (int i = 0; i < 4; i++) {
        double along[3], to_centre[3];

        truth_sub(along, f->corners[(i + 1) % 4], f->corners[i]);
        to_lamp(up, lamp, f->corners[i]);
        truth_cross(out[i].normal, along, up);
        truth_sub(to_centre, f->centre, f->corners[i]);
        if (truth_dot(out[i].normal, to_centre) < 0.0)
            for (int k = 0; k < 3; k++)
                out[i].normal[k] = -out[i].normal[k];
        out[i].least = truth_dot(out[i].normal, f->corners[i]);
    }
    to_lamp(up, lamp, f->centre);
    memcpy(out[4].normal, f->normal, sizeof out[4].normal);
    out[4].least = truth_dot(f->normal, f->centre) + 1e-3 * f->size * truth_dot(f->normal, up) / truth_length(up);
}

static int box_outside(const truth_bvh_node *n, const truth_plane planes[5])
{
    for (int i = 0; i < 5; i++) {
        double most = 0.0;

        for (int k = 0; k < 3; k++)
            most += planes[i].normal[k] * (double)n->box[planes[i].normal[k] > 0.0][k];
        if (most < planes[i].least)
            return 1;
    }
    return 0;
}

/* Cuts the segment down to what lies inside all planes; returns 0 if nothing does. */
static int clip(double out[2][3], const double segment[2][3], const truth_plane planes[5])
{
    double from = 0.0, to = 1.0, along[3];

    for (int i = 0; i < 5; i++) {
        const double a = truth_dot(planes[i].normal, segment[0]) - planes[i].least;
        const double b = truth_dot(planes[i].normal, segment[1]) - planes[i].least;

        if (a < 0.0 && b < 0.0)
            return 0;
        if (a < 0.0)
            from = fmax(from, a / (a - b));
        else if (b < 0.0)
            to = fmin(to, a / (a - b));
    }
    if (from > to)
        return 0;
    truth_sub(along, segment[1], segment[0]);
    truth_along(out[0], segment[0], from, along);
    truth_along(out[1], segment[0], to, along);
    return 1;
}

int truth_silhouette_within(const truth_silhouette *s, const truth_plane planes[5], truth_part_visitor each, void *user)
{
    uint32_t stack[TRUTH_BVH_STACK];
    int top = 0;

    if (s->count == 0)
        return 0;
    stack[top++] = 0;
    while (top > 0) {
        const truth_bvh_node *n = &s->bvh.nodes[stack[--top]];

        if (box_outside(n, planes))
            continue;
        if (n->count == 0) {
            stack[top++] = n->first + 1;
            stack[top++] = n->first;
            continue;
        }
        for (uint32_t i = n->first; i - n->first < n->count; i++) {
            double part[2][3];
            int answer;

            if (!clip(part, (const double(*)[3])s->segments[i], planes))
                continue;
            answer = each(user, part[0], part[1]);
            if (answer)
                return answer;
        }
    }
    return 0;
}

int truth_silhouette_cross(const truth_silhouette *s, const truth_footprint *f, truth_part_visitor each, void *user)
{
    truth_plane planes[5];

    pyramid(planes, &s->lamp, f);
    return truth_silhouette_within(s, planes, each, user);
}
