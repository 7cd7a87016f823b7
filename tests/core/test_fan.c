/* test_fan.c - dark caps over the silhouette wind around each direction as often as the casting triangles cover it; and
 * where all sides run round the hub the same way they cover hardly any more often. */
#include "gn_matrix.h"
#include "gn_test.h"
#include "gni.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static uint32_t rng = 2003;

static void add_ball(test_mesh *m, uint32_t around, uint32_t rings)
{
    const uint32_t top = test_add_vertex(m, 0, 1, 0);

    for (uint32_t j = 1; j < rings; j++)
        for (uint32_t i = 0; i < around; i++) {
            const double u = 6.283185307179586 * i / around, v = 3.141592653589793 * j / rings;

            test_add_vertex(m, (float)(sin(v) * cos(u)), (float)cos(v), (float)(sin(v) * sin(u)));
        }
    test_add_vertex(m, 0, -1, 0);
    for (uint32_t i = 0; i < around; i++) {
        const uint32_t n = (i + 1) % around, last = 1 + (rings - 2) * around;

        test_add_triangle(m, top, 1 + n, 1 + i);
        test_add_triangle(m, last + i, last + n, last + around);
        for (uint32_t j = 0; j + 2 < rings; j++) {
            const uint32_t row = 1 + j * around;

            test_add_triangle(m, row + i, row + n, row + around + n);
            test_add_triangle(m, row + i, row + around + n, row + around + i);
        }
    }
}

/* A box, a torus, a ball, a ball with dents. */
static void make_mesh(test_mesh *m, int kind)
{
    static const float low[3] = {-1, -0.6f, -0.8f}, high[3] = {1, 0.6f, 0.8f};

    m->vertex_count = m->triangle_count = 0;
    if (kind == 0)
        test_add_box(m, low, high, 0);
    else if (kind == 1)
        test_add_torus(m, 1.0f, 0.4f, 14, 8);
    else
        add_ball(m, 16, 9);
    for (size_t v = 0; v < m->vertex_count && kind == 3; v++) {
        const float size = (float)test_uniform(&rng, 0.85, 1.05);

        for (int i = 0; i < 3; i++)
            m->positions[3 * v + (size_t)i] *= size;
    }
}

/* -1, 0, 1: how a triangle of far vertices, as indices, is seen along a direction from the light; 0 where it is not
 * hit. */
static int covers(const gn_mesh *mesh, const uint16_t t[3], const double light[4], const double along[3])
{
    double side[3], p[3][3], n[3];

    for (int k = 0; k < 3; k++) {
        const uint32_t vertex = t[k] / 2u;
        const float *v = vertex < mesh->info.vertex_count ? mesh->positions + 3 * (size_t)mesh->chunk_vertices[vertex]
                                                          : mesh->info.hub;

        assert_int_equal(t[k] % 2, 1); /* far vertices alone */
        for (int i = 0; i < 3; i++)
            p[k][i] = (double)v[i] - light[i];
    }
    for (int k = 0; k < 3; k++) {
        gni_cross(n, p[k], p[(k + 1) % 3]);
        side[k] = gni_dot(n, along);
    }
    if (side[0] > 0 && side[1] > 0 && side[2] > 0)
        return 1;
    return side[0] < 0 && side[1] < 0 && side[2] < 0 ? -1 : 0;
}

static void fans_cover_what_caps_do(void **state)
{
    static const double identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    static test_mesh m;
    static uint16_t indices[2][GNI_MOST_INDICES * 400];
    static uint32_t first[GN_CHUNK_VERTICES], next[3 * 400];
    static uint16_t loop[3 * 400 + 1];
    const gni_walk walk = {GN_CHUNK_VERTICES, first, next, loop};
    uint32_t found = 0, none = 0, covered = 0, enclosed = 0;

    (void)state;
    memset(first, 0xff, sizeof first);
    for (int trial = 0; trial < 400; trial++) {
        gn_mesh_desc desc;
        gn_mesh *mesh;
        gn_object object = {0};
        gn_light lamp = {.kind = GN_LIGHT_POINT};
        gni_casting *casting;
        uint32_t sides, counts[2];
        double light[4] = {0, 0, 0, 1}, length;
        int runs_round;

        make_mesh(&m, trial % 4);
        desc = test_desc(&m);
        assert_int_equal(gn_mesh_create(test_context, &desc, &mesh), GN_OK);
        for (int i = 0; i < 3; i++)
            light[i] = test_uniform(&rng, -1, 1);
        length = sqrt(gni_dot(light, light));
        for (int i = 0; i < 3; i++)
            light[i] *= test_uniform(&rng, 2.5, 9) / length;
        casting = &mesh->scratch;
        gni_find_casting(mesh, light, casting);
        object.mesh = mesh;
        memcpy(object.model, identity, sizeof object.model);
        for (int i = 0; i < 3; i++)
            lamp.position[i] = light[i] + (double)mesh->info.centre[i];
        assert_int_equal(gni_light_is_outside(&lamp, &object), 1);
        sides = gni_put_sides(mesh, 0, casting, 1, indices[1]);
        runs_round = gni_runs_round_hub(mesh, 0, indices[1], sides, 3, identity, light);
        counts[0] = gni_put_dark_cap(mesh, 0, casting, indices[0]);
        counts[1] = gni_put_fan(mesh, 0, indices[1], sides, 3, &walk, indices[1] + sides);
        assert_true(counts[1] <= sides);
        found += runs_round != 0;
        none += !runs_round;
        for (int n = 0; n < 60; n++) {
            double along[3];
            int sums[2] = {0, 0}, absolute = 0;

            for (int i = 0; i < 3; i++)
                along[i] = test_uniform(&rng, -1, 1) - light[i];
            for (int f = 0; f < 2; f++)
                for (uint32_t i = 0; i < counts[f]; i += 3) {
                    const int times = covers(mesh, indices[f] + (f ? sides : 0) + i, light, along);

                    sums[f] += times;
                    absolute += f ? abs(times) : 0;
                }
            if (sums[0] != sums[1])
                fail_msg("trial %d: the fan covers a direction %d times, the cap %d times", trial, sums[1], sums[0]);
            covered += runs_round ? (uint32_t)absolute : 0;
            enclosed += runs_round ? (uint32_t)abs(sums[1]) : 0;
        }
        for (uint32_t v = 0; v < GN_CHUNK_VERTICES; v++)
            assert_true(first[v] == GNI_NONE);
        gn_mesh_destroy(mesh);
    }
    print_message("           %lu have a fan, %lu have none\n", (unsigned long)found, (unsigned long)none);
    print_message("           %lu directions are enclosed, and covered %lu times\n", (unsigned long)enclosed,
                  (unsigned long)covered);
    assert_true(found > 100 && none > 50);
    assert_true(enclosed > 1000 && covered - enclosed < enclosed / 16);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(fans_cover_what_caps_do)};

    return cmocka_run_group_tests_name("fan", tests, test_open_context, test_close_context);
}
