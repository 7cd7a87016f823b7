/* view.c - `gnomon view`: a scene in a window, to walk round, to move its lights, and to see how its shadows are made. */
#include "command.h"

#include <stdlib.h>
#include <string.h>

#include "options.h"
#include "picture.h"
#include "view.h"

const char help_view[] =
    "usage: gnomon view SCENE.gltf|SCENE.glb [options]\n"
    "\n"
    "Shows a scene in a window: turn it, drag its lights, switch methods, compare them with each other and\n"
    "with the truth. ? lists the keys.\n"
    "\n"
    "  --size WxH            [960x600]\n"
    "  --method NAME         to begin with: see `gnomon methods` [auto]\n"
    "  --scale S             masks of a pixel for S x S of the frame's: 1, 2 or 4 [1]\n"
    "  --upsample HOW        nearest, bilinear or depth, for scale 2 and 4 [bilinear]\n"
    "  --budget-ms MS        the selector chooses, so that frames take no longer\n"
    "  --quality CLASS       but no less than that: none, rough, fair, fine or exact [none]\n"
    "  --knowledge FILE.csv  what ways cost here, by `gnomon calibrate`; --rules FILE.fcl: what suits\n"
    "  --hide CAP[,CAP...]   pretends that capabilities are absent\n"
    "  --platform NAME       glfw, glfw-native or glfw-osmesa; with --script also egl or osmesa [glfw]\n"
    "  --script FILE         inputs by frame, lines of `FRAME key K`, `drag X,Y X,Y`, `scroll N`, `resize WxH`,\n"
    "                        `lose`, `shot FILE.png`, `report FILE.json`, `masks FOLDER`, `quit`\n"
    "  --help                this text\n";

#define LONGEST 0.1 /* seconds between two frames that things move by */

static int run_script(view *v, view_script *s)
{
    int status = EXIT_DONE;

    for (uint32_t frame = 0; status == EXIT_DONE && !v->is_over && !view_script_is_over(s, frame); frame++) {
        status = view_script_before(s, v, frame);
        if (v->status != EXIT_DONE)
            break;
        if (status == EXIT_DONE)
            status = view_frame(v, frame ? 1.0 / 60.0 : 0.0);
        if (status == EXIT_DONE)
            status = view_script_after(s, v, frame);
        if (status == EXIT_DONE && window_exists(v->stage->platform))
            window_present(v->stage->platform);
    }
    return status == EXIT_DONE ? v->status : status;
}

static int run_window(view *v)
{
    double last = now_ms();
    int status = EXIT_DONE;

    while (status == EXIT_DONE && !v->is_over) {
        const double now = now_ms(), dt = (now - last) / 1000.0;
        window_event event;

        last = now;
        while (!v->is_over && window_poll(v->stage->platform, &event))
            view_take(v, &event);
        if (v->is_over)
            break;
        status = view_frame(v, dt < LONGEST ? dt : LONGEST);
        if (status == EXIT_DONE)
            window_present(v->stage->platform);
    }
    return status == EXIT_DONE ? v->status : status;
}

static int run(view *v, const selecting *given, const char *script)
{
    gn_context *context = NULL;
    view_script *s = script ? view_script_read(script) : NULL;
    int status = EXIT_FAILED;

    if (script && !s)
        return EXIT_FAILED;
    if (gn_context_create(NULL, &context) != GN_OK)
        say("view: no memory");
    else
        status = selecting_load(given, context, &v->files);
    if (status == EXIT_DONE) {
        status = view_open(v);
        if (status == EXIT_DONE)
            status = s ? run_script(v, s) : run_window(v);
        view_close(v);
        selecting_free(&v->files);
    }
    gn_context_destroy(context);
    view_script_free(s);
    return status;
}

int command_view(int count, char **arguments)
{
    static view v;
    selecting given = {0};
    long size[2] = {960, 600}, scale = 1;
    const char *method = "auto", *upsample = "bilinear", *hide = NULL, *where = "glfw", *script = NULL;
    const option options[] = {
        {"--size", OPTION_SIZE, size, 1, 16384},
        {"--method", OPTION_TEXT, &method, 0, 0},
        {"--scale", OPTION_WHOLE, &scale, 1, 4},
        {"--upsample", OPTION_TEXT, &upsample, 0, 0},
        {"--budget-ms", OPTION_NUMBER, &given.budget_ms, 0, 1e6},
        {"--quality", OPTION_TEXT, &given.quality, 0, 0},
        {"--knowledge", OPTION_TEXT, &given.knowledge, 0, 0},
        {"--rules", OPTION_TEXT, &given.rules, 0, 0},
        {"--hide", OPTION_TEXT, &hide, 0, 0},
        {"--platform", OPTION_TEXT, &where, 0, 0},
        {"--script", OPTION_TEXT, &script, 0, 0},
    };
    const int kept = parse_options(count, arguments, options, (int)(sizeof options / sizeof options[0]));
    int one_sided = 0;

    if (kept < 0)
        return EXIT_USAGE;
    if (kept != 1) {
        say("view: takes one scene (%s)", kept > 1 ? arguments[1] : "none given");
        return EXIT_USAGE;
    }
    memset(&v, 0, sizeof v);
    v.ways[0].method = gn_method_by_name(method, &one_sided);
    if (v.ways[0].method == GN_METHOD_TOTAL || one_sided) {
        say("--method: no method that is shown here has that name: see `gnomon methods` (%s)", method);
        return EXIT_USAGE;
    }
    if (!check_small(scale, upsample, &v.ways[0].upsample))
        return EXIT_USAGE;
    if (!check_hidden("--hide", hide) || !check_hidden("GNOMON_HIDE", getenv("GNOMON_HIDE")))
        return EXIT_USAGE;
    if (strncmp(where, "glfw", 4) != 0 && !script) {
        say("--platform: without a script a window is needed: glfw (%s)", where);
        return EXIT_USAGE;
    }
    gn_capability_parse(hide, &v.hidden);
    v.path = arguments[0];
    v.platform = where;
    v.size[0] = (uint32_t)size[0];
    v.size[1] = (uint32_t)size[1];
    v.ways[0].scale = (uint32_t)scale;
    v.ways[1] = (view_way){GN_METHOD_AUTO, 2, GN_UPSAMPLE_BILINEAR};
    v.split = 0.5;
    v.is_adaptive = given.budget_ms > 0.0;
    return run(&v, &given, script);
}
