/* ways.c - see ways.h. */
#include "ways.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "picture.h"

int ways_open(ways_scene *w, const char *name)
{
    const stage_options options = {.width = 320, .height = 240, .depth_bits = 24, .stencil_bits = 8};
    stage_wish exact = {.method = GN_METHOD_AUTO, .casting = 1};
    char path[256], message[SCENE_MESSAGE] = "";

    memset(w, 0, sizeof *w);
    snprintf(path, sizeof path, "build/scenes/%s.gltf", name);
    if (!scene_load(&w->loaded, path, NULL, message) || !scene_ensure_view(&w->loaded, 4.0 / 3.0, NULL) ||
        stage_open(&w->stage, &w->loaded, &options, message) != 0) {
        fprintf(stderr, "%s: %s\n", name, message);
        return 0;
    }
    stage_pose(w->stage, 0.0, 0.0);
    exact.light_count = w->stage->light_count;
    w->loads = calloc(exact.light_count + 1, sizeof *w->loads);
    w->facts = calloc(exact.light_count + 1, sizeof *w->facts);
    if (!w->loads || !w->facts || stage_plan(w->stage, &exact, message) != 0) {
        fprintf(stderr, "%s: %s\n", name, message);
        return 0;
    }
    for (uint32_t i = 0; i < exact.light_count; i++)
        gn_plan_measure(w->stage->plan, i, 0, &w->loads[i], &w->facts[i]);
    return 1;
}

void ways_close(ways_scene *w)
{
    free(w->loads);
    free(w->facts);
    stage_close(w->stage);
    scene_free(&w->loaded);
}

int ways_draw(ways_scene *w, int method, int variant, int casting, double *ms)
{
    const stage_wish wish = {.method = (gn_method)method,
                             .casting = casting,
                             .light_count = w->stage->light_count,
                             .scale = gn_variant_scale(variant),
                             .upsample = gn_variant_upsample(variant)};
    const double start = now_ms();
    char message[SCENE_MESSAGE];

    if (stage_plan(w->stage, &wish, message) != 0 || !stage_draw_lit(w->stage, 0, message))
        return 0;
    w->stage->gl->glFinish();
    *ms = now_ms() - start;
    return 1;
}

int ways_read_knowledge(gn_context *context, const char *path, gn_knowledge *out)
{
    static char text[65536];
    FILE *f = fopen(path, "r");
    size_t length;

    if (!f) {
        fprintf(stderr, "%s: cannot be read\n", path);
        return 0;
    }
    length = fread(text, 1, sizeof text, f);
    fclose(f);
    if (gn_knowledge_read(context, text, length, out) == GN_OK)
        return 1;
    fprintf(stderr, "%s: %s\n", path, gn_message(context));
    return 0;
}
