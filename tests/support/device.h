/* device.h - a platform's context with a gn_gles in it, for tests that draw. */
#ifndef DEVICE_H
#define DEVICE_H
#include "gnomon_gles.h"
#include "platform.h"

typedef struct test_device {
    platform *platform;
    gn_context *context;
    gn_gles *gles;
    const gn_gl *gl;
} test_device;

/* Where contexts come from: what GNOMON_TEST_PLATFORM says, or EGL (make test-drivers). */
const char *test_platform(void);

/* size * size pixels, 8 bits a channel, 24 of depth, 8 of stencil. 0, or 1 having said why: as cmocka's fixtures do. */
int test_open_device(test_device *d, const char *platform_name, uint32_t size);
int test_open_device_of(test_device *d, const char *platform_name, uint32_t width, uint32_t height);
int test_close_device(test_device *d);

/* Formats of textures that counts may be made in. */
typedef struct test_format {
    const char *name;
    GLenum format, type;
    int bits[4]; /* of red, green, blue, alpha */
} test_format;

enum { TEST_FORMATS = 4 };
extern const test_format test_formats[TEST_FORMATS];
/* Such a texture, NEAREST. */
GLuint test_make_texture(const gn_gl *gl, const test_format *format, GLsizei size);
#endif
