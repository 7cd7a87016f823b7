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

static uint32_t triangle_of(uint32_t use)
{
    return (use & GNI_USE_CORNER) / 3;
}

/* The triangle that alone shares an edge with this one, and is wound unlike; GNI_NONE where there is none. */
static uint32_t odd_neighbour(const gn_mesh *mesh, uint32_t corner)
{
    const uint32_t edge = mesh->edge_of[corner], first = mesh->edge_uses[edge];

    if (mesh->edge_uses[edge + 1] - first != 2)
        return GNI_NONE;
    return triangle_of(mesh->uses[(mesh->uses[first] & GNI_USE_CORNER) == corner ? first + 1 : first]);
}

/* part_of: from triangle to part; GNI_NONE for degenerate triangles. stack: [triangle_count]. Returns the number of
 * parts; they come in the order of their first triangles. */
static uint32_t number_parts(const gn_mesh *mesh, uint32_t *part_of, uint32_t *stack)
{
    const uint32_t triangles = mesh->info.triangle_count, *const across = mesh->across;
    uint32_t count = 0;

    memset(part_of, 0xff, mesh->info.triangle_count * sizeof *part_of);
    for (uint32_t first = 0; first < triangles; first++) {
        uint32_t top = 1;

        if (part_of[first] != GNI_NONE || mesh->edge_of[3 * (size_t)first] == GNI_NONE)
            continue;
        part_of[first] = count;
        stack[0] = first;
        while (top > 0) {
            const uint32_t t = stack[--top];

            for (uint32_t k = 0; k < 3; k++) {
                uint32_t other = across[3 * t + k];

                if (other == triangles && (other = odd_neighbour(mesh, 3 * t + k)) == GNI_NONE)
                    continue;
                if (part_of[other] != GNI_NONE)
                    continue;
                part_of[other] = count;
                stack[top++] = other;
            }
        }
        count++;
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
    for (uint32_t e = 0; e < mesh->info.edge_count && mesh->odd_edge_count > 0; e++) {
        const uint32_t first = mesh->edge_uses[e], end = mesh->edge_uses[e + 1];

        if (end - first == 2 && (mesh->uses[first] ^ mesh->uses[first + 1]) & GNI_USE_DOWN)
            continue; /* of one part, and closed */
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

static void find_box(const gn_mesh *mesh, gni_part *part)
{
    float low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};

    memcpy(part->box_min, mesh->info.box_min, sizeof part->box_min);
    memcpy(part->box_max, mesh->info.box_max, sizeof part->box_max);
    if (part->triangle_count == mesh->info.triangle_count)
        return;
    for (uint32_t i = 0; i < part->triangle_count; i++) {
        const uint32_t *c = mesh->triangles + 3 * (size_t)mesh->part_triangles[part->first_triangle + i];

        for (int k = 0; k < 3; k++)
            for (int axis = 0; axis < 3; axis++) {
                const float p = mesh->positions[3 * (size_t)c[k] + (size_t)axis];

                low[axis] = p < low[axis] ? p : low[axis];
                high[axis] = p > high[axis] ? p : high[axis];
            }
    }
    memcpy(part->box_min, low, sizeof low);
    memcpy(part->box_max, high, sizeof high);
}

#define PI     3.14159265358979323846
#define FILLED 0.25 /* of its box: by what has as much its box is known to be */

/* What is seen of it wherever it goes, but edge-on: the second of its box's sides; of a closed part that leaves most of its
 * box empty four times its volume over its surface, which of a bar is its width; of one that is open its surface over pi
 * times its box's diagonal, as of a tube. volume: six times so much; normals: of its triangles, each twice as long as that
 * is large, together. */
static double thickness_of(const gni_part *part, double volume, double normals)
{
    double side[3], least, most, second;

    for (int axis = 0; axis < 3; axis++)
        side[axis] = (double)part->box_max[axis] - (double)part->box_min[axis];
    least = fmin(side[0], fmin(side[1], side[2]));
    most = fmax(side[0], fmax(side[1], side[2]));
    second = side[0] + side[1] + side[2] - least - most;
    if (!part->is_closed)
        return fmin(second, 0.5 * normals / (PI * sqrt(gni_dot(side, side))));
    if (normals == 0.0 || fabs(volume) > 6.0 * FILLED * side[0] * side[1] * side[2])
        return second;
    return fmin(second, 4.0 / 3.0 * fabs(volume) / normals);
}

/* The signed volume: of the pyramids from a point near by over the triangles, each its plane's value there. */
static void measure(gn_mesh *mesh, gni_part *part)
{
    double origin[3], volume = 0.0, normals = 0.0;

    find_box(mesh, part);
    for (int axis = 0; axis < 3; axis++)
        origin[axis] = 0.5 * (double)part->box_min[axis] + 0.5 * (double)part->box_max[axis];
    for (uint32_t i = 0; i < part->triangle_count; i++) {
        const double *plane = mesh->planes + 4 * (size_t)mesh->part_triangles[part->first_triangle + i];

        volume -= plane[0] * origin[0] + plane[1] * origin[1] + plane[2] * origin[2] + plane[3];
        normals += GNI_HAS_REFINE ? sqrt(gni_dot(plane, plane)) : 0.0;
    }
    if (part->outward && volume < 0.0)
        part->outward = -1;
    if (GNI_HAS_REFINE)
        mesh->thickness = fmin(mesh->thickness, thickness_of(part, volume, normals));
}

static void count_part(gn_mesh *mesh, const gni_part *part)
{
    mesh->info.solid_part_count += part->outward != 0;
    mesh->info.outward_part_count += part->outward > 0;
}

static gn_result classify(gn_mesh *mesh)
{
    mesh->thickness = INFINITY;
    for (uint32_t p = 0; p < mesh->info.part_count; p++) {
        gni_part *part = &mesh->parts[p];

        part->is_closed = part->outward;
        measure(mesh, part);
        if (part->outward) {
            const int embedded = GNI_HAS_SOLIDS ? gni_part_is_embedded(mesh, part) : gni_part_is_star(mesh, part);

            if (embedded < 0)
                return GN_E_MEMORY;
            if (!embedded)
                part->outward = 0;
        }
        count_part(mesh, part);
    }
    return GN_OK;
}

void gni_judge_parts(gn_mesh *mesh)
{
    mesh->info.solid_part_count = mesh->info.outward_part_count = 0;
    mesh->thickness = INFINITY;
    for (uint32_t p = 0; p < mesh->info.part_count; p++) {
        gni_part *part = &mesh->parts[p];

        part->outward = part->is_closed;
        measure(mesh, part);
        if (part->outward && !gni_part_is_star(mesh, part))
            part->outward = 0;
        count_part(mesh, part);
    }
}

gn_result gni_make_parts(gn_mesh *mesh)
{
    gn_context *context = mesh->context;
    gn_mesh_info *info = &mesh->info;
    uint32_t *part_of = gni_alloc(context, info->triangle_count, sizeof *part_of);
    uint32_t *stack = gni_alloc(context, info->triangle_count, sizeof *stack);
    int32_t *sums = NULL;
    gn_result result = GN_E_MEMORY;

    if (part_of && stack) {
        info->part_count = number_parts(mesh, part_of, stack);
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
    gni_free(context, stack);
    gni_free(context, part_of);
    if (result == GN_E_MEMORY)
        return gn_fail(context, result, "mesh: no memory for the parts of %lu triangles",
                       (unsigned long)info->triangle_count);
    return result;
}
