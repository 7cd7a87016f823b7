/* render.c - `gnomon render`: a glTF scene, lit, with exact shadows, into a picture; its masks, its plan, what it
 * cost. */
#define _POSIX_C_SOURCE 200809L
#include "command.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "mask_files.h"
#include "options.h"
#include "picture.h"
#include "render_adaptive.h"
#include "report.h"
#include "stage.h"

const char help_render[] =
    "usage: gnomon render SCENE.gltf|SCENE.glb [options]\n"
    "\n"
    "Draws a glTF 2.0 scene with pixel-exact shadows in OpenGL ES 2.0, without a window.\n"
    "\n"
    "  -o FILE.png           the lit frame\n"
    "  --size WxH            [800x600]\n"
    "  --mask-dir DIR        writes light0.png, light1.png ... into DIR: 255 lit, 0 shadowed, "
    "alpha where a surface is\n"
    "  --method NAME         see `gnomon methods` [auto]\n"
    "  --scale S             masks of a pixel for S x S of the frame's: 1, 2 or 4 [1]\n"
    "  --upsample HOW        nearest, bilinear or depth, for scale 2 and 4 [bilinear]\n"
    "  --sharpen             the same, with edges narrowed to a pixel of the frame: not with nearest\n"
    "  --shade HOW           additive: lights are added to ambient; attenuate: shadows dim a lit frame; black "
    "[additive]\n"
    "  --bits R,G,B,A,D,S    of the target, as near as the platform has [8,8,8,8,24,8]\n"
    "  --platform NAME       egl, osmesa or glfw [the first that works]\n"
    "  --hide CAP[,CAP...]   pretends that capabilities are absent: `gnomon probe` names them\n"
    "  --explain             prints why each light got its method, and each caster its case\n"
    "  --soft N:RADIUS       area lights: N jittered lights within RADIUS in place of each [1:0]\n"
    "  --importance E        leaves out lights that add at most E of full light to any pixel [0]\n"
    "  --blend-once          of coincident surfaces only the first is lit by each light\n"
    "  --weld-angle DEG      neighbouring triangles within DEG degrees face a light together [0]\n"
    "  --proxy TRIANGLES     what has more triangles casts by a mesh of about so many [each by itself]\n"
    "  --update-every N      finds a shadow anew in every N-th frame only [1]\n"
    "  --update-distance D   or when its light has moved by D as its caster sees it, in scene units [0]\n"
    "  --masks-every N       makes masks in textures anew in every N-th frame only [1]\n"
    "  --budget-ms MS        chooses for each light how its shadows are made, so that frames take no longer\n"
    "  --budget-mw MW        and their estimated power is no more, at 60 frames a second; --budget-mb MB: and memory\n"
    "  --quality CLASS       but no less than that: none, rough, fair, fine or exact [none: shadows may go]\n"
    "  --knowledge FILE.csv  what ways cost here, by `gnomon calibrate`; --rules FILE.fcl: what suits; --power P: a\n"
    "                        fact for them, 0 hot or low to 1 mains [1]\n"
    "  --load FILE           lines of a frame and lights N, host MS, budget MS or power P, that hold from there on\n"
    "  --trace FILE.csv      what each frame took and how its lights' shadows were made\n"
    "  --frames N            renders N frames at 1/60 s, writes the last [1]\n"
    "  --spin DEG            turns every light DEG degrees a frame about the vertical axis [0]\n"
    "  --exposure E          [the brightest light gives 1 at the scene's centre]\n"
    "  --show WHAT           over the frame: volumes, silhouette, cases (1 green, 2 orange, 3 red); or the mask\n"
    "  --plan FILE.json      the plan of the last frame\n"
    "  --report FILE.json    driver, lights, counts and times\n"
    "  --help                this text\n";

typedef struct job {
    const char *frame, *mask_dir, *method_name, *platform, *hide, *show, *plan, *report, *soft, *shade_name, *bits_text;
    int bits[6];
    gn_shade shade;
    const char *upsample_name;
    long scale;
    gn_upsample upsample;
    long size[2], frames, soft_count;
    long update_every, masks_every, proxy;
    double weld_angle;
    double spin, exposure, importance, soft_radius, update_distance;
    int explain, one_sided, blend_once, sharpen;
    gn_method method;
    adaptive_job adaptive;
} job;

static int write_frame(stage *s, const char *path)
{
    uint8_t *rgb = malloc((size_t)3 * s->target.width * s->target.height);
    int ok = rgb && read_picture(s, rgb);

    if (!ok)
        say("%s: the frame cannot be read back", path);
    ok = ok && write_png(path, rgb, s->target.width, s->target.height, 3);
    free(rgb);
    return ok;
}

static int write_plan(const stage *s, const char *path)
{
    const size_t length = gn_plan_json(s->plan, NULL, 0);
    char *text = malloc(length + 1);
    fresh_file f;
    int ok = 0;

    if (!text)
        say("%s: no memory for the plan", path);
    else if (fresh_open(&f, path)) {
        gn_plan_json(s->plan, text, length + 1);
        ok = fresh_close(&f, fwrite(text, 1, length, f.file) == length);
    }
    free(text);
    return ok;
}

/* One frame, drawn and waited for. Returns 0 or an exit status. */
static int timed_frame(stage *s, const job *j, int casting, double *ms, char message[SCENE_MESSAGE])
{
    const stage_wish wish = {.method = j->method,
                             .one_sided = j->one_sided,
                             .casting = casting,
                             .light_count = s->light_count,
                             .blend_once = j->blend_once,
                             .least_light = j->importance,
                             .keeps = casting,
                             .shade = j->shade,
                             .scale = (uint32_t)j->scale,
                             .upsample = j->upsample,
                             .sharpen = j->sharpen};
    const double start = now_ms();
    const int status = stage_plan(s, &wish, message);

    if (status != 0)
        return status;
    if (j->show && casting && strcmp(j->show, "mask") == 0) {
        if (!stage_draw_shares(s, message))
            return EXIT_FAILED;
    } else if (!stage_draw_lit(s, 0, message)) {
        return EXIT_FAILED;
    }
    s->gl->glFinish();
    *ms = now_ms() - start;
    return EXIT_DONE;
}

/* The frame three ways: in one pass without shadows, in its passes without volumes, and as it is, which stays. */
static int measured_frame(stage *s, const job *j, size_t frame, measured *m, char message[SCENE_MESSAGE])
{
    const int full = j->report != NULL;
    double start, unused;
    gl_counts before, after;
    uint64_t allocations;
    int status = EXIT_DONE;

    if (full) {
        status = timed_frame(s, j, 0, &m->ms.same_passes[frame], message);
        if (status)
            return status;
        start = now_ms();
        stage_draw_plain(s);
        s->gl->glFinish();
        m->ms.one_pass[frame] = now_ms() - start;
    }
    before = counted_gl_read();
    allocations = s->allocations;
    status = timed_frame(s, j, 1, full ? &m->ms.frame[frame] : &unused, message);
    after = counted_gl_read();
    m->allocations += frame ? s->allocations - allocations : 0;
    m->counts.draws = after.draws - before.draws;
    m->counts.vertices = after.vertices - before.vertices;
    m->counts.indices = after.indices - before.indices;
    m->counts.bytes_sent = after.bytes_sent - before.bytes_sent;
    m->counts.state_changes = after.state_changes - before.state_changes;
    return status;
}

static int is_adaptive(const job *j)
{
    const selecting *g = &j->adaptive.given;

    return g->budget_ms > 0.0 || g->budget_mw > 0.0 || g->budget_mb > 0.0 || j->adaptive.script || j->adaptive.csv;
}

/* Within a budget: the frames, and the last one's picture. */
static int run_adaptively(stage *s, const job *j)
{
    const stage_wish like = {.casting = 1, .least_light = j->importance, .sharpen = j->sharpen};
    adaptive_job adaptive = j->adaptive;
    int status;

    adaptive.frames = j->frames;
    adaptive.spin = j->spin;
    adaptive.explain = j->explain;
    status = render_adaptively(s, &adaptive, &like);
    if (status == EXIT_DONE && j->frame && !write_frame(s, j->frame))
        status = EXIT_FAILED;
    return status;
}

static int leaves_something(const job *j)
{
    return j->update_every > 1 || j->update_distance > 0.0 || j->masks_every > 1;
}

static int draw_frames(stage *s, const job *j, measured *m, char message[SCENE_MESSAGE])
{
    const size_t frames = (size_t)j->frames;
    const int show_progress = j->report && frames > 1 && isatty(STDERR_FILENO);

    m->frames = (uint32_t)frames;
    m->ms.count = frames;
    m->ms.frame = calloc(frames, sizeof(double));
    m->ms.same_passes = calloc(frames, sizeof(double));
    m->ms.one_pass = calloc(frames, sizeof(double));
    if (!m->ms.frame || !m->ms.same_passes || !m->ms.one_pass) {
        snprintf(message, SCENE_MESSAGE, "no memory for the times of %lu frames", (unsigned long)frames);
        return EXIT_FAILED;
    }
    for (size_t i = 0; i < frames; i++) {
        int status;

        stage_pose(s, (double)i / 60.0, (double)i * j->spin);
        /* frames whose picture nobody sees are drawn only to be measured, or if what they leave is seen later */
        if (!j->report && !leaves_something(j) && i + 1 < frames)
            continue;
        if (show_progress)
            fprintf(stderr, "\rframe %lu of %lu%s", (unsigned long)i + 1, (unsigned long)frames,
                    i + 1 < frames ? "" : "\n");
        status = measured_frame(s, j, i, m, message);
        if (status)
            return status;
        if (s->platform->kind->lost(s->platform)) {
            snprintf(message, SCENE_MESSAGE, "the GL context was lost in frame %lu", (unsigned long)i);
            return EXIT_FAILED;
        }
    }
    return EXIT_DONE;
}

/* A line for each light, and for each object that might cast. */
static void explain(const stage *s)
{
    char text[1024];

    for (uint32_t i = 0; i < s->plan->light_count; i++) {
        gn_plan_explain_light(s->plan, i, text, sizeof text);
        printf("light %u: %s\n", (unsigned)i, text);
        for (uint32_t o = 0; o < s->plan->object_count; o++)
            if (s->plan->objects[o].flags & GN_CASTS) {
                gn_plan_explain_caster(s->plan, i, o, text, sizeof text);
                printf("  object %u: %s\n", (unsigned)o, text);
            }
    }
}

/* What the plan knew before the frame that it cannot keep. */
static void warn(const stage *s)
{
    char text[512];

    for (int w = 0; w < GN_WARNING_COUNT; w++)
        if (gn_plan_explain_warning(s->plan, (gn_warning)w, text, sizeof text))
            say("%s", text);
}

static int write_outputs(stage *s, const job *j, measured *m)
{
    if (j->explain)
        explain(s);
    warn(s);
    if (j->show && strcmp(j->show, "volumes") == 0)
        stage_show_volumes(s);
    if (j->show && strcmp(j->show, "cases") == 0)
        stage_show_cases(s);
    if (j->show && strcmp(j->show, "silhouette") == 0)
        stage_show_silhouettes(s);
    if (j->frame && !write_frame(s, j->frame))
        return EXIT_FAILED;
    if (j->plan && !write_plan(s, j->plan))
        return EXIT_FAILED;
    if (j->report) {
        if (!stage_count_fragments(s, &m->fragments_rasterised, &m->fragments_passed)) {
            say("%s: fragments cannot be counted", j->report);
            return EXIT_FAILED;
        }
        if (!write_report(j->report, s, m))
            return EXIT_FAILED;
    }
    if (s->shader_refused) {
        say("the GL refuses a shader: surfaces are missing");
        return EXIT_FAILED;
    }
    if (s->gl->glGetError() != GL_NO_ERROR) {
        say("the GL reports an error");
        return EXIT_FAILED;
    }
    if (j->mask_dir) {
        const stage_wish like = {.method = j->method,
                                 .one_sided = j->one_sided,
                                 .scale = (uint32_t)j->scale,
                                 .upsample = j->upsample,
                                 .sharpen = j->sharpen};

        return write_masks(s, &like, j->mask_dir);
    }
    return EXIT_DONE;
}

static int run(const job *j, const char *path)
{
    const stage_options options = {j->platform,
                                   (uint32_t)j->size[0],
                                   (uint32_t)j->size[1],
                                   j->exposure,
                                   j->bits[4],
                                   j->bits[5],
                                   j->hide,
                                   0.0,
                                   NULL,
                                   (uint32_t)j->soft_count,
                                   j->soft_radius,
                                   {(uint32_t)j->update_every, j->update_distance, (uint32_t)j->masks_every},
                                   j->weld_angle * 0.017453292519943295,
                                   (uint32_t)j->proxy,
                                   j->bits};
    char message[SCENE_MESSAGE] = "";
    measured m;
    scene loaded;
    stage *s = NULL;
    int status;

    memset(&m, 0, sizeof m);
    if (!scene_load(&loaded, path, say_line, message)) {
        say("%s", message);
        return EXIT_FAILED;
    }
    if (!scene_ensure_view(&loaded, (double)j->size[0] / (double)j->size[1], say_line)) {
        say("%s: no memory", path);
        scene_free(&loaded);
        return EXIT_FAILED;
    }
    status = stage_open(&s, &loaded, &options, message);
    if (status == EXIT_DONE && !is_adaptive(j))
        status = draw_frames(s, j, &m, message);
    if (status != EXIT_DONE)
        say("%s: %s", path, message);
    else if (is_adaptive(j))
        status = run_adaptively(s, j);
    else
        status = write_outputs(s, j, &m);
    free(m.ms.frame);
    free(m.ms.same_passes);
    free(m.ms.one_pass);
    stage_close(s);
    scene_free(&loaded);
    return status;
}

/* N:RADIUS */
static int parse_soft(job *j)
{
    char *end;

    j->soft_count = strtol(j->soft, &end, 10);
    if (end != j->soft && *end == ':' && j->soft_count >= 1 && j->soft_count <= 1024) {
        const char *radius = end + 1;

        j->soft_radius = strtod(radius, &end);
        if (end != radius && *end == '\0' && j->soft_radius >= 0.0 && isfinite(j->soft_radius)) {
            if (!j->mask_dir || j->soft_count == 1)
                return 1;
            say("--soft: a mask is of one light with hard edges: leave out --mask-dir (%s)", j->soft);
            return 0;
        }
    }
    say("--soft: takes N:RADIUS, N from 1 to 1024 (%s)", j->soft);
    return 0;
}

/* R,G,B,A,D,S */
static int parse_bits(job *j)
{
    const char *at = j->bits_text;

    for (int i = 0; i < 6; i++) {
        char *end;
        const long bits = strtol(at, &end, 10);

        if (end == at || bits < 0 || bits > 32 || *end != (i < 5 ? ',' : '\0')) {
            say("--bits: takes R,G,B,A,D,S, each from 0 to 32 (%s)", j->bits_text);
            return 0;
        }
        j->bits[i] = (int)bits;
        at = end + 1;
    }
    return 1;
}

static int parse_shade(job *j)
{
    static const char *const names[] = {"additive", "attenuate", "black"};

    for (int i = 0; i < 3; i++)
        if (strcmp(j->shade_name, names[i]) == 0) {
            j->shade = (gn_shade)i;
            return 1;
        }
    say("--shade: takes additive, attenuate or black (%s)", j->shade_name);
    return 0;
}

/* Within a budget the selector chooses: what it chooses cannot be given too, nor what is of one plan be written. */
static int check_adaptive(const job *j)
{
    const struct {
        const char *name;
        int is_given;
    } others[] = {{"--method", j->method != GN_METHOD_AUTO},
                  {"--scale", j->scale > 1},
                  {"--mask-dir", j->mask_dir != NULL},
                  {"--plan", j->plan != NULL},
                  {"--report", j->report != NULL},
                  {"--show", j->show != NULL},
                  {"--shade", j->shade != GN_SHADE_ADDITIVE},
                  {"--blend-once", j->blend_once},
                  {"--masks-every", j->masks_every > 1},
                  {"--update-every", j->update_every > 1}};

    if (!is_adaptive(j) && (j->adaptive.given.quality || j->adaptive.given.rules || j->adaptive.given.knowledge)) {
        say("render: --quality, --rules and --knowledge are the selector's: give a budget too (none given)");
        return 0;
    }
    for (size_t i = 0; is_adaptive(j) && i < sizeof others / sizeof others[0]; i++)
        if (others[i].is_given) {
            say("render: a budget leaves the choice to the selector: leave out %s", others[i].name);
            return 0;
        }
    return 1;
}

static int one_of(const char *word, const char *const *words)
{
    for (; *words; words++)
        if (strcmp(word, *words) == 0)
            return 1;
    return 0;
}

int command_render(int count, char **arguments)
{
    static const char *const shows[] = {"volumes", "silhouette", "cases", "mask", NULL};
    job j = {.method_name = "auto",
             .upsample_name = "bilinear",
             .scale = 1,
             .shade_name = "additive",
             .bits_text = "8,8,8,8,24,8",
             .size = {800, 600},
             .frames = 1,
             .soft_count = 1,
             .update_every = 1,
             .masks_every = 1,
             .adaptive = {.power = 1.0}};
    const option options[] = {
        {"--budget-ms", OPTION_NUMBER, &j.adaptive.given.budget_ms, 0, 1e6},
        {"--budget-mw", OPTION_NUMBER, &j.adaptive.given.budget_mw, 0, 1e6},
        {"--budget-mb", OPTION_NUMBER, &j.adaptive.given.budget_mb, 0, 1e6},
        {"--quality", OPTION_TEXT, &j.adaptive.given.quality, 0, 0},
        {"--knowledge", OPTION_TEXT, &j.adaptive.given.knowledge, 0, 0},
        {"--rules", OPTION_TEXT, &j.adaptive.given.rules, 0, 0},
        {"--power", OPTION_NUMBER, &j.adaptive.power, 0, 1},
        {"--load", OPTION_TEXT, &j.adaptive.script, 0, 0},
        {"--trace", OPTION_TEXT, &j.adaptive.csv, 0, 0},
        {"-o", OPTION_TEXT, &j.frame, 0, 0},
        {"--size", OPTION_SIZE, j.size, 1, 16384},
        {"--mask-dir", OPTION_TEXT, &j.mask_dir, 0, 0},
        {"--method", OPTION_TEXT, &j.method_name, 0, 0},
        {"--scale", OPTION_WHOLE, &j.scale, 1, 4},
        {"--upsample", OPTION_TEXT, &j.upsample_name, 0, 0},
        {"--sharpen", OPTION_FLAG, &j.sharpen, 0, 0},
        {"--shade", OPTION_TEXT, &j.shade_name, 0, 0},
        {"--bits", OPTION_TEXT, &j.bits_text, 0, 0},
        {"--platform", OPTION_TEXT, &j.platform, 0, 0},
        {"--hide", OPTION_TEXT, &j.hide, 0, 0},
        {"--explain", OPTION_FLAG, &j.explain, 0, 0},
        {"--frames", OPTION_WHOLE, &j.frames, 1, 1000000},
        {"--spin", OPTION_NUMBER, &j.spin, -1e6, 1e6},
        {"--exposure", OPTION_NUMBER, &j.exposure, 1e-12, 1e12},
        {"--soft", OPTION_TEXT, &j.soft, 0, 0},
        {"--importance", OPTION_NUMBER, &j.importance, 0, 1e6},
        {"--weld-angle", OPTION_NUMBER, &j.weld_angle, 0, 57},
        {"--proxy", OPTION_WHOLE, &j.proxy, 4, 100000000},
        {"--update-every", OPTION_WHOLE, &j.update_every, 1, 1000000},
        {"--masks-every", OPTION_WHOLE, &j.masks_every, 1, 1000000},
        {"--update-distance", OPTION_NUMBER, &j.update_distance, 0, 1e12},
        {"--blend-once", OPTION_FLAG, &j.blend_once, 0, 0},
        {"--show", OPTION_TEXT, &j.show, 0, 0},
        {"--plan", OPTION_TEXT, &j.plan, 0, 0},
        {"--report", OPTION_TEXT, &j.report, 0, 0},
    };
    const int kept = parse_options(count, arguments, options, (int)(sizeof options / sizeof options[0]));

    if (kept < 0)
        return EXIT_USAGE;
    if (kept != 1) {
        say("render: takes one scene (%d given)", kept);
        return EXIT_USAGE;
    }
    if (!j.frame && !j.mask_dir && !j.plan && !j.report && !j.explain && !j.adaptive.csv) {
        say("render: nothing to do: give -o, --mask-dir, --plan, --report or --explain (none given)");
        return EXIT_USAGE;
    }
    j.method = gn_method_by_name(j.method_name, &j.one_sided);
    if (j.method == GN_METHOD_TOTAL) {
        say("--method: no method has that name: see `gnomon methods` (%s)", j.method_name);
        return EXIT_USAGE;
    }
    if (!check_hidden("--hide", j.hide) || !check_hidden("GNOMON_HIDE", getenv("GNOMON_HIDE")))
        return EXIT_USAGE;
    if (!parse_bits(&j) || !parse_shade(&j) || !check_small(j.scale, j.upsample_name, &j.upsample) ||
        !check_adaptive(&j))
        return EXIT_USAGE;
    if (j.soft && !parse_soft(&j))
        return EXIT_USAGE;
    if (j.show && !one_of(j.show, shows)) {
        say("--show: takes volumes, silhouette, cases or mask (%s)", j.show);
        return EXIT_USAGE;
    }
    for (int i = 0; j.platform && strcmp(j.platform, platform_kinds[i]->name) != 0;)
        if (!platform_kinds[++i]) {
            say("--platform: no platform has that name (%s)", j.platform);
            return EXIT_USAGE;
        }
    return run(&j, arguments[0]);
}
