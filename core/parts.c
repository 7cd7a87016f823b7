/* parts.c - the connected parts of a mesh, and which of them are solid.
 *
 * Two triangles belong to one part when they alone share an edge. An edge with three or more triangles joins nothing:
 * the smaller the parts, the more of them are solid, and each part is right by itself.
 *
 * A part is solid when its chain is closed, its triangles are wound alike, and it does not pass through itself. Its
 * signed volume then says which way is out, the winding number of any point is 0 or 1, and for a light outside the
 * lit triangles alone cast the whole shadow (DESIGN.md, decision 2). Closed and wound alike is not enough: a closed
 * surface that passes through itself can enclose a region the wrong way round, whose shadow lit triangles alone
 * would miss. A part that is not solid loses nothing but speed: each of its triangles casts (Kim, Kim and Turk
 * 2008). */
#include "gni.h"

#include <math.h>
#include <string.h>

static uint32_t root_of(uint32_t *parent, uint32_t t)
{
    while (parent[t] != t)
        t = parent[t] = parent[parent[t]];
    return t;
}

static uint32_t triangle_of(uint32_t use)
{
    return (use & GNI_USE_CORNER) / 3;
}

static void join(const gn_mesh *mesh, uint32_t *parent)
{
    for (uint32_t t = 0; t < mesh->info.triangle_count; t++)
        parent[t] = t;
    for (uint32_t e = 0; e < mesh->info.edge_count; e++) {
        const uint32_t u = mesh->edge_uses[e];
        uint32_t a, b;

        if (mesh->edge_uses[e + 1] - u != 2)
            continue;
        a = root_of(parent, triangle_of(mesh->uses[u]));
        b = root_of(parent, triangle_of(mesh->uses[u + 1]));
        parent[a < b ? b : a] =
            a < b ? a : b; /* the lowest triangle is the root: parts come in the order of the mesh */
    }
}

/* part_of: from triangle to part, in place of parents; GNI_NONE for degenerate triangles. Returns the number of
 * parts. */
static uint32_t number_parts(const gn_mesh *mesh, uint32_t *part_of)
{
    uint32_t count = 0;

    for (uint32_t t = 0; t < mesh->info.triangle_count; t++)
        part_of[t] = root_of(part_of, t);
    for (uint32_t t = 0; t < mesh->info.triangle_count; t++) {
        const uint32_t *c = mesh->triangles + 3 * (size_t)t;

        if (part_of[t] != t)
            part_of[t] = part_of[part_of[t]]; /* the root stands before it and has its number already */
        else if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0])
            part_of[t] = GNI_NONE;
        else
            part_of[t] = count++;
    }
    return count;
}

static void sort_triangles(gn_mesh *mesh, const uint32_t *part_of)
{
    uint32_t at = 0;

    for (uint32_t t = 0; t < mesh->info.triangle_count; t++)
        if (part_of[t] != GNI_NONE)
            mesh->parts[part_of[t]].triangle_count++;
    for (uint32_t p = 0; p < mesh->info.part_count; p++) {
        mesh->parts[p].first_triangle = at;
        at += mesh->parts[p].triangle_count;
        mesh->parts[p].triangle_count = 0;
    }
    for (uint32_t t = 0; t < mesh->info.triangle_count; t++)
        if (part_of[t] != GNI_NONE) {
            gni_part *part = &mesh->parts[part_of[t]];

            mesh->part_triangles[part->first_triangle + part->triangle_count++] = t;
        }
    mesh->part_triangle_count = at;
}

/* A part's outward is 1 on entry; 0 when some edge is not closed within the part or two neighbours are wound unlike.
 * sums: [part_count], all 0, and 0 again on return. */
static void find_closed(gn_mesh *mesh, const uint32_t *part_of, int32_t *sums)
{
    for (uint32_t e = 0; e < mesh->info.edge_count; e++) {
        const uint32_t first = mesh->edge_uses[e], end = mesh->edge_uses[e + 1];

        for (uint32_t u = first; u < end; u++)
            sums[part_of[triangle_of(mesh->uses[u])]] += mesh->uses[u] & GNI_USE_DOWN ? -1 : 1;
        for (uint32_t u = first; u < end; u++) {
            const uint32_t p = part_of[triangle_of(mesh->uses[u])];

            if (sums[p] != 0)
                mesh->parts[p].outward = 0;
            sums[p] = 0;
        }
    }
}

static void measure(gn_mesh *mesh, gni_part *part)
{
    const float *origin = NULL;
    double volume = 0.0;

    for (int axis = 0; axis < 3; axis++) {
        part->box_min[axis] = INFINITY;
        part->box_max[axis] = -INFINITY;
    }
    for (uint32_t i = 0; i < part->triangle_count; i++) {
        const uint32_t *c = mesh->triangles + 3 * (size_t)mesh->part_triangles[part->first_triangle + i];
        double v[3][3];

        if (!origin)
            origin = mesh->positions + 3 * (size_t)c[0];
        for (int k = 0; k < 3; k++)
            for (int axis = 0; axis < 3; axis++) {
                const float p = mesh->positions[3 * (size_t)c[k] + (size_t)axis];

                part->box_min[axis] = p < part->box_min[axis] ? p : part->box_min[axis];
                part->box_max[axis] = p > part->box_max[axis] ? p : part->box_max[axis];
                v[k][axis] = (double)p - (double)origin[axis];
            }
        volume += v[0][0] * (v[1][1] * v[2][2] - v[1][2] * v[2][1]) +
                  v[0][1] * (v[1][2] * v[2][0] - v[1][0] * v[2][2]) + v[0][2] * (v[1][0] * v[2][1] - v[1][1] * v[2][0]);
    }
    if (part->outward && volume < 0.0)
        part->outward = -1;
}

static gn_result classify(gn_mesh *mesh)
{
    for (uint32_t p = 0; p < mesh->info.part_count; p++) {
        gni_part *part = &mesh->parts[p];

        measure(mesh, part);
        if (part->outward) {
            const int embedded = gni_part_is_embedded(mesh, part);

            if (embedded < 0)
                return GN_E_MEMORY;
            if (!embedded)
                part->outward = 0;
        }
        mesh->info.solid_part_count += part->outward != 0;
        mesh->info.outward_part_count += part->outward > 0;
    }
    return GN_OK;
}

gn_result gni_make_parts(gn_mesh *mesh)
{
    gn_context *context = mesh->context;
    gn_mesh_info *info = &mesh->info;
    uint32_t *part_of = gni_alloc(context, info->triangle_count, sizeof *part_of);
    int32_t *sums = NULL;
    gn_result result = GN_E_MEMORY;

    if (part_of) {
        join(mesh, part_of);
        info->part_count = number_parts(mesh, part_of);
        sums = gni_alloc(context, info->part_count, sizeof *sums);
        mesh->parts = gni_alloc(context, info->part_count, sizeof *mesh->parts);
        mesh->part_triangles = gni_alloc(context, info->triangle_count, sizeof *mesh->part_triangles);
    }
    if (sums && mesh->parts && mesh->part_triangles) {
        memset(sums, 0, info->part_count * sizeof *sums);
        memset(mesh->parts, 0, info->part_count * sizeof *mesh->parts);
        for (uint32_t p = 0; p < info->part_count; p++)
            mesh->parts[p].outward = 1;
        sort_triangles(mesh, part_of);
        find_closed(mesh, part_of, sums);
        result = classify(mesh);
    }
    gni_free(context, sums);
    gni_free(context, part_of);
    if (result == GN_E_MEMORY)
        return gn_fail(context, result, "mesh: no memory for the parts of %lu triangles",
                       (unsigned long)info->triangle_count);
    return result;
}
