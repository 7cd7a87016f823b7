/* knowledge.c - what each way to make shadows costs and how accurate it is, as long as nothing was measured.
 *
 * The model is a sum over what there is to draw (gn_cost); five coefficients a way, each times a count that the plan
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

int gni_way_exists(int method, int variant)
{
    if (method == GN_METHOD_REFINE)
        return variant == GN_VARIANT_HALF || variant == GN_VARIANT_QUARTER;
    return method > GN_METHOD_ZPASS;
}

/* Microseconds at full size, by method: fitted to the test scenes on llvmpipe, two threads (bench_predict). z-fail
 * and z-pass are what stencil is measured by, and are not chosen. */
static const struct {
    float setup, index, fragment, pixel, pass; /* pass: of a switch */
    uint8_t bytes;                             /* of a fragment */
    uint8_t accuracy;
} defaults[GN_METHOD_TOTAL] = {
    [GN_METHOD_STENCIL] = {350, 0.03f, 0.0029f, 0.0f, 20, 8, GN_ACCURACY_EXACT},
    [GN_METHOD_REFINE] = {0, 0.19f, 0.0028f, 0.0175f, 200, 8, GN_ACCURACY_FINE},
    [GN_METHOD_COUNT] = {660, 0.09f, 0.0084f, 0.0044f, 190, 12, GN_ACCURACY_EXACT},
    [GN_METHOD_SIGNED] = {400, 0.1f, 0.0078f, 0.02f, 80, 12, GN_ACCURACY_EXACT},
    [GN_METHOD_ALPHA] = {240, 0.08f, 0.0085f, 0.008f, 70, 12, GN_ACCURACY_FAIR},
    [GN_METHOD_SCREEN] = {900, 0.08f, 0.015f, 0.002f, 150, 12, GN_ACCURACY_FAIR},
};

#define SLOWER 2.0 /* than that: an unknown board is taken for a slow one */

/* Small masks: fragments are a fourth or a sixteenth, but each is of a triangle's border more often. */
static void make_small(struct gn_known_way *k, int method, uint32_t scale, int is_depth)
{
    const int is_simple = method == GN_METHOD_STENCIL || method == GN_METHOD_COUNT;

    k->us[GN_COST_SETUP] = is_depth ? 400.0 : 550.0;
    k->us[GN_COST_INDEX] = is_simple ? fmax(k->us[GN_COST_INDEX], 0.05) * (is_depth ? 1.5 : 1.1) : 0.16;
    k->us[GN_COST_FRAGMENT] *= scale == 2 ? 3.0 : 6.5;
    k->us[GN_COST_PIXEL] = 0.0;
    k->us[GN_COST_SWITCH] = is_depth ? 170.0 : 80.0;
    for (int c = 0; c < GN_COST_COUNT && is_depth && scale == 2; c++)
        k->us[c] *= 1.25;
    k->bytes[GN_COST_PIXEL] += 4.0 * (is_depth ? 4.0 : 1.0) * scale * scale;
    k->accuracy = scale == 2 ? GN_ACCURACY_FAIR : GN_ACCURACY_ROUGH;
}

void gn_knowledge_default(gn_knowledge *out)
{
    memset(out, 0, sizeof *out);
    for (int m = 0; m < GN_METHOD_TOTAL; m++)
        for (int v = 0; v < GN_VARIANT_COUNT; v++) {
            struct gn_known_way *k = &out->ways[m][v];

            if (!gni_way_exists(m, v))
                continue;
            k->is_known = 1;
            k->us[GN_COST_SETUP] = (double)defaults[m].setup;
            k->us[GN_COST_INDEX] = (double)defaults[m].index;
            k->us[GN_COST_FRAGMENT] = (double)defaults[m].fragment;
            k->us[GN_COST_PIXEL] = (double)defaults[m].pixel;
            k->us[GN_COST_SWITCH] = (double)defaults[m].pass;
            k->bytes[GN_COST_FRAGMENT] = defaults[m].bytes;
            k->bytes[GN_COST_PIXEL] = 8.0;
            k->accuracy = (gn_accuracy)defaults[m].accuracy;
            if (m != GN_METHOD_REFINE && v != GN_VARIANT_FULL)
                make_small(k, m, gn_variant_scale(v), gn_variant_upsample(v) == GN_UPSAMPLE_DEPTH);
            for (int c = 0; c < GN_COST_COUNT; c++)
                k->us[c] *= SLOWER;
        }
}
