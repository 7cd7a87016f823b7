/* render_adaptive.h - `gnomon render` within a budget: frames whose shadows are made as the selector chooses, under loads of a
 * script, with a row of a CSV for each. */
#ifndef RENDER_ADAPTIVE_H
#define RENDER_ADAPTIVE_H
#include "selecting.h"
#include "stage.h"

typedef struct adaptive_job {
    selecting given;
    double power, spin;
    const char *script, *csv; /* NULL: none */
    long frames;
    int explain;
} adaptive_job;

/* Draws the frames, the last of which stays in the target. 0, or an exit status having said why. */
int render_adaptively(stage *s, const adaptive_job *j, const stage_wish *like);
#endif
