/* difference.h - the mask of a light as it is drawn against the truth, traced for just this view. */
#ifndef DIFFERENCE_H
#define DIFFERENCE_H
#include "stage.h"

typedef struct difference {
    uint8_t *marks; /* [height][width][4] RGBA: red, certain and wrong; yellow, wrong where the truth is not certain */
    uint32_t width, height, light;
    size_t certain, wrong_certain, wrong;
    double ms; /* that tracing took */
} difference;

/* Of the scene as it is posed, in the way that is wished. 0, or an exit status with a message. The frame that was drawn is spoilt. */
int difference_find(difference *d, stage *s, const stage_wish *way, uint32_t light, char message[SCENE_MESSAGE]);
void difference_free(difference *d); /* a zeroed one does nothing */
#endif
