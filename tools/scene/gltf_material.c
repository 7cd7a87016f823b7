/* gltf_material.c - materials, and of textures those that some material has for its base colour.
 *
 * The other textures (normals, roughness, occlusion, emission) are never decoded: the stage has no use for them, and
 * they are most of the bytes of a typical file. */
#include "gltf.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define UNTRIED (-2)

/* What became of the document's textures and images: several materials may share one. */
typedef struct texture_map {
    int *texture; /* [count of GLTF_TEXTURE] index into the scene's, SCENE_NONE, or UNTRIED */
    int *useless; /* [count of GLTF_IMAGE] 1 for what is no PNG */
} texture_map;

static int read_wrap(gltf *g, const char *where, const cJSON *sampler, const char *key, scene_wrap *out)
{
    size_t value = 10497;

    if (!gltf_get_size(g, where, sampler, key, &value))
        return 0;
    if (value != 10497 && value != 33071 && value != 33648)
        return gltf_fail(g, "%s: %s is %lu, not 10497, 33071 or 33648", where, key, (unsigned long)value);
    *out = value == 33071 ? SCENE_CLAMP : value == 33648 ? SCENE_MIRROR : SCENE_REPEAT;
    return 1;
}

static int read_sampler(gltf *g, int sampler, scene_texture *out)
{
    const cJSON *json = sampler == SCENE_NONE ? NULL : g->lists[GLTF_SAMPLER].items[sampler];
    size_t filter = 9729;
    char where[GLTF_WHERE];

    snprintf(where, sizeof where, "sampler %d", sampler);
    if (!read_wrap(g, where, json, "wrapS", &out->wrap[0]) || !read_wrap(g, where, json, "wrapT", &out->wrap[1]) ||
        !gltf_get_size(g, where, json, "magFilter", &filter))
        return 0;
    if (filter != 9728 && filter != 9729)
        return gltf_fail(g, "%s: magFilter is %lu, not 9728 or 9729", where, (unsigned long)filter);
    out->nearest = filter == 9728;
    return 1;
}

/* The scene's texture for one of the document, decoded when it is first asked for. */
static int find_texture(gltf *g, scene *s, texture_map *map, int texture, int *out)
{
    const cJSON *json = g->lists[GLTF_TEXTURE].items[texture];
    scene_texture *t = &s->textures[s->texture_count];
    int image = SCENE_NONE, sampler = SCENE_NONE;
    char where[GLTF_WHERE];

    *out = map->texture[texture];
    if (*out != UNTRIED)
        return 1;
    snprintf(where, sizeof where, "texture %d", texture);
    if (!gltf_get_index(g, where, json, "source", GLTF_IMAGE, &image) ||
        !gltf_get_index(g, where, json, "sampler", GLTF_SAMPLER, &sampler) || !read_sampler(g, sampler, t))
        return 0;
    *out = map->texture[texture] = SCENE_NONE;
    if (image == SCENE_NONE)
        gltf_warn(g, "%s has no source: its materials use their factor alone", where);
    if (image == SCENE_NONE || map->useless[image])
        return 1;
    if (!gltf_read_image(g, image, t))
        return 0;
    map->useless[image] = !t->rgba;
    if (t->rgba)
        *out = map->texture[texture] = (int)s->texture_count++;
    return 1;
}

static int read_base_texture(gltf *g, scene *s, texture_map *map, const char *where, const cJSON *json, int material)
{
    const cJSON *transform = gltf_get_extension(json, "KHR_texture_transform");
    gltf_uv_source *source = &g->uv_sources[material];
    int texture = SCENE_NONE;
    size_t set = 0;
    double angle = 0.0;

    if (!json)
        return 1;
    if (!gltf_get_index(g, where, json, "index", GLTF_TEXTURE, &texture) ||
        !gltf_get_size(g, where, json, "texCoord", &set) || !gltf_get_size(g, where, transform, "texCoord", &set) ||
        !gltf_get_numbers(g, where, transform, "offset", 2, source->offset) ||
        !gltf_get_numbers(g, where, transform, "scale", 2, source->scale) ||
        !gltf_get_number(g, where, transform, "rotation", -DBL_MAX, DBL_MAX, &angle))
        return 0;
    if (texture == SCENE_NONE)
        return gltf_fail(g, "%s: baseColorTexture has no index", where);
    if (set > 999)
        return gltf_fail(g, "%s: texCoord is %lu, out of range 0 to 999", where, (unsigned long)set);
    source->cosine = cos(angle);
    source->sine = sin(angle);
    if (!find_texture(g, s, map, texture, &s->materials[material].texture))
        return 0;
    if (s->materials[material].texture != SCENE_NONE)
        source->set = (int)set;
    return 1;
}

static int read_alpha(gltf *g, const char *where, const cJSON *json, scene_material *m)
{
    const char *mode = gltf_get_string(json, "alphaMode");

    if (!mode)
        return gltf_get(json, "alphaMode") ? gltf_fail(g, "%s: alphaMode is not a string", where) : 1;
    if (strcmp(mode, "OPAQUE") == 0)
        m->alpha = SCENE_OPAQUE;
    else if (strcmp(mode, "MASK") == 0)
        m->alpha = SCENE_MASK;
    else if (strcmp(mode, "BLEND") == 0)
        m->alpha = SCENE_BLEND;
    else
        return gltf_fail(g, "%s: alphaMode is %.40s", where, mode);
    return 1;
}

static int read_material(gltf *g, scene *s, texture_map *map, int material, int *unused_textures)
{
    const cJSON *json = g->lists[GLTF_MATERIAL].items[material], *pbr = gltf_get(json, "pbrMetallicRoughness");
    scene_material *m = &s->materials[material];
    char where[GLTF_WHERE];

    snprintf(where, sizeof where, "material %d", material);
    if (!gltf_get_numbers(g, where, pbr, "baseColorFactor", 4, m->base_color) ||
        !gltf_get_number(g, where, pbr, "metallicFactor", 0.0, 1.0, &m->metallic) ||
        !gltf_get_number(g, where, pbr, "roughnessFactor", 0.0, 1.0, &m->roughness) ||
        !gltf_get_numbers(g, where, json, "emissiveFactor", 3, m->emissive) ||
        !gltf_get_number(g, where, json, "alphaCutoff", 0.0, DBL_MAX, &m->alpha_cutoff) ||
        !gltf_get_bool(g, where, json, "doubleSided", &m->double_sided) || !read_alpha(g, where, json, m))
        return 0;
    if (!*unused_textures && (gltf_get(pbr, "metallicRoughnessTexture") || gltf_get(json, "normalTexture") ||
                              gltf_get(json, "occlusionTexture") || gltf_get(json, "emissiveTexture"))) {
        gltf_warn(g, "%s: of its textures, and others', only that of the base colour is used", where);
        *unused_textures = 1;
    }
    return read_base_texture(g, s, map, where, gltf_get(pbr, "baseColorTexture"), material);
}

int gltf_read_materials(gltf *g, scene *s)
{
    const scene_material plain = {
        .base_color = {1, 1, 1, 1}, .metallic = 1, .roughness = 1, .texture = SCENE_NONE, .alpha_cutoff = 0.5};
    const gltf_uv_source no_uv = {.set = SCENE_NONE, .scale = {1, 1}, .cosine = 1};
    const size_t count = g->lists[GLTF_MATERIAL].count, textures = g->lists[GLTF_TEXTURE].count;
    texture_map map;
    int ok, unused_textures = 0;

    map.texture = gltf_alloc(g, textures, sizeof *map.texture);
    map.useless = gltf_alloc_zeroed(g, g->lists[GLTF_IMAGE].count, sizeof *map.useless);
    g->uv_sources = gltf_alloc(g, count + 1, sizeof *g->uv_sources);
    s->materials = gltf_alloc(g, count + 1, sizeof *s->materials);
    s->textures = gltf_alloc_zeroed(g, textures + 1, sizeof *s->textures); /* one to spare: find_texture() */
    ok = map.texture && map.useless && g->uv_sources && s->materials && s->textures;
    for (size_t i = 0; ok && i < textures; i++)
        map.texture[i] = UNTRIED;
    for (size_t i = 0; ok && i <= count; i++) {
        s->materials[i] = plain;
        g->uv_sources[i] = no_uv;
    }
    for (size_t i = 0; ok && i < count; i++)
        ok = read_material(g, s, &map, (int)i, &unused_textures);
    s->material_count = ok ? count + 1 : 0; /* the default material is the last */
    free(map.texture);
    free(map.useless);
    return ok;
}
