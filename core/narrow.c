/* narrow.c - what another's volume must reach of a solid that casts too: the part of it that is lit and seen.
 *
 * The side of a solid that faces away from the light lies in its own volume, and the side that faces away from the eye
 * lies behind the other. So of a receiver that is drawn, and casts in the same light, only triangles count that face
 * both: a box around these, one axis towards the light, and the pixels in which it may be seen. Found when a volume
 * first comes near, once a light. */
#include "gni_plan.h"

#include <math.h>
#include <string.h>

/* Whether its own volume surely holds what faces away from the light, and no back of it is seen. */
static int may_narrow(const gni_draft *d, uint32_t index)
{
    const gn_scene *s = d->scene;
    const gn_object *object = &s->objects[index];
    const gn_mesh *mesh = object->mesh;
    const gni_hull *box = &d->boxes[index];
    const unsigned needed = GN_CASTS | GN_RECEIVES | GN_DRAWN;

    if ((object->flags & needed) != needed || d->region || s->camera.orthographic ||
        s->without & GN_MEASURE_INTERVALS || mesh->group_of || mesh->info.part_count == 0 ||
        mesh->info.outward_part_count != mesh->info.part_count || gni_is_exempt(&s->lights[d->light], index))
        return 0;
    if (s->cache && (s->cache->desc.update_every > 1 || s->cache->desc.update_distance > 0.0))
        return 0; /* its own volume may be old */
    for (int i = 0; i < 8; i++)
        if (!(-box->points[i][2] > s->camera.znear * (1.0 + GNI_MARGIN)))
            return 0;
    return gni_light_is_outside(box, d->bounds.light) && gni_may_cast(&d->bounds, box);
}

/* Adds triangles to the range of each axis; rows take the mesh's space to the axes. */
static void add_triangles(const gn_mesh *mesh, uint32_t cluster, uint64_t bits, double rows[3][4], double range[3][2])
{
    for (; bits; bits &= bits - 1) {
        const uint32_t *corners = mesh->triangles + 3 * (size_t)(cluster * GNI_CLUSTER + gni_lowest_bit(bits));

        for (int corner = 0; corner < 3; corner++) {
            const float *p = mesh->positions + 3 * (size_t)corners[corner];
            const double x = (double)p[0], y = (double)p[1], z = (double)p[2];

            for (int axis = 0; axis < 3; axis++) {
                const double *r = rows[axis], at = r[0] * x + r[1] * y + r[2] * z + r[3];

                range[axis][0] = at < range[axis][0] ? at : range[axis][0];
                range[axis][1] = at > range[axis][1] ? at : range[axis][1];
            }
        }
    }
}

static void fill_box(gni_hull *box, double axes[3][3], double range[3][2])
{
    memset(box, 0, sizeof *box);
    box->point_count = 8;
    for (int corner = 0; corner < 8; corner++)
        for (int axis = 0; axis < 3; axis++)
            for (int k = 0; k < 3; k++)
                box->points[corner][k] += range[axis][corner >> axis & 1] * axes[axis][k];
    for (int axis = 0; axis < 3; axis++)
        for (int k = 0; k < 3; k++)
            box->edges[axis][k] = box->points[1 << axis][k] - box->points[0][k];
}

static void find_box(gni_narrow *n, const gni_draft *d, uint32_t index)
{
    const gn_object *object = &d->scene->objects[index];
    const gn_mesh *mesh = object->mesh;
    uint64_t *const away = d->away[0], *const hidden = d->away[1], *const scratch = d->away[2];
    const double *light = d->bounds.light, *ball = d->balls[index];
    static const double origin[3] = {0, 0, 0};
    double model_view[16], inverse[16], eye[4], of_light[4], axis[3], axes[3][3], rows[3][4];
    double range[3][2] = {{INFINITY, -INFINITY}, {INFINITY, -INFINITY}, {INFINITY, -INFINITY}};

    gni_model_view(model_view, &d->scene->camera, object->model, mesh->info.centre);
    if (!gn_mat4_invert_affine(inverse, model_view) ||
        !gni_light_in_object(&d->scene->lights[d->light], object, of_light))
        return;
    gn_mat4_transform(eye, inverse, origin, 1.0);
    eye[3] = 1.0;
    gni_find_facing(mesh, of_light, scratch, away);
    gni_find_facing(mesh, eye, scratch, hidden);
    for (int k = 0; k < 3; k++)
        axis[k] = light[k] - ball[k] * light[3];
    gni_make_axes(axes, axis);
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 4; k++)
            rows[i][k] = gni_dot(axes[i], model_view + 4 * k);
    }
    for (uint32_t c = 0; c < mesh->cluster_count; c++) {
        const uint32_t rest = mesh->info.triangle_count - c * GNI_CLUSTER;
        const uint64_t all = rest < GNI_CLUSTER ? ((uint64_t)1 << rest) - 1 : ~(uint64_t)0;

        add_triangles(mesh, c, ~(away[c] | hidden[c]) & all, rows, range);
    }
    n->is = range[0][0] <= range[0][1] ? GNI_NARROWED : GNI_NOTHING;
    if (n->is == GNI_NOTHING)
        return;
    fill_box(&n->box, axes, range);
    gni_find_rectangle(n->rectangle, &n->box, &d->scene->camera, &d->scene->target);
    gni_meet_rectangles(n->rectangle, d->rectangles[index]);
}

const gni_narrow *gni_narrow_receiver(const gni_draft *d, uint32_t object)
{
    gni_narrow *n = &d->narrow[object];

    if (n->is == GNI_UNKNOWN) {
        n->is = GNI_WHOLE;
        n->box = d->boxes[object];
        memcpy(n->rectangle, d->rectangles[object], sizeof n->rectangle);
        if (may_narrow(d, object))
            find_box(n, d, object);
    }
    return n;
}
