/* volume.c - the index stream of a shadow volume: sides, dark cap, light cap.
 *
 * The casting triangles, turned towards the light, are the light cap; the same triangles moved away from the light and
 * reversed are the dark cap (DESIGN.md, decision 5); over every silhouette edge stands a side, as many times as its
 * multiplicity. Directed edges cancel in pairs, so the surface is closed, facing outward.
 *
 * Sides are found from the casting triangles alone, cluster by cluster: what lies across each of their edges casts the
 * same way, or not. A cluster of closed parts that casts whole has no silhouette but on its border; one that casts not
 * at all has none. Edges that more or fewer than two triangles share, or two that are wound unlike, are asked for their
 * weight.
 *
 * With a directional light and no end plane all far vertices are one point at infinity: a side is a single triangle,
 * and the dark cap has no area (McGuire 2003, section 6). The dark cap may be a fan over the silhouette instead, a
 * triangle an edge (fan.c says where).
 *
 * Order of a chunk's indices: light cap, sides, dark cap, near cap, turned light cap. The light cap keeps the drawn
 * order of its vertices: another order would give other depths (DESIGN.md, decision 4). */
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

/* A side over an edge along which the cap runs from a to b: it runs from b to a. */
static inline uint16_t *put_side(int converging, uint16_t a, uint16_t b, uint16_t *out)
{
    out[0] = b;
    out[1] = a;
    out[2] = (uint16_t)(a + 1u);
    if (converging)
        return out + 3;
    out[3] = b;
    out[4] = (uint16_t)(a + 1u);
    out[5] = (uint16_t)(b + 1u);
    return out + 6;
}

/* An edge whose triangles are not two neighbours: its first caster draws it, as often as the chain runs along it. */
static uint16_t *put_special(const side_maker *m, uint32_t corner, uint16_t from, uint16_t to, uint16_t *out)
{
    const gn_mesh *mesh = m->mesh;
    const uint32_t edge = mesh->edge_of[corner];
    int32_t weight;

    if (gni_first_caster(mesh, edge, m->casting) != corner)
        return out;
    weight = gni_edge_weight(mesh, edge, m->casting);
    for (uint32_t u = mesh->edge_uses[edge]; u < mesh->edge_uses[edge + 1]; u++)
        if ((mesh->uses[u] & GNI_USE_CORNER) == corner && mesh->uses[u] & GNI_USE_DOWN)
            weight = -weight;
    for (; weight > 0; weight--)
        out = put_side(m->converging, from, to, out);
    for (; weight < 0; weight++)
        out = put_side(m->converging, to, from, out);
    return out;
}

/* Where what lies across casts too, but turned unlike, or is not one triangle. */
static uint16_t *cross_rarely(const side_maker *m, uint32_t corner, uint32_t next, uint16_t *out)
{
    const uint16_t from = m->mesh->corners[corner], to = m->mesh->corners[next];
    const uint32_t other = m->mesh->across[corner];
    const int is_up = m->casting[corner / 3] > 0;

    if (m->casting[other] == GNI_UNLIKE)
        return put_special(m, corner, from, to, out);
    for (int i = 0; i < 2 && corner / 3 < other; i++) /* twice, by one of the two */
        out = put_side(m->converging, is_up ? from : to, is_up ? to : from, out);
    return out;
}

/* The edge of a casting triangle from its k-th corner on, where what lies across is cast unlike. */
static inline uint16_t *cross_over(const side_maker *m, uint32_t triangle, uint32_t k, int8_t across, uint16_t *out)
{
    const uint16_t *corners = m->mesh->corners + 3 * (size_t)triangle;
    const uint32_t next = k < 2 ? k + 1 : 0;
    const int is_up = m->casting[triangle] > 0;

    if (across != 0)
        return cross_rarely(m, 3 * triangle + k, 3 * triangle + next, out);
    return put_side(m->converging, corners[is_up ? k : next], corners[is_up ? next : k], out);
}

static uint32_t end_of(const gn_chunk *chunk)
{
    return (chunk->first_triangle + chunk->triangle_count + GNI_CLUSTER - 1) / GNI_CLUSTER;
}

static int is_whole(const gni_casting *c, uint32_t cluster)
{
    return GNI_HAS_CLUSTERS && c->is_plain && c->bits[cluster] == ~(uint64_t)0;
}

/* Of a cluster that casts whole. */
static uint16_t *walk_border(const side_maker *m, uint32_t cluster, uint16_t *out)
{
    const gn_mesh *mesh = m->mesh;
    const uint8_t *const end = mesh->borders + mesh->border_starts[cluster + 1];
    const uint32_t first = cluster * GNI_CLUSTER, *across = mesh->across + 3 * (size_t)first;
    const int8_t own = m->casting[first];

    for (const uint8_t *corner = mesh->borders + mesh->border_starts[cluster]; corner < end; corner++) {
        const int8_t other = m->casting[across[*corner]];

        if (other != own)
            out = cross_over(m, first + *corner / 3u, *corner % 3u, other, out);
    }
    return out;
}

/* Of the bits that cast. */
static uint16_t *walk_bits(const side_maker *m, uint32_t cluster, uint64_t bits, uint16_t *out)
{
    const uint32_t first = cluster * GNI_CLUSTER;
    const uint32_t *across = m->mesh->across + 3 * (size_t)first;
    const int8_t *casting = m->casting;

    for (; bits; bits &= bits - 1) {
        const size_t i = gni_lowest_bit(bits);
        const uint32_t *a = across + 3 * i;
        const int8_t own = casting[first + i];

        if (casting[a[0]] != own)
            out = cross_over(m, first + (uint32_t)i, 0, casting[a[0]], out);
        if (casting[a[1]] != own)
            out = cross_over(m, first + (uint32_t)i, 1, casting[a[1]], out);
        if (casting[a[2]] != own)
            out = cross_over(m, first + (uint32_t)i, 2, casting[a[2]], out);
    }
    return out;
}

uint32_t gni_put_sides(const gn_mesh *mesh, uint32_t chunk_index, const gni_casting *c, int converging, uint16_t *out)
{
    const gn_chunk *chunk = &mesh->chunks[chunk_index];
    const side_maker m = {mesh, c->of, converging};
    uint16_t *at = out;

    for (uint32_t cluster = chunk->first_triangle / GNI_CLUSTER; cluster < end_of(chunk); cluster++)
        at = is_whole(c, cluster) ? walk_border(&m, cluster, at) : walk_bits(&m, cluster, c->bits[cluster], at);
    return (uint32_t)(at - out);
}

uint32_t gni_put_dark_cap(const gn_mesh *mesh, uint32_t chunk_index, const gni_casting *c, uint16_t *out)
{
    const gn_chunk *chunk = &mesh->chunks[chunk_index];
    uint16_t *at = out;

    for (uint32_t cluster = chunk->first_triangle / GNI_CLUSTER; cluster < end_of(chunk); cluster++)
        for (uint64_t bits = c->bits[cluster]; bits; bits &= bits - 1) {
            const uint32_t i = gni_lowest_bit(bits);
            const uint16_t *v = mesh->corners + 3 * (size_t)(cluster * GNI_CLUSTER) + 3 * i;
            const int turned = c->of[cluster * GNI_CLUSTER + i] < 0;

            at = put(at, v[0] + 1u, v[2 - turned] + 1u, v[1 + turned] + 1u);
        }
    return (uint32_t)(at - out);
}

/* Four indices are copied for three: the one too many is written over, or belongs to the slack. */
static uint16_t *copy_corners(const uint16_t *corners, uint64_t bits, uint16_t *out)
{
    for (; bits; bits &= bits - 1, out += 3)
        memcpy(out, corners + 3 * gni_lowest_bit(bits), 4 * sizeof *out);
    return out;
}

static uint16_t *copy_turned(const uint16_t *corners, const gni_casting *c, uint32_t cluster, int8_t turn,
                             uint16_t *out)
{
    for (uint64_t bits = c->bits[cluster]; bits; bits &= bits - 1) {
        const uint32_t i = gni_lowest_bit(bits);

        memcpy(out, corners + 3 * i, 4 * sizeof *out);
        out += c->of[cluster * GNI_CLUSTER + i] == turn ? 3 : 0;
    }
    return out;
}

uint32_t gni_put_light_cap(const gn_mesh *mesh, uint32_t chunk_index, const gni_casting *c, int8_t turn, uint16_t *out)
{
    const gn_chunk *chunk = &mesh->chunks[chunk_index];
    uint16_t *at = out;

    if (GNI_HAS_CLUSTERS && c->is_plain && c->turn != turn)
        return 0;
    for (uint32_t cluster = chunk->first_triangle / GNI_CLUSTER; cluster < end_of(chunk); cluster++) {
        const uint32_t first = cluster * GNI_CLUSTER;
        const uint16_t *corners = mesh->corners + 3 * (size_t)first;

        if (is_whole(c, cluster)) {
            memcpy(at, corners, 3 * GNI_CLUSTER * sizeof *at);
            at += 3 * GNI_CLUSTER;
            continue;
        }
        at = GNI_HAS_CLUSTERS && c->is_plain ? copy_corners(corners, c->bits[cluster], at)
                                             : copy_turned(corners, c, cluster, turn, at);
    }
    return (uint32_t)(at - out);
}
