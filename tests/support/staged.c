/* staged.c - see staged.h. */
#include "staged.h"
#include "device.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gn_test.h"

void staged_open_as(staged *t, const char *name, const stage_options *options)
{
    char path[128], message[SCENE_MESSAGE] = "";

    snprintf(path, sizeof path, "build/scenes/%s.gltf", name);
    if (!scene_load(&t->loaded, path, NULL, message) ||
        !scene_ensure_view(&t->loaded, (double)options->width / options->height, NULL) ||
        stage_open(&t->stage, &t->loaded, options, message) != 0)
        fail_msg("%s: %s", name, message);
    stage_pose(t->stage, 0, 0);
}

void staged_open(staged *t, const char *name, uint32_t width, uint32_t height)
{
    const stage_options options = {.platform = test_platform(),
                                   .width = width,
                                   .height = height,
                                   .exposure = 1.0,
                                   .depth_bits = 24,
                                   .stencil_bits = 8};

    staged_open_as(t, name, &options);
}

void staged_close(staged *t)
{
    stage_close(t->stage);
    scene_free(&t->loaded);
}

uint8_t *staged_read_mask(staged *t, uint32_t mask)
{
    const stage *s = t->stage;
    const gn_gl *gl = s->gl;
    const uint32_t *size = s->plan->mask_size;
    const size_t row = (size_t)4 * size[0];
    uint8_t *rgba = malloc(row * size[1]), *spare = malloc(row);
    GLuint framebuffer;

    assert_true(rgba && spare);
    gl->glGenFramebuffers(1, &framebuffer);
    gl->glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl->glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, gn_gles_mask(s->gles, mask), 0);
    assert_int_equal(gl->glCheckFramebufferStatus(GL_FRAMEBUFFER), GL_FRAMEBUFFER_COMPLETE);
    gl->glReadPixels(0, 0, (GLsizei)size[0], (GLsizei)size[1], GL_RGBA, GL_UNSIGNED_BYTE, rgba);
    gl->glBindFramebuffer(GL_FRAMEBUFFER, s->target.framebuffer);
    gl->glDeleteFramebuffers(1, &framebuffer);
    for (uint32_t y = 0; y < size[1] / 2; y++) {
        memcpy(spare, rgba + row * y, row);
        memcpy(rgba + row * y, rgba + row * (size[1] - 1 - y), row);
        memcpy(rgba + row * (size[1] - 1 - y), spare, row);
    }
    free(spare);
    return rgba;
}
