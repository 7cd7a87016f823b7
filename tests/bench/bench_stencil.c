/* bench_stencil.c - what the method stencil costs against z-fail throughout, in counts of one lit frame: draws and
 * vertices of the whole frame, with the host's passes; draws, vertices and fragments of the volumes.
 *
 *     bench_stencil [SCENE...]     [all scenes of build/scenes/scenes.txt but the extremes]
 *
 * Writes a CSV, a row for each scene, and as its last rows the medians of the ratios over scenes with four lights and
 * more. Fails when stencil rasterises more fragments than z-fail anywhere. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "counted_gl.h"
#include "spread.h"
#include "stage.h"

enum { WIDTH = 320, HEIGHT = 240, MOST = 200, COUNTS = 6 };

static const char *const names[COUNTS] = {"frame_draws",     "frame_vertices",       "volume_draws",
                                          "volume_vertices", "fragments_rasterised", "fragments_passed"};

/* Ended volumes have ends that are seen, sides of two triangles even of a sun, and projections are draws of their own:
 * what costs are fragments. */
static const int is_bound[COUNTS] = {0, 0, 0, 0, 1, 0};

typedef struct row {
    char scene[64];
    uint32_t lights, lights_left_out, casters_left_out;
    uint64_t zfail[COUNTS], stencil[COUNTS];
} row;

static int count(stage *s, gn_method method, uint64_t counts[COUNTS])
{
    const stage_wish wish = {.method = method, .casting = 1, .light_count = s->light_count};
    char message[SCENE_MESSAGE] = "";
    const gl_counts before = counted_gl_read();

    if (stage_plan(s, &wish, message) != 0 || !stage_draw_lit(s, 0, message))
        return fprintf(stderr, "bench_stencil: %s\n", message), 0;
    counts[0] = counted_gl_read().draws - before.draws;
    counts[1] = counted_gl_read().vertices - before.vertices;
    counts[2] = 0;
    for (uint32_t r = 0; r < s->plan->record_count; r++) {
        const gn_record *record = &s->plan->records[r];

        counts[2] += record->side_count + record->dark_cap_count + record->light_cap_count > 0;
        counts[2] += record->turned_cap_count > 0;
    }
    counts[3] = s->plan->index_count;
    return stage_count_fragments(s, &counts[4], &counts[5]);
}

static int measure(row *r)
{
    const stage_options options = {
        .platform = "egl", .width = WIDTH, .height = HEIGHT, .depth_bits = 24, .stencil_bits = 8};
    char path[128], message[SCENE_MESSAGE] = "";
    scene loaded;
    stage *s;
    int ok;

    snprintf(path, sizeof path, "build/scenes/%.64s.gltf", r->scene);
    if (!scene_load(&loaded, path, NULL, message) || stage_open(&s, &loaded, &options, message) != 0)
        return fprintf(stderr, "bench_stencil: %s: %s\n", path, message), 0;
    stage_pose(s, 0, 0);
    ok = count(s, GN_METHOD_ZFAIL, r->zfail) && count(s, GN_METHOD_STENCIL, r->stencil);
    r->lights = s->light_count;
    for (uint32_t l = 0; ok && l < s->plan->light_count; l++) {
        r->lights_left_out += s->plan->lights[l].skip != GN_SKIP_NOT;
        r->casters_left_out += s->plan->lights[l].skipped_casters;
    }
    stage_close(s);
    scene_free(&loaded);
    return ok;
}

static void print(const row *r)
{
    printf("%s,%u,%u,%u", r->scene, (unsigned)r->lights, (unsigned)r->lights_left_out, (unsigned)r->casters_left_out);
    for (int c = 0; c < COUNTS; c++)
        printf(",%llu,%llu", (unsigned long long)r->zfail[c], (unsigned long long)r->stencil[c]);
    printf("\n");
}

static double median(double *ratios, int n)
{
    qsort(ratios, (size_t)n, sizeof *ratios, by_value);
    return n % 2 ? ratios[n / 2] : 0.5 * (ratios[n / 2 - 1] + ratios[n / 2]);
}

int main(int argument_count, char **arguments)
{
    static row rows[MOST];
    int n = 0, failed = 0;
    FILE *list = fopen("build/scenes/scenes.txt", "r");
    char line[512], size[16];

    for (int i = 1; i < argument_count && n < MOST; i++)
        snprintf(rows[n++].scene, sizeof rows[0].scene, "%.60s", arguments[i]);
    while (argument_count == 1 && list && n < MOST && fgets(line, sizeof line, list))
        n += sscanf(line, "%63s %*s %15s", rows[n].scene, size) == 2 && strcmp(size, "extreme") != 0;
    if (list)
        fclose(list);
    printf("scene,lights,lights_left_out,casters_left_out");
    for (int c = 0; c < COUNTS; c++)
        printf(",%s_zfail,%s_stencil", names[c], names[c]);
    printf("\n");
    for (int i = 0; i < n; i++) {
        if (!measure(&rows[i]))
            return 1;
        print(&rows[i]);
        for (int c = 0; c < COUNTS; c++)
            if (is_bound[c] && rows[i].stencil[c] > rows[i].zfail[c]) {
                fprintf(stderr, "bench_stencil: %s: more %s by stencil than by z-fail\n", rows[i].scene, names[c]);
                failed = 1;
            }
    }
    for (int c = 0; c < COUNTS; c++) {
        double ratios[MOST];
        int many = 0;

        for (int i = 0; i < n; i++)
            if (rows[i].lights >= 4 && rows[i].zfail[c])
                ratios[many++] = (double)rows[i].stencil[c] / (double)rows[i].zfail[c];
        if (many)
            printf("# %s, median ratio of %d scenes with 4 lights and more: %.3f\n", names[c], many,
                   median(ratios, many));
    }
    return failed || n == 0;
}
