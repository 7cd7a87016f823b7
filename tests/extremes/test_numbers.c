/* test_numbers.c - NaN, infinities, the greatest and the smallest numbers in every argument of every public function
 * that takes numbers: an error code with a sentence, or a result in which every number is one. Run it under the
 * sanitizers. */
#include "frame.h"
#include "gn_matrix.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double strange[] = {NAN,    INFINITY, -INFINITY, DBL_MAX, -DBL_MAX, DBL_MIN, 4.9e-324, -4.9e-324, 1e300,
                                 -1e300, 1e-300,   1e40,      -1e40,   1e-40,    1e101,   0.0,      -0.0,      1e18};
enum { STRANGE = sizeof strange / sizeof strange[0] };

static void check_plan(const gn_plan *plan)
{
    const size_t length = gn_plan_json(plan, NULL, 0);
    char *text = malloc(length + 1);

    for (uint32_t i = 0; i < plan->object_count; i++)
        for (int k = 0; k < 16; k++)
            assert_true(isfinite(plan->objects[i].matrix[k]));
    for (uint32_t r = 0; r < plan->record_count; r++)
        for (int k = 0; k < 16; k++)
            assert_true(isfinite(plan->records[r].far_matrix[k]));
    for (uint32_t l = 0; l < plan->light_count; l++) {
        const uint32_t *s = plan->lights[l].scissor;

        assert_true(s[0] + s[2] <= plan->target.width && s[1] + s[3] <= plan->target.height);
        assert_true(plan->lights[l].depth_bounds[0] >= 0.0 && plan->lights[l].depth_bounds[1] <= 1.0);
        assert_true(gn_plan_explain_light(plan, l, NULL, 0) > 0);
    }
    assert_true(isfinite(plan->clear_depth));
    assert_int_equal(gn_plan_json(plan, text, length + 1), length);
    assert_null(strstr(text, "nan"));
    assert_null(strstr(text, "inf,"));
    free(text);
}

/* The numbers of a scene, one after another; NULL at the end. */
static double *number_of(test_frame *f, int index)
{
    gn_camera *c = &f->scene.camera;
    double *const singles[] = {&c->left, &c->right, &c->bottom, &c->top, &c->znear, &c->zfar, &f->scene.least_light};
    enum { SINGLES = 7, LIGHT = 3 + 3 + 2 + 3 + 3 + 3 + 3 };

    if (index < 16)
        return &c->world[index];
    index -= 16;
    if (index < SINGLES)
        return singles[index];
    index -= SINGLES;
    for (int l = 0; l < 2; l++, index -= LIGHT) {
        gn_light *light = &f->lights[l];
        double *const arrays[] = {light->position,    light->towards, light->color,
                                  light->attenuation, light->box_min, light->box_max};

        if (index < 18 && index >= 0)
            return arrays[index / 3] + index % 3;
        if (index == 18)
            return &light->cone;
        if (index == 19)
            return &light->range;
    }
    for (int o = 0; o < 2; o++, index -= 16)
        if (index >= 0 && index < 16)
            return &f->objects[o].model[index];
    return NULL;
}

static void scenes_take_any_number(void **state)
{
    uint32_t planned = 0, refused = 0;
    test_frame f;

    (void)state;
    for (int kind = 0; kind < 6; kind++) {
        const gn_target target = TEST_TARGET(64, 48);

        assert_int_equal(test_frame_make(&f, test_context, NULL, target), GN_OK);
        f.lights[0].kind = kind % 2 ? GN_LIGHT_SPOT : GN_LIGHT_POINT;
        f.lights[0].towards[1] = 1;
        f.lights[0].cone = 0.5;
        f.lights[0].color[0] = 0.5;
        f.lights[0].attenuation[2] = 1;
        f.scene.method = kind == 4 ? GN_METHOD_ZFAIL : GN_METHOD_AUTO;
        f.scene.target.hidden = kind == 5 ? 1u << GN_CAN_W0 | 1u << GN_CAN_DEPTH_CLAMP : 0;
        if (kind == 2 || kind == 3) {
            f.scene.camera.orthographic = 1;
            f.scene.camera.left = f.scene.camera.bottom = -4;
            f.scene.camera.right = f.scene.camera.top = 4;
        }
        for (int n = 0; number_of(&f, n); n++) {
            double *number = number_of(&f, n);
            const double was = *number;

            for (int v = 0; v < STRANGE; v++) {
                const size_t size = gn_plan_bound(&f.scene);
                void *memory;
                gn_result result;

                *number = strange[v];
                memory = malloc(size);
                result = gn_plan_make(test_context, &f.scene, memory, size, &f.plan);
                if (result == GN_OK) {
                    check_plan(f.plan);
                    planned++;
                } else {
                    if (result != GN_E_ARG && result != GN_E_DEVICE)
                        fail_msg("number %d is %g: result %d, %s", n, strange[v], (int)result,
                                 gn_message(test_context));
                    assert_true(strlen(gn_message(test_context)) > 10);
                    refused++;
                }
                if (!isfinite(strange[v]) && n != 16 + 6 + 0 && result == GN_OK)
                    fail_msg("number %d is %g, and there is a plan", n, strange[v]);
                free(memory);
            }
            *number = was;
        }
        test_frame_drop(&f, NULL);
    }
    print_message("           %lu plans, %lu refused\n", (unsigned long)planned, (unsigned long)refused);
    assert_true(planned > 2000 && refused > 2000);
}

static void meshes_take_any_number(void **state)
{
    static const float numbers[] = {NAN,      INFINITY,  -INFINITY, FLT_MAX, -FLT_MAX, FLT_MIN,
                                    1.4e-45f, -1.4e-45f, 1e30f,     0,       -0.0f};
    static test_mesh m;
    static const float low[3] = {-1, -1, -1}, high[3] = {1, 1, 1};

    (void)state;
    for (int i = 0; i < 24; i++)
        for (size_t v = 0; v < sizeof numbers / sizeof numbers[0]; v++) {
            gn_mesh_desc desc;
            gn_mesh *mesh;
            gn_result result;
            int8_t facing[12];

            m.vertex_count = m.triangle_count = 0;
            test_add_box(&m, low, high, 0);
            m.positions[i] = numbers[v];
            desc = test_desc(&m);
            result = gn_mesh_create(test_context, &desc, &mesh);
            if (!isfinite(numbers[v])) {
                assert_int_equal(result, GN_E_MESH);
                assert_null(mesh);
                assert_non_null(strstr(gn_message(test_context), "vertex"));
                continue;
            }
            assert_int_equal(result, GN_OK);
            for (int s = 0; s < STRANGE; s++)
                for (int k = 0; k < 4; k++) {
                    double light[4] = {1, 2, 3, 1};

                    light[k] = strange[s];
                    gn_facing(mesh, light, facing);
                    gn_casting(mesh, light, facing);
                    for (int t = 0; t < 12; t++)
                        assert_in_range(facing[t] + 1, 0, 2);
                }
            {
                gn_object object = {.mesh = mesh, .flags = GN_CASTS | GN_RECEIVES};
                gn_light light = {.kind = GN_LIGHT_POINT, .position = {2, 5, 3}};
                gn_scene scene;
                const gn_plan *plan;
                size_t size;
                void *memory;

                memset(&scene, 0, sizeof scene);
                gn_mat4_identity(object.model);
                gn_mat4_identity(scene.camera.world);
                scene.camera.world[14] = 8;
                scene.camera.left = scene.camera.bottom = -0.5;
                scene.camera.right = scene.camera.top = 0.5;
                scene.camera.znear = 0.1;
                scene.lights = &light;
                scene.objects = &object;
                scene.light_count = scene.object_count = 1;
                scene.target = (gn_target)TEST_TARGET(64, 48);
                size = gn_plan_bound(&scene);
                memory = malloc(size);
                if (gn_plan_make(test_context, &scene, memory, size, &plan) == GN_OK)
                    check_plan(plan);
                free(memory);
            }
            gn_mesh_destroy(mesh);
        }
}

/* Objects by themselves, soft lights, matrices: no number traps. */
static void the_rest_takes_any_number(void **state)
{
    const gn_target target = TEST_TARGET(64, 48);
    test_frame f;
    gn_light parts[4];
    int8_t facing[12];

    (void)state;
    assert_int_equal(test_frame_make(&f, test_context, NULL, target), GN_OK);
    for (int s = 0; s < STRANGE; s++) {
        double m[16], out[16];

        for (int k = 0; k < 16; k++) {
            const double was = f.objects[0].model[k];

            f.objects[0].model[k] = strange[s];
            for (int l = 0; l < 2; l++) {
                gn_object_facing(&f.objects[0], &f.lights[l], facing);
                gn_object_casting(&f.objects[0], &f.lights[l], facing);
            }
            f.objects[0].model[k] = was;
            gn_mat4_identity(m);
            m[k] = strange[s];
            gn_mat4_multiply(out, m, m);
            gn_mat4_determinant3(m);
            gn_mat4_invert_affine(out, m);
        }
        for (int k = 0; k < 3; k++) {
            gn_light light = f.lights[k % 2];
            const gn_result result = gn_light_soften(test_context, &light, strange[s], 4, parts);

            assert_int_equal(result, isfinite(strange[s]) && strange[s] >= 0.0 ? GN_OK : GN_E_ARG);
            light.position[k] = light.towards[k] = strange[s];
            gn_light_soften(test_context, &light, 1.0, 4, parts);
        }
    }
    test_frame_drop(&f, NULL);
}

/* NULL and numbers out of range, where there is no error code: nothing, or an empty answer. */
static void nothing_is_lawful(void **state)
{
    char text[4] = "xyz";
    uint32_t set = 0;

    (void)state;
    assert_int_equal(gn_plan_bound(NULL), 0);
    assert_null(gn_method_describe((gn_method)-1));
    assert_null(gn_method_describe((gn_method)99));
    assert_int_equal(gn_method_by_name("zfail", NULL), GN_METHOD_TOTAL);
    assert_string_equal(gn_plan_method_name(NULL, 0), "");
    assert_int_equal(gn_plan_json(NULL, text, 4), 0);
    assert_int_equal(gn_plan_explain_light(NULL, 0, text, 4), 0);
    assert_int_equal(gn_plan_explain_caster(NULL, 0, 0, text, 4), 0);
    assert_int_equal(gn_plan_explain_warning(NULL, GN_WARN_DEPTH, NULL, 4), 0);
    assert_string_equal(gn_capability_name((gn_capability)-1), "");
    assert_string_equal(gn_capability_summary((gn_capability)99), "");
    assert_null(gn_capability_parse(NULL, &set));
    assert_int_equal(gn_plan_make(test_context, NULL, text, 4, NULL), GN_E_ARG);
    assert_int_equal(gn_plan_make(NULL, NULL, NULL, 0, NULL), GN_E_ARG);
    assert_int_equal(gn_mesh_create(test_context, NULL, NULL), GN_E_ARG);
    assert_int_equal(gn_silhouette(NULL, NULL, NULL, 0, NULL), GN_E_ARG);
    assert_int_equal(gn_light_soften(test_context, NULL, 1, 1, NULL), GN_E_ARG);
    assert_int_equal(gn_context_create(NULL, NULL), GN_E_ARG);
    assert_string_equal(gn_message(NULL), "no context");
    assert_null(gn_context_port(NULL));
    gn_mesh_destroy(NULL);
    gn_context_destroy(NULL);
    assert_int_equal(gn_gles_begin(NULL, NULL), GN_E_ARG);
    assert_int_equal(gn_gles_next(NULL, NULL), 0);
    assert_int_equal(gn_gles_create(test_context, NULL, NULL), GN_E_ARG);
    assert_int_equal(gn_gles_upload(NULL, NULL), GN_E_ARG);
    assert_int_equal(gn_gles_describe_target(NULL, 0, 0, NULL, NULL), GN_E_ARG);
    gn_gles_unload(NULL, NULL);
    gn_gles_forget(NULL);
    gn_gles_destroy(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(scenes_take_any_number), cmocka_unit_test(meshes_take_any_number),
        cmocka_unit_test(the_rest_takes_any_number), cmocka_unit_test(nothing_is_lawful)};

    return cmocka_run_group_tests_name("numbers", tests, test_open_context, test_close_context);
}
