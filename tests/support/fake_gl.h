/* fake_gl.h - a GL that draws nothing and remembers the names of the calls, in order. One at a time in a process. */
#ifndef FAKE_GL_H
#define FAKE_GL_H
#include "gn_gl.h"

#include <stddef.h>

/* Forgets all calls. */
void fake_gl_reset(void);

/* For gn_gles_create(): user is not read. */
gn_proc fake_gl_get_proc(void *user, const char *name);

/* How often a function was called since the reset; the n-th call of all (NULL past the end). */
size_t fake_gl_calls(const char *name);
const char *fake_gl_call(size_t n);

/* What it does badly: a function that is not found; shaders that do not compile; every glGetError says out of
 * memory. */
extern const char *fake_gl_missing;
extern int fake_gl_refuses_shaders, fake_gl_out_of_memory;
/* Names that are generated and not deleted. */
extern long fake_gl_live_names;
/* What the last glDrawElements was given, and the last glClearDepthf. */
extern long fake_gl_last_count;
extern float fake_gl_clear_depth;
#endif
