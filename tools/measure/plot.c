/* plot.c - see plot.h. Each panel's points go to gnuplot with its commands; the picture appears whole or not at all. */
#include "plot.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "plotter.h"

#define LEAST 0.001 /* per cent: what is drawn for none */

static int is_plotted(const trade_rows *rows, size_t row, size_t panel)
{
    return rows->of[row].panel == panel && !isnan(trade_error(rows, row));
}

/* Whether a name there would be written over the last one. */
static int is_near(double named[2], double cost, double error)
{
    if (named[0] > 0.0 && fabs(log(cost / named[0])) < 0.2 && fabs(log(error / named[1])) < 0.4)
        return 1;
    named[0] = cost;
    named[1] = error;
    return 0;
}

/* Points: cost, error, least and most cost, name; dominated ones, or those of the frontier from cheap to dear. */
static size_t put_points(const trade_rows *rows, FILE *f, size_t panel, const char *column, int dominated)
{
    double last = -INFINITY, named[2] = {0, 0};
    size_t count = 0;

    fprintf(f, "$%s << EOD\n", dominated ? "dominated" : "frontier");
    for (;;) {
        size_t next = rows->count;

        for (size_t i = 0; i < rows->count; i++)
            if (is_plotted(rows, i, panel) && trade_is_dominated(rows, i, column) == dominated &&
                trade_number(rows, i, column) > last &&
                (next == rows->count || trade_number(rows, i, column) < trade_number(rows, next, column)))
                next = i;
        if (next == rows->count)
            break;
        last = trade_number(rows, next, column);
        fprintf(f, "%g %g ", last, fmax(trade_error(rows, next), LEAST));
        if (strcmp(column, "frame_ms") == 0)
            fprintf(f, "%g %g \"", trade_number(rows, next, "frame_ms_p5"), trade_number(rows, next, "frame_ms_p95"));
        else
            fprintf(f, "%g %g \"", last, last);
        if (!is_near(named, last, fmax(trade_error(rows, next), LEAST)))
            plotter_put_name(f, trade_word(rows, next, "config"));
        fprintf(f, "\"\n");
        count++;
    }
    fprintf(f, "EOD\n");
    return count;
}

static void plot_panel(const trade_rows *rows, FILE *f, size_t panel, const char *column, const char *label)
{
    char name[256];
    size_t dominated, frontier;

    trade_panel_name(rows, panel, name, sizeof name);
    dominated = put_points(rows, f, panel, column, 1);
    frontier = put_points(rows, f, panel, column, 0);
    fprintf(f, "set title '");
    plotter_put_name(f, name);
    fprintf(
        f,
        "' noenhanced\nset xlabel '%s'\nset ylabel 'wrong pixels, %% (%g: none)'\nset logscale xy\nset xrange [*:*]\n"
        "set yrange [%g:100]\n",
        label, LEAST, LEAST / 2.0);
    if (dominated + frontier == 0)
        return;
    fprintf(f, "plot ");
    if (dominated)
        fprintf(f, "$dominated using 1:2:3:4 with xerrorbars pt 7 ps 0.4 lc '#bbbbbb'%s", frontier ? ", " : "\n");
    if (frontier)
        fprintf(f, "$frontier using 1:2 with lines lc '#c03010', $frontier using 1:2:3:4 with xerrorbars pt 7 ps 0.6 "
                   "lc '#c03010', "
                   "$frontier using 1:2:5 with labels offset 0.6,0.6 left font ',10' noenhanced\n");
}

int plot_trade(const trade_rows *rows, const char *path)
{
    plotter p;

    if (rows->panel_count == 0 || !plotter_start(&p, path, 2, rows->panel_count))
        return rows->panel_count == 0;
    for (size_t panel = 0; panel < rows->panel_count; panel++) {
        plot_panel(rows, p.pipe, panel, "frame_ms", "ms a frame, median, 5 to 95 %");
        plot_panel(rows, p.pipe, panel, "energy_estimate_mj", "mJ a frame, estimated from traffic");
    }
    return plotter_finish(&p);
}

/* What times are drawn against, and which. */
static const struct {
    const char *column, *label, *time, *time_label;
} scales[] = {{"lights", "lights", "frame_ms", "ms a frame, median"},
              {"faces", "faces of casters", "frame_ms", "ms a frame, median"},
              {"pixels", "pixels of a frame", "frame_ms", "ms a frame, median"},
              {"faces", "faces of casters", "plan_ms", "ms of it for planning, median"}};
enum { LIGHTS, FACES, PIXELS, PLANNING, SCALES };

static double scale_of(const trade_rows *rows, size_t row, int scale)
{
    if (scale == PIXELS)
        return trade_number(rows, row, "width") * trade_number(rows, row, "height");
    return trade_number(rows, row, scales[scale].column);
}

static int is_by_faces(int scale)
{
    return scale == FACES || scale == PLANNING;
}

/* Of full masks, and like the first but for what a panel is of; rows of other faces are of other scenes. */
static int is_of_panel(const trade_rows *rows, size_t row, size_t first, int scale)
{
    if (isnan(trade_error(rows, row)) || trade_number(rows, row, "scale") != 1.0)
        return 0;
    for (int other = LIGHTS; other <= PIXELS; other += PIXELS - LIGHTS)
        if (other != scale && scale_of(rows, row, other) != scale_of(rows, first, other))
            return 0;
    return is_by_faces(scale) || strcmp(trade_word(rows, row, "scene"), trade_word(rows, first, "scene")) == 0;
}

/* Whether a panel starts with the row: it is the first of its kind, and of several values. */
static int starts_panel(const trade_rows *rows, size_t row, int scale)
{
    int has_others = 0;

    for (size_t i = 0; i < rows->count; i++) {
        if (!is_of_panel(rows, i, row, scale))
            continue;
        if (i < row)
            return 0;
        has_others |= scale_of(rows, i, scale) != scale_of(rows, row, scale);
    }
    return has_others && is_of_panel(rows, row, row, scale);
}

static int has_config(const trade_rows *rows, size_t row, size_t like)
{
    return strcmp(trade_word(rows, row, "config"), trade_word(rows, like, "config")) == 0;
}

/* A line of one configuration, by growing values. */
static void put_line(const trade_rows *rows, FILE *f, size_t first, size_t of, int scale)
{
    double last = -INFINITY;

    for (;;) {
        size_t next = rows->count;

        for (size_t i = of; i < rows->count; i++)
            if (is_of_panel(rows, i, first, scale) && has_config(rows, i, of) && scale_of(rows, i, scale) > last &&
                (next == rows->count || scale_of(rows, i, scale) < scale_of(rows, next, scale)))
                next = i;
        if (next == rows->count)
            break;
        last = scale_of(rows, next, scale);
        fprintf(f, "%g %g \"", last, trade_number(rows, next, scales[scale].time));
        plotter_put_name(f, trade_word(rows, next, "config"));
        fprintf(f, "\"\n");
    }
}

static void plot_lines(const trade_rows *rows, FILE *f, size_t first, int scale)
{
    const char *slash = strrchr(trade_word(rows, first, "scene"), '/');
    size_t lines = 0;

    for (size_t i = first; i < rows->count; i++) {
        int is_new = is_of_panel(rows, i, first, scale);

        for (size_t k = first; k < i && is_new; k++)
            is_new = !(is_of_panel(rows, k, first, scale) && has_config(rows, k, i));
        if (!is_new)
            continue;
        fprintf(f, "$line%lu << EOD\n", (unsigned long)lines++);
        put_line(rows, f, first, i, scale);
        fprintf(f, "EOD\n");
    }
    fprintf(f, "set title '");
    if (is_by_faces(scale))
        fprintf(f, "lights: %s", trade_word(rows, first, "lights"));
    else
        plotter_put_name(f, slash ? slash + 1 : trade_word(rows, first, "scene"));
    fprintf(f,
            "' noenhanced\nset xlabel '%s'\nset ylabel '%s'\nset logscale xy\nset xrange [*:*]\n"
            "set yrange [*:*]\nset key outside right noenhanced font ',10'\nplot ",
            scales[scale].label, scales[scale].time_label);
    for (size_t i = 0; i < lines; i++)
        fprintf(f, "%s$line%lu using 1:2:(strcol(3)) with linespoints pt 7 ps 0.4 lw 1.5 title word($line%lu[1], 3)",
                i ? ", " : "", (unsigned long)i, (unsigned long)i);
    fprintf(f, "\n");
}

/* Calls for each panel there is, or only counts them. */
static size_t plot_panels(const trade_rows *rows, FILE *f)
{
    size_t panels = 0;

    for (int scale = 0; scale < SCALES; scale++) {
        size_t of_this = 0;

        for (size_t i = 0; i < rows->count; i++)
            if (starts_panel(rows, i, scale) && (!is_by_faces(scale) || of_this == 0)) {
                if (f)
                    plot_lines(rows, f, i, scale);
                of_this++;
            }
        panels += of_this;
    }
    return panels;
}

int plot_scaling(const trade_rows *rows, const char *path)
{
    const size_t panels = plot_panels(rows, NULL);
    plotter p;

    if (panels == 0)
        return 1;
    if (!plotter_start(&p, path, 2, (panels + 1) / 2))
        return 0;
    plot_panels(rows, p.pipe);
    return plotter_finish(&p);
}
