/* test_layers.c - more layers than bits: what must hold of the bound, of batches and of the pieces in them, whatever
 * mesh and light. */
#include "frame.h"
#include "gn_matrix.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SAMPLES = 1500 };

static uint32_t rng = 4711;

static gn_mesh *make_mesh(const test_mesh *m)
{
    const gn_mesh_desc desc = test_desc(m);
    gn_mesh *mesh = NULL;

    assert_int_equal(gn_mesh_create(test_context, &desc, &mesh), GN_OK);
    return mesh;
}

/* Random triangles, most of them across the y axis. */
static void make_pile(test_mesh *m, uint32_t count)
{
    m->vertex_count = m->triangle_count = 0;
    for (uint32_t i = 0; i < count; i++) {
        const double y = test_uniform(&rng, -1, 1), turn = test_uniform(&rng, 0, 6.3),
                     size = test_uniform(&rng, 0.2, 1.5);
        uint32_t v[3];

        for (int k = 0; k < 3; k++)
            v[k] = test_add_vertex(m, (float)(size * cos(turn + 2.1 * k) + test_uniform(&rng, -0.3, 0.3)),
                                   (float)(y + test_uniform(&rng, -0.1, 0.1)),
                                   (float)(size * sin(turn + 2.1 * k) + test_uniform(&rng, -0.3, 0.3)));
        test_add_triangle(m, v[0], v[1], v[2]);
    }
}

/* One sheet that hangs together and winds about the y axis. */
static void make_helix(test_mesh *m, uint32_t turns, uint32_t segments)
{
    m->vertex_count = m->triangle_count = 0;
    for (uint32_t i = 0; i <= turns * segments; i++) {
        const double angle = 6.283185307179586 * i / segments, y = 2.0 * i / (turns * segments) - 1.0;

        test_add_vertex(m, (float)(0.3 * cos(angle)), (float)y, (float)(0.3 * sin(angle)));
        test_add_vertex(m, (float)cos(angle), (float)y, (float)sin(angle));
        if (i > 0) {
            test_add_triangle(m, 2 * i - 2, 2 * i, 2 * i + 1);
            test_add_triangle(m, 2 * i - 2, 2 * i + 1, 2 * i - 1);
        }
    }
}

/* Closed boxes within each other. */
static void make_boxes(test_mesh *m, uint32_t count)
{
    m->vertex_count = m->triangle_count = 0;
    for (uint32_t i = 0; i < count; i++) {
        const float r = 0.2f + 0.8f * (float)i / (float)count, low[3] = {-r, -r, -r}, high[3] = {r, r, r};

        test_add_box(m, low, high, 0);
    }
}

/* Cones of many turns, their triangles dealt out to four pieces so that each meets the others along many edges and
 * takes many of their triangles; and small chains between. */
static void make_cones(test_mesh *m, uint32_t count)
{
    enum { BLADES = 266 };

    m->vertex_count = m->triangle_count = 0;
    for (uint32_t n = 0; n < count; n++) {
        const double y = 0.1 * n - 0.05 * count;
        const uint32_t apex = test_add_vertex(m, 0, (float)y, 0);
        uint32_t first = 0;

        for (uint32_t i = 0; i <= BLADES; i++) {
            const uint32_t v = test_add_vertex(m, (float)cos(3.0 * i), (float)(y + 1e-4 * i), (float)-sin(3.0 * i));

            first = i == 0 ? v : first;
        }
        for (uint32_t hand = 0; hand < 4; hand++)
            for (uint32_t i = hand; i < BLADES; i += 4)
                test_add_triangle(m, apex, first + i, first + i + 1);
        for (uint32_t i = 0; i < 8; i++) {
            const float h = (float)(y + 0.05 + 1e-3 * i);
            const uint32_t a = test_add_vertex(m, -1, h, 1), b = test_add_vertex(m, 1, h, 1);

            test_add_triangle(m, a, b, test_add_vertex(m, 0, h, -1));
        }
    }
}

typedef struct ray {
    double from[3], along[3];
} ray;

/* From the light towards (point) or against it (directional) somewhere near the y axis. */
static ray make_ray(const gn_light *light)
{
    ray r;

    for (int i = 0; i < 3; i++) {
        const double at = test_uniform(&rng, -1.2, 1.2);

        r.along[i] = light->kind == GN_LIGHT_DIRECTIONAL ? -light->towards[i] : at - light->position[i];
        r.from[i] = light->kind == GN_LIGHT_DIRECTIONAL ? at + 9.0 * light->towards[i] : light->position[i];
    }
    return r;
}

static int hits(const ray *r, const float *a, const float *b, const float *c)
{
    const float *const v[3] = {a, b, c};
    double side[3];

    for (int k = 0; k < 3; k++) {
        double p[3], q[3];

        for (int i = 0; i < 3; i++) {
            p[i] = (double)v[k][i] - r->from[i];
            q[i] = (double)v[(k + 1) % 3][i] - r->from[i];
        }
        side[k] = r->along[0] * (p[1] * q[2] - p[2] * q[1]) + r->along[1] * (p[2] * q[0] - p[0] * q[2]) +
                  r->along[2] * (p[0] * q[1] - p[1] * q[0]);
    }
    if (!((side[0] > 1e-9 && side[1] > 1e-9 && side[2] > 1e-9) ||
          (side[0] < -1e-9 && side[1] < -1e-9 && side[2] < -1e-9)))
        return 0;
    {
        double n[3], p[3], e[2][3];

        for (int i = 0; i < 3; i++) {
            p[i] = (double)a[i] - r->from[i];
            e[0][i] = (double)b[i] - (double)a[i];
            e[1][i] = (double)c[i] - (double)a[i];
        }
        n[0] = e[0][1] * e[1][2] - e[0][2] * e[1][1];
        n[1] = e[0][2] * e[1][0] - e[0][0] * e[1][2];
        n[2] = e[0][0] * e[1][1] - e[0][1] * e[1][0];
        return (n[0] * p[0] + n[1] * p[1] + n[2] * p[2]) /
                   (n[0] * r->along[0] + n[1] * r->along[1] + n[2] * r->along[2]) >
               0.0;
    }
}

static const float *position(const gn_plan *plan, const gn_record *r, uint16_t index)
{
    const gn_mesh_info *info = gn_mesh_get_info(plan->objects[r->object].mesh);

    return info->positions + 3 * (size_t)info->chunk_vertices[info->chunks[r->chunk].first_vertex + index / 2];
}

/* How many of the record's casting triangles, which are its light cap, the ray hits. */
static uint32_t layers_of(const gn_plan *plan, const gn_record *r, const ray *way)
{
    uint32_t count = 0;

    for (uint32_t i = 0; i < r->light_cap_count + r->turned_cap_count; i += 3) {
        const uint16_t *at =
            plan->indices + (i < r->light_cap_count ? r->first_index : r->first_turned_cap - r->light_cap_count) + i;

        count += (uint32_t)hits(way, position(plan, r, at[0]), position(plan, r, at[1]), position(plan, r, at[2]));
    }
    return count;
}

/* The directed edges of a record's triangles cancel: each piece is a closed volume. A directional light's far vertices
 * are one point. */
static void check_closed(const gn_plan *plan, const gn_record *r, int converging)
{
    const gn_mesh_info *info = gn_mesh_get_info(plan->objects[r->object].mesh);
    const uint32_t count = r->side_count + r->dark_cap_count + r->light_cap_count + r->turned_cap_count;
    const uint32_t turned = count - r->turned_cap_count, size = 2 * info->chunks[r->chunk].vertex_count;
    int64_t *sum = calloc(size, sizeof *sum);

    /* around every vertex, weighed by a number of the other end: what leaves and what arrives is the same */
    for (uint32_t i = 0; i < count; i += 3)
        for (uint32_t k = 0; k < 3; k++) {
            const uint16_t *t = plan->indices + r->first_index + i;
            uint16_t a = t[i >= turned ? (k + 1) % 3 : k], b = t[i >= turned ? k : (k + 1) % 3];

            a = converging && a % 2 ? 1 : a;
            b = converging && b % 2 ? 1 : b;

            sum[a] += (int64_t)(b * 2654435761u >> 8);
            sum[b] -= (int64_t)(a * 2654435761u >> 8);
        }
    for (uint32_t v = 0; v < size; v++)
        if (sum[v] != 0)
            fail_msg("the piece of record %lu is open at vertex %lu", (unsigned long)(r - plan->records),
                     (unsigned long)v);
    free(sum);
}

/* Plans one caster by z-fail, and looks at its batches along random rays. Returns the batches. */
static uint32_t check(const gn_mesh *mesh, const gn_light *light, uint32_t hidden)
{
    gn_object object = {.mesh = mesh, .flags = GN_CASTS | GN_RECEIVES};
    gn_scene scene;
    const gn_plan *plan;
    size_t size;
    void *memory;
    int8_t *casting = malloc(gn_mesh_get_info(mesh)->triangle_count);
    const gn_mesh_info *info = gn_mesh_get_info(mesh);
    uint32_t batches;

    memset(&scene, 0, sizeof scene);
    gn_mat4_identity(object.model);
    gn_mat4_identity(scene.camera.world);
    for (int i = 0; i < 3; i++) /* where the mesh's own space, less its centre, is the world */
        object.model[12 + i] = -(double)info->centre[i];
    scene.camera.world[14] = 9;
    scene.camera.left = scene.camera.bottom = -0.5;
    scene.camera.right = scene.camera.top = 0.5;
    scene.camera.znear = 0.1;
    scene.lights = light;
    scene.light_count = scene.object_count = 1;
    scene.objects = &object;
    scene.target = (gn_target)TEST_TARGET(64, 48);
    scene.target.hidden = hidden;
    scene.method = GN_METHOD_ZFAIL;
    size = gn_plan_bound(&scene);
    memory = malloc(size);
    assert_int_equal(gn_plan_make(test_context, &scene, memory, size, &plan), GN_OK);
    /* its arrays stand in this order in the memory: none runs into the next */
    assert_true(plan->steps + plan->step_count <= (const gn_step *)(const void *)plan->lights);
    assert_true((const char *)(plan->records + plan->record_count) <= (const char *)plan->indices);
    assert_true((const char *)(plan->indices + plan->index_count) <= (const char *)memory + size);
    gn_object_casting(&object, light, casting);
    for (uint32_t r = 0; r < plan->record_count; r++)
        check_closed(plan, &plan->records[r], light->kind == GN_LIGHT_DIRECTIONAL);
    for (int n = 0; n < SAMPLES; n++) {
        const ray way = make_ray(light);
        uint32_t truth = 0, counted = 0, most = 0;

        for (uint32_t t = 0; t < info->triangle_count; t++) {
            const uint32_t *c = info->triangles + 3 * (size_t)t;

            truth += casting[t] && hits(&way, info->positions + 3 * (size_t)c[0], info->positions + 3 * (size_t)c[1],
                                        info->positions + 3 * (size_t)c[2]);
        }
        for (uint32_t s = 0; s < plan->step_count; s++) {
            uint32_t of_batch = 0;

            if (plan->steps[s].kind != GN_STEP_VOLUMES)
                continue;
            for (uint32_t r = 0; r < plan->steps[s].record_count; r++)
                of_batch += layers_of(plan, &plan->records[plan->steps[s].first_record + r], &way);
            counted += of_batch;
            most = of_batch > most ? of_batch : most;
        }
        if (most > plan->lights[0].layers || most > (uint32_t)plan->lights[0].stencil.high)
            fail_msg("%lu layers in a batch of at most %lu", (unsigned long)most,
                     (unsigned long)plan->lights[0].layers);
        if (counted < truth || (truth == 0) != (counted == 0))
            fail_msg("%lu of %lu layers are counted", (unsigned long)counted, (unsigned long)truth);
    }
    batches = plan->lights[0].batches;
    assert_int_equal(batches > 1, plan->lights[0].stencil.flag != 0);
    free(casting);
    free(memory);
    return batches;
}

static void make_light(gn_light *light, int kind)
{
    memset(light, 0, sizeof *light);
    light->kind = kind == 2 ? GN_LIGHT_DIRECTIONAL : GN_LIGHT_POINT;
    for (int i = 0; i < 3; i++) {
        light->position[i] = test_uniform(&rng, -0.6, 0.6);
        light->towards[i] = i == 1 ? 1.0 : test_uniform(&rng, -0.1, 0.1);
    }
    if (kind == 0) /* outside; else among the triangles */
        light->position[1] = test_uniform(&rng, 1.5, 1e3);
}

static void no_batch_holds_more_than_it_says(void **state)
{
    static test_mesh m;
    uint32_t several = 0, runs = 0;

    (void)state;
    for (int trial = 0; trial < 24; trial++) {
        gn_mesh *mesh;
        gn_light light;

        if (trial % 8 == 7)
            make_cones(&m, 4 + test_random(&rng) % 30);
        else if (trial % 3 == 0)
            make_pile(&m, 100 + test_random(&rng) % 900);
        else if (trial % 3 == 1)
            make_helix(&m, 100 + test_random(&rng) % 250, 12);
        else
            make_boxes(&m, 100 + test_random(&rng) % 300);
        mesh = make_mesh(&m);
        make_light(&light, trial % 8 == 7 ? 2 : trial / 3 % 3);
        if (trial % 8 == 7)
            light.towards[0] = light.towards[2] = 0.0;
        several += check(mesh, &light, trial % 4 == 3 ? 1u << GN_CAN_STENCIL_WRAP : 0) > 1;
        runs++;
        gn_mesh_destroy(mesh);
    }
    print_message("           %lu of %lu need several batches\n", (unsigned long)several, (unsigned long)runs);
    assert_true(several >= 10 && several < runs);
}

/* Meshes that do not nest are never batched, however many triangles cast: 250 boxes side by side, seen from near and
 * far. */
static void what_does_not_nest_is_in_one_batch(void **state)
{
    static test_mesh m;
    static const double heights[] = {1.5, 4, 100, 1e6};
    gn_light light;
    gn_mesh *mesh;

    (void)state;
    m.vertex_count = m.triangle_count = 0;
    for (int i = 0; i < 250; i++) {
        const float x = (float)(i % 16 - 8) * 0.12f, z = (float)(i / 16 - 8) * 0.12f;
        const float low[3] = {x, -0.05f, z}, high[3] = {x + 0.1f, 0.05f, z + 0.1f};

        test_add_box(&m, low, high, 0);
    }
    mesh = make_mesh(&m);
    for (size_t i = 0; i < sizeof heights / sizeof heights[0]; i++) {
        make_light(&light, 0);
        light.position[1] = heights[i];
        assert_int_equal(check(mesh, &light, 0), 1);
    }
    make_light(&light, 2);
    assert_int_equal(check(mesh, &light, 0), 1);
    gn_mesh_destroy(mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(no_batch_holds_more_than_it_says),
                                       cmocka_unit_test(what_does_not_nest_is_in_one_batch)};

    return cmocka_run_group_tests_name("layers", tests, test_open_context, test_close_context);
}
