/* order.c - triangles in an order of the mesh's own: near ones beside each other, whatever order they were given in.
 *
 * Runs of 64 are clusters (clusters.c), and the smaller these are in space, the more of them lie all on one side of a
 * light. Sorted by the interleaved bits of their centres (Morton 1966), most significant pass last. */
#include "gni.h"

#include <string.h>

#define AXIS_BITS 10
#define PASS_BITS 10
#define PASSES    3

/* Every third bit, from the lowest on. */
static uint32_t spread(uint32_t x)
{
    x = (x | x << 16) & 0x030000ffu;
    x = (x | x << 8) & 0x0300f00fu;
    x = (x | x << 4) & 0x030c30c3u;
    return (x | x << 2) & 0x09249249u;
}

static uint32_t key_of(const gn_mesh *mesh, uint32_t triangle, const float scale[3])
{
    const uint32_t *c = mesh->given + 3 * (size_t)triangle;
    uint32_t key = 0;

    for (int axis = 0; axis < 3; axis++) {
        const float *p = mesh->positions + axis, low = 3.0f * mesh->info.box_min[axis];
        const float at = (p[3 * (size_t)c[0]] + p[3 * (size_t)c[1]] + p[3 * (size_t)c[2]] - low) * scale[axis];

        /* what is not a number, where floats overflow, goes first */
        key |= spread(at >= 0.0f ? at < 1023.0f ? (uint32_t)at : 1023u : 0u) << axis;
    }
    return key;
}

/* order: by keys, equal ones as they come. spare: [count]. */
static void sort(uint32_t *order, uint32_t *spare, const uint32_t *keys, uint32_t count)
{
    uint32_t starts[1u << PASS_BITS];

    for (int pass = 0; pass < PASSES; pass++) {
        uint32_t *const from = pass % 2 ? spare : order, *const to = pass % 2 ? order : spare, total = 0;
        const int shift = pass * PASS_BITS;

        memset(starts, 0, sizeof starts);
        for (uint32_t i = 0; i < count; i++)
            starts[keys[i] >> shift & ((1u << PASS_BITS) - 1)]++;
        for (uint32_t b = 0; b < 1u << PASS_BITS; b++) {
            const uint32_t n = starts[b];

            starts[b] = total;
            total += n;
        }
        for (uint32_t i = 0; i < count; i++)
            to[starts[keys[from[i]] >> shift & ((1u << PASS_BITS) - 1)]++] = from[i];
    }
    if (PASSES % 2)
        memcpy(order, spare, count * sizeof *order);
}

gn_result gni_order_triangles(gn_mesh *mesh)
{
    gn_context *context = mesh->context;
    const uint32_t count = mesh->info.triangle_count;
    uint32_t *spare = gni_alloc(context, count, sizeof *spare), *keys = gni_alloc(context, count, sizeof *keys);
    float scale[3];
    int failed;

    mesh->order = gni_alloc(context, count, sizeof *mesh->order);
    mesh->triangles = gni_alloc(context, count, 3 * sizeof *mesh->triangles);
    failed = !spare || !keys || !mesh->order || !mesh->triangles;
    for (int axis = 0; axis < 3 && !failed; axis++) {
        const float width = 3.0f * (mesh->info.box_max[axis] - mesh->info.box_min[axis]);

        scale[axis] = width > 0.0f ? (float)(1 << AXIS_BITS) / width : 0.0f;
    }
    for (uint32_t t = 0; t < count && !failed; t++) {
        keys[t] = key_of(mesh, t, scale);
        mesh->order[t] = t;
    }
    if (!failed && count > GNI_CLUSTER)
        sort(mesh->order, spare, keys, count);
    for (uint32_t t = 0; t < count && !failed; t++)
        memcpy(mesh->triangles + 3 * (size_t)t, mesh->given + 3 * (size_t)mesh->order[t], 3 * sizeof *mesh->triangles);
    gni_free(context, spare);
    gni_free(context, keys);
    if (failed)
        return gn_fail(context, GN_E_MEMORY, "mesh: no memory to order %lu triangles", (unsigned long)count);
    return GN_OK;
}
