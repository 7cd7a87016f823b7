/* test_formats.c - counts in colour in framebuffer objects of 8, 5 and 4 bits: masks are the same whatever the format, as
 * far as the plan says that its range reaches; and depth that the host lends. */
#include "device.h"
#include "frame.h"
#include "plain_host.h"

#include <stdlib.h>
#include <string.h>

#define SIZE 64

enum { BYTES = 4 * SIZE * SIZE };

static test_device device;
static plain_host host;

/* A host's target: a texture of the format and 16 bits of depth; both bound. */
typedef struct object {
    GLuint framebuffer, texture, depth;
    gn_target target;
} object;

static void make_object(object *o, const test_format *format)
{
    const gn_gl *gl = device.gl;

    gl->glGenFramebuffers(1, &o->framebuffer);
    gl->glGenRenderbuffers(1, &o->depth);
    o->texture = test_make_texture(gl, format, SIZE);
    gl->glBindRenderbuffer(GL_RENDERBUFFER, o->depth);
    gl->glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT16, SIZE, SIZE);
    gl->glBindRenderbuffer(GL_RENDERBUFFER, 0);
    gl->glBindFramebuffer(GL_FRAMEBUFFER, o->framebuffer);
    gl->glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, o->texture, 0);
    gl->glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, o->depth);
    assert_int_equal(gn_gles_describe_target(device.gles, SIZE, SIZE, NULL, &o->target), GN_OK);
    assert_int_equal(o->target.framebuffer, o->framebuffer);
    assert_int_equal(o->target.shared_depth, o->depth);
    assert_int_equal(o->target.red_bits, format->bits[0]);
    assert_int_equal(o->target.alpha_bits, format->bits[3]);
    assert_int_equal(o->target.depth_bits, 16);
}

static void drop_object(object *o)
{
    const gn_gl *gl = device.gl;

    gl->glBindFramebuffer(GL_FRAMEBUFFER, 0);
    gl->glDeleteFramebuffers(1, &o->framebuffer);
    gl->glDeleteTextures(1, &o->texture);
    gl->glDeleteRenderbuffers(1, &o->depth);
}

/* How many of the two lights reach each pixel, by levels of a half. Returns 0 where the method is refused. */
static int draw(const object *o, gn_method method, uint32_t hidden, uint8_t lit[SIZE * SIZE], gn_plan *about)
{
    static uint8_t rgba[BYTES];
    const gn_gl *gl = device.gl;
    test_frame f;
    gn_result result;

    result = test_frame_make(&f, device.context, device.gles, o->target);
    assert_true(result == GN_OK || result == GN_E_DEVICE); /* it plans a frame that reads no masks */
    f.scene.method = method;
    f.scene.reads_masks = 1;
    f.scene.target.hidden |= hidden;
    f.memory = realloc(f.memory, gn_plan_bound(&f.scene));
    f.size = gn_plan_bound(&f.scene);
    result = gn_plan_make(device.context, &f.scene, f.memory, f.size, &f.plan);
    if (result == GN_OK) {
        gl->glBindFramebuffer(GL_FRAMEBUFFER, o->framebuffer);
        gl->glClearColor(0, 0, 0, 0);
        assert_true(plain_host_draw(&host, f.plan, 0.45f));
        gl->glReadPixels(0, 0, SIZE, SIZE, GL_RGBA, GL_UNSIGNED_BYTE, rgba);
        assert_int_equal(gl->glGetError(), GL_NO_ERROR);
        for (int i = 0; i < SIZE * SIZE; i++) {
            lit[i] = (uint8_t)((rgba[4 * i] + 57) / 115);
            if (abs(rgba[4 * i] - 115 * lit[i]) > 20) /* a mask that is neither 0 nor 1 */
                fail_msg("method %d: level %d of red", (int)method, rgba[4 * i]);
        }
        *about = *f.plan;
        about->lights = NULL;
    }
    test_frame_drop(&f, device.gles);
    return result == GN_OK;
}

static void all_formats_have_the_same_masks(void **state)
{
    static const struct {
        gn_method method;
        uint32_t hidden;
        int drawn[TEST_FORMATS];
    } ways[] = {{GN_METHOD_COUNT, 1u << GN_CAN_SHARED_DEPTH, {1, 1, 1, 1}},
                {GN_METHOD_COUNT, 0, {1, 1, 1, 1}},
                {GN_METHOD_COUNT,
                 1u << GN_CAN_FBO_RGBA8 | 1u << GN_CAN_FBO_RGB565 | 1u << GN_CAN_FBO_RGB5A1,
                 {1, 1, 1, 1}}, /* an image of 4 bits */
                {GN_METHOD_SIGNED, 0, {1, 1, 1, 1}},
                {GN_METHOD_SIGNED, 1u << GN_CAN_ALPHA, {1, 1, 1, 1}},
                {GN_METHOD_ALPHA, 0, {1, 1, 0, 0}},
                {GN_METHOD_SCREEN, 0, {1, 1, 1, 1}}};
    static uint8_t right[SIZE * SIZE], lit[SIZE * SIZE];
    int counts[3] = {0, 0, 0};

    (void)state;
    for (int format = 0; format < TEST_FORMATS; format++) {
        object o;

        make_object(&o, &test_formats[format]);
        for (size_t w = 0; w < sizeof ways / sizeof ways[0]; w++) {
            gn_plan about = {0};
            int differing = 0;

            assert_int_equal(draw(&o, ways[w].method, ways[w].hidden, lit, &about), ways[w].drawn[format]);
            if (!ways[w].drawn[format])
                continue;
            assert_int_equal(about.warnings & 1u << GN_WARN_RANGE, 0);
            if (ways[w].method == GN_METHOD_COUNT)
                assert_int_equal(about.image.depth_bits, ways[w].hidden & 1u << GN_CAN_SHARED_DEPTH ? 16 : 0);
            if (format == 0 && w == 0)
                memcpy(right, lit, sizeof right);
            for (int i = 0; i < SIZE * SIZE; i++)
                differing += right[i] != lit[i];
            if (differing)
                fail_msg("%s, way %lu: %d pixels differ", test_formats[format].name, (unsigned long)w, differing);
        }
        drop_object(&o);
    }
    for (int i = 0; i < SIZE * SIZE; i++)
        counts[right[i] < 2 ? right[i] : 2]++;
    assert_true(counts[0] > 40 && counts[1] > 40 && counts[2] > 40);
}

static int open_on(const char *name)
{
    return test_open_device(&device, name, SIZE) || !plain_host_open(&host, device.gles);
}

static int open_egl(void **state)
{
    (void)state;
    return open_on(test_platform());
}

static int open_osmesa(void **state)
{
    (void)state;
    return open_on("osmesa");
}

static int close_it(void **state)
{
    (void)state;
    plain_host_close(&host);
    return test_close_device(&device);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(all_formats_have_the_same_masks)};

    return cmocka_run_group_tests_name("formats, egl", tests, open_egl, close_it) +
           cmocka_run_group_tests_name("formats, osmesa", tests, open_osmesa, close_it);
}
