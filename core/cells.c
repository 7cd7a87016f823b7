/* cells.c - how many casting triangles may lie behind each other, as the light sees them: a bound for each cell of
 * light space.
 *
 * A point's count is the number of casting triangles that block its line to the light, and that is a matter of the
 * direction as seen from the light, but for how far the line goes. In a cell of directions the number changes only
 * where the silhouette runs through: it is nowhere more than at the cell's centre and the weights of the silhouette
 * edges that touch the cell together (DESIGN.md, decision 10); nor more than the triangles that touch the cell, which
 * is less where they are few and lie apart. Triangles count at a centre when they touch it, rounding and all: too many
 * is safe.
 *
 * Light space is one plane before the light where all casters are seen within a cone of it, or are lit along one
 * direction; else the six faces of a cube around it. Points are homogeneous there: cell coordinates times w, and w. */
#include "gni_plan.h"

#include <math.h>
#include <string.h>

#define NARROW 0.2   /* cosine of half the widest cone that one plane takes */
#define TINY   1e-12 /* of the size: what is nearer to the light's own plane has no place in a cell */
#define TOUCH  1e-3  /* of a cell: an edge so near touches */

/* A face looks along z; its cells span low to high of x / z and y / z, or of x and y where the light is directional. */
static void add_face(gni_cells *cells, const double axes[3][3], const double light[4], const double low[2],
                     const double high[2])
{
    double(*rows)[4] = cells->rows[cells->face_count++];
    double frame[3][4];

    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++)
            frame[i][k] = i == 2 && light[3] == 0.0 ? 0.0 : axes[i][k];
        frame[i][3] = light[3] == 0.0 ? (i == 2 ? 1.0 : 0.0) : -gni_dot(axes[i], light);
    }
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 4; k++)
            rows[i][k] = (frame[i][k] - low[i] * frame[2][k]) * (cells->side / (high[i] - low[i]));
    memcpy(rows[2], frame[2], sizeof frame[2]);
}

/* One plane for the boxes of all casters. 0 when they are seen under too wide an angle. */
static int fit_plane(gni_cells *cells, const gni_hull *boxes, const uint8_t *is_in, uint32_t count,
                     const double light[4])
{
    double axis[3] = {light[0], light[1], light[2]}, axes[3][3], low[2] = {INFINITY, INFINITY},
           high[2] = {-INFINITY, -INFINITY};

    if (light[3] != 0.0)
        memset(axis, 0, sizeof axis);
    for (uint32_t pass = light[3] != 0.0 ? 0 : 1; pass < 2; pass++) {
        if (pass == 1 && !(gni_dot(axis, axis) > 0.0))
            return 0;
        if (pass == 1)
            gni_make_axes(axes, axis);
        for (uint32_t b = 0; b < count; b++)
            for (int i = 0; i < 8 && is_in[b] & GNI_IN_CAST; i++) {
                double d[3], length, at[3];

                for (int k = 0; k < 3; k++)
                    d[k] = boxes[b].points[i][k] - light[k] * light[3];
                length = sqrt(gni_dot(d, d));
                if (pass == 0) {
                    for (int k = 0; k < 3; k++)
                        axis[k] += length > 0.0 ? d[k] / length : 0.0;
                    continue;
                }
                for (int k = 0; k < 3; k++)
                    at[k] = gni_dot(axes[k], d);
                if (light[3] == 0.0)
                    at[2] = 1.0;
                else if (!(at[2] > NARROW * length))
                    return 0;
                for (int k = 0; k < 2; k++) {
                    low[k] = fmin(low[k], at[k] / at[2]);
                    high[k] = fmax(high[k], at[k] / at[2]);
                }
            }
    }
    for (int k = 0; k < 2; k++) { /* a little more than nothing, also where all lies in a line */
        const double margin = 1e-3 * (high[k] - low[k]) + 1e-6 * (fabs(high[k]) + fabs(low[k])) + 1e-30;

        low[k] -= margin;
        high[k] += margin;
    }
    cells->side = GNI_PLANE_SIDE;
    add_face(cells, (const double(*)[3])axes, light, low, high);
    return 1;
}

void gni_fit_cells(gni_cells *cells, const gni_hull *boxes, const uint8_t *is_in, uint32_t count, const double light[4])
{
    static const double low[2] = {-1, -1}, high[2] = {1, 1};

    memset(cells, 0, sizeof *cells);
    if (fit_plane(cells, boxes, is_in, count, light))
        return;
    cells->side = GNI_CUBE_SIDE;
    for (int face = 0; face < 6; face++) {
        double axes[3][3] = {{0}};

        axes[2][face / 2] = face % 2 ? -1.0 : 1.0;
        axes[0][(face / 2 + 1) % 3] = axes[1][(face / 2 + 2) % 3] = 1.0;
        add_face(cells, (const double(*)[3])axes, light, low, high);
    }
}

void gni_zoom_cells(gni_cells *out, const gni_cells *from, int cell)
{
    const int area = from->side * from->side, place[2] = {cell % area % from->side, cell % area / from->side};

    memset(out, 0, sizeof *out);
    out->face_count = 1;
    out->side = GNI_ZOOM_SIDE;
    memcpy(out->rows[0], from->rows[cell / area], sizeof out->rows[0]);
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 4; k++)
            out->rows[0][i][k] = (out->rows[0][i][k] - place[i] * out->rows[0][2][k]) * out->side;
}

/* A polygon in cell coordinates, what lies at w > 0 of it. */
typedef struct outline {
    double at[5][2];
    int count, everywhere; /* everywhere: it passes so close to the light that it may be seen in every direction */
} outline;

static void project(outline *out, const gni_cells *cells, int face, double points[][3], int count)
{
    double h[4][3], size = 0.0, least;

    memset(out, 0, sizeof *out);
    for (int i = 0; i < count; i++)
        for (int r = 0; r < 3; r++) {
            const double *row = cells->rows[face][r];

            h[i][r] = gni_dot(row, points[i]) + row[3];
            if (r == 2)
                for (int k = 0; k < 3; k++)
                    size = fmax(size, fabs(row[k] * points[i][k]) + fabs(row[3]));
        }
    least = TINY * size;
    out->everywhere = 1;
    for (int i = 0; i < count; i++)
        out->everywhere &= fabs(h[i][2]) <= least;
    for (int i = 0; i < count; i++) {
        const double *a = h[i], *b = h[(i + 1) % count];

        if (a[2] > least) {
            out->at[out->count][0] = a[0] / a[2];
            out->at[out->count++][1] = a[1] / a[2];
        }
        if ((a[2] > least) != (b[2] > least) && (count > 2 || i == 0)) {
            const double t = (a[2] - least) / (a[2] - b[2]), w = least > 0.0 ? least : 1e-300;

            out->at[out->count][0] = (a[0] + t * (b[0] - a[0])) / w;
            out->at[out->count++][1] = (a[1] + t * (b[1] - a[1])) / w;
        }
    }
}

/* How far a point lies inside the convex outline; negative outside. By the greatest step on either axis, in cells: half
 * a cell outside, an edge touches the cell around the point. */
static double depth_in(const outline *o, double sign, const double centre[2])
{
    double least = INFINITY;

    for (int i = 0; i < o->count; i++) {
        const double *a = o->at[i], *b = o->at[(i + 1) % o->count];
        const double dx = b[0] - a[0], dy = b[1] - a[1], size = fabs(dx) + fabs(dy);

        if (size > 0.0)
            least = fmin(least, sign * (dx * (centre[1] - a[1]) - dy * (centre[0] - a[0])) / size);
    }
    return least;
}

static void raise(uint16_t *cell, uint32_t amount)
{
    *cell = (uint16_t)(*cell + amount < UINT16_MAX ? *cell + amount : UINT16_MAX);
}

/* To cells that it touches, and to those whose centre it holds; either grid may be NULL. */
static void add_outline(const gni_cells *cells, int face, const outline *o, uint32_t amount, gni_grid *touched,
                        gni_grid *centred)
{
    const int first = face * cells->side * cells->side;
    double area = 0.0, low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY}, centre[2];
    int from[2], to[2];

    for (int i = 0; i < o->count; i++) {
        const double *a = o->at[i], *b = o->at[(i + 1) % o->count];

        area += (a[0] - o->at[0][0]) * (b[1] - o->at[0][1]) - (a[1] - o->at[0][1]) * (b[0] - o->at[0][0]);
        for (int k = 0; k < 2; k++) {
            low[k] = fmin(low[k], a[k]);
            high[k] = fmax(high[k], a[k]);
        }
    }
    if (o->count == 0 && !o->everywhere)
        return;
    for (int k = 0; k < 2; k++) {
        from[k] = o->everywhere ? 0 : (int)fmin(fmax(floor(low[k] - TOUCH), 0.0), cells->side);
        to[k] = o->everywhere ? cells->side : (int)fmin(fmax(floor(high[k] + TOUCH) + 1.0, 0.0), cells->side);
    }
    for (int y = from[1]; y < to[1]; y++)
        for (int x = from[0]; x < to[0]; x++) {
            double depth;

            centre[0] = x + 0.5;
            centre[1] = y + 0.5;
            depth = o->everywhere ? 0.0 : depth_in(o, area < 0.0 ? -1.0 : 1.0, centre);
            if (touched && depth >= -0.5 - TOUCH)
                raise(&touched->layers[first + y * cells->side + x], amount);
            if (centred && depth >= -TOUCH)
                raise(&centred->layers[first + y * cells->side + x], amount);
        }
}

void gni_cells_add_box(const gni_cells *cells, gni_grid *grid, const gni_hull *box, uint32_t amount)
{
    static const uint8_t quads[6][4] = {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                        {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}};

    for (int face = 0; face < cells->face_count; face++) {
        outline all = {{{INFINITY, INFINITY}, {0, 0}, {-INFINITY, -INFINITY}, {0, 0}, {0, 0}}, 4, 0};
        int any = 0;

        for (int q = 0; q < 6; q++) {
            double corners[4][3];
            outline o;

            for (int i = 0; i < 4; i++)
                memcpy(corners[i], box->points[quads[q][i]], sizeof corners[i]);
            project(&o, cells, face, corners, 4);
            any |= o.count > 0 || o.everywhere;
            all.everywhere |= o.everywhere;
            for (int i = 0; i < o.count; i++)
                for (int k = 0; k < 2; k++) {
                    all.at[0][k] = fmin(all.at[0][k], o.at[i][k]);
                    all.at[2][k] = fmax(all.at[2][k], o.at[i][k]);
                }
        }
        if (!any)
            continue;
        for (int k = 0; k < 2; k++) { /* within what can be counted, and a rectangle */
            all.at[0][k] = fmax(all.at[0][k], -1.0);
            all.at[2][k] = fmin(all.at[2][k], cells->side + 1.0);
        }
        all.at[1][0] = all.at[2][0];
        all.at[1][1] = all.at[0][1];
        all.at[3][0] = all.at[0][0];
        all.at[3][1] = all.at[2][1];
        if (all.everywhere || (all.at[0][0] <= all.at[2][0] && all.at[0][1] <= all.at[2][1]))
            add_outline(cells, face, &all, amount, grid, NULL);
    }
}

static void add_polygon(const gni_cells *cells, double points[][3], int count, uint32_t amount, gni_grid *touched,
                        gni_grid *centred)
{
    for (int face = 0; face < cells->face_count; face++) {
        outline o;

        project(&o, cells, face, points, count);
        add_outline(cells, face, &o, amount, touched, centred);
    }
}

/* The weights of the silhouette edges that a triangle is the first to use, to the cells that they touch. */
static void add_silhouette(const gni_cells *cells, gni_grid *grid, const gn_mesh *mesh, const int8_t *casting,
                           uint32_t triangle, double v[3][3])
{
    for (uint32_t k = 0; k < 3; k++) {
        const uint32_t corner = 3 * triangle + k, edge = mesh->edge_of[corner];
        int32_t weight;
        double ends[2][3];

        if (gni_first_caster(mesh, edge, casting) != corner)
            continue;
        weight = gni_edge_weight(mesh, edge, casting);
        if (weight == 0)
            continue;
        memcpy(ends[0], v[k], sizeof ends[0]);
        memcpy(ends[1], v[(k + 1) % 3], sizeof ends[1]);
        add_polygon(cells, ends, 2, (uint32_t)(weight < 0 ? -weight : weight), grid, NULL);
    }
}

uint32_t gni_measure_triangles(const gni_cells *cells, gni_grid *grid, gni_grid *touches, const gn_mesh *mesh,
                               const double model_view[16], const int8_t *casting, const uint32_t *list, uint32_t count)
{
    const int size = cells->face_count * cells->side * cells->side;
    uint32_t most = 0;

    memset(grid, 0, sizeof *grid);
    memset(touches, 0, sizeof *touches);
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t *c = mesh->triangles + 3 * (size_t)list[i];
        double v[3][3];

        for (int k = 0; k < 3; k++)
            gni_vertex(v[k], mesh, c[k], model_view);
        add_polygon(cells, v, 3, 1, touches, grid);
        add_silhouette(cells, grid, mesh, casting, list[i], v);
    }
    for (int i = 0; i < size; i++) {
        grid->layers[i] = grid->layers[i] < touches->layers[i] ? grid->layers[i] : touches->layers[i];
        most = grid->layers[i] > most ? grid->layers[i] : most;
    }
    return most;
}

uint32_t gni_most_layers(const gni_cells *cells, const gni_grid *a, const gni_grid *b)
{
    const int count = cells->face_count * cells->side * cells->side;
    uint32_t most = 0;

    for (int i = 0; i < count; i++) {
        const uint32_t sum = (uint32_t)a->layers[i] + (b ? b->layers[i] : 0u);

        most = sum > most ? sum : most;
    }
    return most;
}

void gni_add_grid(const gni_cells *cells, gni_grid *to, const gni_grid *grid)
{
    const int count = cells->face_count * cells->side * cells->side;

    for (int i = 0; i < count; i++)
        raise(&to->layers[i], grid->layers[i]);
}
