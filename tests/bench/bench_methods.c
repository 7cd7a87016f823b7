/* bench_methods.c - what each method costs beside the method stencil, on three scenes: one row of a CSV for each.
 *
 *     bench_methods [SCENE...]
 *
 * 640x480, everything turning. The methods draw each frame in turn, so that all have the same of what the machine does
 * besides; time is the process's, all threads, a remark, and of use as a ratio. Traffic is the plan's estimate. Ratios
 * are to stencil; stencil-merged adds several lights in a pass, by masks in textures. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "processor.h"
#include "spread.h"
#include "stage.h"

#define WIDTH  640
#define HEIGHT 480
enum { FRAMES = 15 };

static const struct {
    const char *name;
    gn_method method;
    uint32_t hidden;
    int merges;
} ways[] = {
    {"stencil", GN_METHOD_STENCIL, 0, 0}, {"stencil-merged", GN_METHOD_STENCIL, 0, 1},
    {"refine", GN_METHOD_REFINE, 0, 0},   {"count", GN_METHOD_COUNT, 0, 0},
    {"signed", GN_METHOD_SIGNED, 0, 0},   {"signed-image", GN_METHOD_SIGNED, 1u << GN_CAN_ALPHA, 0},
    {"alpha", GN_METHOD_ALPHA, 0, 0},     {"screen", GN_METHOD_SCREEN, 0, 0},
};
enum { WAYS = sizeof ways / sizeof ways[0] };

static int draw(stage *s, int way, double *ms, char message[SCENE_MESSAGE])
{
    const stage_wish wish = {
        .method = ways[way].method, .casting = 1, .light_count = s->light_count, .merges_lights = ways[way].merges};
    const double start = processor_ms();

    s->target.hidden = ways[way].hidden;
    if (stage_plan(s, &wish, message) != 0 || !stage_draw_lit(s, 0, message))
        return 0;
    s->gl->glFinish();
    *ms = processor_ms() - start;
    return 1;
}

static void print_row(const char *scene_name, const stage *s, int way, double ms, double of_stencil, double *traffic)
{
    const gn_traffic *t = &s->plan->traffic;
    uint32_t batches = 0;

    for (uint32_t i = 0; i < s->plan->light_count; i++)
        batches = s->plan->lights[i].batches > batches ? s->plan->lights[i].batches : batches;
    if (way == 0)
        *traffic = t->written + t->read;
    printf("%s,%u,%s,%.2f,%.2f,%.2f,%.2f,%lu,%lu,%s\n", scene_name, (unsigned)s->light_count, ways[way].name, ms,
           ms / of_stencil, 1e-6 * (t->written + t->read), (t->written + t->read) / *traffic, (unsigned long)batches,
           (unsigned long)s->plan->step_count, s->plan->warnings & 1u << GN_WARN_RANGE ? "warned" : "");
}

static int run(const char *name)
{
    const stage_options options = {
        .platform = "egl", .width = WIDTH, .height = HEIGHT, .depth_bits = 24, .stencil_bits = 8};
    char path[256], message[SCENE_MESSAGE] = "";
    double ms[WAYS][FRAMES], traffic = 1.0;
    scene loaded;
    stage *s;

    snprintf(path, sizeof path, "build/scenes/%s.gltf", name);
    if (!scene_load(&loaded, path, NULL, message) || !scene_ensure_view(&loaded, (double)WIDTH / HEIGHT, NULL) ||
        stage_open(&s, &loaded, &options, message) != 0)
        return fprintf(stderr, "bench_methods: %s: %s\n", name, message), 0;
    for (int frame = -1; frame < FRAMES; frame++) { /* the first warms up */
        stage_pose(s, frame / 60.0, frame);
        for (int way = 0; way < WAYS; way++)
            if (!draw(s, way, &ms[way][frame < 0 ? 0 : frame], message))
                return fprintf(stderr, "bench_methods: %s, %s: %s\n", name, ways[way].name, message), 0;
    }
    for (int way = 0; way < WAYS; way++)
        qsort(ms[way], FRAMES, sizeof(double), by_value);
    for (int way = 0; way < WAYS; way++) {
        double unused;

        if (!draw(s, way, &unused, message))
            return 0;
        print_row(name, s, way, ms[way][FRAMES / 2], ms[0][FRAMES / 2], &traffic);
    }
    stage_close(s);
    scene_free(&loaded);
    return 1;
}

int main(int count, char **arguments)
{
    static const char *const usual[] = {"colours", "courtyard", "pile_of_27"};

    printf("scene,lights,method,ms,of_stencil,traffic_mb,traffic_of_stencil,batches,steps,range\n");
    for (int i = 0; i < (count > 1 ? count - 1 : 3); i++)
        if (!run(count > 1 ? arguments[i + 1] : usual[i]))
            return 1;
    return 0;
}
