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
    const stage_look look = {1, first_light, light_count, NULL, -1, -1, -1, 0};

    stage_draw_objects(s, STAGE_PASS_BLEND, &look);
}

int stage_draw_lit(stage *s, uint32_t first_light, char message[SCENE_MESSAGE])
{
    gn_step step;

    s->gl->glClearColor(0.0f, 0.0f, 0.0f, 0.0f);
    if (!begin(s, message))
        return 0;
    while (gn_gles_next(s->gles, &step)) {
        stage_look look = {0, first_light + step.light, 1, NULL, step.receivers, -1, (int)step.light, 0};

        if (step.draw == GN_DRAW_FINAL) {
            draw_blended(s, first_light, s->plan->light_count);
            continue;
        }
        if (step.draw == GN_DRAW_AMBIENT) {
            look.ambient = 1;
            look.light_count = 0;
            look.receivers = look.lit_by = -1;
            look.backs = 1;
        }
        stage_draw_objects(s, STAGE_PASS_SOLID, &look);
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
        const int is_light = step.draw == GN_DRAW_LIGHT;
        const stage_look look = {0,
                                 0,
                                 0,
                                 is_light ? lit : surface,
                                 is_light ? step.receivers : -1,
                                 is_light ? (int)(first_light + step.light) : -1,
                                 is_light ? (int)step.light : -1,
                                 !is_light};

        if (step.draw != GN_DRAW_FINAL)
            stage_draw_objects(s, STAGE_PASS_SOLID, &look);
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
    const uint32_t group = s->shader_lights;
    stage_look look = {1, 0, count < group ? count : group, NULL, -1, -1, -1, 0};

    gl->glClearColor(0.0f, 0.0f, 0.0f, 0.0f);
    gl->glClearDepthf((GLfloat)s->plan->clear_depth);
    gl->glDepthMask(GL_TRUE);
    gl->glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
    gl->glEnable(GL_DEPTH_TEST);
    gl->glDepthFunc(GL_LESS);
    stage_draw_objects(s, STAGE_PASS_SOLID, &look);
    gl->glDepthMask(GL_FALSE);
    gl->glEnable(GL_BLEND);
    gl->glBlendFunc(GL_ONE, GL_ONE);
    gl->glDepthFunc(GL_EQUAL);
    for (look.ambient = 0, look.first_light = group; look.first_light < count; look.first_light += group) {
        look.light_count = count - look.first_light < group ? count - look.first_light : group;
        stage_draw_objects(s, STAGE_PASS_SOLID, &look);
    }
    gl->glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    gl->glDepthFunc(GL_LESS);
    draw_blended(s, 0, count);
    gl->glDisable(GL_BLEND);
    gl->glDisable(GL_DEPTH_TEST);
    gl->glDepthMask(GL_TRUE);
}
