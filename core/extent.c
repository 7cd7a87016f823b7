/* extent.c - how far a caster's volume goes, and where on the image it matters.
 *
 * What a volume may shadow is known before it is drawn: the things that receive, are seen and lit, and are not surely
 * outside it (receivers.c). So it ends on a plane right behind the last of them, and only pixels are counted that lie
 * in the image of one of them and in the volume's own (CC shadow volumes of Lloyd et al. 2004 do this with tighter and
 * dearer bounds).
 *
 * Such an end is exact under these conditions (DESIGN.md, decision 6): the caster lies strictly between the plane and
 * its parallel through the light, so that each ray from the light through it reaches the plane behind all that it could
 * shadow; and the plane lies behind them by more than depth can confuse: several steps of depth at the farthest of
 * them, seen as flat as the eye sees the plane. Four directions are tried for its normal, from the caster's middle to
 * the light and the world's three axes (a floor under a lamp ends right below itself), and the end taken that is
 * nearest. Nothing farther than the light's reach is lit: no end needs to be. */
#include "gni_plan.h"

#include <math.h>
#include <string.h>

#define STEPS     8.0    /* of depth behind the last receiver; four are needed */
#define PIXELS    0.25   /* between a receiver and where a volume ends or starts */
#define MOST      1024.0 /* times its distance from the light may a vertex be moved: more loses its direction in floats */
#define WORTH     (1.0 / 128.0) /* of the target's pixels must a scissor cut off: changing it is not free everywhere */
#define LEAST_SUN 0.02          /* sine of the angle at which a directional light's rays may meet the end */

void gni_join_rectangles(uint32_t a[4], const uint32_t b[4])
{
    if (a[2] == 0 || a[3] == 0) {
        memcpy(a, b, 4 * sizeof *a);
        return;
    }
    for (int i = 0; i < 2 && b[2] > 0 && b[3] > 0; i++) {
        const uint32_t end = a[i] + a[2 + i] > b[i] + b[2 + i] ? a[i] + a[2 + i] : b[i] + b[2 + i];

        a[i] = a[i] < b[i] ? a[i] : b[i];
        a[2 + i] = end - a[i];
    }
}

void gni_meet_rectangles(uint32_t a[4], const uint32_t b[4])
{
    for (int i = 0; i < 2; i++) {
        const uint32_t low = a[i] > b[i] ? a[i] : b[i];
        const uint32_t end = a[i] + a[2 + i] < b[i] + b[2 + i] ? a[i] + a[2 + i] : b[i] + b[2 + i];

        a[i] = low;
        a[2 + i] = end > low ? end - low : 0;
    }
}

int gni_do_rectangles_meet(const uint32_t a[4], const uint32_t b[4])
{
    return a[0] < b[0] + b[2] && b[0] < a[0] + a[2] && a[1] < b[1] + b[3] && b[1] < a[1] + a[3];
}

double gni_lowest_of(const double normal[3], const gni_hull *box, const double ball[4])
{
    double lowest = INFINITY;

    for (int i = 0; i < 8; i++)
        lowest = fmin(lowest, gni_dot(normal, box->points[i]));
    return fmax(lowest, gni_dot(normal, ball) - ball[3]);
}

int gni_is_object_before(const gni_draft *d, uint32_t object, const double plane[4])
{
    const double lowest = gni_lowest_of(plane, &d->boxes[object], d->balls[object]);

    return lowest + plane[3] > GNI_MARGIN * (fabs(lowest) + fabs(plane[3]));
}

void gni_touch(gni_extent *e, const gni_draft *d, uint32_t object)
{
    const gni_hull *box = &d->boxes[object];

    gni_join_rectangles(e->needed, d->fronts[object].rectangle);
    for (int n = 0; n < GNI_NORMALS; n++)
        e->lowest[n] = fmin(e->lowest[n], gni_lowest_seen(e->normals[n], d, object));
    for (int i = 0; i < box->point_count; i++) {
        e->deepest = fmax(e->deepest, -box->points[i][2]);
        e->greatest =
            fmax(e->greatest, fmax(fabs(box->points[i][0]), fmax(fabs(box->points[i][1]), fabs(box->points[i][2]))));
    }
    d->touched[e->touched++].object = object;
}

void gni_start_extent(gni_extent *e, const gni_draft *d, uint32_t object)
{
    const double *light = d->bounds.light;
    const gni_hull *box = &d->boxes[object];

    e->is_ended = e->is_detached = 0;
    e->start_move = light[3] == 0.0 ? 0.0 : 1.0;
    e->touched = 0;
    e->deepest = -INFINITY;
    e->greatest = 0.0;
    memset(e->needed, 0, sizeof e->needed);
    for (int i = 0; i < box->point_count; i++)
        for (int k = 0; k < 3; k++)
            e->greatest = fmax(e->greatest, fabs(box->points[i][k]));
    for (int n = 0; n < GNI_NORMALS; n++) {
        double *normal = e->normals[n], length;

        for (int k = 0; k < 3; k++) {
            const double middle = 0.5 * (box->points[0][k] + box->points[7][k]);

            normal[k] = n == 0 ? light[k] - middle * light[3] : d->view[4 * (n - 1) + k];
        }
        length = sqrt(gni_dot(normal, normal));
        if (n > 0 && gni_dot(normal, e->normals[0]) < 0.0)
            length = -length;
        for (int k = 0; k < 3; k++)
            normal[k] = length != 0.0 ? normal[k] / length : 0.0;
        e->lowest[n] = INFINITY;
    }
    memcpy(e->scissor, d->lights[d->light].scissor, sizeof e->scissor);
    memcpy(e->image, e->scissor, sizeof e->image);
}

/* How much farther from the light the end on a plane is than the caster's farthest corner, at most; INFINITY where the
 * plane cannot end it. highest: of the caster along the normal. */
static double length_to(const double normal[3], double highest, double lowest, const double ball[4],
                        const double light[4])
{
    const double of_light = gni_dot(normal, light), from_end = of_light - lowest, gap = of_light - highest;
    double spoke[3];

    if (light[3] == 0.0) {
        const double sun = sqrt(gni_dot(light, light));

        return of_light > LEAST_SUN * sun ? (highest - lowest) / of_light * sun : INFINITY;
    }
    if (!(gap > 0.0) || !(from_end < MOST * gap))
        return INFINITY;
    for (int k = 0; k < 3; k++)
        spoke[k] = ball[k] - light[k];
    return (from_end / gap - 1.0) * (sqrt(gni_dot(spoke, spoke)) + ball[3]);
}

/* The corners of a box moved to a plane; 0 where one has no place there. */
static int move_box(double out[8][3], const gni_hull *box, const double light[4], const double plane[4])
{
    const double of_light = gni_dot(plane, light) + plane[3] * light[3];
    double extrusion[16];

    gni_extrusion(extrusion, light, plane);
    for (int i = 0; i < 8; i++) {
        const double w = of_light - light[3] * (gni_dot(plane, box->points[i]) + plane[3]);

        if (!(w > of_light / (2.0 * MOST)))
            return 0;
        gn_mat4_transform(out[i], extrusion, box->points[i], 1.0);
        for (int k = 0; k < 3; k++)
            out[i][k] /= w;
    }
    return 1;
}

double gni_behind(const gni_extent *e, const gni_draft *d, double lowest)
{
    const gn_camera *camera = &d->scene->camera;
    const double depth = camera->zfar != 0.0 ? fmin(e->deepest, camera->zfar) : e->deepest;
    const double steps = STEPS * fmax(depth, camera->znear) / ldexp(camera->znear, d->scene->target.depth_bits);
    const double pixel = d->plan->scale * (camera->top - camera->bottom) / d->scene->target.height *
                         (camera->orthographic ? 1.0 : fmax(depth, camera->znear));

    /* A GL need not place vertices closer than to 1/16 of a pixel: planes nearer to each other than that change places. */
    lowest -= fabs(lowest) * steps + GNI_MARGIN * 8.0 * e->greatest + PIXELS * pixel;
    return lowest - fabs(lowest) * steps; /* it is farther from the eye now */
}

void gni_find_moves(double moves[2], const gni_draft *d, uint32_t object, const double normal[3], double level)
{
    const double *light = d->bounds.light, other[3] = {-normal[0], -normal[1], -normal[2]};
    const double of_light = gni_dot(normal, light);
    const double lowest = gni_lowest_of(normal, &d->boxes[object], d->balls[object]);
    const double highest = -gni_lowest_of(other, &d->boxes[object], d->balls[object]);

    if (light[3] == 0.0) {
        const double sun = sqrt(gni_dot(light, light));

        moves[0] = (lowest - level) / of_light * sun;
        moves[1] = (highest - level) / of_light * sun;
    } else {
        moves[0] = (of_light - level) / (of_light - lowest);
        moves[1] = (of_light - level) / (of_light - highest);
    }
}

/* The caster's box, or where the volume starts, and its end; the volume stays without end where a corner of the box,
 * which is no vertex, has none. */
static void ended_hull(gni_hull *volume, const gni_extent *e, const gni_hull *box, const double light[4])
{
    gni_hull out = *box;

    out.point_count = 16;
    if ((!e->is_detached || move_box(out.points, box, light, e->start_plane)) &&
        move_box(out.points + 8, box, light, e->end_plane))
        *volume = out;
}

static void choose_end(gni_extent *e, const gni_draft *d, uint32_t object)
{
    const gni_hull *box = &d->boxes[object];
    const double *light = d->bounds.light, *ball = d->balls[object];
    double best = INFINITY;

    for (int n = 0; n < GNI_NORMALS; n++) {
        const double *normal = e->normals[n], other[3] = {-normal[0], -normal[1], -normal[2]};
        const double highest = -gni_lowest_of(other, box, ball);
        double lowest = e->lowest[n], length;

        if (light[3] != 0.0 && d->bounds.reach < INFINITY)
            lowest = fmax(lowest, gni_dot(normal, light) - d->bounds.reach);
        lowest = gni_behind(e, d, fmin(lowest, gni_lowest_of(normal, box, ball)));
        length = length_to(normal, highest, lowest, ball, light);
        if (length < best) {
            best = length;
            memcpy(e->end_plane, normal, 3 * sizeof *normal);
            e->end_plane[3] = -lowest;
        }
    }
    e->is_ended = best < INFINITY;
    if (e->is_ended)
        gni_find_moves(e->moves, d, object, e->end_plane, -e->end_plane[3]);
}

/* The image of the balls around a caster whose vertices are moved by `from` to `to`: they hold all that lies between.
 * Returns 0 where the near plane may cut them. */
static int find_moved_image(uint32_t out[4], const gni_draft *d, uint32_t object, double from, double to)
{
    const double *light = d->bounds.light, *ball = d->balls[object], sun = sqrt(gni_dot(light, light));
    double moved[2][4];

    for (int i = 0; i < 2; i++) {
        const double move = i ? to : from;

        moved[i][3] = light[3] == 0.0 ? ball[3] : ball[3] * move;
        for (int k = 0; k < 3; k++)
            moved[i][k] = light[3] == 0.0 ? ball[k] - move * light[k] / sun : light[k] + move * (ball[k] - light[k]);
        if (-moved[i][2] - moved[i][3] < d->scene->camera.znear)
            return 0;
    }
    gni_find_balls_rectangle(out, moved[0], moved[1], &d->scene->camera, &d->scene->target);
    return 1;
}

static double area_of(const uint32_t rectangle[4])
{
    return (double)rectangle[2] * rectangle[3];
}

void gni_choose_scissor(uint32_t out[4], const gni_draft *d, const uint32_t image[4], const uint32_t needed[4])
{
    const uint32_t *light = d->lights[d->light].scissor;
    uint32_t drawn[4];

    memcpy(drawn, image, sizeof drawn);
    memcpy(out, needed, sizeof drawn);
    gni_meet_rectangles(drawn, light);
    gni_meet_rectangles(out, drawn);
    if (out[2] > 0 && out[3] > 0 &&
        (area_of(drawn) - area_of(out) < WORTH * area_of(d->whole) || d->scene->without & GN_MEASURE_SCISSORS))
        memcpy(out, light, sizeof drawn);
}

int gni_see_extent(gni_extent *e, const gni_draft *d, uint32_t object, gni_hull *volume)
{
    uint32_t of_ball[4];

    if (e->is_ended)
        ended_hull(volume, e, &d->boxes[object], d->bounds.light);
    gni_find_rectangle(e->image, volume, &d->scene->camera, &d->scene->target);
    if (e->is_ended && find_moved_image(of_ball, d, object, e->start_move, e->moves[1]))
        gni_meet_rectangles(e->image, of_ball);
    gni_choose_scissor(e->scissor, d, e->image, e->needed);
    gni_meet_rectangles(e->image, e->scissor);
    memcpy(e->end_image, e->image, sizeof e->image);
    if (e->is_ended && find_moved_image(of_ball, d, object, e->moves[0], e->moves[1]))
        gni_meet_rectangles(e->end_image, of_ball);
    if (e->is_ended && volume->direction_count == 0) {
        gni_hull end = *volume;

        end.point_count -= 8;
        memcpy(end.points, volume->points + 8, 8 * sizeof end.points[0]);
        gni_find_rectangle(of_ball, &end, &d->scene->camera, &d->scene->target);
        gni_meet_rectangles(e->end_image, of_ball);
    }
    return e->image[2] > 0 && e->image[3] > 0;
}

int gni_end_extent(gni_extent *e, const gni_draft *d, uint32_t object, gni_hull *volume)
{
    if (!(d->scene->without & GN_MEASURE_ENDS) && !d->region && e->touched > 0)
        choose_end(e, d, object);
    return gni_see_extent(e, d, object, volume);
}
