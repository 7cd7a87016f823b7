/* walk.c - walks a plan: decides nothing, does each step as data says, and stops where the host is to draw. stencil.c and
 * fallback/ have the library's own steps. */
#include "gni_gles.h"

static const gni_state ambient = {.color_mask = 15, .depth_write = GL_TRUE, .depth_func = GL_LESS};
static const gni_state light = {
    .color_mask = 15, .depth_func = GL_EQUAL, .blend_source = GL_ONE, .blend_destination = GL_ONE};
static const gni_state final = {
    .color_mask = 15, .depth_func = GL_LESS, .blend_source = GL_SRC_ALPHA, .blend_destination = GL_ONE_MINUS_SRC_ALPHA};

/* Depth that is there already is not drawn again: the ambient pass then meets it. */
static int has_depth(const gn_plan *plan)
{
    return GNI_HAS_FALLBACK && plan->mask == GN_MASK_TEXTURE && plan->image.format == GN_FORMAT_NONE &&
           plan->mask_count > 0 && plan->scale == 1 && plan->mask_age == 0;
}

/* By the target's alpha, which stays; or becomes 0 where something is lit, so that nothing else is. */
static gni_state light_under_alpha(const gn_plan *plan)
{
    gni_state s = light;

    s.blend_source = GL_DST_ALPHA;
    s.color_mask = plan->blend_once ? 15 : 7;
    s.alpha_source = GNI_ZERO;
    s.alpha_destination = plan->blend_once ? GNI_ZERO : GL_ONE;
    return s;
}

/* 0 with a message. */
static int is_uploaded(gn_gles *g, const gn_plan *plan, uint32_t object)
{
    const gn_mesh *mesh = plan->objects[object].mesh;
    const gni_upload *upload = gni_find_upload(g, mesh);

    if (upload && upload->shape == gn_mesh_get_info(mesh)->shape)
        return 1;
    (void)gn_fail(g->context, GN_E_ARG,
                  upload ? "gn_gles_begin: the mesh of object %lu was not uploaded since its update"
                         : "gn_gles_begin: the mesh of object %lu was not uploaded",
                  (unsigned long)object);
    return 0;
}

void gni_set_viewport(gn_gles *g)
{
    const uint32_t *size = g->into == GN_INTO_TARGET ? g->plan->viewport : g->plan->mask_size;

    g->gl.glViewport(0, 0, (GLsizei)size[0], (GLsizei)size[1]);
}

/* What has changed in the plan's cache since it was sent last: mostly nothing. */
static void send_cached(gn_gles *g, const gn_plan *plan)
{
    const gn_gl *gl = &g->gl;
    const int is_known = g->cache_id == plan->cache_id && g->cached_capacity == plan->cached_capacity;
    uint32_t first = 0, end = plan->cached_index_count;

    if (plan->cached_capacity == 0 || (is_known && g->cache_version == plan->cache_version))
        return;
    gl->glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, g->cached);
    if (!is_known)
        gl->glBufferData(GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)(plan->cached_capacity * sizeof(uint16_t)), NULL,
                         GL_DYNAMIC_DRAW);
    if (is_known && g->cache_version == plan->cache_base) {
        first = plan->cache_changed[0];
        end = plan->cache_changed[1];
    }
    if (end > first)
        gl->glBufferSubData(GL_ELEMENT_ARRAY_BUFFER, (GLintptr)(first * sizeof(uint16_t)),
                            (GLsizeiptr)((end - first) * sizeof(uint16_t)), plan->cached_indices + first);
    gl->glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, 0);
    g->cache_id = plan->cache_id;
    g->cache_version = plan->cache_version;
    g->cached_capacity = plan->cached_capacity;
}

gn_result gn_gles_begin(gn_gles *g, const gn_plan *plan)
{
    unsigned may_switch = 0;
    int discards = 0;
    gn_result result;

    if (!g || !plan)
        return gn_fail(g ? g->context : NULL, GN_E_ARG, "gn_gles_begin: NULL argument");
    if (g->forgotten)
        return gn_fail(g->context, GN_E_ARG, "gn_gles_begin: the GL context was lost");
    for (uint32_t i = 0; i < plan->record_count; i++) {
        if (!is_uploaded(g, plan, plan->records[i].object))
            return GN_E_ARG;
        if (GNI_HAS_CULLING)
            may_switch |= plan->records[i].far_end == GN_FAR_CLAMPED ? GNI_SWITCH_CLAMP : 0u;
    }
    for (uint32_t i = 0; GNI_HAS_CULLING && i < plan->object_count; i++)
        if ((plan->objects[i].patch || plan->objects[i].thin) && !is_uploaded(g, plan, i))
            return GN_E_ARG;
    for (uint32_t i = 0; i < plan->light_count; i++) {
        const gn_plan_light *l = &plan->lights[i];

        if (GNI_HAS_CULLING && l->skip == GN_SKIP_NOT && (l->depth_bounds[0] > 0.0 || l->depth_bounds[1] < 1.0))
            may_switch |= GNI_SWITCH_BOUNDS;
        discards |= l->stencil.discard;
    }
    if (GNI_HAS_FALLBACK && (plan->mask != GN_MASK_STENCIL || plan->carries_depth))
        may_switch |= GNI_SWITCH_DITHER;
    if (GNI_HAS_FALLBACK && discards && !g->sided.name &&
        !gni_make_flat_program(g, &g->sided, "one side of volumes", "#define COUNTED\n#define SIDED\n"))
        return gn_fail(g->context, GN_E_DEVICE, "gn_gles_begin: the GL refuses the shader that discards: see the log");
    if (GNI_HAS_FALLBACK && !gni_make_color_programs(g, plan))
        return gn_fail(g->context, GN_E_DEVICE, "gn_gles_begin: the GL refuses a shader of %s: see the log",
                       gn_plan_method_name(plan, 0));
    result = GNI_HAS_FALLBACK ? gni_prepare_images(g, plan) : GN_OK;
    if (result != GN_OK)
        return result;
    if (GNI_HAS_CACHE && plan->mask_count > 0 && plan->mask_age == 0)
        g->kept_masks[1] = 0; /* until they are made */
    g->plan = plan;
    g->into = GN_INTO_TARGET;
    g->may_switch = may_switch;
    g->at = 0;
    if (plan->index_count) {
        g->gl.glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, g->indices);
        g->gl.glBufferData(GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)(plan->index_count * sizeof(uint16_t)), plan->indices,
                           GL_STREAM_DRAW);
        g->gl.glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, 0);
    }
    if (GNI_HAS_CACHE && plan->cache_id)
        send_cached(g, plan);
    return GN_OK;
}

/* The stencil too where counts are made in it: elsewhere it is somebody else's, or none. */
static void clear(gn_gles *g)
{
    const int counts_here = !GNI_HAS_FALLBACK || g->plan->mask == GN_MASK_STENCIL;

    gni_set_state(g, &gni_unmasked);
    g->gl.glClearDepthf((GLfloat)g->plan->clear_depth);
    if (counts_here)
        g->gl.glClearStencil(g->plan->light_count ? g->plan->lights[0].stencil.reference : 0);
    g->gl.glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | (counts_here ? GL_STENCIL_BUFFER_BIT : 0u));
}

/* A pass of several lights stays in the box around their scissors. */
static void bound_lights(gn_gles *g, gni_state *s, const gn_step *step)
{
    const gn_plan *plan = g->plan;
    uint32_t *box = g->box, end[2] = {0, 0};

    if (step->light_count == 1) {
        gni_bound(s, plan, &plan->lights[step->light], plan->lights[step->light].scissor);
        return;
    }
    box[0] = box[1] = UINT32_MAX;
    for (uint32_t i = 0; i < step->light_count; i++)
        for (int k = 0; k < 2; k++) {
            const uint32_t *at = plan->lights[step->lights[i]].scissor;

            box[k] = box[k] < at[k] ? box[k] : at[k];
            end[k] = end[k] > at[k] + at[2 + k] ? end[k] : at[k] + at[2 + k];
        }
    box[2] = end[0] - box[0];
    box[3] = end[1] - box[1];
    s->scissor = box;
}

static gni_state state_for(gn_gles *g, const gn_step *step)
{
    const gn_plan *plan = g->plan;
    gni_state s = light;

    switch (step->draw) {
    case GN_DRAW_DEPTH:
        if (!GNI_HAS_FALLBACK)
            return s;
        s = ambient;
        if (!plan->carries_depth)
            s.color_mask = 0;
        else
            s.undithered = 1;
        return s;
    case GN_DRAW_AMBIENT:
    case GN_DRAW_LIT:
        s = ambient;
        if (has_depth(plan) || (step->draw == GN_DRAW_LIT && !step->receivers)) {
            s.depth_func = GL_EQUAL;
            s.depth_write = GL_FALSE;
        }
        return s;
    case GN_DRAW_LIGHT:
        if ((!GNI_HAS_FALLBACK || plan->mask == GN_MASK_STENCIL) && (step->receivers || plan->blend_once))
            s = gni_stencil_light(plan, &plan->lights[step->light], light);
        if (GNI_HAS_FALLBACK && plan->mask == GN_MASK_ALPHA && (step->receivers || plan->blend_once))
            s = light_under_alpha(plan);
        else if (GNI_HAS_FALLBACK && plan->mask == GN_MASK_ALPHA)
            s.color_mask = 7;
        if (GNI_HAS_CULLING)
            bound_lights(g, &s, step);
        return s;
    default:
        return final;
    }
}

static void take_step(gn_gles *g, const gn_step *step)
{
    switch (step->kind) {
    case GN_STEP_CLEAR:
        clear(g);
        break;
    case GN_STEP_CLEAR_COLOR:
        if (!GNI_HAS_FALLBACK)
            break;
        gni_set_state(g, &gni_unmasked);
        g->gl.glClear(GL_COLOR_BUFFER_BIT);
        break;
    case GN_STEP_ZERO:
    case GN_STEP_FOLD:
    case GN_STEP_MARK:
    case GN_STEP_DARKEN:
    case GN_STEP_VOLUMES:
        if (GNI_HAS_FALLBACK && g->plan->lights[step->light].color.place != GN_PLACE_STENCIL)
            gni_color_step(g, step);
        else
            gni_stencil_step(g, step);
        break;
    case GN_STEP_NORMALISE:
    case GN_STEP_OPAQUE:
        if (GNI_HAS_FALLBACK)
            gni_color_step(g, step);
        break;
    default:
        if (GNI_HAS_FALLBACK)
            gni_mask_step(g, step);
    }
}

int gn_gles_next(gn_gles *g, gn_step *out)
{
    if (!g || !g->plan || g->forgotten)
        return 0;
    gni_reset_state(g);
    gni_set_viewport(g);
    while (g->at < g->plan->step_count) {
        const gn_step *step = &g->plan->steps[g->at++];
        gni_state state;

        if (GNI_HAS_FALLBACK)
            gni_bind_for(g, step);
        if (step->kind != GN_STEP_DRAW) {
            take_step(g, step);
            continue;
        }
        state = state_for(g, step);
        gni_set_state(g, &state);
        g->gl.glUseProgram(0);
        g->gl.glBindBuffer(GL_ARRAY_BUFFER, 0);
        g->gl.glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, 0);
        *out = *step;
        return 1;
    }
    gni_leave_state(g);
    g->gl.glScissor(0, 0, (GLsizei)g->plan->target.width, (GLsizei)g->plan->target.height);
    if (GNI_HAS_CULLING && g->may_switch & GNI_SWITCH_BOUNDS)
        g->gl.glDepthBoundsEXT(0.0, 1.0);
    if (GNI_HAS_FALLBACK && g->plan->mask_count > 0) {
        g->gl.glActiveTexture(GL_TEXTURE0);
        g->gl.glBindTexture(GL_TEXTURE_2D, 0);
    }
    if (GNI_HAS_CACHE && g->plan->mask_version && g->plan->mask_age == 0) {
        g->kept_masks[0] = g->plan->cache_id;
        g->kept_masks[1] = g->plan->mask_version;
    }
    g->plan = NULL;
    g->may_switch = 0;
    return 0;
}

uint32_t gn_gles_mask(const gn_gles *g, uint32_t mask)
{
    return GNI_HAS_FALLBACK && g && mask < g->images.mask_count ? g->images.masks[mask] : 0;
}
