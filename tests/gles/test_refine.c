/* test_refine.c - small masks that are refined: next to nothing is wrong, few volumes' fragments are counted at full size,
 * nothing thin is lost; and it goes with all that the method stencil goes with. Against full masks by stencil. The table
 * of truth has it too. */
#include <stdlib.h>
#include <string.h>

#include "gn_test.h"
#include "spread.h"
#include "staged.h"

#define WIDTH  320
#define HEIGHT 240
#define MOST   48 /* masks */

enum { BYTES = 4 * WIDTH * HEIGHT };

static staged drawn;
static uint8_t full[BYTES], small[BYTES], refined[BYTES];

static void draw(const stage_wish *wish, int is_mask, uint8_t rgba[BYTES])
{
    char message[SCENE_MESSAGE] = "";

    if (stage_plan(drawn.stage, wish, message) != 0 ||
        !(is_mask ? stage_draw_mask(drawn.stage, wish->first_light, message)
                  : stage_draw_lit(drawn.stage, 0, message)) ||
        !platform_read_back(drawn.stage->platform, rgba))
        fail_msg("method %d: %s", (int)wish->method, message);
    assert_int_equal(drawn.stage->gl->glGetError(), GL_NO_ERROR);
}

static void draw_mask(gn_method method, uint32_t scale, uint32_t light, uint8_t rgba[BYTES])
{
    const stage_wish wish = {.method = method,
                             .casting = 1,
                             .first_light = light,
                             .light_count = 1,
                             .unbounded = 1,
                             .scale = scale,
                             .upsample = GN_UPSAMPLE_BILINEAR};

    draw(&wish, 1, rgba);
}

static size_t count_differing(const uint8_t *a, const uint8_t *b)
{
    size_t count = 0;

    for (size_t i = 0; i < BYTES; i += 4)
        count += (a[i] > 127) != (b[i] > 127);
    return count;
}

static uint64_t count_fragments(int contested)
{
    const gn_gl *gl = drawn.stage->gl;
    uint64_t rasterised = 0, passed = 0;

    if (contested) {
        gl->glEnable(GL_STENCIL_TEST); /* names are in the stencil still */
        gl->glStencilFunc(GL_EQUAL, 0, 128);
    }
    assert_true(stage_count_fragments(drawn.stage, &rasterised, &passed));
    gl->glDisable(GL_STENCIL_TEST);
    return rasterised;
}

/* Of each mask at scale 2 at most a tenth of bilinear's wrong pixels are wrong, of all together at most a fiftieth; and of
 * the fragments of full volumes, in the median, at most 0.45 pass the stencil test. */
static void little_is_wrong_and_little_is_counted(void **state)
{
    static const char *const scenes[] = {"colours",   "torus_knot", "cube_point", "pile_of_8",        "pile_of_27",
                                         "courtyard", "hall",       "primitives", "open_container",   "room_eye_out",
                                         "torches",   "ortho",      "transforms", "camera_in_shadow", "moebius"};
    double ratios[MOST];
    size_t wrong[2] = {0, 0};
    int masks = 0;

    (void)state;
    for (size_t sc = 0; sc < sizeof scenes / sizeof scenes[0]; sc++) {
        staged_open(&drawn, scenes[sc], WIDTH, HEIGHT);
        for (uint32_t light = 0; light < drawn.loaded.light_count && light < 3 && masks < MOST; light++) {
            size_t of_small, of_refined;
            uint64_t fragments;

            draw_mask(GN_METHOD_STENCIL, 2, light, small);
            draw_mask(GN_METHOD_STENCIL, 1, light, full);
            fragments = count_fragments(0);
            draw_mask(GN_METHOD_REFINE, 2, light, refined);
            ratios[masks++] = (double)count_fragments(1) / (double)fragments;
            of_small = count_differing(full, small);
            of_refined = count_differing(full, refined);
            if (10 * of_refined > of_small)
                fail_msg("%s, light %u: %lu pixels of %lu are wrong still", scenes[sc], (unsigned)light,
                         (unsigned long)of_refined, (unsigned long)of_small);
            wrong[0] += of_small;
            wrong[1] += of_refined;
        }
        staged_close(&drawn);
    }
    assert_true(50 * wrong[1] <= wrong[0]);
    qsort(ratios, (size_t)masks, sizeof *ratios, by_value);
    if (ratios[masks / 2] > 0.45)
        fail_msg("%g of the fragments pass", ratios[masks / 2]);
}

/* A fence whose posts and rails are a pixel wide, and their shadows: at scale 2 and 4 all but a pixel in a hundred. */
static void nothing_thin_is_lost(void **state)
{
    (void)state;
    staged_open(&drawn, "fence", WIDTH, HEIGHT);
    for (uint32_t scale = 2; scale <= 4; scale *= 2)
        for (uint32_t light = 0; light < drawn.loaded.light_count; light++) {
            size_t shadowed = 0, lost = 0;

            draw_mask(GN_METHOD_STENCIL, 1, light, full);
            draw_mask(GN_METHOD_REFINE, scale, light, refined);
            for (size_t i = 0; i < BYTES; i += 4)
                if (full[i] < 128 && full[i + 1] > 127) {
                    shadowed++;
                    lost += refined[i] > 127;
                }
            assert_true(shadowed > 500);
            if (100 * lost > shadowed)
                fail_msg("light %u at scale %u: %lu of %lu", (unsigned)light, (unsigned)scale, (unsigned long)lost,
                         (unsigned long)shadowed);
            draw_mask(GN_METHOD_STENCIL, scale, light, small);
            assert_true(count_differing(full, small) > 500); /* it is lost otherwise */
        }
    staged_close(&drawn);
}

/* The fence casts nothing and is lit, some of it, before a shadow: that of the block, which is the last thing, four times
 * as large. At scale 4. */
static void nothing_thin_is_darkened(void **state)
{
    size_t wrong = 0, shadowed = 0;

    (void)state;
    staged_open(&drawn, "fence", WIDTH, HEIGHT);
    for (size_t i = 0; i < drawn.loaded.instance_count; i++)
        drawn.loaded.instances[i].casts = i + 1 == drawn.loaded.instance_count;
    for (int k = 0; k < 11; k++)
        drawn.loaded.instances[drawn.loaded.instance_count - 1].world[k] *= 4.0;
    for (uint32_t light = 0; light < drawn.loaded.light_count; light++) {
        draw_mask(GN_METHOD_STENCIL, 1, light, full);
        draw_mask(GN_METHOD_REFINE, 4, light, refined);
        wrong += count_differing(full, refined);
        for (size_t i = 0; i < BYTES; i += 4)
            shadowed += full[i] < 128 && full[i + 1] > 127;
    }
    assert_true(shadowed > 5000);
    if (wrong > 4)
        fail_msg("%lu pixels", (unsigned long)wrong);
    staged_close(&drawn);
}

/* Whole frames, several lights in one: one-sided, surfaces lit once, dimmed, in batches, in half floats. */
static void it_goes_with_the_rest(void **state)
{
    static const struct {
        const char *scene;
        stage_wish wish;
        uint32_t hidden;
        int is_batched;
    } ways[] = {
        {"courtyard", {.casting = 1}, 0, 0},
        {"courtyard", {.casting = 1, .one_sided = 1}, 0, 0},
        {"courtyard", {.casting = 1}, 1u << GN_CAN_FRAGMENT_HIGHP, 0},
        {"courtyard", {.casting = 1}, 1u << GN_CAN_W0, 0},
        {"coplanar", {.casting = 1, .blend_once = 1}, 0, 0},
        {"many_lights", {.casting = 1}, 0, 0},
        {"colours", {.casting = 0, .blend_once = 1}, 0, 0}, /* no light has a shadow */
        {"hall", {.casting = 1, .shade = GN_SHADE_ATTENUATE}, 0, 0},
        {"nest_256", {.casting = 1}, 0, 1},
        {"nest_257", {.casting = 1}, 0, 1},
    };

    (void)state;
    for (size_t w = 0; w < sizeof ways / sizeof ways[0]; w++) {
        stage_wish wish = ways[w].wish;
        size_t differing = 0;

        staged_open(&drawn, ways[w].scene, WIDTH, HEIGHT);
        drawn.stage->target.hidden = ways[w].hidden;
        wish.light_count = drawn.stage->light_count;
        wish.method = GN_METHOD_STENCIL;
        draw(&wish, 0, full);
        wish.method = GN_METHOD_REFINE;
        draw(&wish, 0, refined);
        assert_int_equal(drawn.stage->plan->lights[0].method, GN_METHOD_REFINE);
        assert_true(!ways[w].is_batched || drawn.stage->plan->lights[0].batches > 1);
        for (size_t i = 0; i < BYTES; i++)
            differing += abs(full[i] - refined[i]) > 24;
        if (differing > BYTES / 500)
            fail_msg("%s, way %lu: %lu bytes differ", ways[w].scene, (unsigned long)w, (unsigned long)differing);
        staged_close(&drawn);
    }
}

static void plan_refined(gn_shade shade)
{
    const stage_wish wish = {.method = GN_METHOD_REFINE,
                             .casting = 1,
                             .light_count = drawn.stage->light_count,
                             .unbounded = 1,
                             .shade = shade};
    char message[SCENE_MESSAGE] = "";

    if (stage_plan(drawn.stage, &wish, message) != 0)
        fail_msg("%s", message);
}

/* Records that are thin, of one light or of any (-1), of one object or of any. */
static int count_thin(int light, int object)
{
    const gn_plan *plan = drawn.stage->plan;
    int count = 0;

    for (uint32_t i = 0; i < plan->record_count; i++)
        count += plan->records[i].thin && (light < 0 || plan->records[i].light == (uint32_t)light) &&
                 (object < 0 || plan->records[i].object == (uint32_t)object);
    return count;
}

/* By plans alone, of the fence (object 1): from inside its box, with a light in its middle; and where volumes have no end
 * of their own never less than where they have. */
static void thin_is_told_in_every_place(void **state)
{
    static const double along_it[16] = {0, 0, -1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 1.4, 0.5, -0.4, 1};
    int more = 0;
    stage *s;

    (void)state;
    staged_open(&drawn, "fence", WIDTH, HEIGHT);
    s = drawn.stage;
    plan_refined(GN_SHADE_ADDITIVE);
    assert_true(s->plan->objects[1].thin && !s->plan->objects[0].thin && !s->plan->objects[6].thin);
    assert_true(count_thin(0, 1) > 0 && count_thin(0, 6) == 0);
    for (int k = 0; k < 3; k++)
        s->lights[0].position[k] = k == 1 ? 0.45 : 0.0;
    plan_refined(GN_SHADE_ADDITIVE);
    assert_true(count_thin(0, 1) > 0);
    memcpy(drawn.loaded.camera.world, along_it, sizeof along_it);
    plan_refined(GN_SHADE_ADDITIVE);
    assert_true(s->plan->objects[1].thin);
    stage_pose(s, 0, 0);
    for (uint32_t width = WIDTH; width <= 16 * WIDTH; width += WIDTH / 4) {
        int ended, endless;

        s->target.width = width;
        s->target.height = width * HEIGHT / WIDTH;
        plan_refined(GN_SHADE_ADDITIVE);
        ended = count_thin(-1, -1);
        plan_refined(GN_SHADE_ATTENUATE);
        endless = count_thin(-1, -1);
        assert_true(endless >= ended);
        more += endless > ended; /* told by the farthest that it may fall on */
        s->target.hidden = 1u << GN_CAN_W0;
        plan_refined(GN_SHADE_ADDITIVE);
        assert_true(count_thin(-1, -1) >= ended);
        s->target.hidden = 0;
        if (width == WIDTH)
            assert_true(ended > 4);
        if (width == 16 * WIDTH)
            assert_int_equal(ended, 0);
    }
    assert_true(more > 0);
    staged_close(&drawn);
}

/* A law, by plans alone: how thin a square is that is seen from its side does not depend on which corner is its first. */
static void thin_is_the_same_for_every_corner(void **state)
{
    static const double at_origin[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    static const double turns[4][2] = {{0.8, 0.6}, {-0.6, 0.8}, {-0.8, -0.6}, {0.6, -0.8}};
    int thin = 0, wide = 0;

    (void)state;
    staged_open(&drawn, "fence", WIDTH, HEIGHT);
    memcpy(drawn.loaded.camera.world, at_origin, sizeof at_origin);
    for (int step = 1; step <= 200; step++) {
        int count = 0;

        for (int turn = 0; turn < 4; turn++) { /* the floor, 8 across, by quarters */
            const double c = turns[turn][0], s = turns[turn][1];
            const double model[16] = {c, 0, -s, 0, 0, 1, 0, 0, s, 0, c, 0, 0.5, -0.002 * step, -8, 1};

            memcpy(drawn.loaded.instances[0].world, model, sizeof model);
            plan_refined(GN_SHADE_ADDITIVE);
            count += drawn.stage->plan->objects[0].thin;
        }
        if (count % 4 != 0)
            fail_msg("%.3f below the eye it is thin in %d of 4 turns", 0.002 * step, count);
        thin += count == 4;
        wide += count == 0;
    }
    assert_true(thin > 20 && wide > 20);
    staged_close(&drawn);
}

static void what_it_lacks_is_named(void **state)
{
    const stage_wish wish = {.method = GN_METHOD_REFINE, .casting = 1, .light_count = 1};
    char message[SCENE_MESSAGE] = "";

    (void)state;
    staged_open(&drawn, "colours", WIDTH, HEIGHT);
    drawn.stage->target.hidden = 1u << GN_CAN_PACKED_DEPTH_STENCIL;
    assert_int_equal(stage_plan(drawn.stage, &wish, message), 3);
    if (!strstr(message, "packed-depth-stencil, which is hidden"))
        fail_msg("%s", message);
    staged_close(&drawn);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(little_is_wrong_and_little_is_counted),
                                       cmocka_unit_test(nothing_thin_is_lost),
                                       cmocka_unit_test(nothing_thin_is_darkened),
                                       cmocka_unit_test(it_goes_with_the_rest),
                                       cmocka_unit_test(thin_is_told_in_every_place),
                                       cmocka_unit_test(thin_is_the_same_for_every_corner),
                                       cmocka_unit_test(what_it_lacks_is_named)};

    return cmocka_run_group_tests_name("refine", tests, NULL, NULL);
}
