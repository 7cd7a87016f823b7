/* plan.c - decides a frame: steps, volumes, and their index streams, as plain data in the caller's memory.
 * plan_passes.c has the order of its passes, plan_light.c decides a light.
 *
 * Memory is cut from the given block from its front: the bound and the plan walk the same list of arrays. */
#include "gni_plan.h"

#include <math.h>
#include <string.h>

/* A block cut from the front. With base NULL it only counts. */
typedef struct arena {
    unsigned char *base;
    size_t used;
    int overflow;
} arena;

static void *cut(arena *a, size_t count, size_t size)
{
    void *const block = a->base ? a->base + a->used : NULL;

    if (count > (SIZE_MAX - a->used - sizeof(double)) / size) {
        a->overflow = 1;
        return NULL;
    }
    a->used = (a->used + count * size + sizeof(double) - 1) / sizeof(double) * sizeof(double);
    return block;
}

static void cut_casting(arena *a, gni_casting *c, size_t triangles)
{
    const size_t clusters = (triangles + GNI_CLUSTER - 1) / GNI_CLUSTER;

    c->of = cut(a, triangles + 1, 1);
    c->bits = cut(a, clusters, sizeof *c->bits);
    c->spare = cut(a, clusters, sizeof *c->spare);
}

/* The most layers that one batch holds where a light needs several; in colour fragments, where casters are cut. */
static uint32_t batch_limit(const gn_scene *s)
{
    const gn_method method = gni_pick(s);

    if (gni_counts_in_color(method))
        return gni_cuts_casters(method) ? gni_color_limit(s, method) : GNI_NONE;
    return gn_target_can(&s->target, GN_CAN_STENCIL_WRAP) && method != GN_METHOD_REFINE ? 127 : 63;
}

/* Cuts every array of a plan at its greatest size. Returns 0 when the sizes do not fit. */
static int lay_out(gni_draft *d, arena *a)
{
    const gn_scene *s = d->scene;
    const uint32_t limit = GNI_HAS_BATCHES ? batch_limit(s) : 0;
    const int is_colored = GNI_HAS_FALLBACK && gni_counts_in_color(gni_pick(s));
    const size_t most_steps = GNI_HAS_REFINE && gni_pick(s) == GN_METHOD_REFINE ? 5 : 3; /* of a batch */
    const size_t most_patches = GNI_HAS_CULLING ? GN_MOST_PATCHES : 0;
    size_t records = 0, chunks = 0, indices = 0, triangles = 0, all = 0, batches = 1, vertices = 0, largest = 0;
    const size_t most =
        UINT32_MAX / (s->light_count ? s->light_count : 1); /* of records and of indices, for each light */

    for (uint32_t i = 0; i < s->object_count; i++) {
        const gn_mesh *mesh = s->objects[i].mesh;
        size_t ends = 1, pieces;

        if (mesh)
            largest = largest < mesh->info.triangle_count ? mesh->info.triangle_count : largest;
        if (!mesh || !(s->objects[i].flags & GN_CASTS))
            continue;
        if (gni_is_orthographic(&s->camera))
            ends = mesh->info.triangle_count < GNI_MAX_ENDS ? mesh->info.triangle_count + 1 : GNI_MAX_ENDS;
        pieces = GNI_HAS_BATCHES ? gni_most_pieces(mesh, ends, limit) : ends;
        if (GNI_HAS_CULLING)
            pieces += is_colored ? GNI_SPARE_PIECES * ends : GNI_MOST_INTERVALS - 1;
        if (mesh->info.chunk_count > (most - records) / (pieces + most_patches) ||
            mesh->info.triangle_count > (most - indices) / GNI_MOST_INDICES)
            return 0;
        records += mesh->info.chunk_count * pieces;
        chunks += mesh->info.chunk_count;
        batches += pieces;
        indices += (size_t)mesh->info.triangle_count * GNI_MOST_INDICES;
        all += mesh->info.triangle_count;
        triangles = triangles < mesh->info.triangle_count ? mesh->info.triangle_count : triangles;
        vertices = vertices < mesh->info.vertex_count ? mesh->info.vertex_count : vertices;
    }
    d->plan = cut(a, 1, sizeof *d->plan);
    /* Before and after all lights there are up to eight. A light zeroes twice, starts a mask (three), marks once, darkens
     * each patch, resolves and draws twice; each of its batches holds a piece of a caster at least, and is resolved or
     * folded, and zeroed. Refined, it is named and zeroed twice more, and its batches come again. */
    if (batches > (SIZE_MAX / 5 - 16) / (s->light_count ? s->light_count : 1))
        return 0;
    d->steps = cut(a, 8 + (size_t)s->light_count * (12 + most_patches + most_steps * batches), sizeof *d->steps);
    d->draws = cut(a, s->light_count, 1);
    d->lights = cut(a, s->light_count, sizeof *d->lights);
    d->objects = cut(a, s->object_count, sizeof *d->objects);
    d->casters = cut(a, (size_t)s->object_count * s->light_count, sizeof *d->casters);
    d->boxes = cut(a, s->object_count, sizeof *d->boxes);
    d->is_in = cut(a, s->object_count, 1);
    d->records = cut(a, (records + most_patches * chunks) * s->light_count, sizeof *d->records);
    cut_casting(a, &d->casting, triangles);
    if (GNI_HAS_CULLING) {
        d->rectangles = cut(a, s->object_count, sizeof *d->rectangles);
        d->balls = cut(a, s->object_count, sizeof *d->balls);
        d->fronts = cut(a, s->object_count, sizeof *d->fronts);
        for (int i = 0; i < 2; i++)
            d->facing[i] = cut(a, (largest + GNI_CLUSTER - 1) / GNI_CLUSTER, sizeof *d->facing[i]);
        d->touched = cut(a, s->object_count, sizeof *d->touched);
        d->heights = cut(a, s->object_count, sizeof *d->heights);
        d->flats = cut(a, most_patches * chunks, sizeof *d->flats);
        d->outlines = cut(a, most_patches * chunks, sizeof *d->outlines);
        d->walk.vertex_count = (uint32_t)(vertices < GN_CHUNK_VERTICES ? vertices : GN_CHUNK_VERTICES);
        d->walk.first = cut(a, d->walk.vertex_count, sizeof *d->walk.first);
        d->walk.next = cut(a, 3 * triangles, sizeof *d->walk.next);
        d->walk.loop = cut(a, 3 * triangles + 1, sizeof *d->walk.loop);
    }
    if (GNI_HAS_CULLING && gni_must_end(s)) {
        cut_casting(a, &d->group, triangles);
        d->end_of = cut(a, triangles, 1);
        d->region = cut(a, 1, sizeof *d->region);
        d->ends = cut(a, 1, sizeof *d->ends);
    }
    if (is_colored)
        d->tiles = cut(a, GNI_TILES * GNI_TILES, sizeof *d->tiles);
    if (is_colored && all > 0) {
        d->seen_cap = cut(a, triangles, 1);
        for (int i = 0; i < 2; i++)
            d->seams[i] = cut(a, vertices, sizeof *d->seams[i]);
        d->sectors = cut(a, 2, sizeof *d->sectors);
        d->columns = cut(a, GNI_COLUMN_WAYS, sizeof *d->columns);
    }
    if (GNI_HAS_BATCHES && all > limit) {
        d->layers = cut(a, 1, sizeof *d->layers);
        cut_casting(a, &d->piece, triangles);
        d->order = cut(a, triangles, sizeof *d->order);
        d->parent = cut(a, triangles, sizeof *d->parent);
        d->end = cut(a, triangles, sizeof *d->end);
        d->ring = cut(a, triangles, sizeof *d->ring);
        d->cheap_of = cut(a, s->object_count, sizeof *d->cheap_of);
    }
    d->indices = cut(a, indices * s->light_count + GNI_SLACK,
                     sizeof *d->indices); /* last: what it does not need stays untouched */
    return !a->overflow;
}

/* What is worked with lies before the plan in the memory that is given: boards have small stacks. */
typedef struct desk {
    gni_draft draft;
    gn_scene scene;
} desk;

size_t gn_plan_bound(const gn_scene *scene)
{
    gni_draft d;
    arena a = {NULL, 0, 0};

    cut(&a, 1, sizeof(desk));
    memset(&d, 0, sizeof d);
    d.scene = scene;
    return scene && lay_out(&d, &a) ? a.used : 0;
}

/* The depth range of an orthographic camera: from znear to behind all that is seen, all casters and all ends. */
static void find_range(gni_draft *d)
{
    const gn_scene *s = d->scene;
    double deepest = d->region->deepest;

    for (uint32_t light = 0; light < s->light_count; light++)
        for (uint32_t i = 0; i < s->object_count; i++) {
            const gn_object *object = &s->objects[i];
            double light_view[4], model_view[16];

            if (!(object->flags & GN_CASTS))
                continue;
            gni_find_object_casting(object, &s->lights[light], &d->casting);
            gni_light_in_view(&d->scene->camera, &s->lights[light], light_view);
            gni_model_view(model_view, &s->camera, object->model, object->mesh->info.centre);
            if (gni_choose_ends(d->ends, d->region, object->mesh, model_view, light_view, d->casting.of, d->end_of))
                deepest = fmax(deepest, d->ends->deepest);
        }
    d->plan->depth_range[0] = s->camera.znear;
    d->plan->depth_range[1] = deepest + (deepest - s->camera.znear) / 1024.0;
    if (!(d->plan->depth_range[1] > d->plan->depth_range[0]))
        d->plan->depth_range[1] = s->camera.znear + 1.0; /* nothing in front of the camera */
}

/* Without culling: whether any of its box is before the eye. */
static int may_be_seen(const gni_draft *d, uint32_t object)
{
    if (GNI_HAS_CULLING)
        return gni_may_be_seen(&d->seen, &d->boxes[object]);
    for (int corner = 0; corner < 8; corner++)
        if (d->boxes[object].points[corner][2] < 0.0)
            return 1;
    return 0;
}

/* A step of depth at the view distance z is z^2 / (n 2^bits) wide. Surface and side are each rounded to one, the side
 * is drawn one behind, and interpolation adds another: from where four are larger than half a pixel on, edges may stray by
 * more than that. */
static void find_depth_limit(gni_draft *d)
{
    const gn_scene *s = d->scene;
    const gn_camera *c = &s->camera;
    const double half = 0.5 * (gni_is_refined(d) ? 1 : d->plan->scale) *
                        fmin((c->top - c->bottom) / s->target.height, (c->right - c->left) / s->target.width);
    const double steps = ldexp(0.25, s->target.depth_bits);
    double farthest = -INFINITY, nearest = INFINITY;

    for (uint32_t i = 0; i < s->object_count; i++) {
        if (!(s->objects[i].flags & GN_RECEIVES) || !may_be_seen(d, i))
            continue;
        for (int corner = 0; corner < 8; corner++) {
            farthest = fmax(farthest, -d->boxes[i].points[corner][2]);
            nearest = fmin(nearest, -d->boxes[i].points[corner][2]);
        }
    }
    if (GNI_HAS_FALLBACK) {
        d->plan->mask_depth[0] = gni_is_orthographic(c) ? 0.5 : fmax(c->znear, nearest < INFINITY ? nearest : 0.0);
        d->plan->mask_depth[1] = gni_is_orthographic(c) ? 0.5 : 0.0;
    }
    d->plan->deepest_receiver = c->zfar != 0.0 ? fmin(farthest, c->zfar) : farthest;
    if (gni_is_orthographic(c))
        d->plan->depth_limit = (d->plan->depth_range[1] - d->plan->depth_range[0]) / steps > half ? c->znear : INFINITY;
    else
        d->plan->depth_limit = c->znear * half * steps;
    if (d->plan->deepest_receiver > d->plan->depth_limit)
        d->plan->warnings |= 1u << GN_WARN_DEPTH;
}

/* Matrices for the host's passes and ours. */
static gn_result place_objects(gni_draft *d)
{
    for (uint32_t i = 0; i < d->scene->object_count; i++) {
        const gn_object *object = &d->scene->objects[i];
        gn_plan_object *o = &d->objects[i];
        double m[16];

        memset(o, 0, sizeof *o);
        o->mesh = object->mesh;
        o->flags = object->flags;
        o->mirrored = gn_mat4_determinant3(object->model) < 0.0;
        gni_model_view(m, &d->scene->camera, object->model, object->mesh->info.centre);
        gn_mat4_multiply(m, d->projection, m);
        gn_mat4_to_float(o->matrix, m);
        for (int k = 0; k < 16; k++)
            if (!isfinite(o->matrix[k]))
                return gn_fail(d->context, GN_E_ARG, "plan: object %lu: element %d of its matrix to clip space is %g",
                               (unsigned long)i, k, m[k]);
    }
    return GN_OK;
}

static uint32_t scale_of(const gn_scene *s)
{
    return s->scale ? s->scale : 1;
}

/* The frame is planned to whole pixels of its masks: to the right and above there is more of it than is seen. */
static void widen(gn_scene *own)
{
    const uint32_t scale = scale_of(own), size[2] = {own->target.width, own->target.height};
    gn_camera *c = &own->camera;

    if (!GNI_HAS_FALLBACK || scale == 1)
        return;
    own->target.width = (size[0] + scale - 1) / scale * scale;
    own->target.height = (size[1] + scale - 1) / scale * scale;
    c->right = c->left + (c->right - c->left) * own->target.width / size[0];
    c->top = c->bottom + (c->top - c->bottom) * own->target.height / size[1];
}

static void start_plan(gni_draft *d)
{
    const gn_scene *s = d->scene;
    gn_plan *plan = d->plan;

    memset(plan, 0, sizeof *plan);
    memset(d->lights, 0, s->light_count * sizeof *d->lights);
    if (GNI_HAS_CULLING)
        memset(d->walk.first, 0xff, d->walk.vertex_count * sizeof *d->walk.first); /* GNI_NONE */
    plan->target = s->target;
    plan->blend_once = s->blend_once;
    plan->mask = d->choice.mask;
    plan->shade = s->shade;
    plan->dimmed = d->choice.dimmed;
    plan->image = d->choice.image;
    plan->mask_format = d->choice.mask_format;
    plan->scale = scale_of(s);
    plan->upsample = gni_is_refined(d) ? GN_UPSAMPLE_BILINEAR : s->upsample;
    plan->sharpen = s->sharpen && plan->scale > 1 && !gni_is_refined(d);
    plan->carries_depth = GNI_HAS_FALLBACK && gni_carries_depth(s);
    plan->viewport[0] = s->target.width;
    plan->viewport[1] = s->target.height;
    for (int i = 0; i < 2; i++)
        plan->mask_size[i] = plan->viewport[i] / plan->scale;
    plan->steps = d->steps;
    plan->records = d->records;
    plan->indices = d->indices;
    plan->lights = d->lights;
    plan->light_count = s->light_count;
    plan->objects = d->objects;
    plan->object_count = s->object_count;
    plan->casters = d->casters;
    plan->depth_range[0] = s->camera.znear;
    plan->depth_range[1] = gni_has_finite_far(&s->camera) ? s->camera.zfar : INFINITY;
    plan->clear_depth = 1.0;
}

/* A vertex shader's floats compute clip w, and z = w - 2 n beside it. What rounding does to the two cancels where 2 n
 * is a multiple of the last bit of the greatest w: so n is brought nearer to the eye by less than that bit, and by an
 * eighth of itself at most. Where that is not enough depths go wrong, in proportion: a warning. */
static void round_near(gni_draft *d, gn_scene *own)
{
    gn_camera *c = &own->camera;
    double farthest = 0.0, step;
    int exponent;

    for (uint32_t i = 0; i < own->object_count; i++) {
        const gn_object *object = &own->objects[i];
        double model_view[16];

        if (!may_be_seen(d, i))
            continue;
        gni_model_view(model_view, c, object->model, object->mesh->info.centre);
        farthest = fmax(farthest, fabs(model_view[14]));
        for (int corner = 0; corner < 8; corner++)
            farthest = fmax(farthest, fabs(d->boxes[i].points[corner][2]));
    }
    d->plan->farthest_vertex = farthest;
    if (gni_is_orthographic(c) || gni_has_finite_far(c) || farthest == 0.0)
        return;
    frexp(farthest, &exponent);
    step = ldexp(1.0, exponent - 24);
    if (2.0 * c->znear >= 8.0 * step)
        c->znear = 0.5 * step * floor(2.0 * c->znear / step);
    else
        d->plan->warnings |= 1u << GN_WARN_FLOAT;
    d->plan->depth_range[0] = c->znear;
}

/* What is the same for all lights. own: the scene, whose camera is this function's to change. */
static gn_result make_frame(gni_draft *d, gn_scene *own)
{
    static const double identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    static const float no_centre[3] = {0, 0, 0};
    const gn_scene *s = d->scene;
    gn_result result;

    d->whole[2] = s->target.width;
    d->whole[3] = s->target.height;
    for (uint32_t i = 0; i < s->object_count; i++) {
        double model_view[16];
        uint32_t of_ball[4];

        gni_model_view(model_view, &s->camera, s->objects[i].model, s->objects[i].mesh->info.centre);
        gni_box_hull(&d->boxes[i], &s->objects[i].mesh->info, model_view);
        if (GNI_HAS_CULLING) {
            gni_find_ball(d->balls[i], &d->boxes[i], s->objects[i].mesh, model_view);
            gni_find_rectangle(d->rectangles[i], &d->boxes[i], &s->camera, &s->target);
            gni_find_balls_rectangle(of_ball, d->balls[i], d->balls[i], &s->camera, &s->target);
            gni_meet_rectangles(d->rectangles[i], of_ball);
        }
        d->receivers_are_known |= (s->objects[i].flags & GN_RECEIVES) != 0;
    }
    if (GNI_HAS_CULLING)
        gni_make_view(&d->seen, &s->camera, &s->target, d->whole);
    round_near(d, own);
    if (gni_has_region(d))
        gni_receiver_region(d->region, s);
    if (gni_is_orthographic(&s->camera))
        find_range(d);
    if (s->camera.zfar != 0.0 && !gni_has_finite_far(&s->camera))
        d->plan->clear_depth = gni_depth_of(&s->camera, d->plan->depth_range, s->camera.zfar);
    gni_projection(d->projection, &s->camera, d->plan->depth_range);
    if (GNI_HAS_CULLING) {
        gni_model_view(d->view, &s->camera, identity, no_centre);
        gni_make_view(&d->seen, &s->camera, &s->target, d->whole);
    }
    find_depth_limit(d);
    gni_start_stain(d);
    result = place_objects(d);
    if (result != GN_OK)
        return result;
    for (uint32_t i = 0; i < s->object_count && gni_is_refined(d); i++)
        d->objects[i].thin = (uint8_t)gni_is_thin_image(d, i);
    if (!GNI_HAS_CULLING)
        return GN_OK;
    gni_find_patches(d);
    gni_find_fronts(d);
    d->plan->patch_count = d->patch_count;
    for (uint32_t p = 0; p < d->patch_count; p++)
        gni_plane_before(d->plan->patches[p], d->patches[p].plane, d->view);
    return GN_OK;
}

gn_result gn_plan_make(gn_context *context, const gn_scene *scene, void *memory, size_t size, const gn_plan **plan)
{
    arena a = {memory, 0, 0};
    desk *work;
    gni_draft *d;
    gn_scene *own;
    size_t needed;
    gn_result result;

    if (!context || !scene || !memory || !plan)
        return gn_fail(context, GN_E_ARG, "gn_plan_make: NULL argument");
    if ((uintptr_t)memory % sizeof(double) != 0)
        return gn_fail(context, GN_E_ARG, "gn_plan_make: memory is not aligned to %d bytes", (int)sizeof(double));
    result = gni_check_scene(context, scene);
    if (result != GN_OK)
        return result;
    needed = gn_plan_bound(scene);
    if (needed == 0)
        return gn_fail(context, GN_E_SPACE,
                       "gn_plan_make: %lu lights and %lu objects need more indices than 32 bits count",
                       (unsigned long)scene->light_count, (unsigned long)scene->object_count);
    if (size < needed)
        return gn_fail(context, GN_E_SPACE, "gn_plan_make: %lu bytes given, %lu needed", (unsigned long)size,
                       (unsigned long)needed);
    work = cut(&a, 1, sizeof *work);
    d = &work->draft;
    own = &work->scene;
    *own = *scene;
    if (GNI_HAS_REFINE && own->method == GN_METHOD_REFINE) {
        own->scale = own->scale < 2 ? 2 : own->scale;
        own->without |= GN_MEASURE_PATCHES; /* their bits name what is not contested */
    }
    memset(d, 0, sizeof *d);
    d->context = context;
    d->scene = own;
    result = gni_choose(context, own, &d->choice);
    if (result != GN_OK)
        return result;
    lay_out(d, &a);
    d->is_colored = gni_counts_in_color(d->choice.method);
    if (GNI_HAS_FALLBACK && d->choice.image.depth_bits &&
        !(gni_is_refined(d) && own->target.depth_bits < d->choice.image.depth_bits))
        own->target.depth_bits = d->choice.image.depth_bits;
    widen(own);
    if (!gni_is_additive(d)) /* what is not lit is dimmed too: shadows must reach it */
        own->without |= GN_MEASURE_ENDS | GN_MEASURE_PATCHES | GN_MEASURE_INTERVALS | GN_MEASURE_SCISSORS;
    start_plan(d);
    d->plan->target = scene->target;
    result = make_frame(d, own);
    if (result != GN_OK)
        return result;
    if (GNI_HAS_CACHE && scene->cache)
        gni_start_cache(scene->cache, scene);
    result = gni_add_passes(d);
    if (GNI_HAS_SELECTOR)
        gni_estimate_traffic(d->plan);
    if (GNI_HAS_CACHE && scene->cache)
        gni_end_cache(scene->cache, d->plan);
    if (result == GN_OK)
        *plan = d->plan;
    return result;
}
