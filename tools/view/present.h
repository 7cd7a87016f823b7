/* present.h - frames of the stage, kept as textures, and shown as a screen takes them: encoded, side by side, and with what differs from the truth. */
#ifndef PRESENT_H
#define PRESENT_H
#include "gn_gl.h"

#include <stdint.h>

typedef struct present {
    const gn_gl *gl;
    GLuint program, buffer, textures[3]; /* left, right, marks */
    GLint u_textures[3], u_split, u_marked;
    uint32_t width, height;
} present;

/* 1, or 0 having said why. */
int present_open(present *p, const gn_gl *gl);
void present_close(present *p); /* a zeroed one does nothing */

/* Keeps the frame that was just drawn: side 0 left, 1 right. */
void present_keep(present *p, int side, uint32_t width, uint32_t height);
/* Colours over the frame [height][width][4] RGBA, row 0 on top. */
void present_mark(present *p, const uint8_t *rgba, uint32_t width, uint32_t height);
/* Draws what was kept. split: where left ends, from 0 to 1. */
void present_draw(const present *p, double split, int is_marked);
#endif
