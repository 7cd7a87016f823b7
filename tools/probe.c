/* probe.c - `gnomon probe`: what the context is, and which methods it can do. It never fails because something is
 * absent. */
#include "command.h"

#include <cjson/cJSON.h>
#include <stdlib.h>
#include <string.h>

#include "gnomon_gles.h"
#include "options.h"
#include "platform.h"

const char help_probe[] =
    "usage: gnomon probe [options]\n"
    "\n"
    "Prints the GL contexts that this machine gives, with their limits, bits, and the methods they can do.\n"
    "\n"
    "  --platform NAME       only this one: egl or osmesa [all]\n"
    "  --json                for machines\n"
    "  --help                this text\n";

static const struct {
    const char *name;
    GLenum value;
} strings[] = {{"driver", GL_VERSION}, {"renderer", GL_RENDERER}, {"vendor", GL_VENDOR}, {"shading_language", 0x8B8C}},
  limits[] = {{"max_texture_size", GL_MAX_TEXTURE_SIZE},
              {"max_renderbuffer_size", GL_MAX_RENDERBUFFER_SIZE},
              {"max_vertex_attribs", GL_MAX_VERTEX_ATTRIBS},
              {"max_vertex_uniform_vectors", GL_MAX_VERTEX_UNIFORM_VECTORS},
              {"max_fragment_uniform_vectors", GL_MAX_FRAGMENT_UNIFORM_VECTORS}};

/* Why a method cannot draw into the target; NULL when it can. */
static const char *obstacle(gn_context *context, gn_method method, const gn_target *target)
{
    static double memory[4096];
    gn_light light = {GN_LIGHT_POINT, {0, 0, 0}, {0, 0, 0}};
    gn_scene s;
    const gn_plan *plan;

    memset(&s, 0, sizeof s);
    for (int i = 0; i < 4; i++)
        s.camera.world[5 * i] = 1.0;
    s.camera.left = s.camera.bottom = -1.0;
    s.camera.right = s.camera.top = 1.0;
    s.camera.znear = 1.0;
    s.lights = &light;
    s.light_count = 1;
    s.target = *target;
    s.method = method;
    return gn_plan_make(context, &s, memory, sizeof memory, &plan) == GN_OK ? NULL : gn_message(context);
}

static cJSON *describe(platform *p, gn_context *context, const gn_gles *gles)
{
    const gn_gl *gl = gn_gles_functions(gles);
    const gn_target t = gn_gles_describe_target(gles, p->actual.width, p->actual.height);
    cJSON *const o = cJSON_CreateObject(), *bits, *methods, *numbers;

    cJSON_AddStringToObject(o, "platform", p->kind->name);
    cJSON_AddStringToObject(o, "way", p->detail);
    for (size_t i = 0; i < sizeof strings / sizeof strings[0]; i++) {
        const GLubyte *text = gl->glGetString(strings[i].value);

        cJSON_AddStringToObject(o, strings[i].name, text ? (const char *)text : "");
    }
    bits = cJSON_AddObjectToObject(o, "bits");
    cJSON_AddNumberToObject(bits, "red", t.red_bits);
    cJSON_AddNumberToObject(bits, "green", t.green_bits);
    cJSON_AddNumberToObject(bits, "blue", t.blue_bits);
    cJSON_AddNumberToObject(bits, "alpha", t.alpha_bits);
    cJSON_AddNumberToObject(bits, "depth", t.depth_bits);
    cJSON_AddNumberToObject(bits, "stencil", t.stencil_bits);
    cJSON_AddNumberToObject(bits, "samples", t.samples);
    numbers = cJSON_AddObjectToObject(o, "limits");
    for (size_t i = 0; i < sizeof limits / sizeof limits[0]; i++) {
        GLint value = 0;

        gl->glGetIntegerv(limits[i].value, &value);
        cJSON_AddNumberToObject(numbers, limits[i].name, value);
    }
    while (gl->glGetError() != GL_NO_ERROR) /* a limit that the context does not know stays 0 */
        continue;
    methods = cJSON_AddObjectToObject(o, "methods");
    for (int m = GN_METHOD_AUTO + 1; m < GN_METHOD_COUNT; m++) {
        const char *const why = obstacle(context, (gn_method)m, &t);

        cJSON_AddStringToObject(methods, gn_method_describe((gn_method)m)->name, why ? why : "possible");
    }
    return o;
}

static cJSON *probe(const platform_kind *kind)
{
    const platform_desc wanted = {64, 64, 8, 8, 8, 8, 24, 8};
    char message[PLATFORM_MESSAGE];
    platform *p = platform_open(kind->name, &wanted, message);
    gn_context *context = NULL;
    gn_gles *gles = NULL;
    cJSON *o = NULL;

    if (p && gn_context_create(NULL, &context) == GN_OK &&
        gn_gles_create(context, platform_get_proc, p, &gles) == GN_OK)
        o = describe(p, context, gles);
    if (!o) {
        o = cJSON_CreateObject();
        cJSON_AddStringToObject(o, "platform", kind->name);
        cJSON_AddStringToObject(o, "absent", p ? gn_message(context) : message);
    }
    gn_gles_destroy(gles);
    gn_context_destroy(context);
    platform_close(p);
    return o;
}

static void print_table(const cJSON *o, int indent)
{
    const cJSON *row;

    cJSON_ArrayForEach (row, o) {
        printf("%*s%-*s", indent, "", 30 - indent, row->string);
        if (cJSON_IsObject(row)) {
            printf("\n");
            print_table(row, indent + 2);
        } else if (cJSON_IsNumber(row)) {
            printf("%g\n", row->valuedouble);
        } else {
            printf("%s\n", row->valuestring);
        }
    }
}

int command_probe(int count, char **arguments)
{
    const char *only = NULL;
    int json = 0, known = 0;
    const option options[] = {{"--platform", OPTION_TEXT, &only, 0, 0}, {"--json", OPTION_FLAG, &json, 0, 0}};
    cJSON *all;
    char *text;

    count = parse_options(count, arguments, options, 2);
    if (count != 0) {
        if (count > 0)
            say("probe: takes no names (%s)", arguments[0]);
        return EXIT_USAGE;
    }
    all = cJSON_CreateArray();
    for (int i = 0; platform_kinds[i]; i++) {
        cJSON *o;

        if (only && strcmp(only, platform_kinds[i]->name) != 0)
            continue;
        known = 1;
        o = probe(platform_kinds[i]);
        cJSON_AddItemToArray(all, o);
        if (!json) {
            print_table(o, 0);
            printf("\n");
        }
    }
    if (!known) {
        say("--platform: no platform has that name (%s)", only);
        cJSON_Delete(all);
        return EXIT_USAGE;
    }
    text = json ? cJSON_Print(all) : NULL;
    if (text)
        printf("%s\n", text);
    free(text);
    cJSON_Delete(all);
    return EXIT_DONE;
}
