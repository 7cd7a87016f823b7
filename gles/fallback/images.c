/* images.c - framebuffer objects of the library's own: an image that counts are made in, with depth that the host draws
 * or the target lends, and textures of masks. Made when a plan first needs them, and anew when it needs others. */
#include "../gni_gles.h"

#include "shaders/carry.frag.h"
#include "shaders/resolve.frag.h"
#include "shaders/shade.frag.h"

#include <string.h>

static GLuint make_texture(gn_gles *g, gn_format format, GLint filter)
{
    static const struct {
        GLenum format, type;
    } kinds[] = {{0, 0},
                 {GL_RGBA, GL_UNSIGNED_BYTE},
                 {GL_RGBA, GL_UNSIGNED_SHORT_4_4_4_4},
                 {GL_RGBA, GL_UNSIGNED_SHORT_5_5_5_1},
                 {GL_RGB, GL_UNSIGNED_SHORT_5_6_5}};
    const gn_gl *gl = &g->gl;
    GLuint name = 0;

    gl->glGenTextures(1, &name);
    gl->glActiveTexture(GL_TEXTURE0);
    gl->glBindTexture(GL_TEXTURE_2D, name);
    gl->glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
    gl->glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
    gl->glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl->glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    gl->glTexImage2D(GL_TEXTURE_2D, 0, (GLint)kinds[format].format, (GLsizei)g->images.width, (GLsizei)g->images.height,
                     0, kinds[format].format, kinds[format].type, NULL);
    gl->glBindTexture(GL_TEXTURE_2D, 0);
    return name;
}

static void attach_color(gn_gles *g, GLuint framebuffer, GLuint texture)
{
    g->gl.glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    g->gl.glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
    g->images.attached = texture;
}

static void make_image(gn_gles *g)
{
    const gn_gl *gl = &g->gl;
    gni_images *m = &g->images;
    GLuint depth = m->borrowed;

    gl->glGenFramebuffers(1, &m->framebuffer);
    if (!m->image.stencil_bits)
        m->count = make_texture(g, m->image.format, GL_NEAREST);
    attach_color(g, m->framebuffer, m->image.stencil_bits ? m->masks[0] : m->count);
    if (m->image.depth_bits) {
        gl->glGenRenderbuffers(1, &m->depth);
        gl->glBindRenderbuffer(GL_RENDERBUFFER, m->depth);
        gl->glRenderbufferStorage(GL_RENDERBUFFER,
                                  m->image.stencil_bits       ? GNI_DEPTH24_STENCIL8
                                  : m->image.depth_bits == 24 ? GNI_DEPTH24
                                                              : GL_DEPTH_COMPONENT16,
                                  (GLsizei)m->width, (GLsizei)m->height);
        gl->glBindRenderbuffer(GL_RENDERBUFFER, 0);
        depth = m->depth;
    }
    gl->glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth);
    if (m->image.stencil_bits)
        gl->glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_STENCIL_ATTACHMENT, GL_RENDERBUFFER, depth);
}

/* Room for the names of mask textures; 0 without memory. */
static int keep_room(gn_gles *g, uint32_t count)
{
    gni_images *m = &g->images;
    GLuint *masks;

    if (count <= m->mask_capacity)
        return 1;
    masks = g->port.resize(g->port.user, m->masks, m->mask_capacity * sizeof *masks, count * sizeof *masks);
    if (!masks)
        return 0;
    m->masks = masks;
    m->mask_capacity = count;
    return 1;
}

void gni_delete_images(gn_gles *g)
{
    const gn_gl *gl = &g->gl;
    gni_images *m = &g->images;
    GLuint *const masks = m->masks;
    const uint32_t capacity = m->mask_capacity;

    if (m->framebuffer)
        gl->glDeleteFramebuffers(1, &m->framebuffer);
    if (m->mask_framebuffer)
        gl->glDeleteFramebuffers(1, &m->mask_framebuffer);
    if (m->count)
        gl->glDeleteTextures(1, &m->count);
    if (m->depth)
        gl->glDeleteRenderbuffers(1, &m->depth);
    if (m->mask_count)
        gl->glDeleteTextures((GLsizei)m->mask_count, m->masks);
    memset(m, 0, sizeof *m);
    m->masks = masks;
    m->mask_capacity = capacity;
}

static GLuint borrowed_by(const gn_plan *plan)
{
    return plan->image.format != GN_FORMAT_NONE && plan->image.depth_bits == 0 ? plan->target.shared_depth : 0;
}

static int are_there(const gni_images *m, const gn_plan *plan)
{
    return m->width == plan->mask_size[0] && m->height == plan->mask_size[1] && m->upsample == plan->upsample &&
           m->carries_depth == plan->carries_depth && memcmp(&m->image, &plan->image, sizeof m->image) == 0 &&
           m->mask_format == plan->mask_format && m->mask_count >= plan->mask_count &&
           (plan->mask_age > 0 || m->borrowed == borrowed_by(plan));
}

static gn_result check(gn_gles *g, const char *what)
{
    const GLenum status = g->gl.glCheckFramebufferStatus(GL_FRAMEBUFFER);

    if (status == GL_FRAMEBUFFER_COMPLETE)
        return GN_OK;
    return gn_fail(g->context, GN_E_DEVICE,
                   "gn_gles_begin: the GL makes no framebuffer of %lux%lu pixels for %s (0x%04X)",
                   (unsigned long)g->images.width, (unsigned long)g->images.height, what, status);
}

/* But depth, alone in the first texture of masks that are refined, is no filter's. */
static int is_filtered(const gn_plan *plan, uint32_t mask)
{
    return plan->upsample == GN_UPSAMPLE_BILINEAR && !(plan->carries_depth && mask == 0);
}

static gn_result make(gn_gles *g, const gn_plan *plan)
{
    gni_images *m = &g->images;
    const int has_image = plan->image.format != GN_FORMAT_NONE;
    gn_result result = GN_OK;

    if (!keep_room(g, plan->mask_count))
        return gn_fail(g->context, GN_E_MEMORY, "gn_gles_begin: no memory for the names of %lu masks",
                       (unsigned long)plan->mask_count);
    gni_delete_images(g);
    g->kept_masks[1] = 0;
    m->image = plan->image;
    m->mask_format = plan->mask_format;
    m->width = plan->mask_size[0];
    m->height = plan->mask_size[1];
    m->upsample = plan->upsample;
    m->carries_depth = plan->carries_depth;
    m->borrowed = borrowed_by(plan);
    for (; m->mask_count < plan->mask_count; m->mask_count++)
        m->masks[m->mask_count] =
            make_texture(g, plan->mask_format, is_filtered(plan, m->mask_count) ? GL_LINEAR : GL_NEAREST);
    if (has_image) {
        make_image(g);
        result = check(g, "counts");
    }
    if (result == GN_OK && has_image && !plan->image.stencil_bits) {
        g->gl.glGenFramebuffers(1, &m->mask_framebuffer);
        attach_color(g, m->mask_framebuffer, m->masks[0]);
        result = check(g, "masks");
    }
    g->gl.glBindFramebuffer(GL_FRAMEBUFFER, plan->target.framebuffer);
    g->into = GN_INTO_TARGET;
    if (result != GN_OK)
        gni_delete_images(g);
    return result;
}

gn_result gni_prepare_images(gn_gles *g, const gn_plan *plan)
{
    const char *const defines = gn_target_can(&plan->target, GN_CAN_FRAGMENT_HIGHP) ? "" : "#define GN_MEDIUMP\n";

    if (plan->mask_count == 0)
        return GN_OK;
    if (!gni_make_reader(g, &g->resolve, "resolve", defines, gni_shader_resolve_frag) ||
        !gni_make_reader(g, &g->shade, "shade", defines, gni_shader_shade_frag) ||
        !gni_make_reader(g, &g->carry, "carry", defines, gni_shader_carry_frag) ||
        (GNI_HAS_REFINE && plan->mask == GN_MASK_STENCIL && !gni_make_refining_programs(g, defines)))
        return gn_fail(g->context, GN_E_DEVICE, "gn_gles_begin: the GL refuses a shader of masks: see the log");
    if (plan->mask_age == 0)
        return are_there(&g->images, plan) ? GN_OK : make(g, plan);
    if (are_there(&g->images, plan) && g->kept_masks[0] == plan->cache_id && g->kept_masks[1] == plan->mask_version)
        return GN_OK;
    return gn_fail(
        g->context, GN_E_ARG,
        "gn_gles_begin: the masks of %lu frames ago are gone: that plan was not walked to its end, or another "
        "made masks since",
        (unsigned long)plan->mask_age);
}

static int is_of_target(gn_into into)
{
    return into == GN_INTO_TARGET || into == GN_INTO_CORNER;
}

static void bind(gn_gles *g, const gn_step *step)
{
    gni_images *m = &g->images;
    GLuint framebuffer, texture;

    if (is_of_target(step->into)) {
        if (!is_of_target(g->into))
            g->gl.glBindFramebuffer(GL_FRAMEBUFFER, g->plan->target.framebuffer);
        return;
    }
    framebuffer = step->into == GN_INTO_IMAGE ? m->framebuffer : m->mask_framebuffer;
    texture = m->masks[step->mask == GN_NO_MASK ? 0 : step->mask];
    if ((step->into == GN_INTO_MASK || m->image.stencil_bits) && m->attached != texture)
        attach_color(g, framebuffer, texture);
    else if (g->into != step->into)
        g->gl.glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
}

void gni_bind_for(gn_gles *g, const gn_step *step)
{
    const gn_into before = g->into;

    bind(g, step);
    g->into = step->into;
    if (g->plan->scale > 1 && (before == GN_INTO_TARGET) != (g->into == GN_INTO_TARGET))
        gni_set_viewport(g);
}
