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
#include <string.h>

#include "gn_select.h"
#include "picture.h"
#include "spread.h"
#include "stage.h"

enum { REPEATS = 7, MOST_ROWS = 4096 };
#define LEAST_MS 0.5

static double errors[2][MOST_ROWS];
static size_t error_count;

static int draw(stage *s, const stage_wish *wish, double *ms)
{
    char message[SCENE_MESSAGE];
    const double start = now_ms();

    if (stage_plan(s, wish, message) != 0 || !stage_draw_lit(s, 0, message))
        return 0;
    s->gl->glFinish();
    *ms = now_ms() - start;
    return 1;
}

static double predict(const stage *s, const gn_knowledge *k, const gn_load *loads, int m, int v, const stage_wish *wish)
{
    const double area = m == GN_METHOD_REFINE ? 1.0 : (double)wish->scale * wish->scale;
    const double *us = k->ways[m][v].us;
    double sum = us[GN_COST_SETUP];

    for (uint32_t i = 0; i < s->plan->light_count; i++)
        sum += us[GN_COST_INDEX] * loads[i].indices + us[GN_COST_FRAGMENT] * loads[i].fragments / area +
               us[GN_COST_PIXEL] * loads[i].pixels / area +
               us[GN_COST_SWITCH] * (m == GN_METHOD_STENCIL && wish->scale == 1 ? 1.0 : 2.0);
    return sum / 1000.0;
}

static void load_of(const stage *s, gn_load *loads)
{
    gn_facts facts;

    for (uint32_t i = 0; i < s->plan->light_count; i++)
        gn_plan_measure(s->plan, i, 0, &loads[i], &facts);
}

static int run_way(stage *s, const gn_knowledge *k, const char *name, int m, int v, const gn_load *of_stencil)
{
    const stage_wish plain = {.method = GN_METHOD_AUTO, .light_count = s->light_count};
    const stage_wish wish = {.method = (gn_method)m,
                             .casting = 1,
                             .light_count = s->light_count,
                             .scale = v == GN_VARIANT_FULL         ? 1
                                      : v <= GN_VARIANT_HALF_DEPTH ? 2
                                                                   : 4,
                             .upsample = v == GN_VARIANT_HALF_DEPTH || v == GN_VARIANT_QUARTER_DEPTH
                                             ? GN_UPSAMPLE_DEPTH
                                             : GN_UPSAMPLE_BILINEAR};
    double shadow[REPEATS], measured, own, foreseen;
    gn_load *loads;

    for (int i = -1; i < REPEATS; i++) {
        double without, with;

        if (!draw(s, &plain, &without) || !draw(s, &wish, &with))
            return 1; /* not possible here */
        shadow[i < 0 ? 0 : i] = with - without;
    }
    loads = calloc(s->light_count + 1, sizeof *loads);
    if (!loads)
        return 0;
    load_of(s, loads);
    measured = spread_of(shadow, REPEATS).median;
    own = predict(s, k, loads, m, v, &wish);
    foreseen = predict(s, k, of_stencil, m, v, &wish);
    for (uint32_t i = 1; i < s->plan->light_count; i++) {
        loads[0].indices += loads[i].indices;
        loads[0].fragments += loads[i].fragments;
        loads[0].pixels += loads[i].pixels;
    }
    printf("%s,%s,%u,%s,%u,%.0f,%.0f,%.0f,%.3f,%.3f,%.3f\n", name, gn_method_describe((gn_method)m)->name,
           (unsigned)wish.scale, wish.upsample == GN_UPSAMPLE_DEPTH ? "depth" : "bilinear",
           (unsigned)s->plan->light_count, loads[0].indices, loads[0].fragments, loads[0].pixels, measured, own,
           foreseen);
    free(loads);
    if (measured >= LEAST_MS && error_count < MOST_ROWS) {
        errors[0][error_count] = fabs(own / measured - 1.0);
        errors[1][error_count++] = fabs(foreseen / measured - 1.0);
    }
    return 1;
}

static int run_scene(const gn_knowledge *k, const char *name)
{
    const stage_options options = {.width = 320, .height = 240, .depth_bits = 24, .stencil_bits = 8};
    const stage_wish stencil = {.method = GN_METHOD_STENCIL, .casting = 1};
    stage_wish wish = stencil;
    char path[256], message[SCENE_MESSAGE] = "";
    gn_load *of_stencil;
    stage *s = NULL;
    scene loaded;
    int ok;

    snprintf(path, sizeof path, "build/scenes/%s.gltf", name);
    if (!scene_load(&loaded, path, NULL, message) || !scene_ensure_view(&loaded, 4.0 / 3.0, NULL) ||
        stage_open(&s, &loaded, &options, message) != 0) {
        fprintf(stderr, "bench_predict: %s: %s\n", name, message);
        return 0;
    }
    stage_pose(s, 0.0, 0.0);
    wish.light_count = s->light_count;
    of_stencil = calloc(s->light_count + 1, sizeof *of_stencil);
    ok = of_stencil && stage_plan(s, &wish, message) == 0;
    if (ok)
        load_of(s, of_stencil);
    for (int m = 0; m < GN_METHOD_TOTAL && ok; m++)
        for (int v = 0; v < GN_VARIANT_COUNT && ok; v++)
            ok = !k->ways[m][v].is_known || run_way(s, k, name, m, v, of_stencil);
    free(of_stencil);
    stage_close(s);
    scene_free(&loaded);
    return ok;
}

int main(int count, char **arguments)
{
    static char text[65536];
    gn_context *context;
    gn_knowledge k;
    FILE *f = count > 2 ? fopen(arguments[1], "r") : NULL;
    size_t length;

    if (!f)
        return fprintf(stderr, "usage: bench_predict KNOWLEDGE.csv SCENE...\n"), 2;
    length = fread(text, 1, sizeof text, f);
    fclose(f);
    if (gn_context_create(NULL, &context) != GN_OK)
        return 1;
    if (gn_knowledge_read(context, text, length, &k) != GN_OK)
        return fprintf(stderr, "bench_predict: %s\n", gn_message(context)), 1;
    printf("scene,method,scale,upsample,lights,indices,fragments,pixels,shadow_ms,predicted_ms,foreseen_ms\n");
    for (int i = 2; i < count; i++)
        if (!run_scene(&k, arguments[i]))
            return 1;
    for (int i = 0; i < 2 && error_count > 0; i++) {
        qsort(errors[i], error_count, sizeof(double), by_value);
        printf("# %s: median error %.3f, three quarters within %.3f, of %lu rows\n", i ? "foreseen" : "predicted",
               errors[i][error_count / 2], errors[i][error_count * 3 / 4], (unsigned long)error_count);
    }
    gn_context_destroy(context);
    return 0;
}
