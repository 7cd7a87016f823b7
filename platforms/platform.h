/* platform.h - where an OpenGL ES 2.0 context comes from. Knows no shadows; nothing but the tools and tests knows it.
 *
 * A platform opens its libraries at run time, so one binary serves whatever is installed. One context with one
 * surface each. Errors are sentences "what: why" in a buffer of PLATFORM_MESSAGE bytes. */
#ifndef PLATFORM_H
#define PLATFORM_H
#include <stdint.h>

#define PLATFORM_MESSAGE 512

typedef struct platform platform;

typedef struct platform_desc {
    uint32_t width, height;
    int red_bits, green_bits, blue_bits, alpha_bits, depth_bits, stencil_bits; /* wanted: at least these */
} platform_desc;

/* What one kind of platform can do: a row of the table in platform.c. */
typedef struct platform_kind {
    const char *name;
    platform *(*create)(const platform_desc *desc, char message[PLATFORM_MESSAGE]); /* also makes it current */
    int (*make_current)(platform *p);                                               /* 1, or 0 */
    void (*(*get_proc)(platform *p, const char *name))(void);
    int (*lost)(platform *p); /* 1: the context is gone for good; destroy it and open another */
    void (*destroy)(platform *p);
} platform_kind;

/* Every kind's struct starts with this. */
struct platform {
    const platform_kind *kind;
    platform_desc actual; /* the surface's real bits */
    const char *detail;   /* which of the kind's ways it took, say "surfaceless" */
};

/* The kinds, in the order in which they are tried; ends with NULL. */
extern const platform_kind *const platform_kinds[];

/* Opens the kind of that name, or with NULL the first that works. On failure NULL, with each kind's own reason in
 * message. The C library is told to keep what is freed: Mesa's rasterisers take megabytes for each frame, and a system
 * that gets them back brings every page anew. */
platform *platform_open(const char *name, const platform_desc *desc, char message[PLATFORM_MESSAGE]);

/* In the form that gn_gles_create() takes; user is the platform. */
void (*platform_get_proc(void *user, const char *name))(void);

/* Waits for the drawing to end and copies the surface: [height][width][4] RGBA, row 0 on top. 1, or 0 when the GL
 * refuses. */
int platform_read_back(platform *p, uint8_t *rgba);

void platform_close(platform *p); /* NULL does nothing */

/* platforms/library.c: the first library of the names (ending with NULL) that opens, and a symbol of it; else NULL. */
void *platform_library(const char *const *names);
void (*platform_symbol(void *library, const char *name))(void);
void platform_release(void *library);
#endif
