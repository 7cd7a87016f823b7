/* counted_gl.c - wrappers made from the function list: those named below count, the others are passed through as they
 * are.
 *
 * GL functions carry no user pointer, so the counters are the process's: a tool's business, never the library's. */
#include "counted_gl.h"

#include <string.h>

static gn_get_proc given_get_proc;
static void *given_user;
static gn_proc (*replace)(const char *name, gn_proc real);
static gn_gl real;
static gl_counts counts;

static uint64_t texel_bytes(GLenum format, GLenum type)
{
    const uint64_t channels = format == GL_RGBA ? 4 : format == GL_RGB ? 3 : format == GL_LUMINANCE_ALPHA ? 2 : 1;

    return type == GL_UNSIGNED_BYTE ? channels : 2;
}

static void GL_APIENTRY counted_glDrawArrays(GLenum mode, GLint first, GLsizei count)
{
    counts.draws++;
    counts.vertices += (uint64_t)count;
    real.glDrawArrays(mode, first, count);
}

static void GL_APIENTRY counted_glDrawElements(GLenum mode, GLsizei count, GLenum type, const void *indices)
{
    counts.draws++;
    counts.vertices += (uint64_t)count;
    counts.indices += (uint64_t)count;
    real.glDrawElements(mode, count, type, indices);
}

static void GL_APIENTRY counted_glBufferData(GLenum target, GLsizeiptr size, const void *data, GLenum usage)
{
    counts.bytes_sent += data ? (uint64_t)size : 0;
    real.glBufferData(target, size, data, usage);
}

static void GL_APIENTRY counted_glBufferSubData(GLenum target, GLintptr offset, GLsizeiptr size, const void *data)
{
    counts.bytes_sent += (uint64_t)size;
    real.glBufferSubData(target, offset, size, data);
}

static void GL_APIENTRY counted_glTexImage2D(GLenum target, GLint level, GLint internal_format, GLsizei width,
                                             GLsizei height, GLint border, GLenum format, GLenum type,
                                             const void *pixels)
{
    counts.bytes_sent += pixels ? (uint64_t)width * (uint64_t)height * texel_bytes(format, type) : 0;
    real.glTexImage2D(target, level, internal_format, width, height, border, format, type, pixels);
}

#define UNIFORMS(F)                                                                                                    \
    F(glUniform1f, (GLint l, GLfloat v), (l, v), 4)                                                                    \
    F(glUniform1i, (GLint l, GLint v), (l, v), 4)                                                                      \
    F(glUniform2fv, (GLint l, GLsizei n, const GLfloat *v), (l, n, v), 8 * (uint64_t)n)                                \
    F(glUniform3fv, (GLint l, GLsizei n, const GLfloat *v), (l, n, v), 12 * (uint64_t)n)                               \
    F(glUniform4fv, (GLint l, GLsizei n, const GLfloat *v), (l, n, v), 16 * (uint64_t)n)                               \
    F(glUniformMatrix3fv, (GLint l, GLsizei n, GLboolean t, const GLfloat *v), (l, n, t, v), 36 * (uint64_t)n)         \
    F(glUniformMatrix4fv, (GLint l, GLsizei n, GLboolean t, const GLfloat *v), (l, n, t, v), 64 * (uint64_t)n)

#define STATES(F)                                                                                                      \
    F(glActiveTexture, (GLenum a), (a), 0)                                                                             \
    F(glBindBuffer, (GLenum a, GLuint b), (a, b), 0)                                                                   \
    F(glBindTexture, (GLenum a, GLuint b), (a, b), 0)                                                                  \
    F(glBlendEquation, (GLenum a), (a), 0)                                                                             \
    F(glBlendFunc, (GLenum a, GLenum b), (a, b), 0)                                                                    \
    F(glClearColor, (GLfloat a, GLfloat b, GLfloat c, GLfloat d), (a, b, c, d), 0)                                     \
    F(glClearDepthf, (GLfloat a), (a), 0)                                                                              \
    F(glClearStencil, (GLint a), (a), 0)                                                                               \
    F(glColorMask, (GLboolean a, GLboolean b, GLboolean c, GLboolean d), (a, b, c, d), 0)                              \
    F(glCullFace, (GLenum a), (a), 0)                                                                                  \
    F(glDepthFunc, (GLenum a), (a), 0)                                                                                 \
    F(glDepthMask, (GLboolean a), (a), 0)                                                                              \
    F(glDisable, (GLenum a), (a), 0)                                                                                   \
    F(glDisableVertexAttribArray, (GLuint a), (a), 0)                                                                  \
    F(glEnable, (GLenum a), (a), 0)                                                                                    \
    F(glEnableVertexAttribArray, (GLuint a), (a), 0)                                                                   \
    F(glFrontFace, (GLenum a), (a), 0)                                                                                 \
    F(glPolygonOffset, (GLfloat a, GLfloat b), (a, b), 0)                                                              \
    F(glScissor, (GLint a, GLint b, GLsizei c, GLsizei d), (a, b, c, d), 0)                                            \
    F(glStencilFunc, (GLenum a, GLint b, GLuint c), (a, b, c), 0)                                                      \
    F(glStencilFuncSeparate, (GLenum a, GLenum b, GLint c, GLuint d), (a, b, c, d), 0)                                 \
    F(glStencilMask, (GLuint a), (a), 0)                                                                               \
    F(glStencilOp, (GLenum a, GLenum b, GLenum c), (a, b, c), 0)                                                       \
    F(glStencilOpSeparate, (GLenum a, GLenum b, GLenum c, GLenum d), (a, b, c, d), 0)                                  \
    F(glUseProgram, (GLuint a), (a), 0)                                                                                \
    F(glVertexAttribPointer, (GLuint a, GLint b, GLenum c, GLboolean d, GLsizei e, const void *f), (a, b, c, d, e, f), \
      0)                                                                                                               \
    F(glViewport, (GLint a, GLint b, GLsizei c, GLsizei d), (a, b, c, d), 0)

#define WRAP_UNIFORM(name, parameters, arguments, bytes)                                                               \
    static void GL_APIENTRY counted_##name parameters                                                                  \
    {                                                                                                                  \
        counts.bytes_sent += bytes;                                                                                    \
        real.name arguments;                                                                                           \
    }
#define WRAP_STATE(name, parameters, arguments, bytes)                                                                 \
    static void GL_APIENTRY counted_##name parameters                                                                  \
    {                                                                                                                  \
        counts.state_changes++;                                                                                        \
        real.name arguments;                                                                                           \
    }
UNIFORMS(WRAP_UNIFORM)
STATES(WRAP_STATE)

static gn_proc real_get_proc(void *user, const char *name)
{
    const gn_proc found = given_get_proc(given_user, name);

    (void)user;
    return replace ? replace(name, found) : found;
}

void counted_gl_wrap(gn_get_proc get_proc, void *user, gn_proc (*replacement)(const char *name, gn_proc real))
{
    given_get_proc = get_proc;
    given_user = user;
    replace = replacement;
    memset(&counts, 0, sizeof counts);
    gn_gl_load(&real, real_get_proc, NULL); /* what is missing is found out again by the library, which says so */
}

gn_proc counted_get_proc(void *user, const char *name)
{
    const gn_proc found = real_get_proc(NULL, name);

    (void)user;
    if (!found)
        return NULL;
#define FIND(function, parameters, arguments, bytes)                                                                   \
    if (strcmp(name, #function) == 0)                                                                                  \
        return (gn_proc)counted_##function;
    FIND(glDrawArrays, , , )
    FIND(glDrawElements, , , )
    FIND(glBufferData, , , )
    FIND(glBufferSubData, , , )
    FIND(glTexImage2D, , , )
    UNIFORMS(FIND)
    STATES(FIND)
    return found;
}

gl_counts counted_gl_read(void)
{
    return counts;
}
