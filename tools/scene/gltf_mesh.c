/* gltf_mesh.c - the triangles of each mesh, its primitives laid one after the other.
 *
 * Primitives often share accessors and use a part of them each. So each primitive is read for itself, and then only
 * the vertices that its triangles use are gathered into the mesh, in their old order; where it brings no normals, every
 * corner of a triangle gathers a vertex of its own, for the flat normal. All primitives of a mesh are read before any
 * is gathered: the mesh's arrays are then allocated once, at their size, with BLEND primitives last. */
#include "gltf.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { POINTS, LINES, LINE_LOOP, LINE_STRIP, TRIANGLES, TRIANGLE_STRIP, TRIANGLE_FAN };

#define FLOATS        (GLTF_FLOAT | GLTF_SMALL_INTEGERS) /* KHR_mesh_quantization allows the integers */
#define NORMALIZED    (GLTF_FLOAT | GLTF_UINT8 | GLTF_UINT16 | GLTF_NORMALIZED)
#define VERTEX_UNUSED UINT32_MAX

/* One primitive, its attributes first as its accessors have them, then only those of gathered vertices. */
typedef struct primitive {
    char where[GLTF_WHERE];
    int material;
    uint32_t accessor_count; /* vertices in its accessors */
    float *positions;        /* [accessor_count, then vertex_count][3] */
    float *normals;          /* [..][3], this and the following NULL where it has none */
    float *uvs;              /* [..][2] */
    float *colors;           /* [..][color_width] */
    unsigned color_width;
    uint32_t triangle_count;
    uint32_t *indices; /* [triangle_count][3] */
    uint32_t vertex_count;
    uint32_t *sources; /* [vertex_count] which vertex of the accessors each gathered one is */
} primitive;

static void free_primitives(primitive *parts, size_t count)
{
    for (size_t i = 0; parts && i < count; i++) {
        free(parts[i].positions);
        free(parts[i].normals);
        free(parts[i].uvs);
        free(parts[i].colors);
        free(parts[i].indices);
        free(parts[i].sources);
    }
    free(parts);
}

/* One attribute; *out stays NULL where the primitive lacks it. `fallback` replaces what is not finite. */
static int read_attribute(gltf *g, const primitive *p, const cJSON *attributes, const char *name, unsigned allowed,
                          float fallback, float **out, unsigned *width)
{
    int index = SCENE_NONE;
    gltf_accessor a;

    if (!gltf_get_index(g, p->where, attributes, name, GLTF_ACCESSOR, &index))
        return 0;
    if (index == SCENE_NONE)
        return 1;
    if (!gltf_open_accessor(g, p->where, name, index, allowed, GLTF_VERTICES_MAX, &a))
        return 0;
    if (a.count != p->accessor_count)
        return gltf_fail(g, "%s: %s has %lu elements, POSITION %lu", p->where, name, (unsigned long)a.count,
                         (unsigned long)p->accessor_count);
    *out = gltf_read_floats(g, &a);
    if (!*out)
        return 0;
    *width = a.components;
    for (size_t i = 0; i < a.count * a.components; i++)
        if (!isfinite((*out)[i]))
            (*out)[i] = fallback;
    return 1;
}

static int read_positions(gltf *g, primitive *p, int index)
{
    gltf_accessor a;

    if (!gltf_open_accessor(g, p->where, "POSITION", index, GLTF_WIDE(3) | FLOATS, GLTF_VERTICES_MAX, &a))
        return 0;
    p->accessor_count = (uint32_t)a.count;
    p->positions = gltf_read_floats(g, &a);
    for (size_t i = 0; p->positions && i < 3 * a.count; i++)
        if (!isfinite(p->positions[i]))
            return gltf_fail(g, "%s: vertex %lu: its position is not finite", p->where, (unsigned long)(i / 3));
    return p->positions != NULL;
}

/* The indices as the file has them, or 0, 1, 2 ... without any. */
static int read_list(gltf *g, const primitive *p, int index, uint32_t **list, size_t *count)
{
    gltf_accessor a;

    if (index == SCENE_NONE) {
        *count = p->accessor_count;
        *list = gltf_alloc(g, *count, sizeof **list);
        for (uint32_t i = 0; *list && i < *count; i++)
            (*list)[i] = i;
        return *list != NULL;
    }
    if (!gltf_open_accessor(g, p->where, "indices", index, GLTF_WIDE(1) | GLTF_INDICES, 3 * (size_t)GLTF_TRIANGLES_MAX,
                            &a))
        return 0;
    *count = a.count;
    *list = gltf_read_indices(g, &a);
    for (size_t i = 0; *list && i < *count; i++)
        if ((*list)[i] >= p->accessor_count)
            return gltf_fail(g, "%s: index %lu is %lu, there are %lu vertices", p->where, (unsigned long)i,
                             (unsigned long)(*list)[i], (unsigned long)p->accessor_count);
    return *list != NULL;
}

/* Separate triangles from a list, strip or fan; corners left over make none (glTF 2.0, 3.7.2.1). Every second triangle
 * of a strip takes its last two corners the other way round, so that all keep the first one's winding. */
static int make_triangles(gltf *g, primitive *p, size_t mode, const uint32_t *list, size_t count)
{
    const size_t triangles = mode == TRIANGLES ? count / 3 : count < 3 ? 0 : count - 2;
    uint32_t *out;

    if (triangles > GLTF_TRIANGLES_MAX - g->triangles)
        return gltf_fail(g, "%s: its %lu triangles go past the limit of %lu in all", p->where, (unsigned long)triangles,
                         (unsigned long)GLTF_TRIANGLES_MAX);
    g->triangles += triangles;
    p->triangle_count = (uint32_t)triangles;
    p->indices = out = gltf_alloc(g, triangles, 3 * sizeof *out);
    if (!out)
        return 0;
    if (mode == TRIANGLES)
        memcpy(out, list, triangles * 3 * sizeof *out);
    for (size_t i = 0; mode == TRIANGLE_STRIP && i < triangles; i++) {
        *out++ = list[i];
        *out++ = list[i + 1 + i % 2];
        *out++ = list[i + 2 - i % 2];
    }
    for (size_t i = 0; mode == TRIANGLE_FAN && i < triangles; i++) {
        *out++ = list[i + 1];
        *out++ = list[i + 2];
        *out++ = list[0];
    }
    return 1;
}

/* Decides which vertices are gathered, and renumbers the indices to them. */
static int choose_vertices(gltf *g, primitive *p)
{
    const size_t corners = 3 * (size_t)p->triangle_count;
    const size_t bound = p->normals && p->accessor_count < corners ? p->accessor_count : corners;
    uint32_t *renumbered;

    p->sources = gltf_alloc(g, bound, sizeof *p->sources);
    if (!p->sources)
        return 0;
    if (!p->normals) {
        for (size_t i = 0; i < corners; i++) {
            p->sources[i] = p->indices[i];
            p->indices[i] = (uint32_t)i;
        }
        p->vertex_count = (uint32_t)corners;
    } else {
        renumbered = gltf_alloc(g, p->accessor_count, sizeof *renumbered);
        if (!renumbered)
            return 0;
        for (size_t i = 0; i < p->accessor_count; i++)
            renumbered[i] = VERTEX_UNUSED;
        for (size_t i = 0; i < corners; i++)
            renumbered[p->indices[i]] = 0;
        for (uint32_t i = 0; i < p->accessor_count; i++)
            if (renumbered[i] != VERTEX_UNUSED) {
                renumbered[i] = p->vertex_count;
                p->sources[p->vertex_count++] = i;
            }
        for (size_t i = 0; i < corners; i++)
            p->indices[i] = renumbered[p->indices[i]];
        free(renumbered);
    }
    g->vertices += p->vertex_count;
    if (g->vertices > GLTF_VERTICES_MAX)
        return gltf_fail(g, "%s: its %lu vertices go past the limit of %lu in all", p->where,
                         (unsigned long)p->vertex_count, (unsigned long)GLTF_VERTICES_MAX);
    return 1;
}

/* Only what is gathered stays in memory: a large set of accessors may serve many primitives. */
static int compact(gltf *g, const primitive *p, unsigned width, float **values)
{
    float *kept;

    if (!*values)
        return 1;
    kept = gltf_alloc(g, p->vertex_count, width * sizeof *kept);
    if (!kept)
        return 0;
    for (size_t i = 0; i < p->vertex_count; i++)
        memcpy(kept + i * width, *values + (size_t)p->sources[i] * width, width * sizeof *kept);
    free(*values);
    *values = kept;
    return 1;
}

static int read_primitive(gltf *g, const scene *s, const cJSON *json, primitive *p)
{
    const cJSON *attributes = gltf_get(json, "attributes");
    int position = SCENE_NONE, indices = SCENE_NONE, ok;
    size_t mode = TRIANGLES, count = 0;
    unsigned width;
    uint32_t *list = NULL;
    char uv_name[GLTF_WHERE];

    p->material = (int)s->material_count - 1;
    if (!cJSON_IsObject(json))
        return gltf_fail(g, "%s is not an object", p->where);
    if (gltf_get(json, "targets"))
        return gltf_fail(g, "%s: morph targets (targets) are not supported", p->where);
    if (!gltf_get_size(g, p->where, json, "mode", &mode) ||
        !gltf_get_index(g, p->where, json, "material", GLTF_MATERIAL, &p->material) ||
        !gltf_get_index(g, p->where, json, "indices", GLTF_ACCESSOR, &indices) ||
        !gltf_get_index(g, p->where, attributes, "POSITION", GLTF_ACCESSOR, &position))
        return 0;
    if (mode > TRIANGLE_FAN)
        return gltf_fail(g, "%s: mode is %lu, out of range 0 to 6", p->where, (unsigned long)mode);
    if (mode < TRIANGLES || position == SCENE_NONE) {
        gltf_warn(g, "%s: skipped: %s", p->where,
                  mode == POINTS     ? "points are not drawn"
                  : mode < TRIANGLES ? "lines are not drawn"
                                     : "it has no POSITION");
        return 1;
    }
    if (!read_positions(g, p, position))
        return 0;
    ok = read_list(g, p, indices, &list, &count) && make_triangles(g, p, mode, list, count);
    free(list);
    if (!ok || !read_attribute(g, p, attributes, "NORMAL", GLTF_WIDE(3) | GLTF_FLOAT | GLTF_INT8 | GLTF_INT16, 0.0f,
                               &p->normals, &width))
        return 0;
    if (g->uv_sources[p->material].set != SCENE_NONE) {
        snprintf(uv_name, sizeof uv_name, "TEXCOORD_%d", g->uv_sources[p->material].set);
        if (!read_attribute(g, p, attributes, uv_name, GLTF_WIDE(2) | FLOATS, 0.0f, &p->uvs, &width))
            return 0;
    }
    if (!read_attribute(g, p, attributes, "COLOR_0", GLTF_WIDE(3) | GLTF_WIDE(4) | NORMALIZED, 1.0f, &p->colors,
                        &p->color_width))
        return 0;
    return choose_vertices(g, p) && compact(g, p, 3, &p->positions) && compact(g, p, 3, &p->normals) &&
           compact(g, p, 2, &p->uvs) && compact(g, p, p->color_width, &p->colors);
}

/* Scales to length 1, and returns 0 for what has no direction. In double the square of no float overflows or vanishes,
 * nor does that of a product of two. */
static int normalize(const double v[3], float out[3])
{
    const double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);

    if (!(length > 0.0))
        return 0;
    for (int i = 0; i < 3; i++)
        out[i] = (float)(v[i] / length);
    return 1;
}

/* The unit normal of a triangle, counter-clockwise outside; +Z for one without area. */
static void flat_normal(const float *a, const float *b, const float *c, float out[3])
{
    double u[3], v[3], n[3];

    for (int i = 0; i < 3; i++) {
        u[i] = (double)b[i] - a[i];
        v[i] = (double)c[i] - a[i];
    }
    for (int i = 0; i < 3; i++)
        n[i] = u[(i + 1) % 3] * v[(i + 2) % 3] - u[(i + 2) % 3] * v[(i + 1) % 3];
    if (!normalize(n, out)) {
        out[0] = out[1] = 0.0f;
        out[2] = 1.0f;
    }
}

/* Flat normals for vertices that were given none, or one of length 0: of the first triangle that uses them. */
static void fill_normals(scene_mesh *m, const uint32_t *indices, size_t triangle_count)
{
    for (size_t t = 0; t < triangle_count; t++, indices += 3)
        for (int i = 0; i < 3; i++) {
            float *n = m->normals + 3 * (size_t)indices[i];

            if (n[0] == 0.0f && n[1] == 0.0f && n[2] == 0.0f)
                flat_normal(m->positions + 3 * (size_t)indices[0], m->positions + 3 * (size_t)indices[1],
                            m->positions + 3 * (size_t)indices[2], n);
        }
}

/* A huge texture transform may leave float's range. */
static float finite_float(double x)
{
    return fabs(x) <= FLT_MAX ? (float)x : 0.0f;
}

/* Adds a primitive's triangles to the mesh, whose arrays have room for them. */
static void gather(const gltf *g, scene_mesh *m, const primitive *p)
{
    const gltf_uv_source *uv = &g->uv_sources[p->material];
    const uint32_t first = m->vertex_count;
    uint32_t *indices = m->indices + 3 * (size_t)m->triangle_count;
    scene_range *range = &m->ranges[m->range_count++];

    for (size_t i = 0; i < p->vertex_count; i++) {
        const size_t to = first + i;
        const double u = p->uvs ? p->uvs[2 * i] * uv->scale[0] : 0.0;
        const double v = p->uvs ? p->uvs[2 * i + 1] * uv->scale[1] : 0.0;

        memcpy(m->positions + 3 * to, p->positions + 3 * i, 3 * sizeof(float));
        if (p->normals) {
            const double n[3] = {p->normals[3 * i], p->normals[3 * i + 1], p->normals[3 * i + 2]};

            normalize(n, m->normals + 3 * to);
        }
        /* counter-clockwise as one sees the picture, where v points down */
        if (p->uvs) {
            m->uvs[2 * to] = finite_float(u * uv->cosine + v * uv->sine + uv->offset[0]);
            m->uvs[2 * to + 1] = finite_float(v * uv->cosine - u * uv->sine + uv->offset[1]);
        }
        for (unsigned c = 0; c < 4; c++)
            m->colors[4 * to + c] = p->colors && c < p->color_width ? p->colors[p->color_width * i + c] : 1.0f;
    }
    for (size_t i = 0; i < 3 * (size_t)p->triangle_count; i++)
        indices[i] = first + p->indices[i];
    range->first_triangle = m->triangle_count;
    range->triangle_count = p->triangle_count;
    range->material = p->material;
    m->vertex_count += p->vertex_count;
    m->triangle_count += p->triangle_count;
    fill_normals(m, indices, p->triangle_count);
}

static int gather_all(gltf *g, const scene *s, const primitive *parts, size_t count, scene_mesh *m)
{
    size_t vertices = 0, triangles = 0;

    for (size_t i = 0; i < count; i++) {
        vertices += parts[i].vertex_count;
        triangles += parts[i].triangle_count;
    }
    m->positions = gltf_alloc(g, vertices, 3 * sizeof(float));
    m->normals = gltf_alloc_zeroed(g, vertices, 3 * sizeof(float));
    m->uvs = gltf_alloc_zeroed(g, vertices, 2 * sizeof(float));
    m->colors = gltf_alloc(g, vertices, 4 * sizeof(float));
    m->indices = gltf_alloc(g, triangles, 3 * sizeof(uint32_t));
    m->ranges = gltf_alloc(g, count, sizeof *m->ranges);
    if (!m->positions || !m->normals || !m->uvs || !m->colors || !m->indices || !m->ranges)
        return 0;
    for (int blend = 0; blend < 2; blend++) {
        for (size_t i = 0; i < count; i++)
            if (parts[i].triangle_count && (s->materials[parts[i].material].alpha == SCENE_BLEND) == blend)
                gather(g, m, &parts[i]);
        if (!blend)
            m->solid_triangle_count = m->triangle_count;
    }
    return 1;
}

static int read_mesh(gltf *g, const scene *s, size_t mesh, scene_mesh *m)
{
    const cJSON *array, *item;
    primitive *parts;
    size_t count = 0, n = 0;
    char where[GLTF_WHERE];
    int ok = 1;

    snprintf(where, sizeof where, "mesh %lu", (unsigned long)mesh);
    if (!gltf_get_array(g, where, g->lists[GLTF_MESH].items[mesh], "primitives", &array))
        return 0;
    cJSON_ArrayForEach (item, array)
        count++;
    parts = gltf_alloc_zeroed(g, count, sizeof *parts);
    if (!parts)
        return 0;
    cJSON_ArrayForEach (item, array) {
        if (!ok)
            break;
        snprintf(parts[n].where, sizeof parts[n].where, "mesh %lu primitive %lu", (unsigned long)mesh,
                 (unsigned long)n);
        ok = read_primitive(g, s, item, &parts[n]);
        n++;
    }
    ok = ok && gather_all(g, s, parts, count, m);
    free_primitives(parts, count);
    return ok;
}

static void find_box(const scene_mesh *m, double box[2][3])
{
    for (int axis = 0; axis < 3; axis++)
        for (size_t i = 0; i < m->vertex_count; i++) {
            const double x = m->positions[3 * i + (size_t)axis];

            box[0][axis] = i == 0 || x < box[0][axis] ? x : box[0][axis];
            box[1][axis] = i == 0 || x > box[1][axis] ? x : box[1][axis];
        }
}

int gltf_read_meshes(gltf *g, scene *s)
{
    const size_t count = g->lists[GLTF_MESH].count;

    s->meshes = gltf_alloc_zeroed(g, count, sizeof *s->meshes);
    g->boxes = gltf_alloc_zeroed(g, count, sizeof *g->boxes);
    if (!s->meshes || !g->boxes)
        return 0;
    s->mesh_count = count; /* zeroed meshes may be freed */
    for (size_t i = 0; i < count; i++) {
        if (!read_mesh(g, s, i, &s->meshes[i]))
            return 0;
        find_box(&s->meshes[i], g->boxes[i]);
    }
    return 1;
}
