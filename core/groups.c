/* groups.c - edges welded by angle (Hoxley 2003): triangles that lie nearly in one plane face the light together.
 *
 * From a triangle on, neighbours join while their normals are within the angle of the first one's. All of a group are
 * decided by its plane: the sum of theirs. So no silhouette runs through a group, and there are fewer edges, and
 * straighter ones; volumes are as closed as ever, since all follows one bit a triangle. A silhouette may lie on the
 * wrong border of a group: that far, and no farther, a shadow's edge may be off where it starts. */
#include "gni.h"

#include <math.h>
#include <string.h>

void gni_sum_groups(gn_mesh *mesh)
{
    double *const sums = mesh->facing_planes;

    if (!mesh->group_of)
        return;
    memset(sums, 0, (size_t)mesh->info.triangle_count * 4 * sizeof *sums);
    for (uint32_t t = 0; t < mesh->info.triangle_count; t++)
        for (size_t k = 0; k < 4; k++)
            sums[4 * (size_t)mesh->group_of[t] + k] += mesh->planes[4 * (size_t)t + k];
    for (uint32_t t = 0; t < mesh->info.triangle_count; t++) /* a group is named by its first triangle */
        memcpy(sums + 4 * (size_t)t, sums + 4 * (size_t)mesh->group_of[t], 4 * sizeof *sums);
}

static int is_within(const double *a, const double *b, double cosine)
{
    return gni_dot(a, b) >= cosine * sqrt(gni_dot(a, a) * gni_dot(b, b));
}

/* The diagonal of the box around a group of several. stack: its triangles. */
static double size_of(const gn_mesh *mesh, const uint32_t *stack, uint32_t count)
{
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY}, square = 0.0;

    for (uint32_t i = 0; i < count; i++)
        for (int k = 0; k < 3; k++) {
            const float *p = mesh->positions + 3 * (size_t)mesh->triangles[3 * (size_t)stack[i] + (size_t)k];

            for (int axis = 0; axis < 3; axis++) {
                low[axis] = fmin(low[axis], (double)p[axis]);
                high[axis] = fmax(high[axis], (double)p[axis]);
            }
        }
    for (int axis = 0; axis < 3; axis++)
        square += (high[axis] - low[axis]) * (high[axis] - low[axis]);
    return count > 1 ? sqrt(square) : 0.0;
}

gn_result gni_make_groups(gn_mesh *mesh, double angle)
{
    gn_context *context = mesh->context;
    const uint32_t triangles = mesh->info.triangle_count;
    const double cosine = cos(angle);
    uint32_t *queue;

    if (angle == 0.0)
        return GN_OK;
    queue = gni_alloc(context, triangles, sizeof *queue);
    mesh->group_of = gni_alloc(context, triangles, sizeof *mesh->group_of);
    mesh->facing_planes = gni_alloc(context, triangles, 4 * sizeof *mesh->facing_planes);
    if (!queue || !mesh->group_of || !mesh->facing_planes) {
        gni_free(context, queue);
        return gn_fail(context, GN_E_MEMORY, "mesh: no memory to weld edges of %lu triangles",
                       (unsigned long)triangles);
    }
    memset(mesh->group_of, 0xff, triangles * sizeof *mesh->group_of);
    for (uint32_t first = 0; first < triangles; first++) {
        uint32_t count = 1;

        if (mesh->group_of[first] != GNI_NONE)
            continue;
        mesh->group_of[first] = first;
        queue[0] = first;
        for (uint32_t at = 0; at < count; at++)
            for (uint32_t corner = 3 * queue[at]; corner < 3 * queue[at] + 3; corner++) {
                const uint32_t other = mesh->across[corner];

                if (other == triangles || mesh->group_of[other] != GNI_NONE ||
                    !is_within(mesh->planes + 4 * (size_t)first, mesh->planes + 4 * (size_t)other, cosine))
                    continue;
                mesh->group_of[other] = first;
                queue[count++] = other;
            }
        mesh->info.weld_error = fmax(mesh->info.weld_error, size_of(mesh, queue, count));
    }
    gni_free(context, queue);
    gni_sum_groups(mesh);
    return GN_OK;
}
