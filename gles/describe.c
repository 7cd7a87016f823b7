/* describe.c - what the bound framebuffer is, and what can be done there. */
#include "gni_gles.h"

#include <string.h>

static int bits(const gn_gl *gl, GLenum name)
{
    GLint value = 0;

    gl->glGetIntegerv(name, &value);
    return value;
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
    t.hidden = g->hidden;
    t.advertised = gni_advertised(g, &t);
    if (gl->glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        return gn_fail(g->context, GN_E_DEVICE, "gn_gles_describe_target: the bound framebuffer is not complete");
    memset(g->symptoms, 0, sizeof g->symptoms);
    if (!gni_read_saved(g, saved, &t)) {
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
