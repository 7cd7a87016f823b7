/* plotter.h - pictures by gnuplot: panels on a sheet, as SVG, that appear whole or not at all. */
#ifndef PLOTTER_H
#define PLOTTER_H
#include <stddef.h>
#include <stdio.h>

/* gnuplot, and the file that it makes. */
typedef struct plotter {
    FILE *pipe; /* for its commands */
    const char *path;
    char part[1024];
} plotter;

/* 1, or 0 having said why. */
int plotter_start(plotter *p, const char *path, size_t columns, size_t rows);
int plotter_finish(plotter *p);
/* What may stand in gnuplot's quotes. */
void plotter_put_name(FILE *f, const char *name);
#endif
