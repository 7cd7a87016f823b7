/* cache.c - what hosts may call in a build without the feature cache: it is refused. */
#include "gni.h"

gn_result gn_shadow_cache_create(gn_context *context, const gn_shadow_cache_desc *desc, gn_shadow_cache **cache)
{
    if (cache)
        *cache = NULL;
    if (!context || !desc || !cache)
        return gn_fail(context, GN_E_ARG, "gn_shadow_cache_create: NULL argument");
    return gn_fail(context, GN_E_DEVICE, "gn_shadow_cache_create: this build lacks the feature %s", "cache");
}

void gn_shadow_cache_destroy(gn_shadow_cache *cache)
{
    (void)cache;
}

void gn_shadow_cache_forget_masks(gn_shadow_cache *cache)
{
    (void)cache;
}
