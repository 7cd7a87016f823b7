/* sweep.c - a bound on layers from the silhouettes alone: a line swept over light space.
 *
 * A line over a point with L layers crosses L silhouette edges on its way in and L on its way out. So nowhere are there
 * more layers than half the weights that one line of a set crosses. The lines are those of a plane before the light
 * along which one coordinate is constant, in bins; an edge adds its weight to all bins that it touches. That takes a
 * few dozen instructions a silhouette edge, and mostly spares the question of cells.c, which looks at triangles. All
 * casters must lie before the plane through the light: one sun, or a lamp above a floor; for a lamp among casters there
 * is no answer here. */
#include "gni_plan.h"

#include <math.h>
#include <string.h>

#define PASSES 64
#define WAYS   12   /* in which the lines run: where a silhouette runs along them they cross much of it */
#define ROOM   0.01 /* of a corner's distance: so far before the plane through the light it must lie */
#define LOOSE  1e-3 /* of a bin: rounding stays inside */

#define BINS_AN_EDGE 32 /* so that few edges share one; no more are cleared and summed than that */
#define LEAST_BINS   512

/* A point of view space is at dot(along, p) / dot(depth, p) of the line of bins, 0 to count. */
typedef struct bins {
    double along[4], depth[4];
    int count; /* at most GNI_BINS */
} bins;

/* only: one object, or GNI_NONE for all that cast. */
static int is_caster(const gni_draft *d, uint32_t object, uint32_t only)
{
    return d->is_in[object] & GNI_IN_CAST && (only == GNI_NONE || only == object);
}

/* A direction from the light before which all casters lie: their mean one, turned towards any corner that lies behind
 * until none does (the perceptron: it ends where there is such a direction with room to spare). */
static int find_axis(const gni_draft *d, uint32_t only, double axis[3])
{
    const double *light = d->bounds.light;

    for (int k = 0; k < 3; k++)
        axis[k] = light[3] == 0.0 ? -light[k] : 0.0;
    for (int pass = 0; pass < PASSES && light[3] != 0.0; pass++) {
        int turned = 0;

        for (uint32_t i = 0; i < d->scene->object_count; i++)
            for (int corner = 0; corner < 8 && is_caster(d, i, only); corner++) {
                double v[3], length;

                for (int k = 0; k < 3; k++)
                    v[k] = d->boxes[i].points[corner][k] - light[k];
                length = sqrt(gni_dot(v, v));
                if (pass > 0 && gni_dot(axis, v) > ROOM * length * sqrt(gni_dot(axis, axis)))
                    continue;
                turned = 1;
                for (int k = 0; k < 3 && length > 0.0; k++)
                    axis[k] += v[k] / length;
            }
        if (!turned)
            return 1;
    }
    return light[3] == 0.0;
}

/* turn: of the lines, about the direction from the light. */
static int fit_bins(const gni_draft *d, uint32_t only, double turn, bins *b)
{
    const double *light = d->bounds.light;
    double axis[3], axes[3][3], low = INFINITY, high = -INFINITY;

    if (!find_axis(d, only, axis) || !(gni_dot(axis, axis) > 0.0))
        return 0;
    gni_make_axes(axes, axis);
    for (int k = 0; k < 3; k++)
        axes[0][k] = cos(turn) * axes[0][k] + sin(turn) * axes[1][k];
    for (uint32_t i = 0; i < d->scene->object_count; i++)
        for (int corner = 0; corner < 8 && is_caster(d, i, only); corner++) {
            double v[3], depth;

            for (int k = 0; k < 3; k++)
                v[k] = d->boxes[i].points[corner][k] - light[k] * light[3];
            depth = light[3] == 0.0 ? 1.0 : gni_dot(axes[2], v);
            low = fmin(low, gni_dot(axes[0], v) / depth);
            high = fmax(high, gni_dot(axes[0], v) / depth);
        }
    if (!(high > low))
        return 0;
    for (int k = 0; k < 3; k++) {
        b->depth[k] = light[3] == 0.0 ? 0.0 : axes[2][k];
        b->along[k] = axes[0][k];
    }
    b->depth[3] = light[3] == 0.0 ? 1.0 : -gni_dot(axes[2], light);
    b->along[3] = light[3] == 0.0 ? 0.0 : -gni_dot(axes[0], light);
    for (int k = 0; k < 4; k++)
        b->along[k] = (b->along[k] - low * b->depth[k]) * (b->count / (high - low));
    return 1;
}

static double at_vertex(const bins *b, const float p[3])
{
    const double v[3] = {(double)p[0], (double)p[1], (double)p[2]};
    const double depth = gni_dot(b->depth, v) + b->depth[3];

    return depth > 0.0 ? (gni_dot(b->along, v) + b->along[3]) / depth : NAN;
}

static void row_by_matrix(double row[4], const double m[16])
{
    double out[4];

    for (int i = 0; i < 4; i++)
        out[i] = gni_dot(row, m + 4 * i) + (i == 3 ? row[3] : 0.0);
    memcpy(row, out, sizeof out);
}

/* Adds an edge between two of a chunk's vertices to the differences between bins. 0 where an end has no place among
 * them. */
static int add_edge(const bins *b, const gn_mesh *mesh, const uint32_t *vertices, uint32_t from, uint32_t to,
                    int32_t differences[GNI_BINS + 1])
{
    const double x = at_vertex(b, mesh->positions + 3 * (size_t)vertices[from / 2u]);
    const double y = at_vertex(b, mesh->positions + 3 * (size_t)vertices[to / 2u]);

    if (!(x >= -1.0 && x <= b->count + 1.0 && y >= -1.0 && y <= b->count + 1.0))
        return 0;
    differences[(int)fmin(fmax((x < y ? x : y) - LOOSE, 0.0), b->count - 1.0)]++;
    differences[(int)fmin(fmax((x < y ? y : x) + LOOSE, 0.0), b->count - 1.0) + 1]--;
    return 1;
}

/* The silhouette of a record: that which its sides stand on, or the outline of its cap on a patch. */
static gni_outline outline_of(const gni_draft *d, uint32_t record)
{
    const gn_record *r = &d->records[record];
    const gni_outline of_sides = {r->first_side, r->side_count,
                                  r->far_end != GN_FAR_ENDED && d->bounds.light[3] == 0.0 ? 3 : 6};

    return r->patch ? d->outlines[record + d->flat_count - d->plan->record_count] : of_sides;
}

/* Adds it to the differences. */
static int add_record(const gni_draft *d, uint32_t record, const bins *in_view, int32_t differences[GNI_BINS + 1])
{
    const gn_record *r = &d->records[record];
    const gn_object *object = &d->scene->objects[r->object];
    const gn_mesh *mesh = object->mesh;
    const uint32_t *vertices = mesh->chunk_vertices + mesh->chunks[r->chunk].first_vertex;
    const uint16_t *from = r->is_cached ? d->scene->cache->indices : d->indices;
    const gni_outline outline = outline_of(d, record);
    double model_view[16];
    bins b = *in_view;
    int all_fit = 1;

    if (r->detached && record > 0 && r[-1].object == r->object && r[-1].first_side == r->first_side && !r[-1].patch)
        return 1; /* of the same volume: no point is in both */
    gni_model_view(model_view, &d->scene->camera, object->model, mesh->info.centre);
    row_by_matrix(b.along, model_view);
    row_by_matrix(b.depth, model_view);
    from += outline.first;
    for (uint32_t i = 0; i < outline.count; i += outline.of_a_side)
        all_fit &= add_edge(&b, mesh, vertices, from[i], from[i + 1], differences);
    return all_fit;
}

static int is_swept(const gni_draft *d, uint32_t record, uint32_t only)
{
    return only == GNI_NONE || d->records[record].object == only;
}

static int choose_count(const gni_draft *d, uint32_t first_record, uint32_t only)
{
    uint32_t edges = 0;
    int count = LEAST_BINS;

    for (uint32_t i = first_record; i < d->plan->record_count; i++)
        if (is_swept(d, i, only)) {
            const gni_outline outline = outline_of(d, i);

            edges += outline.count / outline.of_a_side;
        }
    while (count < GNI_BINS && (uint32_t)count < BINS_AN_EDGE * edges)
        count *= 2;
    return count;
}

static uint32_t sweep(gni_draft *d, uint32_t first_record, uint32_t only, double turn)
{
    int32_t *const differences = d->layers->bins, crossed = 0, most = 0;
    bins b;

    b.count = choose_count(d, first_record, only);
    if (!fit_bins(d, only, turn, &b))
        return UINT32_MAX;
    memset(differences, 0, ((size_t)b.count + 1) * sizeof *differences);
    for (uint32_t i = first_record; i < d->plan->record_count; i++)
        if (is_swept(d, i, only) && !add_record(d, i, &b, differences))
            return UINT32_MAX;
    for (int i = 0; i < b.count; i++) {
        crossed += differences[i];
        most = crossed > most ? crossed : most;
    }
    return (uint32_t)most / 2;
}

uint32_t gni_sweep_layers(gni_draft *d, uint32_t first_record)
{
    return sweep(d, first_record, GNI_NONE, 0.0);
}

uint32_t gni_sweep_caster(gni_draft *d, uint32_t first_record, uint32_t object)
{
    uint32_t least = UINT32_MAX;

    for (int way = 0; way < WAYS; way++) {
        const uint32_t layers = sweep(d, first_record, object, 3.141592653589793 * way / WAYS);

        least = layers < least ? layers : least;
    }
    return least;
}
