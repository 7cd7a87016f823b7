/* fan.c - the dark cap as a fan over the silhouette: a triangle an edge (McGuire 2003, section 6), about the mesh's
 * hub.
 *
 * On a plane a signed fan about any point closes the volume and counts what it encloses, however the silhouette is
 * tangled. At infinity the cap's shape does not matter either, since nothing is behind it; there all directions must
 * lie in an open half of the sphere, so that no triangle spans half of it (DESIGN.md, decision 5; McGuire's trap): the
 * light outside the caster's box is enough, the hub being inside. A fan about a point from which a silhouette turns
 * back covers some pixels three times for once: at infinity, where it would cover the image, it is taken only if all
 * edges run around the hub the same way, and then covers a direction exactly as often as the casting triangles do. */
#include "gni.h"

#include <math.h>

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
