/* methods.c - the methods by name: what each is and what it needs of a target. One row a method. */
#include "gnomon.h"

#include <string.h>

static const gn_method_info methods[GN_METHOD_COUNT] = {
    {"auto", "the best exact method that the target can do", "what that method needs", 1},
    {"zfail", "stencil, every caster by z-fail, closed volumes, to 255 layers (Everitt 2002)",
     "8 stencil bits, depth, two-sided stencil with wrapping", 1},
    {"zpass", "stencil, every caster by z-pass; wrong where a volume meets the near plane (Hoxley 2003)",
     "8 stencil bits, depth, two-sided stencil with wrapping", 0},
};

const gn_method_info *gn_method_describe(gn_method method)
{
    return (unsigned)method < GN_METHOD_COUNT ? &methods[method] : NULL;
}

gn_method gn_method_by_name(const char *name)
{
    for (int m = 0; m < GN_METHOD_COUNT; m++)
        if (name && strcmp(methods[m].name, name) == 0)
            return (gn_method)m;
    return GN_METHOD_COUNT;
}
