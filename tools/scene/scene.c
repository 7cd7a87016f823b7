/* scene.c - a scene's life from load to free, and its textures as the stage samples them. */
#include "gltf.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* What cannot be told from one number alone: products of transforms may leave what double can hold. */
static int check_finite(gltf *g, const scene *s)
{
    for (size_t k = 0; k < s->node_count && s->nodes[k].order != SCENE_NONE; k++) {
        const int node = s->nodes[k].order;

        for (int i = 0; i < 16; i++)
            if (!isfinite(s->nodes[node].world[i]))
                return gltf_fail(g, "node %d: its place in the world is not finite", node);
    }
    for (int i = 0; i < 3; i++)
        if (!isfinite(s->bounds_min[i]) || !isfinite(s->bounds_max[i]))
            return gltf_fail(g, "the scene's bounds are not finite: %g to %g", s->bounds_min[i], s->bounds_max[i]);
    return 1;
}

int scene_load(scene *out, const char *path, void (*warn)(const char *line), char message[SCENE_MESSAGE])
{
    gltf g = {.path = path, .warn = warn, .message = message};
    int ok;

    memset(out, 0, sizeof *out);
    message[0] = '\0';
    ok = gltf_open(&g) && gltf_read_materials(&g, out) && gltf_read_meshes(&g, out) && gltf_read_nodes(&g, out) &&
         gltf_read_animations(&g, out);
    if (ok) {
        scene_pose(out, 0.0);
        ok = check_finite(&g, out);
    }
    gltf_close(&g);
    if (!ok)
        scene_free(out);
    return ok;
}

void scene_free(scene *s)
{
    if (!s)
        return;
    for (size_t i = 0; i < s->texture_count; i++)
        free(s->textures[i].rgba);
    for (size_t i = 0; i < s->mesh_count; i++) {
        free(s->meshes[i].positions);
        free(s->meshes[i].normals);
        free(s->meshes[i].uvs);
        free(s->meshes[i].colors);
        free(s->meshes[i].indices);
        free(s->meshes[i].ranges);
    }
    for (size_t i = 0; s->animation && i < s->animation->count; i++) {
        free(s->animation->channels[i].times);
        free(s->animation->channels[i].values);
    }
    if (s->animation)
        free(s->animation->channels);
    free(s->animation);
    free(s->textures);
    free(s->materials);
    free(s->meshes);
    free(s->instances);
    for (size_t i = 0; i < s->light_count; i++)
        free(s->lights[i].exempt);
    free(s->lights);
    free(s->nodes);
    memset(s, 0, sizeof *s);
}

/* A coordinate brought near [0, 1] without changing what it samples, so that texels count within an int. */
static double reduce(scene_wrap wrap, double coordinate)
{
    if (!isfinite(coordinate))
        return 0.0;
    if (wrap == SCENE_REPEAT)
        return coordinate - floor(coordinate);
    if (wrap == SCENE_MIRROR)
        return coordinate - 2.0 * floor(coordinate / 2.0);
    return coordinate < 0.0 ? 0.0 : coordinate > 1.0 ? 1.0 : coordinate;
}

/* Texel numbers from -1 to 2 size wrapped (OpenGL ES 2.0.25, 3.7.6 and 3.7.7). */
static uint32_t wrap_texel(scene_wrap wrap, int texel, uint32_t size)
{
    const int n = (int)size;

    if (wrap == SCENE_REPEAT)
        return (uint32_t)((texel + n) % n);
    if (wrap == SCENE_MIRROR) {
        texel = (texel + 2 * n) % (2 * n);
        return (uint32_t)(texel < n ? texel : 2 * n - 1 - texel);
    }
    return (uint32_t)(texel < 0 ? 0 : texel < n ? texel : n - 1);
}

void scene_sample_texture(const scene_texture *t, const double uv[2], double out[4])
{
    const uint32_t sizes[2] = {t->width, t->height};
    uint32_t texels[2][2]; /* [axis][lower, upper] */
    double weights[2];     /* of the upper one */

    for (int axis = 0; axis < 2; axis++) {
        const double centred = reduce(t->wrap[axis], uv[axis]) * sizes[axis] - (t->nearest ? 0.0 : 0.5);
        const int lower = (int)floor(centred);

        texels[axis][0] = wrap_texel(t->wrap[axis], lower, sizes[axis]);
        texels[axis][1] = wrap_texel(t->wrap[axis], lower + 1, sizes[axis]);
        weights[axis] = t->nearest ? 0.0 : centred - lower;
    }
    for (int c = 0; c < 4; c++) {
        double rows[2];

        for (int y = 0; y < 2; y++) {
            const uint8_t *row = t->rgba + (size_t)texels[1][y] * t->width * 4 + c;

            rows[y] = (1.0 - weights[0]) * row[4 * (size_t)texels[0][0]] + weights[0] * row[4 * (size_t)texels[0][1]];
        }
        out[c] = (1.0 - weights[1]) * rows[0] + weights[1] * rows[1];
    }
}

double scene_alpha_at(const scene *s, int material, const double uv[2], double vertex_alpha)
{
    const scene_material *m = &s->materials[material];
    double texel[4] = {255, 255, 255, 255};

    if (m->texture != SCENE_NONE)
        scene_sample_texture(&s->textures[m->texture], uv, texel);
    return m->base_color[3] * vertex_alpha * (texel[3] / 255.0);
}
