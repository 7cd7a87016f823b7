/* fan.c - the dark cap at infinity as a fan over the silhouette: a triangle an edge (McGuire 2003, section 6).
 *
 * The cap's shape does not matter there, since nothing is behind it, as long as it closes the volume. With the light
 * outside the caster's box all directions lie in an open half of the sphere, so that no triangle of the fan spans half
 * of it (DESIGN.md, decision 5; McGuire's trap). A fan about a vertex from which a silhouette turns back covers some
 * pixels three times for once. So the vertex taken is the one nearest to the middle as the light sees it, and only if
 * all edges run around it the same way: then the fan covers a direction exactly as often as the casting triangles
 * do. */
#include "gni.h"

#include <math.h>

/* From the light to a vertex. */
static void spoke(double out[3], const gn_mesh *mesh, uint32_t vertex, const double model_view[16],
                  const double light[4])
{
    gni_vertex(out, mesh, vertex, model_view);
    for (int k = 0; k < 3; k++)
        out[k] -= light[k];
}

uint32_t gni_find_apex(const gn_mesh *mesh, const int8_t *casting, const double model_view[16], const double light[4],
                       const gni_hull *box)
{
    double middle[3], hub[3], best = -INFINITY;
    uint32_t apex = GNI_NONE, edges = 0, triangles = 0;
    int sides_seen = 0;

    if (mesh->info.chunk_count != 1 || light[3] == 0.0)
        return GNI_NONE;
    for (int k = 0; k < 3; k++)
        middle[k] = 0.5 * (box->points[0][k] + box->points[7][k]) - light[k];
    for (uint32_t t = 0; t < mesh->info.triangle_count; t++) {
        triangles += casting[t] != 0;
        for (int k = 0; k < 3 && casting[t]; k++) {
            const uint32_t vertex = mesh->triangles[3 * (size_t)t + (size_t)k];
            double at[3], near_middle;

            spoke(at, mesh, vertex, model_view, light);
            near_middle = gni_dot(at, middle) / sqrt(gni_dot(at, at));
            if (near_middle > best) {
                best = near_middle;
                apex = vertex;
            }
        }
    }
    if (apex == GNI_NONE)
        return GNI_NONE;
    spoke(hub, mesh, apex, model_view, light);
    for (uint32_t e = 0; e < mesh->info.edge_count; e++) {
        const int32_t weight = gni_edge_weight(mesh, e, casting);
        const uint32_t use = mesh->uses[mesh->edge_uses[e]], corner = use & GNI_USE_CORNER;
        const uint32_t a = mesh->triangles[corner];
        const uint32_t b = mesh->triangles[gni_next_corner(corner)];
        double from[3], to[3], normal[3], side;

        if (weight == 0 || a == apex || b == apex)
            continue;
        edges += (uint32_t)(weight < 0 ? -weight : weight);
        spoke(from, mesh, a, model_view, light);
        spoke(to, mesh, b, model_view, light);
        gni_cross(normal, from, to);
        side = gni_dot(hub, normal) * ((weight > 0) == !(use & GNI_USE_DOWN) ? 1.0 : -1.0);
        sides_seen |= side > 0.0 ? 1 : 2;
        if (sides_seen == 3)
            return GNI_NONE;
    }
    return edges < triangles ? apex : GNI_NONE;
}
