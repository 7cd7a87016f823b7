/* test_walk.c - the walk over a GL that draws nothing: which calls, how many, and what happens when things fail. */
#include "fake_gl.h"
#include "frame.h"

#include <stdlib.h>
#include <string.h>

static const gn_target target = TEST_TARGET(64, 48);
static const gn_gles_desc fake = {fake_gl_get_proc, NULL, NULL};

static gn_context *context;
static gn_gles *gl;

static int set_up(void **state)
{
    (void)state;
    fake_gl_reset();
    fake_gl_live_names = 0;
    return gn_context_create(NULL, &context) != GN_OK || gn_gles_create(context, &fake, &gl) != GN_OK;
}

static int tear_down(void **state)
{
    (void)state;
    gn_gles_destroy(gl);
    gn_context_destroy(context);
    return fake_gl_live_names != 0; /* every name was given back */
}

static void walk_to_the_end(int *draws)
{
    gn_step step;

    while (gn_gles_next(gl, &step))
        draws[step.draw]++;
}

/* One clear, to the zfar's depth; a draw for each record, one quad between two lights; vertices are never sent in a
 * frame. */
static void a_frame_draws_what_its_plan_says(void **state)
{
    int draws[4] = {0};
    test_frame f;

    (void)state;
    assert_int_equal(test_frame_make(&f, context, gl, target), GN_OK);
    fake_gl_reset();
    assert_int_equal(gn_gles_begin(gl, f.plan), GN_OK);
    assert_int_equal(fake_gl_calls("glBufferData"), 1);
    walk_to_the_end(draws);
    assert_int_equal(draws[GN_DRAW_AMBIENT], 1);
    assert_int_equal(draws[GN_DRAW_LIGHT], 2);
    assert_int_equal(draws[GN_DRAW_FINAL], 1);
    assert_int_equal(fake_gl_calls("glClear"), 1);
    assert_int_equal(fake_gl_calls("glDrawElements"), f.plan->record_count);
    assert_int_equal(fake_gl_calls("glDrawArrays"), 1);
    assert_int_equal(fake_gl_calls("glBufferData"), 1);
    assert_int_equal(fake_gl_calls("glBufferSubData"), 0);
    assert_int_equal(fake_gl_calls("glGetIntegerv") + fake_gl_calls("glGetError") + fake_gl_calls("glGetFloatv"), 0);
    assert_true(fake_gl_clear_depth == 1.0f); /* as in a new context again */
    assert_int_equal(fake_gl_calls("glClearDepthf"), 2);
    assert_int_equal(gn_gles_next(gl, &(gn_step){0}), 0);
    test_frame_drop(&f, gl);
}

/* Turned caps are a call of their own: an inside-out box seen from within the room needs one. */
static void turned_caps_are_drawn_apart(void **state)
{
    static test_mesh m;
    static const float low[3] = {-2, -2, -2}, high[3] = {2, 2, 2};
    gn_mesh_desc desc;
    gn_mesh *room;
    int draws[4] = {0};
    test_frame f;

    (void)state;
    m.vertex_count = m.triangle_count = 0;
    test_add_box(&m, low, high, 0);
    desc = test_desc(&m);
    assert_int_equal(gn_mesh_create(context, &desc, &room), GN_OK);
    assert_int_equal(gn_gles_upload(gl, room), GN_OK);
    assert_int_equal(test_frame_make(&f, context, gl, target), GN_OK);
    f.scene.object_count = 1;
    f.scene.light_count = 1;
    f.objects[0].mesh = room;
    memset(f.lights[0].position, 0, sizeof f.lights[0].position); /* inside: all twelve triangles cast, turned */
    assert_int_equal(gn_plan_make(context, &f.scene, f.memory, f.size, &f.plan), GN_OK);
    assert_int_equal(f.plan->record_count, 1);
    assert_int_equal(f.plan->records[0].turned_cap_count, 36);
    assert_int_equal(f.plan->records[0].light_cap_count, 0);
    assert_int_equal(f.plan->records[0].side_count, 0); /* closed all around */
    fake_gl_reset();
    assert_int_equal(gn_gles_begin(gl, f.plan), GN_OK);
    walk_to_the_end(draws);
    assert_int_equal(fake_gl_calls("glDrawElements"), 2);
    assert_int_equal(fake_gl_last_count, 36);
    test_frame_drop(&f, gl);
    gn_gles_unload(gl, room);
    gn_mesh_destroy(room);
}

static size_t walk_and_count(const gn_plan *plan)
{
    int draws[4] = {0};
    size_t count = 0;

    fake_gl_reset();
    assert_int_equal(gn_gles_begin(gl, plan), GN_OK);
    walk_to_the_end(draws);
    while (fake_gl_call(count))
        count++;
    return count;
}

/* A light that nothing in view is reached by makes no call at all; one with bounds a scissor, and depth bounds where
 * they are proven and not hidden. */
static void bounds_cost_what_they_must(void **state)
{
    static const gn_light lamp = {.kind = GN_LIGHT_POINT, .position = {3, 1.5, 0}, .range = 2.5};
    size_t without, with;
    test_frame f;

    (void)state;
    assert_int_equal(test_frame_make(&f, context, gl, target), GN_OK);
    f.scene.light_count = 1;
    f.scene.without = GN_MEASURE_SCISSORS;
    assert_int_equal(gn_plan_make(context, &f.scene, f.memory, f.size, &f.plan), GN_OK);
    without = walk_and_count(f.plan);
    assert_int_equal(fake_gl_calls("glDepthBoundsEXT"), 0);
    assert_int_equal(fake_gl_calls("glScissor"), 1); /* on exit */
    f.scene.light_count = 2;
    f.lights[1] = lamp;
    f.lights[1].position[2] = 40;
    assert_int_equal(gn_plan_make(context, &f.scene, f.memory, f.size, &f.plan), GN_OK);
    with = walk_and_count(f.plan);
    assert_int_equal(f.plan->lights[1].skip, GN_SKIP_OUT_OF_VIEW);
    assert_int_equal(with, without);
    f.lights[1].position[2] = 0;
    assert_int_equal(gn_plan_make(context, &f.scene, f.memory, f.size, &f.plan), GN_OK);
    assert_true(walk_and_count(f.plan) > without);
    assert_true(fake_gl_calls("glDepthBoundsEXT") > 1);
    assert_true(fake_gl_calls("glScissor") > 1);
    f.scene.target.hidden = 1u << GN_CAN_DEPTH_BOUNDS;
    assert_int_equal(gn_plan_make(context, &f.scene, f.memory, f.size, &f.plan), GN_OK);
    (void)walk_and_count(f.plan);
    assert_int_equal(fake_gl_calls("glDepthBoundsEXT"), 0);
    assert_true(fake_gl_calls("glScissor") > 1);
    test_frame_drop(&f, gl);
}

static void failures_are_said(void **state)
{
    test_frame f;
    gn_gles *other = gl;

    (void)state;
    fake_gl_missing = "glStencilOpSeparate";
    assert_int_equal(gn_gles_create(context, &fake, &other), GN_E_DEVICE);
    assert_null(other);
    assert_non_null(strstr(gn_message(context), "glStencilOpSeparate"));
    fake_gl_missing = NULL;
    fake_gl_refuses_shaders = 1;
    assert_int_equal(gn_gles_create(context, &fake, &other), GN_E_DEVICE);
    assert_non_null(strstr(gn_message(context), "shader"));
    fake_gl_refuses_shaders = 0;
    assert_int_equal(gn_gles_create(context, &(gn_gles_desc){NULL, NULL, NULL}, &other), GN_E_ARG);
    assert_int_equal(test_frame_make(&f, context, gl, target), GN_OK);
    gn_gles_unload(gl, f.meshes[1]);
    assert_int_equal(gn_gles_begin(gl, f.plan), GN_E_ARG);
    assert_non_null(strstr(gn_message(context), "object 1"));
    fake_gl_out_of_memory = 1;
    assert_int_equal(gn_gles_upload(gl, f.meshes[1]), GN_E_DEVICE);
    fake_gl_out_of_memory = 0;
    assert_int_equal(gn_gles_upload(gl, f.meshes[1]), GN_OK);
    assert_int_equal(gn_gles_upload(gl, f.meshes[1]), GN_OK); /* it is there already */
    assert_int_equal(gn_gles_begin(gl, f.plan), GN_OK);
    test_frame_drop(&f, gl);
}

/* After the context is lost nothing calls GL, and everything can be made again. */
static void a_lost_context_is_forgotten(void **state)
{
    test_frame f;
    gn_step step;

    (void)state;
    assert_int_equal(test_frame_make(&f, context, gl, target), GN_OK);
    assert_int_equal(gn_gles_begin(gl, f.plan), GN_OK);
    assert_int_equal(gn_gles_next(gl, &step), 1);
    fake_gl_reset();
    gn_gles_forget(gl);
    fake_gl_live_names = 0; /* they went with the context */
    assert_int_equal(gn_gles_next(gl, &step), 0);
    assert_int_equal(gn_gles_begin(gl, f.plan), GN_E_ARG);
    test_frame_drop(&f, gl);
    gn_gles_destroy(gl);
    assert_null(fake_gl_call(0));
    assert_int_equal(gn_gles_create(context, &fake, &gl), GN_OK);
    assert_int_equal(test_frame_make(&f, context, gl, target), GN_OK);
    assert_int_equal(gn_gles_begin(gl, f.plan), GN_OK);
    test_frame_drop(&f, gl);
}

/* Each allocation of a whole session fails in turn; and once it runs, a frame allocates nothing. */
static void every_allocation_may_fail(void **state)
{
    test_port counter = {0, 0, 0};
    const gn_port port = test_port_make(&counter);
    gn_result result = GN_E_MEMORY;
    size_t fail_at = 0;

    (void)state;
    while (result != GN_OK) {
        gn_context *failing = NULL;
        gn_gles *device = NULL;
        test_frame f;

        memset(&f, 0, sizeof f);
        counter.calls = 0;
        counter.fail_at = ++fail_at;
        result = gn_context_create(&port, &failing);
        if (result == GN_OK)
            result = gn_gles_create(failing, &fake, &device);
        if (result == GN_OK)
            result = test_frame_make(&f, failing, device, target);
        if (result == GN_OK) {
            const size_t calls = counter.calls;
            gn_step step;

            for (int frame = 0; frame < 3; frame++) {
                f.lights[0].position[0] += 0.5;
                assert_int_equal(gn_plan_make(failing, &f.scene, f.memory, f.size, &f.plan), GN_OK);
                assert_int_equal(gn_gles_begin(device, f.plan), GN_OK);
                while (gn_gles_next(device, &step))
                    continue;
            }
            assert_int_equal(counter.calls, calls);
        } else {
            assert_int_equal(result, GN_E_MEMORY);
        }
        test_frame_drop(&f, device);
        gn_gles_destroy(device);
        gn_context_destroy(failing);
        assert_int_equal(counter.live_bytes, 0);
    }
    assert_true(fail_at > 20);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_frame_draws_what_its_plan_says, set_up, tear_down),
        cmocka_unit_test_setup_teardown(turned_caps_are_drawn_apart, set_up, tear_down),
        cmocka_unit_test_setup_teardown(bounds_cost_what_they_must, set_up, tear_down),
        cmocka_unit_test_setup_teardown(failures_are_said, set_up, tear_down),
        cmocka_unit_test_setup_teardown(a_lost_context_is_forgotten, set_up, tear_down),
        cmocka_unit_test_setup_teardown(every_allocation_may_fail, set_up, tear_down),
    };

    return cmocka_run_group_tests_name("walk", tests, NULL, NULL);
}
