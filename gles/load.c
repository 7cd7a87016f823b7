/* load.c - fills the function table from a platform's look-up. */
#include "gn_gl.h"

#include <stddef.h>

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
#include "gl_funcs.h"
#undef GN_GL_PROC
#undef GN_GL_FUNC
    return NULL;
}
