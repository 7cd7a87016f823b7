/* fragments.c - a bound on the fragments of one side that a volume puts at a pixel, for counts in colour: they stop at
 * the ends of a channel, however many cancel later.
 *
 * What of a closed surface shows its front to the eye covers a pixel as often as its border winds around it; and a line
 * across the image that passes the pixel crosses that border once more than it covers it before, and once after. So
 * nowhere are there more fragments than half of what one column of the image crosses of the border; for backs the same
 * (sweep.c has this for layers and the light). Columns run in several directions, and the least bound holds. The border of the volume's fronts is where they meet backs: edges of
 * caps, of sides, and the seams between sides; and, where the near plane cuts the volume, the cut.
 *
 * A volume is never more than the volumes of its casting triangles one by one, each convex: no more than these. */
#include "gni_plan.h"

#include <math.h>
#include <string.h>

#define COLUMNS GNI_COLUMNS
#define WAYS    GNI_COLUMN_WAYS
#define LOOSE   0.01 /* of a column: rounding stays inside */

enum { BACKS, FRONTS, SIDES };

/* Where the edges of each side's border are: differences between columns. */
typedef struct border {
    int is_orthographic, is_cut; /* is_cut: something of the volume lies behind the near plane */
    double znear, across[WAYS][2], low[WAYS], scale[WAYS];
    int32_t (*differences)[SIDES][COLUMNS + 1]; /* [WAYS] */
} border;

/* A volume as the eye sees it. */
typedef struct sight {
    const gn_mesh *mesh;
    double near_matrix[16], far_matrix[16]; /* to view space, homogeneous */
    int converges;
    unsigned parts;
} sight;

/* How far before the near plane, times w. */
static double before_near(const border *b, const double p[4])
{
    return -p[2] - b->znear * p[3];
}

/* Columns of each way across the image. */
static void fit_columns(border *b, const gn_camera *camera)
{
    static const double ways[WAYS][2] = {{1, 0}, {0, 1}, {1, 1}, {1, -1}};

    for (int way = 0; way < WAYS; way++) {
        const double *a = ways[way];
        const double ends[2] = {fmin(a[1] * camera->bottom, a[1] * camera->top),
                                fmax(a[1] * camera->bottom, a[1] * camera->top)};

        memcpy(b->across[way], a, sizeof b->across[way]);
        b->low[way] = a[0] * camera->left + ends[0];
        b->scale[way] = COLUMNS / (a[0] * (camera->right - camera->left) + ends[1] - ends[0]);
    }
}

/* A point on the image, as the camera's edges are given. */
static void project(const border *b, const double p[4], double out[2])
{
    for (int i = 0; i < 2; i++)
        out[i] = p[i] / (b->is_orthographic ? p[3] : -p[2]);
}

static void cut_between(const border *b, const double from[4], const double to[4], double out[4])
{
    const double t = before_near(b, from) / (before_near(b, from) - before_near(b, to));

    for (int i = 0; i < 4; i++)
        out[i] = from[i] + t * (to[i] - from[i]);
}

static void add_columns(border *b, int side, const double from[2], const double to[2], int32_t weight)
{
    for (int way = 0; way < WAYS; way++) {
        const double *a = b->across[way];
        const double x = (a[0] * from[0] + a[1] * from[1] - b->low[way]) * b->scale[way];
        const double y = (a[0] * to[0] + a[1] * to[1] - b->low[way]) * b->scale[way];
        const double first = fmin(x, y) - LOOSE, last = fmax(x, y) + LOOSE;

        if (!(last >= 0.0 && first < COLUMNS)) /* out of view, or no number */
            continue;
        b->differences[way][side][(int)fmax(first, 0.0)] += weight;
        b->differences[way][side][(int)fmin(last, COLUMNS - 1.0) + 1] -= weight;
    }
}

static void add_edge(border *b, int side, const double from[4], const double to[4], int32_t weight)
{
    double start[4], end[4], ends[2][2];

    if (weight == 0 || (before_near(b, from) <= 0.0 && before_near(b, to) <= 0.0))
        return;
    memcpy(start, from, sizeof start);
    memcpy(end, to, sizeof end);
    if (before_near(b, from) <= 0.0)
        cut_between(b, to, from, start);
    if (before_near(b, to) <= 0.0)
        cut_between(b, from, to, end);
    project(b, start, ends[0]);
    project(b, end, ends[1]);
    add_columns(b, side, ends[0], ends[1], weight < 0 ? -weight : weight);
}

/* Where the near plane cuts a convex polygon. */
static void add_cut(border *b, int side, const double polygon[][4], int count, int32_t weight)
{
    double ends[2][2] = {{0, 0}, {0, 0}};
    int found = 0;

    for (int i = 0; i < count; i++) {
        const double *from = polygon[i], *to = polygon[(i + 1) % count];
        double at[4];

        if ((before_near(b, from) > 0.0) == (before_near(b, to) > 0.0))
            continue;
        cut_between(b, from, to, at);
        project(b, at, ends[found++ & 1]);
    }
    if (found == 2)
        add_columns(b, side, ends[0], ends[1], weight < 0 ? -weight : weight);
}

static void place(double out[4], const gn_mesh *mesh, uint32_t vertex, const double m[16])
{
    const float *p = mesh->positions + 3 * (size_t)vertex;

    for (int i = 0; i < 4; i++)
        out[i] = m[i] * (double)p[0] + m[4 + i] * (double)p[1] + m[8 + i] * (double)p[2] + m[12 + i];
    for (int i = 0; i < 4 && out[3] < 0.0; i++)
        out[i] = -out[i];
}

/* Positive where the eye sees the triangle counter-clockwise, whatever w is. */
static double turn_of(const border *b, const double p[4], const double q[4], const double r[4])
{
    if (b->is_orthographic)
        return (q[0] / q[3] - p[0] / p[3]) * (r[1] / r[3] - p[1] / p[3]) -
               (q[1] / q[3] - p[1] / p[3]) * (r[0] / r[3] - p[0] / p[3]);
    return -(p[0] * (q[1] * r[2] - q[2] * r[1]) + p[1] * (q[2] * r[0] - q[0] * r[2]) +
             p[2] * (q[0] * r[1] - q[1] * r[0]));
}

static void note_near(border *b, const double p[4])
{
    b->is_cut |= before_near(b, p) <= 0.0;
}

/* Which side of each casting triangle is seen, in the caps: 1 its front as it is turned, -1; 0 of those that do not
 * cast. Returns how many cast. */
static uint32_t look_at_caps(border *b, const sight *s, const gni_casting *casting, int8_t *const seen[2])
{
    const gn_mesh *mesh = s->mesh;
    uint32_t count = 0;

    for (uint32_t t = 0; t < mesh->info.triangle_count; t++) {
        const double *const matrices[2] = {s->near_matrix, s->far_matrix};

        seen[0][t] = seen[1][t] = 0;
        count += casting->of[t] != 0;
        for (int end = 0; end < 2 && casting->of[t]; end++) {
            double p[3][4], turn;

            for (int k = 0; k < 3; k++) {
                place(p[k], mesh, mesh->triangles[3 * (size_t)t + (size_t)k], matrices[end]);
                note_near(b, p[k]);
            }
            turn = turn_of(b, p[0], p[1], p[2]) * casting->of[t] * (end ? -1.0 : 1.0);
            seen[end][t] = turn > 0.0 ? 1 : -1;
        }
    }
    return count;
}

/* Adds what the near plane cuts of the caps. */
static void cut_caps(border *b, const sight *s, const gni_casting *casting, int8_t *const seen[2])
{
    static const unsigned caps[2] = {GN_LIGHT_CAP, GN_DARK_CAP};
    const double *const matrices[2] = {s->near_matrix, s->far_matrix};

    for (uint32_t t = 0; t < s->mesh->info.triangle_count; t++)
        for (int end = 0; end < 2 && casting->of[t]; end++) {
            double p[3][4];

            for (int k = 0; k < 3; k++)
                place(p[k], s->mesh, s->mesh->triangles[3 * (size_t)t + (size_t)k], matrices[end]);
            if (s->parts & caps[end] && !(end && s->converges))
                add_cut(b, seen[end][t] > 0 ? FRONTS : BACKS, (const double(*)[4])p, 3, 1);
        }
}

/* How often the seen caps run along an edge, fronts and backs apart. */
static void weigh(const gn_mesh *mesh, uint32_t edge, const int8_t *casting, const int8_t *seen, int32_t of[SIDES])
{
    of[FRONTS] = of[BACKS] = 0;
    for (uint32_t u = mesh->edge_uses[edge]; u < mesh->edge_uses[edge + 1]; u++) {
        const uint32_t t = (mesh->uses[u] & GNI_USE_CORNER) / 3;

        if (casting[t])
            of[seen[t] > 0 ? FRONTS : BACKS] += mesh->uses[u] & GNI_USE_DOWN ? -casting[t] : casting[t];
    }
}

/* The side over an edge along which the casting triangles run `weight` times from low to high. */
static int look_at_side(border *b, const double low[2][4], const double high[2][4], int32_t weight)
{
    const double turn = turn_of(b, high[0], low[0], low[1]) * (weight < 0 ? -1.0 : 1.0);
    const double polygon[4][4] = {{low[0][0], low[0][1], low[0][2], low[0][3]},
                                  {high[0][0], high[0][1], high[0][2], high[0][3]},
                                  {high[1][0], high[1][1], high[1][2], high[1][3]},
                                  {low[1][0], low[1][1], low[1][2], low[1][3]}};
    const int side = turn > 0.0 ? FRONTS : BACKS;

    if (b->is_cut)
        add_cut(b, side, polygon, 4, weight);
    return side;
}

/* Edges: near, where a cap meets a side, and far. Seams are gathered by vertex. */
static void add_edges(border *b, const sight *s, const gni_casting *casting, int8_t *const seen[2],
                      int32_t *seams[SIDES])
{
    const gn_mesh *mesh = s->mesh;

    for (uint32_t e = 0; e < mesh->info.edge_count; e++) {
        const uint32_t corner = mesh->uses[mesh->edge_uses[e]] & GNI_USE_CORNER;
        uint32_t v[2] = {mesh->triangles[corner], mesh->triangles[gni_next_corner(corner)]};
        int32_t caps[2][SIDES], weight;
        double low[2][4], high[2][4];
        int side = FRONTS;

        weigh(mesh, e, casting->of, seen[0], caps[0]);
        weigh(mesh, e, casting->of, seen[1], caps[1]);
        weight = caps[0][FRONTS] + caps[0][BACKS];
        if (caps[0][FRONTS] == 0 && caps[0][BACKS] == 0 && caps[1][FRONTS] == 0 && caps[1][BACKS] == 0)
            continue;
        if (v[0] > v[1]) {
            const uint32_t other = v[0];

            v[0] = v[1];
            v[1] = other;
        }
        place(low[0], mesh, v[0], s->near_matrix);
        place(low[1], mesh, v[0], s->far_matrix);
        place(high[0], mesh, v[1], s->near_matrix);
        place(high[1], mesh, v[1], s->far_matrix);
        if (weight && s->parts & GN_SIDES) {
            side = look_at_side(b, (const double(*)[4])low, (const double(*)[4])high, weight);
            seams[side][v[0]] += weight;
            seams[side][v[1]] -= weight;
        }
        for (int k = 0; k < SIDES; k++) {
            const int32_t of_side = s->parts & GN_SIDES && k == side ? weight : 0;

            add_edge(b, k, low[0], high[0], (s->parts & GN_LIGHT_CAP ? caps[0][k] : 0) - of_side);
            if (!s->converges)
                add_edge(b, k, low[1], high[1], of_side - (s->parts & GN_DARK_CAP ? caps[1][k] : 0));
        }
    }
}

/* Of each side the least bound of all ways, and of both sides the greater. */
static uint32_t half_of_most(const border *b)
{
    int32_t greater = 0;

    for (int side = 0; side < SIDES; side++) {
        int32_t least = INT32_MAX;

        for (int way = 0; way < WAYS; way++) {
            int32_t crossed = 0, most = 0;

            for (int i = 0; i < COLUMNS; i++) {
                crossed += b->differences[way][side][i];
                most = crossed > most ? crossed : most;
            }
            least = most < least ? most : least;
        }
        greater = least > greater ? least : greater;
    }
    return (uint32_t)greater / 2;
}

uint32_t gni_most_fragments(gni_draft *d, const gni_volume *v, const gni_casting *casting)
{
    const gn_camera *camera = &d->scene->camera;
    const gn_object *object = &d->scene->objects[v->object];
    border b;
    sight s;
    double extrusion[16];
    uint32_t most, count;
    int mcguire_case;

    memset(&b, 0, sizeof b);
    b.is_orthographic = camera->orthographic;
    b.znear = camera->znear;
    b.differences = d->columns;
    memset(d->columns, 0, WAYS * sizeof *d->columns);
    fit_columns(&b, camera);
    s.mesh = object->mesh;
    s.converges = v->far_end != GN_FAR_ENDED && d->bounds.light[3] == 0.0;
    s.parts = gni_choose_parts(d, v, &mcguire_case);
    gni_model_view(s.near_matrix, camera, object->model, object->mesh->info.centre);
    if (v->end_reach > 0.0)
        gni_extrusion_by(extrusion, d->bounds.light, v->end_reach);
    else
        gni_extrusion(extrusion, d->bounds.light, v->end_plane);
    gn_mat4_multiply(s.far_matrix, extrusion, s.near_matrix);
    count = look_at_caps(&b, &s, casting, d->seen_caps);
    if (b.is_cut)
        cut_caps(&b, &s, casting, d->seen_caps);
    for (int side = 0; side < SIDES; side++)
        memset(d->seams[side], 0, object->mesh->info.vertex_count * sizeof *d->seams[side]);
    add_edges(&b, &s, casting, d->seen_caps, d->seams);
    for (uint32_t i = 0; i < object->mesh->info.vertex_count; i++)
        if (d->seams[FRONTS][i] || d->seams[BACKS][i]) {
            double from[4], to[4];

            place(from, s.mesh, i, s.near_matrix);
            place(to, s.mesh, i, s.far_matrix);
            for (int side = 0; side < SIDES; side++)
                add_edge(&b, side, from, to, d->seams[side][i]);
        }
    most = half_of_most(&b);
    return most < count ? most : count;
}
