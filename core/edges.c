/* edges.c - every edge once, with all its uses by triangles and their directions.
 *
 * A mesh may have any number of triangles at an edge. Uses are bucketed by their lower vertex and each bucket sorted by
 * the higher, so that the uses of one edge stand together: O(uses) but for the sorting of single vertices' buckets. */
#include "gni.h"

#include <string.h>

/* A use in a bucket: the higher vertex, the corner, and whether it runs down, as one number, so that those of one edge
 * stand together in order of their corners. */
typedef uint64_t use;

static inline use make_use(uint32_t high, uint32_t corner, int is_down)
{
    return (uint64_t)high << 32 | (uint64_t)corner << 1 | (uint64_t)is_down;
}

static inline uint32_t high_of(use u)
{
    return (uint32_t)(u >> 32);
}

static inline uint32_t code_of(use u)
{
    return (uint32_t)(u & 0xffffffffu) >> 1 | (u & 1 ? GNI_USE_DOWN : 0);
}

/* Shell's sort: buckets are mostly six or so long, and a fan's hub must not cost a square. */
static void sort_uses(use *u, size_t count)
{
    size_t gap = 1;

    while (gap < count / 3)
        gap = 3 * gap + 1;
    for (; gap > 0; gap /= 3)
        for (size_t i = gap; i < count; i++) {
            const use x = u[i];
            size_t j = i;

            for (; j >= gap && u[j - gap] > x; j -= gap)
                u[j] = u[j - gap];
            u[j] = x;
        }
}

/* starts: [vertex_count + 1], all 0; on return where each bucket ends. sorted: [3 * triangle_count]. */
static void bucket_uses(const gn_mesh *mesh, uint32_t *starts, use *sorted)
{
    const gn_mesh_info *info = &mesh->info;
    uint32_t total = 0;

    for (uint32_t t = 0; t < info->triangle_count; t++) {
        const uint32_t *c = mesh->triangles + 3 * (size_t)t, a = c[0], b = c[1], d = c[2];

        if (a == b || b == d || d == a)
            continue;
        starts[a < b ? a : b]++;
        starts[b < d ? b : d]++;
        starts[d < a ? d : a]++;
    }
    for (uint32_t v = 0; v <= info->vertex_count; v++) {
        const uint32_t n = starts[v];

        starts[v] = total;
        total += n;
    }
    for (uint32_t t = 0; t < info->triangle_count; t++) {
        const uint32_t *c = mesh->triangles + 3 * (size_t)t, a = c[0], b = c[1], d = c[2];

        if (a == b || b == d || d == a)
            continue;
        sorted[starts[a < b ? a : b]++] = make_use(a < b ? b : a, 3 * t, a > b);
        sorted[starts[b < d ? b : d]++] = make_use(b < d ? d : b, 3 * t + 1, b > d);
        sorted[starts[d < a ? d : a]++] = make_use(d < a ? a : d, 3 * t + 2, d > a);
    }
    /* filling moved each start to its bucket's end, which is the next one's start */
    for (uint32_t v = 0; v < info->vertex_count; v++) {
        const uint32_t first = v ? starts[v - 1] : 0;

        sort_uses(sorted + first, starts[v] - first);
    }
}

/* Edge by edge from sorted buckets, which end at `ends`; what lies across too. Returns the number of edges. */
static uint32_t write_edges(gn_mesh *mesh, const use *sorted, const uint32_t *ends)
{
    uint32_t edges = 0, total = 0;

    for (uint32_t v = 0, u = 0, end; v < mesh->info.vertex_count; total = ends[v], v++)
        for (; u < ends[v]; u = end, edges++) {
            mesh->edge_uses[edges] = u;
            for (end = u; end < ends[v] && high_of(sorted[end]) == high_of(sorted[u]); end++) {
                mesh->uses[end] = code_of(sorted[end]);
                mesh->edge_of[(sorted[end] & 0xffffffffu) >> 1] = edges;
            }
            if (end - u == 2 && (sorted[u] ^ sorted[u + 1]) & 1) {
                const uint32_t a = (uint32_t)(sorted[u] & 0xffffffffu) >> 1,
                               b = (uint32_t)(sorted[u + 1] & 0xffffffffu) >> 1;

                mesh->across[a] = b / 3;
                mesh->across[b] = a / 3;
            }
        }
    mesh->edge_uses[edges] = total;
    return edges;
}

gn_result gni_make_edges(gn_mesh *mesh)
{
    gn_context *context = mesh->context;
    const gn_mesh_info *info = &mesh->info;
    const size_t most = 3 * (size_t)info->triangle_count;
    uint32_t *starts = gni_alloc(context, (size_t)info->vertex_count + 1, sizeof *starts);
    use *sorted = gni_alloc(context, most, sizeof *sorted);
    int failed;

    mesh->uses = gni_alloc(context, most, sizeof *mesh->uses);
    mesh->edge_uses = gni_alloc(context, most + 1, sizeof *mesh->edge_uses);
    mesh->edge_of = gni_alloc(context, most, sizeof *mesh->edge_of);
    mesh->across = gni_alloc(context, most, sizeof *mesh->across);
    failed = !starts || !sorted || !mesh->uses || !mesh->edge_uses || !mesh->edge_of || !mesh->across;
    if (!failed) {
        memset(starts, 0, ((size_t)info->vertex_count + 1) * sizeof *starts);
        memset(mesh->edge_of, 0xff, most * sizeof *mesh->edge_of);
        for (size_t i = 0; i < most; i++)
            mesh->across[i] = info->triangle_count;
        bucket_uses(mesh, starts, sorted);
        mesh->info.edge_count = write_edges(mesh, sorted, starts);
    }
    gni_free(context, starts);
    gni_free(context, sorted);
    if (failed)
        return gn_fail(context, GN_E_MEMORY, "mesh: no memory for the edges of %lu triangles",
                       (unsigned long)info->triangle_count);
    return GN_OK;
}
