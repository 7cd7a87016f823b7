/* plan.c - decides a frame: steps, volumes, and their index streams, as plain data in the caller's memory.
 *
 * The order of the passes is McGuire's (2003, section 4): depth and ambient light together; for each light its volumes
 * counted into the stencil and its light added where the count is zero; last what is transparent. The whole colour,
 * depth and stencil are cleared once; between lights the stencil is zeroed by a quad (DESIGN.md, decision 9).
 *
 * Memory is cut from the given block from its front: the bound and the plan walk the same list of arrays. */
#include "gn_matrix.h"
#include "gni.h"

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

/* A plan while it is made. */
typedef struct draft {
    gn_context *context;
    const gn_scene *scene;
    gn_plan *plan;
    gn_step *steps;
    gn_record *records;
    uint16_t *indices;
    gn_plan_light *lights;
    gn_plan_object *objects;
    int8_t *casting, *group; /* of the caster at hand; group: those of one end plane */
    uint8_t *end_of;
    gni_region *region;
    gni_ends *ends;
    gni_choice choice;
    gni_view view_of_camera;
    gni_case at_hand; /* of the caster at hand */
    double projection[16], view[16];
} draft;

/* Cuts every array of a plan at its greatest size. Returns 0 when the sizes do not fit. */
static int lay_out(draft *d, arena *a)
{
    const gn_scene *s = d->scene;
    const int may_end = gni_must_end(s);
    size_t records = 0, indices = 0, triangles = 0;
    const size_t most =
        UINT32_MAX / (s->light_count ? s->light_count : 1); /* of records and of indices, for each light */

    for (uint32_t i = 0; i < s->object_count; i++) {
        const gn_mesh *mesh = s->objects[i].mesh;
        size_t ends = 1;

        if (!mesh || !(s->objects[i].flags & GN_CASTS))
            continue;
        if (s->camera.orthographic)
            ends = mesh->info.triangle_count < GNI_MAX_ENDS ? mesh->info.triangle_count + 1 : GNI_MAX_ENDS;
        if (mesh->info.chunk_count > (most - records) / ends || mesh->info.triangle_count > (most - indices) / 24)
            return 0;
        records += mesh->info.chunk_count * ends;
        indices += gni_volume_bound(mesh);
        triangles = triangles < mesh->info.triangle_count ? mesh->info.triangle_count : triangles;
    }
    d->plan = cut(a, 1, sizeof *d->plan);
    d->steps = cut(a, 3 + 4 * (size_t)s->light_count, sizeof *d->steps);
    d->lights = cut(a, s->light_count, sizeof *d->lights);
    d->objects = cut(a, s->object_count, sizeof *d->objects);
    d->records = cut(a, records * s->light_count, sizeof *d->records);
    d->casting = cut(a, triangles, 1);
    if (may_end) {
        d->group = cut(a, triangles, 1);
        d->end_of = cut(a, triangles, 1);
        d->region = cut(a, 1, sizeof *d->region);
        d->ends = cut(a, 1, sizeof *d->ends);
    }
    d->indices = cut(a, indices * s->light_count, sizeof *d->indices); /* last: what it does not need stays untouched */
    return !a->overflow;
}

size_t gn_plan_bound(const gn_scene *scene)
{
    draft d;
    arena a = {NULL, 0, 0};

    memset(&d, 0, sizeof d);
    d.scene = scene;
    return scene && lay_out(&d, &a) ? a.used : 0;
}

static int all_finite(const double *v, int count)
{
    for (int i = 0; i < count; i++)
        if (!isfinite(v[i]))
            return 0;
    return 1;
}

static gn_result check(gn_context *context, const gn_scene *s)
{
    gn_result result;

    if ((s->light_count && !s->lights) || (s->object_count && !s->objects))
        return gn_fail(context, GN_E_ARG, "plan: NULL array of lights or objects");
    if (s->target.width == 0 || s->target.height == 0)
        return gn_fail(context, GN_E_ARG, "plan: target of %lux%lu pixels", (unsigned long)s->target.width,
                       (unsigned long)s->target.height);
    result = gni_check_camera(context, &s->camera);
    if (result != GN_OK)
        return result;
    for (uint32_t i = 0; i < s->light_count; i++) {
        const gn_light *light = &s->lights[i];
        const double *v = light->kind == GN_LIGHT_DIRECTIONAL ? light->towards : light->position;

        if ((unsigned)light->kind > GN_LIGHT_DIRECTIONAL)
            return gn_fail(context, GN_E_ARG, "plan: light %lu is of unknown kind %d", (unsigned long)i,
                           (int)light->kind);
        if (!all_finite(v, 3))
            return gn_fail(context, GN_E_ARG, "plan: light %lu is at %g %g %g", (unsigned long)i, v[0], v[1], v[2]);
        if (light->kind == GN_LIGHT_DIRECTIONAL && v[0] == 0.0 && v[1] == 0.0 && v[2] == 0.0)
            return gn_fail(context, GN_E_ARG, "plan: light %lu comes from no direction: 0 0 0", (unsigned long)i);
    }
    for (uint32_t i = 0; i < s->object_count; i++) {
        const double *m = s->objects[i].model;

        if (!s->objects[i].mesh)
            return gn_fail(context, GN_E_ARG, "plan: object %lu has no mesh", (unsigned long)i);
        if (!all_finite(m, 16))
            return gn_fail(context, GN_E_ARG, "plan: object %lu: its matrix is not finite", (unsigned long)i);
        if (m[3] != 0.0 || m[7] != 0.0 || m[11] != 0.0 || m[15] != 1.0)
            return gn_fail(context, GN_E_ARG, "plan: object %lu: last row of its matrix is %g %g %g %g, not 0 0 0 1",
                           (unsigned long)i, m[3], m[7], m[11], m[15]);
    }
    return GN_OK;
}

/* Homogeneous, the eye subtracted first. */
static void light_in_view(const draft *d, const gn_light *light, double out[4])
{
    const gn_camera *c = &d->scene->camera;
    const int is_sun = light->kind == GN_LIGHT_DIRECTIONAL;
    double v[3];

    for (int i = 0; i < 3; i++)
        v[i] = is_sun ? light->towards[i] : light->position[i] - c->world[12 + i];
    for (int i = 0; i < 3; i++)
        out[i] = c->world[4 * i] * v[0] + c->world[4 * i + 1] * v[1] + c->world[4 * i + 2] * v[2];
    out[3] = is_sun ? 0.0 : 1.0;
}

/* How a caster is counted, and which parts of its volume that takes. */
static unsigned choose_parts(const draft *d, uint32_t light, uint32_t object_index, gn_far far_end, int *mcguire_case)
{
    const gn_object *object = &d->scene->objects[object_index];
    const gn_mesh_info *info = &object->mesh->info;
    const gn_method method = d->lights[light].method;
    gni_case c = {method == GN_METHOD_ZPASS ? 1 : 3, 7};
    unsigned parts = 0;

    if (method == GN_METHOD_STENCIL)
        c = d->at_hand;
    if (method == GN_METHOD_STENCIL && far_end == GN_FAR_CLAMPED && c.number == 1)
        c.number = c.seen & 1 ? 3 : 2; /* what lies before the near plane would be drawn, and counted */
    if (c.seen & 4)
        parts |= GN_SIDES;
    /* z-pass: the eye may look into a volume from behind its end (DESIGN.md, decision 6) */
    if (far_end == GN_FAR_ENDED ? c.seen & 4 : c.number != 1 && c.seen & 2)
        parts |= GN_DARK_CAP;
    /* z-pass alone leaves the light cap out where the caster itself is seen instead (decision 4). Slivers that turn over
     * when their vertices are rounded are culled when the host draws and counted here: with the cap both ways of counting
     * agree on them too. */
    if (c.seen & 1 &&
        (method != GN_METHOD_ZPASS || !(object->flags & GN_DRAWN) || info->solid_part_count != info->part_count))
        parts |= GN_LIGHT_CAP;
    *mcguire_case = c.number;
    return parts;
}

/* Planes go the other way: a plane p of view space is p m in object space, row times matrix. */
static void plane_before(double out[4], const double plane[4], const double m[16])
{
    double r[4];

    for (int column = 0; column < 4; column++)
        r[column] = plane[0] * m[4 * column] + plane[1] * m[4 * column + 1] + plane[2] * m[4 * column + 2] +
                    plane[3] * m[4 * column + 3];
    memcpy(out, r, sizeof r);
}

/* One closed volume: the casting triangles of one end, a plane (view space) or a reach; a record for each chunk that
 * has any of it. Everything is extruded in view space: no inverse of the model matrix is needed. */
static void add_records(draft *d, uint32_t light, uint32_t object_index, const int8_t *casting,
                        const double light_view[4], gn_far far_end, const double end_plane[4], double reach)
{
    const gn_object *object = &d->scene->objects[object_index];
    const gn_mesh *mesh = object->mesh;
    int mcguire_case;
    const unsigned parts = choose_parts(d, light, object_index, far_end, &mcguire_case);
    const int converging = far_end != GN_FAR_ENDED && light_view[3] == 0.0;
    double matrix[16], extrusion[16], far_matrix[16], plane_world[4] = {0, 0, 0, 0};

    if (reach > 0.0) {
        gni_extrusion_by(extrusion, light_view, reach);
    } else {
        gni_extrusion(extrusion, light_view, end_plane);
        plane_before(plane_world, end_plane, d->view);
    }
    gni_model_view(matrix, &d->scene->camera, object->model, mesh->info.centre);
    gn_mat4_multiply(far_matrix, d->projection, extrusion);
    gn_mat4_multiply(far_matrix, far_matrix, matrix);
    for (uint32_t c = 0; c < mesh->info.chunk_count; c++) {
        gn_record *r = &d->records[d->plan->record_count];
        gni_stream stream;
        const uint32_t count =
            gni_volume_indices(mesh, c, casting, parts, converging, d->indices + d->plan->index_count, &stream);

        if (count == 0)
            continue;
        memset(r, 0, sizeof *r);
        r->light = light;
        r->object = object_index;
        r->chunk = c;
        r->parts = (stream.sides ? GN_SIDES : 0u) | (stream.dark_cap ? GN_DARK_CAP : 0u) |
                   (stream.light_cap + stream.turned_cap ? GN_LIGHT_CAP : 0u);
        r->first_index = d->plan->index_count;
        r->side_count = stream.sides;
        r->dark_cap_count = stream.dark_cap;
        r->light_cap_count = stream.light_cap;
        r->turned_cap_count = stream.turned_cap;
        r->mcguire_case = mcguire_case;
        r->mirrored = d->objects[object_index].mirrored;
        r->far_end = far_end;
        memcpy(r->end_plane, plane_world, sizeof r->end_plane);
        r->end_reach = reach;
        gn_mat4_to_float(r->far_matrix, far_matrix);
        d->plan->index_count += count;
        d->plan->record_count++;
    }
}

static void add_endless(draft *d, uint32_t light, uint32_t object_index, const double light_view[4], gn_far far_end)
{
    static const double infinity[4] = {0, 0, 0, 1};

    add_records(d, light, object_index, d->casting, light_view, far_end, infinity, 0.0);
}

/* Whether a plane of the camera cuts the object's box. Its surfaces are clipped there; drawn under depth clamp they would
 * not be, and their depths would be others by more than a step: its light cap would shadow it. */
static int is_cut(const draft *d, uint32_t object_index)
{
    const gn_camera *camera = &d->scene->camera;
    const gn_object *object = &d->scene->objects[object_index];
    const gn_mesh_info *info = &object->mesh->info;
    double nearest = INFINITY, farthest = -INFINITY, model_view[16];

    gni_model_view(model_view, camera, object->model, info->centre);
    for (int corner = 0; corner < 8; corner++) {
        double p[3];

        for (int axis = 0; axis < 3; axis++)
            p[axis] = (double)(corner >> axis & 1 ? info->box_max[axis] : info->box_min[axis]);
        gn_mat4_transform(p, model_view, p, 1.0);
        nearest = fmin(nearest, -p[2]);
        farthest = fmax(farthest, -p[2]);
    }
    return (nearest <= camera->znear * (1.0 + 1e-6) && farthest >= camera->znear * (1.0 - 1e-6)) ||
           (camera->finite_far && nearest <= camera->zfar * (1.0 + 1e-6) && farthest >= camera->zfar * (1.0 - 1e-6));
}

/* Nothing ends the volume: an orthographic camera's is left out with a warning, since a light among casters must not stop
 * the frame; elsewhere depth clamp does where it can, or the frame is refused. */
static gn_result clamp_or_refuse(draft *d, uint32_t light, uint32_t object, const double light_view[4])
{
    const gn_camera *camera = &d->scene->camera;
    const gn_target *target = &d->scene->target;
    const int clamps = gn_target_can(target, GN_CAN_DEPTH_CLAMP);

    if (camera->orthographic) {
        d->plan->endless_casters++;
        return GN_OK;
    }
    if (clamps && !is_cut(d, object)) {
        add_endless(d, light, object, light_view, GN_FAR_CLAMPED);
        return GN_OK;
    }
    if (camera->finite_far)
        return gn_fail(
            d->context, GN_E_DEVICE,
            "object %lu, light %lu: no end of the volume lies before the far plane at %g, and depth-clamp %s",
            (unsigned long)object, (unsigned long)light, camera->zfar,
            clamps ? "is no help where a plane of the camera cuts the object"
                   : gni_why_not(target, GN_CAN_DEPTH_CLAMP));
    return gn_fail(
        d->context, GN_E_DEVICE,
        "object %lu, light %lu: the light touches the object, its volume has no end; w0 %s, and depth-clamp %s",
        (unsigned long)object, (unsigned long)light, gni_why_not(target, GN_CAN_W0),
        clamps ? "is no help where a plane of the camera cuts the object" : gni_why_not(target, GN_CAN_DEPTH_CLAMP));
}

/* A caster's volumes, one for each end. */
static gn_result add_ended(draft *d, uint32_t light, uint32_t object_index, const double light_view[4])
{
    const gn_object *object = &d->scene->objects[object_index];
    const gn_mesh *mesh = object->mesh;
    double model_view[16];

    gni_model_view(model_view, &d->scene->camera, object->model, mesh->info.centre);
    if (!gni_choose_ends(d->ends, d->region, mesh, model_view, light_view, d->casting, d->end_of))
        return clamp_or_refuse(d, light, object_index, light_view);
    for (uint32_t p = 0; p < d->ends->count; p++) {
        int any = 0;

        for (uint32_t t = 0; t < mesh->info.triangle_count; t++) {
            d->group[t] = d->end_of[t] == p ? d->casting[t] : 0;
            any |= d->group[t];
        }
        if (any)
            add_records(d, light, object_index, d->group, light_view, GN_FAR_ENDED, d->ends->planes[p], d->ends->reach);
    }
    return GN_OK;
}

static gn_result add_volumes(draft *d, uint32_t light)
{
    const gn_stencil_layout *layout = &d->plan->stencil;
    gn_plan_light *about = &d->lights[light];
    gn_result result = GN_OK;
    uint64_t casting = 0;
    double light_view[4], model_view[16];

    light_in_view(d, &d->scene->lights[light], light_view);
    for (uint32_t i = 0; i < d->scene->object_count && result == GN_OK; i++) {
        const gn_object *object = &d->scene->objects[i];
        const uint32_t before = d->plan->record_count;

        if (!(object->flags & GN_CASTS))
            continue;
        gni_model_view(model_view, &d->scene->camera, object->model, object->mesh->info.centre);
        if (about->method == GN_METHOD_STENCIL) {
            gni_find_case(&d->at_hand, &d->view_of_camera, &object->mesh->info, model_view, light_view);
            if (!(d->at_hand.seen & 4))
                continue;
        }
        gn_object_casting(object, &d->scene->lights[light], d->casting);
        for (uint32_t t = 0; !layout->wrap && t < object->mesh->info.triangle_count; t++)
            casting += d->casting[t] != 0;
        if (gni_must_end(d->scene))
            result = add_ended(d, light, i, light_view);
        else
            add_endless(d, light, i, light_view, GN_FAR_INFINITE);
        if (d->plan->record_count > before) {
            about->casters++;
            about->cases[d->records[before].mcguire_case - 1]++;
        }
    }
    about->may_overflow = !layout->wrap && casting > (uint64_t)layout->high;
    return result;
}

/* The depth range of an orthographic camera: from znear to behind all that is seen, all casters and all ends. */
static void find_range(draft *d)
{
    const gn_scene *s = d->scene;
    double deepest = d->region->deepest;

    for (uint32_t light = 0; light < s->light_count; light++)
        for (uint32_t i = 0; i < s->object_count; i++) {
            const gn_object *object = &s->objects[i];
            double light_view[4], model_view[16];

            if (!(object->flags & GN_CASTS))
                continue;
            gn_object_casting(object, &s->lights[light], d->casting);
            light_in_view(d, &s->lights[light], light_view);
            gni_model_view(model_view, &s->camera, object->model, object->mesh->info.centre);
            if (gni_choose_ends(d->ends, d->region, object->mesh, model_view, light_view, d->casting, d->end_of))
                deepest = fmax(deepest, d->ends->deepest);
        }
    d->plan->depth_range[0] = s->camera.znear;
    d->plan->depth_range[1] = deepest + (deepest - s->camera.znear) / 1024.0;
    if (!(d->plan->depth_range[1] > d->plan->depth_range[0]))
        d->plan->depth_range[1] = s->camera.znear + 1.0; /* nothing in front of the camera */
}

static void place_objects(draft *d)
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
    }
}

static void add_step(draft *d, gn_step_kind kind, gn_draw draw, uint32_t light, int receivers)
{
    gn_step *step = &d->steps[d->plan->step_count++];

    memset(step, 0, sizeof *step);
    step->kind = kind;
    step->draw = draw;
    step->light = light;
    step->receivers = receivers;
}

static gn_result add_light(draft *d, uint32_t light, int *stencil_used)
{
    const uint32_t first = d->plan->record_count;
    int others = 0;
    gn_result result;

    d->lights[light].method = d->choice.method;
    memcpy(d->lights[light].reason, d->choice.reason, sizeof d->lights[light].reason);
    result = add_volumes(d, light);
    if (result != GN_OK)
        return result;
    if (d->plan->record_count > first) {
        if (*stencil_used)
            add_step(d, GN_STEP_ZERO, GN_DRAW_NOTHING, light, 0);
        add_step(d, GN_STEP_VOLUMES, GN_DRAW_NOTHING, light, 0);
        d->steps[d->plan->step_count - 1].first_record = first;
        d->steps[d->plan->step_count - 1].record_count = d->plan->record_count - first;
    } else if (*stencil_used) {
        add_step(d, GN_STEP_ZERO, GN_DRAW_NOTHING, light, 0);
    }
    *stencil_used = d->plan->record_count > first;
    add_step(d, GN_STEP_DRAW, GN_DRAW_LIGHT, light, 1);
    for (uint32_t i = 0; i < d->scene->object_count; i++)
        others |= !(d->scene->objects[i].flags & GN_RECEIVES);
    if (others)
        add_step(d, GN_STEP_DRAW, GN_DRAW_LIGHT, light, 0);
    return GN_OK;
}

gn_result gn_plan_make(gn_context *context, const gn_scene *scene, void *memory, size_t size, const gn_plan **plan)
{
    static const double identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    static const float no_centre[3] = {0, 0, 0};
    draft d;
    arena a = {memory, 0, 0};
    int stencil_used = 0;
    size_t needed;
    gn_result result;

    if (!context || !scene || !memory || !plan)
        return gn_fail(context, GN_E_ARG, "gn_plan_make: NULL argument");
    if ((uintptr_t)memory % sizeof(double) != 0)
        return gn_fail(context, GN_E_ARG, "gn_plan_make: memory is not aligned to %d bytes", (int)sizeof(double));
    result = check(context, scene);
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
    memset(&d, 0, sizeof d);
    d.context = context;
    d.scene = scene;
    result = gni_choose(context, scene, &d.choice);
    if (result != GN_OK)
        return result;
    lay_out(&d, &a);
    memset(d.plan, 0, sizeof *d.plan);
    memset(d.lights, 0, scene->light_count * sizeof *d.lights);
    d.plan->target = scene->target;
    d.plan->steps = d.steps;
    d.plan->records = d.records;
    d.plan->indices = d.indices;
    d.plan->lights = d.lights;
    d.plan->light_count = scene->light_count;
    d.plan->objects = d.objects;
    d.plan->object_count = scene->object_count;
    d.plan->stencil = d.choice.stencil;
    d.plan->depth_range[0] = scene->camera.znear;
    d.plan->depth_range[1] = scene->camera.finite_far ? scene->camera.zfar : INFINITY;
    if (gni_must_end(scene))
        gni_receiver_region(d.region, scene);
    if (scene->camera.orthographic)
        find_range(&d);
    d.plan->clear_depth = 1.0;
    if (scene->camera.zfar != 0.0 && !scene->camera.finite_far)
        d.plan->clear_depth = gni_depth_of(&scene->camera, d.plan->depth_range, scene->camera.zfar);
    gni_projection(d.projection, &scene->camera, d.plan->depth_range);
    gni_model_view(d.view, &scene->camera, identity, no_centre);
    gni_make_view(&d.view_of_camera, &scene->camera);
    place_objects(&d);
    add_step(&d, GN_STEP_CLEAR, GN_DRAW_NOTHING, 0, 0);
    add_step(&d, GN_STEP_DRAW, GN_DRAW_AMBIENT, 0, 0);
    for (uint32_t light = 0; light < scene->light_count && result == GN_OK; light++)
        result = add_light(&d, light, &stencil_used);
    add_step(&d, GN_STEP_DRAW, GN_DRAW_FINAL, 0, 0);
    if (result == GN_OK)
        *plan = d.plan;
    return result;
}
