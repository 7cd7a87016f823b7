/* test_hidden.c - what is hidden is never used: a recorder between library and driver sees, while the target is
 * described and a frame is drawn, no call that needs the hidden capability. Nothing hidden, it sees them all. */
#include "between.h"
#include "device.h"
#include "gn_test.h"
#include "stage.h"

#include <stdlib.h>
#include <string.h>

static uint32_t used; /* set of gn_capability */
static GLenum texture_type;
static int clamps;       /* depth clamp is enabled */
static int is_scissored; /* so is the scissor test */
static uint32_t offered; /* by the driver */

static void use(gn_capability c)
{
    used |= 1u << c;
}

static void see_operation(GLenum operation)
{
    if (operation == GL_INCR_WRAP || operation == GL_DECR_WRAP)
        use(GN_CAN_STENCIL_WRAP);
    if (operation != GL_KEEP)
        use(GN_CAN_STENCIL);
}

static void GL_APIENTRY stencil_op(GLenum fail, GLenum depth_fail, GLenum pass)
{
    see_operation(depth_fail);
    see_operation(pass);
    between_real.glStencilOp(fail, depth_fail, pass);
}

static void GL_APIENTRY stencil_op_separate(GLenum face, GLenum fail, GLenum depth_fail, GLenum pass)
{
    if (face != GL_FRONT_AND_BACK)
        use(GN_CAN_TWO_SIDED_STENCIL);
    see_operation(depth_fail);
    see_operation(pass);
    between_real.glStencilOpSeparate(face, fail, depth_fail, pass);
}

static void GL_APIENTRY enable(GLenum name)
{
    if (name == GL_STENCIL_TEST)
        use(GN_CAN_STENCIL);
    if (name == GL_DEPTH_TEST)
        use(GN_CAN_DEPTH);
    if (name == 0x864F) {
        use(GN_CAN_DEPTH_CLAMP);
        clamps = 1;
    }
    is_scissored |= name == GL_SCISSOR_TEST;
    between_real.glEnable(name);
}

static void GL_APIENTRY disable(GLenum name)
{
    if (name == 0x864F) { /* no enumerant where the extension is missing */
        use(GN_CAN_DEPTH_CLAMP);
        clamps = 0;
    }
    is_scissored &= name != GL_SCISSOR_TEST;
    between_real.glDisable(name);
}

static void GL_APIENTRY clear(GLbitfield buffers)
{
    if (buffers & GL_STENCIL_BUFFER_BIT)
        use(GN_CAN_STENCIL);
    if (buffers & GL_DEPTH_BUFFER_BIT)
        use(GN_CAN_DEPTH);
    if (is_scissored)
        use(GN_CAN_PARTIAL_CLEAR);
    between_real.glClear(buffers);
}

static void GL_APIENTRY blend_equation(GLenum mode)
{
    if (mode == 0x800B)
        use(GN_CAN_BLEND_SUBTRACT);
    if (mode == 0x8007 || mode == 0x8008)
        use(GN_CAN_BLEND_MINMAX);
    between_real.glBlendEquation(mode);
}

static void GL_APIENTRY blend_func(GLenum source, GLenum destination)
{
    if (source == GL_ZERO && destination == GL_SRC_COLOR)
        use(GN_CAN_BLEND_ROUNDING);
    between_real.glBlendFunc(source, destination);
}

static void GL_APIENTRY blend_func_separate(GLenum source, GLenum destination, GLenum source_a, GLenum destination_a)
{
    if (source == GL_DST_ALPHA)
        use(GN_CAN_ALPHA);
    between_real.glBlendFuncSeparate(source, destination, source_a, destination_a);
}

static void GL_APIENTRY shader_source(GLuint shader, GLsizei count, const GLchar *const *parts, const GLint *lengths)
{
    for (GLsizei i = 0; i < count; i++) {
        if (strstr(parts[i], "#define FACING") || strstr(parts[i], "#define SIDED") ||
            strstr(parts[i], "#define FACED") || strstr(parts[i], "#define FROM_BEHIND !gl_FrontFacing"))
            use(GN_CAN_FRONT_FACING);
        if (strstr(parts[i], "#define HIGHP") || strstr(parts[i], "#define PRECISION highp"))
            use(GN_CAN_FRAGMENT_HIGHP);
    }
    between_real.glShaderSource(shader, count, parts, lengths);
}

/* Triangles at infinity are told by the matrix that sends them there: z = w, and no depth clamp to keep them. */
static void GL_APIENTRY uniform_matrix(GLint location, GLsizei count, GLboolean transpose, const GLfloat *m)
{
    if (m[2] == m[3] && m[6] == m[7] && m[10] == m[11] && m[14] == m[15] && !clamps)
        use(GN_CAN_W0);
    between_real.glUniformMatrix4fv(location, count, transpose, m);
}

static void GL_APIENTRY draw_elements(GLenum mode, GLsizei count, GLenum type, const void *indices)
{
    if (type == GL_UNSIGNED_INT)
        use(GN_CAN_UINT_INDICES);
    between_real.glDrawElements(mode, count, type, indices);
}

static void GL_APIENTRY tex_image(GLenum target, GLint level, GLint internal, GLsizei width, GLsizei height,
                                  GLint border, GLenum format, GLenum type, const void *pixels)
{
    texture_type = type;
    if (format == GL_DEPTH_COMPONENT)
        use(GN_CAN_DEPTH_TEXTURE);
    between_real.glTexImage2D(target, level, internal, width, height, border, format, type, pixels);
}

static void GL_APIENTRY framebuffer_texture(GLenum target, GLenum attachment, GLenum kind, GLuint name, GLint level)
{
    if (attachment == GL_COLOR_ATTACHMENT0)
        use(texture_type == GL_UNSIGNED_BYTE            ? GN_CAN_FBO_RGBA8
            : texture_type == GL_UNSIGNED_SHORT_5_6_5   ? GN_CAN_FBO_RGB565
            : texture_type == GL_UNSIGNED_SHORT_5_5_5_1 ? GN_CAN_FBO_RGB5A1
                                                        : GN_CAN_FBO_RGBA4);
    between_real.glFramebufferTexture2D(target, attachment, kind, name, level);
}

static void GL_APIENTRY renderbuffer_storage(GLenum target, GLenum format, GLsizei width, GLsizei height)
{
    use(format == 0x88F0 ? GN_CAN_PACKED_DEPTH_STENCIL : GN_CAN_SHARED_DEPTH);
    between_real.glRenderbufferStorage(target, format, width, height);
}

static void GL_APIENTRY begin_query(GLenum target, GLuint query)
{
    use(GN_CAN_TIMER_QUERY);
    between_real.glBeginQueryEXT(target, query);
}

static void GL_APIENTRY discard(GLenum target, GLsizei count, const GLenum *names)
{
    use(GN_CAN_DISCARD);
    between_real.glDiscardFramebufferEXT(target, count, names);
}

static gn_proc replace(const char *name, gn_proc found)
{
    static const between list[] = {{"glStencilOp", (gn_proc)stencil_op},
                                   {"glStencilOpSeparate", (gn_proc)stencil_op_separate},
                                   {"glEnable", (gn_proc)enable},
                                   {"glDisable", (gn_proc)disable},
                                   {"glClear", (gn_proc)clear},
                                   {"glBlendEquation", (gn_proc)blend_equation},
                                   {"glBlendFunc", (gn_proc)blend_func},
                                   {"glBlendFuncSeparate", (gn_proc)blend_func_separate},
                                   {"glShaderSource", (gn_proc)shader_source},
                                   {"glUniformMatrix4fv", (gn_proc)uniform_matrix},
                                   {"glDrawElements", (gn_proc)draw_elements},
                                   {"glTexImage2D", (gn_proc)tex_image},
                                   {"glFramebufferTexture2D", (gn_proc)framebuffer_texture},
                                   {"glRenderbufferStorage", (gn_proc)renderbuffer_storage},
                                   {"glBeginQueryEXT", (gn_proc)begin_query},
                                   {"glDiscardFramebufferEXT", (gn_proc)discard}};

    return between_take(name, found, list, sizeof list / sizeof list[0]);
}

/* Everything from start to a mask; a frame that is refused ends there. Returns stage_plan()'s status. */
static int run(const char *hide, char message[SCENE_MESSAGE])
{
    const stage_options options = {.platform = test_platform(),
                                   .width = 64,
                                   .height = 48,
                                   .depth_bits = 24,
                                   .stencil_bits = 8,
                                   .hide = hide,
                                   .replace = replace};
    const stage_wish wish = {.method = GN_METHOD_AUTO, .casting = 1, .light_count = 1};
    scene loaded;
    stage *s;
    int status;

    used = 0;
    offered = 0;
    assert_true(scene_load(&loaded, "build/scenes/cube_point.gltf", NULL, message));
    assert_int_equal(stage_open(&s, &loaded, &options, message), 0);
    offered = s->target.advertised;
    stage_pose(s, 0, 0);
    status = stage_plan(s, &wish, message);
    if (status == 0)
        assert_true(stage_draw_mask(s, 0, message));
    stage_close(s);
    scene_free(&loaded);
    return status;
}

static void nothing_hidden_all_is_used(void **state)
{
    char message[SCENE_MESSAGE];

    (void)state;
    assert_int_equal(run(NULL, message), 0);
    assert_int_equal(offered | 1u << GN_CAN_DEPTH_BOUNDS, TEST_EVERYTHING); /* which no Mesa rasteriser here has */
    for (int c = 0; c < GN_CAPABILITY_COUNT; c++)
        if (!(used >> c & 1) && offered >> c & 1)
            fail_msg("%s is not seen", gn_capability_name((gn_capability)c));
}

static void what_is_hidden_is_not_used(void **state)
{
    char message[SCENE_MESSAGE];

    (void)state;
    for (int c = 0; c < GN_CAPABILITY_COUNT; c++) {
        const char *const name = gn_capability_name((gn_capability)c);
        const int status = run(name, message);

        if (used >> c & 1)
            fail_msg("%s is hidden and used", name);
        if (c == GN_CAN_DEPTH) { /* without a stencil it is counted in colour */
            assert_int_equal(status, 3);
            assert_non_null(strstr(message, name));
            assert_non_null(strstr(message, "is hidden"));
        } else {
            assert_int_equal(status, 0);
        }
    }
}

/* All at once: nothing is left to draw with, and no call is made for any. */
static void all_may_be_hidden(void **state)
{
    char message[SCENE_MESSAGE], all[1024] = "";

    (void)state;
    for (int c = 0; c < GN_CAPABILITY_COUNT; c++) {
        strcat(all, c ? "," : "");
        strcat(all, gn_capability_name((gn_capability)c));
    }
    assert_int_equal(run(all, message), 3);
    assert_int_equal(used, 0);
    assert_int_equal(run("two-sided-stencil,stencil-wrap,w0,depth-clamp", message), 0);
    assert_int_equal(used & (1u << GN_CAN_TWO_SIDED_STENCIL | 1u << GN_CAN_STENCIL_WRAP | 1u << GN_CAN_W0 |
                             1u << GN_CAN_DEPTH_CLAMP),
                     0);
}

/* The environment hides too, through the port. */
static void the_environment_hides(void **state)
{
    char message[SCENE_MESSAGE];

    (void)state;
    setenv("GNOMON_HIDE", "stencil-wrap,discard", 1);
    assert_int_equal(run("w0", message), 0);
    assert_int_equal(used & (1u << GN_CAN_STENCIL_WRAP | 1u << GN_CAN_DISCARD | 1u << GN_CAN_W0), 0);
    unsetenv("GNOMON_HIDE");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nothing_hidden_all_is_used),
        cmocka_unit_test(what_is_hidden_is_not_used),
        cmocka_unit_test(all_may_be_hidden),
        cmocka_unit_test(the_environment_hides),
    };

    return cmocka_run_group_tests_name("hidden", tests, NULL, NULL);
}
