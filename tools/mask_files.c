/* mask_files.c - see mask_files.h. */
#define _POSIX_C_SOURCE 200809L
#include "mask_files.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "command.h"
#include "picture.h"

static int write_mask(stage *s, const char *dir, uint32_t light)
{
    const size_t pixels = (size_t)s->target.width * s->target.height, length = strlen(dir) + 40;
    uint8_t *lit = malloc(pixels), *visible = malloc(pixels), *both = malloc(2 * pixels);
    char *path = malloc(length);
    int ok = lit && visible && both && path && read_mask(s, lit, visible);

    if (!ok)
        say("%s: the mask of light %u cannot be read back", dir, (unsigned)light);
    for (size_t i = 0; ok && i < pixels; i++) {
        both[2 * i] = lit[i];
        both[2 * i + 1] = visible[i];
    }
    if (ok) {
        snprintf(path, length, "%s/light%u.png", dir, (unsigned)light);
        ok = write_png(path, both, s->target.width, s->target.height, 2);
    }
    free(path);
    free(lit);
    free(visible);
    free(both);
    return ok;
}

int write_masks(stage *s, const stage_wish *like, const char *folder)
{
    char message[SCENE_MESSAGE] = "";

    if (mkdir(folder, 0777) != 0 && errno != EEXIST) {
        say("%s: cannot be made: %s", folder, strerror(errno));
        return EXIT_FAILED;
    }
    for (uint32_t i = 0; i < s->scene->light_count; i++) {
        const stage_wish wish = {.method = like->method,
                                 .one_sided = like->one_sided,
                                 .casting = 1,
                                 .first_light = i,
                                 .light_count = 1,
                                 .unbounded = 1,
                                 .scale = like->scale,
                                 .upsample = like->upsample,
                                 .sharpen = like->sharpen};
        const int status = stage_plan(s, &wish, message);

        if (status != 0 || !stage_draw_mask(s, i, message)) {
            say("light %u: %s", (unsigned)i, message);
            return status ? status : EXIT_FAILED;
        }
        if (!write_mask(s, folder, i))
            return EXIT_FAILED;
    }
    return EXIT_DONE;
}
