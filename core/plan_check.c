/* plan_check.c - what a scene must be for a plan: every number finite and in its range. The first that is not is
 * named. */
#include "gni_plan.h"

#include <math.h>

static int in_range(const double *v, int count)
{
    for (int i = 0; i < count; i++)
        if (!(fabs(v[i]) <= GNI_MOST))
            return 0;
    return 1;
}

/* What bounds a light; zero is lawful everywhere. */
static gn_result check_bounds(gn_context *context, const gn_light *l, unsigned long i)
{
    const int has_cone = l->kind == GN_LIGHT_SPOT && l->cone != 0.0;

    if (!(l->range >= 0.0 && l->range <= GNI_MOST))
        return gn_fail(context, GN_E_ARG, "plan: light %lu has a range of %g", i, l->range);
    if (!isfinite(l->cone) || (has_cone && !(l->cone > 0.0 && l->cone < 1.5707963267948966)))
        return gn_fail(context, GN_E_ARG, "plan: light %lu has a cone of %g radians about its axis", i, l->cone);
    if (has_cone && l->towards[0] == 0.0 && l->towards[1] == 0.0 && l->towards[2] == 0.0)
        return gn_fail(context, GN_E_ARG, "plan: light %lu has a cone along %g %g %g", i, l->towards[0], l->towards[1],
                       l->towards[2]);
    for (int c = 0; c < 3; c++) {
        if (!(l->color[c] >= 0.0 && l->color[c] <= GNI_MOST))
            return gn_fail(context, GN_E_ARG, "plan: light %lu has a color of %g", i, l->color[c]);
        if (!(l->attenuation[c] >= 0.0 && l->attenuation[c] <= GNI_MOST))
            return gn_fail(context, GN_E_ARG, "plan: light %lu has an attenuation of %g", i, l->attenuation[c]);
        if (!in_range(l->box_min + c, 1) || !in_range(l->box_max + c, 1) || l->box_min[c] > l->box_max[c])
            return gn_fail(context, GN_E_ARG, "plan: light %lu has a box from %g to %g", i, l->box_min[c],
                           l->box_max[c]);
    }
    return GN_OK;
}

static gn_result check_light(gn_context *context, const gn_light *l, unsigned long i, uint32_t object_count)
{
    const double *p = l->position, *v = l->towards;

    if ((unsigned)l->kind > GN_LIGHT_DIRECTIONAL)
        return gn_fail(context, GN_E_ARG, "plan: light %lu is of unknown kind %d", i, (int)l->kind);
    if (!in_range(p, 3))
        return gn_fail(context, GN_E_ARG, "plan: light %lu is at %g %g %g", i, p[0], p[1], p[2]);
    if (!in_range(v, 3))
        return gn_fail(context, GN_E_ARG, "plan: light %lu comes from %g %g %g", i, v[0], v[1], v[2]);
    if (l->kind == GN_LIGHT_DIRECTIONAL && v[0] == 0.0 && v[1] == 0.0 && v[2] == 0.0)
        return gn_fail(context, GN_E_ARG, "plan: light %lu comes from no direction: %g %g %g", i, v[0], v[1], v[2]);
    if (l->exempt_count && !l->exempt)
        return gn_fail(context, GN_E_ARG, "plan: light %lu exempts %lu objects at NULL", i,
                       (unsigned long)l->exempt_count);
    for (uint32_t e = 0; e < l->exempt_count; e++)
        if (l->exempt[e] >= object_count)
            return gn_fail(context, GN_E_ARG, "plan: light %lu exempts object %lu of %lu", i,
                           (unsigned long)l->exempt[e], (unsigned long)object_count);
    return GNI_HAS_CULLING ? check_bounds(context, l, i) : GN_OK;
}

static gn_result check_object(gn_context *context, const gn_object *o, unsigned long i)
{
    const double *m = o->model;
    double inverse[16];

    if (!o->mesh)
        return gn_fail(context, GN_E_ARG, "plan: object %lu has no mesh", i);
    for (int k = 0; k < 16; k++)
        if (!in_range(m + k, 1))
            return gn_fail(context, GN_E_ARG, "plan: object %lu: element %d of its matrix is %g", i, k, m[k]);
    if (!(o->error >= 0.0 && o->error <= GNI_MOST))
        return gn_fail(context, GN_E_ARG, "plan: object %lu has an error of %g", i, o->error);
    if (m[3] != 0.0 || m[7] != 0.0 || m[11] != 0.0 || m[15] != 1.0)
        return gn_fail(context, GN_E_ARG, "plan: object %lu: last row of its matrix is %g %g %g %g, not 0 0 0 1", i,
                       m[3], m[7], m[11], m[15]);
    if (!GNI_HAS_SOLIDS && o->flags & GN_CASTS && !gn_mat4_invert_affine(inverse, m))
        return gn_fail(context, GN_E_DEVICE,
                       "plan: object %lu: this build lacks the feature solids, and its matrix has no inverse", i);
    return GN_OK;
}

/* How masks are made, and what they do to the frame. */
static gn_result check_masks(gn_context *context, const gn_scene *s)
{
    if ((unsigned)s->shade > GN_SHADE_BLACK)
        return gn_fail(context, GN_E_ARG, "plan: no shade has number %d", (int)s->shade);
    if (!(s->dimmed >= 0.0 && s->dimmed < 1.0))
        return gn_fail(context, GN_E_ARG, "plan: a shadow leaves %g of the light, not 0 to 1", s->dimmed);
    if (s->scale > 4 || s->scale == 3)
        return gn_fail(context, GN_E_ARG, "plan: masks at scale 1, 2 or 4 (%lu)", (unsigned long)s->scale);
    if ((unsigned)s->upsample > GN_UPSAMPLE_DEPTH)
        return gn_fail(context, GN_E_ARG, "plan: no upsampling has number %d", (int)s->upsample);
    if (s->scale > 1 && s->shade != GN_SHADE_ADDITIVE && (s->sharpen || s->upsample == GN_UPSAMPLE_DEPTH) &&
        s->method != GN_METHOD_REFINE)
        return gn_fail(
            context, GN_E_ARG,
            "plan: a frame that is dimmed (shade %d) takes small masks by nearest or bilinear, not sharpened",
            (int)s->shade);
    if (s->sharpen && s->upsample == GN_UPSAMPLE_NEAREST && s->scale > 1)
        return gn_fail(context, GN_E_ARG, "plan: masks upsampled by nearest are 0 or 1: nothing is sharpened");
    if ((s->follows || s->precedes) && s->shade != GN_SHADE_ADDITIVE)
        return gn_fail(context, GN_E_ARG, "plan: a frame that is dimmed (shade %d) is one plan", (int)s->shade);
    if (s->lights_per_pass > GN_MOST_MASKED)
        return gn_fail(context, GN_E_ARG, "plan: %lu lights in a pass, at most %d", (unsigned long)s->lights_per_pass,
                       GN_MOST_MASKED);
    return GN_OK;
}

/* What this build is not made for (gni_features.h). */
static gn_result check_features(gn_context *context, const gn_scene *s)
{
    const char *missing = NULL;

    if (!GNI_HAS_CULLING && gni_must_end(s))
        missing = "culling: the volumes of this camera, or on this target, must end";
    if (!GNI_HAS_FALLBACK && (s->scale > 1 || s->shade != GN_SHADE_ADDITIVE))
        missing = "fallback: masks are to be small, or the frame dimmed";
    if (!GNI_HAS_CACHE && s->cache)
        missing = "cache";
    return missing ? gn_fail(context, GN_E_DEVICE, "plan: this build lacks the feature %s", missing) : GN_OK;
}

gn_result gni_check_scene(gn_context *context, const gn_scene *s)
{
    gn_result result;

    if ((s->light_count && !s->lights) || (s->object_count && !s->objects))
        return gn_fail(context, GN_E_ARG, "plan: NULL array of lights or objects");
    if (s->target.width == 0 || s->target.height == 0)
        return gn_fail(context, GN_E_ARG, "plan: target of %lux%lu pixels", (unsigned long)s->target.width,
                       (unsigned long)s->target.height);
    if (GNI_HAS_CULLING && !(s->least_light >= 0.0 && isfinite(s->least_light)))
        return gn_fail(context, GN_E_ARG, "plan: the least light that matters is %g", s->least_light);
    result = check_features(context, s);
    if (GNI_HAS_FALLBACK && result == GN_OK)
        result = check_masks(context, s);
    if (result == GN_OK)
        result = gni_check_camera(context, &s->camera);
    for (uint32_t i = 0; i < s->light_count && result == GN_OK; i++)
        result = check_light(context, &s->lights[i], i, s->object_count);
    for (uint32_t i = 0; i < s->object_count && result == GN_OK; i++)
        result = check_object(context, &s->objects[i], i);
    return result;
}
