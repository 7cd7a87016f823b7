/* intervals.c - volumes in pieces: only where along the rays there is something to shadow.
 *
 * Between the caster and what it may shadow, and between that and the next, nobody reads the count. So what an ended
 * volume may touch is sorted along the normal of its end, and the volume is drawn in the intervals that hold any of it
 * (clamping, Lloyd et al. 2004, there with finer and dearer bounds). An interval is a closed volume of its own: sides
 * from its start plane to its end plane, and a cap on each. Inside it the count is that of the whole volume; so planes
 * lie before and behind what is touched by more than depth can confuse, as the end does (extent.c), and all of the
 * caster lies before the first start plane. A gap that is
 * short on the image is not worth two caps and a draw. */
#include "gni_plan.h"

#include <math.h>
#include <string.h>

#define LEAST 12.0 /* pixels of the image: so long must a gap be, for a draw of its own, */
#define CAPS  1.6  /* and so many times as long as a cap's radius is high */

/* Levels along the normal, the higher one first. */
typedef struct span {
    double start, end;
    uint32_t needed[4], count;
} span;

/* Where the caster's middle gets to at a level, in pixels, and how large a cap is there: half the height of its image,
 * as the ball around the caster gives it, seen as flat as it is. 0 where that is behind the eye. */
static int find_place(double out[3], const gni_draft *d, uint32_t object, const double normal[3], double level)
{
    const gn_camera *camera = &d->scene->camera;
    const double *light = d->bounds.light, *ball = d->balls[object];
    const double of_light = gni_dot(normal, light), of_ball = gni_dot(normal, ball);
    const double grown = light[3] == 0.0 ? 1.0 : (of_light - level) / (of_light - of_ball);
    const double pixels = d->whole[3] / (camera->top - camera->bottom);
    double p[3];

    for (int k = 0; k < 3; k++)
        p[k] = light[3] == 0.0 ? ball[k] + (level - of_ball) / of_light * light[k]
                               : light[k] + grown * (ball[k] - light[k]);
    out[0] = p[0] / -p[2] * d->whole[2] / (camera->right - camera->left);
    out[1] = p[1] / -p[2] * pixels;
    out[2] = grown * ball[3] / -p[2] * pixels * fabs(gni_dot(normal, p)) / sqrt(gni_dot(p, p));
    return -p[2] > camera->znear;
}

/* Whether the sides between two levels cover more than caps on both: 4 r g pixels, 2 r wide before and behind, for twice
 * pi r^2. */
static int is_worth_it(const gni_draft *d, uint32_t object, const double normal[3], double from, double to)
{
    double a[3], b[3], gap;

    if (!(from > to) || !find_place(a, d, object, normal, from) || !find_place(b, d, object, normal, to))
        return 0;
    gap = hypot(a[0] - b[0], a[1] - b[1]);
    return gap > LEAST && gap > CAPS * 0.5 * (a[2] + b[2]);
}

/* Those of the touched that start the highest, first. */
static void sort_touched(gni_touched *touched, uint32_t count)
{
    for (uint32_t i = 1; i < count; i++) {
        const gni_touched it = touched[i];
        uint32_t at = i;

        for (; at > 0 && touched[at - 1].start < it.start; at--)
            touched[at] = touched[at - 1];
        touched[at] = it;
    }
}

uint32_t gni_cut_extent(gni_extent out[GNI_MOST_INTERVALS], const gni_extent *e, const gni_draft *d, uint32_t object)
{
    const double *normal = e->end_plane, down[3] = {-normal[0], -normal[1], -normal[2]};
    const double own = gni_behind(e, d, gni_lowest_of(normal, &d->boxes[object], d->balls[object]));
    span spans[GNI_MOST_INTERVALS] = {{INFINITY, own, {0}, 0}};
    uint32_t count = 1, seen = 0;

    for (uint32_t i = 0; i < e->touched; i++) {
        gni_touched *t = &d->touched[i];

        t->start = -gni_behind(e, d, gni_lowest_seen(down, d, t->object));
        t->end = gni_behind(e, d, gni_lowest_seen(normal, d, t->object));
    }
    sort_touched(d->touched, e->touched);
    for (uint32_t i = 0; i < e->touched; i++) {
        const gni_touched *t = &d->touched[i];
        span *s = &spans[count - 1];

        if (t->start <= -e->end_plane[3])
            continue; /* out of reach */
        if (count < GNI_MOST_INTERVALS && is_worth_it(d, object, normal, s->end, t->start)) {
            s = &spans[count++];
            memset(s, 0, sizeof *s);
            s->start = t->start;
            s->end = INFINITY;
        }
        s->end = fmax(fmin(s->end, t->end), -e->end_plane[3]);
        gni_join_rectangles(s->needed, d->fronts[t->object].rectangle);
        s->count++;
    }
    for (uint32_t i = 0; i < count; i++) {
        gni_extent *interval = &out[seen];
        gni_hull volume;
        double moves[2];

        if (spans[i].count == 0)
            continue;
        *interval = *e;
        interval->is_detached = i > 0;
        memcpy(interval->start_plane, normal, 3 * sizeof *normal);
        interval->start_plane[3] = -spans[i].start;
        interval->end_plane[3] = -spans[i].end;
        memcpy(interval->needed, spans[i].needed, sizeof interval->needed);
        if (i > 0) {
            gni_find_moves(moves, d, object, normal, spans[i].start);
            interval->start_move = moves[0];
        }
        gni_find_moves(interval->moves, d, object, normal, spans[i].end);
        gni_volume_hull(&volume, &d->boxes[object], d->bounds.light);
        if (!gni_see_extent(interval, d, object, &volume))
            continue;
        /* the case at hand was asked of these pixels */
        gni_meet_rectangles(interval->scissor, e->scissor);
        gni_meet_rectangles(interval->image, e->scissor);
        gni_meet_rectangles(interval->end_image, e->scissor);
        seen += interval->image[2] > 0 && interval->image[3] > 0;
    }
    return seen;
}
