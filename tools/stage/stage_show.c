/* stage_show.c - makes visible what shadows are made of, and counts what it costs: volumes and silhouettes over the
 * frame (McGuire's purple volumes), fragments by adding 1/255 for each. */
#include "stage.h"

#include <stdlib.h>
#include <string.h>

static void over_the_frame(stage *s, GLenum source, GLenum destination)
{
    const gn_gl *gl = s->gl;

    gl->glEnable(GL_DEPTH_TEST);
    gl->glDepthFunc(GL_LESS);
    gl->glDepthMask(GL_FALSE);
    gl->glDisable(GL_CULL_FACE);
    gl->glEnable(GL_BLEND);
    gl->glBlendFunc(source, destination);
}

static void done(stage *s)
{
    s->gl->glDisable(GL_BLEND);
    s->gl->glDisable(GL_DEPTH_TEST);
    s->gl->glDepthMask(GL_TRUE);
}

void stage_show_volumes(stage *s)
{
    static const float purple[4] = {0.35f, 0.05f, 0.45f, 0.18f};

    over_the_frame(s, GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    gn_gles_draw_volumes(s->gles, s->plan, 0, s->plan->record_count, purple);
    done(s);
}

void stage_show_cases(stage *s)
{
    static const float colors[3][4] = {
        {0.05f, 0.45f, 0.1f, 0.18f}, {0.6f, 0.3f, 0.0f, 0.18f}, {0.55f, 0.03f, 0.03f, 0.18f}};

    over_the_frame(s, GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    for (uint32_t r = 0; r < s->plan->record_count; r++)
        gn_gles_draw_volumes(s->gles, s->plan, r, 1, colors[s->plan->records[r].mcguire_case - 1]);
    done(s);
}

/* The edges of one caster as the light sees it, as lines; returns how many. */
static size_t collect_edges(stage *s, const gn_object *object, const gn_light *light)
{
    const gn_mesh *mesh = object->mesh;
    const gn_mesh_info *info = gn_mesh_get_info(mesh);
    const size_t most = 3 * (size_t)info->triangle_count;
    gn_edge *edges = s->scratch;
    float *ends = (float *)(void *)(edges + most);
    size_t count = 0;

    gn_object_casting(object, light, s->facing);
    if (gn_silhouette(mesh, s->facing, edges, most, &count) != GN_OK)
        return 0;
    for (size_t e = 0; e < count; e++) {
        memcpy(ends + 6 * e, info->positions + 3 * (size_t)edges[e].a, 3 * sizeof(float));
        memcpy(ends + 6 * e + 3, info->positions + 3 * (size_t)edges[e].b, 3 * sizeof(float));
    }
    s->gl->glBindBuffer(GL_ARRAY_BUFFER, s->picked);
    s->gl->glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(count * 6 * sizeof(float)), ends, GL_STREAM_DRAW);
    return count;
}

void stage_show_silhouettes(stage *s)
{
    static const float colors[4][4] = {{1, 0.55f, 0, 1}, {0.1f, 0.9f, 1, 1}, {1, 0.1f, 0.7f, 1}, {0.6f, 1, 0.1f, 1}};
    const stage_program *p = stage_use_lines(s);
    const gn_gl *gl = s->gl;

    if (!p)
        return;
    over_the_frame(s, GL_ONE, GL_ZERO);
    gl->glDepthFunc(GL_LEQUAL);
    gl->glEnableVertexAttribArray(0);
    for (uint32_t r = 0; r < s->plan->record_count; r++) {
        const gn_record *record = &s->plan->records[r];
        const gn_plan_object *object = &s->plan->objects[record->object];
        size_t count;

        if (record->chunk != 0)
            continue;
        count = collect_edges(s, &s->objects[record->object], &s->planned[record->light]);
        gl->glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 3 * sizeof(float), NULL);
        gl->glUniformMatrix4fv(p->clip, 1, GL_FALSE, object->matrix);
        gl->glUniform4fv(p->flat, 1, colors[record->light % 4]);
        gl->glDrawArrays(GL_LINES, 0, (GLsizei)(2 * count));
    }
    gl->glDisableVertexAttribArray(0);
    gl->glBindBuffer(GL_ARRAY_BUFFER, 0);
    gl->glUseProgram(0);
    done(s);
}

static void add_fragments(stage *s, uint32_t first, uint32_t count)
{
    static const float one[4] = {1.0f / 255.0f, 0, 0, 0};

    s->gl->glClearColor(0, 0, 0, 0);
    s->gl->glClear(GL_COLOR_BUFFER_BIT);
    gn_gles_draw_volumes(s->gles, s->plan, first, count, one);
}

void stage_draw_layers(stage *s)
{
    static const float one[4] = {0, 1.0f / 255.0f, 0, 0};
    const stage_look look = {.flat = one, .receivers = -1, .facing_light = -1};

    over_the_frame(s, GL_ONE, GL_ONE);
    s->gl->glDisable(GL_DEPTH_TEST);
    s->gl->glDisable(GL_DITHER);
    add_fragments(s, 0, s->plan->record_count);
    stage_draw_objects(s, STAGE_PASS_SOLID, &look);
    s->gl->glEnable(GL_DITHER);
    done(s);
}

/* Adds up the red of records first .. first + count - 1; where some pixel is full, each half is counted by itself. */
static uint64_t count_records(stage *s, uint32_t first, uint32_t count, uint8_t *pixels)
{
    const size_t size = (size_t)s->target.width * s->target.height;
    uint64_t sum = 0;
    uint8_t most = 0;

    add_fragments(s, first, count);
    s->gl->glReadPixels(0, 0, (GLsizei)s->target.width, (GLsizei)s->target.height, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
    for (size_t i = 0; i < size; i++) {
        sum += pixels[4 * i];
        most = pixels[4 * i] > most ? pixels[4 * i] : most;
    }
    if (most == 255 && count > 1)
        return count_records(s, first, count / 2, pixels) +
               count_records(s, first + count / 2, count - count / 2, pixels);
    return sum;
}

int stage_count_fragments(stage *s, uint64_t *rasterised, uint64_t *passed)
{
    uint8_t *pixels = malloc(4 * (size_t)s->target.width * s->target.height);

    if (!pixels)
        return 0;
    s->gl->glDisable(GL_DITHER);
    over_the_frame(s, GL_ONE, GL_ONE);
    *passed = count_records(s, 0, s->plan->record_count, pixels);
    s->gl->glDepthFunc(GL_ALWAYS);
    *rasterised = count_records(s, 0, s->plan->record_count, pixels);
    s->gl->glEnable(GL_DITHER);
    done(s);
    free(pixels);
    return s->gl->glGetError() == GL_NO_ERROR;
}
