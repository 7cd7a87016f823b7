/* explain.c - says in sentences what a plan decided and why: of its lights, of each object in a light, of what it
 * cannot keep. */
#include "gni.h"

#include <math.h>

static const struct {
    const char *name, *of_light, *of_object;
} skips[] = {
    [GN_SKIP_NOT] = {"", "", ""},
    [GN_SKIP_NO_CASTER] = {"no caster", "", "it casts no shadow"},
    [GN_SKIP_EXEMPT] = {"exempt", "", "it is exempt: the light's list says that it does not cast"},
    [GN_SKIP_NO_TRIANGLE] = {"no triangle", "", "none of its triangles casts, or what they shadow is not seen"},
    [GN_SKIP_OUT_OF_REACH] = {"out of reach", "", "it lies beyond the light's reach, cone or box"},
    [GN_SKIP_OUT_OF_VIEW] = {"out of view", "nothing that it reaches is in view", "no part of its volume is in view"},
    [GN_SKIP_NO_RECEIVER] = {"no receiver", "nothing that it reaches is there to be lit",
                             "its volume misses all that receives, is in view and is reached"},
    [GN_SKIP_FAINT] = {"faint", "it adds less than half a step of the target's bits anywhere", ""},
    [GN_SKIP_UNIMPORTANT] = {"unimportant", "it matters less than was asked for", ""},
    [GN_SKIP_LIGHT] = {"light", "", "the light is left out"},
    [GN_SKIP_ENDLESS] = {"endless", "", "its volume has no end: its shadow is missing"},
    [GN_SKIP_KEPT] = {"kept", "", "its shadow is in a mask that is kept from an earlier frame"},
};

const char *gni_skip_name(gn_skip skip)
{
    return skips[skip].name;
}

/* Returns 0, with an empty text, when it is not of the plan. */
static int start(gni_text *s, int is_there, char *text, size_t capacity)
{
    gni_start_text(s, text, capacity);
    return is_there;
}

static void say_bounds(gni_text *s, const gn_plan *plan, const gn_plan_light *l)
{
    const uint32_t *at = l->scissor;

    if (l->reach < INFINITY)
        gni_put(s, "; it reaches %g", l->reach);
    if (at[2] < plan->target.width || at[3] < plan->target.height)
        gni_put(s, "; scissor %lu, %lu, %lux%lu of %lux%lu pixels", (unsigned long)at[0], (unsigned long)at[1],
                (unsigned long)at[2], (unsigned long)at[3], (unsigned long)plan->target.width,
                (unsigned long)plan->target.height);
    if (l->depth_bounds[0] > 0.0 || l->depth_bounds[1] < 1.0)
        gni_put(s, "; depth bounds %.6f to %.6f", l->depth_bounds[0], l->depth_bounds[1]);
}

/* How a count in colour is made, and what it keeps. */
static void say_color(gni_text *s, const gn_plan *plan, const gn_plan_light *l)
{
    static const char *const places[] = {"", "the target's alpha", "the target's colour", "an image"};

    gni_put(s, "; counted in %s of levels 0 to %d", places[l->color.place], l->color.top);
    if (l->batches)
        gni_put(s, "; up to %lu fragments of one side over a pixel, %d are kept", (unsigned long)l->fragments,
                l->color.limit);
    if (l->batches > 1)
        gni_put(s, "; %lu batches", (unsigned long)l->batches);
    if (plan->image.format != GN_FORMAT_NONE)
        gni_put(s, "; the image has %s of depth",
                plan->image.depth_bits == 0    ? "the target's own buffer"
                : plan->image.depth_bits == 16 ? "16 bits"
                                               : "24 bits");
}

size_t gn_plan_explain_light(const gn_plan *plan, uint32_t light, char *text, size_t capacity)
{
    const gn_plan_light *l;
    gni_text s;

    if (!start(&s, plan && light < plan->light_count, text, capacity))
        return 0;
    l = &plan->lights[light];
    gni_put(&s, "%s: %s", gn_plan_method_name(plan, light), l->reason);
    if (l->skip != GN_SKIP_NOT) {
        gni_put(&s, "; left out: %s", skips[l->skip].of_light);
        if (l->skip == GN_SKIP_UNIMPORTANT)
            gni_put(&s, ": at most %g of a pixel's full light is missing", l->possible_error);
        return s.length;
    }
    say_bounds(&s, plan, l);
    gni_put(&s, "; %lu casters, %lu left out", (unsigned long)l->casters, (unsigned long)l->skipped_casters);
    if (l->color.place != GN_PLACE_STENCIL)
        say_color(&s, plan, l);
    else if (l->batches > 1)
        gni_put(&s, "; more layers than %d bits count: %lu batches of up to %lu layers, folded into a flag",
                l->stencil.bits + 1, (unsigned long)l->batches, (unsigned long)l->layers);
    if (l->cut_casters)
        gni_put(&s, "; %lu casters cut into pieces: at their seams single pixels may be wrong",
                (unsigned long)l->cut_casters);
    if (plan->mask_age)
        gni_put(&s, "; masks are kept that are %lu frames old", (unsigned long)plan->mask_age);
    if (l->caster_error > 0.0)
        gni_put(&s, "; proxies or welded edges: a shadow's edge may be off by up to %g where it starts",
                l->caster_error);
    if (l->light_moved > 0.0)
        gni_put(&s, "; shadows are kept that were found before the light moved by up to %g as their casters see it",
                l->light_moved);
    if (plan->patch_count && l->stencil.patch_bits)
        gni_put(&s, "; flat receivers on %lu planes take no volumes", (unsigned long)plan->patch_count);
    if (plan->blend_once)
        gni_put(&s, "; of coincident surfaces only the first is lit");
    return s.length;
}

size_t gn_plan_explain_caster(const gn_plan *plan, uint32_t light, uint32_t object, char *text, size_t capacity)
{
    static const char *const cases[] = {"case 1, by z-pass: it stands not between the light and the near plane",
                                        "case 2, by z-fail: its shadow may reach the near plane; it is out of view",
                                        "case 3, by z-fail: its shadow may reach the near plane, or it does itself"};
    static const char *const parts[] = {"sides", "light cap", "dark cap"};
    const gn_plan_caster *c;
    const char *separator = "; ";
    gni_text s;

    if (!start(&s, plan && light < plan->light_count && object < plan->object_count, text, capacity))
        return 0;
    c = &plan->casters[(size_t)light * plan->object_count + object];
    if (c->skip != GN_SKIP_NOT) {
        gni_put(&s, "left out: %s", skips[c->skip].of_object);
        return s.length;
    }
    if (c->mcguire_case == 0)
        gni_put(&s, "no volume: only flat receivers are in its shadow");
    else if (gni_models_less(plan->lights[light].method))
        gni_put(&s, "%s", cases[c->mcguire_case - 1]);
    else
        gni_put(&s, "by %s, as all", c->mcguire_case == 1 ? "z-pass" : "z-fail");
    for (int p = 0; p < 3; p++)
        if (c->parts >> p & 1) {
            gni_put(&s, "%s%s", separator, parts[p]);
            separator = ", ";
        }
    if (c->fan)
        gni_put(&s, " as a fan");
    if (c->is_ended)
        gni_put(&s, ", ended behind the last thing that it may shadow");
    if (c->parts & GN_NEAR_CAP)
        gni_put(&s, ", left out where there is nothing to shadow");
    separator = "; projected on patch ";
    for (uint32_t p = 0; p < plan->patch_count; p++)
        if (c->patches >> p & 1) {
            gni_put(&s, "%s%lu", separator, (unsigned long)p + 1);
            separator = ", ";
        }
    return s.length;
}

size_t gn_plan_explain_warning(const gn_plan *plan, gn_warning warning, char *text, size_t capacity)
{
    gni_text s;

    if (!start(&s, plan && (unsigned)warning < GN_WARNING_COUNT && plan->warnings >> warning & 1, text, capacity))
        return 0;
    switch (warning) {
    case GN_WARN_OVERFLOW:
        gni_put(&s, GNI_HAS_BATCHES
                        ? "more triangles cast than a stencil counts that does not wrap: deep shadows may be wrong"
                        : "more triangles may cast than a stencil counts, without batches: deep shadows may be wrong");
        break;
    case GN_WARN_ENDLESS:
        gni_put(
            &s,
            "%lu shadows are left out: the light is too close to too many large triangles for an orthographic camera",
            (unsigned long)plan->endless_casters);
        break;
    case GN_WARN_DEPTH:
        gni_put(&s,
                "from a view distance of %g on four steps of %d bits of depth are larger than half a pixel, and "
                "receivers are "
                "up to "
                "%g "
                "away: edges of shadows may stray there; a near plane farther out than %g helps",
                plan->depth_limit, plan->image.depth_bits ? plan->image.depth_bits : plan->target.depth_bits,
                plan->deepest_receiver, plan->depth_range[0]);
        break;
    case GN_WARN_RANGE:
        for (uint32_t i = 0; i < plan->light_count; i++)
            if (plan->lights[i].fragments > (uint32_t)plan->lights[i].color.limit && plan->lights[i].color.limit) {
                gni_put(&s,
                        "light %lu: up to %lu fragments of one side may lie over a pixel, and %s tells %d apart: "
                        "shadows may be wrong there",
                        (unsigned long)i, (unsigned long)plan->lights[i].fragments, gn_plan_method_name(plan, i),
                        plan->lights[i].color.limit);
                break;
            }
        break;
    case GN_WARN_FLOAT:
        gni_put(
            &s,
            "something in view has vertices %g from the plane of the eye: with a near plane at %g floats of a vertex "
            "shader do "
            "not tell them from infinity, and it may be too deep: smaller triangles or a near plane farther out help",
            plan->farthest_vertex, plan->depth_range[0]);
        break;
    case GN_WARNING_COUNT:
        break;
    }
    return s.length;
}
