/* test_metrics.c - measures of masks and of pictures: on masks made by hand whose answers are known, and PSNR and SSIM
 * against scikit-image, where python3 has it. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "gn_test.h"
#include "image_metrics.h"
#include "mask_metrics.h"

enum { WIDTH = 40, HEIGHT = 30, PIXELS = WIDTH * HEIGHT };

static uint8_t all_seen[PIXELS];

/* Shadow in a rectangle, lit elsewhere. */
static void put_shadow(uint8_t lit[PIXELS], int x, int y, int width, int height)
{
    memset(lit, 255, PIXELS);
    for (int j = y; j < y + height; j++)
        memset(lit + WIDTH * j + x, 0, (size_t)width);
}

static mask_metrics measure(const uint8_t *lit, const uint8_t *truth)
{
    const mask_pair pair = {WIDTH, HEIGHT, lit, truth, all_seen, NULL};
    mask_metrics m;

    assert_true(mask_measure(&pair, &m));
    return m;
}

static void near(double a, double b)
{
    if (!(fabs(a - b) <= 1e-9))
        fail_msg("%.12g is not %.12g", a, b);
}

static void distances_are_euclidean(void **state)
{
    static uint8_t marked[PIXELS];
    static float squared[PIXELS];
    uint32_t rng = 7u;

    (void)state;
    memset(marked, 0, sizeof marked);
    assert_true(distance_transform(marked, WIDTH, HEIGHT, squared));
    assert_true(squared[0] > 1e9f);
    for (int i = 0; i < 9; i++)
        marked[test_random(&rng) % PIXELS] = 1;
    assert_true(distance_transform(marked, WIDTH, HEIGHT, squared));
    for (int i = 0; i < PIXELS; i++) {
        int least = 1 << 20;

        for (int k = 0; k < PIXELS; k++) {
            const int dx = k % WIDTH - i % WIDTH, dy = k / WIDTH - i / WIDTH;

            if (marked[k] && dx * dx + dy * dy < least)
                least = dx * dx + dy * dy;
        }
        assert_int_equal((int)squared[i], least);
    }
}

static void the_truth_itself_is_right(void **state)
{
    static uint8_t truth[PIXELS];
    mask_metrics m;

    (void)state;
    put_shadow(truth, 10, 8, 12, 9);
    m = measure(truth, truth);
    assert_int_equal(m.visible, PIXELS);
    assert_int_equal(m.wrong, 0);
    near(m.iou, 1);
    near(m.precision, 1);
    near(m.recall, 1);
    near(m.boundary_f[0], 1);
    near(m.distance95, 0);
    put_shadow(truth, 0, 0, 0, 0); /* no shadow at all */
    m = measure(truth, truth);
    near(m.iou, 1);
    near(m.boundary_f[1], 1);
}

/* A shadow moved by a pixel: two columns of its height are wrong, both on the boundary. */
static void a_shift_by_a_pixel(void **state)
{
    static uint8_t lit[PIXELS], truth[PIXELS];
    mask_metrics m;

    (void)state;
    put_shadow(truth, 10, 8, 12, 9);
    put_shadow(lit, 11, 8, 12, 9);
    m = measure(lit, truth);
    assert_int_equal(m.wrong, 18);
    assert_int_equal(m.interior, 0);
    assert_int_equal(m.boundary, 18);
    near(m.iou, 99.0 / 117.0);
    near(m.precision, 99.0 / 108.0);
    near(m.recall, 99.0 / 108.0);
    near(m.boundary_f[0], 1);
    near(m.distance95, 1);
    put_shadow(lit, 12, 8, 12, 9);
    m = measure(lit, truth);
    near(m.boundary_f[1], 1);
    assert_true(m.boundary_f[0] < 0.9);
    near(m.distance95, 2);
}

/* A hole of 3 x 3 in the middle of a large shadow, twelve pixels from its boundary: a leak. */
static void a_leak_is_interior(void **state)
{
    static uint8_t lit[PIXELS], truth[PIXELS], crossed[PIXELS];
    const mask_pair pair = {WIDTH, HEIGHT, lit, truth, all_seen, crossed};
    mask_metrics m;

    (void)state;
    put_shadow(truth, 5, 2, 30, 26);
    memcpy(lit, truth, PIXELS);
    for (int y = 14; y < 17; y++)
        memset(lit + WIDTH * y + 19, 255, 3);
    m = measure(lit, truth);
    assert_int_equal(m.wrong, 9);
    assert_int_equal(m.interior, 9);
    near(m.precision, 1);
    near(m.recall, 771.0 / 780.0);
    assert_true(m.boundary_f[1] < 1.0 && m.boundary_f[1] > 0.9);
    memset(crossed, 0, PIXELS);
    crossed[WIDTH * 15 + 18] = 1; /* beside it an edge that no pixel's middle shows */
    assert_true(mask_measure(&pair, &m));
    assert_int_equal(m.interior, 5); /* within two of it are the first column, and the middle of the second */
}

/* A shadow that is missed: nothing in common; boundaries as far apart as can be. */
static void a_shadow_is_missed(void **state)
{
    static uint8_t lit[PIXELS], truth[PIXELS];
    mask_metrics m;

    (void)state;
    put_shadow(truth, 10, 8, 12, 9);
    put_shadow(lit, 0, 0, 0, 0);
    m = measure(lit, truth);
    assert_int_equal(m.wrong, 108);
    near(m.iou, 0);
    near(m.precision, 1);
    near(m.recall, 0);
    near(m.boundary_f[1], 0);
    near(m.distance95, hypot(WIDTH, HEIGHT));
    m = measure(truth, lit); /* and one that is not there */
    near(m.precision, 0);
    near(m.recall, 1);
}

/* Where nothing is seen nothing is wrong, and no boundary runs. */
static void the_background_does_not_count(void **state)
{
    static uint8_t lit[PIXELS], truth[PIXELS], seen[PIXELS];
    const mask_pair pair = {WIDTH, HEIGHT, lit, truth, seen, NULL};
    mask_metrics m;

    (void)state;
    put_shadow(truth, 0, 0, 20, HEIGHT);
    put_shadow(lit, 0, 0, 20, HEIGHT);
    memset(lit + 20, 0, 10); /* ten pixels wrong, of which five are seen */
    memset(seen, 255, PIXELS);
    memset(seen + 25, 0, 15);
    assert_true(mask_measure(&pair, &m));
    assert_int_equal(m.visible, PIXELS - 15);
    assert_int_equal(m.wrong, 5);
    assert_int_equal(m.interior, 2); /* columns 20 to 24; the truth's boundary is columns 19 and 20 */
}

static void flicker_is_of_errors(void **state)
{
    static uint8_t lit[2][PIXELS], truth[2][PIXELS];
    const mask_pair before = {WIDTH, HEIGHT, lit[0], truth[0], all_seen, NULL};
    const mask_pair after = {WIDTH, HEIGHT, lit[1], truth[1], all_seen, NULL};

    (void)state;
    put_shadow(truth[0], 10, 8, 12, 9);
    put_shadow(truth[1], 14, 8, 12, 9);
    memcpy(lit, truth, sizeof lit);
    assert_int_equal(mask_flicker(&before, &after), 0); /* as much as the truth moves */
    lit[0][0] = lit[1][0] = 0;                          /* wrong in both */
    assert_int_equal(mask_flicker(&before, &after), 0);
    lit[1][1] = 0; /* comes */
    lit[0][2] = 0; /* goes */
    assert_int_equal(mask_flicker(&before, &after), 2);
}

enum { SIDE = 64, BYTES = 3 * SIDE * SIDE };

/* Some picture with shapes, and another way of it: with noise, blurred, or darker. */
static void put_pictures(uint8_t a[BYTES], uint8_t b[BYTES], int way)
{
    uint32_t rng = 99u + (uint32_t)way;

    for (int i = 0; i < BYTES; i++) {
        const int x = i / 3 % SIDE, y = i / 3 / SIDE, c = i % 3;
        const int in = (x - 30) * (x - 30) + (y - 25) * (y - 25) < 300;
        const int value = in ? 200 - 20 * c : 40 + x + 2 * c + (y > 40 ? 30 : 0);

        a[i] = (uint8_t)value;
        b[i] = (uint8_t)(way == 0      ? value + (int)(test_random(&rng) % 21u) - 10
                         : way == 1    ? value / 2
                         : (x + y) % 9 ? value
                                       : 255 - value);
    }
}

static void equal_pictures_are_equal(void **state)
{
    static uint8_t a[BYTES], b[BYTES];

    (void)state;
    put_pictures(a, b, 0);
    assert_true(isinf(image_psnr(a, a, SIDE, SIDE)));
    near(image_ssim(a, a, SIDE, SIDE), 1);
    near(image_flip(a, a, SIDE, SIDE), 0);
    assert_true(image_ssim(a, b, 8, 8) < 0.0);
}

/* FLIP: the same either way round, more where more differs, between 0 and 1; black against white close to 1. */
static void flip_is_a_distance(void **state)
{
    static uint8_t a[BYTES], b[BYTES], black[BYTES], white[BYTES], some[BYTES];
    double last = 0.0;

    (void)state;
    put_pictures(a, b, 0);
    near(image_flip(a, b, SIDE, SIDE), image_flip(b, a, SIDE, SIDE));
    memset(white, 255, sizeof white);
    assert_true(image_flip(black, white, SIDE, SIDE) > 0.9 && image_flip(black, white, SIDE, SIDE) <= 1.0);
    for (int step = 4; step <= 64; step *= 2) {
        double flip;

        for (int i = 0; i < BYTES; i++)
            some[i] = (uint8_t)(a[i] + (i / 3 % SIDE < 20 ? step : 0));
        flip = image_flip(a, some, SIDE, SIDE);
        assert_true(flip > last && flip < 1.0);
        last = flip;
    }
}

/* The answers of scikit-image, from a file of both pictures' bytes. */
static int ask_python(const uint8_t *a, const uint8_t *b, double answers[2])
{
    static const char script[] =
        "import sys, numpy as n\n"
        "from skimage.metrics import structural_similarity as s, peak_signal_noise_ratio as p\n"
        "d = n.frombuffer(open(sys.argv[1], 'rb').read(), n.uint8).reshape(2, int(sys.argv[2]), int(sys.argv[2]), 3)\n"
        "print(p(d[0], d[1], data_range=255), s(d[0], d[1], data_range=255, channel_axis=2, gaussian_weights=True,\n"
        "      sigma=1.5, use_sample_covariance=False))\n";
    const char *python = access("/usr/bin/python3", X_OK) == 0 ? "/usr/bin/python3" : "python3";
    char command[256];
    FILE *f = fopen("build/pictures.raw", "wb");
    int read;

    assert_non_null(f);
    assert_true(fwrite(a, 1, BYTES, f) == BYTES && fwrite(b, 1, BYTES, f) == BYTES);
    fclose(f);
    f = fopen("build/ask.py", "w");
    assert_non_null(f);
    fputs(script, f);
    fclose(f);
    snprintf(command, sizeof command, "%s build/ask.py build/pictures.raw %d 2>/dev/null", python, SIDE);
    f = popen(command, "r");
    assert_non_null(f);
    read = fscanf(f, "%lf %lf", &answers[0], &answers[1]);
    pclose(f);
    return read == 2;
}

static void scikit_image_says_the_same(void **state)
{
    static uint8_t a[BYTES], b[BYTES];

    (void)state;
    for (int way = 0; way < 3; way++) {
        double answers[2];

        put_pictures(a, b, way);
        if (!ask_python(a, b, answers)) {
            print_message("           python3 has no skimage\n");
            skip();
        }
        if (!(fabs(image_psnr(a, b, SIDE, SIDE) - answers[0]) < 1e-3) ||
            !(fabs(image_ssim(a, b, SIDE, SIDE) - answers[1]) < 1e-3))
            fail_msg("way %d: PSNR %g, %g; SSIM %g, %g", way, image_psnr(a, b, SIDE, SIDE), answers[0],
                     image_ssim(a, b, SIDE, SIDE), answers[1]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(distances_are_euclidean), cmocka_unit_test(the_truth_itself_is_right),
        cmocka_unit_test(a_shift_by_a_pixel),      cmocka_unit_test(a_leak_is_interior),
        cmocka_unit_test(a_shadow_is_missed),      cmocka_unit_test(the_background_does_not_count),
        cmocka_unit_test(flicker_is_of_errors),    cmocka_unit_test(equal_pictures_are_equal),
        cmocka_unit_test(flip_is_a_distance),      cmocka_unit_test(scikit_image_says_the_same)};

    memset(all_seen, 255, sizeof all_seen);
    return cmocka_run_group_tests_name("metrics", tests, NULL, NULL);
}
