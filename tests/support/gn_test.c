/* gn_test.c - see gn_test.h. */
#include "gn_test.h"

#include <math.h>
#include <stdlib.h>

static void *counting_resize(void *user, void *block, size_t old_size, size_t new_size)
{
    test_port *t = user;
    void *fresh;

    if (new_size == 0) {
        t->live_bytes -= block ? old_size : 0;
        free(block);
        return NULL;
    }
    t->calls++;
    if (t->fail_at && t->calls >= t->fail_at)
        return NULL;
    fresh = realloc(block, new_size);
    if (fresh)
        t->live_bytes += new_size - (block ? old_size : 0);
    return fresh;
}

gn_port test_port_make(test_port *counter)
{
    const gn_port port = {GN_PORT_VERSION, counter, counting_resize, NULL, NULL, NULL};

    return port;
}

gn_context *test_context;

int test_open_context(void **state)
{
    (void)state;
    return gn_context_create(NULL, &test_context) != GN_OK;
}

int test_close_context(void **state)
{
    (void)state;
    gn_context_destroy(test_context);
    test_context = NULL;
    return 0;
}

uint32_t test_random(uint32_t *state)
{
    *state ^= *state << 13;
    *state ^= *state >> 17;
    *state ^= *state << 5;
    return *state;
}

double test_uniform(uint32_t *state, double low, double high)
{
    return low + (high - low) * (double)test_random(state) / 4294967296.0;
}

uint32_t test_add_vertex(test_mesh *m, float x, float y, float z)
{
    float *p = m->positions + 3 * m->vertex_count;

    p[0] = x;
    p[1] = y;
    p[2] = z;
    return (uint32_t)m->vertex_count++;
}

void test_add_triangle(test_mesh *m, uint32_t a, uint32_t b, uint32_t c)
{
    uint32_t *t = m->indices + 3 * m->triangle_count++;

    t[0] = a;
    t[1] = b;
    t[2] = c;
}

void test_add_box(test_mesh *m, const float low[3], const float high[3], int inward)
{
    static const uint8_t faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                        {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    const uint32_t first = (uint32_t)m->vertex_count;

    for (int i = 0; i < 8; i++)
        test_add_vertex(m, i & 1 ? high[0] : low[0], i & 2 ? high[1] : low[1], i & 4 ? high[2] : low[2]);
    for (int f = 0; f < 6; f++) {
        const uint32_t a = first + faces[f][0], b = first + faces[f][1], c = first + faces[f][2],
                       d = first + faces[f][3];

        test_add_triangle(m, a, inward ? c : b, inward ? b : c);
        test_add_triangle(m, a, inward ? d : c, inward ? c : d);
    }
}

void test_add_torus(test_mesh *m, float radius, float tube_radius, uint32_t around, uint32_t tube)
{
    const uint32_t first = (uint32_t)m->vertex_count;

    for (uint32_t i = 0; i < around; i++)
        for (uint32_t j = 0; j < tube; j++) {
            const double u = 6.283185307179586 * i / around, v = 6.283185307179586 * j / tube;
            const double r = (double)radius + (double)tube_radius * cos(v);

            test_add_vertex(m, (float)(r * cos(u)), (float)((double)tube_radius * sin(v)), (float)(r * sin(u)));
        }
    for (uint32_t i = 0; i < around; i++)
        for (uint32_t j = 0; j < tube; j++) {
            const uint32_t i1 = (i + 1) % around, j1 = (j + 1) % tube;
            const uint32_t a = first + i * tube + j, b = first + i * tube + j1;
            const uint32_t c = first + i1 * tube + j1, d = first + i1 * tube + j;

            test_add_triangle(m, a, b, c);
            test_add_triangle(m, a, c, d);
        }
}

gn_mesh_desc test_desc(const test_mesh *m)
{
    const gn_mesh_desc desc = {m->positions, m->vertex_count, 0, m->indices, m->triangle_count, 0.0};

    return desc;
}
