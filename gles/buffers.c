/* buffers.c - meshes in vertex buffers, every vertex twice: w = 1 near, w = 0 far (McGuire 2003, section 4.2). They
 * are sent once; a frame sends only indices. */
#include "gni_gles.h"

#include <string.h>

#define BATCH 64u /* vertices converted at a time, on the stack */

/* Where the mesh is, or would be. */
static uint32_t place_of(const gn_gles *g, const gn_mesh *mesh)
{
    uint32_t low = 0, high = g->upload_count;

    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;

        if ((uintptr_t)g->uploads[middle].mesh < (uintptr_t)mesh)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

const gni_upload *gni_find_upload(const gn_gles *g, const gn_mesh *mesh)
{
    const uint32_t at = place_of(g, mesh);

    return at < g->upload_count && g->uploads[at].mesh == mesh ? &g->uploads[at] : NULL;
}

/* A vertex of a chunk; its hub after the last. */
static const float *vertex_of(const gn_mesh_info *info, const gn_chunk *chunk, uint32_t vertex)
{
    return vertex < chunk->vertex_count
               ? info->positions + 3 * (size_t)info->chunk_vertices[chunk->first_vertex + vertex]
               : info->hub;
}

static void send_vertices(const gn_gl *gl, const gn_mesh_info *info, int is_new)
{
    const gn_chunk *last = &info->chunks[info->chunk_count - 1];
    uint32_t at = 0;
    float batch[BATCH][2][4];

    if (is_new)
        gl->glBufferData(GL_ARRAY_BUFFER,
                         (GLsizeiptr)((last->first_vertex + last->vertex_count + info->chunk_count) * sizeof batch[0]),
                         NULL, GL_STATIC_DRAW);
    for (uint32_t c = 0; c < info->chunk_count; c++)
        for (uint32_t first = 0; first <= info->chunks[c].vertex_count; first += BATCH) {
            const uint32_t rest = info->chunks[c].vertex_count + 1 - first, n = rest < BATCH ? rest : BATCH;

            for (uint32_t i = 0; i < n; i++)
                for (int far = 0; far < 2; far++) {
                    memcpy(batch[i][far], vertex_of(info, &info->chunks[c], first + i), 3 * sizeof(float));
                    batch[i][far][3] = far ? 0.0f : 1.0f;
                }
            gl->glBufferSubData(GL_ARRAY_BUFFER, (GLintptr)(at * sizeof batch[0]), (GLsizeiptr)(n * sizeof batch[0]),
                                batch);
            at += n;
        }
}

/* Every triangle by its near vertices. */
static void send_surface(const gn_gl *gl, const gn_mesh_info *info)
{
    gl->glBufferData(GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)(3 * (size_t)info->triangle_count * sizeof *info->corners),
                     info->corners, GL_STATIC_DRAW);
}

gn_result gn_gles_upload(gn_gles *g, const gn_mesh *mesh)
{
    const gn_gl *gl;
    uint32_t at;
    GLuint buffers[2] = {0, 0};

    if (!g || !mesh)
        return gn_fail(g ? g->context : NULL, GN_E_ARG, "gn_gles_upload: NULL argument");
    if (g->forgotten)
        return gn_fail(g->context, GN_E_ARG, "gn_gles_upload: the GL context was lost");
    gl = &g->gl;
    at = place_of(g, mesh);
    if (gni_find_upload(g, mesh) && g->uploads[at].shape == gn_mesh_get_info(mesh)->shape)
        return GN_OK;
    if (gni_find_upload(g, mesh)) {
        gl->glBindBuffer(GL_ARRAY_BUFFER, g->uploads[at].buffer);
        send_vertices(gl, gn_mesh_get_info(mesh), 0);
        gl->glBindBuffer(GL_ARRAY_BUFFER, 0);
        g->uploads[at].shape = gn_mesh_get_info(mesh)->shape;
        return GN_OK;
    }
    if (g->upload_count == g->upload_capacity) {
        const uint32_t capacity = g->upload_capacity ? 2 * g->upload_capacity : 16;
        gni_upload *grown =
            g->port.resize(g->port.user, g->uploads, g->upload_capacity * sizeof *grown, capacity * sizeof *grown);

        if (!grown)
            return gn_fail(g->context, GN_E_MEMORY, "gn_gles_upload: no memory for a list of meshes");
        g->uploads = grown;
        g->upload_capacity = capacity;
    }
    gl->glGenBuffers(2, buffers);
    gl->glBindBuffer(GL_ARRAY_BUFFER, buffers[0]);
    gl->glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers[1]);
    send_vertices(gl, gn_mesh_get_info(mesh), 1);
    send_surface(gl, gn_mesh_get_info(mesh));
    gl->glBindBuffer(GL_ARRAY_BUFFER, 0);
    gl->glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, 0);
    if (gl->glGetError() != GL_NO_ERROR) {
        gl->glDeleteBuffers(2, buffers);
        return gn_fail(g->context, GN_E_DEVICE, "gn_gles_upload: the GL has no room for %lu vertices",
                       (unsigned long)gn_mesh_get_info(mesh)->vertex_count);
    }
    at = place_of(g, mesh);
    memmove(g->uploads + at + 1, g->uploads + at, (g->upload_count - at) * sizeof *g->uploads);
    g->uploads[at] = (gni_upload){mesh, buffers[0], buffers[1], gn_mesh_get_info(mesh)->shape};
    g->upload_count++;
    return GN_OK;
}

void gni_delete_upload(gn_gles *g, const gni_upload *upload)
{
    const GLuint buffers[2] = {upload->buffer, upload->surface};

    g->gl.glDeleteBuffers(2, buffers);
}

void gn_gles_unload(gn_gles *g, const gn_mesh *mesh)
{
    const gni_upload *upload = g && mesh ? gni_find_upload(g, mesh) : NULL;
    const uint32_t at = upload ? (uint32_t)(upload - g->uploads) : 0;

    if (!upload)
        return;
    if (!g->forgotten)
        gni_delete_upload(g, upload);
    g->upload_count--;
    memmove(g->uploads + at, g->uploads + at + 1, (g->upload_count - at) * sizeof *g->uploads);
}
