/* view_panel.c - what is written over the frame: whose GL it is, how shadows are made and why, what they cost against the
 * budget, what keys do. */
#include "view.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "picture.h"
#include "spread.h"

static const overlay_color backing = {0.05f, 0.06f, 0.09f, 0.78f}, bright = {0.96f, 0.96f, 0.94f, 1.0f},
                           dim = {0.68f, 0.71f, 0.76f, 1.0f}, gold = {1.0f, 0.80f, 0.36f, 1.0f},
                           red = {1.0f, 0.42f, 0.36f, 1.0f}, green = {0.47f, 0.83f, 0.55f, 1.0f},
                           dark = {0.05f, 0.06f, 0.09f, 1.0f};

enum { MOST_LINES = 64, MOST_LETTERS = 160, LEAST_LETTERS = 24 };

#define LIST_BORDER 24.0 /* of a list that covers the frame */

/* Lines that are gathered before they are drawn, so that what is behind them is of their size. */
typedef struct lines {
    char text[MOST_LINES][MOST_LETTERS];
    overlay_color colors[MOST_LINES];
    int count, letters; /* letters: of a line at most; longer ones are broken between words */
} lines;

void view_tell(view *v, const char *format, ...)
{
    va_list args;

    va_start(args, format);
    vsnprintf(v->notice, sizeof v->notice, format, args);
    va_end(args);
    v->notice_until = v->frame + 240.0;
}

static void put_line(lines *l, overlay_color color, const char *text, size_t length)
{
    if (l->count == MOST_LINES)
        return;
    l->colors[l->count] = color;
    snprintf(l->text[l->count++], MOST_LETTERS, "%.*s", (int)length, text);
}

static void put(lines *l, overlay_color color, const char *format, ...)
#ifdef __GNUC__
    __attribute__((format(printf, 3, 4)))
#endif
    ;

static void put(lines *l, overlay_color color, const char *format, ...)
{
    char text[1024];
    const char *at = text;
    va_list args;

    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    do {
        const size_t left = strlen(at);
        size_t length = left;

        if (left > (size_t)l->letters) {
            length = (size_t)l->letters;
            while (length > 0 && at[length] != ' ')
                length--;
            length = length ? length : (size_t)l->letters;
        }
        put_line(l, color, at, length);
        at += length;
        at += *at == ' ';
    } while (*at);
}

static void size_of(const overlay *o, const lines *l, double *width, double *height)
{
    size_t longest = 0;

    for (int i = 0; i < l->count; i++)
        longest = strlen(l->text[i]) > longest ? strlen(l->text[i]) : longest;
    *width = ((double)longest + 2.0) * overlay_letter_width(o);
    *height = l->count * overlay_line_height(o) + overlay_letter_width(o);
}

static void draw_lines(overlay *o, const lines *l, double x, double y)
{
    const double border = overlay_letter_width(o);
    double width, height;

    size_of(o, l, &width, &height);
    overlay_rectangle(o, x, y, width, height, backing);
    for (int i = 0; i < l->count; i++)
        overlay_text(o, x + border, y + border / 2.0 + i * overlay_line_height(o), l->colors[i], l->text[i]);
}

/* ------------------------------------------------------------------ contents */

static double typical_ms(const view *v)
{
    double times[VIEW_TIMES];
    const size_t count = v->frame < VIEW_TIMES ? v->frame : VIEW_TIMES;

    memcpy(times, v->times, count * sizeof *times);
    return count ? spread_of(times, count).median : 0.0;
}

static void put_cost(lines *l, const view_side *side, double budget)
{
    const overlay_color color = budget > 0.0 && side->ms > budget ? red : bright;

    put(l, color, "%.1f ms, %.2f M shadow fragments, about %.0f mW", side->ms, side->fragments / 1e6, side->milliwatts);
}

/* What the selector does, a sentence for each light. */
static void put_choices(lines *l, const view *v)
{
    const gn_choice *wanted;
    gn_selection selection;

    gn_selector_explain(v->adaptive.selector, &selection, &wanted);
    for (uint32_t i = 0; i < v->adaptive.light_count && l->count < 20; i++) {
        char text[512], way[80];

        gn_way_name(&v->adaptive.ways[i], way, sizeof way);
        put(l, i == v->light ? gold : bright, "light %u: %s", (unsigned)i, way);
        gn_explain_choice(&selection, wanted, i, 0, text, sizeof text);
        put(l, dim, "  %s", text);
    }
}

static void put_way(lines *l, const view *v, int number, const char *where)
{
    const view_side *side = &v->sides[number];
    char text[512];

    if (side->why[0]) {
        put(l, red, "%s%s cannot be made here, so there are no shadows", where,
            gn_method_describe(v->ways[number].method)->name);
        put(l, red, "  %s", side->why);
        return;
    }
    put(l, gold, "%s%s", where, side->name);
    if (number == 0 && !v->is_split && v->stage->plan->light_count) {
        gn_plan_explain_light(v->stage->plan, v->light < v->stage->plan->light_count ? v->light : 0, text, sizeof text);
        put(l, dim, "light %u: %s", (unsigned)v->light, text);
    }
}

static void put_difference(lines *l, const view *v)
{
    const difference *d = &v->difference;

    put(l, d->wrong_certain ? red : green, "light %u against the truth: %lu of %lu certain pixels wrong (red)",
        (unsigned)d->light, (unsigned long)d->wrong_certain, (unsigned long)d->certain);
    put(l, dim, "%lu differ where the truth is not certain (yellow); traced in %.1f s",
        (unsigned long)(d->wrong - d->wrong_certain), d->ms / 1000.0);
}

static void gather(lines *l, const view *v)
{
    static const char *const shows[VIEW_SHOWS] = {"", ", volumes shown", ", cases: 1 green, 2 orange, 3 red",
                                                  ", silhouettes shown", ", the mask"};
    const double budget = v->is_adaptive ? v->files.budget.frame_ms : 0.0;
    char hidden[256];
    size_t length = 0;

    put(l, bright, "gnomon %s on %s", gn_version(), (const char *)v->stage->gl->glGetString(GL_RENDERER));
    put(l, dim, "%ux%u, %s %s, %u lights%s", (unsigned)v->size[0], (unsigned)v->size[1], v->stage->platform->kind->name,
        v->stage->platform->detail, (unsigned)v->loaded.light_count, shows[v->show]);
    for (int c = 0; c < GN_CAPABILITY_COUNT && length < sizeof hidden; c++)
        if (v->hidden >> c & 1)
            length += (size_t)snprintf(hidden + length, sizeof hidden - length, "%s%s", length ? ", " : "",
                                       gn_capability_name((gn_capability)c));
    if (length)
        put(l, gold, "hidden: %s", hidden);
    if (v->is_adaptive)
        put_choices(l, v);
    else
        put_way(l, v, 0, v->is_split ? "left: " : "");
    put_cost(l, &v->sides[0], budget);
    if (v->is_split) {
        put_way(l, v, 1, "right: ");
        put_cost(l, &v->sides[1], 0.0);
    }
    if (v->is_marked)
        put_difference(l, v);
}

/* ------------------------------------------------------------------ graph */

/* Times of the last frames as columns, the longest cut off, and the budget as a line. */
static void draw_graph(overlay *o, const view *v, double x, double y, double unit)
{
    const double width = VIEW_TIMES * 2.0 * unit, height = 60.0 * unit, budget = v->files.budget.frame_ms;
    const double most = fmax(v->is_adaptive ? 1.5 * budget : 0.0, 1.6 * typical_ms(v));
    const int has_budget = v->is_adaptive && budget > 0.0;
    char text[80];

    overlay_rectangle(o, x, y, width + 8.0 * unit, height + overlay_line_height(o) + 10.0 * unit, backing);
    x += 4.0 * unit;
    y += 4.0 * unit + overlay_line_height(o);
    for (uint32_t i = 0; i < VIEW_TIMES && i < v->frame && most > 0.0; i++) {
        const uint32_t at = v->frame < VIEW_TIMES ? i : (v->frame + i) % VIEW_TIMES;
        const double share = fmin(v->times[at] / most, 1.0);
        const overlay_color color = has_budget && v->times[at] > budget ? red : green;

        overlay_rectangle(o, x + 2.0 * unit * i, y + height * (1.0 - share), 2.0 * unit - 1.0, height * share, color);
    }
    if (has_budget)
        overlay_rectangle(o, x, y + height * (1.0 - budget / most), width, unit, gold);
    snprintf(text, sizeof text, has_budget ? "%.1f ms a frame, budget %.1f" : "%.1f ms a frame", typical_ms(v), budget);
    overlay_text(o, x, y - overlay_line_height(o) - 1.0 * unit, bright, text);
}

/* ------------------------------------------------------------------ all of it */

static void draw_handles(const view *v, double unit)
{
    for (uint32_t i = 0; i < v->loaded.light_count; i++) {
        const double *c = v->loaded.lights[i].color;
        const double most = fmax(fmax(c[0], c[1]), fmax(c[2], 1e-6));
        const overlay_color color = {(float)(c[0] / most), (float)(c[1] / most), (float)(c[2] / most), 1.0f};
        double at[2];
        char number[16];

        if (!handle_place(&v->loaded, i, v->size, at))
            continue;
        overlay_disc(v->overlay, at[0], at[1], (i == v->light ? 9.0 : 7.0) * unit, i == v->light ? gold : dark);
        overlay_disc(v->overlay, at[0], at[1], (i == v->light ? 6.5 : 5.5) * unit, color);
        snprintf(number, sizeof number, "%u", (unsigned)i);
        overlay_text(v->overlay, at[0] + 11.0 * unit, at[1] - overlay_line_height(v->overlay) / 2.0, bright, number);
    }
}

static void gather_keys(lines *l)
{
    const char *key, *what;

    for (int n = 0; view_key_line(n, &key, &what); n++)
        put(l, key[0] ? bright : dim, "%-12s %s", key, what);
}

static void gather_capabilities(lines *l, const view *v)
{
    put(l, dim, "a letter hides a capability, or shows it again; C: enough");
    for (int c = 0; c < GN_CAPABILITY_COUNT; c++)
        put(l,
            v->hidden >> c & 1                                   ? red
            : gn_target_can(&v->stage->target, (gn_capability)c) ? bright
                                                                 : dim,
            "%c  %-22s %s", 'A' + c + (c >= 2), gn_capability_name((gn_capability)c),
            v->hidden >> c & 1                                   ? "hidden"
            : gn_target_can(&v->stage->target, (gn_capability)c) ? "proven"
                                                                 : "not here");
}

static int has_room(const view *v, const lines *l)
{
    double width, height;

    size_of(v->overlay, l, &width, &height);
    return width + 2.0 * LIST_BORDER < v->size[0] && height + 2.0 * LIST_BORDER < v->size[1];
}

static void draw_figures(const view *v, double unit, double border)
{
    overlay *o = v->overlay;
    lines l;

    draw_handles(v, unit);
    memset(&l, 0, sizeof l);
    l.letters = (int)(0.62 * v->size[0] / overlay_letter_width(o));
    l.letters = l.letters < LEAST_LETTERS ? LEAST_LETTERS : l.letters < MOST_LETTERS ? l.letters : MOST_LETTERS - 1;
    gather(&l, v);
    draw_lines(o, &l, border, border);
    if (v->size[0] >= 480 && v->size[1] >= 300)
        draw_graph(o, v, border, v->size[1] - border - 70.0 * unit - overlay_line_height(o), unit);
    memset(&l, 0, sizeof l);
    l.letters = MOST_LETTERS - 1;
    put(&l, v->frame < v->notice_until ? gold : dim, "%s", v->frame < v->notice_until ? v->notice : "? keys");
    draw_lines(o, &l, v->size[0] - border - ((double)strlen(l.text[0]) + 2.0) * overlay_letter_width(o),
               v->size[1] - border - overlay_line_height(o) - overlay_letter_width(o));
}

int view_is_fine(const view *v)
{
    return window_exists(v->stage->platform) && window_scale(v->stage->platform) > 1.5;
}

void view_draw_panel(view *v)
{
    overlay *o = v->overlay;
    int fine = view_is_fine(v);
    double unit;
    lines l;

    memset(&l, 0, sizeof l);
    l.letters = MOST_LETTERS - 1;
    if (v->shows_help)
        gather_keys(&l);
    else if (v->shows_capabilities)
        gather_capabilities(&l, v);
    overlay_begin(o, v->size[0], v->size[1], fine);
    if (fine && !has_room(v, &l)) /* of a long list all is to be read */
        overlay_begin(o, v->size[0], v->size[1], fine = 0);
    unit = fine ? 2.0 : 1.0;
    if (v->is_split)
        overlay_rectangle(o, v->split * v->size[0] - unit, 0.0, 2.0 * unit, v->size[1], bright);
    if (l.count)
        draw_lines(o, &l, LIST_BORDER, LIST_BORDER);
    else if (!v->hides_panel)
        draw_figures(v, unit, 10.0 * unit);
    overlay_end(o);
}
