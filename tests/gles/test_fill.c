/* test_fill.c - ends, scissors and patches against z-fail throughout: from random places in and around every scene the
 * masks differ in single pixels at most, and these lie on a border of the shadow or of a surface; fragments are never
 * more, and each measure comes up. Where the plan warns of coarse depth more may differ, on borders too. */
#include "device.h"
#include "gn_test.h"
#include "stage.h"
#include "views.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 96, HEIGHT = 72, VIEWS = 12, PIXELS = WIDTH * HEIGHT };

/* Whether a pixel or one beside it looks otherwise: lit, shadowed, or no surface. */
static int is_border(const uint8_t *rgba, int pixel)
{
    const int x = pixel % WIDTH, y = pixel / WIDTH;

    for (int j = y > 0 ? y - 1 : 0; j <= y + 1 && j < HEIGHT; j++)
        for (int i = x > 0 ? x - 1 : 0; i <= x + 1 && i < WIDTH; i++)
            if (memcmp(rgba + 4 * (j * WIDTH + i), rgba + 4 * pixel, 2) != 0)
                return 1;
    return 0;
}

static void only_borders_move(void **state)
{
    static uint8_t rgba[2][4 * PIXELS];
    uint64_t fragments[2] = {0, 0}, differ = 0, doubtful = 0, views = 0, ended = 0, patched = 0, cut = 0;
    uint32_t rng = 77u;
    FILE *list = fopen("build/scenes/scenes.txt", "r");
    char line[256], name[64];

    (void)state;
    setenv("GALLIUM_DRIVER", "llvmpipe", 1);
    assert_non_null(list);
    while (fgets(line, sizeof line, list)) {
        const stage_options options = {.platform = test_platform(),
                                       .width = WIDTH,
                                       .height = HEIGHT,
                                       .exposure = 1.0,
                                       .depth_bits = 24,
                                       .stencil_bits = 8};
        char path[128], message[SCENE_MESSAGE] = "";
        scene loaded;
        stage *s;

        assert_int_equal(sscanf(line, "%63s", name), 1);
        snprintf(path, sizeof path, "build/scenes/%s.gltf", name);
        if (!scene_load(&loaded, path, NULL, message) || stage_open(&s, &loaded, &options, message) != 0)
            fail_msg("%s: %s", path, message);
        for (int view = 0; view < VIEWS; view++, views++) {
            const uint32_t light = test_random(&rng) % (uint32_t)loaded.light_count;
            uint64_t rasterised[2], passed;

            stage_pose(s, 0, 0);
            if (view % 2)
                test_view_from_above(&loaded, &rng);
            else
                test_random_view(&loaded, &rng);
            for (int m = 0; m < 2; m++) {
                const stage_wish wish = {.method = m ? GN_METHOD_STENCIL : GN_METHOD_ZFAIL,
                                         .casting = 1,
                                         .first_light = light,
                                         .light_count = 1,
                                         .unbounded = 1};

                assert_int_equal(stage_plan(s, &wish, message), 0);
                assert_true(stage_draw_mask(s, light, message) && platform_read_back(s->platform, rgba[m]));
                assert_true(stage_count_fragments(s, &rasterised[m], &passed));
                fragments[m] += rasterised[m];
            }
            for (int i = 0; i < PIXELS; i++) {
                if (memcmp(rgba[0] + 4 * i, rgba[1] + 4 * i, 2) == 0)
                    continue;
                *(s->plan->warnings & 1u << GN_WARN_DEPTH ? &doubtful : &differ) += 1;
                if (!is_border(rgba[0], i) && !is_border(rgba[1], i))
                    fail_msg("%s, view %d, light %u: pixel %d, %d differs", path, view, (unsigned)light, i % WIDTH,
                             i / WIDTH);
            }
            for (uint32_t r = 0; r < s->plan->record_count; r++) {
                const gn_record *record = &s->plan->records[r];

                ended += record->far_end == GN_FAR_ENDED && !record->patch;
                patched += record->patch != 0;
                cut += record->scissor[2] * record->scissor[3] < PIXELS;
            }
        }
        stage_close(s);
        scene_free(&loaded);
    }
    fclose(list);
    print_message("           %lu views, %lu pixels differ, %lu where depth is too coarse; %lu volumes end, %lu are "
                  "cut, %lu projections; %.3f of the "
                  "fragments\n",
                  (unsigned long)views, (unsigned long)differ, (unsigned long)doubtful, (unsigned long)ended,
                  (unsigned long)cut, (unsigned long)patched, (double)fragments[1] / (double)fragments[0]);
    assert_true(views > 400 && ended > 400 && patched > 40 && cut > 100);
    assert_true(differ < views / 50 && doubtful < views / 10);
    assert_true(fragments[1] < fragments[0] / 4 * 3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(only_borders_move)};

    return cmocka_run_group_tests_name("fill", tests, NULL, NULL);
}
