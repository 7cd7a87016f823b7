/* loads.c - how much there is to draw for a light's shadows, and what they are like: read off a plan.
 *
 * Fragments are the projected areas of volumes' triangles within the scissor, borders what is round them. All of them would cost as much as a
 * vertex shader does, so a sample is taken, evenly from first to last: a quad of a side, or a triangle of a cap, at each
 * step. */
#include "gn_select.h"
#include "gni.h"

#include <math.h>
#include <string.h>

enum { SAMPLES = 128, MOST_CORNERS = 10 };

/* ------------------------------------------------------------------ areas */

/* Where the volume may be drawn, as planes of clip space: x - l w >= 0 and so on. Whatever is within the four has w >= 0. */
typedef struct window {
    double planes[5][4];
    double half[2]; /* pixels of half a target */
} window;

static void set_window(window *w, const gn_plan *plan, const uint32_t at[4])
{
    const double size[2] = {plan->viewport[0], plan->viewport[1]};

    memset(w, 0, sizeof *w);
    for (int axis = 0; axis < 2; axis++) {
        w->half[axis] = 0.5 * size[axis];
        w->planes[2 * axis][axis] = 1.0;
        w->planes[2 * axis][3] = 1.0 - 2.0 * at[axis] / size[axis];
        w->planes[2 * axis + 1][axis] = -1.0;
        w->planes[2 * axis + 1][3] = 2.0 * (at[axis] + at[2 + axis]) / size[axis] - 1.0;
    }
    w->planes[4][2] = w->planes[4][3] = 1.0; /* near */
}

static int clip(double (*out)[4], const double (*in)[4], int count, const double plane[4])
{
    int kept = 0;

    for (int i = 0; i < count; i++) {
        const double *a = in[i], *b = in[(i + 1) % count];
        const double at_a = a[0] * plane[0] + a[1] * plane[1] + a[2] * plane[2] + a[3] * plane[3];
        const double at_b = b[0] * plane[0] + b[1] * plane[1] + b[2] * plane[2] + b[3] * plane[3];

        if (at_a >= 0.0)
            memcpy(out[kept++], a, sizeof *out);
        if ((at_a >= 0.0) != (at_b >= 0.0)) {
            for (int k = 0; k < 4; k++)
                out[kept][k] = a[k] + (b[k] - a[k]) * at_a / (at_a - at_b);
            kept++;
        }
    }
    return kept;
}

/* How much of the target a triangle takes, in pixels. */
typedef struct extent {
    double area, border;
} extent;

/* Adds a triangle in clip space, so many times. */
static void add_triangle(const window *w, double triangle[3][4], double times, extent *sum)
{
    double corners[2][MOST_CORNERS][4], at[MOST_CORNERS][2], area = 0.0;
    int count = 3, from = 0;

    memcpy(corners[0], triangle, 3 * sizeof triangle[0]);
    for (int p = 0; p < 5 && count > 0; p++, from = !from)
        count = clip(corners[!from], (const double(*)[4])corners[from], count, w->planes[p]);
    for (int i = 0; i < count; i++) {
        const double *c = corners[from][i];

        if (!(c[3] > 0.0))
            return;
        for (int axis = 0; axis < 2; axis++)
            at[i][axis] = w->half[axis] * c[axis] / c[3];
    }
    for (int i = 0; i < count; i++) {
        const double *a = at[i], *b = at[(i + 1) % count];

        area += (a[0] - at[0][0]) * (b[1] - at[0][1]) - (a[1] - at[0][1]) * (b[0] - at[0][0]);
        sum->border += times * sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]));
    }
    sum->area += times * fabs(area) / 2.0;
}

/* ------------------------------------------------------------------ records */

static void place(double out[4], const gn_mesh_info *mesh, const gn_record *r, uint16_t index)
{
    const gn_chunk *chunk = &mesh->chunks[r->chunk];
    const uint32_t vertex = index / 2u;
    const float *p = vertex < chunk->vertex_count
                         ? mesh->positions + 3 * (size_t)mesh->chunk_vertices[chunk->first_vertex + vertex]
                         : mesh->hub;
    const float *m = index % 2u ? r->far_matrix : r->near_matrix;

    for (int k = 0; k < 4; k++)
        out[k] = (double)m[k] * (double)p[0] + (double)m[4 + k] * (double)p[1] + (double)m[8 + k] * (double)p[2] +
                 (double)m[12 + k];
}

static void add_triangles(const gn_plan *plan, const gn_record *r, const window *w, const uint16_t *indices,
                          uint32_t triangles, double times, extent *sum)
{
    const gn_mesh_info *mesh = gn_mesh_get_info(plan->objects[r->object].mesh);

    for (uint32_t t = 0; t < triangles; t++) {
        double corners[3][4];

        for (int k = 0; k < 3; k++)
            place(corners[k], mesh, r, indices[3 * t + (uint32_t)k]);
        add_triangle(w, corners, times, sum);
    }
}

/* A sun's far vertices are all at one point: its sides are triangles, if they do not end. */
static uint32_t triangles_of_a_side(const gn_record *r)
{
    for (int i = 0; i < 12; i++)
        if (r->far_matrix[i] != 0.0f)
            return 2;
    return 1;
}

/* Steps through pieces of one kind, of all records of a light. */
typedef struct sampler {
    double step, next; /* pieces from one sample to the next; how many to go */
    extent sum;
} sampler;

static void sample(sampler *s, const gn_plan *plan, const gn_record *r, uint32_t first, uint32_t count,
                   uint32_t of_a_piece)
{
    const uint16_t *indices = (r->is_cached ? plan->cached_indices : plan->indices) + first;
    const uint32_t pieces = count / (3 * of_a_piece);
    window w;
    int is_set = 0;

    for (; s->next < pieces; s->next += s->step) {
        if (!is_set)
            set_window(&w, plan, r->scissor);
        is_set = 1;
        add_triangles(plan, r, &w, indices + 3 * (size_t)of_a_piece * (size_t)s->next, of_a_piece, s->step, &s->sum);
    }
    s->next -= pieces;
}

/* ------------------------------------------------------------------ facts */

/* Half of the border of what casts, on the screen, as a share of half the screen's border. */
static double border_of(const gn_plan *plan, const gn_plan_object *object)
{
    const gn_mesh_info *mesh = gn_mesh_get_info(object->mesh);
    double low[2] = {1.0, 1.0}, high[2] = {-1.0, -1.0};

    for (int corner = 0; corner < 8; corner++) {
        double at[4];

        for (int k = 0; k < 4; k++)
            at[k] = (double)object->matrix[12 + k];
        for (int axis = 0; axis < 3; axis++)
            for (int k = 0; k < 4; k++)
                at[k] += (double)object->matrix[4 * axis + k] *
                         (double)(corner >> axis & 1 ? mesh->box_max[axis] : mesh->box_min[axis]);
        if (!(at[3] > 0.0))
            return 1.0; /* around the eye */
        for (int axis = 0; axis < 2; axis++) {
            low[axis] = fmin(low[axis], fmax(at[axis] / at[3], -1.0));
            high[axis] = fmax(high[axis], fmin(at[axis] / at[3], 1.0));
        }
    }
    return (fmax(high[0] - low[0], 0.0) * plan->target.width + fmax(high[1] - low[1], 0.0) * plan->target.height) /
           2.0 / ((double)plan->target.width + plan->target.height);
}

int gn_plan_measure(const gn_plan *plan, uint32_t light, uint32_t samples, gn_load *load, gn_facts *facts)
{
    const gn_plan_light *l = &plan->lights[light];
    double sides = 0.0, caps = 0.0, border = 0.0;
    sampler of_sides = {0}, of_caps = {0};

    if (plan->mask_age > 0)
        return 0;
    memset(load, 0, sizeof *load);
    memset(facts, 0, sizeof *facts);
    if (l->skip != GN_SKIP_NOT)
        return 1;
    load->pixels = (double)l->scissor[2] * l->scissor[3];
    for (uint32_t i = 0; i < plan->record_count; i++) {
        const gn_record *r = &plan->records[i];

        if (r->light != light)
            continue;
        sides += r->side_count / (3 * triangles_of_a_side(r));
        caps += (r->light_cap_count + r->dark_cap_count + r->near_cap_count + r->turned_cap_count) / 3;
        load->indices +=
            r->light_cap_count + r->side_count + r->dark_cap_count + r->near_cap_count + r->turned_cap_count;
    }
    samples = samples ? samples : SAMPLES;
    of_sides.step = fmax(1.0, 2.0 * sides / samples);
    of_caps.step = fmax(1.0, 2.0 * caps / samples);
    of_sides.next = floor(of_sides.step / 2.0);
    of_caps.next = floor(of_caps.step / 2.0);
    for (uint32_t i = 0; i < plan->record_count; i++) {
        const gn_record *r = &plan->records[i];

        if (r->light != light)
            continue;
        sample(&of_sides, plan, r, r->first_side, r->side_count, triangles_of_a_side(r));
        sample(&of_caps, plan, r, r->first_index, r->light_cap_count, 1);
        sample(&of_caps, plan, r, r->first_dark_cap, r->dark_cap_count + r->near_cap_count, 1);
        sample(&of_caps, plan, r, r->first_turned_cap, r->turned_cap_count, 1);
    }
    load->fragments = of_sides.sum.area + of_caps.sum.area;
    load->borders = of_sides.sum.border + of_caps.sum.border;
    for (uint32_t i = 0; i < plan->object_count; i++)
        if (plan->casters[(size_t)light * plan->object_count + i].skip == GN_SKIP_NOT) {
            facts->faces += gn_mesh_get_info(plan->objects[i].mesh)->triangle_count;
            border += border_of(plan, &plan->objects[i]);
        }
    facts->edges = sides;
    facts->layers = load->pixels > 0.0 ? load->fragments / (2.0 * load->pixels) : 0.0;
    facts->nearness = fmin(border, 1.0);
    return 1;
}
