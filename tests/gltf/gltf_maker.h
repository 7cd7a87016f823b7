/* gltf_maker.h - tiny glTF documents written into a temporary folder, for the tests of the reader.
 *
 * JSON is written with ' for ", to stay readable in C; the bytes that its buffers need are put one after the other into
 * `bytes`, which is empty at each test's start, and written beside it as data.bin. */
#ifndef GLTF_MAKER_H
#define GLTF_MAKER_H
#include "scene.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>
#include <png.h>

#define NEAR_ENOUGH  1e-6
#define COUNT(array) (sizeof(array) / sizeof(array)[0])

static char folder[512];

static struct {
    uint8_t data[8192];
    size_t size;
} bytes;

static char warnings[4096];
static int warning_count;

/* --- writing documents --- */

static inline void put_bytes(const void *data, size_t size)
{
    assert_true(size <= sizeof bytes.data - bytes.size);
    memcpy(bytes.data + bytes.size, data, size);
    bytes.size += size;
}

static inline void put_unsigned(uint32_t value, size_t size)
{
    for (size_t i = 0; i < size; i++) {
        const uint8_t byte = (uint8_t)(value >> 8 * i);

        put_bytes(&byte, 1);
    }
}

static inline void put_integers(size_t size, const long *values, size_t count)
{
    for (size_t i = 0; i < count; i++)
        put_unsigned((uint32_t)values[i], size);
}

static inline void put_floats(const float *values, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        uint32_t bits;

        memcpy(&bits, &values[i], sizeof bits);
        put_unsigned(bits, 4);
    }
}

#define FLOATS(...) put_floats((const float[]){__VA_ARGS__}, sizeof((const float[]){__VA_ARGS__}) / sizeof(float))
#define INTEGERS(size, ...)                                                                                            \
    put_integers(size, (const long[]){__VA_ARGS__}, sizeof((const long[]){__VA_ARGS__}) / sizeof(long))

static inline const char *path_of(const char *name)
{
    static char path[1024];

    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

static inline void write_file(const char *name, const void *data, size_t size)
{
    FILE *file = fopen(path_of(name), "wb");

    assert_non_null(file);
    assert_int_equal(fwrite(data, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

static inline size_t read_file(const char *name, uint8_t *data, size_t capacity)
{
    FILE *file = fopen(path_of(name), "rb");
    size_t size;

    assert_non_null(file);
    size = fread(data, 1, capacity, file);
    assert_true(size < capacity);
    fclose(file);
    return size;
}

/* The members of a document, written to `text` with an asset and quotes as JSON has them. */
static inline size_t make_json(char *text, size_t capacity, const char *members)
{
    const int length = snprintf(text, capacity, "{'asset':{'version':'2.0'},%s}", members);

    assert_true(length > 0 && (size_t)length < capacity);
    for (char *c = text; *c; c++)
        if (*c == '\'')
            *c = '"';
    return (size_t)length;
}

static inline void write_gltf(const char *members)
{
    char text[16384];

    write_file("scene.gltf", text, make_json(text, sizeof text, members));
    write_file("data.bin", bytes.data, bytes.size);
}

static inline size_t make_glb(uint8_t *out, size_t capacity, const char *members)
{
    char text[16384];
    const size_t json = make_json(text, sizeof text, members), padding = (4 - json % 4) % 4;
    const uint32_t header[5] = {0x46546c67, 2, (uint32_t)(28 + json + padding + bytes.size), (uint32_t)(json + padding),
                                0x4e4f534a};
    const uint32_t chunk[2] = {(uint32_t)bytes.size, 0x004e4942};

    assert_true(header[2] <= capacity);
    for (int i = 0; i < 20; i++)
        out[i] = (uint8_t)(header[i / 4] >> 8 * (i % 4));
    memcpy(out + 20, text, json);
    memset(out + 20 + json, ' ', padding);
    for (size_t i = 0; i < 8; i++)
        out[20 + json + padding + i] = (uint8_t)(chunk[i / 4] >> 8 * (i % 4));
    memcpy(out + 28 + json + padding, bytes.data, bytes.size);
    return header[2];
}

static inline void base64(char *out, const uint8_t *data, size_t size)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

    for (size_t i = 0; i < size; i += 3) {
        const uint32_t b = (uint32_t)data[i] << 16 | (i + 1 < size ? (uint32_t)data[i + 1] << 8 : 0) |
                           (i + 2 < size ? data[i + 2] : 0u);

        *out++ = digits[b >> 18];
        *out++ = digits[b >> 12 & 63];
        *out++ = i + 1 < size ? digits[b >> 6 & 63] : '=';
        *out++ = i + 2 < size ? digits[b & 63] : '=';
    }
    *out = '\0';
}

/* --- loading them --- */

static inline void warn(const char *line)
{
    const size_t used = strlen(warnings);

    warning_count++;
    snprintf(warnings + used, sizeof warnings - used, "%s\n", line);
}

static inline int load(scene *s, const char *name, char message[SCENE_MESSAGE])
{
    warnings[0] = '\0';
    warning_count = 0;
    return scene_load(s, path_of(name), warn, message);
}

static inline void load_named(scene *s, const char *name)
{
    char message[SCENE_MESSAGE];

    if (!load(s, name, message))
        fail_msg("refused: %s", message);
}

static inline void load_members(scene *s, const char *members)
{
    write_gltf(members);
    load_named(s, "scene.gltf");
}

static inline void expect_text(const char *text, const char *part)
{
    if (!strstr(text, part))
        fail_msg("'%s' is not in: %s", part, text);
}

/* The document is refused in one line that has `part` in it, and nothing is left in the scene. */
static inline void expect_refusal(const char *name, const char *part)
{
    const scene empty = {0};
    char message[SCENE_MESSAGE] = "";
    scene s;

    if (load(&s, name, message))
        fail_msg("loaded, instead of: %s", part);
    expect_text(message, part);
    expect_text(message, name);
    assert_null(strchr(message, '\n'));
    assert_memory_equal(&s, &empty, sizeof s);
}

static inline void expect_near(double got, double wanted)
{
    if (!(fabs(got - wanted) <= NEAR_ENOUGH * fmax(1.0, fabs(wanted))))
        fail_msg("%.9g, not %.9g", got, wanted);
}

static inline void expect_doubles(const double *got, const double *wanted, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (!(fabs(got[i] - wanted[i]) <= NEAR_ENOUGH * fmax(1.0, fabs(wanted[i]))))
            fail_msg("element %lu: %.9g, not %.9g", (unsigned long)i, got[i], wanted[i]);
}

static inline void expect_floats(const float *got, const float *wanted, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (!(fabs((double)got[i] - wanted[i]) <= NEAR_ENOUGH))
            fail_msg("element %lu: %.9g, not %.9g", (unsigned long)i, (double)got[i], (double)wanted[i]);
}

static inline void expect_indices(const uint32_t *got, const uint32_t *wanted, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (got[i] != wanted[i])
            fail_msg("index %lu: %lu, not %lu", (unsigned long)i, (unsigned long)got[i], (unsigned long)wanted[i]);
}

#define DOUBLES(got, ...)                                                                                              \
    expect_doubles(got, (const double[]){__VA_ARGS__}, sizeof((const double[]){__VA_ARGS__}) / sizeof(double))
#define EXPECT_FLOATS(got, ...)                                                                                        \
    expect_floats(got, (const float[]){__VA_ARGS__}, sizeof((const float[]){__VA_ARGS__}) / sizeof(float))
#define INDICES(got, ...)                                                                                              \
    expect_indices(got, (const uint32_t[]){__VA_ARGS__}, sizeof((const uint32_t[]){__VA_ARGS__}) / sizeof(uint32_t))

/* Writes a PNG whose alpha is as given, and whose red is the column. */
static inline void write_png(const char *name, uint32_t width, uint32_t height, const uint8_t *alpha)
{
    png_image image = {.version = PNG_IMAGE_VERSION, .width = width, .height = height, .format = PNG_FORMAT_RGBA};
    uint8_t rgba[1024];

    assert_true(width * height * 4 <= sizeof rgba);
    for (uint32_t i = 0; i < width * height; i++) {
        rgba[4 * i] = (uint8_t)(i % width * 10);
        rgba[4 * i + 1] = rgba[4 * i + 2] = 128;
        rgba[4 * i + 3] = alpha[i];
    }
    assert_true(png_image_write_to_file(&image, path_of(name), 0, rgba, 0, NULL));
}

/* A triangle in the plane z = 0, and what a document needs to show it. */
#define TRIANGLE 0, 0, 0, 1, 0, 0, 0, 1, 0
#define BUFFER   "'buffers':[{'uri':'data.bin','byteLength':%lu}]"
#define ONE_MESH                                                                                                       \
    "'nodes':[{'mesh':0}],'meshes':[{'primitives':[{'attributes':{'POSITION':0}}]}],"                                  \
    "'accessors':[{'bufferView':0,'componentType':5126,'count':3,'type':'VEC3'}],"                                     \
    "'bufferViews':[{'buffer':0,'byteLength':36}],'buffers':[{'uri':'data.bin','byteLength':36}]"

/* --- a test's folder --- */

static inline int start_test(void **state)
{
    (void)state;
    memset(&bytes, 0, sizeof bytes);
    return 0;
}

static inline int make_folder(void **state)
{
    const char *base = getenv("TMPDIR");
    struct stat about;

    (void)state;
    if (!base || !*base)
        base = stat("build", &about) == 0 ? "build" : "/tmp";
    snprintf(folder, sizeof folder, "%.400s/test_gltf.XXXXXX", base);
    return mkdtemp(folder) ? 0 : -1;
}

static inline int remove_folder(void **state)
{
    static const char *const names[] = {"scene.gltf",      "scene.glb", "data.bin",  "my data%.bin",
                                        "picture one.png", "photo.jpg", "three.png", "one.png",
                                        "whole.png",       "cut.png",   "wide.png",  "any.png"};

    (void)state;
    for (size_t i = 0; i < COUNT(names); i++)
        remove(path_of(names[i]));
    return rmdir(folder);
}
#endif
