/* plan_json.c - a plan as JSON, for people, for tools and for comparing two plans. Written like snprintf: it may be
 * called with no room to learn the length. */
#include "gni.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

typedef struct writer {
    char *text;
    size_t capacity, length;
} writer;

static void put(writer *w, const char *format, ...)
#ifdef __GNUC__
    __attribute__((format(printf, 2, 3)))
#endif
    ;

static void put(writer *w, const char *format, ...)
{
    char piece[512];
    va_list args;
    int length;

    va_start(args, format);
    length = vsnprintf(piece, sizeof piece, format, args);
    va_end(args);
    for (int i = 0; i < length && i < (int)sizeof piece - 1; i++, w->length++)
        if (w->length + 1 < w->capacity)
            w->text[w->length] = piece[i];
}

static void put_number(writer *w, double value) /* JSON has no infinity */
{
    if (isfinite(value))
        put(w, "%.17g", value);
    else
        put(w, "null");
}

static void put_record(writer *w, const gn_record *r)
{
    static const char *const names[] = {"sides", "light cap", "dark cap"};
    static const char *const far_ends[] = {"infinite", "clamped", "ended"};
    const char *separator = "";

    put(w, "\n  {\"light\": %lu, \"object\": %lu, \"chunk\": %lu, \"parts\": [", (unsigned long)r->light,
        (unsigned long)r->object, (unsigned long)r->chunk);
    for (int part = 0; part < 3; part++)
        if (r->parts >> part & 1) {
            put(w, "%s\"%s\"", separator, names[part]);
            separator = ", ";
        }
    put(w,
        "], \"first_index\": %lu, \"indices\": {\"sides\": %lu, \"dark_cap\": %lu, \"light_cap\": %lu, \"turned_cap\": "
        "%lu},",
        (unsigned long)r->first_index, (unsigned long)r->side_count, (unsigned long)r->dark_cap_count,
        (unsigned long)r->light_cap_count, (unsigned long)r->turned_cap_count);
    put(w, " \"fan\": %s, \"case\": %d, \"mirrored\": %s, \"far_end\": \"%s\", \"end_plane\": [",
        r->fan ? "true" : "false", r->mcguire_case, r->mirrored ? "true" : "false", far_ends[r->far_end]);
    for (int i = 0; i < 4; i++) {
        put(w, "%s", i ? ", " : "");
        put_number(w, r->end_plane[i]);
    }
    put(w, "], \"end_reach\": ");
    put_number(w, r->end_reach);
    put(w, "}");
}

static void put_step(writer *w, const gn_step *s)
{
    static const char *const kinds[] = {"clear", "zero", "volumes", "draw", "fold"};
    static const char *const draws[] = {"nothing", "ambient", "light", "final"};

    put(w, "\n  {\"step\": \"%s\"", kinds[s->kind]);
    if (s->kind == GN_STEP_DRAW)
        put(w, ", \"draw\": \"%s\"", draws[s->draw]);
    if (s->draw == GN_DRAW_LIGHT || (s->kind != GN_STEP_CLEAR && s->kind != GN_STEP_DRAW))
        put(w, ", \"light\": %lu", (unsigned long)s->light);
    if (s->draw == GN_DRAW_LIGHT)
        put(w, ", \"receivers\": %s", s->receivers ? "true" : "false");
    if (s->kind == GN_STEP_VOLUMES)
        put(w, ", \"first_record\": %lu, \"records\": %lu", (unsigned long)s->first_record,
            (unsigned long)s->record_count);
    put(w, "}");
}

static void put_caster(writer *w, const gn_plan *plan, uint32_t light, uint32_t object)
{
    const gn_plan_caster *c = &plan->casters[(size_t)light * plan->object_count + object];

    put(w, "%s{\"skip\": \"%s\", \"case\": %d}", object ? ", " : "", gni_skip_name((gn_skip)c->skip), c->mcguire_case);
}

static void put_light(writer *w, const gn_plan *plan, uint32_t light)
{
    const gn_plan_light *l = &plan->lights[light];
    const gn_stencil_layout *s = &l->stencil;

    put(w, "%s\n  {\"method\": \"%s\", \"reason\": \"%s\", \"skip\": \"%s\", \"reach\": ", light ? "," : "",
        gn_plan_method_name(plan, light), l->reason, gni_skip_name(l->skip));
    put_number(w, l->reach);
    put(w, ", \"scissor\": [%lu, %lu, %lu, %lu], \"depth_bounds\": [", (unsigned long)l->scissor[0],
        (unsigned long)l->scissor[1], (unsigned long)l->scissor[2], (unsigned long)l->scissor[3]);
    put_number(w, l->depth_bounds[0]);
    put(w, ", ");
    put_number(w, l->depth_bounds[1]);
    put(w, "], \"possible_error\": ");
    put_number(w, l->possible_error);
    put(w,
        ",\n   \"stencil\": {\"two_sided\": %s, \"discard\": %s, \"wrap\": %s, \"reference\": %d, \"range\": [%d, %d], "
        "\"bits\": %d, \"flag\": %d},",
        s->two_sided ? "true" : "false", s->discard ? "true" : "false", s->wrap ? "true" : "false", s->reference,
        s->low, s->high, s->bits, s->flag);
    put(w,
        " \"layers\": %lu, \"batches\": %lu,\n   \"casters\": %lu, \"skipped_casters\": %lu, \"case1\": %lu, "
        "\"case2\": %lu, \"case3\": %lu, \"objects\": [",
        (unsigned long)l->layers, (unsigned long)l->batches, (unsigned long)l->casters,
        (unsigned long)l->skipped_casters, (unsigned long)l->cases[0], (unsigned long)l->cases[1],
        (unsigned long)l->cases[2]);
    for (uint32_t o = 0; o < plan->object_count; o++)
        put_caster(w, plan, light, o);
    put(w, "]}");
}

static void put_warnings(writer *w, const gn_plan *plan)
{
    const char *separator = "";

    put(w, " \"warnings\": [");
    for (int i = 0; i < GN_WARNING_COUNT; i++) {
        char text[256];

        if (gn_plan_explain_warning(plan, (gn_warning)i, text, sizeof text)) {
            put(w, "%s\"%s\"", separator, text);
            separator = ", ";
        }
    }
    put(w, "],\n");
}

size_t gn_plan_json(const gn_plan *plan, char *text, size_t capacity)
{
    writer w = {text, capacity, 0};

    if (!plan || (!text && capacity))
        return 0;
    put(&w, "{\"target\": {\"width\": %lu, \"height\": %lu, \"depth_bits\": %d, \"stencil_bits\": %d},\n",
        (unsigned long)plan->target.width, (unsigned long)plan->target.height, plan->target.depth_bits,
        plan->target.stencil_bits);
    put_warnings(&w, plan);
    put(&w, " \"blend_once\": %s, \"clear_depth\": ", plan->blend_once ? "true" : "false");
    put_number(&w, plan->clear_depth);
    put(&w, ", \"depth_range\": [");
    put_number(&w, plan->depth_range[0]);
    put(&w, ", ");
    put_number(&w, plan->depth_range[1]);
    put(&w, "], \"depth_limit\": ");
    put_number(&w, plan->depth_limit);
    put(&w, ", \"indices\": %lu, \"endless_casters\": %lu,\n \"lights\": [", (unsigned long)plan->index_count,
        (unsigned long)plan->endless_casters);
    for (uint32_t i = 0; i < plan->light_count; i++)
        put_light(&w, plan, i);
    put(&w, "],\n \"steps\": [");
    for (uint32_t i = 0; i < plan->step_count; i++) {
        put(&w, "%s", i ? "," : "");
        put_step(&w, &plan->steps[i]);
    }
    put(&w, "],\n \"records\": [");
    for (uint32_t i = 0; i < plan->record_count; i++) {
        put(&w, "%s", i ? "," : "");
        put_record(&w, &plan->records[i]);
    }
    put(&w, "]}\n");
    if (capacity > 0)
        text[w.length < capacity ? w.length : capacity - 1] = '\0';
    return w.length;
}
