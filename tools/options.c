/* options.c - see options.h. Every complaint names the option and what was given. */
#include "options.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "command.h"
#include "gn_capability.h"

static int parse_number(const option *o, const char *text, double *number)
{
    char *end;

    errno = 0;
    *number = strtod(text, &end);
    if (end == text || *end != '\0' || errno == ERANGE || !(*number >= o->low && *number <= o->high)) {
        say("%s: takes a number from %g to %g (%s)", o->name, o->low, o->high, text);
        return 0;
    }
    return 1;
}

static int parse_size(const option *o, const char *text)
{
    long *size = o->value;
    char *end;

    size[0] = strtol(text, &end, 10);
    if (end != text && (*end == 'x' || *end == 'X') && end[1] >= '0' && end[1] <= '9') {
        size[1] = strtol(end + 1, &end, 10);
        if (*end == '\0' && (double)size[0] >= o->low && (double)size[0] <= o->high && (double)size[1] >= o->low &&
            (double)size[1] <= o->high)
            return 1;
    }
    say("%s: takes WIDTHxHEIGHT, each from %g to %g (%s)", o->name, o->low, o->high, text);
    return 0;
}

static int take(const option *o, const char *text)
{
    double number;

    switch (o->kind) {
    case OPTION_TEXT:
        *(const char **)o->value = text;
        return 1;
    case OPTION_SIZE:
        return parse_size(o, text);
    case OPTION_LIST: {
        text_list *list = o->value;

        if (list->count == TEXT_LIST_MOST) {
            say("%s: is given more than %d times (%s)", o->name, TEXT_LIST_MOST, text);
            return 0;
        }
        list->of[list->count++] = text;
        return 1;
    }
    case OPTION_WHOLE:
        if (!parse_number(o, text, &number))
            return 0;
        if (number != floor(number)) {
            say("%s: takes a whole number (%s)", o->name, text);
            return 0;
        }
        *(long *)o->value = (long)number;
        return 1;
    case OPTION_NUMBER:
        return parse_number(o, text, o->value);
    case OPTION_FLAG:
        break;
    }
    return 0;
}

static const option *find(const char *argument, const option *options, int count, const char **attached)
{
    const char *const equals = strncmp(argument, "--", 2) == 0 ? strchr(argument, '=') : NULL;
    const size_t length = equals ? (size_t)(equals - argument) : strlen(argument);

    *attached = equals ? equals + 1 : NULL;
    for (int i = 0; i < count; i++)
        if (strlen(options[i].name) == length && strncmp(options[i].name, argument, length) == 0)
            return &options[i];
    return NULL;
}

int parse_options(int count, char **arguments, const option *options, int option_count)
{
    int kept = 0, ended = 0;

    for (int i = 0; i < count; i++) {
        const char *attached;
        const option *o;

        if (ended || arguments[i][0] != '-' || arguments[i][1] == '\0') {
            arguments[kept++] = arguments[i];
            continue;
        }
        if (strcmp(arguments[i], "--") == 0) {
            ended = 1;
            continue;
        }
        o = find(arguments[i], options, option_count, &attached);
        if (!o) {
            say("unknown option: see --help (%s)", arguments[i]);
            return -1;
        }
        if (o->kind == OPTION_FLAG) {
            if (attached) {
                say("%s: takes no value (%s)", o->name, attached);
                return -1;
            }
            *(int *)o->value = 1;
            continue;
        }
        if (!attached && i + 1 == count) {
            say("%s: a value is missing", o->name);
            return -1;
        }
        if (!take(o, attached ? attached : arguments[++i]))
            return -1;
    }
    return kept;
}

int check_hidden(const char *from, const char *names)
{
    uint32_t set = 0;
    const char *const unknown = gn_capability_parse(names, &set);

    if (unknown)
        say("%s: no capability has that name: see `gnomon probe` (%s)", from, unknown);
    return !unknown;
}

int check_small(long scale, const char *name, gn_upsample *upsample)
{
    static const char *const names[] = {"nearest", "bilinear", "depth"};

    if (scale != 1 && scale != 2 && scale != 4) {
        say("--scale: takes 1, 2 or 4 (%ld)", scale);
        return 0;
    }
    for (int i = 0; i < 3; i++)
        if (strcmp(name, names[i]) == 0) {
            *upsample = (gn_upsample)i;
            return 1;
        }
    say("--upsample: takes nearest, bilinear or depth (%s)", name);
    return 0;
}
