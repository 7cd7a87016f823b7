/* image_metrics.c - PSNR and SSIM: see image_metrics.h. */
#include "image_metrics.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>

double image_psnr(const uint8_t *a, const uint8_t *b, uint32_t width, uint32_t height)
{
    const size_t count = (size_t)3 * width * height;
    double sum = 0.0;

    for (size_t i = 0; i < count; i++)
        sum += ((double)a[i] - b[i]) * ((double)a[i] - b[i]);
    return sum > 0.0 ? 10.0 * log10(255.0 * 255.0 * (double)count / sum) : INFINITY;
}

enum { RADIUS = 5, WINDOW = 2 * RADIUS + 1, MOMENTS = 5 };

/* Of two pictures' values: mean of a, of b, of a a, b b, a b. */
static void moments_of(double a, double b, double out[MOMENTS])
{
    out[0] = a;
    out[1] = b;
    out[2] = a * a;
    out[3] = b * b;
    out[4] = a * b;
}

static double similarity(const double m[MOMENTS])
{
    const double c1 = 0.01 * 255.0 * 0.01 * 255.0, c2 = 0.03 * 255.0 * 0.03 * 255.0;
    const double variances = m[2] - m[0] * m[0] + m[3] - m[1] * m[1], covariance = m[4] - m[0] * m[1];

    return (2.0 * m[0] * m[1] + c1) * (2.0 * covariance + c2) / ((m[0] * m[0] + m[1] * m[1] + c1) * (variances + c2));
}

/* Sums over rows of windows, row by row, and these over columns. rows: [height][MOMENTS] of one column of windows. */
static double sum_column(const uint8_t *a, const uint8_t *b, uint32_t width, uint32_t height, uint32_t x, int channel,
                         const double weights[WINDOW], double (*rows)[MOMENTS])
{
    double sum = 0.0;

    for (uint32_t y = 0; y < height; y++) {
        double *r = rows[y];

        for (int m = 0; m < MOMENTS; m++)
            r[m] = 0.0;
        for (int k = 0; k < WINDOW; k++) {
            const size_t at = 3 * ((size_t)width * y + x + (size_t)k - RADIUS) + (size_t)channel;
            double moments[MOMENTS];

            moments_of(a[at], b[at], moments);
            for (int m = 0; m < MOMENTS; m++)
                r[m] += weights[k] * moments[m];
        }
    }
    for (uint32_t y = RADIUS; y + RADIUS < height; y++) {
        double moments[MOMENTS] = {0, 0, 0, 0, 0};

        for (int k = 0; k < WINDOW; k++)
            for (int m = 0; m < MOMENTS; m++)
                moments[m] += weights[k] * rows[y + (uint32_t)k - RADIUS][m];
        sum += similarity(moments);
    }
    return sum;
}

double image_ssim(const uint8_t *a, const uint8_t *b, uint32_t width, uint32_t height)
{
    double weights[WINDOW], total = 0.0, sum = 0.0, (*rows)[MOMENTS];

    if (width < WINDOW || height < WINDOW)
        return -1.0;
    rows = malloc(height * sizeof *rows);
    if (!rows)
        return -1.0;
    for (int k = 0; k < WINDOW; k++)
        total += weights[k] = exp(-(k - RADIUS) * (k - RADIUS) / (2.0 * 1.5 * 1.5));
    for (int k = 0; k < WINDOW; k++)
        weights[k] /= total;
    for (int channel = 0; channel < 3; channel++)
        for (uint32_t x = RADIUS; x + RADIUS < width; x++)
            sum += sum_column(a, b, width, height, x, channel, weights, rows);
    free(rows);
    return sum / (3.0 * (width - 2 * RADIUS) * (height - 2 * RADIUS));
}
