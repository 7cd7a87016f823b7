/* ends.c - where shadow volumes end that may not reach infinity.
 *
 * An orthographic camera cannot image a vertex at infinity, a camera with a finite far plane of its own clips it, and a
 * board may. Volumes then end (DESIGN.md, decision 3): an orthographic camera's depth range is widened to hold
 * them, which costs precision; in front of a finite far plane there is only so much room. So they end
 * as near as may be.
 *
 * A plane p > 0 on the side of everything visible that receives may end the volume of a triangle when the light is on
 * that side too and the triangle lies strictly between the plane and the parallel to it through the light: then each
 * ray from the light through the triangle reaches the plane behind everything that it could shadow (DESIGN.md, decision
 * 6). A triangle that lies wholly behind such a plane shadows nothing that is seen.
 *
 * Candidates are the faces of two boxes around what is seen and receives, one along the view's axes and one along
 * the world's: a floor under a lamp ends right below itself. When one plane serves a whole caster, it is taken.
 *
 * Otherwise the volume may end by reach: all vertices are moved away from the light by one factor of their distance (by
 * one distance, if it is directional), such that the nearest point of the caster comes to lie behind all that is seen.
 * That is right for any caster, in one piece, but a light close to one triangle carries the others far off: a
 * perspective camera whose far plane is at infinity does not mind, others do.
 *
 * Where there is no room for that before a finite far plane, there is no end. For an orthographic camera, which has no
 * other way, each triangle then takes the plane that keeps its end nearest to the eye, and the caster's volume falls
 * into as many closed volumes as there are planes. A triangle that no face serves (a large one, seen under a wide angle
 * from a light close to it) gets a plane parallel to itself. Volumes that touch have sides back to back: where a
 * surface cuts such a seam within a step or two of depth, a pixel may come out wrong. */
#include "gni.h"

#include <math.h>
#include <string.h>

#define MARGIN     (1.0 / 4096.0) /* of the diagonal of what is seen: many steps of even 16 bits of depth, and no more */
#define INSIDE     (1.0 / 1048576.0) /* of the depth range, before a finite far plane: what is rounded stays inside */
#define SLACK      1.25 /* of reach: a light so close that this is lost in rounding to float has no direction left */
#define MOST_REACH 1e9  /* what it carries off must stay a number in float */
#define STEPS      4.0  /* of depth between a perspective camera's receivers and an end, at least */

static void grow(double low[3], double high[3], const double p[3])
{
    for (int axis = 0; axis < 3; axis++) {
        low[axis] = fmin(low[axis], p[axis]);
        high[axis] = fmax(high[axis], p[axis]);
    }
}

static void grow_by_box(double low[3], double high[3], const gn_mesh_info *info, const double matrix[16])
{
    for (int corner = 0; corner < 8; corner++) {
        double p[3];

        for (int axis = 0; axis < 3; axis++)
            p[axis] = (double)(corner >> axis & 1 ? info->box_max[axis] : info->box_min[axis]);
        gn_mat4_transform(p, matrix, p, 1.0);
        grow(low, high, p);
    }
}

static void add_margin(double low[3], double high[3], double least)
{
    const double x = high[0] - low[0], y = high[1] - low[1], z = high[2] - low[2];
    const double margin = fmax(MARGIN * sqrt(x * x + y * y + z * z), least);

    for (int axis = 0; axis < 3; axis++) {
        low[axis] -= margin;
        high[axis] += margin;
    }
}

/* Cuts the box along the world's axes down to what the box along the view's axes reaches: a floor as wide as the
 * world is seen only so far. */
static void clip_by_view(double low[3], double high[3], const double view_low[3], const double view_high[3],
                         const double axes[16])
{
    double reach_low[3] = {INFINITY, INFINITY, INFINITY}, reach_high[3] = {-INFINITY, -INFINITY, -INFINITY};

    for (int corner = 0; corner < 8; corner++) {
        double p[3];

        for (int axis = 0; axis < 3; axis++)
            p[axis] = corner >> axis & 1 ? view_high[axis] : view_low[axis];
        gn_mat4_transform(p, axes, p, 0.0);
        grow(reach_low, reach_high, p);
    }
    for (int axis = 0; axis < 3; axis++) {
        low[axis] = fmax(low[axis], reach_low[axis]);
        high[axis] = fmin(high[axis], reach_high[axis]);
    }
}

/* The six faces of a box as planes that are positive inside. */
static void faces(double planes[6][4], const double low[3], const double high[3])
{
    memset(planes, 0, 6 * sizeof planes[0]);
    for (int axis = 0; axis < 3; axis++) {
        planes[2 * axis][axis] = 1.0;
        planes[2 * axis][3] = -low[axis];
        planes[2 * axis + 1][axis] = -1.0;
        planes[2 * axis + 1][3] = high[axis];
    }
}

/* The lowest that an edge of the image, given at distance 1, reaches between near plane and the deepest receiver. */
static double edge(const gn_camera *camera, double at_one, double deepest)
{
    return camera->orthographic ? at_one : at_one * (at_one < 0.0 ? deepest : camera->znear);
}

/* DESIGN.md, decision 6: four steps of depth at the farthest receiver, seen under whatever angle. */
static double steps_at(const gn_scene *scene, const double low[3], const double high[3])
{
    double reach = 0.0;

    if (scene->camera.orthographic)
        return 0.0;
    for (int axis = 0; axis < 3; axis++)
        reach += fmax(low[axis] * low[axis], high[axis] * high[axis]);
    return STEPS * sqrt(reach) * -low[2] / ldexp(scene->camera.znear, scene->target.depth_bits);
}

/* The view distance whose depth is INSIDE less than that of zfar. */
static double limit_of(const gn_camera *camera)
{
    const double n = camera->znear, share = n / camera->zfar;

    return n / (share + INSIDE * (1.0 - share));
}

void gni_receiver_region(gni_region *region, const gn_scene *scene)
{
    const gn_camera *camera = &scene->camera;
    double low[2][3], high[2][3], axes[16], least;

    memset(region, 0, sizeof *region);
    region->deepest = camera->zfar != 0.0 && camera->orthographic ? camera->zfar : camera->znear;
    region->is_deep = !camera->orthographic;
    region->limit = camera->finite_far ? limit_of(camera) : INFINITY;
    for (int box = 0; box < 2; box++)
        for (int axis = 0; axis < 3; axis++) {
            low[box][axis] = INFINITY;
            high[box][axis] = -INFINITY;
        }
    /* the world's axes, from the eye: view space turned, so that nothing is far from the origin */
    memcpy(axes, camera->world, sizeof axes);
    axes[12] = axes[13] = axes[14] = 0.0;
    for (uint32_t i = 0; i < scene->object_count; i++) {
        const gn_object *object = &scene->objects[i];
        double to_view[16], turned[16], object_low[3] = {INFINITY, INFINITY, INFINITY};
        double object_high[3] = {-INFINITY, -INFINITY, -INFINITY};

        gni_model_view(to_view, camera, object->model, object->mesh->info.centre);
        grow_by_box(object_low, object_high, &object->mesh->info, to_view);
        if (camera->zfar == 0.0 || !camera->orthographic)
            region->deepest = fmax(region->deepest, -object_low[2]);
        if (!(object->flags & GN_RECEIVES))
            continue;
        grow(low[0], high[0], object_low);
        grow(low[0], high[0], object_high);
        gn_mat4_multiply(turned, axes, to_view);
        grow_by_box(low[1], high[1], &object->mesh->info, turned);
    }
    if (camera->zfar != 0.0)
        region->deepest = fmin(region->deepest, camera->zfar);
    low[0][0] = fmax(low[0][0], edge(camera, camera->left, region->deepest));
    high[0][0] = fmin(high[0][0], -edge(camera, -camera->right, region->deepest));
    low[0][1] = fmax(low[0][1], edge(camera, camera->bottom, region->deepest));
    high[0][1] = fmin(high[0][1], -edge(camera, -camera->top, region->deepest));
    low[0][2] = fmax(low[0][2], -region->deepest);
    high[0][2] = fmin(high[0][2], -camera->znear);
    region->empty = !(low[0][0] < high[0][0] && low[0][1] < high[0][1] && low[0][2] < high[0][2]);
    if (region->empty)
        return;
    clip_by_view(low[1], high[1], low[0], high[0], axes);
    least = steps_at(scene, low[0], high[0]);
    for (int box = 0; box < 2; box++) {
        add_margin(low[box], high[box], least);
        faces(region->planes + 6 * box, low[box], high[box]);
        memcpy(region->corner_min[box], low[box], sizeof low[box]);
        memcpy(region->corner_max[box], high[box], sizeof high[box]);
    }
    memcpy(region->view_to_axes, axes, sizeof axes);
    for (int p = 6; p < 12; p++) { /* a plane turns with the inverse, and a rotation's inverse is its transpose */
        const double n[3] = {region->planes[p][0], region->planes[p][1], region->planes[p][2]};

        for (int i = 0; i < 3; i++)
            region->planes[p][i] = axes[4 * i] * n[0] + axes[4 * i + 1] * n[1] + axes[4 * i + 2] * n[2];
    }
}

static double side(const double plane[4], const double p[3], double w)
{
    return plane[0] * p[0] + plane[1] * p[1] + plane[2] * p[2] + plane[3] * w;
}

typedef struct search {
    const gni_region *region;
    const gn_mesh *mesh;
    const double *model_view, *light;
} search;

static void triangle_in_view(const search *s, uint32_t triangle, double v[3][3])
{
    for (int k = 0; k < 3; k++)
        gni_vertex(v[k], s->mesh, s->mesh->triangles[3 * (size_t)triangle + (size_t)k], s->model_view);
}

/* The greatest view distance of a triangle and its end on a plane; INFINITY when the plane cannot end it; -INFINITY
 * when it lies behind the plane and shadows nothing. */
static double depth_on(const search *s, const double plane[4], double v[3][3])
{
    const double of_light = side(plane, s->light, s->light[3]);
    double deepest = -INFINITY;
    int behind = 0;

    if (!(of_light > 0.0))
        return INFINITY;
    for (int k = 0; k < 3; k++) {
        const double of_point = side(plane, v[k], 1.0);
        const double w = of_light - of_point * s->light[3];

        behind += of_point <= 0.0;
        /* strictly between, and by enough that the division below keeps its digits */
        if (of_point <= 0.0 || !(w > 1e-9 * of_light))
            deepest = INFINITY;
        else
            deepest = fmax(deepest, fmax(-v[k][2], -(of_light * v[k][2] - of_point * s->light[2]) / w));
    }
    return behind == 3 ? -INFINITY : deepest;
}

/* A plane parallel to the triangle, behind it as the light sees it, and behind all of one of the two boxes. */
static void own_plane(const search *s, double v[3][3], double plane[4])
{
    const gni_region *r = s->region;
    double a[3], b[3], n[3], of_triangle, nearest = INFINITY, length;

    for (int i = 0; i < 3; i++) {
        a[i] = v[1][i] - v[0][i];
        b[i] = v[2][i] - v[0][i];
    }
    n[0] = a[1] * b[2] - a[2] * b[1];
    n[1] = a[2] * b[0] - a[0] * b[2];
    n[2] = a[0] * b[1] - a[1] * b[0];
    length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    of_triangle = n[0] * v[0][0] + n[1] * v[0][1] + n[2] * v[0][2];
    if (n[0] * s->light[0] + n[1] * s->light[1] + n[2] * s->light[2] - of_triangle * s->light[3] < 0.0)
        length = -length; /* the normal looks at the light */
    for (int i = 0; i < 3; i++)
        n[i] /= length;
    of_triangle /= length;
    for (int box = 0; box < 2; box++) {
        double turned[3] = {n[0], n[1], n[2]}, lowest = 0.0;

        if (box == 1)
            gn_mat4_transform(turned, r->view_to_axes, n, 0.0);
        for (int i = 0; i < 3; i++)
            lowest += turned[i] * (turned[i] > 0.0 ? r->corner_min[box][i] : r->corner_max[box][i]);
        /* the nearer to the light of the two serves, since what is seen lies in both boxes */
        if (box == 0 || lowest > nearest)
            nearest = lowest;
    }
    for (int i = 0; i < 3; i++)
        plane[i] = n[i];
    length = 0.0;
    for (int i = 0; i < 3; i++)
        length = fmax(length, r->corner_max[0][i] - r->corner_min[0][i]);
    plane[3] = -fmin(nearest, of_triangle - MARGIN * length);
}

/* One plane for the whole caster: the one whose ends are nearest. Returns its depth, or INFINITY. */
static double best_common(const search *s, const int8_t *casting, uint32_t *best)
{
    double depth[12];

    for (int p = 0; p < 12; p++)
        depth[p] = -INFINITY;
    for (uint32_t t = 0; t < s->mesh->info.triangle_count; t++) {
        double v[3][3];

        if (!casting[t])
            continue;
        triangle_in_view(s, t, v);
        for (int p = 0; p < 12; p++)
            if (depth[p] < INFINITY) {
                const double d = depth_on(s, s->region->planes[p], v);

                depth[p] = d == -INFINITY ? INFINITY : fmax(depth[p], d);
            }
    }
    *best = 0;
    for (uint32_t p = 1; p < 12; p++)
        if (depth[p] < depth[*best])
            *best = p;
    return depth[*best];
}

/* A plane for each triangle. Returns 0 when there are too many. */
static int choose_each(gni_ends *ends, const search *s, const int8_t *casting, uint8_t *end_of)
{
    /* twice the range: beyond it a plane of the triangle's own is tried */
    const double enough = fmin(2.0 * s->region->deepest + s->region->corner_max[0][2], s->region->limit);

    memcpy(ends->planes, s->region->planes, sizeof s->region->planes);
    ends->count = 12;
    ends->deepest = -INFINITY;
    for (uint32_t t = 0; t < s->mesh->info.triangle_count; t++) {
        double v[3][3], depth = INFINITY;
        int best = 0;

        if (!casting[t])
            continue;
        triangle_in_view(s, t, v);
        for (uint32_t p = 0; p < ends->count && depth > -INFINITY; p++) {
            const double d = depth_on(s, ends->planes[p], v);

            if (d < depth) {
                depth = d;
                best = (int)p;
            }
        }
        if (depth > enough) {
            double plane[4], d;

            own_plane(s, v, plane);
            d = depth_on(s, plane, v);
            if (d < depth && ends->count < GNI_MAX_ENDS) {
                memcpy(ends->planes[ends->count], plane, sizeof plane);
                best = (int)ends->count++;
                depth = d;
            }
        }
        if (depth == INFINITY || depth > s->region->limit)
            return 0;
        end_of[t] = depth == -INFINITY ? GNI_MAX_ENDS : (uint8_t)best;
        ends->deepest = fmax(ends->deepest, depth);
    }
    return 1;
}

/* The distance from the light to a triangle of view space: to its plane, if it is hit at right angles inside, else to
 * an edge. */
static double distance_to(const double light[3], double v[3][3])
{
    double nearest = INFINITY, n[3], at[3][3], inside = 1.0, area = 0.0, height = 0.0;

    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 3; i++)
            at[k][i] = v[k][i] - light[i];
    for (int k = 0; k < 3; k++) {
        const double *a = at[k], *b = at[(k + 1) % 3];
        double along[3], t = 0.0, square = 0.0, gap = 0.0;

        for (int i = 0; i < 3; i++) {
            along[i] = b[i] - a[i];
            square += along[i] * along[i];
            t -= a[i] * along[i];
        }
        t = square > 0.0 ? fmin(fmax(t / square, 0.0), 1.0) : 0.0;
        for (int i = 0; i < 3; i++)
            gap += (a[i] + t * along[i]) * (a[i] + t * along[i]);
        nearest = fmin(nearest, sqrt(gap));
    }
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;

        n[i] = (at[1][j] - at[0][j]) * (at[2][k] - at[0][k]) - (at[1][k] - at[0][k]) * (at[2][j] - at[0][j]);
        area += n[i] * n[i];
    }
    for (int k = 0; k < 3; k++) {
        const double *a = at[k], *b = at[(k + 1) % 3];

        inside = fmin(inside, n[0] * (a[1] * b[2] - a[2] * b[1]) + n[1] * (a[2] * b[0] - a[0] * b[2]) +
                                  n[2] * (a[0] * b[1] - a[1] * b[0]));
        height += n[k] * at[0][k];
    }
    return area > 0.0 && inside > 0.0 ? fmin(nearest, fabs(height) / sqrt(area)) : nearest;
}

/* How far all vertices must be moved to lie behind what is seen, and the view distance of the farthest then. Returns
 * INFINITY when the light touches the caster. */
static double reach_depth(const search *s, const int8_t *casting, double *reach)
{
    const double *l = s->light, length = sqrt(l[0] * l[0] + l[1] * l[1] + l[2] * l[2]);
    const gni_region *r = s->region;
    double nearest = INFINITY, highest = -INFINITY, lowest = INFINITY, radius = 0.0, deepest = -INFINITY;

    for (int corner = 0; corner < 8; corner++) {
        double along = 0.0, square = 0.0;

        for (int i = 0; i < 3; i++) {
            const double c = corner >> i & 1 ? r->corner_max[0][i] : r->corner_min[0][i];

            along += c * l[i];
            square += (c - l[i]) * (c - l[i]);
        }
        lowest = fmin(lowest, along / length);
        radius = fmax(radius, sqrt(square));
    }
    for (uint32_t t = 0; t < s->mesh->info.triangle_count; t++) {
        double v[3][3];

        if (!casting[t])
            continue;
        triangle_in_view(s, t, v);
        if (l[3] != 0.0)
            nearest = fmin(nearest, distance_to(l, v));
        for (int k = 0; k < 3; k++)
            highest = fmax(highest, (v[k][0] * l[0] + v[k][1] * l[1] + v[k][2] * l[2]) / length);
    }
    *reach = l[3] != 0.0 ? SLACK * radius / nearest : highest - lowest;
    if (!(*reach < MOST_REACH))
        return INFINITY;
    if (*reach <= (l[3] != 0.0 ? 1.0 : 0.0)) /* the caster itself lies behind all that is seen */
        return -INFINITY;
    for (uint32_t t = 0; t < s->mesh->info.triangle_count; t++) {
        double v[3][3];

        if (!casting[t])
            continue;
        triangle_in_view(s, t, v);
        for (int k = 0; k < 3; k++) {
            const double far = l[3] != 0.0 ? l[2] + *reach * (v[k][2] - l[2]) : v[k][2] - *reach * l[2] / length;

            deepest = fmax(deepest, fmax(-v[k][2], -far));
        }
    }
    return deepest;
}

int gni_choose_ends(gni_ends *ends, const gni_region *region, const gn_mesh *mesh, const double model_view[16],
                    const double light[4], const int8_t *casting, uint8_t *end_of)
{
    const search s = {region, mesh, model_view, light};
    uint32_t best;
    double depth, most;

    ends->count = 0;
    ends->reach = 0.0;
    ends->deepest = -INFINITY;
    if (region->empty)
        return 1;
    most = region->is_deep ? region->limit : fmin(2.0 * region->deepest + region->corner_max[0][2], region->limit);
    depth = best_common(&s, casting, &best);
    if (depth <= most && depth < INFINITY) {
        ends->count = depth == -INFINITY ? 0 : 1; /* nothing casts: no volume */
        memcpy(ends->planes[0], region->planes[best], sizeof ends->planes[0]);
        ends->deepest = depth;
        memset(end_of, 0, mesh->info.triangle_count);
        return 1;
    }
    depth = reach_depth(&s, casting, &ends->reach);
    if (depth <= most && depth < INFINITY) {
        ends->count = depth > -INFINITY ? 1 : 0;
        ends->deepest = depth;
        memset(end_of, 0, mesh->info.triangle_count);
        return 1;
    }
    ends->reach = 0.0;
    return region->is_deep ? 0 : choose_each(ends, &s, casting, end_of);
}

void gni_extrusion_by(double out[16], const double light[4], double reach)
{
    const double length = sqrt(light[0] * light[0] + light[1] * light[1] + light[2] * light[2]);
    const int is_sun = light[3] == 0.0;

    for (int i = 0; i < 16; i++)
        out[i] = i % 5 == 0 ? 1.0 : 0.0;
    for (int i = 0; i < 3; i++) {
        out[5 * i] = is_sun ? 1.0 : reach;
        out[12 + i] = is_sun ? -reach * light[i] / length : (1.0 - reach) * light[i] / light[3];
    }
}
