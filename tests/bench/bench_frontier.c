/* bench_frontier.c - whether what is chosen is among the best that could be: one row of a CSV for each scene and budget.
 *
 *     bench_frontier KNOWLEDGE.csv SCENE...
 *
 * Every way that is known is drawn on the scene, all lights alike, at 320x240: frames and the host's part of them, medians of seven.
 * Then for budgets from less than the cheapest takes to more than the dearest one way is chosen for all lights (the
 * least accurate of gn_select()'s), by knowledge alone, nothing learnt. It is on the frontier where no other way is as
 * accurate or more and takes less; beside: by how much the best of those takes less. Accuracy is the class; of small masks
 * by depth and bilinear, the former is more accurate. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gn_select.h"
#include "picture.h"
#include "spread.h"
#include "stage.h"

enum { REPEATS = 7, BUDGETS = 8 };
#define NEAR 1.1

typedef struct measured {
    double ms[GN_METHOD_TOTAL][GN_VARIANT_COUNT]; /* NAN: not possible */
    double host_ms;
} measured;

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

static double median_ms(stage *s, const stage_wish *wish)
{
    double ms[REPEATS];

    for (int i = -1; i < REPEATS; i++)
        if (!draw(s, wish, &ms[i < 0 ? 0 : i]))
            return NAN;
    return spread_of(ms, REPEATS).median;
}

static void measure(stage *s, const gn_knowledge *k, measured *out)
{
    const stage_wish plain = {.method = GN_METHOD_AUTO, .light_count = s->light_count};

    out->host_ms = median_ms(s, &plain);
    for (int m = 0; m < GN_METHOD_TOTAL; m++)
        for (int v = 0; v < GN_VARIANT_COUNT; v++) {
            const stage_wish wish = {.method = (gn_method)m,
                                     .casting = 1,
                                     .light_count = s->light_count,
                                     .scale = v == GN_VARIANT_FULL ? 1 : v <= GN_VARIANT_HALF_DEPTH ? 2 : 4,
                                     .upsample = v == GN_VARIANT_HALF_DEPTH || v == GN_VARIANT_QUARTER_DEPTH
                                                     ? GN_UPSAMPLE_DEPTH
                                                     : GN_UPSAMPLE_BILINEAR};

            out->ms[m][v] = k->ways[m][v].is_known ? median_ms(s, &wish) : NAN;
        }
}

static int rank_of(const gn_knowledge *k, int m, int v)
{
    return 2 * (int)k->ways[m][v].accuracy + (v == GN_VARIANT_HALF_DEPTH || v == GN_VARIANT_QUARTER_DEPTH);
}

/* The least time of what is as accurate as a way, or more. */
static double best_of(const measured *all, const gn_knowledge *k, int rank)
{
    double best = INFINITY;

    for (int m = 0; m < GN_METHOD_TOTAL; m++)
        for (int v = 0; v < GN_VARIANT_COUNT; v++)
            if (!isnan(all->ms[m][v]) && rank_of(k, m, v) >= rank)
                best = fmin(best, all->ms[m][v]);
    return best;
}

static int variant_of(const gn_way *way)
{
    return way->scale == 1 ? GN_VARIANT_FULL
                           : (way->scale == 2 ? GN_VARIANT_HALF : GN_VARIANT_QUARTER) + (way->upsample == GN_UPSAMPLE_DEPTH);
}

/* Adds to how many there are, and how many of them are on the frontier. */
static int choose(gn_context *context, gn_rules *rules, const stage *s, const gn_knowledge *k, const measured *all, const char *name,
                  const gn_light_state *lights, double budget, int counts[2])
{
    gn_selection selection = {.knowledge = k,
                              .rules = rules,
                              .budget = {.frame_ms = budget, .quality = GN_ACCURACY_ROUGH},
                              .host_ms = all->host_ms,
                              .target_pixels = 320 * 240,
                              .lights = lights,
                              .light_count = s->light_count};
    gn_choice choices[GN_MOST_SELECTED];
    gn_scene like;
    uint32_t least = 0;
    char way[80];
    double ms, best;
    int m, v;

    memset(&like, 0, sizeof like);
    like.target = s->target;
    like.reads_masks = 1;
    gn_find_possible(&like, &selection.possible);
    if (gn_select(context, &selection, choices) != GN_OK)
        return fprintf(stderr, "bench_frontier: %s\n", gn_message(context)), 0;
    for (uint32_t i = 1; i < s->light_count; i++)
        least = choices[i].accuracy < choices[least].accuracy ? i : least;
    m = (int)choices[least].way.method;
    v = variant_of(&choices[least].way);
    ms = all->ms[m][v];
    if (isnan(ms))
        return 1;
    best = best_of(all, k, rank_of(k, m, v));
    gn_way_name(&choices[least].way, way, sizeof way);
    printf("%s,%.2f,%s,%s,%.2f,%.2f,%.2f\n", name, budget, way, gn_accuracy_name(k->ways[m][v].accuracy), ms, best, ms / best);
    counts[0]++;
    counts[1] += ms <= NEAR * best;
    return 1;
}

static int run_scene(gn_context *context, gn_rules *rules, const gn_knowledge *k, const char *name, int counts[2])
{
    const stage_options options = {.width = 320, .height = 240, .depth_bits = 24, .stencil_bits = 8};
    gn_light_state lights[GN_MOST_SELECTED];
    stage_wish wish = {.method = GN_METHOD_AUTO, .casting = 1};
    char path[256], message[SCENE_MESSAGE] = "";
    double least = INFINITY, most = 0.0;
    static measured all;
    stage *s = NULL;
    scene loaded;
    int ok = 1;

    snprintf(path, sizeof path, "build/scenes/%s.gltf", name);
    if (!scene_load(&loaded, path, NULL, message) || !scene_ensure_view(&loaded, 4.0 / 3.0, NULL) ||
        stage_open(&s, &loaded, &options, message) != 0) {
        fprintf(stderr, "bench_frontier: %s: %s\n", name, message);
        return 0;
    }
    stage_pose(s, 0.0, 0.0);
    measure(s, k, &all);
    wish.light_count = s->light_count;
    memset(lights, 0, sizeof lights);
    ok = s->light_count <= GN_MOST_SELECTED && stage_plan(s, &wish, message) == 0;
    for (uint32_t i = 0; ok && i < s->light_count; i++) {
        gn_plan_measure(s->plan, i, 0, &lights[i].load, &lights[i].facts);
        lights[i].facts.motion = 0.2;
        lights[i].importance = lights[i].load.pixels;
    }
    for (int m = 0; m < GN_METHOD_TOTAL; m++)
        for (int v = 0; v < GN_VARIANT_COUNT; v++)
            if (!isnan(all.ms[m][v])) {
                least = fmin(least, all.ms[m][v]);
                most = fmax(most, all.ms[m][v]);
            }
    for (int b = 0; ok && b < BUDGETS && most > 0.0; b++)
        ok = choose(context, rules, s, k, &all, name, lights, 0.9 * least * pow(1.3 * most / least, (double)b / (BUDGETS - 1)), counts);
    stage_close(s);
    scene_free(&loaded);
    return ok;
}

int main(int count, char **arguments)
{
    static char text[65536];
    int counts[2] = {0, 0};
    gn_context *context;
    gn_rules *rules;
    gn_knowledge k;
    FILE *f = count > 2 ? fopen(arguments[1], "r") : NULL;
    size_t length;

    if (!f)
        return fprintf(stderr, "usage: bench_frontier KNOWLEDGE.csv SCENE...\n"), 2;
    length = fread(text, 1, sizeof text, f);
    fclose(f);
    if (gn_context_create(NULL, &context) != GN_OK || gn_rules_create(context, NULL, 0, &rules) != GN_OK)
        return 1;
    if (gn_knowledge_read(context, text, length, &k) != GN_OK)
        return fprintf(stderr, "bench_frontier: %s\n", gn_message(context)), 1;
    printf("scene,budget_ms,way,accuracy,frame_ms,best_ms,ratio\n");
    for (int i = 2; i < count; i++)
        if (!run_scene(context, rules, &k, arguments[i], counts))
            return 1;
    printf("# on the frontier or within a tenth of it: %d of %d\n", counts[1], counts[0]);
    gn_rules_destroy(rules);
    gn_context_destroy(context);
    return 0;
}
