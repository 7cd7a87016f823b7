/* volumes.c - draws records: the triangles of volumes, with whatever state is set.
 *
 * A chunk's vertices stand in its mesh's buffer from its first vertex on, each twice, so attribute 0 is pointed
 * there and the record's 16-bit indices do the rest. The turned part of a light cap is a call of its own: it keeps
 * its drawn order of vertices, and the caller counts it the other way round (DESIGN.md, decision 4). */
#include "gni_gles.h"

void gni_begin_volumes(gn_gles *g, const gni_program *program)
{
    g->in_use = program;
    g->pointed = NULL;
    g->gl.glUseProgram(program->name);
    g->bound_indices = 0;
    g->gl.glEnableVertexAttribArray(0);
}

static void bind_indices(gn_gles *g, GLuint buffer)
{
    if (g->bound_indices != buffer)
        g->gl.glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffer);
    g->bound_indices = buffer;
}

/* Attribute 0 at a chunk, where it is not there already; before each chunk stand the hubs of those before it. */
static void point_at(gn_gles *g, const gn_mesh *mesh, uint32_t chunk)
{
    const uint32_t vertex = gn_mesh_get_info(mesh)->chunks[chunk].first_vertex + chunk;

    if (g->pointed == mesh && g->pointed_chunk == chunk)
        return;
    g->pointed = mesh;
    g->pointed_chunk = chunk;
    g->gl.glBindBuffer(GL_ARRAY_BUFFER, gni_find_upload(g, mesh)->buffer);
    g->gl.glVertexAttribPointer(0, 4, GL_FLOAT, GL_FALSE, 4 * sizeof(float),
                                (const void *)((uintptr_t)vertex * 8 * sizeof(float)));
}

#if GNI_HAS_CULLING
void gni_draw_surface(gn_gles *g, const gn_plan_object *object)
{
    const gn_gl *gl = &g->gl;
    const gn_mesh_info *info = gn_mesh_get_info(object->mesh);

    bind_indices(g, gni_find_upload(g, object->mesh)->surface);
    gl->glUniformMatrix4fv(g->in_use->near_matrix, 1, GL_FALSE, object->matrix);
    for (uint32_t c = 0; c < info->chunk_count; c++) {
        point_at(g, object->mesh, c);
        gl->glDrawElements(GL_TRIANGLES, (GLsizei)(3 * info->chunks[c].triangle_count), GL_UNSIGNED_SHORT,
                           (const void *)((uintptr_t)info->chunks[c].first_triangle * 3 * sizeof(uint16_t)));
    }
}
#endif

void gni_draw_record(gn_gles *g, const gn_plan *plan, const gn_record *r, int turned)
{
    const gn_gl *gl = &g->gl;
    const uint32_t upright = r->light_cap_count + r->side_count + r->dark_cap_count + r->near_cap_count;
    const uint32_t first = turned ? r->first_turned_cap : r->first_index;
    const uint32_t count = turned ? r->turned_cap_count : upright;

    if (count == 0)
        return;
    point_at(g, plan->objects[r->object].mesh, r->chunk);
    bind_indices(g, r->is_cached ? g->cached : g->indices);
    gl->glUniformMatrix4fv(g->in_use->near_matrix, 1, GL_FALSE, r->near_matrix);
    gl->glUniformMatrix4fv(g->in_use->far_matrix, 1, GL_FALSE, r->far_matrix);
    gl->glDrawElements(GL_TRIANGLES, (GLsizei)count, GL_UNSIGNED_SHORT,
                       (const void *)((uintptr_t)first * sizeof(uint16_t)));
}

void gni_count_casters(gn_gles *g, const gn_step *step, int both_sides, gni_count *count)
{
    const gn_record *records = g->plan->records;
    const uint32_t end = step->first_record + step->record_count;

    for (uint32_t i = step->first_record, next; i < end; i = next) {
        for (next = i + 1; next < end && records[next].object == records[i].object;)
            next++;
        if (both_sides) {
            count(g, i, next, GNI_BOTH);
        } else {
            count(g, i, next, GNI_RISING);
            count(g, i, next, GNI_FALLING);
        }
    }
}

void gni_end_volumes(gn_gles *g)
{
    const gn_gl *gl = &g->gl;

    gl->glDisableVertexAttribArray(0);
    gl->glBindBuffer(GL_ARRAY_BUFFER, 0);
    gl->glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, 0);
    gl->glUseProgram(0);
}
