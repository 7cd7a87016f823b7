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
#include <string.h>

#include "spread.h"
#include "ways.h"

enum { REPEATS = 7, BUDGETS = 8 };
#define NEAR 1.1

typedef struct measured {
    double ms[GN_METHOD_TOTAL][GN_VARIANT_COUNT]; /* NAN: not possible */
    double host_ms;
} measured;

static double median_ms(ways_scene *w, int m, int v, int casting)
{
    double ms[REPEATS];

    for (int i = -1; i < REPEATS; i++)
        if (!ways_draw(w, m, v, casting, &ms[i < 0 ? 0 : i]))
            return NAN;
    return spread_of(ms, REPEATS).median;
}

static void measure(ways_scene *w, const gn_knowledge *k, measured *out)
{
    out->host_ms = median_ms(w, GN_METHOD_AUTO, GN_VARIANT_FULL, 0);
    for (int m = 0; m < GN_METHOD_TOTAL; m++)
        for (int v = 0; v < GN_VARIANT_COUNT; v++)
            out->ms[m][v] = k->ways[m][v].is_known ? median_ms(w, m, v, 1) : NAN;
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

/* Adds to how many there are, and how many of them are on the frontier. */
static int choose(gn_context *context, gn_rules *rules, const stage *s, const gn_knowledge *k, const measured *all,
                  const char *name, const gn_light_state *lights, double budget, int counts[2])
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
    v = gn_way_variant(&choices[least].way);
    ms = all->ms[m][v];
    if (isnan(ms))
        return 1;
    best = best_of(all, k, rank_of(k, m, v));
    gn_way_name(&choices[least].way, way, sizeof way);
    printf("%s,%.2f,%s,%s,%.2f,%.2f,%.2f\n", name, budget, way, gn_accuracy_name(k->ways[m][v].accuracy), ms, best,
           ms / best);
    counts[0]++;
    counts[1] += ms <= NEAR * best;
    return 1;
}

static int run_scene(gn_context *context, gn_rules *rules, const gn_knowledge *k, const char *name, int counts[2])
{
    gn_light_state lights[GN_MOST_SELECTED];
    double least = INFINITY, most = 0.0;
    static measured all;
    ways_scene w;
    int ok = ways_open(&w, name) && w.stage->light_count <= GN_MOST_SELECTED;

    if (ok)
        measure(&w, k, &all);
    memset(lights, 0, sizeof lights);
    for (uint32_t i = 0; ok && i < w.stage->light_count; i++) {
        lights[i].load = w.loads[i];
        lights[i].facts = w.facts[i];
        lights[i].facts.motion = 0.2;
        lights[i].importance = lights[i].load.pixels;
    }
    for (int m = 0; ok && m < GN_METHOD_TOTAL; m++)
        for (int v = 0; v < GN_VARIANT_COUNT; v++)
            if (!isnan(all.ms[m][v])) {
                least = fmin(least, all.ms[m][v]);
                most = fmax(most, all.ms[m][v]);
            }
    for (int b = 0; ok && b < BUDGETS && most > 0.0; b++)
        ok = choose(context, rules, w.stage, k, &all, name, lights,
                    0.9 * least * pow(1.3 * most / least, (double)b / (BUDGETS - 1)), counts);
    ways_close(&w);
    return ok;
}

int main(int count, char **arguments)
{
    int counts[2] = {0, 0};
    gn_context *context;
    gn_rules *rules;
    gn_knowledge k;

    if (count < 3)
        return fprintf(stderr, "usage: bench_frontier KNOWLEDGE.csv SCENE...\n"), 2;
    if (gn_context_create(NULL, &context) != GN_OK || gn_rules_default(context, &rules) != GN_OK ||
        !ways_read_knowledge(context, arguments[1], &k))
        return 1;
    printf("scene,budget_ms,way,accuracy,frame_ms,best_ms,ratio\n");
    for (int i = 2; i < count; i++)
        if (!run_scene(context, rules, &k, arguments[i], counts))
            return 1;
    printf("# on the frontier or within a tenth of it: %d of %d\n", counts[1], counts[0]);
    gn_rules_destroy(rules);
    gn_context_destroy(context);
    return 0;
}
