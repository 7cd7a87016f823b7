/* batches.c - counts beyond the stencil's bits: volumes in batches, and casters cut into pieces.
 *
 * A count of n bits that wraps tells 2^n - 1 volumes from none; 256 around a point look like none. Whether so many can lie
 * around one is asked in steps, each dearer than the one before: how many triangles cast at all; half the length of
 * silhouettes, since a line that passes L layers of casters beside the light crosses silhouettes 2 L times on its way in
 * and out; boxes in cells of light space; and at last triangles and silhouettes in those cells. Most scenes end at
 * the first or second.
 *
 * Where they do not, one bit becomes a flag and the rest counts in batches; between two batches what is counted is folded
 * into the flag (DESIGN.md, decision 10). A caster that alone is too much is cut into chains: triangles that hang together
 * through edges where they cancel. Cut so, no new side arises. Only a chain that alone nests too much, such as a helix, is
 * cut through; each piece then also takes the triangles beyond the cut, so that no seam is the edge of both pieces
 * beside it: what a surface would lose where it meets a seam within a step of depth, the other piece covers. (What is
 * covered twice is shadowed all the same.) */
#include "gni_plan.h"

#include <string.h>

size_t gni_most_pieces(const gn_mesh *mesh, size_t ends, uint32_t limit)
{
    const size_t triangles = mesh->info.triangle_count;

    /* Two groups of chains in a row have more triangles than the limit together; halves of a chain that is cut have a half
     * of it at least, and a group may be closed before one. */
    return triangles <= limit ? ends : 3 * triangles / limit + 2 * ends + 1;
}

void gni_end_batch(gni_draft *d, int more_follows)
{
    gn_step *step;

    if (d->plan->record_count == d->first_of_batch)
        return;
    gni_add_step(d, GN_STEP_VOLUMES, GN_DRAW_NOTHING, d->light, 0);
    step = &d->steps[d->plan->step_count - 1];
    step->first_record = d->first_of_batch;
    step->record_count = d->plan->record_count - d->first_of_batch;
    d->first_of_batch = d->plan->record_count;
    d->lights[d->light].batches++;
    if (more_follows)
        gni_add_step(d, GN_STEP_FOLD, GN_DRAW_NOTHING, d->light, 0);
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
} cutter;

/* d->piece holds the casting of these triangles, and 0 for all others. */
static void mark(const cutter *c, const uint32_t *list, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        c->d->piece[list[i]] = c->casting[list[i]];
}

static void unmark(const cutter *c, const uint32_t *list, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        c->d->piece[list[i]] = 0;
}

/* Layers of the marked triangles of list[count]: not more than there are triangles. */
static uint32_t measure(const cutter *c, gni_grid *grid, const uint32_t *list, uint32_t count)
{
    memset(grid, 0, sizeof *grid);
    gni_cells_add_triangles(&c->d->layers->cells, grid, c->mesh, c->model_view, c->d->piece, list, count);
    for (size_t i = 0; i < GNI_CELLS; i++)
        grid->layers[i] = grid->layers[i] < count ? grid->layers[i] : (uint16_t)count;
    return gni_most_layers(&c->d->layers->cells, grid, NULL);
}

/* The marked piece, whose layers are in `grid`, into this batch or the next. */
static void emit(const cutter *c, const gni_grid *grid)
{
    gni_draft *d = c->d;
    gni_layers *l = d->layers;
    gn_plan_light *about = &d->lights[d->light];
    uint32_t most;

    if (gni_most_layers(&l->cells, &l->batch, grid) > c->limit) {
        gni_end_batch(d, 1);
        memset(&l->batch, 0, sizeof l->batch);
    }
    gni_add_grid(&l->cells, &l->batch, grid);
    most = gni_most_layers(&l->cells, &l->batch, NULL);
    about->layers = about->layers > most ? about->layers : most;
    gni_add_records(d, c->volume, d->piece);
}

/* Copies list[count] to ring[] and adds, marked, the neighbours beyond edges where two triangles cancel; of the same chunk,
 * so that a piece has no more records. Returns how many all are. */
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

                if (c->d->piece[t] || !c->casting[t] || gni_chunk_of(mesh, t) != gni_chunk_of(mesh, list[i]))
                    continue;
                c->d->piece[t] = c->casting[t];
                ring[total++] = t;
            }
        }
    return total;
}

/* A chain that is too much by itself: halves, until each is not; with its ring where that keeps within the limit and the
 * room. */
static void cut_through(cutter *c, const uint32_t *list, uint32_t count)
{
    gni_draft *d = c->d;
    gni_grid *grid = &d->layers->chain;
    uint32_t total;

    mark(c, list, count);
    if (measure(c, grid, list, count) > c->limit) {
        unmark(c, list, count);
        cut_through(c, list, count / 2);
        cut_through(c, list + count / 2, count - count / 2);
        return;
    }
    total = add_ring(c, list, count, d->ring);
    c->to_do -= count;
    if (GNI_MOST_INDICES * ((uint64_t)total + c->to_do) > c->indices_end - d->plan->index_count ||
        measure(c, grid, d->ring, total) > c->limit) {
        unmark(c, d->ring + count, total - count);
        total = count;
        measure(c, grid, list, count);
    }
    emit(c, grid);
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

/* d->order: the casting triangles, chain by chain; parent[t] names the chain of each, end[] where that ends. Returns how many
 * triangles cast. */
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
        if (c->casting[t])
            c->d->order[end[parent[t]]++] = t;
    return total;
}

/* Groups of chains, as many in each as keep within the limit. */
static void add_chains(cutter *c, uint32_t count)
{
    gni_draft *d = c->d;
    gni_layers *l = d->layers;
    const uint32_t *order = d->order;
    uint32_t group = 0, to;

    memset(&l->group, 0, sizeof l->group);
    for (uint32_t from = 0; from < count; from = to) {
        uint32_t most;

        to = d->end[d->parent[order[from]]];
        mark(c, order + from, to - from);
        most = measure(c, &l->chain, order + from, to - from);
        unmark(c, order + from, to - from);
        if (from > group && gni_most_layers(&l->cells, &l->group, &l->chain) > c->limit) {
            mark(c, order + group, from - group);
            emit(c, &l->group);
            unmark(c, order + group, from - group);
            c->to_do -= from - group;
            group = from;
            memset(&l->group, 0, sizeof l->group);
        }
        if (most > c->limit) {
            cut_through(c, order + from, to - from);
            group = to;
        } else {
            gni_add_grid(&l->cells, &l->group, &l->chain);
        }
    }
    if (count > group) {
        mark(c, order + group, count - group);
        emit(c, &l->group);
        unmark(c, order + group, count - group);
    }
}

void gni_add_batched(gni_draft *d, const gni_volume *volume, const int8_t *casting)
{
    const gn_object *object = &d->scene->objects[volume->object];
    cutter c = {d, volume, object->mesh, casting, {0}, (uint32_t)d->lights[d->light].stencil.high, 0, 0};

    gni_model_view(c.model_view, &d->scene->camera, object->model, object->mesh->info.centre);
    memset(d->piece, 0, object->mesh->info.triangle_count);
    c.to_do = sort_chains(&c);
    c.indices_end = d->plan->index_count + GNI_MOST_INDICES * c.to_do;
    mark(&c, d->order, c.to_do);
    if (measure(&c, &d->layers->group, d->order, c.to_do) <= c.limit) {
        emit(&c, &d->layers->group);
    } else {
        unmark(&c, d->order, c.to_do);
        add_chains(&c, c.to_do);
    }
}

/* What is known cheaply; then all casting triangles of the light's casters in cells, boxes first. */
int gni_layers_fit(gni_draft *d, uint32_t limit)
{
    gni_layers *l = d->layers;
    gn_plan_light *about = &d->lights[d->light];

    if (about->layers <= limit)
        return 1;
    gni_fit_cells(&l->cells, d->boxes, d->is_in, d->scene->object_count, d->bounds.light);
    memset(&l->batch, 0, sizeof l->batch);
    for (uint32_t i = 0; i < d->scene->object_count; i++)
        if (d->is_in[i] & GNI_IN_CAST)
            gni_cells_add_box(&l->cells, &l->batch, &d->boxes[i], d->cheap_of[i]);
    about->layers = gni_most_layers(&l->cells, &l->batch, NULL);
    if (about->layers <= limit)
        return 1;
    memset(&l->batch, 0, sizeof l->batch);
    for (uint32_t i = 0; i < d->scene->object_count; i++)
        if (d->is_in[i] & GNI_IN_CAST) {
            const gn_object *object = &d->scene->objects[i];
            const gni_volume volume = {i, NULL, GN_FAR_INFINITE, NULL, 0.0};
            cutter c = {d, &volume, object->mesh, d->casting, {0}, limit, 0, 0};

            gn_object_casting(object, &d->scene->lights[d->light], d->casting);
            gni_model_view(c.model_view, &d->scene->camera, object->model, object->mesh->info.centre);
            for (uint32_t t = 0; t < object->mesh->info.triangle_count; t++) {
                d->piece[t] = d->casting[t];
                if (d->casting[t])
                    d->order[c.to_do++] = t;
            }
            measure(&c, &l->group, d->order, c.to_do);
            gni_add_grid(&l->cells, &l->batch, &l->group);
        }
    about->layers = gni_most_layers(&l->cells, &l->batch, NULL);
    return about->layers <= limit;
}
