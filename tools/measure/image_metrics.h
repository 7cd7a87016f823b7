/* image_metrics.h - how far one picture is from another, as it is looked at: sRGB, 8 bits a channel, [height][width][3]. */
#ifndef IMAGE_METRICS_H
#define IMAGE_METRICS_H
#include <stdint.h>

/* Decibels over all channels; INFINITY where they are the same. */
double image_psnr(const uint8_t *a, const uint8_t *b, uint32_t width, uint32_t height);

/* Structural similarity (Wang et al. 2004): Gaussian window of 11 x 11, sigma 1.5, population covariance, mean of the channels and
 * of all places whose window is within the picture. -1 without memory, or where the picture is smaller than a window. */
double image_ssim(const uint8_t *a, const uint8_t *b, uint32_t width, uint32_t height);

/* The mean of FLIP (Andersson et al. 2020), of low dynamic range: 0 the same, 1 as different as can be seen in the time of a
 * flip between the two, at 67 pixels a degree (a screen of 3840 pixels, 0.7 m wide, from 0.7 m). -1 without memory. */
double image_flip(const uint8_t *a, const uint8_t *b, uint32_t width, uint32_t height);
#endif
