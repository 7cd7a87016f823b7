/* bench_small.c - when smaller masks pay: one row of a CSV for each method, number of layers and scale.
 *
 *     bench_small
 *
 * A floor that fills the frame, and over it, out of view, as many sheets as there are layers: each volume covers the whole
 * frame. 1024x768, one light, flat surfaces. The scales are drawn in turn; times are the process's, all threads, medians:
 * a remark, and of use as the ratio to full masks: for refine, to those by stencil. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "device.h"
#include "gn_matrix.h"
#include "plain_host.h"
#include "processor.h"
#include "spread.h"

enum { WIDTH = 1024, HEIGHT = 768, FRAMES = 9, MOST_LAYERS = 64, SCALES = 3 };

typedef struct bench {
    test_device device;
    plain_host host;
    gn_mesh *floor, *sheet;
    gn_object objects[1 + MOST_LAYERS];
    gn_light light;
    gn_scene scene;
    void *memory;
    size_t size;
} bench;

static gn_mesh *make_quad(bench *b, float half)
{
    const float positions[12] = {-half, 0, -half, -half, 0, half, half, 0, half, half, 0, -half};
    static const uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
    const gn_mesh_desc desc = {.positions = positions, .vertex_count = 4, .indices = indices, .triangle_count = 2};
    gn_mesh *mesh = NULL;

    if (gn_mesh_create(b->device.context, &desc, &mesh) != GN_OK || gn_gles_upload(b->device.gles, mesh) != GN_OK)
        return NULL;
    return mesh;
}

/* The eye is above the floor, between it and the sheets, and looks down. */
static int make_scene(bench *b)
{
    gn_scene *s = &b->scene;

    b->floor = make_quad(b, 20.0f);
    b->sheet = make_quad(b, 6.0f);
    if (!b->floor || !b->sheet)
        return 0;
    for (int i = 0; i <= MOST_LAYERS; i++) {
        b->objects[i].mesh = i ? b->sheet : b->floor;
        gn_mat4_identity(b->objects[i].model);
        b->objects[i].model[13] = i ? 10.0 + 0.02 * i : 0.0;
        b->objects[i].flags = i ? GN_CASTS : GN_RECEIVES;
    }
    b->light.kind = GN_LIGHT_POINT;
    b->light.position[1] = 14.0;
    memset(s->camera.world, 0, sizeof s->camera.world);
    s->camera.world[0] = s->camera.world[15] = 1.0;
    s->camera.world[6] = -1.0; /* up is -z */
    s->camera.world[9] = 1.0;  /* and -z of the camera down */
    s->camera.world[13] = 5.0;
    s->camera.top = 0.5;
    s->camera.right = 0.5 * WIDTH / HEIGHT;
    s->camera.left = -s->camera.right;
    s->camera.bottom = -s->camera.top;
    s->camera.znear = 0.1;
    s->lights = &b->light;
    s->light_count = 1;
    s->objects = b->objects;
    s->reads_masks = 1;
    s->without = ~0u; /* the layers are what is measured */
    return 1;
}

static int draw(bench *b, gn_method method, uint32_t scale, double *ms)
{
    const gn_plan *plan;
    const double start = processor_ms();
    size_t size;

    b->scene.scale = scale;
    b->scene.method = method == GN_METHOD_REFINE && scale == 1 ? GN_METHOD_STENCIL : method;
    b->scene.upsample = GN_UPSAMPLE_BILINEAR;
    size = gn_plan_bound(&b->scene);
    if (size > b->size) {
        free(b->memory);
        b->memory = malloc(size);
        b->size = b->memory ? size : 0;
    }
    if (!b->memory || gn_plan_make(b->device.context, &b->scene, b->memory, b->size, &plan) != GN_OK ||
        !plain_host_draw(&b->host, plan, 0.8f))
        return fprintf(stderr, "bench_small: %s\n", gn_message(b->device.context)), 0;
    b->device.gl->glFinish();
    *ms = processor_ms() - start;
    return 1;
}

static int run(bench *b, gn_method method, uint32_t layers)
{
    double ms[SCALES][FRAMES];

    b->scene.object_count = 1 + layers;
    for (int scale = 0; scale < SCALES; scale++) /* images are made anew when the scale changes: a run for each */
        for (int frame = -1; frame < FRAMES; frame++)
            if (!draw(b, method, 1u << scale, &ms[scale][frame < 0 ? 0 : frame]))
                return 0;
    for (int scale = 0; scale < SCALES; scale++)
        qsort(ms[scale], FRAMES, sizeof(double), by_value);
    for (int scale = 0; scale < SCALES; scale++)
        printf("%s,%u,%d,%.2f,%.2f\n", gn_method_describe(method)->name, (unsigned)layers, 1 << scale,
               ms[scale][FRAMES / 2], ms[0][FRAMES / 2] / ms[scale][FRAMES / 2]);
    return 1;
}

int main(void)
{
    static const uint32_t layers[] = {2, 4, 8, 16, 32, 64};
    static bench b;

    if (test_open_device_of(&b.device, "egl", WIDTH, HEIGHT) || !plain_host_open(&b.host, b.device.gles) ||
        gn_gles_describe_target(b.device.gles, WIDTH, HEIGHT, NULL, &b.scene.target) != GN_OK || !make_scene(&b))
        return 1;
    printf("method,layers,scale,ms,times_faster_than_full\n");
    for (size_t i = 0; i < sizeof layers / sizeof layers[0]; i++)
        if (!run(&b, GN_METHOD_STENCIL, layers[i]) || !run(&b, GN_METHOD_COUNT, layers[i]) ||
            !run(&b, GN_METHOD_REFINE, layers[i]))
            return 1;
    gn_gles_unload(b.device.gles, b.floor);
    gn_gles_unload(b.device.gles, b.sheet);
    gn_mesh_destroy(b.floor);
    gn_mesh_destroy(b.sheet);
    free(b.memory);
    plain_host_close(&b.host);
    return test_close_device(&b.device);
}
