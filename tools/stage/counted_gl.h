/* counted_gl.h - a platform's GL with a counter before the calls that cost: what a frame sends and draws. */
#ifndef COUNTED_GL_H
#define COUNTED_GL_H
#include "gn_gl.h"

#include <stdint.h>

typedef struct gl_counts {
    uint64_t draws, vertices, indices; /* vertices: named by draws, by index or in order */
    uint64_t bytes_sent;               /* into buffers, textures and uniforms */
    uint64_t state_changes;            /* calls that set state, bind, or use a program */
} gl_counts;

/* Counts what goes through the functions that counted_get_proc() finds; one GL at a time in a process. */
/* replace: a function to take instead of the real one, or the real one; or NULL. */
void counted_gl_wrap(gn_get_proc get_proc, void *user, gn_proc (*replace)(const char *name, gn_proc real));
gn_proc counted_get_proc(void *user, const char *name); /* user is not read */
gl_counts counted_gl_read(void);
#endif
