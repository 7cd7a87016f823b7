/* small_program.h - a program of two GLSL ES 1.00 texts without variants. */
#ifndef SMALL_PROGRAM_H
#define SMALL_PROGRAM_H
#include "gn_gl.h"

/* attributes: by location, ending with NULL. 0 having said why. */
GLuint small_program(const gn_gl *gl, const char *vertex, const char *fragment, const char *const *attributes);
#endif
