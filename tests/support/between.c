/* between.c - see between.h. */
#include "between.h"

#include <string.h>

gn_gl between_real;

gn_proc between_take(const char *name, gn_proc found, const between *list, size_t count)
{
#define GN_GL_PROC(function, parameters, arguments)                                                                    \
    if (strcmp(name, #function) == 0)                                                                                  \
        between_real.function = (void(GL_APIENTRY *) parameters)found;
#define GN_GL_FUNC(type, function, parameters, arguments)                                                              \
    if (strcmp(name, #function) == 0)                                                                                  \
        between_real.function = (type(GL_APIENTRY *) parameters)found;
#include "gl_funcs.h"
#undef GN_GL_PROC
#undef GN_GL_FUNC
    for (size_t i = 0; found && i < count; i++)
        if (strcmp(name, list[i].name) == 0)
            return list[i].function;
    return found;
}
