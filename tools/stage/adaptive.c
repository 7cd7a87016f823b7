/* adaptive.c - see adaptive.h. */
#include "adaptive.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FAST 0.02 /* of the screen's height in a frame: motion 1 */

enum { LOOKS = 16 }; /* frames after which shadows that are dropped are looked at again */

static void find_possible(adaptive *a)
{
    gn_scene like;
    int any = 0;

    memset(&like, 0, sizeof like);
    like.target = a->stage->target;
    like.reads_masks = 1;
    like.lights_per_pass = a->stage->shader_lights;
    like.follows = 1;
    gn_find_possible(&like, &a->asked.possible);
    for (int m = 0; m < GN_METHOD_TOTAL; m++)
        any |= m > GN_METHOD_ZPASS && a->asked.possible.variants[m];
    a->is_uniform = !any;
    like.follows = 0;
    if (a->is_uniform)
        gn_find_possible(&like, &a->asked.possible);
}

int adaptive_open(adaptive *a, stage *s, const adaptive_options *options, char message[SCENE_MESSAGE])
{
    memset(a, 0, sizeof *a);
    a->stage = s;
    a->power = options->power;
    if (s->light_count > GN_MOST_SELECTED) {
        snprintf(message, SCENE_MESSAGE, "the selector takes at most %d lights (%u)", GN_MOST_SELECTED,
                 (unsigned)s->light_count);
        return 1;
    }
    a->object_count = s->scene->instance_count * (s->proxy_triangles ? 2 : 1);
    a->places = calloc(a->object_count + 1, sizeof *a->places);
    if (!a->places || gn_selector_create(s->context, options->knowledge, options->rules, &a->selector) != GN_OK) {
        snprintf(message, SCENE_MESSAGE, "%s", a->places ? gn_message(s->context) : "no memory for the selector");
        adaptive_close(a);
        return 1;
    }
    a->asked.budget = options->budget;
    a->asked.target_pixels = (double)s->target.width * s->target.height;
    a->asked.has_proxies = s->proxy_triangles > 0;
    find_possible(a);
    gn_selector_set(a->selector, &a->asked);
    return 0;
}

void adaptive_close(adaptive *a)
{
    gn_selector_destroy(a->selector);
    free(a->places);
    memset(a, 0, sizeof *a);
}

void adaptive_set_budget(adaptive *a, const gn_budget *budget)
{
    a->asked.budget = *budget;
    gn_selector_set(a->selector, &a->asked);
}

/* ------------------------------------------------------------------ facts */

/* How far the middle of what casts has gone since the last frame, at most. */
static double find_motion(adaptive *a)
{
    const gn_plan *plan = a->stage->plan;
    const float aspect = (float)plan->target.width / (float)plan->target.height;
    double most = 0.0;

    for (uint32_t i = 0; i < plan->object_count && i < a->object_count; i++) {
        const float *m = plan->objects[i].matrix;
        const int is_before = m[15] > 0.0f;
        const float at[2] = {is_before ? aspect * m[12] / m[15] : 0.0f, is_before ? m[13] / m[15] : 0.0f};

        if (a->light_count && is_before && fabsf(at[0]) < 2.0f * aspect && fabsf(at[1]) < 2.0f)
            most = fmax(most, hypot((double)(at[0] - a->places[i][0]), (double)(at[1] - a->places[i][1])) / 2.0);
        memcpy(a->places[i], at, sizeof at);
    }
    return fmin(most / FAST, 1.0);
}

static int has_moved(const gn_light *now, const gn_light *last)
{
    return memcmp(now->position, last->position, sizeof now->position) != 0 ||
           memcmp(now->towards, last->towards, sizeof now->towards) != 0;
}

/* What a part of the frame says of its lights. shares: by how many times the casters themselves have more to draw. */
static void note_part(adaptive *a, const uint32_t *members, uint32_t count, double shares)
{
    const gn_plan *plan = a->stage->plan;

    for (uint32_t i = 0; i < count; i++) {
        gn_light_state *l = &a->lights[members[i]];
        const double *color = a->stage->lights[members[i]].color;

        gn_plan_measure(plan, i, 0, &l->load, &l->facts);
        l->load.indices *= shares;
        l->importance = fmax(fmax(color[0], color[1]), color[2]) * l->load.pixels;
    }
}

/* And all of them together. */
static void note_frame(adaptive *a, uint32_t light_count)
{
    const double motion = find_motion(a);
    double casting = 0.0, moving = 0.0;

    for (uint32_t i = 0; i < light_count; i++) {
        casting += a->lights[i].load.indices > 0.0;
        moving += a->light_count > i && has_moved(&a->stage->lights[i], &a->last[i]);
        a->last[i] = a->stage->lights[i];
    }
    for (uint32_t i = 0; i < light_count; i++) {
        a->lights[i].facts.lights = casting;
        a->lights[i].facts.moving = moving;
        a->lights[i].facts.motion = motion;
        a->lights[i].facts.power = a->power;
    }
    a->light_count = light_count;
}

/* ------------------------------------------------------------------ frames */

static int is_same(const gn_way *a, const gn_way *b)
{
    if (a->is_dropped || b->is_dropped)
        return a->is_dropped == b->is_dropped;
    return a->method == b->method && a->scale == b->scale && (a->scale == 1 || a->upsample == b->upsample) &&
           a->proxies == b->proxies;
}

/* Before the first frame nothing is known: it is planned once for that. */
static int look_ahead(adaptive *a, const stage_wish *like, uint32_t light_count, char message[SCENE_MESSAGE])
{
    stage_wish wish = *like;
    uint32_t all[GN_MOST_SELECTED];

    wish.method = GN_METHOD_AUTO;
    wish.light_count = light_count;
    if (stage_plan(a->stage, &wish, message) != 0)
        return 0;
    for (uint32_t i = 0; i < light_count; i++)
        all[i] = i;
    note_part(a, all, light_count, 1.0);
    note_frame(a, light_count);
    return 1;
}

/* The lights of one way, from `first` on, as a part of the frame. */
static int draw_part(adaptive *a, const stage_wish *like, uint32_t first, uint8_t *drawn, uint32_t light_count,
                     char message[SCENE_MESSAGE])
{
    const gn_way *way = &a->ways[first];
    uint32_t members[GN_MOST_SELECTED], count = 0, left = 0;
    stage_wish wish = *like;

    for (uint32_t i = 0; i < light_count; i++) {
        const int is_member = !drawn[i] && is_same(&a->ways[i], way);

        if (is_member)
            members[count++] = i;
        drawn[i] |= (uint8_t)is_member;
        left += !drawn[i];
    }
    wish.members = members;
    wish.light_count = count;
    wish.follows = a->plans > 0;
    wish.precedes = left > 0;
    wish.casting = !way->is_dropped;
    wish.method = way->is_dropped ? GN_METHOD_AUTO : way->method;
    wish.scale = way->is_dropped ? 1 : way->scale;
    wish.upsample = way->upsample;
    wish.full_casters = !way->proxies;
    if (way->is_dropped && a->frames % LOOKS == 0) {
        stage_wish look = wish;

        look.casting = 1;
        if (stage_plan(a->stage, &look, message) != 0)
            return 0;
        note_part(a, members, count, 1.0);
    }
    if (stage_plan(a->stage, &wish, message) != 0 || !stage_draw_lit(a->stage, 0, message))
        return 0;
    a->plans++;
    a->traffic.written += a->stage->plan->traffic.written;
    a->traffic.read += a->stage->plan->traffic.read;
    if (!way->is_dropped)
        note_part(a, members, count, way->proxies ? 2.0 : 1.0); /* as the selector takes proxies to spare a half */
    return 1;
}

int adaptive_draw(adaptive *a, const stage_wish *like, uint32_t light_count, char message[SCENE_MESSAGE])
{
    uint8_t drawn[GN_MOST_SELECTED] = {0};

    if (a->light_count != light_count && !look_ahead(a, like, light_count, message))
        return 0;
    if (gn_selector_next(a->selector, a->lights, light_count, a->ways) != GN_OK) {
        snprintf(message, SCENE_MESSAGE, "%s", gn_message(a->stage->context));
        return 0;
    }
    for (uint32_t i = 1; i < light_count && a->is_uniform; i++)
        a->ways[i] = a->ways[0];
    a->plans = 0;
    memset(&a->traffic, 0, sizeof a->traffic);
    for (uint32_t i = 0; i < light_count; i++)
        if (!drawn[i] && !draw_part(a, like, i, drawn, light_count, message))
            return 0;
    if (light_count == 0) {
        stage_wish wish = *like;

        wish.light_count = 0;
        if (stage_plan(a->stage, &wish, message) != 0 || !stage_draw_lit(a->stage, 0, message))
            return 0;
    }
    note_frame(a, light_count);
    a->frames++;
    return 1;
}

void adaptive_measured(adaptive *a, double frame_ms)
{
    gn_selector_measured(a->selector, frame_ms);
}
