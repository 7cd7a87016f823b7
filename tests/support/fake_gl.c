/* fake_gl.c - made from the library's own list of functions: each does nothing but say that it was called. */
#include "fake_gl.h"

#include <string.h>

#pragma GCC diagnostic ignored "-Wunused-parameter"

#define MOST 20000

const char *fake_gl_missing;
int fake_gl_refuses_shaders, fake_gl_out_of_memory;
long fake_gl_live_names, fake_gl_last_count;
float fake_gl_clear_depth;

static const char *calls[MOST];
static size_t call_count;

static void note(const char *name)
{
    if (call_count < MOST)
        calls[call_count++] = name;
}

#define GN_GL_PROC(name, parameters, arguments)                                                                        \
    static void GL_APIENTRY null_##name parameters                                                                     \
    {                                                                                                                  \
        note(#name);                                                                                                   \
    }
#define GN_GL_FUNC(type, name, parameters, arguments)                                                                  \
    static type GL_APIENTRY null_##name parameters                                                                     \
    {                                                                                                                  \
        note(#name);                                                                                                   \
        return (type)0;                                                                                                \
    }
#include "gl_funcs.h"
#undef GN_GL_PROC
#undef GN_GL_FUNC

static GLuint GL_APIENTRY make_shader(GLenum type)
{
    note("glCreateShader");
    return ++fake_gl_live_names, 7;
}

static GLuint GL_APIENTRY make_program(void)
{
    note("glCreateProgram");
    return ++fake_gl_live_names, 9;
}

static void GL_APIENTRY drop_object(GLuint name)
{
    note("glDelete");
    fake_gl_live_names -= name != 0;
}

static void GL_APIENTRY status(GLuint name, GLenum pname, GLint *params)
{
    note("glGetiv");
    *params = !fake_gl_refuses_shaders;
}

static void GL_APIENTRY log_of(GLuint name, GLsizei size, GLsizei *length, GLchar *log)
{
    note("glGetInfoLog");
    log[0] = '\0';
}

static void GL_APIENTRY make_buffers(GLsizei n, GLuint *names)
{
    note("glGenBuffers");
    for (GLsizei i = 0; i < n; i++)
        names[i] = 11;
    fake_gl_live_names += n;
}

static void GL_APIENTRY drop_buffers(GLsizei n, const GLuint *names)
{
    note("glDeleteBuffers");
    for (GLsizei i = 0; i < n; i++)
        fake_gl_live_names -= names[i] != 0;
}

static void GL_APIENTRY integers(GLenum pname, GLint *data)
{
    note("glGetIntegerv");
    *data = 8;
}

static GLenum GL_APIENTRY error(void)
{
    note("glGetError");
    return fake_gl_out_of_memory ? GL_OUT_OF_MEMORY : GL_NO_ERROR;
}

static void GL_APIENTRY elements(GLenum mode, GLsizei count, GLenum type, const void *indices)
{
    note("glDrawElements");
    fake_gl_last_count = count;
}

static void GL_APIENTRY clear_depth(GLfloat depth)
{
    note("glClearDepthf");
    fake_gl_clear_depth = depth;
}

gn_proc fake_gl_get_proc(void *user, const char *name)
{
    static const struct {
        const char *name;
        gn_proc function;
    } special[] = {
        {"glCreateShader", (gn_proc)make_shader}, {"glCreateProgram", (gn_proc)make_program},
        {"glDeleteShader", (gn_proc)drop_object}, {"glDeleteProgram", (gn_proc)drop_object},
        {"glGetShaderiv", (gn_proc)status},       {"glGetProgramiv", (gn_proc)status},
        {"glGetShaderInfoLog", (gn_proc)log_of},  {"glGetProgramInfoLog", (gn_proc)log_of},
        {"glGenBuffers", (gn_proc)make_buffers},  {"glDeleteBuffers", (gn_proc)drop_buffers},
        {"glGetIntegerv", (gn_proc)integers},     {"glGetError", (gn_proc)error},
        {"glDrawElements", (gn_proc)elements},    {"glClearDepthf", (gn_proc)clear_depth},
    };

    if (fake_gl_missing && strcmp(name, fake_gl_missing) == 0)
        return NULL;
    for (size_t i = 0; i < sizeof special / sizeof special[0]; i++)
        if (strcmp(special[i].name, name) == 0)
            return special[i].function;
#define GN_GL_PROC(function, parameters, arguments)                                                                    \
    if (strcmp(name, #function) == 0)                                                                                  \
        return (gn_proc)null_##function;
#define GN_GL_FUNC(type, function, parameters, arguments) GN_GL_PROC(function, parameters, arguments)
#include "gl_funcs.h"
#undef GN_GL_PROC
#undef GN_GL_FUNC
    return NULL;
}

void fake_gl_reset(void)
{
    call_count = 0;
    fake_gl_missing = NULL;
    fake_gl_refuses_shaders = fake_gl_out_of_memory = 0;
}

size_t fake_gl_calls(const char *name)
{
    size_t count = 0;

    for (size_t i = 0; i < call_count; i++)
        count += strcmp(calls[i], name) == 0;
    return count;
}

const char *fake_gl_call(size_t n)
{
    return n < call_count ? calls[n] : NULL;
}
