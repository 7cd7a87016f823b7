/* stencil.c - volumes counted in a stencil.
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

gni_state gni_where_count(const gn_plan_light *l, GLenum func)
{
    const gni_state s = {
        .stencil_func = func, .stencil_reference = l->stencil.reference, .stencil_mask = (GLuint)l->stencil.mask};

    return s;
}

gni_state gni_stencil_light(const gn_plan *plan, const gn_plan_light *l, gni_state s)
{
    static const gni_face lit_once = {0, GL_INCR};

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

GLint gni_patch_name(const gn_stencil_layout *layout, uint32_t patch)
{
    return (GLint)(patch << (8 - layout->patch_bits));
}

static GLuint name_mask(const gn_stencil_layout *layout)
{
    return 255u & ~(GLuint)layout->mask;
}

/* The quad that counts once all that is seen of a patch. */
static gni_state darken(const gn_stencil_layout *layout, uint32_t patch)
{
    gni_state s = reset(layout);

    s.stencil_func = GL_EQUAL;
    s.stencil_reference = gni_patch_name(layout, patch) | 1;
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
                         .stencil_reference = gni_patch_name(layout, patch),
                         .stencil_mask = ~0u,
                         .front = replace,
                         .back = replace};

    return s;
}

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
int gni_backs_rise(const gn_record *r, int turned)
{
    return (is_zfail(r) || r->patch) != is_swapped(r, turned);
}

/* One side at a time: whether this half is the back faces. */
int gni_shows_backs(const gn_record *r, int turned, gni_half h)
{
    return (h == GNI_RISING) == gni_backs_rise(r, turned);
}

static gni_state counting(const gn_plan *plan, const gn_record *r, int turned, gni_half h)
{
    const gn_stencil_layout *layout = &plan->lights[r->light].stencil;
    const int zfail = is_zfail(r);
    const GLenum up = !GNI_HAS_FALLBACK || layout->wrap ? GL_INCR_WRAP : GL_INCR,
                 down = !GNI_HAS_FALLBACK || layout->wrap ? GL_DECR_WRAP : GL_DECR;
    const gni_face rise = {zfail ? up : 0, zfail ? 0 : up}, fall = {zfail ? down : 0, zfail ? 0 : down};
    gni_state s = {.stencil_write = layout->patch_bits ? (GLuint)layout->mask : ~0u,
                   .depth_func = GL_LESS,
                   .stencil_func = GL_ALWAYS,
                   .stencil_reference = layout->reference,
                   .stencil_mask = ~0u,
                   .offset = 1,
                   .clamp = r->far_end == GN_FAR_CLAMPED};

    if (GNI_HAS_CULLING && r->patch) {
        s.depth_func = 0;
        s.offset = 0;
        s.stencil_func = GL_EQUAL;
        s.stencil_reference = gni_patch_name(layout, r->patch);
        s.stencil_mask = name_mask(layout);
    }
    if (GNI_HAS_CULLING && r->unpatched) {
        s.stencil_func = GL_EQUAL;
        s.stencil_reference = 0;
        s.stencil_mask = name_mask(layout);
    }
    if (!GNI_HAS_FALLBACK || h == GNI_BOTH) {
        s.front = gni_backs_rise(r, turned) ? fall : rise;
        s.back = gni_backs_rise(r, turned) ? rise : fall;
    } else {
        s.front = s.back = h == GNI_RISING ? rise : fall;
        if (!layout->discard)
            s.cull = gni_shows_backs(r, turned, h) ? GL_FRONT : GL_BACK;
    }
    if (!GNI_HAS_CULLING)
        return s;
    gni_bound(&s, plan, &plan->lights[r->light], r->scissor);
    if (r->patch)
        s.bounds = NULL; /* of depths that are not tested */
    return s;
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

static void count_records(gn_gles *g, uint32_t first, uint32_t end, gni_half h)
{
    for (uint32_t i = first; i < end; i++)
        for (int turned = 0; turned < 2; turned++) {
            const gn_record *r = &g->plan->records[i];
            gni_state state;

            if (turned && !r->turned_cap_count)
                continue;
            state = counting(g->plan, r, turned, h);
            gni_set_state(g, &state);
            if (GNI_HAS_FALLBACK && g->plan->lights[r->light].stencil.discard)
                g->gl.glUniform1f(g->sided.side, gni_shows_backs(r, turned, h) ? -1.0f : 1.0f);
            gni_draw_record(g, g->plan, r, turned);
        }
}

static void count_volumes(gn_gles *g, const gn_step *step)
{
    const gn_stencil_layout *layout = &g->plan->lights[step->light].stencil;

    gni_begin_volumes(g, GNI_HAS_FALLBACK && layout->discard ? &g->sided : &g->counted);
    if (GNI_HAS_FALLBACK)
        gni_count_casters(g, step, layout->two_sided, count_records);
    else
        count_records(g, step->first_record, step->first_record + step->record_count, GNI_BOTH);
    gni_end_volumes(g);
}

void gni_stencil_step(gn_gles *g, const gn_step *step)
{
    const gn_stencil_layout *layout = &g->plan->lights[step->light].stencil;

    switch (step->kind) {
    case GN_STEP_ZERO:
        gni_fill_quad(g, step, reset(layout), NULL);
        break;
    case GN_STEP_FOLD:
        if (GNI_HAS_BATCHES)
            gni_fill_quad(g, step, fold(layout), NULL);
        break;
    case GN_STEP_MARK:
        if (GNI_HAS_CULLING)
            mark_patches(g, step);
        break;
    case GN_STEP_DARKEN:
        if (GNI_HAS_CULLING)
            gni_fill_quad(g, step, darken(layout, step->patch), NULL);
        break;
    default:
        count_volumes(g, step);
    }
}
