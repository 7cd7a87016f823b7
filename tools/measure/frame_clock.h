/* frame_clock.h - what a frame takes: by the wall's clock, all of it and its planning; and by the GL's own, its timer query.
 *
 * A query that works need not be right: one driver here says 1 ms of frames that are waited for 12. So it is believed only
 * where it agrees with the wall over frames that are drawn for nothing else; elsewhere the GL's part is what is waited for. */
#ifndef FRAME_CLOCK_H
#define FRAME_CLOCK_H
#include "stage.h"

typedef struct frame_clock {
    GLuint query; /* 0: none is proven, or it is not believed */
    char why_not[128];
} frame_clock;

/* ms */
typedef struct frame_times {
    double frame, plan; /* planning is part of the frame */
    double gl;          /* drawing: by the query, or until the GL is idle */
} frame_times;

/* Plans and draws what is wished for and waits for it. 1, or 0 with a message. */
int frame_clock_draw(const frame_clock *c, stage *st, const stage_wish *wish, frame_times *out,
                     char message[SCENE_MESSAGE]);

/* Tries the query on frames of the wish. 1, or 0 with a message when they cannot be drawn. */
int frame_clock_open(frame_clock *c, stage *st, const stage_wish *wish, char message[SCENE_MESSAGE]);
void frame_clock_close(frame_clock *c, stage *st); /* a zeroed one does nothing */
#endif
