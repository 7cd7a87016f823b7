/* test_targets.c - targets other than a window of 8 bits a channel: what each is said to be able to do, and that what
 * was proven once can be given back. */
#include "device.h"
#include "gn_test.h"
#include "gnomon_gles.h"
#include "platform.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define BIT(capability) (1u << (capability))

static platform *p;
static gn_context *context;
static gn_gles *gles;
static const gn_gl *gl;
static gn_gl real;
static long draws;
static const char *renderer; /* instead of the driver's own */
static char warnings[4096];

static void GL_APIENTRY counted_draw(GLenum mode, GLint first, GLsizei count)
{
    draws++;
    real.glDrawArrays(mode, first, count);
}

static const GLubyte *GL_APIENTRY other_string(GLenum name)
{
    return name == GL_RENDERER && renderer ? (const GLubyte *)renderer : real.glGetString(name);
}

static gn_proc get_proc(void *user, const char *name)
{
    const gn_proc found = platform_get_proc(user, name);

    if (strcmp(name, "glDrawArrays") == 0) {
        real.glDrawArrays = (void(GL_APIENTRY *)(GLenum, GLint, GLsizei))found;
        return (gn_proc)counted_draw;
    }
    if (strcmp(name, "glGetString") == 0) {
        real.glGetString = (const GLubyte *(GL_APIENTRY *)(GLenum))found;
        return (gn_proc)other_string;
    }
    return found;
}

static void keep_log(void *user, int level, const char *line)
{
    (void)user;
    (void)level;
    if (strlen(warnings) + strlen(line) + 2 < sizeof warnings)
        strcat(strcat(warnings, line), "\n");
}

static int open_on(const char *name, const char *hide)
{
    const platform_desc wanted = {64, 64, 8, 8, 8, 8, 24, 8};
    gn_port port = gn_port_libc();
    char message[PLATFORM_MESSAGE];
    gn_gles_desc desc = {get_proc, NULL, hide};

    p = platform_open(name, &wanted, message);
    desc.user = p;
    port.log = keep_log;
    renderer = NULL;
    warnings[0] = '\0';
    if (!p || gn_context_create(&port, &context) != GN_OK || gn_gles_create(context, &desc, &gles) != GN_OK) {
        print_error("%s\n", p ? gn_message(context) : message);
        return 1;
    }
    gl = gn_gles_functions(gles);
    return 0;
}

static int open_egl(void **state)
{
    (void)state;
    return open_on(test_platform(), NULL);
}

static int open_osmesa(void **state)
{
    (void)state;
    return open_on("osmesa", NULL);
}

static int close_it(void **state)
{
    (void)state;
    gn_gles_destroy(gles);
    gn_context_destroy(context);
    platform_close(p);
    gles = NULL;
    context = NULL;
    p = NULL;
    return 0;
}

/* A framebuffer object of renderbuffers, bound. samples 0: none. */
static void bind_object(GLenum color, GLenum depth, GLsizei size, GLsizei samples)
{
    typedef void(GL_APIENTRY * storage)(GLenum, GLsizei, GLenum, GLsizei, GLsizei);
    const storage multisampled = (storage)platform_get_proc(p, "glRenderbufferStorageMultisample");
    GLuint names[2], framebuffer;

    gl->glGenFramebuffers(1, &framebuffer);
    gl->glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl->glGenRenderbuffers(2, names);
    for (int i = 0; i < 2; i++) {
        const GLenum format = i ? depth : color;

        gl->glBindRenderbuffer(GL_RENDERBUFFER, names[i]);
        if (samples)
            multisampled(GL_RENDERBUFFER, samples, format, size, size);
        else
            gl->glRenderbufferStorage(GL_RENDERBUFFER, format, size, size);
        gl->glFramebufferRenderbuffer(GL_FRAMEBUFFER, i ? GL_DEPTH_ATTACHMENT : GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                                      names[i]);
    }
    if (depth == 0x88F0)
        gl->glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_STENCIL_ATTACHMENT, GL_RENDERBUFFER, names[1]);
    assert_int_equal(gl->glCheckFramebufferStatus(GL_FRAMEBUFFER), GL_FRAMEBUFFER_COMPLETE);
    assert_int_equal(gl->glGetError(), GL_NO_ERROR);
}

static gn_target describe(uint32_t size)
{
    gn_target t;

    assert_int_equal(gn_gles_describe_target(gles, size, size, NULL, &t), GN_OK);
    assert_int_equal(gl->glGetError(), GL_NO_ERROR);
    return t;
}

enum {
    STENCILS = BIT(GN_CAN_STENCIL) | BIT(GN_CAN_STENCIL_WRAP) | BIT(GN_CAN_TWO_SIDED_STENCIL),
    RGBA8 = 0x8058,
    PACKED = 0x88F0
};

static void framebuffer_objects_are_targets(void **state)
{
    gn_target t;

    (void)state;
    bind_object(RGBA8, PACKED, 64, 0);
    t = describe(64);
    assert_int_equal(t.stencil_bits, 8);
    assert_int_equal(t.proven & STENCILS, STENCILS);
    assert_true(t.proven & BIT(GN_CAN_ALPHA));
    assert_string_equal(warnings, "");

    bind_object(GL_RGB565, GL_DEPTH_COMPONENT16, 64, 0); /* neither stencil nor alpha; steps of 1/31 */
    t = describe(64);
    assert_int_equal(t.advertised & (STENCILS | BIT(GN_CAN_ALPHA)), 0);
    assert_int_equal(t.depth_bits, 16);
    assert_true(t.proven & BIT(GN_CAN_DEPTH) && t.proven & BIT(GN_CAN_W0) && t.proven & BIT(GN_CAN_BLEND_SUBTRACT));
    assert_true(t.proven & BIT(GN_CAN_BLEND_MINMAX) && t.proven & BIT(GN_CAN_PACKED_DEPTH_STENCIL));
    assert_int_equal(t.advertised & ~t.proven, 0);
    assert_string_equal(warnings, "");
}

/* No cell fits, and what is seen of each is enough. */
static void targets_may_be_tiny(void **state)
{
    static const uint32_t sizes[] = {1, 5, 15, 17, 40};

    (void)state;
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        gn_target t;

        bind_object(RGBA8, PACKED, (GLsizei)sizes[i], 0);
        t = describe(sizes[i]);
        assert_int_equal(t.proven, t.advertised);
        assert_string_equal(warnings, "");
    }
}

/* Floats and sRGB cannot be read as levels: another framebuffer is proven, and nothing said of their blending. */
static void odd_colors_are_proven_by_another(void **state)
{
    static const GLenum formats[] = {0x881A /* RGBA16F */, 0x8C43 /* SRGB8_ALPHA8 */, 0x8229 /* R8 */};

    (void)state;
    for (size_t i = 0; i < sizeof formats / sizeof formats[0]; i++) {
        gn_target t;

        bind_object(formats[i], PACKED, 64, 0);
        t = describe(64);
        assert_int_equal(t.proven & STENCILS, STENCILS);
        assert_true(t.proven & BIT(GN_CAN_DEPTH) && t.proven & BIT(GN_CAN_W0));
        assert_int_equal(t.advertised & (BIT(GN_CAN_ALPHA) | BIT(GN_CAN_BLEND_ROUNDING)), 0);
        assert_int_equal(t.proven, t.advertised);
        assert_true(t.mediump_bits == 10 || t.mediump_bits == 23);
        assert_string_equal(warnings, "");
    }
}

/* The sizes are only told: none may be too large. */
static void targets_may_be_huge(void **state)
{
    gn_target t;

    (void)state;
    assert_int_equal(gn_gles_describe_target(gles, 1u << 20, 1u << 20, NULL, &t), GN_OK);
    assert_int_equal(gn_gles_describe_target(gles, UINT32_MAX, UINT32_MAX, NULL, &t), GN_OK);
}

/* A multisampled framebuffer object cannot be read, and is proven by one that stands in for it. */
static void multisampled_objects_are_proven_by_another(void **state)
{
    gn_target t;
    GLint bound[2];

    (void)state;
    bind_object(RGBA8, PACKED, 64, 4);
    gl->glGetIntegerv(GL_FRAMEBUFFER_BINDING, &bound[0]);
    t = describe(64);
    gl->glGetIntegerv(GL_FRAMEBUFFER_BINDING, &bound[1]);
    assert_int_equal(bound[0], bound[1]);
    assert_int_equal(t.samples, 4);
    assert_int_equal(t.width, 64);
    assert_int_equal(t.proven & STENCILS, STENCILS);
    assert_true(!(t.advertised & BIT(GN_CAN_SHARED_DEPTH))); /* a mask has one sample */
    assert_string_equal(warnings, "");
}

static void an_incomplete_target_is_refused(void **state)
{
    GLuint framebuffer;
    gn_target t;

    (void)state;
    gl->glGenFramebuffers(1, &framebuffer);
    gl->glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    assert_int_equal(gn_gles_describe_target(gles, 8, 8, NULL, &t), GN_E_DEVICE);
    gl->glBindFramebuffer(GL_FRAMEBUFFER, 0);
    assert_int_equal(gn_gles_describe_target(gles, 0, 8, NULL, &t), GN_E_ARG);
    assert_non_null(strstr(gn_message(context), "0x8"));
    assert_int_equal(gn_gles_describe_target(gles, 8, 8, NULL, NULL), GN_E_ARG);
    gn_gles_forget(gles);
    assert_int_equal(gn_gles_describe_target(gles, 8, 8, NULL, &t), GN_E_ARG);
}

/* Text for text the same target without a single draw; of another driver, another target, cut short, or silent about
 * something that was hidden then: it is proven anew. */
static void what_was_proven_is_given_back(void **state)
{
    gn_target first = describe(64), again;
    char text[4096], cut[4096];
    size_t length;

    (void)state;
    length = gn_gles_save_target(gles, &first, text, sizeof text);
    assert_true(length > 200 && length < sizeof text && strlen(text) == length);
    assert_int_equal(gn_gles_save_target(gles, &first, cut, 10), length);
    assert_int_equal(strlen(cut), 9);
    draws = 0;
    assert_int_equal(gn_gles_describe_target(gles, 64, 64, text, &again), GN_OK);
    assert_int_equal(draws, 0);
    assert_memory_equal(&again, &first, sizeof first);

    for (size_t at = 0; at < length; at += 7) { /* cut anywhere */
        memcpy(cut, text, at);
        cut[at] = '\0';
        draws = 0;
        assert_int_equal(gn_gles_describe_target(gles, 64, 64, cut, &again), GN_OK);
        assert_true(draws > 0);
        assert_memory_equal(&again, &first, sizeof first);
    }
    renderer = "another";
    draws = 0;
    assert_int_equal(gn_gles_describe_target(gles, 64, 64, text, &again), GN_OK);
    assert_true(draws > 0);
    renderer = NULL;
    bind_object(RGBA8, GL_DEPTH_COMPONENT16, 64, 0);
    draws = 0;
    assert_int_equal(gn_gles_describe_target(gles, 64, 64, text, &again), GN_OK);
    assert_true(draws > 0 && again.depth_bits == 16);
}

/* A failure is given back with its symptom; what was hidden when the text was made is proven once it no longer is. */
static void hiding_and_saving_go_together(void **state)
{
    gn_target hidden, t;
    char text[4096], longer[2048];
    const char *line;

    (void)state;
    assert_int_equal(open_on(test_platform(), "two-sided-stencil,w0"), 0);
    hidden = describe(64);
    assert_int_equal(hidden.hidden, BIT(GN_CAN_TWO_SIDED_STENCIL) | BIT(GN_CAN_W0));
    assert_true(!gn_target_can(&hidden, GN_CAN_W0) && gn_target_can(&hidden, GN_CAN_STENCIL));
    gn_gles_save_target(gles, &hidden, text, sizeof text);
    close_it(NULL);
    assert_int_equal(open_on(test_platform(), NULL), 0);
    draws = 0;
    assert_int_equal(gn_gles_describe_target(gles, 64, 64, text, &t), GN_OK);
    assert_true(draws > 0 && gn_target_can(&t, GN_CAN_W0));

    gn_gles_save_target(gles, &t, longer, sizeof longer);
    line = strstr(longer, "w0: ");
    snprintf(text, sizeof text, "%.*sw0: failed, pixels were lost%s", (int)(line - longer), longer, strchr(line, '\n'));
    draws = 0;
    assert_int_equal(gn_gles_describe_target(gles, 64, 64, text, &t), GN_OK);
    assert_int_equal(draws, 0);
    assert_true(!gn_target_can(&t, GN_CAN_W0));
    assert_string_equal(gn_gles_symptom(gles, GN_CAN_W0), "pixels were lost");
    close_it(NULL);
}

/* What could not be tried for want of something hidden is tried once that is there again, on a target without it
 * too. */
static void what_was_not_tried_is_not_kept(void **state)
{
    gn_target t;
    char text[4096];

    (void)state;
    assert_int_equal(open_on(test_platform(), "stencil"), 0);
    bind_object(RGBA8, GL_DEPTH_COMPONENT16, 64, 0);
    t = describe(64);
    assert_true(!(t.proven & BIT(GN_CAN_PACKED_DEPTH_STENCIL)));
    gn_gles_save_target(gles, &t, text, sizeof text);
    close_it(NULL);
    assert_int_equal(open_on(test_platform(), NULL), 0);
    bind_object(RGBA8, GL_DEPTH_COMPONENT16, 64, 0);
    assert_int_equal(gn_gles_describe_target(gles, 64, 64, text, &t), GN_OK);
    assert_true(t.proven & BIT(GN_CAN_PACKED_DEPTH_STENCIL));
    close_it(NULL);
}

static void names_that_are_none_are_refused(void **state)
{
    gn_context *other;
    gn_gles *device = NULL;
    gn_gles_desc desc = {get_proc, p, "alpha,beta"};

    (void)state;
    assert_int_equal(gn_context_create(NULL, &other), GN_OK);
    assert_int_equal(gn_gles_create(other, &desc, &device), GN_E_ARG);
    assert_non_null(strstr(gn_message(other), "\"beta\""));
    setenv("GNOMON_HIDE", "gamma", 1);
    desc.hide = NULL;
    assert_int_equal(gn_gles_create(other, &desc, &device), GN_E_ARG);
    assert_non_null(strstr(gn_message(other), "GNOMON_HIDE: no capability is called \"gamma\""));
    unsetenv("GNOMON_HIDE");
    assert_null(device);
    gn_context_destroy(other);
}

int main(void)
{
    const struct CMUnitTest egl[] = {
        cmocka_unit_test_setup_teardown(framebuffer_objects_are_targets, open_egl, close_it),
        cmocka_unit_test_setup_teardown(targets_may_be_tiny, open_egl, close_it),
        cmocka_unit_test_setup_teardown(odd_colors_are_proven_by_another, open_egl, close_it),
        cmocka_unit_test_setup_teardown(targets_may_be_huge, open_egl, close_it),
        cmocka_unit_test_setup_teardown(multisampled_objects_are_proven_by_another, open_egl, close_it),
        cmocka_unit_test_setup_teardown(an_incomplete_target_is_refused, open_egl, close_it),
        cmocka_unit_test_setup_teardown(what_was_proven_is_given_back, open_egl, close_it),
        cmocka_unit_test(hiding_and_saving_go_together),
        cmocka_unit_test(what_was_not_tried_is_not_kept),
        cmocka_unit_test_setup_teardown(names_that_are_none_are_refused, open_egl, close_it),
    };
    const struct CMUnitTest osmesa[] = {
        cmocka_unit_test_setup_teardown(framebuffer_objects_are_targets, open_osmesa, close_it),
        cmocka_unit_test_setup_teardown(multisampled_objects_are_proven_by_another, open_osmesa, close_it),
    };

    return cmocka_run_group_tests_name("targets, egl", egl, NULL, NULL) +
           cmocka_run_group_tests_name("targets, osmesa", osmesa, NULL, NULL);
}
