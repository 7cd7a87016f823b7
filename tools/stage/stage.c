/* stage.c - opens a context for a scene, poses it, and asks the library for the frame's plan. */
#include "stage.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "counted_gl.h"
#include "gn_matrix.h"

#define MANY_LIGHTS 3 /* from which on drawing backs once costs less than caps */

/* The libc port, counting what the library asks for. */
static void *counting_resize(void *user, void *block, size_t old_size, size_t new_size)
{
    uint64_t *allocations = user;
    const gn_port libc_port = gn_port_libc();

    *allocations += new_size != 0;
    return libc_port.resize(NULL, block, old_size, new_size);
}

/* The most of a light that any material gives back, as surface.frag computes it: all channels white, seen at the best
 * angle. */
static double find_brightest(const scene *s)
{
    double most = 1.0;

    for (size_t i = 0; i < s->material_count; i++) {
        const scene_material *m = &s->materials[i];
        const double roughness = fmax(m->roughness, 0.1), shininess = fmax(2.0 / pow(roughness, 4.0) - 2.0, 1.0);
        const double shine = (1.0 - roughness) * (shininess + 8.0) / 8.0;

        most = fmax(most, 1.0 - m->metallic + (0.04 + 0.96 * m->metallic) * shine);
    }
    return most;
}

/* Irradiance of a light at a point, its brightest channel, cones left aside. */
static double brightness(const scene_light *l, const double at[3])
{
    const double channel = fmax(l->color[0], fmax(l->color[1], l->color[2])) * l->intensity;
    double square = 0.0, window = 1.0;

    if (l->kind == SCENE_DIRECTIONAL)
        return channel;
    for (int i = 0; i < 3; i++)
        square += (l->position[i] - at[i]) * (l->position[i] - at[i]);
    if (l->range > 0.0)
        window = fmax(0.0, 1.0 - square * square / (l->range * l->range * l->range * l->range));
    return channel * window / fmax(square, 1e-4);
}

static double default_exposure(const stage *s)
{
    double brightest = 0.0;

    for (size_t i = 0; i < s->scene->light_count; i++)
        brightest = fmax(brightest, brightness(&s->scene->lights[i], s->centre));
    return brightest > 0.0 ? 1.0 / brightest : 1.0;
}

static int refuse(stage **out, stage *s, int status)
{
    stage_close(s);
    *out = NULL;
    return status;
}

int stage_open(stage **out, scene *given, const stage_options *options, char message[SCENE_MESSAGE])
{
    static const int eight[4] = {8, 8, 8, 8};
    const int *bits = options->color_bits ? options->color_bits : eight;
    const platform_desc wanted = {options->width,      options->height,      bits[0], bits[1], bits[2], bits[3],
                                  options->depth_bits, options->stencil_bits};
    stage *s = calloc(1, sizeof *s);
    gn_port port = gn_port_libc();
    gn_gles_desc desc = {counted_get_proc, NULL, options->hide};
    char why[PLATFORM_MESSAGE];
    gn_result result;
    GLint vectors = 0;

    *out = NULL;
    if (!s) {
        snprintf(message, SCENE_MESSAGE, "stage: no memory");
        return 1;
    }
    s->scene = given;
    for (int i = 0; i < 3; i++)
        s->centre[i] = 0.5 * (given->bounds_min[i] + given->bounds_max[i]);
    s->finite_far = options->finite_far;
    s->soft_count = options->soft_count ? options->soft_count : 1;
    s->soft_radius = options->soft_radius;
    s->weld_angle = options->weld_angle;
    s->proxy_triangles = options->proxy_triangles;
    s->light_count = (uint32_t)given->light_count * s->soft_count;
    s->brightest = find_brightest(given);
    s->exposure = options->exposure > 0.0 ? options->exposure : default_exposure(s);
    s->platform = platform_open(options->platform, &wanted, why);
    if (!s->platform) {
        snprintf(message, SCENE_MESSAGE, "no context of %ux%u: %.400s", (unsigned)options->width,
                 (unsigned)options->height, why);
        return refuse(out, s, 3);
    }
    port.user = &s->allocations;
    port.resize = counting_resize;
    counted_gl_wrap(platform_get_proc, s->platform, options->replace);
    if (gn_context_create(&port, &s->context) != GN_OK) {
        snprintf(message, SCENE_MESSAGE, "stage: no memory");
        return refuse(out, s, 1);
    }
    s->cache_desc = options->cache;
    result = gn_shadow_cache_create(s->context, &s->cache_desc, &s->cache);
    if (result == GN_E_DEVICE) /* the library was built without */
        result = GN_OK;
    if (result == GN_OK)
        result = gn_gles_create(s->context, &desc, &s->gles);
    if (result == GN_OK)
        result =
            gn_gles_describe_target(s->gles, s->platform->actual.width, s->platform->actual.height, NULL, &s->target);
    if (result != GN_OK) {
        snprintf(message, SCENE_MESSAGE, "%s", gn_message(s->context));
        return refuse(out, s, result == GN_E_DEVICE ? 3 : 1);
    }
    s->gl = gn_gles_functions(s->gles);
    /* ten vectors for the material, four for each light; 16 are guaranteed */
    s->gl->glGetIntegerv(GL_MAX_FRAGMENT_UNIFORM_VECTORS, &vectors);
    s->shader_lights = vectors < 10 + 2 * 4 ? 1 : vectors < 10 + STAGE_LIGHTS * 4 ? 2 : STAGE_LIGHTS;
    if (!stage_upload(s, message))
        return refuse(out, s, 1);
    *out = s;
    return 0;
}

void stage_close(stage *s)
{
    if (!s)
        return;
    stage_release(s);
    gn_gles_destroy(s->gles);
    gn_shadow_cache_destroy(s->cache);
    gn_context_destroy(s->context);
    platform_close(s->platform);
    free(s);
}

int stage_renew_cache(stage *s)
{
    gn_shadow_cache_destroy(s->cache);
    return gn_shadow_cache_create(s->context, &s->cache_desc, &s->cache) == GN_OK;
}

/* About the vertical axis through the scene's centre. */
static void spin(const stage *s, double degrees, double p[3], int is_point)
{
    const double a = degrees * 3.14159265358979323846 / 180.0;
    const double x = p[0] - (is_point ? s->centre[0] : 0.0), z = p[2] - (is_point ? s->centre[2] : 0.0);

    p[0] = x * cos(a) + z * sin(a) + (is_point ? s->centre[0] : 0.0);
    p[2] = z * cos(a) - x * sin(a) + (is_point ? s->centre[2] : 0.0);
}

/* What the library is told of a light: all that bounds it. */
static void bound_light(const stage *s, gn_light *light, const scene_light *from)
{
    for (int i = 0; i < 3; i++)
        light->color[i] = from->color[i] * from->intensity * s->exposure * s->brightest;
    light->attenuation[2] = from->kind == SCENE_DIRECTIONAL ? 0.0 : 1.0;
    light->range = from->kind == SCENE_DIRECTIONAL ? 0.0 : from->range;
    /* a cone of a right angle bounds nothing */
    light->cone = from->kind == SCENE_SPOT && from->outer < 1.57 ? from->outer : 0.0;
    light->exempt = from->exempt;
    light->exempt_count = (uint32_t)from->exempt_count;
}

/* One of a scene's light's parts as shaders want it. */
static void shade_light(const stage *s, stage_light *to, const gn_light *light, const scene_light *from)
{
    const int is_sun = light->kind == GN_LIGHT_DIRECTIONAL;

    memset(to, 0, sizeof *to);
    for (int i = 0; i < 3; i++) {
        to->color[i] = (float)(from->color[i] * from->intensity * s->exposure / s->soft_count);
        to->shader_position[i] =
            (float)(is_sun ? light->towards[i] : light->position[i] - s->scene->camera.world[12 + i]);
        to->axis[i] = (float)-light->towards[i];
    }
    to->shader_position[3] = is_sun ? 0.0f : 1.0f;
    to->axis[3] = from->range > 0.0 ? (float)(1.0 / from->range) : 0.0f;
    to->cone[0] = 0.0f;
    to->cone[1] = 1.0f;
    if (from->kind == SCENE_SPOT) {
        const double scale = 1.0 / fmax(0.001, cos(from->inner) - cos(from->outer));

        to->cone[0] = (float)scale;
        to->cone[1] = (float)(-cos(from->outer) * scale);
    }
}

static void pose_light(stage *s, size_t index, double degrees)
{
    const scene_light *from = &s->scene->lights[index];
    const int is_sun = from->kind == SCENE_DIRECTIONAL;
    gn_light *lights = s->lights + index * s->soft_count, light;

    memset(&light, 0, sizeof light);
    light.kind = is_sun ? GN_LIGHT_DIRECTIONAL : from->kind == SCENE_SPOT ? GN_LIGHT_SPOT : GN_LIGHT_POINT;
    memcpy(light.position, from->position, sizeof light.position);
    memcpy(light.towards, from->towards, sizeof light.towards);
    if (degrees != 0.0) {
        spin(s, degrees, light.position, 1);
        spin(s, degrees, light.towards, 0);
    }
    bound_light(s, &light, from);
    gn_light_soften(s->context, &light, s->soft_radius, s->soft_count, lights);
    for (uint32_t i = 0; i < s->soft_count; i++)
        shade_light(s, &s->shading[index * s->soft_count + i], &lights[i], from);
}

void stage_pose(stage *s, double seconds, double spin_degrees)
{
    scene_pose(s->scene, seconds);
    stage_place_lights(s, spin_degrees);
}

void stage_place_lights(stage *s, double spin_degrees)
{
    for (size_t i = 0; i < s->scene->light_count; i++)
        pose_light(s, i, spin_degrees);
}

int stage_resize(stage *s, char message[SCENE_MESSAGE])
{
    const platform_desc *now = &s->platform->actual;
    const size_t length = gn_gles_save_target(s->gles, &s->target, NULL, 0);
    char *saved = malloc(length + 1); /* what was proven of the target is proven of another size */
    gn_result result = GN_E_MEMORY;

    if (saved) {
        gn_gles_save_target(s->gles, &s->target, saved, length + 1);
        result = gn_gles_describe_target(s->gles, now->width, now->height, saved, &s->target);
    }
    snprintf(message, SCENE_MESSAGE, "%s", saved ? gn_message(s->context) : "stage: no memory");
    free(saved);
    return result == GN_OK;
}

static void place_camera(const stage *s, gn_camera *camera)
{
    const scene_camera *from = &s->scene->camera;

    memset(camera, 0, sizeof *camera);
    memcpy(camera->world, from->world, sizeof camera->world);
    camera->orthographic = from->orthographic;
    camera->top = from->orthographic ? from->ymag : tan(0.5 * from->yfov);
    camera->right = from->orthographic ? from->xmag : camera->top * s->target.width / s->target.height;
    camera->bottom = -camera->top;
    camera->left = -camera->right;
    camera->znear = from->znear;
    camera->zfar = from->zfar;
    if (s->finite_far > 0.0) {
        camera->zfar = s->finite_far;
        camera->finite_far = 1;
    }
}

/* Whether the near rectangle may lie in the object's box: then the eye may see insides. */
static int eye_may_be_inside(const gn_camera *camera, const gn_object *object)
{
    const gn_mesh_info *info = gn_mesh_get_info(object->mesh);
    const double reach = camera->orthographic ? 1.0 : camera->znear;
    const double near_low[3] = {camera->left * reach, camera->bottom * reach, -camera->znear};
    const double near_high[3] = {camera->right * reach, camera->top * reach, -camera->znear};
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};

    for (int corner = 0; corner < 8; corner++) {
        double p[3];

        for (int axis = 0; axis < 3; axis++)
            p[axis] =
                (double)(corner >> axis & 1 ? info->box_max[axis] : info->box_min[axis]) + (double)info->centre[axis];
        gn_mat4_transform(p, object->model, p, 1.0);
        for (int axis = 0; axis < 3; axis++)
            p[axis] -= camera->world[12 + axis];
        for (int axis = 0; axis < 3; axis++) {
            const double *a = camera->world + 4 * axis, along = a[0] * p[0] + a[1] * p[1] + a[2] * p[2];

            low[axis] = fmin(low[axis], along);
            high[axis] = fmax(high[axis], along);
        }
    }
    for (int axis = 0; axis < 3; axis++) {
        const double margin = 1e-5 * (fabs(low[axis]) + fabs(high[axis]) + camera->znear);

        if (low[axis] > near_high[axis] + margin || high[axis] < near_low[axis] - margin)
            return 0;
    }
    return 1;
}

/* Backs are drawn of what is double-sided throughout. Those of what is closed, wound outward and seen from outside may
 * be drawn unseen: once, after the fronts, instead of a light cap for each light. */
static unsigned flags_of(const stage *s, const scene_instance *instance, const gn_camera *camera,
                         const gn_object *object, const stage_wish *wish)
{
    const scene_mesh *m = &s->scene->meshes[instance->mesh];
    const gn_mesh_info *info = gn_mesh_get_info(object->mesh);
    const uint32_t lights = wish->members ? s->light_count : wish->light_count; /* alike in all parts of a frame */
    const int hides_backs =
        lights >= MANY_LIGHTS && info->outward_part_count == info->part_count && !eye_may_be_inside(camera, object);
    unsigned flags = GN_DRAWN | GN_DRAWN_BACKS | (instance->casts && wish->casting ? GN_CASTS : 0u) |
                     (instance->receives ? GN_RECEIVES : 0u);

    for (size_t r = 0; r < m->range_count; r++) {
        const scene_material *material = &s->scene->materials[m->ranges[r].material];

        if (material->alpha == SCENE_MASK)
            flags &= ~(unsigned)GN_DRAWN;
        if (!material->double_sided && !hides_backs)
            flags &= ~(unsigned)GN_DRAWN_BACKS;
    }
    return flags;
}

size_t stage_drawn_object(const stage *s, size_t instance)
{
    const stage_mesh *m = &s->meshes[s->scene->instances[instance].mesh];

    return m->proxy ? s->scene->instance_count + instance : instance;
}

/* With proxies there are two objects for each instance: the first casts, and is drawn where it is no proxy. */
static void place_object(stage *s, size_t index, const gn_camera *camera, const stage_wish *wish)
{
    const scene_instance *instance = &s->scene->instances[index];
    const stage_mesh *m = &s->meshes[instance->mesh];
    gn_object *first = &s->objects[index], *drawn = &s->objects[stage_drawn_object(s, index)];

    for (size_t i = index; i <= index + (s->proxy_triangles ? s->scene->instance_count : 0);
         i += s->scene->instance_count) {
        memset(&s->objects[i], 0, sizeof s->objects[i]);
        s->objects[i].mesh = m->mesh;
        memcpy(s->objects[i].model, instance->world, sizeof s->objects[i].model);
    }
    drawn->flags = flags_of(s, instance, camera, drawn, wish);
    if (drawn == first || wish->full_casters)
        return;
    first->mesh = m->proxy;
    first->error = m->proxy_error;
    first->flags = drawn->flags & GN_CASTS;
    drawn->flags &= ~(unsigned)GN_CASTS;
}

/* A light without what bounds it. */
static void unbind(gn_light *light)
{
    const gn_light was = *light;

    memset(light, 0, sizeof *light);
    light->kind = was.kind;
    memcpy(light->position, was.position, sizeof was.position);
    memcpy(light->towards, was.towards, sizeof was.towards);
    light->exempt = was.exempt;
    light->exempt_count = was.exempt_count;
}

int stage_plan(stage *s, const stage_wish *wish, char message[SCENE_MESSAGE])
{
    gn_scene frame;
    gn_result result;
    size_t size;

    memset(&frame, 0, sizeof frame);
    place_camera(s, &frame.camera);
    for (size_t i = 0; i < s->scene->instance_count; i++)
        place_object(s, i, &frame.camera, wish);
    for (uint32_t i = 0; i < s->light_count; i++) {
        s->planned[i] = s->lights[i];
        if (wish->unbounded)
            unbind(&s->planned[i]);
    }
    s->member_count = wish->members ? wish->light_count : 0;
    for (uint32_t i = 0; i < s->member_count;
         i++) { /* to the front, in order: a member's number is no less than its place */
        s->members[i] = wish->members[i];
        s->planned[i] = s->planned[s->members[i]];
    }
    frame.lights = s->planned + (wish->members ? 0 : wish->first_light);
    frame.follows = wish->follows;
    frame.precedes = wish->precedes;
    frame.light_count = wish->light_count;
    frame.objects = s->objects;
    frame.object_count = (uint32_t)(s->scene->instance_count * (s->proxy_triangles ? 2 : 1));
    frame.target = s->target;
    frame.method = wish->method;
    frame.one_sided = wish->one_sided;
    frame.blend_once = wish->blend_once;
    frame.least_light = wish->least_light;
    frame.reads_masks = 1;
    frame.lights_per_pass = wish->lights_per_pass ? wish->lights_per_pass : s->shader_lights;
    frame.shade = wish->shade;
    frame.dimmed = wish->dimmed;
    frame.merges_lights = wish->merges_lights;
    frame.scale = wish->scale;
    frame.upsample = wish->upsample;
    frame.sharpen = wish->sharpen;
    frame.without = wish->without;
    frame.cache = wish->keeps ? s->cache : NULL;
    size = gn_plan_bound(&frame);
    if (size > s->plan_size) {
        free(s->plan_memory);
        s->plan_memory = malloc(size);
        s->plan_size = s->plan_memory ? size : 0;
    }
    if (!s->plan_memory) {
        snprintf(message, SCENE_MESSAGE, "plan: no memory for %lu bytes", (unsigned long)size);
        return 1;
    }
    result = gn_plan_make(s->context, &frame, s->plan_memory, s->plan_size, &s->plan);
    if (result != GN_OK)
        snprintf(message, SCENE_MESSAGE, "%s", gn_message(s->context));
    return result == GN_OK ? 0 : result == GN_E_DEVICE ? 3 : 1;
}
