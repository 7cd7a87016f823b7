/* configs.c - see configs.h. */
#include "configs.h"

#include <stdlib.h>
#include <string.h>

#include "command.h"

static const char *const upsample_names[] = {"nearest", "bilinear", "depth"};

/* The word of a list at *at, which moves on; 0 at its end. */
static int next_word(const char **at, char *word, size_t size)
{
    size_t length;

    if (!*at)
        return 0;
    length = strcspn(*at, ",");
    snprintf(word, size, "%.*s", (int)length, *at);
    *at = (*at)[length] ? *at + length + 1 : NULL;
    return 1;
}

int parse_numbers(const char *option, const char *list, long low, long high, long *out, int most)
{
    char word[32];
    int count = 0;

    for (const char *at = list; next_word(&at, word, sizeof word);) {
        char *end;
        const long value = strtol(word, &end, 10);

        if (end == word || *end || value < low || value > high) {
            say("%s: takes whole numbers from %ld to %ld with commas between (%s)", option, low, high, word);
            return 0;
        }
        if (count == most) {
            say("%s: takes at most %d numbers (%s)", option, most, list);
            return 0;
        }
        out[count++] = value;
    }
    return count;
}

static int add(config_list *list, gn_method method, int one_sided, uint32_t scale, int upsample)
{
    config *c = &list->of[list->count];
    const char *const name = gn_method_describe(method)->name, *const sided = one_sided ? "/one-sided" : "";

    if (list->count == MOST_CONFIGS) {
        say("measure: more than %d configurations", MOST_CONFIGS);
        return 0;
    }
    list->count++;
    c->method = method;
    c->one_sided = one_sided;
    c->scale = scale;
    c->upsample = (gn_upsample)upsample;
    if (scale == 1)
        snprintf(c->name, sizeof c->name, "%s%s", name, sided);
    else if (method == GN_METHOD_REFINE)
        snprintf(c->name, sizeof c->name, "%s%s@1/%u", name, sided, (unsigned)scale);
    else
        snprintf(c->name, sizeof c->name, "%s%s@1/%u-%s", name, sided, (unsigned)scale, upsample_names[upsample]);
    return 1;
}

static int add_method(config_list *list, gn_method method, int one_sided, const long *scales, int scale_count,
                      const int *upsamples, int upsample_count)
{
    for (int i = 0; i < scale_count; i++) {
        const int refines = method == GN_METHOD_REFINE;

        if (refines && scales[i] == 1)
            continue;
        for (int u = 0; u < (scales[i] == 1 || refines ? 1 : upsample_count); u++)
            if (!add(list, method, one_sided, (uint32_t)scales[i], upsamples[u]))
                return 0;
    }
    return 1;
}

static int parse_upsamples(const char *list, int *out)
{
    char word[32];
    int count = 0;

    for (const char *at = list; next_word(&at, word, sizeof word);) {
        int found = -1;

        for (int i = 0; i < 3; i++)
            found = strcmp(word, upsample_names[i]) == 0 ? i : found;
        if (found < 0 || count == 3) {
            say("--upsample: takes nearest, bilinear and depth with commas between (%s)", word);
            return 0;
        }
        out[count++] = found;
    }
    return count;
}

int list_configs(const char *methods, const char *scales, const char *upsamples, config_list *out)
{
    long scale[3];
    int upsample[3], scale_count, upsample_count;
    char word[32];

    out->count = 0;
    scale_count = parse_numbers("--scales", scales, 1, 4, scale, 3);
    upsample_count = parse_upsamples(upsamples, upsample);
    for (int i = 0; i < scale_count; i++)
        if (scale[i] == 3) {
            say("--scales: takes 1, 2 and 4 (3)");
            return 0;
        }
    if (scale_count == 0 || upsample_count == 0)
        return 0;
    for (const char *at = methods; next_word(&at, word, sizeof word);) {
        int one_sided, ok = 1;
        const gn_method method = gn_method_by_name(word, &one_sided);

        if (strcmp(word, "all") == 0)
            for (int m = GN_METHOD_AUTO + 1; m < GN_METHOD_TOTAL && ok; m++)
                ok = add_method(out, (gn_method)m, 0, scale, scale_count, upsample, upsample_count);
        else if (method == GN_METHOD_TOTAL)
            ok = (say("--methods: no method has that name: see `gnomon methods` (%s)", word), 0);
        else
            ok = add_method(out, method, one_sided, scale, scale_count, upsample, upsample_count);
        if (!ok)
            return 0;
    }
    return out->count > 0;
}
