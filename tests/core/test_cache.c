/* test_cache.c - what a cache keeps is what would be made: the same triangles, frame for frame, whatever moves; a still
 * light and caster are found once and send no index; looser rules keep shadows as long as they say and no longer. */
#include "frame.h"
#include "gn_matrix.h"
#include "gni_plan.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static test_frame f;
static gn_shadow_cache *cache;

static int set_up(void **state)
{
    const gn_target target = TEST_TARGET(320, 240);

    (void)state;
    cache = NULL;
    return test_frame_make(&f, test_context, NULL, target) != GN_OK;
}

static int tear_down(void **state)
{
    (void)state;
    gn_shadow_cache_destroy(cache);
    test_frame_drop(&f, NULL);
    return 0;
}

static void open_cache(uint32_t every, double distance)
{
    const gn_shadow_cache_desc desc = {every, distance, 0};

    assert_int_equal(gn_shadow_cache_create(test_context, &desc, &cache), GN_OK);
    f.scene.cache = cache;
}

static void plan(void)
{
    assert_int_equal(gn_plan_make(test_context, &f.scene, f.memory, f.size, &f.plan), GN_OK);
}

typedef struct triangle {
    uint32_t light, object, at[3];
    int turned, patch;
} triangle;

static int by_value(const void *a, const void *b)
{
    return memcmp(a, b, sizeof(triangle));
}

/* All triangles of a plan's volumes, sorted, but for light caps. */
static size_t list(const gn_plan *p, triangle *out, size_t capacity)
{
    size_t count = 0;

    for (uint32_t i = 0; i < p->record_count; i++) {
        const gn_record *r = &p->records[i];
        const uint16_t *from = r->is_cached ? p->cached_indices : p->indices;

        for (int part = 0; part < 2; part++) {
            const uint32_t first = part ? r->first_dark_cap : r->first_side;

            for (uint32_t k = 0; k < (part ? r->dark_cap_count : r->side_count); k += 3) {
                triangle *t = &out[count++];

                assert_true(count < capacity);
                memset(t, 0, sizeof *t);
                t->light = r->light;
                t->object = r->object;
                t->patch = (int)r->patch;
                for (int c = 0; c < 3; c++)
                    t->at[c] = from[first + k + (uint32_t)c];
            }
        }
    }
    qsort(out, count, sizeof *out, by_value);
    return count;
}

static void kept_is_what_would_be_made(void **state)
{
    static triangle with[4000], without[4000];
    uint32_t cached = 0;

    (void)state;
    open_cache(0, 0.0);
    for (int frame = 0; frame < 40; frame++) {
        size_t counts[2];

        f.scene.camera.world[12] = 3 * sin(frame);
        f.scene.camera.world[13] = 3 + 2 * cos(0.7 * frame);
        if (frame % 10 == 9) /* now and then a light moves, or a caster */
            f.lights[0].position[0] += 0.3;
        if (frame % 10 == 4)
            f.objects[0].model[12] += 0.1;
        f.scene.cache = NULL;
        plan();
        counts[0] = list(f.plan, without, 4000);
        f.scene.cache = cache;
        plan();
        counts[1] = list(f.plan, with, 4000);
        for (uint32_t i = 0; i < f.plan->record_count; i++)
            cached += f.plan->records[i].is_cached != 0;
        assert_int_equal(counts[0], counts[1]);
        assert_memory_equal(with, without, counts[0] * sizeof *with);
    }
    assert_true(cached > 40);
}

static void what_is_still_is_found_once(void **state)
{
    uint32_t version = 0;

    (void)state;
    open_cache(0, 0.0);
    for (int frame = 0; frame < 8; frame++) {
        f.scene.camera.world[12] = 0.1 * frame;
        plan();
        if (frame < 4)
            continue;
        assert_int_equal(f.plan->index_count, 0);
        assert_int_equal(f.plan->cache_built, 0);
        assert_true(f.plan->cached_index_count > 0);
        assert_true(frame == 4 || f.plan->cache_version == version);
        version = f.plan->cache_version;
    }
    f.lights[0].position[1] += 0.5;
    plan();
    assert_true(f.plan->index_count > 0); /* it moves: nothing is kept */
    plan();
    assert_true(f.plan->cache_built > 0);
    plan();
    assert_int_equal(f.plan->cache_built, 0);
    assert_int_equal(f.plan->index_count, 0);
    assert_true(f.plan->lights[0].light_moved == 0.0);
}

static void shadows_lag_as_long_as_is_said(void **state)
{
    uint32_t built = 0;

    (void)state;
    open_cache(4, 0.0);
    for (int frame = 0; frame < 30; frame++) {
        f.lights[0].position[0] = 2 + 0.01 * frame;
        plan();
        built += frame >= 6 && f.plan->cache_built > 0;
        assert_true(f.plan->lights[0].light_moved < 0.031);
        if (frame >= 6)
            assert_int_equal(f.plan->index_count, 0);
    }
    assert_int_equal(built, 6);
    gn_shadow_cache_destroy(cache);
    open_cache(0, 0.025);
    built = 0;
    for (int frame = 0; frame < 30; frame++) {
        f.lights[0].position[0] = 2 + 0.01 * frame;
        plan();
        built += frame >= 6 && f.plan->cache_built > 0;
        assert_true(f.plan->lights[0].light_moved <= 0.025 + 1e-12);
    }
    assert_int_equal(built, 8);
}

static void new_shapes_are_found(void **state)
{
    const gn_mesh_info *info = gn_mesh_get_info(f.meshes[0]);
    static float positions[3 * 64];

    (void)state;
    open_cache(100, 0.0);
    for (int frame = 0; frame < 5; frame++)
        plan();
    assert_int_equal(f.plan->cache_built, 0);
    for (uint32_t i = 0; i < 3 * info->vertex_count; i++)
        positions[i] = 1.5f * info->positions[i] + info->centre[i % 3];
    assert_int_equal(gn_mesh_update(f.meshes[0], positions, 0), GN_OK);
    plan();
    assert_true(f.plan->cache_built > 0);
}

static void bad_caches_are_refused(void **state)
{
    const gn_shadow_cache_desc desc = {0, -1.0, 0};

    (void)state;
    assert_int_equal(gn_shadow_cache_create(test_context, &desc, &cache), GN_E_ARG);
    assert_null(cache);
    assert_non_null(strstr(gn_message(test_context), "-1"));
    assert_int_equal(gn_shadow_cache_create(test_context, NULL, &cache), GN_E_ARG);
    gn_shadow_cache_destroy(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(kept_is_what_would_be_made, set_up, tear_down),
        cmocka_unit_test_setup_teardown(what_is_still_is_found_once, set_up, tear_down),
        cmocka_unit_test_setup_teardown(shadows_lag_as_long_as_is_said, set_up, tear_down),
        cmocka_unit_test_setup_teardown(new_shapes_are_found, set_up, tear_down),
        cmocka_unit_test_setup_teardown(bad_caches_are_refused, set_up, tear_down),
    };

    return cmocka_run_group_tests_name("cache", tests, test_open_context, test_close_context);
}
