/* facing.c - which triangles show their fronts to a light, and which their backs: a bit each.
 *
 * The truth of a bit is the sign of one expression in double (DESIGN.md, decision 1). facing_floats.c finds the same
 * bits faster. */
#include "gni.h"

static int exact_side(const double plane[4], const double light[4])
{
    const double side = plane[0] * light[0] + plane[1] * light[1] + plane[2] * light[2] + plane[3] * light[3];

    return (side > 0.0) - (side < 0.0);
}

void gni_look_closely(const gn_mesh *mesh, uint32_t cluster, const double light[4], uint64_t *front, uint64_t *back)
{
    *front = *back = 0;
    for (uint32_t i = 0; i < GNI_CLUSTER && cluster * GNI_CLUSTER + i < mesh->info.triangle_count; i++) {
        const int side = exact_side(mesh->facing_planes + 4 * (size_t)(cluster * GNI_CLUSTER + i), light);

        *front |= (uint64_t)(side > 0) << i;
        *back |= (uint64_t)(side < 0) << i;
    }
}

uint32_t gni_find_facing(const gn_mesh *mesh, const double light[4], uint64_t *front, uint64_t *back)
{
    if (GNI_HAS_CLUSTERS)
        return gni_search_facing(mesh, light, front, back);
    for (uint32_t c = 0; c < mesh->cluster_count; c++)
        gni_look_closely(mesh, c, light, &front[c], &back[c]);
    return mesh->info.triangle_count;
}
