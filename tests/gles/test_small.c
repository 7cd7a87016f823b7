/* test_small.c - masks smaller than the frame: what is in them, and what the frame makes of them. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gn_test.h"
#include "stage.h"

#define WIDTH  240
#define HEIGHT 180

static scene loaded;
static stage *s;

static void open_scene(const char *name, uint32_t width, uint32_t height)
{
    const stage_options options = {
        .platform = "egl", .width = width, .height = height, .exposure = 1.0, .depth_bits = 24, .stencil_bits = 8};
    char path[128], message[SCENE_MESSAGE] = "";

    snprintf(path, sizeof path, "build/scenes/%s.gltf", name);
    if (!scene_load(&loaded, path, NULL, message) || !scene_ensure_view(&loaded, (double)WIDTH / HEIGHT, NULL) ||
        stage_open(&s, &loaded, &options, message) != 0)
        fail_msg("%s: %s", name, message);
    stage_pose(s, 0, 0);
}

static void close_scene(void)
{
    stage_close(s);
    scene_free(&loaded);
}

static void draw_mask(gn_method method, uint32_t scale, gn_upsample upsample)
{
    const stage_wish wish = {
        .method = method, .casting = 1, .light_count = 1, .unbounded = 1, .scale = scale, .upsample = upsample};
    char message[SCENE_MESSAGE] = "";

    if (stage_plan(s, &wish, message) != 0 || !stage_draw_mask(s, 0, message))
        fail_msg("method %d at scale %u: %s", (int)method, (unsigned)scale, message);
    assert_int_equal(s->gl->glGetError(), GL_NO_ERROR);
}

/* The first mask texture of the plan just drawn: [mask_size[1]][mask_size[0]][4], lowest row first. */
static uint8_t *read_texture(void)
{
    const gn_gl *gl = s->gl;
    const uint32_t *size = s->plan->mask_size;
    uint8_t *rgba = malloc((size_t)4 * size[0] * size[1]);
    GLuint framebuffer;

    gl->glGenFramebuffers(1, &framebuffer);
    gl->glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl->glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, gn_gles_mask(s->gles, 0), 0);
    assert_int_equal(gl->glCheckFramebufferStatus(GL_FRAMEBUFFER), GL_FRAMEBUFFER_COMPLETE);
    gl->glReadPixels(0, 0, (GLsizei)size[0], (GLsizei)size[1], GL_RGBA, GL_UNSIGNED_BYTE, rgba);
    gl->glBindFramebuffer(GL_FRAMEBUFFER, s->target.framebuffer);
    gl->glDeleteFramebuffers(1, &framebuffer);
    return rgba;
}

static uint8_t *read_mask(void)
{
    const size_t pixels = (size_t)s->plan->mask_size[0] * s->plan->mask_size[1];
    uint8_t *rgba = read_texture(), *red = malloc(pixels);

    for (size_t i = 0; i < pixels; i++)
        red[i] = rgba[4 * i];
    free(rgba);
    return red;
}

/* A mask at scale 2 or 4 is the mask of a frame of that size, to the last bit. */
static void a_small_mask_is_a_small_frames(void **state)
{
    static const gn_method methods[] = {GN_METHOD_COUNT, GN_METHOD_SIGNED, GN_METHOD_ALPHA, GN_METHOD_STENCIL};
    static const char *const scenes[] = {"colours", "torus_knot", "eye_on_side", "pile_of_8"};

    (void)state;
    for (uint32_t scale = 2; scale <= 4; scale *= 2)
        for (int sc = 0; sc < 4; sc++) {
            uint8_t *right, *mask;
            const size_t pixels = (size_t)WIDTH / scale * HEIGHT / scale;
            size_t shadowed = 0;

            open_scene(scenes[sc], WIDTH / scale, HEIGHT / scale);
            draw_mask(GN_METHOD_COUNT, 1, GN_UPSAMPLE_NEAREST);
            right = read_mask();
            close_scene();
            open_scene(scenes[sc], WIDTH, HEIGHT);
            for (int m = 0; m < 4; m++) {
                draw_mask(methods[m], scale, m & 1 ? GN_UPSAMPLE_BILINEAR : GN_UPSAMPLE_NEAREST);
                assert_int_equal(s->plan->mask_size[0], WIDTH / scale);
                if (s->plan->warnings & 1u << GN_WARN_RANGE)
                    continue;
                mask = read_mask();
                for (size_t i = 0; i < pixels; i++) {
                    shadowed += mask[i] == 0;
                    if (mask[i] != right[i])
                        fail_msg("%s at scale %u, method %d: mask pixel %lu is %d, not %d", scenes[sc], (unsigned)scale,
                                 (int)methods[m], (unsigned long)i, mask[i], right[i]);
                }
                free(mask);
            }
            assert_true(shadowed > 100);
            free(right);
            close_scene();
        }
}

/* Frames that are no multiple of the scale: a pixel of the mask has its own block, and away from borders of shadows and
 * surfaces the frame is as with full masks. */
static void odd_sizes_are_right(void **state)
{
    static const gn_method methods[] = {GN_METHOD_COUNT, GN_METHOD_STENCIL, GN_METHOD_SCREEN};

    (void)state;
    for (uint32_t extra = 1; extra < 4; extra++) {
        const uint32_t width = WIDTH + extra, height = HEIGHT + 4 - extra;
        uint8_t *full = malloc((size_t)4 * width * height), *small = malloc((size_t)4 * width * height);

        open_scene("cube_point", width, height);
        draw_mask(GN_METHOD_COUNT, 1, GN_UPSAMPLE_NEAREST);
        assert_true(platform_read_back(s->platform, full));
        for (int m = 0; m < 3; m++)
            for (uint32_t scale = 2; scale <= 4; scale *= 2) {
                size_t wrong = 0;

                draw_mask(methods[m], scale, GN_UPSAMPLE_NEAREST);
                assert_int_equal(s->plan->mask_size[0], (width + scale - 1) / scale);
                assert_int_equal(s->plan->viewport[1], (height + scale - 1) / scale * scale);
                assert_true(platform_read_back(s->platform, small));
                for (uint32_t y = scale; y + scale < height; y++)
                    for (uint32_t x = scale; x + scale < width; x++) {
                        const size_t at = (size_t)width * y + x;
                        int is_plain = 1; /* all around is the same */

                        for (int dy = -(int)scale; dy <= (int)scale; dy++)
                            for (int dx = -(int)scale; dx <= (int)scale; dx++)
                                is_plain &= memcmp(full + 4 * at, full + 4 * (size_t)((long)at + dy * (long)width + dx),
                                                   2) == 0;
                        wrong += is_plain && memcmp(full + 4 * at, small + 4 * at, 2) != 0;
                    }
                if (wrong)
                    fail_msg("%ux%u, method %d at scale %u: %lu pixels", (unsigned)width, (unsigned)height,
                             (int)methods[m], (unsigned)scale, (unsigned long)wrong);
            }
        free(full);
        free(small);
        close_scene();
    }
}

/* The depth that the masks of a frame twice as large carry: [HEIGHT][WIDTH], row 0 on top. */
static void read_depth(const char *name, double depth[HEIGHT][WIDTH])
{
    uint8_t *rgba;

    open_scene(name, 2 * WIDTH, 2 * HEIGHT);
    draw_mask(GN_METHOD_COUNT, 2, GN_UPSAMPLE_DEPTH);
    rgba = read_texture();
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            const uint8_t *at = rgba + 4 * (size_t)(WIDTH * (HEIGHT - 1 - y) + x);

            depth[y][x] = at[2] / 255.0 + at[3] / 65025.0;
        }
    free(rgba);
    close_scene();
}

/* Depth is linear on the image of a plane: where it bends there is an edge. */
static int is_edge(double depth[HEIGHT][WIDTH], int x, int y)
{
    const double at = depth[y][x];

    return fabs(depth[y][x - 1] + depth[y][x + 1] - 2.0 * at) > 0.02 * at ||
           fabs(depth[y - 1][x] + depth[y + 1][x] - 2.0 * at) > 0.02 * at;
}

static int is_near_edge(double depth[HEIGHT][WIDTH], int x, int y)
{
    for (int dy = -2; dy <= 2; dy++)
        for (int dx = -2; dx <= 2; dx++)
            if (is_edge(depth, x + dx, y + dy))
                return 1;
    return 0;
}

/* Near edges of depth fewer pixels are wrong than by bilinear (the rest are borders of shadows there), and nowhere more. */
static void depth_keeps_edges(void **state)
{
    static const char *const scenes[] = {"colours", "torus_knot", "cube_point", "pile_of_8", "courtyard"};
    static double depth[HEIGHT][WIDTH];
    static uint8_t full[4 * WIDTH * HEIGHT], small[4 * WIDTH * HEIGHT];
    size_t wrong[2][2] = {{0, 0}, {0, 0}}; /* by bilinear, by depth: elsewhere, near an edge */

    (void)state;
    for (size_t sc = 0; sc < sizeof scenes / sizeof scenes[0]; sc++) {
        read_depth(scenes[sc], depth);
        open_scene(scenes[sc], WIDTH, HEIGHT);
        draw_mask(GN_METHOD_COUNT, 1, GN_UPSAMPLE_NEAREST);
        assert_true(platform_read_back(s->platform, full));
        for (int way = 0; way < 2; way++) {
            draw_mask(GN_METHOD_COUNT, 2, way ? GN_UPSAMPLE_DEPTH : GN_UPSAMPLE_BILINEAR);
            assert_true(platform_read_back(s->platform, small));
            for (int y = 3; y < HEIGHT - 3; y++)
                for (int x = 3; x < WIDTH - 3; x++) {
                    const size_t at = 4 * (size_t)(WIDTH * y + x);

                    wrong[way][is_near_edge(depth, x, y)] += (full[at] > 127) != (small[at] > 127);
                }
        }
        close_scene();
    }
    assert_true(wrong[1][0] <= wrong[0][0]);
    assert_true(4 * wrong[1][1] < 3 * wrong[0][1]);
}

/* By the plan: what is counted into is a quarter, a sixteenth of the pixels. */
static void traffic_of_images_falls(void **state)
{
    double bytes[3];

    (void)state;
    open_scene("pile_of_8", WIDTH, HEIGHT);
    for (int i = 0; i < 3; i++) {
        draw_mask(GN_METHOD_COUNT, 1u << i, GN_UPSAMPLE_NEAREST);
        bytes[i] = s->plan->traffic.image_color + s->plan->traffic.image_depth;
    }
    assert_true(4.0 * bytes[1] <= 1.001 * bytes[0] && 16.0 * bytes[2] <= 1.001 * bytes[0]);
    close_scene();
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_small_mask_is_a_small_frames),
                                       cmocka_unit_test(odd_sizes_are_right), cmocka_unit_test(depth_keeps_edges),
                                       cmocka_unit_test(traffic_of_images_falls)};

    return cmocka_run_group_tests_name("small", tests, NULL, NULL);
}
