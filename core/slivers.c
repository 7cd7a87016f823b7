/* slivers.c - which triangles of a light cap z-pass must draw when the host draws front faces only.
 *
 * z-pass needs no light cap where the caster is seen in its place. Of a closed caster seen from outside with all fronts
 * drawn that would be everywhere, since a back lies behind some front; but a triangle that is nearly edge-on may turn
 * over when a rasteriser rounds its vertices, be culled as a back, and leave a hole: there it counts, and so does each
 * back that is seen through it. So only those are left out that are drawn for sure: fronts whose image is higher than
 * rounding. Vertices are rounded to a sixteenth of a pixel at worst (OpenGL ES 2.0's least SUBPIXEL_BITS is 4): a
 * height of an eighth is safe.
 *
 * Backs lie behind fronts in the rounded image too, which is closed as the mesh is: at a fold that a sliver turns over
 * they may show for less than the rounding. A volume that ends, and so keeps to the truth but not to each bit of one
 * without end, does without them.
 *
 * Twice the area of a triangle's image at distance 1 is the product of its plane with the eye over the product of its
 * vertices' distances; over its longest side that is its height. */
#include "gni_plan.h"

#include <math.h>
#include <string.h>

#define HEIGHT 0.125 /* of a pixel */

int gni_find_slivers(const gni_draft *d, const gni_volume *v, double eye[4], double heights[2])
{
    const gn_camera *camera = &d->scene->camera;
    const gn_object *object = &d->scene->objects[v->object];
    const gn_mesh *mesh = object->mesh;
    const gni_hull *box = &d->boxes[v->object];
    const double pixels =
        fmin(d->whole[2] / (camera->right - camera->left), d->whole[3] / (camera->top - camera->bottom)) /
        d->plan->scale;
    static const double origin[3] = {0, 0, 0};
    double model_view[16], inverse[16], nearest = INFINITY, farthest = 0.0, longest = 0.0;

    if (camera->orthographic || !(object->flags & GN_DRAWN) || mesh->info.outward_part_count != mesh->info.part_count)
        return 0;
    for (int i = 0; i < 8; i++) {
        const double *p = box->points[i];

        nearest = fmin(nearest, -p[2]);
        farthest = fmax(farthest, -p[2]);
        longest = fmax(longest, sqrt(gni_dot(p, p)) / -p[2]);
    }
    gni_model_view(model_view, camera, object->model, mesh->info.centre);
    if (!(nearest > camera->znear * (1.0 + GNI_MARGIN)) || !gn_mat4_invert_affine(inverse, model_view))
        return 0;
    gn_mat4_transform(eye, inverse, origin, 1.0);
    eye[3] = 1.0;
    /* an edge's image is no longer than the edge over the least distance, seen under the widest angle */
    heights[1] = HEIGHT / pixels * mesh->longest_edge * gni_stretch(model_view) * longest / nearest * farthest *
                 farthest * farthest / fabs(gn_mat4_determinant3(object->model));
    heights[0] = v->extent->is_ended ? -heights[1] : -INFINITY;
    return isfinite(heights[1]);
}

uint32_t gni_put_slivers(const gn_mesh *mesh, uint32_t chunk_index, const gni_casting *c, const double eye[4],
                         const double heights[2], uint16_t *out)
{
    const gn_chunk *chunk = &mesh->chunks[chunk_index];
    const uint32_t end = (chunk->first_triangle + chunk->triangle_count + GNI_CLUSTER - 1) / GNI_CLUSTER;
    uint16_t *at = out;

    for (uint32_t cluster = chunk->first_triangle / GNI_CLUSTER; cluster < end; cluster++)
        for (uint64_t bits = c->bits[cluster]; bits; bits &= bits - 1) {
            const uint32_t t = cluster * GNI_CLUSTER + gni_lowest_bit(bits);
            const double *plane = mesh->planes + 4 * (size_t)t, height = gni_dot(plane, eye) + plane[3];

            if (height < heights[0] || height > heights[1])
                continue;
            memcpy(at, mesh->corners + 3 * (size_t)t, 4 * sizeof *at); /* one too many, which is written over */
            at += 3;
        }
    return (uint32_t)(at - out);
}
