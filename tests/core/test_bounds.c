/* test_bounds.c - what bounds a light, in the plan: nothing that it lights lies outside; what it cannot reach is
 * skipped and the plan says why. */
#include "frame.h"
#include "gn_matrix.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static test_frame f;
static uint32_t rng = 99;

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

static const gn_plan *plan(void)
{
    const size_t size = gn_plan_bound(&f.scene);

    if (size > f.size) {
        free(f.memory);
        f.memory = malloc(size);
        f.size = size;
    }
    if (gn_plan_make(test_context, &f.scene, f.memory, f.size, &f.plan) != GN_OK)
        fail_msg("%s", gn_message(test_context));
    return f.plan;
}

static void random_light(gn_light *l)
{
    memset(l, 0, sizeof *l);
    l->kind = (gn_light_kind)(test_random(&rng) % 3);
    for (int i = 0; i < 3; i++) {
        l->position[i] = test_uniform(&rng, -9, 9);
        l->towards[i] = test_uniform(&rng, -1, 1);
        l->color[i] = test_random(&rng) % 2 ? 0.0 : test_uniform(&rng, 0, 0.2);
        l->attenuation[i] = test_random(&rng) % 2 ? 0.0 : test_uniform(&rng, 0.5, 4);
        l->box_min[i] = test_random(&rng) % 2 ? -20 : test_uniform(&rng, -8, 0);
        l->box_max[i] = test_random(&rng) % 2 ? 20 : test_uniform(&rng, 0, 8);
    }
    if (test_random(&rng) % 2) {
        memset(l->box_min, 0, sizeof l->box_min);
        memset(l->box_max, 0, sizeof l->box_max);
    }
    l->range = test_random(&rng) % 2 ? 0.0 : test_uniform(&rng, 0.5, 8);
    l->cone = test_random(&rng) % 2 ? 0.0 : test_uniform(&rng, 0.05, 1.5);
}

/* Whether a point gets half a step of light or more, as the public header defines a light's bounds. */
static int is_lit(const gn_light *l, const double p[3])
{
    double d[3], square = 0.0, along = 0.0, length = 0.0, attenuation, most = 0.0;
    int has_box = 0, known = 0;

    for (int i = 0; i < 3; i++) {
        d[i] = p[i] - l->position[i];
        square += d[i] * d[i];
        along -= d[i] * l->towards[i];
        length += l->towards[i] * l->towards[i];
        has_box |= l->box_min[i] != 0.0 || l->box_max[i] != 0.0;
        known |= l->color[i] != 0.0;
        most = fmax(most, l->color[i]);
    }
    for (int i = 0; i < 3 && has_box; i++)
        if (p[i] < l->box_min[i] || p[i] > l->box_max[i])
            return 0;
    if (l->kind == GN_LIGHT_DIRECTIONAL)
        return 1;
    attenuation = l->attenuation[0] + l->attenuation[1] * sqrt(square) + l->attenuation[2] * square;
    if (l->attenuation[0] == 0.0 && l->attenuation[1] == 0.0 && l->attenuation[2] == 0.0)
        attenuation = 1.0;
    if (known && most / attenuation < 0.5 / 255.0)
        return 0;
    if (l->range > 0.0 && square > l->range * l->range)
        return 0;
    return l->kind != GN_LIGHT_SPOT || l->cone == 0.0 || along >= cos(l->cone) * sqrt(square * length);
}

/* A point all but on the light's cone, in the world and in view space; 0 where it is not seen. */
static int at_the_rim(const gn_light *l, const gn_camera *c, double p[3], double v[3])
{
    const double turn = test_uniform(&rng, 0, 6.3), along = test_uniform(&rng, 0.2, 9),
                 wide = 0.999 * tan(l->cone) * along;
    const double length =
        sqrt(l->towards[0] * l->towards[0] + l->towards[1] * l->towards[1] + l->towards[2] * l->towards[2]);
    double axis[3], u[3], w[3], size;

    for (int i = 0; i < 3; i++)
        axis[i] = -l->towards[i] / length;
    u[0] = axis[1]; /* across the axis, whatever it is: axis x (axis turned) */
    u[1] = axis[2];
    u[2] = axis[0];
    w[0] = axis[1] * u[2] - axis[2] * u[1];
    w[1] = axis[2] * u[0] - axis[0] * u[2];
    w[2] = axis[0] * u[1] - axis[1] * u[0];
    size = sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
    for (int i = 0; i < 3; i++)
        w[i] /= size;
    u[0] = w[1] * axis[2] - w[2] * axis[1];
    u[1] = w[2] * axis[0] - w[0] * axis[2];
    u[2] = w[0] * axis[1] - w[1] * axis[0];
    for (int i = 0; i < 3; i++)
        p[i] = l->position[i] + along * axis[i] + wide * (cos(turn) * u[i] + sin(turn) * w[i]);
    for (int k = 0; k < 3; k++) {
        v[k] = 0.0;
        for (int i = 0; i < 3; i++)
            v[k] += c->world[4 * k + i] * (p[i] - c->world[12 + i]);
    }
    size = c->orthographic ? 1.0 : -v[2];
    return v[2] < -c->znear && v[0] > c->left * size && v[0] < c->right * size && v[1] > c->bottom * size &&
           v[1] < c->top * size;
}

/* Points of the view that are lit lie in the scissor and between the depth bounds. */
static void what_is_lit_is_in_bounds(void **state)
{
    uint32_t inside = 0, outside = 0, skipped = 0;

    (void)state;
    f.scene.light_count = 1;
    f.scene.target.width = 2048; /* so that the pixel of margin is little */
    f.scene.target.height = 1536;
    for (int trial = 0; trial < 3000; trial++) {
        const double q[4] = {test_uniform(&rng, -1, 1), test_uniform(&rng, -1, 1), test_uniform(&rng, -1, 1), 1};
        const double eye[3] = {test_uniform(&rng, -6, 6), test_uniform(&rng, -6, 6), test_uniform(&rng, -6, 6)};
        static const double one[3] = {1, 1, 1};
        gn_camera *c = &f.scene.camera;
        const gn_plan_light *l;

        c->orthographic = trial % 4 == 3;
        c->zfar = 60;
        c->left = c->bottom = c->orthographic ? -5 : -0.6;
        c->right = c->top = -c->left;
        gn_mat4_from_trs(c->world, eye, q, one);
        random_light(&f.lights[0]);
        if (trial % 7 == 0) { /* a cone alone bounds it, before the eye and across the view */
            const double turn = test_uniform(&rng, 0, 6.3), at[3] = {0.2, -0.3, test_uniform(&rng, -8, -3)};
            const double across[3] = {cos(turn), sin(turn), 0.1};

            f.lights[0] = (gn_light){.kind = GN_LIGHT_SPOT, .cone = test_uniform(&rng, 0.05, 0.4)};
            gn_mat4_transform(f.lights[0].position, c->world, at, 1.0);
            gn_mat4_transform(f.lights[0].towards, c->world, across, 0.0);
        }
        /* everything around receives, so that a light is skipped for its bounds alone */
        f.objects[1].model[0] = f.objects[1].model[5] = f.objects[1].model[10] = 20;
        l = &plan()->lights[0];
        skipped += l->skip != GN_SKIP_NOT;
        for (int n = 0; n < 60; n++) {
            double v[3], p[3], x, y, depth;
            double distance = c->znear + test_uniform(&rng, 0, 1) * (trial % 2 ? 3 : 20);
            double scale = c->orthographic ? 1.0 : distance;
            int in;

            v[0] = test_uniform(&rng, c->left, c->right) * scale;
            v[1] = test_uniform(&rng, c->bottom, c->top) * scale;
            v[2] = -distance;
            gn_mat4_transform(p, c->world, v, 1.0);
            if (n % 2 && f.lights[0].kind == GN_LIGHT_SPOT && f.lights[0].cone > 0.0 &&
                !at_the_rim(&f.lights[0], c, p, v))
                continue;
            distance = -v[2];
            scale = c->orthographic ? 1.0 : distance;
            if (!is_lit(&f.lights[0], p)) {
                outside++;
                continue;
            }
            x = (v[0] / scale - c->left) / (c->right - c->left) * 2048;
            y = (v[1] / scale - c->bottom) / (c->top - c->bottom) * 1536;
            depth = c->orthographic
                        ? (distance - f.plan->depth_range[0]) / (f.plan->depth_range[1] - f.plan->depth_range[0])
                        : 1.0 - c->znear / distance;
            in = l->skip == GN_SKIP_NOT && x >= l->scissor[0] && x <= l->scissor[0] + l->scissor[2] &&
                 y >= l->scissor[1] && y <= l->scissor[1] + l->scissor[3] && depth >= l->depth_bounds[0] &&
                 depth <= l->depth_bounds[1];
            inside++;
            if (!in && !(l->skip == GN_SKIP_NO_RECEIVER))
                fail_msg(
                    "trial %d: %g %g %g is lit (pixel %g, %g, depth %g); skip %d, scissor %u %u %u %u, depths %g %g",
                    trial, p[0], p[1], p[2], x, y, depth, l->skip, l->scissor[0], l->scissor[1], l->scissor[2],
                    l->scissor[3], l->depth_bounds[0], l->depth_bounds[1]);
        }
    }
    print_message("           %lu points lit, %lu not; %lu lights skipped\n", (unsigned long)inside,
                  (unsigned long)outside, (unsigned long)skipped);
    assert_true(inside > 10000 && outside > 10000 && skipped > 300);
}

static void light_says(uint32_t light, const char *words)
{
    char text[600];

    assert_true(gn_plan_explain_light(f.plan, light, text, sizeof text) < sizeof text);
    if (!strstr(text, words))
        fail_msg("\"%s\" does not say \"%s\"", text, words);
}

static void caster_says(uint32_t object, const char *words)
{
    char text[600];

    gn_plan_explain_caster(f.plan, 0, object, text, sizeof text);
    if (!strstr(text, words))
        fail_msg("object %u: \"%s\" does not say \"%s\"", (unsigned)object, text, words);
}

/* Every reason that there is, each by the scene that has it; texts are cut like snprintf's. */
static void what_is_skipped_is_said(void **state)
{
    const uint32_t list[1] = {0};
    char text[8] = "xxxxxxx";
    size_t length;

    (void)state;
    f.scene.light_count = 1;
    plan();
    light_says(0, "stencil: exact for any view; 2 casters, 0 left out");
    caster_says(0, "case 1, by z-pass");
    caster_says(1, "case 1, by z-pass: it stands not between the light and the near plane; sides");
    length = gn_plan_explain_light(f.plan, 0, NULL, 0);
    assert_int_equal(gn_plan_explain_light(f.plan, 0, text, 4), length);
    assert_string_equal(text, "ste");
    assert_int_equal(gn_plan_explain_light(f.plan, 1, text, sizeof text), 0);
    assert_string_equal(text, "");
    assert_int_equal(gn_plan_explain_caster(f.plan, 0, 2, NULL, 0), 0);
    assert_int_equal(gn_plan_explain_warning(f.plan, GN_WARN_DEPTH, NULL, 0), 0);

    f.lights[0].range = 0.5; /* in the air */
    plan();
    assert_int_equal(f.plan->lights[0].skip, GN_SKIP_NO_RECEIVER);
    light_says(0, "left out: nothing that it reaches is there to be lit");
    caster_says(0, "the light is left out");
    assert_int_equal(f.plan->step_count, 3); /* clear, ambient, final: nothing of it */
    f.lights[0].position[2] = 30;            /* behind the eye */
    f.lights[0].range = 4;
    plan();
    assert_int_equal(f.plan->lights[0].skip, GN_SKIP_OUT_OF_VIEW);
    light_says(0, "left out: nothing that it reaches is in view");
    f.lights[0].color[0] = f.lights[0].color[1] = 0.001;
    plan();
    assert_int_equal(f.plan->lights[0].skip, GN_SKIP_FAINT);
    light_says(0, "less than half a step");
    f.lights[0] = (gn_light){.kind = GN_LIGHT_POINT, .position = {-6, 1, 0}, .range = 3};
    plan();
    caster_says(0, "left out: it lies beyond the light's reach");
    f.lights[0] = (gn_light){.kind = GN_LIGHT_SPOT, .position = {-4, 3, 0}, .towards = {0.2, 1, 0}, .cone = 0.4};
    plan();
    caster_says(0, "left out: it lies beyond the light's reach");
    f.lights[0] = (gn_light){.kind = GN_LIGHT_POINT, .position = {2, 5, 3}, .exempt = list, .exempt_count = 1};
    plan();
    caster_says(0, "left out: it is exempt");
    f.lights[0] = (gn_light){.kind = GN_LIGHT_POINT, .position = {0, 1, 60}};
    f.objects[0].model[14] = 40; /* far behind the eye, and its shadow goes away from it */
    f.lights[0].position[2] = 20;
    plan();
    caster_says(0, "left out: no part of its volume is in view");
    f.objects[0].model[14] = 0;
    f.lights[0] =
        (gn_light){.kind = GN_LIGHT_POINT, .position = {2, 5, 3}, .color = {0.5, 0.2, 0.1}, .attenuation = {0, 0, 1}};
    f.scene.least_light = 0.2;
    plan();
    assert_int_equal(f.plan->lights[0].skip, GN_SKIP_UNIMPORTANT);
    assert_true(f.plan->lights[0].possible_error > 0.01 && f.plan->lights[0].possible_error <= 0.2);
    light_says(0, "left out: it matters less than was asked for: at most 0.0");
    f.scene.least_light = 0.0;
    plan();
    assert_true(f.plan->lights[0].reach > 15.9 && f.plan->lights[0].reach < 16.0); /* sqrt(0.5 * 2 * 255) */
    f.objects[0].flags &= ~(unsigned)GN_CASTS;
    plan();
    caster_says(0, "it casts no shadow");
}

/* From below the floor it casts: what is above, or itself, may be seen in its shadow. */
static void floors_cast_where_they_may(void **state)
{
    static test_mesh m;
    gn_mesh_desc desc;
    gn_mesh *quad;

    (void)state;
    m.vertex_count = m.triangle_count = 0;
    for (int i = 0; i < 4; i++)
        test_add_vertex(&m, i & 1 ? 40.0f : -40.0f, 0.0f, i & 2 ? 40.0f : -40.0f);
    test_add_triangle(&m, 0, 2, 1);
    test_add_triangle(&m, 1, 2, 3);
    desc = test_desc(&m);
    assert_int_equal(gn_mesh_create(test_context, &desc, &quad), GN_OK);
    assert_int_equal(gn_mesh_get_info(quad)->planar, 2);
    f.scene.without = ~0u;
    f.objects[1].mesh = quad;
    f.objects[1].flags = GN_CASTS | GN_RECEIVES | GN_DRAWN;
    f.scene.light_count = 1;
    f.scene.camera.zfar = 0;
    f.scene.camera.world[13] = 3;
    f.scene.camera.top = -0.1; /* the horizon, where its border is, is out of view */
    plan();
    caster_says(1, "its volume misses all that receives");
    f.scene.camera.top = 0.6;
    plan();
    caster_says(1, "; sides"); /* z-pass, without caps: all of it is drawn */
    assert_int_equal(f.plan->casters[1].parts, GN_SIDES);
    f.objects[1].flags &= ~(unsigned)GN_DRAWN;
    plan();
    assert_int_equal(f.plan->casters[1].parts, GN_SIDES | GN_LIGHT_CAP);
    f.objects[1].flags |= GN_DRAWN;
    f.scene.camera.top = -0.1;
    f.objects[0].model[13] = -1; /* sunk into it */
    plan();
    caster_says(1, "case 1, by z-pass");
    f.objects[0].model[13] = 0;
    f.scene.camera.world[13] = -3; /* the eye below */
    f.scene.camera.top = 0.6;
    plan();
    assert_int_equal(f.plan->casters[1].skip, GN_SKIP_NOT);
    f.objects[1].mesh = f.meshes[1];
    gn_mesh_destroy(quad);
}

/* Parts of a soft light keep its color together, are within its radius, apart, and the same each time. */
static void soft_lights_are_jittered_and_stay(void **state)
{
    gn_light light = {
        .kind = GN_LIGHT_POINT, .position = {1, 2, 3}, .towards = {0, 3, 4}, .color = {1, 2, 4}, .range = 7};
    gn_light parts[2][32];

    (void)state;
    for (int kind = 0; kind < 3; kind++) {
        double color = 0.0;

        light.kind = (gn_light_kind)kind;
        for (int i = 0; i < 2; i++)
            assert_int_equal(gn_light_soften(test_context, &light, 0.5, 32, parts[i]), GN_OK);
        assert_memory_equal(parts[0], parts[1], sizeof parts[0]);
        for (int i = 0; i < 32; i++) {
            const int is_sun = kind == GN_LIGHT_DIRECTIONAL;
            const double *a = is_sun ? parts[0][i].towards : parts[0][i].position;
            const double *b = is_sun ? light.towards : light.position;
            /* of a direction: across it, at distance 1; directions have any length */
            const double along = (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) / (b[0] * b[0] + b[1] * b[1] + b[2] * b[2]);
            const double scale = is_sun ? 5.0 * along : 1.0;
            double square = 0.0;

            for (int k = 0; k < 3; k++)
                square += (a[k] - b[k] * (is_sun ? along : 1.0)) * (a[k] - b[k] * (is_sun ? along : 1.0));
            assert_true(sqrt(square) <= 0.5 * scale * (1 + 1e-12) && sqrt(square) > 0.0);
            for (int j = 0; j < i; j++)
                assert_memory_not_equal(&parts[0][i], &parts[0][j], sizeof parts[0][0]);
            color += parts[0][i].color[2];
            assert_true(parts[0][i].range == 7);
        }
        assert_true(fabs(color - 4.0) < 1e-9);
    }
    assert_int_equal(gn_light_soften(test_context, &light, 0.5, 1, parts[0]), GN_OK); /* one is itself */
    assert_memory_equal(&parts[0][0], &light, sizeof light);
    assert_int_equal(gn_light_soften(test_context, &light, -1, 4, parts[0]), GN_E_ARG);
    assert_int_equal(gn_light_soften(test_context, &light, NAN, 4, parts[0]), GN_E_ARG);
    assert_int_equal(gn_light_soften(test_context, &light, 1, 0, parts[0]), GN_E_ARG);
    memset(light.towards, 0, sizeof light.towards);
    light.kind = GN_LIGHT_DIRECTIONAL;
    assert_int_equal(gn_light_soften(test_context, &light, 1, 4, parts[0]), GN_E_ARG);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(what_is_lit_is_in_bounds, set_up, tear_down),
        cmocka_unit_test_setup_teardown(what_is_skipped_is_said, set_up, tear_down),
        cmocka_unit_test_setup_teardown(floors_cast_where_they_may, set_up, tear_down),
        cmocka_unit_test_setup_teardown(soft_lights_are_jittered_and_stay, set_up, tear_down),
    };

    return cmocka_run_group_tests_name("bounds", tests, test_open_context, test_close_context);
}
