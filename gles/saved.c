/* saved.c - what was proven, as a small text: given back on the next start it spares the proofs. It begins with what it
 * is true of, the driver's own strings and the target's bits, and is of no use for anything else. */
#include "gni_gles.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define HEAD  1024
#define SMALL 16 /* pixels: what is smaller is proven in another way (proofs/proofs.c) */

static const char *text_of(const gn_gles *g, GLenum name)
{
    const GLubyte *const text = g->gl.glGetString(name);

    return text ? (const char *)text : "";
}

/* What the text is true of. 0 when the driver's strings are too long. */
static int head_of(const gn_gles *g, const gn_target *t, char head[HEAD])
{
    GLint bound = 0;
    int length;

    g->gl.glGetIntegerv(GL_FRAMEBUFFER_BINDING, &bound);
    length = snprintf(head, HEAD,
                      "gnomon %s\n%s\n%s\n%s\n"
                      "bits %d %d %d %d depth %d stencil %d samples %d object %d small %d hidden %lx\n",
                      gn_version(), text_of(g, GL_VENDOR), text_of(g, GL_RENDERER), text_of(g, GL_VERSION), t->red_bits,
                      t->green_bits, t->blue_bits, t->alpha_bits, t->depth_bits, t->stencil_bits, t->samples,
                      bound != 0, t->width < SMALL || t->height < SMALL, (unsigned long)t->hidden);
    return length > 0 && length < HEAD;
}

#if GNI_HAS_PROOFS
typedef struct writer {
    char *text;
    size_t capacity, length;
} writer;

static void put(writer *w, const char *text)
{
    for (; *text; text++, w->length++)
        if (w->length + 1 < w->capacity)
            w->text[w->length] = *text;
}

size_t gn_gles_save_target(const gn_gles *g, const gn_target *t, char *text, size_t capacity)
{
    writer w = {text, capacity, 0};
    char head[HEAD], number[48];

    if (g && t && !g->forgotten && head_of(g, t, head)) {
        put(&w, head);
        snprintf(number, sizeof number, "mediump %d\n", t->mediump_bits);
        put(&w, number);
        for (int c = 0; c < GN_CAPABILITY_COUNT; c++) {
            if (!((t->advertised & ~t->hidden) >> c & 1))
                continue;
            put(&w, gn_capability_name((gn_capability)c));
            put(&w, t->proven >> c & 1 ? ": proven" : ": failed, ");
            put(&w, t->proven >> c & 1 ? "" : g->symptoms[c]);
            put(&w, "\n");
        }
    }
    if (capacity > 0)
        text[w.length < capacity ? w.length : capacity - 1] = '\0';
    return w.length;
}
#endif

/* The line "NAME: " of a text, and what follows in it. */
static const char *line_of(const char *text, const char *name)
{
    const size_t length = strlen(name);

    while (text) {
        if (strncmp(text, name, length) == 0 && strncmp(text + length, ": ", 2) == 0)
            return text + length + 2;
        text = strchr(text, '\n');
        text = text ? text + 1 : NULL;
    }
    return NULL;
}

int gni_read_saved(gn_gles *g, const char *saved, gn_target *t)
{
    static const char mediump[] = "mediump ", proven[] = "proven\n", failing[] = "failed, ";
    const uint32_t offered = t->advertised & ~t->hidden;
    uint32_t found = 0;
    char head[HEAD];
    long bits;

    if (!saved || !head_of(g, t, head) || strncmp(saved, head, strlen(head)) != 0)
        return 0;
    saved += strlen(head);
    if (strncmp(saved, mediump, sizeof mediump - 1) != 0)
        return 0;
    bits = strtol(saved + sizeof mediump - 1, NULL, 10);
    for (int pass = 0; pass < 2; pass++) /* nothing changes before all of it has been understood */
        for (int c = 0; c < GN_CAPABILITY_COUNT; c++) {
            const char *const line = line_of(saved, gn_capability_name((gn_capability)c));

            if (!(offered >> c & 1))
                continue;
            if (line && strncmp(line, proven, sizeof proven - 1) == 0)
                found |= 1u << c;
            else if (!line || strncmp(line, failing, sizeof failing - 1) != 0 || !strchr(line, '\n'))
                return 0;
            else if (GNI_HAS_MESSAGES && pass == 1)
                snprintf(g->symptoms[c], GNI_SYMPTOM, "%.*s", (int)strcspn(line + sizeof failing - 1, "\n"),
                         line + sizeof failing - 1);
        }
    t->proven = found;
    t->mediump_bits = bits > 0 && bits <= 24 ? (int)bits : 0;
    return 1;
}
