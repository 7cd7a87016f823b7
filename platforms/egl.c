/* egl.c - a context through EGL with neither window nor GPU: displays are tried from the one that needs least
 * (surfaceless, device, default), and the surface is always a pbuffer, so that framebuffer 0 is a window's stand-in.
 *
 * angle is the same by ANGLE's own libEGL.so over SwiftShader, in the folder that GNOMON_ANGLE names. */
#include "platform.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Every function of EGL that is called here: (type, name, parameters). */
#define EGL_FUNCTIONS(F)                                                                                               \
    F(EGLBoolean, eglInitialize, (EGLDisplay, EGLint *, EGLint *))                                                     \
    F(EGLBoolean, eglTerminate, (EGLDisplay))                                                                          \
    F(EGLBoolean, eglBindAPI, (EGLenum))                                                                               \
    F(EGLBoolean, eglChooseConfig, (EGLDisplay, const EGLint *, EGLConfig *, EGLint, EGLint *))                        \
    F(EGLBoolean, eglGetConfigAttrib, (EGLDisplay, EGLConfig, EGLint, EGLint *))                                       \
    F(EGLSurface, eglCreatePbufferSurface, (EGLDisplay, EGLConfig, const EGLint *))                                    \
    F(EGLBoolean, eglQuerySurface, (EGLDisplay, EGLSurface, EGLint, EGLint *))                                         \
    F(EGLBoolean, eglDestroySurface, (EGLDisplay, EGLSurface))                                                         \
    F(EGLContext, eglCreateContext, (EGLDisplay, EGLConfig, EGLContext, const EGLint *))                               \
    F(EGLBoolean, eglDestroyContext, (EGLDisplay, EGLContext))                                                         \
    F(EGLBoolean, eglMakeCurrent, (EGLDisplay, EGLSurface, EGLSurface, EGLContext))                                    \
    F(EGLDisplay, eglGetDisplay, (EGLNativeDisplayType))                                                               \
    F(const char *, eglQueryString, (EGLDisplay, EGLint))                                                              \
    F(EGLint, eglGetError, (void))                                                                                     \
    F(__eglMustCastToProperFunctionPointerType, eglGetProcAddress, (const char *))

/* EGL_ANGLE_platform_angle, EGL_ANGLE_platform_angle_vulkan and _device_type_swiftshader, which Khronos' headers lack. */
#ifndef EGL_PLATFORM_ANGLE_ANGLE
#define EGL_PLATFORM_ANGLE_ANGLE                         0x3202
#define EGL_PLATFORM_ANGLE_TYPE_ANGLE                    0x3203
#define EGL_PLATFORM_ANGLE_DEVICE_TYPE_ANGLE             0x3209
#define EGL_PLATFORM_ANGLE_TYPE_VULKAN_ANGLE             0x3450
#define EGL_PLATFORM_ANGLE_DEVICE_TYPE_SWIFTSHADER_ANGLE 0x3487
#endif

typedef struct egl_platform {
    platform base;
    void *egl_library, *gles_library;
#define MEMBER(type, name, parameters) type(EGLAPIENTRY *name) parameters;
    EGL_FUNCTIONS(MEMBER)
#undef MEMBER
    EGLDisplay display;
    EGLSurface surface;
    EGLContext context;
    int was_lost;
} egl_platform;

extern const platform_kind platform_egl, platform_angle;

enum { SURFACELESS, DEVICE, DEFAULT, ANGLE, WAYS };

/* A whole word of a list. */
static int has_word(const char *list, const char *word)
{
    const size_t length = strlen(word);

    for (const char *at = list; at && (at = strstr(at, word)) != NULL; at += length)
        if ((at == list || at[-1] == ' ') && (at[length] == ' ' || at[length] == '\0'))
            return 1;
    return 0;
}

static const char *load(egl_platform *e, const char *folder)
{
    static const char *const usual_egl[] = {"libEGL.so.1", "libEGL.so", NULL};
    static const char *const usual_gles[] = {"libGLESv2.so.2", "libGLESv2.so", NULL};
    char egl_path[1024], gles_path[1024];
    const char *const own_egl[] = {egl_path, NULL}, *const own_gles[] = {gles_path, NULL};
    const char *const *const egl_names = folder ? own_egl : usual_egl;
    const char *const *const gles_names = folder ? own_gles : usual_gles;

    if (folder) {
        snprintf(egl_path, sizeof egl_path, "%s/libEGL.so", folder);
        snprintf(gles_path, sizeof gles_path, "%s/libGLESv2.so", folder);
    }
    e->egl_library = platform_library(egl_names);
    if (!e->egl_library)
        return folder ? "there is no libEGL.so in the folder of GNOMON_ANGLE" : "there is no libEGL.so.1";
    e->gles_library = platform_library(gles_names); /* without it functions come from eglGetProcAddress */
#define LOAD(type, name, parameters)                                                                                   \
    e->name = (type(EGLAPIENTRY *) parameters)platform_symbol(e->egl_library, #name);                                  \
    if (!e->name)                                                                                                      \
        return "libEGL has no " #name;
    EGL_FUNCTIONS(LOAD)
#undef LOAD
    return NULL;
}

static EGLDisplay display_of(egl_platform *e, int way)
{
    const char *const extensions = e->eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    const PFNEGLGETPLATFORMDISPLAYEXTPROC get =
        (PFNEGLGETPLATFORMDISPLAYEXTPROC)(has_word(extensions, "EGL_EXT_platform_base")
                                              ? e->eglGetProcAddress("eglGetPlatformDisplayEXT")
                                              : NULL);

    if (way == ANGLE) {
        static const EGLint attributes[] = {EGL_PLATFORM_ANGLE_TYPE_ANGLE, EGL_PLATFORM_ANGLE_TYPE_VULKAN_ANGLE,
                                            EGL_PLATFORM_ANGLE_DEVICE_TYPE_ANGLE,
                                            EGL_PLATFORM_ANGLE_DEVICE_TYPE_SWIFTSHADER_ANGLE, EGL_NONE};

        return get && has_word(extensions, "EGL_ANGLE_platform_angle")
                   ? get(EGL_PLATFORM_ANGLE_ANGLE, (void *)EGL_DEFAULT_DISPLAY, attributes)
                   : EGL_NO_DISPLAY;
    }
    if (way == SURFACELESS)
        return get && has_word(extensions, "EGL_MESA_platform_surfaceless")
                   ? get(EGL_PLATFORM_SURFACELESS_MESA, (void *)EGL_DEFAULT_DISPLAY, NULL)
                   : EGL_NO_DISPLAY;
    if (way == DEVICE) {
        const PFNEGLQUERYDEVICESEXTPROC query =
            (PFNEGLQUERYDEVICESEXTPROC)(has_word(extensions, "EGL_EXT_device_enumeration") ||
                                                has_word(extensions, "EGL_EXT_device_base")
                                            ? e->eglGetProcAddress("eglQueryDevicesEXT")
                                            : NULL);
        EGLDeviceEXT device;
        EGLint count = 0;

        if (!get || !query || !has_word(extensions, "EGL_EXT_platform_device") || !query(1, &device, &count) ||
            count < 1)
            return EGL_NO_DISPLAY;
        return get(EGL_PLATFORM_DEVICE_EXT, device, NULL);
    }
    return e->eglGetDisplay(EGL_DEFAULT_DISPLAY);
}

/* The first with just the colours that are wanted, if there is one: EGL puts those with more before. */
static EGLConfig closest(egl_platform *e, const platform_desc *d, const EGLConfig *found, EGLint count)
{
    const EGLint names[4] = {EGL_RED_SIZE, EGL_GREEN_SIZE, EGL_BLUE_SIZE, EGL_ALPHA_SIZE};
    const int wanted[4] = {d->red_bits, d->green_bits, d->blue_bits, d->alpha_bits};

    for (EGLint i = 0; i < count; i++) {
        int same = 1;

        for (int c = 0; c < 4; c++) {
            EGLint bits = -1;

            e->eglGetConfigAttrib(e->display, found[i], names[c], &bits);
            same &= bits == wanted[c];
        }
        if (same)
            return found[i];
    }
    return found[0];
}

/* The config with the wanted bits, or with as many of them as there are: what a context lacks, its user says better. */
static int choose_config(egl_platform *e, const platform_desc *d, EGLConfig *config)
{
    for (int less = 0; less < 5; less++) { /* without alpha; 16 bits of depth; no stencil; 565 and nothing else */
        const EGLint wanted[] = {EGL_SURFACE_TYPE,
                                 EGL_PBUFFER_BIT,
                                 EGL_RENDERABLE_TYPE,
                                 EGL_OPENGL_ES2_BIT,
                                 EGL_RED_SIZE,
                                 less < 4 ? d->red_bits : 0,
                                 EGL_GREEN_SIZE,
                                 less < 4 ? d->green_bits : 0,
                                 EGL_BLUE_SIZE,
                                 less < 4 ? d->blue_bits : 0,
                                 EGL_ALPHA_SIZE,
                                 less < 1 ? d->alpha_bits : 0,
                                 EGL_DEPTH_SIZE,
                                 less < 2 || d->depth_bits < 16 ? d->depth_bits
                                 : less < 4                     ? 16
                                                                : 0,
                                 EGL_STENCIL_SIZE,
                                 less < 3 ? d->stencil_bits : 0,
                                 EGL_SAMPLES,
                                 0,
                                 EGL_NONE};
        EGLConfig found[64];
        EGLint count = 0;

        if (e->eglChooseConfig(e->display, wanted, found, 64, &count) && count > 0) {
            *config = closest(e, d, found, count);
            return 1;
        }
    }
    return 0;
}

/* Config, surface and context on an initialised display. Returns NULL or what failed. */
static const char *make(egl_platform *e, const platform_desc *d)
{
    const EGLint size[] = {EGL_WIDTH, (EGLint)d->width, EGL_HEIGHT, (EGLint)d->height, EGL_NONE};
    const EGLint version[] = {EGL_CONTEXT_CLIENT_VERSION, 2, EGL_NONE};
    const EGLint names[6] = {EGL_RED_SIZE,   EGL_GREEN_SIZE, EGL_BLUE_SIZE,
                             EGL_ALPHA_SIZE, EGL_DEPTH_SIZE, EGL_STENCIL_SIZE};
    int *const bits[6] = {&e->base.actual.red_bits,   &e->base.actual.green_bits, &e->base.actual.blue_bits,
                          &e->base.actual.alpha_bits, &e->base.actual.depth_bits, &e->base.actual.stencil_bits};
    EGLConfig config;
    EGLint width = 0, height = 0;

    if (!e->eglBindAPI(EGL_OPENGL_ES_API))
        return "it has no OpenGL ES";
    if (!choose_config(e, d, &config))
        return "it has no config for OpenGL ES 2.0 with a pbuffer";
    e->surface = e->eglCreatePbufferSurface(e->display, config, size);
    if (e->surface == EGL_NO_SURFACE || !e->eglQuerySurface(e->display, e->surface, EGL_WIDTH, &width) ||
        !e->eglQuerySurface(e->display, e->surface, EGL_HEIGHT, &height) || width != size[1] || height != size[3])
        return "it refuses a pbuffer of that size";
    e->context = e->eglCreateContext(e->display, config, EGL_NO_CONTEXT, version);
    if (e->context == EGL_NO_CONTEXT)
        return "it refuses an OpenGL ES 2.0 context";
    if (!e->eglMakeCurrent(e->display, e->surface, e->surface, e->context))
        return "it does not make the context current";
    e->base.actual = *d;
    for (int i = 0; i < 6; i++)
        e->eglGetConfigAttrib(e->display, config, names[i], bits[i]);
    return NULL;
}

static void close_display(egl_platform *e)
{
    if (e->display == EGL_NO_DISPLAY)
        return;
    e->eglMakeCurrent(e->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (e->context != EGL_NO_CONTEXT)
        e->eglDestroyContext(e->display, e->context);
    if (e->surface != EGL_NO_SURFACE)
        e->eglDestroySurface(e->display, e->surface);
    e->eglTerminate(e->display);
    e->display = EGL_NO_DISPLAY;
    e->context = EGL_NO_CONTEXT;
    e->surface = EGL_NO_SURFACE;
}

static void destroy(platform *p)
{
    egl_platform *e = (egl_platform *)p;

    if (e->egl_library)
        close_display(e);
    platform_release(e->gles_library);
    platform_release(e->egl_library);
    free(e);
}

/* By the ways from first to last. */
static platform *create_by(const platform_kind *kind, int first, int last, const char *folder,
                           const platform_desc *desc, char message[PLATFORM_MESSAGE])
{
    static const char *const ways[WAYS] = {"surfaceless", "device", "default", "SwiftShader"};
    egl_platform *e = calloc(1, sizeof *e);
    const char *failure = e ? load(e, folder) : "no memory";
    size_t length = 0;

    if (failure) {
        snprintf(message, PLATFORM_MESSAGE, "%s", failure);
        if (e) {
            platform_release(e->gles_library);
            platform_release(e->egl_library);
            free(e);
        }
        return NULL;
    }
    e->base.kind = kind;
    e->display = EGL_NO_DISPLAY;
    for (int way = first; way <= last; way++) {
        const EGLDisplay display = display_of(e, way);
        EGLint error = EGL_SUCCESS;

        if (display == EGL_NO_DISPLAY) {
            failure = "there is none";
        } else if (!e->eglInitialize(display, NULL, NULL)) {
            failure = "it does not start";
            error = e->eglGetError();
        } else {
            e->display = display;
            failure = make(e, desc);
            if (!failure) {
                e->base.detail = ways[way];
                return &e->base;
            }
            error = e->eglGetError(); /* before cleaning up calls EGL again */
            close_display(e);
        }
        if (length < PLATFORM_MESSAGE)
            length += (size_t)snprintf(message + length, PLATFORM_MESSAGE - length, "%s%s display: %s (0x%04x)",
                                       length ? ", " : "", ways[way], failure, (unsigned)error);
    }
    destroy(&e->base);
    return NULL;
}

static platform *create(const platform_desc *desc, char message[PLATFORM_MESSAGE])
{
    return create_by(&platform_egl, SURFACELESS, DEFAULT, NULL, desc, message);
}

static platform *create_angle(const platform_desc *desc, char message[PLATFORM_MESSAGE])
{
    const char *folder = getenv("GNOMON_ANGLE");

    if (folder && strlen(folder) < 1000)
        return create_by(&platform_angle, ANGLE, ANGLE, folder, desc, message);
    snprintf(message, PLATFORM_MESSAGE, "GNOMON_ANGLE names no folder");
    return NULL;
}

static int make_current(platform *p)
{
    egl_platform *e = (egl_platform *)p;

    if (e->eglMakeCurrent(e->display, e->surface, e->surface, e->context))
        return 1;
    e->was_lost |= e->eglGetError() == EGL_CONTEXT_LOST;
    return 0;
}

static int lost(platform *p)
{
    return !make_current(p) && ((egl_platform *)p)->was_lost;
}

static void (*get_proc(platform *p, const char *name))(void)
{
    egl_platform *e = (egl_platform *)p;
    void (*const core)(void) = e->gles_library ? platform_symbol(e->gles_library, name) : NULL;

    return core ? core : e->eglGetProcAddress(name);
}

const platform_kind platform_egl = {"egl", create, make_current, get_proc, lost, destroy};
const platform_kind platform_angle = {"angle", create_angle, make_current, get_proc, lost, destroy};
