/* extrude.c - the one matrix that moves a caster's vertices away from the light.
 *
 * The line from the light l through a point x meets the plane p at (p . l) x - (p . x) l, in homogeneous
 * coordinates. With the plane at infinity, p = (0, 0, 0, 1), that is (x l_w - l, 0) for a point x with w = 1: the
 * extrusion of Everitt 2002, section 3.2.2, and of McGuire 2003. A finite plane ends the volume there. So one
 * expression serves point lights and directional ones, infinite and ended volumes. */
#include "gni.h"

void gni_extrusion(double out[16], const double light[4], const double plane[4])
{
    const double s = plane[0] * light[0] + plane[1] * light[1] + plane[2] * light[2] + plane[3] * light[3];

    for (int column = 0; column < 4; column++)
        for (int row = 0; row < 4; row++)
            out[4 * column + row] = (row == column ? s : 0.0) - light[row] * plane[column];
}
