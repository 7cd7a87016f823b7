/* capability.c - capabilities by name. */
#include "gnomon.h"

#include <string.h>

static const struct {
    const char *name, *summary;
} capabilities[] = {
#define ROW(constant, name, summary) {name, summary},
    GN_CAPABILITIES(ROW)
#undef ROW
};

const char *gn_capability_name(gn_capability c)
{
    return (unsigned)c < GN_CAPABILITY_COUNT ? capabilities[c].name : "";
}

const char *gn_capability_summary(gn_capability c)
{
    return (unsigned)c < GN_CAPABILITY_COUNT ? capabilities[c].summary : "";
}

const char *gn_capability_parse(const char *names, uint32_t *set)
{
    uint32_t found = 0;

    while (names && *names) {
        const size_t length = strcspn(names, ",");
        int c = 0;

        while (c < GN_CAPABILITY_COUNT &&
               (strlen(capabilities[c].name) != length || strncmp(capabilities[c].name, names, length) != 0))
            c++;
        if (c == GN_CAPABILITY_COUNT)
            return names;
        found |= 1u << c;
        names += length;
        if (*names == ',' && *++names == '\0') /* nothing after the last comma */
            return names - 1;
    }
    *set |= found;
    return NULL;
}

int gn_target_can(const gn_target *target, gn_capability capability)
{
    return (target->proven & ~target->hidden) >> capability & 1;
}
