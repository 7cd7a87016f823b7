/* overlay.h - text and flat shapes over a frame, in pixels from the left and top, gathered and drawn at once. */
#ifndef OVERLAY_H
#define OVERLAY_H
#include "gn_gl.h"

typedef struct overlay overlay;

typedef struct overlay_color {
    float r, g, b, a;
} overlay_color;

/* NULL when a shader is refused or memory ran out. */
overlay *overlay_create(const gn_gl *gl);
void overlay_destroy(overlay *o); /* NULL does nothing */

/* fine: letters twice as large. */
void overlay_begin(overlay *o, unsigned width, unsigned height, int fine);
void overlay_rectangle(overlay *o, double x, double y, double width, double height, overlay_color color);
void overlay_disc(overlay *o, double x, double y, double radius, overlay_color color);
/* One line, of printable ASCII; others are drawn as '?'. Returns how wide it is. */
double overlay_text(overlay *o, double x, double y, overlay_color color, const char *text);
double overlay_letter_width(const overlay *o);
double overlay_line_height(const overlay *o);
/* Draws what was gathered, and leaves the state as gn_gles_next() does. What has no room was left out. */
void overlay_end(overlay *o);
#endif
