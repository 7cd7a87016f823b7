/* gn_gl.h - OpenGL ES 2.0 through a table of pointers, so that two platforms live in one process, no GL library is
 * linked, and tests count, record or fail calls (DESIGN.md, decision 13). */
#ifndef GN_GL_H
#define GN_GL_H
#include <GLES2/gl2.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct gn_gl {
#define GN_GL_PROC(name, parameters, arguments)       void(GL_APIENTRY * name) parameters;
#define GN_GL_FUNC(type, name, parameters, arguments) type(GL_APIENTRY *name) parameters;
#include "gl_funcs.h"
#undef GN_GL_PROC
#undef GN_GL_FUNC
} gn_gl;

/* Any function pointer; cast back before the call. */
typedef void (*gn_proc)(void);

/* Finds a function by name, core functions too (EGL 1.4 promises only extensions from eglGetProcAddress, so
 * platforms look in the client library first). NULL where there is none; a pointer alone proves nothing. */
typedef gn_proc (*gn_get_proc)(void *user, const char *name);

/* Fills the table. Returns NULL, or the name of the first function that was not found. */
const char *gn_gl_load(gn_gl *gl, gn_get_proc get_proc, void *user);

#ifdef __cplusplus
}
#endif
#endif
