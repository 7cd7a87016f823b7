/* kept_masks.c - masks in textures that are used again: made anew in every n-th frame only, and as they are in between,
 * wherever camera, lights and casters have gone meanwhile. A choice (gn_shadow_cache_desc.masks_every), and not exact: the
 * plan says how many frames old they are.
 *
 * What a later frame must know of them is which light's is where. They are made anew, too, when the frame is of another
 * size or kind, and when a light is seen that was not when they were made: nothing is known of its shadows. */
#include "gni_plan.h"

#include <string.h>

#define UNKNOWN (GN_NO_MASK - 1u)

int gni_keeps_masks(const gn_scene *s)
{
    return s->cache && s->cache->desc.masks_every > 1;
}

int gni_may_reuse_masks(const gni_draft *d)
{
    const gn_plan *plan = d->plan;
    const gni_kept_masks *k;

    if (!gni_keeps_masks(d->scene) || plan->mask != GN_MASK_TEXTURE)
        return 0;
    k = &d->scene->cache->masks;
    return k->version != 0 && k->age + 1 < d->scene->cache->desc.masks_every && k->light_count == plan->light_count &&
           k->format == plan->mask_format && k->upsample == plan->upsample && k->method == d->choice.method &&
           memcmp(k->size, plan->mask_size, sizeof k->size) == 0 && k->lights_per_mask == d->choice.lights_per_mask &&
           memcmp(&k->image, &plan->image, sizeof k->image) == 0;
}

int gni_take_kept_mask(gni_draft *d)
{
    const gni_kept_masks *k = &d->scene->cache->masks;
    gn_plan_light *about = &d->lights[d->light];

    if (k->lights[d->light][0] == UNKNOWN)
        return 0;
    about->mask_texture = k->lights[d->light][0];
    about->mask_channel = k->lights[d->light][1];
    about->is_shadowed = about->mask_texture != GN_NO_MASK;
    for (uint32_t i = 0; i < d->scene->object_count; i++) {
        gn_plan_caster *caster = &d->casters[(size_t)d->light * d->scene->object_count + i];

        caster->skip = d->scene->objects[i].flags & GN_CASTS ? GN_SKIP_KEPT : GN_SKIP_NO_CASTER;
        about->skipped_casters += caster->skip == GN_SKIP_KEPT;
    }
    return 1;
}

void gni_reuse_masks(gni_draft *d)
{
    gni_kept_masks *k = &d->scene->cache->masks;

    d->plan->mask_age = ++k->age;
    d->plan->mask_version = k->version;
    d->plan->mask_count = k->mask_count;
    memcpy(d->plan->mask_depth, k->depth, sizeof k->depth);
}

void gn_shadow_cache_forget_masks(gn_shadow_cache *cache)
{
    if (cache)
        cache->masks.light_count = UINT32_MAX; /* like no frame's */
}

/* Room for so many lights; 0 without memory. */
static int grow(gn_shadow_cache *cache, uint32_t count)
{
    gni_kept_masks *k = &cache->masks;

    if (count <= k->capacity)
        return 1;
    gni_free(cache->context, k->lights);
    k->lights = gni_alloc(cache->context, count, sizeof *k->lights);
    k->capacity = k->lights ? count : 0;
    return k->lights != NULL;
}

void gni_note_masks(gni_draft *d)
{
    const gn_plan *plan = d->plan;
    gni_kept_masks *k;

    if (!gni_keeps_masks(d->scene))
        return;
    k = &d->scene->cache->masks;
    k->age = 0;
    k->version++;
    if (plan->mask != GN_MASK_TEXTURE || plan->mask_count == 0 || !grow(d->scene->cache, plan->light_count)) {
        gn_shadow_cache_forget_masks(d->scene->cache);
        return;
    }
    k->method = d->choice.method;
    k->format = plan->mask_format;
    k->image = plan->image;
    k->upsample = plan->upsample;
    k->lights_per_mask = d->choice.lights_per_mask;
    k->light_count = plan->light_count;
    k->mask_count = plan->mask_count;
    memcpy(k->size, plan->mask_size, sizeof k->size);
    memcpy(k->depth, plan->mask_depth, sizeof k->depth);
    for (uint32_t i = 0; i < plan->light_count; i++) {
        const gn_plan_light *l = &plan->lights[i];
        const int is_known = l->skip == GN_SKIP_NOT && d->draws[i] & GNI_DRAWS_RECEIVERS;

        k->lights[i][0] = !is_known ? UNKNOWN : l->is_shadowed ? l->mask_texture : GN_NO_MASK;
        k->lights[i][1] = l->mask_channel;
    }
    d->plan->mask_version = k->version;
}
