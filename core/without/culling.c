/* culling.c - what hosts may call in a build without the feature culling: a light is one light. */
#include "gni.h"

gn_result gn_light_soften(gn_context *context, const gn_light *light, double radius, uint32_t count, gn_light *out)
{
    (void)radius;
    if (!context || !light || !out || count == 0)
        return gn_fail(context, GN_E_ARG, "gn_light_soften: a NULL argument, or %lu lights in place of one",
                       (unsigned long)count);
    if (count > 1)
        return gn_fail(context, GN_E_DEVICE,
                       "gn_light_soften: this build lacks the feature culling (%lu lights in place of one)",
                       (unsigned long)count);
    *out = *light;
    return GN_OK;
}
