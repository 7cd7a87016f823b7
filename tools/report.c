/* report.c - the report of a run, as JSON. */
#include "report.h"

#include <cjson/cJSON.h>
#include <stdlib.h>

#include "command.h"
#include "spread.h"

static void add_timing(cJSON *to, const char *name, double *ms, size_t count)
{
    cJSON *const o = cJSON_AddObjectToObject(to, name);
    const spread over = spread_of(ms, count);

    cJSON_AddNumberToObject(o, "median", over.median);
    cJSON_AddNumberToObject(o, "p5", over.p5);
    cJSON_AddNumberToObject(o, "p95", over.p95);
}

static void add_target(cJSON *root, const gn_target *t)
{
    cJSON *const target = cJSON_AddObjectToObject(root, "target");
    cJSON *const size = cJSON_AddArrayToObject(root, "size");
    const struct {
        const char *name;
        int bits;
    } rows[] = {{"red", t->red_bits},     {"green", t->green_bits}, {"blue", t->blue_bits},
                {"alpha", t->alpha_bits}, {"depth", t->depth_bits}, {"stencil", t->stencil_bits}};

    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        cJSON_AddNumberToObject(target, rows[i].name, rows[i].bits);
    cJSON_AddItemToArray(size, cJSON_CreateNumber(t->width));
    cJSON_AddItemToArray(size, cJSON_CreateNumber(t->height));
}

static void add_lights(cJSON *root, const gn_plan *plan)
{
    cJSON *const lights = cJSON_AddArrayToObject(root, "lights");

    for (uint32_t i = 0; i < plan->light_count; i++) {
        const gn_plan_light *l = &plan->lights[i];
        cJSON *const o = cJSON_CreateObject();

        cJSON_AddStringToObject(o, "method", gn_plan_method_name(plan, i));
        cJSON_AddNumberToObject(o, "scale", plan->scale);
        cJSON_AddStringToObject(o, "reason", l->reason);
        cJSON_AddNumberToObject(o, "casters", l->casters);
        cJSON_AddNumberToObject(o, "case1", l->cases[0]);
        cJSON_AddNumberToObject(o, "case2", l->cases[1]);
        cJSON_AddNumberToObject(o, "case3", l->cases[2]);
        cJSON_AddNumberToObject(o, "skipped_casters", l->skipped_casters);
        cJSON_AddBoolToObject(o, "left_out", l->skip != GN_SKIP_NOT);
        cJSON_AddNumberToObject(o, "possible_error", l->possible_error);
        cJSON_AddNumberToObject(o, "layers", l->layers);
        cJSON_AddNumberToObject(o, "batches", l->batches);
        cJSON_AddNumberToObject(o, "fragments", l->fragments);
        cJSON_AddNumberToObject(o, "cut_casters", l->cut_casters);
        cJSON_AddItemToArray(lights, o);
    }
}

static void add_counts(cJSON *root, const measured *m)
{
    cJSON *const counts = cJSON_AddObjectToObject(root, "counts");

    cJSON_AddNumberToObject(counts, "draws", (double)m->counts.draws);
    cJSON_AddNumberToObject(counts, "vertices", (double)m->counts.vertices);
    cJSON_AddNumberToObject(counts, "indices", (double)m->counts.indices);
    cJSON_AddNumberToObject(counts, "bytes_sent", (double)m->counts.bytes_sent);
    cJSON_AddNumberToObject(counts, "state_changes", (double)m->counts.state_changes);
    cJSON_AddNumberToObject(counts, "allocations", (double)m->allocations);
    cJSON_AddNumberToObject(counts, "fragments_rasterised", (double)m->fragments_rasterised);
    cJSON_AddNumberToObject(counts, "fragments_passed", (double)m->fragments_passed);
}

/* Bytes that the last frame's plan expects, by what is written and read. */
static void add_traffic(cJSON *root, const gn_plan *plan)
{
    cJSON *const o = cJSON_AddObjectToObject(root, "traffic_bytes_estimated");
    const gn_traffic *t = &plan->traffic;

    cJSON_AddNumberToObject(o, "target_color", t->target_color);
    cJSON_AddNumberToObject(o, "target_depth", t->target_depth);
    cJSON_AddNumberToObject(o, "image_color", t->image_color);
    cJSON_AddNumberToObject(o, "image_depth", t->image_depth);
    cJSON_AddNumberToObject(o, "masks", t->masks);
    cJSON_AddNumberToObject(o, "written", t->written);
    cJSON_AddNumberToObject(o, "read", t->read);
}

int write_report(const char *path, const stage *s, measured *m)
{
    static const char *const masks[] = {"stencil", "alpha", "texture"};
    cJSON *const root = cJSON_CreateObject();
    cJSON *ms;
    char *text;
    fresh_file f;
    int ok = 0;

    cJSON_AddStringToObject(root, "driver", (const char *)s->gl->glGetString(GL_VERSION));
    cJSON_AddStringToObject(root, "renderer", (const char *)s->gl->glGetString(GL_RENDERER));
    cJSON_AddStringToObject(root, "platform", s->platform->kind->name);
    add_target(root, &s->target);
    cJSON_AddNumberToObject(root, "frames", m->frames);
    cJSON_AddStringToObject(root, "mask", masks[s->plan->mask]);
    add_lights(root, s->plan);
    add_counts(root, m);
    add_traffic(root, s->plan);
    ms = cJSON_AddObjectToObject(root, "ms");
    add_timing(ms, "frame", m->ms.frame, m->ms.count);
    add_timing(ms, "same_passes_without_volumes", m->ms.same_passes, m->ms.count);
    add_timing(ms, "one_pass_without_shadows", m->ms.one_pass, m->ms.count);
    text = cJSON_Print(root);
    if (!text)
        say("%s: no memory for the report", path);
    else if (fresh_open(&f, path))
        ok = fresh_close(&f, fprintf(f.file, "%s\n", text) > 0);
    free(text);
    cJSON_Delete(root);
    return ok;
}
