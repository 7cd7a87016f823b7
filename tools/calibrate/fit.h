/* fit.h - least squares of few rows: of what is not negative, and near to what is likely where the rows leave it open. */
#ifndef FIT_H
#define FIT_H

enum { FIT_MOST = 8 };

/* x: [columns] such that a x comes closest to b, each row by the share of what is likely that it is off; and, less strongly, to
 * `likely`, by which all rows are more than nought. a: [rows][columns]. */
void fit_costs(const double (*a)[FIT_MOST], const double *b, int rows, int columns, const double *likely, double *x);
#endif
