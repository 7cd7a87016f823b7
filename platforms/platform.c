/* platform.c - tries the kinds of platforms in order, and says why each did not work. */
#include "platform.h"

#include <GLES2/gl2.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

extern const platform_kind platform_egl, platform_osmesa, platform_glfw, platform_glfw_native, platform_glfw_osmesa,
    platform_angle;

const platform_kind *const platform_kinds[] = {
    &platform_egl, &platform_osmesa, &platform_glfw, &platform_glfw_native, &platform_glfw_osmesa, &platform_angle,
    NULL};

static void keep_memory(void)
{
#ifdef __GLIBC__
    mallopt(M_TRIM_THRESHOLD, 1 << 30);
    mallopt(M_MMAP_THRESHOLD, 32 << 20); /* the most that there may be */
#endif
}

platform *platform_open(const char *name, const platform_desc *desc, char message[PLATFORM_MESSAGE])
{
    size_t length = 0;
    int known = 0;

    message[0] = '\0';
    keep_memory();
    for (int i = 0; platform_kinds[i]; i++) {
        char why[PLATFORM_MESSAGE] = "";
        platform *p;

        if (name && strcmp(name, platform_kinds[i]->name) != 0)
            continue;
        known = 1;
        p = platform_kinds[i]->create(desc, why);
        if (p)
            return p;
        if (length < PLATFORM_MESSAGE)
            length += (size_t)snprintf(message + length, PLATFORM_MESSAGE - length, "%s%s: %s", length ? "; " : "",
                                       platform_kinds[i]->name, why);
    }
    if (!known)
        snprintf(message, PLATFORM_MESSAGE, "no platform is called %s", name);
    return NULL;
}

void (*platform_get_proc(void *user, const char *name))(void)
{
    platform *p = user;

    return p->kind->get_proc(p, name);
}

int platform_read_back(platform *p, uint8_t *rgba)
{
    void(GL_APIENTRY * read)(GLint, GLint, GLsizei, GLsizei, GLenum, GLenum, void *) =
        (void(GL_APIENTRY *)(GLint, GLint, GLsizei, GLsizei, GLenum, GLenum, void *))platform_get_proc(p,
                                                                                                       "glReadPixels");
    void(GL_APIENTRY * store)(GLenum, GLint) =
        (void(GL_APIENTRY *)(GLenum, GLint))platform_get_proc(p, "glPixelStorei");
    GLenum(GL_APIENTRY * error)(void) = (GLenum(GL_APIENTRY *)(void))platform_get_proc(p, "glGetError");
    const size_t row = 4 * (size_t)p->actual.width;
    uint8_t *const swap = malloc(row);

    if (!read || !store || !error || !swap) {
        free(swap);
        return 0;
    }
    store(GL_PACK_ALIGNMENT, 4);
    read(0, 0, (GLsizei)p->actual.width, (GLsizei)p->actual.height, GL_RGBA, GL_UNSIGNED_BYTE, rgba);
    for (uint32_t y = 0; y < p->actual.height / 2; y++) {
        uint8_t *const a = rgba + row * y, *const b = rgba + row * (p->actual.height - 1 - y);

        memcpy(swap, a, row);
        memcpy(a, b, row);
        memcpy(b, swap, row);
    }
    free(swap);
    return error() == GL_NO_ERROR;
}

void platform_close(platform *p)
{
    if (p)
        p->kind->destroy(p);
}
