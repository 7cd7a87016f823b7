/* probe.c - `gnomon probe`: what the context is, what it says that it can do and what of that is true, and which
 * methods that makes possible. It never fails because something is absent. */
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
    "Prints the GL contexts that this machine gives: driver, limits, bits; for each capability whether it is "
    "advertised,\n"
    "proven (drawn into a few pixels and read back) or hidden; and for each method whether it is possible, or what is\n"
    "missing.\n"
    "\n"
    "  --platform NAME       only this one: egl or osmesa [all]\n"
    "  --hide CAP[,CAP...]   pretends that capabilities are absent, as GNOMON_HIDE in the environment does\n"
    "  --save FILE           what the first context proved, as gn_gles_save_target() writes it: for programs on this "
    "very\n"
    "                        driver that have not the time, or not the code, to prove it themselves\n"
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

/* Whether a method can draw into the target, and how, or why not: what the plan of an empty frame says. */
static void add_method(cJSON *to, gn_context *context, gn_method method, const gn_target *target)
{
    static const char *const places[] = {"", "the target's alpha", "the target's colour", "an image"};
    static double memory[4096];
    gn_light light;
    char text[320];
    gn_scene s;
    const gn_plan *plan;

    memset(&light, 0, sizeof light);
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
    s.reads_masks = 1;
    if (gn_plan_make(context, &s, memory, sizeof memory, &plan) != GN_OK) {
        cJSON_AddStringToObject(to, gn_method_describe(method)->name, gn_message(context));
        return;
    }
    if (plan->lights[0].color.place == GN_PLACE_STENCIL)
        snprintf(text, sizeof text, "possible%s; %d layers at once, more in batches",
                 plan->lights[0].reason + strcspn(plan->lights[0].reason, ";"), plan->lights[0].stencil.high);
    else
        snprintf(text, sizeof text, "possible%s; in %s; %d fragments of one side over a pixel at once, more in batches",
                 plan->lights[0].reason + strcspn(plan->lights[0].reason, ";"), places[plan->lights[0].color.place],
                 plan->lights[0].color.limit);
    cJSON_AddStringToObject(to, gn_method_describe(method)->name, text);
}

static void add_capabilities(cJSON *to, const gn_gles *gles, const gn_target *t)
{
    cJSON *const all = cJSON_AddObjectToObject(to, "capabilities");

    for (int c = 0; c < GN_CAPABILITY_COUNT; c++) {
        cJSON *const o = cJSON_AddObjectToObject(all, gn_capability_name((gn_capability)c));
        const char *const symptom = gn_gles_symptom(gles, (gn_capability)c);

        cJSON_AddBoolToObject(o, "advertised", t->advertised >> c & 1);
        cJSON_AddBoolToObject(o, "proven", t->proven >> c & 1);
        cJSON_AddBoolToObject(o, "hidden", t->hidden >> c & 1);
        if (symptom[0])
            cJSON_AddStringToObject(o, "symptom", symptom);
    }
}

static void add_bits(cJSON *to, const gn_target *t)
{
    cJSON *const bits = cJSON_AddObjectToObject(to, "bits");
    const struct {
        const char *name;
        int bits;
    } rows[] = {{"red", t->red_bits},     {"green", t->green_bits},    {"blue", t->blue_bits},
                {"alpha", t->alpha_bits}, {"depth", t->depth_bits},    {"stencil", t->stencil_bits},
                {"samples", t->samples},  {"mediump", t->mediump_bits}};

    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        cJSON_AddNumberToObject(bits, rows[i].name, rows[i].bits);
}

static cJSON *describe(platform *p, gn_context *context, const gn_gles *gles, const gn_target *t)
{
    const gn_gl *gl = gn_gles_functions(gles);
    cJSON *const o = cJSON_CreateObject(), *methods, *numbers;

    cJSON_AddStringToObject(o, "platform", p->kind->name);
    cJSON_AddStringToObject(o, "way", p->detail);
    for (size_t i = 0; i < sizeof strings / sizeof strings[0]; i++) {
        const GLubyte *text = gl->glGetString(strings[i].value);

        cJSON_AddStringToObject(o, strings[i].name, text ? (const char *)text : "");
    }
    add_bits(o, t);
    numbers = cJSON_AddObjectToObject(o, "limits");
    for (size_t i = 0; i < sizeof limits / sizeof limits[0]; i++) {
        GLint value = 0;

        gl->glGetIntegerv(limits[i].value, &value);
        cJSON_AddNumberToObject(numbers, limits[i].name, value);
    }
    while (gl->glGetError() != GL_NO_ERROR) /* a limit that the context does not know stays 0 */
        continue;
    add_capabilities(o, gles, t);
    methods = cJSON_AddObjectToObject(o, "methods");
    for (int m = GN_METHOD_AUTO + 1; m < GN_METHOD_TOTAL; m++)
        add_method(methods, context, (gn_method)m, t);
    return o;
}

/* saved: becomes the text of gn_gles_save_target(), the caller's to free; stays NULL where there is no context. */
static cJSON *probe(const platform_kind *kind, const char *hide, char **saved)
{
    const platform_desc wanted = {64, 64, 8, 8, 8, 8, 24, 8};
    char message[PLATFORM_MESSAGE];
    platform *p = platform_open(kind->name, &wanted, message);
    const gn_gles_desc desc = {platform_get_proc, p, hide};
    gn_port port = gn_port_libc();
    gn_context *context = NULL;
    gn_gles *gles = NULL;
    gn_target target;
    cJSON *o = NULL;

    port.log = NULL; /* what fails stands in the table */
    if (p && gn_context_create(&port, &context) == GN_OK && gn_gles_create(context, &desc, &gles) == GN_OK &&
        gn_gles_describe_target(gles, p->actual.width, p->actual.height, NULL, &target) == GN_OK)
        o = describe(p, context, gles, &target);
    if (o) {
        const size_t length = gn_gles_save_target(gles, &target, NULL, 0);

        *saved = length ? malloc(length + 1) : NULL;
        if (*saved)
            gn_gles_save_target(gles, &target, *saved, length + 1);
    }
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

enum { NAMES = 32 }; /* width of the first column */

static void print_capability(const cJSON *row)
{
    const cJSON *const symptom = cJSON_GetObjectItem(row, "symptom");

    printf("  %-*s%-12s%-9s%-8s%s\n", NAMES - 2, row->string,
           cJSON_IsTrue(cJSON_GetObjectItem(row, "advertised")) ? "yes" : "no",
           cJSON_IsTrue(cJSON_GetObjectItem(row, "proven")) ? "yes" : "no",
           cJSON_IsTrue(cJSON_GetObjectItem(row, "hidden")) ? "yes" : "no", symptom ? symptom->valuestring : "");
}

static void print_table(const cJSON *o, int indent)
{
    const cJSON *row;

    cJSON_ArrayForEach (row, o) {
        const int is_set = strcmp(row->string, "capabilities") == 0;

        if (indent && cJSON_IsObject(row)) {
            print_capability(row);
            continue;
        }
        printf("%*s%-*s", indent, "", NAMES - indent, row->string);
        if (cJSON_IsObject(row)) {
            printf("%s\n", is_set ? "advertised  proven   hidden" : "");
            print_table(row, indent + 2);
        } else if (cJSON_IsNumber(row)) {
            printf("%g\n", row->valuedouble);
        } else {
            printf("%s\n", row->valuestring);
        }
    }
}

static int write_saved(const char *path, const char *saved)
{
    fresh_file f;

    if (!saved) {
        say("%s: no context of which anything could be saved", path);
        return EXIT_MISSING;
    }
    return fresh_open(&f, path) && fresh_close(&f, fputs(saved, f.file) >= 0) ? EXIT_DONE : EXIT_FAILED;
}

int command_probe(int count, char **arguments)
{
    const char *only = NULL, *hide = NULL, *save = NULL;
    int json = 0, known = 0;
    const option options[] = {{"--platform", OPTION_TEXT, &only, 0, 0},
                              {"--hide", OPTION_TEXT, &hide, 0, 0},
                              {"--save", OPTION_TEXT, &save, 0, 0},
                              {"--json", OPTION_FLAG, &json, 0, 0}};
    cJSON *all;
    char *text, *saved = NULL;
    int status;

    count = parse_options(count, arguments, options, 4);
    if (count != 0) {
        if (count > 0)
            say("probe: takes no names (%s)", arguments[0]);
        return EXIT_USAGE;
    }
    if (!check_hidden("--hide", hide) || !check_hidden("GNOMON_HIDE", getenv("GNOMON_HIDE")))
        return EXIT_USAGE;
    all = cJSON_CreateArray();
    for (int i = 0; platform_kinds[i]; i++) {
        char *of_this = NULL;
        cJSON *o;

        if (only && strcmp(only, platform_kinds[i]->name) != 0)
            continue;
        known = 1;
        o = probe(platform_kinds[i], hide, &of_this);
        if (!saved)
            saved = of_this;
        else
            free(of_this);
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
    status = save ? write_saved(save, saved) : EXIT_DONE;
    free(saved);
    return status;
}
