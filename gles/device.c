/* device.c - a GL context as gnomon uses it: functions, one program, one quad, a buffer for indices. */
#include "gni_gles.h"

#include <stdio.h>
#include <string.h>

static gn_result refuse(gn_gles *g, const char *what)
{
    gn_context *context = g->context;

    gn_gles_destroy(g);
    return gn_fail(context, GN_E_DEVICE, "gn_gles_create: %s", what);
}

static gn_result hide(gn_context *context, const char *from, const char *names, uint32_t *hidden)
{
    const char *const unknown = gn_capability_parse(names, hidden);

    if (!unknown)
        return GN_OK;
    return gn_fail(context, GN_E_ARG, "%s: no capability is called \"%.*s\"", from, (int)strcspn(unknown, ","),
                   unknown);
}

gn_result gn_gles_create(gn_context *context, const gn_gles_desc *desc, gn_gles **out)
{
    /* clang-format off */
    static const float corners[][4] = {
        {-1, -1, 0, 1}, {1, -1, 0, 1}, {1, 1, 0, 1}, {-1, -1, 0, 1}, {1, 1, 0, 1}, {-1, 1, 0, 1}, /* GNI_QUAD */
#if GNI_HAS_PROOFS
        {-1, -1, 1, 0}, {1, -1, 1, 0}, {1, 1, 1, 0}, {-1, -1, 1, 0}, {1, 1, 1, 0}, {-1, 1, 1, 0}, /* GNI_FAR_QUAD */
        {-1, -1, 1, 1}, {1, -1, 1, 1}, {1, 1, 1, 0}, {-1, -1, 1, 1}, {1, 1, 1, 0}, {-1, 1, 1, 0}  /* GNI_WALL */
#endif
    };
    /* clang-format on */
    const gn_port *port = gn_context_port(context);
    const char *missing;
    uint32_t hidden = 0;
    gn_gles *g;
    GLint arrays = 0;
    gn_result result;

    if (out)
        *out = NULL;
    if (!context || !desc || !desc->get_proc || !out)
        return gn_fail(context, GN_E_ARG, "gn_gles_create: NULL argument");
    if (GNI_HAS_PROOFS) {
        result = hide(context, "gn_gles_desc.hide", desc->hide, &hidden);
        if (result == GN_OK && port->setting)
            result = hide(context, "GNOMON_HIDE", port->setting(port->user, "GNOMON_HIDE"), &hidden);
        if (result != GN_OK)
            return result;
    } else if ((desc->hide && desc->hide[0]) || (port->setting && port->setting(port->user, "GNOMON_HIDE"))) {
        return gn_fail(context, GN_E_DEVICE, "gn_gles_create: this build lacks the feature proofs: it hides nothing");
    }
    g = port->resize(port->user, NULL, 0, sizeof *g);
    if (!g)
        return gn_fail(context, GN_E_MEMORY, "gn_gles_create: no memory");
    memset(g, 0, sizeof *g);
    g->context = context;
    g->port = *port;
    g->hidden = hidden;
    missing = gn_gl_load(&g->gl, desc->get_proc, desc->user);
    if (missing) {
        g->forgotten = 1;
        gn_gles_destroy(g);
        return gn_fail(context, GN_E_DEVICE, "gn_gles_create: the GL has no function %s", missing);
    }
    g->gl.glGetIntegerv(GL_MAX_VERTEX_ATTRIBS, &arrays);
    g->attribute_arrays = arrays > 0 ? (GLuint)arrays : 8; /* 8 is the least that OpenGL ES 2.0 allows */
    if (((GNI_HAS_FALLBACK || GNI_HAS_PROOFS) && !gni_make_flat_program(g, &g->colored, "volume", "")) ||
        !gni_make_flat_program(g, &g->counted, "counted volume", NULL))
        return refuse(g, "the GL refuses the volume shaders: see the log");
    g->gl.glGenBuffers(1, &g->quad);
    g->gl.glGenBuffers(1, &g->indices);
    g->gl.glGenBuffers(1, &g->cached);
    g->gl.glBindBuffer(GL_ARRAY_BUFFER, g->quad);
    g->gl.glBufferData(GL_ARRAY_BUFFER, sizeof corners, corners, GL_STATIC_DRAW);
    gni_leave_state(g);
    if (g->gl.glGetError() != GL_NO_ERROR)
        return refuse(g, "the GL reports an error while buffers are made");
    *out = g;
    return GN_OK;
}

void gn_gles_forget(gn_gles *g)
{
    if (g)
        g->forgotten = 1;
}

static void delete_fallback(gn_gles *g)
{
    /* 0 is none */
    g->gl.glDeleteProgram(g->sided.name);
    g->gl.glDeleteProgram(g->sided_color.name);
    g->gl.glDeleteProgram(g->faced.name);
    g->gl.glDeleteProgram(g->resolve.name);
    g->gl.glDeleteProgram(g->shade.name);
    g->gl.glDeleteProgram(g->carry.name);
    g->gl.glDeleteProgram(g->edges.name);
    g->gl.glDeleteProgram(g->agree.name);
    gni_delete_images(g);
}

void gn_gles_destroy(gn_gles *g)
{
    if (!g)
        return;
    if (!g->forgotten) {
        for (uint32_t i = 0; i < g->upload_count; i++)
            gni_delete_upload(g, &g->uploads[i]);
        g->gl.glDeleteBuffers(1, &g->quad);
        g->gl.glDeleteBuffers(1, &g->indices);
        g->gl.glDeleteBuffers(1, &g->cached);
        g->gl.glDeleteProgram(g->counted.name);
        if (GNI_HAS_FALLBACK || GNI_HAS_PROOFS)
            g->gl.glDeleteProgram(g->colored.name);
        if (GNI_HAS_FALLBACK)
            delete_fallback(g);
    }
    if (GNI_HAS_FALLBACK && g->images.masks)
        g->port.resize(g->port.user, g->images.masks, g->images.mask_capacity * sizeof *g->images.masks, 0);
    if (g->uploads)
        g->port.resize(g->port.user, g->uploads, g->upload_capacity * sizeof *g->uploads, 0);
    g->port.resize(g->port.user, g, sizeof *g, 0);
}

const gn_gl *gn_gles_functions(const gn_gles *g)
{
    return &g->gl;
}
