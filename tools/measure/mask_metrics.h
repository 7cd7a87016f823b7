/* mask_metrics.h - how far a mask is from the truth (FACTS.md, measures of a mask).
 *
 * Masks are [height][width], row 0 on top, 0 shadowed and 255 lit. All is said of shadow, and of pixels in which the truth
 * shows a surface. The boundary of a mask: pixels with a neighbour, of four, that is seen too and is otherwise. */
#ifndef MASK_METRICS_H
#define MASK_METRICS_H
#include <stddef.h>
#include <stdint.h>

/* A mask and the truth about it. */
typedef struct mask_pair {
    uint32_t width, height;
    const uint8_t *lit, *true_lit; /* by the method; by the truth */
    const uint8_t *visible;        /* 255 where the truth shows a surface */
    const uint8_t *crossed; /* not 0 where an edge crosses the pixel for all that its middle shows; NULL: not known */
} mask_pair;

typedef struct mask_metrics {
    size_t visible, wrong; /* pixels */
    size_t interior,
        boundary; /* of the wrong: more than two pixels from the truth's boundary and any pixel that is crossed, and the others */
    double iou;               /* of shadow: 1 where neither has any */
    double precision, recall; /* 1 where there is nothing to be wrong, or missed */
    double boundary_f
        [2]; /* the share of boundaries that lie within 1, 2 pixels of each other: harmonic mean of precision and
                                  recall */
    double distance95; /* pixels: 95 % of both boundaries lie nearer to the other; the diagonal where one is missing */
} mask_metrics;

/* 1, or 0 without memory. */
int mask_measure(const mask_pair *pair, mask_metrics *out);

/* Pixels seen in both frames whose error comes or goes between two frames: the XOR of masks less the truth's own. */
size_t mask_flicker(const mask_pair *before, const mask_pair *after);

/* Squared distances, in pixels, to the nearest marked one: [height][width]; a large number where none is. 1, or 0 without
 * memory. (Felzenszwalb and Huttenlocher 2012: lower envelopes of parabolas, along columns and then rows.) */
int distance_transform(const uint8_t *marked, uint32_t width, uint32_t height, float *squared);
#endif
