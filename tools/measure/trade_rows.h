/* trade_rows.h - rows of trade.csv as they are plotted and shown: fields by the names of their columns. */
#ifndef TRADE_ROWS_H
#define TRADE_ROWS_H
#include "trade_csv.h"

enum { TRADE_MOST_COLUMNS = 64 };

typedef struct trade_row {
    char *fields[TRADE_MOST_COLUMNS]; /* "" where there is none */
    size_t panel;                     /* rows of one scene, size and number of lights have the same */
} trade_row;

typedef struct trade_rows {
    char *columns[TRADE_MOST_COLUMNS];
    int column_count;
    trade_row *of;
    size_t count, panel_count;
    char *text; /* that the fields are in */
} trade_rows;

/* 1, or 0 without memory. */
int trade_rows_make(trade_rows *out, const trade_csv *table);
void trade_rows_free(trade_rows *rows);

const char *trade_word(const trade_rows *rows, size_t row, const char *column); /* "" where there is no such column */
double trade_number(const trade_rows *rows, size_t row, const char *column);    /* NAN where it is none */
/* The wrong of the pixels seen, in per cent; NAN where the configuration is impossible. */
double trade_error(const trade_rows *rows, size_t row);
/* Whether another row of its panel is no worse in both error and the column, and better in one. */
int trade_is_dominated(const trade_rows *rows, size_t row, const char *column);
/* "colours.gltf, 320x240, lights: 4" */
void trade_panel_name(const trade_rows *rows, size_t panel, char *name, size_t size);
#endif
