/* proof_depth.c - depth that hides; depth clamped, not clipped; vertices at infinity that are not clipped.
 *
 * At infinity w = 0 and, under a projection that ends there too, z = w to the last bit: nothing lies outside. It breaks
 * where a GPU fuses one row's multiplications and not the other's, or clips with a margin. */
#include "proofs.h"

#include "gn_matrix.h"

#include <math.h>

static const int is_red[4] = {255, 0, 0, -1}, is_green[4] = {0, 255, 0, -1}, is_blue[4] = {0, 0, 255, -1};

/* Middle; farther over all; nearer over the right half. */
static void draw_hiding(gni_proofs *p)
{
    p->gl->glEnable(GL_DEPTH_TEST);
    gni_draw_rectangle(p, 0, 0, CELL, CELL, 0.0f, 0, gni_red);
    gni_draw_rectangle(p, 0, 0, CELL, CELL, 0.5f, 0, gni_green);
    gni_draw_rectangle(p, 8, 0, 8, CELL, -0.5f, 0, gni_blue);
}

static int hides(gni_proofs *p)
{
    return gni_is_color(p, 0, 0, 8, CELL, is_red, "what is behind is drawn") &&
           gni_is_color(p, 8, 0, 8, CELL, is_blue, "what is in front is not drawn");
}

/* Over depth 0.5 a plane that starts before it and leaves the far plane: drawn where it is behind, also beyond. With
 * the offset that volumes have: softpipe moves and clamps vertices then, which tilts the plane. */
static void draw_clamped(gni_proofs *p)
{
    static const float tilted[16] = {1, 0, 2, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 1, 1}; /* z = 1 + 2 x */

    p->gl->glEnable(GL_DEPTH_TEST);
    gni_draw_rectangle(p, 0, 0, CELL, CELL, 0.0f, 0, gni_green);
    p->gl->glEnable(GNI_DEPTH_CLAMP);
    p->gl->glEnable(GL_POLYGON_OFFSET_FILL);
    p->gl->glPolygonOffset(0.0f, 1.0f);
    p->gl->glDepthFunc(GL_GREATER);
    gni_draw_quad(p, 0, 0, CELL, CELL, tilted, gni_red);
    p->gl->glDisable(GNI_DEPTH_CLAMP);
}

static int clamps(gni_proofs *p)
{
    return gni_is_color(p, 0, 0, 4, CELL, is_green, "what lies before depth 0.5 comes behind it") &&
           gni_is_color(p, 4, 0, 4, CELL, is_red, "depths go wrong in a triangle that leaves the range") &&
           gni_is_color(p, 8, 0, 8, CELL, is_red, "what lies beyond depth 1 is clipped");
}

/* Matrices that carry the corners (+-1, +-1, 1) to points before the eye (near) and to the same directions at infinity
 * (far): a tilted quad that fills the view and more, with no round number in it. */
static void tilt(float near_matrix[16], float far_matrix[16], int view)
{
    const double a = 0.7 + 0.9 * view, s = 0.37 * cos(a), t = 0.37 * sin(a), n = 0.0131 * (view + 1), k = n * 7.3;
    double projection[16],
        direction[16] = {3.1, 0.13, s, 0, -0.17, 3.3, t, 0, 0.11, -0.07, -0.43, 0, 0.05, 0.09, -0.57};
    double m[16];

    gn_mat4_identity(projection);
    projection[0] = 1.07 + 0.011 * view;
    projection[5] = 1.13 - 0.013 * view;
    projection[10] = projection[11] = -1.0;
    projection[14] = -2.0 * n;
    projection[15] = 0.0;
    gn_mat4_multiply(m, projection, direction);
    gn_mat4_to_float(far_matrix, m);
    for (int i = 0; i < 15; i++)
        direction[i] *= k;
    direction[15] = 1.0;
    gn_mat4_multiply(m, projection, direction);
    gn_mat4_to_float(near_matrix, m);
}

/* Views 0 to 3 wholly at infinity, 4 to 7 with the lower edge near: a cap and a side of a volume. */
static void draw_infinity(gni_proofs *p)
{
    const gn_gl *gl = p->gl;
    const gn_gles *g = p->g;

    gl->glUseProgram(g->colored.name);
    gl->glUniform4fv(g->colored.color, 1, gni_red);
    gl->glBindBuffer(GL_ARRAY_BUFFER, g->quad);
    gl->glEnableVertexAttribArray(0);
    for (int view = 0; view < 8; view++) {
        float near_matrix[16], far_matrix[16];

        tilt(near_matrix, far_matrix, view);
        gl->glUniformMatrix4fv(g->colored.near_matrix, 1, GL_FALSE, near_matrix);
        gl->glUniformMatrix4fv(g->colored.far_matrix, 1, GL_FALSE, far_matrix);
        gl->glVertexAttribPointer(
            0, 4, GL_FLOAT, GL_FALSE, 4 * sizeof(float),
            (const void *)((view < 4 ? (size_t)GNI_FAR_QUAD : (size_t)GNI_WALL) * 4 * sizeof(float)));
        gl->glViewport(p->x + view % 4 * 4, p->y + view / 4 * 8, 4, 8);
        gl->glDrawArrays(GL_TRIANGLES, 0, 6);
    }
    gl->glDisableVertexAttribArray(0);
}

static int reaches_infinity(gni_proofs *p)
{
    return gni_is_color(p, 0, 0, CELL, 8, is_red, "pixels of triangles at infinity are lost") &&
           gni_is_color(p, 0, 8, CELL, 8, is_red, "pixels of triangles that reach infinity are lost");
}

const gni_cell_proof gni_proofs_of_depth[3] = {
    {GN_CAN_DEPTH, 0, draw_hiding, hides},
    {GN_CAN_DEPTH_CLAMP, 1u << GN_CAN_DEPTH, draw_clamped, clamps},
    {GN_CAN_W0, 0, draw_infinity, reaches_infinity},
};
