/* worst.c - see worst.h. */
#include "worst.h"

#include <stdlib.h>
#include <string.h>

#include "command.h"
#include "picture.h"

/* As part of a file's name. */
static void make_plain(char *name)
{
    for (char *c = name; *c; c++)
        if (strchr("/@ \"'", *c))
            *c = '-';
}

void worst_path(const char *directory, const char *scene_file, const char *config_name, const char *width,
                const char *height, const char *lights, char *path, size_t size)
{
    const char *slash = strrchr(scene_file, '/');
    char of_scene[64], of_config[64], *dot;

    snprintf(of_scene, sizeof of_scene, "%s", slash ? slash + 1 : scene_file);
    dot = strrchr(of_scene, '.');
    if (dot)
        *dot = '\0';
    snprintf(of_config, sizeof of_config, "%s", config_name);
    make_plain(of_scene);
    make_plain(of_config);
    snprintf(path, size, "%s/worst/%s-%s-%sx%s-%s.png", directory, of_scene, of_config, width, height, lights);
}

static void put_mask(uint8_t *row, const uint8_t *lit, const uint8_t *visible, uint32_t width)
{
    static const uint8_t white[3] = {235, 235, 235}, dark[3] = {45, 45, 45}, blue[3] = {25, 40, 90};

    for (uint32_t x = 0; x < width; x++)
        memcpy(row + 3 * (size_t)x, !visible[x] ? blue : lit[x] ? white : dark, 3);
}

static void put_difference(uint8_t *row, const uint8_t *lit, const uint8_t *right, const uint8_t *visible,
                           uint32_t width)
{
    static const uint8_t red[3] = {255, 40, 30};

    put_mask(row, right, visible, width);
    for (uint32_t x = 0; x < width; x++) {
        uint8_t *pixel = row + 3 * (size_t)x;

        for (int c = 0; c < 3; c++)
            pixel[c] = (uint8_t)(pixel[c] / 2 + 40);
        if (visible[x] && lit[x] != right[x])
            memcpy(pixel, red, sizeof red);
    }
}

int worst_write(subject *s, const config *c, const trial *t, const char *path)
{
    const uint32_t width = s->stage->target.width, height = s->stage->target.height, gap = 4, row = 3 * width + 2 * gap;
    const true_mask *true_one = &s->truths[(size_t)t->worst_frame * s->lights + t->worst_light];
    const stage_wish wish = {.method = c->method,
                             .one_sided = c->one_sided,
                             .casting = 1,
                             .keeps = subject_keeps(s),
                             .first_light = t->worst_light,
                             .light_count = 1,
                             .unbounded = 1,
                             .scale = c->scale,
                             .upsample = c->upsample};
    const size_t pixels = (size_t)width * height;
    uint8_t *lit = malloc(2 * pixels), *picture = malloc((size_t)3 * row * height);
    char message[SCENE_MESSAGE] = "no memory";
    int ok = lit && picture;

    ok = ok && stage_renew_cache(s->stage);
    for (uint32_t frame = wish.keeps ? 0 : t->worst_frame; ok && frame <= t->worst_frame; frame++) {
        subject_pose(s, frame);
        ok = stage_plan(s->stage, &wish, message) == 0 && stage_draw_mask(s->stage, t->worst_light, message) &&
             read_mask(s->stage, lit, lit + pixels);
    }
    if (!ok)
        say("%s: %s", path, message);
    for (uint32_t y = 0; ok && y < height; y++) {
        const size_t at = (size_t)width * y;
        uint8_t *const out = picture + (size_t)3 * row * y;

        memset(out, 255, (size_t)3 * row);
        put_mask(out, lit + at, true_one->visible + at, width);
        put_mask(out + (size_t)3 * (width + gap), true_one->lit + at, true_one->visible + at, width);
        put_difference(out + (size_t)6 * (width + gap), lit + at, true_one->lit + at, true_one->visible + at, width);
    }
    ok = ok && write_png(path, picture, row, height, 3);
    free(lit);
    free(picture);
    return ok;
}
