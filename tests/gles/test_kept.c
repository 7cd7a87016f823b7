/* test_kept.c - masks that are used for several frames: the same bytes until they are due, those of a frame of its own when
 * they are; made anew where they cannot serve; and never taken for what they are not. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "device.h"
#include "gn_test.h"
#include "staged.h"

#define WIDTH  160
#define HEIGHT 120
#define EVERY  3

enum { BYTES = 4 * WIDTH * HEIGHT };

static staged drawn;
static stage *s;

static void open_stage(const char *name)
{
    const stage_options options = {.platform = test_platform(),
                                   .width = WIDTH,
                                   .height = HEIGHT,
                                   .depth_bits = 24,
                                   .stencil_bits = 8,
                                   .cache = {.masks_every = EVERY}};

    staged_open_as(&drawn, name, &options);
    s = drawn.stage;
}

static stage_wish wish_for(gn_method method, int keeps)
{
    const stage_wish wish = {
        .method = method, .casting = 1, .light_count = s->light_count, .unbounded = 1, .keeps = keeps, .scale = 2};

    return wish;
}

static void plan(const stage_wish *wish)
{
    char message[SCENE_MESSAGE] = "";

    if (stage_plan(s, wish, message) != 0)
        fail_msg("%s", message);
}

static void draw(const stage_wish *wish, uint8_t rgba[BYTES])
{
    char message[SCENE_MESSAGE] = "";

    plan(wish);
    if (!stage_draw_shares(s, message) || !platform_read_back(s->platform, rgba))
        fail_msg("%s", message);
    assert_int_equal(s->gl->glGetError(), GL_NO_ERROR);
}

/* Lights that turn, an eye that stays: for EVERY frames the masks are the first one's, to the last bit, and the picture is not that of
 * a frame of its own; then they are new. */
static void masks_stay_until_they_are_due(void **state)
{
    static const gn_method methods[] = {GN_METHOD_STENCIL, GN_METHOD_COUNT, GN_METHOD_ALPHA, GN_METHOD_SCREEN};
    static uint8_t fresh[2 * EVERY][BYTES], kept[BYTES];

    (void)state;
    for (size_t m = 0; m < sizeof methods / sizeof methods[0]; m++) {
        stage_wish once, keeping;
        size_t moved = 0, bytes;
        uint8_t *first = NULL, *mask;

        open_stage("colours");
        once = wish_for(methods[m], 0);
        keeping = wish_for(methods[m], 1);
        once.scale = keeping.scale = methods[m] == GN_METHOD_SCREEN ? 1 : 2;
        for (int frame = 0; frame < 2 * EVERY; frame++) {
            stage_pose(s, 0, 4.0 * frame);
            draw(&once, fresh[frame]);
        }
        for (int frame = 0; frame < 2 * EVERY; frame++) {
            stage_pose(s, 0, 4.0 * frame);
            draw(&keeping, kept);
            assert_int_equal(s->plan->mask_age, frame % EVERY);
            assert_true(frame % EVERY == 0 || s->plan->record_count == 0);
            assert_true(s->plan->lights[0].is_shadowed);
            if (frame % EVERY == 0)
                assert_memory_equal(kept, fresh[frame], BYTES);
            else
                moved += memcmp(kept, fresh[frame], BYTES) != 0;
            mask = staged_read_mask(&drawn, 0);
            bytes = (size_t)4 * s->plan->mask_size[0] * s->plan->mask_size[1];
            if (frame % EVERY == 0) {
                free(first);
                first = mask;
                continue;
            }
            assert_memory_equal(mask, first, bytes);
            free(mask);
        }
        free(first);
        assert_true(moved == 2 * (EVERY - 1));
        staged_close(&drawn);
    }
}

/* A still frame is the same however old its masks are: lit light by light, dimmed, or by masks made in its own colour. */
static void old_masks_are_in_their_places(void **state)
{
    static uint8_t first[BYTES], rgba[BYTES];

    (void)state;
    for (int way = 0; way < 3; way++) {
        int differing = 0;

        open_stage("offices"); /* lights with masks in several textures */
        stage_pose(s, 0, 0);
        for (int frame = 0; frame < 2 * EVERY; frame++) {
            stage_wish wish = wish_for(way == 2 ? GN_METHOD_SCREEN : GN_METHOD_COUNT, 1);
            char message[SCENE_MESSAGE] = "";

            wish.shade = way == 1 ? GN_SHADE_ATTENUATE : GN_SHADE_ADDITIVE;
            wish.scale = way == 2 ? 1 : 2;
            plan(&wish);
            assert_true(stage_draw_lit(s, 0, message));
            assert_true(platform_read_back(s->platform, frame ? rgba : first));
            assert_int_equal(s->plan->mask_age, frame % EVERY);
            assert_true(s->plan->mask_count > 1);
            for (int i = 0; frame && i < BYTES; i++)
                differing += first[i] != rgba[i];
        }
        /* after a pass of depth alone the last of several surfaces of one depth is seen, and not the first */
        assert_true(differing <= (way == 2 ? BYTES / 500 : 0));
        staged_close(&drawn);
    }
}

/* What comes nearer changes what depth is carried as: in frames that use masks again it is what they have. */
static void depth_stays_what_masks_carry(void **state)
{
    static uint8_t rgba[BYTES];
    double carried[2] = {0, 0};

    (void)state;
    open_stage("colours");
    for (int frame = 0; frame < EVERY + 1; frame++) {
        stage_wish wish = wish_for(GN_METHOD_COUNT, 1);

        wish.upsample = GN_UPSAMPLE_DEPTH;
        stage_pose(s, 0, 0);
        for (int axis = 0; axis < 3; axis++)
            drawn.loaded.camera.world[12 + axis] -= 0.2 * frame * drawn.loaded.camera.world[8 + axis];
        draw(&wish, rgba);
        assert_int_equal(s->plan->mask_age, frame % EVERY);
        if (frame == 0)
            memcpy(carried, s->plan->mask_depth, sizeof carried);
        if (frame < EVERY)
            assert_memory_equal(carried, s->plan->mask_depth, sizeof carried);
        else
            assert_true(carried[0] > s->plan->mask_depth[0]);
    }
    staged_close(&drawn);
}

/* Of another method, scale or number of lights; or of a light that was out of view. */
static void they_are_made_anew_where_they_cannot_serve(void **state)
{
    static uint8_t rgba[BYTES];
    stage_wish wish;

    (void)state;
    open_stage("colours");
    stage_pose(s, 0, 0);
    wish = wish_for(GN_METHOD_COUNT, 1);
    draw(&wish, rgba);
    for (int change = 0; change < 4; change++) {
        draw(&wish, rgba);
        assert_int_equal(s->plan->mask_age, 1);
        wish.scale = change == 0 ? 4 : wish.scale;
        wish.method = change == 1 ? GN_METHOD_SIGNED : wish.method;
        wish.light_count = change == 2 ? 2 : wish.light_count;
        wish.upsample = change == 3 ? GN_UPSAMPLE_DEPTH : wish.upsample;
        draw(&wish, rgba);
        assert_int_equal(s->plan->mask_age, 0);
    }
    staged_close(&drawn);

    open_stage("torches"); /* lights with a range */
    stage_pose(s, 0, 0);
    wish = wish_for(GN_METHOD_COUNT, 1);
    wish.unbounded = 0;
    s->lights[0].position[0] += 1000.0;
    draw(&wish, rgba);
    assert_int_equal(s->plan->lights[0].skip, GN_SKIP_OUT_OF_VIEW);
    assert_true(s->plan->mask_count > 0);
    s->lights[0].position[0] -= 1000.0;
    draw(&wish, rgba);
    assert_int_equal(s->plan->lights[0].skip, GN_SKIP_NOT);
    assert_int_equal(s->plan->mask_age, 0);
    assert_true(s->plan->lights[0].is_shadowed);
    draw(&wish, rgba);
    assert_int_equal(s->plan->mask_age, 1);
    staged_close(&drawn);
}

/* Another plan has made masks since: refused in words, until the cache forgets them. */
static void what_is_gone_is_refused(void **state)
{
    static uint8_t rgba[BYTES];
    stage_wish keeping, other;
    char message[SCENE_MESSAGE] = "";

    (void)state;
    open_stage("colours");
    stage_pose(s, 0, 0);
    keeping = wish_for(GN_METHOD_COUNT, 1);
    other = wish_for(GN_METHOD_COUNT, 0);
    draw(&keeping, rgba);
    draw(&other, rgba);
    plan(&keeping);
    assert_int_equal(s->plan->mask_age, 1);
    assert_int_equal(gn_gles_begin(s->gles, s->plan), GN_E_ARG);
    snprintf(message, sizeof message, "%s", gn_message(s->context));
    if (!strstr(message, "masks of 1 frames ago are gone"))
        fail_msg("%s", message);
    gn_shadow_cache_forget_masks(s->cache);
    draw(&keeping, rgba);
    assert_int_equal(s->plan->mask_age, 0);
    draw(&keeping, rgba);
    assert_int_equal(s->plan->mask_age, 1);
    staged_close(&drawn);
}

/* Under a stencil masks are in no texture to stay in: the plan says so. */
static void without_textures_they_are_made_each_time(void **state)
{
    static uint8_t rgba[BYTES];

    (void)state;
    open_stage("colours");
    stage_pose(s, 0, 0);
    for (int frame = 0; frame < 2; frame++) {
        const stage_wish wish = wish_for(GN_METHOD_REFINE, 1);

        draw(&wish, rgba);
        assert_int_equal(s->plan->mask_age, 0);
        assert_non_null(strstr(s->plan->lights[0].reason, "made in each frame"));
    }
    staged_close(&drawn);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(masks_stay_until_they_are_due), cmocka_unit_test(old_masks_are_in_their_places),
        cmocka_unit_test(depth_stays_what_masks_carry),  cmocka_unit_test(they_are_made_anew_where_they_cannot_serve),
        cmocka_unit_test(what_is_gone_is_refused),       cmocka_unit_test(without_textures_they_are_made_each_time)};

    return cmocka_run_group_tests_name("kept", tests, NULL, NULL);
}
