/* test_bounds.c - bounded lights: from random places, the frame by `stencil`, which leaves out all that a light cannot
 * reach, is the frame by z-fail, which leaves out nothing; and it never costs more. llvmpipe. */
#include "counted_gl.h"
#include "device.h"
#include "gn_test.h"
#include "stage.h"
#include "views.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 64, HEIGHT = 48, VIEWS = 30 };

typedef struct cost {
    uint64_t draws, vertices, rasterised, passed;
} cost;

static void draw(stage *s, gn_method method, double least, uint8_t *rgba, cost *c)
{
    const stage_wish wish = {.method = method,
                             .casting = 1,
                             .light_count = s->light_count,
                             .least_light = least,
                             .without = ~0u}; /* z-fail's bits */
    char message[SCENE_MESSAGE] = "";
    const gl_counts before = counted_gl_read();

    if (stage_plan(s, &wish, message) != 0 || !stage_draw_lit(s, 0, message))
        fail_msg("%s", message);
    c->draws = counted_gl_read().draws - before.draws;
    c->vertices = counted_gl_read().vertices - before.vertices;
    assert_true(platform_read_back(s->platform, rgba));
    assert_true(stage_count_fragments(s, &c->rasterised, &c->passed));
}

static int most_difference(const uint8_t *a, const uint8_t *b)
{
    int most = 0;

    for (int i = 0; i < 4 * WIDTH * HEIGHT; i++) {
        const int d = a[i] > b[i] ? a[i] - b[i] : b[i] - a[i];

        most = i % 4 != 3 && d > most ? d : most;
    }
    return most;
}

static void check_costs(const char *name, int view, const cost *a, const cost *b)
{
    if (b->draws > a->draws || b->vertices > a->vertices || b->rasterised > a->rasterised || b->passed > a->passed)
        fail_msg("%s, view %d: %lu draws, %lu vertices, %lu fragments, %lu passed; z-fail %lu, %lu, %lu, %lu", name,
                 view, (unsigned long)b->draws, (unsigned long)b->vertices, (unsigned long)b->rasterised,
                 (unsigned long)b->passed, (unsigned long)a->draws, (unsigned long)a->vertices,
                 (unsigned long)a->rasterised, (unsigned long)a->passed);
}

static void bounded_frames_are_the_same(void **state)
{
    static const char *const scenes[] = {"hall",    "street",      "torches",   "dim_lights",
                                         "colours", "many_lights", "cube_spot", "ortho"};
    static uint8_t rgba[2][4 * WIDTH * HEIGHT];
    uint64_t skipped_lights = 0, skipped_casters = 0, scissored = 0;
    uint32_t rng = 77003u;
    int worst = 0;

    (void)state;
    setenv("GALLIUM_DRIVER", "llvmpipe", 1);
    for (size_t n = 0; n < sizeof scenes / sizeof scenes[0]; n++) {
        const stage_options options = {
            .platform = test_platform(), .width = WIDTH, .height = HEIGHT, .depth_bits = 24, .stencil_bits = 8};
        char path[128], message[SCENE_MESSAGE] = "";
        scene loaded;
        stage *s = NULL;

        snprintf(path, sizeof path, "build/scenes/%s.gltf", scenes[n]);
        if (!scene_load(&loaded, path, NULL, message) || stage_open(&s, &loaded, &options, message) != 0)
            fail_msg("%s: %s", path, message);
        for (int view = 0; view < VIEWS; view++) {
            cost costs[2];
            int difference;

            if (view > 0) /* shaders want lights from the eye: posed after it is moved, which stays so */
                test_random_view(&loaded, &rng);
            stage_pose(s, 0, 0);
            loaded.camera.node = SCENE_NONE;
            for (int m = 0; m < 2; m++)
                draw(s, m ? GN_METHOD_STENCIL : GN_METHOD_ZFAIL, 0.0, rgba[m], &costs[m]);
            difference = most_difference(rgba[0], rgba[1]);
            worst = difference > worst ? difference : worst;
            if (difference > (int)s->light_count)
                fail_msg("%s, view %d: a pixel differs by %d", path, view, difference);
            check_costs(scenes[n], view, &costs[0], &costs[1]);
            for (uint32_t l = 0; l < s->plan->light_count; l++) {
                skipped_lights += s->plan->lights[l].skip != GN_SKIP_NOT;
                skipped_casters += s->plan->lights[l].skipped_casters;
                scissored += s->plan->lights[l].skip == GN_SKIP_NOT &&
                             s->plan->lights[l].scissor[2] * s->plan->lights[l].scissor[3] < WIDTH * HEIGHT;
            }
        }
        stage_close(s);
        scene_free(&loaded);
    }
    print_message("           %lu lights and %lu casters left out, %lu lights scissored; worst difference %d\n",
                  (unsigned long)skipped_lights, (unsigned long)skipped_casters, (unsigned long)scissored, worst);
    assert_true(skipped_lights > 100 && skipped_casters > 1000 && scissored > 100);
}

/* Lights that are left out for their little importance take no more from a pixel than the plan says. */
static void unimportant_lights_cost_what_is_said(void **state)
{
    const stage_options options = {
        .platform = test_platform(), .width = WIDTH, .height = HEIGHT, .depth_bits = 24, .stencil_bits = 8};
    static uint8_t rgba[2][4 * WIDTH * HEIGHT];
    char message[SCENE_MESSAGE] = "";
    double error = 0.0;
    uint32_t out = 0;
    scene loaded;
    stage *s = NULL;
    cost c;

    (void)state;
    if (!scene_load(&loaded, "build/scenes/dim_lights.gltf", NULL, message) ||
        stage_open(&s, &loaded, &options, message) != 0)
        fail_msg("%s", message);
    stage_pose(s, 0, 0);
    draw(s, GN_METHOD_STENCIL, 0.0, rgba[0], &c);
    draw(s, GN_METHOD_STENCIL, 0.6, rgba[1], &c);
    for (uint32_t l = 0; l < s->plan->light_count; l++)
        if (s->plan->lights[l].skip == GN_SKIP_UNIMPORTANT) {
            assert_true(s->plan->lights[l].possible_error > 0.0 && s->plan->lights[l].possible_error <= 0.6);
            error += s->plan->lights[l].possible_error;
            out++;
        } else {
            assert_true(s->plan->lights[l].possible_error == 0.0);
        }
    assert_true(out > 0 && out < s->light_count);
    assert_in_range(most_difference(rgba[0], rgba[1]), 1, (int)(255.0 * error) + (int)out);
    stage_close(s);
    scene_free(&loaded);
}

/* Coincident surfaces: lit once by choice, the frame is that of the scene without the second ones; else light adds
 * up. */
static void coincident_surfaces_are_lit_once(void **state)
{
    const stage_options options = {.platform = test_platform(),
                                   .width = WIDTH,
                                   .height = HEIGHT,
                                   .depth_bits = 24,
                                   .stencil_bits = 8,
                                   .exposure = 0.05};
    static uint8_t rgba[3][4 * WIDTH * HEIGHT];
    char message[SCENE_MESSAGE] = "";
    scene loaded;
    stage *s = NULL;

    (void)state;
    if (!scene_load(&loaded, "build/scenes/coplanar.gltf", NULL, message) ||
        stage_open(&s, &loaded, &options, message) != 0)
        fail_msg("%s", message);
    stage_pose(s, 0, 0);
    for (int i = 0; i < 3; i++) {
        const stage_wish wish = {.casting = 1, .light_count = s->light_count, .blend_once = i < 2};
        const scene_instance mat = loaded.instances[loaded.instance_count - 1];
        const size_t all = loaded.instance_count;

        if (i == 0) { /* a floor, a box, the mat */
            loaded.instances[2] = mat;
            loaded.instance_count = 3;
        }
        if (stage_plan(s, &wish, message) != 0 || !stage_draw_lit(s, 0, message))
            fail_msg("%s", message);
        assert_true(platform_read_back(s->platform, rgba[i]));
        if (i == 0) {
            loaded.instances[2] = loaded.instances[0];
            loaded.instance_count = all;
        }
    }
    assert_int_equal(most_difference(rgba[0], rgba[1]), 0);
    assert_true(most_difference(rgba[0], rgba[2]) > 20);
    stage_close(s);
    scene_free(&loaded);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(bounded_frames_are_the_same),
                                       cmocka_unit_test(unimportant_lights_cost_what_is_said),
                                       cmocka_unit_test(coincident_surfaces_are_lit_once)};

    return cmocka_run_group_tests_name("bounds", tests, NULL, NULL);
}
