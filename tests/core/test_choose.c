/* test_choose.c - the chain: which way a frame is drawn when capabilities are missing, and what the plan says of it. */
#include "frame.h"

#include <stdlib.h>
#include <string.h>

#include "gn_matrix.h"

static test_frame f;

static int set_up(void **state)
{
    (void)state;
    return test_frame_make(&f, test_context, NULL, (gn_target)TEST_TARGET(64, 48)) != GN_OK;
}

static int tear_down(void **state)
{
    (void)state;
    test_frame_drop(&f, NULL);
    return 0;
}

static gn_result plan(void)
{
    const size_t size = gn_plan_bound(&f.scene);

    if (size > f.size) {
        free(f.memory);
        f.memory = malloc(size);
        f.size = size;
    }
    return gn_plan_make(test_context, &f.scene, f.memory, f.size, &f.plan);
}

#define HIDE(capability) (f.scene.target.hidden |= 1u << (capability))

static void says(const char *words)
{
    if (!strstr(f.plan->lights[0].reason, words))
        fail_msg("\"%s\" does not say \"%s\"", f.plan->lights[0].reason, words);
}

static void names_are_read_and_written(void **state)
{
    int one_sided = 7;

    (void)state;
    for (int m = 0; m < GN_METHOD_TOTAL; m++) {
        assert_int_equal(gn_method_by_name(gn_method_describe((gn_method)m)->name, &one_sided), m);
        assert_int_equal(one_sided, 0);
    }
    assert_int_equal(gn_method_by_name("zfail/one-sided", &one_sided), GN_METHOD_ZFAIL);
    assert_int_equal(one_sided, 1);
    assert_int_equal(gn_method_by_name("zpass/one-sided", &one_sided), GN_METHOD_ZPASS);
    assert_int_equal(gn_method_by_name("auto/one-sided", &one_sided), GN_METHOD_TOTAL);
    assert_int_equal(gn_method_by_name("zfail/one-sided/one-sided", &one_sided), GN_METHOD_TOTAL);
    assert_int_equal(gn_method_by_name("zfail/", &one_sided), GN_METHOD_TOTAL);
    assert_int_equal(gn_method_by_name(NULL, &one_sided), GN_METHOD_TOTAL);
}

static void lists_of_capabilities_are_parsed(void **state)
{
    uint32_t set = 0;

    (void)state;
    for (int c = 0; c < GN_CAPABILITY_COUNT; c++) {
        set = 0;
        assert_null(gn_capability_parse(gn_capability_name((gn_capability)c), &set));
        assert_int_equal(set, 1u << c);
    }
    set = 0;
    assert_null(gn_capability_parse("stencil-wrap,w0", &set));
    assert_int_equal(set, 1u << GN_CAN_STENCIL_WRAP | 1u << GN_CAN_W0);
    assert_null(gn_capability_parse("", &set));
    assert_null(gn_capability_parse(NULL, &set));
    assert_string_equal(gn_capability_parse("w0,stencils,alpha", &set), "stencils,alpha");
    assert_string_equal(gn_capability_parse("w0,", &set), ",");
    assert_string_equal(gn_capability_parse(",w0", &set), ",w0");
    assert_string_equal(gn_capability_parse("stenci", &set), "stenci");
    assert_int_equal(set, 1u << GN_CAN_STENCIL_WRAP | 1u << GN_CAN_W0);
    assert_string_equal(gn_capability_name(GN_CAPABILITY_COUNT), "");
}

static void the_chain_goes_down_step_by_step(void **state)
{
    (void)state;
    assert_int_equal(plan(), GN_OK);
    assert_string_equal(gn_plan_method_name(f.plan, 0), "stencil");
    assert_true(f.plan->lights[0].stencil.two_sided && f.plan->lights[0].stencil.wrap &&
                f.plan->lights[0].stencil.reference == 0);

    HIDE(GN_CAN_TWO_SIDED_STENCIL);
    assert_int_equal(plan(), GN_OK);
    assert_string_equal(gn_plan_method_name(f.plan, 0), "stencil/one-sided");
    assert_true(!f.plan->lights[0].stencil.two_sided && f.plan->lights[0].stencil.wrap);
    says("one side at a time, since two-sided-stencil is hidden");
    assert_true(f.plan->lights[0].stencil.discard);

    f.scene.target.proven &= ~(1u << GN_CAN_STENCIL_WRAP);
    assert_int_equal(plan(), GN_OK);
    assert_true(!f.plan->lights[0].stencil.wrap && f.plan->lights[0].stencil.reference == 128);
    assert_int_equal(f.plan->lights[0].stencil.low, -128);
    assert_int_equal(f.plan->lights[0].stencil.high, 127);
    says("since stencil-wrap fails its proof");

    f.scene.target.advertised &= ~(1u << GN_CAN_STENCIL);
    f.scene.target.proven &= ~(1u << GN_CAN_STENCIL);
    assert_int_equal(plan(), GN_OK); /* no masks in textures for a host that does not read them */
    assert_string_equal(gn_plan_method_name(f.plan, 0), "signed");
    assert_int_equal(f.plan->mask, GN_MASK_ALPHA);
    says("count makes its mask in a texture, which the host does not read");

    f.scene.reads_masks = 1;
    assert_int_equal(plan(), GN_OK);
    assert_string_equal(gn_plan_method_name(f.plan, 0), "count");
    assert_int_equal(f.plan->mask, GN_MASK_TEXTURE);
    assert_true(f.plan->lights[0].color.both_sides && f.plan->lights[0].color.limit == 255);
    says("stencil needs stencil, which is not offered");

    HIDE(GN_CAN_FRONT_FACING);
    assert_int_equal(plan(), GN_OK);
    assert_string_equal(gn_plan_method_name(f.plan, 0), "count/one-sided");
    assert_true(!f.plan->lights[0].color.both_sides && !f.plan->lights[0].color.discard);
    HIDE(GN_CAN_FBO_RGBA8);
    assert_int_equal(plan(), GN_OK);
    assert_int_equal(f.plan->image.format, GN_FORMAT_RGB565);
    assert_int_equal(f.plan->lights[0].color.limit, 31);

    HIDE(GN_CAN_FBO_RGB565);
    HIDE(GN_CAN_FBO_RGB5A1);
    HIDE(GN_CAN_FBO_RGBA4);
    assert_int_equal(plan(), GN_OK);
    assert_string_equal(gn_plan_method_name(f.plan, 0), "signed");
    assert_int_equal(f.plan->lights[0].color.place, GN_PLACE_ALPHA);
    assert_int_equal(f.plan->lights[0].color.limit, 127);
    says("count needs framebuffer objects: fbo-rgba8 is hidden");

    HIDE(GN_CAN_BLEND_SUBTRACT);
    assert_int_equal(plan(), GN_OK);
    assert_string_equal(gn_plan_method_name(f.plan, 0), "alpha");
    assert_int_equal(f.plan->lights[0].color.limit, 8);
    says("signed needs blend-subtract, which is hidden");

    HIDE(GN_CAN_ALPHA);
    assert_int_equal(plan(), GN_OK);
    assert_string_equal(gn_plan_method_name(f.plan, 0), "screen");
    assert_int_equal(f.plan->lights[0].color.place, GN_PLACE_COLOR);
    f.scene.target.red_bits = 5;
    assert_int_equal(plan(), GN_OK);
    assert_int_equal(f.plan->lights[0].color.limit, 5);

    HIDE(GN_CAN_BLEND_ROUNDING);
    assert_int_equal(plan(), GN_E_DEVICE);
    assert_non_null(strstr(gn_message(test_context), "stencil, which is not offered, and none without"));
}

/* Whatever is asked for of a target that can do nothing is refused, and its bound is a number. */
static void what_can_do_nothing_is_refused(void **state)
{
    const gn_target kept = f.scene.target;

    (void)state;
    f.scene.target.proven = f.scene.target.advertised = 0;
    for (int reads = 0; reads < 2; reads++)
        for (int m = 0; m < GN_METHOD_TOTAL; m++) {
            f.scene.reads_masks = reads;
            f.scene.method = (gn_method)m;
            assert_true(gn_plan_bound(&f.scene) > 0);
            f.memory = realloc(f.memory, gn_plan_bound(&f.scene));
            f.size = gn_plan_bound(&f.scene);
            assert_int_equal(gn_plan_make(test_context, &f.scene, f.memory, f.size, &f.plan), GN_E_DEVICE);
        }
    f.scene.target = kept;
    f.scene.method = GN_METHOD_AUTO;
    f.scene.reads_masks = 0;
}

static void one_sided_may_be_asked_for(void **state)
{
    (void)state;
    f.scene.method = GN_METHOD_ZPASS;
    f.scene.one_sided = 1;
    assert_int_equal(plan(), GN_OK);
    assert_string_equal(gn_plan_method_name(f.plan, 0), "zpass/one-sided");
    says("one side at a time, as asked for");
    HIDE(GN_CAN_FRONT_FACING);
    assert_int_equal(plan(), GN_OK);
    assert_int_equal(f.plan->lights[0].stencil.discard, 0);
    says("culled, which may lose slivers, since front-facing is hidden");
    f.scene.one_sided = 0;
    f.scene.method = GN_METHOD_AUTO;
}

/* Every far vertex, through the float matrix of its record, lies in front of the far plane. */
static void far_vertices_are_inside(void)
{
    assert_true(f.plan->record_count > 0);
    for (uint32_t r = 0; r < f.plan->record_count; r++) {
        const gn_record *record = &f.plan->records[r];
        const gn_mesh_info *info = gn_mesh_get_info(f.plan->objects[record->object].mesh);
        const gn_chunk *chunk = &info->chunks[record->chunk];

        for (uint32_t i = 0; i < record->side_count + record->dark_cap_count; i++) {
            const uint16_t index = f.plan->indices[record->first_index + i];
            const float *m = record->far_matrix;
            const float *v = info->positions + 3 * (size_t)info->chunk_vertices[chunk->first_vertex + index / 2];
            const float z = m[2] * v[0] + m[6] * v[1] + m[10] * v[2] + m[14];
            const float w = m[3] * v[0] + m[7] * v[1] + m[11] * v[2] + m[15];

            if (index % 2)
                assert_true(z < w);
        }
    }
}

static void all_end(gn_far far_end)
{
    for (uint32_t r = 0; r < f.plan->record_count; r++)
        assert_int_equal(f.plan->records[r].far_end, far_end);
}

/* Where w = 0 would be clipped volumes end; a light all but on a face leaves no end, and depth
 * clamp does. */
static void far_ends_go_down_too(void **state)
{
    (void)state;
    assert_int_equal(plan(), GN_OK);
    all_end(GN_FAR_ENDED); /* behind what they may shadow */
    f.scene.without = GN_MEASURE_ENDS;
    assert_int_equal(plan(), GN_OK);
    all_end(GN_FAR_INFINITE);
    HIDE(GN_CAN_W0);
    assert_int_equal(plan(), GN_OK);
    all_end(GN_FAR_ENDED);
    says("volumes end behind what is seen, since w0 is hidden");
    far_vertices_are_inside();

    f.scene.light_count = 1;
    f.scene.object_count = 1;
    f.lights[0].position[0] = f.lights[0].position[2] = 0.1;
    f.lights[0].position[1] = 2 + 1e-10;
    assert_int_equal(plan(), GN_OK);
    all_end(GN_FAR_CLAMPED);
    HIDE(GN_CAN_DEPTH_CLAMP);
    assert_int_equal(plan(), GN_E_DEVICE);
    assert_non_null(strstr(gn_message(test_context), "object 0, light 0: the light touches the object"));
}

/* A host's own far plane: volumes end before it; or are clamped, if no plane cuts the caster; or are refused. */
static void a_finite_far_plane_is_kept_or_refused(void **state)
{
    (void)state;
    f.scene.camera.finite_far = 1;
    assert_int_equal(plan(), GN_OK);
    all_end(GN_FAR_ENDED);
    says("volumes end behind what is seen, since the camera's far plane is finite");
    assert_true(f.plan->depth_range[1] == 40 && f.plan->clear_depth == 1.0);
    far_vertices_are_inside();

    f.lights[0].position[0] = 1.001; /* beside the box: its shadow runs to the horizon */
    f.lights[0].position[1] = 1.999;
    f.lights[0].position[2] = 0;
    assert_int_equal(plan(), GN_OK);
    assert_int_equal(f.plan->records[0].far_end, GN_FAR_CLAMPED);
    HIDE(GN_CAN_DEPTH_CLAMP);
    assert_int_equal(plan(), GN_E_DEVICE);
    assert_non_null(
        strstr(gn_message(test_context), "object 0, light 0: no end of the volume lies before the far plane at 40"));
    assert_non_null(strstr(gn_message(test_context), "depth-clamp is hidden"));
    f.scene.target.hidden = 0;
    f.scene.camera.zfar = 8; /* in the middle of the box */
    assert_int_equal(plan(), GN_E_DEVICE);
    assert_non_null(strstr(gn_message(test_context), "is no help where a plane of the camera cuts the object"));
    f.scene.camera.zfar = 0;
    assert_int_equal(plan(), GN_E_ARG);
}

/* Where counting stops at the ends, more casting triangles than it holds are a warning. */
static void overflow_is_warned_of(void **state)
{
    (void)state;
    assert_int_equal(plan(), GN_OK);
    assert_int_equal(f.plan->warnings & 1u << GN_WARN_OVERFLOW, 0);
    HIDE(GN_CAN_STENCIL_WRAP);
    assert_int_equal(plan(), GN_OK);
    assert_int_equal(f.plan->warnings & 1u << GN_WARN_OVERFLOW, 0); /* twelve triangles or less */
    {
        static test_mesh m;
        gn_mesh_desc desc;
        gn_mesh *torus;

        m.vertex_count = m.triangle_count = 0;
        test_add_torus(&m, 1.0f, 0.3f, 20, 20);
        desc = test_desc(&m);
        assert_int_equal(gn_mesh_create(test_context, &desc, &torus), GN_OK);
        f.objects[0].mesh = torus;
        assert_int_equal(plan(), GN_OK);
        assert_int_equal(f.plan->warnings & 1u << GN_WARN_OVERFLOW, 1u << GN_WARN_OVERFLOW);
        f.scene.target.hidden = 0;
        assert_int_equal(plan(), GN_OK);
        assert_int_equal(f.plan->warnings & 1u << GN_WARN_OVERFLOW, 0);
        f.objects[0].mesh = f.meshes[0];
        gn_mesh_destroy(torus);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lists_of_capabilities_are_parsed),
        cmocka_unit_test(names_are_read_and_written),
        cmocka_unit_test_setup_teardown(the_chain_goes_down_step_by_step, set_up, tear_down),
        cmocka_unit_test_setup_teardown(what_can_do_nothing_is_refused, set_up, tear_down),
        cmocka_unit_test_setup_teardown(one_sided_may_be_asked_for, set_up, tear_down),
        cmocka_unit_test_setup_teardown(far_ends_go_down_too, set_up, tear_down),
        cmocka_unit_test_setup_teardown(overflow_is_warned_of, set_up, tear_down),
        cmocka_unit_test_setup_teardown(a_finite_far_plane_is_kept_or_refused, set_up, tear_down),
    };

    return cmocka_run_group_tests_name("choose", tests, test_open_context, test_close_context);
}
