/* window.h - a platform's window, where it has one (glfw): what its user does, and showing what was drawn.
 *
 * Positions are pixels of the surface from its left and top, also on screens that count points. */
#ifndef WINDOW_H
#define WINDOW_H
#include "platform.h"

typedef enum window_event_kind {
    WINDOW_KEY,     /* key went down */
    WINDOW_KEY_UP,  /* key */
    WINDOW_PRESS,   /* button 0 left, 1 right, 2 middle; at x, y */
    WINDOW_RELEASE, /* the same */
    WINDOW_MOVE,    /* to x, y */
    WINDOW_SCROLL,  /* by y, up is positive */
    WINDOW_RESIZE,  /* to x by y, which platform.actual is from when this is taken */
    WINDOW_CLOSE    /* is asked for */
} window_event_kind;

/* Keys: a letter in capitals, a digit or sign as it is without shift; or one of these. */
enum { WINDOW_ESCAPE = 256, WINDOW_LEFT, WINDOW_RIGHT, WINDOW_UP, WINDOW_DOWN };
enum { WINDOW_SHIFT = 1, WINDOW_CONTROL = 2 };

typedef struct window_event {
    window_event_kind kind;
    int key, button;
    unsigned modifiers; /* with keys and buttons */
    double x, y;
} window_event;

/* 1 where the platform has a window. It is hidden until window_show(). */
int window_exists(const platform *p);
void window_show(platform *p, const char *title);
/* The next event, oldest first: 1, or 0 when there is none. Allocates nothing. */
int window_poll(platform *p, window_event *event);
void window_present(platform *p);                                 /* what was drawn last; waits for the screen */
void window_resize(platform *p, uint32_t width, uint32_t height); /* asks for it; an event tells of it */
double window_scale(const platform *p);                           /* pixels of a point: 2 on a fine screen */
#endif
