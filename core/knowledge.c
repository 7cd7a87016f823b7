/* knowledge.c - what each way to make shadows costs and how accurate it is, as long as nothing was measured.
 *
 * The model is a sum over what there is to draw (gn_cost); six coefficients a way, each times a count that the plan
 * knows. That shadow time is so is what Rautenbach's chapter 4 (2008) and docs/trade.md show: time follows lights, fill and, less,
 * silhouettes. */
#include "gni_select.h"

#include <math.h>
#include <string.h>

static const char *const accuracy_names[GN_ACCURACY_COUNT] = {"none", "rough", "fair", "fine", "exact"};

const char *gn_accuracy_name(gn_accuracy accuracy)
{
    return (unsigned)accuracy < GN_ACCURACY_COUNT ? accuracy_names[accuracy] : "";
}

gn_accuracy gn_accuracy_by_name(const char *name)
{
    int i = 0;

    while (i < GN_ACCURACY_COUNT && strcmp(accuracy_names[i], name) != 0)
        i++;
    return (gn_accuracy)i;
}

uint32_t gn_variant_scale(int variant)
{
    return variant == GN_VARIANT_FULL ? 1 : variant <= GN_VARIANT_HALF_DEPTH ? 2 : 4;
}

gn_upsample gn_variant_upsample(int variant)
{
    return variant == GN_VARIANT_HALF_DEPTH || variant == GN_VARIANT_QUARTER_DEPTH ? GN_UPSAMPLE_DEPTH
                                                                                   : GN_UPSAMPLE_BILINEAR;
}

int gn_way_variant(const gn_way *way)
{
    int v = 0;

    while (v < GN_VARIANT_COUNT &&
           (gn_variant_scale(v) != way->scale || (way->scale > 1 && gn_variant_upsample(v) != way->upsample)))
        v++;
    return v;
}

uint32_t gn_count_passes(const gn_way *way, uint32_t lights)
{
    const uint32_t most =
        way->scale > 1 && way->upsample == GN_UPSAMPLE_DEPTH && way->method != GN_METHOD_REFINE ? 2 : 4;

    return (lights + most - 1) / most;
}

void gn_count_costs(const gn_way *way, const gn_load *load, double counts[GN_COST_COUNT])
{
    const double scale = way->method == GN_METHOD_REFINE ? 1.0 : way->scale; /* its volumes are at full size */

    counts[GN_COST_SETUP] = 1.0;
    counts[GN_COST_INDEX] = load->indices;
    counts[GN_COST_FRAGMENT] = load->fragments / (scale * scale);
    counts[GN_COST_BORDER] = load->borders / scale;
    counts[GN_COST_PIXEL] = load->pixels / (scale * scale);
    counts[GN_COST_SWITCH] = way->method == GN_METHOD_STENCIL && way->scale == 1 ? 1.0 : 2.0;
}

int gni_way_exists(int method, int variant)
{
    if (method == GN_METHOD_REFINE)
        return variant == GN_VARIANT_HALF || variant == GN_VARIANT_QUARTER;
    return method > GN_METHOD_ZPASS;
}

/* Microseconds, fitted to the test scenes on llvmpipe, two threads (bench_predict). z-fail and z-pass are what stencil is
 * measured by, and are not chosen. */
static const struct {
    uint8_t method, variant, accuracy;
    float us[GN_COST_COUNT]; /* setup, index, fragment, border, pixel, switch */
} defaults[] = {
    {GN_METHOD_STENCIL, GN_VARIANT_FULL, GN_ACCURACY_EXACT, {20, 0.029f, 0.0014f, 0.0041f, 0, 54}},
    {GN_METHOD_STENCIL, GN_VARIANT_HALF, GN_ACCURACY_FAIR, {360, 0.035f, 0.0066f, 0.0068f, 0, 0}},
    {GN_METHOD_STENCIL, GN_VARIANT_HALF_DEPTH, GN_ACCURACY_FAIR, {400, 0.035f, 0.0066f, 0.0068f, 0, 0}},
    {GN_METHOD_STENCIL, GN_VARIANT_QUARTER, GN_ACCURACY_ROUGH, {320, 0.032f, 0.025f, 0.0055f, 0, 0}},
    {GN_METHOD_STENCIL, GN_VARIANT_QUARTER_DEPTH, GN_ACCURACY_ROUGH, {330, 0.032f, 0.025f, 0.0055f, 0, 0}},
    {GN_METHOD_REFINE, GN_VARIANT_HALF, GN_ACCURACY_FINE, {340, 0.055f, 0.00065f, 0.012f, 0.0146f, 145}},
    {GN_METHOD_REFINE, GN_VARIANT_QUARTER, GN_ACCURACY_FINE, {145, 0.064f, 0.0004f, 0.0106f, 0.015f, 124}},
    {GN_METHOD_COUNT, GN_VARIANT_FULL, GN_ACCURACY_EXACT, {980, 0.054f, 0.0051f, 0.0057f, 0.0053f, 63}},
    {GN_METHOD_COUNT, GN_VARIANT_HALF, GN_ACCURACY_FAIR, {820, 0.052f, 0.012f, 0.0057f, 0, 5}},
    {GN_METHOD_COUNT, GN_VARIANT_HALF_DEPTH, GN_ACCURACY_FAIR, {920, 0.057f, 0.0128f, 0.0077f, 0.002f, 0}},
    {GN_METHOD_COUNT, GN_VARIANT_QUARTER, GN_ACCURACY_ROUGH, {500, 0.047f, 0.047f, 0.004f, 0, 0}},
    {GN_METHOD_COUNT, GN_VARIANT_QUARTER_DEPTH, GN_ACCURACY_ROUGH, {600, 0.059f, 0.0455f, 0.0106f, 0, 0}},
    {GN_METHOD_SIGNED, GN_VARIANT_FULL, GN_ACCURACY_EXACT, {297, 0.051f, 0.005f, 0.0144f, 0.0152f, 47}},
    {GN_METHOD_SIGNED, GN_VARIANT_HALF, GN_ACCURACY_FAIR, {850, 0.095f, 0.0144f, 0.015f, 0, 12}},
    {GN_METHOD_SIGNED, GN_VARIANT_HALF_DEPTH, GN_ACCURACY_FAIR, {890, 0.084f, 0.0184f, 0.0166f, 0, 0}},
    {GN_METHOD_SIGNED, GN_VARIANT_QUARTER, GN_ACCURACY_ROUGH, {490, 0.073f, 0.054f, 0.0183f, 0, 0}},
    {GN_METHOD_SIGNED, GN_VARIANT_QUARTER_DEPTH, GN_ACCURACY_ROUGH, {625, 0.081f, 0.0525f, 0.022f, 0, 0}},
    {GN_METHOD_ALPHA, GN_VARIANT_FULL, GN_ACCURACY_FAIR, {174, 0.0535f, 0.007f, 0.0174f, 0.0065f, 43}},
    {GN_METHOD_ALPHA, GN_VARIANT_HALF, GN_ACCURACY_FAIR, {750, 0.105f, 0.0185f, 0.0246f, 0, 24}},
    {GN_METHOD_ALPHA, GN_VARIANT_HALF_DEPTH, GN_ACCURACY_FAIR, {905, 0.107f, 0.022f, 0.025f, 0, 0}},
    {GN_METHOD_ALPHA, GN_VARIANT_QUARTER, GN_ACCURACY_ROUGH, {415, 0.11f, 0.073f, 0.022f, 0, 0}},
    {GN_METHOD_ALPHA, GN_VARIANT_QUARTER_DEPTH, GN_ACCURACY_ROUGH, {600, 0.105f, 0.068f, 0.0277f, 0, 0}},
    {GN_METHOD_SCREEN, GN_VARIANT_FULL, GN_ACCURACY_FAIR, {1165, 0.084f, 0.0081f, 0.0162f, 0, 33}},
    {GN_METHOD_SCREEN, GN_VARIANT_HALF, GN_ACCURACY_FAIR, {670, 0.1f, 0.0177f, 0.0148f, 0, 0}},
    {GN_METHOD_SCREEN, GN_VARIANT_HALF_DEPTH, GN_ACCURACY_FAIR, {800, 0.1f, 0.021f, 0.016f, 0, 0}},
    {GN_METHOD_SCREEN, GN_VARIANT_QUARTER, GN_ACCURACY_ROUGH, {470, 0.086f, 0.067f, 0.0148f, 0, 0}},
    {GN_METHOD_SCREEN, GN_VARIANT_QUARTER_DEPTH, GN_ACCURACY_ROUGH, {600, 0.09f, 0.067f, 0.018f, 0, 0}},
};

#define SLOWER 2.0 /* than that: an unknown board is taken for a slow one */

/* Of a fragment two buffers are read and one or two written; of a pixel the mask is written, and read by what lights. */
static void set_bytes(double bytes[GN_COST_COUNT], gn_method method, int variant)
{
    const double scale = gn_variant_scale(variant);
    const int reads = gn_variant_upsample(variant) == GN_UPSAMPLE_DEPTH ? 4 : 1;

    bytes[GN_COST_FRAGMENT] = method == GN_METHOD_STENCIL || method == GN_METHOD_REFINE ? 8.0 : 12.0;
    bytes[GN_COST_PIXEL] = 8.0;
    if (method != GN_METHOD_REFINE && variant != GN_VARIANT_FULL)
        bytes[GN_COST_PIXEL] += 4.0 * reads * scale * scale;
}

void gn_knowledge_default(gn_knowledge *out)
{
    memset(out, 0, sizeof *out);
    for (size_t i = 0; i < sizeof defaults / sizeof defaults[0]; i++) {
        struct gn_known_way *k = &out->ways[defaults[i].method][defaults[i].variant];

        k->is_known = 1;
        k->accuracy = (gn_accuracy)defaults[i].accuracy;
        for (int c = 0; c < GN_COST_COUNT; c++)
            k->us[c] = SLOWER * (double)defaults[i].us[c];
        set_bytes(k->bytes, (gn_method)defaults[i].method, defaults[i].variant);
    }
}
