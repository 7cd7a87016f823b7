/* sample_scene.c - see sample_scene.h. Tori: their silhouettes have folds and holes, as those of what people draw. */
#include "sample_scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "gn_matrix.h"

static const double pi = 3.14159265358979323846;

enum { FLOOR, COARSE, FINE, MESHES };

static int make_mesh(scene_mesh *m, uint32_t around, uint32_t tube)
{
    const size_t vertices = (size_t)around * tube, triangles = 2 * vertices;

    m->vertex_count = (uint32_t)vertices;
    m->triangle_count = m->solid_triangle_count = (uint32_t)triangles;
    m->positions = calloc(3 * vertices, sizeof *m->positions);
    m->normals = calloc(3 * vertices, sizeof *m->normals);
    m->uvs = calloc(2 * vertices, sizeof *m->uvs);
    m->colors = malloc(4 * vertices * sizeof *m->colors);
    m->indices = malloc(3 * triangles * sizeof *m->indices);
    m->ranges = calloc(1, sizeof *m->ranges);
    if (!m->positions || !m->normals || !m->uvs || !m->colors || !m->indices || !m->ranges)
        return 0;
    for (size_t i = 0; i < 4 * vertices; i++)
        m->colors[i] = 1.0f;
    m->range_count = 1;
    m->ranges[0].triangle_count = (uint32_t)triangles;
    return 1;
}

static void put_quad(uint32_t *at, uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
    const uint32_t corners[6] = {a, b, c, a, c, d};

    memcpy(at, corners, sizeof corners);
}

/* About y, closed, outward. */
static void fill_torus(scene_mesh *m, uint32_t around, uint32_t tube)
{
    for (uint32_t i = 0; i < around; i++)
        for (uint32_t k = 0; k < tube; k++) {
            const double a = 2.0 * pi * i / around, b = 2.0 * pi * k / tube;
            const double n[3] = {cos(a) * cos(b), sin(b), sin(a) * cos(b)};
            const size_t v = (size_t)i * tube + k;
            const uint32_t i1 = (i + 1) % around, k1 = (k + 1) % tube;

            for (size_t axis = 0; axis < 3; axis++) {
                const double centre = axis == 0 ? cos(a) : axis == 2 ? sin(a) : 0.0;

                m->normals[3 * v + axis] = (float)n[axis];
                m->positions[3 * v + axis] = (float)(0.6 * centre + 0.25 * n[axis]);
            }
            put_quad(m->indices + 6 * v, i * tube + k, i * tube + k1, i1 * tube + k1, i1 * tube + k);
        }
}

/* A grid of so many vertices each way; what would wrap round is no triangle. */
static void fill_floor(scene_mesh *m, uint32_t side, double half)
{
    uint32_t *at = m->indices;

    for (uint32_t i = 0; i < side; i++)
        for (uint32_t k = 0; k < side; k++) {
            const size_t v = (size_t)i * side + k;

            m->positions[3 * v] = (float)(half * (2.0 * i / (side - 1) - 1.0));
            m->positions[3 * v + 2] = (float)(half * (2.0 * k / (side - 1) - 1.0));
            m->normals[3 * v + 1] = 1.0f;
            if (i + 1 == side || k + 1 == side)
                continue;
            put_quad(at, i * side + k, i * side + k + 1, (i + 1) * side + k + 1, (i + 1) * side + k);
            at += 6;
        }
    m->triangle_count = m->solid_triangle_count = m->ranges[0].triangle_count = (uint32_t)(at - m->indices) / 3;
}

static void place(scene_instance *instance, int mesh, int number, int count)
{
    const double a = 2.0 * pi * number / count * 3.0, r = 0.5 + 2.2 * number / count;

    memset(instance, 0, sizeof *instance);
    instance->node = SCENE_NONE;
    instance->mesh = mesh;
    instance->receives = 1;
    gn_mat4_identity(instance->world);
    if (mesh == FLOOR)
        return;
    /* tilted, each another way */
    instance->world[0] = cos(a);
    instance->world[1] = instance->world[4] = 0.0;
    instance->world[2] = -sin(a);
    instance->world[4] = sin(a) * sin(1.0 + number);
    instance->world[5] = cos(1.0 + number);
    instance->world[6] = cos(a) * sin(1.0 + number);
    instance->world[8] = sin(a) * cos(1.0 + number);
    instance->world[9] = -sin(1.0 + number);
    instance->world[10] = cos(a) * cos(1.0 + number);
    instance->world[12] = r * cos(a);
    instance->world[13] = 1.0 + 0.3 * (number % 3);
    instance->world[14] = r * sin(a);
}

static void place_lights(scene *s)
{
    for (int i = 0; i < SAMPLE_LIGHTS; i++) {
        scene_light *l = &s->lights[i];

        l->node = SCENE_NONE;
        l->kind = SCENE_POINT;
        l->color[0] = l->color[1] = l->color[2] = 1.0;
        l->intensity = 20.0;
        l->outer = pi / 4.0;
        l->towards[2] = 1.0;
        l->position[0] = 3.0 * cos(2.1 * i);
        l->position[1] = 3.5;
        l->position[2] = 3.0 * sin(2.1 * i);
    }
}

/* Above the floor's edge, towards its middle. */
static void place_camera(scene_camera *c)
{
    static const double eye[3] = {0.0, 2.6, 4.6};
    const double length = sqrt(eye[1] * eye[1] + eye[2] * eye[2]);

    c->node = SCENE_NONE;
    c->yfov = 0.9;
    c->znear = 0.1;
    gn_mat4_identity(c->world);
    c->world[5] = c->world[10] = eye[2] / length;
    c->world[6] = -eye[1] / length;
    c->world[9] = eye[1] / length;
    memcpy(c->world + 12, eye, sizeof eye);
}

int sample_scene_make(scene *s)
{
    static const uint32_t sizes[MESHES][2] = {{9, 9}, {12, 8}, {40, 24}};
    const int counts[MESHES] = {1, SAMPLE_COARSE, SAMPLE_FINE};
    int ok;

    memset(s, 0, sizeof *s);
    s->meshes = calloc(MESHES, sizeof *s->meshes);
    s->materials = calloc(1, sizeof *s->materials);
    s->instances = calloc(1 + SAMPLE_COARSE + SAMPLE_FINE, sizeof *s->instances);
    s->lights = calloc(SAMPLE_LIGHTS, sizeof *s->lights);
    ok = s->meshes && s->materials && s->instances && s->lights;
    for (int m = 0; ok && m < MESHES; m++) {
        s->mesh_count++;
        ok = make_mesh(&s->meshes[m], sizes[m][0], sizes[m][1]);
        if (!ok)
            break;
        if (m == FLOOR)
            fill_floor(&s->meshes[m], sizes[m][0], 5.0);
        else
            fill_torus(&s->meshes[m], sizes[m][0], sizes[m][1]);
        for (int i = 0; i < counts[m]; i++)
            place(&s->instances[s->instance_count++], m, i, counts[m]);
    }
    if (!ok) {
        scene_free(s);
        return 0;
    }
    s->material_count = 1;
    for (int i = 0; i < 4; i++)
        s->materials[0].base_color[i] = 0.8;
    s->materials[0].base_color[3] = 1.0;
    s->materials[0].roughness = 0.8;
    s->materials[0].texture = SCENE_NONE;
    s->light_count = SAMPLE_LIGHTS;
    s->has_camera = 1;
    place_lights(s);
    place_camera(&s->camera);
    return 1;
}

void sample_scene_cast(scene *s, int coarse, int fine)
{
    for (size_t i = 0; i < s->instance_count; i++) {
        scene_instance *instance = &s->instances[i];

        instance->casts = instance->mesh == COARSE ? coarse-- > 0 : instance->mesh == FINE && fine-- > 0;
    }
}
