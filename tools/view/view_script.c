/* view_script.c - inputs from a file, a line each: the frame, and what is done in it.
 *
 *     FRAME key [shift+]KEY           as it is shown in the list of keys; "release KEY" lifts one that moves
 *     FRAME drag [right|shift] X,Y X,Y
 *     FRAME scroll STEPS
 *     FRAME resize WxH
 *     FRAME lose                      the context is lost
 *     FRAME shot FILE.png             after the frame: the window's picture
 *     FRAME report FILE.json          what the panel says
 *     FRAME masks FOLDER              as `gnomon render --mask-dir` writes them, of this view
 *     FRAME quit
 *
 * # starts a comment. Frames are a sixtieth of a second apart, so that a script does the same each time. */
#include "view.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "command.h"
#include "mask_files.h"

enum { MOST_LINES = 1024, MOST_LETTERS = 512, STEPS = 8 };

typedef enum verb { KEY, RELEASE, DRAG, SCROLL, RESIZE, LOSE, SHOT, REPORT, MASKS, QUIT, VERBS } verb;

static const char *const verb_names[VERBS] = {"key",  "release", "drag",   "scroll", "resize",
                                              "lose", "shot",    "report", "masks",  "quit"};

typedef struct line {
    uint32_t frame;
    verb verb;
    int key, button;
    unsigned modifiers;
    double at[4];
    char path[256];
} line;

struct view_script {
    line *lines;
    size_t count;
};

/* ------------------------------------------------------------------ reading */

static int read_key(const char *text, line *out)
{
    static const struct {
        const char *name;
        int key;
    } named[] = {{"space", ' '}, {"Esc", WINDOW_ESCAPE}, {"?", '/'}};

    if (strncmp(text, "shift+", 6) == 0) {
        out->modifiers = WINDOW_SHIFT;
        text += 6;
    }
    for (size_t i = 0; i < sizeof named / sizeof named[0]; i++)
        if (strcmp(text, named[i].name) == 0)
            out->key = named[i].key;
    if (!out->key && text[0] && !text[1])
        out->key = text[0] >= 'a' && text[0] <= 'z' ? text[0] - 'a' + 'A' : text[0];
    return view_is_key(out->key);
}

/* Finite, and nothing after them. */
static int are_sound(const line *l, const char *text, int used)
{
    return isfinite(l->at[0]) && isfinite(l->at[1]) && isfinite(l->at[2]) && isfinite(l->at[3]) && !text[used];
}

static int read_drag(const char *text, line *out)
{
    int used = 0;

    if (strncmp(text, "right ", 6) == 0) {
        out->button = 1;
        text += 6;
    } else if (strncmp(text, "shift ", 6) == 0) {
        out->modifiers = WINDOW_SHIFT;
        text += 6;
    }
    return sscanf(text, "%lf,%lf %lf,%lf%n", &out->at[0], &out->at[1], &out->at[2], &out->at[3], &used) == 4 &&
           are_sound(out, text, used);
}

static int read_rest(const char *text, line *out)
{
    const size_t length = strlen(text);
    int used = 0;

    switch (out->verb) {
    case KEY:
    case RELEASE:
        return read_key(text, out);
    case DRAG:
        return read_drag(text, out);
    case SCROLL:
        return sscanf(text, "%lf%n", &out->at[0], &used) == 1 && are_sound(out, text, used);
    case RESIZE:
        return sscanf(text, "%lfx%lf%n", &out->at[0], &out->at[1], &used) == 2 && are_sound(out, text, used) &&
               out->at[0] >= 1 && out->at[1] >= 1 && out->at[0] <= 16384 && out->at[1] <= 16384;
    case SHOT:
    case REPORT:
    case MASKS:
        memcpy(out->path, text, length < sizeof out->path ? length + 1 : 0);
        return length > 0 && length < sizeof out->path;
    default:
        return length == 0;
    }
}

/* 1; 0 where there is nothing to do; -1 where it cannot be read. */
static int read_line(char *text, line *out)
{
    unsigned long frame;
    char name[16] = "";
    int used = 0;
    size_t length;

    text[strcspn(text, "#\r\n")] = '\0';
    for (length = strlen(text); length && text[length - 1] == ' ';)
        text[--length] = '\0';
    if (!text[strspn(text, " \t")])
        return 0;
    memset(out, 0, sizeof *out);
    if (sscanf(text, "%lu %15s%n", &frame, name, &used) != 2 || frame > 1000000)
        return -1;
    out->frame = (uint32_t)frame;
    while (out->verb < VERBS && strcmp(verb_names[out->verb], name) != 0)
        out->verb = (verb)(out->verb + 1);
    text += used;
    text += strspn(text, " \t");
    return out->verb < VERBS && read_rest(text, out) ? 1 : -1;
}

view_script *view_script_read(const char *path)
{
    FILE *f = fopen(path, "r");
    view_script *s = calloc(1, sizeof *s);
    char text[MOST_LETTERS];
    int number = 0, ok = f && s;

    if (!f)
        say("%s: cannot be read: %s", path, strerror(errno));
    if (s)
        s->lines = calloc(MOST_LINES, sizeof *s->lines);
    if (!s || !s->lines) {
        say("%s: no memory", path);
        ok = 0;
    }
    while (ok && fgets(text, sizeof text, f)) {
        int read;

        number++;
        if (s->count == MOST_LINES) {
            say("%s: more than %d lines", path, MOST_LINES);
            ok = 0;
            break;
        }
        read = strlen(text) + 1 < sizeof text ? read_line(text, &s->lines[s->count]) : -1;
        if (read < 0 || (read > 0 && s->count && s->lines[s->count].frame < s->lines[s->count - 1].frame)) {
            say("%s: line %d: %s (%s)", path, number, read < 0 ? "is no input" : "its frame is before the last line's",
                text);
            ok = 0;
        }
        s->count += read > 0;
    }
    if (ok && !s->count) {
        say("%s: there is no input in it (0 lines)", path);
        ok = 0;
    }
    if (f)
        fclose(f);
    if (ok)
        return s;
    view_script_free(s);
    return NULL;
}

void view_script_free(view_script *s)
{
    if (s)
        free(s->lines);
    free(s);
}

/* ------------------------------------------------------------------ doing */

static void drag(view *v, const line *l)
{
    window_event e = {
        .kind = WINDOW_PRESS, .button = l->button, .modifiers = l->modifiers, .x = l->at[0], .y = l->at[1]};

    view_take(v, &e);
    e.kind = WINDOW_MOVE;
    for (int i = 1; i <= STEPS; i++) {
        e.x = l->at[0] + (l->at[2] - l->at[0]) * i / STEPS;
        e.y = l->at[1] + (l->at[3] - l->at[1]) * i / STEPS;
        view_take(v, &e);
    }
    e.kind = WINDOW_RELEASE;
    view_take(v, &e);
}

/* A window system answers when it likes: the frame waits for it. */
static int resize(view *v, const line *l)
{
    const uint32_t width = (uint32_t)l->at[0], height = (uint32_t)l->at[1];
    window_event e;

    if (!window_exists(v->stage->platform)) {
        v->size[0] = width;
        v->size[1] = height;
        return view_reopen(v);
    }
    window_resize(v->stage->platform, width, height);
    for (int tries = 0; tries < 100000 && (v->size[0] != width || v->size[1] != height); tries++)
        while (!v->is_over && window_poll(v->stage->platform, &e))
            view_take(v, &e);
    if (v->size[0] == width && v->size[1] == height)
        return EXIT_DONE;
    say("resize: the window stays %ux%u (%ux%u asked for)", (unsigned)v->size[0], (unsigned)v->size[1], (unsigned)width,
        (unsigned)height);
    return EXIT_FAILED;
}

static int do_before(view *v, const line *l)
{
    const window_event event = {.kind = l->verb == KEY       ? WINDOW_KEY
                                        : l->verb == RELEASE ? WINDOW_KEY_UP
                                                             : WINDOW_SCROLL,
                                .key = l->key,
                                .modifiers = l->modifiers,
                                .y = l->at[0]};

    switch (l->verb) {
    case KEY:
    case RELEASE:
    case SCROLL:
        view_take(v, &event);
        return EXIT_DONE;
    case DRAG:
        drag(v, l);
        return EXIT_DONE;
    case RESIZE:
        return resize(v, l);
    case LOSE:
        v->is_lost = 1;
        return EXIT_DONE;
    default:
        return EXIT_DONE;
    }
}

static int do_after(view *v, const line *l)
{
    const stage_wish like = view_wish(v, 0);

    switch (l->verb) {
    case SHOT:
        return view_write_picture(v, l->path) ? EXIT_DONE : EXIT_FAILED;
    case REPORT:
        return view_write_report(v, l->path) ? EXIT_DONE : EXIT_FAILED;
    case MASKS:
        return write_masks(v->stage, &like, l->path);
    case QUIT:
        v->is_over = 1;
        return EXIT_DONE;
    default:
        return EXIT_DONE;
    }
}

static int run(view_script *s, view *v, uint32_t frame, int (*act)(view *v, const line *l))
{
    for (size_t i = 0; i < s->count; i++) {
        const int status = s->lines[i].frame == frame ? act(v, &s->lines[i]) : EXIT_DONE;

        if (status != EXIT_DONE)
            return status;
    }
    return EXIT_DONE;
}

int view_script_before(view_script *s, view *v, uint32_t frame)
{
    return run(s, v, frame, do_before);
}

int view_script_after(view_script *s, view *v, uint32_t frame)
{
    return run(s, v, frame, do_after);
}

int view_script_is_over(const view_script *s, uint32_t frame)
{
    return s->lines[s->count - 1].frame < frame;
}
