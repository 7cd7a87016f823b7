/* chunks.c - cuts a mesh so that 16-bit indices reach all of it.
 *
 * Clusters are taken in order until the next one would bring a chunk past GN_CHUNK_VERTICES distinct vertices. A vertex
 * that several chunks need is in each of them; a side is drawn by the chunk of a triangle that has its edge, and so has
 * both its vertices: every index of a volume's chunk is local, and the chunks together draw the same triangles as one
 * would. */
#include "gni.h"

#include <string.h>

/* While chunks are cut. */
typedef struct cutter {
    gn_mesh *mesh;
    uint32_t *chunk_of, *cluster_of; /* [vertex_count] the last chunk that has it; the last cluster that asked for it */
    uint32_t *local;                 /* [vertex_count] its number there */
} cutter;

/* Vertices of the cluster from `first` to `end` that the chunk has not yet. */
static uint32_t count_fresh(const cutter *c, uint32_t chunk, uint32_t first, uint32_t end)
{
    uint32_t fresh = 0;

    for (uint32_t i = 3 * first; i < 3 * end; i++) {
        const uint32_t v = c->mesh->triangles[i];

        if (c->chunk_of[v] != chunk && c->cluster_of[v] != first) {
            c->cluster_of[v] = first;
            fresh++;
        }
    }
    return fresh;
}

/* How many chunks and chunk vertices there are in all; with chunks != NULL writes everything. */
static void cut(const cutter *c, gn_chunk *chunks, uint32_t *chunk_count, uint32_t *vertices, uint32_t *vertex_count)
{
    gn_mesh *mesh = c->mesh;
    uint32_t chunk = 0, total = 0;
    gn_chunk now = {0, 0, 0, 0};

    memset(c->chunk_of, 0xff, mesh->info.vertex_count * sizeof *c->chunk_of);
    memset(c->cluster_of, 0xff, mesh->info.vertex_count * sizeof *c->cluster_of);
    for (uint32_t first = 0; first < mesh->info.triangle_count; first += GNI_CLUSTER) {
        const uint32_t rest = mesh->info.triangle_count - first,
                       end = first + (rest < GNI_CLUSTER ? rest : GNI_CLUSTER);

        if (now.vertex_count + 3 * GNI_CLUSTER > GN_CHUNK_VERTICES &&
            now.vertex_count + count_fresh(c, chunk, first, end) > GN_CHUNK_VERTICES) {
            if (chunks)
                chunks[chunk] = now;
            chunk++;
            now = (gn_chunk){total, 0, first, 0};
        }
        for (uint32_t i = 3 * first; i < 3 * end; i++) {
            const uint32_t v = mesh->triangles[i];

            if (c->chunk_of[v] != chunk) {
                c->chunk_of[v] = chunk;
                c->local[v] = now.vertex_count++;
                if (vertices)
                    vertices[total] = v;
                total++;
            }
            if (vertices)
                mesh->corners[i] = (uint16_t)(2 * c->local[v]);
        }
        now.triangle_count += end - first;
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

gn_result gni_make_chunks(gn_mesh *mesh)
{
    gn_context *context = mesh->context;
    gn_mesh_info *info = &mesh->info;
    uint32_t *const scratch = gni_alloc(context, info->vertex_count, 3 * sizeof *scratch);
    const cutter c = {mesh, scratch, scratch + info->vertex_count, scratch + 2 * (size_t)info->vertex_count};
    uint32_t chunk_vertex_count = 0;
    int failed = !scratch;

    if (!failed) {
        if (info->vertex_count <= GN_CHUNK_VERTICES) {
            info->chunk_count = 1;
            chunk_vertex_count = info->vertex_count; /* each is some triangle's */
        } else {
            cut(&c, NULL, &info->chunk_count, NULL, &chunk_vertex_count);
        }
        mesh->chunks = gni_alloc(context, info->chunk_count, sizeof *mesh->chunks);
        mesh->chunk_vertices = gni_alloc(context, chunk_vertex_count, sizeof *mesh->chunk_vertices);
        mesh->corners = gni_alloc(context, 3 * (size_t)info->triangle_count + 1, sizeof *mesh->corners);
        failed = !mesh->chunks || !mesh->chunk_vertices || !mesh->corners;
    }
    if (!failed) {
        mesh->corners[3 * (size_t)info->triangle_count] = 0; /* caps are copied four at a time */
        cut(&c, mesh->chunks, &info->chunk_count, mesh->chunk_vertices, &chunk_vertex_count);
    }
    gni_free(context, scratch);
    if (failed)
        return gn_fail(context, GN_E_MEMORY, "mesh: no memory for the chunks of %lu vertices",
                       (unsigned long)info->vertex_count);
    return GN_OK;
}
