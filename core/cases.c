/* cases.c - McGuire's three cases: how a caster is counted, and which parts of its volume that takes.
 *
 * The occlusion pyramid has the light at its tip and the near rectangle at its base (McGuire 2003, section 6, figure
 * 2); a directional light's is a prism without end. Where it misses the caster's box nothing stands between the light
 * and the near rectangle: no volume is cut there, and counting before what is seen is right (case 1). Otherwise
 * counting must be behind what is seen, without a light cap where the caster is out of view (case 2) or with it (case
 * 3).
 *
 * A part of a volume that lies outside one plane of the view touches no pixel and is left out. Far corners are the
 * directions from the light through the box's corners, whatever the volume's real end: what is nearer than infinity
 * lies between corner and direction. Where the end is known (extent.c) they are its corners.
 *
 * The view is that of the scissor: near rectangle and planes are narrowed to it (McGuire 2003, line 7). */
#include "gni.h"

#include <math.h>
#include <string.h>

void gni_make_view(gni_view *view, const gn_camera *camera, const gn_target *target, const uint32_t scissor[4])
{
    const double n = camera->znear, reach = camera->orthographic ? 1.0 : n;
    const double width = (camera->right - camera->left) / target->width;
    const double height = (camera->top - camera->bottom) / target->height;
    /* the image's own edges to the last bit where the scissor reaches them */
    const double x[2] = {camera->left + width * scissor[0], scissor[0] + scissor[2] < target->width
                                                                ? camera->left + width * (scissor[0] + scissor[2])
                                                                : camera->right};
    const double y[2] = {camera->bottom + height * scissor[1], scissor[1] + scissor[3] < target->height
                                                                   ? camera->bottom + height * (scissor[1] + scissor[3])
                                                                   : camera->top};

    memset(view, 0, sizeof *view);
    view->near_rectangle.point_count = 4;
    for (int i = 0; i < 4; i++) {
        double *corner = view->near_rectangle.points[i];

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

int gni_may_be_seen(const gni_view *view, const gni_hull *hull)
{
    for (int p = 0; p < 5; p++)
        if (gni_is_outside(hull, view->planes[p]))
            return 0;
    return 1;
}

static int pyramid_misses(const gni_view *view, const double light[4], const gni_hull *box)
{
    gni_hull pyramid = view->near_rectangle;
    double spokes[6][3], axis[3];
    int spoke_count = 2;

    for (int k = 0; k < 3; k++) {
        spokes[0][k] = pyramid.points[1][k] - pyramid.points[0][k];
        spokes[1][k] = pyramid.points[3][k] - pyramid.points[0][k];
    }
    if (light[3] == 0.0) {
        memcpy(spokes[spoke_count++], light, sizeof spokes[0]);
        memcpy(pyramid.directions[pyramid.direction_count++], light, sizeof spokes[0]);
    } else {
        for (int i = 0; i < 4; i++, spoke_count++)
            for (int k = 0; k < 3; k++)
                spokes[spoke_count][k] = light[k] - pyramid.points[i][k];
        memcpy(pyramid.points[pyramid.point_count++], light, sizeof spokes[0]);
    }
    for (int i = 0; i < 3; i++) { /* faces of the box */
        gni_cross(axis, box->edges[i], box->edges[(i + 1) % 3]);
        if (gni_separates(axis, &pyramid, box))
            return 1;
    }
    gni_cross(axis, spokes[0], spokes[1]);
    if (gni_separates(axis, &pyramid, box))
        return 1;
    for (int i = 2; i < spoke_count; i++) /* faces of the pyramid */
        for (int rim = 0; rim < 2; rim++) {
            gni_cross(axis, spokes[i], spokes[rim]);
            if (gni_separates(axis, &pyramid, box))
                return 1;
        }
    for (int i = 0; i < spoke_count; i++)
        for (int e = 0; e < 3; e++) {
            gni_cross(axis, spokes[i], box->edges[e]);
            if (gni_separates(axis, &pyramid, box))
                return 1;
        }
    return 0;
}

void gni_find_case(gni_case *out, const gni_view *view, const gni_hull *box, const gni_hull *volume,
                   const double light[4])
{
    gni_hull image = *volume; /* of the end: at infinity directions alone */

    image.point_count = 0;
    if (volume->direction_count == 0) {
        image.point_count = volume->point_count - box->point_count;
        memcpy(image.points, volume->points + box->point_count, (size_t)image.point_count * sizeof image.points[0]);
    }
    out->is_drawn = 0;
    out->seen = (gni_may_be_seen(view, box) ? GNI_SEES_CASTER : 0u) |
                (gni_may_be_seen(view, &image) ? GNI_SEES_FAR : 0u) |
                (gni_may_be_seen(view, volume) ? GNI_SEES_VOLUME : 0u);
    out->number = pyramid_misses(view, light, box) ? 1 : out->seen & GNI_SEES_CASTER ? 3 : 2;
}
