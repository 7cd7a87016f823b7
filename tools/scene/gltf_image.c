/* gltf_image.c - PNG images, as eight-bit RGBA with sides that are powers of two.
 *
 * The plain interface of libpng and not the simplified one: glTF says how texels are encoded whatever the file's gAMA,
 * sRGB or iCCP chunks say, and the simplified interface obeys them (it takes sixteen-bit samples for linear, for one).
 *
 * OpenGL ES 2.0 repeats and mipmaps only powers of two (OpenGL ES 2.0.25, 3.8.2), so other sizes are resampled upwards,
 * by the same sampling that the texture itself asks for. Whoever asks for alpha later samples the same texels. */
#include "gltf.h"

#include <png.h>
#include <setjmp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct decoder {
    const uint8_t *bytes;
    size_t size, at;
    char message[80];
    png_structp png;
    png_infop info;
    uint8_t *rgba;
    uint32_t width, height;
} decoder;

static void on_error(png_structp png, png_const_charp text)
{
    decoder *d = png_get_error_ptr(png);

    snprintf(d->message, sizeof d->message, "%s", text);
    png_longjmp(png, 1);
}

static void on_warning(png_structp png, png_const_charp text)
{
    (void)png;
    (void)text;
}

static void on_read(png_structp png, png_bytep out, png_size_t count)
{
    decoder *d = png_get_io_ptr(png);

    if (count > d->size - d->at)
        png_error(png, "the file is cut short");
    memcpy(out, d->bytes + d->at, count);
    d->at += count;
}

/* Nothing of what changes after setjmp() is read after longjmp(), but for what is behind the pointer. */
static int decode_rows(decoder *d)
{
    int passes;

    if (setjmp(png_jmpbuf(d->png)))
        return 0;
    png_set_read_fn(d->png, d, on_read);
    png_set_user_limits(d->png, GLTF_TEXTURE_MAX, GLTF_TEXTURE_MAX);
    png_set_chunk_malloc_max(d->png, 1u << 24);
    png_read_info(d->png, d->info);
    png_set_expand(d->png);
    png_set_scale_16(d->png);
    png_set_gray_to_rgb(d->png);
    png_set_add_alpha(d->png, 0xff, PNG_FILLER_AFTER);
    passes = png_set_interlace_handling(d->png);
    png_read_update_info(d->png, d->info);
    if (png_get_image_width(d->png, d->info) != d->width || png_get_image_height(d->png, d->info) != d->height ||
        png_get_rowbytes(d->png, d->info) != (size_t)d->width * 4)
        png_error(d->png, "rows of an unexpected size");
    while (passes-- > 0)
        for (uint32_t y = 0; y < d->height; y++)
            png_read_row(d->png, d->rgba + (size_t)y * d->width * 4, NULL);
    png_read_end(d->png, NULL);
    return 1;
}

static int decode(gltf *g, const char *where, decoder *d)
{
    int ok = 0;

    d->png = png_create_read_struct(PNG_LIBPNG_VER_STRING, d, on_error, on_warning);
    d->info = d->png ? png_create_info_struct(d->png) : NULL;
    if (!d->info)
        gltf_fail_memory(g, sizeof *d);
    else if (decode_rows(d))
        ok = 1;
    else
        gltf_fail(g, "%s: PNG: %s", where, d->message);
    png_destroy_read_struct(&d->png, &d->info, NULL);
    return ok;
}

static uint32_t next_power(uint32_t n)
{
    uint32_t power = 1;

    while (power < n)
        power *= 2;
    return power;
}

/* Replaces the texels by those of a picture whose sides are powers of two. */
static int resample(gltf *g, scene_texture *t)
{
    const uint32_t width = next_power(t->width), height = next_power(t->height);
    uint8_t *rgba, *texel;

    if (width == t->width && height == t->height)
        return 1;
    rgba = texel = gltf_alloc(g, (size_t)width * height, 4);
    if (!rgba)
        return 0;
    for (uint32_t y = 0; y < height; y++)
        for (uint32_t x = 0; x < width; x++) {
            const double uv[2] = {(x + 0.5) / width, (y + 0.5) / height};
            double value[4];

            scene_sample_texture(t, uv, value);
            for (int c = 0; c < 4; c++)
                *texel++ = (uint8_t)(value[c] + 0.5);
        }
    free(t->rgba);
    t->rgba = rgba;
    t->width = width;
    t->height = height;
    return 1;
}

static uint32_t big_endian(const uint8_t *bytes)
{
    return (uint32_t)bytes[0] << 24 | (uint32_t)bytes[1] << 16 | (uint32_t)bytes[2] << 8 | (uint32_t)bytes[3];
}

/* The signature, then IHDR with width and height: looked at before libpng is, so that the messages have numbers. */
static int read_size(gltf *g, const char *where, decoder *d)
{
    size_t texels;

    if (d->size < 24 || memcmp(d->bytes + 12, "IHDR", 4) != 0)
        return gltf_fail(g, "%s: PNG: no header in its %lu bytes", where, (unsigned long)d->size);
    d->width = big_endian(d->bytes + 16);
    d->height = big_endian(d->bytes + 20);
    if (d->width < 1 || d->width > GLTF_TEXTURE_MAX || d->height < 1 || d->height > GLTF_TEXTURE_MAX)
        return gltf_fail(g, "%s: %lu x %lu texels, the limit is %lu", where, (unsigned long)d->width,
                         (unsigned long)d->height, (unsigned long)GLTF_TEXTURE_MAX);
    texels = (size_t)next_power(d->width) * next_power(d->height);
    if (texels > GLTF_TEXELS_MAX - g->texels)
        return gltf_fail(g, "%s: its %lu texels go past the limit of %lu in all", where, (unsigned long)texels,
                         (unsigned long)GLTF_TEXELS_MAX);
    g->texels += texels;
    return 1;
}

static int decode_image(gltf *g, int image, const uint8_t *bytes, size_t size, scene_texture *out)
{
    const cJSON *json = g->lists[GLTF_IMAGE].items[image];
    const char *name = gltf_get_string(json, "name"), *uri = gltf_get_string(json, "uri");
    char where[GLTF_WHERE];
    decoder d = {0};

    if (!name)
        name = uri && strncmp(uri, "data:", 5) != 0 ? uri : "no name";
    snprintf(where, sizeof where, "image %d", image);
    if (size < 8 || png_sig_cmp(bytes, 0, 8) != 0) {
        gltf_warn(g, "%s (%.60s) is not a PNG: its materials use their factor alone", where, name);
        return 1;
    }
    d.bytes = bytes;
    d.size = size;
    if (!read_size(g, where, &d))
        return 0;
    d.rgba = gltf_alloc(g, (size_t)d.width * d.height, 4);
    if (!d.rgba)
        return 0;
    out->rgba = d.rgba;
    out->width = d.width;
    out->height = d.height;
    if (decode(g, where, &d) && resample(g, out))
        return 1;
    free(out->rgba);
    out->rgba = NULL;
    return 0;
}

int gltf_read_image(gltf *g, int image, scene_texture *out)
{
    const cJSON *json = g->lists[GLTF_IMAGE].items[image];
    const char *uri = gltf_get_string(json, "uri");
    gltf_bytes file = {NULL, 0};
    const uint8_t *bytes;
    size_t size, stride;
    int view = SCENE_NONE, ok;
    char where[GLTF_WHERE];

    out->rgba = NULL;
    snprintf(where, sizeof where, "image %d", image);
    if (!gltf_get_index(g, where, json, "bufferView", GLTF_VIEW, &view))
        return 0;
    if (view != SCENE_NONE)
        return gltf_view_bytes(g, view, &bytes, &size, &stride) && decode_image(g, image, bytes, size, out);
    if (!uri)
        return gltf_fail(g, "%s: it has neither a uri nor a buffer view", where);
    if (!gltf_read_uri(g, where, uri, &file))
        return 0;
    ok = decode_image(g, image, file.data, file.size, out);
    free(file.data);
    return ok;
}
