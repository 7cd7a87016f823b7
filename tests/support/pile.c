/* pile.c - see pile.h. */
#include "pile.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "gn_matrix.h"

static const double pi = 3.14159265358979323846;

static int make_arrays(pile_mesh *m, size_t vertices, size_t triangles)
{
    memset(m, 0, sizeof *m);
    m->positions = malloc(vertices * 3 * sizeof *m->positions);
    m->normals = calloc(vertices * 3, sizeof *m->normals);
    m->indices = malloc(triangles * 3 * sizeof *m->indices);
    m->vertex_count = vertices;
    return m->positions && m->normals && m->indices;
}

static void add(pile_mesh *m, uint32_t a, uint32_t b, uint32_t c)
{
    uint32_t *at = m->indices + 3 * m->triangle_count++;

    at[0] = a;
    at[1] = b;
    at[2] = c;
}

static int finish(pile_mesh *m, gn_context *context)
{
    const gn_mesh_desc desc = {m->positions, m->vertex_count, 0, m->indices, m->triangle_count, 0.0};

    for (size_t t = 0; t < m->triangle_count; t++) {
        const uint32_t *c = m->indices + 3 * t;
        const float *a = m->positions + 3 * c[0], *b = m->positions + 3 * c[1], *d = m->positions + 3 * c[2];

        for (int axis = 0; axis < 3; axis++) {
            const int y = (axis + 1) % 3, z = (axis + 2) % 3;
            const float n = (b[y] - a[y]) * (d[z] - a[z]) - (b[z] - a[z]) * (d[y] - a[y]);

            for (int k = 0; k < 3; k++)
                m->normals[3 * c[k] + (uint32_t)axis] += n;
        }
    }
    for (size_t v = 0; v < m->vertex_count; v++) {
        float *n = m->normals + 3 * v;
        const float length = sqrtf(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);

        for (int axis = 0; axis < 3 && length > 0; axis++)
            n[axis] /= length;
    }
    return gn_mesh_create(context, &desc, &m->mesh) == GN_OK;
}

int pile_make_lump(pile_mesh *m, gn_context *context, uint32_t rings, uint32_t sectors)
{
    const size_t vertices = 2 + (size_t)(rings - 1) * sectors, triangles = 2 * (size_t)sectors * (rings - 1);
    const uint32_t south = (uint32_t)vertices - 1;

    if (!make_arrays(m, vertices, triangles))
        return 0;
    for (size_t v = 0; v < vertices; v++) {
        const size_t ring = v == 0 ? 0 : (v - 1) / sectors + 1, sector = v == 0 ? 0 : (v - 1) % sectors;
        const double polar = v == south ? pi : pi * (double)ring / rings, around = 2 * pi * (double)sector / sectors;
        const double d[3] = {sin(polar) * cos(around), cos(polar), sin(polar) * sin(around)};
        const double hills = sin(5 * d[0] + 1) * sin(4 * d[1] + 2) * sin(6 * d[2] + 3), r = 0.42 + 0.08 * hills;

        for (int axis = 0; axis < 3; axis++)
            m->positions[3 * v + (size_t)axis] = (float)(r * d[axis]);
    }
    for (uint32_t s = 0; s < sectors; s++) {
        const uint32_t next = (s + 1) % sectors, last = 1 + (rings - 2) * sectors;

        add(m, 0, 1 + next, 1 + s);
        for (uint32_t r = 0; r + 2 < rings; r++) {
            const uint32_t a = 1 + r * sectors + s, b = 1 + r * sectors + next;

            add(m, a, b, b + sectors);
            add(m, a, b + sectors, a + sectors);
        }
        add(m, south, last + s, last + next);
    }
    return finish(m, context);
}

int pile_make_floor(pile_mesh *m, gn_context *context, uint32_t quads, float half)
{
    const uint32_t side = quads + 1;

    if (!make_arrays(m, (size_t)side * side, 2 * (size_t)quads * quads))
        return 0;
    for (uint32_t z = 0; z < side; z++)
        for (uint32_t x = 0; x < side; x++) {
            float *p = m->positions + 3 * (z * side + x);

            p[0] = half * (2.0f * (float)x / (float)quads - 1.0f);
            p[1] = 0.0f;
            p[2] = half * (2.0f * (float)z / (float)quads - 1.0f);
        }
    for (uint32_t z = 0; z < quads; z++)
        for (uint32_t x = 0; x < quads; x++) {
            const uint32_t a = z * side + x;

            add(m, a, a + side, a + side + 1);
            add(m, a, a + side + 1, a + 1);
        }
    return finish(m, context);
}

void pile_drop(pile_mesh *m)
{
    gn_mesh_destroy(m->mesh);
    free(m->positions);
    free(m->normals);
    free(m->indices);
    memset(m, 0, sizeof *m);
}

double pile_floor_half(uint32_t side)
{
    return 4.0 * side + 6.0;
}

/* A turn by an angle about an axis that differs from lump to lump, and a place. */
static void turn(double model[16], uint32_t lump, double angle, const double at[3])
{
    static const double scale[3] = {1, 1, 1};
    const double axis[3] = {sin(1.0 + lump), 1.0, cos(2.0 * lump)};
    const double length = sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
    double rotation[4];

    for (int i = 0; i < 3; i++)
        rotation[i] = axis[i] / length * sin(0.5 * angle);
    rotation[3] = cos(0.5 * angle);
    gn_mat4_from_trs(model, at, rotation, scale);
}

void pile_look_at(double m[16], const double eye[3], const double at[3])
{
    double length = 0.0, flat;

    gn_mat4_identity(m);
    for (int i = 0; i < 3; i++)
        length += (eye[i] - at[i]) * (eye[i] - at[i]);
    for (int i = 0; i < 3; i++) {
        m[8 + i] = (eye[i] - at[i]) / sqrt(length);
        m[12 + i] = eye[i];
    }
    flat = sqrt(m[8] * m[8] + m[10] * m[10]);
    m[0] = m[10] / flat;
    m[1] = 0.0;
    m[2] = -m[8] / flat;
    m[4] = m[9] * m[2] - m[10] * m[1];
    m[5] = m[10] * m[0] - m[8] * m[2];
    m[6] = m[8] * m[1] - m[9] * m[0];
}

void pile_pose(pile *p, uint32_t frame, double aspect)
{
    const double extent = 1.5 * p->side, middle = 0.75 * (p->side - 1.0);
    const double eye[3] = {0.45 * extent + 0.5, 0.65 * extent + 1.2, 1.2 * extent + 1.6};
    const double at[3] = {0.0, 0.45 * extent, 0.0};

    p->object_count = p->side * p->side * p->side + 1;
    memset(p->objects, 0, sizeof p->objects);
    for (uint32_t i = 0; i + 1 < p->object_count; i++) {
        const double place[3] = {1.5 * (i % p->side) - middle, 0.9 + 1.5 * (i / p->side % p->side),
                                 1.5 * (i / p->side / p->side) - middle};

        turn(p->objects[i].model, i, 0.01 * frame + i, place);
        p->objects[i].mesh = p->meshes[0]->mesh;
        p->objects[i].flags = GN_CASTS | GN_RECEIVES | GN_DRAWN;
    }
    gn_mat4_identity(p->objects[p->object_count - 1].model);
    p->objects[p->object_count - 1].mesh = p->meshes[1]->mesh;
    p->objects[p->object_count - 1].flags = GN_CASTS | GN_RECEIVES | GN_DRAWN;
    for (uint32_t i = 0; i < p->light_count; i++) {
        const double angle = 0.02 * frame + 2 * pi * i / p->light_count, radius = 0.8 * extent + 1.6;

        memset(&p->lights[i], 0, sizeof p->lights[i]);
        p->lights[i].kind = GN_LIGHT_POINT;
        p->lights[i].position[0] = radius * cos(angle);
        p->lights[i].position[1] = 1.05 * extent + 2.2;
        p->lights[i].position[2] = radius * sin(angle);
    }
    memset(&p->camera, 0, sizeof p->camera);
    pile_look_at(p->camera.world, eye, at);
    p->camera.top = tan(pi / 8);
    p->camera.right = p->camera.top * aspect;
    p->camera.bottom = -p->camera.top;
    p->camera.left = -p->camera.right;
    p->camera.znear = 0.1;
    p->camera.zfar = 100.0;
}
