/* load.c - fills the function table from a platform's look-up. Extensions' functions come last, by the name that they
 * have in the family of the context: many a look-up finds something under any name. */
#include "gn_gl.h"

#include <stddef.h>
#include <string.h>

static int is_desktop(const gn_gl *gl)
{
    const GLubyte *const version = gl->glGetString(GL_VERSION);

    return version && strncmp((const char *)version, "OpenGL ES", 9) != 0;
}

const char *gn_gl_load(gn_gl *gl, gn_get_proc get_proc, void *user)
{
#define GN_GL_PROC(name, parameters, arguments)                                                                        \
    gl->name = (void(GL_APIENTRY *) parameters)get_proc(user, #name);                                                  \
    if (!gl->name)                                                                                                     \
        return #name;
#define GN_GL_FUNC(type, name, parameters, arguments)                                                                  \
    gl->name = (type(GL_APIENTRY *) parameters)get_proc(user, #name);                                                  \
    if (!gl->name)                                                                                                     \
        return #name;
#define GN_GL_OPTIONAL(name, other, parameters, arguments)                                                             \
    gl->name = (void(GL_APIENTRY *) parameters)get_proc(user, is_desktop(gl) ? #other : #name);
#include "gl_funcs.h"
#undef GN_GL_PROC
#undef GN_GL_FUNC
#undef GN_GL_OPTIONAL
    return NULL;
}
