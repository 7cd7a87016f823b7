/* mask_metrics.c - see mask_metrics.h. */
#include "mask_metrics.h"

#include <math.h>
#include <stdlib.h>

#define FAR 1e12f /* squared: of no pixel */

/* One line: out[q] = the least over p of (q - p)^2 + in[p]. hull, starts: [count], [count + 1]. */
static void transform_line(const float *in, float *out, uint32_t count, uint32_t *hull, float *starts)
{
    uint32_t top = 0;

    hull[0] = 0;
    starts[0] = -FAR;
    starts[1] = FAR;
    for (uint32_t q = 1; q < count; q++) {
        const float height = in[q] + (float)q * (float)q;
        float meet;

        for (;;) {
            const uint32_t p = hull[top];

            meet = (height - (in[p] + (float)p * (float)p)) / (2.0f * (float)(q - p));
            if (meet > starts[top] || top == 0)
                break;
            top--;
        }
        if (meet > starts[top])
            top++;
        hull[top] = q;
        starts[top] = meet;
        starts[top + 1] = FAR;
    }
    top = 0;
    for (uint32_t q = 0; q < count; q++) {
        float away;

        while (starts[top + 1] < (float)q)
            top++;
        away = (float)q - (float)hull[top];
        out[q] = away * away + in[hull[top]];
    }
}

int distance_transform(const uint8_t *marked, uint32_t width, uint32_t height, float *squared)
{
    const uint32_t most = width > height ? width : height;
    float *in = calloc(most, sizeof *in), *out = malloc(most * sizeof *out), *starts = malloc((most + 1) * sizeof *in);
    uint32_t *hull = malloc(most * sizeof *hull);
    const int ok = in && out && starts && hull;

    for (uint32_t x = 0; ok && x < width; x++) {
        for (uint32_t y = 0; y < height; y++)
            in[y] = marked[(size_t)width * y + x] ? 0.0f : FAR;
        transform_line(in, out, height, hull, starts);
        for (uint32_t y = 0; y < height; y++)
            squared[(size_t)width * y + x] = out[y];
    }
    for (uint32_t y = 0; ok && y < height; y++) {
        float *row = squared + (size_t)width * y;

        transform_line(row, out, width, hull, starts);
        for (uint32_t x = 0; x < width; x++)
            row[x] = out[x];
    }
    free(in);
    free(out);
    free(starts);
    free(hull);
    return ok;
}

/* Marks the boundary of a mask; returns how many pixels it has. */
static size_t mark_boundary(const mask_pair *p, const uint8_t *lit, uint8_t *marked)
{
    const size_t width = p->width, height = p->height;
    size_t count = 0;

    for (size_t y = 0; y < height; y++)
        for (size_t x = 0; x < width; x++) {
            const size_t at = width * y + x;
            const size_t beside[4] = {x > 0 ? at - 1 : at, x + 1 < width ? at + 1 : at, y > 0 ? at - width : at,
                                      y + 1 < height ? at + width : at};

            marked[at] = 0;
            for (int k = 0; k < 4 && p->visible[at]; k++)
                marked[at] |= p->visible[beside[k]] && lit[beside[k]] != lit[at];
            count += marked[at];
        }
    return count;
}

static int by_value(const void *a, const void *b)
{
    const float x = *(const float *)a, y = *(const float *)b;

    return (x > y) - (x < y);
}

/* Boundaries of the mask and of the truth, and how far from each other. */
typedef struct outlines {
    uint8_t *of_mask, *of_truth;
    float *to_mask, *to_truth, *distances;
    size_t mask_count, truth_count;
} outlines;

static void compare_outlines(const mask_pair *p, outlines *o, mask_metrics *out)
{
    const size_t pixels = (size_t)p->width * p->height;
    size_t near[2][2] = {{0, 0}, {0, 0}}, count = 0; /* of the mask's, of the truth's */

    for (size_t i = 0; i < pixels; i++) {
        for (int d = 0; d < 2; d++) {
            const float most = (float)((d + 1) * (d + 1));

            near[0][d] += o->of_mask[i] && o->to_truth[i] <= most;
            near[1][d] += o->of_truth[i] && o->to_mask[i] <= most;
        }
        if (o->of_mask[i])
            o->distances[count++] = o->to_truth[i];
        if (o->of_truth[i])
            o->distances[count++] = o->to_mask[i];
    }
    for (int d = 0; d < 2; d++) {
        const double precision = o->mask_count ? (double)near[0][d] / (double)o->mask_count : 0.0;
        const double recall = o->truth_count ? (double)near[1][d] / (double)o->truth_count : 0.0;

        out->boundary_f[d] = o->mask_count + o->truth_count == 0 ? 1.0
                             : precision + recall > 0.0          ? 2.0 * precision * recall / (precision + recall)
                                                                 : 0.0;
    }
    out->distance95 = 0.0;
    if (count == 0)
        return;
    qsort(o->distances, count, sizeof *o->distances, by_value);
    out->distance95 = fmin(sqrt((double)o->distances[(size_t)(0.95 * (double)(count - 1) + 0.5)]),
                           hypot((double)p->width, (double)p->height));
}

static void compare_areas(const mask_pair *p, const float *to_edge, mask_metrics *out)
{
    const size_t pixels = (size_t)p->width * p->height;
    size_t both = 0, mine = 0, theirs = 0;

    for (size_t i = 0; i < pixels; i++) {
        const int is_mine = p->lit[i] < 128, is_theirs = p->true_lit[i] < 128;

        if (!p->visible[i])
            continue;
        out->visible++;
        both += (size_t)(is_mine && is_theirs);
        mine += (size_t)is_mine;
        theirs += (size_t)is_theirs;
        if (is_mine == is_theirs)
            continue;
        out->wrong++;
        *(to_edge[i] > 4.0f ? &out->interior : &out->boundary) += 1;
    }
    out->iou = mine + theirs > both ? (double)both / (double)(mine + theirs - both) : 1.0;
    out->precision = mine ? (double)both / (double)mine : 1.0;
    out->recall = theirs ? (double)both / (double)theirs : 1.0;
}

int mask_measure(const mask_pair *p, mask_metrics *out)
{
    static const mask_metrics none;
    const size_t pixels = (size_t)p->width * p->height;
    outlines o = {malloc(pixels),
                  malloc(pixels),
                  malloc(pixels * sizeof(float)),
                  malloc(pixels * sizeof(float)),
                  malloc(2 * pixels * sizeof(float)),
                  0,
                  0};
    int ok = o.of_mask && o.of_truth && o.to_mask && o.to_truth && o.distances;

    *out = none;
    if (ok) {
        o.mask_count = mark_boundary(p, p->lit, o.of_mask);
        o.truth_count = mark_boundary(p, p->true_lit, o.of_truth);
        ok = distance_transform(o.of_mask, p->width, p->height, o.to_mask) &&
             distance_transform(o.of_truth, p->width, p->height, o.to_truth);
    }
    if (ok) {
        compare_outlines(p, &o, out);
        for (size_t i = 0; p->crossed && i < pixels; i++)
            o.of_truth[i] |= p->crossed[i] != 0;
        ok = !p->crossed || distance_transform(o.of_truth, p->width, p->height, o.to_truth);
    }
    if (ok)
        compare_areas(p, o.to_truth, out);
    free(o.of_mask);
    free(o.of_truth);
    free(o.to_mask);
    free(o.to_truth);
    free(o.distances);
    return ok;
}

size_t mask_flicker(const mask_pair *before, const mask_pair *after)
{
    const size_t pixels = (size_t)after->width * after->height;
    size_t count = 0;

    for (size_t i = 0; i < pixels; i++)
        if (before->visible[i] && after->visible[i])
            count += ((before->lit[i] ^ before->true_lit[i]) >> 7) != ((after->lit[i] ^ after->true_lit[i]) >> 7);
    return count;
}
