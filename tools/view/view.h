/* view.h - the viewer's state: a scene on the stage, how it is looked at, how its shadows are made, and what is said of it.
 *
 *     view_open.c    the stage and what is drawn over it: made, lost, made again
 *     view_frame.c   a frame: one way or two, encoded, marked
 *     view_panel.c   what is written over it
 *     view_input.c   what keys and the pointer do
 *     view_script.c  inputs from a file, for tests and demonstrations
 *     view_report.c  what is written over it, as a file */
#ifndef VIEW_H
#define VIEW_H
#include "adaptive.h"
#include "difference.h"
#include "handles.h"
#include "orbit.h"
#include "overlay.h"
#include "present.h"
#include "selecting.h"
#include "stage.h"
#include "window.h"

typedef enum view_show { VIEW_LIT, VIEW_VOLUMES, VIEW_CASES, VIEW_SILHOUETTES, VIEW_MASK, VIEW_SHOWS } view_show;

/* How shadows are made, where the selector does not choose. */
typedef struct view_way {
    gn_method method;
    uint32_t scale;
    gn_upsample upsample;
} view_way;

/* What a side of the last frame took, and what was drawn. */
typedef struct view_side {
    double ms;
    double fragments;         /* of shadow volumes, estimated */
    double bytes, milliwatts; /* traffic of the whole frame, and what that takes at this pace, or 60 frames a second */
    char name[64];
    char why[256]; /* it cannot be: "" where it can */
    int is_blank;  /* not even without shadows */
} view_side;

enum { VIEW_TIMES = 120 };

typedef struct view {
    /* given */
    const char *path, *platform;
    uint32_t size[2];
    uint32_t hidden; /* capabilities */
    selecting_files files;

    scene loaded;
    stage *stage;
    overlay *overlay;
    present present;
    adaptive adaptive;
    char no_selector[256]; /* why it cannot choose here: "" where it can */
    uint32_t possible;     /* methods, by bits */

    orbit camera;
    handles lights;
    double seconds;
    int is_paused, turns_lights, flies;
    uint32_t light; /* that is meant by keys */

    view_way ways[2];
    view_side sides[2];
    int is_split, is_adaptive;
    double split;
    view_show show;
    int hides_panel, shows_help, shows_capabilities;
    int is_marked, compares; /* difference is of this view; is to be found in the next frame */
    difference difference;

    double times[VIEW_TIMES]; /* ms of the left side's frames: a ring */
    uint32_t frame;
    int dragged;       /* what the pointer holds: VIEW_DRAGS */
    double pointer[2]; /* where it was */
    unsigned moves;    /* keys that are down while flying, by bits */
    char notice[256];  /* the last thing that was done, or went wrong */
    double notice_until;
    int is_over; /* the user has had enough, or it cannot go on: then the command ends with this */
    int status;
    int is_lost; /* pretends that the context is */
    unsigned shots;
} view;

enum { VIEW_DRAGS_NOTHING, VIEW_DRAGS_VIEW, VIEW_DRAGS_PAN, VIEW_DRAGS_LIGHT, VIEW_DRAGS_SPLIT };

/* view_open.c: 0, or an exit status having said why. */
int view_open(view *v);
void view_close(view *v);
/* Nothing for EXIT_DONE; else it is over, with that status. */
void view_end(view *v, int status);
/* Makes the stage anew, with what is hidden now; the scene and how it is looked at stay. */
int view_reopen(view *v);
int view_resize(view *v);
stage_wish view_wish(const view *v, int side);

/* view_frame.c: poses, draws and shows a frame; dt: seconds since the last. 0, or an exit status having said why. */
int view_frame(view *v, double dt);

/* view_panel.c */
void view_draw_panel(view *v);
int view_is_fine(const view *v); /* letters are twice as large: on a screen of small pixels */
void view_tell(view *v, const char *format, ...)
#ifdef __GNUC__
    __attribute__((format(printf, 2, 3)))
#endif
    ;

/* view_input.c */
void view_take(view *v, const window_event *event);
/* Moves what keys that are down move. */
void view_fly(view *v, double dt);
/* Key n and what it does, for the list; 0 past the last. */
/* Whether a key does something, somewhere. */
int view_is_key(int key);
int view_key_line(int n, const char **key, const char **what);

/* view_script.c: what is to be done at which frame. */
typedef struct view_script view_script;
view_script *view_script_read(const char *path); /* NULL having said why */
void view_script_free(view_script *s);
/* What is due before this frame, and after it. 0, or an exit status having said why. */
int view_script_before(view_script *s, view *v, uint32_t frame);
int view_script_after(view_script *s, view *v, uint32_t frame);
int view_script_is_over(const view_script *s, uint32_t frame);

/* view_report.c: 1, or 0 having said why. */
int view_write_report(const view *v, const char *path);
int view_write_picture(view *v, const char *path);
#endif
