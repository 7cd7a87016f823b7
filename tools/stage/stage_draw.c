/* stage_draw.c - draws the scene's objects in one of several looks, with whatever masks and tests the library has set.
 *
 * An object's triangles are drawn in the same order of vertices in every pass, from the same buffer, with the same
 * matrix: their depths are the same to the last bit. */
#include "stage.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "gn_matrix.h"

#define AMBIENT 0.1f

static void set_lights(stage *s, const stage_program *p, const stage_look *look)
{
    const uint32_t count = look->light_count;
    float position[STAGE_LIGHTS][4], color[STAGE_LIGHTS][3], axis[STAGE_LIGHTS][4], cone[STAGE_LIGHTS][2];

    for (uint32_t i = 0; i < count; i++) {
        const uint32_t number = look->first_light + (look->picked ? look->picked[i] : i);
        const stage_light *l = &s->shading[look->picked && s->member_count ? s->members[number] : number];

        memcpy(position[i], l->shader_position, sizeof position[i]);
        memcpy(color[i], l->color, sizeof color[i]);
        memcpy(axis[i], l->axis, sizeof axis[i]);
        memcpy(cone[i], l->cone, sizeof cone[i]);
    }
    s->gl->glUniform4fv(p->light_position, (GLsizei)count, position[0]);
    s->gl->glUniform3fv(p->light_color, (GLsizei)count, color[0]);
    s->gl->glUniform4fv(p->light_axis, (GLsizei)count, axis[0]);
    s->gl->glUniform2fv(p->light_cone, (GLsizei)count, cone[0]);
}

static void set_material(stage *s, const stage_program *p, const scene_material *m, const stage_look *look)
{
    const gn_gl *gl = s->gl;
    const float base[4] = {(float)m->base_color[0], (float)m->base_color[1], (float)m->base_color[2],
                           (float)m->base_color[3]};
    const float emissive[3] = {(float)m->emissive[0], (float)m->emissive[1], (float)m->emissive[2]};
    const float ambient[3] = {look->ambient ? AMBIENT : 0.0f, look->ambient ? AMBIENT : 0.0f,
                              look->ambient ? AMBIENT : 0.0f};
    const float roughness = (float)fmax(m->roughness, 0.1), gloss = 1.0f - roughness;
    const float specular[3] = {gloss, gloss, gloss}; /* what is rough spreads its highlight until none is seen */

    gl->glUniform4fv(p->base, 1, base);
    gl->glUniform3fv(p->emissive, 1, emissive);
    gl->glUniform3fv(p->ambient, 1, ambient);
    gl->glUniform1f(p->emits, look->ambient ? 1.0f : 0.0f);
    gl->glUniform1f(p->cutoff, (float)m->alpha_cutoff);
    gl->glUniform1f(p->shininess, fmaxf(2.0f / (roughness * roughness * roughness * roughness) - 2.0f, 1.0f));
    gl->glUniform3fv(p->specular, 1, specular);
    gl->glUniform1f(p->metallic, (float)m->metallic);
    gl->glUniform1f(p->two_sided, m->double_sided ? 1.0f : 0.0f);
    if (look->flat)
        gl->glUniform4fv(p->flat, 1, look->flat);
    if (look->carries_depth || look->mask) {
        const float size[2] = {(float)s->plan->mask_size[0], (float)s->plan->mask_size[1]};
        const float depth[2] = {(float)s->plan->mask_depth[0], (float)s->plan->mask_depth[1]};

        gl->glUniform2fv(p->mask_size, 1, size);
        gl->glUniform2fv(p->mask_depth, 1, depth);
        gl->glUniform1f(p->mask_sharpness, (float)s->plan->scale);
    }
    if (look->mask) {
        float channels[4] = {0, 0, 0, 0};

        channels[look->channel] = 1.0f;
        gl->glActiveTexture(GL_TEXTURE1);
        gl->glBindTexture(GL_TEXTURE_2D, look->mask);
        gl->glUniform1i(p->mask, 1);
        if (look->flat)
            gl->glUniform4fv(p->channels, 1, channels);
    }
    if (m->texture != SCENE_NONE) {
        gl->glActiveTexture(GL_TEXTURE0);
        gl->glBindTexture(GL_TEXTURE_2D, s->textures[m->texture]);
        gl->glUniform1i(p->texture, 0);
    }
}

/* World space from the eye, and normals: the inverse transposed, by cofactors, so that a flattened object has some
 * too. */
static void set_object(stage *s, const stage_program *p, const scene_instance *instance, const gn_plan_object *object)
{
    const float *centre = gn_mesh_get_info(object->mesh)->centre;
    const double c[3] = {(double)centre[0], (double)centre[1], (double)centre[2]}, *m = instance->world;
    const double sign = gn_mat4_determinant3(m) < 0.0 ? -1.0 : 1.0;
    double world[16], origin[3];
    float to_world[16], normal[9];

    memcpy(world, m, sizeof world);
    gn_mat4_transform(origin, m, c, 1.0);
    for (int i = 0; i < 3; i++)
        world[12 + i] = origin[i] - s->scene->camera.world[12 + i];
    gn_mat4_to_float(to_world, world);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;

            normal[3 * i + j] = (float)(sign * (m[4 * i1 + j1] * m[4 * i2 + j2] - m[4 * i2 + j1] * m[4 * i1 + j2]));
        }
    s->gl->glUniformMatrix4fv(p->clip, 1, GL_FALSE, object->matrix);
    s->gl->glUniformMatrix4fv(p->world, 1, GL_FALSE, to_world);
    s->gl->glUniformMatrix3fv(p->normal, 1, GL_FALSE, normal);
}

static void point_at(const gn_gl *gl, const stage_mesh *m, const stage_batch *batch)
{
    static const GLint sizes[4] = {3, 3, 2, 4};
    size_t offset = batch->first_vertex * 12 * sizeof(float);

    gl->glBindBuffer(GL_ARRAY_BUFFER, m->vertices);
    for (GLuint i = 0; i < 4; i++) {
        gl->glVertexAttribPointer(i, sizes[i], GL_FLOAT, GL_FALSE, 12 * sizeof(float), (const void *)(uintptr_t)offset);
        gl->glEnableVertexAttribArray(i);
        offset += (size_t)sizes[i] * sizeof(float);
    }
}

/* The triangles of a batch whose front (side 1) or back (-1) looks at the light. */
static void draw_facing(stage *s, const stage_mesh *m, const stage_batch *batch, int side)
{
    uint16_t *picked = s->scratch;
    size_t count = 0;

    for (uint32_t t = 0; t < batch->triangle_count; t++)
        if (s->facing[batch->first_triangle + t] == side) {
            memcpy(picked + count, m->index_copy + batch->first_index + 3 * (size_t)t, 3 * sizeof *picked);
            count += 3;
        }
    if (!count)
        return;
    s->gl->glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, s->picked);
    s->gl->glBufferData(GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)(count * sizeof *picked), picked, GL_STREAM_DRAW);
    s->gl->glCullFace(side > 0 ? GL_BACK : GL_FRONT);
    s->gl->glEnable(GL_CULL_FACE);
    s->gl->glDrawElements(GL_TRIANGLES, (GLsizei)count, GL_UNSIGNED_SHORT, NULL);
}

static void draw_batch(stage *s, const stage_mesh *m, const stage_batch *batch, const scene_material *material,
                       unsigned flags, const stage_look *look)
{
    const gn_gl *gl = s->gl;

    point_at(gl, m, batch);
    if (look->facing_light >= 0) {
        draw_facing(s, m, batch, 1);
        if (material->double_sided)
            draw_facing(s, m, batch, -1);
        return;
    }
    if (material->double_sided)
        gl->glDisable(GL_CULL_FACE);
    else
        gl->glEnable(GL_CULL_FACE);
    gl->glCullFace(GL_BACK);
    gl->glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, m->indices);
    gl->glDrawElements(GL_TRIANGLES, (GLsizei)(3 * batch->triangle_count), GL_UNSIGNED_SHORT,
                       (const void *)(uintptr_t)(batch->first_index * sizeof(uint16_t)));
    if (!look->backs || material->double_sided || !(flags & GN_DRAWN_BACKS))
        return;
    gl->glCullFace(GL_FRONT); /* fronts win where both have the same depth */
    gl->glDrawElements(GL_TRIANGLES, (GLsizei)(3 * batch->triangle_count), GL_UNSIGNED_SHORT,
                       (const void *)(uintptr_t)(batch->first_index * sizeof(uint16_t)));
}

static void draw_object(stage *s, size_t index, stage_pass pass, const stage_look *look)
{
    const scene_instance *instance = &s->scene->instances[index];
    const stage_mesh *m = &s->meshes[instance->mesh];
    const size_t drawn = stage_drawn_object(s, index);
    const gn_plan_object *object = &s->plan->objects[drawn];

    if (look->facing_light >= 0)
        gn_object_facing(&s->objects[drawn], &s->lights[look->facing_light], s->facing);
    s->gl->glFrontFace(object->mirrored ? GL_CW : GL_CCW);
    for (size_t b = 0; b < m->batch_count; b++) {
        const scene_material *material = &s->scene->materials[m->batches[b].material];
        const unsigned kind =
            (material->texture != SCENE_NONE ? STAGE_TEXTURED : 0u) | (material->alpha == SCENE_MASK ? STAGE_CUT : 0u) |
            (look->flat ? STAGE_FLAT : 0u) | (look->mask ? STAGE_MASKED : 0u) |
            (look->mask && s->plan->carries_depth ? STAGE_UPSAMPLED : 0u) |
            (look->mask && s->plan->sharpen ? STAGE_SHARPENED : 0u) | (look->carries_depth ? STAGE_DEPTH : 0u) |
            (gn_target_can(&s->target, GN_CAN_FRAGMENT_HIGHP) ? 0u : STAGE_MEDIUMP) |
            (look->flat ? 0u : look->light_count << STAGE_LIGHT_SHIFT);
        const stage_program *p;

        if ((material->alpha == SCENE_BLEND) != (pass == STAGE_PASS_BLEND))
            continue;
        p = stage_use(s, kind);
        if (!p) {
            s->shader_refused = 1;
            continue;
        }
        set_material(s, p, material, look);
        set_object(s, p, instance, object);
        if (!look->flat && look->light_count)
            set_lights(s, p, look);
        draw_batch(s, m, &m->batches[b], material, object->flags, look);
    }
}

static double distance_of(const stage *s, size_t index)
{
    const scene_instance *instance = &s->scene->instances[index];
    const double *eye = s->scene->camera.world + 12, *m = instance->world;

    return (m[12] - eye[0]) * (m[12] - eye[0]) + (m[13] - eye[1]) * (m[13] - eye[1]) +
           (m[14] - eye[2]) * (m[14] - eye[2]);
}

static int is_blended(const stage *s, size_t index)
{
    const scene_mesh *m = &s->scene->meshes[s->scene->instances[index].mesh];

    return m->solid_triangle_count < m->triangle_count;
}

/* The transparent object that comes after `last` from far to near (equal ones in order); count when there is none. */
static size_t next_blended(const stage *s, size_t last)
{
    const size_t count = s->scene->instance_count;
    const double before = last < count ? distance_of(s, last) : INFINITY;
    size_t next = count;

    for (size_t i = 0; i < count; i++) {
        double d;

        if (!is_blended(s, i))
            continue;
        d = distance_of(s, i);
        if ((d < before || (last < count && d == before && i > last)) && (next == count || d > distance_of(s, next)))
            next = i;
    }
    return next;
}

/* Transparent objects from far to near, by their origins; each with all its lights before the next. */
static void draw_blended(stage *s, const stage_look *look)
{
    const size_t count = s->scene->instance_count;
    const uint32_t end = look->first_light + look->light_count;

    for (size_t i = next_blended(s, count); i < count; i = next_blended(s, i)) {
        stage_look group = *look;

        s->gl->glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
        do {
            group.light_count = end - group.first_light < s->shader_lights ? end - group.first_light : s->shader_lights;
            draw_object(s, i, STAGE_PASS_BLEND, &group);
            s->gl->glBlendFunc(GL_SRC_ALPHA, GL_ONE);
            group.ambient = 0;
            group.first_light += group.light_count;
        } while (group.first_light < end);
    }
    s->gl->glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
}

/* By any of the lights. */
static int is_lit(const stage *s, const stage_look *look, size_t instance)
{
    for (uint32_t i = 0; i < look->picked_count; i++)
        if (s->plan->casters[(size_t)look->picked[i] * s->plan->object_count + stage_drawn_object(s, instance)].is_lit)
            return 1;
    return 0;
}

void stage_draw_objects(stage *s, stage_pass pass, const stage_look *look)
{
    const size_t count = s->scene->instance_count;

    if (pass == STAGE_PASS_BLEND) {
        draw_blended(s, look);
        return;
    }
    for (size_t i = 0; i < count; i++)
        if ((look->receivers < 0 || look->receivers == s->scene->instances[i].receives) &&
            (!look->only_lit || is_lit(s, look, i)))
            draw_object(s, i, pass, look);
}
