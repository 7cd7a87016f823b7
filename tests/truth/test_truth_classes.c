/* test_truth_classes.c - how sure a pixel is: what must never be called certain, and what must be. */
#include "truth_stage.h"

enum { SIDE = 96 };

#define HALF 2.03

/* The column or row of the image from above at that x or z. */
static int at_pixel(double x)
{
    return (int)floor((x / HALF + 1.0) * SIDE / 2.0);
}

/* Slats a hundredth of a pixel wide, their shadows moved aside by their height: no subsample need meet them. */
static void what_is_thinner_than_a_pixel_leaves_no_pixel_certain(void **unused)
{
    const double width = 0.01 * 2 * HALF / SIDE, height = 1.1;
    uint8_t crossed[SIDE] = {0};
    stage st = {0};
    masks m;

    (void)unused;
    stage_table(&st, SINGLE, 0, -9, 9, -9, 9);
    for (int i = 0; i < 12; i++) {
        const double x = -0.7 + 0.1373 * i;

        stage_table(&st, DOUBLE, height, x, x + width, -9, 9);
        crossed[at_pixel(x - height)] = 1;
        crossed[at_pixel(x - height + width)] = 1;
    }
    stage_light(&st, SCENE_DIRECTIONAL, 1, 1, 0);
    stage_camera_above(&st, 5, HALF);
    m = stage_masks(&st, SIDE, SIDE, 24, 0);
    for (int i = 0; i < SIDE * SIDE; i++)
        if ((m.classes[i] != TRUTH_CERTAIN) != crossed[i % SIDE])
            fail_msg("column %d: class %d", i % SIDE, m.classes[i]);
    masks_free(&m);
    stage_free(&st);
}

/* The same of light: two tables leave a gap a fiftieth of a pixel wide between their shadows. */
static void a_ray_of_light_thinner_than_a_pixel_is_found(void **unused)
{
    const double gap = 0.02 * 2 * HALF / SIDE, edge = 0.3217;
    stage st = {0};
    masks m;

    (void)unused;
    stage_table(&st, SINGLE, 0, -9, 9, -9, 9);
    stage_table(&st, SINGLE, 6, -20, edge + 6, -20, 20);
    stage_table(&st, SINGLE, 6, edge + gap + 6, 20, -20, 20);
    stage_light(&st, SCENE_DIRECTIONAL, 1, 1, 0);
    stage_camera_above(&st, 5, HALF);
    m = stage_masks(&st, SIDE, SIDE, 24, 0);
    for (int i = 0; i < SIDE * SIDE; i++)
        if ((m.classes[i] != TRUTH_CERTAIN) != (i % SIDE == at_pixel(edge)))
            fail_msg("column %d: class %d", i % SIDE, m.classes[i]);
    masks_free(&m);
    stage_free(&st);
}

/* A small table below a large one: its edges bear no shadow edge, nor does the seam in the large one. */
static void edges_in_a_greater_shadow_are_certain(void **unused)
{
    stage st = {0};
    masks m;

    (void)unused;
    stage_table(&st, SINGLE, 0, -30, 30, -30, 30);
    stage_table(&st, SINGLE, 7, -9, 7.123, -9, 9);
    stage_table(&st, SINGLE, 7, 7.123, 20, -9, 9); /* not welded to it: it has no vertex in common but two */
    for (int i = 0; i < 2; i++) {
        scene_instance *cube = stage_cube(&st, SINGLE, 0.4);

        cube->world[12] = 5.7 * i;
        cube->world[13] = 5.6;
    }
    stage_table(&st, SINGLE, 6.5, 6.1, 7.2, -0.3, 0.4);
    stage_light(&st, SCENE_DIRECTIONAL, 1, 1, 0);
    stage_light(&st, SCENE_POINT, 1, 6.9, 0.2);
    stage_camera_above(&st, 5, HALF);
    m = stage_masks(&st, SIDE, SIDE, 24, 0);
    masks_check_area(&m, SHADOWED, SIDE * SIDE, 0, 0);
    masks_free(&m);
    m = stage_masks(&st, SIDE, SIDE, 24, 1); /* and the lamp below the large table has the other cube's shadow */
    assert_true(masks_count(&m, TRUTH_BOUNDARY) > 10);
    assert_true(masks_count(&m, TRUTH_CERTAIN) > SIDE * SIDE * 9 / 10);
    masks_free(&m);
    stage_free(&st);
}

/* Another surface of another state within two depth steps, or a caster that close to what it shades. */
static void what_two_depth_steps_turn_over_is_depth_limited(void **unused)
{
    static const struct {
        int bits;
        double gap;
        truth_class expected;
    } cases[] = {
        {24, 1e-2, TRUTH_CERTAIN},
        {24, 5e-7, TRUTH_DEPTH_LIMITED},
        {10, 5e-3, TRUTH_DEPTH_LIMITED},
        {10, 3e-2, TRUTH_CERTAIN},
    };

    (void)unused;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        stage st = {0};
        masks m;

        stage_table(&st, SINGLE, 0, -9, 9, -9, 9);
        /* in gap above the floor hangs a sheet that does not receive, and so is lit under the roof */
        stage_table(&st, SINGLE, cases[i].gap, -8, 8, -8, 8)->receives = 0;
        stage_table(&st, SINGLE, 8, -99, 99, -99, 99);
        stage_light(&st, SCENE_DIRECTIONAL, 0.1, 1, 0.2);
        stage_camera_above(&st, 5, HALF);
        st.s.camera.zfar = 5.1;
        m = stage_masks(&st, 16, 16, cases[i].bits, 0);
        for (int n = 0; n < 256; n++)
            if (m.classes[n] != cases[i].expected)
                fail_msg("case %lu: class %d", (unsigned long)i, m.classes[n]);
        masks_free(&m);
        stage_free(&st);
    }
}

/* Two surfaces in the same place: which is seen is anybody's guess. */
static void coincident_surfaces_of_two_states_are_not_certain(void **unused)
{
    stage st = {0};
    masks m;

    (void)unused;
    stage_table(&st, SINGLE, 0, -9, 9, -9, 9);
    stage_table(&st, SINGLE, 0, -8, 8, -8, 8)->receives = 0;
    stage_table(&st, SINGLE, 8, -99, 99, -99, 99);
    stage_light(&st, SCENE_DIRECTIONAL, 0.1, 1, 0.2);
    stage_camera_above(&st, 5, HALF);
    m = stage_masks(&st, 16, 16, 24, 0);
    assert_int_equal(masks_count(&m, TRUTH_CERTAIN), 0);
    masks_free(&m);
    stage_free(&st);
}

/* Moved behind its own surface a point is no more in shadow than before, however coarse the depth. */
static void a_surface_does_not_shade_itself(void **unused)
{
    stage st = {0};
    masks m;

    (void)unused;
    stage_table(&st, DOUBLE, 0, -3, 0.1, -3, 3); /* their diagonals and their seam are in the image */
    stage_table(&st, DOUBLE, 0, 0.1, 3, -3, 3);
    stage_light(&st, SCENE_POINT, 1.5, 0.3, 0.2);
    stage_camera_above(&st, 5, HALF);
    st.s.camera.zfar = 9;
    m = stage_masks(&st, SIDE, SIDE, 10, 0);
    masks_check_area(&m, LIT, SIDE * SIDE, 0, 0);
    masks_free(&m);
    stage_free(&st);
}

/* A face that a float light cannot tell from edge-on is not certain; one that double cannot is unlit. */
static void nearly_edge_on_is_not_certain(void **unused)
{
    static const double heights[] = {0.0, 1e-8, -1e-8, 1e-3};

    (void)unused;
    for (int i = 0; i < 4; i++) {
        stage st = {0};
        masks m;

        stage_table(&st, SINGLE, 0, -9, 9, -9, 9);
        stage_light(&st, SCENE_DIRECTIONAL, 1, heights[i], 0.25);
        stage_camera_above(&st, 5, HALF);
        m = stage_masks(&st, 16, 16, 24, 0);
        for (int n = 0; n < 256; n++) {
            assert_int_equal(m.classes[n], i < 3 ? TRUTH_SNAPPED : TRUTH_CERTAIN);
            assert_int_equal(m.lit[n], heights[i] > 0.0 ? 255 : 0);
        }
        masks_free(&m);
        stage_free(&st);
    }
    for (int i = 1; i < 40; i++) { /* turned about z, a table and the light in its plane: rounding is no light */
        const double angle = 0.03 * i;
        stage st = {0};
        scene_instance *table = stage_table(&st, DOUBLE, 0, -9, 9, -9, 9);
        masks m;

        table->world[0] = table->world[5] = cos(angle);
        table->world[1] = sin(angle);
        table->world[4] = -sin(angle);
        stage_light(&st, SCENE_POINT, 7 * cos(angle), 7 * sin(angle), 0.4);
        stage_camera_above(&st, 15, 0.5);
        m = stage_masks(&st, 4, 4, 24, 0);
        for (int n = 0; n < 16; n++)
            assert_int_equal(masks_state(&m, (size_t)n), SHADOWED);
        masks_free(&m);
        stage_free(&st);
    }
}

static void soup_above(stage *st, uint32_t seed, int directional)
{
    uint32_t indices[3 * 40];
    float p[9 * 40];

    stage_table(st, SINGLE, 0, -9, 9, -9, 9);
    for (uint32_t i = 0; i < 9 * 40; i++)
        p[i] = (float)(i % 3 == 1 ? stage_random(&seed, 2.5, 3.5) : stage_random(&seed, -3, 3));
    for (uint32_t i = 0; i < 3 * 40; i++)
        indices[i] = i % 3 == 2 || stage_random(&seed, 0, 1) < 0.5 ? i : (i + 30) % 120; /* some share vertices */
    stage_mesh(st, DOUBLE, 120, p, 40, indices);
    stage_light(st, directional ? SCENE_DIRECTIONAL : SCENE_POINT, stage_random(&seed, -1, 1), 5, 0.3);
    stage_camera_above(st, 2, HALF); /* below the soup: only its shadows are seen */
}

/* A certain pixel is of one state all over: in an image of 5 times the size its 25 pixels all are that state. */
static void certain_pixels_are_of_one_state_all_over(void **unused)
{
    size_t certain = 0;

    (void)unused;
    for (uint32_t run = 1; run <= 8; run++) {
        stage st = {0};
        masks coarse, fine;

        soup_above(&st, run, run % 2 == 0);
        coarse = stage_masks(&st, 32, 32, 24, 0);
        fine = stage_masks(&st, 160, 160, 24, 0);
        for (uint32_t i = 0; i < 160 * 160; i++) {
            const uint32_t n = i / 160 / 5 * 32 + i % 160 / 5;

            if (coarse.classes[n] == TRUTH_CERTAIN && coarse.lit[n] != fine.lit[i])
                fail_msg("run %u: pixel %u, %u", run, n % 32, n / 32);
            certain += coarse.classes[n] == TRUTH_CERTAIN;
        }
        masks_free(&coarse);
        masks_free(&fine);
        stage_free(&st);
    }
    assert_true(certain > 8 * 160 * 160 / 3);
}

/* Fewer bits make no pixel surer, and change neither mask nor any other class. */
static void depth_bits_change_only_what_is_depth_limited(void **unused)
{
    (void)unused;
    for (uint32_t run = 1; run <= 6; run++) {
        stage st = {0};
        masks fine, coarse;

        soup_above(&st, run, run % 2 == 0);
        st.s.camera.world[13] = 6; /* above the soup */
        fine = stage_masks(&st, 48, 48, 24, 0);
        coarse = stage_masks(&st, 48, 48, 11, 0);
        assert_memory_equal(fine.lit, coarse.lit, 48 * 48);
        assert_memory_equal(fine.visible, coarse.visible, 48 * 48);
        for (int i = 0; i < 48 * 48; i++) {
            assert_true((fine.classes[i] >= TRUTH_SNAPPED) == (coarse.classes[i] >= TRUTH_SNAPPED));
            assert_true(fine.classes[i] < TRUTH_SNAPPED || fine.classes[i] == coarse.classes[i]);
        }
        assert_true(masks_count(&coarse, TRUTH_DEPTH_LIMITED) > masks_count(&fine, TRUTH_DEPTH_LIMITED));
        masks_free(&fine);
        masks_free(&coarse);
        stage_free(&st);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_thinner_than_a_pixel_leaves_no_pixel_certain),
        cmocka_unit_test(a_ray_of_light_thinner_than_a_pixel_is_found),
        cmocka_unit_test(edges_in_a_greater_shadow_are_certain),
        cmocka_unit_test(what_two_depth_steps_turn_over_is_depth_limited),
        cmocka_unit_test(coincident_surfaces_of_two_states_are_not_certain),
        cmocka_unit_test(a_surface_does_not_shade_itself),
        cmocka_unit_test(nearly_edge_on_is_not_certain),
        cmocka_unit_test(certain_pixels_are_of_one_state_all_over),
        cmocka_unit_test(depth_bits_change_only_what_is_depth_limited),
    };

    return cmocka_run_group_tests_name("truth_classes", tests, NULL, NULL);
}
