/* order.c - triangles in an order of the mesh's own: near ones beside each other, whatever order they were given in.
 *
 * Runs of 64 are clusters (clusters.c), and the smaller these are in space, the more of them lie all on one side of a
 * light. So the triangles are split in two at the middle of the longest side of the box around their centres, again and
 * again (Bentley's k-d tree, 1975): not in halves but so that the first part is a power of two clusters, the largest
 * that leaves a rest. Then runs of 8 clusters, of 64 and so on, which are the nodes of a tree, are boxes too. */
#include "gni.h"

#include <math.h>
#include <string.h>

#define SAMPLES 128 /* for a pivot, at most */
#define LOOKS   32  /* for the longest side, and up to twice as many */

/* A triangle while it is sorted: its centre, and its number. */
typedef struct item {
    float at[3];
    uint32_t triangle;
} item;

/* A value by which to part items, so that most of those beyond the middle are parted off on the side where more are:
 * from a sorted sample, a little beside it (Floyd and Rivest 1975). */
static float choose_pivot(const item *items, uint32_t count, uint32_t middle, int axis)
{
    const uint32_t wanted = count / 64 < SAMPLES ? count / 64 : SAMPLES;
    float sample[SAMPLES + 1];
    uint32_t size = 0;
    int32_t at;

    if (wanted < 4)
        return items[(count - 1) / 2].at[axis]; /* never the last: both sides keep some */
    for (uint32_t i = 0; i < wanted; i++) {
        const float x = items[(uint64_t)i * (count - 1) / wanted].at[axis];
        uint32_t to = size++;

        for (; to > 0 && sample[to - 1] > x; to--)
            sample[to] = sample[to - 1];
        sample[to] = x;
    }
    at = (int32_t)((uint64_t)middle * size / count);
    at += 2 * middle < count ? 1 + (int32_t)size / 16 : -1 - (int32_t)size / 16;
    return sample[at < 0 ? 0 : at < (int32_t)size ? at : (int32_t)size - 1];
}

/* Hoare's selection: the smallest `middle` items come first. */
static void split(item *items, uint32_t count, uint32_t middle, int axis)
{
    int is_stuck = 0;

    while (count > 1) {
        const float pivot = is_stuck ? items[(count - 1) / 2].at[axis] : choose_pivot(items, count, middle, axis);
        const uint32_t before = count;
        item *low = items, *high = items + count - 1;
        uint32_t parted;

        for (;; low++, high--) {
            item swapped;

            while (low->at[axis] < pivot)
                low++;
            while (high->at[axis] > pivot)
                high--;
            if (low >= high)
                break;
            swapped = *low;
            *low = *high;
            *high = swapped;
        }
        parted = (uint32_t)(high - items) + 1;
        if (middle < parted) {
            count = parted;
        } else {
            items += parted;
            middle -= parted;
            count -= parted;
        }
        is_stuck = 2 * count > before; /* so is quadratic time avoided, as well as it ever was */
    }
}

/* Of the box around some of the items: enough to tell. */
static int longest_axis(const item *items, uint32_t count)
{
    const uint32_t step = 1 + count / LOOKS / 2;
    float low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    int longest = 0;

    for (uint32_t i = 0; i < count; i += step)
        for (int axis = 0; axis < 3; axis++) {
            const float x = items[i].at[axis];

            low[axis] = x < low[axis] ? x : low[axis];
            high[axis] = x > high[axis] ? x : high[axis];
        }
    for (int axis = 1; axis < 3; axis++)
        longest = high[axis] - low[axis] > high[longest] - low[longest] ? axis : longest;
    return longest;
}

static void sort(item *items, uint32_t count)
{
    while (count > GNI_CLUSTER) {
        uint32_t first = GNI_CLUSTER;

        while (2 * first < count)
            first *= 2;
        split(items, count, first, longest_axis(items, count));
        sort(items, first);
        items += first;
        count -= first;
    }
}

gn_result gni_order_triangles(gn_mesh *mesh)
{
    gn_context *context = mesh->context;
    const uint32_t count = mesh->info.triangle_count;
    const float third = 1.0f / 3.0f;
    item *items = gni_alloc(context, count, sizeof *items);
    int failed;

    mesh->order = gni_alloc(context, count, sizeof *mesh->order);
    mesh->triangles = gni_alloc(context, count, 3 * sizeof *mesh->triangles);
    failed = !items || !mesh->order || !mesh->triangles;
    for (uint32_t t = 0; t < count && !failed; t++) {
        const uint32_t *c = mesh->given + 3 * (size_t)t;
        const float *p = mesh->positions + 3 * (size_t)c[0], *q = mesh->positions + 3 * (size_t)c[1];
        const float *r = mesh->positions + 3 * (size_t)c[2];

        for (int axis = 0; axis < 3; axis++) /* a third of each first: floats do not overflow, nor is it a NaN */
            items[t].at[axis] = p[axis] * third + q[axis] * third + r[axis] * third;
        items[t].triangle = t;
    }
    if (!failed)
        sort(items, count);
    for (uint32_t t = 0; t < count && !failed; t++) {
        mesh->order[t] = items[t].triangle;
        memcpy(mesh->triangles + 3 * (size_t)t, mesh->given + 3 * (size_t)items[t].triangle,
               3 * sizeof *mesh->triangles);
    }
    gni_free(context, items);
    if (failed)
        return gn_fail(context, GN_E_MEMORY, "mesh: no memory to order %lu triangles", (unsigned long)count);
    return GN_OK;
}
