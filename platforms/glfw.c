/* glfw.c - a window by GLFW 3.3, opened at run time: a context through EGL, else by the window system's own API, else
 * OSMesa's, whose window stays black and is for reading back.
 *
 * The window is hidden until it is shown, and draws all the same. One window in a process, since GLFW is the process's. */
#include "window.h"

#define GLFW_INCLUDE_NONE
#include <GLES2/gl2.h>
#include <GLFW/glfw3.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* GLFW's functions that are used, once each: type, name, parameters. */
#define FUNCTIONS(F)                                                                                                   \
    F(int, glfwInit, (void))                                                                                           \
    F(void, glfwTerminate, (void))                                                                                     \
    F(int, glfwGetError, (const char **description))                                                                   \
    F(void, glfwDefaultWindowHints, (void))                                                                            \
    F(void, glfwWindowHint, (int hint, int value))                                                                     \
    F(GLFWwindow *, glfwCreateWindow,                                                                                  \
      (int width, int height, const char *title, GLFWmonitor *monitor, GLFWwindow *share))                             \
    F(void, glfwDestroyWindow, (GLFWwindow * window))                                                                  \
    F(void, glfwMakeContextCurrent, (GLFWwindow * window))                                                             \
    F(GLFWglproc, glfwGetProcAddress, (const char *name))                                                              \
    F(void, glfwGetFramebufferSize, (GLFWwindow * window, int *width, int *height))                                    \
    F(void, glfwGetWindowSize, (GLFWwindow * window, int *width, int *height))                                         \
    F(void, glfwSetWindowSize, (GLFWwindow * window, int width, int height))                                           \
    F(void, glfwSetWindowTitle, (GLFWwindow * window, const char *title))                                              \
    F(void, glfwGetWindowContentScale, (GLFWwindow * window, float *x, float *y))                                      \
    F(void, glfwShowWindow, (GLFWwindow * window))                                                                     \
    F(void, glfwPollEvents, (void))                                                                                    \
    F(void, glfwSwapBuffers, (GLFWwindow * window))                                                                    \
    F(void, glfwSwapInterval, (int interval))                                                                          \
    F(GLFWkeyfun, glfwSetKeyCallback, (GLFWwindow * window, GLFWkeyfun callback))                                      \
    F(GLFWmousebuttonfun, glfwSetMouseButtonCallback, (GLFWwindow * window, GLFWmousebuttonfun callback))              \
    F(GLFWcursorposfun, glfwSetCursorPosCallback, (GLFWwindow * window, GLFWcursorposfun callback))                    \
    F(GLFWscrollfun, glfwSetScrollCallback, (GLFWwindow * window, GLFWscrollfun callback))                             \
    F(GLFWframebuffersizefun, glfwSetFramebufferSizeCallback, (GLFWwindow * window, GLFWframebuffersizefun callback))  \
    F(GLFWwindowclosefun, glfwSetWindowCloseCallback, (GLFWwindow * window, GLFWwindowclosefun callback))              \
    F(void, glfwSetWindowShouldClose, (GLFWwindow * window, int value))

enum { QUEUE = 256 };

typedef struct glfw_platform {
    platform base;
    void *library;
#define POINTER(type, name, parameters) type(*name) parameters;
    FUNCTIONS(POINTER)
#undef POINTER
    GLFWwindow *window;
    int is_started;
    GLenum(GL_APIENTRY *reset_status)(void); /* NULL where it is not told */
    int was_lost;
    window_event queue[QUEUE]; /* a ring; what does not fit is dropped */
    unsigned first, count;
    double x, y; /* of the pointer */
} glfw_platform;

extern const platform_kind platform_glfw, platform_glfw_native, platform_glfw_osmesa;

static glfw_platform *open_one; /* whose window calls back */

/* ------------------------------------------------------------------ events */

/* Moves in a row are one; where the queue is full a new size and the wish to close still take the last place. */
static window_event *push(glfw_platform *g, window_event_kind kind)
{
    static window_event dropped;
    window_event *last = g->count ? &g->queue[(g->first + g->count - 1) % QUEUE] : NULL, *e = &dropped;

    if (last && last->kind == WINDOW_MOVE && kind == WINDOW_MOVE)
        e = last;
    else if (g->count < QUEUE)
        e = &g->queue[(g->first + g->count++) % QUEUE];
    else if (kind == WINDOW_RESIZE || kind == WINDOW_CLOSE)
        e = last;
    memset(e, 0, sizeof *e);
    e->kind = kind;
    e->x = g->x;
    e->y = g->y;
    return e;
}

static unsigned modifiers_of(int mods)
{
    return (mods & GLFW_MOD_SHIFT ? WINDOW_SHIFT : 0u) | (mods & GLFW_MOD_CONTROL ? WINDOW_CONTROL : 0u);
}

static int key_of(int key)
{
    switch (key) {
    case GLFW_KEY_ESCAPE:
        return WINDOW_ESCAPE;
    case GLFW_KEY_LEFT:
        return WINDOW_LEFT;
    case GLFW_KEY_RIGHT:
        return WINDOW_RIGHT;
    case GLFW_KEY_UP:
        return WINDOW_UP;
    case GLFW_KEY_DOWN:
        return WINDOW_DOWN;
    default:
        return key < 128 ? key : 0;
    }
}

static void on_key(GLFWwindow *window, int key, int scancode, int action, int mods)
{
    window_event *e;

    (void)window;
    (void)scancode;
    if (action == GLFW_REPEAT)
        return;
    e = push(open_one, action == GLFW_RELEASE ? WINDOW_KEY_UP : WINDOW_KEY);
    e->key = key_of(key);
    e->modifiers = modifiers_of(mods);
}

static void on_button(GLFWwindow *window, int button, int action, int mods)
{
    window_event *e = push(open_one, action == GLFW_PRESS ? WINDOW_PRESS : WINDOW_RELEASE);

    (void)window;
    e->button = button;
    e->modifiers = modifiers_of(mods);
}

static void on_move(GLFWwindow *window, double x, double y)
{
    glfw_platform *g = open_one;
    int width = 0, height = 0;

    g->glfwGetWindowSize(window, &width, &height);
    g->x = width > 0 ? x * g->base.actual.width / width : x;
    g->y = height > 0 ? y * g->base.actual.height / height : y;
    push(g, WINDOW_MOVE);
}

static void on_scroll(GLFWwindow *window, double x, double y)
{
    (void)window;
    (void)x;
    push(open_one, WINDOW_SCROLL)->y = y;
}

/* platform.actual follows when the event is taken: what is drawn until then is of the old size. */
static void on_resize(GLFWwindow *window, int width, int height)
{
    window_event *e;

    (void)window;
    if (width < 1 || height < 1) /* it is an icon now */
        return;
    e = push(open_one, WINDOW_RESIZE);
    e->x = width;
    e->y = height;
}

static void on_close(GLFWwindow *window)
{
    glfw_platform *g = open_one;

    g->glfwSetWindowShouldClose(window, 0);
    push(g, WINDOW_CLOSE);
}

/* ------------------------------------------------------------------ opening */

static const char *load(glfw_platform *g)
{
    static const char *const names[] = {"libglfw.so.3", "libglfw.3.dylib", "glfw3.dll", NULL};
    int ok = 1;

    g->library = platform_library(names);
    if (!g->library)
        return "there is no libglfw.so.3";
#define FIND(type, name, parameters)                                                                                   \
    g->name = (type(*) parameters)platform_symbol(g->library, #name);                                                  \
    ok = ok && g->name;
    FUNCTIONS(FIND)
#undef FIND
    return ok ? NULL : "the library lacks a function: 3.3 is needed";
}

/* What GLFW says of its last failure. */
static const char *reason(const glfw_platform *g)
{
    const char *text = NULL;

    g->glfwGetError(&text);
    return text ? text : "it does not say why";
}

static GLFWwindow *make_window(glfw_platform *g, const platform_desc *d, int api, int is_robust)
{
    const struct {
        int hint, value;
    } hints[] = {{GLFW_CLIENT_API, api == GLFW_OSMESA_CONTEXT_API ? GLFW_OPENGL_API : GLFW_OPENGL_ES_API},
                 {GLFW_CONTEXT_VERSION_MAJOR, 2},
                 {GLFW_CONTEXT_VERSION_MINOR, api == GLFW_OSMESA_CONTEXT_API ? 1 : 0},
                 {GLFW_CONTEXT_CREATION_API, api},
                 {GLFW_CONTEXT_ROBUSTNESS, is_robust ? GLFW_LOSE_CONTEXT_ON_RESET : GLFW_NO_ROBUSTNESS},
                 {GLFW_RED_BITS, d->red_bits},
                 {GLFW_GREEN_BITS, d->green_bits},
                 {GLFW_BLUE_BITS, d->blue_bits},
                 {GLFW_ALPHA_BITS, d->alpha_bits},
                 {GLFW_DEPTH_BITS, d->depth_bits},
                 {GLFW_STENCIL_BITS, d->stencil_bits},
                 {GLFW_VISIBLE, GLFW_FALSE}};

    g->glfwDefaultWindowHints();
    for (size_t i = 0; i < sizeof hints / sizeof hints[0]; i++)
        g->glfwWindowHint(hints[i].hint, hints[i].value);
    return g->glfwCreateWindow((int)d->width, (int)d->height, "gnomon", NULL, NULL);
}

static void read_size(glfw_platform *g)
{
    int width = 0, height = 0;

    g->glfwGetFramebufferSize(g->window, &width, &height);
    g->base.actual.width = (uint32_t)width;
    g->base.actual.height = (uint32_t)height;
}

static void read_bits(glfw_platform *g)
{
    void(GL_APIENTRY * get)(GLenum, GLint *) =
        (void(GL_APIENTRY *)(GLenum, GLint *))g->glfwGetProcAddress("glGetIntegerv");
    static const GLenum names[6] = {GL_RED_BITS,   GL_GREEN_BITS, GL_BLUE_BITS,
                                    GL_ALPHA_BITS, GL_DEPTH_BITS, GL_STENCIL_BITS};
    int *const bits[6] = {&g->base.actual.red_bits,   &g->base.actual.green_bits, &g->base.actual.blue_bits,
                          &g->base.actual.alpha_bits, &g->base.actual.depth_bits, &g->base.actual.stencil_bits};

    for (int i = 0; i < 6; i++)
        get(names[i], bits[i]);
}

static void destroy(platform *p)
{
    glfw_platform *g = (glfw_platform *)p;

    if (open_one == g)
        open_one = NULL;
    if (g->window)
        g->glfwDestroyWindow(g->window);
    if (g->is_started)
        g->glfwTerminate();
    platform_release(g->library);
    free(g);
}

/* On a screen that counts points the surface has more pixels than were asked for: then a smaller window. */
static void fit_size(glfw_platform *g, const platform_desc *d)
{
    read_size(g);
    if (g->base.actual.width == d->width && g->base.actual.height == d->height)
        return;
    window_resize(&g->base, d->width, d->height);
    g->glfwPollEvents();
    read_size(g);
}

/* Returns NULL or what failed. */
static const char *start(glfw_platform *g, const platform_desc *d, const int *apis, int api_count)
{
    if (open_one)
        return "one window is open already";
    if (!g->glfwInit())
        return reason(g);
    g->is_started = 1;
    for (int i = 0; i < 2 * api_count && !g->window; i++) { /* each also without being told of lost contexts */
        g->window = make_window(g, d, apis[i / 2], i % 2 == 0);
        g->base.detail = apis[i / 2] == GLFW_EGL_CONTEXT_API      ? "EGL"
                         : apis[i / 2] == GLFW_NATIVE_CONTEXT_API ? "native"
                                                                  : "OSMesa";
    }
    if (!g->window)
        return reason(g);
    open_one = g;
    g->glfwMakeContextCurrent(g->window);
    g->glfwSetKeyCallback(g->window, on_key);
    g->glfwSetMouseButtonCallback(g->window, on_button);
    g->glfwSetCursorPosCallback(g->window, on_move);
    g->glfwSetScrollCallback(g->window, on_scroll);
    g->glfwSetFramebufferSizeCallback(g->window, on_resize);
    g->glfwSetWindowCloseCallback(g->window, on_close);
    g->base.actual = *d;
    read_bits(g);
    fit_size(g, d);
    g->count = 0;
    g->reset_status = (GLenum(GL_APIENTRY *)(void))g->glfwGetProcAddress("glGetGraphicsResetStatusEXT");
    return NULL;
}

static platform *create_of(const platform_kind *kind, const platform_desc *desc, const int *apis, int api_count,
                           char message[PLATFORM_MESSAGE])
{
    glfw_platform *g = calloc(1, sizeof *g);
    const char *failure = g ? load(g) : "no memory";

    if (g)
        g->base.kind = kind;
    if (!failure)
        failure = start(g, desc, apis, api_count);
    if (!failure)
        return &g->base;
    snprintf(message, PLATFORM_MESSAGE, "%s", failure);
    if (g)
        destroy(&g->base);
    return NULL;
}

static platform *create(const platform_desc *desc, char message[PLATFORM_MESSAGE])
{
    static const int apis[] = {GLFW_EGL_CONTEXT_API, GLFW_NATIVE_CONTEXT_API};

    return create_of(&platform_glfw, desc, apis, 2, message);
}

static platform *create_native(const platform_desc *desc, char message[PLATFORM_MESSAGE])
{
    static const int apis[] = {GLFW_NATIVE_CONTEXT_API};

    return create_of(&platform_glfw_native, desc, apis, 1, message);
}

static platform *create_osmesa(const platform_desc *desc, char message[PLATFORM_MESSAGE])
{
    static const int apis[] = {GLFW_OSMESA_CONTEXT_API};

    return create_of(&platform_glfw_osmesa, desc, apis, 1, message);
}

static int make_current(platform *p)
{
    glfw_platform *g = (glfw_platform *)p;

    g->glfwGetError(NULL); /* of before */
    g->glfwMakeContextCurrent(g->window);
    return g->glfwGetError(NULL) == GLFW_NO_ERROR;
}

static void (*get_proc(platform *p, const char *name))(void)
{
    return ((glfw_platform *)p)->glfwGetProcAddress(name);
}

static int lost(platform *p)
{
    glfw_platform *g = (glfw_platform *)p;

    g->was_lost |= g->reset_status && g->reset_status() != GL_NO_ERROR;
    return g->was_lost;
}

const platform_kind platform_glfw = {"glfw", create, make_current, get_proc, lost, destroy};
const platform_kind platform_glfw_native = {"glfw-native", create_native, make_current, get_proc, lost, destroy};
const platform_kind platform_glfw_osmesa = {"glfw-osmesa", create_osmesa, make_current, get_proc, lost, destroy};

/* ------------------------------------------------------------------ the window */

int window_exists(const platform *p)
{
    return p->kind->create == create || p->kind->create == create_native || p->kind->create == create_osmesa;
}

void window_show(platform *p, const char *title)
{
    glfw_platform *g = (glfw_platform *)p;

    g->glfwSetWindowTitle(g->window, title);
    g->glfwShowWindow(g->window);
    g->glfwSwapInterval(1);
}

int window_poll(platform *p, window_event *event)
{
    glfw_platform *g = (glfw_platform *)p;

    if (!g->count)
        g->glfwPollEvents();
    if (!g->count)
        return 0;
    *event = g->queue[g->first];
    g->first = (g->first + 1) % QUEUE;
    g->count--;
    if (event->kind == WINDOW_RESIZE) {
        p->actual.width = (uint32_t)event->x;
        p->actual.height = (uint32_t)event->y;
    }
    return 1;
}

void window_present(platform *p)
{
    glfw_platform *g = (glfw_platform *)p;

    g->glfwSwapBuffers(g->window);
}

void window_resize(platform *p, uint32_t width, uint32_t height)
{
    glfw_platform *g = (glfw_platform *)p;
    int points[2] = {0, 0};

    g->glfwGetWindowSize(g->window, &points[0], &points[1]);
    if (g->base.actual.width == 0 || g->base.actual.height == 0)
        return;
    g->glfwSetWindowSize(g->window, (int)((double)width * points[0] / g->base.actual.width + 0.5),
                         (int)((double)height * points[1] / g->base.actual.height + 0.5));
}

double window_scale(const platform *p)
{
    const glfw_platform *g = (const glfw_platform *)p;
    float x = 1.0f, y = 1.0f;

    g->glfwGetWindowContentScale(g->window, &x, &y);
    return x >= 1.0f ? (double)x : 1.0;
}
