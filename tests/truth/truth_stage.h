/* truth_stage.h - small scenes made by hand for the truth's tests, and areas counted in its masks.
 *
 * Start from a stage that is all zero. Whatever does not fit fails the test. */
#ifndef TRUTH_STAGE_H
#define TRUTH_STAGE_H
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "gn_matrix.h"
#include "truth.h"

enum { STAGE_MESHES = 16, STAGE_LIGHTS = 4 };
enum { SINGLE, DOUBLE, CUT_AT_HALF, BLENDED, STAGE_MATERIALS }; /* materials: indices */

typedef struct stage {
    scene s;
    scene_material materials[STAGE_MATERIALS];
    scene_mesh meshes[STAGE_MESHES];
    scene_range ranges[STAGE_MESHES];
    scene_instance instances[STAGE_MESHES];
    scene_light lights[STAGE_LIGHTS];
} stage;

typedef struct masks {
    uint32_t width, height;
    uint8_t *lit, *visible, *classes;
} masks;

static inline void *stage_memory(size_t count, size_t size)
{
    void *m = calloc(count, size);

    if (!m)
        fail_msg("out of memory");
    return m;
}

static inline void stage_free(stage *st)
{
    for (size_t i = 0; i < st->s.mesh_count; i++) {
        free(st->meshes[i].positions);
        free(st->meshes[i].normals);
        free(st->meshes[i].uvs);
        free(st->meshes[i].colors);
        free(st->meshes[i].indices);
    }
    memset(st, 0, sizeof *st);
}

/* A mesh of one material and an instance of it, untransformed. Returns the instance, to be changed at will. */
static inline scene_instance *stage_mesh(stage *st, int material, uint32_t vertices, const float *positions,
                                         uint32_t triangles, const uint32_t *indices)
{
    const size_t n = st->s.mesh_count;
    scene_mesh *m = &st->meshes[n];

    assert_true(n < STAGE_MESHES);
    st->s.materials = st->materials;
    st->s.material_count = STAGE_MATERIALS;
    for (int i = 0; i < STAGE_MATERIALS; i++) {
        st->materials[i].texture = SCENE_NONE;
        st->materials[i].double_sided = i != SINGLE;
        st->materials[i].alpha_cutoff = 0.5;
        st->materials[i].alpha = i == CUT_AT_HALF ? SCENE_MASK : i == BLENDED ? SCENE_BLEND : SCENE_OPAQUE;
        for (int k = 0; k < 4; k++)
            st->materials[i].base_color[k] = 1.0;
    }
    st->s.meshes = st->meshes;
    st->s.instances = st->instances;
    st->s.mesh_count = st->s.instance_count = n + 1;
    m->vertex_count = vertices;
    m->triangle_count = triangles;
    m->solid_triangle_count = material == BLENDED ? 0 : triangles;
    m->positions = stage_memory(3 * (size_t)vertices, sizeof(float));
    m->normals = stage_memory(3 * (size_t)vertices, sizeof(float));
    m->uvs = stage_memory(2 * (size_t)vertices, sizeof(float));
    m->colors = stage_memory(4 * (size_t)vertices, sizeof(float));
    m->indices = stage_memory(3 * (size_t)triangles, sizeof(uint32_t));
    memcpy(m->positions, positions, 3 * (size_t)vertices * sizeof(float));
    memcpy(m->indices, indices, 3 * (size_t)triangles * sizeof(uint32_t));
    for (size_t i = 0; i < 4 * (size_t)vertices; i++)
        m->colors[i] = 1.0f;
    st->ranges[n] = (scene_range){0, triangles, material};
    m->ranges = &st->ranges[n];
    m->range_count = 1;
    st->instances[n].node = SCENE_NONE;
    st->instances[n].mesh = (int)n;
    st->instances[n].casts = st->instances[n].receives = 1;
    gn_mat4_identity(st->instances[n].world);
    return &st->instances[n];
}

/* A horizontal rectangle at height y that faces up: x from x0 to x1, z from z0 to z1. */
static inline scene_instance *stage_table(stage *st, int material, double y, double x0, double x1, double z0, double z1)
{
    const float p[12] = {(float)x0, (float)y, (float)z0, (float)x0, (float)y, (float)z1,
                         (float)x1, (float)y, (float)z1, (float)x1, (float)y, (float)z0};
    static const uint32_t indices[6] = {0, 1, 2, 0, 2, 3};

    return stage_mesh(st, material, 4, p, 2, indices);
}

/* A cube from -half to half whose faces look outwards. */
static inline scene_instance *stage_cube(stage *st, int material, double half)
{
    static const uint32_t indices[36] = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                         2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
    float p[24];

    for (int i = 0; i < 8; i++)
        for (int k = 0; k < 3; k++)
            p[3 * i + k] = (float)(i >> k & 1 ? half : -half);
    return stage_mesh(st, material, 8, p, 12, indices);
}

static inline void stage_light(stage *st, scene_light_kind kind, double x, double y, double z)
{
    scene_light *l = &st->lights[st->s.light_count];
    const double length = sqrt(x * x + y * y + z * z), at[3] = {x, y, z};

    assert_true(st->s.light_count < STAGE_LIGHTS);
    st->s.lights = st->lights;
    st->s.light_count++;
    l->kind = kind;
    for (int k = 0; k < 3; k++)
        if (kind == SCENE_DIRECTIONAL)
            l->towards[k] = at[k] / length;
        else
            l->position[k] = at[k];
}

/* Looks straight down from height y onto x from -half to half (right is +x, up in the image is -z). */
static inline void stage_camera_above(stage *st, double y, double half)
{
    static const double down[16] = {1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1};

    st->s.has_camera = 1;
    st->s.camera.node = SCENE_NONE;
    st->s.camera.orthographic = 1;
    st->s.camera.xmag = st->s.camera.ymag = half;
    st->s.camera.znear = 0.1;
    st->s.camera.zfar = 0.0;
    memcpy(st->s.camera.world, down, sizeof down);
    st->s.camera.world[13] = y;
}

/* A perspective camera at the origin that looks along -z. */
static inline void stage_camera(stage *st, double yfov)
{
    st->s.has_camera = 1;
    st->s.camera.node = SCENE_NONE;
    st->s.camera.orthographic = 0;
    st->s.camera.yfov = yfov;
    st->s.camera.znear = 0.1;
    st->s.camera.zfar = 0.0;
    gn_mat4_identity(st->s.camera.world);
}

static inline masks stage_masks(const stage *st, uint32_t width, uint32_t height, int depth_bits, size_t light)
{
    const truth_options options = {width, height, depth_bits, {0.0, 0.0}};
    const size_t pixels = (size_t)width * height;
    masks m = {width, height, stage_memory(pixels, 1), stage_memory(pixels, 1), stage_memory(pixels, 1)};
    char message[SCENE_MESSAGE] = "";
    truth *t = truth_create(&st->s, &options, message);

    if (!t || !truth_light(t, light, m.lit, m.visible, m.classes, message))
        fail_msg("%s", message);
    truth_free(t);
    for (size_t i = 0; i < pixels; i++) { /* what must hold of any mask */
        assert_true(m.lit[i] == 0 || m.lit[i] == 255);
        assert_true(m.visible[i] == 0 || m.visible[i] == 255);
        assert_true(m.lit[i] <= m.visible[i]);
        assert_true(m.classes[i] <= TRUTH_BOUNDARY);
    }
    return m;
}

static inline void masks_free(masks *m)
{
    free(m->lit);
    free(m->visible);
    free(m->classes);
}

static inline size_t masks_count(const masks *m, truth_class c)
{
    size_t n = 0;

    for (size_t i = 0; i < (size_t)m->width * m->height; i++)
        n += m->classes[i] == c;
    return n;
}

typedef enum state { UNSEEN, SHADOWED, LIT } state;

static inline state masks_state(const masks *m, size_t i)
{
    return !m->visible[i] ? UNSEEN : m->lit[i] ? LIT : SHADOWED;
}

/* The area in that state must be what was computed by hand: no less than its certain pixels, no more than these and all
 * that are not certain; and these may be no more than `loose` pixels. pixel_area 0: expected counts pixels. */
static inline void masks_check_area(const masks *m, state what, double expected, double pixel_area, size_t loose)
{
    size_t sure = 0, unsure = 0;

    for (size_t i = 0; i < (size_t)m->width * m->height; i++)
        if (m->classes[i] != TRUTH_CERTAIN)
            unsure++;
        else if (masks_state(m, i) == what)
            sure++;
    if (pixel_area <= 0.0)
        pixel_area = 1.0;
    if (unsure > loose || (double)sure * pixel_area > expected || (double)(sure + unsure) * pixel_area < expected)
        fail_msg("state %d: area %g, between %lu and %lu pixels of %g (at most %lu unsure)", (int)what, expected,
                 (unsigned long)sure, (unsigned long)(sure + unsure), pixel_area, (unsigned long)loose);
}

/* The same generator on every machine: a test names its seed. */
static inline double stage_random(uint32_t *seed, double least, double most)
{
    *seed = *seed * 1664525u + 1013904223u;
    return least + (most - least) * ((double)(*seed >> 8) / 16777216.0);
}
#endif
