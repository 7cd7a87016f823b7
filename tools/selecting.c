/* selecting.c - see selecting.h. */
#include "selecting.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "command.h"

/* All of a file; NULL having said why. */
static char *read_file(const char *path, size_t *length)
{
    enum { MOST = 1 << 20 };
    FILE *f = fopen(path, "rb");
    char *text = f ? malloc(MOST) : NULL;

    if (!f || !text) {
        say("%s: cannot be read: %s", path, f ? "no memory" : strerror(errno));
    } else {
        *length = fread(text, 1, MOST, f);
        if (ferror(f) || *length == MOST) {
            say("%s: cannot be read: %s", path, ferror(f) ? strerror(errno) : "it is larger than a megabyte");
            free(text);
            text = NULL;
        }
    }
    if (f)
        fclose(f);
    return text;
}

static int load_knowledge(const char *path, gn_context *context, gn_knowledge *out)
{
    size_t length;
    char *text;
    int ok;

    if (!path) {
        gn_knowledge_default(out);
        return 1;
    }
    text = read_file(path, &length);
    ok = text && gn_knowledge_read(context, text, length, out) == GN_OK;
    if (text && !ok)
        say("%s: %s", path, gn_message(context));
    free(text);
    return ok;
}

/* A file that cannot be read as rules, or asks for facts that there are not, is found out here, with its name. */
static int load_rules(const char *path, gn_context *context, gn_rules **out)
{
    size_t length;
    char *text = path ? read_file(path, &length) : NULL;
    gn_selector *trial = NULL;
    int ok;

    if (path && !text)
        return 0;
    ok = path ? gn_rules_create(context, text, length, out) == GN_OK &&
                    gn_selector_create(context, NULL, *out, &trial) == GN_OK
              : gn_rules_default(context, out) == GN_OK;
    if (!ok)
        say("%s: %s", path ? path : "rules", gn_message(context));
    gn_selector_destroy(trial);
    free(text);
    return ok;
}

int selecting_load(const selecting *given, gn_context *context, selecting_files *out)
{
    const gn_accuracy quality = given->quality ? gn_accuracy_by_name(given->quality) : GN_ACCURACY_NONE;

    memset(out, 0, sizeof *out);
    if (quality == GN_ACCURACY_COUNT) {
        say("--quality: takes none, rough, fair, fine or exact (%s)", given->quality);
        return EXIT_USAGE;
    }
    out->budget.quality = quality;
    out->budget.frame_ms = given->budget_ms;
    out->budget.energy_mw = given->budget_mw;
    out->budget.memory = given->budget_mb * 1e6;
    if (load_knowledge(given->knowledge, context, &out->knowledge) && load_rules(given->rules, context, &out->rules))
        return EXIT_DONE;
    selecting_free(out);
    return EXIT_FAILED;
}

void selecting_free(selecting_files *files)
{
    gn_rules_destroy(files->rules);
    files->rules = NULL;
}
