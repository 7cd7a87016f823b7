/* silhouette.c - where the casting triangles end.
 *
 * "One neighbour lit, the other not" has no answer for an edge with one triangle or three. So the casting triangles are
 * taken as a chain: each adds its direction along an edge, and what does not cancel is the silhouette, with its
 * multiplicity. A boundary has no boundary: that is why the swept sides close on any soup.
 *
 * Bergeron. A General Version of Crow's Shadow Volumes. IEEE CG&A 6(9), 1986. Kim, Kim, Turk. A Shadow-Volume
 * Algorithm for Opaque and Transparent Nonmanifold Casters. Journal of Graphics Tools 13(3), 2008. */
#include "gni.h"

/* As gni_edge_weight(), of casting in the order of the description. */
static int32_t weight_of(const gn_mesh *mesh, uint32_t edge, const int8_t *casting)
{
    int32_t weight = 0;

    for (uint32_t u = mesh->edge_uses[edge]; u < mesh->edge_uses[edge + 1]; u++) {
        const int8_t c = casting[mesh->order[(mesh->uses[u] & GNI_USE_CORNER) / 3]];

        weight += mesh->uses[u] & GNI_USE_DOWN ? -c : c;
    }
    return weight;
}

gn_result gn_silhouette(const gn_mesh *mesh, const int8_t *casting, gn_edge *edges, size_t capacity, size_t *count)
{
    size_t needed = 0;

    if (!mesh || !casting || !count || (!edges && capacity))
        return gn_fail(mesh ? mesh->context : NULL, GN_E_ARG, "gn_silhouette: NULL argument");
    for (uint32_t e = 0; e < mesh->info.edge_count; e++) {
        const int32_t weight = weight_of(mesh, e, casting);
        const uint32_t use = mesh->uses[mesh->edge_uses[e]], corner = use & GNI_USE_CORNER;
        const uint32_t from = mesh->triangles[corner];
        const uint32_t to = mesh->triangles[gni_next_corner(corner)];
        const int along = (weight > 0) == !(use & GNI_USE_DOWN); /* the chain runs as the first use does */

        if (weight != 0 && needed++ < capacity)
            edges[needed - 1] =
                (gn_edge){along ? from : to, along ? to : from, (uint32_t)(weight < 0 ? -weight : weight)};
    }
    *count = needed;
    if (needed > capacity)
        return gn_fail(mesh->context, GN_E_SPACE, "gn_silhouette: %lu edges, room for %lu", (unsigned long)needed,
                       (unsigned long)capacity);
    return GN_OK;
}
