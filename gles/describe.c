/* describe.c - what the bound framebuffer is, and what can be done there. */
#include "gni_gles.h"

#include <string.h>

static int bits(const gn_gl *gl, GLenum name)
{
    GLint value = 0;

    gl->glGetIntegerv(name, &value);
    return value;
}

/* Depth that an image of the library's own may borrow: a renderbuffer of the bound framebuffer object. */
static uint32_t find_depth_to_share(const gn_gl *gl, uint32_t framebuffer)
{
    GLint kind = 0, name = 0;

    if (!framebuffer)
        return 0;
    gl->glGetFramebufferAttachmentParameteriv(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT,
                                              GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE, &kind);
    if (kind == GL_RENDERBUFFER)
        gl->glGetFramebufferAttachmentParameteriv(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT,
                                                  GL_FRAMEBUFFER_ATTACHMENT_OBJECT_NAME, &name);
    return (uint32_t)name;
}

gn_result gn_gles_describe_target(gn_gles *g, uint32_t width, uint32_t height, const char *saved, gn_target *target)
{
    gni_host_state host;
    const gn_gl *gl;
    gn_target t;

    if (!g || !target)
        return gn_fail(g ? g->context : NULL, GN_E_ARG, "gn_gles_describe_target: NULL argument");
    if (g->forgotten)
        return gn_fail(g->context, GN_E_ARG, "gn_gles_describe_target: the GL context was lost");
    if (width == 0 || height == 0)
        return gn_fail(g->context, GN_E_ARG, "gn_gles_describe_target: %lux%lu pixels", (unsigned long)width,
                       (unsigned long)height);
    gl = &g->gl;
    memset(&t, 0, sizeof t);
    t.width = width;
    t.height = height;
    t.red_bits = bits(gl, GL_RED_BITS);
    t.green_bits = bits(gl, GL_GREEN_BITS);
    t.blue_bits = bits(gl, GL_BLUE_BITS);
    t.alpha_bits = bits(gl, GL_ALPHA_BITS);
    t.depth_bits = bits(gl, GL_DEPTH_BITS);
    t.stencil_bits = bits(gl, GL_STENCIL_BITS);
    t.samples = bits(gl, GL_SAMPLES);
    t.image_depth_bits = GNI_HAS_FALLBACK ? gni_image_depth(g) : 0;
    t.framebuffer = (uint32_t)bits(gl, GL_FRAMEBUFFER_BINDING);
    t.shared_depth = !GNI_HAS_FALLBACK || t.samples ? 0 : find_depth_to_share(gl, t.framebuffer);
    t.hidden = g->hidden;
    t.advertised = gni_advertised(g, &t);
    if (gl->glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        return gn_fail(g->context, GN_E_DEVICE, "gn_gles_describe_target: the bound framebuffer is not complete");
    memset(g->symptoms, 0, sizeof g->symptoms);
    if (!gni_read_saved(g, saved, &t)) {
        if (!GNI_HAS_PROOFS)
            return gn_fail(g->context, GN_E_DEVICE,
                           "gn_gles_describe_target: this build proves nothing: the text that is given must have been "
                           "saved of this driver and target");
        gni_keep_host(g, &host);
        gni_prove(g, &t);
        gni_put_host_back(g, &host);
    }
    *target = t;
    return GN_OK;
}

const char *gn_gles_symptom(const gn_gles *g, gn_capability capability)
{
    return g && (unsigned)capability < GN_CAPABILITY_COUNT ? g->symptoms[capability] : "";
}
