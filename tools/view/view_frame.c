/* view_frame.c - a frame of the viewer: posed, drawn by one way or two, measured, encoded, and with the panel over it. */
#include "view.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "command.h"
#include "picture.h"

#define TURNING         20.0 /* degrees a second */
#define MILLIWATTS_A_GB 100.0
#define MOST_FRAMES     60.0 /* a second, for power */

static void pose(view *v, double dt)
{
    if (!v->is_paused && dt > 0.0 && (v->loaded.duration > 0.0 || v->turns_lights))
        v->is_marked = 0;
    if (!v->is_paused) {
        v->seconds += dt;
        if (v->loaded.duration > 0.0)
            v->seconds = fmod(v->seconds, v->loaded.duration);
    }
    if (v->turns_lights && !v->is_paused)
        handles_turn(&v->lights, TURNING * dt);
    view_fly(v, dt);
    stage_pose(v->stage, v->seconds, 0.0);
    orbit_apply(&v->camera, &v->loaded);
    handles_apply(&v->lights, &v->loaded);
    stage_place_lights(v->stage, 0.0);
}

static void show_more(view *v)
{
    if (v->show == VIEW_VOLUMES)
        stage_show_volumes(v->stage);
    else if (v->show == VIEW_CASES)
        stage_show_cases(v->stage);
    else if (v->show == VIEW_SILHOUETTES)
        stage_show_silhouettes(v->stage);
}

/* Of a light's mask at full size, as many as its scale leaves. */
static double at_scale(double fragments, uint32_t scale)
{
    return fragments / ((double)scale * scale);
}

static void note_plan(const view *v, view_side *side)
{
    const gn_plan *plan = v->stage->plan;

    for (uint32_t i = 0; i < plan->light_count; i++) {
        gn_load load;
        gn_facts facts;

        if (gn_plan_measure(plan, i, 0, &load, &facts))
            side->fragments += at_scale(load.fragments, plan->scale);
    }
    side->bytes = plan->traffic.written + plan->traffic.read;
}

static void note_choices(const view *v, view_side *side)
{
    const adaptive *a = &v->adaptive;

    for (uint32_t i = 0; i < a->light_count; i++)
        if (!a->ways[i].is_dropped)
            side->fragments += at_scale(a->lights[i].load.fragments, a->ways[i].scale);
    side->bytes = a->traffic.written + a->traffic.read;
}

/* What cannot be made is drawn without shadows, or where not even that can be not at all, and says so. */
static int draw_unshadowed(view *v, view_side *side, char message[SCENE_MESSAGE])
{
    const stage_wish wish = {.method = GN_METHOD_AUTO, .light_count = v->stage->light_count};

    if (stage_plan(v->stage, &wish, message) == 0)
        return stage_draw_lit(v->stage, 0, message);
    v->stage->gl->glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    side->is_blank = 1;
    return 1;
}

static int draw_way(view *v, int number, char message[SCENE_MESSAGE])
{
    const stage_wish wish = view_wish(v, number);
    view_side *side = &v->sides[number];
    int ok;

    if (stage_plan(v->stage, &wish, message) != 0) {
        snprintf(side->why, sizeof side->why, "%.255s", message);
        return draw_unshadowed(v, side, message);
    }
    ok = v->show == VIEW_MASK ? stage_draw_shares(v->stage, message) : stage_draw_lit(v->stage, 0, message);
    if (ok && v->stage->plan->light_count) {
        const gn_way way = {.method = v->stage->plan->lights[0].method,
                            .scale = v->stage->plan->scale,
                            .upsample = wish.upsample,
                            .update_every = 1};

        gn_way_name(&way, side->name, sizeof side->name);
    }
    return ok;
}

static int draw_side(view *v, int number, char message[SCENE_MESSAGE])
{
    view_side *side = &v->sides[number];
    const double start = now_ms();
    int ok;

    memset(side, 0, sizeof *side);
    if (v->is_adaptive && number == 0) {
        const stage_wish like = {.casting = 1};

        ok = adaptive_draw(&v->adaptive, &like, v->stage->light_count, message);
        snprintf(side->name, sizeof side->name, "as the selector chooses");
    } else {
        ok = draw_way(v, number, message);
    }
    if (!ok)
        return 0;
    v->stage->gl->glFinish();
    side->ms = now_ms() - start;
    if (v->is_adaptive && number == 0) {
        adaptive_measured(&v->adaptive, side->ms);
        note_choices(v, side);
    } else if (!side->is_blank) {
        note_plan(v, side);
    }
    side->milliwatts = side->bytes / 1e9 * MILLIWATTS_A_GB * fmin(1000.0 / side->ms, MOST_FRAMES);
    if (!side->why[0])
        show_more(v);
    present_keep(&v->present, number, v->stage->target.width, v->stage->target.height);
    return 1;
}

/* The mask of the light that is meant against the truth, as it stands. What is drawn after it is as if nothing had been. */
static void compare(view *v)
{
    char message[SCENE_MESSAGE] = "";
    stage_wish way = view_wish(v, 0);

    v->compares = 0;
    difference_free(&v->difference);
    if (v->is_adaptive && v->light < v->adaptive.light_count) {
        const gn_way *chosen = &v->adaptive.ways[v->light];

        if (chosen->is_dropped) {
            view_tell(v, "light %u has no shadow to be compared", (unsigned)v->light);
            return;
        }
        way.method = chosen->method;
        way.scale = chosen->scale;
        way.upsample = chosen->upsample;
    }
    if (difference_find(&v->difference, v->stage, &way, v->light, message) != EXIT_DONE) {
        view_tell(v, "no difference: %.200s", message);
        return;
    }
    present_mark(&v->present, v->difference.marks, v->difference.width, v->difference.height);
    v->is_marked = 1;
}

static int is_lost(view *v)
{
    v->is_lost = v->is_lost || v->stage->platform->kind->lost(v->stage->platform);
    return v->is_lost;
}

int view_frame(view *v, double dt)
{
    char message[SCENE_MESSAGE] = "";
    GLenum error;

    if (is_lost(v)) {
        const int status = view_reopen(v);

        if (status != EXIT_DONE)
            return status;
        v->is_lost = 0;
        view_tell(v, "the context was lost, and made again");
    }
    pose(v, dt);
    if (v->compares)
        compare(v);
    if ((v->is_split && !draw_side(v, 1, message)) || !draw_side(v, 0, message)) {
        if (is_lost(v))
            return EXIT_DONE; /* and made again before the next */
        say("%s", message);
        return EXIT_FAILED;
    }
    v->times[v->frame++ % VIEW_TIMES] = v->sides[0].ms;
    present_draw(&v->present, v->is_split ? v->split : 1.0, v->is_marked);
    view_draw_panel(v);
    error = v->stage->gl->glGetError();
    if (error != GL_NO_ERROR && !is_lost(v)) {
        say("view: the GL reports an error (0x%04x)", (unsigned)error);
        return EXIT_FAILED;
    }
    return EXIT_DONE;
}
