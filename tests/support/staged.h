/* staged.h - a test scene of build/scenes on the stage, headless on EGL. */
#ifndef STAGED_H
#define STAGED_H
#include "stage.h"

typedef struct staged {
    scene loaded;
    stage *stage;
} staged;

/* 8 bits a channel, 24 of depth, 8 of stencil; posed at its start. A failure fails the test. */
void staged_open(staged *t, const char *name, uint32_t width, uint32_t height);
/* The same with options of the test's own. */
void staged_open_as(staged *t, const char *name, const stage_options *options);
void staged_close(staged *t);

/* A mask texture of the plan: [mask_size[1]][mask_size[0]][4], row 0 on top. The caller frees it. */
uint8_t *staged_read_mask(staged *t, uint32_t mask);
#endif
