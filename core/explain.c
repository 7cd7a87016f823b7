/* explain.c - says in sentences what a plan decided and why: of its lights, of each object in a light, of what it cannot
 * keep. */
#include "gni.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

typedef struct sentence {
    char *text;
    size_t capacity, length;
} sentence;

static void say(sentence *s, const char *format, ...)
#ifdef __GNUC__
    __attribute__((format(printf, 2, 3)))
#endif
    ;

static void say(sentence *s, const char *format, ...)
{
    const size_t room = s->length < s->capacity ? s->capacity - s->length : 0;
    va_list args;
    int length;

    va_start(args, format);
    length = vsnprintf(room ? s->text + s->length : NULL, room, format, args);
    va_end(args);
    s->length += length > 0 ? (size_t)length : 0;
}

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
};

const char *gni_skip_name(gn_skip skip)
{
    return skips[skip].name;
}

/* Returns 0, with an empty text, when it is not of the plan. */
static int start(sentence *s, int is_there, char *text, size_t capacity)
{
    *s = (sentence){text, text ? capacity : 0, 0};
    if (s->capacity)
        text[0] = '\0';
    return is_there;
}

static void say_bounds(sentence *s, const gn_plan *plan, const gn_plan_light *l)
{
    const uint32_t *at = l->scissor;

    if (l->reach < INFINITY)
        say(s, "; it reaches %g", l->reach);
    if (at[2] < plan->target.width || at[3] < plan->target.height)
        say(s, "; scissor %lu, %lu, %lux%lu of %lux%lu pixels", (unsigned long)at[0], (unsigned long)at[1],
            (unsigned long)at[2], (unsigned long)at[3], (unsigned long)plan->target.width,
            (unsigned long)plan->target.height);
    if (l->depth_bounds[0] > 0.0 || l->depth_bounds[1] < 1.0)
        say(s, "; depth bounds %.6f to %.6f", l->depth_bounds[0], l->depth_bounds[1]);
}

size_t gn_plan_explain_light(const gn_plan *plan, uint32_t light, char *text, size_t capacity)
{
    const gn_plan_light *l;
    sentence s;

    if (!start(&s, plan && light < plan->light_count, text, capacity))
        return 0;
    l = &plan->lights[light];
    say(&s, "%s: %s", gn_plan_method_name(plan, light), l->reason);
    if (l->skip != GN_SKIP_NOT) {
        say(&s, "; left out: %s", skips[l->skip].of_light);
        if (l->skip == GN_SKIP_UNIMPORTANT)
            say(&s, ": at most %g of a pixel's full light is missing", l->possible_error);
        return s.length;
    }
    say_bounds(&s, plan, l);
    say(&s, "; %lu casters, %lu left out", (unsigned long)l->casters, (unsigned long)l->skipped_casters);
    if (l->batches > 1)
        say(&s, "; more layers than %d bits count: %lu batches of up to %lu layers, folded into a flag",
            l->stencil.bits + 1, (unsigned long)l->batches, (unsigned long)l->layers);
    if (plan->blend_once)
        say(&s, "; of coincident surfaces only the first is lit");
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
    sentence s;

    if (!start(&s, plan && light < plan->light_count && object < plan->object_count, text, capacity))
        return 0;
    c = &plan->casters[(size_t)light * plan->object_count + object];
    if (c->skip != GN_SKIP_NOT) {
        say(&s, "left out: %s", skips[c->skip].of_object);
        return s.length;
    }
    if (plan->lights[light].method == GN_METHOD_STENCIL)
        say(&s, "%s", cases[c->mcguire_case - 1]);
    else
        say(&s, "by %s, as all", c->mcguire_case == 1 ? "z-pass" : "z-fail");
    for (int p = 0; p < 3; p++)
        if (c->parts >> p & 1) {
            say(&s, "%s%s", separator, parts[p]);
            separator = ", ";
        }
    if (c->fan)
        say(&s, " as a fan");
    return s.length;
}

size_t gn_plan_explain_warning(const gn_plan *plan, gn_warning warning, char *text, size_t capacity)
{
    sentence s;

    if (!start(&s, plan && (unsigned)warning < GN_WARNING_COUNT && plan->warnings >> warning & 1, text, capacity))
        return 0;
    switch (warning) {
    case GN_WARN_OVERFLOW:
        say(&s, "more triangles cast than a stencil counts that does not wrap: deep shadows may be wrong");
        break;
    case GN_WARN_ENDLESS:
        say(&s,
            "%lu shadows are left out: the light is too close to too many large triangles for an orthographic camera",
            (unsigned long)plan->endless_casters);
        break;
    case GN_WARN_DEPTH:
        say(&s,
            "from a view distance of %g on four steps of %d bits of depth are larger than a pixel, and receivers are "
            "up to "
            "%g "
            "away: edges of shadows may stray there; a near plane farther out than %g helps",
            plan->depth_limit, plan->target.depth_bits, plan->deepest_receiver, plan->depth_range[0]);
        break;
    case GN_WARN_FLOAT:
        say(&s,
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
