/* truth_table.c - masks of scenes against the ray-traced truth: for every driver here and every way to draw them.
 *
 *     truth_table [--size WxH] [--drivers LIST] [--depth BITS] [--bits R,G,B,A,D,S] [--ways LIST] [--extremes]
 *                 [--pixels] SCENES_DIR [SCENE...]
 *
 * A row for each scene, driver, light and way: z-fail and z-pass as the driver can; z-fail with capabilities hidden,
 * which must be the same bits (one-sided, saturating, both; and stencil by McGuire's cases) or as right (ended; under a
 * far plane of the camera's own finite, finite-end; unless refused). With --ways those that it names, and only these
 * count without a stencil: where a plan warns of its range, or that it cuts a caster, wrong pixels are no failure.
 *
 * SCENES_DIR holds the .gltf files and scenes.txt, which says of each scene whether z-pass is right there (zpass,
 * nozpass) and whether a slow rasteriser draws it (small, large) or it is one of the extremes, which --extremes draws
 * instead of the others: by z-fail and stencil, on every driver, or by --ways. --depth and --bits ask for as many bits:
 * what needs others is left out, and where the plan warns that they are too few, wrong pixels are no failure. Drivers: llvmpipe and softpipe through EGL, osmesa,
 * and zink over SwiftShader where Debian's chromium-common is installed; softpipe takes small scenes.
 *
 * A rasteriser that draws a shared edge twice, or not at all, at some pixel cannot count volumes there (Everitt 2002,
 * section 3.1, asks for watertight rasterisation). softpipe is such: where its number of fragments at a wrong pixel is
 * not llvmpipe's, the pixel stands under "cracks" and not under "wrong", as long as there are no more of them than one
 * in 10,000.
 *
 * SwiftShader places vertices to 1/16 pixel, and its depths of triangles that reach infinity stray: what the truth is
 * certain of at 1/256 pixel it may get wrong. No way of it may be wrong in one pixel of 2,000 more than its z-fail.
 *
 * The truth of a light is traced once; then each driver draws in a process of its own, since Mesa picks its
 * rasteriser once a process, into memory that all share. Fails when a certain pixel is wrong where the way must be
 * right, when two ways differ that must not, when fewer than 80 % of the pixels are certain, or when the masks of
 * llvmpipe and osmesa differ in a single byte. */
#define _DEFAULT_SOURCE
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include "stage.h"
#include "truth.h"

#define MOST_LIGHTS 5 /* of a scene; more would say the same again */

#define SWIFTSHADER "/usr/lib/chromium/vk_swiftshader_icd.json" /* of Debian's chromium-common */

typedef struct driver {
    const char *name, *platform, *gallium, *needs; /* needs: a file, or NULL */
    int slow, cracks;
    int rough; /* coordinates of less than 1/256 pixel, or depths that stray: only compared with itself */
} driver;

static const driver drivers[] = {
    {"llvmpipe", "egl", "llvmpipe", NULL, 0, 0, 0},
    {"osmesa", "osmesa", "llvmpipe", NULL, 0, 0, 0},
    {"softpipe", "egl", "softpipe", NULL, 1, 1, 0},
    {"zink", "egl", "zink", SWIFTSHADER, 0, 0, 1},
};

#define BIT(capability) (1u << (capability))

/* What is drawn: a method, with capabilities hidden. */
typedef struct way {
    const char *name;
    gn_method method;
    uint32_t hidden;
    int same;         /* to the last bit what the first way draws */
    int may_end;      /* volumes end; a light that is too near may be refused */
    int finite;       /* the camera has a far plane of its own, at twice the distance of all there is */
    int slivers;      /* slivers may be lost: few pixels are wrong, and none of them fails the table */
    unsigned without; /* of gn_measure */
} way;

static const way ways[] = {
    {"zfail", GN_METHOD_ZFAIL, 0, 0, 0, 0, 0, 0},
    {"zpass", GN_METHOD_ZPASS, 0, 0, 0, 0, 0, 0},
    {"stencil", GN_METHOD_STENCIL, 0, 0, 0, 0, 0, 0},
    {"unmeasured", GN_METHOD_STENCIL, 0, 1, 0, 0, 0, ~0u},
    {"one-sided", GN_METHOD_ZFAIL, BIT(GN_CAN_TWO_SIDED_STENCIL), 1, 0, 0, 0, 0},
    {"culled", GN_METHOD_ZFAIL, BIT(GN_CAN_TWO_SIDED_STENCIL) | BIT(GN_CAN_FRONT_FACING), 0, 0, 0, 1, 0},
    {"saturating", GN_METHOD_ZFAIL, BIT(GN_CAN_STENCIL_WRAP), 1, 0, 0, 0, 0},
    {"both", GN_METHOD_ZFAIL, BIT(GN_CAN_TWO_SIDED_STENCIL) | BIT(GN_CAN_STENCIL_WRAP), 1, 0, 0, 0, 0},
    {"ended", GN_METHOD_ZFAIL, BIT(GN_CAN_W0), 0, 0, 0, 0, 0},
    {"finite", GN_METHOD_ZFAIL, 0, 0, 1, 1, 0, 0},
    {"finite-end", GN_METHOD_ZFAIL, BIT(GN_CAN_DEPTH_CLAMP), 0, 1, 1, 0, 0},
    {"refine", GN_METHOD_REFINE, 0, 0, 0, 0, 0, 0},
    {"count", GN_METHOD_COUNT, 0, 0, 0, 0, 0, 0},
    {"count-565", GN_METHOD_COUNT, BIT(GN_CAN_FBO_RGBA8), 0, 0, 0, 0, 0},
    {"count-two", GN_METHOD_COUNT, BIT(GN_CAN_FRONT_FACING), 0, 0, 0, 1, 0},
    {"signed", GN_METHOD_SIGNED, 0, 0, 0, 0, 0, 0},
    {"signed-fbo", GN_METHOD_SIGNED, BIT(GN_CAN_ALPHA), 0, 0, 0, 0, 0},
    {"alpha", GN_METHOD_ALPHA, 0, 0, 0, 0, 0, 0},
    {"screen", GN_METHOD_SCREEN, 0, 0, 0, 0, 0, 0},
    {"mediump", GN_METHOD_COUNT, BIT(GN_CAN_FRAGMENT_HIGHP), 0, 0, 0, 0, 0},
};
enum { DRIVERS = sizeof drivers / sizeof drivers[0], WAYS = sizeof ways / sizeof ways[0] };
enum { IS_DRAWN = 4 }; /* in masks, beside lit 1 and visible 2 */

typedef struct job {
    char name[64];
    int zpass_is_right, is_large, extremes, is_poor;
    int bits[6];      /* red, green, blue, alpha, depth, stencil */
    int list_pixels;  /* print each wrong one */
    const char *ways; /* those that are drawn, with commas between; NULL: all */
    uint32_t width, height;
    size_t lights;
    uint8_t *lit, *visible, *classes; /* [lights][pixels] of the truth */
    uint8_t *drawn;                   /* shared: [DRIVERS][WAYS][MOST_LIGHTS][pixels]: lit 1, visible 2, IS_DRAWN */
    uint8_t *warned;                  /* shared: [DRIVERS][WAYS][MOST_LIGHTS]: of too few bits of depth */
    uint8_t *layers;                  /* shared, the same: fragments of volumes and surfaces, as one number */
} job;

static size_t pixels_of(const job *j)
{
    return (size_t)j->width * j->height;
}

/* Where the pixels of one drawing start, in masks and in layers. */
static size_t place_of(const job *j, int d, int w, size_t light)
{
    return (((size_t)d * WAYS + (size_t)w) * MOST_LIGHTS + light) * pixels_of(j);
}

/* Twice as far as the farthest corner of the scene. */
static double far_of(const scene *s)
{
    double farthest = 0.0;

    for (int corner = 0; corner < 8; corner++) {
        double square = 0.0;

        for (int i = 0; i < 3; i++) {
            const double d = (corner >> i & 1 ? s->bounds_max[i] : s->bounds_min[i]) - s->camera.world[12 + i];

            square += d * d;
        }
        farthest = fmax(farthest, sqrt(square));
    }
    return 2.0 * farthest;
}

/* A whole word of a list with commas between. */
static int is_wanted(const char *list, const char *name)
{
    const size_t length = strlen(name);

    for (const char *at = list; at; at = strchr(at, ',') ? strchr(at, ',') + 1 : NULL)
        if (strncmp(at, name, length) == 0 && (at[length] == ',' || at[length] == '\0'))
            return 1;
    return 0;
}

/* 1 where each name of the list is a way's. */
static int are_ways(const char *list)
{
    for (const char *at = list; at; at = strchr(at, ',') ? strchr(at, ',') + 1 : NULL) {
        int known = 0;

        for (int w = 0; w < WAYS; w++) {
            const size_t length = strlen(ways[w].name);

            known |= strncmp(at, ways[w].name, length) == 0 && (at[length] == ',' || at[length] == '\0');
        }
        if (!known)
            return 0;
    }
    return 1;
}

/* What the plan says beforehand: a warning, or of a count in colour that a caster is cut. */
static uint8_t is_warned(const gn_plan *plan, gn_method method)
{
    return plan->warnings != 0 || (method >= GN_METHOD_COUNT && plan->lights[0].cut_casters > 0);
}

/* In a process of its own. */
static int draw_masks(const job *j, scene *loaded, int d)
{
    const stage_options options = {.platform = drivers[d].platform,
                                   .width = j->width,
                                   .height = j->height,
                                   .depth_bits = j->bits[4],
                                   .stencil_bits = j->bits[5],
                                   .color_bits = j->bits};
    char message[SCENE_MESSAGE] = "";
    uint8_t *rgba = malloc(4 * pixels_of(j));
    stage *s;
    int failed;

    setenv("GALLIUM_DRIVER", drivers[d].gallium, 1);
    if (drivers[d].needs) {
        setenv("MESA_LOADER_DRIVER_OVERRIDE", drivers[d].gallium, 1);
        setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
        setenv("VK_ICD_FILENAMES", drivers[d].needs, 1);
    }
    failed = !rgba || stage_open(&s, loaded, &options, message) != 0;
    if (!failed)
        stage_pose(s, 0.0, 0.0);
    for (uint32_t light = 0; !failed && light < j->lights; light++)
        for (int w = 0; !failed && w < WAYS; w++) {
            const stage_wish wish = {.method = ways[w].method,
                                     .casting = 1,
                                     .first_light = light,
                                     .light_count = 1,
                                     .unbounded = 1,
                                     .without = ways[w].without};
            const size_t at = place_of(j, d, w, light);
            int status;

            if (j->extremes && ways[w].method != GN_METHOD_STENCIL && w > 0 && !j->ways)
                continue;
            if (j->ways ? !is_wanted(j->ways, ways[w].name) : ways[w].method >= GN_METHOD_REFINE)
                continue;
            if (ways[w].finite && (loaded->camera.orthographic || loaded->camera.zfar > 0.0))
                continue;
            s->finite_far = ways[w].finite ? far_of(loaded) : 0.0;
            s->target.hidden = ways[w].hidden;
            status = stage_plan(s, &wish, message);
            if (status == 3 && j->is_poor) /* the target lacks what this way needs */
                continue;
            if (status == 3 && ways[w].may_end && strstr(message, "no end of the volume")) /* refused in words */
                continue;
            if (status == 0)
                j->warned[((size_t)d * WAYS + (size_t)w) * MOST_LIGHTS + light] = is_warned(s->plan, ways[w].method);
            failed = status != 0 || !stage_draw_mask(s, light, message) || !platform_read_back(s->platform, rgba);
            for (size_t i = 0; !failed && i < pixels_of(j); i++)
                j->drawn[at + i] = (uint8_t)((rgba[4 * i] > 127) | (rgba[4 * i + 1] > 127) << 1 | IS_DRAWN);
            if (!failed) {
                stage_draw_layers(s);
                failed = !platform_read_back(s->platform, rgba);
            }
            for (size_t i = 0; !failed && i < pixels_of(j); i++)
                j->layers[at + i] = (uint8_t)(rgba[4 * i] + 37 * rgba[4 * i + 1]);
        }
    if (failed)
        printf("%-18s %-9s cannot be drawn: %s\n", j->name, drivers[d].name, message);
    fflush(stdout);
    _exit(failed);
}

/* The truth knows no lists: what is exempt in a light casts not while that light is traced. */
static truth *trace_light(job *j, scene *loaded, truth *common, size_t light, char message[SCENE_MESSAGE])
{
    const truth_options options = {j->width, j->height, j->bits[4], {0, 0}};
    const scene_light *l = &loaded->lights[light];
    const size_t at = light * pixels_of(j);
    truth *t = common, *own = NULL;
    int casts[64];

    for (size_t i = 0; i < l->exempt_count && i < 64; i++) {
        casts[i] = loaded->instances[l->exempt[i]].casts;
        loaded->instances[l->exempt[i]].casts = 0;
    }
    if (l->exempt_count)
        t = own = truth_create(loaded, &options, message);
    else if (!common)
        t = common = truth_create(loaded, &options, message);
    for (size_t i = 0; i < l->exempt_count && i < 64; i++)
        loaded->instances[l->exempt[i]].casts = casts[i];
    if (!t || !truth_light(t, light, j->lit + at, j->visible + at, j->classes + at, message))
        printf("%-18s has no truth: %s\n", j->name, message);
    truth_free(own);
    return common;
}

static int trace(job *j, scene *loaded)
{
    const size_t size = (j->lights ? j->lights : 1) * pixels_of(j);
    char message[SCENE_MESSAGE] = "";
    truth *common = NULL;

    j->lit = malloc(size);
    j->visible = malloc(size);
    j->classes = malloc(size);
    for (size_t light = 0; light < j->lights && !message[0]; light++)
        common = trace_light(j, loaded, common, light, message);
    truth_free(common);
    return !message[0];
}

/* Certain pixels that a way gets wrong. */
static size_t count_wrong(const job *j, int d, int w, size_t light)
{
    const size_t n = pixels_of(j), at = light * n;
    const uint8_t *mask = j->drawn + place_of(j, d, w, light);
    size_t wrong = 0;

    for (size_t i = 0; i < n; i++)
        wrong += j->classes[at + i] == TRUTH_CERTAIN &&
                 mask[i] != (uint8_t)(IS_DRAWN | (j->lit[at + i] != 0) | (j->visible[at + i] != 0) << 1);
    return wrong;
}

/* A driver that places vertices roughly may lose single pixels, by z-fail as by anything else, but no shadow. Counted before
 * what is seen, volumes without ends are another matter there: their depths stray. */
static int is_worse(const job *j, int d, int w, size_t light, size_t wrong)
{
    const int can_tell = drivers[d].rough && ways[w].without == 0 && j->drawn[place_of(j, d, 0, light)] & IS_DRAWN;

    return can_tell && wrong > count_wrong(j, d, 0, light) + pixels_of(j) / 2000;
}

/* Prints a row; returns 1 when it is a failure. */
static int compare(const job *j, int d, int w, size_t light)
{
    const size_t n = pixels_of(j), at = light * n;
    const uint8_t *mask = j->drawn + place_of(j, d, w, light), *layers = j->layers + place_of(j, d, w, light);
    const uint8_t *sound = j->layers + place_of(j, 0, w, light);
    const int must_be_right = ways[w].method != GN_METHOD_ZPASS || j->zpass_is_right;
    const int is_warned = j->warned[((size_t)d * WAYS + (size_t)w) * MOST_LIGHTS + light];
    const int is_rough = drivers[d].rough || ways[w].slivers || is_warned;
    /* before and behind what is seen there are as many fragments only where rasterising is watertight */
    const int may_differ = ways[w].method == GN_METHOD_STENCIL && (drivers[d].cracks || drivers[d].rough);
    const int differs = ways[w].same && !may_differ && memcmp(mask, j->drawn + place_of(j, d, 0, light), n) != 0;
    size_t certain = 0, depth_limited = 0, wrong = 0, cracks = 0;
    int few, worse;

    if (!(mask[0] & IS_DRAWN) && (j->extremes || j->is_poor || j->ways || ways[w].method >= GN_METHOD_REFINE))
        return 0;
    if (!(mask[0] & IS_DRAWN)) {
        printf("%-18s %-9s %-10s %5lu  not drawn\n", j->name, drivers[d].name, ways[w].name, (unsigned long)light);
        return 0;
    }
    for (size_t i = 0; i < n; i++) {
        const uint8_t right = (uint8_t)(IS_DRAWN | (j->lit[at + i] != 0) | (j->visible[at + i] != 0) << 1);

        depth_limited += j->classes[at + i] == TRUTH_DEPTH_LIMITED;
        if (j->classes[at + i] != TRUTH_CERTAIN)
            continue;
        certain++;
        if (mask[i] == right)
            continue;
        if (drivers[d].cracks && layers[i] != sound[i])
            cracks++;
        else
            wrong++;
        if (j->list_pixels && must_be_right)
            printf("  pixel %lu, %lu: %s%s drawn\n", (unsigned long)(i % j->width), (unsigned long)(i / j->width),
                   mask[i] & 1 ? "lit" : "shadowed", mask[i] & 2 ? "" : ", nothing");
    }
    if (cracks > n / 10000) { /* a few lie on edges; more are something else */
        wrong += cracks;
        cracks = 0;
    }
    worse = must_be_right && !is_warned && is_worse(j, d, w, light, wrong);
    few = certain * 10 < n * (j->extremes ? 7 : 8); /* a light on a vertex leaves more in doubt */
    printf("%-18s %-9s %-10s %5lu %8.2f%% %7lu %7lu %7lu%s%s%s\n", j->name, drivers[d].name, ways[w].name,
           (unsigned long)light, 100.0 * (double)certain / (double)n, (unsigned long)depth_limited,
           (unsigned long)wrong, (unsigned long)cracks,
           !must_be_right ? "  (not for this view)"
           : !wrong       ? ""
           : is_warned    ? "  (warned)"
           : worse        ? "  WRONG, and not by z-fail"
           : is_rough     ? "  (rough)"
                          : "  WRONG",
           few ? "  TOO FEW CERTAIN" : "", differs ? "  DIFFERS from zfail" : "");
    return few || differs || worse || (must_be_right && wrong && !is_rough);
}

static int run(job *j, const char *dir, const char *wanted_drivers)
{
    char path[1024], message[SCENE_MESSAGE] = "";
    const size_t shared = (size_t)DRIVERS * WAYS * MOST_LIGHTS * pixels_of(j);
    int failures = 0, drawn[DRIVERS] = {0};
    scene loaded;

    snprintf(path, sizeof path, "%s/%s.gltf", dir, j->name);
    if (!scene_load(&loaded, path, NULL, message) ||
        !scene_ensure_view(&loaded, (double)j->width / (double)j->height, NULL)) {
        printf("%-18s cannot be loaded: %s\n", j->name, message);
        return 1;
    }
    j->lights = loaded.light_count < MOST_LIGHTS ? loaded.light_count : MOST_LIGHTS;
    j->drawn = mmap(NULL, 2 * shared + DRIVERS * WAYS * MOST_LIGHTS, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS,
                    -1, 0);
    j->layers = j->drawn + shared;
    j->warned = j->layers + shared;
    if (j->drawn == MAP_FAILED || !trace(j, &loaded))
        return 1;
    for (int d = 0; d < DRIVERS; d++) {
        int status = 1;
        pid_t child;

        if (!strstr(wanted_drivers, drivers[d].name) || (drivers[d].slow && j->is_large) ||
            (drivers[d].needs && access(drivers[d].needs, R_OK) != 0))
            continue;
        child = fork();
        if (child == 0)
            draw_masks(j, &loaded, d);
        if (child < 0 || waitpid(child, &status, 0) != child || status != 0) {
            failures++;
            continue;
        }
        drawn[d] = 1;
        for (int w = 0; w < WAYS; w++)
            for (size_t light = 0; light < j->lights; light++)
                failures += compare(j, d, w, light);
    }
    if (drawn[0] && drawn[1] && memcmp(j->drawn, j->drawn + shared / DRIVERS, shared / DRIVERS) != 0) {
        printf("%-18s llvmpipe and osmesa: the masks differ\n", j->name);
        failures++;
    }
    fflush(stdout);
    munmap(j->drawn, 2 * shared + DRIVERS * WAYS * MOST_LIGHTS);
    free(j->lit);
    free(j->visible);
    free(j->classes);
    scene_free(&loaded);
    return failures;
}

static int is_named(const char *name, int count, char **names)
{
    for (int i = 0; i < count; i++)
        if (strcmp(name, names[i]) == 0)
            return 1;
    return count == 0;
}

int main(int count, char **arguments)
{
    const char *wanted_drivers = "llvmpipe,osmesa,softpipe,zink", *wanted_ways = NULL;
    unsigned width = 640, height = 480;
    int bits[6] = {8, 8, 8, 8, 24, 8};
    int list_pixels = 0, extremes = 0, failures = 0, scenes = 0, at = 1;
    char path[1024], line[512];
    FILE *list;

    setvbuf(stdout, NULL, _IOLBF, 0);
    for (; at + 1 < count && strncmp(arguments[at], "--", 2) == 0; at++)
        if (strcmp(arguments[at], "--pixels") == 0)
            list_pixels = 1;
        else if (strcmp(arguments[at], "--extremes") == 0)
            extremes = 1;
        else if (strcmp(arguments[at], "--depth") == 0)
            bits[4] = atoi(arguments[++at]);
        else if (strcmp(arguments[at], "--bits") == 0 && sscanf(arguments[at + 1], "%d,%d,%d,%d,%d,%d", &bits[0],
                                                                &bits[1], &bits[2], &bits[3], &bits[4], &bits[5]) == 6)
            at++;
        else if (strcmp(arguments[at], "--drivers") == 0)
            wanted_drivers = arguments[++at];
        else if (strcmp(arguments[at], "--ways") == 0)
            wanted_ways = arguments[++at];
        else if (strcmp(arguments[at], "--size") != 0 || sscanf(arguments[++at], "%ux%u", &width, &height) != 2)
            return fprintf(stderr, "truth_table: what is %s?\n", arguments[at]), 2;
    if (!are_ways(wanted_ways))
        return fprintf(stderr, "truth_table: no such way: %s\n", wanted_ways), 2;
    if (at >= count)
        return fprintf(stderr, "usage: truth_table [--size WxH] [--drivers LIST] SCENES_DIR [SCENE...]\n"), 2;
    snprintf(path, sizeof path, "%s/scenes.txt", arguments[at]);
    list = fopen(path, "r");
    if (!list)
        return fprintf(stderr, "truth_table: %s: cannot be read\n", path), 1;
    printf("%-18s %-9s %-10s %5s %9s %7s %7s %7s   (%ux%u)\n", "scene", "driver", "way", "light", "certain", "depth",
           "wrong", "cracks", width, height);
    while (fgets(line, sizeof line, list)) {
        char zpass[16], size[16];
        job j;

        memset(&j, 0, sizeof j);
        if (sscanf(line, "%63s %15s %15s", j.name, zpass, size) != 3 ||
            !is_named(j.name, count - at - 1, arguments + at + 1) || (strcmp(size, "extreme") == 0) != extremes)
            continue;
        j.zpass_is_right = strcmp(zpass, "zpass") == 0;
        j.is_large = strcmp(size, "large") == 0;
        j.extremes = extremes;
        memcpy(j.bits, bits, sizeof bits);
        j.is_poor = bits[3] == 0 || bits[5] == 0;
        j.list_pixels = list_pixels;
        j.ways = wanted_ways;
        j.width = width;
        j.height = height;
        scenes++;
        failures += run(&j, arguments[at], wanted_drivers);
    }
    fclose(list);
    printf("%d scenes, %d failures\n", scenes, failures);
    return scenes == 0 || failures != 0;
}
