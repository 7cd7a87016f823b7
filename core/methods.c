/* methods.c - the methods by name: what each is and what it needs of a target. One row a method. */
#include "gni.h"

#include <string.h>

#define BIT(capability) (1u << (capability))

#define STENCIL_NEEDS (BIT(GN_CAN_STENCIL) | BIT(GN_CAN_DEPTH))
#define STENCIL_LIKES (BIT(GN_CAN_TWO_SIDED_STENCIL) | BIT(GN_CAN_STENCIL_WRAP) | BIT(GN_CAN_W0))
#define IMAGES        (BIT(GN_CAN_FBO_RGBA8) | BIT(GN_CAN_FBO_RGBA4) | BIT(GN_CAN_FBO_RGB5A1) | BIT(GN_CAN_FBO_RGB565))
#define COLOR_LIKES   (BIT(GN_CAN_FRONT_FACING) | BIT(GN_CAN_W0))

static const char one_sided_suffix[] = "/one-sided";

static const gn_method_info methods[GN_METHOD_TOTAL] = {
    {"auto", GNI_SENTENCE("the best exact method that the target can do"), 0, 0, 0, 1},
    {"zfail", GNI_SENTENCE("stencil, every caster by z-fail, closed volumes, to 255 layers (Everitt 2002)"),
     STENCIL_NEEDS, 0, STENCIL_LIKES, 1},
    {"zpass", GNI_SENTENCE("stencil, every caster by z-pass; wrong where a volume meets the near plane (Hoxley 2003)"),
     STENCIL_NEEDS, 0, STENCIL_LIKES, 0},
    {"stencil", GNI_SENTENCE("stencil, z-pass or z-fail for each caster, parts out of view left out (McGuire 2003)"),
     STENCIL_NEEDS, 0, STENCIL_LIKES, 1},
    {"refine",
     GNI_SENTENCE("stencil where a small mask is contested; elsewhere that: nearly exact (after Chan and Durand)"),
     STENCIL_NEEDS | BIT(GN_CAN_STENCIL_WRAP) | BIT(GN_CAN_PACKED_DEPTH_STENCIL) | BIT(GN_CAN_FBO_RGBA8), 0,
     BIT(GN_CAN_TWO_SIDED_STENCIL) | BIT(GN_CAN_W0), 0},
    {"count", GNI_SENTENCE("no stencil: fronts and backs counted in two channels of an image"), BIT(GN_CAN_DEPTH),
     IMAGES, COLOR_LIKES, 1},
    {"signed", GNI_SENTENCE("no stencil: added and subtracted about a level, in alpha or in an image"),
     BIT(GN_CAN_DEPTH) | BIT(GN_CAN_BLEND_SUBTRACT), BIT(GN_CAN_ALPHA) | IMAGES, COLOR_LIKES, 1},
    {"alpha",
     GNI_SENTENCE("no stencil: halved and doubled in the target's alpha, while nesting is shallow (Roettger 2002)"),
     BIT(GN_CAN_DEPTH) | BIT(GN_CAN_ALPHA) | BIT(GN_CAN_BLEND_ROUNDING), 0, COLOR_LIKES | BIT(GN_CAN_BLEND_MINMAX), 1},
    {"screen", GNI_SENTENCE("no stencil, no alpha: the same in the colour, copied to a texture (Roettger 2002)"),
     BIT(GN_CAN_DEPTH) | BIT(GN_CAN_BLEND_ROUNDING), 0, COLOR_LIKES, 1},
};

/* "" for one that counts one side at a time anyway. */
static const char one_sided[GN_METHOD_TOTAL][sizeof "stencil/one-sided"] = {[GN_METHOD_ZFAIL] = "zfail/one-sided",
                                                                            [GN_METHOD_ZPASS] = "zpass/one-sided",
                                                                            [GN_METHOD_STENCIL] = "stencil/one-sided",
                                                                            [GN_METHOD_REFINE] = "refine/one-sided",
                                                                            [GN_METHOD_COUNT] = "count/one-sided"};

const gn_method_info *gn_method_describe(gn_method method)
{
    return (unsigned)method < GN_METHOD_TOTAL ? &methods[method] : NULL;
}

gn_method gn_method_by_name(const char *name, int *is_one_sided)
{
    const char *const suffix = name ? strstr(name, one_sided_suffix) : NULL;

    if (!is_one_sided)
        return GN_METHOD_TOTAL;
    *is_one_sided = suffix && strcmp(suffix, one_sided_suffix) == 0;
    for (int m = 0; m < GN_METHOD_TOTAL; m++) {
        const char *const full = *is_one_sided ? one_sided[m] : methods[m].name;

        if (name && full[0] && strcmp(full, name) == 0)
            return (gn_method)m;
    }
    return GN_METHOD_TOTAL;
}

const char *gn_plan_method_name(const gn_plan *plan, uint32_t light)
{
    const gn_plan_light *about;

    if (!plan || light >= plan->light_count)
        return "";
    about = &plan->lights[light];
    if (gni_counts_in_color(about->method) ? about->color.both_sides || about->method != GN_METHOD_COUNT
                                           : about->stencil.two_sided)
        return methods[about->method].name;
    return one_sided[about->method];
}
