/* host_state.c - the GL state of the host, kept by glGet and put back: proofs disturb it, and nobody shall see that.
 *
 * Of attribute arrays and textures only what proofs touch is kept: array 0, and what is bound to unit 0. */
#include "gni_gles.h"

static const GLenum switches[] = {GL_BLEND,           GL_CULL_FACE,           GL_DEPTH_TEST,
                                  GL_DITHER,          GL_POLYGON_OFFSET_FILL, GL_SAMPLE_ALPHA_TO_COVERAGE,
                                  GL_SAMPLE_COVERAGE, GL_SCISSOR_TEST,        GL_STENCIL_TEST};
enum { SWITCHES = sizeof switches / sizeof switches[0] };

/* Function, reference, value mask; operations; write mask. */
static const GLenum stencil_names[2][7] = {
    {GL_STENCIL_FUNC, GL_STENCIL_REF, GL_STENCIL_VALUE_MASK, GL_STENCIL_FAIL, GL_STENCIL_PASS_DEPTH_FAIL,
     GL_STENCIL_PASS_DEPTH_PASS, GL_STENCIL_WRITEMASK},
    {GL_STENCIL_BACK_FUNC, GL_STENCIL_BACK_REF, GL_STENCIL_BACK_VALUE_MASK, GL_STENCIL_BACK_FAIL,
     GL_STENCIL_BACK_PASS_DEPTH_FAIL, GL_STENCIL_BACK_PASS_DEPTH_PASS, GL_STENCIL_BACK_WRITEMASK}};
static const GLenum blend_names[6] = {GL_BLEND_SRC_RGB,   GL_BLEND_DST_RGB,      GL_BLEND_SRC_ALPHA,
                                      GL_BLEND_DST_ALPHA, GL_BLEND_EQUATION_RGB, GL_BLEND_EQUATION_ALPHA};

static GLint whole(const gn_gl *gl, GLenum name)
{
    GLint value = 0;

    gl->glGetIntegerv(name, &value);
    return value;
}

void gni_keep_host(const gn_gles *g, gni_host_state *h)
{
    const gn_gl *gl = &g->gl;

    for (int i = 0; i < SWITCHES; i++)
        h->switches[i] = whole(gl, switches[i]);
    for (int side = 0; side < 2; side++)
        for (int i = 0; i < 7; i++)
            h->stencil[side][i] = whole(gl, stencil_names[side][i]);
    for (int i = 0; i < 6; i++)
        h->blend[i] = (GLenum)whole(gl, blend_names[i]);
    gl->glGetIntegerv(GL_VIEWPORT, h->viewport);
    gl->glGetIntegerv(GL_SCISSOR_BOX, h->scissor);
    gl->glGetIntegerv(GL_COLOR_WRITEMASK, h->color_mask);
    gl->glGetFloatv(GL_COLOR_CLEAR_VALUE, h->clear_color);
    gl->glGetFloatv(GL_DEPTH_CLEAR_VALUE, &h->clear_depth);
    gl->glGetFloatv(GL_DEPTH_RANGE, h->depth_range);
    gl->glGetFloatv(GL_POLYGON_OFFSET_FACTOR, &h->offset[0]);
    gl->glGetFloatv(GL_POLYGON_OFFSET_UNITS, &h->offset[1]);
    h->clear_stencil = whole(gl, GL_STENCIL_CLEAR_VALUE);
    h->depth_mask = whole(gl, GL_DEPTH_WRITEMASK);
    h->depth_func = (GLenum)whole(gl, GL_DEPTH_FUNC);
    h->front_face = (GLenum)whole(gl, GL_FRONT_FACE);
    h->cull_mode = (GLenum)whole(gl, GL_CULL_FACE_MODE);
    h->program = (GLuint)whole(gl, GL_CURRENT_PROGRAM);
    h->array_buffer = (GLuint)whole(gl, GL_ARRAY_BUFFER_BINDING);
    h->element_buffer = (GLuint)whole(gl, GL_ELEMENT_ARRAY_BUFFER_BINDING);
    h->framebuffer = (GLuint)whole(gl, GL_FRAMEBUFFER_BINDING);
    h->renderbuffer = (GLuint)whole(gl, GL_RENDERBUFFER_BINDING);
    h->active_texture = (GLenum)whole(gl, GL_ACTIVE_TEXTURE);
    h->pack = whole(gl, GL_PACK_ALIGNMENT);
    h->unpack = whole(gl, GL_UNPACK_ALIGNMENT);
    gl->glActiveTexture(GL_TEXTURE0);
    h->texture = (GLuint)whole(gl, GL_TEXTURE_BINDING_2D);
    h->arrays = 0;
    for (GLuint i = 0; i < g->attribute_arrays && i < 32; i++) {
        GLint on = 0;

        gl->glGetVertexAttribiv(i, GL_VERTEX_ATTRIB_ARRAY_ENABLED, &on);
        h->arrays |= (uint32_t)(on != 0) << i;
    }
    gl->glGetVertexAttribiv(0, GL_VERTEX_ATTRIB_ARRAY_SIZE, &h->array_size);
    gl->glGetVertexAttribiv(0, GL_VERTEX_ATTRIB_ARRAY_TYPE, &h->array_type);
    gl->glGetVertexAttribiv(0, GL_VERTEX_ATTRIB_ARRAY_NORMALIZED, &h->array_normalized);
    gl->glGetVertexAttribiv(0, GL_VERTEX_ATTRIB_ARRAY_STRIDE, &h->array_stride);
    gl->glGetVertexAttribiv(0, GL_VERTEX_ATTRIB_ARRAY_BUFFER_BINDING, &h->array_source);
    gl->glGetVertexAttribPointerv(0, GL_VERTEX_ATTRIB_ARRAY_POINTER, &h->array_pointer);
}

static void set_switch(const gn_gl *gl, GLenum name, int on)
{
    if (on)
        gl->glEnable(name);
    else
        gl->glDisable(name);
}

/* What is the same on both sides by the functions that need no two-sided stencil. */
static void put_back_stencil(const gn_gl *gl, const GLint front[7], const GLint back[7])
{
    if (front[0] == back[0] && front[1] == back[1] && front[2] == back[2]) {
        gl->glStencilFunc((GLenum)front[0], front[1], (GLuint)front[2]);
    } else {
        gl->glStencilFuncSeparate(GL_FRONT, (GLenum)front[0], front[1], (GLuint)front[2]);
        gl->glStencilFuncSeparate(GL_BACK, (GLenum)back[0], back[1], (GLuint)back[2]);
    }
    if (front[3] == back[3] && front[4] == back[4] && front[5] == back[5]) {
        gl->glStencilOp((GLenum)front[3], (GLenum)front[4], (GLenum)front[5]);
    } else {
        gl->glStencilOpSeparate(GL_FRONT, (GLenum)front[3], (GLenum)front[4], (GLenum)front[5]);
        gl->glStencilOpSeparate(GL_BACK, (GLenum)back[3], (GLenum)back[4], (GLenum)back[5]);
    }
    if (front[6] == back[6]) {
        gl->glStencilMask((GLuint)front[6]);
    } else {
        gl->glStencilMaskSeparate(GL_FRONT, (GLuint)front[6]);
        gl->glStencilMaskSeparate(GL_BACK, (GLuint)back[6]);
    }
}

static void put_back_arrays(const gn_gles *g, const gni_host_state *h)
{
    const gn_gl *gl = &g->gl;

    gl->glBindBuffer(GL_ARRAY_BUFFER, (GLuint)h->array_source);
    gl->glVertexAttribPointer(0, h->array_size, (GLenum)h->array_type, (GLboolean)h->array_normalized, h->array_stride,
                              h->array_pointer);
    gl->glBindBuffer(GL_ARRAY_BUFFER, h->array_buffer);
    gl->glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, h->element_buffer);
    for (GLuint i = 0; i < g->attribute_arrays && i < 32; i++)
        if (h->arrays >> i & 1)
            gl->glEnableVertexAttribArray(i);
        else
            gl->glDisableVertexAttribArray(i);
}

void gni_put_host_back(const gn_gles *g, const gni_host_state *h)
{
    const gn_gl *gl = &g->gl;

    for (int i = 0; i < SWITCHES; i++)
        set_switch(gl, switches[i], h->switches[i]);
    put_back_stencil(gl, h->stencil[0], h->stencil[1]);
    gl->glBlendFuncSeparate(h->blend[0], h->blend[1], h->blend[2], h->blend[3]);
    gl->glBlendEquationSeparate(h->blend[4], h->blend[5]);
    gl->glViewport(h->viewport[0], h->viewport[1], h->viewport[2], h->viewport[3]);
    gl->glScissor(h->scissor[0], h->scissor[1], h->scissor[2], h->scissor[3]);
    gl->glColorMask((GLboolean)h->color_mask[0], (GLboolean)h->color_mask[1], (GLboolean)h->color_mask[2],
                    (GLboolean)h->color_mask[3]);
    gl->glClearColor(h->clear_color[0], h->clear_color[1], h->clear_color[2], h->clear_color[3]);
    gl->glClearDepthf(h->clear_depth);
    gl->glClearStencil(h->clear_stencil);
    gl->glDepthRangef(h->depth_range[0], h->depth_range[1]);
    gl->glPolygonOffset(h->offset[0], h->offset[1]);
    gl->glDepthMask((GLboolean)h->depth_mask);
    gl->glDepthFunc(h->depth_func);
    gl->glFrontFace(h->front_face);
    gl->glCullFace(h->cull_mode);
    gl->glUseProgram(h->program);
    put_back_arrays(g, h);
    gl->glBindFramebuffer(GL_FRAMEBUFFER, h->framebuffer);
    gl->glBindRenderbuffer(GL_RENDERBUFFER, h->renderbuffer);
    gl->glBindTexture(GL_TEXTURE_2D, h->texture);
    gl->glActiveTexture(h->active_texture);
    gl->glPixelStorei(GL_PACK_ALIGNMENT, h->pack);
    gl->glPixelStorei(GL_UNPACK_ALIGNMENT, h->unpack);
}
