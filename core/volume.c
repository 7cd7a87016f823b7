/* volume.c - the index stream of a shadow volume: sides, dark cap, light cap.
 *
 * The casting triangles, turned towards the light, are the light cap; the same triangles moved away from the light and
 * reversed are the dark cap (DESIGN.md, decision 5); over every silhouette edge stands a side, as many times as its
 * multiplicity. Directed edges cancel in pairs, so the surface is closed, facing outward.
 *
 * With a directional light and no end plane all far vertices are one point at infinity: a side is a single triangle,
 * and the dark cap has no area (McGuire 2003, section 5).
 *
 * Order of a chunk's indices: sides, dark cap, light cap, turned light cap. The light cap keeps the drawn order of its
 * vertices: another order would give other depths (DESIGN.md, decision 4). */
#include "gni.h"

size_t gni_volume_bound(const gn_mesh *mesh)
{
    /* a triangle brings at most three sides of two triangles each, and is in both caps */
    return (size_t)mesh->info.triangle_count * (3 * 6 + 3 + 3);
}

static uint16_t *put(uint16_t *out, uint32_t a, uint32_t b, uint32_t c)
{
    out[0] = (uint16_t)a;
    out[1] = (uint16_t)b;
    out[2] = (uint16_t)c;
    return out + 3;
}

static uint16_t *put_sides(const gn_mesh *mesh, uint32_t chunk, const int8_t *casting, int converging, uint16_t *out)
{
    for (uint32_t e = mesh->chunk_edges[chunk]; e < mesh->chunk_edges[chunk + 1]; e++) {
        const int32_t weight = gni_edge_weight(mesh, e, casting);
        uint32_t use, corner, a, b;

        if (weight == 0)
            continue;
        use = mesh->uses[mesh->edge_uses[e]];
        corner = use & GNI_USE_CORNER;
        a = 2u * mesh->corners[corner];
        b = 2u * mesh->corners[corner % 3 == 2 ? corner - 2 : corner + 1];
        if ((weight > 0) != !(use & GNI_USE_DOWN)) {
            const uint32_t swapped = a;

            a = b;
            b = swapped;
        }
        for (int32_t m = weight < 0 ? -weight : weight; m > 0; m--) { /* the cap runs a to b, so the side b to a */
            out = put(out, b, a, a + 1);
            if (!converging)
                out = put(out, b, a + 1, b + 1);
        }
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
                            int converging, uint16_t *out, gni_stream *stream)
{
    const gn_chunk *chunk = &mesh->chunks[chunk_index];
    uint16_t *const sides = out, *dark_cap, *light_cap, *turned_cap, *end;

    dark_cap = parts & GN_SIDES ? put_sides(mesh, chunk_index, casting, converging, sides) : sides;
    light_cap = parts & GN_DARK_CAP && !converging ? put_dark_cap(mesh, chunk, casting, dark_cap) : dark_cap;
    turned_cap = parts & GN_LIGHT_CAP ? put_light_cap(mesh, chunk, casting, 1, light_cap) : light_cap;
    end = parts & GN_LIGHT_CAP ? put_light_cap(mesh, chunk, casting, -1, turned_cap) : turned_cap;
    stream->sides = (uint32_t)(dark_cap - sides);
    stream->dark_cap = (uint32_t)(light_cap - dark_cap);
    stream->light_cap = (uint32_t)(turned_cap - light_cap);
    stream->turned_cap = (uint32_t)(end - turned_cap);
    return (uint32_t)(end - out);
}
