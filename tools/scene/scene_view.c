/* scene_view.c - a camera and a light for scenes that bring none.
 *
 * The camera stands off the bounds' centre so far that the sphere around the bounds fits its narrower angle, a little
 * to the right and above. The light stands beside the camera and higher, so that shadows fall where they are seen. */
#include "gltf.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846

#define VIEW_MARGIN   1.05 /* of the distance at which the sphere just fits */
#define NEAR_FRACTION 0.01 /* of the distance: the sphere begins at 0.6 of it or beyond */
#define LIGHT_ASIDE   0.35 /* of the distance */
#define LIGHT_ABOVE   0.5

static void tell(void (*warn)(const char *line), const char *what, const double at[3])
{
    char line[SCENE_MESSAGE];

    snprintf(line, sizeof line, "no %s in the scene: placed one at (%g, %g, %g)", what, at[0], at[1], at[2]);
    if (warn)
        warn(line);
}

/* Centre and radius of the bounds; radius 1 for a scene without extent. */
static double find_sphere(const scene *s, double centre[3])
{
    double half[3], radius;

    for (int i = 0; i < 3; i++) {
        half[i] = s->bounds_max[i] / 2 - s->bounds_min[i] / 2;
        centre[i] = s->bounds_min[i] + half[i];
    }
    radius = sqrt(half[0] * half[0] + half[1] * half[1] + half[2] * half[2]);
    return radius > 0.0 && isfinite(radius) ? radius : 1.0;
}

static void place_camera(scene *s, double aspect)
{
    const double back[3] = {0.6, 0.5, 0.8}, flat = sqrt(back[0] * back[0] + back[2] * back[2]);
    const double length = sqrt(flat * flat + back[1] * back[1]);
    scene_camera *c = &s->camera;
    double centre[3], radius, half_angle, distance;

    memset(c, 0, sizeof *c);
    radius = find_sphere(s, centre);
    c->node = SCENE_NONE;
    c->yfov = PI / 4;
    half_angle = fmin(c->yfov / 2, atan(tan(c->yfov / 2) * aspect));
    distance = VIEW_MARGIN * radius / sin(half_angle);
    c->znear = NEAR_FRACTION * distance;
    /* x lies level, z looks back from the centre, y = z x x */
    c->world[0] = back[2] / flat;
    c->world[2] = -back[0] / flat;
    for (int i = 0; i < 3; i++) {
        c->world[8 + i] = back[i] / length;
        c->world[12 + i] = centre[i] + distance * c->world[8 + i];
    }
    c->world[4] = c->world[9] * c->world[2] - c->world[10] * c->world[1];
    c->world[5] = c->world[10] * c->world[0] - c->world[8] * c->world[2];
    c->world[6] = c->world[8] * c->world[1] - c->world[9] * c->world[0];
    c->world[15] = 1.0;
    s->has_camera = 1;
}

/* By the camera, whoever placed that: a camera inside a room gets its light in the room, more likely than not. */
static void place_light(scene *s, scene_light *l)
{
    const double *eye = s->camera.world + 12, *x = s->camera.world;
    double centre[3], distance, radius = find_sphere(s, centre), to_centre = 0.0;

    memset(l, 0, sizeof *l);
    distance = sqrt((eye[0] - centre[0]) * (eye[0] - centre[0]) + (eye[1] - centre[1]) * (eye[1] - centre[1]) +
                    (eye[2] - centre[2]) * (eye[2] - centre[2]));
    distance = fmax(distance, radius / 8);
    l->node = SCENE_NONE;
    l->kind = SCENE_POINT;
    l->outer = PI / 4;
    l->towards[2] = 1.0;
    for (int i = 0; i < 3; i++) {
        l->color[i] = 1.0;
        l->position[i] = eye[i] + LIGHT_ASIDE * distance * x[i] + (i == 1 ? LIGHT_ABOVE * distance : 0.0);
        to_centre += (l->position[i] - centre[i]) * (l->position[i] - centre[i]);
    }
    l->intensity = to_centre > 0.0 && isfinite(to_centre) ? to_centre : 1.0; /* gives 1 at the centre */
}

int scene_ensure_view(scene *s, double aspect, void (*warn)(const char *line))
{
    scene_light *lights;

    if (!(aspect > 1e-3 && aspect < 1e3))
        aspect = aspect >= 1e3 ? 1e3 : aspect > 0.0 ? 1e-3 : 1.0;
    if (!s->has_camera) {
        place_camera(s, aspect);
        tell(warn, "camera", s->camera.world + 12);
    }
    if (s->light_count > 0)
        return 1;
    lights = realloc(s->lights, sizeof *lights);
    if (!lights)
        return 0;
    s->lights = lights;
    place_light(s, &lights[0]);
    s->light_count = 1;
    tell(warn, "light", lights[0].position);
    return 1;
}
