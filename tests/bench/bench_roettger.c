/* bench_roettger.c - Roettger 2002, table 2, here: frames by masks in the screen, in alpha, in the stencil, at half the
 * resolution, and without shadows, at three sizes of the window; a row of a CSV for each size, beside his.
 *
 *     bench_roettger [SCENE]
 *
 * One light, shadows that attenuate a lit frame (his section 4.3), the light turning. Half the resolution: in the screen,
 * copied, as his. Ways are drawn in turn; what is printed is the frame rate by the process's time, all threads, in parts of
 * that without shadows: medians. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "processor.h"
#include "spread.h"
#include "stage.h"

enum { FRAMES = 15, WAYS = 5, SIZES = 3 };

static const struct {
    gn_method method;
    uint32_t scale;
    int casting;
} ways[WAYS] = {{GN_METHOD_SCREEN, 1, 1},
                {GN_METHOD_ALPHA, 1, 1},
                {GN_METHOD_STENCIL, 1, 1},
                {GN_METHOD_SCREEN, 2, 1},
                {GN_METHOD_STENCIL, 1, 0}};

/* Frames a second, of the paper. */
static const double his[SIZES][WAYS] = {
    {40.8, 42.4, 42.4, 39.1, 90.4}, {29.9, 33.6, 29.1, 30.5, 89.2}, {9.3, 10.2, 8.9, 15.7, 44.6}};

static int draw(stage *s, int way, double *ms, char message[SCENE_MESSAGE])
{
    const stage_wish wish = {.method = ways[way].method,
                             .casting = ways[way].casting,
                             .light_count = 1,
                             .shade = GN_SHADE_ATTENUATE,
                             .scale = ways[way].scale,
                             .upsample = GN_UPSAMPLE_BILINEAR};
    const double start = processor_ms();

    if (stage_plan(s, &wish, message) != 0 || !stage_draw_lit(s, 0, message))
        return 0;
    s->gl->glFinish();
    *ms = processor_ms() - start;
    return 1;
}

static int run(const char *name, int size)
{
    const uint32_t side = 256u << size;
    const stage_options options = {
        .platform = "egl", .width = side, .height = side, .exposure = 1.0, .depth_bits = 24, .stencil_bits = 8};
    char path[128], message[SCENE_MESSAGE] = "";
    double ms[WAYS][FRAMES];
    int ok = 1;
    scene loaded;
    stage *s;

    snprintf(path, sizeof path, "build/scenes/%.64s.gltf", name);
    if (!scene_load(&loaded, path, NULL, message) || !scene_ensure_view(&loaded, 1.0, NULL) ||
        stage_open(&s, &loaded, &options, message) != 0)
        return fprintf(stderr, "bench_roettger: %s: %s\n", path, message), 0;
    for (int frame = -1; frame < FRAMES && ok; frame++)
        for (int way = 0; way < WAYS && ok; way++) {
            stage_pose(s, 0, 2.0 * frame);
            /* images are made anew where the size of masks changes: once more */
            ok = draw(s, way, &ms[way][frame < 0 ? 0 : frame], message) &&
                 draw(s, way, &ms[way][frame < 0 ? 0 : frame], message);
        }
    for (int way = 0; way < WAYS && ok; way++)
        qsort(ms[way], FRAMES, sizeof(double), by_value);
    if (ok)
        printf("%s,%u", name, (unsigned)side);
    for (int way = 0; way < WAYS - 1 && ok; way++)
        printf(",%.2f,%.2f", ms[WAYS - 1][FRAMES / 2] / ms[way][FRAMES / 2], his[size][way] / his[size][WAYS - 1]);
    if (ok)
        printf(",%.2f\n", ms[WAYS - 1][FRAMES / 2]);
    else
        fprintf(stderr, "bench_roettger: %s\n", message);
    stage_close(s);
    scene_free(&loaded);
    return ok;
}

int main(int argument_count, char **arguments)
{
    printf("scene,window,screen,his,alpha,his,stencil,his,half,his,ms_without\n");
    for (int size = 0; size < SIZES; size++)
        if (!run(argument_count > 1 ? arguments[1] : "torus_knot", size))
            return 1;
    return 0;
}
