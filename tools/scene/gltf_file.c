/* gltf_file.c - opening a document: from .gltf or .glb to JSON with its arrays listed and its buffers in memory.
 *
 * A .glb is told by its first four bytes and not by its name. What the document requires is looked at before anything
 * else in it: a file that needs what we lack is refused by that name, not by what it happens to break. */
#include "gltf.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define GLB_MAGIC 0x46546c67u /* "glTF" */
#define GLB_JSON  0x4e4f534au /* "JSON" */
#define GLB_BIN   0x004e4942u /* "BIN\0" */

static const char *const known_extensions[] = {
    "KHR_lights_punctual",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
};

static const char *const list_keys[GLTF_KINDS] = {
    [GLTF_ACCESSOR] = "accessors", [GLTF_ANIMATION] = "animations", [GLTF_BUFFER] = "buffers",
    [GLTF_VIEW] = "bufferViews",   [GLTF_CAMERA] = "cameras",       [GLTF_IMAGE] = "images",
    [GLTF_LIGHT] = "lights",       [GLTF_MATERIAL] = "materials",   [GLTF_MESH] = "meshes",
    [GLTF_NODE] = "nodes",         [GLTF_SAMPLER] = "samplers",     [GLTF_SCENE] = "scenes",
    [GLTF_TEXTURE] = "textures",
};

static uint32_t little_endian(const uint8_t *bytes)
{
    return (uint32_t)bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 | (uint32_t)bytes[3] << 24;
}

/* Finds the JSON chunk and the binary chunk of a .glb. Chunks of other types may follow, and are passed over. */
static int split_glb(gltf *g, const uint8_t **json, size_t *json_size)
{
    uint8_t *bytes = g->file.data;
    const size_t size = g->file.size;
    size_t at = 12;

    *json = NULL;
    if (size < 12)
        return gltf_fail(g, "the header of a .glb has 12 bytes, this file %lu", (unsigned long)size);
    if (little_endian(bytes + 4) != 2)
        return gltf_fail(g, "the .glb container has version %lu, not 2", (unsigned long)little_endian(bytes + 4));
    if (little_endian(bytes + 8) != size)
        return gltf_fail(g, "the .glb header says %lu bytes, the file has %lu", (unsigned long)little_endian(bytes + 8),
                         (unsigned long)size);
    for (int chunk = 0; at < size; chunk++) {
        uint32_t length, type;

        if (size - at < 8)
            return gltf_fail(g, "chunk %d: its header is cut off at byte %lu", chunk, (unsigned long)size);
        length = little_endian(bytes + at);
        type = little_endian(bytes + at + 4);
        at += 8;
        if (length > size - at)
            return gltf_fail(g, "chunk %d: %lu bytes from %lu on, the file has %lu", chunk, (unsigned long)length,
                             (unsigned long)at, (unsigned long)size);
        if (chunk == 0 && type != GLB_JSON)
            return gltf_fail(g, "chunk 0 has type 0x%08lx, not JSON", (unsigned long)type);
        if (chunk == 0) {
            *json = bytes + at;
            *json_size = length;
        } else if (chunk == 1 && type == GLB_BIN) {
            g->glb_chunk = bytes + at;
            g->glb_chunk_size = length;
        }
        at += length;
    }
    return *json ? 1 : gltf_fail(g, "a .glb without chunks");
}

static int parse_json(gltf *g, const uint8_t *bytes, size_t size)
{
    const char *text = (const char *)bytes, *end = text;

    g->root = cJSON_ParseWithLengthOpts(text, size, &end, 0);
    if (!g->root)
        return gltf_fail(g, "the JSON is wrong at byte %lu (or memory ran out)", (unsigned long)(end - text));
    for (; end < text + size; end++)
        if (!strchr(" \t\r\n", *end)) /* finds NUL too: some writers fill a chunk up with it */
            return gltf_fail(g, "the JSON ends at byte %lu, but more follows", (unsigned long)(end - text));
    return cJSON_IsObject(g->root) ? 1 : gltf_fail(g, "the JSON is not an object");
}

static int check_version(gltf *g)
{
    const cJSON *asset = gltf_get(g->root, "asset");
    const char *version = gltf_get_string(asset, "version"), *least = gltf_get_string(asset, "minVersion");

    if (!version)
        return gltf_fail(g, "asset.version is missing: this is no glTF");
    if (strncmp(version, "2.", 2) != 0)
        return gltf_fail(g, "glTF version %.20s, not 2.x", version);
    if (least && strcmp(least, "2.0") != 0)
        return gltf_fail(g, "it needs at least glTF version %.20s, this reader has 2.0", least);
    return 1;
}

static int check_extensions(gltf *g)
{
    const cJSON *required, *item;

    if (!gltf_get_array(g, "the document", g->root, "extensionsRequired", &required))
        return 0;
    cJSON_ArrayForEach (item, required) {
        int known = 0;

        if (!cJSON_IsString(item))
            return gltf_fail(g, "extensionsRequired has an element that is not a string");
        for (size_t i = 0; i < sizeof known_extensions / sizeof known_extensions[0]; i++)
            if (strcmp(item->valuestring, known_extensions[i]) == 0)
                known = 1;
        if (!known)
            return gltf_fail(g, "required extension %.80s is not supported", item->valuestring);
    }
    return 1;
}

static int make_list(gltf *g, gltf_kind kind)
{
    const cJSON *owner = kind == GLTF_LIGHT ? gltf_get_extension(g->root, "KHR_lights_punctual") : g->root;
    gltf_list *list = &g->lists[kind];
    const cJSON *array, *item;
    size_t count = 0;

    if (!gltf_get_array(g, "the document", owner, list_keys[kind], &array))
        return 0;
    cJSON_ArrayForEach (item, array)
        count++;
    list->items = gltf_alloc(g, count, sizeof *list->items);
    if (!list->items)
        return 0;
    cJSON_ArrayForEach (item, array) {
        if (!cJSON_IsObject(item))
            return gltf_fail(g, "%s: element %lu is not an object", list_keys[kind], (unsigned long)list->count);
        list->items[list->count++] = item;
    }
    return 1;
}

static int read_buffers(gltf *g)
{
    const gltf_list *list = &g->lists[GLTF_BUFFER];

    g->buffers = gltf_alloc_zeroed(g, list->count, sizeof *g->buffers);
    if (!g->buffers)
        return 0;
    for (size_t i = 0; i < list->count; i++) {
        const char *uri = gltf_get_string(list->items[i], "uri");
        gltf_bytes *buffer = &g->buffers[i];
        char where[GLTF_WHERE];
        size_t length = SIZE_MAX;

        snprintf(where, sizeof where, "buffer %lu", (unsigned long)i);
        if (!gltf_get_size(g, where, list->items[i], "byteLength", &length))
            return 0;
        if (length == SIZE_MAX)
            return gltf_fail(g, "%s: byteLength is missing", where);
        if (uri) {
            if (!gltf_read_uri(g, where, uri, buffer))
                return 0;
        } else if (i == 0 && g->glb_chunk) {
            buffer->data = g->glb_chunk;
            buffer->size = g->glb_chunk_size;
        } else {
            continue; /* lawful: an extension may fill it. Whoever reads from it is told. */
        }
        if (length > buffer->size)
            return gltf_fail(g, "%s: byteLength is %lu, its data has %lu bytes", where, (unsigned long)length,
                             (unsigned long)buffer->size);
        buffer->size = length;
    }
    return 1;
}

int gltf_open(gltf *g)
{
    const uint8_t *json;
    size_t json_size;

    if (!gltf_read_file(g, "", g->path, &g->file))
        return 0;
    json = g->file.data;
    json_size = g->file.size;
    if (json_size >= 4 && little_endian(json) == GLB_MAGIC && !split_glb(g, &json, &json_size))
        return 0;
    if (!parse_json(g, json, json_size) || !check_version(g) || !check_extensions(g))
        return 0;
    for (int kind = 0; kind < GLTF_KINDS; kind++)
        if (!make_list(g, (gltf_kind)kind))
            return 0;
    return read_buffers(g);
}

void gltf_close(gltf *g)
{
    for (size_t i = 0; g->buffers && i < g->lists[GLTF_BUFFER].count; i++)
        if (g->buffers[i].data != g->glb_chunk)
            free(g->buffers[i].data);
    free(g->buffers);
    for (int kind = 0; kind < GLTF_KINDS; kind++)
        free(g->lists[kind].items);
    free(g->uv_sources);
    free(g->boxes);
    cJSON_Delete(g->root);
    free(g->file.data);
}

int gltf_view_bytes(gltf *g, int view, const uint8_t **data, size_t *size, size_t *stride)
{
    const cJSON *json = g->lists[GLTF_VIEW].items[view];
    size_t offset = 0, length = SIZE_MAX;
    int buffer = SCENE_NONE;
    char where[GLTF_WHERE];

    *stride = 0;
    snprintf(where, sizeof where, "buffer view %d", view);
    if (!gltf_get_index(g, where, json, "buffer", GLTF_BUFFER, &buffer) ||
        !gltf_get_size(g, where, json, "byteOffset", &offset) ||
        !gltf_get_size(g, where, json, "byteLength", &length) || !gltf_get_size(g, where, json, "byteStride", stride))
        return 0;
    if (buffer == SCENE_NONE || length == SIZE_MAX)
        return gltf_fail(g, "%s: %s is missing", where, buffer == SCENE_NONE ? "buffer" : "byteLength");
    if (*stride != 0 && (*stride < 4 || *stride > 252))
        return gltf_fail(g, "%s: byteStride is %lu, out of range 4 to 252", where, (unsigned long)*stride);
    if (!g->buffers[buffer].data)
        return gltf_fail(g, "%s: buffer %d has neither a uri nor the binary chunk of a .glb", where, buffer);
    if (offset > g->buffers[buffer].size || length > g->buffers[buffer].size - offset)
        return gltf_fail(g, "%s: %lu bytes from %lu on, buffer %d has %lu", where, (unsigned long)length,
                         (unsigned long)offset, buffer, (unsigned long)g->buffers[buffer].size);
    *data = g->buffers[buffer].data + offset;
    *size = length;
    return 1;
}
