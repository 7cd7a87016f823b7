/* truth_vec.h - three-vectors of doubles for the truth's own use. Results may be an argument's array. */
#ifndef TRUTH_VEC_H
#define TRUTH_VEC_H
#include <math.h>

static inline double truth_dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline double truth_length(const double a[3])
{
    return sqrt(truth_dot(a, a));
}

static inline void truth_sub(double out[3], const double a[3], const double b[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = a[k] - b[k];
}

/* out = a + s b */
static inline void truth_along(double out[3], const double a[3], double s, const double b[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = a[k] + s * b[k];
}

static inline void truth_cross(double out[3], const double a[3], const double b[3])
{
    const double x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2], z = a[0] * b[1] - a[1] * b[0];

    out[0] = x;
    out[1] = y;
    out[2] = z;
}
#endif
