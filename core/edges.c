/* edges.c - every edge once, with all its uses by triangles and their directions.
 *
 * A mesh may have any number of triangles at an edge. Uses are bucketed by their lower vertex and each bucket sorted by
 * the higher, so that the uses of one edge stand together: O(uses) but for the sorting of single vertices' buckets. */
#include "gni.h"

#include <string.h>

typedef struct use {
    uint32_t high, code; /* the higher vertex; GNI_USE_* */
} use;

static int is_degenerate(const uint32_t t[3])
{
    return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

/* Shell's sort: buckets are mostly six or so long, and a fan's hub must not cost a square. Ties keep no order, so
 * the code decides them. */
static void sort_uses(use *u, size_t count)
{
    size_t gap = 1;

    while (gap < count / 3)
        gap = 3 * gap + 1;
    for (; gap > 0; gap /= 3)
        for (size_t i = gap; i < count; i++) {
            const use x = u[i];
            size_t j = i;

            for (; j >= gap &&
                   (u[j - gap].high > x.high ||
                    (u[j - gap].high == x.high && (u[j - gap].code & GNI_USE_CORNER) > (x.code & GNI_USE_CORNER)));
                 j -= gap)
                u[j] = u[j - gap];
            u[j] = x;
        }
}

/* starts: [vertex_count + 1]; sorted: [3 * triangle_count]. Returns how many uses there are. */
static uint32_t bucket_uses(const gn_mesh *mesh, uint32_t *starts, use *sorted)
{
    const gn_mesh_info *info = &mesh->info;
    uint32_t total = 0;

    memset(starts, 0, ((size_t)info->vertex_count + 1) * sizeof *starts);
    for (int pass = 0; pass < 2; pass++) {
        for (uint32_t t = 0; t < info->triangle_count; t++) {
            const uint32_t *corner = mesh->triangles + 3 * (size_t)t;

            if (is_degenerate(corner))
                continue;
            for (uint32_t k = 0; k < 3; k++) {
                const uint32_t a = corner[k], b = corner[(k + 1) % 3];
                const uint32_t low = a < b ? a : b;

                if (pass == 0)
                    starts[low]++;
                else
                    sorted[starts[low]++] = (use){a < b ? b : a, (3 * t + k) | (a < b ? 0 : GNI_USE_DOWN)};
            }
        }
        if (pass == 0)
            for (uint32_t v = 0; v <= info->vertex_count; v++) {
                const uint32_t n = starts[v];

                starts[v] = total;
                total += n;
            }
    }
    /* filling moved each start to its bucket's end, which is the next one's start */
    for (uint32_t v = 0; v < info->vertex_count; v++) {
        const uint32_t first = v ? starts[v - 1] : 0;

        sort_uses(sorted + first, starts[v] - first);
    }
    return total;
}

gn_result gni_make_edges(gn_mesh *mesh)
{
    gn_context *context = mesh->context;
    const gn_mesh_info *info = &mesh->info;
    const size_t most = 3 * (size_t)info->triangle_count;
    uint32_t *starts = gni_alloc(context, (size_t)info->vertex_count + 1, sizeof *starts);
    use *sorted = gni_alloc(context, most, sizeof *sorted);
    uint32_t total, edges = 0;

    mesh->uses = gni_alloc(context, most, sizeof *mesh->uses);
    mesh->edge_uses = gni_alloc(context, most + 1, sizeof *mesh->edge_uses);
    mesh->edge_of = gni_alloc(context, most, sizeof *mesh->edge_of);
    if (!starts || !sorted || !mesh->uses || !mesh->edge_uses || !mesh->edge_of) {
        gni_free(context, starts);
        gni_free(context, sorted);
        return gn_fail(context, GN_E_MEMORY, "mesh: no memory for the edges of %lu triangles",
                       (unsigned long)info->triangle_count);
    }
    total = bucket_uses(mesh, starts, sorted);
    for (uint32_t v = 0, u = 0; v < info->vertex_count; v++)
        for (const uint32_t first = u; u < starts[v]; u++) {
            if (u == first || sorted[u].high != sorted[u - 1].high)
                mesh->edge_uses[edges++] = u;
            mesh->uses[u] = sorted[u].code;
        }
    mesh->edge_uses[edges] = total;
    memset(mesh->edge_of, 0xff, most * sizeof *mesh->edge_of);
    for (uint32_t e = 0; e < edges; e++)
        for (uint32_t u = mesh->edge_uses[e]; u < mesh->edge_uses[e + 1]; u++)
            mesh->edge_of[mesh->uses[u] & GNI_USE_CORNER] = e;
    mesh->info.edge_count = edges;
    gni_free(context, starts);
    gni_free(context, sorted);
    return GN_OK;
}
