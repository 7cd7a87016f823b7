/* choose.c - which method a frame gets, and which way of it the target can do: the first of a chain, from the best to
 * what needs least. What could not be had, and why, becomes the sentence of the plan.
 *
 * A stencil method runs two-sided where that is proven, else in two passes a caster, one for each side (Everitt 2002,
 * section 3.3); wrapping where that is proven, else about the middle of the range. The other side is discarded by
 * gl_FrontFacing where that is proven, and culled elsewhere: a driver may judge slivers by unrounded vertices when it
 * culls and by rounded ones when it draws, and lose them both times. llvmpipe does. */
#include "gni.h"

#include <string.h>

#define MIDDLE 128 /* of 8 bits */

const char *gni_why_not(const gn_target *t, gn_capability c)
{
    const uint32_t bit = 1u << c;

    return t->hidden & bit ? "is hidden" : t->advertised & bit ? "fails its proof" : "is not offered";
}

int gni_must_end(const gn_scene *s)
{
    return s->camera.orthographic || s->camera.finite_far || !gn_target_can(&s->target, GN_CAN_W0);
}

static void choose_layout(const gn_scene *s, gni_choice *choice)
{
    const gn_target *t = &s->target;
    gn_stencil_layout *layout = &choice->stencil;

    layout->bits = 8;
    layout->mask = 255;
    if (!GNI_HAS_FALLBACK) { /* is_possible() has asked for both */
        layout->two_sided = layout->wrap = 1;
        layout->high = 255;
        return;
    }
    layout->two_sided = !s->one_sided && gn_target_can(t, GN_CAN_TWO_SIDED_STENCIL);
    layout->discard = !layout->two_sided && gn_target_can(t, GN_CAN_FRONT_FACING);
    if (s->one_sided)
        gni_put(&choice->text, "; one side at a time, as asked for");
    else if (!layout->two_sided)
        gni_put(&choice->text, "; one side at a time, since %s %s", gn_capability_name(GN_CAN_TWO_SIDED_STENCIL),
                gni_why_not(t, GN_CAN_TWO_SIDED_STENCIL));
    if (!layout->two_sided && !layout->discard)
        gni_put(&choice->text, "; culled, which may lose slivers, since %s %s", gn_capability_name(GN_CAN_FRONT_FACING),
                gni_why_not(t, GN_CAN_FRONT_FACING));
    layout->wrap = gn_target_can(t, GN_CAN_STENCIL_WRAP);
    layout->reference = layout->wrap ? 0 : MIDDLE;
    layout->low = layout->wrap ? 0 : -MIDDLE;
    layout->high = layout->wrap ? 255 : 255 - MIDDLE;
    if (!layout->wrap)
        gni_put(&choice->text, "; counts from %d to %d about %d, since %s %s", layout->low, layout->high,
                layout->reference, gn_capability_name(GN_CAN_STENCIL_WRAP), gni_why_not(t, GN_CAN_STENCIL_WRAP));
}

void gni_patch_layout(gn_stencil_layout *layout, uint32_t patch_count)
{
    layout->patch_bits = patch_count > 1 ? 2 : 1;
    layout->bits -= layout->patch_bits;
    layout->mask = (1 << layout->bits) - 1;
    layout->high = layout->mask;
}

void gni_split_layout(gn_stencil_layout *layout)
{
    layout->bits--;
    layout->flag = 1 << layout->bits;
    layout->reference /= 2;
    layout->low /= 2;
    layout->high /= 2;
}

static void choose_far(const gn_scene *s, gni_choice *choice)
{
    if (s->camera.orthographic || !gni_must_end(s))
        return;
    if (s->camera.finite_far)
        gni_put(&choice->text, "; volumes end behind what is seen, since the camera's far plane is finite");
    else
        gni_put(&choice->text, "; volumes end behind what is seen, since %s %s", gn_capability_name(GN_CAN_W0),
                gni_why_not(&s->target, GN_CAN_W0));
}

/* The feature of gni_features.h that a method is part of, where this build lacks it; NULL mostly. */
static const char *feature_for(gn_method method)
{
    if (!GNI_HAS_REFINE && method == GN_METHOD_REFINE)
        return "refine";
    if (!GNI_HAS_FALLBACK && method >= GN_METHOD_COUNT)
        return "fallback";
    return !GNI_HAS_CULLING && method == GN_METHOD_STENCIL ? "culling" : NULL;
}

/* Whether a method that is asked for by name, or in the chain, can run here; if not, why. */
static int is_possible(const gn_scene *s, gn_method method, gni_text *why)
{
    const gn_target *t = &s->target;
    const gn_method_info *info = gn_method_describe(method);
    const uint32_t needs =
        info->needs | (GNI_HAS_FALLBACK ? 0u : 1u << GN_CAN_TWO_SIDED_STENCIL | 1u << GN_CAN_STENCIL_WRAP);

    if (feature_for(method)) {
        gni_put(why, "%s needs the feature %s, which this build lacks", info->name, feature_for(method));
        return 0;
    }
    if (!GNI_HAS_FALLBACK && s->one_sided) {
        gni_put(why, "%s one side at a time needs the feature fallback, which this build lacks", info->name);
        return 0;
    }
    for (int c = 0; c < GN_CAPABILITY_COUNT; c++)
        if (needs >> c & 1 && !gn_target_can(t, (gn_capability)c)) {
            gni_put(why, "%s needs %s, which %s", info->name, gn_capability_name((gn_capability)c),
                    gni_why_not(t, (gn_capability)c));
            return 0;
        }
    if (method == GN_METHOD_REFINE || !GNI_HAS_FALLBACK)
        return 1;
    return gni_counts_in_color(method) ? gni_color_is_possible(s, method, why)
                                       : gni_stencil_is_possible(s, info->name, why);
}

/* From the best to what needs least. */
static const gn_method chain[] = {GNI_HAS_CULLING ? GN_METHOD_STENCIL : GN_METHOD_ZFAIL, GN_METHOD_COUNT,
                                  GN_METHOD_SIGNED, GN_METHOD_ALPHA, GN_METHOD_SCREEN};

/* The first of the chain that is possible, or GN_METHOD_AUTO; the reason is why the one before was not. */
static gn_method pick(const gn_scene *s, gni_text *reason, gni_text *first_why)
{
    char last[128] = "";

    for (size_t i = 0; i < (GNI_HAS_FALLBACK ? sizeof chain / sizeof chain[0] : 1); i++) {
        char text[128];
        gni_text why;

        gni_start_text(&why, text, sizeof text);
        if (is_possible(s, chain[i], &why)) {
            gni_put(reason, i ? "the best that is possible here: %s" : "exact for any view", last);
            return chain[i];
        }
        if (i == 0)
            gni_put(first_why, "%s", text);
        memcpy(last, text, sizeof last);
    }
    return GN_METHOD_AUTO;
}

gn_method gni_pick(const gn_scene *s)
{
    gni_text nothing;

    gni_start_text(&nothing, NULL, 0);
    return s->method == GN_METHOD_AUTO ? pick(s, &nothing, &nothing) : s->method;
}

/* In its colour, or small ones in its corner: what was drawn there is lost. */
static int makes_masks_in_target(const gn_scene *s, const gni_choice *choice)
{
    return choice->color.place == GN_PLACE_COLOR ||
           (s->scale > 1 && choice->image.format == GN_FORMAT_NONE && !choice->is_refined);
}

gn_result gni_choose(gn_context *context, const gn_scene *s, gni_choice *choice)
{
    const gn_target *t = &s->target;
    char text[128] = "";
    gni_text why;

    memset(choice, 0, sizeof *choice);
    gni_start_text(&choice->text, choice->reason, sizeof choice->reason);
    gni_start_text(&why, text, sizeof text);
    if ((unsigned)s->method >= GN_METHOD_TOTAL)
        return gn_fail(context, GN_E_ARG, "plan: no method has number %d", (int)s->method);
    if (s->method == GN_METHOD_AUTO) {
        choice->method = pick(s, &choice->text, &why);
    } else if (is_possible(s, s->method, &why)) {
        choice->method = s->method;
        gni_put(&choice->text, "asked for by name");
    }
    if (choice->method == GN_METHOD_AUTO)
        return gn_fail(context, GN_E_DEVICE, "method %s%s (%d bits of stencil, %d of alpha, %d of depth)", text,
                       s->method == GN_METHOD_AUTO ? ", and none without a stencil is possible either" : "",
                       t->stencil_bits, t->alpha_bits, t->depth_bits);
    if (gni_counts_in_color(choice->method))
        gni_choose_color(s, choice);
    else
        choose_layout(s, choice);
    choice->is_refined = GNI_HAS_REFINE && choice->method == GN_METHOD_REFINE;
    if (choice->is_refined)
        gni_patch_layout(&choice->stencil, 1); /* of what is not contested */
    if (GNI_HAS_FALLBACK)
        gni_choose_masks(s, choice);
    choose_far(s, choice);
    if (GNI_HAS_FALLBACK && s->follows && makes_masks_in_target(s, choice))
        return gn_fail(
            context, GN_E_DEVICE,
            "plan: method %s at scale 1/%lu makes masks in the target: it cannot follow another plan of the frame",
            gn_method_describe(choice->method)->name, (unsigned long)(s->scale ? s->scale : 1));
    return GN_OK;
}
