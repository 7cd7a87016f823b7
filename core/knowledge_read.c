/* knowledge_read.c - reads what `gnomon calibrate` measured, a CSV. */
#include "gni_select.h"
#include "scan.h"

#include <string.h>

static const char *const columns[] = {"method",         "scale",        "upsample",    "accuracy",
                                      "us_setup",       "us_index",     "us_fragment", "us_border",
                                      "us_pixel",       "us_switch",    "bytes_setup", "bytes_index",
                                      "bytes_fragment", "bytes_border", "bytes_pixel", "bytes_switch"};
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
    while (v < GN_VARIANT_COUNT && (gn_variant_scale(v) != scale ||
                                    (gn_variant_upsample(v) == GN_UPSAMPLE_DEPTH) != (strcmp(upsample, "depth") == 0)))
        v++;
    if (s->result == GN_OK && (m == GN_METHOD_TOTAL || v == GN_VARIANT_COUNT || !gni_way_exists(m, v)))
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
