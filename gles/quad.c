/* quad.c - a quad over the target, or the part of it that a light reaches. */
#include "gni_gles.h"

void gni_bound(gni_state *s, const gn_plan *plan, const gn_plan_light *l, const uint32_t scissor[4])
{
    if (scissor[2] < plan->viewport[0] || scissor[3] < plan->viewport[1])
        s->scissor = scissor;
    if (l->depth_bounds[0] > 0.0 || l->depth_bounds[1] < 1.0)
        s->bounds = l->depth_bounds;
}

static void set_quad_state(gn_gles *g, const gn_step *step, gni_state *state)
{
    if (GNI_HAS_CULLING && step->light != GN_NO_LIGHT)
        gni_bound(state, g->plan, &g->plan->lights[step->light], g->plan->lights[step->light].scissor);
    state->bounds = NULL; /* what depth the pixels have does not matter */
    gni_set_state(g, state);
}

static void draw(gn_gles *g)
{
    const gn_gl *gl = &g->gl;

    gl->glBindBuffer(GL_ARRAY_BUFFER, g->quad);
    gl->glVertexAttribPointer(0, 4, GL_FLOAT, GL_FALSE, 4 * sizeof(float), NULL);
    gl->glDrawArrays(GL_TRIANGLES, GNI_QUAD, 6);
}

void gni_fill_quad(gn_gles *g, const gn_step *step, gni_state state, const float color[4])
{
    static const float identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    const gni_program *const program = GNI_HAS_FALLBACK && color ? &g->colored : &g->counted;

    set_quad_state(g, step, &state);
    gni_begin_volumes(g, program);
    g->gl.glUniformMatrix4fv(program->near_matrix, 1, GL_FALSE, identity);
    if (GNI_HAS_FALLBACK && color)
        g->gl.glUniform4fv(program->color, 1, color);
    draw(g);
    gni_end_volumes(g);
}

void gni_use_reader(gn_gles *g, const gni_reader *reader, GLuint texture)
{
    const gn_gl *gl = &g->gl;

    gl->glUseProgram(reader->name);
    gl->glActiveTexture(GL_TEXTURE0);
    gl->glBindTexture(GL_TEXTURE_2D, texture);
    gl->glUniform1i(reader->texture, 0);
}

void gni_draw_reader(gn_gles *g, const gn_step *step, gni_state state)
{
    set_quad_state(g, step, &state);
    g->gl.glEnableVertexAttribArray(0);
    draw(g);
    gni_end_volumes(g);
}
