/* cases.c - McGuire's three cases: how a caster is counted, and which parts of its volume that takes.
 *
 * The occlusion pyramid has the light at its tip and the near rectangle at its base (McGuire 2003, section 6, figure 2);
 * a directional light's is a prism without end. Where it misses the caster's box nothing stands between the light and the
 * near rectangle: no volume is cut there, and counting before what is seen is right (case 1). Otherwise counting must
 * be behind what is seen, without a light cap where the caster is out of view (case 2) or with it (case 3).
 *
 * Boxes are of object space, so that in view space they are parallelepipeds, sheared ones too. Two convex bodies are
 * apart when some axis separates them: the normals of their faces and the products of their edges are enough. A margin
 * keeps rounding on the safe side; where no axis can be told, they touch.
 *
 * A part of a volume that lies outside one plane of the view touches no pixel and is left out. Far corners are the
 * directions from the light through the box's corners, whatever the volume's real end: what is nearer than infinity lies
 * between corner and direction. */
#include "gn_matrix.h"
#include "gni.h"

#include <math.h>
#include <string.h>

#define MARGIN                                                                                                         \
    1e-6 /* of the greatest coordinate: double precision leaves a wide gap to it, float and pixels a small one */

static void cross(double out[3], const double a[3], const double b[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void subtract(double out[3], const double a[3], const double b[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = a[i] - b[i];
}

void gni_make_view(gni_view *view, const gn_camera *camera)
{
    const double n = camera->znear, reach = camera->orthographic ? 1.0 : n;
    const double x[2] = {camera->left, camera->right}, y[2] = {camera->bottom, camera->top};

    memset(view, 0, sizeof *view);
    for (int i = 0; i < 4; i++) {
        double *corner = view->near_corners[i];

        corner[0] = x[i == 1 || i == 2] * reach;
        corner[1] = y[i >= 2] * reach;
        corner[2] = -n;
    }
    for (int side = 0; side < 2; side++) { /* inside is positive */
        const double sign = side ? -1.0 : 1.0;

        view->planes[side][0] = sign;
        view->planes[side][camera->orthographic ? 3 : 2] = sign * x[side] * (camera->orthographic ? -1.0 : 1.0);
        view->planes[2 + side][1] = sign;
        view->planes[2 + side][camera->orthographic ? 3 : 2] = sign * y[side] * (camera->orthographic ? -1.0 : 1.0);
    }
    view->planes[4][2] = -1.0;
    view->planes[4][3] = -n;
}

/* The corners of the box around an object, in view space. */
static void box_corners(const gn_mesh_info *info, const double model_view[16], double corners[8][3])
{
    for (int c = 0; c < 8; c++) {
        double p[3];

        for (int axis = 0; axis < 3; axis++)
            p[axis] = (double)(c >> axis & 1 ? info->box_max[axis] : info->box_min[axis]);
        gn_mat4_transform(corners[c], model_view, p, 1.0);
    }
}

static void grow(double range[2], double value)
{
    range[0] = fmin(range[0], value);
    range[1] = fmax(range[1], value);
}

/* Whether the axis separates pyramid and box. */
static int separates(const double axis[3], const gni_view *view, const double light[4], double corners[8][3])
{
    const double length = sqrt(dot(axis, axis));
    double pyramid[2] = {INFINITY, -INFINITY}, box[2] = {INFINITY, -INFINITY}, scale = 0.0;

    if (!(length > 0.0))
        return 0;
    for (int i = 0; i < 4; i++)
        grow(pyramid, dot(axis, view->near_corners[i]));
    if (light[3] != 0.0)
        grow(pyramid, dot(axis, light));
    for (int i = 0; i < 8; i++)
        grow(box, dot(axis, corners[i]));
    scale = MARGIN * (fmax(fabs(pyramid[0]), fabs(pyramid[1])) + fmax(fabs(box[0]), fabs(box[1])));
    if (light[3] == 0.0) {
        const double along = dot(axis, light), least = 1e-12 * length * sqrt(dot(light, light));

        /* towards the light without end; an axis all but at right angles to it is taken to see both ends */
        if (along > -least)
            pyramid[1] = INFINITY;
        if (along < least)
            pyramid[0] = -INFINITY;
    }
    return pyramid[0] > box[1] + scale || box[0] > pyramid[1] + scale;
}

static int pyramid_misses(const gni_view *view, const double light[4], double corners[8][3])
{
    double edges[3][3], spokes[6][3], axis[3];
    int spoke_count = 0;

    for (int i = 0; i < 3; i++)
        subtract(edges[i], corners[1 << i], corners[0]);
    subtract(spokes[spoke_count++], view->near_corners[1], view->near_corners[0]);
    subtract(spokes[spoke_count++], view->near_corners[3], view->near_corners[0]);
    if (light[3] == 0.0)
        memcpy(spokes[spoke_count++], light, sizeof spokes[0]);
    else
        for (int i = 0; i < 4; i++)
            subtract(spokes[spoke_count++], light, view->near_corners[i]);
    for (int i = 0; i < 3; i++) { /* faces of the box */
        cross(axis, edges[i], edges[(i + 1) % 3]);
        if (separates(axis, view, light, corners))
            return 1;
    }
    cross(axis, spokes[0], spokes[1]);
    if (separates(axis, view, light, corners))
        return 1;
    for (int i = 2; i < spoke_count; i++) /* faces of the pyramid */
        for (int rim = 0; rim < 2; rim++) {
            cross(axis, spokes[i], spokes[rim]);
            if (separates(axis, view, light, corners))
                return 1;
        }
    for (int i = 0; i < spoke_count; i++)
        for (int e = 0; e < 3; e++) {
            cross(axis, spokes[i], edges[e]);
            if (separates(axis, view, light, corners))
                return 1;
        }
    return 0;
}

/* Which of two hulls may be seen: 1 the box, 2 its image at infinity; 4 what lies between. */
static unsigned seen_parts(const gni_view *view, const double light[4], double corners[8][3])
{
    unsigned seen = 7;

    for (int p = 0; p < 5; p++) {
        const double *plane = view->planes[p];
        double box[2] = {INFINITY, -INFINITY}, far[2] = {INFINITY, -INFINITY}, scale = fabs(plane[3]), reach = 0.0;
        int box_is_out, far_is_out;

        for (int i = 0; i < 8; i++) {
            double direction[3];

            for (int k = 0; k < 3; k++)
                direction[k] = corners[i][k] * light[3] - light[k];
            grow(box, dot(plane, corners[i]) + plane[3]);
            grow(far, dot(plane, direction));
            for (int k = 0; k < 3; k++) {
                scale = fmax(scale, fabs(plane[k] * corners[i][k]));
                reach = fmax(reach, fabs(plane[k]) * (fabs(corners[i][k] * light[3]) + fabs(light[k])));
            }
        }
        box_is_out = box[1] < -MARGIN * scale;
        far_is_out = far[1] < -MARGIN * reach;
        if (box_is_out)
            seen &= ~1u;
        if (far_is_out)
            seen &= ~2u;
        if (box_is_out && far_is_out)
            seen &= ~4u;
    }
    return seen;
}

void gni_find_case(gni_case *out, const gni_view *view, const gn_mesh_info *info, const double model_view[16],
                   const double light[4])
{
    double corners[8][3];

    box_corners(info, model_view, corners);
    out->seen = seen_parts(view, light, corners);
    out->number = pyramid_misses(view, light, corners) ? 1 : out->seen & 1 ? 3 : 2;
}
