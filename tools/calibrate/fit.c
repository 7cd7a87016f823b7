/* fit.c - see fit.h.
 *
 * Unknowns are multiples of what is likely, drawn back to one the more the rows differ from that. Coordinate descent on the
 * normal equations: each in turn is set to what is best for it, or nought. The sum is convex, so that it ends in its one least
 * place. */
#include "fit.h"

#include <math.h>

enum { ROUNDS = 2000 };
#define SPREAD 0.5 /* of coefficients about what is likely */
#define OFF    0.2 /* by which rows are off at least, whatever the few at hand say */

void fit_costs(const double (*a)[FIT_MOST], const double *b, int rows, int columns, const double *likely, double *x)
{
    double normal[FIT_MOST][FIT_MOST] = {{0}}, right[FIT_MOST] = {0}, off = 0.0, draws;

    for (int i = 0; i < rows; i++) {
        double expected = 0.0;

        for (int k = 0; k < columns; k++)
            expected += a[i][k] * likely[k];
        off += (b[i] / expected - 1.0) * (b[i] / expected - 1.0) / rows;
        for (int k = 0; k < columns; k++) {
            right[k] += a[i][k] * likely[k] * b[i] / (expected * expected);
            for (int j = 0; j < columns; j++)
                normal[k][j] += a[i][k] * likely[k] * a[i][j] * likely[j] / (expected * expected);
        }
    }
    draws = fmax(off, OFF * OFF) / (SPREAD * SPREAD);
    for (int k = 0; k < columns; k++) {
        right[k] += draws;
        normal[k][k] += draws;
        x[k] = 1.0;
    }
    for (int round = 0; round < ROUNDS; round++)
        for (int k = 0; k < columns; k++) {
            double rest = right[k];

            for (int j = 0; j < columns; j++)
                rest -= j == k ? 0.0 : normal[k][j] * x[j];
            x[k] = fmax(rest / normal[k][k], 0.0);
        }
    for (int k = 0; k < columns; k++)
        x[k] *= likely[k];
}
