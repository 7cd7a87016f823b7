/* plan_json.c - a plan as JSON, for people, for tools and for comparing two plans. Written like snprintf: it may be
 * called with no room to learn the length. */
#include "gnomon.h"

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
    put(w, " \"case\": %d, \"mirrored\": %s, \"far_end\": \"%s\", \"end_plane\": [", r->mcguire_case,
        r->mirrored ? "true" : "false", far_ends[r->far_end]);
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
    static const char *const kinds[] = {"clear", "zero", "volumes", "draw"};
    static const char *const draws[] = {"nothing", "ambient", "light", "final"};

    put(w, "\n  {\"step\": \"%s\"", kinds[s->kind]);
    if (s->kind == GN_STEP_DRAW)
        put(w, ", \"draw\": \"%s\"", draws[s->draw]);
    if (s->draw == GN_DRAW_LIGHT || s->kind == GN_STEP_VOLUMES)
        put(w, ", \"light\": %lu", (unsigned long)s->light);
    if (s->draw == GN_DRAW_LIGHT)
        put(w, ", \"receivers\": %s", s->receivers ? "true" : "false");
    if (s->kind == GN_STEP_VOLUMES)
        put(w, ", \"first_record\": %lu, \"records\": %lu", (unsigned long)s->first_record,
            (unsigned long)s->record_count);
    put(w, "}");
}

size_t gn_plan_json(const gn_plan *plan, char *text, size_t capacity)
{
    writer w = {text, capacity, 0};

    put(&w, "{\"target\": {\"width\": %lu, \"height\": %lu, \"depth_bits\": %d, \"stencil_bits\": %d},\n",
        (unsigned long)plan->target.width, (unsigned long)plan->target.height, plan->target.depth_bits,
        plan->target.stencil_bits);
    put(&w,
        " \"stencil\": {\"two_sided\": %s, \"discard\": %s, \"wrap\": %s, \"reference\": %d, \"range\": [%d, %d]},\n",
        plan->stencil.two_sided ? "true" : "false", plan->stencil.discard ? "true" : "false",
        plan->stencil.wrap ? "true" : "false", plan->stencil.reference, plan->stencil.low, plan->stencil.high);
    put(&w, " \"clear_depth\": ");
    put_number(&w, plan->clear_depth);
    put(&w, ", \"depth_range\": [");
    put_number(&w, plan->depth_range[0]);
    put(&w, ", ");
    put_number(&w, plan->depth_range[1]);
    put(&w, "], \"indices\": %lu, \"endless_casters\": %lu,\n \"lights\": [", (unsigned long)plan->index_count,
        (unsigned long)plan->endless_casters);
    for (uint32_t i = 0; i < plan->light_count; i++) {
        const gn_plan_light *l = &plan->lights[i];

        put(&w,
            "%s\n  {\"method\": \"%s\", \"reason\": \"%s\", \"casters\": %lu, \"case1\": %lu, \"case2\": %lu, "
            "\"case3\": %lu, \"may_overflow\": %s}",
            i ? "," : "", gn_plan_method_name(plan, i), l->reason, (unsigned long)l->casters,
            (unsigned long)l->cases[0], (unsigned long)l->cases[1], (unsigned long)l->cases[2],
            l->may_overflow ? "true" : "false");
    }
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
