/* casting.c - which triangles look at the light, and which of them cast.
 *
 * Facing is decided once per triangle by the sign of one expression in double, and every part of a volume follows that
 * one bit: whatever rounding does to the bit, the volume stays a closed chain (DESIGN.md, decision 1).
 *
 * Casting follows DESIGN.md, decision 2. Whether a light is inside a solid part is asked only when it is within the
 * part's box, by the solid angle that the part fills as the light sees it; in doubt (the light on the surface) every
 * triangle casts, which is always right.
 *
 * Solid angle of a triangle: van Oosterom and Strackee, The Solid Angle of a Plane Triangle, IEEE Transactions on
 * Biomedical Engineering 30(2), 1983. */
#include "gni.h"

#include <math.h>
#include <string.h>

static int8_t facing_of(const double plane[4], const double light[4])
{
    const double side = plane[0] * light[0] + plane[1] * light[1] + plane[2] * light[2] + plane[3] * light[3];

    return (int8_t)((side > 0.0) - (side < 0.0));
}

void gn_facing(const gn_mesh *mesh, const double light[4], int8_t *facing)
{
    for (uint32_t t = 0; t < mesh->info.triangle_count; t++)
        facing[t] = facing_of(mesh->planes + 4 * (size_t)t, light);
}

/* The winding number of a closed part about a point; a half where the point lies on a triangle, or as good as on it. */
static double winding(const gn_mesh *mesh, const gni_part *part, const double point[4])
{
    double angle = 0.0;

    for (uint32_t i = 0; i < part->triangle_count; i++) {
        const uint32_t *c = mesh->triangles + 3 * (size_t)mesh->part_triangles[part->first_triangle + i];
        double v[3][3], length[3], triple, lengths, rest;

        for (int k = 0; k < 3; k++) {
            for (int axis = 0; axis < 3; axis++)
                v[k][axis] = (double)mesh->positions[3 * (size_t)c[k] + (size_t)axis] - point[axis];
            length[k] = sqrt(gni_dot(v[k], v[k]));
        }
        triple = v[0][0] * (v[1][1] * v[2][2] - v[1][2] * v[2][1]) + v[0][1] * (v[1][2] * v[2][0] - v[1][0] * v[2][2]) +
                 v[0][2] * (v[1][0] * v[2][1] - v[1][1] * v[2][0]);
        lengths = length[0] * length[1] * length[2];
        rest = lengths + gni_dot(v[0], v[1]) * length[2] + gni_dot(v[1], v[2]) * length[0] +
               gni_dot(v[2], v[0]) * length[1];
        if (rest <= 1e-12 * lengths && fabs(triple) <= 1e-12 * lengths)
            return 0.5;
        angle += atan2(triple, rest);
    }
    return angle / 6.283185307179586;
}

/* Only the lit triangles of a part cast when it is solid and the light is surely outside. */
static int only_lit_cast(const gn_mesh *mesh, const gni_part *part, const double light[4])
{
    if (!part->outward)
        return 0;
    if (light[3] == 0.0)
        return 1;
    for (int axis = 0; axis < 3; axis++)
        if (light[axis] < (double)part->box_min[axis] || light[axis] > (double)part->box_max[axis])
            return 1;
    return fabs(winding(mesh, part, light)) < 1e-9; /* far from all whole numbers but 0 */
}

void gn_casting(const gn_mesh *mesh, const double light[4], int8_t *casting)
{
    if (mesh->part_triangle_count < mesh->info.triangle_count)
        memset(casting, 0, mesh->info.triangle_count); /* degenerate triangles are in no part */
    for (uint32_t p = 0; p < mesh->info.part_count; p++) {
        const gni_part *part = &mesh->parts[p];
        const uint32_t *triangle = mesh->part_triangles + part->first_triangle;
        const int8_t unlit = only_lit_cast(mesh, part, light) ? (int8_t)-part->outward : 0;

        for (uint32_t i = 0; i < part->triangle_count; i++) {
            const int8_t facing = facing_of(mesh->planes + 4 * (size_t)triangle[i], light);

            casting[triangle[i]] = facing == unlit ? 0 : facing;
        }
    }
}

void gni_towards(double out[3], const gn_light *light)
{
    const double *v = light->towards;
    int exponent;

    frexp(fmax(fabs(v[0]), fmax(fabs(v[1]), fabs(v[2]))), &exponent);
    for (int i = 0; i < 3; i++)
        out[i] = ldexp(v[i], -exponent);
}

/* The light in the space of an object's mesh, less its centre: independent of the camera. 0 when the matrix is
 * singular. */
static int light_in_object(const gn_light *light, const gn_object *object, double out[4])
{
    const float *centre = object->mesh->info.centre;
    const double c[3] = {(double)centre[0], (double)centre[1], (double)centre[2]};
    const int is_sun = light->kind == GN_LIGHT_DIRECTIONAL;
    double inverse[16], origin[3], v[3];

    if (!gn_mat4_invert_affine(inverse, object->model))
        return 0;
    gn_mat4_transform(origin, object->model, c, 1.0);
    gni_towards(v, light);
    for (int i = 0; i < 3 && !is_sun; i++)
        v[i] = light->position[i] - origin[i];
    gn_mat4_transform(out, inverse, v, 0.0);
    out[3] = is_sun ? 0.0 : 1.0;
    return 1;
}

/* Facing of triangles as they lie flattened in the world. */
static void facing_flattened(const gn_object *object, const gn_light *light, int8_t *facing)
{
    const gn_mesh *mesh = object->mesh;
    const int is_sun = light->kind == GN_LIGHT_DIRECTIONAL;
    double towards[3];

    gni_towards(towards, light);
    for (uint32_t t = 0; t < mesh->info.triangle_count; t++) {
        double v[3][3], plane[4], at[4] = {0, 0, 0, is_sun ? 0.0 : 1.0};

        for (int k = 0; k < 3; k++) {
            const float *p = mesh->positions + 3 * (size_t)mesh->triangles[3 * (size_t)t + (size_t)k];
            double x[3];

            for (int axis = 0; axis < 3; axis++)
                x[axis] = (double)p[axis] + (double)mesh->info.centre[axis];
            gn_mat4_transform(v[k], object->model, x, 1.0);
        }
        for (int axis = 0; axis < 3; axis++) {
            const int y = (axis + 1) % 3, z = (axis + 2) % 3;

            plane[axis] = (v[1][y] - v[0][y]) * (v[2][z] - v[0][z]) - (v[1][z] - v[0][z]) * (v[2][y] - v[0][y]);
            at[axis] = is_sun ? towards[axis] : light->position[axis] - v[0][axis];
        }
        plane[3] = 0.0;
        facing[t] = facing_of(plane, at);
    }
}

void gn_object_facing(const gn_object *object, const gn_light *light, int8_t *facing)
{
    double at[4];

    if (light_in_object(light, object, at))
        gn_facing(object->mesh, at, facing);
    else
        facing_flattened(object, light, facing);
}

void gn_object_casting(const gn_object *object, const gn_light *light, int8_t *casting)
{
    double at[4];

    if (light_in_object(light, object, at)) {
        gn_casting(object->mesh, at, casting);
        return;
    }
    facing_flattened(object, light, casting);
    for (uint32_t p = 0; p < object->mesh->info.part_count; p++) {
        const gni_part *part = &object->mesh->parts[p];

        /* a flattened solid has two sheets in one place: the lit one is enough, and it is the one that is seen as
         * lit */
        for (uint32_t i = 0; part->outward && i < part->triangle_count; i++) {
            int8_t *c = &casting[object->mesh->part_triangles[part->first_triangle + i]];

            *c = *c == part->outward ? *c : 0;
        }
    }
}
