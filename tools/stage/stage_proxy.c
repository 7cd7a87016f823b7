/* stage_proxy.c - meshes of fewer triangles that cast in the place of finer ones: by meshoptimizer, which estimates how
 * far the new surface is from the old.
 *
 * Where a proxy stands out of what is seen, that is shadowed all over. So its vertices are moved inward by twice that
 * distance; its surface is then up to three times as far away, and a shadow's edge too. */
#include "stage.h"

#include <math.h>
#include <meshoptimizer.h>
#include <stdlib.h>
#include <string.h>

#define INWARD 2.0

/* positions: [vertex_count][3], of which the triangles use some. normals: the same, 0. */
static void move_inward(float *positions, float *normals, size_t vertex_count, const uint32_t *indices, size_t corners,
                        double distance)
{
    for (size_t i = 0; i < corners; i += 3) {
        const float *p[3];
        float n[3];

        for (size_t k = 0; k < 3; k++)
            p[k] = positions + 3 * (size_t)indices[i + k];
        for (int axis = 0; axis < 3; axis++) {
            const int y = (axis + 1) % 3, z = (axis + 2) % 3;

            n[axis] = (p[1][y] - p[0][y]) * (p[2][z] - p[0][z]) - (p[1][z] - p[0][z]) * (p[2][y] - p[0][y]);
        }
        for (size_t k = 0; k < 3; k++)
            for (size_t axis = 0; axis < 3; axis++)
                normals[3 * (size_t)indices[i + k] + axis] += n[axis];
    }
    for (size_t v = 0; v < vertex_count; v++) {
        const float *n = normals + 3 * v;
        const double length = sqrt((double)n[0] * n[0] + (double)n[1] * n[1] + (double)n[2] * n[2]);

        for (size_t axis = 0; axis < 3 && length > 0.0; axis++)
            positions[3 * v + axis] -= (float)(distance * (double)n[axis] / length);
    }
}

int stage_make_proxy(stage *s, const scene_mesh *m, stage_mesh *out)
{
    const size_t corners = 3 * (size_t)m->solid_triangle_count, stride = 3 * sizeof(float);
    uint32_t *welded, *fewer;
    float error = 0.0f, *moved, *normals;
    int ok = 1;

    if (s->proxy_triangles == 0 || m->solid_triangle_count <= s->proxy_triangles)
        return 1;
    welded = malloc(corners * sizeof *welded);
    fewer = malloc(corners * sizeof *fewer);
    moved = malloc(m->vertex_count * stride);
    normals = calloc(m->vertex_count, stride);
    if (welded && fewer && moved && normals) {
        gn_mesh_desc desc = {moved, m->vertex_count, 0, fewer, 0, s->weld_angle};

        /* vertices that differ in normals alone are one */
        meshopt_generateShadowIndexBuffer(welded, m->indices, corners, m->positions, m->vertex_count, stride, stride);
        desc.triangle_count = meshopt_simplify(fewer, welded, corners, m->positions, m->vertex_count, stride,
                                               3 * (size_t)s->proxy_triangles, 1.0f, 0, &error) /
                              3;
        out->proxy_error = (double)error * (double)meshopt_simplifyScale(m->positions, m->vertex_count, stride);
        memcpy(moved, m->positions, m->vertex_count * stride);
        move_inward(moved, normals, m->vertex_count, fewer, 3 * desc.triangle_count, INWARD * out->proxy_error);
        out->proxy_error *= 1.0 + INWARD;
        ok = gn_mesh_create(s->context, &desc, &out->proxy) == GN_OK && gn_gles_upload(s->gles, out->proxy) == GN_OK;
    } else {
        ok = 0;
    }
    free(welded);
    free(fewer);
    free(moved);
    free(normals);
    return ok;
}
