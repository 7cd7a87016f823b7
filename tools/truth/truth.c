/* truth.c - the right mask: rays in double precision from the eye, and from where they end to the light.
 *
 * Rays go through a grid of (2 width + 1) x (2 height + 1) samples, half a pixel apart, so that neighbours share the
 * eight samples around their centres. A pixel's centre gives the mask; truth_class.c judges how sure it is. */
#include "truth.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "truth_pass.h"
#include "truth_vec.h"

#define SIZE_MOST   8192u /* the samples' arrays then stay below 2^31 bytes each */
#define SEGMENT_END 1e-9  /* the open segment to the light leaves out this part of itself at both ends */
#define EDGE_ON     1e-13 /* cosine to the light below which a face is edge-on: the rounding of its normal */

static int fail(char message[SCENE_MESSAGE], const char *format, ...)
{
    va_list args;

    va_start(args, format);
    vsnprintf(message, SCENE_MESSAGE, format, args);
    va_end(args);
    return 0;
}

void truth_view_ray(const truth *t, double x, double y, double from[3], double along[3])
{
    const double sx = (2.0 * x / t->width - 1.0) * t->half[0], sy = (1.0 - 2.0 * y / t->height) * t->half[1];
    double across[3];

    for (int k = 0; k < 3; k++)
        across[k] = sx * t->axes[0][k] + sy * t->axes[1][k];
    for (int k = 0; k < 3; k++) {
        from[k] = t->scene->camera.orthographic ? across[k] : 0.0;
        along[k] = t->axes[2][k] + (t->scene->camera.orthographic ? 0.0 : across[k]);
    }
}

uint32_t truth_see(const truth *t, double x, double y, uint32_t hint, double *depth)
{
    double from[3], along[3];
    truth_ray ray;

    truth_view_ray(t, x, y, from, along);
    truth_ray_set(&ray, from, along);
    return truth_rays_seen(&t->rays, &ray, t->nearest, t->farthest, TRUTH_NOTHING, hint, depth);
}

void truth_point_set(truth_point *p, const truth *t, double x, double y, uint32_t triangle, double depth)
{
    p->triangle = triangle;
    p->depth = depth;
    truth_view_ray(t, x, y, p->from, p->along);
    truth_along(p->at, p->from, depth, p->along);
}

/* With the far plane at infinity the buffer holds 1 - near / depth; an orthographic one is linear. */
double truth_stepped(const truth *t, double depth, double count)
{
    const double near = t->scene->camera.znear;
    double left;

    if (t->scene->camera.orthographic)
        return depth + count * t->ortho_range / t->steps;
    left = near / depth - count / t->steps;
    return left > 0.0 ? fmin(near / left, 1e9 * depth) : 1e9 * depth;
}

/* ------------------------------------------------------------------ what the eye sees */

static int any_within(const truth *t, const truth_ray *ray, double least, double most, uint32_t skip)
{
    uint32_t found;
    double depth;

    return truth_rays_within(&t->rays, ray, least, most, skip, &found, &depth, 1) > 0;
}

/* Finds the remarks for the pixel x, y. */
static uint8_t look_around(const truth *t, uint32_t x, uint32_t y)
{
    const double cx = x + 0.5, cy = y + 0.5;
    const size_t centre = (2 * (size_t)y + 1) * t->columns + 2 * (size_t)x + 1;
    const uint32_t seen = t->seen[centre];
    const double depth = t->depth[centre], zfar = t->scene->camera.zfar;
    double from[3], along[3], d;
    truth_ray ray;
    uint8_t remarks = 0;

    for (int j = -1; j <= 1; j++)
        for (int i = -1; i <= 1; i++) {
            const uint32_t other = i || j ? truth_see(t, cx + i * TRUTH_SNAP, cy + j * TRUTH_SNAP, seen, &d) : seen;

            if ((other == TRUTH_NOTHING) != (seen == TRUTH_NOTHING))
                remarks |= TRUTH_SNAP_VISIBLE;
            else if (other != seen)
                remarks |= TRUTH_SNAP_TRIANGLE;
        }

    truth_view_ray(t, cx, cy, from, along);
    truth_ray_set(&ray, from, along);
    if (any_within(t, &ray, truth_stepped(t, t->nearest, -2), truth_stepped(t, t->nearest, 2), TRUTH_NOTHING))
        remarks |= TRUTH_CUT_NEAR_BY;
    if (seen != TRUTH_NOTHING) {
        if (zfar > 0.0 && depth >= truth_stepped(t, zfar, -2))
            remarks |= TRUTH_CUT_NEAR_BY;
        if (any_within(t, &ray, depth * (1.0 - 1e-9), fmin(truth_stepped(t, depth, 2), t->farthest), seen))
            remarks |= TRUTH_BEHIND;
    } else if (zfar > 0.0 && any_within(t, &ray, zfar, truth_stepped(t, zfar, 2), TRUTH_NOTHING)) {
        remarks |= TRUTH_CUT_NEAR_BY;
    }
    return remarks;
}

static int set_view(truth *t, const truth_options *options, char message[SCENE_MESSAGE])
{
    const scene_camera *camera = &t->scene->camera;
    const double *m = camera->world;

    if (!t->scene->has_camera)
        return fail(message, "truth: the scene has no camera");
    if (options->width < 1 || options->width > SIZE_MOST || options->height < 1 || options->height > SIZE_MOST)
        return fail(message, "truth: the size is out of range, 1 to %u each (%ux%u)", SIZE_MOST, options->width,
                    options->height);
    if (options->depth_bits < 8 || options->depth_bits > 32)
        return fail(message, "truth: the depth format is out of range, 8 to 32 bits (%d)", options->depth_bits);
    if (!(camera->znear >= 0.0) || (!camera->orthographic && camera->znear <= 0.0))
        return fail(message, "truth: the camera's znear is out of range (%g)", camera->znear);
    t->width = options->width;
    t->height = options->height;
    t->columns = 2 * (size_t)t->width + 1;
    t->rows = 2 * (size_t)t->height + 1;
    t->steps = ldexp(1.0, options->depth_bits) - 1.0;
    t->nearest = camera->znear;
    t->farthest = camera->zfar > 0.0 ? camera->zfar : HUGE_VAL;
    for (int k = 0; k < 3; k++) {
        t->axes[0][k] = m[k];
        t->axes[1][k] = m[4 + k];
        t->axes[2][k] = -m[8 + k]; /* a camera looks along its negative z */
        t->eye[k] = m[12 + k];
    }
    if (camera->orthographic) {
        t->half[0] = camera->xmag;
        t->half[1] = camera->ymag;
    } else {
        t->half[1] = tan(0.5 * camera->yfov);
        t->half[0] = t->half[1] * t->width / t->height;
    }
    return 1;
}

/* The range of depths of an orthographic depth buffer. */
static double ortho_range(const truth *t, const truth_options *options)
{
    const double given = options->ortho_depth[1] - options->ortho_depth[0];
    double behind = t->nearest;

    if (given > 0.0)
        return given;
    if (t->scene->camera.zfar > 0.0)
        return t->scene->camera.zfar - t->nearest;
    for (size_t i = 0; i < t->rays.count; i++)
        for (int c = 0; c < 3; c++)
            behind = fmax(behind, truth_dot(t->rays.triangles[i].v[c], t->axes[2]));
    return behind - t->nearest;
}

truth *truth_create(const scene *s, const truth_options *options, char message[SCENE_MESSAGE])
{
    truth *t = calloc(1, sizeof *t);

    if (!t) {
        fail(message, "truth: out of memory");
        return NULL;
    }
    t->scene = s;
    if (!set_view(t, options, message)) {
        free(t);
        return NULL;
    }
    t->seen = malloc(t->rows * t->columns * sizeof *t->seen);
    t->depth = malloc(t->rows * t->columns * sizeof *t->depth);
    t->remarks = malloc((size_t)t->width * t->height);
    if (!t->seen || !t->depth || !t->remarks || !truth_rays_build(&t->rays, s, t->eye) ||
        !truth_edges_build(&t->edges, &t->rays)) {
        fail(message, "truth: out of memory (%ux%u)", t->width, t->height);
        truth_free(t);
        return NULL;
    }
    t->ortho_range = ortho_range(t, options);
    for (size_t j = 0; j < t->rows; j++) {
        uint32_t hint = TRUTH_NOTHING;

        for (size_t i = 0; i < t->columns; i++) {
            const size_t n = j * t->columns + i;

            t->depth[n] = HUGE_VAL;
            hint = t->seen[n] = truth_see(t, 0.5 * (double)i, 0.5 * (double)j, hint, &t->depth[n]);
        }
    }
    for (uint32_t y = 0; y < t->height; y++)
        for (uint32_t x = 0; x < t->width; x++)
            t->remarks[(size_t)y * t->width + x] = look_around(t, x, y);
    return t;
}

void truth_free(truth *t)
{
    if (!t)
        return;
    truth_edges_free(&t->edges);
    truth_rays_free(&t->rays);
    free(t->seen);
    free(t->depth);
    free(t->remarks);
    free(t);
}

/* ------------------------------------------------------------------ what the light sees */

void truth_to_light(const truth_pass *p, const double at[3], double out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = p->lamp.directional ? p->lamp.at[k] * p->t->rays.extent : p->lamp.at[k] - at[k];
}

int truth_in_shadow(truth_pass *p, const double at[3], uint32_t seen, const truth_pardon *pardon)
{
    const double most = p->lamp.directional ? HUGE_VAL : 1.0 - SEGMENT_END;
    double along[3], least;
    truth_ray ray;

    truth_to_light(p, at, along);
    /* what is left out is there for the point's rounding, so that a far light does not widen it */
    least = SEGMENT_END * fmin(1.0, (truth_length(at) + 0.01 * p->t->rays.extent) / truth_length(along));
    truth_ray_set(&ray, at, along);
    return truth_rays_blocked(&p->t->rays, &ray, least, most, seen, pardon, &p->last);
}

double truth_facing(const truth_pass *p, const truth_point *at)
{
    const truth_triangle *f = &p->t->rays.triangles[at->triangle];
    double n[3], up[3], cosine;

    truth_normal(n, f);
    truth_to_light(p, f->v[0], up);
    cosine = truth_dot(n, up) / truth_length(n);
    if (fabs(cosine) <= EDGE_ON * truth_length(up))
        return 0.0;
    truth_to_light(p, at->at, up);
    cosine /= truth_length(up);
    return truth_dot(n, at->along) < 0.0 ? cosine : -cosine;
}

int truth_is_lit(truth_pass *p, const truth_point *at)
{
    if (!(truth_facing(p, at) > 0.0))
        return 0;
    return !(p->t->rays.triangles[at->triangle].flags & TRUTH_RECEIVES) ||
           !truth_in_shadow(p, at->at, at->triangle, NULL);
}

int truth_light(truth *t, size_t light, uint8_t *lit, uint8_t *visible, uint8_t *classes, char message[SCENE_MESSAGE])
{
    const scene_light *from;
    truth_pass p = {t, {0, {0}}, {NULL, 0, {NULL, NULL, 0}, {0, {0}}}, TRUTH_NOTHING, NULL};

    if (light >= t->scene->light_count)
        return fail(message, "truth: no such light (%lu of %lu)", (unsigned long)light,
                    (unsigned long)t->scene->light_count);
    from = &t->scene->lights[light];
    p.lamp.directional = from->kind == SCENE_DIRECTIONAL;
    if (p.lamp.directional)
        memcpy(p.lamp.at, from->towards, sizeof p.lamp.at);
    else
        truth_sub(p.lamp.at, from->position, t->eye);
    p.lit = malloc(t->rows * t->columns);
    if (!p.lit || !truth_silhouette_build(&p.silhouette, &t->edges, &p.lamp)) {
        free(p.lit);
        return fail(message, "truth: out of memory (light %lu)", (unsigned long)light);
    }
    for (size_t j = 0; j < t->rows; j++)
        for (size_t i = 0; i < t->columns; i++) {
            const size_t n = j * t->columns + i;
            truth_point at;

            p.lit[n] = 0;
            if (t->seen[n] == TRUTH_NOTHING)
                continue;
            truth_point_set(&at, t, 0.5 * (double)i, 0.5 * (double)j, t->seen[n], t->depth[n]);
            p.lit[n] = (uint8_t)truth_is_lit(&p, &at);
        }
    for (uint32_t y = 0; y < t->height; y++)
        for (uint32_t x = 0; x < t->width; x++) {
            const size_t pixel = (size_t)y * t->width + x;
            const size_t centre = (2 * (size_t)y + 1) * t->columns + 2 * (size_t)x + 1;

            visible[pixel] = t->seen[centre] == TRUTH_NOTHING ? 0 : 255;
            lit[pixel] = p.lit[centre] ? 255 : 0;
            classes[pixel] = (uint8_t)truth_classify(&p, x, y);
        }
    truth_silhouette_free(&p.silhouette);
    free(p.lit);
    return 1;
}
