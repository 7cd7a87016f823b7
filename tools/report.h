/* report.h - what a run of `gnomon render` measured, and its JSON. */
#ifndef REPORT_H
#define REPORT_H
#include "counted_gl.h"
#include "stage.h"

/* Milliseconds of each frame, three ways. */
typedef struct timings {
    double *frame, *same_passes, *one_pass; /* [count] */
    size_t count;
} timings;

typedef struct measured {
    uint32_t frames;
    gl_counts counts;                                /* of the last frame, whole */
    uint64_t allocations;                            /* in all frames but the first */
    uint64_t fragments_rasterised, fragments_passed; /* of the last frame's volumes */
    timings ms;
} measured;

/* Writes the report; sorts the timings. 1, or 0 having said why. */
int write_report(const char *path, const stage *s, measured *m);
#endif
