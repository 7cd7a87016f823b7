/* cache.c - index streams that stay from frame to frame (Hoxley 2003, caching of volumes).
 *
 * Which triangles of a caster cast, and where they end, is a matter of the light as the caster's mesh sees it, and of
 * nothing else: not of the camera. So a stream is kept for each light and object with the light's place in the space of
 * the mesh, and used again while that is the same, or, if the caller wants that, nearly or lately the same; then the
 * plan says how far the light has moved meanwhile. A stream is made on the second frame in which nothing has changed,
 * so that what moves costs nothing here; with looser rules at once.
 *
 * A stream has, chunk by chunk, all parts of the volume in the order light cap, sides, dark cap, near cap, turned
 * light cap: each record is a run of it. Room is taken from one array from its front; a stream that is made anew
 * keeps its room if it fits. When the array is full all is dropped, and it grows: in frames to come all that stays is
 * made again. */
#include "gni_plan.h"

#include <math.h>
#include <string.h>

#define FIRST_ROOM 65536u /* indices */

static void drop_all(gn_shadow_cache *cache)
{
    for (uint32_t i = 0; i < cache->slot_count; i++)
        for (int kind = 0; kind < GNI_STREAM_KINDS; kind++)
            cache->slots[i].streams[kind].room = cache->slots[i].streams[kind].count = 0;
    cache->used = 0;
}

gn_result gn_shadow_cache_create(gn_context *context, const gn_shadow_cache_desc *desc, gn_shadow_cache **out)
{
    gn_shadow_cache *cache;

    if (out)
        *out = NULL;
    if (!context || !desc || !out)
        return gn_fail(context, GN_E_ARG, "gn_shadow_cache_create: NULL argument");
    if (!(desc->update_distance >= 0.0 && isfinite(desc->update_distance)))
        return gn_fail(context, GN_E_ARG, "gn_shadow_cache_create: update distance of %g", desc->update_distance);
    cache = gni_alloc(context, 1, sizeof *cache);
    if (!cache)
        return gn_fail(context, GN_E_MEMORY, "gn_shadow_cache_create: no memory");
    memset(cache, 0, sizeof *cache);
    cache->context = context;
    cache->id = ++context->caches;
    cache->desc = *desc;
    *out = cache;
    return GN_OK;
}

void gn_shadow_cache_destroy(gn_shadow_cache *cache)
{
    if (!cache)
        return;
    gni_free(cache->context, cache->slots);
    gni_free(cache->context, cache->masks.lights);
    gni_free(cache->context, cache->indices);
    gni_free(cache->context, cache);
}

/* Room for so many slots. Without memory there are as many as before. */
static void grow_slots(gn_shadow_cache *cache, uint32_t count)
{
    gni_slot *slots;

    if (count <= cache->slot_count)
        return;
    slots = gni_alloc(cache->context, count, sizeof *slots);
    if (!slots)
        return;
    memset(slots, 0, count * sizeof *slots);
    gni_free(cache->context, cache->slots);
    cache->slots = slots;
    cache->slot_count = count;
    cache->used = 0;
}

void gni_start_cache(gn_shadow_cache *cache, const gn_scene *scene)
{
    const uint64_t needed = (uint64_t)scene->light_count * scene->object_count;

    cache->frame++;
    if (needed > UINT32_MAX)
        return;
    if (cache->object_count != scene->object_count) { /* slots mean other pairs now */
        cache->object_count = scene->object_count;
        drop_all(cache);
        if (cache->slots)
            memset(cache->slots, 0, cache->slot_count * sizeof *cache->slots);
    }
    grow_slots(cache, (uint32_t)needed);
    if (cache->wanted > cache->capacity) {
        uint16_t *indices = gni_alloc(cache->context, cache->wanted, sizeof *indices);

        if (indices) {
            gni_free(cache->context, cache->indices);
            cache->indices = indices;
            cache->capacity = cache->wanted;
            drop_all(cache);
        }
        cache->wanted = cache->capacity;
    }
    cache->base_version = cache->version;
    cache->dirty[0] = UINT32_MAX;
    cache->dirty[1] = 0;
    cache->built = 0;
}

/* How far a light has moved, as the caster sees it, in the world's lengths; of a directional light, at distance 1. */
static double distance_between(const double a[4], const double b[4], double stretch)
{
    double square = 0.0, of_a = 1.0, of_b = 1.0;

    if (a[3] != b[3])
        return INFINITY;
    if (a[3] == 0.0) {
        of_a = sqrt(gni_dot(a, a));
        of_b = sqrt(gni_dot(b, b));
        stretch = 1.0;
    }
    for (int k = 0; k < 3; k++)
        square += (a[k] / of_a - b[k] / of_b) * (a[k] / of_a - b[k] / of_b);
    return sqrt(square) * stretch;
}

gni_slot *gni_find_slot(gni_draft *d, uint32_t object_index)
{
    gn_shadow_cache *cache = d->scene->cache;
    const gn_object *object = &d->scene->objects[object_index];
    const uint64_t at = (uint64_t)d->light * d->scene->object_count + object_index;
    gni_slot *slot;
    double light[4], moved;
    int is_same, is_loose;

    if (!cache || at >= cache->slot_count || d->is_batched || d->region ||
        object->mesh->info.chunk_count > GNI_CACHED_CHUNKS ||
        !gni_light_in_object(&d->scene->lights[d->light], object, light))
        return NULL;
    slot = &cache->slots[at];
    is_loose = cache->desc.update_every > 1 || cache->desc.update_distance > 0.0;
    is_same = slot->mesh == object->mesh && slot->shape == object->mesh->info.shape &&
              memcmp(slot->light, light, sizeof light) == 0;
    moved = slot->mesh == object->mesh && slot->shape == object->mesh->info.shape
                ? distance_between(slot->light, light, gni_stretch(object->model))
                : INFINITY;
    if (is_same || (slot->is_made && is_loose && isfinite(moved) &&
                    (cache->desc.update_every <= 1 || cache->frame - slot->made < cache->desc.update_every) &&
                    (cache->desc.update_distance == 0.0 || moved <= cache->desc.update_distance))) {
        if (!slot->is_made && slot->made == cache->frame && !is_loose) /* a plan asks again when counts do not fit */
            return NULL;
        if (slot->is_made && !is_same)
            d->lights[d->light].light_moved = fmax(d->lights[d->light].light_moved, moved);
        return slot;
    }
    for (int kind = 0; kind < GNI_STREAM_KINDS; kind++)
        slot->streams[kind].count = 0;
    slot->mesh = object->mesh;
    slot->shape = object->mesh->info.shape;
    memcpy(slot->light, light, sizeof light);
    slot->is_made = 0;
    slot->made = cache->frame;
    return is_loose ? slot : NULL; /* else it must stay for a frame first */
}

uint16_t *gni_take_room(gn_shadow_cache *cache, gni_stream *stream, uint32_t most)
{
    if (most <= stream->room)
        return cache->indices + stream->first;
    if (most > cache->capacity - cache->used || !cache->indices) {
        const uint64_t wanted = 2 * ((uint64_t)cache->capacity + most) + FIRST_ROOM;

        if (wanted < UINT32_MAX / 2 && wanted > cache->wanted)
            cache->wanted = (uint32_t)wanted; /* from the next frame on */
        return NULL;
    }
    stream->first = cache->used;
    stream->room = most;
    cache->used += most;
    return cache->indices + stream->first;
}

void gni_note_change(gn_shadow_cache *cache, const gni_stream *stream)
{
    if (cache->version == cache->base_version)
        cache->version++;
    cache->dirty[0] = cache->dirty[0] < stream->first ? cache->dirty[0] : stream->first;
    cache->dirty[1] = cache->dirty[1] > stream->first + stream->count ? cache->dirty[1] : stream->first + stream->count;
    cache->built++;
}

void gni_end_cache(const gn_shadow_cache *cache, gn_plan *plan)
{
    plan->cache_id = cache->id;
    plan->cached_indices = cache->indices;
    plan->cached_index_count = cache->used;
    plan->cached_capacity = cache->capacity;
    plan->cache_version = cache->version;
    plan->cache_base = cache->base_version;
    plan->cache_changed[0] = cache->dirty[0] < cache->dirty[1] ? cache->dirty[0] : 0;
    plan->cache_changed[1] = cache->dirty[1];
    plan->cache_built = cache->built;
}
