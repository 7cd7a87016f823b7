/* frame_clock.c - see frame_clock.h. */
#include "frame_clock.h"

#include <stdio.h>

#include "picture.h"

#define TIME_ELAPSED 0x88BF /* GL_TIME_ELAPSED_EXT */
#define RESULT       0x8866 /* GL_QUERY_RESULT_EXT */

/* The query is believed if it says no more than what was waited for, and no less than half: the processor's own part of
 * a frame is in the one and not in the other. */
enum { TRIALS = 4 };
#define LEAST 0.5
#define MOST  1.05

static double result_ms(const frame_clock *c, const gn_gl *gl)
{
    GLuint nanoseconds = 0;

    gl->glGetQueryObjectuivEXT(c->query, RESULT, &nanoseconds);
    return nanoseconds * 1e-6;
}

int frame_clock_draw(const frame_clock *c, stage *st, const stage_wish *wish, frame_times *out,
                     char message[SCENE_MESSAGE])
{
    const gn_gl *gl = st->gl;
    const double start = now_ms();
    int ok;

    if (stage_plan(st, wish, message) != 0)
        return 0;
    out->plan = now_ms() - start;
    if (c->query)
        gl->glBeginQueryEXT(TIME_ELAPSED, c->query);
    ok = stage_draw_lit(st, 0, message);
    if (c->query)
        gl->glEndQueryEXT(TIME_ELAPSED);
    gl->glFinish();
    out->frame = now_ms() - start;
    out->gl = c->query ? result_ms(c, gl) : out->frame - out->plan;
    return ok;
}

int frame_clock_open(frame_clock *c, stage *st, const stage_wish *wish, char message[SCENE_MESSAGE])
{
    double said = 0.0, waited = 0.0;

    c->query = 0;
    snprintf(c->why_not, sizeof c->why_not, "timer-query is not proven");
    if (!gn_target_can(&st->target, GN_CAN_TIMER_QUERY))
        return 1;
    st->gl->glGenQueriesEXT(1, &c->query);
    for (int i = 0; i < TRIALS; i++) {
        frame_times t;

        if (!frame_clock_draw(c, st, wish, &t, message))
            return 0;
        said += i ? t.gl : 0.0; /* the first warms up */
        waited += i ? t.frame - t.plan : 0.0;
    }
    c->why_not[0] = '\0';
    if (said < LEAST * waited || said > MOST * waited) {
        frame_clock_close(c, st);
        snprintf(c->why_not, sizeof c->why_not, "the timer query says %.2f ms of frames that are waited for %.2f ms",
                 said / (TRIALS - 1), waited / (TRIALS - 1));
    }
    return 1;
}

void frame_clock_close(frame_clock *c, stage *st)
{
    if (c->query)
        st->gl->glDeleteQueriesEXT(1, &c->query);
    c->query = 0;
}
