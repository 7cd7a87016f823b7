/* view_input.c - what keys and the pointer do: a table of keys, and drags. */
#include "view.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "command.h"

#define REACH     14.0 /* pixels round a light's handle, and half of that beside the line of a split */
#define A_HEIGHT  3.0  /* radians, dragged from the picture's bottom to its top */
#define FLY_SPEED 0.4  /* of the scene's size, a second */

/* ------------------------------------------------------------------ keys */

static const char *method_name(int m)
{
    return gn_method_describe((gn_method)m)->name;
}

/* The next that is possible, or before. */
static void step_method(view *v, int side, int by)
{
    int m = (int)v->ways[side].method;

    do
        m = (m + by + GN_METHOD_TOTAL) % GN_METHOD_TOTAL;
    while (!(v->possible >> m & 1));
    v->ways[side].method = (gn_method)m;
    if (m == GN_METHOD_REFINE && v->ways[side].scale == 1)
        v->ways[side].scale = 2;
    v->is_adaptive = side ? v->is_adaptive : 0;
    view_tell(v, "%s%s", v->is_split ? side ? "right: " : "left: " : "", method_name(m));
}

static void next_method(view *v, int is_shifted)
{
    step_method(v, 0, is_shifted ? -1 : 1);
}

static void next_right_method(view *v, int is_shifted)
{
    v->is_split = 1;
    step_method(v, 1, is_shifted ? -1 : 1);
}

static void next_scale(view *v, int is_shifted)
{
    view_way *way = &v->ways[is_shifted];

    way->scale = way->scale == 4 ? 1 : 2 * way->scale;
    if (way->method == GN_METHOD_REFINE && way->scale == 1)
        way->scale = 2;
    view_tell(v, "%smasks of a pixel for %ux%u", is_shifted ? "right: " : "", (unsigned)way->scale,
              (unsigned)way->scale);
}

static void next_upsample(view *v, int is_shifted)
{
    static const char *const names[] = {"nearest", "bilinear", "depth"};
    view_way *way = &v->ways[is_shifted];

    way->upsample = (gn_upsample)(((int)way->upsample + 1) % 3);
    view_tell(v, "%ssmall masks by %s", is_shifted ? "right: " : "", names[way->upsample]);
}

static void toggle_selector(view *v, int is_shifted)
{
    (void)is_shifted;
    if (v->no_selector[0]) {
        view_tell(v, "%s", v->no_selector);
        return;
    }
    v->is_adaptive = !v->is_adaptive;
    view_tell(v, v->is_adaptive ? "the selector chooses, for each light" : "%s for all lights",
              method_name((int)v->ways[0].method));
}

/* Up and down by halves of an octave. */
static void next_budget(view *v, int is_shifted)
{
    gn_budget *b = &v->files.budget;

    if (v->no_selector[0]) {
        view_tell(v, "%s", v->no_selector);
        return;
    }
    b->frame_ms =
        fmin(fmax((b->frame_ms > 0.0 ? b->frame_ms : 16.7) * (is_shifted ? sqrt(2.0) : sqrt(0.5)), 0.5), 1000.0);
    adaptive_set_budget(&v->adaptive, b);
    v->is_adaptive = 1;
    view_tell(v, "budget: %.1f ms a frame", b->frame_ms);
}

static void next_show(view *v, int is_shifted)
{
    v->show = (view_show)(((int)v->show + (is_shifted ? VIEW_SHOWS - 1 : 1)) % VIEW_SHOWS);
}

static void toggle_split(view *v, int is_shifted)
{
    (void)is_shifted;
    v->is_split = !v->is_split;
}

static void compare(view *v, int is_shifted)
{
    (void)is_shifted;
    v->compares = !v->is_marked;
    v->is_marked = 0;
}

static void next_light(view *v, int is_shifted)
{
    const uint32_t count = (uint32_t)v->loaded.light_count;

    if (count)
        v->light = (v->light + (is_shifted ? count - 1 : 1)) % count;
    view_tell(v, "light %u", (unsigned)v->light);
}

static void toggle_turning(view *v, int is_shifted)
{
    (void)is_shifted;
    v->turns_lights = !v->turns_lights;
}

static void toggle_pause(view *v, int is_shifted)
{
    (void)is_shifted;
    v->is_paused = !v->is_paused;
    view_tell(v, v->is_paused ? "time stands still" : "time goes on");
}

static void toggle_flying(view *v, int is_shifted)
{
    (void)is_shifted;
    v->flies = !v->flies;
    v->moves = 0;
    view_tell(v, v->flies ? "flying: W A S D, Q down, E up" : "round the scene");
}

static void toggle_capabilities(view *v, int is_shifted)
{
    (void)is_shifted;
    v->shows_capabilities = !v->shows_capabilities;
    v->shows_help = 0;
}

static void reset(view *v, int is_shifted)
{
    (void)is_shifted;
    orbit_reset(&v->camera, &v->loaded);
    handles_reset(&v->lights);
    v->seconds = 0.0;
}

static void shoot(view *v, int is_shifted)
{
    char path[64];

    (void)is_shifted;
    for (FILE *there = NULL;; fclose(there)) { /* none that is there is written over */
        snprintf(path, sizeof path, "gnomon-%03u.png", v->shots++);
        there = fopen(path, "rb");
        if (!there)
            break;
    }
    if (view_write_picture(v, path))
        view_tell(v, "%s", path);
}

static void toggle_panel(view *v, int is_shifted)
{
    (void)is_shifted;
    v->hides_panel = !v->hides_panel;
}

static void toggle_help(view *v, int is_shifted)
{
    (void)is_shifted;
    v->shows_help = !v->shows_help;
    v->shows_capabilities = 0;
}

static void leave(view *v, int is_shifted)
{
    (void)is_shifted;
    if (v->shows_help || v->shows_capabilities)
        v->shows_help = v->shows_capabilities = 0;
    else
        v->is_over = 1;
}

static const struct {
    int key;
    const char *shown, *what;
    void (*act)(view *v, int is_shifted);
    int spoils; /* what the difference was of */
} keys[] = {
    {'M', "M", "next method that is possible here; shift: the one before", next_method, 1},
    {'R', "R", "masks at full, half, quarter resolution; shift: of the right side", next_scale, 1},
    {'U', "U", "small masks by nearest, bilinear, depth; shift: of the right side", next_upsample, 1},
    {'G', "G", "the selector chooses, within the budget", toggle_selector, 1},
    {'B', "B", "a smaller budget; shift: a larger one", next_budget, 1},
    {'C', "C", "capabilities: pretend that the board lacks some", toggle_capabilities, 0},
    {'X', "X", "split: two methods side by side; drag the line", toggle_split, 1},
    {'N', "N", "next method on the right side", next_right_method, 1},
    {'T', "T", "the light's mask against the ray-traced truth, and away again", compare, 0},
    {'V', "V", "shown: lit, volumes, cases, silhouettes, mask", next_show, 1},
    {'L', "L", "next light", next_light, 0},
    {'K', "K", "lights go round", toggle_turning, 1},
    {' ', "space", "time stands still, or goes on", toggle_pause, 0},
    {'F', "F", "fly, or go round the scene", toggle_flying, 0},
    {'0', "0", "as the scene was", reset, 1},
    {'P', "P", "a picture, gnomon-NNN.png", shoot, 0},
    {'O', "O", "this panel, or the frame alone", toggle_panel, 0},
    {'/', "?", "this list", toggle_help, 0},
    {WINDOW_ESCAPE, "Esc", "leave", leave, 0},
};
enum { KEYS = sizeof keys / sizeof keys[0] };

static const char *const pointer_lines[][2] = {{"drag", "round the scene; flying: look about"},
                                               {"right drag", "along the picture; shift and left does the same"},
                                               {"wheel", "near and far"},
                                               {"drag a disc", "moves the light"},
                                               {"W A S D Q E", "while flying: forward, left, back, right, down, up"}};
enum { POINTER_LINES = sizeof pointer_lines / sizeof pointer_lines[0] };

int view_key_line(int n, const char **key, const char **what)
{
    if (n >= KEYS + POINTER_LINES)
        return 0;
    *key = n < KEYS ? keys[n].shown : pointer_lines[n - KEYS][0];
    *what = n < KEYS ? keys[n].what : pointer_lines[n - KEYS][1];
    return 1;
}

/* While flying these keys move, and do nothing else. */
static const char moving[] = "WASDQE";

static int move_of(int key)
{
    const char *at = key > 0 && key < 128 ? strchr(moving, key) : NULL;

    return at ? (int)(at - moving) : -1;
}

void view_fly(view *v, double dt)
{
    const double step = FLY_SPEED * dt;
    const int m = (int)v->moves;

    if (!v->flies || !m)
        return;
    orbit_move(&v->camera, &v->loaded, step * ((m >> 3 & 1) - (m >> 1 & 1)), step * ((m >> 5 & 1) - (m >> 4 & 1)),
               step * ((m & 1) - (m >> 2 & 1)));
    v->is_marked = 0;
}

/* Letters A and B, then D on: C closes the list. */
static int capability_of(int key)
{
    const int c = key - 'A' - (key > 'C');

    return key < 'A' || key > 'Z' || key == 'C' || c >= GN_CAPABILITY_COUNT ? GN_CAPABILITY_COUNT : c;
}

static int hide(view *v, int key)
{
    const int c = capability_of(key);

    if (c == GN_CAPABILITY_COUNT)
        return 0;
    v->hidden ^= 1u << c;
    view_tell(v, "%s is %s", gn_capability_name((gn_capability)c), v->hidden >> c & 1 ? "hidden" : "shown again");
    view_end(v, view_reopen(v));
    return 1;
}

int view_is_key(int key)
{
    int is_one = move_of(key) >= 0 || capability_of(key) < GN_CAPABILITY_COUNT;

    for (int i = 0; i < KEYS; i++)
        is_one |= keys[i].key == key;
    return is_one;
}

static void press_key(view *v, int key, unsigned modifiers)
{
    const int move = v->flies ? move_of(key) : -1;

    if (v->shows_capabilities && hide(v, key))
        return;
    if (move >= 0) {
        v->moves |= 1u << move;
        return;
    }
    for (int i = 0; i < KEYS; i++)
        if (keys[i].key == key) {
            v->is_marked = keys[i].spoils ? 0 : v->is_marked;
            keys[i].act(v, (modifiers & WINDOW_SHIFT) != 0);
        }
}

/* ------------------------------------------------------------------ the pointer */

static void press(view *v, const window_event *e)
{
    const double at[2] = {e->x, e->y};
    const int light = v->hides_panel ? SCENE_NONE : handle_find(&v->lights, &v->loaded, at, v->size, REACH);

    memcpy(v->pointer, at, sizeof at);
    v->dragged = VIEW_DRAGS_VIEW;
    if (e->button != 0 || e->modifiers & WINDOW_SHIFT) {
        v->dragged = VIEW_DRAGS_PAN;
    } else if (light != SCENE_NONE) {
        v->dragged = VIEW_DRAGS_LIGHT;
        v->light = (uint32_t)light;
    } else if (v->is_split && fabs(e->x - v->split * v->size[0]) < REACH / 2.0) {
        v->dragged = VIEW_DRAGS_SPLIT;
    }
}

static void drag(view *v, const window_event *e)
{
    const double by[2] = {e->x - v->pointer[0], e->y - v->pointer[1]}, height = v->size[1];

    v->pointer[0] = e->x;
    v->pointer[1] = e->y;
    switch (v->dragged) {
    case VIEW_DRAGS_VIEW:
        if (v->flies)
            orbit_look(&v->camera, &v->loaded, -A_HEIGHT / 2.0 * by[0] / height, -A_HEIGHT / 2.0 * by[1] / height);
        else
            orbit_turn(&v->camera, &v->loaded, -A_HEIGHT * by[0] / height, A_HEIGHT * by[1] / height);
        break;
    case VIEW_DRAGS_PAN:
        orbit_pan(&v->camera, &v->loaded, 2.0 * by[0] / height, -2.0 * by[1] / height);
        break;
    case VIEW_DRAGS_LIGHT:
        handle_drag(&v->lights, &v->loaded, v->light, by, v->size);
        break;
    case VIEW_DRAGS_SPLIT:
        v->split = fmin(fmax(e->x / v->size[0], 0.0), 1.0);
        return;
    default:
        return;
    }
    v->is_marked = 0;
}

void view_take(view *v, const window_event *e)
{
    switch (e->kind) {
    case WINDOW_KEY:
        press_key(v, e->key, e->modifiers);
        break;
    case WINDOW_KEY_UP:
        if (move_of(e->key) >= 0)
            v->moves &= ~(1u << move_of(e->key));
        break;
    case WINDOW_PRESS:
        press(v, e);
        break;
    case WINDOW_RELEASE:
        v->dragged = VIEW_DRAGS_NOTHING;
        break;
    case WINDOW_MOVE:
        drag(v, e);
        break;
    case WINDOW_SCROLL:
        orbit_zoom(&v->camera, &v->loaded, e->y);
        v->is_marked = 0;
        break;
    case WINDOW_RESIZE:
        view_end(v, view_resize(v));
        break;
    case WINDOW_CLOSE:
        v->is_over = 1;
        break;
    }
}
