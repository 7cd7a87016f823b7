/* test_parts.c - a frame of several plans, each with lights of its own: the same pixels as of one plan, whatever the methods; and
 * what cannot follow another says so. */
#include "gn_test.h"

#include <stdlib.h>
#include <string.h>

#include "picture.h"
#include "staged.h"

enum { WIDTH = 160, HEIGHT = 120, BYTES = 3 * WIDTH * HEIGHT };

static staged t;
static uint8_t whole[BYTES], parts[BYTES];

static void draw(const stage_wish *wish)
{
    char message[SCENE_MESSAGE] = "";

    if (stage_plan(t.stage, wish, message) != 0 || !stage_draw_lit(t.stage, 0, message))
        fail_msg("%s", message);
}

static void draw_parts(const gn_method methods[2], uint32_t scale)
{
    static const uint32_t members[2][4] = {{0, 3}, {1, 2}};

    for (int part = 0; part < 2; part++) {
        const stage_wish wish = {.method = methods[part],
                                 .casting = 1,
                                 .members = members[part],
                                 .light_count = 2,
                                 .follows = part == 1,
                                 .precedes = part == 0,
                                 .scale = scale};

        draw(&wish);
    }
    assert_true(read_picture(t.stage, parts));
}

/* Exact methods have the same masks; light is added in another order, by which a level may round otherwise. */
static void two_plans_are_one_frame(void **state)
{
    static const gn_method methods[] = {GN_METHOD_STENCIL, GN_METHOD_ZFAIL, GN_METHOD_COUNT, GN_METHOD_SIGNED,
                                        GN_METHOD_ALPHA};
    enum { METHODS = sizeof methods / sizeof methods[0] };
    const stage_wish all = {.method = GN_METHOD_STENCIL, .casting = 1, .light_count = 4};

    (void)state;
    draw(&all);
    assert_true(read_picture(t.stage, whole));
    for (int a = 0; a < METHODS; a++)
        for (int b = 0; b < METHODS; b++) {
            const gn_method pair[2] = {methods[a], methods[b]};
            int wrong = 0;

            draw_parts(pair, 1);
            for (int i = 0; i < BYTES; i++)
                wrong += abs(parts[i] - whole[i]) > 3;
            if (wrong > 3 * 20) /* the halves of pixels on borders */
                fail_msg("%s and %s: %d levels differ", gn_method_describe(pair[0])->name,
                         gn_method_describe(pair[1])->name, wrong);
        }
}

/* Small masks in images after a frame that was drawn by a stencil, and the other way round. */
static void small_masks_follow_and_precede(void **state)
{
    static const gn_method pairs[][2] = {{GN_METHOD_STENCIL, GN_METHOD_REFINE},
                                         {GN_METHOD_REFINE, GN_METHOD_REFINE},
                                         {GN_METHOD_COUNT, GN_METHOD_REFINE}};
    const stage_wish all = {.method = GN_METHOD_STENCIL, .casting = 1, .light_count = 4};

    (void)state;
    draw(&all);
    assert_true(read_picture(t.stage, whole));
    for (size_t p = 0; p < sizeof pairs / sizeof pairs[0]; p++) {
        int wrong = 0;

        draw_parts(pairs[p], 2);
        for (int i = 0; i < BYTES; i++)
            wrong += abs(parts[i] - whole[i]) > 3;
        if (wrong > (pairs[p][0] == GN_METHOD_REFINE ? 3 * 20 : 3 * 400)) /* half masks are of 4 pixels each */
            fail_msg("pair %d: %d levels differ", (int)p, wrong);
    }
}

static void what_draws_into_the_target_follows_nothing(void **state)
{
    static const uint32_t members[2] = {1, 2};
    char message[SCENE_MESSAGE] = "";
    stage_wish wish = {.method = GN_METHOD_SCREEN, .casting = 1, .members = members, .light_count = 2, .follows = 1};

    (void)state;
    assert_int_equal(stage_plan(t.stage, &wish, message), 3);
    assert_string_equal(
        message,
        "plan: method screen at scale 1/1 makes masks in the target: it cannot follow another plan of the frame");
    wish.method = GN_METHOD_STENCIL;
    wish.shade = GN_SHADE_BLACK;
    assert_int_equal(stage_plan(t.stage, &wish, message), 1);
    assert_string_equal(message, "plan: a frame that is dimmed (shade 2) is one plan");
}

static int open_scene(void **state)
{
    (void)state;
    staged_open(&t, "colours", WIDTH, HEIGHT);
    return 0;
}

static int close_scene(void **state)
{
    (void)state;
    staged_close(&t);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(two_plans_are_one_frame),
        cmocka_unit_test(small_masks_follow_and_precede),
        cmocka_unit_test(what_draws_into_the_target_follows_nothing),
    };

    return cmocka_run_group_tests(tests, open_scene, close_scene);
}
