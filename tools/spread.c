/* spread.c - the spread by sorting: of n sorted values, those at n/2, n/20 and n - 1 - n/20. */
#include "spread.h"

#include <stdlib.h>

int by_value(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;

    return (x > y) - (x < y);
}

spread spread_of(double *values, size_t count)
{
    spread out;

    qsort(values, count, sizeof *values, by_value);
    out.median = values[count / 2];
    out.p5 = values[count / 20];
    out.p95 = values[count - 1 - count / 20];
    return out;
}
