/* difference.c - see difference.h. */
#include "difference.h"

#include <stdlib.h>
#include <string.h>

#include "command.h"
#include "picture.h"
#include "true_mask.h"

static void compare(difference *d, const uint8_t *drawn, const true_mask *true_one)
{
    static const uint8_t red[4] = {255, 40, 30, 255}, yellow[4] = {255, 220, 0, 255};

    for (size_t i = 0; i < (size_t)d->width * d->height; i++) {
        const int is_certain = true_one->visible[i] && true_one->classes[i] == TRUTH_CERTAIN;
        const int is_wrong = true_one->visible[i] && (drawn[i] != 0) != (true_one->lit[i] != 0);

        d->certain += (size_t)is_certain;
        d->wrong += (size_t)is_wrong;
        d->wrong_certain += (size_t)(is_wrong && is_certain);
        if (is_wrong)
            memcpy(d->marks + 4 * i, is_certain ? red : yellow, 4);
    }
}

static int draw(stage *s, const stage_wish *way, uint32_t light, uint8_t *lit, uint8_t *visible,
                char message[SCENE_MESSAGE])
{
    stage_wish wish = *way;
    int status;

    wish.casting = wish.unbounded = 1;
    wish.light_count = 1;
    wish.first_light = light;
    wish.keeps = 0;
    status = stage_plan(s, &wish, message);
    if (status == 0 && !stage_draw_mask(s, light, message))
        status = EXIT_FAILED;
    if (status == 0 && !read_mask(s, lit, visible)) {
        snprintf(message, SCENE_MESSAGE, "the mask cannot be read back");
        status = EXIT_FAILED;
    }
    return status;
}

int difference_find(difference *d, stage *s, const stage_wish *way, uint32_t light, char message[SCENE_MESSAGE])
{
    const size_t pixels = (size_t)s->target.width * s->target.height;
    const truth_options options = {s->target.width, s->target.height, s->target.depth_bits, {0, 0}};
    const double start = now_ms();
    uint8_t *drawn = malloc(2 * pixels);
    true_mask true_one = {NULL, NULL, NULL};
    truth *common = NULL;
    int status = EXIT_FAILED;

    memset(d, 0, sizeof *d);
    d->width = s->target.width;
    d->height = s->target.height;
    d->light = light;
    d->marks = calloc(pixels, 4);
    if (!drawn || !d->marks)
        snprintf(message, SCENE_MESSAGE, "no memory for the difference");
    else
        status = draw(s, way, light, drawn, drawn + pixels, message);
    if (status == 0 && !true_mask_trace(&true_one, s->scene, &options, light, &common, message))
        status = EXIT_FAILED;
    if (status == 0)
        compare(d, drawn, &true_one);
    else
        difference_free(d);
    d->ms = now_ms() - start;
    true_mask_free(&true_one);
    truth_free(common);
    free(drawn);
    return status;
}

void difference_free(difference *d)
{
    free(d->marks);
    memset(d, 0, sizeof *d);
}
