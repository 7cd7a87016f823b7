/* between.h - functions of a test's own between the library and a real GL: they watch, or lie, and pass on. */
#ifndef BETWEEN_H
#define BETWEEN_H
#include "gn_gl.h"

#include <stddef.h>

typedef struct between {
    const char *name;
    gn_proc function;
} between;

/* The real functions, as they were looked up. */
extern gn_gl between_real;

/* For stage_options.replace: keeps the real function, and returns the list's own of that name, or the real one. */
gn_proc between_take(const char *name, gn_proc found, const between *list, size_t count);
#endif
