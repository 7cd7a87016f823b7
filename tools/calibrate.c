/* calibrate.c - `gnomon calibrate`: what each way to make shadows costs on this board, as the coefficients of a small model.
 *
 * A sample scene is drawn with few and with many casters, without shadows and by each way that is possible. The shadow part of each frame, the difference, is to be a sum over what its plan says that there is to draw. Few
 * frames fit into two seconds, and they are noisy: so the default's coefficients are kept but for how much slower the board
 * is, then each way, then, where the frames insist, each coefficient. */
#include "command.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "accuracy.h"
#include "fit.h"
#include "options.h"
#include "picture.h"
#include "sample_scene.h"
#include "spread.h"
#include "stage.h"

const char help_calibrate[] =
    "usage: gnomon calibrate -o FILE.csv [options]\n"
    "\n"
    "Measures on this board what each way to make shadows costs, and writes it as a CSV that `gnomon render`\n"
    "and `gnomon select` take with --knowledge. In less than two seconds.\n"
    "\n"
    "  -o FILE.csv           a row for each way that is possible: its accuracy, then for time (us_) and\n"
    "                        memory traffic (bytes_) what a frame, an index of volumes, a fragment of\n"
    "                        them, a pixel of their triangles' borders, a pixel of the mask and a switch\n"
    "                        of target cost\n"
    "  --trade FILE.csv      takes accuracies from a table of `gnomon measure`\n"
    "  --platform NAME       egl or osmesa [the first that works]\n"
    "  --hide CAP[,CAP...]   pretends that capabilities are absent\n"
    "  --help                this text\n";

/* Frames that are drawn: with so many casters. All are of one size and two lights, since what is made and compiled for another
 * would be measured with it for some frames. */
static const struct sample {
    int coarse, fine;
} samples[] = {{2, 0}, {3, 1}, {5, 0}};
enum { SAMPLES = sizeof samples / sizeof samples[0], DRAWS = 2, LIGHTS = 2 };

#define STRAYS 1.4  /* so many times dearer or cheaper a way may look in the sample than it is in other scenes */
#define FREE   0.1  /* of what is likely: no way is so cheap */
#define DEARER 1.4  /* the sample is than test scenes with as much to draw (bench_predict) */
#define ENOUGH 1700 /* ms: no further way is observed; what was not follows what was */

typedef struct observed {
    double counts[SAMPLES][FIT_MOST], us[SAMPLES], bytes[SAMPLES];
    int rows; /* 0: it is not measured, or not possible */
} observed;

/* Quarter masks are as much dearer than is likely as half ones, and masks by depth of the other methods as count's: time is short. */
static int is_measured(int method, int variant)
{
    return variant == GN_VARIANT_FULL || variant == GN_VARIANT_HALF ||
           (variant == GN_VARIANT_HALF_DEPTH && (method == GN_METHOD_STENCIL || method == GN_METHOD_COUNT));
}

static int variant_wish(int method, int variant, stage_wish *wish)
{
    wish->method = (gn_method)method;
    wish->scale = gn_variant_scale(variant);
    wish->upsample = gn_variant_upsample(variant);
    return method == GN_METHOD_REFINE ? variant == GN_VARIANT_HALF || variant == GN_VARIANT_QUARTER
                                      : method > GN_METHOD_ZPASS;
}

/* One frame; 0 where it cannot be. */
static int draw(stage *s, const stage_wish *wish, double *us, char message[SCENE_MESSAGE])
{
    const double start = now_ms();

    if (stage_plan(s, wish, message) != 0 || !stage_draw_lit(s, 0, message))
        return 0;
    s->gl->glFinish();
    *us = 1000.0 * (now_ms() - start);
    return 1;
}

static void note_counts(const stage *s, const stage_wish *wish, double counts[FIT_MOST])
{
    const gn_way way = {.method = wish->method, .scale = wish->scale};

    memset(counts, 0, FIT_MOST * sizeof *counts);
    for (uint32_t i = 0; i < s->plan->light_count; i++) {
        gn_load load;
        gn_facts facts;
        double of_light[GN_COST_COUNT];

        gn_plan_measure(s->plan, i, 1024, &load, &facts);
        gn_count_costs(&way, &load, of_light);
        for (int c = 0; c < GN_COST_COUNT; c++)
            counts[c] += of_light[c];
    }
    counts[GN_COST_SETUP] = 1.0;
}

static double traffic_of(const stage *s)
{
    return s->plan->traffic.written + s->plan->traffic.read;
}

/* A sample by one way; what is made and compiled for it is not measured. */
static int observe(stage *s, const stage_wish *wish, observed *o)
{
    char message[SCENE_MESSAGE];
    double us = 0.0;

    for (int k = -1; k < DRAWS; k++) {
        double one;

        if (!draw(s, wish, &one, message))
            return 0;
        us += k < 0 ? 0.0 : one / DRAWS;
    }
    note_counts(s, wish, o->counts[o->rows]);
    o->us[o->rows] = us;
    o->bytes[o->rows++] = traffic_of(s);
    return 1;
}

/* A sample by all ways, and without shadows before each of them, so that both meet the same machine. */
static int observe_sample(stage *s, double until, observed all[GN_METHOD_TOTAL][GN_VARIANT_COUNT],
                          char message[SCENE_MESSAGE])
{
    const stage_wish plain = {.method = GN_METHOD_AUTO, .light_count = LIGHTS};
    double us[1 + GN_METHOD_TOTAL * GN_VARIANT_COUNT], bytes = 0.0;
    observed *fresh[GN_METHOD_TOTAL * GN_VARIANT_COUNT];
    int count = 0, fresh_count = 0;

    for (int m = 0; m < GN_METHOD_TOTAL; m++)
        for (int v = 0; v < GN_VARIANT_COUNT; v++) {
            stage_wish wish = {.casting = 1, .light_count = LIGHTS};

            if (!variant_wish(m, v, &wish) || !is_measured(m, v) || now_ms() > until)
                continue;
            for (int k = count ? 1 : 0; k < 2; k++) /* the first of all makes what is kept */
                if (!draw(s, &plain, &us[count], message))
                    return 0;
            count++;
            bytes = traffic_of(s);
            if (observe(s, &wish, &all[m][v]))
                fresh[fresh_count++] = &all[m][v];
        }
    qsort(us, (size_t)count, sizeof *us, by_value);
    for (int i = 0; i < fresh_count; i++) {
        fresh[i]->us[fresh[i]->rows - 1] -= us[count / 2];
        fresh[i]->bytes[fresh[i]->rows - 1] -= bytes;
    }
    return 1;
}

static int observe_all(stage *s, scene *of, observed all[GN_METHOD_TOTAL][GN_VARIANT_COUNT],
                       char message[SCENE_MESSAGE])
{
    const double until = now_ms() + ENOUGH;

    for (int i = 0; i < SAMPLES && now_ms() < until; i++) {
        sample_scene_cast(of, samples[i].coarse, samples[i].fine);
        if (!observe_sample(s, until, all, message))
            return 0;
    }
    return 1;
}

/* By how much what is likely of a way must be multiplied, over all its rows; of what, how much that would be. */
static double multiple_of(const observed *o, const double *values, const double *likely, double *expected)
{
    double sum = 0.0;

    *expected = 0.0;
    for (int i = 0; i < o->rows; i++) {
        sum += values[i];
        for (int c = 0; c < GN_COST_COUNT; c++)
            *expected += o->counts[i][c] * likely[c];
    }
    return sum / *expected;
}

/* Of time, the median of all ways': how much faster or slower the board is than the default's. */
static double board_multiple(observed all[GN_METHOD_TOTAL][GN_VARIANT_COUNT], const gn_knowledge *k)
{
    double multiples[GN_METHOD_TOTAL * GN_VARIANT_COUNT], expected;
    size_t count = 0;

    for (int m = 0; m < GN_METHOD_TOTAL; m++)
        for (int v = 0; v < GN_VARIANT_COUNT; v++)
            if (k->ways[m][v].is_known && all[m][v].rows > 0)
                multiples[count++] = multiple_of(&all[m][v], all[m][v].us, k->ways[m][v].us, &expected);
    return count ? fmax(spread_of(multiples, count).median / DEARER, 1e-3) : 1.0;
}

/* A way's own multiple: the board's, but for by how much it is farther from that than a few frames of one scene may be. What
 * looks as good as free was not measured: the frames without shadows met a busier machine. */
static double own_multiple(const observed *o, const double *values, double board, const double *costs)
{
    double expected;
    const double ratio = multiple_of(o, values, costs, &expected) / board;

    if (!(ratio > FREE))
        return board;
    return board * (ratio > 1.0 ? fmax(ratio / STRAYS, 1.0) : fmin(ratio * STRAYS, 1.0));
}

/* Costs times the multiple; and from there, where the way itself was measured, each coefficient. */
static void fit_way(const observed *o, const double *values, double multiple, double *costs)
{
    for (int c = 0; c < GN_COST_COUNT; c++)
        costs[c] *= multiple;
    if (o->rows > 0) {
        double likely[GN_COST_COUNT];

        memcpy(likely, costs, sizeof likely);
        fit_costs((const double(*)[FIT_MOST])o->counts, values, o->rows, GN_COST_COUNT, likely, costs);
    }
}

static void fit_all(observed all[GN_METHOD_TOTAL][GN_VARIANT_COUNT], gn_knowledge *k)
{
    const double board = board_multiple(all, k);

    for (int m = 0; m < GN_METHOD_TOTAL; m++) {
        double us = board, bytes = 1.0;

        for (int v = 0; v < GN_VARIANT_COUNT; v++) { /* what is not measured follows what is */
            const observed *o = &all[m][v];
            struct gn_known_way *way = &k->ways[m][v];

            if (way->is_known && o->rows > 0) {
                us = own_multiple(o, o->us, board, way->us);
                bytes = own_multiple(o, o->bytes, 1.0, way->bytes);
            }
            fit_way(o, o->us, us, way->us);
            fit_way(o, o->bytes, bytes, way->bytes);
        }
    }
}

static int write_knowledge(const gn_knowledge *k, const gn_possible *possible, const char *path)
{
    static const char *const costs[GN_COST_COUNT] = {"setup", "index", "fragment", "border", "pixel", "switch"};
    fresh_file f;

    if (!fresh_open(&f, path))
        return 0;
    fprintf(f.file, "method,scale,upsample,accuracy");
    for (int c = 0; c < 2 * GN_COST_COUNT; c++)
        fprintf(f.file, ",%s_%s", c < GN_COST_COUNT ? "us" : "bytes", costs[c % GN_COST_COUNT]);
    fprintf(f.file, "\n");
    for (int m = 0; m < GN_METHOD_TOTAL; m++)
        for (int v = 0; v < GN_VARIANT_COUNT; v++) {
            const struct gn_known_way *way = &k->ways[m][v];
            stage_wish wish;

            if (!way->is_known || !(possible->variants[m] >> v & 1))
                continue;
            variant_wish(m, v, &wish);
            fprintf(f.file, "%s,%u,%s,%s", gn_method_describe((gn_method)m)->name, (unsigned)wish.scale,
                    wish.scale == 1                      ? "none"
                    : wish.upsample == GN_UPSAMPLE_DEPTH ? "depth"
                                                         : "bilinear",
                    gn_accuracy_name(way->accuracy));
            for (int c = 0; c < 2 * GN_COST_COUNT; c++)
                fprintf(f.file, ",%.6g", c < GN_COST_COUNT ? way->us[c] : way->bytes[c - GN_COST_COUNT]);
            fprintf(f.file, "\n");
        }
    return fresh_close(&f, 1);
}

static int run(const char *path, const char *trade, const char *platform_name, const char *hide)
{
    const stage_options options = {
        .platform = platform_name, .width = 320, .height = 240, .depth_bits = 24, .stencil_bits = 8, .hide = hide};
    static observed all[GN_METHOD_TOTAL][GN_VARIANT_COUNT];
    char message[SCENE_MESSAGE] = "no memory for the sample scene";
    gn_knowledge knowledge;
    gn_possible possible;
    int status = EXIT_FAILED;
    stage *s = NULL;
    scene of;

    gn_knowledge_default(&knowledge);
    if (trade && !accuracy_from_trade(&knowledge, trade))
        return EXIT_FAILED;
    if (sample_scene_make(&of)) {
        status = stage_open(&s, &of, &options, message);
        if (status == EXIT_DONE) {
            const gn_scene like = {.target = s->target, .reads_masks = 1};

            gn_find_possible(&like, &possible);
            status = observe_all(s, &of, all, message) ? EXIT_DONE : EXIT_FAILED;
        }
        stage_close(s);
        scene_free(&of);
    }
    if (status != EXIT_DONE) {
        say("calibrate: %s", message);
        return status;
    }
    fit_all(all, &knowledge);
    return write_knowledge(&knowledge, &possible, path) ? EXIT_DONE : EXIT_FAILED;
}

int command_calibrate(int count, char **arguments)
{
    const char *path = NULL, *trade = NULL, *platform_name = NULL, *hide = NULL;
    const option options[] = {{"-o", OPTION_TEXT, &path, 0, 0},
                              {"--trade", OPTION_TEXT, &trade, 0, 0},
                              {"--platform", OPTION_TEXT, &platform_name, 0, 0},
                              {"--hide", OPTION_TEXT, &hide, 0, 0}};
    const int kept = parse_options(count, arguments, options, (int)(sizeof options / sizeof options[0]));

    if (kept < 0)
        return EXIT_USAGE;
    if (kept > 0 || !path) {
        say("calibrate: takes -o FILE.csv and no scene (%s)", kept > 0 ? arguments[0] : "none given");
        return EXIT_USAGE;
    }
    if (!check_hidden("--hide", hide) || !check_hidden("GNOMON_HIDE", getenv("GNOMON_HIDE")))
        return EXIT_USAGE;
    return run(path, trade, platform_name, hide);
}
