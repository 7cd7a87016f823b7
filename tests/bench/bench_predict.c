/* bench_predict.c - how far predictions are from what frames take: one row of a CSV for each way on each scene.
 *
 *     bench_predict KNOWLEDGE.csv SCENE...
 *
 * Shadow time is the difference of a frame with shadows and one without, at 320x240, medians of seven pairs; what is predicted of
 * it is by the load of the way's own plan, and by that of the method stencil, from which the selector foresees what it has not
 * tried. Summaries are of shadow times of half a millisecond and more: below it the machine's noise is measured.
 *
 * A machine's speed changes meanwhile. So each pair has a frame of one scene and way beside it, and there are summaries too of times
 * in these, over the run's median of them; and of both, over what all rows have in common, which the selector learns in a
 * few frames. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "spread.h"
#include "ways.h"

enum { REPEATS = 7, MOST_ROWS = 4096 };
#define STEADY   "hall"
#define LEAST_MS 0.5

typedef struct row {
    double ms, steady_ms, predicted[2]; /* steady_ms: of the frame that is always the same */
} row;

static row rows[MOST_ROWS];
static size_t row_count;

static double predict(const ways_scene *w, const gn_knowledge *k, const gn_load *loads, int m, int v)
{
    const gn_way way = {
        .method = (gn_method)m, .scale = gn_variant_scale(v), .upsample = gn_variant_upsample(v), .update_every = 1};
    const double *us = k->ways[m][v].us;
    double sum = us[GN_COST_SETUP] * gn_count_passes(&way, w->stage->light_count);

    for (uint32_t i = 0; i < w->stage->light_count; i++) {
        double counts[GN_COST_COUNT];

        gn_count_costs(&way, &loads[i], counts);
        for (int c = GN_COST_SETUP + 1; c < GN_COST_COUNT; c++)
            sum += us[c] * counts[c];
    }
    return sum / 1000.0;
}

static void put_row(const ways_scene *w, const char *name, int m, int v, const gn_load *loads, const double ms[3])
{
    gn_load sum = {0, 0, 0, 0};

    for (uint32_t i = 0; i < w->stage->light_count; i++) {
        sum.indices += loads[i].indices;
        sum.fragments += loads[i].fragments;
        sum.borders += loads[i].borders;
        sum.pixels += loads[i].pixels;
    }
    printf("%s,%s,%u,%s,%u,%.0f,%.0f,%.0f,%.0f,%.3f,%.3f,%.3f\n", name, gn_method_describe((gn_method)m)->name,
           (unsigned)gn_variant_scale(v), gn_variant_upsample(v) == GN_UPSAMPLE_DEPTH ? "depth" : "bilinear",
           (unsigned)w->stage->light_count, sum.indices, sum.fragments, sum.borders, sum.pixels, ms[0], ms[1], ms[2]);
}

static int draw(ways_scene *w, int m, int v, int casting, double *ms)
{
    return w->stage->platform->kind->make_current(w->stage->platform) && ways_draw(w, m, v, casting, ms);
}

static int run_way(ways_scene *w, ways_scene *steady, const gn_knowledge *k, const char *name, int m, int v)
{
    double shadow[REPEATS], same[REPEATS], ms[3];
    gn_load *loads;

    for (int i = -1; i < REPEATS; i++) {
        double without, with;

        if (!draw(steady, GN_METHOD_COUNT, GN_VARIANT_FULL, 1, &same[i < 0 ? 0 : i]))
            return 0;
        if (!draw(w, GN_METHOD_AUTO, GN_VARIANT_FULL, 0, &without) || !draw(w, m, v, 1, &with))
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
    if (ms[0] >= LEAST_MS && row_count < MOST_ROWS)
        rows[row_count++] = (row){ms[0], spread_of(same, REPEATS).median, {ms[1], ms[2]}};
    return 1;
}

/* Over which the errors of predictions are: times at the run's median speed, or as they are; and what all have in common. */
static void summarise(int of, int is_steady)
{
    static double ratios[MOST_ROWS], errors[MOST_ROWS];
    double typical, common;

    for (size_t i = 0; i < row_count; i++)
        ratios[i] = rows[i].steady_ms;
    typical = spread_of(ratios, row_count).median;
    for (size_t i = 0; i < row_count; i++)
        errors[i] = ratios[i] = rows[i].predicted[of] / rows[i].ms * (is_steady ? rows[i].steady_ms / typical : 1.0);
    common = spread_of(errors, row_count).median;
    for (int k = 0; k < 2; k++) {
        for (size_t i = 0; i < row_count; i++)
            errors[i] = fabs(ratios[i] / (k ? common : 1.0) - 1.0);
        qsort(errors, row_count, sizeof *errors, by_value);
        printf("# %s%s%s: median error %.3f, three quarters within %.3f, of %lu rows\n", of ? "foreseen" : "predicted",
               is_steady ? ", at a steady speed" : "", k ? ", but for the common factor" : "", errors[row_count / 2],
               errors[row_count * 3 / 4], (unsigned long)row_count);
    }
}

int main(int count, char **arguments)
{
    gn_context *context;
    gn_knowledge k;

    if (count < 3)
        return fprintf(stderr, "usage: bench_predict KNOWLEDGE.csv SCENE...\n"), 2;
    if (gn_context_create(NULL, &context) != GN_OK || !ways_read_knowledge(context, arguments[1], &k))
        return 1;
    printf("scene,method,scale,upsample,lights,indices,fragments,borders,pixels,shadow_ms,predicted_ms,foreseen_ms\n");
    for (int i = 2; i < count; i++) {
        ways_scene w, steady;
        int ok = ways_open(&steady, STEADY) && ways_open(&w, arguments[i]);

        for (int m = 0; m < GN_METHOD_TOTAL && ok; m++)
            for (int v = 0; v < GN_VARIANT_COUNT && ok; v++)
                ok = !k.ways[m][v].is_known || run_way(&w, &steady, &k, arguments[i], m, v);
        ways_close(&w);
        ways_close(&steady);
        if (!ok)
            return 1;
    }
    for (int i = 0; i < 4 && row_count > 0; i++)
        summarise(i / 2, i % 2);
    gn_context_destroy(context);
    return 0;
}
