/* mesh.c - a triangle soup made ready to cast: welded, with edges, planes, parts and 16-bit chunks, once for all
 * frames. */
#include "gni.h"

#include <math.h>
#include <string.h>

void gn_mesh_destroy(gn_mesh *mesh)
{
    gn_context *context;

    if (!mesh)
        return;
    context = mesh->context;
    gni_free(context, mesh->positions);
    gni_free(context, mesh->given);
    gni_free(context, mesh->welded);
    gni_free(context, mesh->first_given);
    gni_free(context, mesh->order);
    gni_free(context, mesh->triangles);
    if (GNI_HAS_WELDING && mesh->facing_planes != mesh->planes)
        gni_free(context, mesh->facing_planes);
    if (GNI_HAS_WELDING)
        gni_free(context, mesh->group_of);
    gni_free(context, mesh->planes);
    gni_free(context, mesh->edge_uses);
    gni_free(context, mesh->uses);
    gni_free(context, mesh->edge_of);
    gni_free(context, mesh->across);
    if (GNI_HAS_CLUSTERS) {
        gni_free(context, mesh->clusters);
        gni_free(context, mesh->nodes);
        gni_free(context, mesh->border_starts);
        gni_free(context, mesh->borders);
    }
    gni_free(context, mesh->scratch.of);
    gni_free(context, mesh->scratch.bits);
    gni_free(context, mesh->scratch.spare);
    gni_free(context, mesh->parts);
    gni_free(context, mesh->part_triangles);
    gni_free(context, mesh->chunks);
    gni_free(context, mesh->chunk_vertices);
    gni_free(context, mesh->corners);
    gni_free(context, mesh);
}

static double square_of(const double v[3])
{
    return v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
}

/* The plane of a triangle: its cross product and minus that times its first vertex. 0 0 0 0 where it has no area.
 * Returns the square of its longest edge; square: of its cross product. */
static inline double plane_of(const float *positions, const uint32_t corners[3], double plane[4], double *square)
{
    const float *p = positions + 3 * (size_t)corners[0], *q = positions + 3 * (size_t)corners[1];
    const float *r = positions + 3 * (size_t)corners[2];
    const double v[3] = {(double)p[0], (double)p[1], (double)p[2]};
    const double a[3] = {(double)q[0] - v[0], (double)q[1] - v[1], (double)q[2] - v[2]};
    const double b[3] = {(double)r[0] - v[0], (double)r[1] - v[1], (double)r[2] - v[2]};
    const double d[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    const double n[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    double longest = square_of(a), other = square_of(b);

    plane[0] = n[0];
    plane[1] = n[1];
    plane[2] = n[2];
    plane[3] = -(n[0] * v[0] + n[1] * v[1] + n[2] * v[2]);
    *square = square_of(n);
    longest = longest > other ? longest : other;
    other = square_of(d);
    return longest > other ? longest : other;
}

static void find_hub(gn_mesh *mesh)
{
    double square = 0.0;

    for (int axis = 0; axis < 3; axis++) /* halves, since the sum may be too much for a float */
        mesh->info.hub[axis] = 0.5f * mesh->info.box_min[axis] + 0.5f * mesh->info.box_max[axis];
    for (uint32_t v = 0; (GNI_HAS_CULLING || GNI_HAS_CLUSTERS) && v < mesh->info.vertex_count; v++) {
        double d[3], of_vertex;

        for (int axis = 0; axis < 3; axis++)
            d[axis] = (double)mesh->positions[3 * (size_t)v + (size_t)axis] - (double)mesh->info.hub[axis];
        of_vertex = square_of(d);
        square = of_vertex > square ? of_vertex : square;
    }
    mesh->radius = sqrt(square);
}

void gni_find_planes(gn_mesh *mesh)
{
    const double *first = NULL;
    const uint32_t *corners = mesh->triangles;
    const float *positions = mesh->positions;
    double largest = 0.0, longest = 0.0;
    int is_alike = 1;

    mesh->largest = 0;
    mesh->info.planar = GNI_HAS_CULLING && mesh->info.triangle_count > 0;
    for (uint32_t t = 0; t < mesh->info.triangle_count; t++) {
        double *plane = mesh->planes + 4 * (size_t)t, square;
        const double edge = plane_of(positions, corners + 3 * (size_t)t, plane, &square);

        if (!GNI_HAS_CULLING)
            continue;
        longest = longest > edge ? longest : edge;
        if (square == 0.0) /* products of floats' differences do not vanish in doubles */
            continue;
        if (!first)
            first = plane;
        if (square > largest) {
            largest = square;
            mesh->largest = t;
        }
        if (!mesh->info.planar)
            continue;
        is_alike &= plane[0] * first[0] + plane[1] * first[1] + plane[2] * first[2] > 0.0;
        for (int k = 0; k < 3 && mesh->info.planar; k++) { /* exact: a mesh is planar, or it is not known to be */
            const float *p = mesh->positions + 3 * (size_t)mesh->triangles[3 * (size_t)t + (size_t)k];

            if (first[0] * (double)p[0] + first[1] * (double)p[1] + first[2] * (double)p[2] + first[3] != 0.0)
                mesh->info.planar = 0;
        }
    }
    mesh->longest_edge = GNI_HAS_CULLING ? sqrt(longest) : 0.0;
    if (!first)
        mesh->info.planar = 0;
    else if (mesh->info.planar && is_alike)
        mesh->info.planar = 2;
    find_hub(mesh);
}

static gn_result make_planes(gn_mesh *mesh)
{
    mesh->planes = gni_alloc(mesh->context, mesh->info.triangle_count, 4 * sizeof(double));
    if (!mesh->planes)
        return gn_fail(mesh->context, GN_E_MEMORY, "mesh: no memory for the planes of %lu triangles",
                       (unsigned long)mesh->info.triangle_count);
    gni_find_planes(mesh);
    return GN_OK;
}

/* The order of the description. */
static gn_result keep_order(gn_mesh *mesh)
{
    const size_t count = mesh->info.triangle_count;

    mesh->order = gni_alloc(mesh->context, count, sizeof *mesh->order);
    mesh->triangles = gni_alloc(mesh->context, count, 3 * sizeof *mesh->triangles);
    if (!mesh->order || !mesh->triangles)
        return gn_fail(mesh->context, GN_E_MEMORY, "mesh: no memory for %lu triangles", (unsigned long)count);
    for (uint32_t t = 0; t < count; t++)
        mesh->order[t] = t;
    if (count)
        memcpy(mesh->triangles, mesh->given, count * 3 * sizeof *mesh->triangles);
    return GN_OK;
}

static gn_result make_scratch(gn_mesh *mesh)
{
    gni_casting *c = &mesh->scratch;

    mesh->cluster_count = (mesh->info.triangle_count + GNI_CLUSTER - 1) / GNI_CLUSTER;
    c->of = gni_alloc(mesh->context, (size_t)mesh->info.triangle_count + 1, 1);
    c->bits = gni_alloc(mesh->context, mesh->cluster_count, sizeof *c->bits);
    c->spare = gni_alloc(mesh->context, mesh->cluster_count, sizeof *c->spare);
    mesh->first_given = gni_alloc(mesh->context, mesh->info.vertex_count, sizeof *mesh->first_given);
    if (!c->of || !c->bits || !c->spare || !mesh->first_given)
        return gn_fail(mesh->context, GN_E_MEMORY, "mesh: no memory for the facing of %lu triangles",
                       (unsigned long)mesh->info.triangle_count);
    return GN_OK;
}

gn_result gn_mesh_create(gn_context *context, const gn_mesh_desc *desc, gn_mesh **out)
{
    gn_mesh *mesh;
    gn_result result;

    if (out)
        *out = NULL;
    if (!context || !desc || !out || (!desc->positions && desc->vertex_count) ||
        (!desc->indices && desc->triangle_count))
        return gn_fail(context, GN_E_ARG, "gn_mesh_create: NULL argument");
    if (desc->stride != 0 && (desc->stride < 3 * sizeof(float) || desc->stride % sizeof(float) != 0))
        return gn_fail(context, GN_E_ARG, "gn_mesh_create: stride of %lu bytes: a multiple of 4 from 12 on, or 0",
                       (unsigned long)desc->stride);
    if (desc->triangle_count > GN_MAX_TRIANGLES || desc->vertex_count > 3 * (size_t)GN_MAX_TRIANGLES)
        return gn_fail(context, GN_E_ARG, "gn_mesh_create: %lu triangles, %lu vertices: at most %lu triangles",
                       (unsigned long)desc->triangle_count, (unsigned long)desc->vertex_count,
                       (unsigned long)GN_MAX_TRIANGLES);
    if (!(desc->weld_angle >= 0.0 && desc->weld_angle < 1.0))
        return gn_fail(context, GN_E_ARG, "gn_mesh_create: edges are welded by 0 to 1 radian (%g)", desc->weld_angle);
    if (!GNI_HAS_WELDING && desc->weld_angle > 0.0)
        return gn_fail(context, GN_E_DEVICE, "gn_mesh_create: this build lacks the feature welding (%g radian)",
                       desc->weld_angle);
    mesh = gni_alloc(context, 1, sizeof *mesh);
    if (!mesh)
        return gn_fail(context, GN_E_MEMORY, "gn_mesh_create: no memory for a mesh");
    memset(mesh, 0, sizeof *mesh);
    mesh->context = context;
    result = gni_weld(mesh, desc);
    if (result == GN_OK)
        result = GNI_HAS_CLUSTERS ? gni_order_triangles(mesh) : keep_order(mesh);
    if (result == GN_OK)
        result = make_planes(mesh);
    if (result == GN_OK)
        result = gni_make_edges(mesh);
    if (result == GN_OK)
        result = gni_make_parts(mesh);
    if (result == GN_OK)
        result = gni_make_chunks(mesh);
    mesh->facing_planes = mesh->planes;
    if (GNI_HAS_WELDING && result == GN_OK)
        result = gni_make_groups(mesh, desc->weld_angle);
    if (GNI_HAS_CLUSTERS && result == GN_OK)
        result = gni_make_clusters(mesh);
    if (result == GN_OK)
        result = make_scratch(mesh);
    if (result != GN_OK) {
        gn_mesh_destroy(mesh);
        return result;
    }
    mesh->info.positions = mesh->positions;
    mesh->info.triangles = mesh->given;
    mesh->info.chunks = mesh->chunks;
    mesh->info.chunk_vertices = mesh->chunk_vertices;
    mesh->info.corners = mesh->corners;
    *out = mesh;
    return GN_OK;
}

const gn_mesh_info *gn_mesh_get_info(const gn_mesh *mesh)
{
    return &mesh->info;
}
