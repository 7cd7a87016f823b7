/* chunks.c - cuts a mesh so that 16-bit indices reach all of it.
 *
 * Triangles are taken in order until the next one would bring a chunk past GN_CHUNK_VERTICES distinct vertices. A
 * vertex that several chunks need is in each of them, and an edge belongs to the chunk of its first use, which has
 * both its vertices: so every index of a volume's chunk is local, and the chunks together draw the same triangles as
 * one would. */
#include "gni.h"

#include <string.h>

/* How many chunk vertices there are in all; with out != NULL writes everything. stamp, local: [vertex_count]. */
static void cut(gn_mesh *mesh, uint32_t *stamp, uint32_t *local, gn_chunk *chunks, uint32_t *chunk_count,
                uint32_t *vertices, uint32_t *vertex_count)
{
    uint32_t chunk = 0, first = 0, total = 0;
    gn_chunk now = {0, 0, 0, 0};

    memset(stamp, 0xff, mesh->info.vertex_count * sizeof *stamp);
    for (uint32_t t = 0; t < mesh->info.triangle_count; t++) {
        const uint32_t *c = mesh->triangles + 3 * (size_t)t;
        uint32_t fresh = 0;

        for (int k = 0; k < 3; k++)
            fresh += stamp[c[k]] != chunk;
        if (now.vertex_count + fresh > GN_CHUNK_VERTICES) {
            if (chunks)
                chunks[chunk] = now;
            chunk++;
            first += now.triangle_count;
            now = (gn_chunk){total, 0, first, 0};
        }
        for (int k = 0; k < 3; k++) {
            if (stamp[c[k]] != chunk) {
                stamp[c[k]] = chunk;
                local[c[k]] = now.vertex_count++;
                if (vertices)
                    vertices[total] = c[k];
                total++;
            }
            if (vertices)
                mesh->corners[3 * (size_t)t + (size_t)k] = (uint16_t)local[c[k]];
        }
        now.triangle_count++;
    }
    if (chunks)
        chunks[chunk] = now;
    *chunk_count = chunk + 1;
    *vertex_count = total;
}

uint32_t gni_chunk_of(const gn_mesh *mesh, uint32_t triangle)
{
    uint32_t low = 0, high = mesh->info.chunk_count - 1;

    while (low < high) {
        const uint32_t middle = (low + high + 1) / 2;

        if (mesh->chunks[middle].first_triangle <= triangle)
            low = middle;
        else
            high = middle - 1;
    }
    return low;
}

/* Edges in order of their chunks, each with its uses: a counting sort. */
static gn_result sort_edges(gn_mesh *mesh)
{
    gn_context *context = mesh->context;
    const uint32_t edges = mesh->info.edge_count, chunks = mesh->info.chunk_count;
    uint32_t *edge_uses = gni_alloc(context, (size_t)edges + 1, sizeof *edge_uses);
    uint32_t *uses = gni_alloc(context, mesh->edge_uses[edges], sizeof *uses);
    uint32_t *use_at = gni_alloc(context, (size_t)chunks + 1, sizeof *use_at);
    uint32_t *edge_at = mesh->chunk_edges;

    if (!edge_uses || !uses || !use_at) {
        gni_free(context, edge_uses);
        gni_free(context, uses);
        gni_free(context, use_at);
        return GN_E_MEMORY;
    }
    memset(edge_at, 0, ((size_t)chunks + 1) * sizeof *edge_at);
    memset(use_at, 0, ((size_t)chunks + 1) * sizeof *use_at);
    for (uint32_t e = 0; e < edges; e++) {
        const uint32_t c = gni_chunk_of(mesh, (mesh->uses[mesh->edge_uses[e]] & GNI_USE_CORNER) / 3);

        edge_at[c + 1]++;
        use_at[c + 1] += mesh->edge_uses[e + 1] - mesh->edge_uses[e];
    }
    for (uint32_t c = 0; c < chunks; c++) {
        edge_at[c + 1] += edge_at[c];
        use_at[c + 1] += use_at[c];
    }
    for (uint32_t e = 0; e < edges; e++) {
        const uint32_t c = gni_chunk_of(mesh, (mesh->uses[mesh->edge_uses[e]] & GNI_USE_CORNER) / 3);
        const uint32_t n = mesh->edge_uses[e + 1] - mesh->edge_uses[e];

        edge_uses[edge_at[c]++] = use_at[c];
        memcpy(uses + use_at[c], mesh->uses + mesh->edge_uses[e], n * sizeof *uses);
        use_at[c] += n;
    }
    edge_uses[edges] = mesh->edge_uses[edges];
    for (uint32_t c = chunks; c > 0; c--) /* filling moved each start to the next one's */
        edge_at[c] = edge_at[c - 1];
    edge_at[0] = 0;
    gni_free(context, use_at);
    gni_free(context, mesh->edge_uses);
    gni_free(context, mesh->uses);
    mesh->edge_uses = edge_uses;
    mesh->uses = uses;
    memset(mesh->edge_of, 0xff, 3 * (size_t)mesh->info.triangle_count * sizeof *mesh->edge_of);
    for (uint32_t e = 0; e < edges; e++)
        for (uint32_t u = edge_uses[e]; u < edge_uses[e + 1]; u++)
            mesh->edge_of[uses[u] & GNI_USE_CORNER] = e;
    return GN_OK;
}

gn_result gni_make_chunks(gn_mesh *mesh)
{
    gn_context *context = mesh->context;
    gn_mesh_info *info = &mesh->info;
    uint32_t *stamp = gni_alloc(context, info->vertex_count, sizeof *stamp);
    uint32_t *local = gni_alloc(context, info->vertex_count, sizeof *local);
    uint32_t chunk_vertex_count = 0;
    gn_result result = GN_E_MEMORY;

    if (stamp && local) {
        cut(mesh, stamp, local, NULL, &info->chunk_count, NULL, &chunk_vertex_count);
        mesh->chunks = gni_alloc(context, info->chunk_count, sizeof *mesh->chunks);
        mesh->chunk_edges = gni_alloc(context, (size_t)info->chunk_count + 1, sizeof *mesh->chunk_edges);
        mesh->chunk_vertices = gni_alloc(context, chunk_vertex_count, sizeof *mesh->chunk_vertices);
        mesh->corners = gni_alloc(context, info->triangle_count, 3 * sizeof *mesh->corners);
        mesh->edge_of = gni_alloc(context, info->triangle_count, 3 * sizeof *mesh->edge_of);
    }
    if (mesh->chunks && mesh->chunk_edges && mesh->chunk_vertices && mesh->corners && mesh->edge_of) {
        cut(mesh, stamp, local, mesh->chunks, &info->chunk_count, mesh->chunk_vertices, &chunk_vertex_count);
        result = sort_edges(mesh);
    }
    gni_free(context, stamp);
    gni_free(context, local);
    if (result == GN_E_MEMORY)
        return gn_fail(context, result, "mesh: no memory for the chunks of %lu vertices",
                       (unsigned long)info->vertex_count);
    return result;
}
