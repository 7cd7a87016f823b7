/* test_update.c - a mesh in a new shape is as one made so: the same planes, facing, silhouettes and solid parts, where
 * these are stars; bad positions change nothing; nothing is allocated. */
#include "gn_test.h"
#include "gni.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static uint32_t rng = 7;
static test_port counter;
static gn_context *context;

static int open_counting(void **state)
{
    const gn_port port = test_port_make(&counter);

    (void)state;
    return gn_context_create(&port, &context) != GN_OK;
}

static int close_counting(void **state)
{
    (void)state;
    gn_context_destroy(context);
    return counter.live_bytes != 0;
}

/* Boxes, whose corners are given three times each, or a ball-like torus section; vertex v moved by a function of its
 * place: what is at one place stays so. */
static void make_mesh(test_mesh *m)
{
    m->vertex_count = m->triangle_count = 0;
    for (int i = 0; i < 3; i++) {
        const float low[3] = {(float)(3 * i), -1, -1}, high[3] = {(float)(3 * i + 2), 1, 1};

        test_add_box(m, low, high, i == 1);
    }
    test_add_torus(m, 6.0f, 1.0f, 20, 12);
}

static void move(const test_mesh *m, float *out)
{
    float matrix[3][3];

    for (int i = 0; i < 9; i++)
        matrix[i / 3][i % 3] = (float)test_uniform(&rng, -1, 1) + (i % 4 == 0 ? 2.0f : 0.0f);
    for (size_t v = 0; v < m->vertex_count; v++)
        for (int i = 0; i < 3; i++) {
            const float *p = m->positions + 3 * v;

            out[3 * v + (size_t)i] = matrix[i][0] * p[0] + matrix[i][1] * p[1] + matrix[i][2] * p[2] + 100.0f;
        }
}

static void shapes_are_as_made_so(void **state)
{
    static test_mesh m;
    static float moved[3 * 12000];
    static int8_t casting[2][20000];
    static gn_edge edges[2][60000];

    (void)state;
    make_mesh(&m);
    for (int trial = 0; trial < 30; trial++) {
        gn_mesh_desc desc = test_desc(&m);
        gn_mesh *meshes[2];
        size_t counts[2], calls;
        double light[4] = {0, 0, 0, 1};

        assert_int_equal(gn_mesh_create(context, &desc, &meshes[0]), GN_OK);
        move(&m, moved);
        calls = counter.calls;
        assert_int_equal(gn_mesh_update(meshes[0], moved, 0), GN_OK);
        assert_int_equal(counter.calls, calls);
        desc.positions = moved;
        assert_int_equal(gn_mesh_create(context, &desc, &meshes[1]), GN_OK);
        assert_int_equal(meshes[0]->info.shape, 1);
        assert_memory_equal(meshes[0]->info.centre, meshes[1]->info.centre, 9 * sizeof(float));
        assert_memory_equal(meshes[0]->positions, meshes[1]->positions,
                            meshes[1]->info.vertex_count * 3 * sizeof(float));
        assert_true(meshes[0]->radius == meshes[1]->radius && meshes[0]->longest_edge == meshes[1]->longest_edge);
        assert_int_equal(meshes[1]->info.solid_part_count, 4);
        assert_int_equal(meshes[0]->info.solid_part_count, 3); /* the torus is no star */
        for (int n = 0; n < 10; n++) {
            for (int i = 0; i < 3; i++)
                light[i] = test_uniform(&rng, -80, 80);
            for (int i = 0; i < 2; i++)
                gn_facing(meshes[i], light, casting[i]);
            assert_memory_equal(casting[0], casting[1], meshes[0]->info.triangle_count);
            for (int i = 0; i < 2; i++) {
                gn_casting(meshes[i], light, casting[i]);
                assert_int_equal(gn_silhouette(meshes[i], casting[i], edges[i], 60000, &counts[i]), GN_OK);
            }
            assert_memory_equal(casting[0], casting[1], 36); /* of the boxes */
        }
        gn_mesh_destroy(meshes[0]);
        gn_mesh_destroy(meshes[1]);
    }
}

static void bad_shapes_change_nothing(void **state)
{
    static test_mesh m;
    static float moved[3 * 12000], kept[3 * 12000];
    gn_mesh_desc desc;
    gn_mesh *mesh;

    (void)state;
    make_mesh(&m);
    m.vertex_count = test_add_vertex(&m, m.positions[0], m.positions[1], m.positions[2]) + 1u;
    test_add_triangle(&m, (uint32_t)m.vertex_count - 1, 1, 2); /* a second vertex at the place of the first */
    desc = test_desc(&m);
    assert_int_equal(gn_mesh_create(context, &desc, &mesh), GN_OK);
    memcpy(kept, mesh->positions, mesh->info.vertex_count * 3 * sizeof *kept);
    memcpy(moved, m.positions, m.vertex_count * 3 * sizeof *moved);
    moved[0] += 1.0f;
    assert_int_equal(gn_mesh_update(mesh, moved, 0), GN_E_MESH);
    assert_non_null(strstr(gn_message(context), "were at one place"));
    moved[0] = NAN;
    assert_int_equal(gn_mesh_update(mesh, moved, 0), GN_E_MESH);
    assert_non_null(strstr(gn_message(context), "vertex 0 is not finite"));
    moved[0] = INFINITY;
    assert_int_equal(gn_mesh_update(mesh, moved, 0), GN_E_MESH);
    assert_int_equal(gn_mesh_update(mesh, moved, 10), GN_E_ARG);
    assert_non_null(strstr(gn_message(context), "10"));
    assert_int_equal(gn_mesh_update(mesh, NULL, 0), GN_E_ARG);
    assert_int_equal(gn_mesh_update(NULL, moved, 0), GN_E_ARG);
    assert_memory_equal(kept, mesh->positions, mesh->info.vertex_count * 3 * sizeof *kept);
    assert_int_equal(mesh->info.shape, 0);
    assert_int_equal(gn_mesh_update(mesh, m.positions, 12), GN_OK);
    assert_memory_equal(kept, mesh->positions, mesh->info.vertex_count * 3 * sizeof *kept);
    gn_mesh_destroy(mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(shapes_are_as_made_so),
                                       cmocka_unit_test(bad_shapes_change_nothing)};

    return cmocka_run_group_tests_name("update", tests, open_counting, close_counting);
}
