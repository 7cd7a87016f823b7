/* possible.c - which ways a target and its host can take at all: asked of the planner's own choice of a method. */
#include "gni_select.h"

#include <string.h>

void gn_find_possible(const gn_scene *scene, gn_possible *out)
{
    memset(out, 0, sizeof *out);
    for (int m = GN_METHOD_AUTO + 1; m < GN_METHOD_TOTAL; m++)
        for (int v = 0; v < GN_VARIANT_COUNT; v++) {
            gn_scene own = *scene;
            gni_choice choice;

            own.method = (gn_method)m;
            own.scale = gn_variant_scale(v);
            own.upsample = gn_variant_upsample(v);
            own.cache = NULL;
            if (own.upsample == GN_UPSAMPLE_DEPTH && own.shade != GN_SHADE_ADDITIVE)
                continue; /* dimmed frames take no masks by depth */
            if (gni_choose(NULL, &own, &choice) != GN_OK)
                continue;
            out->variants[m] |= (uint8_t)(1u << v);
            if (choice.mask == GN_MASK_TEXTURE && own.reads_masks)
                out->keeps[m] |= (uint8_t)(1u << v);
        }
}
