/* bench_select.c - what deciding costs: one row of a CSV for each number of lights.
 *
 *     bench_select
 *
 * Microseconds a light of gn_selector_next() with the library's rules and all ways possible (masks of 1, 2 and 4 frames, proxies), of
 * gn_plan_measure() of a pile's plan, and of one evaluation of the rules; medians of 99, the processor's time. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gn_matrix.h"
#include "gn_select.h"
#include "pile.h"
#include "processor.h"
#include "spread.h"

enum { REPEATS = 99, INNER = 20 };

static double median(double *us)
{
    return spread_of(us, REPEATS).median;
}

static double evaluate_us(gn_context *context)
{
    double us[REPEATS], inputs[GN_FACT_COUNT] = {3, 1, 4, 3000, 900, 0.3, 0.2, 0.4, 0.5}, outputs[64];
    gn_rules *rules;

    if (gn_rules_default(context, &rules) != GN_OK)
        return -1.0;
    for (int i = 0; i < REPEATS; i++) {
        const double start = processor_ms();

        for (int k = 0; k < 50 * INNER; k++) {
            inputs[0] = k % 8;
            gn_rules_evaluate(rules, inputs, outputs, NULL);
        }
        us[i] = 1000.0 * (processor_ms() - start) / (50 * INNER);
    }
    gn_rules_destroy(rules);
    return median(us);
}

static double decide_us(gn_context *context, uint32_t count)
{
    gn_selection asked = {.target_pixels = 640 * 480, .has_proxies = 1, .updates = 4, .budget = {.frame_ms = 16.6}};
    gn_light_state lights[GN_MOST_SELECTED];
    gn_way ways[GN_MOST_SELECTED];
    gn_selector *selector;
    double us[REPEATS];

    memset(asked.possible.variants, 0xff, sizeof asked.possible.variants);
    memset(asked.possible.keeps, 0xff, sizeof asked.possible.keeps);
    memset(lights, 0, sizeof lights);
    for (uint32_t i = 0; i < count; i++) {
        lights[i].load = (gn_load){4000, 200000.0 + 10000.0 * i, 100000, 100000};
        lights[i].facts = (gn_facts){count, 1, 2, 3000, 900, 0.3, 0.2, 0.5, 0.5};
        lights[i].importance = i;
    }
    if (gn_selector_create(context, NULL, NULL, &selector) != GN_OK)
        return -1.0;
    gn_selector_set(selector, &asked);
    for (int i = 0; i < REPEATS; i++) {
        const double start = processor_ms();

        for (int k = 0; k < INNER; k++) {
            gn_selector_next(selector, lights, count, ways);
            gn_selector_measured(selector, 14.0 + k % 4);
        }
        us[i] = 1000.0 * (processor_ms() - start) / (INNER * count);
    }
    gn_selector_destroy(selector);
    return median(us);
}

static double measure_us(gn_context *context)
{
    pile_mesh lump, ground;
    gn_scene scene;
    const gn_plan *plan;
    pile p = {.side = 2, .light_count = 1};
    double us[REPEATS];
    void *memory;
    size_t size;

    if (!pile_make_lump(&lump, context, 24, 40) || !pile_make_floor(&ground, context, 16, (float)pile_floor_half(2)))
        return -1.0;
    p.meshes[0] = &lump;
    p.meshes[1] = &ground;
    pile_pose(&p, 3, 4.0 / 3.0);
    memset(&scene, 0, sizeof scene);
    scene.camera = p.camera;
    scene.lights = p.lights;
    scene.light_count = 1;
    scene.objects = p.objects;
    scene.object_count = p.object_count;
    scene.target = (gn_target){.width = 640,
                               .height = 480,
                               .red_bits = 8,
                               .green_bits = 8,
                               .blue_bits = 8,
                               .alpha_bits = 8,
                               .depth_bits = 24,
                               .stencil_bits = 8,
                               .image_depth_bits = 24,
                               .advertised = (1u << GN_CAPABILITY_COUNT) - 1,
                               .proven = (1u << GN_CAPABILITY_COUNT) - 1};
    size = gn_plan_bound(&scene);
    memory = malloc(size);
    if (!memory || gn_plan_make(context, &scene, memory, size, &plan) != GN_OK)
        return -1.0;
    for (int i = 0; i < REPEATS; i++) {
        const double start = processor_ms();

        for (int k = 0; k < INNER; k++) {
            gn_load load;
            gn_facts facts;

            gn_plan_measure(plan, 0, 0, &load, &facts);
        }
        us[i] = 1000.0 * (processor_ms() - start) / INNER;
    }
    free(memory);
    pile_drop(&lump);
    pile_drop(&ground);
    return median(us);
}

int main(void)
{
    static const uint32_t counts[] = {1, 2, 4, 8, 16};
    gn_context *context;

    if (gn_context_create(NULL, &context) != GN_OK)
        return 1;
    printf("what,lights,us_a_light\nrules evaluated once,1,%.3f\n", evaluate_us(context));
    printf("load and facts of a plan,1,%.2f\n", measure_us(context));
    for (size_t i = 0; i < sizeof counts / sizeof counts[0]; i++)
        printf("decided,%u,%.2f\n", (unsigned)counts[i], decide_us(context, counts[i]));
    gn_context_destroy(context);
    return 0;
}
