/* test_plan.c - plans: pure, within their bound, and what a frame's parts must be. */
#include "frame.h"
#include "gn_matrix.h"
#include "gni.h"
#include "port_template.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The frame of the walk's tests, with an infinite far plane; plans are made in memory of their own here. */
static void make_fixture(test_frame *f)
{
    const gn_target target = TEST_TARGET(64, 48);

    assert_int_equal(test_frame_make(f, test_context, NULL, target), GN_OK);
    f->scene.camera.zfar = 0.0;
    f->scene.method = GN_METHOD_ZFAIL; /* the one whose parts do not depend on the view */
}

static void drop_fixture(test_frame *f)
{
    test_frame_drop(f, NULL);
}

static const gn_plan *make_plan(const test_frame *f, void **memory)
{
    const size_t size = gn_plan_bound(&f->scene);
    const gn_plan *plan = NULL;

    *memory = calloc(1, size);
    assert_non_null(*memory);
    assert_int_equal(gn_plan_make(test_context, &f->scene, *memory, size, &plan), GN_OK);
    return plan;
}

/* The order of passes; between lights the stencil is zeroed; z-fail has all three parts, but a sun no dark cap. */
static void a_frame_has_its_steps(void **state)
{
    static const struct {
        gn_step_kind kind;
        gn_draw draw;
        uint32_t light;
    } expected[] = {{GN_STEP_CLEAR, GN_DRAW_NOTHING, GN_NO_LIGHT},
                    {GN_STEP_DRAW, GN_DRAW_AMBIENT, GN_NO_LIGHT},
                    {GN_STEP_VOLUMES, GN_DRAW_NOTHING, 0},
                    {GN_STEP_DRAW, GN_DRAW_LIGHT, 0},
                    {GN_STEP_ZERO, GN_DRAW_NOTHING, 1},
                    {GN_STEP_VOLUMES, GN_DRAW_NOTHING, 1},
                    {GN_STEP_DRAW, GN_DRAW_LIGHT, 1},
                    {GN_STEP_DRAW, GN_DRAW_FINAL, GN_NO_LIGHT}};
    test_frame f;
    void *memory;
    const gn_plan *plan;

    (void)state;
    make_fixture(&f);
    plan = make_plan(&f, &memory);
    assert_int_equal(plan->step_count, sizeof expected / sizeof expected[0]);
    for (uint32_t i = 0; i < plan->step_count; i++) {
        assert_int_equal(plan->steps[i].kind, expected[i].kind);
        assert_int_equal(plan->steps[i].draw, expected[i].draw);
        assert_int_equal(plan->steps[i].light, expected[i].light);
    }
    assert_int_equal(plan->record_count, 4);
    for (uint32_t r = 0; r < 4; r++) {
        const gn_record *record = &plan->records[r];

        assert_int_equal(record->parts, r < 2 ? GN_SIDES | GN_LIGHT_CAP | GN_DARK_CAP : GN_SIDES | GN_LIGHT_CAP);
        assert_int_equal(record->light, r / 2);
        assert_int_equal(record->object, r % 2);
        assert_int_equal(record->light_cap_count, r < 2 ? record->dark_cap_count : record->light_cap_count);
        assert_true(record->end_plane[3] == 1.0);
    }
    /* the point light sees three faces of the box: six triangles, a silhouette of six edges */
    assert_int_equal(plan->records[0].light_cap_count, 18);
    assert_int_equal(plan->records[0].side_count, 6 * 6);
    assert_int_equal(plan->records[2].side_count, 6 * 3); /* the sun's sides are triangles */
    assert_int_equal(plan->lights[0].method, GN_METHOD_ZFAIL);
    assert_int_equal(plan->lights[0].cases[2], 2);
    free(memory);

    f.objects[1].flags &= ~(unsigned)GN_RECEIVES; /* then there is a pass for what does not receive */
    f.scene.method = GN_METHOD_ZPASS;
    plan = make_plan(&f, &memory);
    assert_int_equal(plan->step_count, sizeof expected / sizeof expected[0] + 2);
    assert_int_equal(plan->steps[3].receivers, 1);
    assert_int_equal(plan->steps[4].receivers, 0);
    assert_int_equal(plan->records[0].parts, GN_SIDES); /* closed and drawn: z-pass needs no cap */
    assert_int_equal(plan->lights[0].cases[0], 2);
    free(memory);
    f.objects[0].flags &= ~(unsigned)GN_DRAWN;
    plan = make_plan(&f, &memory);
    assert_int_equal(plan->records[0].parts, GN_SIDES | GN_LIGHT_CAP);
    free(memory);
    drop_fixture(&f);
}

/* Equal scenes give equal bytes, and nothing is written beyond the bound. */
static void planning_is_pure_and_bounded(void **state)
{
    test_frame f;

    (void)state;
    make_fixture(&f);
    for (int round = 0; round < 2; round++) {
        const size_t size = gn_plan_bound(&f.scene);
        unsigned char *a = malloc(size + 64), *b = malloc(size + 64);
        const gn_plan *pa, *pb;

        memset(a, 0xa5, size + 64);
        memset(b, 0xa5, size + 64);
        assert_int_equal(gn_plan_make(test_context, &f.scene, a, size, &pa), GN_OK);
        assert_int_equal(gn_plan_make(test_context, &f.scene, b, size, &pb), GN_OK);
        for (int i = 0; i < 64; i++)
            assert_int_equal(a[size + (size_t)i], 0xa5);
        assert_int_equal(pa->index_count, pb->index_count);
        assert_memory_equal(pa->indices, pb->indices, pa->index_count * sizeof(uint16_t));
        assert_memory_equal(pa->records, pb->records, pa->record_count * sizeof(gn_record));
        assert_memory_equal(pa->steps, pb->steps, pa->step_count * sizeof(gn_step));
        assert_int_equal(gn_plan_make(test_context, &f.scene, a, size - 8, &pa), GN_E_SPACE);
        assert_non_null(strstr(gn_message(test_context), "needed"));
        free(a);
        free(b);
        f.scene.camera.orthographic = 1;
        f.scene.camera.left = f.scene.camera.bottom = -4;
        f.scene.camera.right = f.scene.camera.top = 4;
    }
    drop_fixture(&f);
}

/* Rows z and w of a perspective matrix, far vertices' too, are equal to the last bit: nothing at infinity is
 * clipped. */
static void infinity_is_not_clipped(void **state)
{
    uint32_t rng = 77;

    (void)state;
    for (int trial = 0; trial < 300; trial++) {
        const double q[4] = {test_uniform(&rng, -1, 1), test_uniform(&rng, -1, 1), test_uniform(&rng, -1, 1), 1};
        const double t[3] = {test_uniform(&rng, -9e4, 9e4), test_uniform(&rng, -5, 5), test_uniform(&rng, -5, 5)};
        const double s[3] = {test_uniform(&rng, 0.1, 3), test_uniform(&rng, -3, -0.1), 1}, one[3] = {1, 1, 1};
        const gn_plan *plan;
        test_frame f;
        void *memory;

        make_fixture(&f);
        gn_mat4_from_trs(f.objects[0].model, t, q, s);
        gn_mat4_from_trs(f.scene.camera.world, t, q, one);
        f.scene.camera.left = -0.3; /* off the middle */
        plan = make_plan(&f, &memory);
        for (uint32_t i = 0; i < plan->object_count; i++)
            for (int column = 0; column < 3; column++)
                assert_true(plan->objects[i].matrix[4 * column + 2] == plan->objects[i].matrix[4 * column + 3]);
        for (uint32_t r = 0; r < plan->record_count; r++)
            for (int column = 0; column < 4; column++)
                assert_true(plan->records[r].far_matrix[4 * column + 2] == plan->records[r].far_matrix[4 * column + 3]);
        assert_int_equal(plan->objects[0].mirrored, 1);
        free(memory);
        drop_fixture(&f);
    }
}

/* The box far from the origin, with the camera beside it, gets the matrices of the box at the origin. */
static void distance_from_the_origin_does_not_matter(void **state)
{
    const double far_off = 1048576.0 + 1.0 / 64.0; /* more digits than a float has */
    const gn_plan *near_plan, *far_plan;
    void *near_memory, *far_memory;
    test_frame f;

    (void)state;
    make_fixture(&f);
    near_plan = make_plan(&f, &near_memory);
    for (int i = 0; i < 2; i++)
        f.objects[i].model[12] += far_off;
    f.scene.camera.world[12] += far_off;
    f.lights[0].position[0] += far_off;
    far_plan = make_plan(&f, &far_memory);
    assert_memory_equal(near_plan->objects[0].matrix, far_plan->objects[0].matrix, sizeof far_plan->objects[0].matrix);
    assert_int_equal(near_plan->index_count, far_plan->index_count);
    assert_memory_equal(near_plan->indices, far_plan->indices, near_plan->index_count * sizeof(uint16_t));
    assert_memory_equal(near_plan->records, far_plan->records, near_plan->record_count * sizeof(gn_record));
    free(near_memory);
    free(far_memory);
    drop_fixture(&f);
}

/* Orthographic volumes end: every far vertex is finite and not behind the widened depth range; the zfar is the
 * cleared depth. */
static void orthographic_volumes_end(void **state)
{
    uint32_t rng = 5;

    (void)state;
    for (int trial = 0; trial < 200; trial++) {
        test_frame f;
        void *memory;
        const gn_plan *plan;
        const double q[4] = {test_uniform(&rng, -1, 1), test_uniform(&rng, -1, 1), test_uniform(&rng, -1, 1), 1};
        const double eye[3] = {0, 3, 8}, one[3] = {1, 1, 1};

        make_fixture(&f);
        gn_mat4_from_trs(f.scene.camera.world, eye, q, one);
        f.scene.camera.orthographic = 1;
        f.scene.camera.left = f.scene.camera.bottom = -6;
        f.scene.camera.right = f.scene.camera.top = 6;
        f.scene.camera.znear = -20;
        f.scene.camera.zfar = trial % 2 ? 30 : 0;
        for (int i = 0; i < 3; i++) /* beside, above, and inside the box's height */
            f.lights[0].position[i] = test_uniform(&rng, -3, 3) + (i == 1 ? 3.2 : 0.0);
        plan = make_plan(&f, &memory);
        assert_true(isfinite(plan->depth_range[1]));
        if (trial % 2)
            assert_true(plan->depth_range[1] >= 30 &&
                        fabs(plan->clear_depth * (plan->depth_range[1] + 20) - 50) < 1e-9);
        else
            assert_true(plan->clear_depth == 1.0);
        for (uint32_t r = 0; r < plan->record_count; r++) {
            const gn_record *record = &plan->records[r];
            const gn_mesh_info *info = gn_mesh_get_info(plan->objects[record->object].mesh);
            const uint32_t count = record->side_count + record->dark_cap_count;

            for (uint32_t i = 0; i < count; i++) {
                const uint16_t index = plan->indices[record->first_index + i];
                double w, z;

                if (index % 2 == 0)
                    continue;
                z = w = 0.0;
                for (int c = 0; c < 4; c++) {
                    const double p =
                        c < 3 ? (double)info->positions[3 * (size_t)info->chunk_vertices[index / 2] + (size_t)c] : 1.0;

                    z += (double)record->far_matrix[4 * c + 2] * p;
                    w += (double)record->far_matrix[4 * c + 3] * p;
                }
                assert_true(w > 0.0);
                assert_true(z <= 1.0001 * w); /* before znear it may be: that is clipped and not counted */
                assert_true(record->end_reach > 0.0 ||
                            fabs(record->end_plane[0]) + fabs(record->end_plane[1]) + fabs(record->end_plane[2]) > 0.1);
            }
        }
        free(memory);
        drop_fixture(&f);
    }
}

/* What cannot be is refused with a sentence; a flattened caster is lawful. */
static void bad_scenes_are_refused(void **state)
{
    test_frame f;
    void *memory = malloc(1 << 20);
    const gn_plan *plan = NULL;

    (void)state;
    make_fixture(&f);
#define REFUSED(result, words)                                                                                         \
    do {                                                                                                               \
        assert_int_equal(gn_plan_make(test_context, &f.scene, memory, 1 << 20, &plan), result);                        \
        assert_non_null(strstr(gn_message(test_context), words));                                                      \
        assert_null(plan);                                                                                             \
        drop_fixture(&f);                                                                                              \
        make_fixture(&f);                                                                                              \
    } while (0)
    f.scene.camera.znear = 0.0;
    REFUSED(GN_E_ARG, "znear 0");
    f.scene.camera.zfar = 0.05;
    REFUSED(GN_E_ARG, "zfar 0.05");
    f.scene.camera.world[5] = NAN;
    REFUSED(GN_E_ARG, "element 5");
    f.scene.camera.right = -0.6;
    REFUSED(GN_E_ARG, "no area");
    f.lights[0].position[1] = INFINITY;
    REFUSED(GN_E_ARG, "light 0");
    memset(f.lights[1].towards, 0, sizeof f.lights[1].towards);
    REFUSED(GN_E_ARG, "light 1");
    f.objects[1].model[7] = 1;
    REFUSED(GN_E_ARG, "object 1");
    f.objects[0].model[3 * 4] = NAN;
    REFUSED(GN_E_ARG, "object 0");
    f.objects[0].mesh = NULL;
    REFUSED(GN_E_ARG, "object 0 has no mesh");
    f.scene.camera.finite_far = f.scene.camera.orthographic = 1;
    REFUSED(GN_E_ARG, "finite far");
    f.scene.target.height = 0;
    REFUSED(GN_E_ARG, "64x0");
    f.scene.method = GN_METHOD_TOTAL;
    REFUSED(GN_E_ARG, "no method");
    f.objects[0].model[5] = 0; /* flattened onto the floor: it casts all the same, by the lit one of its two sheets */
    assert_int_equal(gn_plan_make(test_context, &f.scene, memory, 1 << 20, &plan), GN_OK);
    assert_int_equal(plan->record_count, 4);
    assert_int_equal(plan->records[0].light_cap_count, 6);
    assert_int_equal(plan->records[0].turned_cap_count, 0);
    drop_fixture(&f);
    free(memory);
}

/* The JSON's length is told without room, it is cut and terminated with too little, and it names what it must. */
static void json_tells_the_plan(void **state)
{
    static const char *const words[] = {"\"clear_depth\": 1",      "\"method\": \"zfail\"", "\"case3\": 2",
                                        "\"light cap\"",           "\"step\": \"zero\"",    "\"draw\": \"final\"",
                                        "\"depth_range\": [0.0999"};
    test_frame f;
    void *memory;
    const gn_plan *plan;
    size_t length;
    char *text, tiny[8] = "xxxxxxx";

    (void)state;
    make_fixture(&f);
    plan = make_plan(&f, &memory);
    length = gn_plan_json(plan, NULL, 0);
    text = malloc(length + 1);
    assert_int_equal(gn_plan_json(plan, text, length + 1), length);
    assert_int_equal(strlen(text), length);
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++)
        if (!strstr(text, words[i]))
            fail_msg("the JSON does not say %s", words[i]);
    assert_int_equal(gn_plan_json(plan, tiny, 5), length);
    assert_memory_equal(tiny, text, 4);
    assert_memory_equal(tiny + 4, "\0xx", 3);
    free(text);
    free(memory);
    drop_fixture(&f);
}

/* The template port, as it stands, carries a mesh and a plan. */
static void the_template_port_works(void **state)
{
    static double block[40000];
    gn_port_block b = {(unsigned char *)block, sizeof block, 0, 0, 0};
    const gn_port port = gn_port_template(&b);
    gn_context *kept = test_context;
    test_frame f;
    void *memory;

    (void)state;
    assert_int_equal(gn_context_create(&port, &test_context), GN_OK);
    make_fixture(&f);
    assert_true(b.used > 0 && b.live > 10);
    (void)make_plan(&f, &memory);
    free(memory);
    drop_fixture(&f);
    gn_context_destroy(test_context);
    assert_int_equal(b.live, 0);
    assert_int_equal(b.used, 0);
    test_context = kept;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_frame_has_its_steps),    cmocka_unit_test(planning_is_pure_and_bounded),
        cmocka_unit_test(infinity_is_not_clipped),  cmocka_unit_test(distance_from_the_origin_does_not_matter),
        cmocka_unit_test(orthographic_volumes_end), cmocka_unit_test(bad_scenes_are_refused),
        cmocka_unit_test(json_tells_the_plan),      cmocka_unit_test(the_template_port_works),
    };

    return cmocka_run_group_tests_name("plan", tests, test_open_context, test_close_context);
}
