/* gltf_accessor.c - numbers out of buffers, in every layout that glTF allows.
 *
 * An accessor is checked once, when it is opened: its last byte lies in its buffer view, its sparse indices in its
 * count. Reading then needs no checks, and asks for memory only in proportion to a count that stays under the limits;
 * a count needs no bytes behind it where the accessor has no buffer view and is all zero.
 *
 * Bytes are put together one by one: buffers are little-endian whatever the machine, and need not be aligned here. */
#include "gltf.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define TYPE_FIRST 5120u /* GLTF_INT8 is the bit of this type, and so on */

/* Bytes of a component type, 0 for a number that is none. */
static size_t type_size(size_t type)
{
    static const uint8_t sizes[] = {1, 1, 2, 2, 0, 4, 4}; /* 5120 to 5126 */

    return type >= TYPE_FIRST && type < TYPE_FIRST + sizeof sizes ? sizes[type - TYPE_FIRST] : 0;
}

/* 1 to 4, or 0 for a type that nothing here reads (matrices serve skins only). */
static unsigned components_of(const char *type)
{
    static const char *const names[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};

    for (unsigned i = 0; type && i < 4; i++)
        if (strcmp(type, names[i]) == 0)
            return i + 1;
    return 0;
}

/* Where `count` elements of `size` bytes lie, `stride` apart (0: size, or what the view says). The end is computed in
 * 64 bits, where it cannot overflow: count stays below 2^32, a stride below 2^8, and offset below 2^53. */
static int find_elements(gltf *g, const char *where, int view, size_t offset, size_t count, size_t size,
                         const uint8_t **data, size_t *stride)
{
    size_t available, view_stride;
    uint64_t end;

    if (!gltf_view_bytes(g, view, data, &available, &view_stride))
        return 0;
    *stride = view_stride ? view_stride : size;
    if (*stride < size)
        return gltf_fail(g, "%s: elements of %lu bytes, buffer view %d has byteStride %lu", where, (unsigned long)size,
                         view, (unsigned long)*stride);
    end = (uint64_t)offset + (count ? (uint64_t)(count - 1) * *stride + size : 0);
    if (end > available)
        return gltf_fail(g, "%s: %lu elements of %lu bytes end at %.0f, buffer view %d has %lu", where,
                         (unsigned long)count, (unsigned long)size, (double)end, view, (unsigned long)available);
    *data += offset;
    return 1;
}

static uint32_t read_unsigned(const uint8_t *bytes, size_t size)
{
    uint32_t value = 0;

    for (size_t i = size; i-- > 0;)
        value = value << 8 | bytes[i];
    return value;
}

static int open_sparse(gltf *g, const char *where, const cJSON *sparse, gltf_accessor *a)
{
    const cJSON *indices = gltf_get(sparse, "indices"), *values = gltf_get(sparse, "values");
    size_t offsets[2] = {0, 0}, type = 0, size, stride;
    int views[2] = {SCENE_NONE, SCENE_NONE};

    if (!gltf_get_size(g, where, sparse, "count", &a->sparse_count) ||
        !gltf_get_size(g, where, indices, "componentType", &type) ||
        !gltf_get_index(g, where, indices, "bufferView", GLTF_VIEW, &views[0]) ||
        !gltf_get_index(g, where, values, "bufferView", GLTF_VIEW, &views[1]) ||
        !gltf_get_size(g, where, indices, "byteOffset", &offsets[0]) ||
        !gltf_get_size(g, where, values, "byteOffset", &offsets[1]))
        return 0;
    if (a->sparse_count > a->count)
        return gltf_fail(g, "%s: %lu sparse elements of %lu", where, (unsigned long)a->sparse_count,
                         (unsigned long)a->count);
    if (views[0] == SCENE_NONE || views[1] == SCENE_NONE)
        return gltf_fail(g, "%s: its sparse part lacks a buffer view", where);
    size = type_size(type);
    if (size == 0 || !(1u << (type - TYPE_FIRST + 8) & GLTF_INDICES))
        return gltf_fail(g, "%s: sparse indices of component type %lu", where, (unsigned long)type);
    a->sparse_type = (unsigned)type;
    if (!find_elements(g, where, views[0], offsets[0], a->sparse_count, size, &a->sparse_indices, &stride))
        return 0;
    for (size_t i = 0; i < a->sparse_count; i++) {
        const uint32_t at = read_unsigned(a->sparse_indices + i * size, size);

        if (at >= a->count)
            return gltf_fail(g, "%s: sparse index %lu is %lu, there are %lu elements", where, (unsigned long)i,
                             (unsigned long)at, (unsigned long)a->count);
    }
    return find_elements(g, where, views[1], offsets[1], a->sparse_count, a->components * type_size(a->type),
                         &a->sparse_values, &stride);
}

int gltf_open_accessor(gltf *g, const char *where, const char *what, int index, unsigned allowed, size_t count_max,
                       gltf_accessor *out)
{
    const cJSON *json = g->lists[GLTF_ACCESSOR].items[index], *sparse = gltf_get(json, "sparse");
    size_t offset = 0, type = 0, size;
    int view = SCENE_NONE;
    char name[GLTF_WHERE];

    memset(out, 0, sizeof *out);
    out->index = index;
    snprintf(name, sizeof name, "accessor %d", index);
    if (!gltf_get_size(g, name, json, "count", &out->count) || !gltf_get_size(g, name, json, "componentType", &type) ||
        !gltf_get_size(g, name, json, "byteOffset", &offset) ||
        !gltf_get_bool(g, name, json, "normalized", &out->normalized) ||
        !gltf_get_index(g, name, json, "bufferView", GLTF_VIEW, &view))
        return 0;
    out->components = components_of(gltf_get_string(json, "type"));
    size = type_size(type);
    if (out->components == 0 || !(GLTF_WIDE(out->components) & allowed))
        return gltf_fail(g, "%s: %s: accessor %d has type %.20s", where, what, index,
                         gltf_get_string(json, "type") ? gltf_get_string(json, "type") : "none");
    if (size == 0 || !(1u << (type - TYPE_FIRST + 8) & allowed))
        return gltf_fail(g, "%s: %s: accessor %d has component type %lu", where, what, index, (unsigned long)type);
    if (allowed & GLTF_NORMALIZED && type != 5126 && !out->normalized)
        return gltf_fail(g, "%s: %s: accessor %d has integers that are not normalized", where, what, index);
    if (out->count == 0 || out->count > count_max)
        return gltf_fail(g, "%s: count is %lu, out of range 1 to %lu", name, (unsigned long)out->count,
                         (unsigned long)count_max);
    g->elements += out->count;
    if (g->elements > GLTF_ELEMENTS_MAX)
        return gltf_fail(g, "%s: its %lu elements go past the limit of %lu in all", name, (unsigned long)out->count,
                         (unsigned long)GLTF_ELEMENTS_MAX);
    out->type = (unsigned)type;
    out->stride = size * out->components;
    if (view != SCENE_NONE &&
        !find_elements(g, name, view, offset, out->count, size * out->components, &out->data, &out->stride))
        return 0;
    return sparse ? open_sparse(g, name, sparse, out) : 1;
}

/* One component as glTF defines its value. A signed integer's most negative value is clamped to -1. */
static float read_component(const uint8_t *bytes, unsigned type, int normalized)
{
    const uint32_t bits = read_unsigned(bytes, type_size(type));
    double value, largest;
    float exact;

    switch (type) {
    case 5120:
        value = (double)bits - (bits & 0x80u ? 256.0 : 0.0);
        largest = 127.0;
        break;
    case 5121:
        value = bits;
        largest = 255.0;
        break;
    case 5122:
        value = (double)bits - (bits & 0x8000u ? 65536.0 : 0.0);
        largest = 32767.0;
        break;
    case 5123:
        value = bits;
        largest = 65535.0;
        break;
    default:
        memcpy(&exact, &bits, sizeof exact); /* 5126: the very bits */
        return exact;
    }
    if (!normalized)
        return (float)value;
    return value < -largest ? -1.0f : (float)(value / largest);
}

static void read_element(const gltf_accessor *a, const uint8_t *bytes, float *out)
{
    const size_t size = type_size(a->type);

    for (unsigned c = 0; c < a->components; c++)
        out[c] = read_component(bytes + c * size, a->type, a->normalized);
}

float *gltf_read_floats(gltf *g, const gltf_accessor *a)
{
    const size_t size = type_size(a->sparse_type), element_size = a->components * type_size(a->type);
    float *values = gltf_alloc_zeroed(g, a->count, a->components * sizeof *values);

    if (!values)
        return NULL;
    for (size_t i = 0; a->data && i < a->count; i++)
        read_element(a, a->data + i * a->stride, values + i * a->components);
    for (size_t i = 0; i < a->sparse_count; i++)
        read_element(a, a->sparse_values + i * element_size,
                     values + read_unsigned(a->sparse_indices + i * size, size) * (size_t)a->components);
    return values;
}

uint32_t *gltf_read_indices(gltf *g, const gltf_accessor *a)
{
    const size_t size = type_size(a->sparse_type), element_size = type_size(a->type);
    uint32_t *values = gltf_alloc_zeroed(g, a->count, sizeof *values);

    if (!values)
        return NULL;
    for (size_t i = 0; a->data && i < a->count; i++)
        values[i] = read_unsigned(a->data + i * a->stride, element_size);
    for (size_t i = 0; i < a->sparse_count; i++)
        values[read_unsigned(a->sparse_indices + i * size, size)] =
            read_unsigned(a->sparse_values + i * element_size, element_size);
    return values;
}
