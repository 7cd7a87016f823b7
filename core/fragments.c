/* fragments.c - a bound on the fragments of one side that a volume puts at a pixel, for counts in colour: they stop at
 * the ends of a channel, however many cancel later.
 *
 * Sides. A line of sight lies in one plane of the pencil through eye and light, and such a plane meets a side in a ray
 * from the light, which the line crosses at most once: so it crosses no more fronts than there are silhouette edges that
 * run round the axis one way past its plane, and no more backs than run the other way.
 *
 * Caps. What of a cap shows its front to the eye covers a pixel as often as its border winds around it; and a line across
 * the image that passes the pixel crosses that border once more than it covers it before, and once after. So nowhere are
 * there more than half of what one column of the image crosses of the border (sweep.c has this for layers and the light).
 * Columns run in several directions, and the least bound holds. Where the near plane cuts a cap, the cut is border too.
 *
 * A volume is never more than the volumes of its casting triangles one by one, each convex: no more than these. */
#include "gni_plan.h"

#include <math.h>
#include <string.h>

#define COLUMNS GNI_COLUMNS
#define WAYS    GNI_COLUMN_WAYS
#define SECTORS GNI_SECTORS
#define LOOSE   0.01 /* of a column: rounding stays inside */
#define PI      3.141592653589793

enum { BACKS, FRONTS, SIDES };

/* A volume as the eye sees it. */
typedef struct sight {
    const gn_mesh *mesh;
    int is_orthographic;
    double near_matrix[16], far_matrix[16]; /* to view space, homogeneous */
    int converges;
    unsigned parts;
} sight;

static void place(double out[4], const gn_mesh *mesh, uint32_t vertex, const double m[16])
{
    const float *p = mesh->positions + 3 * (size_t)vertex;

    for (int i = 0; i < 4; i++)
        out[i] = m[i] * (double)p[0] + m[4 + i] * (double)p[1] + m[8 + i] * (double)p[2] + m[12 + i];
    for (int i = 0; i < 4 && out[3] < 0.0; i++)
        out[i] = -out[i];
}

/* ---- Sides ---- */

/* Planes through eye and light, by an angle about the axis; or, where all are parallel, by how far they are along. */
typedef struct pencil {
    double across[2][4];          /* two planes of it, at right angles; the second is not read where all are parallel */
    int are_parallel, goes_round; /* goes_round: the axis may pass through the caster */
    double middle, low, scale;
    int32_t (*differences)[SECTORS + 1]; /* [SIDES] by which way edges run */
    int32_t **ends;                      /* [SIDES][vertex_count] edges that end there less those that start */
} pencil;

/* From -pi to pi. */
static double wrapped(double angle)
{
    return angle > PI ? angle - 2.0 * PI : angle <= -PI ? angle + 2.0 * PI : angle;
}

static double place_in_pencil(const pencil *p, const double v[4])
{
    double at[2];

    for (int i = 0; i < 2; i++)
        at[i] = gni_dot(p->across[i], v) + p->across[i][3] * v[3];
    return p->are_parallel ? at[0] : wrapped(atan2(at[1], at[0]) - p->middle);
}

/* 0 where eye and light are as good as one: then no plane is told from another. */
static int fit_pencil(pencil *p, const gni_draft *d, uint32_t object)
{
    const double *light = d->bounds.light;
    double axes[3][3], low = INFINITY, high = -INFINITY, centre[4] = {0, 0, 0, 1};

    memset(p->across, 0, sizeof p->across);
    p->are_parallel = p->goes_round = 0;
    p->middle = 0.0;
    if (!d->scene->camera.orthographic) {
        if (!(gni_dot(light, light) > 0.0))
            return 0;
        gni_make_axes(axes, light);
        memcpy(p->across[0], axes[0], sizeof axes[0]);
        memcpy(p->across[1], axes[1], sizeof axes[1]);
    } else if (light[3] != 0.0) {
        p->across[0][0] = p->across[1][1] = light[3];
        p->across[0][3] = -light[0];
        p->across[1][3] = -light[1];
    } else {
        p->are_parallel = 1;
        p->across[0][0] = -light[1];
        p->across[0][1] = light[0];
        if (!(gni_dot(p->across[0], p->across[0]) > 0.0))
            return 0;
    }
    for (int corner = 0; corner < 8; corner++)
        for (int i = 0; i < 3; i++)
            centre[i] += d->boxes[object].points[corner][i] / 8.0;
    p->middle = p->are_parallel ? 0.0 : place_in_pencil(p, centre);
    for (int corner = 0; corner < 8; corner++) {
        const double *point = d->boxes[object].points[corner], v[4] = {point[0], point[1], point[2], 1.0};

        low = fmin(low, place_in_pencil(p, v));
        high = fmax(high, place_in_pencil(p, v));
    }
    p->goes_round = !p->are_parallel && !(high - low < PI);
    p->low = p->goes_round ? -PI : low;
    p->scale = p->goes_round ? SECTORS / (2.0 * PI) : high > low ? SECTORS / (high - low) : 0.0;
    return 1;
}

static int sector_of(const pencil *p, double at)
{
    return (int)fmin(fmax((at - p->low) * p->scale, 0.0), SECTORS - 1.0);
}

/* An edge fills the sectors from its start on, but not that of its end: there the next one starts, mostly. */
static void add_side(pencil *p, const double from[4], const double to[4], uint32_t first, uint32_t second,
                     int32_t weight)
{
    const double a = place_in_pencil(p, from), b = place_in_pencil(p, to);
    const double turn = p->are_parallel ? b - a : wrapped(b - a);
    const int way = turn > 0.0, start = sector_of(p, way ? a : b), end = sector_of(p, way ? b : a);

    if (turn == 0.0)
        return;
    p->differences[way][start] += weight;
    p->differences[way][end] -= weight;
    if (p->goes_round && end < start) /* past the seam of the circle */
        p->differences[way][0] += weight;
    p->ends[way][way ? second : first] += weight;
    p->ends[way][way ? first : second] -= weight;
}

/* Whichever way a silhouette edge's side is turned: edges that run round one way are fronts, those of the other backs. */
static void look_at_sides(pencil *p, const sight *s, const gni_casting *casting)
{
    const gn_mesh *mesh = s->mesh;

    for (uint32_t e = 0; e < mesh->info.edge_count; e++) {
        const int32_t weight = gni_edge_weight(mesh, e, casting->of);
        uint32_t corner, v[2];
        double ends[2][4];

        if (weight == 0)
            continue;
        corner = mesh->uses[mesh->edge_uses[e]] & GNI_USE_CORNER;
        v[0] = mesh->triangles[corner];
        v[1] = mesh->triangles[gni_next_corner(corner)];
        if ((v[0] > v[1]) == (weight > 0)) {
            const uint32_t other = v[0];

            v[0] = v[1];
            v[1] = other;
        }
        place(ends[0], mesh, v[0], s->near_matrix);
        place(ends[1], mesh, v[1], s->near_matrix);
        add_side(p, ends[0], ends[1], v[0], v[1], weight < 0 ? -weight : weight);
    }
}

/* The most edges that run one way past a plane. Where an edge ends and none starts, its last sector is its own too. */
static uint32_t count_sides(gni_draft *d, const sight *s, uint32_t object, const gni_casting *casting)
{
    const uint32_t vertices = s->mesh->info.vertex_count;
    pencil p = {.differences = d->sectors, .ends = d->seams};
    int32_t most = 0;

    if (!fit_pencil(&p, d, object))
        return GNI_NONE;
    memset(d->sectors, 0, SIDES * sizeof *d->sectors);
    for (int way = 0; way < SIDES; way++)
        memset(d->seams[way], 0, vertices * sizeof *d->seams[way]);
    look_at_sides(&p, s, casting);
    for (uint32_t i = 0; i < vertices; i++)
        for (int way = 0; way < SIDES; way++)
            if (d->seams[way][i] > 0) {
                double at[4];
                int sector;

                place(at, s->mesh, i, s->near_matrix);
                sector = sector_of(&p, place_in_pencil(&p, at));
                p.differences[way][sector] += d->seams[way][i];
                p.differences[way][sector + 1] -= d->seams[way][i];
            }
    for (int way = 0; way < SIDES; way++)
        for (int32_t i = 0, crossed = 0; i < SECTORS; i++) {
            crossed += p.differences[way][i];
            most = crossed > most ? crossed : most;
        }
    return (uint32_t)most;
}

/* ---- Caps ---- */

/* Where the edges of each side's border are: differences between columns. */
typedef struct border {
    int is_orthographic, is_cut; /* is_cut: something of the caps lies behind the near plane */
    double znear, across[WAYS][2], low[WAYS], scale[WAYS];
    int32_t (*differences)[SIDES][COLUMNS + 1]; /* [WAYS] */
} border;

/* How far before the near plane, times w. */
static double before_near(const border *b, const double p[4])
{
    return -p[2] - b->znear * p[3];
}

static void fit_columns(border *b, const gn_camera *camera)
{
    static const double ways[WAYS][2] = {{1, 0}, {0, 1}, {1, 1}, {1, -1}};

    b->is_orthographic = camera->orthographic;
    b->is_cut = 0;
    b->znear = camera->znear;
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
    out[2] = fmin(out[2], -1e-6 * fmax(fabs(out[0]), fabs(out[1]))); /* of directions: as good as at right angles */
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

/* Where the near plane cuts a triangle. */
static void add_cut(border *b, int side, const double corners[3][4])
{
    double ends[2][2] = {{0, 0}, {0, 0}};
    int found = 0;

    for (int i = 0; i < 3; i++) {
        const double *from = corners[i], *to = corners[(i + 1) % 3];
        double at[4];

        if ((before_near(b, from) > 0.0) == (before_near(b, to) > 0.0))
            continue;
        cut_between(b, from, to, at);
        project(b, at, ends[found++ & 1]);
    }
    if (found == 2)
        add_columns(b, side, ends[0], ends[1], 1);
}

/* Positive where the eye sees the triangle counter-clockwise, whatever w is. */
static double turn_of(int is_orthographic, const double p[4], const double q[4], const double r[4])
{
    if (is_orthographic)
        return (q[0] / q[3] - p[0] / p[3]) * (r[1] / r[3] - p[1] / p[3]) -
               (q[1] / q[3] - p[1] / p[3]) * (r[0] / r[3] - p[0] / p[3]);
    return -(p[0] * (q[1] * r[2] - q[2] * r[1]) + p[1] * (q[2] * r[0] - q[0] * r[2]) +
             p[2] * (q[0] * r[1] - q[1] * r[0]));
}

/* Which side of each casting triangle is seen in a cap: 1 its front as it is turned, -1. And where the near plane cuts
 * it. */
static void look_at_cap(border *b, const sight *s, const double matrix[16], int reversed, const gni_casting *casting,
                        int8_t *seen)
{
    const gn_mesh *mesh = s->mesh;

    for (uint32_t t = 0; t < mesh->info.triangle_count; t++) {
        double p[3][4], turn;
        int is_cut = 0;

        if (!casting->of[t])
            continue;
        for (int k = 0; k < 3; k++) {
            place(p[k], mesh, mesh->triangles[3 * (size_t)t + (size_t)k], matrix);
            is_cut |= before_near(b, p[k]) <= 0.0;
        }
        turn = turn_of(s->is_orthographic, p[0], p[1], p[2]) * casting->of[t] * (reversed ? -1.0 : 1.0);
        seen[t] = turn > 0.0 ? 1 : -1;
        if (is_cut)
            add_cut(b, seen[t] > 0 ? FRONTS : BACKS, (const double(*)[4])p);
    }
}

/* How often the triangles of each side run along an edge. */
static void weigh(const gn_mesh *mesh, uint32_t edge, const int8_t *casting, const int8_t *seen, int32_t of[SIDES])
{
    of[FRONTS] = of[BACKS] = 0;
    for (uint32_t u = mesh->edge_uses[edge]; u < mesh->edge_uses[edge + 1]; u++) {
        const uint32_t t = (mesh->uses[u] & GNI_USE_CORNER) / 3;

        if (casting[t])
            of[seen[t] > 0 ? FRONTS : BACKS] += mesh->uses[u] & GNI_USE_DOWN ? -casting[t] : casting[t];
    }
}

static void add_cap(border *b, const sight *s, const double matrix[16], int reversed, const gni_casting *casting,
                    int8_t *seen)
{
    const gn_mesh *mesh = s->mesh;

    look_at_cap(b, s, matrix, reversed, casting, seen);
    for (uint32_t e = 0; e < mesh->info.edge_count; e++) {
        int32_t weights[SIDES];
        uint32_t corner;
        double ends[2][4];

        weigh(mesh, e, casting->of, seen, weights);
        if (weights[FRONTS] == 0 && weights[BACKS] == 0)
            continue;
        corner = mesh->uses[mesh->edge_uses[e]] & GNI_USE_CORNER;
        place(ends[0], mesh, mesh->triangles[corner], matrix);
        place(ends[1], mesh, mesh->triangles[gni_next_corner(corner)], matrix);
        for (int side = 0; side < SIDES; side++)
            add_edge(b, side, ends[0], ends[1], weights[side]);
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

static uint32_t count_caps(gni_draft *d, const sight *s, const gni_casting *casting)
{
    border b = {.differences = d->columns};

    memset(d->columns, 0, WAYS * sizeof *d->columns);
    fit_columns(&b, &d->scene->camera);
    if (s->parts & GN_LIGHT_CAP)
        add_cap(&b, s, s->near_matrix, 0, casting, d->seen_cap);
    if (s->parts & GN_DARK_CAP && !s->converges)
        add_cap(&b, s, s->far_matrix, 1, casting, d->seen_cap);
    return half_of_most(&b);
}

static uint32_t count_casting(const gn_mesh *mesh, const gni_casting *casting)
{
    uint32_t count = 0;

    for (uint32_t t = 0; t < mesh->info.triangle_count; t++)
        count += casting->of[t] != 0;
    return count;
}

uint32_t gni_most_fragments(gni_draft *d, const gni_volume *v, const gni_casting *casting)
{
    const gn_camera *camera = &d->scene->camera;
    const gn_object *object = &d->scene->objects[v->object];
    const uint32_t triangles = count_casting(object->mesh, casting);
    sight s = {.mesh = object->mesh, .is_orthographic = camera->orthographic};
    double extrusion[16];
    uint32_t sides = 0, caps = 0;
    int mcguire_case;

    s.converges = v->far_end != GN_FAR_ENDED && d->bounds.light[3] == 0.0;
    s.parts = gni_choose_parts(d, v, &mcguire_case);
    gni_model_view(s.near_matrix, camera, object->model, object->mesh->info.centre);
    if (v->end_reach > 0.0)
        gni_extrusion_by(extrusion, d->bounds.light, v->end_reach);
    else
        gni_extrusion(extrusion, d->bounds.light, v->end_plane);
    gn_mat4_multiply(s.far_matrix, extrusion, s.near_matrix);
    if (s.parts & GN_SIDES)
        sides = count_sides(d, &s, v->object, casting);
    if (s.parts & (GN_LIGHT_CAP | GN_DARK_CAP))
        caps = count_caps(d, &s, casting);
    return sides < triangles && caps < triangles - sides ? sides + caps : triangles;
}
