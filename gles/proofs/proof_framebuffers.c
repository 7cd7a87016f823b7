/* proof_framebuffers.c - framebuffer objects: formats of colour, depth with stencil, depth that two of them share,
 * depth in a texture. Complete is what a driver calls them; proven is what was drawn into one and read back. */
#include "proofs.h"

#include "shaders/sample.frag.h"

enum { SIZE = 16 };

/* A texture of a colour format in a framebuffer object; both bound. */
typedef struct object {
    GLuint framebuffer, texture;
} object;

static GLuint make_texture(gni_proofs *p, GLenum format, GLenum type)
{
    const gn_gl *gl = p->gl;
    GLuint name = 0;

    gl->glGenTextures(1, &name);
    gl->glBindTexture(GL_TEXTURE_2D, name);
    gl->glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl->glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl->glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl->glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    gl->glTexImage2D(GL_TEXTURE_2D, 0, (GLint)format, SIZE, SIZE, 0, format, type, NULL);
    return name;
}

static void make(gni_proofs *p, object *o, GLenum format, GLenum type)
{
    o->texture = make_texture(p, format, type);
    p->gl->glGenFramebuffers(1, &o->framebuffer);
    p->gl->glBindFramebuffer(GL_FRAMEBUFFER, o->framebuffer);
    p->gl->glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, o->texture, 0);
}

static void drop(gni_proofs *p, const object *o)
{
    p->gl->glDeleteFramebuffers(1, &o->framebuffer);
    p->gl->glDeleteTextures(1, &o->texture);
}

static GLuint make_depth(gni_proofs *p, GLenum format)
{
    GLuint name = 0;

    p->gl->glGenRenderbuffers(1, &name);
    p->gl->glBindRenderbuffer(GL_RENDERBUFFER, name);
    p->gl->glRenderbufferStorage(GL_RENDERBUFFER, format, SIZE, SIZE);
    return name;
}

static void attach(gni_proofs *p, GLenum attachment, GLuint renderbuffer)
{
    p->gl->glFramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, renderbuffer);
}

static int is_complete(gni_proofs *p)
{
    const GLenum status = p->gl->glCheckFramebufferStatus(GL_FRAMEBUFFER), error = p->gl->glGetError();

    if (status != GL_FRAMEBUFFER_COMPLETE)
        return gni_failed(p, "the framebuffer is not complete (0x%04X)", status);
    return error == GL_NO_ERROR ? 1 : gni_failed(p, "the GL says 0x%04X while it is made", error);
}

static void start(gni_proofs *p, GLbitfield buffers)
{
    gni_fresh_state(p);
    p->gl->glClearColor(0.0f, 0.0f, 0.0f, 0.0f);
    p->gl->glClear(buffers);
}

/* Reads the framebuffer object as a cell. */
static int read(gni_proofs *p)
{
    GLenum error;

    p->gl->glReadPixels(0, 0, SIZE, SIZE, GL_RGBA, GL_UNSIGNED_BYTE, p->pixels);
    error = p->gl->glGetError();
    return error == GL_NO_ERROR ? 1 : gni_failed(p, "it cannot be read (0x%04X)", error);
}

static const int is_red[4] = {255, 0, 0, -1}, is_black[4] = {0, 0, 0, -1}, is_blue[4] = {0, 0, 255, -1};

/* A block of rows starts at each of these levels. */
static int start_of(int y, int top)
{
    return y < 5 ? 0 : y < 10 ? top / 2 : top - 8;
}

/* Column x has x + 1 steps more than its start, stopped at the top; and with `less` as many less again, stopped at 0. */
static int levels_are_stepped(gni_proofs *p, int top, int less)
{
    if (!read(p))
        return 0;
    for (int y = 0; y < SIZE; y++)
        for (int x = 0; x < SIZE; x++) {
            const int more = start_of(y, top) + x + 1 < top ? start_of(y, top) + x + 1 : top;
            const int wanted = !less ? more : more > x + 1 ? more - x - 1 : 0;
            const int got = (p->pixels[4 * (SIZE * y + x)] * top + 127) / 255;

            if (got != wanted)
                return gni_failed(p, "%d steps of 1/%d %s from level %d are level %d", x + 1, top,
                                  less ? "added and subtracted" : "added", start_of(y, top), got);
        }
    return 1;
}

static void step_columns(gni_proofs *p, int top, GLenum equation)
{
    const float step = 1.0f / (float)top, color[4] = {step, step, step, step};

    p->gl->glEnable(GL_BLEND);
    p->gl->glBlendEquation(equation);
    p->gl->glBlendFunc(GL_ONE, GL_ONE);
    for (int x = 0; x < SIZE; x++)
        gni_draw_rectangle(p, x, 0, SIZE - x, SIZE, 0.0f, 0, color);
    p->gl->glBlendEquation(GL_FUNC_ADD);
    p->gl->glDisable(GL_BLEND);
}

/* Counts are made there: single steps add up, and down again where subtracting is offered. */
static int adds_steps(gni_proofs *p, int top)
{
    gni_fresh_state(p);
    for (int y = 0; y < SIZE; y += 5) {
        const float start = (float)start_of(y, top) / (float)top, color[4] = {start, start, start, start};

        gni_draw_rectangle(p, 0, y, SIZE, SIZE - y, 0.0f, 0, color);
    }
    step_columns(p, top, GL_FUNC_ADD);
    if (!levels_are_stepped(p, top, 0))
        return 0;
    if (!gni_proofs_can(p, GN_CAN_BLEND_SUBTRACT))
        return 1;
    step_columns(p, top, 0x800B); /* GL_FUNC_REVERSE_SUBTRACT */
    return levels_are_stepped(p, top, 1);
}

static int holds_color(gni_proofs *p, GLenum format, GLenum type, int top)
{
    object o;
    int ok;

    make(p, &o, format, type);
    ok = is_complete(p);
    if (ok) {
        gni_fresh_state(p);
        p->gl->glClearColor(1.0f, 0.0f, 0.0f, 1.0f);
        p->gl->glClear(GL_COLOR_BUFFER_BIT);
        gni_draw_rectangle(p, 8, 0, 8, SIZE, 0.0f, 0, gni_blue);
        ok = read(p) && gni_is_color(p, 0, 0, 8, SIZE, is_red, "cleared to red it is not red") &&
             gni_is_color(p, 8, 0, 8, SIZE, is_blue, "blue is not blue") && adds_steps(p, top);
    }
    drop(p, &o);
    return ok;
}

static int holds_rgba8(gni_proofs *p)
{
    return holds_color(p, GL_RGBA, GL_UNSIGNED_BYTE, 255);
}

static int holds_rgba4(gni_proofs *p)
{
    return holds_color(p, GL_RGBA, GL_UNSIGNED_SHORT_4_4_4_4, 15);
}

static int holds_rgb5a1(gni_proofs *p)
{
    return holds_color(p, GL_RGBA, GL_UNSIGNED_SHORT_5_5_5_1, 31);
}

static int holds_rgb565(gni_proofs *p)
{
    return holds_color(p, GL_RGB, GL_UNSIGNED_SHORT_5_6_5, 31);
}

/* Depth hides, and stencil counts what it hid. */
static int holds_both(gni_proofs *p)
{
    const gn_gl *gl = p->gl;
    GLuint depth;
    object o;
    int ok;

    make(p, &o, GL_RGBA, GL_UNSIGNED_BYTE);
    depth = make_depth(p, GNI_DEPTH24_STENCIL8);
    attach(p, GL_DEPTH_ATTACHMENT, depth);
    attach(p, GL_STENCIL_ATTACHMENT, depth);
    ok = is_complete(p);
    if (ok) {
        start(p, GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
        gl->glEnable(GL_DEPTH_TEST);
        gl->glEnable(GL_STENCIL_TEST);
        gl->glStencilOp(GL_KEEP, GL_INCR, GL_KEEP);
        gni_draw_rectangle(p, 0, 0, 8, SIZE, 0.0f, 0, gni_blue);
        gni_draw_rectangle(p, 0, 0, SIZE, SIZE, 0.5f, 0, gni_blue);
        gl->glDisable(GL_DEPTH_TEST);
        gl->glStencilFunc(GL_EQUAL, 1, ~0u);
        gni_draw_rectangle(p, 0, 0, SIZE, SIZE, 0.0f, 0, gni_red);
        ok = read(p) && gni_is_color(p, 0, 0, 8, SIZE, is_red, "what depth hides is not counted") &&
             gni_is_color(p, 8, 0, 8, SIZE, is_blue, "what depth shows is counted");
    }
    drop(p, &o);
    gl->glDeleteRenderbuffers(1, &depth);
    return ok;
}

/* Depth from one framebuffer object hides in the other. */
static int shares_depth(gni_proofs *p)
{
    const gn_gl *gl = p->gl;
    object first, second;
    GLuint depth;
    int ok;

    make(p, &first, GL_RGBA, GL_UNSIGNED_BYTE);
    depth = make_depth(p, GL_DEPTH_COMPONENT16);
    attach(p, GL_DEPTH_ATTACHMENT, depth);
    ok = is_complete(p);
    if (ok) {
        start(p, GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        gl->glEnable(GL_DEPTH_TEST);
        gni_draw_rectangle(p, 0, 0, 8, SIZE, 0.0f, 0, gni_blue);
    }
    make(p, &second, GL_RGBA, GL_UNSIGNED_BYTE);
    attach(p, GL_DEPTH_ATTACHMENT, depth);
    ok = ok && is_complete(p);
    if (ok) {
        start(p, GL_COLOR_BUFFER_BIT);
        gl->glEnable(GL_DEPTH_TEST);
        gni_draw_rectangle(p, 0, 0, SIZE, SIZE, 0.5f, 0, gni_red);
        ok = read(p) && gni_is_color(p, 0, 0, 8, SIZE, is_black, "depth of the first does not hide in the second") &&
             gni_is_color(p, 8, 0, 8, SIZE, is_red, "depth of the second is not what the first left");
    }
    drop(p, &second);
    drop(p, &first);
    gl->glDeleteRenderbuffers(1, &depth);
    return ok;
}

/* Depth drawn into a texture, and read from it in a shader. */
static int samples_depth(gni_proofs *p)
{
    const gn_gl *gl = p->gl;
    const GLuint depth = make_texture(p, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT);
    object o;
    int ok;

    make(p, &o, GL_RGBA, GL_UNSIGNED_BYTE);
    gl->glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth, 0);
    ok = is_complete(p);
    if (ok) {
        start(p, GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        gl->glEnable(GL_DEPTH_TEST);
        gni_draw_rectangle(p, 0, 0, SIZE, SIZE, 0.0f, 0, gni_white);
        gl->glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, 0, 0);
        ok = is_complete(p);
    }
    gni_fresh_state(p);
    if (ok && !gni_use_shader(p, "sample", "", gni_shader_sample_frag))
        ok = gni_failed(p, "a shader that samples it is refused");
    if (ok) {
        gl->glBindTexture(GL_TEXTURE_2D, depth);
        gl->glUniform1i(gni_uniform(p, "u_texture"), 0);
        gni_draw_rectangle(p, 0, 0, SIZE, SIZE, 0.0f, 0, gni_white);
        gni_use_own_shader(p);
        ok = read(p);
        if (ok && (p->pixels[0] < 126 || p->pixels[0] > 129))
            ok = gni_failed(p, "a depth of 0.5 reads as %d of 255", p->pixels[0]);
    }
    gl->glBindTexture(GL_TEXTURE_2D, 0);
    drop(p, &o);
    gl->glDeleteTextures(1, &depth);
    return ok;
}

const gni_lone_proof gni_proofs_of_framebuffers[7] = {
    {GN_CAN_FBO_RGBA8, 0, 0, holds_rgba8},
    {GN_CAN_FBO_RGBA4, 0, 0, holds_rgba4},
    {GN_CAN_FBO_RGB5A1, 0, 0, holds_rgb5a1},
    {GN_CAN_FBO_RGB565, 0, 0, holds_rgb565},
    {GN_CAN_PACKED_DEPTH_STENCIL, 1u << GN_CAN_FBO_RGBA8, 1u << GN_CAN_DEPTH | 1u << GN_CAN_STENCIL, holds_both},
    {GN_CAN_SHARED_DEPTH, 1u << GN_CAN_FBO_RGBA8, 1u << GN_CAN_DEPTH, shares_depth},
    {GN_CAN_DEPTH_TEXTURE, 1u << GN_CAN_FBO_RGBA8, 1u << GN_CAN_DEPTH, samples_depth},
};
