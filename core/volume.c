/* volume.c - the index stream of a shadow volume: sides, dark cap, light cap.
 *
 * The casting triangles, turned towards the light, are the light cap; the same triangles moved away from the light and
 * reversed are the dark cap (DESIGN.md, decision 5); over every silhouette edge stands a side, as many times as its
 * multiplicity. Directed edges cancel in pairs, so the surface is closed, facing outward.
 *
 * Sides are found from the casting triangles alone, cluster by cluster: what lies across each of their edges casts the
 * same way, or not. A cluster of closed parts that casts whole has no silhouette but on its border; one that casts not at
 * all has none. Edges that more or fewer than two triangles share, or two that are wound unlike, are asked for their
 * weight.
 *
 * With a directional light and no end plane all far vertices are one point at infinity: a side is a single triangle,
 * and the dark cap has no area (McGuire 2003, section 6). The dark cap may be a fan over the silhouette instead, a
 * triangle an edge (fan.c says where).
 *
 * Order of a chunk's indices: sides, dark cap, light cap, turned light cap. The light cap keeps the drawn order of its
 * vertices: another order would give other depths (DESIGN.md, decision 4). */
#include "gni.h"

#include <string.h>

static uint16_t *put(uint16_t *out, uint32_t a, uint32_t b, uint32_t c)
{
    out[0] = (uint16_t)a;
    out[1] = (uint16_t)b;
    out[2] = (uint16_t)c;
    return out + 3;
}

typedef struct side_maker {
    const gn_mesh *mesh;
    const int8_t *casting;
    int converging;
} side_maker;

/* Sides over a corner's edge; the chain runs along it, or against it, so many times. */
static uint16_t *put_side(const side_maker *m, uint32_t corner, int32_t weight, uint16_t *out)
{
    const uint32_t from = m->mesh->corners[corner], to = m->mesh->corners[gni_next_corner(corner)];
    const uint32_t a = weight > 0 ? from : to, b = weight > 0 ? to : from;

    for (int32_t i = weight < 0 ? -weight : weight; i > 0; i--) {
        out = put(out, b, a, a + 1); /* the cap runs a to b, so the side b to a */
        if (!m->converging)
            out = put(out, b, a + 1, b + 1);
    }
    return out;
}

/* An edge whose triangles are not two neighbours: by its first caster. */
static uint16_t *put_special(const side_maker *m, uint32_t corner, uint32_t edge, uint16_t *out)
{
    const gn_mesh *mesh = m->mesh;
    int32_t weight;

    if (gni_first_caster(mesh, edge, m->casting) != corner)
        return out;
    weight = gni_edge_weight(mesh, edge, m->casting);
    for (uint32_t u = mesh->edge_uses[edge]; u < mesh->edge_uses[edge + 1]; u++)
        if ((mesh->uses[u] & GNI_USE_CORNER) == corner && mesh->uses[u] & GNI_USE_DOWN)
            weight = -weight;
    return put_side(m, corner, weight, out);
}

/* Of a casting triangle. */
static inline uint16_t *look_across(const side_maker *m, uint32_t triangle, uint32_t corner, uint16_t *out)
{
    const uint32_t other = m->mesh->across[corner];
    const int8_t own = m->casting[triangle];

    if (other < GNI_SPECIAL) {
        if (m->casting[other] == own)
            return out;
        if (m->casting[other] == 0)
            return put_side(m, corner, own, out);
        return triangle < other ? put_side(m, corner, 2 * own, out) : out; /* turned unlike: twice, by one of them */
    }
    return other == GNI_NOTHING ? out : put_special(m, corner, other & ~GNI_SPECIAL, out);
}

static uint32_t end_of(const gn_chunk *chunk)
{
    return (chunk->first_triangle + chunk->triangle_count + GNI_CLUSTER - 1) / GNI_CLUSTER;
}

static int is_whole(const gn_mesh *mesh, const gni_casting *c, uint32_t cluster)
{
    (void)mesh;
    return c->is_plain && c->bits[cluster] == ~(uint64_t)0;
}

uint32_t gni_put_sides(const gn_mesh *mesh, uint32_t chunk_index, const gni_casting *c, int converging, uint16_t *out)
{
    const gn_chunk *chunk = &mesh->chunks[chunk_index];
    const side_maker m = {mesh, c->of, converging};
    uint16_t *at = out;

    for (uint32_t cluster = chunk->first_triangle / GNI_CLUSTER; cluster < end_of(chunk); cluster++) {
        const uint32_t first = cluster * GNI_CLUSTER;

        if (is_whole(mesh, c, cluster)) {
            for (uint32_t b = mesh->border_starts[cluster]; b < mesh->border_starts[cluster + 1]; b++)
                at = look_across(&m, first + mesh->borders[b] / 3u, 3u * first + mesh->borders[b], at);
            continue;
        }
        for (uint64_t bits = c->bits[cluster]; bits; bits &= bits - 1) {
            const uint32_t t = first + gni_lowest_bit(bits);

            at = look_across(&m, t, 3 * t, at);
            at = look_across(&m, t, 3 * t + 1, at);
            at = look_across(&m, t, 3 * t + 2, at);
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

uint32_t gni_put_dark_cap(const gn_mesh *mesh, uint32_t chunk_index, const gni_casting *c, uint16_t *out)
{
    const gn_chunk *chunk = &mesh->chunks[chunk_index];
    uint16_t *at = out;

    for (uint32_t cluster = chunk->first_triangle / GNI_CLUSTER; cluster < end_of(chunk); cluster++)
        for (uint64_t bits = c->bits[cluster]; bits; bits &= bits - 1) {
            const uint32_t t = cluster * GNI_CLUSTER + gni_lowest_bit(bits);
            const uint16_t *v = mesh->corners + 3 * (size_t)t;

            at = c->of[t] > 0 ? put(at, v[0] + 1u, v[2] + 1u, v[1] + 1u) : put(at, v[0] + 1u, v[1] + 1u, v[2] + 1u);
        }
    return (uint32_t)(at - out);
}

uint32_t gni_put_light_cap(const gn_mesh *mesh, uint32_t chunk_index, const gni_casting *c, int8_t turn, uint16_t *out)
{
    const gn_chunk *chunk = &mesh->chunks[chunk_index];
    uint16_t *at = out;

    for (uint32_t cluster = chunk->first_triangle / GNI_CLUSTER; cluster < end_of(chunk); cluster++) {
        const uint32_t first = cluster * GNI_CLUSTER;

        if (c->is_plain && (c->bits[cluster] == 0 || c->of[first + gni_lowest_bit(c->bits[cluster])] != turn))
            continue;
        if (is_whole(mesh, c, cluster)) {
            memcpy(at, mesh->corners + 3 * (size_t)first, 3 * GNI_CLUSTER * sizeof *at);
            at += 3 * GNI_CLUSTER;
            continue;
        }
        for (uint64_t bits = c->bits[cluster]; bits; bits &= bits - 1) {
            const uint32_t t = first + gni_lowest_bit(bits);

            if (c->of[t] != turn)
                continue;
            memcpy(at, mesh->corners + 3 * (size_t)t, 4 * sizeof *at); /* one too many, which is written over */
            at += 3;
        }
    }
    return (uint32_t)(at - out);
}
