/* test_laws.c - the two laws of DESIGN.md, decision 2, over random meshes and lights, by way of the index streams that
 * are really drawn.
 *
 * Closure: the signed directed edges of a volume's triangles sum to zero, whatever mesh and light. Shadow: the winding
 * number of the volume about a point is non-zero exactly where some triangle meets the open segment from the point to
 * the light. The first law alone does not see a wrong choice of casting triangles.
 *
 * Meshes lie on a grid of whole numbers, and so do many of the lights: lights on vertices, on edges and in the
 * planes of triangles are common, and double precision decides them exactly. */
#include "gn_matrix.h"
#include "gn_test.h"
#include "gni.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define TRIALS       100000
#define ENDED_TRIALS 10000
#define POINTS       4
#define MOST         512 /* triangles of a mesh here */

static test_mesh soup;
static uint32_t rng;

static float grid(int reach)
{
    return (float)((int)(test_random(&rng) % (unsigned)(2 * reach + 1)) - reach);
}

static void add_tetrahedron(int reach)
{
    uint32_t v[4];

    for (int i = 0; i < 4; i++) {
        const float x = grid(reach), y = grid(reach);

        v[i] = test_add_vertex(&soup, x, y, grid(reach));
    }
    test_add_triangle(&soup, v[0], v[2], v[1]);
    test_add_triangle(&soup, v[0], v[1], v[3]);
    test_add_triangle(&soup, v[1], v[2], v[3]);
    test_add_triangle(&soup, v[2], v[0], v[3]);
}

static void add_random_box(int reach)
{
    float low[3], high[3];

    for (int axis = 0; axis < 3; axis++) {
        low[axis] = grid(reach);
        high[axis] = low[axis] + 1.0f + (float)(test_random(&rng) % 3);
    }
    test_add_box(&soup, low, high, (int)(test_random(&rng) & 1));
}

static void flip_some(void)
{
    for (size_t t = 0; t < soup.triangle_count; t++)
        if (test_random(&rng) % 8 == 0) {
            const uint32_t swapped = soup.indices[3 * t];

            soup.indices[3 * t] = soup.indices[3 * t + 1];
            soup.indices[3 * t + 1] = swapped;
        }
}

/* One of many kinds of mesh, among them closed, open, self-intersecting, nonmanifold, degenerate and doubled ones. */
static void make_soup(void)
{
    const uint32_t kind = test_random(&rng) % 9;
    const uint32_t count = 1 + test_random(&rng) % 4;

    soup.vertex_count = soup.triangle_count = 0;
    if (kind == 0) /* triangles anywhere */
        for (uint32_t i = 0; i < 4 * count; i++) {
            for (int k = 0; k < 3; k++) {
                const float x = grid(2), y = grid(2);

                test_add_vertex(&soup, x, y, grid(2));
            }
            test_add_triangle(&soup, 3 * i, 3 * i + 1, 3 * i + 2);
        }
    else if (kind <= 2) /* closed, sharing vertices, edges and faces; some inside out */
        for (uint32_t i = 0; i < 2 * count; i++)
            add_tetrahedron(kind == 1 ? 1 : 3);
    else if (kind <= 5) { /* boxes beside, within and through each other */
        for (uint32_t i = 0; i < count; i++)
            add_random_box(3);
        if (kind == 5)
            flip_some();
    } else { /* a closed surface with vertices moved: it passes through itself */
        test_add_torus(&soup, 3.0f, 1.0f, 6, 5);
        for (size_t i = 0; i < 3 * soup.vertex_count; i++)
            soup.positions[i] = rintf(soup.positions[i] + (kind == 6 ? 0.0f : grid((int)kind - 6)));
    }
    if (kind % 2 == 1 && soup.triangle_count > 2) /* a hole */
        soup.triangle_count -= 1 + test_random(&rng) % 2;
    if (test_random(&rng) % 4 == 0) { /* doubled and degenerate triangles */
        const uint32_t *t = soup.indices;

        test_add_triangle(&soup, t[0], t[1], t[2]);
        test_add_triangle(&soup, t[3], t[3], t[4]);
        test_add_triangle(&soup, t[0], t[0], t[0]);
    }
}

static void make_light(const gn_mesh *mesh, double light[4])
{
    const gn_mesh_info *info = gn_mesh_get_info(mesh);
    const uint32_t kind = test_random(&rng) % 6;
    const uint32_t *t = info->triangles + 3 * (size_t)(test_random(&rng) % info->triangle_count);
    const double share[2] = {kind == 0 ? 0.0 : 0.5, kind == 2 ? 0.25 : 0.0};

    light[3] = 1.0;
    for (int axis = 0; axis < 3; axis++) {
        double p[3];

        for (int k = 0; k < 3; k++)
            p[k] = (double)info->positions[3 * (size_t)t[k] + (size_t)axis];
        if (kind <= 2) /* on a vertex, an edge, inside a triangle */
            light[axis] = p[0] + share[0] * (p[1] - p[0]) + share[1] * (p[2] - p[0]);
        else if (kind == 3) /* on the grid: often in a plane */
            light[axis] = (double)grid(5);
        else
            light[axis] = test_uniform(&rng, -6.0, 6.0);
    }
    if (kind == 5) { /* a direction, often along an axis or in a plane */
        light[3] = 0.0;
        for (int axis = 0; axis < 3; axis++)
            light[axis] = test_random(&rng) % 2 ? (double)grid(2) : light[axis];
        if (light[0] == 0.0 && light[1] == 0.0 && light[2] == 0.0)
            light[1] = 1.0;
    }
}

/* The volume's triangles as welded vertices: 2 v near, 2 v + 1 far, or 1 for the one far point of a directional
 * light. */
static uint32_t volume_triangles(const gn_mesh *mesh, const gni_casting *casting, int converging, uint32_t (*out)[3])
{
    static uint16_t indices[24 * MOST + GNI_SLACK];
    uint32_t count = 0;

    for (uint32_t c = 0; c < mesh->info.chunk_count; c++) {
        const gn_chunk *chunk = &mesh->info.chunks[c];
        uint32_t n = gni_put_sides(mesh, c, casting, converging, indices), turned;

        if (!converging)
            n += gni_put_dark_cap(mesh, c, casting, indices + n);
        n += gni_put_light_cap(mesh, c, casting, 1, indices + n);
        turned = n;
        n += gni_put_light_cap(mesh, c, casting, -1, indices + n);
        assert_true(n <= GNI_MOST_INDICES * mesh->info.triangle_count);
        for (uint32_t i = 0; i < n; i += 3, count++) {
            for (uint32_t k = 0; k < 3; k++) {
                const uint32_t vertex = mesh->info.chunk_vertices[chunk->first_vertex + indices[i + k] / 2];

                out[count][k] = indices[i + k] % 2 == 0 ? 2 * vertex : converging ? 1 : 2 * vertex + 1;
            }
            if (i >= turned) { /* drawn as it is wound, counted the other way */
                const uint32_t swapped = out[count][0];

                out[count][0] = out[count][1];
                out[count][1] = swapped;
            }
        }
    }
    return count;
}

typedef struct directed {
    uint64_t key;
    int sign;
} directed;

static int by_key(const void *a, const void *b)
{
    const uint64_t x = ((const directed *)a)->key, y = ((const directed *)b)->key;

    return (x > y) - (x < y);
}

static int is_closed(uint32_t (*triangles)[3], uint32_t count)
{
    static directed edges[3 * 8 * MOST];
    uint32_t n = 0;

    for (uint32_t t = 0; t < count; t++)
        for (int k = 0; k < 3; k++) {
            const uint32_t a = triangles[t][k], b = triangles[t][(k + 1) % 3];

            if (a != b)
                edges[n++] = (directed){(uint64_t)(a < b ? a : b) << 32 | (a < b ? b : a), a < b ? 1 : -1};
        }
    qsort(edges, n, sizeof edges[0], by_key);
    for (uint32_t i = 0; i < n;) {
        const uint64_t key = edges[i].key;
        int sum = 0;

        for (; i < n && edges[i].key == key; i++)
            sum += edges[i].sign;
        if (sum != 0)
            return 0;
    }
    return 1;
}

static double triple(const double a[3], const double b[3], const double c[3])
{
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

static double solid_angle(double v[3][3])
{
    double length[3], d[3];

    for (int k = 0; k < 3; k++) {
        const double *a = v[k], *b = v[(k + 1) % 3];

        length[k] = sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
        d[k] = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    }
    return 2.0 * atan2(triple(v[0], v[1], v[2]),
                       length[0] * length[1] * length[2] + d[0] * length[2] + d[1] * length[0] + d[2] * length[1]);
}

/* A vertex of the volume as seen from a point; for one at infinity its direction. */
static void seen_from(const gn_mesh *mesh, uint32_t code, const double light[4], const double point[3], double out[3])
{
    for (int axis = 0; axis < 3; axis++) {
        const double p = (double)mesh->info.positions[3 * (size_t)(code / 2) + (size_t)axis];

        out[axis] = code % 2 == 0 ? p - point[axis] : p * light[3] - light[axis];
    }
}

/* How many triangles meet the open segment from the point to the light; -1 where double precision should not decide. */
static int blockers(const gn_mesh *mesh, const double light[4], const double point[3])
{
    int count = 0;
    double to_light[3];

    for (int axis = 0; axis < 3; axis++)
        to_light[axis] = light[axis] - point[axis] * light[3];
    for (uint32_t t = 0; t < mesh->info.triangle_count; t++) {
        double v[3][3], s[3], before, after;

        for (int k = 0; k < 3; k++)
            for (int axis = 0; axis < 3; axis++)
                v[k][axis] =
                    (double)mesh->info
                        .positions[3 * (size_t)mesh->info.triangles[3 * (size_t)t + (size_t)k] + (size_t)axis] -
                    point[axis];
        for (int k = 0; k < 3; k++)
            s[k] = triple(v[k], v[(k + 1) % 3], to_light);
        before = triple(v[0], v[1], v[2]);                                            /* side of the point */
        after = mesh->planes[4 * t] * light[0] + mesh->planes[4 * t + 1] * light[1] + /* side of the light */
                mesh->planes[4 * t + 2] * light[2] + mesh->planes[4 * t + 3] * light[3];
        if (after == 0.0)
            continue; /* edge-on, or without area */
        if (fabs(before) < 1e-6 || fabs(s[0]) < 1e-6 || fabs(s[1]) < 1e-6 || fabs(s[2]) < 1e-6)
            return -1;
        if ((s[0] > 0.0) == (s[1] > 0.0) && (s[1] > 0.0) == (s[2] > 0.0) && (before > 0.0) == (after > 0.0))
            count++;
    }
    return count;
}

static void both_laws_hold(void **state)
{
    static uint32_t triangles[8 * MOST][3];
    gn_context *context;
    uint32_t sure = 0, shadowed = 0, solid = 0;

    (void)state;
    assert_int_equal(gn_context_create(NULL, &context), GN_OK);
    for (uint32_t trial = 1; trial <= TRIALS; trial++) {
        gn_mesh_desc desc;
        gn_mesh *mesh;
        double light[4];
        uint32_t count;

        rng = trial * 2654435761u | 1u;
        make_soup();
        desc = test_desc(&soup);
        assert_int_equal(gn_mesh_create(context, &desc, &mesh), GN_OK);
        make_light(mesh, light);
        gni_find_casting(mesh, light, &mesh->scratch);
        count = volume_triangles(mesh, &mesh->scratch, light[3] == 0.0, triangles);
        if (!is_closed(triangles, count))
            fail_msg("trial %u: the volume is not closed", trial);
        solid += gn_mesh_get_info(mesh)->solid_part_count;
        for (int i = 0; i < POINTS; i++) {
            const double point[3] = {test_uniform(&rng, -8, 8), test_uniform(&rng, -8, 8), test_uniform(&rng, -8, 8)};
            const int blocked = blockers(mesh, light, point);
            double angle = 0.0;
            int winding;

            if (blocked < 0)
                continue;
            for (uint32_t t = 0; t < count; t++) {
                double v[3][3];

                for (int k = 0; k < 3; k++)
                    seen_from(mesh, triangles[t][k], light, point, v[k]);
                angle += solid_angle(v);
            }
            winding = (int)lrint(angle / (4.0 * 3.14159265358979323846));
            if ((winding != 0) != (blocked != 0))
                fail_msg("trial %u: %d triangles block the light, the volume winds %d times", trial, blocked, winding);
            sure++;
            shadowed += blocked != 0;
        }
        gn_mesh_destroy(mesh);
    }
    gn_context_destroy(context);
    /* the trials must be worth their time: most points decided, many in shadow, many solid parts */
    assert_true(sure > TRIALS * POINTS * 9ull / 10);
    assert_true(shadowed > sure / 20);
    assert_true(solid > TRIALS / 4);
}

/* The image of a volume's vertex in clip space, which for an orthographic camera is an affine image of the world. */
static void clip_position(const gn_plan *plan, const gn_record *r, uint16_t index, double out[3])
{
    const gn_mesh_info *info = gn_mesh_get_info(plan->objects[r->object].mesh);
    const gn_chunk *chunk = &info->chunks[r->chunk];
    const float *p = info->positions + 3 * (size_t)info->chunk_vertices[chunk->first_vertex + index / 2];
    const float *m = index % 2 ? r->far_matrix : r->near_matrix;
    double h[4];

    for (int row = 0; row < 4; row++)
        h[row] = (double)m[row] * (double)p[0] + (double)m[4 + row] * (double)p[1] + (double)m[8 + row] * (double)p[2] +
                 (double)m[12 + row];
    for (int row = 0; row < 3; row++)
        out[row] = h[row] / h[3];
}

static double plan_angle(const gn_plan *plan, const double point[3])
{
    double angle = 0.0;

    for (uint32_t n = 0; n < plan->record_count; n++) {
        const gn_record *r = &plan->records[n];
        const uint32_t upright = r->light_cap_count + r->side_count + r->dark_cap_count + r->near_cap_count;

        for (uint32_t i = 0; i < upright + r->turned_cap_count; i += 3) {
            double v[3][3];

            for (uint32_t k = 0; k < 3; k++) {
                clip_position(plan, r,
                              plan->indices[(i < upright ? r->first_index : r->first_turned_cap - upright) + i + k],
                              v[k]);
                for (int axis = 0; axis < 3; axis++)
                    v[k][axis] -= point[axis];
            }
            angle += (i < upright ? 1.0 : -1.0) * solid_angle(v);
        }
    }
    return angle;
}

static int is_askew(const double plane[4], const double world[16])
{
    double most = 0.0;

    for (int axis = 0; axis < 3; axis++) {
        const double *a = world + 4 * axis;

        most = fmax(most, fmax(fabs(plane[axis]), fabs(a[0] * plane[0] + a[1] * plane[1] + a[2] * plane[2])));
    }
    return most < 0.9999;
}

/* The shadow law for volumes that end on planes: at random points of what an orthographic camera sees, the volumes
 * of a plan wind around the point exactly where the light is blocked. */
static void ended_volumes_shadow_what_is_seen(void **state)
{
    static const double eye[3] = {0, 0, 0}, one[3] = {1, 1, 1};
    gn_context *context;
    uint32_t sure = 0, shadowed = 0, several = 0, own = 0;

    (void)state;
    assert_int_equal(gn_context_create(NULL, &context), GN_OK);
    for (uint32_t trial = 1; trial <= ENDED_TRIALS; trial++) {
        const int large = trial % 2 == 0; /* triangles larger than what is seen, the light close to them */
        gn_object object;
        gn_light light = {.kind = GN_LIGHT_POINT};
        gn_scene scene;
        gn_mesh_desc desc;
        gn_mesh *mesh;
        const gn_plan *plan;
        double at[4], q[4];
        void *memory;

        rng = trial * 2246822519u | 1u;
        make_soup();
        for (size_t i = 0; large && i < 3 * soup.vertex_count; i++)
            soup.positions[i] *= 8.0f;
        desc = test_desc(&soup);
        assert_int_equal(gn_mesh_create(context, &desc, &mesh), GN_OK);
        make_light(mesh, at);
        memset(&object, 0, sizeof object);
        memset(&scene, 0, sizeof scene);
        object.mesh = mesh;
        gn_mat4_identity(object.model);
        object.flags = GN_CASTS | GN_RECEIVES;
        for (int axis = 0; axis < 3; axis++)
            light.position[axis] = light.towards[axis] = at[axis] + (double)mesh->info.centre[axis];
        if (at[3] == 0.0) {
            light.kind = GN_LIGHT_DIRECTIONAL;
            memcpy(light.towards, at, sizeof light.towards);
        }
        for (int k = 0; k < 4; k++)
            q[k] = test_uniform(&rng, -1, 1);
        gn_mat4_from_trs(scene.camera.world, eye, q, one);
        scene.camera.orthographic = 1;
        scene.camera.left = scene.camera.bottom = -5;
        scene.camera.right = scene.camera.top = 5;
        scene.camera.znear = -20;
        scene.lights = &light;
        scene.objects = &object;
        scene.light_count = scene.object_count = 1;
        scene.target = (gn_target)TEST_TARGET(64, 64);
        memory = malloc(gn_plan_bound(&scene));
        assert_int_equal(gn_plan_make(context, &scene, memory, gn_plan_bound(&scene), &plan), GN_OK);
        assert_int_equal(plan->endless_casters, 0);
        several += plan->record_count > 1;
        for (uint32_t n = 0; n < plan->record_count; n++) /* a plane along no axis of the view or of the world */
            own += (uint32_t)is_askew(plan->records[n].end_plane, scene.camera.world);
        for (int i = 0; i < POINTS; i++) {
            double point[3], clip[3];
            const float *m = plan->objects[0].matrix;
            int blocked, winding, seen = 1;

            for (int axis = 0; axis < 3; axis++)
                point[axis] = test_uniform(&rng, large ? -4.0 : (double)mesh->info.box_min[axis],
                                           large ? 4.0 : (double)mesh->info.box_max[axis]);
            for (int row = 0; row < 3; row++) {
                clip[row] = (double)m[row] * point[0] + (double)m[4 + row] * point[1] + (double)m[8 + row] * point[2] +
                            (double)m[12 + row];
                seen &= fabs(clip[row]) < 1.0 && point[row] >= (double)mesh->info.box_min[row] &&
                        point[row] <= (double)mesh->info.box_max[row];
            }
            blocked = blockers(mesh, at, point);
            if (blocked < 0 || !seen)
                continue;
            winding = (int)lrint(plan_angle(plan, clip) / (4.0 * 3.14159265358979323846));
            if ((winding != 0) != (blocked != 0))
                fail_msg("trial %u: %d triangles block the light, the ended volumes wind %d times", trial, blocked,
                         winding);
            sure++;
            shadowed += blocked != 0;
        }
        free(memory);
        gn_mesh_destroy(mesh);
    }
    gn_context_destroy(context);
    assert_true(sure > ENDED_TRIALS * POINTS / 2);
    assert_true(shadowed > sure / 20);
    assert_true(several > ENDED_TRIALS / 20); /* casters that one plane does not end are among them, */
    assert_true(own > ENDED_TRIALS / 100);    /* and triangles that need a plane of their own */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(both_laws_hold),
        cmocka_unit_test(ended_volumes_shadow_what_is_seen),
    };

    return cmocka_run_group_tests_name("laws", tests, NULL, NULL);
}
