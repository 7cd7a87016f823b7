/* matrix.c - the few 4x4 matrix operations that placing casters, lights and cameras needs, in double precision; and a product of vectors.
 *
 * Sums run in a fixed order (left to right over the inner index), so that equal inputs give equal bits everywhere. */
#include "gni.h"

#include <math.h>
#include <string.h>

void gn_mat4_identity(double out[16])
{
    for (int i = 0; i < 16; i++)
        out[i] = i % 5 == 0 ? 1.0 : 0.0;
}

void gn_mat4_multiply(double out[16], const double a[16], const double b[16])
{
    double r[16];

    for (int column = 0; column < 4; column++)
        for (int row = 0; row < 4; row++)
            r[4 * column + row] = a[row] * b[4 * column] + a[4 + row] * b[4 * column + 1] +
                                  a[8 + row] * b[4 * column + 2] + a[12 + row] * b[4 * column + 3];
    memcpy(out, r, sizeof r);
}

void gn_mat4_from_trs(double out[16], const double t[3], const double q[4], const double s[3])
{
    const double n = 2.0 / (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    const double x = q[0], y = q[1], z = q[2], w = q[3];
    const double r[9] = {
        1 - n * (y * y + z * z), n * (x * y + w * z),     n * (x * z - w * y), /* first column */
        n * (x * y - w * z),     1 - n * (x * x + z * z), n * (y * z + w * x), /* second */
        n * (x * z + w * y),     n * (y * z - w * x),     1 - n * (x * x + y * y),
    };

    for (int column = 0; column < 3; column++) {
        for (int row = 0; row < 3; row++)
            out[4 * column + row] = r[3 * column + row] * s[column];
        out[4 * column + 3] = 0.0;
        out[12 + column] = t[column];
    }
    out[15] = 1.0;
}

double gn_mat4_determinant3(const double m[16])
{
    return m[0] * (m[5] * m[10] - m[9] * m[6]) - m[4] * (m[1] * m[10] - m[9] * m[2]) +
           m[8] * (m[1] * m[6] - m[5] * m[2]);
}

int gn_mat4_invert_affine(double out[16], const double m[16])
{
    const double det = gn_mat4_determinant3(m);
    double lengths = 1.0, r[16];

    for (int column = 0; column < 3; column++)
        lengths *= sqrt(m[4 * column] * m[4 * column] + m[4 * column + 1] * m[4 * column + 1] +
                        m[4 * column + 2] * m[4 * column + 2]);
    /* the volume spanned by the columns against the box of their lengths; also false for NaN */
    if (!(fabs(det) > 1e-14 * lengths))
        return 0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;

            /* inverse (row i, column j) = cofactor (row j, column i) / det */
            r[4 * j + i] = (m[4 * i1 + j1] * m[4 * i2 + j2] - m[4 * i2 + j1] * m[4 * i1 + j2]) / det;
        }
    for (int i = 0; i < 3; i++) {
        r[12 + i] = -(r[i] * m[12] + r[4 + i] * m[13] + r[8 + i] * m[14]);
        r[4 * i + 3] = 0.0;
    }
    r[15] = 1.0;
    memcpy(out, r, sizeof r);
    return 1;
}

void gn_mat4_transform(double out[3], const double m[16], const double v[3], double w)
{
    const double x = v[0], y = v[1], z = v[2];

    for (int row = 0; row < 3; row++)
        out[row] = m[row] * x + m[4 + row] * y + m[8 + row] * z + m[12 + row] * w;
}

void gn_mat4_to_float(float out[16], const double m[16])
{
    for (int i = 0; i < 16; i++)
        out[i] = (float)m[i];
}

void gni_cross(double out[3], const double a[3], const double b[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}
