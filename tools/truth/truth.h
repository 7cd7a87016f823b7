/* truth.h - the right mask of a scene, by tracing rays in double precision, and how sure each pixel of it is.
 *
 * What a mask is stands in CLI.md: a pixel is lit where the seen side of the face looks at the light (flat normal) and
 * no caster's triangle meets the open segment from the visible point to the light; cones and ranges do not matter.
 * This module shares nothing with the library whose masks it judges but the scene that both read. */
#ifndef TRUTH_H
#define TRUTH_H
#include "scene.h"

/* How sure a pixel is. Anything but TRUTH_CERTAIN may differ in a mask drawn by a GL. */
typedef enum truth_class {
    TRUTH_CERTAIN,       /* an exact method must agree */
    TRUTH_DEPTH_LIMITED, /* flips within 2 steps of the depth format along the view ray */
    TRUTH_SNAPPED,       /* flips when vertices move by 1/256 pixel, as rasterisers snap them */
    TRUTH_BOUNDARY       /* nine subsamples disagree, or a shadow edge crosses the footprint */
} truth_class;

typedef struct truth truth;

typedef struct truth_options {
    uint32_t width, height;
    int depth_bits;        /* of the target that is to be judged, say 24 */
    double ortho_depth[2]; /* the range of view depths that an orthographic target's depth buffer spans; 0, 0: znear to
                              zfar, or to behind the scene where the camera has no zfar */
} truth_options;

/* Builds the hierarchies and traces the primary rays of a posed scene with a camera. The scene must stay as it is until
 * truth_free(). Returns NULL with a message when memory ran out or an argument is out of range. */
truth *truth_create(const scene *s, const truth_options *options, char message[SCENE_MESSAGE]);

/* The mask of one light: [height][width] each, row 0 on top. lit: 0 or 255; visible: 0 or 255 (lit is 0 where
 * nothing is visible); classes: truth_class. Returns 1, or 0 with a message. */
int truth_light(truth *t, size_t light, uint8_t *lit, uint8_t *visible, uint8_t *classes, char message[SCENE_MESSAGE]);

void truth_free(truth *t); /* NULL does nothing */
#endif
