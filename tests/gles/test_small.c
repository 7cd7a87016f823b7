/* test_small.c - masks smaller than the frame: what is in them, and what the frame makes of them. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gn_test.h"
#include "staged.h"

#define WIDTH  240
#define HEIGHT 180

static staged drawn;

static void draw_mask(gn_method method, uint32_t scale, gn_upsample upsample)
{
    const stage_wish wish = {
        .method = method, .casting = 1, .light_count = 1, .unbounded = 1, .scale = scale, .upsample = upsample};
    char message[SCENE_MESSAGE] = "";

    if (stage_plan(drawn.stage, &wish, message) != 0 || !stage_draw_mask(drawn.stage, 0, message))
        fail_msg("method %d at scale %u: %s", (int)method, (unsigned)scale, message);
    assert_int_equal(drawn.stage->gl->glGetError(), GL_NO_ERROR);
}

static uint8_t *read_mask(void)
{
    const size_t pixels = (size_t)drawn.stage->plan->mask_size[0] * drawn.stage->plan->mask_size[1];
    uint8_t *rgba = staged_read_mask(&drawn, 0), *red = malloc(pixels);

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

            staged_open(&drawn, scenes[sc], WIDTH / scale, HEIGHT / scale);
            draw_mask(GN_METHOD_COUNT, 1, GN_UPSAMPLE_NEAREST);
            right = read_mask();
            staged_close(&drawn);
            staged_open(&drawn, scenes[sc], WIDTH, HEIGHT);
            for (int m = 0; m < 4; m++) {
                draw_mask(methods[m], scale, m & 1 ? GN_UPSAMPLE_BILINEAR : GN_UPSAMPLE_NEAREST);
                assert_int_equal(drawn.stage->plan->mask_size[0], WIDTH / scale);
                if (drawn.stage->plan->warnings & 1u << GN_WARN_RANGE)
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
            staged_close(&drawn);
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

        staged_open(&drawn, "cube_point", width, height);
        draw_mask(GN_METHOD_COUNT, 1, GN_UPSAMPLE_NEAREST);
        assert_true(platform_read_back(drawn.stage->platform, full));
        for (int m = 0; m < 3; m++)
            for (uint32_t scale = 2; scale <= 4; scale *= 2) {
                size_t wrong = 0;

                draw_mask(methods[m], scale, GN_UPSAMPLE_NEAREST);
                assert_int_equal(drawn.stage->plan->mask_size[0], (width + scale - 1) / scale);
                assert_int_equal(drawn.stage->plan->viewport[1], (height + scale - 1) / scale * scale);
                assert_true(platform_read_back(drawn.stage->platform, small));
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
        staged_close(&drawn);
    }
}

/* By the plan: what is counted into is a quarter, a sixteenth of the pixels. */
static void traffic_of_images_falls(void **state)
{
    double bytes[3];

    (void)state;
    staged_open(&drawn, "pile_of_8", WIDTH, HEIGHT);
    for (int i = 0; i < 3; i++) {
        draw_mask(GN_METHOD_COUNT, 1u << i, GN_UPSAMPLE_NEAREST);
        bytes[i] = drawn.stage->plan->traffic.image_color + drawn.stage->plan->traffic.image_depth;
    }
    assert_true(4.0 * bytes[1] <= 1.001 * bytes[0] && 16.0 * bytes[2] <= 1.001 * bytes[0]);
    staged_close(&drawn);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_small_mask_is_a_small_frames),
                                       cmocka_unit_test(odd_sizes_are_right),
                                       cmocka_unit_test(traffic_of_images_falls)};

    return cmocka_run_group_tests_name("small", tests, NULL, NULL);
}
