/* edges.c - every edge once, with all its uses by triangles and their directions.
 *
 * A mesh may have any number of triangles at an edge. Edges are found in a hash table by their two vertices and
 * numbered in order of their first use; uses of one stand together, in order of their corners. */
#include "gni.h"

#include <string.h>

/* While edges are found. counts stands one place on in edge_uses: of uses, then where the next use goes, which at
 * last is where the next edge starts. */
typedef struct finder {
    uint32_t *table; /* [mask + 1] edges, or GNI_NONE */
    uint32_t mask;
    uint64_t *keys; /* [3 * triangle_count] of each edge its lower vertex and its higher one */
    uint32_t *counts;
    uint32_t edge_count;
} finder;

static inline uint64_t key_of(uint32_t from, uint32_t to)
{
    return from < to ? (uint64_t)from << 32 | to : (uint64_t)to << 32 | from;
}

/* The edge between two vertices, new if it was not yet there. */
static inline uint32_t find_edge(finder *f, uint32_t from, uint32_t to)
{
    const uint64_t key = key_of(from, to);
    uint32_t slot = (uint32_t)(key * 0x9e3779b97f4a7c15u >> 32) & f->mask, edge;

    while ((edge = f->table[slot]) != GNI_NONE) {
        if (f->keys[edge] == key) {
            f->counts[edge]++;
            return edge;
        }
        slot = (slot + 1) & f->mask;
    }
    edge = f->edge_count++;
    f->table[slot] = edge;
    f->keys[edge] = key;
    f->counts[edge] = 1;
    return edge;
}

static void find_edges(gn_mesh *mesh, const finder *empty)
{
    const uint32_t triangles = mesh->info.triangle_count, *c = mesh->triangles;
    uint32_t *edges = mesh->edge_of;
    finder f = *empty;

    for (uint32_t t = 0; t < triangles; t++, c += 3, edges += 3) {
        const uint32_t x = c[0], y = c[1], z = c[2];

        if (x == y || y == z || z == x) {
            edges[0] = edges[1] = edges[2] = GNI_NONE;
            continue;
        }
        edges[0] = find_edge(&f, x, y);
        edges[1] = find_edge(&f, y, z);
        edges[2] = find_edge(&f, z, x);
    }
    mesh->info.edge_count = f.edge_count;
}

static void write_uses(gn_mesh *mesh)
{
    const uint32_t triangles = mesh->info.triangle_count, edge_count = mesh->info.edge_count;
    const uint32_t *c = mesh->triangles, *edges = mesh->edge_of;
    uint32_t *const next = mesh->edge_uses + 1, *const uses = mesh->uses;
    uint32_t total = 0;

    mesh->edge_uses[0] = 0;
    for (uint32_t e = 0; e < edge_count; e++) {
        const uint32_t count = next[e];

        next[e] = total;
        total += count;
    }
    for (uint32_t corner = 0; corner < 3 * triangles; corner += 3, c += 3, edges += 3) {
        const uint32_t x = c[0], y = c[1], z = c[2];

        if (edges[0] == GNI_NONE)
            continue;
        uses[next[edges[0]]++] = corner | (x > y ? GNI_USE_DOWN : 0);
        uses[next[edges[1]]++] = (corner + 1) | (y > z ? GNI_USE_DOWN : 0);
        uses[next[edges[2]]++] = (corner + 2) | (z > x ? GNI_USE_DOWN : 0);
    }
}

/* What lies across: of edges that two triangles alone share as neighbours do. */
static void write_across(gn_mesh *mesh)
{
    const uint32_t none = mesh->info.triangle_count, edge_count = mesh->info.edge_count;
    const uint32_t *const starts = mesh->edge_uses, *const uses = mesh->uses;
    uint32_t *const across = mesh->across, paired = 0;

    for (size_t i = 0; i < 3 * (size_t)none; i++)
        across[i] = none;
    for (uint32_t e = 0; e < edge_count; e++) {
        const uint32_t *u = uses + starts[e], a = u[0] & GNI_USE_CORNER, b = u[1] & GNI_USE_CORNER;

        if (starts[e + 1] - starts[e] != 2 || !((u[0] ^ u[1]) & GNI_USE_DOWN))
            continue;
        across[a] = b / 3;
        across[b] = a / 3;
        paired++;
    }
    mesh->odd_edge_count = edge_count - paired;
}

gn_result gni_make_edges(gn_mesh *mesh)
{
    gn_context *context = mesh->context;
    const gn_mesh_info *info = &mesh->info;
    const size_t most = 3 * (size_t)info->triangle_count;
    finder f = {NULL, 1, NULL, NULL, 0};
    int failed;

    while (f.mask < most + most / 2) /* of a closed mesh there are half as many */
        f.mask = 2 * f.mask + 1;
    f.table = gni_alloc(context, (size_t)f.mask + 1, sizeof *f.table);
    f.keys = gni_alloc(context, most, sizeof *f.keys);
    mesh->uses = gni_alloc(context, most + 1, sizeof *mesh->uses); /* the last may be read with one more */
    mesh->edge_uses = gni_alloc(context, most + 1, sizeof *mesh->edge_uses);
    mesh->edge_of = gni_alloc(context, most, sizeof *mesh->edge_of);
    mesh->across = gni_alloc(context, most, sizeof *mesh->across);
    failed = !f.table || !f.keys || !mesh->uses || !mesh->edge_uses || !mesh->edge_of || !mesh->across;
    if (!failed) {
        memset(f.table, 0xff, ((size_t)f.mask + 1) * sizeof *f.table);
        f.counts = mesh->edge_uses + 1;
        mesh->uses[most] = 0;
        find_edges(mesh, &f);
        write_uses(mesh);
        write_across(mesh);
    }
    gni_free(context, f.table);
    gni_free(context, f.keys);
    if (failed)
        return gn_fail(context, GN_E_MEMORY, "mesh: no memory for the edges of %lu triangles",
                       (unsigned long)info->triangle_count);
    return GN_OK;
}
