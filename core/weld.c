/* weld.c - one vertex for every distinct position, so that triangles which meet share vertices and hence edges.
 *
 * Positions are equal when their floats are (-0 counts as 0): no tolerance, since moving a vertex would move a shadow.
 *
 * The centre that is subtracted never rounds. Where all coordinates of an axis have one sign and lie within a factor of
 * two, subtracting one of them is exact (Sterbenz), and the cancelled leading bits no longer cost precision in the clip
 * matrix; on any other axis the centre is 0. */
#include "gni.h"

#include <math.h>
#include <string.h>

static const float *vertex_of(const gn_mesh_desc *desc, uint32_t index)
{
    const size_t stride = desc->stride ? desc->stride : 3 * sizeof(float);

    return (const float *)(const void *)((const unsigned char *)desc->positions + stride * index);
}

static gn_result check(gn_context *context, const gn_mesh_desc *desc)
{
    const uint32_t *const indices = desc->indices;
    const size_t corners = 3 * desc->triangle_count;

    for (size_t i = 0; i < desc->vertex_count; i++) {
        const float *p = vertex_of(desc, (uint32_t)i);

        for (int axis = 0; axis < 3; axis++)
            if (!isfinite(p[axis]))
                return gn_fail(context, GN_E_MESH, "mesh: vertex %lu is not finite: its %c is %g", (unsigned long)i,
                               "xyz"[axis], (double)p[axis]);
    }
    for (size_t i = 0; i < corners; i++)
        if (indices[i] >= desc->vertex_count)
            return gn_fail(context, GN_E_MESH, "mesh: triangle %lu names vertex %lu of %lu", (unsigned long)(i / 3),
                           (unsigned long)indices[i], (unsigned long)desc->vertex_count);
    return GN_OK;
}

static uint32_t hash_of(const float p[3])
{
    uint32_t bits[3];

    memcpy(bits, p, sizeof bits);
    bits[0] = (bits[0] * 0x9e3779b1u) ^ (bits[1] * 0x85ebca77u) ^ (bits[2] * 0xc2b2ae3du);
    bits[0] ^= bits[0] >> 15;
    return bits[0] * 0x2c1b3c6du;
}

/* Numbers positions in order of their first use; writes raw positions and triangles. Returns how many there are. */
static uint32_t number_vertices(gn_mesh *mesh, const gn_mesh_desc *desc, uint32_t *table, uint32_t mask)
{
    const uint32_t *const indices = desc->indices;
    uint32_t *const welded = mesh->welded, *const given = mesh->given;
    const size_t corners = 3 * desc->triangle_count;
    uint32_t count = 0;

    memset(table, 0xff, ((size_t)mask + 1) * sizeof *table);
    for (size_t i = 0; i < corners; i++) {
        const uint32_t index = indices[i];
        const float *at;
        float p[3];
        uint32_t slot;

        if (welded[index] != GNI_NONE) {
            given[i] = welded[index];
            continue;
        }
        at = vertex_of(desc, index);
        for (int axis = 0; axis < 3; axis++)
            p[axis] = at[axis] + 0.0f; /* -0 + 0 is 0 */
        slot = (hash_of(p) >> 7) & mask;
        while (table[slot] != GNI_NONE && memcmp(mesh->positions + 3 * (size_t)table[slot], p, sizeof p) != 0)
            slot = (slot + 1) & mask;
        if (table[slot] == GNI_NONE) {
            memcpy(mesh->positions + 3 * (size_t)count, p, sizeof p);
            table[slot] = count++;
        }
        given[i] = welded[index] = table[slot];
    }
    return count;
}

void gni_subtract_centre(gn_mesh *mesh)
{
    gn_mesh_info *info = &mesh->info;

    for (int axis = 0; axis < 3; axis++) {
        float low = INFINITY, high = -INFINITY, centre = 0.0f;

        for (uint32_t v = 0; v < info->vertex_count; v++) {
            const float p = mesh->positions[3 * (size_t)v + (size_t)axis];

            low = p < low ? p : low;
            high = p > high ? p : high;
        }
        if (info->vertex_count && ((low > 0.0f && high <= 2.0f * low) || (high < 0.0f && low >= 2.0f * high)))
            centre = 0.5f * low + 0.5f * high;
        for (uint32_t v = 0; v < info->vertex_count && centre != 0.0f; v++)
            mesh->positions[3 * (size_t)v + (size_t)axis] -= centre;
        info->centre[axis] = centre;
        info->box_min[axis] = info->vertex_count ? low - centre : 0.0f;
        info->box_max[axis] = info->vertex_count ? high - centre : 0.0f;
    }
}

gn_result gni_weld(gn_mesh *mesh, const gn_mesh_desc *desc)
{
    gn_context *context = mesh->context;
    const size_t corners = 3 * desc->triangle_count;
    const size_t most = corners < desc->vertex_count ? corners : desc->vertex_count;
    const gn_result result = check(context, desc);
    uint32_t *table, mask = 1;

    if (result != GN_OK)
        return result;
    while (mask < 2 * most)
        mask = 2 * mask + 1;
    table = gni_alloc(context, (size_t)mask + 1, sizeof *table);
    mesh->positions = gni_alloc(context, most, 3 * sizeof(float));
    mesh->given = gni_alloc(context, corners, sizeof *mesh->given);
    mesh->welded = gni_alloc(context, desc->vertex_count, sizeof *mesh->welded);
    if (!table || !mesh->welded || !mesh->positions || !mesh->given) {
        gni_free(context, table);
        return gn_fail(context, GN_E_MEMORY, "mesh: no memory to weld %lu vertices", (unsigned long)desc->vertex_count);
    }
    memset(mesh->welded, 0xff, desc->vertex_count * sizeof *mesh->welded);
    mesh->given_count = (uint32_t)desc->vertex_count;
    mesh->info.triangle_count = (uint32_t)desc->triangle_count;
    mesh->info.vertex_count = number_vertices(mesh, desc, table, mask);
    gni_free(context, table);
    gni_subtract_centre(mesh);
    return GN_OK;
}
