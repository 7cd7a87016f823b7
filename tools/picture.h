/* picture.h - what a frame on the stage looks like, and what time it is. */
#ifndef PICTURE_H
#define PICTURE_H
#include "stage.h"

double now_ms(void);

/* The frame just drawn, sRGB-encoded: [height][width][3], row 0 on top. 1, or 0 where it cannot be read back. */
int read_picture(const stage *s, uint8_t *rgb);
/* The same as it is drawn, linear; and such levels encoded, in place. */
int read_levels(const stage *s, uint8_t *rgb);
void encode_picture(uint8_t *rgb, size_t pixels);
/* A mask just drawn by stage_draw_mask(): [height][width] each, 255 lit or shadowed 0, and 255 where a surface is. */
int read_mask(const stage *s, uint8_t *lit, uint8_t *visible);
#endif
