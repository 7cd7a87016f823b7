/* test_truth_examples.c - our truth against another's: masks of the example scenes that an independent ray tracer made.
 *
 * test_truth_examples [FOLDER]: SCENE.gltf, SCENE/lightN.png (grey: lit, alpha: visible), SCENE/ambN.png (0: certain).
 * The default is tests/examples. Prints both classes' counts. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <png.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "truth.h"

enum { WIDTH = 320, HEIGHT = 240, DEPTH_BITS = 24, PIXELS = WIDTH * HEIGHT };

static const char *folder = "tests/examples";

static void read_png(uint8_t *pixels, const char *scene_name, const char *kind, size_t light, png_uint_32 format)
{
    char path[1024];
    png_image image;

    snprintf(path, sizeof path, "%s/%s/%s%lu.png", folder, scene_name, kind, (unsigned long)light);
    memset(&image, 0, sizeof image);
    image.version = PNG_IMAGE_VERSION;
    if (!png_image_begin_read_from_file(&image, path))
        fail_msg("%s: %s", path, image.message);
    image.format = format;
    if (image.width != WIDTH || image.height != HEIGHT)
        fail_msg("%s: %ux%u", path, image.width, image.height);
    if (!png_image_finish_read(&image, NULL, pixels, 0, NULL))
        fail_msg("%s: %s", path, image.message);
}

static void compare(const char *scene_name, size_t lights)
{
    static uint8_t lit[PIXELS], visible[PIXELS], classes[PIXELS], theirs[2 * PIXELS], sure[PIXELS];
    const truth_options options = {WIDTH, HEIGHT, DEPTH_BITS, {0.0, 0.0}};
    char path[1024], message[SCENE_MESSAGE];
    scene s;
    truth *t;

    snprintf(path, sizeof path, "%s/%s.gltf", folder, scene_name);
    if (!scene_load(&s, path, NULL, message))
        fail_msg("%s", message);
    assert_int_equal(s.light_count, lights);
    t = truth_create(&s, &options, message);
    if (!t)
        fail_msg("%s", message);
    for (size_t light = 0; light < lights; light++) {
        unsigned long ours[4] = {0}, certain = 0, only_ours = 0, differ = 0;

        if (!truth_light(t, light, lit, visible, classes, message))
            fail_msg("%s", message);
        read_png(theirs, scene_name, "light", light, PNG_FORMAT_GA);
        read_png(sure, scene_name, "amb", light, PNG_FORMAT_GRAY);
        for (int i = 0; i < PIXELS; i++) {
            const int same = lit[i] == theirs[2 * i] && visible[i] == theirs[2 * i + 1];

            if (sure[i] == 0 && !same)
                fail_msg("%s light %lu, pixel %d, %d: %d %d, not %d %d", scene_name, (unsigned long)light, i % WIDTH,
                         i / WIDTH, lit[i], visible[i], theirs[2 * i], theirs[2 * i + 1]);
            ours[classes[i]]++;
            certain += sure[i] == 0;
            only_ours += sure[i] != 0 && classes[i] == TRUTH_CERTAIN;
            differ += !same;
        }
        printf("%s light %lu: certain %lu, depth-limited %lu, snapped %lu, boundary %lu; theirs certain %lu; "
               "certain here alone %lu; different %lu\n",
               scene_name, (unsigned long)light, ours[TRUTH_CERTAIN], ours[TRUTH_DEPTH_LIMITED], ours[TRUTH_SNAPPED],
               ours[TRUTH_BOUNDARY], certain, only_ours, differ);
        /* the two have nothing in common but their definition: a few pixels' classes are a matter of judgement */
        assert_true(only_ours <= PIXELS / 1000);
        assert_true(ours[TRUTH_CERTAIN] + PIXELS / 1000 >= certain);
    }
    truth_free(t);
    scene_free(&s);
}

static void a_box_on_a_floor(void **unused)
{
    (void)unused;
    compare("first", 1);
}

static void a_room_with_a_lamp_in_it_and_the_sun_outside(void **unused)
{
    (void)unused;
    compare("room", 2);
}

static void a_sheet_seen_by_an_orthographic_camera(void **unused)
{
    (void)unused;
    compare("sheet", 2);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_box_on_a_floor),
        cmocka_unit_test(a_room_with_a_lamp_in_it_and_the_sun_outside),
        cmocka_unit_test(a_sheet_seen_by_an_orthographic_camera),
    };

    if (argc > 1)
        folder = argv[1];
    return cmocka_run_group_tests_name("truth_examples", tests, NULL, NULL);
}
