/* handles.c - see handles.h. */
#include "handles.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define DEGREE (3.14159265358979323846 / 180.0)
#define FAR    0.9 /* a sun's handle, of half the scene's diagonal */

int handles_open(handles *h, const scene *s)
{
    h->count = s->light_count;
    h->of = calloc(h->count + 1, sizeof *h->of);
    return h->of != NULL;
}

void handles_close(handles *h)
{
    free(h->of);
    memset(h, 0, sizeof *h);
}

void handles_reset(handles *h)
{
    memset(h->of, 0, h->count * sizeof *h->of);
}

static double middle_of(const scene *s, double middle[3])
{
    double square = 0.0;

    for (int i = 0; i < 3; i++) {
        const double extent = s->bounds_max[i] - s->bounds_min[i];

        middle[i] = 0.5 * (s->bounds_min[i] + s->bounds_max[i]);
        square += extent * extent;
    }
    return fmax(FAR * 0.5 * sqrt(square), 1e-6);
}

static void turn(double p[3], const double about[3], double degrees)
{
    const double a = degrees * DEGREE, x = p[0] - about[0], z = p[2] - about[2];

    p[0] = about[0] + x * cos(a) + z * sin(a);
    p[2] = about[2] + z * cos(a) - x * sin(a);
}

/* Of a scene whose lights were placed by handles_apply(), or not yet. */
static void world_of(const scene *s, size_t light, double p[3])
{
    const scene_light *l = &s->lights[light];
    double middle[3];
    const double far = middle_of(s, middle);

    for (int i = 0; i < 3; i++)
        p[i] = l->kind == SCENE_DIRECTIONAL ? middle[i] + far * l->towards[i] : l->position[i];
}

/* Right, up and depth before the eye. */
static void see(const scene *s, const double p[3], double seen[3])
{
    const double *w = s->camera.world;

    for (int axis = 0; axis < 3; axis++) {
        seen[axis] = 0.0;
        for (int i = 0; i < 3; i++)
            seen[axis] += w[4 * axis + i] * (p[i] - w[12 + i]);
    }
    seen[2] = -seen[2];
}

/* World units of a pixel at that depth. */
static double unit_at(const scene *s, double depth, const uint32_t size[2])
{
    const double half = s->camera.orthographic ? s->camera.ymag : depth * tan(0.5 * s->camera.yfov);

    return 2.0 * half / size[1];
}

int handle_place(const scene *s, size_t light, const uint32_t size[2], double at[2])
{
    double p[3], seen[3], unit;

    world_of(s, light, p);
    see(s, p, seen);
    if (!s->camera.orthographic && seen[2] < s->camera.znear)
        return 0;
    unit = unit_at(s, seen[2], size);
    at[0] = 0.5 * size[0] +
            seen[0] / unit * (s->camera.orthographic ? s->camera.ymag / s->camera.xmag * size[0] / size[1] : 1.0);
    at[1] = 0.5 * size[1] - seen[1] / unit;
    return 1;
}

int handle_find(const handles *h, const scene *s, const double at[2], const uint32_t size[2], double reach)
{
    double nearest = reach;
    int found = SCENE_NONE;

    for (size_t i = 0; i < h->count; i++) {
        double place[2];

        if (!handle_place(s, i, size, place) || hypot(place[0] - at[0], place[1] - at[1]) > nearest)
            continue;
        nearest = hypot(place[0] - at[0], place[1] - at[1]);
        found = (int)i;
    }
    return found;
}

void handle_drag(handles *h, const scene *s, size_t light, const double by[2], const uint32_t size[2])
{
    const double *w = s->camera.world;
    handle *of = &h->of[light];
    double seen[3], unit;

    if (!of->is_moved || of->turned != 0.0)
        world_of(s, light, of->at);
    of->is_moved = 1;
    of->turned = 0.0;
    see(s, of->at, seen);
    unit = unit_at(s, fmax(seen[2], s->camera.znear), size);
    for (int i = 0; i < 3; i++)
        of->at[i] += unit * (by[0] * w[i] - by[1] * w[4 + i]);
}

void handles_turn(handles *h, double degrees)
{
    for (size_t i = 0; i < h->count; i++)
        h->of[i].turned += degrees;
}

void handles_apply(const handles *h, scene *s)
{
    double middle[3];

    middle_of(s, middle);
    for (size_t i = 0; i < h->count; i++) {
        scene_light *l = &s->lights[i];
        const int is_sun = l->kind == SCENE_DIRECTIONAL;
        double length = 0.0, p[3];

        if (h->of[i].is_moved)
            memcpy(p, h->of[i].at, sizeof p);
        else
            world_of(s, i, p);
        if (h->of[i].turned != 0.0)
            turn(p, middle, h->of[i].turned);
        for (int k = 0; k < 3; k++) {
            if (!is_sun)
                l->position[k] = p[k];
            length += (p[k] - middle[k]) * (p[k] - middle[k]);
        }
        for (int k = 0; k < 3 && is_sun && length > 0.0; k++)
            l->towards[k] = (p[k] - middle[k]) / sqrt(length);
    }
}
