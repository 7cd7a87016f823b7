/* view_open.c - the viewer's stage, and what is drawn over it: opened, resized, and made again when the context was lost or
 * other capabilities are hidden. */
#include "view.h"

#include <string.h>

#include "command.h"

void view_end(view *v, int status)
{
    if (status == EXIT_DONE)
        return;
    v->is_over = 1;
    v->status = status;
}

static void close_stage(view *v)
{
    adaptive_close(&v->adaptive);
    overlay_destroy(v->overlay);
    v->overlay = NULL;
    present_close(&v->present);
    stage_close(v->stage);
    v->stage = NULL;
}

static void list_hidden(uint32_t set, char names[1024])
{
    size_t length = 0;

    names[0] = '\0';
    for (int c = 0; c < GN_CAPABILITY_COUNT; c++)
        if (set >> c & 1)
            length += (size_t)snprintf(names + length, 1024 - length, "%s%s", length ? "," : "",
                                       gn_capability_name((gn_capability)c));
}

/* Methods that a frame like the scene's can be made by here. */
static void find_possible(view *v)
{
    v->possible = 1u << GN_METHOD_AUTO;
    for (int m = 0; m < GN_METHOD_TOTAL; m++) {
        stage_wish wish = view_wish(v, 0);
        char message[SCENE_MESSAGE];

        wish.method = (gn_method)m;
        wish.scale = m == GN_METHOD_REFINE ? 2 : 1;
        if (stage_plan(v->stage, &wish, message) == 0)
            v->possible |= 1u << m;
    }
}

static int open_stage(view *v)
{
    char names[1024], message[SCENE_MESSAGE] = "";
    const stage_options options = {.platform = v->platform,
                                   .width = v->size[0],
                                   .height = v->size[1],
                                   .depth_bits = 24,
                                   .stencil_bits = 8,
                                   .hide = names};
    const adaptive_options choosing = {&v->files.knowledge, v->files.rules, v->files.budget, 1.0};
    int status;

    v->no_selector[0] = '\0';
    list_hidden(v->hidden, names);
    status = stage_open(&v->stage, &v->loaded, &options, message);
    if (status != 0) {
        say("%s", message);
        return status;
    }
    v->size[0] = v->stage->target.width;
    v->size[1] = v->stage->target.height;
    v->overlay = overlay_create(v->stage->gl);
    if (!v->overlay || !present_open(&v->present, v->stage->gl)) {
        say("view: what is drawn over the frame cannot be made");
        return EXIT_FAILED;
    }
    if (adaptive_open(&v->adaptive, v->stage, &choosing, message) != 0) {
        if (v->is_adaptive) {
            say("view: %s", message);
            return EXIT_FAILED;
        }
        snprintf(v->no_selector, sizeof v->no_selector, "%.255s", message);
    }
    stage_pose(v->stage, v->seconds, 0.0);
    find_possible(v);
    if (window_exists(v->stage->platform))
        window_show(v->stage->platform, v->path);
    return EXIT_DONE;
}

int view_open(view *v)
{
    char message[SCENE_MESSAGE] = "";

    if (!scene_load(&v->loaded, v->path, say_line, message) ||
        !scene_ensure_view(&v->loaded, (double)v->size[0] / v->size[1], say_line)) {
        say("%s", message[0] ? message : "no memory");
        return EXIT_FAILED;
    }
    if (!handles_open(&v->lights, &v->loaded)) {
        say("view: no memory");
        return EXIT_FAILED;
    }
    return open_stage(v);
}

void view_close(view *v)
{
    close_stage(v);
    difference_free(&v->difference);
    handles_close(&v->lights);
    scene_free(&v->loaded);
}

int view_reopen(view *v)
{
    v->is_marked = 0;
    v->moves = 0;
    v->dragged = VIEW_DRAGS_NOTHING;
    close_stage(v);
    return open_stage(v);
}

int view_resize(view *v)
{
    char message[SCENE_MESSAGE];

    v->is_marked = 0;
    if (!stage_resize(v->stage, message)) {
        say("%s", message);
        return EXIT_FAILED;
    }
    v->size[0] = v->stage->target.width;
    v->size[1] = v->stage->target.height;
    if (!v->no_selector[0]) {
        v->adaptive.asked.target_pixels = (double)v->size[0] * v->size[1];
        gn_selector_set(v->adaptive.selector, &v->adaptive.asked);
    }
    return EXIT_DONE;
}

stage_wish view_wish(const view *v, int side)
{
    const view_way *way = &v->ways[side];
    const stage_wish wish = {.method = way->method,
                             .casting = 1,
                             .light_count = v->stage->light_count,
                             .scale = way->scale,
                             .upsample = way->upsample};

    return wish;
}
