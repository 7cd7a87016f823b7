/* test_fragments.c - counts in colour keep what the plan says: on no line of sight through the drawn triangles of a batch
 * are there more fronts, or more backs, than its bound; and bounds are not so loose that every mesh is cut. */
#include "frame.h"
#include "gn_matrix.h"
#include "pile.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ROUNDS = 300, LINES = 400 };

static uint32_t rng = 99;

static double between(double low, double high)
{
    return test_uniform(&rng, low, high);
}

static void place(double out[4], const float m[16], const float *p)
{
    for (int i = 0; i < 4; i++)
        out[i] = (double)m[i] * (double)p[0] + (double)m[4 + i] * (double)p[1] + (double)m[8 + i] * (double)p[2] +
                 (double)m[12 + i];
}

/* 1 where the line through x, y of the image meets the triangle behind the near plane and sees its front, -1 its back. */
static int meets(double p[3][4], double x, double y)
{
    double a[3], b[3], share[3], z = 0.0, w = 0.0;

    for (int i = 0; i < 3; i++) {
        a[i] = p[i][0] - x * p[i][3];
        b[i] = p[i][1] - y * p[i][3];
    }
    for (int i = 0; i < 3; i++)
        share[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
    if (!((share[0] > 0 && share[1] > 0 && share[2] > 0) || (share[0] < 0 && share[1] < 0 && share[2] < 0)))
        return 0;
    for (int i = 0; i < 3; i++) {
        z += fabs(share[i]) * p[i][2];
        w += fabs(share[i]) * p[i][3];
    }
    return w > 0.0 && z >= -w ? share[0] > 0 ? 1 : -1 : 0;
}

static void count_record(const gn_plan *plan, const gn_record *r, double x, double y, uint32_t counts[2])
{
    const gn_mesh_info *info = gn_mesh_get_info(plan->objects[r->object].mesh);
    const uint32_t *vertices = info->chunk_vertices + info->chunks[r->chunk].first_vertex;
    const uint32_t upright = r->light_cap_count + r->side_count + r->dark_cap_count + r->near_cap_count;

    for (uint32_t i = 0; i < upright + r->turned_cap_count; i += 3) {
        const int turned = i >= upright;
        const uint16_t *corner = plan->indices + (turned ? r->first_turned_cap + i - upright : r->first_index + i);
        double p[3][4];
        int seen;

        for (int k = 0; k < 3; k++)
            place(p[k], corner[k] & 1 ? r->far_matrix : r->near_matrix,
                  info->positions + 3 * (size_t)vertices[corner[k] / 2]);
        seen = meets(p, x, y) * (turned ? -1 : 1);
        if (seen)
            counts[seen > 0]++;
    }
}

static uint32_t worst_line(const gn_plan *plan, const gn_step *batch)
{
    uint32_t worst = 0;

    for (int line = 0; line < LINES; line++) {
        const double x = between(-1.0, 1.0), y = between(-1.0, 1.0);
        uint32_t counts[2] = {0, 0};

        for (uint32_t r = batch->first_record; r < batch->first_record + batch->record_count; r++)
            count_record(plan, &plan->records[r], x, y, counts);
        worst = counts[0] > worst ? counts[0] : worst;
        worst = counts[1] > worst ? counts[1] : worst;
    }
    return worst;
}

/* NULL where a volume has no end and must have one. */
static const gn_plan *make(gn_scene *scene, int may_refuse)
{
    static double *memory;
    static size_t size;
    const size_t needed = gn_plan_bound(scene);
    const gn_plan *plan = NULL;
    gn_result result;

    if (needed > size) {
        memory = realloc(memory, needed);
        size = needed;
    }
    result = gn_plan_make(test_context, scene, memory, size, &plan);
    assert_true(result == GN_OK || (may_refuse && result == GN_E_DEVICE));
    return plan;
}

/* A scene of one mesh, one light, and the eye at a place, looking along -z. */
typedef struct one {
    gn_scene scene;
    gn_object object;
    gn_light light;
    gn_mesh *mesh;
} one;

static void set_up(one *o, const test_mesh *m, gn_method method, const double eye[3])
{
    const gn_mesh_desc desc = test_desc(m);

    memset(o, 0, sizeof *o);
    assert_int_equal(gn_mesh_create(test_context, &desc, &o->mesh), GN_OK);
    o->object.mesh = o->mesh;
    o->object.flags = GN_CASTS;
    gn_mat4_identity(o->object.model);
    gn_mat4_identity(o->scene.camera.world);
    memcpy(o->scene.camera.world + 12, eye, 3 * sizeof(double));
    o->scene.camera.left = o->scene.camera.bottom = -0.7;
    o->scene.camera.right = o->scene.camera.top = 0.7;
    o->scene.camera.znear = 0.1;
    o->scene.lights = &o->light;
    o->scene.light_count = 1;
    o->scene.objects = &o->object;
    o->scene.object_count = 1;
    o->scene.target = (gn_target)TEST_TARGET(64, 64);
    o->scene.method = method;
    o->scene.reads_masks = 1;
}

/* A quad with its corners at the ends of two edges from its middle. */
static void add_quad(test_mesh *m, const double middle[3], const double u[3], const double v[3])
{
    static const int signs[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    uint32_t corners[4];

    for (int i = 0; i < 4; i++) {
        float at[3];

        for (int k = 0; k < 3; k++)
            at[k] = (float)(middle[k] + signs[i][0] * u[k] + signs[i][1] * v[k]);
        corners[i] = test_add_vertex(m, at[0], at[1], at[2]);
    }
    test_add_triangle(m, corners[0], corners[1], corners[2]);
    test_add_triangle(m, corners[0], corners[2], corners[3]);
}

/* Rows and stacks of sheets whose number a line can meet: in a row every volume by its sides; in a stack every cap; and
 * sheets so large that all that is seen of their caps' borders is where the near plane cuts them. */
static void as_many_as_sheets(void **state)
{
    enum { SHEETS = 40 };
    static const double eye[3] = {0, 0, 0};
    static const struct {
        double first[3], pitch[3], u[3], v[3], sun[3];
        unsigned parts;
    } rows[] = {
        {{0, 1, -2}, {0, 0, -0.2}, {0.8, 0, 0}, {0, 0.2, 0.01}, {0.1, 1, 0.05}, GN_SIDES},
        {{0, -1, -5}, {0, -0.03, 0}, {1, 0, 0}, {0, 0, 1}, {0.3, 1, 0.4}, GN_LIGHT_CAP},
        {{0.1, 0, -2}, {0.05, 0, 0}, {0, 30, 0}, {0.2, 0, 30}, {1, 0.1, 0.1}, GN_LIGHT_CAP},
    };

    (void)state;
    for (size_t r = 0; r < sizeof rows / sizeof rows[0]; r++) {
        static test_mesh m;
        const gn_plan *plan;
        uint32_t worst;
        one o;

        m.vertex_count = m.triangle_count = 0;
        for (int i = 0; i < SHEETS; i++) {
            double middle[3];

            for (int k = 0; k < 3; k++)
                middle[k] = rows[r].first[k] + i * rows[r].pitch[k];
            add_quad(&m, middle, rows[r].u, rows[r].v);
        }
        set_up(&o, &m, GN_METHOD_COUNT, eye);
        o.light.kind = GN_LIGHT_DIRECTIONAL;
        memcpy(o.light.towards, rows[r].sun, sizeof o.light.towards);
        plan = make(&o.scene, 0);
        assert_int_equal(plan->lights[0].batches, 1);
        assert_int_equal(plan->records[0].parts & rows[r].parts, rows[r].parts);
        for (uint32_t s = 0; s < plan->step_count; s++)
            if (plan->steps[s].kind == GN_STEP_VOLUMES) {
                worst = worst_line(plan, &plan->steps[s]);
                assert_true(worst >= SHEETS);
                assert_true(worst <= plan->lights[0].fragments);
                assert_true(plan->lights[0].fragments <= 2 * SHEETS + 2);
            }
        gn_mesh_destroy(o.mesh);
    }
}

static void turn(double world[16], double yaw, double pitch)
{
    const double axes[9] = {cos(yaw),
                            0,
                            -sin(yaw),
                            sin(yaw) * sin(pitch),
                            cos(pitch),
                            cos(yaw) * sin(pitch),
                            sin(yaw) * cos(pitch),
                            -sin(pitch),
                            cos(yaw) * cos(pitch)};

    for (int i = 0; i < 9; i++)
        world[4 * (i / 3) + i % 3] = axes[i];
}

/* Boxes in boxes, the last of them open, around the lamp: caps at infinity surround the eye, whichever way it looks. */
static void shells_around_the_eye(void **state)
{
    enum { SHELLS = 14 };
    static test_mesh m;

    (void)state;
    m.vertex_count = m.triangle_count = 0;
    for (int i = 0; i < SHELLS; i++) {
        const float half = 0.5f + 0.1f * (float)i, low[3] = {-half, -half, -half}, high[3] = {half, half, half};

        test_add_box(&m, low, high, 0);
    }
    m.triangle_count -= 2;
    for (int round = 0; round < ROUNDS; round++) {
        const double eye[3] = {between(-3, 3), between(-3, 3), between(-3, 3)};
        const gn_plan *plan;
        one o;

        set_up(&o, &m, round % 2 ? GN_METHOD_ALPHA : GN_METHOD_COUNT, eye);
        turn(o.scene.camera.world, between(-3.1, 3.1), between(-1.5, 1.5));
        o.light.kind = GN_LIGHT_POINT;
        for (int k = 0; k < 3; k++)
            o.light.position[k] = between(-0.4, 0.4);
        plan = make(&o.scene, 0);
        for (uint32_t s = 0; s < plan->step_count; s++)
            if (plan->steps[s].kind == GN_STEP_VOLUMES) {
                const uint32_t worst = worst_line(plan, &plan->steps[s]);

                if (worst > plan->lights[0].fragments)
                    fail_msg("round %d: %lu fragments of one side, bound %lu", round, (unsigned long)worst,
                             (unsigned long)plan->lights[0].fragments);
            }
        gn_mesh_destroy(o.mesh);
    }
}

/* Boxes, closed and inside out, some open, and lights and eyes anywhere, in and behind volumes. */
static void no_line_meets_more(void **state)
{
    static const gn_method methods[] = {GN_METHOD_COUNT, GN_METHOD_SIGNED, GN_METHOD_ALPHA};
    uint32_t tight = 0, batches = 0;

    (void)state;
    for (int round = 0; round < ROUNDS; round++) {
        static test_mesh m;
        double eye[3];
        const gn_plan *plan;
        one o;

        m.vertex_count = m.triangle_count = 0;
        for (int b = 0; b < 1 + round % 4; b++) {
            float low[3], high[3];

            for (int k = 0; k < 3; k++) {
                low[k] = (float)between(-2.0, 1.0);
                high[k] = low[k] + (float)between(0.1, 1.5);
            }
            test_add_box(&m, low, high, b & 1);
        }
        if (round % 3 == 0) /* open: its last triangles are gone, and all that are left cast */
            m.triangle_count -= 2;
        for (int k = 0; k < 3; k++)
            eye[k] = between(-3.0, 3.0) + (k == 2 ? 3.0 : 0.0);
        set_up(&o, &m, methods[round % 3], eye);
        turn(o.scene.camera.world, between(-3.1, 3.1), between(-1.5, 1.5));
        if (round % 11 == 0) {
            o.scene.camera.orthographic = 1;
            o.scene.camera.left = o.scene.camera.bottom = -3.0;
            o.scene.camera.right = o.scene.camera.top = 3.0;
        }
        o.object.flags |= round % 5 ? GN_RECEIVES : 0u;
        o.light.kind = round % 2 ? GN_LIGHT_POINT : GN_LIGHT_DIRECTIONAL;
        for (int k = 0; k < 3; k++)
            o.light.position[k] = o.light.towards[k] = between(-4.0, 4.0);
        o.scene.target.hidden = round % 7 == 0 ? 1u << GN_CAN_W0 | 1u << GN_CAN_DEPTH_CLAMP : 0;
        plan = make(&o.scene, 1);
        for (uint32_t s = 0; plan && s < plan->step_count; s++)
            if (plan->steps[s].kind == GN_STEP_VOLUMES) {
                const uint32_t worst = worst_line(plan, &plan->steps[s]);

                if (worst > plan->lights[0].fragments)
                    fail_msg("round %d: %lu fragments of one side, bound %lu", round, (unsigned long)worst,
                             (unsigned long)plan->lights[0].fragments);
                batches++;
                tight += worst > 0 && plan->lights[0].fragments <= 3 * worst;
            }
        gn_mesh_destroy(o.mesh);
    }
    assert_true(batches > ROUNDS / 3);
    assert_true(tight > batches / 8); /* a bound that is no bound would pass the rest */
}

/* However fine a round mesh is, a line of sight crosses few of its sides: nothing is cut for it, and eight of them do with
 * two batches. */
static void fine_meshes_are_not_cut(void **state)
{
    static const uint32_t sizes[][2] = {{16, 16}, {43, 44}, {100, 100}};

    (void)state;
    for (int i = 0; i < 3; i++) {
        pile_mesh lump, floor;
        pile p;
        gn_scene scene;
        const gn_plan *plan;

        assert_true(pile_make_lump(&lump, test_context, sizes[i][0], sizes[i][1]));
        assert_true(pile_make_floor(&floor, test_context, 32, (float)pile_floor_half(2)));
        memset(&p, 0, sizeof p);
        memset(&scene, 0, sizeof scene);
        p.meshes[0] = &lump;
        p.meshes[1] = &floor;
        p.side = 2;
        p.light_count = 1;
        pile_pose(&p, 0, 4.0 / 3.0);
        for (uint32_t o = 0; o < p.object_count; o++)
            p.objects[o].flags |= GN_CASTS;
        scene.camera = p.camera;
        scene.lights = p.lights;
        scene.light_count = 1;
        scene.objects = p.objects;
        scene.object_count = p.object_count;
        scene.target = (gn_target)TEST_TARGET(640, 480);
        scene.method = GN_METHOD_COUNT;
        scene.reads_masks = 1;
        plan = make(&scene, 0);
        assert_true(plan->lights[0].batches <= 2);
        assert_int_equal(plan->lights[0].cut_casters, 0);
        pile_drop(&lump);
        pile_drop(&floor);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(as_many_as_sheets), cmocka_unit_test(shells_around_the_eye),
                                       cmocka_unit_test(no_line_meets_more), cmocka_unit_test(fine_meshes_are_not_cut)};

    return cmocka_run_group_tests_name("fragments", tests, test_open_context, test_close_context);
}
