/* gltf_view.c - cameras, and the lights of KHR_lights_punctual. */
#include "gltf.h"

#include <float.h>
#include <stdio.h>
#include <string.h>

#define PI 3.14159265358979323846

/* Lengths that reach further than this would overflow once they are squared. */
#define FARTHEST 1e100

int gltf_read_camera(gltf *g, int camera, scene_camera *out)
{
    const cJSON *json = g->lists[GLTF_CAMERA].items[camera], *values;
    const char *type = gltf_get_string(json, "type");
    char where[GLTF_WHERE];

    memset(out, 0, sizeof *out);
    snprintf(where, sizeof where, "camera %d", camera);
    if (!type || (strcmp(type, "perspective") != 0 && strcmp(type, "orthographic") != 0))
        return gltf_fail(g, "%s: type is %.40s", where, type ? type : "missing");
    out->orthographic = type[0] == 'o';
    values = gltf_get(json, type);
    if (!gltf_get_number(g, where, values, "yfov", DBL_MIN, PI - 1e-6, &out->yfov) ||
        !gltf_get_number(g, where, values, "xmag", -FARTHEST, FARTHEST, &out->xmag) ||
        !gltf_get_number(g, where, values, "ymag", -FARTHEST, FARTHEST, &out->ymag) ||
        !gltf_get_number(g, where, values, "znear", out->orthographic ? 0.0 : DBL_MIN, FARTHEST, &out->znear) ||
        !gltf_get_number(g, where, values, "zfar", DBL_MIN, FARTHEST, &out->zfar))
        return 0;
    if (out->orthographic && (out->xmag == 0.0 || out->ymag == 0.0))
        return gltf_fail(g, "%s: %s is missing or 0", where, out->xmag == 0.0 ? "xmag" : "ymag");
    if (!out->orthographic && (out->yfov == 0.0 || out->znear == 0.0))
        return gltf_fail(g, "%s: %s is missing", where, out->yfov == 0.0 ? "yfov" : "znear");
    if (out->orthographic && out->zfar == 0.0)
        return gltf_fail(g, "%s: zfar is missing", where);
    if (out->zfar != 0.0 && out->zfar <= out->znear)
        return gltf_fail(g, "%s: zfar is %g, not beyond znear %g", where, out->zfar, out->znear);
    return 1;
}

int gltf_read_light(gltf *g, int light, scene_light *out)
{
    const cJSON *json = g->lists[GLTF_LIGHT].items[light], *spot = gltf_get(json, "spot");
    const char *type = gltf_get_string(json, "type");
    const scene_light defaults = {.node = SCENE_NONE, .color = {1, 1, 1}, .intensity = 1, .outer = PI / 4};
    char where[GLTF_WHERE];

    *out = defaults;
    snprintf(where, sizeof where, "light %d", light);
    if (type && strcmp(type, "point") == 0)
        out->kind = SCENE_POINT;
    else if (type && strcmp(type, "spot") == 0)
        out->kind = SCENE_SPOT;
    else if (type && strcmp(type, "directional") == 0)
        out->kind = SCENE_DIRECTIONAL;
    else
        return gltf_fail(g, "%s: type is %.40s", where, type ? type : "missing");
    /* some writers round pi/2 up, and some write range 0 where they mean none */
    if (!gltf_get_numbers(g, where, json, "color", 3, out->color) ||
        !gltf_get_number(g, where, json, "intensity", 0.0, FARTHEST, &out->intensity) ||
        !gltf_get_number(g, where, json, "range", 0.0, FARTHEST, &out->range) ||
        !gltf_get_number(g, where, spot, "innerConeAngle", 0.0, PI / 2 + 1e-6, &out->inner) ||
        !gltf_get_number(g, where, spot, "outerConeAngle", 0.0, PI / 2 + 1e-6, &out->outer))
        return 0;
    if (out->inner > out->outer)
        return gltf_fail(g, "%s: innerConeAngle %g is larger than outerConeAngle %g", where, out->inner, out->outer);
    return 1;
}
