/* bench_refine.c - what refining a small mask leaves wrong, and what it counts: one row of a CSV for each mask.
 *
 *     bench_refine [SCENE...]
 *
 * At 320x240, against full masks by stencil: wrong pixels by bilinear at scale 2, and refined from scale 2 and 4; how many of
 * the fragments of the full method's volumes pass the stencil test at scale 2. At most five lights of a scene. The last line,
 * a comment, has sums and the median. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "spread.h"
#include "stage.h"

enum { WIDTH = 320, HEIGHT = 240, BYTES = 4 * WIDTH * HEIGHT, MOST = 512, LIGHTS = 5 };

typedef struct totals {
    unsigned long wrong[3];
    double ratios[MOST];
    int masks;
} totals;

static int draw(stage *s, gn_method method, uint32_t scale, uint32_t light, uint8_t rgba[BYTES],
                char message[SCENE_MESSAGE])
{
    const stage_wish wish = {.method = method,
                             .casting = 1,
                             .first_light = light,
                             .light_count = 1,
                             .unbounded = 1,
                             .scale = scale,
                             .upsample = GN_UPSAMPLE_BILINEAR};

    return stage_plan(s, &wish, message) == 0 && stage_draw_mask(s, light, message) &&
           platform_read_back(s->platform, rgba);
}

static unsigned long count_differing(const uint8_t *a, const uint8_t *b)
{
    unsigned long count = 0;

    for (int i = 0; i < BYTES; i += 4)
        count += (a[i] > 127) != (b[i] > 127);
    return count;
}

static int measure(stage *s, const char *name, uint32_t light, totals *t, char message[SCENE_MESSAGE])
{
    static uint8_t full[BYTES], other[BYTES];
    unsigned long wrong[3];
    uint64_t fragments, contested, passed;

    if (!draw(s, GN_METHOD_STENCIL, 1, light, full, message) || !stage_count_fragments(s, &fragments, &passed))
        return 0;
    for (int way = 0; way < 3; way++) {
        if (!draw(s, way ? GN_METHOD_REFINE : GN_METHOD_STENCIL, way == 2 ? 4 : 2, light, other, message))
            return 0;
        wrong[way] = count_differing(full, other);
        t->wrong[way] += wrong[way];
        if (way != 1)
            continue;
        s->gl->glEnable(GL_STENCIL_TEST); /* names are in the stencil still */
        s->gl->glStencilFunc(GL_EQUAL, 0, 128);
        if (!stage_count_fragments(s, &contested, &passed))
            return 0;
        s->gl->glDisable(GL_STENCIL_TEST);
    }
    t->ratios[t->masks] = fragments ? (double)contested / (double)fragments : 0.0;
    printf("%s,%u,%lu,%lu,%lu,%.2f\n", name, (unsigned)light, wrong[0], wrong[1], wrong[2], t->ratios[t->masks]);
    t->masks += fragments > 0;
    return 1;
}

static int run(const char *name, totals *t)
{
    const stage_options options = {
        .platform = "egl", .width = WIDTH, .height = HEIGHT, .exposure = 1.0, .depth_bits = 24, .stencil_bits = 8};
    char path[128], message[SCENE_MESSAGE] = "";
    int ok = 1;
    scene loaded;
    stage *s;

    snprintf(path, sizeof path, "build/scenes/%.64s.gltf", name);
    if (!scene_load(&loaded, path, NULL, message) || !scene_ensure_view(&loaded, (double)WIDTH / HEIGHT, NULL) ||
        stage_open(&s, &loaded, &options, message) != 0)
        return fprintf(stderr, "bench_refine: %s: %s\n", path, message), 0;
    stage_pose(s, 0, 0);
    for (uint32_t light = 0; ok && light < loaded.light_count && light < LIGHTS && t->masks < MOST; light++)
        ok = measure(s, name, light, t, message);
    stage_close(s);
    scene_free(&loaded);
    return ok ? 1 : (fprintf(stderr, "bench_refine: %s: %s\n", name, message), 0);
}

int main(int argument_count, char **arguments)
{
    static totals t;
    FILE *list = argument_count > 1 ? NULL : fopen("build/scenes/scenes.txt", "r");
    char line[512], name[64], size[16];

    printf("scene,light,wrong_bilinear,wrong_refined,wrong_refined_4,fragments_passed\n");
    for (int i = 1; i < argument_count; i++)
        if (!run(arguments[i], &t))
            return 1;
    while (list && fgets(line, sizeof line, list))
        if (sscanf(line, "%63s %*s %15s", name, size) == 2 && strcmp(size, "extreme") != 0 && !run(name, &t))
            return 1;
    if (list)
        fclose(list);
    qsort(t.ratios, (size_t)t.masks, sizeof *t.ratios, by_value);
    printf("# %d masks: %lu wrong by bilinear, %lu refined, %lu at scale 4; %.2f of the fragments pass in the median\n",
           t.masks, t.wrong[0], t.wrong[1], t.wrong[2], t.masks ? t.ratios[t.masks / 2] : 0.0);
    return 0;
}
