/* capability.c - capabilities by name. */
#include "gni_features.h"

#include <string.h>

#define NAME(constant, name, summary)    name "\0"
#define SUMMARY(constant, name, summary) GNI_SENTENCE(summary) "\0"
static const char names[] = GN_CAPABILITIES(NAME), summaries[] = GN_CAPABILITIES(SUMMARY);
#undef NAME
#undef SUMMARY

static const char *text_of(const char *texts, gn_capability c)
{
    if ((unsigned)c >= GN_CAPABILITY_COUNT)
        return "";
    for (unsigned i = 0; i < (unsigned)c; i++)
        texts += strlen(texts) + 1;
    return texts;
}

const char *gn_capability_name(gn_capability c)
{
    return text_of(names, c);
}

const char *gn_capability_summary(gn_capability c)
{
    return text_of(summaries, c);
}

const char *gn_capability_parse(const char *list, uint32_t *set)
{
    uint32_t found = 0;

    while (list && *list) {
        const size_t length = strcspn(list, ",");
        int c = 0;

        for (const char *name = names; c < GN_CAPABILITY_COUNT; name += strlen(name) + 1, c++)
            if (strlen(name) == length && strncmp(name, list, length) == 0)
                break;
        if (c == GN_CAPABILITY_COUNT)
            return list;
        found |= 1u << c;
        list += length;
        if (*list == ',' && *++list == '\0') /* nothing after the last comma */
            return list - 1;
    }
    *set |= found;
    return NULL;
}

int gn_target_can(const gn_target *target, gn_capability capability)
{
    return (target->proven & ~target->hidden) >> capability & 1;
}
