/* gn_matrix.h - 4x4 matrices in double precision.
 *
 * A matrix is double[16], column by column, as OpenGL has it: element (row, column) is m[4 * column + row]. Points are
 * columns. Everything is composed in double and the eye subtracted before a matrix becomes float, so that a scene far
 * from the origin keeps its last bits (DESIGN.md, decision 4).
 *
 * Results may be the same array as an argument. Nothing here allocates or fails, unless the comment says otherwise. */
#ifndef GN_MATRIX_H
#define GN_MATRIX_H

#ifdef __cplusplus
extern "C" {
#endif

void gn_mat4_identity(double out[16]);

/* out = a b: b is applied to a point first. */
void gn_mat4_multiply(double out[16], const double a[16], const double b[16]);

/* out = translation * rotation * scale, as glTF composes a node. rotation is a quaternion x, y, z, w; any length but
 * 0. */
void gn_mat4_from_trs(double out[16], const double translation[3], const double rotation[4], const double scale[3]);

/* The determinant of the upper left 3x3 block: negative for a mirroring transform. */
double gn_mat4_determinant3(const double m[16]);

/* Inverts a matrix whose last row is 0 0 0 1. Returns 1, or 0 (out untouched) when the upper left 3x3 block is singular
 * to within what double can tell. */
int gn_mat4_invert_affine(double out[16], const double m[16]);

/* out = m * (v, w): the first three rows; the matrix's last row is not read. w is 1 for a point, 0 for a direction. */
void gn_mat4_transform(double out[3], const double m[16], const double v[3], double w);

void gn_mat4_to_float(float out[16], const double m[16]);

#ifdef __cplusplus
}
#endif
#endif
