/* plan_light.c - one light of a frame: what bounds it, which objects it lights and which of them cast, and its mask
 * (McGuire 2003, section 6, DetermineShadows).
 *
 * *Model only what a scene requires*: the method stencil asks of every light where it is seen, and of every caster
 * whether it is within reach and whether its volume touches anything that receives, is seen and is lit. What is not,
 * costs nothing, and the plan says why.
 *
 * The other methods draw every caster in the whole target: they are what stencil is measured by. */
#include "gni_plan.h"

#include <math.h>
#include <string.h>

void gni_light_in_view(const gn_camera *c, const gn_light *light, double out[4])
{
    const int is_sun = light->kind == GN_LIGHT_DIRECTIONAL;
    double v[3];

    gni_towards(v, light);
    for (int i = 0; i < 3 && !is_sun; i++)
        v[i] = light->position[i] - c->world[12 + i];
    for (int i = 0; i < 3; i++)
        out[i] = c->world[4 * i] * v[0] + c->world[4 * i + 1] * v[1] + c->world[4 * i + 2] * v[2];
    out[3] = is_sun ? 0.0 : 1.0;
}

void gni_no_bounds(gni_bounds *out, const gn_scene *scene, const double light[4])
{
    memset(out, 0, sizeof *out);
    memcpy(out->light, light, sizeof out->light);
    out->reach = INFINITY;
    out->scissor[2] = scene->target.width;
    out->scissor[3] = scene->target.height;
    out->distances[0] = scene->camera.znear;
    out->distances[1] = INFINITY;
}

static int is_exempt(const gn_light *light, uint32_t object)
{
    for (uint32_t i = 0; i < light->exempt_count; i++)
        if (light->exempt[i] == object)
            return 1;
    return 0;
}

/* What the method stencil asks of a caster. */
static gn_skip look_closely(const gni_draft *d, uint32_t object, gni_case *at_hand, gni_extent *extent)
{
    const unsigned all_drawn = GN_DRAWN | GN_DRAWN_BACKS;
    gni_hull volume;
    gni_view view;
    double plane[4];
    int is_flat;

    if (!gni_may_cast(&d->bounds, &d->boxes[object]))
        return GN_SKIP_OUT_OF_REACH;
    gni_volume_hull(&volume, &d->boxes[object], d->bounds.light);
    if (!gni_may_be_seen(&d->seen, &volume))
        return GN_SKIP_OUT_OF_VIEW;
    is_flat = gni_lit_side(d, object, plane);
    for (uint32_t p = 0; p < d->patch_count && d->uses_patches; p++)
        extent->on[p] = gni_cast_on_patch(d, object, &d->patches[p], extent->shadow[p]);
    if (!gni_find_extent(extent, d, object, &volume, is_flat ? plane : NULL))
        return GN_SKIP_NO_RECEIVER;
    gni_make_view(&view, &d->scene->camera, &d->scene->target, extent->image);
    gni_find_case(at_hand, &view, &d->boxes[object], &volume, d->bounds.light);
    at_hand->is_drawn = is_flat || (d->scene->objects[object].flags & all_drawn) == all_drawn;
    return at_hand->seen & GNI_SEES_VOLUME ? GN_SKIP_NOT : GN_SKIP_NO_RECEIVER;
}

/* Why a caster is not drawn; else fills its case and extent. */
static gn_skip look_at(const gni_draft *d, uint32_t object, gni_case *at_hand, gni_extent *extent)
{
    const gn_light *light = &d->scene->lights[d->light];
    const gn_method method = d->lights[d->light].method;
    const unsigned flags = d->scene->objects[object].flags, all_drawn = GN_DRAWN | GN_DRAWN_BACKS;

    memset(extent, 0, sizeof *extent); /* all patches are filled */
    memcpy(extent->scissor, d->lights[d->light].scissor, sizeof extent->scissor);
    memcpy(extent->image, extent->scissor, sizeof extent->image);
    at_hand->is_drawn = (flags & all_drawn) == all_drawn;
    at_hand->number = method == GN_METHOD_ZPASS ? 1 : 3;
    at_hand->seen = GNI_SEES_CASTER | GNI_SEES_FAR | GNI_SEES_VOLUME;
    if (!(flags & GN_CASTS))
        return GN_SKIP_NO_CASTER;
    if (is_exempt(light, object))
        return GN_SKIP_EXEMPT;
    return gni_models_less(method) ? look_closely(d, object, at_hand, extent) : GN_SKIP_NOT;
}

/* Records of all casters, in one batch or in as many as it takes. */
static gn_result add_casters(gni_draft *d)
{
    gn_plan_light *about = &d->lights[d->light];
    gn_result result = GN_OK;

    about->casters = about->skipped_casters = 0;
    memset(about->cases, 0, sizeof about->cases);
    d->flat_count = 0;
    d->casting_count = d->cheap_layers = 0;
    for (uint32_t i = 0; i < d->scene->object_count && result == GN_OK; i++) {
        gn_plan_caster *caster = &d->casters[(size_t)d->light * d->scene->object_count + i];
        const uint32_t before = d->plan->record_count, flats = d->flat_count;
        gni_case at_hand;
        gni_extent extent;

        caster->mcguire_case = caster->parts = caster->fan = caster->is_ended = caster->patches = 0;
        caster->skip = (uint8_t)look_at(d, i, &at_hand, &extent);
        for (uint32_t p = 0; GNI_HAS_CULLING && p < d->patch_count; p++)
            caster->patches |= (uint8_t)((extent.on[p] == GNI_FANS_PATCH) << p);
        d->is_in[i] &= (uint8_t)~GNI_IN_CAST;
        if (gni_has_layers(d))
            d->cheap_of[i] = 0;
        d->slot = NULL;
        d->casting_is_known = 0;
        if (GNI_HAS_CACHE && (caster->skip == GN_SKIP_NOT || caster->patches))
            d->slot = gni_find_slot(d, i);
        if (caster->skip == GN_SKIP_NOT)
            result = gni_add_caster(d, i, &at_hand, &extent);
        if (GNI_HAS_CULLING && caster->patches)
            gni_add_flats(d, i, &extent, before);
        if (d->plan->record_count > before || d->flat_count > flats) {
            const gn_object *object = &d->scene->objects[i];

            d->is_in[i] |= GNI_IN_CAST;
            if (GNI_HAS_CULLING)
                about->caster_error = fmax(about->caster_error, (object->error + object->mesh->info.weld_error) *
                                                                    gni_stretch(object->model));
            caster->skip = GN_SKIP_NOT;
            about->casters++;
            if (caster->mcguire_case)
                about->cases[caster->mcguire_case - 1]++;
        } else {
            caster->skip = caster->skip == GN_SKIP_NOT ? GN_SKIP_NO_TRIANGLE : caster->skip;
            about->skipped_casters += caster->skip != GN_SKIP_NO_CASTER;
        }
    }
    if (GNI_HAS_CULLING) {
        memcpy(d->records + d->plan->record_count, d->flats, d->flat_count * sizeof *d->flats);
        d->plan->record_count += d->flat_count;
    }
    return result;
}

/* How the light's volumes are counted: 0 with patches, 1 without, 2 in batches. */
static void set_way(gni_draft *d, int way, const gn_stencil_layout *layout)
{
    gn_plan_light *about = &d->lights[d->light];

    about->stencil = *layout;
    d->uses_patches = way == 0;
    d->is_batched = way == 2;
    d->first_of_batch = d->plan->record_count;
    if (way == 0)
        gni_patch_layout(&about->stencil, d->patch_count);
    if (way == 2) {
        gni_split_layout(&about->stencil);
        about->layers = 0;
        memset(&d->layers->batch, 0, sizeof d->layers->batch);
    }
}

/* The steps before the light's volumes: a stencil that is clean where the light is, and patches named in it. */
static void prepare_stencil(gni_draft *d)
{
    if (GNI_HAS_CULLING && d->are_marked && !d->uses_patches) { /* their names are in the bits of the count now */
        d->are_marked = 0;
        d->stain.at[0] = d->stain.at[1] = 0;
        d->stain.at[2] = d->scene->target.width;
        d->stain.at[3] = d->scene->target.height;
    }
    gni_clean_stencil(d, d->light);
    if (gni_uses_patches(d) && !d->are_marked)
        gni_add_step(d, GN_STEP_MARK, GN_DRAW_NOTHING, d->light, 0);
    d->are_marked |= gni_uses_patches(d);
    for (uint32_t p = 0; gni_uses_patches(d) && p < d->patch_count; p++)
        if (d->patches[p].use == GNI_PATCH_DARK) {
            gni_add_step(d, GN_STEP_DARKEN, GN_DRAW_NOTHING, d->light, 0);
            d->steps[d->plan->step_count - 1].patch = p + 1;
        }
}

static int any_is_dark(const gni_draft *d)
{
    for (uint32_t p = 0; GNI_HAS_CULLING && p < d->patch_count; p++)
        if (d->patches[p].use == GNI_PATCH_DARK)
            return 1;
    return 0;
}

/* Whether the counts that were just made surely keep within the layout's bits. */
static int fits(gni_draft *d, uint32_t first_record)
{
    gn_plan_light *about = &d->lights[d->light];
    const uint32_t high = (uint32_t)about->stencil.high;

    about->layers = (uint32_t)(d->cheap_layers < UINT32_MAX ? d->cheap_layers : UINT32_MAX);
    return about->layers <= high || (gni_has_layers(d) && gni_layers_fit(d, high, first_record));
}

/* Volumes in the first of the ways from `way` on by which counts keep within the layout's bits. */
static gn_result add_some_way(gni_draft *d, int way, int *is_long)
{
    gn_plan_light *about = &d->lights[d->light];
    const gn_stencil_layout layout = about->stencil;
    const gni_stain stain = d->stain;
    const int were_marked = d->are_marked;
    const gn_plan plan = *d->plan;
    gn_result result = GN_OK;

    for (; way < 3; way++) {
        set_way(d, way, &layout);
        if (way == 2)
            prepare_stencil(d);
        result = add_casters(d);
        *is_long = !about->stencil.wrap && d->casting_count > (uint64_t)about->stencil.high;
        if (result != GN_OK || way == 2 ||
            (fits(d, plan.record_count) && (way == 1 || d->flat_count || d->are_marked || any_is_dark(d))))
            break;
        if (way == 1 && !gni_has_layers(d)) {
            *is_long |= !GNI_HAS_BATCHES;
            break;
        }
        *d->plan = plan;
        d->stain = stain;
        d->are_marked = were_marked;
    }
    return result;
}

/* Volumes and what they stand on, in one of three ways: with patches, if some is worth it; without; in batches. */
static gn_result add_volumes(gni_draft *d)
{
    const uint32_t record = d->plan->record_count;
    int is_long = 0;
    gn_result result;

    if (GNI_HAS_CULLING) {
        result = add_some_way(d, d->patch_count ? 0 : 1, &is_long);
    } else { /* there is one */
        d->first_of_batch = record;
        result = add_casters(d);
        is_long = !fits(d, record);
    }
    if (!gni_is_batched(d))
        prepare_stencil(d);
    d->plan->warnings |= is_long ? 1u << GN_WARN_OVERFLOW : 0u;
    if (d->plan->record_count > record || d->scene->blend_once || gni_uses_patches(d))
        gni_stain_stencil(d, d->light);
    gni_end_batch(d, 0);
    return result;
}

/* A channel of a mask for the light; its texture is cleared with the first. */
static void take_channel(gni_draft *d)
{
    gn_plan_light *about = &d->lights[d->light];
    const uint32_t index = d->mask_count++;

    about->mask_texture = index / d->choice.lights_per_mask + (gni_is_refined(d) ? 1 : 0);
    about->mask_channel = index % d->choice.lights_per_mask;
    if (about->mask_channel == 0)
        gni_start_mask(d);
    if (about->color.place == GN_PLACE_COLOR)
        gni_choose_channel(d->scene, &about->color, about->mask_channel);
}

/* Volumes counted in colour. A light without any leaves its mask as it was cleared; alpha and colour are set. */
static gn_result add_colored(gni_draft *d)
{
    gn_plan_light *about = &d->lights[d->light];
    const uint32_t step = d->plan->step_count, record = d->plan->record_count;
    const int is_image = about->color.place == GN_PLACE_IMAGE;
    gn_result result;

    d->first_of_batch = record;
    gni_start_color(d);
    if (!is_image || d->image_is_used || gni_carries_depth(d->scene))
        gni_add_step(d, GN_STEP_ZERO, GN_DRAW_NOTHING, d->light, 0);
    result = add_casters(d);
    if (d->plan->record_count == record) {
        d->plan->step_count = is_image ? step : d->plan->step_count;
        if (about->color.place == GN_PLACE_ALPHA)
            d->steps[step].kind = GN_STEP_OPAQUE;
        return result;
    }
    d->image_is_used = 1;
    gni_end_batch(d, 0);
    if (about->color.place == GN_PLACE_ALPHA)
        gni_add_step(d, GN_STEP_NORMALISE, GN_DRAW_NOTHING, d->light, 0);
    return result;
}

/* The light's mask. One that nothing shadows has none: its steps are taken back. */
static gn_result add_mask(gni_draft *d)
{
    gn_plan_light *about = &d->lights[d->light];
    const uint32_t first = d->plan->step_count, record = d->plan->record_count;
    const gni_stain stain = d->stain;
    const int were_marked = d->are_marked, are_textures = gni_makes_textures(d);
    uint32_t step;
    gn_result result;

    if (are_textures)
        take_channel(d);
    step = d->plan->step_count;
    result = gni_is_colored(d) ? add_colored(d) : add_volumes(d);
    about->is_shadowed = d->plan->record_count > record || (gni_uses_patches(d) && any_is_dark(d));
    if (!are_textures)
        return result;
    if (about->is_shadowed && !gni_is_colored(d) && d->plan->step_count > step)
        gni_add_step(d, GN_STEP_RESOLVE, GN_DRAW_NOTHING, d->light, 0);
    if (about->is_shadowed)
        return result;
    d->plan->step_count = first;
    d->stain = stain;
    d->are_marked = were_marked;
    d->mask_count--;
    about->mask_texture = GN_NO_MASK;
    return result;
}

/* What the light can lighten, and the most that it adds to any of it. */
static double find_lit(gni_draft *d, int *any_receiver, int *any_other)
{
    const gn_scene *s = d->scene;
    double most = 0.0, low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};

    *any_receiver = !d->receivers_are_known || !gni_models_less(d->lights[d->light].method);
    *any_other = 0;
    for (uint32_t i = 0; i < s->object_count; i++) {
        const gn_object *object = &s->objects[i];
        gn_plan_caster *caster = &d->casters[(size_t)d->light * s->object_count + i];

        memset(caster, 0, sizeof *caster);
        caster->skip = object->flags & GN_CASTS ? GN_SKIP_NO_RECEIVER : GN_SKIP_NO_CASTER;
        caster->is_lit = !gni_models_less(d->lights[d->light].method) ||
                         (gni_may_be_seen(&d->seen, &d->boxes[i]) && gni_may_be_lit(&d->bounds, &d->boxes[i]));
        d->is_in[i] = caster->is_lit ? GNI_IN_LIT : 0;
        if (!caster->is_lit)
            continue;
        *any_receiver |= (object->flags & GN_RECEIVES) != 0;
        *any_other |= !(object->flags & GN_RECEIVES);
        if (!GNI_HAS_CULLING)
            continue;
        most = fmax(most, gni_most_light(&d->bounds, &s->lights[d->light], &d->boxes[i]));
        for (int corner = 0; corner < 8 && object->flags & GN_RECEIVES; corner++)
            for (int axis = 0; axis < 3; axis++) {
                low[axis] = fmin(low[axis], d->boxes[i].points[corner][axis]);
                high[axis] = fmax(high[axis], d->boxes[i].points[corner][axis]);
            }
    }
    if (GNI_HAS_CULLING && low[0] <= high[0])
        gni_hull_around(&d->all_lit, low, high);
    return *any_receiver && !d->receivers_are_known ? INFINITY : most;
}

/* Window depths that the stencil's and the light's passes are kept to: a step of 16 bits more on either side. */
static void find_depth_bounds(const gni_draft *d, gn_plan_light *about)
{
    const gn_camera *camera = &d->scene->camera;

    about->depth_bounds[0] = 0.0;
    about->depth_bounds[1] = 1.0;
    if (!GNI_HAS_CULLING || !gn_target_can(&d->scene->target, GN_CAN_DEPTH_BOUNDS))
        return;
    for (int i = 0; i < 2; i++)
        if (isfinite(d->bounds.distances[i])) {
            const double depth = gni_depth_of(camera, d->plan->depth_range, d->bounds.distances[i]);

            about->depth_bounds[i] = fmin(fmax(depth + (i ? 2.0 : -2.0) / 65536.0, 0.0), 1.0);
        }
}

static gn_result skip_light(gni_draft *d, gn_skip why)
{
    gn_plan_light *about = &d->lights[d->light];

    about->skip = why;
    memset(about->scissor, 0, sizeof about->scissor);
    for (uint32_t i = 0; i < d->scene->object_count; i++) {
        gn_plan_caster *caster = &d->casters[(size_t)d->light * d->scene->object_count + i];

        memset(caster, 0, sizeof *caster);
        caster->skip = d->scene->objects[i].flags & GN_CASTS ? GN_SKIP_LIGHT : GN_SKIP_NO_CASTER;
        about->skipped_casters += caster->skip == GN_SKIP_LIGHT;
    }
    return GN_OK;
}

gn_result gni_add_light(gni_draft *d, uint32_t light)
{
    const gn_scene *s = d->scene;
    gn_plan_light *about = &d->lights[light];
    int any_receiver, any_other;
    double at[4], most;
    gn_result result = GN_OK;

    d->light = light;
    about->method = d->choice.method;
    about->stencil = d->choice.stencil;
    about->color = d->choice.color;
    if (GNI_HAS_MESSAGES)
        memcpy(about->reason, d->choice.reason, sizeof about->reason);
    gni_light_in_view(&d->scene->camera, &s->lights[light], at);
    if (gni_models_less(about->method) && gni_is_additive(d))
        gni_find_bounds(&d->bounds, s, light, at, d->view);
    else
        gni_no_bounds(&d->bounds, s, at);
    about->reach = d->bounds.reach;
    if (GNI_HAS_CULLING && d->bounds.skip != GN_SKIP_NOT)
        return skip_light(d, d->bounds.skip);
    memcpy(about->scissor, d->bounds.scissor, sizeof about->scissor);
    if (GNI_HAS_CULLING)
        gni_make_view(&d->seen, &s->camera, &s->target, about->scissor);
    most = find_lit(d, &any_receiver, &any_other);
    if (gni_models_less(about->method)) {
        if (!any_receiver && !any_other)
            return skip_light(d, GN_SKIP_NO_RECEIVER);
        if (most <= s->least_light) {
            about->possible_error = most;
            return skip_light(d, GN_SKIP_UNIMPORTANT);
        }
    }
    find_depth_bounds(d, about);
    if (GNI_HAS_CULLING)
        gni_light_patches(d);
    d->draws[light] = (uint8_t)((any_receiver ? GNI_DRAWS_RECEIVERS : 0) | (any_other ? GNI_DRAWS_OTHERS : 0));
    if (any_receiver && !(GNI_HAS_CACHE && d->reuses_masks))
        result = add_mask(d);
    else if (GNI_HAS_CACHE && any_receiver)
        d->must_remake |= !gni_take_kept_mask(d);
    return result;
}
