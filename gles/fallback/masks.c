/* masks.c - counts become masks in textures, and masks dim a frame.
 *
 * A count in an image is compared pixel by pixel and multiplied into its light's channel of a mask texture, so that
 * batches add up; a stencil in an image writes that channel, which is the image's own colour; what was counted in the
 * target's colour is copied. Where a frame is not lit light by light, it is multiplied by what shadows leave. */
#include "../gni_gles.h"

enum { COLOR = 7, ALPHA = 8, ALL = 15 }; /* channels */

static const float none[4] = {0, 0, 0, 0};

static void clear_depth(gn_gles *g)
{
    static const gni_state open = {.color_mask = ALL, .depth_write = GL_TRUE, .stencil_write = ~0u};
    const gn_image *image = &g->plan->image;

    gni_set_state(g, &open);
    if (image->depth_bits)
        g->gl.glClearDepthf((GLfloat)g->plan->clear_depth);
    if (image->stencil_bits)
        g->gl.glClearStencil(g->plan->lights[0].stencil.reference);
    g->gl.glClear(GL_COLOR_BUFFER_BIT | (image->depth_bits ? GL_DEPTH_BUFFER_BIT : 0u) |
                  (image->stencil_bits ? GL_STENCIL_BUFFER_BIT : 0u));
}

/* The clear colour is the host's, so a quad brings the level. */
static void fill(gn_gles *g, float value)
{
    static const gn_step everywhere = {.light = GN_NO_LIGHT};
    const gni_state state = {.color_mask = ALL, .undithered = 1};
    const float color[4] = {value, value, value, value};

    gni_fill_quad(g, &everywhere, state, color);
}

static void clear_image(gn_gles *g)
{
    const gn_color_layout *layout = &g->plan->lights[0].color;

    clear_depth(g);
    fill(g, g->plan->image.stencil_bits ? 1.0f : (float)layout->start / (float)layout->top);
}

static void resolve(gn_gles *g, const gn_step *step)
{
    const gn_plan_light *l = &g->plan->lights[step->light];
    const float weights[4] = {(float)l->color.top, l->color.other_top ? -(float)l->color.other_top : 0.0f, 0.0f, 0.0f};
    gni_state state = {.color_mask = 1u << l->mask_channel, .undithered = 1};

    if (g->plan->image.stencil_bits) {
        state = gni_where_count(l, GL_NOTEQUAL);
        state.color_mask = 1u << l->mask_channel;
        state.undithered = 1;
        gni_fill_quad(g, step, state, none);
        return;
    }
    gni_use_reader(g, &g->resolve, g->images.count);
    g->gl.glUniform4fv(g->resolve.weights, 1, weights);
    g->gl.glUniform1f(g->resolve.level, l->color.other_top ? 0.0f : (float)l->color.start);
    gni_draw_reader(g, step, state);
    g->gl.glBindTexture(GL_TEXTURE_2D, 0);
}

static void copy(gn_gles *g, const gn_step *step)
{
    const gn_gl *gl = &g->gl;

    gl->glActiveTexture(GL_TEXTURE0);
    gl->glBindTexture(GL_TEXTURE_2D, g->images.masks[step->mask]);
    gl->glCopyTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 0, 0, (GLsizei)g->plan->mask_size[0],
                            (GLsizei)g->plan->mask_size[1]);
    gl->glBindTexture(GL_TEXTURE_2D, 0);
}

/* Depth is in the image that it was drawn into: until it is counted in, or in the first mask. */
static void carry(gn_gles *g, const gn_step *step)
{
    const gni_state state = {.color_mask = ALL, .undithered = 1};
    const gn_step everywhere = {.light = GN_NO_LIGHT};

    gni_use_reader(g, &g->carry, step->mask > 0 ? g->images.masks[0] : g->images.count);
    gni_draw_reader(g, &everywhere, state);
    g->gl.glBindTexture(GL_TEXTURE_2D, 0);
}

/* Only surfaces: the background has the depth that was cleared to, and quads are drawn two steps before it. */
static const gni_state multiply = {.color_mask = COLOR, .depth_func = GL_GREATER, .blend_destination = GL_SRC_COLOR};

static void set_depth(gn_gles *g, int before_background)
{
    const double step = 1.0 / (double)(1u << (g->plan->target.depth_bits < 24 ? g->plan->target.depth_bits : 24));
    const GLfloat depth = (GLfloat)(g->plan->clear_depth - 2.0 * step);

    g->gl.glDepthRangef(before_background ? depth : 0.0f, before_background ? depth : 1.0f);
}

static void shade_by_alpha(gn_gles *g, const gn_step *step)
{
    const float left = (float)g->plan->dimmed, dimmed[4] = {left, left, left, left};
    gni_state state = {
        .color_mask = ALPHA, .blend_source = GL_ONE, .blend_destination = GL_ONE_MINUS_SRC_COLOR, .undithered = 1};

    if (left > 0.0f && !g->plan->lights[step->light].color.by_maximum)
        gni_fill_quad(g, step, state, dimmed);
    state = multiply;
    state.blend_destination = GL_DST_ALPHA;
    gni_fill_quad(g, step, state, none);
}

static void shade_by_texture(gn_gles *g, const gn_step *step)
{
    gn_step all = *step; /* lights of one pass have scissors of their own */
    float unused[4] = {1, 1, 1, 1};

    for (uint32_t i = 0; i < step->light_count; i++)
        unused[g->plan->lights[step->lights[i]].mask_channel] = 0.0f;
    if (step->light_count > 1)
        all.light = GN_NO_LIGHT;
    gni_use_reader(g, &g->shade, g->images.masks[step->mask]);
    g->gl.glUniform4fv(g->shade.unused, 1, unused);
    g->gl.glUniform1f(g->shade.dimmed, (float)g->plan->dimmed);
    gni_draw_reader(g, &all, multiply);
    g->gl.glBindTexture(GL_TEXTURE_2D, 0);
}

static void shade(gn_gles *g, const gn_step *step)
{
    const float left = (float)g->plan->dimmed, dimmed[4] = {left, left, left, left};
    gni_state state;

    set_depth(g, 1);
    switch (g->plan->mask) {
    case GN_MASK_ALPHA:
        shade_by_alpha(g, step);
        break;
    case GN_MASK_TEXTURE:
        shade_by_texture(g, step);
        break;
    default:
        state = gni_where_count(&g->plan->lights[step->light], GL_NOTEQUAL);
        state.color_mask = COLOR;
        state.depth_func = GL_GREATER;
        state.blend_destination = GL_SRC_COLOR;
        gni_fill_quad(g, step, state, dimmed);
    }
    set_depth(g, 0);
}

/* Depth and stencil; of an image that is not the mask its count too. */
static void discard(gn_gles *g, const gn_step *step)
{
    static const GLenum of_window[2] = {0x1801, 0x1802}; /* GL_DEPTH_EXT, GL_STENCIL_EXT */
    static const GLenum attachments[3] = {GL_DEPTH_ATTACHMENT, GL_STENCIL_ATTACHMENT, GL_COLOR_ATTACHMENT0};

    if (!g->gl.glDiscardFramebufferEXT)
        return;
    if (step->into == GN_INTO_TARGET)
        g->gl.glDiscardFramebufferEXT(GL_FRAMEBUFFER, 2, g->plan->target.framebuffer ? attachments : of_window);
    else if (g->plan->image.depth_bits)
        g->gl.glDiscardFramebufferEXT(GL_FRAMEBUFFER, g->plan->image.stencil_bits ? 2 : 3, attachments);
    else
        g->gl.glDiscardFramebufferEXT(GL_FRAMEBUFFER, 1, attachments + 2);
}

void gni_mask_step(gn_gles *g, const gn_step *step)
{
    switch (step->kind) {
    case GN_STEP_CLEAR_IMAGE:
        clear_image(g);
        break;
    case GN_STEP_CLEAR_MASK:
        if (GNI_HAS_REFINE && g->plan->mask == GN_MASK_STENCIL)
            gni_find_edges(g);
        else if (g->plan->carries_depth)
            carry(g, step);
        else
            fill(g, 1.0f);
        break;
    case GN_STEP_REFINE:
        if (GNI_HAS_REFINE)
            gni_refine_step(g, step);
        break;
    case GN_STEP_RESOLVE:
        resolve(g, step);
        break;
    case GN_STEP_COPY:
        copy(g, step);
        break;
    case GN_STEP_SHADE:
        shade(g, step);
        break;
    case GN_STEP_DISCARD:
        discard(g, step);
        break;
    default:
        break;
    }
}
