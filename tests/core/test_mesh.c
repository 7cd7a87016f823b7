/* test_mesh.c - welding, edges, parts, chunks: what a mesh is said to be, by count and by law. */
#include "gn_test.h"
#include "gni.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static test_mesh m;

static void clear(void)
{
    m.vertex_count = m.triangle_count = 0;
}

static gn_mesh *create(void)
{
    const gn_mesh_desc desc = test_desc(&m);
    gn_mesh *mesh = NULL;

    assert_int_equal(gn_mesh_create(test_context, &desc, &mesh), GN_OK);
    return mesh;
}

static const float low[3] = {0, 0, 0}, high[3] = {1, 2, 3};

/* A box whose every triangle has vertices of its own welds to 8 vertices, 18 edges, one solid part. */
static void unshared_vertices_weld(void **state)
{
    test_mesh box;
    gn_mesh *mesh;

    (void)state;
    clear();
    box.vertex_count = box.triangle_count = 0;
    test_add_box(&box, low, high, 0);
    for (size_t i = 0; i < 3 * box.triangle_count; i++) {
        const float *p = box.positions + 3 * (size_t)box.indices[i];

        test_add_vertex(&m, i % 2 && p[0] == 0.0f ? -0.0f : p[0], p[1], p[2]); /* -0 is 0 */
        if (i % 3 == 2)
            test_add_triangle(&m, (uint32_t)i - 2, (uint32_t)i - 1, (uint32_t)i);
    }
    mesh = create();
    assert_int_equal(gn_mesh_get_info(mesh)->vertex_count, 8);
    assert_int_equal(gn_mesh_get_info(mesh)->edge_count, 18);
    assert_int_equal(gn_mesh_get_info(mesh)->part_count, 1);
    assert_int_equal(gn_mesh_get_info(mesh)->solid_part_count, 1);
    assert_int_equal(gn_mesh_get_info(mesh)->planar, 0);
    gn_mesh_destroy(mesh);
}

/* Solid, or not: by cases that differ in one thing. */
static void solid_parts_are_told(void **state)
{
    static const float inner_low[3] = {0.25f, 0.25f, 0.25f}, inner_high[3] = {0.5f, 0.5f, 0.5f};
    static const float over_low[3] = {0.5f, 1, 1}, over_high[3] = {2, 1.5f, 2};
    gn_mesh *mesh;

    (void)state;
    clear(); /* wound inward: as solid as outward */
    test_add_box(&m, low, high, 1);
    mesh = create();
    assert_int_equal(gn_mesh_get_info(mesh)->solid_part_count, 1);
    assert_int_equal(gn_mesh_get_info(mesh)->outward_part_count, 0);
    gn_mesh_destroy(mesh);
    m.triangle_count--; /* a hole */
    mesh = create();
    assert_int_equal(gn_mesh_get_info(mesh)->part_count, 1);
    assert_int_equal(gn_mesh_get_info(mesh)->solid_part_count, 0);
    gn_mesh_destroy(mesh);
    clear(); /* one triangle turned round */
    test_add_box(&m, low, high, 0);
    m.indices[0] = m.indices[1];
    m.indices[1] = 0;
    mesh = create();
    assert_int_equal(gn_mesh_get_info(mesh)->solid_part_count, 0);
    gn_mesh_destroy(mesh);
    clear(); /* one box within another, one through another: parts of their own, each solid */
    test_add_box(&m, low, high, 0);
    test_add_box(&m, inner_low, inner_high, 1);
    test_add_box(&m, over_low, over_high, 0);
    mesh = create();
    assert_int_equal(gn_mesh_get_info(mesh)->part_count, 3);
    assert_int_equal(gn_mesh_get_info(mesh)->solid_part_count, 3);
    gn_mesh_destroy(mesh);
    clear();
    test_add_torus(&m, 2.0f, 0.5f, 24, 12);
    mesh = create();
    assert_int_equal(gn_mesh_get_info(mesh)->solid_part_count, 1);
    gn_mesh_destroy(mesh);
    m.positions[0] = -4.0f; /* one vertex pulled through the other side: closed, but through itself */
    mesh = create();
    assert_int_equal(gn_mesh_get_info(mesh)->part_count, 1);
    assert_int_equal(gn_mesh_get_info(mesh)->solid_part_count, 0);
    gn_mesh_destroy(mesh);
}

/* Finely tessellated flat faces touch their neighbours in lines and points, and are solid all the same. */
static void flat_neighbours_are_no_contact(void **state)
{
    gn_mesh *mesh;
    uint32_t grid[6][6][6];

    (void)state;
    clear();
    for (int x = 0; x < 6; x++)
        for (int y = 0; y < 6; y++)
            for (int z = 0; z < 6; z++)
                if (x % 5 == 0 || y % 5 == 0 || z % 5 == 0)
                    grid[x][y][z] = test_add_vertex(&m, (float)x / 5, 0.3f * (float)y, (float)(2 * x + z));
    for (int axis = 0; axis < 3; axis++)
        for (int side = 0; side < 2; side++)
            for (int u = 0; u < 5; u++)
                for (int v = 0; v < 5; v++) {
                    uint32_t q[4];

                    for (int k = 0; k < 4; k++) {
                        int at[3];

                        at[axis] = 5 * side;
                        at[(axis + 1) % 3] = u + (k == 1 || k == 2);
                        at[(axis + 2) % 3] = v + (k >= 2);
                        q[side ? k : 3 - k] = grid[at[0]][at[1]][at[2]];
                    }
                    test_add_triangle(&m, q[0], q[1], q[2]);
                    test_add_triangle(&m, q[0], q[2], q[3]);
                }
    mesh = create();
    assert_int_equal(gn_mesh_get_info(mesh)->solid_part_count, 1);
    gn_mesh_destroy(mesh);
}

/* Subtracting the centre never rounds, near or far from the origin. */
static void the_centre_is_exact(void **state)
{
    (void)state;
    for (int trial = 0; trial < 200; trial++) {
        uint32_t rng = (uint32_t)trial * 7919u + 1;
        const double offset = trial % 2 ? 1e5 : 0.5;
        const gn_mesh_info *info;
        gn_mesh *mesh;

        clear();
        for (int i = 0; i < 30; i++) {
            const float x = (float)(offset + test_uniform(&rng, -3, 3)), y = (float)test_uniform(&rng, 1, 7);

            test_add_vertex(&m, x, y, (float)-test_uniform(&rng, 7, 8));
            if (i % 3 == 2)
                test_add_triangle(&m, (uint32_t)i - 2, (uint32_t)i - 1, (uint32_t)i);
        }
        mesh = create();
        info = gn_mesh_get_info(mesh);
        for (uint32_t i = 0; i < 3 * info->triangle_count; i++)
            for (size_t axis = 0; axis < 3; axis++) {
                const float given = m.positions[3 * (size_t)m.indices[i] + axis];
                const float held = info->positions[3 * (size_t)info->triangles[i] + axis];

                assert_true((double)held + (double)info->centre[axis] == (double)given);
                assert_true(given - info->centre[axis] == held);
            }
        if (trial % 2)
            assert_true(fabsf(info->centre[0] - 1e5f) < 4.0f);
        gn_mesh_destroy(mesh);
    }
}

/* Chunks partition the triangles, have at most 32,768 vertices, and their corners name the right welded vertices. */
static void chunks_reach_everything(void **state)
{
    const uint32_t side = 300; /* 90,000 vertices */
    float *positions = malloc((size_t)side * side * 3 * sizeof *positions);
    uint32_t *indices = malloc((size_t)(side - 1) * (side - 1) * 6 * sizeof *indices);
    gn_mesh_desc desc = {positions, (size_t)side * side, 0, indices, 0, 0.0};
    const gn_mesh_info *info;
    uint32_t triangles = 0;
    gn_mesh *mesh;

    (void)state;
    assert_non_null(positions);
    assert_non_null(indices);
    for (uint32_t y = 0; y < side; y++)
        for (uint32_t x = 0; x < side; x++) {
            float *p = positions + 3 * ((size_t)y * side + x);

            p[0] = (float)x;
            p[1] = (float)(x * y % 7);
            p[2] = (float)y;
            if (x + 1 < side && y + 1 < side) {
                const uint32_t a = y * side + x, quad[6] = {a, a + side, a + 1, a + 1, a + side, a + side + 1};

                memcpy(indices + 3 * desc.triangle_count, quad, sizeof quad);
                desc.triangle_count += 2;
            }
        }
    assert_int_equal(gn_mesh_create(test_context, &desc, &mesh), GN_OK);
    info = gn_mesh_get_info(mesh);
    assert_true(info->chunk_count >= 3);
    for (uint32_t c = 0; c < info->chunk_count; c++) {
        const gn_chunk *chunk = &info->chunks[c];

        assert_true(chunk->vertex_count <= GN_CHUNK_VERTICES);
        assert_int_equal(chunk->first_triangle, triangles);
        triangles += chunk->triangle_count;
        for (uint32_t t = chunk->first_triangle; t < triangles; t++)
            for (size_t k = 0; k < 3; k++)
                assert_int_equal(info->chunk_vertices[chunk->first_vertex + info->corners[3 * (size_t)t + k] / 2],
                                 info->triangles[3 * (size_t)mesh->order[t] + k]);
    }
    assert_int_equal(triangles, info->triangle_count);
    gn_mesh_destroy(mesh);
    free(positions);
    free(indices);
}

/* Every refusal has its code, names the offender, and leaves no mesh. */
static void bad_input_is_refused(void **state)
{
    gn_mesh_desc desc;
    gn_mesh *mesh = (gn_mesh *)&desc;

    (void)state;
    clear();
    test_add_box(&m, low, high, 0);
    desc = test_desc(&m);
    m.indices[20] = 8;
    assert_int_equal(gn_mesh_create(test_context, &desc, &mesh), GN_E_MESH);
    assert_null(mesh);
    assert_non_null(strstr(gn_message(test_context), "triangle 6 names vertex 8 of 8"));
    m.indices[20] = 7;
    m.positions[16] = NAN;
    assert_int_equal(gn_mesh_create(test_context, &desc, &mesh), GN_E_MESH);
    assert_non_null(strstr(gn_message(test_context), "vertex 5"));
    m.positions[16] = -INFINITY;
    assert_int_equal(gn_mesh_create(test_context, &desc, &mesh), GN_E_MESH);
    m.positions[16] = 0;
    desc.stride = 10;
    assert_int_equal(gn_mesh_create(test_context, &desc, &mesh), GN_E_ARG);
    assert_non_null(strstr(gn_message(test_context), "10"));
    desc.stride = 0;
    desc.triangle_count = (size_t)GN_MAX_TRIANGLES + 1;
    assert_int_equal(gn_mesh_create(test_context, &desc, &mesh), GN_E_ARG);
    desc = test_desc(&m);
    desc.positions = NULL;
    assert_int_equal(gn_mesh_create(test_context, &desc, &mesh), GN_E_ARG);
    assert_int_equal(gn_mesh_create(test_context, NULL, &mesh), GN_E_ARG);
    assert_int_equal(gn_mesh_create(test_context, &desc, NULL), GN_E_ARG);
    assert_int_equal(gn_mesh_create(NULL, &desc, &mesh), GN_E_ARG);
    gn_mesh_destroy(NULL);
}

/* No triangle, only degenerate ones, the same one five times: lawful and harmless. */
static void odd_meshes_are_lawful(void **state)
{
    int8_t casting[8];
    const double light[4] = {0, 0, 5, 1};
    gn_edge edges[24];
    gn_mesh *mesh;
    size_t count;

    (void)state;
    clear();
    mesh = create();
    assert_int_equal(gn_mesh_get_info(mesh)->part_count, 0);
    assert_true(gn_mesh_get_info(mesh)->centre[0] == 0.0f && gn_mesh_get_info(mesh)->box_max[2] == 0.0f);
    gn_mesh_destroy(mesh);
    test_add_vertex(&m, 0, 0, 0);
    test_add_vertex(&m, 1, 0, 0);
    test_add_vertex(&m, 0, 1, 0);
    test_add_triangle(&m, 0, 0, 1);
    test_add_triangle(&m, 2, 2, 2);
    mesh = create();
    gn_casting(mesh, light, casting);
    assert_int_equal(casting[0] | casting[1], 0);
    gn_mesh_destroy(mesh);
    for (int i = 0; i < 5; i++)
        test_add_triangle(&m, 0, 1, 2);
    mesh = create();
    gn_casting(mesh, light, casting);
    assert_int_equal(gn_silhouette(mesh, casting, edges, 24, &count), GN_OK);
    assert_int_equal(count, 3); /* multiplicity five */
    assert_int_equal(edges[0].weight, 5);
    edges[2].weight = 99;
    assert_int_equal(gn_silhouette(mesh, casting, edges, 2, &count), GN_E_SPACE);
    assert_int_equal(count, 3);
    assert_int_equal(edges[2].weight, 99); /* nothing is written beyond the capacity */
    assert_int_equal(gn_mesh_get_info(mesh)->planar, 2);
    gn_mesh_destroy(mesh);
    test_add_triangle(&m, 0, 2, 1);
    mesh = create();
    assert_int_equal(gn_mesh_get_info(mesh)->planar, 1); /* one is wound the other way */
    gn_mesh_destroy(mesh);
}

/* Each allocation fails in turn: an error code, no mesh, and not a byte left. */
static void every_allocation_may_fail(void **state)
{
    test_port counter = {0, 0, 0};
    const gn_port port = test_port_make(&counter);
    size_t fail_at = 0;
    gn_result result = GN_E_MEMORY;

    (void)state;
    clear();
    test_add_torus(&m, 2.0f, 0.5f, 12, 8);
    while (result != GN_OK) {
        gn_context *failing = NULL;
        gn_mesh *mesh = NULL;
        const gn_mesh_desc desc = test_desc(&m);

        counter.calls = 0;
        counter.fail_at = ++fail_at;
        result = gn_context_create(&port, &failing);
        if (result == GN_OK)
            result = gn_mesh_create(failing, &desc, &mesh);
        assert_true(result == GN_OK || (result == GN_E_MEMORY && !mesh));
        gn_mesh_destroy(mesh);
        gn_context_destroy(failing);
        assert_int_equal(counter.live_bytes, 0);
    }
    assert_true(fail_at > 15);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(unshared_vertices_weld),         cmocka_unit_test(solid_parts_are_told),
        cmocka_unit_test(flat_neighbours_are_no_contact), cmocka_unit_test(the_centre_is_exact),
        cmocka_unit_test(chunks_reach_everything),        cmocka_unit_test(bad_input_is_refused),
        cmocka_unit_test(odd_meshes_are_lawful),          cmocka_unit_test(every_allocation_may_fail),
    };

    return cmocka_run_group_tests_name("mesh", tests, test_open_context, test_close_context);
}
