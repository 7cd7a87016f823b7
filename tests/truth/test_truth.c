/* test_truth.c - masks whose areas can be computed by hand, and masks against rays traced without any hierarchy. */
#include "truth_stage.h"

#define HALF 2.03 /* of the image seen from above: no edge of a scene falls onto the border of a pixel */

enum { SIDE = 120 };

static const double pixel = (2.0 * HALF / SIDE) * (2.0 * HALF / SIDE);

static const double *world_scale(scene_instance *of, double x, double y, double z)
{
    of->world[0] = x;
    of->world[5] = y;
    of->world[10] = z;
    return of->world;
}

/* The lamp is twice as high as the square: the shadow's sides are twice as long; the square hides a quarter of it. */
static void a_square_under_a_lamp(void **unused)
{
    stage st = {0};
    masks m;

    (void)unused;
    stage_table(&st, SINGLE, 0, -9, 9, -9, 9);
    stage_table(&st, SINGLE, 1, -0.5, 0.5, -0.5, 0.5);
    stage_light(&st, SCENE_POINT, 0, 2, 0);
    stage_camera_above(&st, 5, HALF);
    m = stage_masks(&st, SIDE, SIDE, 24, 0);
    masks_check_area(&m, SHADOWED, 3.0, pixel, 380);
    masks_check_area(&m, UNSEEN, 0.0, pixel, 380);
    masks_free(&m);
    stage_free(&st);
}

static void a_square_in_the_sun(void **unused)
{
    stage st = {0};
    masks m;

    (void)unused;
    stage_table(&st, SINGLE, 0, -9, 9, -9, 9);
    stage_table(&st, SINGLE, 1.2, -0.5, 0.5, -0.5, 0.5);
    stage_light(&st, SCENE_DIRECTIONAL, 1, 1, 0);
    stage_camera_above(&st, 5, HALF);
    m = stage_masks(&st, SIDE, SIDE, 24, 0);
    masks_check_area(&m, SHADOWED, 1.0, pixel, 140); /* moved by its height, so none of it is hidden */
    assert_int_equal(m.lit[SIDE * SIDE / 2 + (size_t)(SIDE * (1 - 1.2 / HALF) / 2)], 0);
    assert_int_equal(m.lit[SIDE * SIDE / 2 + (size_t)(SIDE * (1 + 1.2 / HALF) / 2)], 255);
    masks_free(&m);
    stage_free(&st);
}

static void a_lamp_in_a_closed_box_lights_all_of_it_and_the_sun_outside_none(void **unused)
{
    stage st = {0};
    masks m;

    (void)unused;
    stage_cube(&st, DOUBLE, 3);
    stage_light(&st, SCENE_SPOT, 0.3, 1, -0.2);
    stage_light(&st, SCENE_DIRECTIONAL, 0.3, 1, -0.2);
    stage_light(&st, SCENE_POINT, 0, 4, 0);
    stage_camera(&st, 1.5);
    m = stage_masks(&st, SIDE, SIDE, 24, 0);
    masks_check_area(&m, LIT, SIDE * SIDE, 0, 0);
    masks_free(&m);
    for (size_t light = 1; light < 3; light++) {
        m = stage_masks(&st, SIDE, SIDE, 24, light);
        masks_check_area(&m, SHADOWED, SIDE * SIDE, 0, 20);
        for (size_t i = 0; i < SIDE * SIDE; i++)
            assert_int_equal(masks_state(&m, i), SHADOWED);
        masks_free(&m);
    }
    stage_free(&st);
}

/* A sheet is lit where viewer and light are on one side of it, and a face edge-on to the light is not. */
static void which_side_of_a_sheet_is_lit(void **unused)
{
    static const struct {
        int material;
        double light_y, camera_y;
        state expected;
    } cases[] = {
        {DOUBLE, 3, 5, LIT},      {DOUBLE, -3, 5, SHADOWED}, {DOUBLE, 3, -5, SHADOWED}, {DOUBLE, -3, -5, LIT},
        {DOUBLE, 0, 5, SHADOWED}, {SINGLE, 3, 5, LIT},       {SINGLE, -3, 5, SHADOWED}, {SINGLE, 3, -5, UNSEEN},
        {SINGLE, -3, -5, UNSEEN}, {BLENDED, 3, 5, UNSEEN},
    };

    (void)unused;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        stage st = {0};
        masks m;

        stage_table(&st, cases[i].material, 0, -9, 9, -9, 9);
        stage_light(&st, SCENE_POINT, 12, cases[i].light_y, 1);
        stage_camera_above(&st, cases[i].camera_y, HALF);
        if (cases[i].camera_y < 0) { /* look up */
            st.s.camera.world[6] = 1;
            st.s.camera.world[9] = -1;
        }
        m = stage_masks(&st, 16, 16, 24, 0);
        for (size_t n = 0; n < 256; n++)
            if (masks_state(&m, n) != cases[i].expected)
                fail_msg("case %lu: %d", (unsigned long)i, (int)masks_state(&m, n));
        masks_free(&m);
        stage_free(&st);
    }
}

static void a_mirrored_instance_is_seen_from_its_front(void **unused)
{
    stage st = {0};
    masks m;

    (void)unused;
    stage_table(&st, SINGLE, 0, -9, 9, -9, 9);
    world_scale(stage_table(&st, SINGLE, 1, -1.5, -0.5, -0.5, 0.5), -1, 1, 1);  /* its front stays above */
    world_scale(stage_table(&st, SINGLE, -1, -1.5, -0.5, -0.5, 0.5), 1, -1, 1); /* its front is turned down: unseen */
    stage_light(&st, SCENE_POINT, 0, 2, 0);
    stage_camera_above(&st, 5, HALF);
    m = stage_masks(&st, SIDE, SIDE, 24, 0);
    /* shadows from 1 to 3 to either side, of which the image shows 1 to HALF; the square on the right hides part of its
     * own, and the one on the left, not seen, hides none */
    masks_check_area(&m, SHADOWED, 2 * 2 * (HALF - 1) - 0.5, pixel, 500);
    assert_int_equal(masks_state(&m, SIDE * SIDE / 2 + (size_t)(SIDE * (1 + 1.3 / HALF) / 2)), LIT);
    assert_int_equal(masks_state(&m, SIDE * SIDE / 2 + (size_t)(SIDE * (1 - 1.3 / HALF) / 2)), SHADOWED);
    masks_free(&m);
    stage_free(&st);
}

static void what_casts_and_what_receives(void **unused)
{
    stage st = {0};
    scene_instance *floor, *square;
    masks m;

    (void)unused;
    floor = stage_table(&st, SINGLE, 0, -9, 9, -9, 9);
    square = stage_table(&st, SINGLE, 1.2, -0.5, 0.5, -0.5, 0.5);
    stage_table(&st, BLENDED, 1.5, -9, 9, -9, 9); /* casts nothing, and is not seen */
    stage_light(&st, SCENE_DIRECTIONAL, 1, 1, 0);
    stage_light(&st, SCENE_DIRECTIONAL, 1, -1, 0);
    stage_camera_above(&st, 5, HALF);
    square->casts = 0;
    m = stage_masks(&st, SIDE, SIDE, 24, 0);
    masks_check_area(&m, LIT, SIDE * SIDE, 0, 0);
    masks_free(&m);
    square->casts = 1;
    floor->receives = 0;
    m = stage_masks(&st, SIDE, SIDE, 24, 0);
    masks_check_area(&m, LIT, SIDE * SIDE, 0, 0);
    masks_free(&m);
    m = stage_masks(&st, SIDE, SIDE, 24, 1); /* from below: lit by facing alone, it is not lit here */
    masks_check_area(&m, SHADOWED, SIDE * SIDE, 0, 0);
    masks_free(&m);
    stage_free(&st);
}

/* A ramp that sinks from depth 1 at the image's left border to 3 at the right one. */
static void near_and_far_planes_cut_but_what_they_cut_casts(void **unused)
{
    static const float ramp[12] = {-2.03f, 4, -9, -2.03f, 4, 9, 2.03f, 2, 9, 2.03f, 2, -9};
    static const uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
    stage st = {0};
    masks m;

    (void)unused;
    stage_mesh(&st, SINGLE, 4, ramp, 2, indices);
    stage_light(&st, SCENE_DIRECTIONAL, 0, 1, 0);
    stage_camera_above(&st, 5, HALF);
    st.s.camera.znear = 1.25;
    st.s.camera.zfar = 2.5;
    m = stage_masks(&st, SIDE, SIDE, 24, 0);
    masks_check_area(&m, LIT, SIDE * SIDE * (0.75 - 0.125), 0, 2 * SIDE);
    masks_check_area(&m, UNSEEN, SIDE * SIDE * (0.25 + 0.125), 0, 2 * SIDE);
    masks_free(&m);
    st.s.camera.znear = 1.251;
    st.s.camera.zfar = 2.5005;
    m = stage_masks(&st, SIDE, SIDE, 8, 0); /* 2 steps are 0.0098; a pixel is 2 / 120 of depth */
    for (int y = 0; y < SIDE; y++) {
        static const struct {
            int x;
            truth_class expected;
        } columns[] = {
            {13, TRUTH_CERTAIN},       /* depth 1.225 */
            {14, TRUTH_DEPTH_LIMITED}, /* 1.242 */
            {15, TRUTH_BOUNDARY},      /* its left border, 1.25, is not seen */
            {16, TRUTH_CERTAIN},       {88, TRUTH_CERTAIN}, {89, TRUTH_DEPTH_LIMITED}, /* 2.492 */
            {90, TRUTH_BOUNDARY}, /* its left border, 2.5, is seen */
            {91, TRUTH_CERTAIN},
        };

        for (size_t i = 0; i < sizeof columns / sizeof columns[0]; i++)
            if (m.classes[y * SIDE + columns[i].x] != columns[i].expected)
                fail_msg("column %d: class %d", columns[i].x, m.classes[y * SIDE + columns[i].x]);
    }
    masks_free(&m);
    stage_table(&st, SINGLE, 0, -9, 9, -9, 9); /* beyond what the ramp hides, and wholly in its shadow */
    st.s.camera.zfar = 6;
    st.s.camera.znear = 2;
    m = stage_masks(&st, SIDE, SIDE, 24, 0);
    masks_check_area(&m, SHADOWED, SIDE * SIDE / 2, 0, 2 * SIDE + 8);
    masks_free(&m);
    stage_free(&st);
}

/* Alpha rises from 0 on the left to 1 on the right: half of the square is seen, and all of it casts. */
static void a_cut_material_casts_by_its_full_triangles(void **unused)
{
    stage st = {0};
    masks m;

    (void)unused;
    stage_table(&st, SINGLE, 0, -9, 9, -9, 9);
    stage_table(&st, CUT_AT_HALF, 1, -0.5, 0.5, -0.5, 0.5);
    st.meshes[1].colors[3] = st.meshes[1].colors[7] = 0.0f;
    stage_light(&st, SCENE_POINT, 0, 2, 0);
    stage_camera_above(&st, 5, HALF);
    m = stage_masks(&st, SIDE, SIDE, 24, 0);
    masks_check_area(&m, SHADOWED, 3.5, pixel, 380);
    masks_free(&m);
    stage_free(&st);
}

static void slivers_without_area_are_neither_seen_nor_casting(void **unused)
{
    static const float line[9] = {-1, 1, -1, 0.1f, 1, 0.1f, 1, 1, 1};
    static const uint32_t indices[6] = {0, 1, 2, 0, 0, 2};
    stage st = {0};
    masks m;

    (void)unused;
    stage_table(&st, SINGLE, 0, -9, 9, -9, 9);
    stage_mesh(&st, DOUBLE, 3, line, 2, indices);
    stage_light(&st, SCENE_DIRECTIONAL, 1, 2, 0.3);
    stage_camera_above(&st, 5, HALF);
    m = stage_masks(&st, SIDE, SIDE, 24, 0);
    masks_check_area(&m, LIT, SIDE * SIDE, 0, 0);
    masks_free(&m);
    stage_free(&st);
}

/* ------------------------------------------------------------------ rays without a hierarchy */

enum { SOUP = 60 };

static double triple(const double a[3], const double b[3], const double c[3])
{
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/* t where the line meets the triangle, by Cramer's rule; negative if it does not. */
static double plain_hit(const float *p, const uint32_t *corner, const double from[3], const double along[3])
{
    double e[2][3], o[3], minus[3], det, t, u, v;

    for (int k = 0; k < 3; k++) {
        e[0][k] = (double)p[3 * corner[1] + (uint32_t)k] - (double)p[3 * corner[0] + (uint32_t)k];
        e[1][k] = (double)p[3 * corner[2] + (uint32_t)k] - (double)p[3 * corner[0] + (uint32_t)k];
        o[k] = from[k] - (double)p[3 * corner[0] + (uint32_t)k];
        minus[k] = -along[k];
    }
    det = triple(e[0], e[1], minus);
    t = triple(e[0], e[1], o) / det;
    u = triple(o, e[1], minus) / det;
    v = triple(e[0], o, minus) / det;
    return u >= 0 && v >= 0 && u + v <= 1 && t > 0 ? t : -1;
}

static state plain_state(const stage *st, const double along[3])
{
    static const double eye[3] = {0, 0, 0};
    const scene_mesh *mesh = &st->meshes[0];
    const uint32_t *seen = NULL;
    double nearest = HUGE_VAL, at[3], to[3], e[2][3], side;

    for (uint32_t i = 0; i < mesh->triangle_count; i++) {
        const double t = plain_hit(mesh->positions, &mesh->indices[3 * i], eye, along);

        if (t >= st->s.camera.znear && t < nearest) {
            nearest = t;
            seen = &mesh->indices[3 * i];
        }
    }
    if (!seen)
        return UNSEEN;
    for (uint32_t k = 0; k < 3; k++) {
        at[k] = nearest * along[k];
        to[k] = st->lights[0].position[k] - at[k];
        e[0][k] = (double)mesh->positions[3 * seen[1] + k] - (double)mesh->positions[3 * seen[0] + k];
        e[1][k] = (double)mesh->positions[3 * seen[2] + k] - (double)mesh->positions[3 * seen[0] + k];
    }
    side = triple(e[0], e[1], to) * triple(e[0], e[1], along);
    if (side >= 0)
        return SHADOWED;
    for (uint32_t i = 0; i < mesh->triangle_count; i++)
        if (&mesh->indices[3 * i] != seen) {
            const double t = plain_hit(mesh->positions, &mesh->indices[3 * i], at, to);

            if (t > 1e-9 && t < 1 - 1e-9)
                return SHADOWED;
        }
    return LIT;
}

/* Triangles all about, the lamp among them. Pixels that are not on a boundary leave no doubt whatever the method. */
static void soups_agree_with_plain_rays(void **unused)
{
    size_t compared = 0;

    (void)unused;
    for (uint32_t run = 1; run <= 30; run++) {
        uint32_t seed = run, indices[3 * SOUP];
        double lamp[3];
        float p[9 * SOUP];
        stage st = {0};
        masks m;

        for (uint32_t i = 0; i < 9 * SOUP; i++) { /* in every third run small ones */
            const double least = i % 3 == 2 ? -8 : -3, most = i % 3 == 2 ? 1 : 3;

            p[i] = (float)stage_random(&seed, least, most);
            if (run % 3 == 0 && i % 9 >= 3)
                p[i] = p[i / 9 * 9 + i % 3] + 0.2f * p[i];
        }
        for (uint32_t i = 0; i < 3 * SOUP; i++)
            indices[i] = i;
        stage_mesh(&st, DOUBLE, 3 * SOUP, p, run % 2 ? SOUP : 7, indices);
        for (int k = 0; k < 3; k++)
            lamp[k] = k < 2 ? stage_random(&seed, -2, 2) : stage_random(&seed, -4, 0);
        stage_light(&st, SCENE_POINT, lamp[0], lamp[1], lamp[2]);
        stage_camera(&st, 1.1);
        m = stage_masks(&st, 48, 36, 24, 0);
        for (uint32_t i = 0; i < 48 * 36; i++) {
            const double h = tan(0.55), along[3] = {((i % 48) / 24.0 + 1 / 48.0 - 1) * h * 48 / 36,
                                                    (1 - (i / 48) / 18.0 - 1 / 36.0) * h, -1};

            if (m.classes[i] == TRUTH_BOUNDARY)
                continue;
            compared++;
            if (masks_state(&m, i) != plain_state(&st, along))
                fail_msg("seed %u, pixel %u: %d", run, i, (int)masks_state(&m, i));
        }
        masks_free(&m);
        stage_free(&st);
    }
    assert_true(compared > 30 * 48 * 36 / 2);
}

/* Far from the origin the same scene gives the same mask: the eye is subtracted before anything is lost. */
static void far_from_the_origin(void **unused)
{
    static const double far_away[3] = {6.5e6, 32.0, -1.25e7};
    masks m[2];

    (void)unused;
    for (int i = 0; i < 2; i++) {
        stage st = {0};

        stage_table(&st, SINGLE, 0, -9, 9, -9, 9);
        stage_cube(&st, SINGLE, 0.5)->world[13] = 0.7;
        stage_light(&st, SCENE_POINT, 1, 2, 0.5);
        stage_camera_above(&st, 5, HALF);
        for (int k = 0; k < 3 && i == 1; k++) {
            st.instances[0].world[12 + k] += far_away[k];
            st.instances[1].world[12 + k] += far_away[k];
            st.lights[0].position[k] += far_away[k];
            st.s.camera.world[12 + k] += far_away[k];
        }
        m[i] = stage_masks(&st, SIDE, SIDE, 24, 0);
        stage_free(&st);
    }
    assert_memory_equal(m[0].lit, m[1].lit, SIDE * SIDE);
    assert_memory_equal(m[0].visible, m[1].visible, SIDE * SIDE);
    assert_true(masks_count(&m[0], TRUTH_CERTAIN) > SIDE * SIDE * 8 / 10);
    masks_free(&m[0]);
    masks_free(&m[1]);
}

static void what_cannot_be_traced_is_refused_with_a_message(void **unused)
{
    static const truth_options bad[] = {
        {0, 8, 24, {0, 0}},
        {8, 0, 24, {0, 0}},
        {8, 40000, 24, {0, 0}},
        {8, 8, 0, {0, 0}},
    };
    const truth_options good = {8, 8, 24, {0, 0}};
    char message[SCENE_MESSAGE];
    uint8_t out[3][64];
    stage st = {0};
    truth *t;

    (void)unused;
    strcpy(message, "");
    assert_null(truth_create(&st.s, &good, message)); /* no camera */
    assert_string_not_equal(message, "");
    stage_camera(&st, 1);
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        strcpy(message, "");
        assert_null(truth_create(&st.s, &bad[i], message));
        assert_string_not_equal(message, "");
    }
    stage_light(&st, SCENE_POINT, 0, 0, 0);
    t = truth_create(&st.s, &good, message); /* nothing to be seen is no mistake */
    assert_non_null(t);
    assert_int_equal(truth_light(t, 0, out[0], out[1], out[2], message), 1);
    for (int i = 0; i < 64; i++)
        assert_int_equal(out[0][i] + out[1][i] + out[2][i], TRUTH_CERTAIN);
    strcpy(message, "");
    assert_int_equal(truth_light(t, 1, out[0], out[1], out[2], message), 0);
    assert_string_not_equal(message, "");
    truth_free(t);
    truth_free(NULL);
    stage_free(&st);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_square_under_a_lamp),
        cmocka_unit_test(a_square_in_the_sun),
        cmocka_unit_test(a_lamp_in_a_closed_box_lights_all_of_it_and_the_sun_outside_none),
        cmocka_unit_test(which_side_of_a_sheet_is_lit),
        cmocka_unit_test(a_mirrored_instance_is_seen_from_its_front),
        cmocka_unit_test(what_casts_and_what_receives),
        cmocka_unit_test(near_and_far_planes_cut_but_what_they_cut_casts),
        cmocka_unit_test(a_cut_material_casts_by_its_full_triangles),
        cmocka_unit_test(slivers_without_area_are_neither_seen_nor_casting),
        cmocka_unit_test(soups_agree_with_plain_rays),
        cmocka_unit_test(far_from_the_origin),
        cmocka_unit_test(what_cannot_be_traced_is_refused_with_a_message),
    };

    return cmocka_run_group_tests_name("truth", tests, NULL, NULL);
}
