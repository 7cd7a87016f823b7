/* trade_csv.h - trade.csv: a row for each configuration on each scene, written whole after each, so that a run that is
 * interrupted keeps what it has, and goes on where it was.
 *
 * What is measured by a clock is last in a row: all before it is the same in every run. */
#ifndef TRADE_CSV_H
#define TRADE_CSV_H
#include "trial.h"

/* What a row is of. */
typedef struct row_key {
    const char *scene, *config, *path, *renderer, *driver;
    uint32_t width, height, lights, frames, repeat;
} row_key;

typedef struct trade_csv {
    char *path;
    char **rows;
    size_t count, capacity;
} trade_csv;

/* Reads the rows that are there. 1; 0 having said why, also of a file that is no such table. */
int trade_open(trade_csv *t, const char *path);
void trade_close(trade_csv *t);

/* The line of the columns' names. */
const char *trade_header(void);

int trade_has(const trade_csv *t, const row_key *key);
/* Adds a row and writes the file. 1, or 0 having said why. */
int trade_add(trade_csv *t, const row_key *key, const config *c, const subject *s, const trial *result);
#endif
