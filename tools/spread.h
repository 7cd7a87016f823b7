/* spread.h - how repeated measurements are spread: the median, and what 5 and 95 % of them are below. */
#ifndef SPREAD_H
#define SPREAD_H
#include <stddef.h>

typedef struct spread {
    double median, p5, p95;
} spread;

/* The order of doubles, for qsort. */
int by_value(const void *a, const void *b);

/* Sorts the values, of which there is one at least. */
spread spread_of(double *values, size_t count);
#endif
