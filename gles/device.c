/* device.c - a GL context as gnomon uses it: functions, one program, one quad, a buffer for indices. */
#include "gni_gles.h"

#include <stdio.h>
#include <string.h>

#include "shaders/flat.frag.h"
#include "shaders/volume.vert.h"

static gn_result refuse(gn_gles *g, const char *what)
{
    gn_context *context = g->context;

    gn_gles_destroy(g);
    return gn_fail(context, GN_E_DEVICE, "gn_gles_create: %s", what);
}

gn_result gn_gles_create(gn_context *context, gn_get_proc get_proc, void *user, gn_gles **out)
{
    /* two triangles over the whole target; w = 1 takes the near matrix */
    static const float corners[6][4] = {{-1, -1, 0, 1}, {1, -1, 0, 1}, {1, 1, 0, 1},
                                        {-1, -1, 0, 1}, {1, 1, 0, 1},  {-1, 1, 0, 1}};
    const gn_port *port = gn_context_port(context);
    const char *missing;
    gn_gles *g;
    GLint arrays = 0;

    if (out)
        *out = NULL;
    if (!context || !get_proc || !out)
        return gn_fail(context, GN_E_ARG, "gn_gles_create: NULL argument");
    g = port->resize(port->user, NULL, 0, sizeof *g);
    if (!g)
        return gn_fail(context, GN_E_MEMORY, "gn_gles_create: no memory");
    memset(g, 0, sizeof *g);
    g->context = context;
    g->port = *port;
    missing = gn_gl_load(&g->gl, get_proc, user);
    if (missing) {
        g->forgotten = 1;
        gn_gles_destroy(g);
        return gn_fail(context, GN_E_DEVICE, "gn_gles_create: the GL has no function %s", missing);
    }
    g->gl.glGetIntegerv(GL_MAX_VERTEX_ATTRIBS, &arrays);
    g->attribute_arrays = arrays > 0 ? (GLuint)arrays : 8; /* 8 is the least that OpenGL ES 2.0 allows */
    g->program = gni_make_program(g, "volume", gni_shader_volume_vert, gni_shader_flat_frag);
    if (!g->program)
        return refuse(g, "the GL refuses the volume shaders: see the log");
    g->near_matrix = g->gl.glGetUniformLocation(g->program, "u_near");
    g->far_matrix = g->gl.glGetUniformLocation(g->program, "u_far");
    g->color = g->gl.glGetUniformLocation(g->program, "u_color");
    g->gl.glGenBuffers(1, &g->quad);
    g->gl.glGenBuffers(1, &g->indices);
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

void gn_gles_destroy(gn_gles *g)
{
    if (!g)
        return;
    if (!g->forgotten) {
        for (uint32_t i = 0; i < g->upload_count; i++)
            g->gl.glDeleteBuffers(1, &g->uploads[i].buffer);
        g->gl.glDeleteBuffers(1, &g->quad);
        g->gl.glDeleteBuffers(1, &g->indices);
        g->gl.glDeleteProgram(g->program);
    }
    if (g->uploads)
        g->port.resize(g->port.user, g->uploads, g->upload_capacity * sizeof *g->uploads, 0);
    g->port.resize(g->port.user, g, sizeof *g, 0);
}

const gn_gl *gn_gles_functions(const gn_gles *g)
{
    return &g->gl;
}

gn_target gn_gles_describe_target(const gn_gles *g, uint32_t width, uint32_t height)
{
    const gn_gl *gl = &g->gl;
    gn_target t;

    memset(&t, 0, sizeof t);
    t.width = width;
    t.height = height;
    gl->glGetIntegerv(GL_RED_BITS, &t.red_bits);
    gl->glGetIntegerv(GL_GREEN_BITS, &t.green_bits);
    gl->glGetIntegerv(GL_BLUE_BITS, &t.blue_bits);
    gl->glGetIntegerv(GL_ALPHA_BITS, &t.alpha_bits);
    gl->glGetIntegerv(GL_DEPTH_BITS, &t.depth_bits);
    gl->glGetIntegerv(GL_STENCIL_BITS, &t.stencil_bits);
    gl->glGetIntegerv(GL_SAMPLES, &t.samples);
    return t;
}
