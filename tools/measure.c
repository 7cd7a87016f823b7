/* measure.c - `gnomon measure`: what each method, resolution and shortcut costs on this board and how far from the truth
 * it is, as a table; or, with --certify, whether all that claim to be exact are. */
#include "command.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "configs.h"
#include "options.h"
#include "page.h"
#include "picture.h"
#include "plot.h"
#include "trade_csv.h"
#include "worst.h"

const char help_measure[] =
    "usage: gnomon measure SCENE... -o DIR [options]\n"
    "       gnomon measure --certify SCENE... [options]\n"
    "\n"
    "Draws the same frames by every method, resolution and upsampling, and compares their masks and\n"
    "pictures with ray-traced ones. Writes into DIR:\n"
    "  trade.csv             a row for each configuration and scene; kept when interrupted, and gone on with\n"
    "  trade.svg             error against time, and against an estimate of energy; scaling.svg: time against lights,\n"
    "                        faces and pixels, where there are several; both by gnuplot\n"
    "  report.html           all of it on one page\n"
    "  worst/                the worst mask of each beside the truth, and in commands.txt what makes it again\n"
    "\n"
    "  --methods LIST        names with commas between; all: each of them [all]\n"
    "  --scales LIST         of 1, 2, 4 [1,2,4]\n"
    "  --upsample LIST       of nearest, bilinear, depth [bilinear]\n"
    "  --size WxH[,WxH...]   [320x240]\n"
    "  --frames N            of the path [6]\n"
    "  --camera-path PATH    orbit: round the scene's centre, 2 degrees a frame; or a file with a line for each\n"
    "                        frame: three numbers for the eye, three for what it looks at [orbit]\n"
    "  --lights LIST         so many of the scene's lights [4, or as many as there are]\n"
    "  --repeat N            of each frame, for its times [1]\n"
    "  --spin DEG            turns every light DEG degrees a frame about the vertical axis [0]\n"
    "  --weld-angle, --proxy, --update-every, --update-distance, --masks-every: as of `gnomon render`; their rows'\n"
    "                        names say so, so that rows with them and without stand in one table\n"
    "  --certify             no table: 0 if no pixel that the truth is certain of is wrong, and none more than two\n"
    "                        pixels from a border, by any method that claims to be exact, in any frame but\n"
    "                        those that its plan warns of\n"
    "  --platform NAME       egl or osmesa [the first that works]\n"
    "  --hide CAP[,CAP...]   pretends that capabilities are absent\n"
    "  --help                this text\n";

enum { MOST_SIZES = 8, MOST_COUNTS = 16 };

typedef struct job {
    const char *directory, *methods, *scales, *upsamples, *sizes_text, *path_name, *lights_text, *platform, *hide;
    long frames, repeat;
    int certify;
    config_list configs;
    uint32_t sizes[MOST_SIZES][2];
    int size_count;
    long lights[MOST_COUNTS];
    int light_counts;
    camera_path path;
    shortcuts spared;
    long update_every, masks_every, proxy;
    char suffix[64]; /* of names: what is spared */
    trade_csv table;
    double started;
    size_t done, skipped, total;          /* rows; of the done those that were there already */
    uint64_t certified, warned, failures; /* masks, and those that plans warned of; pixels */
} job;

static void show(const job *j, const char *what)
{
    const double seconds = (now_ms() - j->started) / 1000.0;
    const size_t made = j->done - j->skipped;

    if (!isatty(STDERR_FILENO))
        return;
    fprintf(stderr, "\r%lu of %lu", (unsigned long)j->done, (unsigned long)j->total);
    if (made > 0)
        fprintf(stderr, ", %.0f s left", seconds / (double)made * (double)(j->total - j->done));
    fprintf(stderr, ": %-48.48s", what);
}

static void trace_progress(void)
{
    if (isatty(STDERR_FILENO))
        fprintf(stderr, "\rtracing the truth ...                                                          ");
}

static int keep_worst(const job *j, subject *s, const char *file, const config *c, const row_key *key, const trial *t)
{
    char numbers[3][16], path[1024], list[1024];
    FILE *f;
    int ok;

    snprintf(numbers[0], sizeof numbers[0], "%u", (unsigned)key->width);
    snprintf(numbers[1], sizeof numbers[1], "%u", (unsigned)key->height);
    snprintf(numbers[2], sizeof numbers[2], "%u", (unsigned)key->lights);
    worst_path(j->directory, file, key->config, numbers[0], numbers[1], numbers[2], path, sizeof path);
    snprintf(list, sizeof list, "%s/worst/commands.txt", j->directory);
    if (!worst_write(s, c, t, path))
        return 0;
    f = fopen(list, "a");
    ok = f != NULL;
    if (f) {
        fprintf(f, "# %s: frame %u, light %u, %llu pixels\n", strrchr(path, '/') + 1, (unsigned)t->worst_frame,
                (unsigned)t->worst_light, (unsigned long long)t->worst_wrong);
        fprintf(f,
                "gnomon measure '%s' -o again --methods %s%s --scales %u%s%s --size %ux%u --frames %u --lights %u%s%s",
                file, gn_method_describe(c->method)->name, c->one_sided ? "/one-sided" : "", (unsigned)c->scale,
                c->scale > 1 ? " --upsample " : "",
                c->scale > 1 ? (c->upsample == GN_UPSAMPLE_DEPTH      ? "depth"
                                : c->upsample == GN_UPSAMPLE_BILINEAR ? "bilinear"
                                                                      : "nearest")
                             : "",
                (unsigned)key->width, (unsigned)key->height, (unsigned)key->frames, (unsigned)key->lights,
                j->path.views ? " --camera-path " : "", j->path.views ? j->path_name : "");
        fprintf(f, " --spin %g --weld-angle %g --proxy %ld --update-every %ld --update-distance %g --masks-every %ld\n",
                j->spared.spin, j->spared.weld_angle, j->proxy, j->update_every, j->spared.cache.update_distance,
                j->masks_every);
        ok = !ferror(f) && fclose(f) == 0;
    }
    if (!ok)
        say("%s: cannot be written: %s", list, strerror(errno));
    return ok;
}

static int run_row(job *j, subject *s, const char *file, const config *c, uint32_t lights)
{
    const platform *p = s->stage->platform;
    char name[sizeof c->name + sizeof j->suffix];
    const row_key key = {file,
                         name,
                         j->path.name,
                         (const char *)s->stage->gl->glGetString(GL_RENDERER),
                         p->kind->name,
                         s->stage->target.width,
                         s->stage->target.height,
                         lights,
                         (uint32_t)j->frames,
                         (uint32_t)j->repeat};
    trial t;

    snprintf(name, sizeof name, "%s%s", c->name, j->suffix);
    show(j, name);
    if (!j->certify && trade_has(&j->table, &key)) {
        j->skipped++;
        return 1;
    }
    if (!trial_run(s, c, lights, (uint32_t)j->repeat, &t))
        return 0;
    if (j->certify && !t.impossible[0]) {
        j->certified += t.masks - t.warned;
        j->warned += t.warned;
        j->failures += t.unwarned_certain + t.unwarned_interior;
        if (t.unwarned_certain + t.unwarned_interior)
            printf("%s: %s: %llu certain and %llu interior pixels are wrong\n", file, c->name,
                   (unsigned long long)t.unwarned_certain, (unsigned long long)t.unwarned_interior);
    }
    if (j->certify)
        return 1;
    return trade_add(&j->table, &key, c, s, &t) && (t.worst_wrong == 0 || keep_worst(j, s, file, c, &key, &t));
}

static int run_scene(job *j, const char *file, const uint32_t size[2])
{
    subject_desc desc = {file, &j->path,    size[0], size[1],   (uint32_t)j->frames,
                         0,    j->platform, j->hide, j->spared, trace_progress};
    uint32_t most = 0;
    int status, ok = 1;
    subject s;

    for (int i = 0; i < j->light_counts; i++)
        most = most < (uint32_t)j->lights[i] ? (uint32_t)j->lights[i] : most;
    desc.most_lights = most;
    status = subject_open(&s, &desc);
    if (status != 0)
        return status;
    for (int l = 0; l < j->light_counts && ok; l++)
        for (int c = 0; c < j->configs.count && ok; c++) {
            const uint32_t lights = (uint32_t)j->lights[l] < s.lights ? (uint32_t)j->lights[l] : s.lights;
            const gn_method_info *info = gn_method_describe(j->configs.of[c].method);

            if (!(l > 0 && (uint32_t)j->lights[l - 1] >= s.lights) && (!j->certify || info->exact))
                ok = run_row(j, &s, file, &j->configs.of[c], lights);
            j->done++;
        }
    subject_close(&s);
    return ok ? EXIT_DONE : EXIT_FAILED;
}

/* A line for each frame: six numbers. */
static int read_path(camera_path *path, const char *file)
{
    FILE *f = fopen(file, "r");
    char line[512];
    int number = 0;

    if (!f) {
        say("--camera-path: %s: cannot be read: %s", file, strerror(errno));
        return 0;
    }
    while (fgets(line, sizeof line, f)) {
        double v[6], (*views)[6];

        number++;
        if (line[strspn(line, " \t\r\n")] == '\0' || line[0] == '#')
            continue;
        if (sscanf(line, "%lf%*[ ,\t]%lf%*[ ,\t]%lf%*[ ,\t]%lf%*[ ,\t]%lf%*[ ,\t]%lf", v, v + 1, v + 2, v + 3, v + 4,
                   v + 5) != 6 ||
            (v[0] == v[3] && v[1] == v[4] && v[2] == v[5])) {
            say("--camera-path: %s: line %d is no eye and place to look at", file, number);
            fclose(f);
            return 0;
        }
        views = realloc(path->views, (path->count + 1) * sizeof *views);
        if (!views) {
            say("--camera-path: %s: no memory for line %d", file, number);
            fclose(f);
            return 0;
        }
        path->views = views;
        memcpy(views[path->count++], v, sizeof v);
    }
    fclose(f);
    if (path->count == 0)
        say("--camera-path: %s: has no frame", file);
    return path->count > 0;
}

static int parse_sizes(job *j)
{
    const char *at = j->sizes_text;

    while (at && j->size_count < MOST_SIZES) {
        unsigned width, height;
        int length = 0;

        if (sscanf(at, "%ux%u%n", &width, &height, &length) != 2 || (at[length] && at[length] != ',') || width < 16 ||
            height < 16 || width > 8192 || height > 8192) {
            say("--size: takes WxH of 16 to 8192 with commas between (%s)", j->sizes_text);
            return 0;
        }
        j->sizes[j->size_count][0] = width;
        j->sizes[j->size_count++][1] = height;
        at = at[length] ? at + length + 1 : NULL;
    }
    if (at)
        say("--size: takes at most %d sizes (%s)", MOST_SIZES, j->sizes_text);
    return !at;
}

/* What is spared, and its names. */
static void take_shortcuts(job *j)
{
    const struct {
        const char *name;
        double value, none;
    } all[] = {{"spin", j->spared.spin, 0},
               {"weld", j->spared.weld_angle, 0},
               {"proxy", (double)j->proxy, 0},
               {"update", (double)j->update_every, 1},
               {"moved", j->spared.cache.update_distance, 0},
               {"masks", (double)j->masks_every, 1}};
    size_t length = 0;

    j->spared.proxy = (uint32_t)j->proxy;
    j->spared.cache.update_every = (uint32_t)j->update_every;
    j->spared.cache.masks_every = (uint32_t)j->masks_every;
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++)
        if (all[i].value != all[i].none && length < sizeof j->suffix)
            length +=
                (size_t)snprintf(j->suffix + length, sizeof j->suffix - length, "+%s%g", all[i].name, all[i].value);
}

static int make_directory(const char *path)
{
    if (mkdir(path, 0777) == 0 || errno == EEXIST)
        return 1;
    say("%s: cannot be made: %s", path, strerror(errno));
    return 0;
}

static int prepare(job *j)
{
    char path[1024];

    if (j->certify)
        return 1;
    snprintf(path, sizeof path, "%s/worst", j->directory);
    if (!make_directory(j->directory) || !make_directory(path))
        return 0;
    snprintf(path, sizeof path, "%s/trade.csv", j->directory);
    return trade_open(&j->table, path);
}

/* Of all rows that there are. */
static int write_pictures(const job *j)
{
    char path[1024];
    trade_rows rows;
    int ok;

    if (!trade_rows_make(&rows, &j->table)) {
        say("%s: no memory for the pictures of %lu rows", j->directory, (unsigned long)j->table.count);
        return 0;
    }
    snprintf(path, sizeof path, "%s/trade.svg", j->directory);
    ok = plot_trade(&rows, path);
    snprintf(path, sizeof path, "%s/scaling.svg", j->directory);
    ok = plot_scaling(&rows, path) && ok;
    ok = page_write(&rows, j->directory) && ok;
    trade_rows_free(&rows);
    return ok;
}

static int run(job *j, int scene_count, char **scenes)
{
    int status = EXIT_DONE;

    j->started = now_ms();
    j->total = (size_t)scene_count * (size_t)j->size_count * (size_t)j->light_counts * (size_t)j->configs.count;
    if (!prepare(j))
        return EXIT_FAILED;
    for (int i = 0; i < scene_count && status == EXIT_DONE; i++)
        for (int size = 0; size < j->size_count && status == EXIT_DONE; size++)
            status = run_scene(j, scenes[i], j->sizes[size]);
    if (isatty(STDERR_FILENO))
        fprintf(stderr, "\n");
    if (!j->certify && status != EXIT_MISSING && !write_pictures(j))
        status = status == EXIT_DONE ? EXIT_FAILED : status;
    trade_close(&j->table);
    if (!j->certify || status != EXIT_DONE)
        return status;
    printf("%s: %llu pixels are wrong, of those that the truth is certain of or that lie more than two pixels within, "
           "in %llu "
           "masks of %d scenes by all methods that claim to be exact; of %llu masks they warned beforehand\n",
           j->failures ? "not certified" : "certified", (unsigned long long)j->failures,
           (unsigned long long)j->certified, scene_count, (unsigned long long)j->warned);
    return j->failures ? EXIT_FAILED : EXIT_DONE;
}

int command_measure(int count, char **arguments)
{
    job j = {.methods = "all",
             .scales = NULL,
             .upsamples = "bilinear",
             .sizes_text = "320x240",
             .path_name = "orbit",
             .lights_text = "4",
             .frames = 6,
             .update_every = 1,
             .masks_every = 1,
             .repeat = 1};
    const option options[] = {
        {"-o", OPTION_TEXT, &j.directory, 0, 0},
        {"--methods", OPTION_TEXT, &j.methods, 0, 0},
        {"--scales", OPTION_TEXT, &j.scales, 0, 0},
        {"--upsample", OPTION_TEXT, &j.upsamples, 0, 0},
        {"--size", OPTION_TEXT, &j.sizes_text, 0, 0},
        {"--frames", OPTION_WHOLE, &j.frames, 1, 10000},
        {"--camera-path", OPTION_TEXT, &j.path_name, 0, 0},
        {"--lights", OPTION_TEXT, &j.lights_text, 0, 0},
        {"--repeat", OPTION_WHOLE, &j.repeat, 1, 1000},
        {"--certify", OPTION_FLAG, &j.certify, 0, 0},
        {"--spin", OPTION_NUMBER, &j.spared.spin, -360, 360},
        {"--weld-angle", OPTION_NUMBER, &j.spared.weld_angle, 0, 57},
        {"--proxy", OPTION_WHOLE, &j.proxy, 0, 100000000},
        {"--update-every", OPTION_WHOLE, &j.update_every, 1, 1000000},
        {"--update-distance", OPTION_NUMBER, &j.spared.cache.update_distance, 0, 1e12},
        {"--masks-every", OPTION_WHOLE, &j.masks_every, 1, 1000000},
        {"--platform", OPTION_TEXT, &j.platform, 0, 0},
        {"--hide", OPTION_TEXT, &j.hide, 0, 0},
    };
    const int kept = parse_options(count, arguments, options, (int)(sizeof options / sizeof options[0]));
    int status = EXIT_USAGE;

    if (kept < 0)
        return EXIT_USAGE;
    if (kept == 0 || (!j.certify && !j.directory)) {
        say("measure: takes scenes and -o DIR, or --certify (%d scenes given)", kept);
        return EXIT_USAGE;
    }
    if (!j.scales)
        j.scales = j.certify ? "1" : "1,2,4"; /* small masks claim nothing */
    snprintf(j.path.name, sizeof j.path.name, "%.63s", j.path_name);
    take_shortcuts(&j);
    j.light_counts = parse_numbers("--lights", j.lights_text, 1, 64, j.lights, MOST_COUNTS);
    if (j.light_counts > 0 && check_hidden("--hide", j.hide) && parse_sizes(&j) &&
        list_configs(j.methods, j.scales, j.upsamples, &j.configs))
        status = strcmp(j.path_name, "orbit") == 0 || read_path(&j.path, j.path_name) ? run(&j, kept, arguments)
                                                                                      : EXIT_FAILED;
    free(j.path.views);
    return status;
}
