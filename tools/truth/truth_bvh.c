/* truth_bvh.c - the hierarchy's builder: top down, each node split where the surface area heuristic says so.
 *
 * A ray that meets a node meets a child with a probability of about the ratio of their surface areas, so the best split
 * has the least sum of area times items. Only 15 planes an axis are tried, between 16 bins of the boxes' centres, which
 * takes linear time and serves nearly as well. Past 40 levels, which only contrived input reaches, items are halved by
 * count, which ends within 31 more levels whatever the input.
 *
 * MacDonald, Booth. Heuristics for Ray Tracing Using Space Subdivision. The Visual Computer 6(3), 1990.
 * Wald. On Fast Construction of SAH-based Bounding Volume Hierarchies. IEEE/EG Symposium on Interactive Ray Tracing,
 * 2007. */
#include "truth_bvh.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { BINS = 16, LEAF_MOST = 8, LEVELS_BY_AREA = 40 };

typedef struct task {
    uint32_t node, begin, end;
    int level;
} task;

typedef struct bin {
    double box[6];
    uint32_t count;
} bin;

static void empty_box(double box[6])
{
    for (int k = 0; k < 3; k++) {
        box[k] = HUGE_VAL;
        box[3 + k] = -HUGE_VAL;
    }
}

static void grow(double box[6], const double by[6])
{
    for (int k = 0; k < 3; k++) {
        if (by[k] < box[k])
            box[k] = by[k];
        if (by[3 + k] > box[3 + k])
            box[3 + k] = by[3 + k];
    }
}

static double half_area(const double box[6])
{
    const double x = box[3] - box[0], y = box[4] - box[1], z = box[5] - box[2];

    return x < 0.0 ? 0.0 : x * y + y * z + z * x;
}

static float rounded_down(double x)
{
    const float f = (float)x;

    return (double)f > x ? nextafterf(f, -HUGE_VALF) : f;
}

static float rounded_up(double x)
{
    const float f = (float)x;

    return (double)f < x ? nextafterf(f, HUGE_VALF) : f;
}

/* Which bin of `axis` holds the box's centre; `scale` is bins per length, doubled, since the centre is not halved. */
static int bin_of(const double box[6], int axis, double twice_least, double scale)
{
    const int b = (int)((box[axis] + box[3 + axis] - twice_least) * scale);

    return b < 0 ? 0 : b >= BINS ? BINS - 1 : b;
}

/* The range of the (doubled) centres of some items. */
static void centre_range(double range[6], const double (*boxes)[6], const uint32_t *order, uint32_t begin, uint32_t end)
{
    empty_box(range);
    for (uint32_t i = begin; i < end; i++) {
        const double *b = boxes[order[i]];
        const double c[6] = {b[0] + b[3], b[1] + b[4], b[2] + b[5], b[0] + b[3], b[1] + b[4], b[2] + b[5]};

        grow(range, c);
    }
}

/* Finds the cheapest split of order[begin..end) and makes it. Returns the first item of the second child, or `begin`
 * when one leaf is cheaper. */
static uint32_t split_by_area(const double (*boxes)[6], uint32_t *order, uint32_t begin, uint32_t end,
                              const double box[6])
{
    double range[6], best = HUGE_VAL;
    int best_axis = -1, best_bin = 0;
    uint32_t i = begin, j = end;

    centre_range(range, boxes, order, begin, end);
    for (int axis = 0; axis < 3; axis++) {
        const double extent = range[3 + axis] - range[axis], scale = BINS / extent;
        double right_cost[BINS], running[6];
        uint32_t n = 0;
        bin bins[BINS];

        if (!(extent > 0.0) || !isfinite(scale))
            continue;
        for (int b = 0; b < BINS; b++) {
            empty_box(bins[b].box);
            bins[b].count = 0;
        }
        for (uint32_t k = begin; k < end; k++) {
            bin *b = &bins[bin_of(boxes[order[k]], axis, range[axis], scale)];

            grow(b->box, boxes[order[k]]);
            b->count++;
        }
        empty_box(running);
        for (int b = BINS - 1; b > 0; b--) {
            grow(running, bins[b].box);
            n += bins[b].count;
            right_cost[b] = half_area(running) * n;
        }
        empty_box(running);
        n = 0;
        for (int b = 1; b < BINS; b++) {
            double cost;

            grow(running, bins[b - 1].box);
            n += bins[b - 1].count;
            cost = half_area(running) * n + right_cost[b];
            if (n > 0 && n < end - begin && cost < best) {
                best = cost;
                best_axis = axis;
                best_bin = b;
            }
        }
    }
    if (best_axis < 0) /* all centres in one point */
        return end - begin <= LEAF_MOST ? begin : begin + (end - begin) / 2;
    /* stepping into a node costs about as much as one item's test */
    if (end - begin <= LEAF_MOST && best + half_area(box) >= half_area(box) * (end - begin))
        return begin;
    while (i < j) {
        const double scale = BINS / (range[3 + best_axis] - range[best_axis]);

        if (bin_of(boxes[order[i]], best_axis, range[best_axis], scale) < best_bin) {
            i++;
        } else {
            const uint32_t swap = order[i];

            order[i] = order[--j];
            order[j] = swap;
        }
    }
    return i;
}

int truth_bvh_build(truth_bvh *out, const double (*boxes)[6], size_t count)
{
    truth_bvh b = {NULL, NULL, count};
    task stack[TRUTH_BVH_STACK];
    uint32_t used = 1;
    double margin = 0.0;
    int top = 0;

    memset(out, 0, sizeof *out);
    if (count == 0)
        return 1;
    if (count >= 1u << 31)
        return 0;
    b.nodes = malloc((2 * count - 1) * sizeof *b.nodes);
    b.order = malloc(count * sizeof *b.order);
    if (!b.nodes || !b.order) {
        truth_bvh_free(&b);
        return 0;
    }
    for (size_t i = 0; i < count; i++) {
        b.order[i] = (uint32_t)i;
        for (int k = 0; k < 6; k++)
            margin = fmax(margin, fabs(boxes[i][k]));
    }
    /* Flat boxes get some thickness, so that rounding in the slab test never loses what lies in them. */
    margin *= 1e-9;

    stack[top++] = (task){0, 0, (uint32_t)count, 0};
    while (top > 0) {
        const task job = stack[--top];
        truth_bvh_node *node = &b.nodes[job.node];
        uint32_t middle;
        double box[6];

        empty_box(box);
        for (uint32_t i = job.begin; i < job.end; i++)
            grow(box, boxes[b.order[i]]);
        for (int k = 0; k < 3; k++) {
            node->box[0][k] = rounded_down(box[k] - margin);
            node->box[1][k] = rounded_up(box[3 + k] + margin);
        }
        if (job.end - job.begin <= 1)
            middle = job.begin;
        else if (job.level < LEVELS_BY_AREA)
            middle = split_by_area(boxes, b.order, job.begin, job.end, box);
        else
            middle = job.end - job.begin <= LEAF_MOST ? job.begin : job.begin + (job.end - job.begin) / 2;
        if (middle == job.begin) {
            node->first = job.begin;
            node->count = job.end - job.begin;
            continue;
        }
        node->first = used;
        node->count = 0;
        stack[top++] = (task){used + 1, middle, job.end, job.level + 1};
        stack[top++] = (task){used, job.begin, middle, job.level + 1};
        used += 2;
    }
    *out = b;
    return 1;
}

void truth_bvh_free(truth_bvh *b)
{
    free(b->nodes);
    free(b->order);
    memset(b, 0, sizeof *b);
}
