/* camera.c - from world to clip space.
 *
 * A perspective camera's far plane is at infinity, without any epsilon (Everitt 2002, section 3.2.1): rows z and w of
 * the projection differ only in their last column, so that a vertex at infinity gets z = w exactly and is not clipped.
 * A camera's zfar is honoured by the depth to which the buffer is cleared. An orthographic camera spans a finite range,
 * and so does the camera of a host that insists on its own far plane. */
#include "gni.h"

#include <math.h>
#include <string.h>

gn_result gni_check_camera(gn_context *context, const gn_camera *camera)
{
    const double lengths[6] = {camera->left, camera->right, camera->bottom, camera->top, camera->znear, camera->zfar};

    for (int i = 0; i < 16; i++)
        if (!(fabs(camera->world[i]) <= GNI_MOST))
            return gn_fail(context, GN_E_ARG, "camera: element %d of its matrix is %g", i, camera->world[i]);
    for (int i = 0; i < 6; i++)
        if (!(fabs(lengths[i]) <= GNI_MOST))
            return gn_fail(context, GN_E_ARG, "camera: an edge or a distance is %g", lengths[i]);
    if (camera->left >= camera->right || camera->bottom >= camera->top)
        return gn_fail(context, GN_E_ARG, "camera: image from %g to %g by %g to %g has no area", camera->left,
                       camera->right, camera->bottom, camera->top);
    if (!camera->orthographic && camera->znear <= 0.0)
        return gn_fail(context, GN_E_ARG, "camera: znear %g is not in front of the eye", camera->znear);
    if (camera->zfar != 0.0 && camera->zfar <= camera->znear)
        return gn_fail(context, GN_E_ARG, "camera: zfar %g is not behind znear %g", camera->zfar, camera->znear);
    if (camera->finite_far && (camera->orthographic || camera->zfar == 0.0))
        return gn_fail(context, GN_E_ARG, "camera: a finite far plane needs a perspective camera and a zfar (%g)",
                       camera->zfar);
    return GN_OK;
}

void gni_model_view(double out[16], const gn_camera *camera, const double model[16], const float centre[3])
{
    const double c[3] = {(double)centre[0], (double)centre[1], (double)centre[2]};
    double m[16], origin[3];

    gn_mat4_transform(origin, model, c, 1.0);
    for (int i = 0; i < 16; i++)
        m[i] = model[i];
    for (int i = 0; i < 3; i++)
        m[12 + i] = origin[i] - camera->world[12 + i];
    for (int column = 0; column < 4; column++) {
        for (int row = 0; row < 3; row++)
            out[4 * column + row] = camera->world[4 * row] * m[4 * column] +
                                    camera->world[4 * row + 1] * m[4 * column + 1] +
                                    camera->world[4 * row + 2] * m[4 * column + 2];
        out[4 * column + 3] = column == 3 ? 1.0 : 0.0;
    }
}

void gni_projection(double out[16], const gn_camera *camera, const double range[2])
{
    const double width = camera->right - camera->left, height = camera->top - camera->bottom;
    const double x = (camera->right + camera->left) / width, y = (camera->top + camera->bottom) / height;

    for (int i = 0; i < 16; i++)
        out[i] = 0.0;
    out[0] = 2.0 / width;
    out[5] = 2.0 / height;
    if (gni_is_orthographic(camera)) {
        out[12] = -x;
        out[13] = -y;
        out[10] = -2.0 / (range[1] - range[0]);
        out[14] = -(range[1] + range[0]) / (range[1] - range[0]);
        out[15] = 1.0;
        return;
    }
    out[8] = x;
    out[9] = y;
    out[11] = -1.0;
    if (gni_has_finite_far(camera)) {
        out[10] = -(range[1] + range[0]) / (range[1] - range[0]);
        out[14] = -2.0 * range[1] * range[0] / (range[1] - range[0]);
    } else {
        out[10] = -1.0;
        out[14] = -2.0 * range[0];
    }
}

double gni_depth_of(const gn_camera *camera, const double range[2], double distance)
{
    if (gni_is_orthographic(camera))
        return (distance - range[0]) / (range[1] - range[0]);
    return (1.0 - range[0] / distance) * (gni_has_finite_far(camera) ? range[1] / (range[1] - range[0]) : 1.0);
}

void gni_box_hull(gni_hull *out, const gn_mesh_info *info, const double model_view[16])
{
    memset(out, 0, sizeof *out);
    out->point_count = 8;
    for (int c = 0; c < 8; c++) {
        double p[3];

        for (int axis = 0; axis < 3; axis++)
            p[axis] = (double)(c >> axis & 1 ? info->box_max[axis] : info->box_min[axis]);
        gn_mat4_transform(out->points[c], model_view, p, 1.0);
    }
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            out->edges[i][k] = out->points[1 << i][k] - out->points[0][k];
}
