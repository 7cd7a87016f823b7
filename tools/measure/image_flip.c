/* image_flip.c - FLIP (Andersson, Nilsson, Akenine-Moeller, Oskarsson, Astroem, Fairchild 2020): what an eye notices that
 * is shown one picture and then the other. Colours are blurred as the eye blurs them and compared in a space where distances are as seen;
 * edges and points that are in one and not in the other make it worse. */
#include "image_metrics.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#define PIXELS_A_DEGREE 67.0
#define COLOR_POWER     0.7   /* of distances between colours */
#define FEATURE_POWER   0.5   /* of those between edges, and points */
#define KNEE_AT         0.4   /* of the largest distance is mapped */
#define KNEE_TO         0.95  /* to here */
#define FEATURE_WIDTH   0.082 /* degrees */
#define PI              3.14159265358979323846

enum { MOST_RADIUS = 32 };

/* Of linear red, green, blue to X, Y, Z of a screen whose white is 1 1 1, and back. */
static const double to_xyz[3][3] = {{10135552.0 / 24577794.0, 8788810.0 / 24577794.0, 4435075.0 / 24577794.0},
                                    {2613072.0 / 12288897.0, 8788810.0 / 12288897.0, 887015.0 / 12288897.0},
                                    {1425312.0 / 73733382.0, 8788810.0 / 73733382.0, 70074185.0 / 73733382.0}};
static const double from_xyz[3][3] = {{3.241003275, -1.537398934, -0.498615861},
                                      {-0.969224334, 1.875930071, 0.041554224},
                                      {0.055639423, -0.204011202, 1.057148933}};

static void times(const double m[3][3], const double v[3], double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
}

/* The white of the screen. */
static void find_white(double white[3])
{
    static const double ones[3] = {1, 1, 1};

    times(to_xyz, ones, white);
}

static double linear(uint8_t level)
{
    const double v = level / 255.0;

    return v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4);
}

/* Opponent colours in which blurring is linear. */
static void to_opponents(const uint8_t rgb[3], const double white[3], double out[3])
{
    const double v[3] = {linear(rgb[0]), linear(rgb[1]), linear(rgb[2])};
    double xyz[3];

    times(to_xyz, v, xyz);
    for (int i = 0; i < 3; i++)
        xyz[i] /= white[i];
    out[0] = 116.0 * xyz[1] - 16.0;
    out[1] = 500.0 * (xyz[0] - xyz[1]);
    out[2] = 200.0 * (xyz[1] - xyz[2]);
}

static double lab_of(double t)
{
    const double d = 6.0 / 29.0;

    return t > d * d * d ? cbrt(t) : t / (3.0 * d * d) + 4.0 / 29.0;
}

/* L*a*b* of linear colours, with what is dark less colourful (the Hunt effect). */
static void to_hunt_lab(const double rgb[3], const double white[3], double out[3])
{
    double xyz[3], f[3];

    times(to_xyz, rgb, xyz);
    for (int i = 0; i < 3; i++)
        f[i] = lab_of(xyz[i] / white[i]);
    out[0] = 116.0 * f[1] - 16.0;
    out[1] = 0.01 * out[0] * 500.0 * (f[0] - f[1]);
    out[2] = 0.01 * out[0] * 200.0 * (f[1] - f[2]);
}

static void from_opponents(const double c[3], const double white[3], double rgb[3])
{
    const double y = (c[0] + 16.0) / 116.0;
    const double xyz[3] = {(y + c[1] / 500.0) * white[0], y * white[1], (y - c[2] / 200.0) * white[2]};

    times(from_xyz, xyz, rgb);
    for (int i = 0; i < 3; i++)
        rgb[i] = fmin(fmax(rgb[i], 0.0), 1.0);
}

static double distance_of(const double a[3], const double b[3])
{
    return pow(fabs(a[0] - b[0]) + hypot(a[1] - b[1], a[2] - b[2]), COLOR_POWER);
}

/* A picture while it is looked at: planes of [height][width]. */
typedef struct eye {
    uint32_t width, height;
    double *planes[3], *blurred[3], *edges, *points, *spare;
} eye;

static size_t clamped(long at, uint32_t count)
{
    return (size_t)(at < 0 ? 0 : at >= (long)count ? (long)count - 1 : at);
}

/* By weights along rows, and others along columns; borders go on. out may not be a plane that is read. */
static void filter(const eye *e, const double *in, const double *along, const double *down, int radius, double *out)
{
    for (uint32_t y = 0; y < e->height; y++)
        for (uint32_t x = 0; x < e->width; x++) {
            double sum = 0.0;

            for (int k = -radius; k <= radius; k++)
                sum += along[k + radius] * in[(size_t)e->width * y + clamped((long)x + k, e->width)];
            e->spare[(size_t)e->width * y + x] = sum;
        }
    for (uint32_t y = 0; y < e->height; y++)
        for (uint32_t x = 0; x < e->width; x++) {
            double sum = 0.0;

            for (int k = -radius; k <= radius; k++)
                sum += down[k + radius] * e->spare[e->width * clamped((long)y + k, e->height) + x];
            out[(size_t)e->width * y + x] = sum;
        }
}

/* Weights of the eye's blur in one opponent channel: a sum of two Gaussians, each separable, with its share of the whole. */
static void blur_weights(double b, int radius, double *weights, double *volume)
{
    double sum = 0.0;

    for (int k = -radius; k <= radius; k++)
        sum += weights[k + radius] = exp(-PI * PI * (k / PIXELS_A_DEGREE) * (k / PIXELS_A_DEGREE) / b);
    for (int k = -radius; k <= radius; k++)
        weights[k + radius] /= sum;
    *volume = sum * sum;
}

static void blur(eye *e, double *sum)
{
    static const double bells[3][2][2] = {
        {{1.0, 0.0047}, {0.0, 0.0}}, {{1.0, 0.0053}, {0.0, 0.0}}, {{34.1, 0.04}, {13.5, 0.025}}};
    const int radius = (int)ceil(3.0 * sqrt(0.04 / (2.0 * PI * PI)) * PIXELS_A_DEGREE);
    const size_t pixels = (size_t)e->width * e->height;

    for (int c = 0; c < 3; c++) {
        double weights[2][2 * MOST_RADIUS + 1], share[2] = {0, 0}, volume;

        for (int bell = 0; bell < 2 && bells[c][bell][0] > 0.0; bell++) {
            blur_weights(bells[c][bell][1], radius, weights[bell], &volume);
            share[bell] = bells[c][bell][0] * sqrt(PI / bells[c][bell][1]) * volume;
        }
        memset(e->blurred[c], 0, pixels * sizeof(double));
        for (int bell = 0; bell < 2 && share[bell] > 0.0; bell++) {
            filter(e, e->planes[c], weights[bell], weights[bell], radius, sum);
            for (size_t i = 0; i < pixels; i++)
                e->blurred[c][i] += share[bell] / (share[0] + share[1]) * sum[i];
        }
    }
}

/* Weights of the first or the second derivative of a Gaussian, what is above 0 and below adding to 1 each; and its own. */
static int feature_weights(int order, double *derivative, double *bell)
{
    const double deviation = 0.5 * FEATURE_WIDTH * PIXELS_A_DEGREE;
    const int radius = (int)ceil(3.0 * deviation);
    double above = 0.0, below = 0.0, sum = 0.0;

    for (int k = -radius; k <= radius; k++) {
        const double g = exp(-k * k / (2.0 * deviation * deviation));
        const double w = order == 1 ? -k * g : (k * k / (deviation * deviation) - 1.0) * g;

        derivative[k + radius] = w;
        bell[k + radius] = g;
        above += w > 0.0 ? w : 0.0;
        below -= w < 0.0 ? w : 0.0;
        sum += g;
    }
    for (int k = 0; k <= 2 * radius; k++) {
        derivative[k] /= derivative[k] > 0.0 ? above : below;
        bell[k] /= sum;
    }
    return radius;
}

/* The length of the gradient of edges (order 1), or of points (2), in the first plane. */
static void find_features(eye *e, int order, double *across, double *length)
{
    const size_t pixels = (size_t)e->width * e->height;
    double derivative[2 * MOST_RADIUS + 1], bell[2 * MOST_RADIUS + 1];
    const int radius = feature_weights(order, derivative, bell);

    filter(e, e->planes[0], derivative, bell, radius, across);
    filter(e, e->planes[0], bell, derivative, radius, length);
    for (size_t i = 0; i < pixels; i++)
        length[i] = hypot(across[i], length[i]) / 116.0; /* of lightness from 0 to 1 */
}

static void look(eye *e, const uint8_t *rgb, const double white[3])
{
    const size_t pixels = (size_t)e->width * e->height;

    for (size_t i = 0; i < pixels; i++) {
        double c[3];

        to_opponents(rgb + 3 * i, white, c);
        for (int k = 0; k < 3; k++)
            e->planes[k][i] = c[k];
    }
}

/* From 0 to 1, most of which small distances take. */
static double spread(double distance, double most)
{
    const double knee = KNEE_AT * most;

    return distance < knee ? KNEE_TO / knee * distance : KNEE_TO + (distance - knee) / (most - knee) * (1.0 - KNEE_TO);
}

static double color_difference(const eye *a, const eye *b, size_t i, const double white[3], double most)
{
    const double of_a[3] = {a->blurred[0][i], a->blurred[1][i], a->blurred[2][i]};
    const double of_b[3] = {b->blurred[0][i], b->blurred[1][i], b->blurred[2][i]};
    double rgb[3], lab[2][3];

    from_opponents(of_a, white, rgb);
    to_hunt_lab(rgb, white, lab[0]);
    from_opponents(of_b, white, rgb);
    to_hunt_lab(rgb, white, lab[1]);
    return spread(distance_of(lab[0], lab[1]), most);
}

/* Of each picture its planes and what is blurred, its edges and its points; two that both use. */
enum { OF_EACH = 8, PLANES = 2 * OF_EACH + 2 };

static void look_at(eye *e, const uint8_t *rgb, const double white[3], double *own, double *shared)
{
    const size_t pixels = (size_t)e->width * e->height;

    for (int c = 0; c < 3; c++) {
        e->planes[c] = own + (size_t)c * pixels;
        e->blurred[c] = own + (size_t)(3 + c) * pixels;
    }
    e->edges = own + 6 * pixels;
    e->points = own + 7 * pixels;
    e->spare = shared;
    look(e, rgb, white);
    find_features(e, 1, shared + pixels, e->edges);
    find_features(e, 2, shared + pixels, e->points);
    blur(e, shared + pixels);
}

double image_flip(const uint8_t *a, const uint8_t *b, uint32_t width, uint32_t height)
{
    static const double green[3] = {0, 1, 0}, blue[3] = {0, 0, 1};
    const size_t pixels = (size_t)width * height;
    double *memory = malloc(PLANES * pixels * sizeof *memory);
    double white[3], lab[2][3], most, sum = 0.0;
    eye eyes[2];

    if (!memory)
        return -1.0;
    find_white(white);
    to_hunt_lab(green, white, lab[0]);
    to_hunt_lab(blue, white, lab[1]);
    most = distance_of(lab[0], lab[1]);
    for (int k = 0; k < 2; k++) {
        eyes[k].width = width;
        eyes[k].height = height;
        look_at(&eyes[k], k ? b : a, white, memory + (size_t)(k * OF_EACH) * pixels,
                memory + (size_t)(2 * OF_EACH) * pixels);
    }
    for (size_t i = 0; i < pixels; i++) {
        const double feature =
            fmax(fabs(eyes[0].edges[i] - eyes[1].edges[i]), fabs(eyes[0].points[i] - eyes[1].points[i]));

        sum += pow(color_difference(&eyes[0], &eyes[1], i, white, most), 1.0 - pow(feature / sqrt(2.0), FEATURE_POWER));
    }
    free(memory);
    return sum / (double)pixels;
}
