/* true_mask.h - the true mask of a light of a scene, with what the scene says of lights that some objects do not shade. */
#ifndef TRUE_MASK_H
#define TRUE_MASK_H
#include "truth.h"

typedef struct true_mask {
    uint8_t *lit, *visible, *classes; /* truth_light()'s */
} true_mask;

/* Of the scene as it is posed. common: kept between lights of one pose, NULL at first; free it with truth_free(). 1, or 0 with a
 * message. */
int true_mask_trace(true_mask *m, scene *s, const truth_options *options, uint32_t light, truth **common,
                    char message[SCENE_MESSAGE]);
void true_mask_free(true_mask *m); /* a zeroed one does nothing */
#endif
