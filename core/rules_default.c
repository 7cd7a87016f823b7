/* rules_default.c - the library's own rules: tables that the build makes of rules/default.fcl (rules/compile.c), so that
 * who brings no rules needs no reader. */
#include "gni_rules.h"

#include "default.fcl.h"

#include <string.h>

gn_result gn_rules_default(gn_context *context, gn_rules **rules)
{
    const size_t size = sizeof **rules + sizeof(double) * gni_default_rules.term_count;
    gn_rules *r;

    if (!context || !rules)
        return gn_fail(context, GN_E_ARG, "gn_rules_default: NULL argument");
    *rules = r = gni_alloc(context, 1, size);
    if (!r)
        return gn_fail(context, GN_E_MEMORY, "rules: no memory for the %lu bytes of the library's own",
                       (unsigned long)size);
    *r = gni_default_rules;
    r->context = context;
    r->degrees = (double *)(void *)(r + 1);
    return GN_OK;
}
