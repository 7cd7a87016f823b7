/* batches.c - counts beyond the stencil's bits: volumes in batches, and casters cut into pieces.
 *
 * A count of n bits that wraps tells 2^n - 1 volumes from none; 256 around a point look like none. Whether so many can
 * lie around one is asked in steps, each dearer than the one before: how many triangles cast at all; half the number of
 * silhouette edges, since as the light sees it a line over a point with L layers crosses L of them on its way in and L
 * on its way out; the same for a line swept over light space (sweep.c); boxes in cells of light space, each with as
 * many layers as its own sweep says; triangles and silhouettes in those; and at last in parts of cells. Most scenes end
 * at the first three.
 *
 * Where they do not, one bit becomes a flag and the rest counts in batches; between two batches what is counted is
 * folded into the flag (DESIGN.md, decision 10). A caster that alone is too much is cut into chains: triangles that
 * hang together through edges where they cancel. Cut so, no new side arises. Only a chain that alone nests too much,
 * such as a helix, is cut through; a piece then also takes the triangles beyond the cut, where limit, room and the
 * chunk of 16-bit indices allow it (for one of the two beside a seam they mostly do), so that a surface that meets a
 * seam within a step of depth loses nothing. What is covered twice is shadowed all the same. */
#include "gni_plan.h"

#include <string.h>

#define ROOM_FOR_RING 16 /* triangles: of fewer the ring is as many again */
#define FEW           2  /* layers of one caster that are not looked at closer */

size_t gni_most_pieces(const gn_mesh *mesh, size_t ends, uint32_t limit)
{
    const size_t triangles = mesh->info.triangle_count;

    /* Two groups of chains in a row have more triangles than the limit together; halves of a chain that is cut have a
     * half of it at least, and a group may be closed before one. */
    return triangles <= limit ? ends : 3 * triangles / limit + 2 * ends + 1;
}

/* A caster's volume while it is cut. */
typedef struct cutter {
    gni_draft *d;
    const gni_volume *volume;
    const gn_mesh *mesh;
    const int8_t *casting;
    double model_view[16];
    uint32_t limit;
    uint32_t to_do;       /* triangles that are in no piece yet */
    uint32_t indices_end; /* of the caster's room in d->indices */
    int spare;            /* pieces more than need be */
} cutter;

/* d->piece holds the casting of these triangles, and 0 for all others. */
static void mark(const cutter *c, const uint32_t *list, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        c->d->piece.of[list[i]] = c->casting[list[i]];
}

static void unmark(const cutter *c, const uint32_t *list, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        c->d->piece.of[list[i]] = 0;
}

/* Layers of the marked triangles of list[count], into the grid of the piece at hand; of a count in colour their
 * fragments. */
static uint32_t measure(const cutter *c, const uint32_t *list, uint32_t count)
{
    gni_layers *l = c->d->layers;

    if (gni_is_colored(c->d))
        return gni_most_fragments(c->d, c->volume, &c->d->piece);
    return gni_measure_triangles(&l->cells, &l->piece, &l->scratch, c->mesh, c->model_view, c->d->piece.of, list,
                                 count);
}

/* The marked piece, which was measured last, into this batch or the next. */
static void emit(const cutter *c, uint32_t measured)
{
    gni_draft *d = c->d;
    gni_layers *l = d->layers;
    gn_plan_light *about = &d->lights[d->light];
    uint32_t most;

    gni_find_bits(c->mesh, &d->piece);
    if (gni_is_colored(d)) {
        gni_make_room(d, c->volume->extent->scissor, measured);
        gni_add_records(d, c->volume, 1, &d->piece);
        return;
    }
    if (gni_most_layers(&l->cells, &l->batch, &l->piece) > c->limit) {
        gni_end_batch(d, 1);
        memset(&l->batch, 0, sizeof l->batch);
    }
    gni_add_grid(&l->cells, &l->batch, &l->piece);
    most = gni_most_layers(&l->cells, &l->batch, NULL);
    about->layers = about->layers > most ? about->layers : most;
    gni_add_records(d, c->volume, 1, &d->piece);
}

/* Copies list[count] to ring[] and adds, marked, the neighbours beyond edges where two triangles cancel; of the same
 * chunk, so that a piece has no more records. Returns how many all are. */
static uint32_t add_ring(const cutter *c, const uint32_t *list, uint32_t count, uint32_t *ring)
{
    const gn_mesh *mesh = c->mesh;
    uint32_t total = count;

    memcpy(ring, list, count * sizeof *ring);
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t k = 0; k < 3; k++) {
            const uint32_t edge = mesh->edge_of[3 * list[i] + k], first = mesh->edge_uses[edge];

            if (mesh->edge_uses[edge + 1] - first != 2 || gni_edge_weight(mesh, edge, c->casting) != 0)
                continue;
            for (uint32_t u = first; u < first + 2; u++) {
                const uint32_t t = (mesh->uses[u] & GNI_USE_CORNER) / 3;

                if (c->d->piece.of[t] || !c->casting[t] || gni_chunk_of(mesh, t) != gni_chunk_of(mesh, list[i]))
                    continue;
                c->d->piece.of[t] = c->casting[t];
                ring[total++] = t;
            }
        }
    return total;
}

static void cut_through(cutter *c, const uint32_t *list, uint32_t count);

static void cut_in_halves(cutter *c, const uint32_t *list, uint32_t count)
{
    unmark(c, list, count);
    cut_through(c, list, count / 2);
    cut_through(c, list + count / 2, count - count / 2);
}

/* A chain that is too much by itself: halves, until each is not; with its ring where that keeps within the limit and
 * the room. Fragments are measured loosely: there a smaller piece makes room for its ring. */
static void cut_through(cutter *c, const uint32_t *list, uint32_t count)
{
    gni_draft *d = c->d;
    uint32_t total, measured;

    mark(c, list, count);
    if (measure(c, list, count) > c->limit && count > 1) {
        cut_in_halves(c, list, count);
        return;
    }
    total = add_ring(c, list, count, d->ring);
    measured = measure(c, d->ring, total);
    if (measured > c->limit && c->spare > 0 && count > ROOM_FOR_RING) {
        c->spare--;
        unmark(c, d->ring + count, total - count);
        cut_in_halves(c, list, count);
        return;
    }
    c->to_do -= count;
    if (GNI_MOST_INDICES * ((uint64_t)total + c->to_do) > c->indices_end - d->plan->index_count ||
        measured > c->limit) {
        unmark(c, d->ring + count, total - count);
        total = count;
        measured = measure(c, list, count);
    }
    emit(c, measured);
    unmark(c, d->ring, total);
}

static uint32_t find(uint32_t *parent, uint32_t t)
{
    while (parent[t] != t) {
        parent[t] = parent[parent[t]];
        t = parent[t];
    }
    return t;
}

/* d->order: the casting triangles, chain by chain; parent[t] names the chain of each, end[] where that ends. Returns
 * how many triangles cast. */
static uint32_t sort_chains(const cutter *c)
{
    const gn_mesh *mesh = c->mesh;
    const uint32_t triangles = mesh->info.triangle_count;
    uint32_t *parent = c->d->parent, *end = c->d->end, total = 0;

    for (uint32_t t = 0; t < triangles; t++) {
        parent[t] = t;
        end[t] = 0;
    }
    for (uint32_t e = 0; e < mesh->info.edge_count; e++) {
        const int32_t weight = gni_edge_weight(mesh, e, c->casting);
        int32_t uses = 0;

        for (uint32_t u = mesh->edge_uses[e]; u < mesh->edge_uses[e + 1]; u++)
            uses += c->casting[(mesh->uses[u] & GNI_USE_CORNER) / 3] != 0;
        if (uses == (weight < 0 ? -weight : weight)) /* nothing cancels */
            continue;
        for (uint32_t u = mesh->edge_uses[e]; u < mesh->edge_uses[e + 1]; u++) {
            const uint32_t t = (mesh->uses[u] & GNI_USE_CORNER) / 3;

            if (c->casting[t])
                parent[find(parent, t)] = find(parent, gni_first_caster(mesh, e, c->casting) / 3);
        }
    }
    for (uint32_t t = 0; t < triangles; t++)
        if (c->casting[t]) {
            parent[t] = find(parent, t);
            end[parent[t]]++;
        }
    for (uint32_t t = 0; t < triangles; t++) {
        const uint32_t count = end[t];

        end[t] = total;
        total += count;
    }
    for (uint32_t t = 0; t < triangles; t++)
        c->d->ring[mesh->order[t]] = t;
    for (uint32_t given = 0; given < triangles; given++) { /* as a strip is given, so it is best cut */
        const uint32_t t = c->d->ring[given];

        if (c->casting[t])
            c->d->order[end[parent[t]]++] = t;
    }
    return total;
}

static uint32_t chain_end(const cutter *c, uint32_t at)
{
    return c->d->end[c->d->parent[c->d->order[at]]];
}

/* Whether the triangles order[from .. to) keep within the limit. */
static int fits(const cutter *c, uint32_t from, uint32_t to)
{
    const uint32_t *list = c->d->order + from;
    uint32_t most;

    mark(c, list, to - from);
    most = measure(c, list, to - from);
    unmark(c, list, to - from);
    return most <= c->limit;
}

/* Where the longest run of whole chains from `from` on ends that keeps within the limit; `from` when not even one does.
 * Each look costs as much as a grid has cells: so runs are doubled, and the last doubling halved. */
static uint32_t longest_run(const cutter *c, uint32_t from, uint32_t count)
{
    const uint32_t *order = c->d->order, *parent = c->d->parent;
    uint32_t good = chain_end(c, from), bad = count;

    if (!fits(c, from, good))
        return from;
    while (good < count) {
        const uint32_t more = good - from < count - good ? good - from : count - good;
        const uint32_t next = chain_end(c, good + more - 1);

        if (!fits(c, from, next)) {
            bad = next;
            break;
        }
        good = next;
    }
    while (bad - good > (good - from) / 8) { /* near enough: it has eight ninths of the limit's triangles then */
        const uint32_t at = good + (bad - good - 1) / 2;
        uint32_t middle = chain_end(c, at);

        if (middle >= bad) /* the chain there is the one that is too much: what comes before it */
            for (middle = at; middle > good && parent[order[middle - 1]] == parent[order[at]];)
                middle--;
        if (middle <= good)
            break;
        if (fits(c, from, middle))
            good = middle;
        else
            bad = middle;
    }
    return good;
}

/* Groups of chains, as many in each as keep within the limit. */
static void add_chains(cutter *c, uint32_t count)
{
    gni_draft *d = c->d;

    for (uint32_t from = 0, to; from < count; from = to) {
        to = longest_run(c, from, count);
        if (to == from) {
            to = chain_end(c, from);
            cut_through(c, d->order + from, to - from);
            continue;
        }
        mark(c, d->order + from, to - from);
        emit(c, measure(c, d->order + from, to - from));
        unmark(c, d->order + from, to - from);
        c->to_do -= to - from;
    }
}

void gni_add_batched(gni_draft *d, const gni_volume *volume, const gni_casting *casting)
{
    const gn_object *object = &d->scene->objects[volume->object];
    const gn_plan_light *about = &d->lights[d->light];
    cutter c = {d,           volume, object->mesh,
                casting->of, {0},    (uint32_t)(gni_is_colored(d) ? about->color.limit : about->stencil.high),
                0,           0,      gni_is_colored(d) ? GNI_SPARE_PIECES : 0};
    uint32_t measured;

    gni_model_view(c.model_view, &d->scene->camera, object->model, object->mesh->info.centre);
    memset(d->piece.of, 0, object->mesh->info.triangle_count);
    c.to_do = sort_chains(&c);
    c.indices_end = d->plan->index_count + GNI_MOST_INDICES * c.to_do;
    mark(&c, d->order, c.to_do);
    measured = measure(&c, d->order, c.to_do);
    if (measured <= c.limit) {
        emit(&c, measured);
    } else {
        d->lights[d->light].cut_casters++;
        unmark(&c, d->order, c.to_do);
        add_chains(&c, c.to_do);
    }
}

/* All casting triangles of the light's casters. Returns the most layers of a cell. */
static uint32_t measure_all(gni_draft *d, const gni_cells *cells, gni_grid *grid)
{
    memset(grid, 0, sizeof *grid);
    for (uint32_t i = 0; i < d->scene->object_count; i++) {
        const gn_object *object = &d->scene->objects[i];
        double model_view[16];
        uint32_t count = 0;

        if (!(d->is_in[i] & GNI_IN_CAST))
            continue;
        gni_find_object_casting(object, &d->scene->lights[d->light], &d->casting);
        for (uint32_t t = 0; t < object->mesh->info.triangle_count; t++)
            if (d->casting.of[t])
                d->order[count++] = t;
        gni_model_view(model_view, &d->scene->camera, object->model, object->mesh->info.centre);
        gni_measure_triangles(cells, &d->layers->piece, &d->layers->scratch, object->mesh, model_view, d->casting.of,
                              d->order, count);
        gni_add_grid(cells, grid, &d->layers->piece);
    }
    return gni_most_layers(cells, grid, NULL);
}

/* Looks closer at cells with more layers than the limit: silhouettes of fine meshes crowd in a cell, but not at one
 * place. Returns the most that there may be, or more than the limit. */
static uint32_t zoom_in(gni_draft *d, uint32_t limit)
{
    gni_layers *l = d->layers;
    const int count = l->cells.face_count * l->cells.side * l->cells.side;
    uint32_t most = 0, hot_count = 0;
    int hot[GNI_MOST_ZOOMS];
    gni_grid *const sum = &l->zoomed;

    for (int i = 0; i < count; i++) {
        if (l->batch.layers[i] <= limit)
            most = most > l->batch.layers[i] ? most : l->batch.layers[i];
        else if (hot_count == GNI_MOST_ZOOMS)
            return l->batch.layers[i];
        else
            hot[hot_count++] = i;
    }
    for (uint32_t i = 0; i < hot_count && most <= limit; i++) {
        gni_cells closer;
        uint32_t layers;

        gni_zoom_cells(&closer, &l->cells, hot[i]);
        layers = measure_all(d, &closer, sum);
        most = most > layers ? most : layers;
    }
    return most;
}

/* What is known cheaply; then silhouettes; then boxes in cells; then triangles; and where these are too many, a closer
 * look. */
int gni_layers_fit(gni_draft *d, uint32_t limit, uint32_t first_record)
{
    gni_layers *l = d->layers;
    gn_plan_light *about = &d->lights[d->light];
    const uint32_t swept = about->layers <= limit ? 0 : gni_sweep_layers(d, first_record);

    if (about->layers <= limit)
        return 1;
    if (swept <= limit) {
        about->layers = swept;
        return 1;
    }
    for (uint32_t i = 0; i < d->scene->object_count; i++)
        if (d->is_in[i] & GNI_IN_CAST && d->cheap_of[i] > FEW) {
            const uint32_t own = gni_sweep_caster(d, first_record, i);

            d->cheap_of[i] = own < d->cheap_of[i] ? own : d->cheap_of[i];
        }
    gni_fit_cells(&l->cells, d->boxes, d->is_in, d->scene->object_count, d->bounds.light);
    memset(&l->batch, 0, sizeof l->batch);
    for (uint32_t i = 0; i < d->scene->object_count; i++)
        if (d->is_in[i] & GNI_IN_CAST)
            gni_cells_add_box(&l->cells, &l->batch, &d->boxes[i], d->cheap_of[i]);
    about->layers = gni_most_layers(&l->cells, &l->batch, NULL);
    if (about->layers > limit && d->uses_patches) /* what follows does not know them */
        return 0;
    if (about->layers > limit)
        about->layers = measure_all(d, &l->cells, &l->batch);
    if (about->layers > limit)
        about->layers = zoom_in(d, limit);
    return about->layers <= limit;
}
