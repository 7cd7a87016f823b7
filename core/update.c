/* update.c - a mesh in a new shape: all that its positions say, found again in the memory that is there.
 *
 * What triangles share stays as it was, and so does their order: clusters and chunks are still right, if no longer as
 * small as could be. Whether a closed part passes through itself is asked anew, by a test that needs no memory and
 * knows only parts that are seen whole from their middle; all triangles of the others cast, which is right for any
 * shape. */
#include "gni.h"

#include <math.h>
#include <string.h>

static const float *vertex_of(const float *positions, size_t stride, uint32_t index)
{
    return (const float *)(const void *)((const unsigned char *)positions + stride * index);
}

/* scratch: [vertex_count] the first that was given for each. */
static gn_result check(gn_mesh *mesh, const float *positions, size_t stride, uint32_t *scratch)
{
    memset(scratch, 0xff, mesh->info.vertex_count * sizeof *scratch);
    for (uint32_t v = 0; v < mesh->given_count; v++) {
        const float *p = vertex_of(positions, stride, v), *other;
        const uint32_t welded = mesh->welded[v];

        for (int axis = 0; axis < 3; axis++)
            if (!isfinite(p[axis]))
                return gn_fail(mesh->context, GN_E_MESH, "gn_mesh_update: vertex %lu is not finite: its %c is %g",
                               (unsigned long)v, "xyz"[axis], (double)p[axis]);
        if (welded == GNI_NONE)
            continue;
        if (scratch[welded] == GNI_NONE)
            scratch[welded] = v;
        other = vertex_of(positions, stride, scratch[welded]);
        for (int axis = 0; axis < 3; axis++)
            if (!(p[axis] >= other[axis] && p[axis] <= other[axis]))
                return gn_fail(
                    mesh->context, GN_E_MESH,
                    "gn_mesh_update: vertices %lu and %lu were at one place, and are not: their %c is %g and %g",
                    (unsigned long)scratch[welded], (unsigned long)v, "xyz"[axis], (double)other[axis],
                    (double)p[axis]);
    }
    return GN_OK;
}

gn_result gn_mesh_update(gn_mesh *mesh, const float *positions, size_t stride)
{
    const size_t step = stride ? stride : 3 * sizeof(float);
    gn_result result;

    if (!mesh || (!positions && mesh->given_count))
        return gn_fail(mesh ? mesh->context : NULL, GN_E_ARG, "gn_mesh_update: NULL argument");
    if (step < 3 * sizeof(float) || step % sizeof(float) != 0)
        return gn_fail(mesh->context, GN_E_ARG, "gn_mesh_update: stride of %lu bytes: a multiple of 4 from 12 on, or 0",
                       (unsigned long)stride);
    result = check(mesh, positions, step, mesh->first_given);
    if (result != GN_OK)
        return result;
    for (uint32_t v = 0; v < mesh->info.vertex_count; v++)
        for (size_t axis = 0; axis < 3; axis++)
            mesh->positions[3 * (size_t)v + axis] = vertex_of(positions, step, mesh->first_given[v])[axis] + 0.0f;
    gni_subtract_centre(mesh);
    gni_find_planes(mesh);
    gni_judge_parts(mesh);
    if (GNI_HAS_WELDING)
        gni_sum_groups(mesh);
    if (GNI_HAS_CLUSTERS)
        gni_fill_clusters(mesh);
    mesh->info.shape++;
    return GN_OK;
}
