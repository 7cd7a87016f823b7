/* fronts.c - of a solid that is drawn only fronts are seen, and only what is seen need be shadowed.
 *
 * A back lies behind some front. So of a solid that receives, with all of it before the eye, a box around the triangles
 * that face the eye stands beside the box around all: one axis towards the eye, and the pixels in which it may be
 * seen. It says what a volume may touch, where it may end and start, and where it must be counted. Found once a
 * frame. */
#include "gni_plan.h"

#include <math.h>
#include <string.h>

#define SMALL (1.0 / 16.0) /* of the mesh: a cluster whose ball is as good as its triangles */

static int shows_fronts_alone(const gni_draft *d, uint32_t index)
{
    const gn_scene *s = d->scene;
    const gn_object *object = &s->objects[index];
    const gn_mesh_info *info = &object->mesh->info;
    const gni_hull *box = &d->boxes[index];

    if (!(object->flags & GN_RECEIVES) || !(object->flags & GN_DRAWN) || !gni_models_less(d->choice.method) ||
        s->camera.orthographic || d->region || s->without & GN_MEASURE_INTERVALS || info->part_count == 0 ||
        info->outward_part_count != info->part_count || object->mesh->group_of) /* groups face the eye together */
        return 0;
    for (int i = 0; i < 8; i++)
        if (!(-box->points[i][2] > s->camera.znear * (1.0 + GNI_MARGIN)))
            return 0;
    return 1;
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

/* The same of a whole cluster, by the ball around it. */
static void add_ball(const gni_node *n, double rows[3][4], double range[3][2])
{
    for (int axis = 0; axis < 3; axis++) {
        const double *r = rows[axis], at = gni_dot(r, n->centre) + r[3], reach = n->radius * sqrt(gni_dot(r, r));

        range[axis][0] = fmin(range[axis][0], at - reach);
        range[axis][1] = fmax(range[axis][1], at + reach);
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

static void find_fronts(gni_fronts *f, const gni_draft *d, uint32_t index)
{
    static const double origin[3] = {0, 0, 0};
    const gn_object *object = &d->scene->objects[index];
    const gn_mesh *mesh = object->mesh;
    double model_view[16], inverse[16], eye[4], axes[3][3], rows[3][4];
    double range[3][2] = {{INFINITY, -INFINITY}, {INFINITY, -INFINITY}, {INFINITY, -INFINITY}};

    gni_model_view(model_view, &d->scene->camera, object->model, mesh->info.centre);
    if (!gn_mat4_invert_affine(inverse, model_view))
        return;
    gn_mat4_transform(eye, inverse, origin, 1.0);
    eye[3] = 1.0;
    gni_find_facing(mesh, eye, d->facing[0], d->facing[1]);
    gni_make_axes(axes, d->balls[index]);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 4; k++)
            rows[i][k] = gni_dot(axes[i], model_view + 4 * k);
    for (uint32_t c = 0; c < mesh->cluster_count; c++) {
        const uint32_t rest = mesh->info.triangle_count - c * GNI_CLUSTER;
        const uint64_t all = rest < GNI_CLUSTER ? ((uint64_t)1 << rest) - 1 : ~(uint64_t)0;
        const uint64_t bits = ~d->facing[1][c] & all;

        if (GNI_HAS_CLUSTERS && bits == all && mesh->nodes[c].radius < SMALL * mesh->radius)
            add_ball(&mesh->nodes[c], rows, range);
        else
            add_triangles(mesh, c, bits, rows, range);
    }
    if (!(range[0][0] <= range[0][1]))
        return;
    fill_box(&f->box, axes, range);
    gni_find_rectangle(f->rectangle, &f->box, &d->scene->camera, &d->scene->target);
    gni_meet_rectangles(f->rectangle, d->rectangles[index]);
}

/* Either box may be the closer one. */
double gni_lowest_seen(const double normal[3], const gni_draft *d, uint32_t object)
{
    return fmax(gni_lowest_of(normal, &d->boxes[object], d->balls[object]),
                gni_lowest_of(normal, &d->fronts[object].box, d->balls[object]));
}

void gni_find_fronts(gni_draft *d)
{
    unsigned flags = 0;

    for (uint32_t i = 0; i < d->scene->object_count; i++)
        flags |= d->scene->objects[i].flags;
    if (!(flags & GN_CASTS))
        return; /* nobody asks */
    for (uint32_t i = 0; i < d->scene->object_count; i++) {
        gni_fronts *f = &d->fronts[i];

        f->box = d->boxes[i];
        memcpy(f->rectangle, d->rectangles[i], sizeof f->rectangle);
        if (shows_fronts_alone(d, i) && gni_may_be_seen(&d->seen, &d->boxes[i]))
            find_fronts(f, d, i);
    }
}
