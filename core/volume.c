/* volume.c - the index stream of a shadow volume: sides, dark cap, light cap.
 *
 * The casting triangles, turned towards the light, are the light cap; the same triangles moved away from the light and
 * reversed are the dark cap (DESIGN.md, decision 5); over every silhouette edge stands a side, as many times as its
 * multiplicity. Directed edges cancel in pairs, so the surface is closed, facing outward.
 *
 * With a directional light and no end plane all far vertices are one point at infinity: a side is a single triangle,
 * and the dark cap has no area (McGuire 2003, section 6). At infinity the dark cap may be a fan over the silhouette
 * instead, a triangle an edge (fan.c says where).
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

static uint16_t *put_sides(const gn_mesh *mesh, uint32_t chunk, const int8_t *casting, int converging, uint16_t *out)
{
    for (uint32_t e = mesh->chunk_edges[chunk]; e < mesh->chunk_edges[chunk + 1]; e++) {
        uint32_t a, b;

        for (int32_t m = silhouette_edge(mesh, e, casting, &a, &b); m > 0; m--) {
            out = put(out, b, a, a + 1); /* the cap runs a to b, so the side b to a */
            if (!converging)
                out = put(out, b, a + 1, b + 1);
        }
    }
    return out;
}

static uint16_t *put_fan(const gn_mesh *mesh, uint32_t chunk, const int8_t *casting, uint32_t apex, uint16_t *out)
{
    uint32_t hub = 0;

    while (mesh->chunk_vertices[mesh->chunks[chunk].first_vertex + hub] != apex)
        hub++;
    hub *= 2u;
    for (uint32_t e = mesh->chunk_edges[chunk]; e < mesh->chunk_edges[chunk + 1]; e++) {
        uint32_t a, b;

        for (int32_t m = silhouette_edge(mesh, e, casting, &a, &b); m > 0 && a != hub && b != hub; m--)
            out = put(out, hub + 1, b + 1, a + 1);
    }
    return out;
}

static uint16_t *put_dark_cap(const gn_mesh *mesh, const gn_chunk *chunk, const int8_t *casting, uint16_t *out)
{
    for (uint32_t t = chunk->first_triangle; t < chunk->first_triangle + chunk->triangle_count; t++) {
        const uint16_t *c = mesh->corners + 3 * (size_t)t;

        if (casting[t] > 0)
            out = put(out, 2u * c[0] + 1, 2u * c[2] + 1, 2u * c[1] + 1);
        else if (casting[t] < 0)
            out = put(out, 2u * c[0] + 1, 2u * c[1] + 1, 2u * c[2] + 1);
    }
    return out;
}

static uint16_t *put_light_cap(const gn_mesh *mesh, const gn_chunk *chunk, const int8_t *casting, int8_t turn,
                               uint16_t *out)
{
    for (uint32_t t = chunk->first_triangle; t < chunk->first_triangle + chunk->triangle_count; t++) {
        const uint16_t *c = mesh->corners + 3 * (size_t)t;

        if (casting[t] == turn)
            out = put(out, 2u * c[0], 2u * c[1], 2u * c[2]);
    }
    return out;
}

uint32_t gni_volume_indices(const gn_mesh *mesh, uint32_t chunk_index, const int8_t *casting, unsigned parts,
                            uint32_t apex, uint16_t *out, gni_stream *stream)
{
    const gn_chunk *chunk = &mesh->chunks[chunk_index];
    const int converging = (parts & GNI_CONVERGING) != 0;
    uint16_t *at = out;

    if (parts & GN_SIDES)
        at = put_sides(mesh, chunk_index, casting, converging, at);
    stream->sides = (uint32_t)(at - out);
    if (parts & GN_DARK_CAP && !converging)
        at = parts & GNI_FAN ? put_fan(mesh, chunk_index, casting, apex, at) : put_dark_cap(mesh, chunk, casting, at);
    stream->dark_cap = (uint32_t)(at - out) - stream->sides;
    if (parts & GN_LIGHT_CAP)
        at = put_light_cap(mesh, chunk, casting, 1, at);
    stream->light_cap = (uint32_t)(at - out) - stream->sides - stream->dark_cap;
    if (parts & GN_LIGHT_CAP)
        at = put_light_cap(mesh, chunk, casting, -1, at);
    stream->turned_cap = (uint32_t)(at - out) - stream->sides - stream->dark_cap - stream->light_cap;
    return (uint32_t)(at - out);
}
