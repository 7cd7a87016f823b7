/* handles.h - lights moved by hand: where each is on the screen, which is meant, and where it is dragged to.
 *
 * A point or spot light's handle is at its place; a sun's is on a sphere round the scene's middle, towards it. */
#ifndef HANDLES_H
#define HANDLES_H
#include "scene.h"

typedef struct handle {
    int is_moved;  /* by hand: the scene's own animation of it is over */
    double at[3];  /* its handle, world */
    double turned; /* degrees about the vertical axis through the scene's middle */
} handle;

typedef struct handles {
    handle *of; /* [count] */
    size_t count;
} handles;

int handles_open(handles *h, const scene *s); /* 1, or 0 without memory */
void handles_close(handles *h);               /* a zeroed one does nothing */
/* All as the scene has them. */
void handles_reset(handles *h);

/* Pixels from the left and top; 0 when it is behind the eye. */
int handle_place(const scene *s, size_t light, const uint32_t size[2], double at[2]);
/* The light whose handle is within `reach` pixels, the nearest; SCENE_NONE when none is. */
int handle_find(const handles *h, const scene *s, const double at[2], const uint32_t size[2], double reach);
/* By so many pixels, at the depth at which it is. */
void handle_drag(handles *h, const scene *s, size_t light, const double by[2], const uint32_t size[2]);
/* All lights about the vertical axis. */
void handles_turn(handles *h, double degrees);
/* Puts the scene's lights there; after scene_pose(). */
void handles_apply(const handles *h, scene *s);
#endif
