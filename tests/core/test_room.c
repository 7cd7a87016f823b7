/* test_room.c - a plan stays in the memory that gn_plan_bound() asks for, whatever the soup and the camera: what is behind it stays as it
 * was, and no array of the plan runs into what is after it. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "gn_matrix.h"
#include "gn_test.h"

#define GUARD 4096 /* bytes behind the plan */

/* Large loose triangles about a point: of a light there many volumes end on planes of their own, under an orthographic
 * camera. */
static void scatter(test_mesh *m, uint32_t *rng, uint32_t count)
{
    m->vertex_count = m->triangle_count = 0;
    for (uint32_t t = 0; t < count; t++) {
        const double at[3] = {test_uniform(rng, -1, 1), test_uniform(rng, -1, 1), test_uniform(rng, -1, 1)};
        uint32_t corners[3];

        for (int k = 0; k < 3; k++)
            corners[k] =
                test_add_vertex(m, (float)(at[0] + test_uniform(rng, -8, 8)), (float)(at[1] + test_uniform(rng, -8, 8)),
                                (float)(at[2] + test_uniform(rng, -8, 8)));
        test_add_triangle(m, corners[0], corners[1], corners[2]);
    }
}

static void check_plan(const gn_plan *plan)
{
    for (uint32_t i = 0; i < plan->record_count; i++) {
        const gn_record *r = &plan->records[i];

        assert_in_range(r->object, 0, plan->object_count - 1);
        assert_in_range(r->light, 0, plan->light_count - 1);
        assert_true(isfinite(r->near_matrix[15]) && isfinite(r->far_matrix[15]));
        assert_true(r->first_index + r->light_cap_count + r->side_count + r->dark_cap_count <= plan->index_count);
    }
    for (uint32_t i = 0; i < plan->step_count; i++)
        assert_in_range(plan->steps[i].kind, 0, GN_STEP_KIND_COUNT - 1);
}

static void plans_stay_in_their_memory(void **state)
{
    static test_mesh m;
    uint32_t rng = 77, planned = 0, ended = 0;

    (void)state;
    for (int trial = 0; trial < 60; trial++) {
        const gn_target target = TEST_TARGET(320, 240);
        gn_light lights[2] = {{.kind = GN_LIGHT_POINT}, {.kind = GN_LIGHT_DIRECTIONAL, .towards = {0.2, 1, 0.3}}};
        gn_object object = {.flags = GN_CASTS | GN_RECEIVES};
        gn_scene scene = {.lights = lights, .light_count = 2, .objects = &object, .object_count = 1, .target = target};
        gn_mesh *mesh;
        gn_mesh_desc desc;
        const gn_plan *plan;
        unsigned char *memory;
        size_t size;

        scatter(&m, &rng, 1 + (uint32_t)test_uniform(&rng, 0, 400));
        desc = test_desc(&m);
        assert_int_equal(gn_mesh_create(test_context, &desc, &mesh), GN_OK);
        object.mesh = mesh;
        gn_mat4_identity(object.model);
        gn_mat4_identity(scene.camera.world);
        scene.camera.world[14] = 12;
        scene.camera.orthographic = trial % 2;
        scene.camera.left = scene.camera.bottom = trial % 2 ? -6 : -0.6;
        scene.camera.right = scene.camera.top = -scene.camera.left;
        scene.camera.znear = 0.1;
        for (int k = 0; k < 3; k++)
            lights[0].position[k] = test_uniform(&rng, -0.2, 0.2);
        size = gn_plan_bound(&scene);
        memory = malloc(size + GUARD);
        assert_non_null(memory);
        memset(memory + size, 0x5a, GUARD);
        if (gn_plan_make(test_context, &scene, memory, size, &plan) == GN_OK) {
            planned++;
            ended += plan->record_count > 40;
            check_plan(plan);
        } else {
            assert_true(scene.camera.orthographic); /* which a library without culling refuses */
        }
        for (size_t i = 0; i < GUARD; i++)
            assert_int_equal(memory[size + i], 0x5a);
        free(memory);
        gn_mesh_destroy(mesh);
    }
    assert_true(planned >= 30);
    assert_true(planned == 30 || ended > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(plans_stay_in_their_memory)};

    return cmocka_run_group_tests(tests, test_open_context, test_close_context);
}
