/* render_adaptive.c - see render_adaptive.h.
 *
 * A script has a line for each change of load: the frame from which on, and one of
 *     lights N      so many of the scene's lights
 *     host MS       the host takes so much more of each frame, by waiting
 *     budget MS     the budget for a frame's time
 *     power P       the fact, 0 to 1 */
#include "render_adaptive.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "adaptive.h"
#include "command.h"
#include "picture.h"

enum { MOST_CHANGES = 256 };

typedef struct change {
    long frame;
    char what[16];
    double value;
} change;

typedef struct script {
    change of[MOST_CHANGES];
    int count;
} script;

typedef struct loads {
    uint32_t lights;
    double host_ms;
} loads;

static int is_change(const change *c)
{
    static const struct {
        const char *what;
        double most;
    } all[] = {{"lights", GN_MOST_SELECTED}, {"host", 10000}, {"budget", 10000}, {"power", 1}};

    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        if (strcmp(c->what, all[i].what) == 0)
            return c->frame >= 0 && c->value >= 0.0 && c->value <= all[i].most;
    return 0;
}

static int read_script(const char *path, script *s)
{
    FILE *f = fopen(path, "r");
    char line[256];
    int number = 0, ok = 1;

    s->count = 0;
    if (!f) {
        say("--load: %s: cannot be read: %s", path, strerror(errno));
        return 0;
    }
    while (ok && fgets(line, sizeof line, f)) {
        change *c = &s->of[s->count];

        number++;
        if (line[strspn(line, " \t\r\n")] == '\0' || line[0] == '#')
            continue;
        ok =
            s->count < MOST_CHANGES && sscanf(line, "%ld %15s %lf", &c->frame, c->what, &c->value) == 3 && is_change(c);
        s->count++;
    }
    fclose(f);
    if (!ok)
        say("--load: %s: line %d is no frame with lights, host, budget or power and a number (or one of more than %d)",
            path, number, MOST_CHANGES);
    return ok;
}

static void apply(const script *s, long frame, adaptive *a, loads *now)
{
    for (int i = 0; i < s->count; i++) {
        const change *c = &s->of[i];
        gn_budget budget = a->asked.budget;

        if (c->frame != frame)
            continue;
        if (strcmp(c->what, "lights") == 0)
            now->lights = c->value < a->stage->light_count ? (uint32_t)c->value : a->stage->light_count;
        else if (strcmp(c->what, "host") == 0)
            now->host_ms = c->value;
        else if (strcmp(c->what, "power") == 0)
            a->power = c->value;
        budget.frame_ms = strcmp(c->what, "budget") == 0 ? c->value : budget.frame_ms;
        adaptive_set_budget(a, &budget);
    }
}

static int draw_frame(adaptive *a, const stage_wish *like, const loads *now, double *ms, char message[SCENE_MESSAGE])
{
    const double start = now_ms();

    while (now_ms() - start < now->host_ms)
        continue;
    if (!adaptive_draw(a, like, now->lights, message))
        return 0;
    a->stage->gl->glFinish();
    *ms = now_ms() - start;
    return 1;
}

static void put_header(FILE *f, uint32_t lights)
{
    fprintf(f, "frame,ms,predicted_ms,budget_ms,lights,host_ms,fragments,plans,changes,accuracy");
    for (uint32_t i = 0; i < lights; i++)
        fprintf(f, ",light%u", (unsigned)i);
    fprintf(f, "\n");
}

/* The least accurate class of the lights' ways, as the selector knows them. */
static gn_accuracy least_accuracy(const adaptive *a, const gn_knowledge *k)
{
    gn_accuracy least = GN_ACCURACY_EXACT;

    for (uint32_t i = 0; i < a->light_count; i++) {
        const gn_way *w = &a->ways[i];
        gn_accuracy of = w->is_dropped ? GN_ACCURACY_NONE : k->ways[w->method][gn_way_variant(w)].accuracy;

        of = w->proxies && of > GN_ACCURACY_FAIR ? GN_ACCURACY_FAIR : of;
        least = of < least ? of : least;
    }
    return least;
}

static void put_row(FILE *f, long frame, double ms, const adaptive *a, const loads *now, const gn_knowledge *k,
                    const gn_way *before)
{
    double fragments = 0.0;
    int changes = 0;

    for (uint32_t i = 0; i < a->light_count; i++)
        fragments += a->lights[i].load.fragments;
    for (uint32_t i = 0; i < a->light_count; i++)
        changes += frame > 0 && memcmp(&before[i], &a->ways[i], sizeof before[i]) != 0;
    fprintf(f, "%ld,%.3f,%.3f,%g,%u,%g,%.0f,%u,%d,%s", frame, ms, gn_selector_predicted(a->selector),
            a->asked.budget.frame_ms, (unsigned)now->lights, now->host_ms, fragments, (unsigned)a->plans, changes,
            gn_accuracy_name(least_accuracy(a, k)));
    for (uint32_t i = 0; i < a->stage->light_count; i++) {
        char name[80] = "";

        if (i < a->light_count)
            gn_way_name(&a->ways[i], name, sizeof name);
        fprintf(f, ",\"%s\"", name);
    }
    fprintf(f, "\n");
}

/* Of each light what is taken, and what the selector would take at once, and why. */
static void explain(const adaptive *a)
{
    static char text[65536];
    const gn_choice *wanted;
    gn_selection selection;

    gn_selector_explain(a->selector, &selection, &wanted);
    for (uint32_t i = 0; i < a->light_count; i++) {
        gn_way_name(&a->ways[i], text, sizeof text);
        printf("light %u: %s; wanted: ", (unsigned)i, text);
        gn_explain_choice(&selection, wanted, i, 1, text, sizeof text);
        printf("%s\n", text);
    }
}

static int draw_frames(adaptive *a, const adaptive_job *j, const stage_wish *like, const script *s,
                       const gn_knowledge *k, FILE *csv, char message[SCENE_MESSAGE])
{
    loads now = {a->stage->light_count, 0.0};

    if (csv)
        put_header(csv, a->stage->light_count);
    for (long frame = 0; frame < j->frames; frame++) {
        gn_way before[GN_MOST_SELECTED];
        double ms;

        memcpy(before, a->ways, sizeof before);
        apply(s, frame, a, &now);
        stage_pose(a->stage, (double)frame / 60.0, (double)frame * j->spin);
        if (!draw_frame(a, like, &now, &ms, message))
            return 0;
        if (csv)
            put_row(csv, frame, ms, a, &now, k, before);
        adaptive_measured(a, ms);
        if (a->stage->platform->kind->lost(a->stage->platform)) {
            snprintf(message, SCENE_MESSAGE, "the GL context was lost in frame %ld", frame);
            return 0;
        }
    }
    return 1;
}

int render_adaptively(stage *s, const adaptive_job *j, const stage_wish *like)
{
    char message[SCENE_MESSAGE] = "";
    selecting_files files;
    fresh_file csv = {NULL, NULL, NULL};
    static script changes;
    adaptive a;
    int status = selecting_load(&j->given, s->context, &files), ok;

    memset(&a, 0, sizeof a);
    changes.count = 0;
    if (status == EXIT_DONE && j->script && !read_script(j->script, &changes))
        status = EXIT_FAILED;
    else if (status == EXIT_DONE && j->csv && !fresh_open(&csv, j->csv))
        status = EXIT_FAILED;
    if (status != EXIT_DONE) {
        selecting_free(&files);
        return status;
    }
    {
        const adaptive_options options = {&files.knowledge, files.rules, files.budget, j->power};

        ok = adaptive_open(&a, s, &options, message) == 0;
    }
    ok = ok && draw_frames(&a, j, like, &changes, &files.knowledge, csv.file, message);
    if (!ok)
        say("%s", message);
    if (ok && j->explain)
        explain(&a);
    adaptive_close(&a);
    selecting_free(&files);
    if (j->csv)
        ok = fresh_close(&csv, ok) && ok;
    return ok ? EXIT_DONE : EXIT_FAILED;
}
