/* test_intervals.c - volumes in intervals: whatever the eye sees is in one of each object that stands between it and the
 * light, in however many pieces; and each piece is a closed volume. */
#include "gn_matrix.h"
#include "gn_test.h"
#include "pile.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { TRIALS = 250, POINTS = 60, OBJECTS = 6 };

static uint32_t rng = 31;
static pile_mesh lump;
static gn_mesh *welded; /* the same, its edges welded by angle */

typedef struct world {
    gn_scene scene;
    gn_light light;
    uint32_t exempt;
    gn_object objects[OBJECTS];
    const gn_plan *plan;
    void *memory;
} world;

/* Lumps strewn along a beam, seen from anywhere; not all of them cast. */
static void make_world(world *w)
{
    static const double scale[3] = {1, 1, 1};
    double axis[3], length, eye[3], at[3];

    memset(w, 0, sizeof *w);
    for (int k = 0; k < 3; k++)
        axis[k] = test_uniform(&rng, -1, 1);
    length = sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
    w->light.kind = test_random(&rng) % 3 ? GN_LIGHT_POINT : GN_LIGHT_DIRECTIONAL;
    for (int k = 0; k < 3; k++) {
        w->light.position[k] = 6.0 * axis[k] / length;
        w->light.towards[k] = axis[k];
    }
    w->light.range = test_random(&rng) % 4 ? 0.0 : 14.0;
    for (uint32_t i = 0; i < OBJECTS; i++) {
        const double along = test_uniform(&rng, -9, 3);
        double place[3], q[4];

        for (int k = 0; k < 3; k++)
            place[k] = along * axis[k] / length + test_uniform(&rng, -0.6, 0.6);
        for (int k = 0; k < 4; k++)
            q[k] = test_uniform(&rng, -1, 1);
        gn_mat4_from_trs(w->objects[i].model, place, q, scale);
        w->objects[i].mesh = test_random(&rng) % 3 ? lump.mesh : welded;
        w->objects[i].flags = GN_RECEIVES | GN_DRAWN | (test_random(&rng) % 2 ? GN_DRAWN_BACKS : 0u) |
                              (test_random(&rng) % 6 ? GN_CASTS : 0u);
    }
    w->exempt = test_random(&rng) % OBJECTS;
    w->light.exempt = &w->exempt;
    w->light.exempt_count = test_random(&rng) % 2;
    for (int k = 0; k < 3; k++) {
        at[k] = test_uniform(&rng, -6, 2) * axis[k] / length;
        eye[k] = at[k] + test_uniform(&rng, -9, 9);
    }
    pile_look_at(w->scene.camera.world, eye, at);
    w->scene.camera.right = w->scene.camera.top = 0.7;
    w->scene.camera.left = w->scene.camera.bottom = -0.7;
    w->scene.camera.znear = 0.1;
    w->scene.lights = &w->light;
    w->scene.objects = w->objects;
    w->scene.light_count = 1;
    w->scene.object_count = OBJECTS;
    w->scene.target = (gn_target)TEST_TARGET(256, 256);
    w->scene.method = GN_METHOD_STENCIL;
    w->memory = malloc(gn_plan_bound(&w->scene));
    if (gn_plan_make(test_context, &w->scene, w->memory, gn_plan_bound(&w->scene), &w->plan) != GN_OK)
        fail_msg("%s", gn_message(test_context));
}

static void corners_of(double v[3][3], const world *w, uint32_t object, size_t triangle)
{
    for (int k = 0; k < 3; k++) {
        const float *p = lump.positions + 3 * (size_t)lump.indices[3 * triangle + (size_t)k];
        const double given[3] = {(double)p[0], (double)p[1], (double)p[2]};

        gn_mat4_transform(v[k], w->objects[object].model, given, 1.0);
    }
}

static double triple(const double a[3], const double b[3], const double c[3])
{
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

static int casts(const world *w, uint32_t object)
{
    return w->objects[object].flags & GN_CASTS && !(w->light.exempt_count && w->exempt == object);
}

/* Which objects a segment from p towards the light meets, a bit each. */
static unsigned blockers(const world *w, const double p[3])
{
    double way[3];
    unsigned found = 0;

    for (int k = 0; k < 3; k++)
        way[k] = w->light.kind == GN_LIGHT_POINT ? w->light.position[k] - p[k] : w->light.towards[k] * 1e3;
    for (uint32_t i = 0; i < OBJECTS; i++)
        for (size_t t = 0; t < lump.triangle_count && !(found >> i & 1) && casts(w, i); t++) {
            double v[3][3], side[3], sum;

            corners_of(v, w, i, t);
            for (int k = 0; k < 3; k++)
                for (int axis = 0; axis < 3; axis++)
                    v[k][axis] -= p[axis];
            for (int k = 0; k < 3; k++)
                side[k] = triple(way, v[k], v[(k + 1) % 3]);
            sum = side[0] + side[1] + side[2];
            if ((side[0] > 0 && side[1] > 0 && side[2] > 0) || (side[0] < 0 && side[1] < 0 && side[2] < 0)) {
                const double share = triple(v[0], v[1], v[2]) / sum; /* of the way */

                found |= share > 0.0 && share < 1.0 ? 1u << i : 0u;
            }
        }
    return found;
}

static double height(const double plane[4], const double p[3])
{
    return plane[0] * p[0] + plane[1] * p[1] + plane[2] * p[2] + plane[3];
}

/* Whether a volume of the object holds the point. */
static int is_held(const world *w, const double p[3], uint32_t object)
{
    for (uint32_t i = 0; i < w->plan->record_count; i++) {
        const gn_record *r = &w->plan->records[i];

        if (r->object == object && (r->far_end != GN_FAR_ENDED || height(r->end_plane, p) > 0) &&
            (!r->detached || height(r->start_plane, p) < 0))
            return 1;
    }
    return 0;
}

static int is_in_view(const gn_camera *c, const double p[3])
{
    double v[3];

    for (int i = 0; i < 3; i++)
        v[i] = (p[0] - c->world[12]) * c->world[4 * i] + (p[1] - c->world[13]) * c->world[4 * i + 1] +
               (p[2] - c->world[14]) * c->world[4 * i + 2];
    return -v[2] > c->znear && fabs(v[0]) < c->right * -v[2] && fabs(v[1]) < c->top * -v[2];
}

static void what_is_seen_is_held(void **state)
{
    uint32_t sure = 0, shadowed = 0, detached = 0, spared = 0;

    (void)state;
    for (int trial = 0; trial < TRIALS; trial++) {
        world w;
        const double *eye;

        make_world(&w);
        eye = w.scene.camera.world + 12;
        for (uint32_t i = 0; i < w.plan->record_count; i++)
            detached += w.plan->records[i].detached != 0;
        for (int n = 0; n < POINTS; n++) {
            const uint32_t object = test_random(&rng) % OBJECTS;
            double v[3][3], p[3], normal[3], edges[2][3], weights[3], sum = 0.0, length, to_eye[3], far = 0.0;
            unsigned blocking;
            int same = 1;

            corners_of(v, &w, object, test_random(&rng) % lump.triangle_count);
            for (int k = 0; k < 3; k++)
                sum += weights[k] = test_uniform(&rng, 0.1, 1);
            for (int k = 0; k < 3; k++) {
                p[k] = (weights[0] * v[0][k] + weights[1] * v[1][k] + weights[2] * v[2][k]) / sum;
                edges[0][k] = v[1][k] - v[0][k];
                edges[1][k] = v[2][k] - v[0][k];
            }
            for (int k = 0; k < 3; k++)
                normal[k] =
                    edges[0][(k + 1) % 3] * edges[1][(k + 2) % 3] - edges[0][(k + 2) % 3] * edges[1][(k + 1) % 3];
            length = sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
            for (int k = 0; k < 3; k++) {
                p[k] += 1e-4 * normal[k] / length;
                to_eye[k] = eye[k] - p[k];
                far += (p[k] - w.light.position[k]) * (p[k] - w.light.position[k]);
            }
            if (normal[0] * to_eye[0] + normal[1] * to_eye[1] + normal[2] * to_eye[2] <= 0.0 ||
                (w.light.range > 0.0 && w.light.kind == GN_LIGHT_POINT && sqrt(far) > w.light.range))
                continue; /* not seen, or not lit */
            if (!is_in_view(&w.scene.camera, p))
                continue;
            blocking = blockers(&w, p);
            for (int j = 0; j < 6; j++) {
                double q[3] = {p[0], p[1], p[2]};

                q[j / 2] += j % 2 ? 2e-5 : -2e-5;
                same &= (blockers(&w, q) != 0) == (blocking != 0);
            }
            if (!same)
                continue;
            for (uint32_t by = 0; by < OBJECTS; by++)
                if (blocking >> by & 1 && !is_held(&w, p, by))
                    fail_msg("trial %d: a point of object %u is blocked by object %u, and in none of its volumes",
                             trial, (unsigned)object, (unsigned)by);
            sure++;
            shadowed += blocking != 0;
            for (uint32_t by = 0; by < OBJECTS; by++)
                spared += by != object && !(blocking >> by & 1) && !is_held(&w, p, by);
        }
        free(w.memory);
    }
    print_message(
        "           %lu points, %lu in shadow; %lu detached volumes; %lu times one ends before or starts behind\n",
        (unsigned long)sure, (unsigned long)shadowed, (unsigned long)detached, (unsigned long)spared);
    assert_true(sure > 2000 && shadowed > 800 && sure - shadowed > 400 && detached > 100 && spared > 100);
}

static void intervals_are_closed(void **state)
{
    uint32_t checked = 0;

    (void)state;
    for (int trial = 0; trial < TRIALS; trial++) {
        world w;

        make_world(&w);
        for (uint32_t i = 0; i < w.plan->record_count; i++) {
            const gn_record *r = &w.plan->records[i];
            const uint32_t count = r->light_cap_count + r->side_count + r->dark_cap_count + r->near_cap_count;
            const uint32_t size = 2 * (gn_mesh_get_info(lump.mesh)->vertex_count + 1);
            int64_t *sum = calloc(size, sizeof *sum);

            /* around every vertex, weighed by a number of the other end: what leaves and what arrives is the same */
            for (uint32_t k = 0; r->detached && k < count; k++) {
                const uint16_t *t = w.plan->indices + r->first_index + k / 3 * 3;
                const uint16_t a = t[k % 3], b = t[(k + 1) % 3];

                sum[a] += (int64_t)(b * 2654435761u >> 8);
                sum[b] -= (int64_t)(a * 2654435761u >> 8);
            }
            for (uint32_t v = 0; v < size; v++)
                assert_int_equal(sum[v], 0);
            checked += r->detached != 0;
            free(sum);
        }
        free(w.memory);
    }
    assert_true(checked > 100);
}

static int open_all(void **state)
{
    gn_mesh_desc desc = {0};

    if (test_open_context(state) || !pile_make_lump(&lump, test_context, 9, 8))
        return 1;
    desc.positions = lump.positions;
    desc.vertex_count = lump.vertex_count;
    desc.indices = lump.indices;
    desc.triangle_count = lump.triangle_count;
    desc.weld_angle = 0.9;
    return gn_mesh_create(test_context, &desc, &welded) != GN_OK;
}

static int close_all(void **state)
{
    gn_mesh_destroy(welded);
    pile_drop(&lump);
    return test_close_context(state);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_seen_is_held),
        cmocka_unit_test(intervals_are_closed),
    };

    return cmocka_run_group_tests_name("intervals", tests, open_all, close_all);
}
