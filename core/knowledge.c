/* knowledge.c - what each way to make shadows costs and how accurate it is: the default, and what `gnomon calibrate` measured.
 *
 * The model is a sum over what there is to draw (gn_cost); five coefficients a way, each times a count that the plan
 * knows. That shadow time is so is what Rautenbach's chapter 4 (2008) and docs/trade.md show: time follows lights, fill and, less,
 * silhouettes. */
#include "gni_select.h"
#include "scan.h"

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

uint32_t gni_variant_scale(int variant)
{
    return variant == GN_VARIANT_FULL ? 1 : variant <= GN_VARIANT_HALF_DEPTH ? 2 : 4;
}

gn_upsample gni_variant_upsample(int variant)
{
    return variant == GN_VARIANT_HALF_DEPTH || variant == GN_VARIANT_QUARTER_DEPTH ? GN_UPSAMPLE_DEPTH
                                                                                   : GN_UPSAMPLE_BILINEAR;
}

/* refine has small masks of its own, that are not upsampled. */
static int exists(int method, int variant)
{
    if (method == GN_METHOD_REFINE)
        return variant == GN_VARIANT_HALF || variant == GN_VARIANT_QUARTER;
    return method > GN_METHOD_ZPASS;
}

/* ------------------------------------------------------------------ the default */

/* Of a board that fills 100 million pixels a second, each counted fragment in this many bytes, and this many times as dear as a
 * stencil's. z-fail and z-pass are what stencil is measured by, and are not chosen. */
static const struct {
    double bytes, times;
    gn_accuracy accuracy;
} defaults[GN_METHOD_TOTAL] = {
    [GN_METHOD_STENCIL] = {8, 1, GN_ACCURACY_EXACT}, [GN_METHOD_REFINE] = {8, 1.5, GN_ACCURACY_FINE},
    [GN_METHOD_COUNT] = {12, 2, GN_ACCURACY_EXACT},  [GN_METHOD_SIGNED] = {12, 3, GN_ACCURACY_EXACT},
    [GN_METHOD_ALPHA] = {12, 4, GN_ACCURACY_FAIR},   [GN_METHOD_SCREEN] = {12, 4, GN_ACCURACY_FAIR},
};

void gn_knowledge_default(gn_knowledge *out)
{
    memset(out, 0, sizeof *out);
    for (int m = 0; m < GN_METHOD_TOTAL; m++)
        for (int v = 0; v < GN_VARIANT_COUNT; v++) {
            struct gn_known_way *k = &out->ways[m][v];
            const uint32_t scale = gni_variant_scale(v);
            const int is_depth = gni_variant_upsample(v) == GN_UPSAMPLE_DEPTH;
            const double us[GN_COST_COUNT] = {200, 0.02, 0.01 * defaults[m].times,
                                              /* of the mask's pixels: each is read by scale^2 of the frame's */
                                              0.02 + (scale > 1 ? (is_depth ? 0.03 : 0.01) * scale * scale : 0), 100};
            const double bytes[GN_COST_COUNT] = {0, 0, defaults[m].bytes,
                                                 8 + (scale > 1 ? (is_depth ? 16.0 : 4.0) * scale * scale : 0), 0};

            if (!exists(m, v))
                continue;
            k->is_known = 1;
            memcpy(k->us, us, sizeof us);
            memcpy(k->bytes, bytes, sizeof bytes);
            k->accuracy = defaults[m].accuracy;
            if (m != GN_METHOD_REFINE && scale > 1)
                k->accuracy = scale == 2 ? GN_ACCURACY_FAIR : GN_ACCURACY_ROUGH;
        }
}

/* ------------------------------------------------------------------ reading */

static const char *const columns[] = {"method",      "scale",          "upsample",    "accuracy",    "us_setup",
                                      "us_index",    "us_fragment",    "us_pixel",    "us_switch",   "bytes_setup",
                                      "bytes_index", "bytes_fragment", "bytes_pixel", "bytes_switch"};
enum { COLUMNS = sizeof columns / sizeof columns[0] };

static void read_word(gni_scan *s, char word[16])
{
    const size_t length = s->token.length < 15 ? s->token.length : 15;

    memcpy(word, s->token.at, length);
    word[length] = '\0';
    gni_scan_next(s);
    gni_scan_expect(s, ",");
}

static void read_row(gni_scan *s, gn_knowledge *k)
{
    const char *at = s->token.at;
    char method[16], upsample[16], accuracy[16];
    double scale;
    int m = 1, v = 0, one_sided;
    struct gn_known_way *way;

    read_word(s, method);
    scale = gni_scan_number(s);
    gni_scan_expect(s, ",");
    read_word(s, upsample);
    read_word(s, accuracy);
    m = (int)gn_method_by_name(method, &one_sided);
    while (v < GN_VARIANT_COUNT && (gni_variant_scale(v) != scale ||
                                    (gni_variant_upsample(v) == GN_UPSAMPLE_DEPTH) != (strcmp(upsample, "depth") == 0)))
        v++;
    if (s->result == GN_OK && (m == GN_METHOD_TOTAL || v == GN_VARIANT_COUNT || !exists(m, v)))
        gni_scan_fail(s, at, "there is no such way (%s, %g, %s)", method, scale, upsample);
    if (s->result == GN_OK && gn_accuracy_by_name(accuracy) == GN_ACCURACY_COUNT)
        gni_scan_fail(s, at, "accuracy is none, rough, fair, fine or exact (%s)", accuracy);
    if (s->result != GN_OK)
        return;
    way = &k->ways[m][v];
    if (way->is_known)
        gni_scan_fail(s, at, "this way has a row already (%s, %g, %s)", method, scale, upsample);
    way->is_known = 1;
    way->accuracy = gn_accuracy_by_name(accuracy);
    for (int i = 0; i < 2 * GN_COST_COUNT; i++) {
        double *value = i < GN_COST_COUNT ? &way->us[i] : &way->bytes[i - GN_COST_COUNT];

        if (i)
            gni_scan_expect(s, ",");
        at = s->token.at;
        *value = gni_scan_number(s);
        if (*value < 0.0)
            gni_scan_fail(s, at, "a cost is not negative (%g)", *value);
    }
}

gn_result gn_knowledge_read(gn_context *context, const char *text, size_t length, gn_knowledge *out)
{
    gn_knowledge read;
    gni_scan s;

    if (!context || !text || !out)
        return gn_fail(context, GN_E_ARG, "gn_knowledge_read: NULL argument");
    memset(&read, 0, sizeof read);
    gni_scan_start(&s, context, "knowledge", text, length);
    for (int i = 0; i < COLUMNS; i++) {
        if (i)
            gni_scan_expect(&s, ",");
        gni_scan_expect(&s, columns[i]);
    }
    while (s.result == GN_OK && s.token.kind != GNI_TEXT_END)
        read_row(&s, &read);
    if (s.result == GN_OK)
        *out = read;
    return s.result;
}
