/* test_scale.c - invariance: a scene scaled by a power of two has the same masks to the last bit; scaled by powers of
 * ten, or moved a hundred thousand from the origin, the same certain pixels. llvmpipe. */
#include "device.h"
#include "gn_test.h"
#include "stage.h"
#include "truth.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 96, HEIGHT = 72, PIXELS = WIDTH * HEIGHT };

static const char *const scenes[] = {"cube_point",  "colours",          "ortho",    "ortho_container", "soup",
                                     "room_eye_in", "near_cuts_volume", "zfar",     "transforms",      "flat_light",
                                     "hole",        "open_container",   "courtyard"};

/* The posed scene in another unit of length, at another place. */
static void place(stage *s, double scale, double x)
{
    scene_camera *c = &s->scene->camera;
    const double offset[3] = {x, -x, 0.3 * x};

    stage_pose(s, 0, 0);
    for (size_t i = 0; i < s->scene->instance_count; i++) {
        double *m = s->scene->instances[i].world;

        for (int column = 0; column < 4; column++)
            for (int row = 0; row < 3; row++)
                m[4 * column + row] = m[4 * column + row] * scale + (column == 3 ? offset[row] : 0.0);
    }
    for (int i = 0; i < 3; i++) {
        c->world[12 + i] = c->world[12 + i] * scale + offset[i];
        for (uint32_t l = 0; l < s->light_count; l++)
            s->lights[l].position[i] = s->lights[l].position[i] * scale + offset[i];
    }
}

/* A camera's lengths stand in its lens, which posing does not set. */
static void set_lens(scene_camera *c, const scene_camera *lens, double scale)
{
    c->znear = lens->znear * scale;
    c->zfar = lens->zfar * scale;
    c->xmag = lens->xmag * scale;
    c->ymag = lens->ymag * scale;
}

static void draw(stage *s, gn_method method, uint32_t light, uint8_t *rgba)
{
    const stage_wish wish = {.method = method, .casting = 1, .first_light = light, .light_count = 1, .unbounded = 1};
    char message[SCENE_MESSAGE] = "";

    if (stage_plan(s, &wish, message) != 0 || !stage_draw_mask(s, light, message) ||
        !platform_read_back(s->platform, rgba))
        fail_msg("%s", message);
}

typedef struct fixture {
    scene loaded;
    scene_camera lens;
    stage *s;
} fixture;

static void open_scene(fixture *f, const char *name)
{
    const stage_options options = {
        .platform = test_platform(), .width = WIDTH, .height = HEIGHT, .depth_bits = 24, .stencil_bits = 8};
    char path[128], message[SCENE_MESSAGE] = "";

    setenv("GALLIUM_DRIVER", "llvmpipe", 1);
    snprintf(path, sizeof path, "build/scenes/%s.gltf", name);
    if (!scene_load(&f->loaded, path, NULL, message) || stage_open(&f->s, &f->loaded, &options, message) != 0)
        fail_msg("%s: %s", path, message);
    f->lens = f->loaded.camera;
}

static void close_scene(fixture *f)
{
    stage_close(f->s);
    scene_free(&f->loaded);
}

static void powers_of_two_change_no_bit(void **state)
{
    static const int powers[] = {-20, -13, -6, -1, 1, 7, 14, 20};
    static uint8_t right[4 * PIXELS], rgba[4 * PIXELS];

    (void)state;
    for (size_t n = 0; n < sizeof scenes / sizeof scenes[0]; n++) {
        fixture f;

        open_scene(&f, scenes[n]);
        for (int m = 0; m < 2; m++)
            for (uint32_t light = 0; light < f.s->light_count; light++) {
                const gn_method method = m ? GN_METHOD_STENCIL : GN_METHOD_ZFAIL;

                set_lens(&f.loaded.camera, &f.lens, 1.0);
                place(f.s, 1.0, 0.0);
                draw(f.s, method, light, right);
                for (size_t p = 0; p < sizeof powers / sizeof powers[0]; p++) {
                    set_lens(&f.loaded.camera, &f.lens, ldexp(1.0, powers[p]));
                    place(f.s, ldexp(1.0, powers[p]), 0.0);
                    draw(f.s, method, light, rgba);
                    if (memcmp(right, rgba, sizeof right) != 0)
                        fail_msg("%s, light %u, %s: another mask at 2^%d", scenes[n], (unsigned)light,
                                 gn_method_describe(method)->name, powers[p]);
                }
            }
        close_scene(&f);
    }
}

/* Against the truth of the scene as it is. */
static void certain_pixels_stay(void **state)
{
    static const struct {
        double scale, x;
    } places[] = {{1e-5, 0}, {1e-3, 0}, {0.1, 0}, {1e3, 0}, {1e5, 0}, {1, 1e5}, {1e-2, 1e5}, {10, -1e6}};
    static uint8_t rgba[4 * PIXELS], lit[PIXELS], visible[PIXELS], classes[PIXELS];
    uint64_t certain = 0;

    (void)state;
    for (size_t n = 0; n < sizeof scenes / sizeof scenes[0]; n++) {
        const truth_options options = {WIDTH, HEIGHT, 24, {0, 0}};
        char message[SCENE_MESSAGE] = "";
        fixture f;

        open_scene(&f, scenes[n]);
        for (uint32_t light = 0; light < f.s->light_count; light++) {
            truth *t;

            set_lens(&f.loaded.camera, &f.lens, 1.0);
            place(f.s, 1.0, 0.0);
            t = truth_create(&f.loaded, &options, message);
            if (!t || !truth_light(t, light, lit, visible, classes, message))
                fail_msg("%s: %s", scenes[n], message);
            truth_free(t);
            for (size_t p = 0; p < sizeof places / sizeof places[0]; p++) {
                set_lens(&f.loaded.camera, &f.lens, places[p].scale);
                place(f.s, places[p].scale, places[p].x);
                draw(f.s, GN_METHOD_STENCIL, light, rgba);
                for (int i = 0; i < PIXELS; i++) {
                    certain += classes[i] == TRUTH_CERTAIN;
                    if (classes[i] == TRUTH_CERTAIN &&
                        ((rgba[4 * i] > 127) != (lit[i] != 0) || (rgba[4 * i + 1] > 127) != (visible[i] != 0)))
                        fail_msg("%s, light %u, scaled by %g, moved by %g: pixel %d, %d is wrong", scenes[n],
                                 (unsigned)light, places[p].scale, places[p].x, i % WIDTH, i / WIDTH);
                }
            }
        }
        close_scene(&f);
    }
    assert_true(certain > 1000000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(powers_of_two_change_no_bit),
                                       cmocka_unit_test(certain_pixels_stay)};

    return cmocka_run_group_tests_name("scale", tests, NULL, NULL);
}
