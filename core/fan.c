/* fan.c - the dark cap over the silhouette (McGuire 2003, section 6, the fan over O(s)), about a triangle an edge.
 *
 * On a plane any triangles whose border is the silhouette close the volume and count what it encloses, however tangled
 * it is. A fan about one point makes them all as long as the cap is wide, and of a fine mesh less than a pixel thin:
 * rasterisers pay for the blocks of pixels that each of them touches. So the silhouette is walked in loops, and of a
 * loop every other vertex is cut off, again and again until two are left: half of the triangles are as small as its
 * edges, a quarter twice that. Loops of a mesh in several chunks are open in each; what joins their ends is a triangle
 * about the mesh's hub, the same point in all chunks.
 *
 * At infinity the cap's shape does not matter either, since nothing is behind it; there all directions must lie in an
 * open half of the sphere, so that no triangle spans half of it (DESIGN.md, decision 5; McGuire's trap): the light
 * outside the caster's box is enough, the hub being inside. A silhouette that turns back may be covered more often than
 * it encloses: at infinity, where that would cover the image, it is taken only if all edges run around the hub the same
 * way. */
#include "gni.h"

#include <math.h>

static inline uint16_t *put(uint16_t *out, uint16_t a, uint16_t b, uint16_t c)
{
    out[0] = a;
    out[1] = b;
    out[2] = c;
    return out + 3;
}

/* Cuts every other vertex off a loop, until two are left. */
static uint16_t *span_loop(uint16_t *loop, uint32_t count, uint16_t *out)
{
    while (count > 2) {
        const uint16_t *from = loop, *const last = loop + count - 1;
        uint16_t *kept = loop;

        for (; from + 1 < last; from += 2) {
            out = put(out, from[0], from[1], from[2]);
            *kept++ = from[0];
        }
        if (from < last)
            out = put(out, from[0], from[1], loop[0]);
        *kept++ = from[0];
        count = (uint32_t)(kept - loop);
    }
    return out;
}

uint32_t gni_put_fan(const gn_mesh *mesh, uint32_t chunk, const uint16_t *sides, uint32_t count, uint32_t of_a_side,
                     const gni_walk *w, uint16_t *out)
{
    const uint16_t hub = (uint16_t)(2u * mesh->chunks[chunk].vertex_count + 1u), *const end = sides + count;
    uint32_t *const first = w->first, *const next = w->next, left = 0;
    uint16_t *const loop = w->loop, *const start = out;

    for (const uint16_t *side = sides; side < end; side += of_a_side, left++) {
        next[left] = first[side[0] / 2u];
        first[side[0] / 2u] = left;
    }
    for (const uint16_t *side = sides; left > 0; side += of_a_side)
        while (first[side[0] / 2u] != GNI_NONE) {
            uint32_t vertex = side[0], edge = first[vertex / 2u], length = 0;

            do {
                loop[length++] = (uint16_t)(vertex + 1u);
                first[vertex / 2u] = next[edge];
                vertex = sides[(size_t)edge * of_a_side + 1];
                edge = first[vertex / 2u];
            } while (vertex != side[0] && edge != GNI_NONE);
            left -= length;
            if (vertex != side[0]) {
                loop[length++] = (uint16_t)(vertex + 1u);
                out = put(out, hub, (uint16_t)(side[0] + 1u), (uint16_t)(vertex + 1u));
            }
            out = span_loop(loop, length, out);
        }
    return (uint32_t)(out - start);
}

void gni_put_near_fan(const uint16_t *fan, uint32_t count, uint16_t *out)
{
    for (uint32_t i = 0; i < count; i += 3) {
        out[i] = (uint16_t)(fan[i] - 1u);
        out[i + 1] = (uint16_t)(fan[i + 2] - 1u);
        out[i + 2] = (uint16_t)(fan[i + 1] - 1u);
    }
}

/* From the light to a point of the mesh. */
static void spoke(double out[3], const float point[3], const double model_view[16], const double light[4])
{
    const double given[3] = {(double)point[0], (double)point[1], (double)point[2]};

    gn_mat4_transform(out, model_view, given, 1.0);
    for (int k = 0; k < 3; k++)
        out[k] -= light[k];
}

int gni_runs_round_hub(const gn_mesh *mesh, uint32_t chunk, const uint16_t *sides, uint32_t count, uint32_t of_a_side,
                       const double model_view[16], const double light[4])
{
    const uint32_t *vertices = mesh->chunk_vertices + mesh->chunks[chunk].first_vertex;
    double hub[3];
    int ways = 0;

    spoke(hub, mesh->info.hub, model_view, light);
    for (uint32_t i = 0; i < count && ways != 3; i += of_a_side) {
        double from[3], to[3], normal[3];

        spoke(from, mesh->positions + 3 * (size_t)vertices[sides[i] / 2u], model_view, light);
        spoke(to, mesh->positions + 3 * (size_t)vertices[sides[i + 1] / 2u], model_view, light);
        gni_cross(normal, from, to);
        ways |= gni_dot(hub, normal) > 0.0 ? 1 : 2;
    }
    return ways != 3;
}
