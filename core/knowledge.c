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
    {GN_METHOD_STENCIL, GN_VARIANT_FULL, GN_ACCURACY_EXACT, {50, 0.029f, 0.0014f, 0.0041f, 0, 54}},
    {GN_METHOD_STENCIL, GN_VARIANT_HALF, GN_ACCURACY_FAIR, {150, 0.033f, 0.0072f, 0.0067f, 0, 60}},
    {GN_METHOD_STENCIL, GN_VARIANT_HALF_DEPTH, GN_ACCURACY_FAIR, {150, 0.033f, 0.0072f, 0.0067f, 0, 110}},
    {GN_METHOD_STENCIL, GN_VARIANT_QUARTER, GN_ACCURACY_ROUGH, {90, 0.032f, 0.025f, 0.0055f, 0, 50}},
    {GN_METHOD_STENCIL, GN_VARIANT_QUARTER_DEPTH, GN_ACCURACY_ROUGH, {90, 0.032f, 0.025f, 0.0055f, 0, 70}},
    {GN_METHOD_REFINE, GN_VARIANT_HALF, GN_ACCURACY_FINE, {290, 0.055f, 0.0007f, 0.012f, 0.014f, 180}},
    {GN_METHOD_REFINE, GN_VARIANT_QUARTER, GN_ACCURACY_FINE, {120, 0.064f, 0.0004f, 0.0105f, 0.015f, 140}},
    {GN_METHOD_COUNT, GN_VARIANT_FULL, GN_ACCURACY_EXACT, {790, 0.053f, 0.0052f, 0.0055f, 0.004f, 175}},
    {GN_METHOD_COUNT, GN_VARIANT_HALF, GN_ACCURACY_FAIR, {590, 0.052f, 0.013f, 0.0047f, 0, 72}},
    {GN_METHOD_COUNT, GN_VARIANT_HALF_DEPTH, GN_ACCURACY_FAIR, {570, 0.058f, 0.0113f, 0.0064f, 0, 160}},
    {GN_METHOD_COUNT, GN_VARIANT_QUARTER, GN_ACCURACY_ROUGH, {500, 0.046f, 0.044f, 0.005f, 0, 15}},
    {GN_METHOD_COUNT, GN_VARIANT_QUARTER_DEPTH, GN_ACCURACY_ROUGH, {290, 0.058f, 0.043f, 0.011f, 0, 110}},
    {GN_METHOD_SIGNED, GN_VARIANT_FULL, GN_ACCURACY_EXACT, {265, 0.051f, 0.005f, 0.0144f, 0.0147f, 78}},
    {GN_METHOD_SIGNED, GN_VARIANT_HALF, GN_ACCURACY_FAIR, {630, 0.096f, 0.0146f, 0.0146f, 0, 77}},
    {GN_METHOD_SIGNED, GN_VARIANT_HALF_DEPTH, GN_ACCURACY_FAIR, {455, 0.081f, 0.0174f, 0.0164f, 0, 165}},
    {GN_METHOD_SIGNED, GN_VARIANT_QUARTER, GN_ACCURACY_ROUGH, {510, 0.072f, 0.05f, 0.018f, 0, 15}},
    {GN_METHOD_SIGNED, GN_VARIANT_QUARTER_DEPTH, GN_ACCURACY_ROUGH, {320, 0.081f, 0.055f, 0.021f, 0, 107}},
    {GN_METHOD_ALPHA, GN_VARIANT_FULL, GN_ACCURACY_FAIR, {155, 0.054f, 0.0071f, 0.0172f, 0.0062f, 61}},
    {GN_METHOD_ALPHA, GN_VARIANT_HALF, GN_ACCURACY_FAIR, {565, 0.104f, 0.0186f, 0.0241f, 0, 94}},
    {GN_METHOD_ALPHA, GN_VARIANT_HALF_DEPTH, GN_ACCURACY_FAIR, {515, 0.098f, 0.0212f, 0.0254f, 0, 170}},
    {GN_METHOD_ALPHA, GN_VARIANT_QUARTER, GN_ACCURACY_ROUGH, {440, 0.105f, 0.067f, 0.024f, 0, 15}},
    {GN_METHOD_ALPHA, GN_VARIANT_QUARTER_DEPTH, GN_ACCURACY_ROUGH, {260, 0.104f, 0.067f, 0.028f, 0, 112}},
    {GN_METHOD_SCREEN, GN_VARIANT_FULL, GN_ACCURACY_FAIR, {850, 0.085f, 0.0085f, 0.0152f, 0, 137}},
    {GN_METHOD_SCREEN, GN_VARIANT_HALF, GN_ACCURACY_FAIR, {585, 0.099f, 0.0187f, 0.0144f, 0, 32}},
    {GN_METHOD_SCREEN, GN_VARIANT_HALF_DEPTH, GN_ACCURACY_FAIR, {520, 0.095f, 0.021f, 0.016f, 0, 105}},
    {GN_METHOD_SCREEN, GN_VARIANT_QUARTER, GN_ACCURACY_ROUGH, {480, 0.086f, 0.06f, 0.0158f, 0, 15}},
    {GN_METHOD_SCREEN, GN_VARIANT_QUARTER_DEPTH, GN_ACCURACY_ROUGH, {260, 0.09f, 0.06f, 0.018f, 0, 70}},
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
