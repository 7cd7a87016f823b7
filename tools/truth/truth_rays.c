/* truth_rays.c - rays against triangles in double precision, without cracks.
 *
 * Pixel centres fall exactly onto shared edges as a matter of course (the diagonal of a square seen from above), and a
 * ray that slips between two triangles is a wrong pixel. Woop's test shears the ray onto the z axis and takes three
 * edge functions of the sheared vertices. An edge's function depends on its two ends alone, and in double (with no
 * fused multiply-add) swapping the ends negates it exactly, so that of two triangles that share an edge at least one is
 * met: zero counts as inside.
 *
 * Woop, Benthin, Wald. Watertight Ray/Triangle Intersection. Journal of Computer Graphics Techniques 2(1), 2013. */
#include "truth_rays.h"

#include <stdlib.h>
#include <string.h>

#include "gn_matrix.h"
#include "truth_vec.h"

/* Farther than this, a coordinate is taken for damage: floats hold the boxes. */
#define FARTHEST 1e30

void truth_normal(double out[3], const truth_triangle *f)
{
    double a[3], b[3];

    truth_sub(a, f->v[1], f->v[0]);
    truth_sub(b, f->v[2], f->v[0]);
    truth_cross(out, a, b);
}

/* A triangle has no area when what its normal has is the rounding of its vertices. */
static int has_area(const truth_triangle *f)
{
    double n[3], longest = 0.0, reach = 0.0;

    truth_normal(n, f);
    for (int i = 0; i < 3; i++) {
        double e[3];

        truth_sub(e, f->v[(i + 1) % 3], f->v[i]);
        longest = fmax(longest, truth_length(e));
        for (int k = 0; k < 3; k++) {
            if (!(fabs(f->v[i][k]) < FARTHEST))
                return 0;
            reach = fmax(reach, fabs(f->v[i][k]));
        }
    }
    return truth_length(n) > 4e-16 * reach * longest;
}

static uint32_t flags_of(const scene_instance *of, const scene_material *m)
{
    return (of->casts ? TRUTH_CASTS : 0u) | (of->receives ? TRUTH_RECEIVES : 0u) |
           (m->double_sided ? 0u : TRUTH_ONE_SIDED) | (m->alpha == SCENE_MASK ? TRUTH_CUT : 0u) |
           (gn_mat4_determinant3(of->world) < 0.0 ? TRUTH_MIRRORED : 0u);
}

static void gather(truth_rays *out, const scene *s, size_t instance, const double eye[3])
{
    const scene_instance *of = &s->instances[instance];
    const scene_mesh *mesh = &s->meshes[of->mesh];
    double to_eye[16];

    memcpy(to_eye, of->world, sizeof to_eye);
    for (int k = 0; k < 3; k++)
        to_eye[12 + k] -= eye[k];
    for (size_t r = 0; r < mesh->range_count; r++) {
        const scene_range *range = &mesh->ranges[r];
        const scene_material *m = &s->materials[range->material];

        if (m->alpha == SCENE_BLEND)
            continue;
        for (uint32_t i = range->first_triangle; i - range->first_triangle < range->triangle_count; i++) {
            truth_triangle *f = &out->triangles[out->count];

            f->instance = (uint32_t)instance;
            f->index = i;
            f->material = range->material;
            f->flags = flags_of(of, m);
            for (int c = 0; c < 3; c++) {
                const float *p = &mesh->positions[3 * (size_t)mesh->indices[3 * (size_t)i + (size_t)c]];
                const double v[3] = {p[0], p[1], p[2]};

                gn_mat4_transform(f->v[c], to_eye, v, 1.0);
                for (int k = 0; k < 3; k++)
                    f->v[c][k] += 0.0; /* -0 becomes 0: vertices are welded by their bits */
            }
            if (has_area(f))
                out->count++;
        }
    }
}

static void triangle_box(double box[6], const truth_triangle *f)
{
    for (int k = 0; k < 3; k++) {
        box[k] = fmin(f->v[0][k], fmin(f->v[1][k], f->v[2][k]));
        box[3 + k] = fmax(f->v[0][k], fmax(f->v[1][k], f->v[2][k]));
    }
}

int truth_rays_build(truth_rays *out, const scene *s, const double eye[3])
{
    double(*boxes)[6];
    truth_triangle *sorted;
    size_t room = 0;

    memset(out, 0, sizeof *out);
    out->scene = s;
    out->extent = 1.0;
    for (size_t i = 0; i < s->instance_count; i++)
        room += s->meshes[s->instances[i].mesh].triangle_count;
    if (room == 0)
        return 1;
    if (room > SIZE_MAX / (3 * sizeof *out->triangles))
        return 0;
    out->triangles = malloc(room * sizeof *out->triangles);
    boxes = malloc(room * sizeof *boxes);
    sorted = malloc(room * sizeof *sorted);
    if (!out->triangles || !boxes || !sorted)
        goto failed;
    for (size_t i = 0; i < s->instance_count; i++)
        gather(out, s, i, eye);
    for (size_t i = 0; i < out->count; i++)
        triangle_box(boxes[i], &out->triangles[i]);
    if (!truth_bvh_build(&out->bvh, (const double(*)[6])boxes, out->count))
        goto failed;
    for (size_t i = 0; i < out->count; i++)
        sorted[i] = out->triangles[out->bvh.order[i]];
    free(out->triangles);
    free(boxes);
    out->triangles = sorted;
    if (out->count > 0) {
        const truth_bvh_node *root = &out->bvh.nodes[0];
        const double d[3] = {(double)root->box[1][0] - (double)root->box[0][0],
                             (double)root->box[1][1] - (double)root->box[0][1],
                             (double)root->box[1][2] - (double)root->box[0][2]};

        out->extent = truth_length(d);
    }
    return 1;

failed:
    free(boxes);
    free(sorted);
    truth_rays_free(out);
    return 0;
}

void truth_rays_free(truth_rays *r)
{
    free(r->triangles);
    truth_bvh_free(&r->bvh);
    memset(r, 0, sizeof *r);
}

void truth_ray_set(truth_ray *ray, const double from[3], const double along[3])
{
    int z = 0;

    for (int k = 0; k < 3; k++) {
        ray->from[k] = from[k];
        ray->along[k] = along[k];
        /* not infinite: 0 times infinity would be no number where the ray starts in a box's face */
        ray->inverse[k] = fabs(along[k]) > 1e-280 ? 1.0 / along[k] : 1e280;
        if (fabs(along[k]) > fabs(along[z]))
            z = k;
    }
    ray->axis[0] = (z + 1) % 3;
    ray->axis[1] = (z + 2) % 3;
    ray->axis[2] = z;
    ray->shear[0] = along[ray->axis[0]] * ray->inverse[z];
    ray->shear[1] = along[ray->axis[1]] * ray->inverse[z];
    ray->shear[2] = ray->inverse[z];
}

/* Returns 1 with t, and weights of the three vertices (not yet divided by their sum), where the line meets it. */
static int meets(const truth_triangle *f, const truth_ray *ray, double *t, double weights[3])
{
    const int kx = ray->axis[0], ky = ray->axis[1], kz = ray->axis[2];
    double x[3], y[3], z[3], u, v, w, sum;

    for (int i = 0; i < 3; i++) {
        z[i] = f->v[i][kz] - ray->from[kz];
        x[i] = f->v[i][kx] - ray->from[kx] - ray->shear[0] * z[i];
        y[i] = f->v[i][ky] - ray->from[ky] - ray->shear[1] * z[i];
    }
    u = x[2] * y[1] - y[2] * x[1];
    v = x[0] * y[2] - y[0] * x[2];
    w = x[1] * y[0] - y[1] * x[0];
    if ((u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0))
        return 0;
    sum = u + v + w;
    if (sum == 0.0) /* seen edge-on */
        return 0;
    *t = (u * z[0] + v * z[1] + w * z[2]) / sum * ray->shear[2];
    weights[0] = u;
    weights[1] = v;
    weights[2] = w;
    return 1;
}

static int is_cut(const truth_rays *r, const truth_triangle *f, const double weights[3])
{
    const scene_mesh *mesh = &r->scene->meshes[r->scene->instances[f->instance].mesh];
    const double sum = weights[0] + weights[1] + weights[2];
    double uv[2] = {0.0, 0.0}, alpha = 0.0;

    for (int c = 0; c < 3; c++) {
        const size_t vertex = mesh->indices[3 * (size_t)f->index + (size_t)c];
        const double share = weights[c] / sum;

        uv[0] += share * (double)mesh->uvs[2 * vertex];
        uv[1] += share * (double)mesh->uvs[2 * vertex + 1];
        alpha += share * (double)mesh->colors[4 * vertex + 3];
    }
    return scene_alpha_at(r->scene, f->material, uv, alpha) < r->scene->materials[f->material].alpha_cutoff;
}

static int is_seen(const truth_rays *r, uint32_t index, const truth_ray *ray, double least, double most, double *t)
{
    const truth_triangle *f = &r->triangles[index];
    double weights[3], at;

    if (!meets(f, ray, &at, weights) || !(at >= least && at <= most))
        return 0;
    if (f->flags & TRUTH_ONE_SIDED) {
        double n[3], towards;

        truth_normal(n, f);
        towards = truth_dot(n, ray->along);
        if (f->flags & TRUTH_MIRRORED ? towards <= 0.0 : towards >= 0.0)
            return 0;
    }
    if ((f->flags & TRUTH_CUT) && is_cut(r, f, weights))
        return 0;
    *t = at;
    return 1;
}

/* Where a ray enters a node's box, or HUGE_VAL if it misses it within [least, most]. */
static inline double entry(const truth_bvh_node *n, const truth_ray *ray, const int from_high[3], double least,
                           double most)
{
    for (int k = 0; k < 3; k++) {
        const double near = ((double)n->box[from_high[k]][k] - ray->from[k]) * ray->inverse[k];
        const double far = ((double)n->box[1 - from_high[k]][k] - ray->from[k]) * ray->inverse[k];

        least = near > least ? near : least;
        most = far < most ? far : most;
    }
    return least <= most ? least : HUGE_VAL;
}

uint32_t truth_rays_seen(const truth_rays *r, const truth_ray *ray, double least, double most, uint32_t skip,
                         uint32_t hint, double *t)
{
    const int from_high[3] = {ray->inverse[0] < 0.0, ray->inverse[1] < 0.0, ray->inverse[2] < 0.0};
    struct {
        uint32_t node;
        double entry;
    } stack[TRUTH_BVH_STACK];
    uint32_t found = TRUTH_NOTHING, node = 0;
    int top = 0;

    if (r->count == 0)
        return TRUTH_NOTHING;
    if (hint != TRUTH_NOTHING && hint != skip && is_seen(r, hint, ray, least, most, t)) {
        found = hint;
        most = *t;
    }
    if (entry(&r->bvh.nodes[0], ray, from_high, least, most) == HUGE_VAL)
        return found;
    for (;;) {
        const truth_bvh_node *n = &r->bvh.nodes[node];

        if (n->count == 0) {
            const double a = entry(&r->bvh.nodes[n->first], ray, from_high, least, most);
            const double b = entry(&r->bvh.nodes[n->first + 1], ray, from_high, least, most);
            const uint32_t second = b < a ? 0 : 1; /* the farther child waits */

            if (a != HUGE_VAL || b != HUGE_VAL) {
                if (a != HUGE_VAL && b != HUGE_VAL) {
                    stack[top].node = n->first + second;
                    stack[top++].entry = second == 0 ? a : b;
                }
                node = n->first + 1 - second;
                continue;
            }
        }
        for (uint32_t i = n->first; i - n->first < n->count; i++)
            if (i != skip && i != found && is_seen(r, i, ray, least, most, t)) {
                found = i;
                most = *t;
            }
        do {
            if (top == 0) {
                *t = most;
                return found;
            }
            top--;
        } while (stack[top].entry > most);
        node = stack[top].node;
    }
}

size_t truth_rays_within(const truth_rays *r, const truth_ray *ray, double least, double most, uint32_t skip,
                         uint32_t *found, double *t, size_t room)
{
    const int from_high[3] = {ray->inverse[0] < 0.0, ray->inverse[1] < 0.0, ray->inverse[2] < 0.0};
    uint32_t stack[TRUTH_BVH_STACK];
    size_t count = 0;
    int top = 0;

    if (r->count > 0)
        stack[top++] = 0;
    while (top > 0 && count < room) {
        const truth_bvh_node *n = &r->bvh.nodes[stack[--top]];

        if (entry(n, ray, from_high, least, most) == HUGE_VAL)
            continue;
        if (n->count == 0) {
            stack[top++] = n->first + 1;
            stack[top++] = n->first;
            continue;
        }
        for (uint32_t i = n->first; i - n->first < n->count && count < room; i++)
            if (i != skip && is_seen(r, i, ray, least, most, &t[count]))
                found[count++] = i;
    }
    return count;
}

static int shares_vertex(const truth_triangle *a, const truth_triangle *b)
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            if (a->v[i][0] == b->v[j][0] && a->v[i][1] == b->v[j][1] && a->v[i][2] == b->v[j][2])
                return 1;
    return 0;
}

static int is_pardoned(const truth_rays *r, uint32_t index, const truth_pardon *pardon, double t)
{
    const truth_triangle *f = &r->triangles[index];
    double n[3], to[3];

    truth_normal(n, f);
    truth_sub(to, pardon->seen_at, f->v[0]);
    if (fabs(truth_dot(n, to)) <= 1e-9 * truth_length(n) * (truth_length(to) + truth_length(pardon->seen_at)))
        return 1;
    return t <= pardon->reach && shares_vertex(f, &r->triangles[pardon->seen]);
}

static int blocks(const truth_rays *r, uint32_t index, const truth_ray *ray, double least, double most, uint32_t skip,
                  const truth_pardon *pardon)
{
    double t, weights[3];

    return index != skip && (r->triangles[index].flags & TRUTH_CASTS) &&
           meets(&r->triangles[index], ray, &t, weights) && t > least && t < most &&
           !(pardon && is_pardoned(r, index, pardon, t));
}

int truth_rays_blocked(const truth_rays *r, const truth_ray *ray, double least, double most, uint32_t skip,
                       const truth_pardon *pardon, uint32_t *last)
{
    const int from_high[3] = {ray->inverse[0] < 0.0, ray->inverse[1] < 0.0, ray->inverse[2] < 0.0};
    uint32_t stack[TRUTH_BVH_STACK];
    int top = 0;

    if (r->count == 0)
        return 0;
    if (*last != TRUTH_NOTHING && blocks(r, *last, ray, least, most, skip, pardon))
        return 1;
    stack[top++] = 0;
    while (top > 0) {
        const truth_bvh_node *n = &r->bvh.nodes[stack[--top]];

        if (entry(n, ray, from_high, least, most) == HUGE_VAL)
            continue;
        if (n->count == 0) {
            stack[top++] = n->first + 1;
            stack[top++] = n->first;
            continue;
        }
        for (uint32_t i = n->first; i - n->first < n->count; i++)
            if (blocks(r, i, ray, least, most, skip, pardon)) {
                *last = i;
                return 1;
            }
    }
    return 0;
}
