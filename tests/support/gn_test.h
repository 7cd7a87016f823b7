/* gn_test.h - what the tests share: cmocka, a port that counts and can fail, random numbers, small meshes. */
#ifndef GN_TEST_H
#define GN_TEST_H
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "gnomon.h"

/* A target of width by height that can do everything. */
#define TEST_EVERYTHING ((1u << GN_CAPABILITY_COUNT) - 1)
#define TEST_TARGET(width, height)                                                                                     \
    {                                                                                                                  \
        width, height, 8, 8, 8, 8, 24, 8, 24, 0, 0, 0, 23, TEST_EVERYTHING, TEST_EVERYTHING, 0                         \
    }

/* A port that counts live bytes and calls, and refuses every allocation from the one numbered fail_at on (0: never). */
typedef struct test_port {
    size_t live_bytes, calls, fail_at;
} test_port;

gn_port test_port_make(test_port *counter);

/* A context over libc's port for all tests of a group: its set-up and tear-down. */
extern gn_context *test_context;
int test_open_context(void **state);
int test_close_context(void **state);

/* xorshift; the seed must not be 0. */
uint32_t test_random(uint32_t *state);
double test_uniform(uint32_t *state, double low, double high);

/* A mesh in arrays, built by adding triangles. */
typedef struct test_mesh {
    float positions[3 * 12000];
    uint32_t indices[3 * 20000];
    size_t vertex_count, triangle_count;
} test_mesh;

uint32_t test_add_vertex(test_mesh *m, float x, float y, float z);
void test_add_triangle(test_mesh *m, uint32_t a, uint32_t b, uint32_t c);
/* An axis-aligned box, front faces outward (inward: the other way), with vertices of its own. */
void test_add_box(test_mesh *m, const float low[3], const float high[3], int inward);
/* A closed torus about y with `around` by `tube` quads. */
void test_add_torus(test_mesh *m, float radius, float tube_radius, uint32_t around, uint32_t tube);
gn_mesh_desc test_desc(const test_mesh *m);
#endif
