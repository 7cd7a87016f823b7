/* load.c - fills the function table from a platform's look-up. Extensions' functions come last, by the name that they
 * have in the family of the context: many a look-up finds something under any name. */
#include "gn_gl.h"

#include <string.h>

static int is_desktop(const gn_gl *gl)
{
    const GLubyte *const version = gl->glGetString(GL_VERSION);

    return version && strncmp((const char *)version, "OpenGL ES", 9) != 0;
}

/* Names in the order of the table; of an extension's function "?" and both. */
static const char names[] =
#define GN_GL_PROC(name, parameters, arguments)            #name "\0"
#define GN_GL_FUNC(type, name, parameters, arguments)      #name "\0"
#define GN_GL_OPTIONAL(name, other, parameters, arguments) "?" #name "\0" #other "\0"
#include "gl_funcs.h"
#undef GN_GL_PROC
#undef GN_GL_FUNC
#undef GN_GL_OPTIONAL
    ;

const char *gn_gl_load(gn_gl *gl, gn_get_proc get_proc, void *user)
{
    unsigned char *to = (unsigned char *)gl; /* pointers to functions, and nothing else */
    int desktop = -1;

    for (const char *name = names; *name; name += strlen(name) + 1, to += sizeof(gn_proc)) {
        gn_proc found;

        if (*name == '?') {
            if (desktop < 0)
                desktop = is_desktop(gl);
            found = get_proc(user, desktop ? name + strlen(name) + 1 : name + 1);
            name += strlen(name) + 1;
        } else if (!(found = get_proc(user, name))) {
            return name;
        }
        memcpy(to, &found, sizeof found);
    }
    return NULL;
}
