/* osmesa.c - Mesa's off-screen context: no display of any kind, the surface is memory of ours.
 *
 * Its context is desktop OpenGL of the compatibility profile, which runs GLSL ES 1.00 (ARB_ES2_compatibility). The few
 * prototypes stand here so that no header of it need be installed. */
#include "platform.h"

#include <GLES2/gl2.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef void *osmesa_context;

#define OSMESA_RGBA 0x1908 /* GL_RGBA */

#ifndef OSMESA_RGB_565
#define OSMESA_RGB_565 0x5 /* what a compatibility header may lack */
#endif

typedef struct osmesa_platform {
    platform base;
    void *library;
    osmesa_context (*create)(GLenum format, GLint depth_bits, GLint stencil_bits, GLint accum_bits,
                             osmesa_context share);
    void (*destroy)(osmesa_context context);
    GLboolean (*make_current)(osmesa_context context, void *buffer, GLenum type, GLsizei width, GLsizei height);
    void (*(*get_proc)(const char *name))(void);
    osmesa_context context;
    int is_565;      /* two bytes of a pixel, else four */
    uint8_t *buffer; /* [height][width] */
} osmesa_platform;

extern const platform_kind platform_osmesa;

static int make_current(platform *p)
{
    osmesa_platform *o = (osmesa_platform *)p;

    return o->make_current(o->context, o->buffer, o->is_565 ? GL_UNSIGNED_SHORT_5_6_5 : GL_UNSIGNED_BYTE,
                           (GLsizei)p->actual.width, (GLsizei)p->actual.height) != 0;
}

static void destroy(platform *p)
{
    osmesa_platform *o = (osmesa_platform *)p;

    if (o->context)
        o->destroy(o->context);
    platform_release(o->library);
    free(o->buffer);
    free(o);
}

static const char *open_library(osmesa_platform *o)
{
    static const char *const names[] = {"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so", NULL};

    o->library = platform_library(names);
    if (!o->library)
        return "there is no libOSMesa.so.8";
    o->create = (osmesa_context(*)(GLenum, GLint, GLint, GLint, osmesa_context))platform_symbol(
        o->library, "OSMesaCreateContextExt");
    o->destroy = (void (*)(osmesa_context))platform_symbol(o->library, "OSMesaDestroyContext");
    o->make_current = (GLboolean(*)(osmesa_context, void *, GLenum, GLsizei, GLsizei))platform_symbol(
        o->library, "OSMesaMakeCurrent");
    o->get_proc = (void (*(*)(const char *))(void))platform_symbol(o->library, "OSMesaGetProcAddress");
    return o->create && o->destroy && o->make_current && o->get_proc ? NULL : "the library lacks a function";
}

static platform *create(const platform_desc *desc, char message[PLATFORM_MESSAGE])
{
    osmesa_platform *o = calloc(1, sizeof *o);
    const char *failure = o ? open_library(o) : "no memory";

    if (o)
        o->base = (platform){&platform_osmesa, *desc, "memory"};
    if (!failure) {
        void(GL_APIENTRY * get)(GLenum, GLint *);
        static const GLenum names[6] = {GL_RED_BITS,   GL_GREEN_BITS, GL_BLUE_BITS,
                                        GL_ALPHA_BITS, GL_DEPTH_BITS, GL_STENCIL_BITS};
        int *const bits[6] = {&o->base.actual.red_bits,   &o->base.actual.green_bits, &o->base.actual.blue_bits,
                              &o->base.actual.alpha_bits, &o->base.actual.depth_bits, &o->base.actual.stencil_bits};

        o->buffer = calloc(desc->height, 4 * (size_t)desc->width);
        o->is_565 = desc->red_bits == 5 && desc->green_bits == 6 && desc->alpha_bits == 0;
        o->context = o->create(o->is_565 ? OSMESA_RGB_565 : OSMESA_RGBA, desc->depth_bits, desc->stencil_bits, 0, NULL);
        if (!o->buffer || !o->context || !make_current(&o->base))
            failure = !o->buffer ? "no memory for the surface" : "it refuses a context of that size and those bits";
        else {
            get = (void(GL_APIENTRY *)(GLenum, GLint *))o->get_proc("glGetIntegerv");
            for (int i = 0; i < 6; i++)
                get(names[i], bits[i]);
        }
    }
    if (failure) {
        snprintf(message, PLATFORM_MESSAGE, "%s", failure);
        if (o)
            destroy(&o->base);
        return NULL;
    }
    return &o->base;
}

static void (*get_proc(platform *p, const char *name))(void)
{
    return ((osmesa_platform *)p)->get_proc(name);
}

static int lost(platform *p)
{
    (void)p; /* memory is not lost */
    return 0;
}

const platform_kind platform_osmesa = {"osmesa", create, make_current, get_proc, lost, destroy};
