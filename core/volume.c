/* volume.c - the index stream of a shadow volume: sides, dark cap, light cap.
 *
 * The casting triangles, turned towards the light, are the light cap; the same triangles moved away from the light and
 * reversed are the dark cap (DESIGN.md, decision 5); over every silhouette edge stands a side, as many times as its
 * multiplicity. Directed edges cancel in pairs, so the surface is closed, facing outward.
 *
 * With a directional light and no end plane all far vertices are one point at infinity: a side is a single triangle,
 * and the dark cap has no area (McGuire 2003, section 6). The dark cap may be a fan over the silhouette instead, a
 * triangle an edge (fan.c says where).
 *
 * Order of a chunk's indices: sides, dark cap, light cap, turned light cap. The light cap keeps the drawn order of its
 * vertices: another order would give other depths (DESIGN.md, decision 4). */
#include "gni.h"

static uint16_t *put(uint16_t *out, uint32_t a, uint32_t b, uint32_t c)
{
    out[0] = (uint16_t)a;
    out[1] = (uint16_t)b;
    out[2] = (uint16_t)c;
    return out + 3;
}

/* How often the chain runs along an edge of a chunk, and from which near vertex to which. */
static int32_t silhouette_edge(const gn_mesh *mesh, uint32_t edge, const int8_t *casting, uint32_t *a, uint32_t *b)
{
    const int32_t weight = gni_edge_weight(mesh, edge, casting);
    const uint32_t use = mesh->uses[mesh->edge_uses[edge]], corner = use & GNI_USE_CORNER;
    const uint32_t from = 2u * mesh->corners[corner];
    const uint32_t to = 2u * mesh->corners[gni_next_corner(corner)];
    const int along = (weight > 0) == !(use & GNI_USE_DOWN);

    *a = along ? from : to;
    *b = along ? to : from;
    return weight < 0 ? -weight : weight;
}

uint32_t gni_put_sides(const gn_mesh *mesh, uint32_t chunk, const int8_t *casting, int converging, uint16_t *out)
{
    uint16_t *at = out;

    for (uint32_t e = mesh->chunk_edges[chunk]; e < mesh->chunk_edges[chunk + 1]; e++) {
        uint32_t a, b;

        for (int32_t m = silhouette_edge(mesh, e, casting, &a, &b); m > 0; m--) {
            at = put(at, b, a, a + 1); /* the cap runs a to b, so the side b to a */
            if (!converging)
                at = put(at, b, a + 1, b + 1);
        }
    }
    return (uint32_t)(at - out);
}

uint32_t gni_put_fan(const gn_mesh *mesh, uint32_t chunk, const uint16_t *sides, uint32_t count, uint32_t of_a_side,
                     uint16_t *out)
{
    const uint32_t hub = 2u * mesh->chunks[chunk].vertex_count + 1u;
    uint16_t *at = out;

    for (uint32_t i = 0; i < count; i += of_a_side)
        at = put(at, hub, sides[i] + 1u, sides[i + 1] + 1u);
    return (uint32_t)(at - out);
}

uint32_t gni_put_dark_cap(const gn_mesh *mesh, uint32_t chunk_index, const int8_t *casting, uint16_t *out)
{
    const gn_chunk *chunk = &mesh->chunks[chunk_index];
    uint16_t *at = out;

    for (uint32_t t = chunk->first_triangle; t < chunk->first_triangle + chunk->triangle_count; t++) {
        const uint16_t *c = mesh->corners + 3 * (size_t)t;

        if (casting[t] > 0)
            at = put(at, 2u * c[0] + 1, 2u * c[2] + 1, 2u * c[1] + 1);
        else if (casting[t] < 0)
            at = put(at, 2u * c[0] + 1, 2u * c[1] + 1, 2u * c[2] + 1);
    }
    return (uint32_t)(at - out);
}

uint32_t gni_put_light_cap(const gn_mesh *mesh, uint32_t chunk_index, const int8_t *casting, int8_t turn, uint16_t *out)
{
    const gn_chunk *chunk = &mesh->chunks[chunk_index];
    uint16_t *at = out;

    for (uint32_t t = chunk->first_triangle; t < chunk->first_triangle + chunk->triangle_count; t++) {
        const uint16_t *c = mesh->corners + 3 * (size_t)t;

        if (casting[t] == turn)
            at = put(at, 2u * c[0], 2u * c[1], 2u * c[2]);
    }
    return (uint32_t)(at - out);
}
