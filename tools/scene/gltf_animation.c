/* gltf_animation.c - keys of all channels of all animations, which play together from time 0.
 *
 * Each channel gets its own copy of its sampler's keys: channels share samplers rarely, and a copy needs no owner. */
#include "gltf.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int read_times(gltf *g, const char *where, int accessor, scene_channel *c)
{
    gltf_accessor a;

    if (!gltf_open_accessor(g, where, "input", accessor, GLTF_WIDE(1) | GLTF_FLOAT, GLTF_VERTICES_MAX, &a))
        return 0;
    c->times = gltf_read_floats(g, &a);
    if (!c->times)
        return 0;
    c->count = a.count;
    for (size_t k = 0; k < c->count; k++) {
        if (!isfinite(c->times[k]))
            return gltf_fail(g, "%s: the time of key %lu is not finite", where, (unsigned long)k);
        if (k && c->times[k] < c->times[k - 1])
            return gltf_fail(g, "%s: key %lu at %g s is before the one at %g s", where, (unsigned long)k,
                             (double)c->times[k], (double)c->times[k - 1]);
    }
    return 1;
}

static int read_values(gltf *g, const char *where, int accessor, scene_channel *c)
{
    const unsigned allowed = c->path == SCENE_ROTATION
                                 ? GLTF_WIDE(4) | GLTF_FLOAT | GLTF_SMALL_INTEGERS | GLTF_NORMALIZED
                                 : GLTF_WIDE(3) | GLTF_FLOAT;
    const size_t width = c->path == SCENE_ROTATION ? 4 : 3, parts = c->steps == SCENE_CUBIC ? 3 : 1;
    gltf_accessor a;

    if (!gltf_open_accessor(g, where, "output", accessor, allowed, 3 * (size_t)GLTF_VERTICES_MAX, &a))
        return 0;
    if (a.count != parts * c->count)
        return gltf_fail(g, "%s: %lu output values for %lu keys, not %lu", where, (unsigned long)a.count,
                         (unsigned long)c->count, (unsigned long)(parts * c->count));
    c->values = gltf_read_floats(g, &a);
    if (!c->values)
        return 0;
    for (size_t i = 0; i < a.count * width; i++)
        if (!isfinite(c->values[i]))
            return gltf_fail(g, "%s: output value %lu is not finite", where, (unsigned long)(i / width));
    for (size_t k = 0; width == 4 && k < c->count; k++) {
        const float *q = c->values + (k * parts + parts / 2) * 4;
        const double length =
            sqrt((double)q[0] * q[0] + (double)q[1] * q[1] + (double)q[2] * q[2] + (double)q[3] * q[3]);

        if (!(length > 1e-6 && length < 1e6))
            return gltf_fail(g, "%s: the rotation of key %lu has length %g", where, (unsigned long)k, length);
    }
    return 1;
}

static int read_sampler(gltf *g, const char *where, const cJSON *sampler, scene_channel *c)
{
    const char *steps = gltf_get_string(sampler, "interpolation");
    int input = SCENE_NONE, output = SCENE_NONE;

    if (!gltf_get_index(g, where, sampler, "input", GLTF_ACCESSOR, &input) ||
        !gltf_get_index(g, where, sampler, "output", GLTF_ACCESSOR, &output))
        return 0;
    if (input == SCENE_NONE || output == SCENE_NONE)
        return gltf_fail(g, "%s: its sampler has no %s", where, input == SCENE_NONE ? "input" : "output");
    if (!steps || strcmp(steps, "LINEAR") == 0)
        c->steps = SCENE_LINEAR;
    else if (strcmp(steps, "STEP") == 0)
        c->steps = SCENE_STEP;
    else if (strcmp(steps, "CUBICSPLINE") == 0)
        c->steps = SCENE_CUBIC;
    else
        return gltf_fail(g, "%s: interpolation is %.40s", where, steps);
    return read_times(g, where, input, c) && read_values(g, where, output, c);
}

/* What a channel moves. *moves becomes 0 where it moves nothing of ours. */
static int read_target(gltf *g, const char *where, const cJSON *channel, scene_channel *c, int *moves)
{
    const cJSON *target = gltf_get(channel, "target");
    const char *path = gltf_get_string(target, "path");

    *moves = 1;
    if (!path)
        return gltf_fail(g, "%s: target.path is missing", where);
    if (strcmp(path, "weights") == 0)
        return gltf_fail(g, "%s: morph targets (weights) are not supported", where);
    if (!gltf_get_index(g, where, target, "node", GLTF_NODE, &c->node))
        return 0;
    if (strcmp(path, "translation") == 0)
        c->path = SCENE_TRANSLATION;
    else if (strcmp(path, "rotation") == 0)
        c->path = SCENE_ROTATION;
    else if (strcmp(path, "scale") == 0)
        c->path = SCENE_SCALE;
    else if (gltf_get(target, "extensions"))
        *moves = 0;
    else
        return gltf_fail(g, "%s: target path is %.40s", where, path);
    if (c->node == SCENE_NONE)
        *moves = 0;
    if (!*moves)
        gltf_warn(g, "%s: skipped: its target is none of a node's (%.40s)", where, path);
    return 1;
}

static int read_channel(gltf *g, scene *s, const char *where, const cJSON *json, const cJSON *samplers)
{
    scene_channel *c = &s->animation->channels[s->animation->count];
    const cJSON *item, *found = NULL;
    size_t sampler = SIZE_MAX, count = 0;
    int moves;

    c->node = SCENE_NONE;
    if (!read_target(g, where, json, c, &moves))
        return 0;
    if (!moves)
        return 1;
    if (s->nodes[c->node].has_matrix)
        return gltf_fail(g, "%s: node %d has a matrix, and may not be animated", where, c->node);
    if (!gltf_get_size(g, where, json, "sampler", &sampler))
        return 0;
    cJSON_ArrayForEach (item, samplers) {
        if (count++ == sampler)
            found = item;
    }
    if (!found)
        return gltf_fail(g, "%s: there is no sampler %.0f (the animation has %lu)", where,
                         sampler == SIZE_MAX ? -1.0 : (double)sampler, (unsigned long)count);
    s->animation->count++; /* from here on scene_free() frees its keys */
    if (!read_sampler(g, where, found, c))
        return 0;
    s->nodes[c->node].moves = 1;
    if (c->times[c->count - 1] > s->duration)
        s->duration = c->times[c->count - 1];
    return 1;
}

/* A node that is called static, but is animated or hangs under one that is, counts as moving. */
static void check_static(gltf *g, scene *s)
{
    for (size_t i = 0; i < s->instance_count; i++) {
        scene_instance *instance = &s->instances[i];
        int n = instance->node;

        while (instance->is_static && n != SCENE_NONE && !s->nodes[n].moves)
            n = s->nodes[n].parent;
        if (instance->is_static && n != SCENE_NONE) {
            gltf_warn(g, "node %d is called static, but node %d is animated: it counts as moving", instance->node, n);
            instance->is_static = 0;
        }
    }
}

int gltf_read_animations(gltf *g, scene *s)
{
    const gltf_list *list = &g->lists[GLTF_ANIMATION];
    const cJSON *channels, *samplers, *item;
    size_t count = 0;
    char where[GLTF_WHERE];

    for (size_t i = 0; i < list->count; i++) {
        snprintf(where, sizeof where, "animation %lu", (unsigned long)i);
        if (!gltf_get_array(g, where, list->items[i], "channels", &channels) ||
            !gltf_get_array(g, where, list->items[i], "samplers", &samplers))
            return 0;
        cJSON_ArrayForEach (item, channels)
            count++;
    }
    if (count == 0)
        return 1;
    s->animation = gltf_alloc_zeroed(g, 1, sizeof *s->animation);
    if (!s->animation)
        return 0;
    s->animation->channels = gltf_alloc_zeroed(g, count, sizeof *s->animation->channels);
    if (!s->animation->channels)
        return 0;
    for (size_t i = 0; i < list->count; i++) {
        size_t n = 0;

        samplers = gltf_get(list->items[i], "samplers");
        channels = gltf_get(list->items[i], "channels");
        cJSON_ArrayForEach (item, channels) {
            snprintf(where, sizeof where, "animation %lu channel %lu", (unsigned long)i, (unsigned long)n++);
            if (!read_channel(g, s, where, item, samplers))
                return 0;
        }
    }
    check_static(g, s);
    return 1;
}
