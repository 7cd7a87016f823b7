/* orbit.c - see orbit.h. */
#include "orbit.h"

#include <math.h>
#include <string.h>

#define STEEPEST 1.55 /* radians: short of straight up and down, where yaw means nothing */

void orbit_reset(orbit *o, scene *s)
{
    if (o->is_moved) {
        s->camera.xmag = o->magnification[0];
        s->camera.ymag = o->magnification[1];
    }
    memset(o, 0, sizeof *o);
}

static void axes_of(const orbit *o, double right[3], double up[3], double back[3])
{
    const double r[3] = {cos(o->yaw), 0.0, -sin(o->yaw)};
    const double b[3] = {cos(o->pitch) * sin(o->yaw), sin(o->pitch), cos(o->pitch) * cos(o->yaw)};

    for (int i = 0; i < 3; i++) {
        right[i] = r[i];
        back[i] = b[i];
        up[i] = b[(i + 1) % 3] * r[(i + 2) % 3] - b[(i + 2) % 3] * r[(i + 1) % 3];
    }
}

/* The first time: from the camera as it is. What it looks at is as far as the scene's middle is, if that is before it. */
static void begin(orbit *o, const scene *s)
{
    const double *world = s->camera.world, *back = world + 8, *eye = world + 12;
    double ahead = 0.0, size = 0.0;

    if (o->is_moved)
        return;
    o->is_moved = 1;
    o->zoom = 1.0;
    o->magnification[0] = s->camera.xmag;
    o->magnification[1] = s->camera.ymag;
    o->yaw = atan2(back[0], back[2]);
    o->pitch = fmin(fmax(asin(fmin(fmax(back[1], -1.0), 1.0)), -STEEPEST), STEEPEST);
    for (int i = 0; i < 3; i++) {
        const double extent = s->bounds_max[i] - s->bounds_min[i];

        size += extent * extent;
        ahead += (eye[i] - 0.5 * (s->bounds_min[i] + s->bounds_max[i])) * back[i];
    }
    o->reach = fmax(0.5 * sqrt(size), 1e-6);
    o->distance = fmax(ahead, 0.2 * o->reach);
    for (int i = 0; i < 3; i++)
        o->target[i] = eye[i] - o->distance * back[i];
}

void orbit_turn(orbit *o, const scene *s, double yaw, double pitch)
{
    begin(o, s);
    o->yaw += yaw;
    o->pitch = fmin(fmax(o->pitch + pitch, -STEEPEST), STEEPEST);
}

void orbit_look(orbit *o, const scene *s, double yaw, double pitch)
{
    double right[3], up[3], back[3], eye[3];

    begin(o, s);
    axes_of(o, right, up, back);
    for (int i = 0; i < 3; i++)
        eye[i] = o->target[i] + o->distance * back[i];
    orbit_turn(o, s, yaw, pitch);
    axes_of(o, right, up, back);
    for (int i = 0; i < 3; i++)
        o->target[i] = eye[i] - o->distance * back[i];
}

static void shift(orbit *o, double x, double y, double z)
{
    double right[3], up[3], back[3];

    axes_of(o, right, up, back);
    for (int i = 0; i < 3; i++)
        o->target[i] += x * right[i] + y * up[i] + z * back[i];
}

void orbit_pan(orbit *o, const scene *s, double right, double up)
{
    double half;

    begin(o, s);
    half = s->camera.orthographic ? s->camera.ymag : o->distance * tan(0.5 * s->camera.yfov);
    shift(o, -right * half, -up * half, 0.0);
}

void orbit_zoom(orbit *o, const scene *s, double steps)
{
    begin(o, s);
    if (s->camera.orthographic)
        o->zoom *= pow(0.9, steps);
    else
        o->distance = fmax(o->distance * pow(0.9, steps), 1e-3 * o->reach);
}

void orbit_move(orbit *o, const scene *s, double right, double up, double forward)
{
    begin(o, s);
    shift(o, right * o->reach, up * o->reach, -forward * o->reach);
}

void orbit_apply(const orbit *o, scene *s)
{
    double *world = s->camera.world;

    if (!o->is_moved)
        return;
    s->camera.xmag = o->zoom * o->magnification[0];
    s->camera.ymag = o->zoom * o->magnification[1];
    axes_of(o, world, world + 4, world + 8);
    for (int i = 0; i < 3; i++)
        world[12 + i] = o->target[i] + o->distance * world[8 + i];
}
