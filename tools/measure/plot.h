/* plot.h - trade.svg and scaling.svg, by gnuplot. */
#ifndef PLOT_H
#define PLOT_H
#include "trade_rows.h"

/* Error against time, and against the estimate of energy: a pair of panels for each scene, size and number of lights. What is
 * dominated is grey; the frontier is drawn and named; bars run from p5 to p95. 1; 0 having said why, where gnuplot is
 * not there or fails. */
int plot_trade(const trade_rows *rows, const char *path);

/* Time against lights, faces and pixels, a line for each configuration at full size: a panel for each of these that the rows
 * have several of. The same; 1 without a file where there is none. */
int plot_scaling(const trade_rows *rows, const char *path);
#endif
