/* sample_scene.h - what a board is calibrated on: a floor, tori above it that may cast, and lamps. */
#ifndef SAMPLE_SCENE_H
#define SAMPLE_SCENE_H
#include "scene.h"

enum { SAMPLE_COARSE = 10, SAMPLE_FINE = 1, SAMPLE_LIGHTS = 3 }; /* tori of few and of many faces */

/* Built in memory; scene_free() frees it. 1, or 0 without memory. */
int sample_scene_make(scene *out);
/* So many of each cast. */
void sample_scene_cast(scene *s, int coarse, int fine);
#endif
