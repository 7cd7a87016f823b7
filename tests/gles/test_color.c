/* test_color.c - counts in colour on a real driver: the same bits as a stencil's in the same kind of target, one pass for
 * several lights like as many passes, frames that are dimmed, and no memory from frame to frame. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gn_test.h"
#include "staged.h"

#define WIDTH  200
#define HEIGHT 150

static const char *const scenes[] = {"colours", "courtyard", "hall", "dim_lights", "offices"};
enum { SCENES = sizeof scenes / sizeof scenes[0], BYTES = 4 * WIDTH * HEIGHT };

/* Everything but ends, patches and the like, which move pixels on borders; masks in textures as they come. */
#define PLAIN (~(unsigned)GN_MEASURE_MASKS)

static staged drawn;

static stage_wish wish_for(gn_method method, unsigned without)
{
    const stage_wish wish = {.method = method,
                             .casting = 1,
                             .light_count = (uint32_t)drawn.loaded.light_count,
                             .unbounded = 1,
                             .without = without};

    return wish;
}

/* Shares of lights, or the lit frame. */
static void draw(const stage_wish *wish, uint32_t hidden, int is_lit, uint8_t rgba[BYTES])
{
    char message[SCENE_MESSAGE] = "";

    drawn.stage->target.hidden = hidden;
    if (stage_plan(drawn.stage, wish, message) != 0 ||
        !(is_lit ? stage_draw_lit(drawn.stage, 0, message) : stage_draw_shares(drawn.stage, message)) ||
        !platform_read_back(drawn.stage->platform, rgba))
        fail_msg("method %d: %s", (int)wish->method, message);
    assert_int_equal(drawn.stage->gl->glGetError(), GL_NO_ERROR);
}

/* Pixels with a channel of colour that differs by more than `slack`. */
static int count_differing(const uint8_t *a, const uint8_t *b, int slack)
{
    int count = 0;

    for (int i = 0; i < BYTES; i += 4)
        count += abs(a[i] - b[i]) > slack || abs(a[i + 1] - b[i + 1]) > slack || abs(a[i + 2] - b[i + 2]) > slack;
    return count;
}

/* Framebuffer objects against framebuffer objects, the window against the window: they round borders their own way. */
static void counts_have_the_bits_of_a_stencil(void **state)
{
    static const struct {
        gn_method method;
        uint32_t hidden;
        int in_image, may_warn;
    } ways[] = {{GN_METHOD_COUNT, 0, 1, 0},
                {GN_METHOD_COUNT, 1u << GN_CAN_FRONT_FACING, 1, 0},
                {GN_METHOD_SIGNED, 1u << GN_CAN_ALPHA, 1, 0},
                {GN_METHOD_SIGNED, 0, 0, 0},
                {GN_METHOD_ALPHA, 0, 0, 1},
                {GN_METHOD_SCREEN, 0, 0, 1}};
    static uint8_t right[2][BYTES], rgba[BYTES];
    int compared[6] = {0};

    (void)state;
    for (int sc = 0; sc < SCENES; sc++) {
        stage_wish wish;

        staged_open(&drawn, scenes[sc], WIDTH, HEIGHT);
        wish = wish_for(GN_METHOD_STENCIL, ~0u);
        draw(&wish, 0, 0, right[0]);
        assert_int_equal(drawn.stage->plan->mask, GN_MASK_STENCIL);
        if (drawn.loaded.light_count > 2) {
            wish = wish_for(GN_METHOD_STENCIL, PLAIN);
            wish.merges_lights = 1;
            draw(&wish, 0, 0, right[1]);
            assert_int_equal(drawn.stage->plan->mask, GN_MASK_TEXTURE);
        }
        for (size_t w = 0; w < sizeof ways / sizeof ways[0]; w++) {
            if (ways[w].in_image && drawn.loaded.light_count < 3)
                continue;
            wish = wish_for(ways[w].method, ~0u);
            draw(&wish, ways[w].hidden, 0, rgba);
            if (ways[w].may_warn && drawn.stage->plan->warnings & 1u << GN_WARN_RANGE)
                continue;
            compared[w]++;
            if (count_differing(right[ways[w].in_image], rgba, 0) != 0)
                fail_msg("%s: way %lu differs in %d pixels", scenes[sc], (unsigned long)w,
                         count_differing(right[ways[w].in_image], rgba, 0));
        }
        staged_close(&drawn);
    }
    for (int w = 0; w < 6; w++)
        assert_true(compared[w] >= 3);
}

static void one_pass_adds_what_several_add(void **state)
{
    static const gn_method methods[] = {GN_METHOD_COUNT, GN_METHOD_SCREEN, GN_METHOD_STENCIL};
    static uint8_t several[BYTES], one[BYTES];

    (void)state;
    for (int sc = 0; sc < SCENES; sc++)
        for (size_t m = 0; m < sizeof methods / sizeof methods[0]; m++) {
            stage_wish wish;

            staged_open(&drawn, scenes[sc], WIDTH, HEIGHT);
            wish = wish_for(methods[m], 0);
            wish.merges_lights = 1;
            draw(&wish, 0, 1, one);
            assert_true(drawn.stage->plan->mask_count > 0);
            assert_true(drawn.stage->plan->mask_count < drawn.loaded.light_count);
            wish.lights_per_pass = methods[m] == GN_METHOD_STENCIL ? 2 : 1; /* one takes stencils to no texture */
            draw(&wish, 0, 1, several);
            assert_true(drawn.stage->plan->mask_count * wish.lights_per_pass >= drawn.loaded.light_count);
            if (count_differing(one, several, 2) != 0)
                fail_msg("%s: %d pixels differ by more than 2 of 255", scenes[sc], count_differing(one, several, 2));
            staged_close(&drawn);
        }
}

/* Every shadow leaves half, or nothing, of a frame that is lit as if nothing cast; whatever counts it. */
static void shadows_dim_a_lit_frame(void **state)
{
    static const struct {
        gn_method method;
        uint32_t hidden;
    } ways[] = {{GN_METHOD_SIGNED, 0},
                {GN_METHOD_ALPHA, 0},
                {GN_METHOD_ALPHA, 1u << GN_CAN_BLEND_MINMAX},
                {GN_METHOD_SCREEN, 0}};
    static uint8_t lit[BYTES], right[BYTES], rgba[BYTES];

    (void)state;
    staged_open(&drawn, "colours", WIDTH, HEIGHT);
    for (int shade = GN_SHADE_ATTENUATE; shade <= GN_SHADE_BLACK; shade++) {
        stage_wish wish = wish_for(GN_METHOD_STENCIL, ~0u);
        int dimmed = 0, kept = 0;

        wish.light_count = 1;
        wish.shade = (gn_shade)shade;
        wish.casting = 0;
        draw(&wish, 0, 1, lit);
        wish.casting = 1;
        draw(&wish, 0, 1, right);
        for (int i = 0; i < BYTES; i++) {
            const int left = shade == GN_SHADE_BLACK ? 0 : (lit[i] + 1) / 2;

            if (i % 4 == 3)
                continue;
            dimmed += lit[i] > 20 && abs(right[i] - left) <= 1;
            kept += lit[i] > 20 && right[i] == lit[i];
            assert_true(abs(right[i] - left) <= 1 || right[i] == lit[i]);
        }
        assert_true(dimmed > 2000 && kept > 2000);
        for (size_t w = 0; w < sizeof ways / sizeof ways[0]; w++) {
            wish.method = ways[w].method;
            draw(&wish, ways[w].hidden, 1, rgba);
            if (count_differing(right, rgba, 1) != 0)
                fail_msg("shade %d, way %lu: %d pixels differ", shade, (unsigned long)w,
                         count_differing(right, rgba, 1));
        }
    }
    staged_close(&drawn);
}

/* Lights with bounds, and things that do not receive: a dimmed frame is the same by every method, and dims no background. */
static void every_method_dims_alike(void **state)
{
    static const struct {
        gn_method method;
        uint32_t hidden;
        double dimmed;
    } ways[] = {{GN_METHOD_STENCIL, 0, 0.5},
                {GN_METHOD_SIGNED, 0, 0.3},
                {GN_METHOD_SIGNED, 1u << GN_CAN_ALPHA, 0.5},
                {GN_METHOD_ALPHA, 0, 0.7},
                {GN_METHOD_ALPHA, 0, 0.5},
                {GN_METHOD_ALPHA, 0, 0.3},
                {GN_METHOD_ALPHA, 1u << GN_CAN_BLEND_MINMAX, 0.7}};
    static const char *const names[] = {"hall", "offices", "colours"};
    static uint8_t lit[BYTES], right[BYTES], rgba[BYTES];
    int maximum = 0;

    (void)state;
    for (int n = 0; n < 3; n++) {
        staged_open(&drawn, names[n], WIDTH, HEIGHT);
        for (size_t i = 0; i < drawn.loaded.instance_count; i += 3)
            drawn.loaded.instances[i].receives = 0;
        for (size_t w = 0; w < sizeof ways / sizeof ways[0]; w++) {
            stage_wish wish = wish_for(GN_METHOD_ZFAIL, 0);
            int kept = 0, dimmed = 0;

            wish.unbounded = 0;
            wish.light_count = drawn.loaded.light_count < 3 ? (uint32_t)drawn.loaded.light_count : 3;
            wish.shade = GN_SHADE_ATTENUATE;
            wish.dimmed = ways[w].dimmed;
            wish.casting = 0;
            draw(&wish, 0, 1, lit);
            wish.casting = 1;
            draw(&wish, 0, 1, right);
            wish.method = ways[w].method;
            draw(&wish, ways[w].hidden, 1, rgba);
            if (drawn.stage->plan->warnings & 1u << GN_WARN_RANGE)
                continue;
            maximum += drawn.stage->plan->lights[0].color.by_maximum;
            /* in an image shadows of several lights are one product, elsewhere each is rounded */
            if (count_differing(right, rgba, 3) > (ways[w].hidden == 1u << GN_CAN_ALPHA ? 40 : 0))
                fail_msg("%s, way %lu: %d pixels differ", names[n], (unsigned long)w, count_differing(right, rgba, 3));
            for (int i = 0; i < BYTES; i += 4) {
                kept += memcmp(lit + i, rgba + i, 3) == 0;
                dimmed += rgba[i] < lit[i];
            }
            assert_true(kept > 500 && dimmed > 500);
        }
        staged_close(&drawn);
    }
    assert_true(maximum > 0);
}

/* Alpha is 1 when the frame is done, as compositors want it. */
static void alpha_is_left_full(void **state)
{
    static const gn_method methods[] = {GN_METHOD_SIGNED, GN_METHOD_ALPHA};
    static uint8_t rgba[BYTES];

    (void)state;
    staged_open(&drawn, "colours", WIDTH, HEIGHT);
    for (int m = 0; m < 2; m++) {
        const stage_wish wish = wish_for(methods[m], 0);

        draw(&wish, 0, 1, rgba);
        for (int i = 3; i < BYTES; i += 4)
            assert_int_equal(rgba[i], 255);
    }
    staged_close(&drawn);
}

static void frames_take_no_memory(void **state)
{
    static uint8_t rgba[BYTES];

    (void)state;
    staged_open(&drawn, "colours", WIDTH, HEIGHT);
    for (int m = GN_METHOD_STENCIL; m < GN_METHOD_TOTAL; m++) {
        const stage_wish wish = wish_for((gn_method)m, 0);
        uint64_t before;

        draw(&wish, 0, 1, rgba);
        before = drawn.stage->allocations;
        for (int frame = 0; frame < 3; frame++)
            draw(&wish, 0, 1, rgba);
        assert_int_equal(drawn.stage->allocations, before);
    }
    staged_close(&drawn);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(counts_have_the_bits_of_a_stencil),
                                       cmocka_unit_test(one_pass_adds_what_several_add),
                                       cmocka_unit_test(shadows_dim_a_lit_frame),
                                       cmocka_unit_test(every_method_dims_alike),
                                       cmocka_unit_test(alpha_is_left_full),
                                       cmocka_unit_test(frames_take_no_memory)};

    return cmocka_run_group_tests_name("color", tests, NULL, NULL);
}
