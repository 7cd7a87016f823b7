/* trade_rows.c - see trade_rows.h. */
#include "trade_rows.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Takes a line apart in place: commas become ends, quotes go. Returns how many fields it has. */
static int split(char *line, char *fields[TRADE_MOST_COLUMNS])
{
    int count = 0;

    while (count < TRADE_MOST_COLUMNS) {
        char *out = line;
        int quoted = 0;

        fields[count++] = line;
        for (; *line && (quoted || *line != ','); line++) {
            if (*line == '"' && quoted && line[1] == '"')
                *out++ = *line++;
            else if (*line == '"')
                quoted = !quoted;
            else
                *out++ = *line;
        }
        if (!*line) {
            *out = '\0';
            break;
        }
        line++;
        *out = '\0';
    }
    return count;
}

static int is_same_panel(const trade_rows *r, size_t a, size_t b)
{
    static const char *const key[] = {"scene", "width", "height", "lights", "frames", "path", "renderer"};

    for (size_t i = 0; i < sizeof key / sizeof key[0]; i++)
        if (strcmp(trade_word(r, a, key[i]), trade_word(r, b, key[i])) != 0)
            return 0;
    return 1;
}

static void find_panel(trade_rows *r, size_t row)
{
    for (size_t i = 0; i < row; i++)
        if (is_same_panel(r, i, row)) {
            r->of[row].panel = r->of[i].panel;
            return;
        }
    r->of[row].panel = r->panel_count++;
}

int trade_rows_make(trade_rows *out, const trade_csv *table)
{
    const size_t header_size = strlen(trade_header()) + 1;
    size_t size = header_size;
    char *at;

    memset(out, 0, sizeof *out);
    for (size_t i = 0; i < table->count; i++)
        size += strlen(table->rows[i]) + 1;
    out->text = malloc(size);
    out->of = calloc(table->count + 1, sizeof *out->of);
    if (!out->text || !out->of) {
        trade_rows_free(out);
        return 0;
    }
    at = memcpy(out->text, trade_header(), header_size);
    out->column_count = split(at, out->columns);
    at += header_size;
    for (size_t i = 0; i < table->count; i++) {
        const size_t length = strlen(table->rows[i]) + 1;
        int count;

        memcpy(at, table->rows[i], length);
        count = split(at, out->of[i].fields);
        for (int k = count; k < out->column_count; k++)
            out->of[i].fields[k] = at + length - 1;
        at += length;
        out->count++;
        find_panel(out, i);
    }
    return 1;
}

void trade_rows_free(trade_rows *rows)
{
    free(rows->text);
    free(rows->of);
    memset(rows, 0, sizeof *rows);
}

const char *trade_word(const trade_rows *rows, size_t row, const char *column)
{
    for (int c = 0; c < rows->column_count; c++)
        if (strcmp(rows->columns[c], column) == 0)
            return rows->of[row].fields[c];
    return "";
}

double trade_number(const trade_rows *rows, size_t row, const char *column)
{
    const char *word = trade_word(rows, row, column);
    char *end;
    const double value = strtod(word, &end);

    return end == word ? NAN : value;
}

double trade_error(const trade_rows *rows, size_t row)
{
    return 100.0 * trade_number(rows, row, "wrong") / trade_number(rows, row, "visible");
}

int trade_is_dominated(const trade_rows *rows, size_t row, const char *column)
{
    const double error = trade_error(rows, row), cost = trade_number(rows, row, column);

    for (size_t i = 0; i < rows->count; i++) {
        const double other_error = trade_error(rows, i), other_cost = trade_number(rows, i, column);

        if (rows->of[i].panel == rows->of[row].panel && other_error <= error && other_cost <= cost &&
            (other_error < error || other_cost < cost))
            return 1;
    }
    return 0;
}

void trade_panel_name(const trade_rows *rows, size_t panel, char *name, size_t size)
{
    for (size_t i = 0; i < rows->count; i++)
        if (rows->of[i].panel == panel) {
            const char *scene_name = trade_word(rows, i, "scene"), *slash = strrchr(scene_name, '/');

            snprintf(name, size, "%s, %sx%s, lights: %s", slash ? slash + 1 : scene_name, trade_word(rows, i, "width"),
                     trade_word(rows, i, "height"), trade_word(rows, i, "lights"));
            return;
        }
    name[0] = '\0';
}
