/* stage_upload.c - puts a scene into GL: meshes as the library and the stage's shaders want them, and textures.
 *
 * Vertices are sent less the mesh's centre, by plain float subtraction: exactly the positions that the library's
 * volumes have. Each range is cut into batches that 16-bit indices reach, in the order of its triangles. */
#include "stage.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FLOATS         12 /* position 3, normal 3, uv 2, colour 4 */
#define BATCH_VERTICES 65535u

typedef struct packer {
    float *vertices;
    uint16_t *indices;
    uint32_t *stamp, *local; /* [vertex_count] */
    uint32_t vertex_count, index_count, batch_stamp;
} packer;

static int fail(char message[SCENE_MESSAGE], const char *what)
{
    snprintf(message, SCENE_MESSAGE, "stage: %s", what);
    return 0;
}

static void pack_vertex(packer *p, const scene_mesh *m, const float centre[3], uint32_t vertex)
{
    float *out = p->vertices + (size_t)FLOATS * p->vertex_count;

    for (size_t axis = 0; axis < 3; axis++)
        out[axis] = m->positions[3 * (size_t)vertex + axis] - centre[axis];
    memcpy(out + 3, m->normals + 3 * (size_t)vertex, 3 * sizeof(float));
    memcpy(out + 6, m->uvs + 2 * (size_t)vertex, 2 * sizeof(float));
    memcpy(out + 8, m->colors + 4 * (size_t)vertex, 4 * sizeof(float));
    p->vertex_count++;
}

/* Batches of one range; with batches NULL only counts them. */
static size_t pack_range(packer *p, const scene_mesh *m, const scene_range *range, const float centre[3],
                         stage_batch *batches)
{
    const uint32_t end = range->first_triangle + range->triangle_count;
    size_t count = 0;
    uint32_t in_batch = BATCH_VERTICES; /* full: the first triangle opens a batch */

    for (uint32_t t = range->first_triangle; t < end; t++) {
        const uint32_t *c = m->indices + 3 * (size_t)t;
        uint32_t fresh = 0;

        for (int k = 0; k < 3; k++)
            fresh += p->stamp[c[k]] != p->batch_stamp;
        if (t == range->first_triangle || in_batch + fresh > BATCH_VERTICES) {
            p->batch_stamp++;
            in_batch = 0;
            batches[count++] = (stage_batch){p->vertex_count, p->index_count, 0, t, range->material};
        }
        for (int k = 0; k < 3; k++) {
            if (p->stamp[c[k]] != p->batch_stamp) {
                p->stamp[c[k]] = p->batch_stamp;
                p->local[c[k]] = in_batch++;
                pack_vertex(p, m, centre, c[k]);
            }
            p->indices[p->index_count++] = (uint16_t)p->local[c[k]];
        }
        batches[count - 1].triangle_count++;
    }
    return count;
}

static void send(const gn_gl *gl, GLenum target, GLuint *name, const void *data, size_t size)
{
    gl->glGenBuffers(1, name);
    gl->glBindBuffer(target, *name);
    gl->glBufferData(target, (GLsizeiptr)size, data, GL_STATIC_DRAW);
    gl->glBindBuffer(target, 0);
}

static int upload_mesh(stage *s, const scene_mesh *m, stage_mesh *out, char message[SCENE_MESSAGE])
{
    const size_t corners = 3 * (size_t)m->triangle_count;
    const gn_mesh_desc desc = {m->positions, m->vertex_count, 0, m->indices, m->solid_triangle_count, s->weld_angle};
    packer p;
    int ok;

    if (gn_mesh_create(s->context, &desc, &out->mesh) != GN_OK || gn_gles_upload(s->gles, out->mesh) != GN_OK ||
        !stage_make_proxy(s, m, out)) {
        snprintf(message, SCENE_MESSAGE, "stage: %s", gn_message(s->context));
        return 0;
    }
    memset(&p, 0, sizeof p);
    /* a vertex may be in several batches: at most as many as there are corners */
    p.vertices = malloc((corners + 1) * FLOATS * sizeof(float));
    p.indices = out->index_copy = malloc((corners + 1) * sizeof(uint16_t));
    p.stamp = calloc((size_t)m->vertex_count + 1, sizeof(uint32_t));
    p.local = malloc(((size_t)m->vertex_count + 1) * sizeof(uint32_t));
    out->batches = malloc((m->range_count + corners / (BATCH_VERTICES - 2) + 1) * sizeof *out->batches);
    ok = p.vertices && p.indices && p.stamp && p.local && out->batches;
    if (ok) {
        for (size_t r = 0; r < m->range_count; r++)
            out->batch_count +=
                pack_range(&p, m, &m->ranges[r], gn_mesh_get_info(out->mesh)->centre, out->batches + out->batch_count);
        send(s->gl, GL_ARRAY_BUFFER, &out->vertices, p.vertices, (size_t)p.vertex_count * FLOATS * sizeof(float));
        send(s->gl, GL_ELEMENT_ARRAY_BUFFER, &out->indices, p.indices, (size_t)p.index_count * sizeof(uint16_t));
    }
    free(p.vertices);
    free(p.stamp);
    free(p.local);
    return ok ? 1 : fail(message, "no memory for a mesh");
}

/* A texture whose alpha cuts is not minified through smaller levels: those would cut elsewhere than the truth does. */
static void upload_texture(const gn_gl *gl, const scene_texture *t, int cuts, GLuint *name)
{
    const GLint plain = t->nearest ? GL_NEAREST : GL_LINEAR;

    static const GLint wraps[] = {GL_REPEAT, GL_CLAMP_TO_EDGE, GL_MIRRORED_REPEAT};

    gl->glGenTextures(1, name);
    gl->glBindTexture(GL_TEXTURE_2D, *name);
    gl->glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    gl->glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, (GLsizei)t->width, (GLsizei)t->height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                     t->rgba);
    gl->glGenerateMipmap(GL_TEXTURE_2D);
    gl->glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, wraps[t->wrap[0]]);
    gl->glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, wraps[t->wrap[1]]);
    gl->glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, plain);
    gl->glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, cuts ? plain : GL_LINEAR_MIPMAP_LINEAR);
    gl->glBindTexture(GL_TEXTURE_2D, 0);
}

int stage_upload(stage *s, char message[SCENE_MESSAGE])
{
    const scene *from = s->scene;
    uint32_t most = 1;

    s->meshes = calloc(from->mesh_count + 1, sizeof *s->meshes);
    s->textures = calloc(from->texture_count + 1, sizeof *s->textures);
    s->objects = calloc(2 * from->instance_count + 1, sizeof *s->objects);
    s->lights = calloc((size_t)s->light_count + 1, sizeof *s->lights);
    s->planned = calloc((size_t)s->light_count + 1, sizeof *s->planned);
    s->shading = calloc((size_t)s->light_count + 1, sizeof *s->shading);
    s->members = calloc((size_t)s->light_count + 1, sizeof *s->members);
    if (!s->members || !s->meshes || !s->textures || !s->objects || !s->lights || !s->planned || !s->shading)
        return fail(message, "no memory for the scene's objects");
    for (size_t i = 0; i < from->mesh_count; i++) {
        if (!upload_mesh(s, &from->meshes[i], &s->meshes[i], message))
            return 0;
        if (from->meshes[i].triangle_count > most)
            most = from->meshes[i].triangle_count;
    }
    for (size_t i = 0; i < from->texture_count; i++) {
        int cuts = 0;

        for (size_t m = 0; m < from->material_count; m++)
            cuts |= from->materials[m].texture == (int)i && from->materials[m].alpha == SCENE_MASK;
        upload_texture(s->gl, &from->textures[i], cuts, &s->textures[i]);
    }
    /* per triangle: three edges of two ends of three floats, or three 16-bit indices */
    s->scratch = malloc((size_t)most * 3 * (6 * sizeof(float) + sizeof(gn_edge)));
    s->facing = malloc(most);
    s->gl->glGenBuffers(1, &s->picked);
    if (!s->scratch || !s->facing)
        return fail(message, "no memory for picking triangles");
    return 1;
}

void stage_release(stage *s)
{
    const gn_gl *gl = s->gl;

    for (size_t i = 0; s->meshes && i < s->scene->mesh_count; i++) {
        stage_mesh *m = &s->meshes[i];

        if (gl) {
            gl->glDeleteBuffers(1, &m->vertices);
            gl->glDeleteBuffers(1, &m->indices);
        }
        gn_gles_unload(s->gles, m->mesh);
        gn_mesh_destroy(m->mesh);
        gn_gles_unload(s->gles, m->proxy);
        gn_mesh_destroy(m->proxy);
        free(m->index_copy);
        free(m->batches);
    }
    if (gl && s->textures)
        gl->glDeleteTextures((GLsizei)s->scene->texture_count, s->textures);
    if (gl) {
        gl->glDeleteBuffers(1, &s->picked);
        for (int i = 0; i < STAGE_PROGRAMS; i++)
            gl->glDeleteProgram(s->programs[i].name);
        gl->glDeleteProgram(s->lines.name);
    }
    free(s->meshes);
    free(s->textures);
    free(s->objects);
    free(s->lights);
    free(s->planned);
    free(s->shading);
    free(s->members);
    free(s->scratch);
    free(s->facing);
    free(s->plan_memory);
}
