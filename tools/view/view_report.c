/* view_report.c - what the panel says, as JSON; and the picture with the panel on it. */
#include "view.h"

#include <cjson/cJSON.h>
#include <stdlib.h>
#include <string.h>

#include "command.h"

static void add_side(cJSON *to, const view_side *side)
{
    cJSON *o = cJSON_CreateObject();

    cJSON_AddStringToObject(o, "way", side->name);
    cJSON_AddStringToObject(o, "impossible", side->why);
    cJSON_AddNumberToObject(o, "ms", side->ms);
    cJSON_AddNumberToObject(o, "fragments", side->fragments);
    cJSON_AddNumberToObject(o, "milliwatts", side->milliwatts);
    cJSON_AddItemToArray(to, o);
}

static void add_lights(const view *v, cJSON *root)
{
    cJSON *lights = cJSON_AddArrayToObject(root, "lights");

    for (uint32_t i = 0; i < v->loaded.light_count; i++) {
        cJSON *o = cJSON_CreateObject();
        char way[80] = "";
        double at[2];

        if (v->is_adaptive && i < v->adaptive.light_count)
            gn_way_name(&v->adaptive.ways[i], way, sizeof way);
        cJSON_AddStringToObject(o, "way", v->is_adaptive ? way : v->sides[0].name);
        cJSON_AddItemToObject(o, "position", cJSON_CreateDoubleArray(v->loaded.lights[i].position, 3));
        cJSON_AddItemToObject(o, "towards", cJSON_CreateDoubleArray(v->loaded.lights[i].towards, 3));
        if (handle_place(&v->loaded, i, v->size, at))
            cJSON_AddItemToObject(o, "at", cJSON_CreateDoubleArray(at, 2));
        cJSON_AddItemToArray(lights, o);
    }
}

static void add_difference(const view *v, cJSON *root)
{
    cJSON *o = cJSON_AddObjectToObject(root, "difference");

    cJSON_AddNumberToObject(o, "light", v->difference.light);
    cJSON_AddNumberToObject(o, "certain", (double)v->difference.certain);
    cJSON_AddNumberToObject(o, "wrong", (double)v->difference.wrong);
    cJSON_AddNumberToObject(o, "wrong_certain", (double)v->difference.wrong_certain);
}

int view_write_report(const view *v, const char *path)
{
    const char *const shows[VIEW_SHOWS] = {"lit", "volumes", "cases", "silhouettes", "mask"};
    const double size[2] = {v->size[0], v->size[1]};
    cJSON *root = cJSON_CreateObject(), *sides;
    fresh_file f = {NULL, NULL, NULL};
    char *text;
    int ok;

    cJSON_AddStringToObject(root, "renderer", (const char *)v->stage->gl->glGetString(GL_RENDERER));
    cJSON_AddStringToObject(root, "platform", v->stage->platform->kind->name);
    cJSON_AddItemToObject(root, "size", cJSON_CreateDoubleArray(size, 2));
    cJSON_AddBoolToObject(root, "fine", view_is_fine(v));
    cJSON_AddNumberToObject(root, "frame", v->frame);
    cJSON_AddNumberToObject(root, "seconds", v->seconds);
    cJSON_AddStringToObject(root, "show", shows[v->show]);
    cJSON_AddBoolToObject(root, "adaptive", v->is_adaptive);
    cJSON_AddNumberToObject(root, "budget_ms", v->files.budget.frame_ms);
    sides = cJSON_AddArrayToObject(root, "sides");
    for (int i = 0; i <= v->is_split; i++)
        add_side(sides, &v->sides[i]);
    add_lights(v, root);
    cJSON_AddItemToObject(root, "eye", cJSON_CreateDoubleArray(v->loaded.camera.world + 12, 3));
    if (v->camera.is_moved)
        cJSON_AddItemToObject(root, "target", cJSON_CreateDoubleArray(v->camera.target, 3));
    cJSON_AddStringToObject(root, "notice", v->notice);
    if (v->is_marked)
        add_difference(v, root);
    text = cJSON_Print(root);
    cJSON_Delete(root);
    if (!text) {
        say("%s: no memory", path);
        return 0;
    }
    ok = fresh_open(&f, path);
    ok = ok && fresh_close(&f, fputs(text, f.file) >= 0 && fputc('\n', f.file) != EOF);
    free(text);
    return ok;
}

int view_write_picture(view *v, const char *path)
{
    const size_t pixels = (size_t)v->size[0] * v->size[1];
    uint8_t *rgba = malloc(4 * pixels);
    int ok = rgba && platform_read_back(v->stage->platform, rgba);

    if (!ok)
        say("%s: the frame cannot be read back", path);
    for (size_t i = 0; ok && i < pixels; i++)
        memmove(rgba + 3 * i, rgba + 4 * i, 3);
    ok = ok && write_png(path, rgba, v->size[0], v->size[1], 3);
    free(rgba);
    return ok;
}
