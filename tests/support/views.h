/* views.h - cameras of tests: anywhere in and around a scene. */
#ifndef VIEWS_H
#define VIEWS_H
#include "scene.h"

/* In the scene's box, or somewhat outside it, looking anywhere. */
void test_random_view(scene *s, uint32_t *rng);
/* From above, towards the middle: floors are seen. */
void test_view_from_above(scene *s, uint32_t *rng);
#endif
