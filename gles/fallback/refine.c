/* refine.c - where a small mask is unanimous the stencil takes its word; where it is contested volumes will be counted
 * (core/plan_refine.c). Unanimous pixels have the name 1 in the bit above the count, and a count that says lit or
 * shadow: volumes are counted under the name 0, lights are added by the count alone. */
#include "../gni_gles.h"

#include "shaders/agree.frag.h"
#include "shaders/edges.frag.h"

#include <stdio.h>

int gni_make_refining_programs(gn_gles *g, const char *defines)
{
    char edges[64];

    snprintf(edges, sizeof edges, "%s#define CROSS\n", defines);
    return gni_make_reader(g, &g->edges, "edges", edges, gni_shader_edges_frag) &&
           gni_make_reader(g, &g->agree, "agree", defines, gni_shader_agree_frag);
}

void gni_find_edges(gn_gles *g)
{
    static const gn_step everywhere = {.light = GN_NO_LIGHT};
    const gni_state state = {.color_mask = 15, .undithered = 1};
    const uint32_t *size = g->plan->mask_size;
    const float texel[2] = {1.0f / (float)size[0], 1.0f / (float)size[1]};

    gni_use_reader(g, &g->edges, g->images.masks[0]);
    g->gl.glUniform2fv(g->edges.step, 1, texel);
    gni_draw_reader(g, &everywhere, state);
    g->gl.glBindTexture(GL_TEXTURE_2D, 0);
}

static gni_state writes(GLint value)
{
    static const gni_face replace = {GL_REPLACE, GL_REPLACE};
    const gni_state s = {.stencil_write = ~0u,
                         .stencil_func = GL_ALWAYS,
                         .stencil_reference = value,
                         .stencil_mask = ~0u,
                         .front = replace,
                         .back = replace};

    return s;
}

/* What the mask says with one voice: lit, or not. */
static void take_word(gn_gles *g, const gn_step *step, int lit)
{
    const gn_plan_light *l = &g->plan->lights[step->light];
    float channel[4] = {0, 0, 0, 0};

    channel[l->mask_channel] = 1.0f;
    gni_use_reader(g, &g->agree, g->images.masks[l->mask_texture]);
    g->gl.glUniform4fv(g->agree.weights, 1, channel);
    g->gl.glUniform1f(g->agree.level, lit ? 1.0f : 0.0f);
    gni_draw_reader(g, step, writes(gni_patch_name(&l->stencil, 1) | (l->stencil.reference + !lit)));
    g->gl.glBindTexture(GL_TEXTURE_2D, 0);
}

/* What is seen of thin things: by the one statement of positions their depths are the same. */
static void contest_objects(gn_gles *g, uint32_t light, GLint reference)
{
    static const gni_face seen = {0, GL_REPLACE};
    const gn_plan *plan = g->plan;
    const gn_plan_caster *in_light = plan->casters + (size_t)light * plan->object_count;
    gni_state state = writes(reference);

    state.depth_func = GL_EQUAL;
    state.front = state.back = seen;
    gni_bound(&state, plan, &plan->lights[light], plan->lights[light].scissor);
    gni_set_state(g, &state);
    for (uint32_t i = 0; i < plan->object_count; i++)
        if (plan->objects[i].thin && in_light[i].is_lit)
            gni_draw_surface(g, &plan->objects[i]);
}

/* Where a thin shadow will be counted. */
static void contest_record(gn_gles *g, const gn_record *r, GLint reference)
{
    const gni_face replace = {r->mcguire_case > 1 ? GL_REPLACE : 0, r->mcguire_case > 1 ? 0 : GL_REPLACE};
    gni_state state = writes(reference);

    state.depth_func = GL_LESS;
    state.offset = 1;
    state.clamp = r->far_end == GN_FAR_CLAMPED;
    state.front = state.back = replace;
    gni_bound(&state, g->plan, &g->plan->lights[r->light], r->scissor);
    gni_set_state(g, &state);
    for (int turned = 0; turned < 1 + (r->turned_cap_count > 0); turned++)
        gni_draw_record(g, g->plan, r, turned);
}

void gni_refine_step(gn_gles *g, const gn_step *step)
{
    const gn_plan *plan = g->plan;
    const GLint reference = plan->lights[step->light].stencil.reference;

    gni_fill_quad(g, step, writes(reference), NULL);
    for (int lit = 0; lit < 2; lit++)
        take_word(g, step, lit);
    gni_begin_volumes(g, &g->counted);
    contest_objects(g, step->light, reference);
    for (uint32_t i = 0; i < plan->record_count; i++)
        if (plan->records[i].light == step->light && plan->records[i].thin)
            contest_record(g, &plan->records[i], reference);
    gni_end_volumes(g);
}
