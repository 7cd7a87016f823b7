/* scene_pose.c - a scene at a time of its animation: keys to nodes, nodes to the world, the world's bounds.
 *
 * Every channel writes its node's value at every pose, so no rest pose needs keeping, and poses may be asked for in any
 * order. Nodes are composed in the order of the scene's walk, in which parents come first. */
#include "gltf.h"

#include "gn_matrix.h"

#include <math.h>
#include <string.h>

/* Above this cosine (1.4e-5 radians) the sine in slerp's divisor goes to 0, and the arc is straight to the last bit. */
#define SLERP_COSINE_MAX (1.0 - 1e-10)

/* Returns 0, and leaves v alone, when it has no direction. */
static int normalize(double *v, int count)
{
    double sum = 0.0, length;

    for (int i = 0; i < count; i++)
        sum += v[i] * v[i];
    length = sqrt(sum);
    if (!(length > 1e-150) || !isfinite(length))
        return 0;
    for (int i = 0; i < count; i++)
        v[i] /= length;
    return 1;
}

/* The last key at or before the time, which lies within the keys. */
static size_t find_key(const scene_channel *c, double seconds)
{
    size_t low = 0, high = c->count - 1;

    while (low < high) {
        const size_t middle = high - (high - low) / 2;

        if (c->times[middle] <= seconds)
            low = middle;
        else
            high = middle - 1;
    }
    return low;
}

static void copy_key(const scene_channel *c, size_t key, int width, double *out)
{
    const size_t parts = c->steps == SCENE_CUBIC ? 3 : 1;
    const float *value = c->values + (key * parts + parts / 2) * (size_t)width;

    for (int i = 0; i < width; i++)
        out[i] = value[i];
}

/* Along the great circle, the shorter way round (glTF 2.0, appendix C.4; Shoemake 1985). */
static void slerp(const double a[4], const double b[4], double t, double out[4])
{
    double cosine = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3], sign = 1.0, wa = 1.0 - t, wb = t;

    if (cosine < 0.0) {
        cosine = -cosine;
        sign = -1.0;
    }
    if (cosine < SLERP_COSINE_MAX) {
        const double angle = acos(cosine), sine = sin(angle);

        wa = sin(wa * angle) / sine;
        wb = sin(wb * angle) / sine;
    }
    for (int i = 0; i < 4; i++)
        out[i] = wa * a[i] + sign * wb * b[i];
}

/* Cubic Hermite spline; tangents are per second (glTF 2.0, appendix C.5). */
static void cubic(const float *key, int width, double t, double seconds, double *out)
{
    const double t2 = t * t, t3 = t2 * t;
    const float *value = key + width, *tangent = key + 2 * width;
    const float *next_tangent = key + 3 * width, *next_value = key + 4 * width;

    for (int i = 0; i < width; i++)
        out[i] = (2 * t3 - 3 * t2 + 1) * value[i] + seconds * (t3 - 2 * t2 + t) * tangent[i] +
                 (3 * t2 - 2 * t3) * next_value[i] + seconds * (t3 - t2) * next_tangent[i];
}

void scene_sample(const scene_channel *c, double seconds, double out[4])
{
    const int width = c->path == SCENE_ROTATION ? 4 : 3;
    const size_t last = c->count - 1;
    size_t key;
    double t, span, next[4];

    if (!(seconds > c->times[0])) /* and NaN */
        key = 0;
    else
        key = seconds >= c->times[last] ? last : find_key(c, seconds);
    copy_key(c, key, width, out);
    if (width == 4)
        normalize(out, 4);
    if (c->steps == SCENE_STEP || key == last || !(seconds > c->times[key]))
        return;
    span = (double)c->times[key + 1] - c->times[key]; /* not 0: the time lies strictly between */
    t = (seconds - c->times[key]) / span;
    if (c->steps == SCENE_CUBIC) {
        cubic(c->values + key * 3 * (size_t)width, width, t, span, next);
        /* a spline may pass through no rotation at all: hold the key there */
        if (width == 3 || normalize(next, 4))
            memcpy(out, next, (size_t)width * sizeof *out);
        return;
    }
    copy_key(c, key + 1, width, next);
    if (width == 3) {
        for (int i = 0; i < 3; i++)
            out[i] = (1.0 - t) * out[i] + t * next[i];
        return;
    }
    normalize(next, 4);
    slerp(out, next, t, out);
    normalize(out, 4);
}

static void animate(scene *s, double seconds)
{
    for (size_t i = 0; s->animation && i < s->animation->count; i++) {
        const scene_channel *c = &s->animation->channels[i];
        scene_node *n = &s->nodes[c->node];
        double value[4];

        scene_sample(c, seconds, value);
        if (c->path == SCENE_ROTATION)
            memcpy(n->rotation, value, sizeof n->rotation);
        else
            memcpy(c->path == SCENE_SCALE ? n->scale : n->translation, value, sizeof n->scale);
    }
}

static void place_nodes(scene *s)
{
    for (size_t k = 0; k < s->node_count && s->nodes[k].order != SCENE_NONE; k++) {
        scene_node *n = &s->nodes[s->nodes[k].order];

        if (!n->has_matrix)
            gn_mat4_from_trs(n->local, n->translation, n->rotation, n->scale);
        if (n->parent == SCENE_NONE)
            memcpy(n->world, n->local, sizeof n->world);
        else
            gn_mat4_multiply(n->world, s->nodes[n->parent].world, n->local);
    }
}

/* A camera's matrix is its node's without scale and shear: its view is along -Z, its up in the plane of Y and Z. */
static void place_camera(scene_camera *c, const scene_node *n)
{
    double z[3] = {n->world[8], n->world[9], n->world[10]};
    double y[3] = {n->world[4], n->world[5], n->world[6]};
    double x[3];

    /* lengths may be anything, products of them need not fit */
    if (!normalize(z, 3) || !normalize(y, 3)) {
        z[0] = z[1] = 0.0;
        z[2] = 1.0;
        y[0] = y[2] = 0.0;
        y[1] = 1.0;
    }
    for (int attempt = 0;; attempt++) {
        for (int i = 0; i < 3; i++)
            x[i] = y[(i + 1) % 3] * z[(i + 2) % 3] - y[(i + 2) % 3] * z[(i + 1) % 3];
        if (normalize(x, 3))
            break;
        /* flattened to a line: of the axes X and Y one at least is not z */
        y[0] = attempt ? 1.0 : 0.0;
        y[1] = attempt ? 0.0 : 1.0;
        y[2] = 0.0;
    }
    for (int i = 0; i < 3; i++) {
        c->world[i] = x[i];
        c->world[4 + i] = z[(i + 1) % 3] * x[(i + 2) % 3] - z[(i + 2) % 3] * x[(i + 1) % 3];
        c->world[8 + i] = z[i];
        c->world[12 + i] = n->world[12 + i];
        c->world[4 * i + 3] = 0.0;
    }
    c->world[15] = 1.0;
}

static void place_light(scene_light *l, const scene_node *n)
{
    memcpy(l->towards, n->world + 8, sizeof l->towards);
    if (!normalize(l->towards, 3)) {
        l->towards[0] = l->towards[1] = 0.0;
        l->towards[2] = 1.0;
    }
    for (int i = 0; i < 3; i++)
        l->position[i] = l->kind == SCENE_DIRECTIONAL ? 0.0 : n->world[12 + i];
}

/* The box of the transformed corners of each mesh's box: it holds the mesh, if not as tightly as could be. */
static void find_bounds(scene *s)
{
    int empty = 1;

    for (int axis = 0; axis < 3; axis++)
        s->bounds_min[axis] = s->bounds_max[axis] = 0.0;
    for (size_t i = 0; i < s->instance_count; i++)
        for (int corner = 0; corner < 8 && s->instances[i].node != SCENE_NONE; corner++) {
            const scene_node *n = &s->nodes[s->instances[i].node];
            const double local[3] = {n->box[corner & 1][0], n->box[corner >> 1 & 1][1], n->box[corner >> 2][2]};
            double world[3];

            gn_mat4_transform(world, n->world, local, 1.0);
            for (int axis = 0; axis < 3; axis++) {
                if (empty || world[axis] < s->bounds_min[axis])
                    s->bounds_min[axis] = world[axis];
                if (empty || world[axis] > s->bounds_max[axis])
                    s->bounds_max[axis] = world[axis];
            }
            empty = 0;
        }
}

void scene_pose(scene *s, double seconds)
{
    animate(s, seconds);
    place_nodes(s);
    for (size_t i = 0; i < s->instance_count; i++)
        if (s->instances[i].node != SCENE_NONE)
            memcpy(s->instances[i].world, s->nodes[s->instances[i].node].world, sizeof s->instances[i].world);
    for (size_t i = 0; i < s->light_count; i++)
        if (s->lights[i].node != SCENE_NONE)
            place_light(&s->lights[i], &s->nodes[s->lights[i].node]);
    if (s->has_camera && s->camera.node != SCENE_NONE)
        place_camera(&s->camera, &s->nodes[s->camera.node]);
    find_bounds(s);
}
