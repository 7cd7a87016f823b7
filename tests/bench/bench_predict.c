/* bench_predict.c - how far predictions are from what frames take: one row of a CSV for each way on each scene.
 *
 *     bench_predict KNOWLEDGE.csv SCENE...
 *
 * Shadow time is the difference of a frame with shadows and one without, at 320x240, medians of seven pairs; what is predicted of
 * it is by the load of the way's own plan, and by that of the method stencil, from which the selector foresees what it has not
 * tried. Summaries are of shadow times of half a millisecond and more: below it the machine's noise is measured. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "spread.h"
#include "ways.h"

enum { REPEATS = 7, MOST_ROWS = 4096 };
#define LEAST_MS 0.5

static double errors[2][MOST_ROWS];
static size_t error_count;

static double predict(const ways_scene *w, const gn_knowledge *k, const gn_load *loads, int m, int v)
{
    const double area = m == GN_METHOD_REFINE ? 1.0 : (double)gn_variant_scale(v) * gn_variant_scale(v);
    const double *us = k->ways[m][v].us;
    double sum = us[GN_COST_SETUP];

    for (uint32_t i = 0; i < w->stage->light_count; i++)
        sum += us[GN_COST_INDEX] * loads[i].indices + us[GN_COST_FRAGMENT] * loads[i].fragments / area +
               us[GN_COST_PIXEL] * loads[i].pixels / area +
               us[GN_COST_SWITCH] * (m == GN_METHOD_STENCIL && v == GN_VARIANT_FULL ? 1.0 : 2.0);
    return sum / 1000.0;
}

static void put_row(const ways_scene *w, const char *name, int m, int v, const gn_load *loads, const double ms[3])
{
    gn_load sum = {0, 0, 0};

    for (uint32_t i = 0; i < w->stage->light_count; i++) {
        sum.indices += loads[i].indices;
        sum.fragments += loads[i].fragments;
        sum.pixels += loads[i].pixels;
    }
    printf("%s,%s,%u,%s,%u,%.0f,%.0f,%.0f,%.3f,%.3f,%.3f\n", name, gn_method_describe((gn_method)m)->name,
           (unsigned)gn_variant_scale(v), gn_variant_upsample(v) == GN_UPSAMPLE_DEPTH ? "depth" : "bilinear",
           (unsigned)w->stage->light_count, sum.indices, sum.fragments, sum.pixels, ms[0], ms[1], ms[2]);
}

static int run_way(ways_scene *w, const gn_knowledge *k, const char *name, int m, int v)
{
    double shadow[REPEATS], ms[3];
    gn_load *loads;

    for (int i = -1; i < REPEATS; i++) {
        double without, with;

        if (!ways_draw(w, GN_METHOD_AUTO, GN_VARIANT_FULL, 0, &without) || !ways_draw(w, m, v, 1, &with))
            return 1; /* not possible here */
        shadow[i < 0 ? 0 : i] = with - without;
    }
    loads = calloc(w->stage->light_count + 1, sizeof *loads);
    if (!loads)
        return 0;
    for (uint32_t i = 0; i < w->stage->light_count; i++) {
        gn_facts facts;

        gn_plan_measure(w->stage->plan, i, 0, &loads[i], &facts);
    }
    ms[0] = spread_of(shadow, REPEATS).median;
    ms[1] = predict(w, k, loads, m, v);
    ms[2] = predict(w, k, w->loads, m, v);
    put_row(w, name, m, v, loads, ms);
    free(loads);
    for (int i = 0; i < 2 && ms[0] >= LEAST_MS && error_count < MOST_ROWS; i++)
        errors[i][error_count] = fabs(ms[1 + i] / ms[0] - 1.0);
    error_count += ms[0] >= LEAST_MS && error_count < MOST_ROWS;
    return 1;
}

int main(int count, char **arguments)
{
    gn_context *context;
    gn_knowledge k;

    if (count < 3)
        return fprintf(stderr, "usage: bench_predict KNOWLEDGE.csv SCENE...\n"), 2;
    if (gn_context_create(NULL, &context) != GN_OK || !ways_read_knowledge(context, arguments[1], &k))
        return 1;
    printf("scene,method,scale,upsample,lights,indices,fragments,pixels,shadow_ms,predicted_ms,foreseen_ms\n");
    for (int i = 2; i < count; i++) {
        ways_scene w;
        int ok = ways_open(&w, arguments[i]);

        for (int m = 0; m < GN_METHOD_TOTAL && ok; m++)
            for (int v = 0; v < GN_VARIANT_COUNT && ok; v++)
                ok = !k.ways[m][v].is_known || run_way(&w, &k, arguments[i], m, v);
        ways_close(&w);
        if (!ok)
            return 1;
    }
    for (int i = 0; i < 2 && error_count > 0; i++) {
        qsort(errors[i], error_count, sizeof(double), by_value);
        printf("# %s: median error %.3f, three quarters within %.3f, of %lu rows\n", i ? "foreseen" : "predicted",
               errors[i][error_count / 2], errors[i][error_count * 3 / 4], (unsigned long)error_count);
    }
    gn_context_destroy(context);
    return 0;
}
