/* test_facing.c - floats and the tree of cones find the very bits that the double expression has; sides are the
 * silhouette, whichever way it is found. */
#include "gn_test.h"
#include "gni.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static uint32_t rng = 5;

/* A torus, a rough one, a grid, triangles anywhere; far from the origin, huge or tiny. */
static void make_mesh(test_mesh *m, uint32_t kind)
{
    const float size = (float)pow(10.0, test_uniform(&rng, -12, 12)), away = test_random(&rng) % 3 == 0 ? 50.0f : 0.0f;

    m->vertex_count = m->triangle_count = 0;
    if (kind == 0) {
        test_add_torus(m, 2.0f, 0.7f, 60, 24);
    } else if (kind == 1) {
        test_add_torus(m, 2.0f, 0.7f, 60, 24);
        for (size_t i = 0; i < 3 * m->vertex_count; i++)
            m->positions[i] += (float)test_uniform(&rng, -0.02, 0.02);
    } else if (kind == 2) { /* flat, or nearly */
        const float bend = test_random(&rng) % 2 ? (float)pow(10.0, test_uniform(&rng, -6, -2)) : 0.0f;

        for (uint32_t i = 0; i < 30 * 30; i++)
            test_add_vertex(m, (float)(i % 30), 1.0f + bend * (float)((i % 30) * (i % 30) + (i / 30) * (i / 30)),
                            (float)(i / 30));
        for (uint32_t i = 0; i < 29 * 30; i++)
            if (i % 30 != 29) {
                test_add_triangle(m, i, i + 30, i + 1);
                test_add_triangle(m, i + 1, i + 30, i + 31);
            }
    } else {
        for (uint32_t i = 0; i < 600; i++)
            test_add_vertex(m, (float)test_uniform(&rng, -2, 2), (float)test_uniform(&rng, -2, 2),
                            (float)(test_random(&rng) % 3));
        for (uint32_t i = 0; i < 1000; i++)
            test_add_triangle(m, test_random(&rng) % 600, test_random(&rng) % 600, test_random(&rng) % 600);
    }
    for (size_t i = 0; i < 3 * m->vertex_count; i++)
        m->positions[i] = (m->positions[i] + away) * size;
}

/* Anywhere, on a vertex, in a triangle's plane, or without end away; or a direction. */
static void make_light(const gn_mesh *mesh, double light[4])
{
    const uint32_t t = test_random(&rng) % mesh->info.triangle_count, kind = test_random(&rng) % 5;
    const uint32_t *c = mesh->triangles + 3 * (size_t)t;
    const double reach = mesh->radius * pow(10.0, test_uniform(&rng, -1, kind == 4 ? 40 : 1));
    double share[3] = {1, 0, 0};

    for (int k = 0; k < 2 && kind == 1; k++)
        share[k] = test_uniform(&rng, -1, 1) * pow(10.0, test_uniform(&rng, 0, 3));
    share[2] = kind == 1 ? 1.0 - share[0] - share[1] : 0.0;
    for (int axis = 0; axis < 3; axis++) {
        light[axis] = 0.0;
        for (int k = 0; k < 3; k++)
            light[axis] += share[k] * (double)mesh->positions[3 * (size_t)c[k] + (size_t)axis];
        light[axis] += kind >= 2 ? test_uniform(&rng, -1, 1) * reach : 0.0;
    }
    light[3] = kind == 3 ? 0.0 : 1.0;
}

static int exact(const double plane[4], const double light[4])
{
    const double side = plane[0] * light[0] + plane[1] * light[1] + plane[2] * light[2] + plane[3] * light[3];

    return (side > 0.0) - (side < 0.0);
}

static void bits_are_the_expressions(void **state)
{
    static test_mesh m;
    uint64_t looked = 0, all = 0, zeros = 0;

    (void)state;
    for (uint32_t trial = 0; trial < 400; trial++) {
        gn_mesh_desc desc;
        gn_mesh *mesh;
        uint64_t *bits[4];

        make_mesh(&m, trial % 4);
        desc = test_desc(&m);
        assert_int_equal(gn_mesh_create(test_context, &desc, &mesh), GN_OK);
        for (int i = 0; i < 4; i++)
            bits[i] = malloc(mesh->cluster_count * sizeof *bits[i]);
        for (int n = 0; n < 20; n++) {
            double light[4];

            make_light(mesh, light);
            looked += gni_find_facing(mesh, light, bits[0], bits[1]);
            all += gni_scan_facing(mesh, light, bits[2], bits[3]);
            assert_memory_equal(bits[0], bits[2], mesh->cluster_count * sizeof *bits[0]);
            assert_memory_equal(bits[1], bits[3], mesh->cluster_count * sizeof *bits[1]);
            for (uint32_t t = 0; t < mesh->info.triangle_count; t++) {
                const int found = (int)(bits[0][t / 64] >> t % 64 & 1) - (int)(bits[1][t / 64] >> t % 64 & 1);
                const int side = exact(mesh->planes + 4 * (size_t)t, light);

                zeros += side == 0;
                if (found != side)
                    fail_msg("trial %u, light %g %g %g %g, triangle %u: %d, and in double %d", trial, light[0],
                             light[1], light[2], light[3], t, found, side);
            }
        }
        for (int i = 0; i < 4; i++)
            free(bits[i]);
        gn_mesh_destroy(mesh);
    }
    print_message("           %.0f %% of the triangles were looked at, %lu are edge-on\n",
                  100.0 * (double)looked / (double)all, (unsigned long)zeros);
    assert_true(looked < all / 10 * 9 && zeros > 1000);
}

typedef struct tally {
    uint32_t a, b;
    int32_t weight;
} tally;

static int by_edge(const void *x, const void *y)
{
    const tally *a = x, *b = y;

    if (a->a != b->a)
        return a->a < b->a ? -1 : 1;
    return a->b < b->b ? -1 : a->b > b->b;
}

/* Equal edges added up; returns how many are left. */
static size_t add_up(tally *t, size_t count)
{
    size_t kept = 0;

    qsort(t, count, sizeof *t, by_edge);
    for (size_t i = 0; i < count; i++) {
        if (kept && by_edge(&t[kept - 1], &t[i]) == 0)
            t[kept - 1].weight += t[i].weight;
        else
            t[kept++] = t[i];
    }
    return kept;
}

static void sides_are_the_silhouette(void **state)
{
    static test_mesh m;
    static uint16_t indices[18 * 6000];
    static gn_edge edges[3 * 6000];
    static tally tallies[2][3 * 6000];
    static int8_t casting[6000];

    (void)state;
    for (uint32_t trial = 0; trial < 200; trial++) {
        gn_mesh_desc desc;
        gn_mesh *mesh;
        double light[4];
        size_t counts[2];
        uint32_t sides;

        make_mesh(&m, trial % 4);
        desc = test_desc(&m);
        assert_int_equal(gn_mesh_create(test_context, &desc, &mesh), GN_OK);
        assert_int_equal(mesh->info.chunk_count, 1);
        make_light(mesh, light);
        gn_casting(mesh, light, casting);
        assert_int_equal(gn_silhouette(mesh, casting, edges, 3 * 6000, &counts[0]), GN_OK);
        for (size_t i = 0; i < counts[0]; i++)
            tallies[0][i] = (tally){edges[i].a, edges[i].b, (int32_t)edges[i].weight};
        gni_find_casting(mesh, light, &mesh->scratch);
        sides = gni_put_sides(mesh, 0, &mesh->scratch, 1, indices);
        counts[1] = sides / 3;
        for (size_t i = 0; i < counts[1]; i++) /* b, a, a + 1: the cap runs from a to b */
            tallies[1][i] =
                (tally){mesh->chunk_vertices[indices[3 * i + 1] / 2], mesh->chunk_vertices[indices[3 * i] / 2], 1};
        counts[0] = add_up(tallies[0], counts[0]);
        counts[1] = add_up(tallies[1], counts[1]);
        assert_int_equal(counts[0], counts[1]);
        assert_memory_equal(tallies[0], tallies[1], counts[0] * sizeof tallies[0][0]);
        gn_mesh_destroy(mesh);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(bits_are_the_expressions),
                                       cmocka_unit_test(sides_are_the_silhouette)};

    return cmocka_run_group_tests_name("facing", tests, test_open_context, test_close_context);
}
