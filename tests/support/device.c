/* device.c - see device.h. */
#include "device.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const test_format test_formats[TEST_FORMATS] = {{"rgba8", GL_RGBA, GL_UNSIGNED_BYTE, {8, 8, 8, 8}},
                                                {"rgba4", GL_RGBA, GL_UNSIGNED_SHORT_4_4_4_4, {4, 4, 4, 4}},
                                                {"rgb5a1", GL_RGBA, GL_UNSIGNED_SHORT_5_5_5_1, {5, 5, 5, 1}},
                                                {"rgb565", GL_RGB, GL_UNSIGNED_SHORT_5_6_5, {5, 6, 5, 0}}};

const char *test_platform(void)
{
    const char *name = getenv("GNOMON_TEST_PLATFORM");

    return name ? name : "egl";
}

int test_open_device(test_device *d, const char *platform_name, uint32_t size)
{
    return test_open_device_of(d, platform_name, size, size);
}

int test_open_device_of(test_device *d, const char *platform_name, uint32_t width, uint32_t height)
{
    const platform_desc wanted = {width, height, 8, 8, 8, 8, 24, 8};
    char message[PLATFORM_MESSAGE] = "no memory";
    gn_gles_desc desc = {platform_get_proc, NULL, NULL};

    memset(d, 0, sizeof *d);
    d->platform = platform_open(platform_name, &wanted, message);
    desc.user = d->platform;
    if (!d->platform || gn_context_create(NULL, &d->context) != GN_OK ||
        gn_gles_create(d->context, &desc, &d->gles) != GN_OK) {
        fprintf(stderr, "%s: %s\n", platform_name, d->context ? gn_message(d->context) : message);
        return 1;
    }
    d->gl = gn_gles_functions(d->gles);
    return 0;
}

int test_close_device(test_device *d)
{
    gn_gles_destroy(d->gles);
    gn_context_destroy(d->context);
    platform_close(d->platform);
    return 0;
}

GLuint test_make_texture(const gn_gl *gl, const test_format *format, GLsizei size)
{
    GLuint name = 0;

    gl->glGenTextures(1, &name);
    gl->glBindTexture(GL_TEXTURE_2D, name);
    gl->glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl->glTexImage2D(GL_TEXTURE_2D, 0, (GLint)format->format, size, size, 0, format->format, format->type, NULL);
    gl->glBindTexture(GL_TEXTURE_2D, 0);
    return name;
}
