/* views.c - see views.h. */
#include "views.h"

#include <string.h>

#include "gn_matrix.h"
#include "gn_test.h"
#include "pile.h"

void test_random_view(scene *s, uint32_t *rng)
{
    static const double zero[3] = {0, 0, 0}, one[3] = {1, 1, 1};
    double q[4];

    for (int i = 0; i < 4; i++)
        q[i] = test_uniform(rng, -1, 1);
    gn_mat4_from_trs(s->camera.world, zero, q, one);
    for (int i = 0; i < 3; i++)
        s->camera.world[12 + i] = 0.5 * (s->bounds_min[i] + s->bounds_max[i]) +
                                  test_uniform(rng, -0.35, 0.35) * (s->bounds_max[i] - s->bounds_min[i]);
}

void test_view_from_above(scene *s, uint32_t *rng)
{
    const double away[3] = {test_uniform(rng, -1, 1), test_uniform(rng, 0.3, 1.0), test_uniform(rng, -1, 1) + 0.01};
    double eye[3], middle[3];

    for (int i = 0; i < 3; i++) {
        middle[i] = 0.5 * (s->bounds_max[i] + s->bounds_min[i]);
        eye[i] = middle[i] + away[i] * (0.5 * (s->bounds_max[i] - s->bounds_min[i]) + 1.0);
    }
    pile_look_at(s->camera.world, eye, middle);
}
