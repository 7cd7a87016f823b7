/* test_convex.c - a convex closed caster alone shadows nothing that its light sees: from 24 views, with the light at
 * four distances, on each driver, no pixel that the truth calls lit is shadowed in the mask by a volume.
 *
 * At an edge a rasteriser, which snaps vertices, may see the triangle on the other side of it, turned from the
 * light; that is told from a false shadow by the mask of the same frame without volumes. */
#define _DEFAULT_SOURCE
#include "device.h"
#include "gn_matrix.h"
#include "gn_test.h"
#include "stage.h"
#include "truth.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

enum { WIDTH = 160, HEIGHT = 120, VIEWS = 24, AROUND = 24, RINGS = 12 };

/* A sphere of 2 * AROUND * (RINGS - 1) triangles, turned so that nothing of it lies along an axis. */
typedef struct model {
    scene s;
    scene_mesh mesh;
    scene_range range;
    scene_material material;
    scene_instance instance;
    scene_light light;
    float positions[(2 + AROUND * (RINGS - 1)) * 3], zeros[(2 + AROUND * (RINGS - 1)) * 4];
    uint32_t indices[AROUND * (RINGS - 1) * 2 * 3];
} model;

static void put_vertex(model *m, double theta, double phi)
{
    float *p = m->positions + 3 * (size_t)m->mesh.vertex_count++;

    p[0] = (float)(sin(theta) * cos(phi));
    p[1] = (float)cos(theta);
    p[2] = (float)(sin(theta) * sin(phi));
}

static void put_triangle(model *m, uint32_t a, uint32_t b, uint32_t c)
{
    uint32_t *t = m->indices + 3 * (size_t)m->mesh.triangle_count++;

    t[0] = a;
    t[1] = b;
    t[2] = c;
}

static void make_model(model *m)
{
    static const double pi = 3.14159265358979323846;

    memset(m, 0, sizeof *m);
    put_vertex(m, 0, 0);
    put_vertex(m, pi, 0);
    for (int r = 1; r < RINGS; r++)
        for (int a = 0; a < AROUND; a++)
            put_vertex(m, pi * r / RINGS, 2 * pi * a / AROUND);
    for (uint32_t a = 0; a < AROUND; a++) {
        const uint32_t next = (a + 1) % AROUND;

        put_triangle(m, 0, 2 + next, 2 + a);
        for (uint32_t r = 0; r + 2 < RINGS; r++) {
            const uint32_t top = 2 + r * AROUND, bottom = top + AROUND;

            put_triangle(m, top + a, top + next, bottom + a);
            put_triangle(m, top + next, bottom + next, bottom + a);
        }
        put_triangle(m, 1, 2 + (RINGS - 2) * AROUND + a, 2 + (RINGS - 2) * AROUND + next);
    }
    m->mesh.solid_triangle_count = m->mesh.triangle_count;
    m->mesh.positions = m->mesh.normals = m->positions;
    m->mesh.uvs = m->mesh.colors = m->zeros;
    m->mesh.indices = m->indices;
    m->range.triangle_count = m->mesh.triangle_count;
    m->mesh.ranges = &m->range;
    m->mesh.range_count = 1;
    m->material.roughness = 1;
    m->material.texture = SCENE_NONE;
    for (int i = 0; i < 4; i++)
        m->material.base_color[i] = m->instance.world[5 * i] = m->s.camera.world[5 * i] = 1;
    m->instance.casts = m->instance.receives = 1;
    m->light.intensity = m->light.color[0] = 1;
    m->s.camera.yfov = 0.7;
    m->s.camera.znear = 0.1;
    m->s.has_camera = 1;
    m->s.materials = &m->material;
    m->s.meshes = &m->mesh;
    m->s.instances = &m->instance;
    m->s.lights = &m->light;
    m->s.material_count = m->s.mesh_count = m->s.instance_count = m->s.light_count = 1;
}

static void place(model *m, uint32_t *rng, double distance)
{
    const double a = test_uniform(rng, 0, 6.28), b = test_uniform(rng, -1.4, 1.4), t[3] = {0, 0, 0}, one[3] = {1, 1, 1};
    double q[4], away[3];

    for (int i = 0; i < 4; i++)
        q[i] = test_uniform(rng, -1, 1);
    gn_mat4_from_trs(m->s.camera.world, t, q, one);
    for (int i = 0; i < 3; i++)
        m->s.camera.world[12 + i] = 3.2 * m->s.camera.world[8 + i];
    away[0] = cos(a) * cos(b);
    away[1] = sin(b);
    away[2] = sin(a) * cos(b);
    for (int i = 0; i < 3; i++) /* the light on the seen side more often than not */
        m->light.position[i] = distance * (away[i] + 0.8 * m->s.camera.world[8 + i]) / 1.2;
}

/* In a process of its own: prints what is wrong, and exits with how much. */
static void check_driver(const char *kind, const char *gallium)
{
    static const double distances[] = {1.3, 2, 10, 1000};
    static uint8_t lit[WIDTH * HEIGHT], visible[WIDTH * HEIGHT], classes[WIDTH * HEIGHT], rgba[4 * WIDTH * HEIGHT],
        facing[4 * WIDTH * HEIGHT];
    const stage_options options = {
        .platform = kind, .width = WIDTH, .height = HEIGHT, .exposure = 1.0, .depth_bits = 24, .stencil_bits = 8};
    const stage_wish bare = {.method = GN_METHOD_ZFAIL, .light_count = 1, .unbounded = 1};
    const stage_wish shadowed = {.method = GN_METHOD_ZFAIL, .casting = 1, .light_count = 1, .unbounded = 1};
    const truth_options tracing = {WIDTH, HEIGHT, 24, {0, 0}};
    char message[SCENE_MESSAGE] = "";
    static model m;
    uint32_t rng = 12345;
    size_t wrong = 0, seen_lit = 0;
    stage *s;

    setenv("GALLIUM_DRIVER", gallium, 1);
    make_model(&m);
    if (stage_open(&s, &m.s, &options, message) != 0) {
        printf("%s: %s\n", kind, message);
        _exit(255);
    }
    for (int view = 0; view < VIEWS; view++)
        for (int d = 0; d < 4; d++) {
            truth *t;

            place(&m, &rng, distances[d]);
            /* no animation moves it: stage_pose() but for the scene's own */
            for (int i = 0; i < 3; i++)
                s->lights[0].position[i] = m.light.position[i];
            t = truth_create(&m.s, &tracing, message);
            if (!t || !truth_light(t, 0, lit, visible, classes, message) || stage_plan(s, &bare, message) ||
                !stage_draw_mask(s, 0, message) || !platform_read_back(s->platform, facing) ||
                stage_plan(s, &shadowed, message) || !stage_draw_mask(s, 0, message) ||
                !platform_read_back(s->platform, rgba)) {
                printf("%s: %s\n", kind, message);
                _exit(255);
            }
            for (int i = 0; i < WIDTH * HEIGHT; i++) {
                seen_lit += lit[i] != 0;
                if (lit[i] && facing[4 * i] > 127 && rgba[4 * i] < 128) {
                    printf("%s %s: view %d, light at %g: pixel %d, %d is shadowed (class %d)\n", kind, gallium, view,
                           distances[d], i % WIDTH, i / WIDTH, classes[i]);
                    wrong++;
                }
            }
            truth_free(t);
        }
    if (seen_lit < (size_t)VIEWS * 4 * WIDTH * HEIGHT / 50) {
        printf("only %lu lit pixels were seen\n", (unsigned long)seen_lit);
        wrong++;
    }
    stage_close(s);
    fflush(stdout);
    _exit(wrong > 200 ? 200 : (int)wrong);
}

static void run(const char *kind, const char *gallium)
{
    const pid_t child = fork();
    int status = 1;

    assert_true(child >= 0);
    if (child == 0)
        check_driver(kind, gallium);
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_int_equal(status, 0);
}

static void on_llvmpipe(void **state)
{
    (void)state;
    run(test_platform(), "llvmpipe");
}

static void on_osmesa(void **state)
{
    (void)state;
    run("osmesa", "llvmpipe");
}

static void on_softpipe(void **state)
{
    (void)state;
    run(test_platform(), "softpipe");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(on_llvmpipe),
        cmocka_unit_test(on_osmesa),
        cmocka_unit_test(on_softpipe),
    };

    return cmocka_run_group_tests_name("convex", tests, NULL, NULL);
}
