/* picture.c - see picture.h. */
#include "picture.h"

#include <math.h>
#include <stdlib.h>

double now_ms(void)
{
    static const double per_ms = 1000.0;
    const gn_port port = gn_port_libc();

    return (double)port.now_us(NULL) / per_ms;
}

/* A linear value of 0 to 255 as sRGB. */
static void make_srgb_table(uint8_t table[256])
{
    for (int i = 0; i < 256; i++) {
        const double x = i / 255.0, y = x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1.0 / 2.4) - 0.055;

        table[i] = (uint8_t)lrint(255.0 * y);
    }
}

static uint8_t *read_back(const stage *s)
{
    uint8_t *rgba = malloc((size_t)4 * s->target.width * s->target.height);

    if (rgba && platform_read_back(s->platform, rgba))
        return rgba;
    free(rgba);
    return NULL;
}

int read_levels(const stage *s, uint8_t *rgb)
{
    const size_t pixels = (size_t)s->target.width * s->target.height;
    uint8_t *rgba = read_back(s);

    for (size_t i = 0; rgba && i < pixels; i++)
        for (size_t c = 0; c < 3; c++)
            rgb[3 * i + c] = rgba[4 * i + c];
    free(rgba);
    return rgba != NULL;
}

void encode_picture(uint8_t *rgb, size_t pixels)
{
    uint8_t table[256];

    make_srgb_table(table);
    for (size_t i = 0; i < 3 * pixels; i++)
        rgb[i] = table[rgb[i]];
}

int read_picture(const stage *s, uint8_t *rgb)
{
    if (!read_levels(s, rgb))
        return 0;
    encode_picture(rgb, (size_t)s->target.width * s->target.height);
    return 1;
}

int read_mask(const stage *s, uint8_t *lit, uint8_t *visible)
{
    const size_t pixels = (size_t)s->target.width * s->target.height;
    uint8_t *rgba = read_back(s);

    for (size_t i = 0; rgba && i < pixels; i++) {
        lit[i] = rgba[4 * i] > 127 ? 255 : 0;
        visible[i] = rgba[4 * i + 1] > 127 ? 255 : 0;
    }
    free(rgba);
    return rgba != NULL;
}
