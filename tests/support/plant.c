/* plant.c - see plant.h. */
#include "plant.h"

#include <math.h>
#include <string.h>

#include "gn_test.h"

#define BUDGET 16.6
#define HOST   5.0

const char *const plant_load_names[PLANT_LOADS] = {"step", "ramp", "sine", "square", "noise", "host", "recorded"};
const char *const plant_control_names[PLANT_CONTROLS] = {"selector", "full", "half", "pid"};

/* How many fragments a light's volumes had in every fifteenth frame of a walk through a scene, as multiples of the mean. */
static const double recorded[] = {
#include "recorded_load.h"
};

static double load_at(plant_load load, int frame)
{
    const int count = (int)(sizeof recorded / sizeof recorded[0]);

    switch (load) {
    case PLANT_STEP:
        return frame < 600 ? 1.0 : frame < 1800 ? 3.0 : 1.0;
    case PLANT_RAMP:
        return 0.5 + 3.0 * frame / PLANT_FRAMES;
    case PLANT_SINE:
        return 1.5 + 1.0 * sin(frame * 6.283185307179586 / 150.0);
    case PLANT_SQUARE:
        return frame / 150 % 2 ? 2.5 : 0.8;
    case PLANT_RECORDED:
        return recorded[frame / 15 % count] +
               (recorded[(frame / 15 + 1) % count] - recorded[frame / 15 % count]) * (frame % 15) / 15.0;
    default:
        return 1.0;
    }
}

/* A sum of twelve even numbers is nearly normal. */
static double normal(uint32_t *seed)
{
    double sum = -6.0;

    for (int i = 0; i < 12; i++)
        sum += test_uniform(seed, 0, 1);
    return sum;
}

static void set_lights(gn_light_state lights[PLANT_LIGHTS], double load)
{
    memset(lights, 0, PLANT_LIGHTS * sizeof *lights);
    for (int i = 0; i < PLANT_LIGHTS; i++) {
        gn_light_state *l = &lights[i];

        l->importance = 1.0 / (i + 1);
        l->load.pixels = 40000.0;
        l->load.fragments = 100000.0 * load;
        l->load.indices = 6000.0;
        l->facts.lights = PLANT_LIGHTS;
        l->facts.layers = l->load.fragments / (2.0 * l->load.pixels);
        l->facts.edges = 1000.0;
        l->facts.faces = 4000.0;
        l->facts.nearness = 0.4;
        l->facts.motion = 0.2;
        l->facts.moving = 1.0;
        l->facts.power = 0.5;
    }
}

/* Passes that a light's way is first to need; 0 where an earlier light has it. */
static double passes_of(const gn_way *ways, uint32_t light, uint32_t count)
{
    uint32_t alike = 0;

    for (uint32_t i = 0; i < count; i++) {
        const int is_same = memcmp(&ways[i], &ways[light], sizeof ways[i]) == 0;

        if (is_same && i < light)
            return 0.0;
        alike += (uint32_t)is_same;
    }
    return gn_count_passes(&ways[light], alike);
}

/* What the ways take, in a selection that is the board's own. */
static double true_ms(const gn_selection *board, const gn_way *ways, int *accuracy)
{
    double sum = 0.0;

    *accuracy = GN_ACCURACY_EXACT;
    for (uint32_t i = 0; i < board->light_count; i++) {
        const struct gn_known_way *known;
        const gn_load *load = &board->lights[i].load;
        const gn_way *way = &ways[i];
        double counts[GN_COST_COUNT];

        if (way->is_dropped) {
            *accuracy = GN_ACCURACY_NONE;
            continue;
        }
        known = &board->knowledge->ways[way->method][gn_way_variant(way)];
        *accuracy = (int)known->accuracy < *accuracy ? (int)known->accuracy : *accuracy;
        gn_count_costs(way, load, counts);
        counts[GN_COST_SETUP] = passes_of(ways, i, board->light_count);
        for (int c = 0; c < GN_COST_COUNT; c++)
            sum += board->gains[way->method] * known->us[c] * counts[c] / 1000.0;
    }
    return sum;
}

/* Full, half or quarter masks by a controller that knows of nothing but the last frame's time. */
static void steer(double ms, double *integral, double *last_error, gn_way ways[PLANT_LIGHTS])
{
    const double error = (ms - 0.9 * BUDGET) / BUDGET;
    double level;

    *integral = fmin(fmax(*integral + error, -20.0), 20.0);
    level = 1.0 + 1.0 * error + 0.1 * *integral + 0.5 * (error - *last_error);
    *last_error = error;
    for (int i = 0; i < PLANT_LIGHTS; i++)
        ways[i].scale = level < 1.5 ? 1 : level < 2.5 ? 2 : 4;
}

/* What the selector knows: the library's ways at round numbers, those of a slow GPU. */
static void make_knowledge(gn_knowledge *k)
{
    static const double times[GN_METHOD_TOTAL] = {0, 0, 0, 1, 1.5, 2, 3, 4, 4}; /* a fragment's, of a stencil's */

    gn_knowledge_default(k);
    for (int m = 0; m < GN_METHOD_TOTAL; m++)
        for (int v = 0; v < GN_VARIANT_COUNT; v++) {
            const double scale = gn_variant_scale(v);
            const double reads = v == GN_VARIANT_FULL ? 0.0
                                 : v % 2              ? 1.0
                                                      : 3.0; /* of the mask, by the frame's pixels */
            const double us[GN_COST_COUNT] = {200, 0.02, 0.01 * times[m], 0.0, 0.02 + 0.01 * reads * scale * scale,
                                              100};

            memcpy(k->ways[m][v].us, us, sizeof us);
        }
}

int plant_simulate(gn_context *context, plant_load load, plant_control control, double noise, plant_run *out)
{
    static const double factors[GN_METHOD_TOTAL] = {1, 1, 1, 1.3, 0.8, 1.2, 0.7, 1, 1};
    gn_selection board = {.light_count = PLANT_LIGHTS, .gains = factors, .target_pixels = 300000.0}, asked;
    gn_light_state lights[PLANT_LIGHTS];
    gn_way ways[PLANT_LIGHTS], last[PLANT_LIGHTS];
    gn_selector *selector = NULL;
    gn_knowledge knowledge;
    double integral = 0.0, last_error = 0.0;
    uint32_t seed = 77;

    make_knowledge(&knowledge);
    board.knowledge = &knowledge;
    board.lights = lights;
    memset(&asked, 0, sizeof asked);
    asked.budget.frame_ms = out->budget_ms = BUDGET;
    asked.target_pixels = board.target_pixels;
    memset(asked.possible.variants, 0xff, sizeof asked.possible.variants);
    if (control == PLANT_SELECTOR && gn_selector_create(context, &knowledge, NULL, &selector) != GN_OK)
        return 0;
    if (selector)
        gn_selector_set(selector, &asked);
    for (int i = 0; i < PLANT_LIGHTS; i++)
        ways[i] = (gn_way){0, GN_METHOD_STENCIL, control == PLANT_HALF ? 2 : 1, GN_UPSAMPLE_BILINEAR, 1, 0};
    for (int f = 0; f < PLANT_FRAMES; f++) {
        plant_frame *frame = &out->frames[f];
        const double host = load == PLANT_HOST && f >= 600 && f < 1800 ? 2.0 * HOST : HOST;

        frame->load = load_at(load, f);
        set_lights(lights, frame->load);
        if (selector && gn_selector_next(selector, lights, PLANT_LIGHTS, ways) != GN_OK) {
            gn_selector_destroy(selector);
            return 0;
        }
        frame->ms = (host + true_ms(&board, ways, &frame->accuracy)) * fmax(1.0 + noise * normal(&seed), 0.5);
        frame->predicted_ms = selector ? gn_selector_predicted(selector) : 0.0;
        frame->changes = 0;
        for (int i = 0; i < PLANT_LIGHTS; i++)
            frame->changes += f > 0 && memcmp(&last[i], &ways[i], sizeof last[i]) != 0;
        memcpy(last, ways, sizeof last);
        if (selector)
            gn_selector_measured(selector, frame->ms);
        if (control == PLANT_PID)
            steer(frame->ms, &integral, &last_error, ways);
    }
    gn_selector_destroy(selector);
    return 1;
}

double plant_over(const plant_run *run, int from, int to)
{
    int over = 0;

    for (int f = from; f < to; f++)
        over += run->frames[f].ms > run->budget_ms;
    return (double)over / (to - from);
}

double plant_changes(const plant_run *run, int from, int to)
{
    int changes = 0;

    for (int f = from; f < to; f++)
        changes += run->frames[f].changes > 0;
    return 60.0 * changes / (to - from);
}
