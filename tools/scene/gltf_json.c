/* gltf_json.c - reading JSON that may be wrong, and saying in one line what is wrong with it.
 *
 * glTF gives nearly every member a default, so an absent member is never an error here: the caller presets the default
 * and the getters leave it alone. A member that is there must have the right type and range. */
#include "gltf.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Above this a double no longer holds every integer. */
#define INTEGER_MAX 9007199254740992.0

static const char *const kind_names[GLTF_KINDS] = {
    [GLTF_ACCESSOR] = "accessor", [GLTF_ANIMATION] = "animation", [GLTF_BUFFER] = "buffer",
    [GLTF_VIEW] = "buffer view",  [GLTF_CAMERA] = "camera",       [GLTF_IMAGE] = "image",
    [GLTF_LIGHT] = "light",       [GLTF_MATERIAL] = "material",   [GLTF_MESH] = "mesh",
    [GLTF_NODE] = "node",         [GLTF_SAMPLER] = "sampler",     [GLTF_SCENE] = "scene",
    [GLTF_TEXTURE] = "texture",
};

/* "file: text" into line[SCENE_MESSAGE]. Names come from the file, and must not break the line. */
static void write_line(const gltf *g, char *line, const char *format, va_list arguments) GLTF_PRINTF(3, 0);

static void write_line(const gltf *g, char *line, const char *format, va_list arguments)
{
    const size_t path_max = 160, length = strlen(g->path);
    int used = 0;

    /* of a very long path the end says more than the beginning */
    if (length > path_max)
        used = snprintf(line, SCENE_MESSAGE, "...%s: ", g->path + length - path_max);
    else
        used = snprintf(line, SCENE_MESSAGE, "%s: ", g->path);
    if (used >= 0 && used < SCENE_MESSAGE)
        vsnprintf(line + used, SCENE_MESSAGE - (size_t)used, format, arguments);
    for (char *c = line; *c; c++)
        if ((unsigned char)*c < 0x20 || *c == 0x7f)
            *c = '?';
}

int gltf_fail(gltf *g, const char *format, ...)
{
    va_list arguments;

    va_start(arguments, format);
    write_line(g, g->message, format, arguments);
    va_end(arguments);
    return 0;
}

int gltf_fail_memory(gltf *g, size_t bytes)
{
    return gltf_fail(g, "no memory: %lu bytes wanted", (unsigned long)bytes);
}

void gltf_warn(gltf *g, const char *format, ...)
{
    char line[SCENE_MESSAGE];
    va_list arguments;

    if (!g->warn)
        return;
    va_start(arguments, format);
    write_line(g, line, format, arguments);
    va_end(arguments);
    g->warn(line);
}

void *gltf_alloc(gltf *g, size_t count, size_t size)
{
    void *block = NULL;

    if (count == 0)
        count = 1;
    if (count <= SIZE_MAX / 2 / size)
        block = malloc(count * size);
    if (!block)
        gltf_fail_memory(g, count <= SIZE_MAX / size ? count * size : SIZE_MAX);
    return block;
}

void *gltf_alloc_zeroed(gltf *g, size_t count, size_t size)
{
    void *block = gltf_alloc(g, count, size);

    if (block)
        memset(block, 0, (count ? count : 1) * size);
    return block;
}

const cJSON *gltf_get(const cJSON *object, const char *key)
{
    return cJSON_IsObject(object) ? cJSON_GetObjectItemCaseSensitive(object, key) : NULL;
}

const cJSON *gltf_get_extension(const cJSON *object, const char *name)
{
    return gltf_get(gltf_get(object, "extensions"), name);
}

const char *gltf_get_string(const cJSON *object, const char *key)
{
    const cJSON *item = gltf_get(object, key);

    return cJSON_IsString(item) ? item->valuestring : NULL;
}

int gltf_get_bool(gltf *g, const char *where, const cJSON *object, const char *key, int *out)
{
    const cJSON *item = gltf_get(object, key);

    if (!item)
        return 1;
    if (!cJSON_IsBool(item))
        return gltf_fail(g, "%s: %s is neither true nor false", where, key);
    *out = cJSON_IsTrue(item) ? 1 : 0;
    return 1;
}

int gltf_get_number(gltf *g, const char *where, const cJSON *object, const char *key, double lowest, double highest,
                    double *out)
{
    const cJSON *item = gltf_get(object, key);

    if (!item)
        return 1;
    if (!cJSON_IsNumber(item) || !isfinite(item->valuedouble))
        return gltf_fail(g, "%s: %s is not a number", where, key);
    if (!(item->valuedouble >= lowest && item->valuedouble <= highest))
        return gltf_fail(g, "%s: %s is %g, out of range %g to %g", where, key, item->valuedouble, lowest, highest);
    *out = item->valuedouble;
    return 1;
}

int gltf_get_numbers(gltf *g, const char *where, const cJSON *object, const char *key, size_t count, double *out)
{
    const cJSON *array = gltf_get(object, key), *item;
    size_t n = 0;

    if (!array)
        return 1;
    if (!cJSON_IsArray(array))
        return gltf_fail(g, "%s: %s is not an array", where, key);
    cJSON_ArrayForEach (item, array) {
        if (!cJSON_IsNumber(item) || !isfinite(item->valuedouble))
            return gltf_fail(g, "%s: %s: element %lu is not a number", where, key, (unsigned long)n);
        if (n < count)
            out[n] = item->valuedouble;
        n++;
    }
    if (n != count)
        return gltf_fail(g, "%s: %s has %lu numbers, not %lu", where, key, (unsigned long)n, (unsigned long)count);
    return 1;
}

/* A number that is an integer from 0 on. */
static int as_size(const cJSON *item, size_t *out)
{
    const double value = cJSON_IsNumber(item) ? item->valuedouble : -1.0;

    if (!(value >= 0.0 && value <= INTEGER_MAX && value <= (double)(SIZE_MAX / 2)) || value != floor(value))
        return 0;
    *out = (size_t)value;
    return 1;
}

int gltf_get_size(gltf *g, const char *where, const cJSON *object, const char *key, size_t *out)
{
    const cJSON *item = gltf_get(object, key);

    if (!item || as_size(item, out))
        return 1;
    if (cJSON_IsNumber(item))
        return gltf_fail(g, "%s: %s is %.17g, not a whole number from 0 on", where, key, item->valuedouble);
    return gltf_fail(g, "%s: %s is not a number", where, key);
}

int gltf_index(gltf *g, const char *where, const char *key, const cJSON *item, gltf_kind kind, int *out)
{
    const size_t count = g->lists[kind].count;
    size_t index = 0;

    if (!cJSON_IsNumber(item))
        return gltf_fail(g, "%s: %s is not a number", where, key);
    if (!as_size(item, &index) || index >= count)
        return gltf_fail(g, "%s: %s: there is no %s %.17g (the file has %lu)", where, key, kind_names[kind],
                         item->valuedouble, (unsigned long)count);
    *out = (int)index; /* a list of 2^31 elements is longer than GLTF_FILE_MAX */
    return 1;
}

int gltf_get_index(gltf *g, const char *where, const cJSON *object, const char *key, gltf_kind kind, int *out)
{
    const cJSON *item = gltf_get(object, key);

    return item ? gltf_index(g, where, key, item, kind, out) : 1;
}

int gltf_get_array(gltf *g, const char *where, const cJSON *object, const char *key, const cJSON **out)
{
    const cJSON *item = gltf_get(object, key);

    *out = item;
    if (item && !cJSON_IsArray(item))
        return gltf_fail(g, "%s: %s is not an array", where, key);
    return 1;
}
