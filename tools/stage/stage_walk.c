/* stage_walk.c - frames: pulls the plan's steps from the library and draws what each asks for. */
#include "stage.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int begin(stage *s, char message[SCENE_MESSAGE])
{
    if (gn_gles_begin(s->gles, s->plan) == GN_OK)
        return 1;
    snprintf(message, SCENE_MESSAGE, "%s", gn_message(s->context));
    return 0;
}

/* Everything transparent, lit by all lights without shadows: it casts none, and masks are of what is behind it. */
static void draw_blended(stage *s, uint32_t first_light, uint32_t light_count)
{
    const stage_look look = {
        .ambient = 1, .first_light = first_light, .light_count = light_count, .receivers = -1, .facing_light = -1};

    stage_draw_objects(s, STAGE_PASS_BLEND, &look);
}

/* Every opaque object and all lights, as many in a pass as the shader takes; the state for the first is set. */
static void draw_all_lit(stage *s, uint32_t first_light, uint32_t count, int receivers, int backs)
{
    const uint32_t group = s->shader_lights, end = first_light + count;
    stage_look look = {.ambient = 1,
                       .first_light = first_light,
                       .light_count = count < group ? count : group,
                       .receivers = receivers,
                       .facing_light = -1,
                       .backs = backs};

    stage_draw_objects(s, STAGE_PASS_SOLID, &look);
    s->gl->glDepthMask(GL_FALSE);
    s->gl->glEnable(GL_BLEND);
    s->gl->glBlendFunc(GL_ONE, GL_ONE);
    s->gl->glDepthFunc(GL_EQUAL);
    look.ambient = look.backs = 0;
    for (look.first_light += group; look.first_light < end; look.first_light += group) {
        look.light_count = end - look.first_light < group ? end - look.first_light : group;
        stage_draw_objects(s, STAGE_PASS_SOLID, &look);
    }
}

static void draw_depth(stage *s)
{
    static const float black[4] = {0, 0, 0, 0};
    const stage_look look = {
        .flat = black, .receivers = -1, .facing_light = -1, .carries_depth = s->plan->carries_depth, .backs = 1};

    stage_draw_objects(s, STAGE_PASS_SOLID, &look);
}

static uint32_t mask_of(const stage *s, const gn_step *step)
{
    return s->plan->mask == GN_MASK_TEXTURE && step->receivers ? gn_gles_mask(s->gles, step->mask) : 0;
}

int stage_draw_lit(stage *s, uint32_t first_light, char message[SCENE_MESSAGE])
{
    gn_step step;

    s->gl->glClearColor(0.0f, 0.0f, 0.0f, 0.0f);
    if (!begin(s, message))
        return 0;
    while (gn_gles_next(s->gles, &step)) {
        const stage_look ambient = {.ambient = 1, .receivers = -1, .facing_light = -1, .backs = 1};
        const stage_look light = {.first_light = first_light,
                                  .light_count = step.light_count,
                                  .picked = step.lights,
                                  .picked_count = step.light_count,
                                  .mask = mask_of(s, &step),
                                  .receivers = step.receivers,
                                  .facing_light = -1,
                                  .only_lit = 1};

        switch (step.draw) {
        case GN_DRAW_DEPTH:
            draw_depth(s);
            break;
        case GN_DRAW_AMBIENT:
            stage_draw_objects(s, STAGE_PASS_SOLID, &ambient);
            break;
        case GN_DRAW_LIT:
            draw_all_lit(s, first_light, s->plan->light_count, step.receivers ? -1 : 0, step.receivers);
            break;
        case GN_DRAW_LIGHT:
            stage_draw_objects(s, STAGE_PASS_SOLID, &light);
            break;
        default:
            draw_blended(s, first_light, s->member_count ? s->light_count : s->plan->light_count);
        }
    }
    return 1;
}

/* Surfaces in one colour, and another added where a light reaches them: light first_light + n for the plan's n-th. */
static int draw_flat(stage *s, uint32_t first_light, const float surface[4], const float lit[4],
                     char message[SCENE_MESSAGE])
{
    gn_step step;

    s->gl->glClearColor(0.0f, 0.0f, 0.0f, 0.0f);
    if (!begin(s, message))
        return 0;
    while (gn_gles_next(s->gles, &step)) {
        const stage_look all = {.flat = surface, .receivers = -1, .facing_light = -1, .backs = 1};

        if (step.draw == GN_DRAW_DEPTH)
            draw_depth(s);
        else if (step.draw == GN_DRAW_AMBIENT)
            stage_draw_objects(s, STAGE_PASS_SOLID, &all);
        for (uint32_t i = 0; i < step.light_count; i++) {
            const stage_look one = {.flat = lit,
                                    .picked = &step.lights[i],
                                    .picked_count = 1,
                                    .mask = mask_of(s, &step),
                                    .channel = i,
                                    .receivers = step.receivers,
                                    .facing_light = (int)(first_light + step.lights[i]),
                                    .only_lit = 1};

            stage_draw_objects(s, STAGE_PASS_SOLID, &one);
        }
    }
    return 1;
}

int stage_draw_mask(stage *s, uint32_t light, char message[SCENE_MESSAGE])
{
    static const float visible[4] = {0, 1, 0, 0}, lit[4] = {1, 0, 0, 0};

    return draw_flat(s, light, visible, lit, message);
}

int stage_draw_shares(stage *s, char message[SCENE_MESSAGE])
{
    static const float black[4] = {0, 0, 0, 1};
    const float share = 1.0f / (float)(s->plan->light_count ? s->plan->light_count : 1);
    const float grey[4] = {share, share, share, 0};

    return draw_flat(s, 0, black, grey, message);
}

void stage_draw_plain(stage *s)
{
    const gn_gl *gl = s->gl;
    const uint32_t count = s->plan->light_count;

    gl->glClearColor(0.0f, 0.0f, 0.0f, 0.0f);
    gl->glClearDepthf((GLfloat)s->plan->clear_depth);
    gl->glDepthMask(GL_TRUE);
    gl->glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
    gl->glEnable(GL_DEPTH_TEST);
    gl->glDepthFunc(GL_LESS);
    draw_all_lit(s, 0, count, -1, 0);
    gl->glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    gl->glDepthFunc(GL_LESS);
    draw_blended(s, 0, count);
    gl->glDisable(GL_BLEND);
    gl->glDisable(GL_DEPTH_TEST);
    gl->glDepthMask(GL_TRUE);
}
