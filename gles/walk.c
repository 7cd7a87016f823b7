/* walk.c - walks a plan: decides nothing, does each step as data says, and stops where the host is to draw.
 *
 * Counting (Everitt 2002, section 3.3): a volume's surface faces outward. z-fail counts what lies behind the visible
 * surface, back faces up and front faces down; z-pass what lies before it, the other way round. Depth is compared LESS:
 * a light cap that is the visible surface itself counts as behind it, and that is why a surface is unlit on the side
 * turned away from the light and lit on the other. Where stencil is two-sided one draw counts both ways, else two draws
 * do, a side each. Wrapping keeps their order from mattering; counts that stop at the ends start in the middle (the
 * light's layout says where and how far they reach). The flag above them, of what earlier batches counted, needs no
 * mask: what is borrowed from it on the way comes back, since the sum is within the bits below.
 *
 * Volumes are moved away from the eye by one step of the depth buffer. Beside a silhouette edge a side, or the other
 * face of a fold, lies less than a step behind the visible surface, and interpolation may put it before: the cap
 * that shares the edge is then counted and the side is not. One step back, what is behind stays behind; the visible
 * cap counts as behind as it did; and receivers move by less than depth can tell. With no offset 2 certain pixels
 * of the test scenes are wrong by either method on llvmpipe, with it none (make truth). */
#include "gni_gles.h"

static const gni_state ambient = {.color_write = GL_TRUE, .depth_write = GL_TRUE, .depth_func = GL_LESS};
static const gni_state light = {
    .color_write = GL_TRUE, .depth_func = GL_EQUAL, .blend_source = GL_ONE, .blend_destination = GL_ONE};
static const gni_state final = {.color_write = GL_TRUE,
                                .depth_func = GL_LESS,
                                .blend_source = GL_SRC_ALPHA,
                                .blend_destination = GL_ONE_MINUS_SRC_ALPHA};
static const gni_state unmasked = {.color_write = GL_TRUE, .depth_write = GL_TRUE, .stencil_write = ~0u};

/* Nothing outside a light's bounds is lit: its passes stay in its scissor or in one within, and where the driver can
 * within its depths. */
static void bound(gni_state *s, const gn_plan *plan, const gn_plan_light *l, const uint32_t scissor[4])
{
    if (scissor[2] < plan->target.width || scissor[3] < plan->target.height)
        s->scissor = scissor;
    if (l->depth_bounds[0] > 0.0 || l->depth_bounds[1] < 1.0)
        s->bounds = l->depth_bounds;
}

static gni_state light_under_mask(const gn_plan *plan, const gn_plan_light *l)
{
    static const gni_face lit_once = {0, GL_INCR};
    gni_state s = light;

    s.stencil_func = GL_EQUAL;
    s.stencil_reference = l->stencil.reference;
    s.stencil_mask = (GLuint)l->stencil.mask;
    if (plan->blend_once) {
        s.stencil_write = (GLuint)l->stencil.mask;
        s.front = s.back = lit_once;
    }
    return s;
}

/* The quad that makes every count the reference again; names of patches stay. */
static gni_state reset(const gn_stencil_layout *layout)
{
    static const gni_face replace = {GL_REPLACE, GL_REPLACE};
    const gni_state s = {.stencil_write = layout->patch_bits ? (GLuint)layout->mask : ~0u,
                         .stencil_func = GL_ALWAYS,
                         .stencil_reference = layout->reference,
                         .stencil_mask = ~0u,
                         .front = replace,
                         .back = replace};

    return s;
}

/* The quad that folds a batch: where the count is not the reference it becomes the reference, and the flag is set. */
static gni_state fold(const gn_stencil_layout *layout)
{
    gni_state s = reset(layout);

    s.stencil_func = GL_NOTEQUAL;
    s.stencil_reference = layout->flag | layout->reference;
    s.stencil_mask = (1u << layout->bits) - 1u;
    return s;
}

static GLint name_of(const gn_stencil_layout *layout, uint32_t patch)
{
    return (GLint)(patch << layout->bits);
}

/* The bits above the count. */
static GLuint name_mask(const gn_stencil_layout *layout)
{
    return ((1u << layout->patch_bits) - 1u) << layout->bits;
}

/* The quad that counts once all that is seen of a patch. */
static gni_state darken(const gn_stencil_layout *layout, uint32_t patch)
{
    gni_state s = reset(layout);

    s.stencil_func = GL_EQUAL;
    s.stencil_reference = name_of(layout, patch) | 1;
    s.stencil_mask = name_mask(layout);
    return s;
}

/* A patch's own triangles, where they are what is seen: by the one statement of positions their depths are the same. */
static gni_state mark(const gn_stencil_layout *layout, uint32_t patch)
{
    static const gni_face replace = {0, GL_REPLACE};
    const gni_state s = {.stencil_write = name_mask(layout),
                         .depth_func = GL_EQUAL,
                         .stencil_func = GL_ALWAYS,
                         .stencil_reference = name_of(layout, patch),
                         .stencil_mask = ~0u,
                         .front = replace,
                         .back = replace};

    return s;
}

/* Which faces a draw counts: both at once where stencil is two-sided, else those that count up, then the others. */
typedef enum half { BOTH, RISING, FALLING } half;

/* Fronts count as backs where the object is mirrored or the triangles are turned caps, not both. */
static int is_swapped(const gn_record *r, int turned)
{
    return r->mirrored ^ turned;
}

static int is_zfail(const gn_record *r)
{
    return r->mcguire_case > 1;
}

/* Whether backs count up. The end of a volume on a patch is seen from inside. */
static int backs_rise(const gn_record *r, int turned)
{
    return (is_zfail(r) || r->patch) != is_swapped(r, turned);
}

/* One side at a time: whether this half is the back faces. */
static int shows_backs(const gn_record *r, int turned, half h)
{
    return (h == RISING) == backs_rise(r, turned);
}

static gni_state counting(const gn_plan *plan, const gn_record *r, int turned, half h)
{
    const gn_stencil_layout *layout = &plan->lights[r->light].stencil;
    const int zfail = is_zfail(r);
    const GLenum up = layout->wrap ? GL_INCR_WRAP : GL_INCR, down = layout->wrap ? GL_DECR_WRAP : GL_DECR;
    const gni_face rise = {zfail ? up : 0, zfail ? 0 : up}, fall = {zfail ? down : 0, zfail ? 0 : down};
    gni_state s = {.stencil_write = layout->patch_bits ? (GLuint)layout->mask : ~0u,
                   .depth_func = GL_LESS,
                   .stencil_func = GL_ALWAYS,
                   .stencil_reference = layout->reference,
                   .stencil_mask = ~0u,
                   .offset = 1,
                   .clamp = r->far_end == GN_FAR_CLAMPED};

    if (r->patch) {
        s.depth_func = 0;
        s.offset = 0;
        s.stencil_func = GL_EQUAL;
        s.stencil_reference = name_of(layout, r->patch);
        s.stencil_mask = name_mask(layout);
    }
    if (r->unpatched) {
        s.stencil_func = GL_EQUAL;
        s.stencil_reference = 0;
        s.stencil_mask = name_mask(layout);
    }
    if (h == BOTH) {
        s.front = backs_rise(r, turned) ? fall : rise;
        s.back = backs_rise(r, turned) ? rise : fall;
    } else {
        s.front = s.back = h == RISING ? rise : fall;
        if (!layout->discard)
            s.cull = shows_backs(r, turned, h) ? GL_FRONT : GL_BACK;
    }
    bound(&s, plan, &plan->lights[r->light], r->scissor);
    if (r->patch)
        s.bounds = NULL; /* of depths that are not tested */
    return s;
}

/* 0 with a message. */
static int is_uploaded(gn_gles *g, const gn_plan *plan, uint32_t object)
{
    const gn_mesh *mesh = plan->objects[object].mesh;
    const gni_upload *upload = gni_find_upload(g, mesh);

    if (upload && upload->shape == gn_mesh_get_info(mesh)->shape)
        return 1;
    gn_fail(g->context, GN_E_ARG,
            upload ? "gn_gles_begin: the mesh of object %lu was not uploaded since its update"
                   : "gn_gles_begin: the mesh of object %lu was not uploaded",
            (unsigned long)object);
    return 0;
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

    if (!g || !plan)
        return gn_fail(g ? g->context : NULL, GN_E_ARG, "gn_gles_begin: NULL argument");
    if (g->forgotten)
        return gn_fail(g->context, GN_E_ARG, "gn_gles_begin: the GL context was lost");
    for (uint32_t i = 0; i < plan->record_count; i++) {
        if (!is_uploaded(g, plan, plan->records[i].object))
            return GN_E_ARG;
        may_switch |= plan->records[i].far_end == GN_FAR_CLAMPED ? GNI_SWITCH_CLAMP : 0u;
    }
    for (uint32_t i = 0; i < plan->object_count; i++)
        if (plan->objects[i].patch && !is_uploaded(g, plan, i))
            return GN_E_ARG;
    for (uint32_t i = 0; i < plan->light_count; i++) {
        const gn_plan_light *l = &plan->lights[i];

        if (l->skip == GN_SKIP_NOT && (l->depth_bounds[0] > 0.0 || l->depth_bounds[1] < 1.0))
            may_switch |= GNI_SWITCH_BOUNDS;
        discards |= l->stencil.discard;
    }
    if (discards && !g->sided.name &&
        !gni_make_flat_program(g, &g->sided, "one side of volumes", "#define COUNTED\n#define SIDED\n"))
        return gn_fail(g->context, GN_E_DEVICE, "gn_gles_begin: the GL refuses the shader that discards: see the log");
    g->plan = plan;
    g->may_switch = may_switch;
    g->at = 0;
    if (plan->index_count) {
        g->gl.glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, g->indices);
        g->gl.glBufferData(GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)(plan->index_count * sizeof(uint16_t)), plan->indices,
                           GL_STREAM_DRAW);
        g->gl.glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, 0);
    }
    if (plan->cache_id)
        send_cached(g, plan);
    return GN_OK;
}

static void clear(gn_gles *g)
{
    gni_set_state(g, &unmasked);
    g->gl.glClearDepthf((GLfloat)g->plan->clear_depth);
    g->gl.glClearStencil(g->plan->light_count ? g->plan->lights[0].stencil.reference : 0);
    g->gl.glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
}

/* A quad over the target, or the light's part of it. */
static void draw_quad(gn_gles *g, const gn_step *step, gni_state state)
{
    static const float identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    const gn_gl *gl = &g->gl;

    bound(&state, g->plan, &g->plan->lights[step->light], g->plan->lights[step->light].scissor);
    state.bounds = NULL; /* what depth the pixels have does not matter */
    gni_set_state(g, &state);
    gni_begin_volumes(g, &g->counted);
    gl->glBindBuffer(GL_ARRAY_BUFFER, g->quad);
    gl->glVertexAttribPointer(0, 4, GL_FLOAT, GL_FALSE, 4 * sizeof(float), NULL);
    gl->glUniformMatrix4fv(g->counted.near_matrix, 1, GL_FALSE, identity);
    gl->glDrawArrays(GL_TRIANGLES, 0, 6);
    gni_end_volumes(g);
}

/* Patches, once for all lights that use them. */
static void mark_patches(gn_gles *g, const gn_step *step)
{
    const gn_plan *plan = g->plan;

    gni_begin_volumes(g, &g->counted);
    for (uint32_t i = 0; i < plan->object_count; i++)
        if (plan->objects[i].patch) {
            const gni_state state = mark(&plan->lights[step->light].stencil, plan->objects[i].patch);

            gni_set_state(g, &state);
            gni_draw_surface(g, &plan->objects[i]);
        }
    gni_end_volumes(g);
}

static void count_records(gn_gles *g, uint32_t first, uint32_t end, half h)
{
    for (uint32_t i = first; i < end; i++)
        for (int turned = 0; turned < 2; turned++) {
            const gn_record *r = &g->plan->records[i];
            gni_state state;

            if (turned && !r->turned_cap_count)
                continue;
            state = counting(g->plan, r, turned, h);
            gni_set_state(g, &state);
            if (g->plan->lights[r->light].stencil.discard)
                g->gl.glUniform1f(g->sided.side, shows_backs(r, turned, h) ? -1.0f : 1.0f);
            gni_draw_record(g, g->plan, r, turned);
        }
}

/* One-sided, a caster at a time: up first, so that counts which stop at the ends stray by one caster's layers only. */
static void count_volumes(gn_gles *g, const gn_step *step)
{
    const gn_plan *plan = g->plan;
    const gn_stencil_layout *layout = &plan->lights[step->light].stencil;
    const uint32_t end = step->first_record + step->record_count;

    gni_begin_volumes(g, layout->discard ? &g->sided : &g->counted);
    for (uint32_t i = step->first_record, next; i < end; i = next) {
        for (next = i + 1; next < end && plan->records[next].object == plan->records[i].object;)
            next++;
        if (layout->two_sided) {
            count_records(g, i, next, BOTH);
        } else {
            count_records(g, i, next, RISING);
            count_records(g, i, next, FALLING);
        }
    }
    gni_end_volumes(g);
}

static gni_state state_for(const gn_plan *plan, const gn_step *step)
{
    gni_state s;

    switch (step->draw) {
    case GN_DRAW_AMBIENT:
        return ambient;
    case GN_DRAW_LIGHT:
        s = step->receivers || plan->blend_once ? light_under_mask(plan, &plan->lights[step->light]) : light;
        bound(&s, plan, &plan->lights[step->light], plan->lights[step->light].scissor);
        return s;
    default:
        return final;
    }
}

int gn_gles_next(gn_gles *g, gn_step *out)
{
    if (!g || !g->plan || g->forgotten)
        return 0;
    gni_reset_state(g);
    g->gl.glViewport(0, 0, (GLsizei)g->plan->target.width, (GLsizei)g->plan->target.height);
    while (g->at < g->plan->step_count) {
        const gn_step *step = &g->plan->steps[g->at++];
        gni_state state;

        switch (step->kind) {
        case GN_STEP_CLEAR:
            clear(g);
            break;
        case GN_STEP_ZERO:
            draw_quad(g, step, reset(&g->plan->lights[step->light].stencil));
            break;
        case GN_STEP_FOLD:
            draw_quad(g, step, fold(&g->plan->lights[step->light].stencil));
            break;
        case GN_STEP_MARK:
            mark_patches(g, step);
            break;
        case GN_STEP_DARKEN:
            draw_quad(g, step, darken(&g->plan->lights[step->light].stencil, step->patch));
            break;
        case GN_STEP_VOLUMES:
            count_volumes(g, step);
            break;
        case GN_STEP_DRAW:
            state = state_for(g->plan, step);
            gni_set_state(g, &state);
            g->gl.glUseProgram(0);
            g->gl.glBindBuffer(GL_ARRAY_BUFFER, 0);
            g->gl.glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, 0);
            *out = *step;
            return 1;
        }
    }
    gni_leave_state(g);
    g->gl.glScissor(0, 0, (GLsizei)g->plan->target.width, (GLsizei)g->plan->target.height);
    if (g->may_switch & GNI_SWITCH_BOUNDS)
        g->gl.glDepthBoundsEXT(0.0, 1.0);
    g->plan = NULL;
    g->may_switch = 0;
    return 0;
}
