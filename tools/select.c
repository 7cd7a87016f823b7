/* select.c - `gnomon select`: the selector alone, without a GL: what it would take for a light of given facts, and why; and
 * control surfaces, what it says over two facts. */
#include "command.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "options.h"
#include "plotter.h"
#include "selecting.h"

const char help_select[] =
    "usage: gnomon select [--fact NAME=VALUE]... [options]\n"
    "\n"
    "Chooses how a light's shadows are made, from its facts and load, without drawing. Prints the way.\n"
    "\n"
    "  --fact NAME=VALUE     lights, moving, layers, faces, edges, nearness, motion, power; or of the load:\n"
    "                        indices, fragments, borders, pixels [lights 1, nearness 0.3, motion 0.1, power 1,\n"
    "                        layers 2, faces 2000, edges 500; fragments: twice layers times pixels; pixels\n"
    "                        100000; indices: 12 an edge; borders: of so many and large slender triangles]\n"
    "  --lights N            so many such lights, each less important than the one before [1]\n"
    "  --rules FILE.fcl      instead of the library's own\n"
    "  --prefer              what suits best of what can be paid for, whatever its accuracy\n"
    "  --knowledge FILE.csv  of `gnomon calibrate` [the library's own: a slow board]\n"
    "  --hide CAP[,CAP...]   capabilities that the board has not\n"
    "  --budget-ms MS        of a frame's time; --host-ms MS: what the host draws takes of it [0]\n"
    "  --budget-mw MW        of shadows' estimated power, at 60 frames a second\n"
    "  --budget-mb MB        of memory for masks\n"
    "  --quality CLASS       none, rough, fair, fine or exact: no less than that [none]\n"
    "  --updates N           masks may be used for 1, 2 or 4 frames [1]; --proxies: casters have some\n"
    "  --explain             a sentence for each light, and all that led to it\n"
    "  -o FILE.svg           a control surface, by gnuplot\n"
    "  --surface A,B         the two facts that it is over; the others are as given\n"
    "  --output NAME         what it shows: an output of the rules [which way is taken]\n"
    "  --help                this text\n";

enum { SIDE = 41, LOADS = 4 };

typedef struct job {
    selecting given;
    text_list facts;
    const char *hide, *picture, *surface, *output;
    double host_ms;
    long light_count, updates;
    int prefers, explain, has_proxies;
    int surface_facts[2];
    double values[GN_FACT_COUNT + LOADS]; /* facts, then loads; NAN: not given */
} job;

static const char *const load_names[LOADS] = {"indices", "fragments", "borders", "pixels"};

/* The place of a fact or a load; -1 having said that there is none. */
static int find_fact(const char *from, const char *name, size_t length)
{
    for (int i = 0; i < GN_FACT_COUNT + LOADS; i++) {
        const char *of = i < GN_FACT_COUNT ? gn_fact_name(i) : load_names[i - GN_FACT_COUNT];

        if (strlen(of) == length && strncmp(of, name, length) == 0)
            return i;
    }
    say("%s: no fact has that name (%.*s)", from, (int)length, name);
    return -1;
}

static int parse_facts(job *j)
{
    for (int i = 0; i < GN_FACT_COUNT + LOADS; i++)
        j->values[i] = NAN;
    for (int i = 0; i < j->facts.count; i++) {
        const char *text = j->facts.of[i], *equals = strchr(text, '=');
        char *end = NULL;
        int at;

        if (!equals) {
            say("--fact: takes NAME=VALUE (%s)", text);
            return 0;
        }
        at = find_fact("--fact", text, (size_t)(equals - text));
        if (at < 0)
            return 0;
        if (at < GN_FACT_COUNT && strcmp(gn_fact_name(at), "headroom") == 0) {
            say("--fact: headroom follows from --budget-ms and --host-ms (%s)", text);
            return 0;
        }
        j->values[at] = strtod(equals + 1, &end);
        if (end == equals + 1 || *end || !(j->values[at] >= 0.0 && j->values[at] <= 1e12)) {
            say("--fact: takes a number from 0 to 1e12 (%s)", text);
            return 0;
        }
    }
    return 1;
}

static int parse_surface(job *j)
{
    const char *comma = j->surface ? strchr(j->surface, ',') : NULL;

    if (!j->picture != !j->surface || (j->surface && !comma)) {
        say("select: a surface takes -o FILE.svg and --surface A,B (%s)", j->surface ? j->surface : j->picture);
        return 0;
    }
    if (!j->surface)
        return 1;
    j->surface_facts[0] = find_fact("--surface", j->surface, (size_t)(comma - j->surface));
    j->surface_facts[1] = find_fact("--surface", comma + 1, strlen(comma + 1));
    return j->surface_facts[0] >= 0 && j->surface_facts[1] >= 0;
}

static double given_or(double value, double otherwise)
{
    return isnan(value) ? otherwise : value;
}

/* A light of these facts; what is not given follows from what is, or is usual. */
static void set_light(const double *v, gn_light_state *light)
{
    static const double usual[GN_FACT_COUNT] = {1, 0, 2, 2000, 500, 0.3, 0.1, 1, 1};

    memset(light, 0, sizeof *light);
    for (int f = 0; f < GN_FACT_COUNT; f++)
        *gn_fact(&light->facts, f) = given_or(v[f], usual[f]);
    light->load.pixels = given_or(v[GN_FACT_COUNT + 3], 100000.0);
    light->load.fragments = given_or(v[GN_FACT_COUNT + 1], 2.0 * light->facts.layers * light->load.pixels);
    light->load.indices = given_or(v[GN_FACT_COUNT], 12.0 * light->facts.edges);
    light->load.borders = given_or(v[GN_FACT_COUNT + 2], 8.0 * sqrt(light->load.fragments * light->load.indices / 3.0));
}

static void set_possible(const job *j, gn_possible *out)
{
    const uint32_t all = (1u << GN_CAPABILITY_COUNT) - 1;
    gn_scene scene;

    memset(&scene, 0, sizeof scene);
    scene.target = (gn_target){.width = 640,
                               .height = 480,
                               .red_bits = 8,
                               .green_bits = 8,
                               .blue_bits = 8,
                               .alpha_bits = 8,
                               .depth_bits = 24,
                               .stencil_bits = 8,
                               .image_depth_bits = 24,
                               .mediump_bits = 23,
                               .advertised = all,
                               .proven = all};
    gn_capability_parse(j->hide, &scene.target.hidden);
    scene.reads_masks = 1;
    gn_find_possible(&scene, out);
}

static int print_choices(const job *j, gn_context *context, gn_selection *s)
{
    gn_choice choices[GN_MOST_SELECTED];
    gn_light_state lights[GN_MOST_SELECTED];
    static char text[65536];

    for (long i = 0; i < j->light_count; i++) {
        set_light(j->values, &lights[i]);
        lights[i].importance = 1.0 / (double)(i + 1);
        if (isnan(j->values[0]))
            lights[i].facts.lights = (double)j->light_count;
    }
    s->lights = lights;
    s->light_count = (uint32_t)j->light_count;
    if (gn_select(context, s, choices) != GN_OK) {
        say("%s", gn_message(context));
        return EXIT_MISSING;
    }
    for (uint32_t i = 0; i < s->light_count; i++) {
        if (j->explain) {
            gn_explain_choice(s, choices, i, 1, text, sizeof text);
            if (j->light_count > 1)
                printf("light %u: ", (unsigned)i);
        } else {
            gn_way_name(&choices[i].way, text, sizeof text);
        }
        printf("%s\n", text);
    }
    return EXIT_DONE;
}

/* ------------------------------------------------------------------ surfaces */

typedef struct surface {
    double low[2], high[2]; /* of the two facts */
    double z[SIDE][SIDE];   /* the output, or which of the names */
    char names[64][80];
    int name_count;
} surface;

/* From what the rules say of its range, or from nought to four times what it is. */
static void find_range(const job *j, const gn_rules *rules, const double *values, int axis, surface *of)
{
    const int fact = j->surface_facts[axis];
    double range[2] = {0.0, 0.0};
    gn_light_state light;

    set_light(values, &light);
    if (fact < GN_FACT_COUNT && gn_rules_range(rules, gn_rules_find_input(rules, gn_fact_name(fact)), range)) {
        of->low[axis] = range[0];
        of->high[axis] = range[1];
        return;
    }
    of->low[axis] = 0.0;
    of->high[axis] = 4.0 * (fact < GN_FACT_COUNT        ? fmax(*gn_fact(&light.facts, fact), 0.25)
                            : fact == GN_FACT_COUNT     ? light.load.indices
                            : fact == GN_FACT_COUNT + 1 ? light.load.fragments
                            : fact == GN_FACT_COUNT + 2 ? light.load.borders
                                                        : light.load.pixels);
}

static int find_name(surface *of, const gn_way *way)
{
    char name[80];
    int i = 0;

    gn_way_name(way, name, sizeof name);
    while (i < of->name_count && strcmp(of->names[i], name) != 0)
        i++;
    if (i == of->name_count && of->name_count < 64)
        memcpy(of->names[of->name_count++], name, sizeof name);
    return i;
}

static int find_point(const job *j, gn_context *context, gn_selection *s, const double *values, uint32_t output,
                      surface *of, double *z)
{
    gn_light_state light;
    gn_choice choice;

    set_light(values, &light);
    if (output != UINT32_MAX) {
        double inputs[GN_FACT_COUNT] = {0}, outputs[64] = {0};

        for (uint32_t i = 0; i < gn_rules_input_count(s->rules); i++)
            for (int f = 0; f < GN_FACT_COUNT; f++)
                if (strcmp(gn_fact_name(f), gn_rules_input(s->rules, i)) == 0)
                    inputs[i] = *gn_fact(&light.facts, f);
        gn_rules_evaluate(s->rules, inputs, outputs, NULL);
        *z = outputs[output];
        return 1;
    }
    (void)j;
    s->lights = &light;
    s->light_count = 1;
    if (gn_select(context, s, &choice) != GN_OK) {
        say("%s", gn_message(context));
        return 0;
    }
    *z = find_name(of, &choice.way);
    return 1;
}

static int plot(const job *j, const surface *of)
{
    const char *names[2];
    plotter p;

    for (int axis = 0; axis < 2; axis++)
        names[axis] = j->surface_facts[axis] < GN_FACT_COUNT ? gn_fact_name(j->surface_facts[axis])
                                                             : load_names[j->surface_facts[axis] - GN_FACT_COUNT];
    if (!plotter_start(&p, j->picture, 1, 1))
        return 0;
    fprintf(p.pipe, "set title '%s'\nset xlabel '%s'\nset ylabel '%s'\nset xrange [%g:%g]\nset yrange [%g:%g]\n",
            j->output ? j->output : "the way that is taken", names[0], names[1], of->low[0], of->high[0], of->low[1],
            of->high[1]);
    fprintf(p.pipe, "$points << EOD\n");
    for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++)
            fprintf(p.pipe, "%g %g %g\n", of->low[0] + (of->high[0] - of->low[0]) * x / (SIDE - 1),
                    of->low[1] + (of->high[1] - of->low[1]) * y / (SIDE - 1), of->z[y][x]);
    fprintf(p.pipe, "EOD\n");
    if (j->output) {
        fprintf(
            p.pipe,
            "set palette defined (0 '#2b3a67', 50 '#e8e1d4', 100 '#b5482a')\nset cbrange [0:100]\nset cblabel 'suits'\n"
            "plot $points using 1:2:3 with image\n");
    } else {
        fprintf(p.pipe, "set key outside right noenhanced\nset tics out\nplot ");
        for (int i = 0; i < of->name_count; i++)
            fprintf(p.pipe, "%s$points using 1:($3==%d?$2:1/0) with points pt 5 ps 0.9 title '%s'", i ? ", " : "", i,
                    of->names[i]);
        fprintf(p.pipe, "\n");
    }
    return plotter_finish(&p);
}

static int draw_surface(const job *j, gn_context *context, gn_selection *s)
{
    static surface of;
    uint32_t output = UINT32_MAX;

    if (j->output) {
        output = gn_rules_find_output(s->rules, j->output);
        if (output == UINT32_MAX || gn_rules_output_count(s->rules) > 64) {
            say("--output: the rules have no output of that name (%s)", j->output);
            return EXIT_USAGE;
        }
    }
    for (int axis = 0; axis < 2; axis++)
        find_range(j, s->rules, j->values, axis, &of);
    for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++) {
            double values[GN_FACT_COUNT + LOADS];

            memcpy(values, j->values, sizeof values);
            values[j->surface_facts[0]] = of.low[0] + (of.high[0] - of.low[0]) * x / (SIDE - 1);
            values[j->surface_facts[1]] = of.low[1] + (of.high[1] - of.low[1]) * y / (SIDE - 1);
            if (!find_point(j, context, s, values, output, &of, &of.z[y][x]))
                return EXIT_MISSING;
        }
    return plot(j, &of) ? EXIT_DONE : EXIT_FAILED;
}

/* ------------------------------------------------------------------ the command */

static int run(job *j)
{
    gn_selection s;
    selecting_files files;
    gn_context *context;
    int status;

    if (gn_context_create(NULL, &context) != GN_OK) {
        say("select: no memory");
        return EXIT_FAILED;
    }
    status = selecting_load(&j->given, context, &files);
    if (status == EXIT_DONE) {
        memset(&s, 0, sizeof s);
        s.knowledge = &files.knowledge;
        s.budget = files.budget;
        s.host_ms = j->host_ms;
        s.target_pixels = 640.0 * 480.0;
        s.has_proxies = j->has_proxies;
        s.updates = (int)j->updates;
        s.prefers = j->prefers;
        set_possible(j, &s.possible);
        s.rules = files.rules;
        status = j->surface ? draw_surface(j, context, &s) : print_choices(j, context, &s);
        selecting_free(&files);
    }
    gn_context_destroy(context);
    return status;
}

int command_select(int count, char **arguments)
{
    job j = {.light_count = 1, .updates = 1};
    const option options[] = {
        {"--fact", OPTION_LIST, &j.facts, 0, 0},
        {"--lights", OPTION_WHOLE, &j.light_count, 1, GN_MOST_SELECTED},
        {"--rules", OPTION_TEXT, &j.given.rules, 0, 0},
        {"--knowledge", OPTION_TEXT, &j.given.knowledge, 0, 0},
        {"--quality", OPTION_TEXT, &j.given.quality, 0, 0},
        {"--budget-ms", OPTION_NUMBER, &j.given.budget_ms, 0, 1e6},
        {"--budget-mw", OPTION_NUMBER, &j.given.budget_mw, 0, 1e6},
        {"--budget-mb", OPTION_NUMBER, &j.given.budget_mb, 0, 1e6},
        {"--host-ms", OPTION_NUMBER, &j.host_ms, 0, 1e6},
        {"--hide", OPTION_TEXT, &j.hide, 0, 0},
        {"--updates", OPTION_WHOLE, &j.updates, 1, 4},
        {"--proxies", OPTION_FLAG, &j.has_proxies, 0, 0},
        {"--prefer", OPTION_FLAG, &j.prefers, 0, 0},
        {"--explain", OPTION_FLAG, &j.explain, 0, 0},
        {"-o", OPTION_TEXT, &j.picture, 0, 0},
        {"--surface", OPTION_TEXT, &j.surface, 0, 0},
        {"--output", OPTION_TEXT, &j.output, 0, 0},
    };
    const int kept = parse_options(count, arguments, options, (int)(sizeof options / sizeof options[0]));

    if (kept < 0)
        return EXIT_USAGE;
    if (kept > 0) {
        say("select: takes no scene: facts are given by --fact (%s)", arguments[0]);
        return EXIT_USAGE;
    }
    return check_hidden("--hide", j.hide) && parse_facts(&j) && parse_surface(&j) ? run(&j) : EXIT_USAGE;
}
