/* orbit.h - a camera moved by hand: round a point, along, near and far; or flown. y is up. */
#ifndef ORBIT_H
#define ORBIT_H
#include "scene.h"

typedef struct orbit {
    int is_moved; /* 0: the scene's own camera is seen, as it is animated */
    double target[3], yaw, pitch, distance;
    double reach;                  /* of the scene: half its diagonal */
    double zoom, magnification[2]; /* of an orthographic camera: by how much, of what */
} orbit;

/* Back to the scene's own. */
void orbit_reset(orbit *o, scene *s);
/* Radians about the target. */
void orbit_turn(orbit *o, const scene *s, double yaw, double pitch);
/* Radians about the eye. */
void orbit_look(orbit *o, const scene *s, double yaw, double pitch);
/* By halves of the picture's height, at the target's distance. */
void orbit_pan(orbit *o, const scene *s, double right, double up);
/* Nearer by steps of a tenth; less than 0: farther. */
void orbit_zoom(orbit *o, const scene *s, double steps);
/* Eye and target together, by shares of the scene's size. */
void orbit_move(orbit *o, const scene *s, double right, double up, double forward);
/* Puts the scene's camera there. */
void orbit_apply(const orbit *o, scene *s);
#endif
