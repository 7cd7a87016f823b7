/* test_lies.c - a real driver behind a function table that lies, one lie at a time: the proof finds it out and says
 * what it saw, and the frame has the same bits as the truthful driver's all the same, or is refused in words. */
#include "between.h"
#include "device.h"
#include "gn_test.h"
#include "stage.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 160, HEIGHT = 120 };

static const char *lie;              /* the one told now */
static GLenum texture_type, storage; /* of the last glTexImage2D and glRenderbufferStorage */
static GLuint depth_holder;          /* the renderbuffer that was attached first */

static int lies(const char *name)
{
    return strcmp(lie, name) == 0;
}

static GLenum dropped_wrap(GLenum operation, int two_sided, int fails)
{
    if (lies("wrap is dropped") || (two_sided && lies("wrap is dropped on two sides")) ||
        (fails && lies("wrap is dropped by failing depth")) ||
        (fails && two_sided && lies("wrap is dropped by failing depth on two sides")))
        return operation == GL_INCR_WRAP ? GL_INCR : operation == GL_DECR_WRAP ? GL_DECR : operation;
    return operation;
}

static void GL_APIENTRY stencil_op(GLenum fail, GLenum depth_fail, GLenum pass)
{
    between_real.glStencilOp(dropped_wrap(fail, 0, 0), dropped_wrap(depth_fail, 0, 1), dropped_wrap(pass, 0, 0));
}

static void GL_APIENTRY stencil_op_separate(GLenum face, GLenum fail, GLenum depth_fail, GLenum pass)
{
    if (lies("back state is ignored")) {
        if (face != GL_BACK)
            between_real.glStencilOp(fail, depth_fail, pass);
        return;
    }
    between_real.glStencilOpSeparate(face, dropped_wrap(fail, 1, 0), dropped_wrap(depth_fail, 1, 1),
                                     dropped_wrap(pass, 1, 0));
}

static void GL_APIENTRY enable(GLenum name)
{
    if ((lies("stencil is null") && name == GL_STENCIL_TEST) || (lies("clamp is ignored") && name == 0x864F) ||
        (lies("depth is null") && name == GL_DEPTH_TEST) || (lies("scissor is ignored") && name == GL_SCISSOR_TEST))
        return;
    between_real.glEnable(name);
}

static void GL_APIENTRY blend_equation(GLenum mode)
{
    if ((lies("subtract is missing") && mode == 0x800B) || (lies("min and max are missing") && mode < 0x800A))
        mode = GL_FUNC_ADD;
    between_real.glBlendEquation(mode);
}

static void GL_APIENTRY blend_func_separate(GLenum source, GLenum destination, GLenum source_a, GLenum destination_a)
{
    between_real.glBlendFuncSeparate(lies("alpha reads as 1") && source == GL_DST_ALPHA ? GL_ONE : source, destination,
                                     source_a, destination_a);
}

static void GL_APIENTRY uniform4fv(GLint location, GLsizei count, const GLfloat *value)
{
    static const GLfloat up[4] = {129.0f / 255.0f, 129.0f / 255.0f, 129.0f / 255.0f, 129.0f / 255.0f};

    between_real.glUniform4fv(location, count, lies("halves round up") && value[0] == 128.0f / 255.0f ? up : value);
}

/* Vertex shaders end by pushing what lies at infinity out; fragment shaders have words exchanged. */
static void GL_APIENTRY shader_source(GLuint shader, GLsizei count, const GLchar *const *parts, const GLint *lengths)
{
    static char text[20000];
    const char *from = "", *to = "";
    size_t length = 0;

    if (lies("w = 0 is clipped"))
        from = "void main()", to = "void told_main()";
    else if (lies("sampling does not compile"))
        from = "texture2D(u_texture, vec2", to = "texture9D(u_texture, vec2";
    else if (lies("facing is inverted"))
        from = "gl_FrontFacing", to = "!gl_FrontFacing";
    else if (lies("highp is mediump") && strstr(parts[count - 1], "u_high_ones"))
        from = "highp ", to = "mediump ";
    for (GLsizei i = 0; i < count; i++) {
        const char *at = parts[i], *found;

        while (*from && (found = strstr(at, from)) != NULL) {
            length += (size_t)snprintf(text + length, sizeof text - length, "%.*s%s", (int)(found - at), at, to);
            at = found + strlen(from);
        }
        length += (size_t)snprintf(text + length, sizeof text - length, "%s", at);
    }
    if (lies("w = 0 is clipped"))
        snprintf(text + length, sizeof text - length, "%s",
                 strstr(text, "gl_Position") ? "void main() { told_main(); if (gl_Position.z >= gl_Position.w) "
                                               "gl_Position.z = 1.0000002 * gl_Position.w; }\n"
                                             : "void main() { told_main(); }\n");
    parts = (const GLchar *const[]){text};
    between_real.glShaderSource(shader, 1, parts, NULL);
    (void)lengths;
}

static void GL_APIENTRY draw_elements(GLenum mode, GLsizei count, GLenum type, const void *indices)
{
    if (!(lies("indices are cut") && type == GL_UNSIGNED_INT))
        between_real.glDrawElements(mode, count, type, indices);
}

static void GL_APIENTRY tex_image(GLenum target, GLint level, GLint internal, GLsizei width, GLsizei height,
                                  GLint border, GLenum format, GLenum type, const void *pixels)
{
    texture_type = type;
    between_real.glTexImage2D(target, level, internal, width, height, border, format, type, pixels);
}

static void GL_APIENTRY renderbuffer_storage(GLenum target, GLenum format, GLsizei width, GLsizei height)
{
    storage = format;
    depth_holder = 0;
    between_real.glRenderbufferStorage(target, format, width, height);
}

static void GL_APIENTRY framebuffer_renderbuffer(GLenum target, GLenum attachment, GLenum kind, GLuint name)
{
    if (lies("depth is not shared") && name == depth_holder)
        return;
    depth_holder = attachment == GL_DEPTH_ATTACHMENT && storage == GL_DEPTH_COMPONENT16 ? name : 0;
    between_real.glFramebufferRenderbuffer(target, attachment, kind, name);
}

static void GL_APIENTRY framebuffer_texture(GLenum target, GLenum attachment, GLenum kind, GLuint name, GLint level)
{
    if (!(lies("depth textures stay empty") && attachment == GL_DEPTH_ATTACHMENT))
        between_real.glFramebufferTexture2D(target, attachment, kind, name, level);
}

static GLenum GL_APIENTRY framebuffer_status(GLenum target)
{
    if ((lies("packed is incomplete") && storage == 0x88F0) ||
        (lies("rgba8 is incomplete") && texture_type == GL_UNSIGNED_BYTE) ||
        (lies("565 is incomplete") && texture_type == GL_UNSIGNED_SHORT_5_6_5) ||
        (lies("rgba4 is incomplete") && texture_type == GL_UNSIGNED_SHORT_4_4_4_4) ||
        (lies("rgb5a1 is incomplete") && texture_type == GL_UNSIGNED_SHORT_5_5_5_1))
        return GL_FRAMEBUFFER_UNSUPPORTED;
    return between_real.glCheckFramebufferStatus(target);
}

static void GL_APIENTRY query_result(GLuint query, GLenum name, GLuint *value)
{
    between_real.glGetQueryObjectuivEXT(query, name, value);
    if (lies("queries never end") && name == 0x8867)
        *value = 0;
}

static void GL_APIENTRY discard(GLenum target, GLsizei count, const GLenum *names)
{
    between_real.glDiscardFramebufferEXT(target, count, names);
    if (lies("discard takes colour too"))
        between_real.glClear(GL_COLOR_BUFFER_BIT);
}

static gn_proc replace(const char *name, gn_proc found)
{
    static const between list[] = {{"glStencilOp", (gn_proc)stencil_op},
                                   {"glStencilOpSeparate", (gn_proc)stencil_op_separate},
                                   {"glEnable", (gn_proc)enable},
                                   {"glBlendEquation", (gn_proc)blend_equation},
                                   {"glBlendFuncSeparate", (gn_proc)blend_func_separate},
                                   {"glUniform4fv", (gn_proc)uniform4fv},
                                   {"glShaderSource", (gn_proc)shader_source},
                                   {"glDrawElements", (gn_proc)draw_elements},
                                   {"glTexImage2D", (gn_proc)tex_image},
                                   {"glRenderbufferStorage", (gn_proc)renderbuffer_storage},
                                   {"glFramebufferRenderbuffer", (gn_proc)framebuffer_renderbuffer},
                                   {"glFramebufferTexture2D", (gn_proc)framebuffer_texture},
                                   {"glCheckFramebufferStatus", (gn_proc)framebuffer_status},
                                   {"glGetQueryObjectuivEXT", (gn_proc)query_result},
                                   {"glDiscardFramebufferEXT", (gn_proc)discard}};

    return between_take(name, found, list, sizeof list / sizeof list[0]);
}

/* What a scene's first light's mask looks like while a lie is told. Returns stage_plan()'s status. */
static int draw(const char *path, const char *told, const char *hide, double finite_far, gn_capability c, int proven,
                uint8_t *rgba, char message[SCENE_MESSAGE])
{
    const stage_options options = {.platform = test_platform(),
                                   .width = WIDTH,
                                   .height = HEIGHT,
                                   .depth_bits = 24,
                                   .stencil_bits = 8,
                                   .hide = hide,
                                   .finite_far = finite_far,
                                   .replace = replace};
    const stage_wish wish = {.method = GN_METHOD_AUTO, .casting = 1, .light_count = 1, .unbounded = 1};
    scene loaded;
    stage *s;
    int status;

    lie = told;
    texture_type = storage = 0;
    depth_holder = 0;
    assert_true(scene_load(&loaded, path, NULL, message));
    assert_int_equal(stage_open(&s, &loaded, &options, message), 0);
    if (c != GN_CAPABILITY_COUNT) {
        if (gn_target_can(&s->target, c) != proven)
            fail_msg("%s: %s is %s", told, gn_capability_name(c), proven ? gn_gles_symptom(s->gles, c) : "proven");
        assert_true((gn_gles_symptom(s->gles, c)[0] != '\0') == !proven);
        if (!proven)
            print_message("           %s: %s\n", told, gn_gles_symptom(s->gles, c));
    }
    stage_pose(s, 0, 0);
    status = stage_plan(s, &wish, message);
    if (status == 0) {
        assert_true(stage_draw_mask(s, 0, message));
        assert_true(platform_read_back(s->platform, rgba));
        assert_int_equal(s->gl->glGetError(), GL_NO_ERROR);
    }
    stage_close(s);
    scene_free(&loaded);
    return status;
}

static const struct {
    const char *lie;
    gn_capability found_out;
    const char *hide;
    double finite_far;
    const char *refused; /* with these words; NULL: the frame is right */
    int moves;           /* pixels on edges that may differ from the truthful frame: volumes end elsewhere */
} told[] = {
    {"wrap is dropped", GN_CAN_STENCIL_WRAP, NULL, 0, NULL, 0},
    {"wrap is dropped on two sides", GN_CAN_TWO_SIDED_STENCIL, NULL, 0, NULL, 0},
    {"wrap is dropped by failing depth", GN_CAN_STENCIL_WRAP, NULL, 0, NULL, 0},
    {"wrap is dropped by failing depth on two sides", GN_CAN_TWO_SIDED_STENCIL, NULL, 0, NULL, 0},
    {"stencil is null", GN_CAN_STENCIL, NULL, 0, NULL, 20},
    {"depth is null", GN_CAN_DEPTH, NULL, 0, "needs depth, which fails its proof", 0},
    {"back state is ignored", GN_CAN_TWO_SIDED_STENCIL, NULL, 0, NULL, 0},
    {"w = 0 is clipped", GN_CAN_W0, NULL, 0, NULL, 20},
    {"w = 0 is clipped", GN_CAN_W0, "depth-clamp", 0, NULL, 20},
    {"clamp is ignored", GN_CAN_DEPTH_CLAMP, NULL, 0, NULL, 0},
    {"clamp is ignored", GN_CAN_DEPTH_CLAMP, NULL, 100, NULL, 20},
    {"clamp is ignored", GN_CAN_DEPTH_CLAMP, NULL, 6, "no end of the volume lies before the far plane at 6", 0},
    {"alpha reads as 1", GN_CAN_ALPHA, NULL, 0, NULL, 0},
    {"subtract is missing", GN_CAN_BLEND_SUBTRACT, NULL, 0, NULL, 0},
    {"min and max are missing", GN_CAN_BLEND_MINMAX, NULL, 0, NULL, 0},
    {"halves round up", GN_CAN_BLEND_ROUNDING, NULL, 0, NULL, 0},
    {"facing is inverted", GN_CAN_FRONT_FACING, NULL, 0, NULL, 0},
    {"highp is mediump", GN_CAN_FRAGMENT_HIGHP, NULL, 0, NULL, 0},
    {"indices are cut", GN_CAN_UINT_INDICES, NULL, 0, NULL, 0},
    {"scissor is ignored", GN_CAN_PARTIAL_CLEAR, NULL, 0, NULL, 0},
    {"rgba8 is incomplete", GN_CAN_FBO_RGBA8, NULL, 0, NULL, 0},
    {"rgba8 is incomplete", GN_CAN_SHARED_DEPTH, NULL, 0, NULL, 0}, /* needs the other */
    {"rgba4 is incomplete", GN_CAN_FBO_RGBA4, NULL, 0, NULL, 0},
    {"rgb5a1 is incomplete", GN_CAN_FBO_RGB5A1, NULL, 0, NULL, 0},
    {"565 is incomplete", GN_CAN_FBO_RGB565, NULL, 0, NULL, 0},
    {"packed is incomplete", GN_CAN_PACKED_DEPTH_STENCIL, NULL, 0, NULL, 0},
    {"depth is not shared", GN_CAN_SHARED_DEPTH, NULL, 0, NULL, 0},
    {"depth textures stay empty", GN_CAN_DEPTH_TEXTURE, NULL, 0, NULL, 0},
    {"sampling does not compile", GN_CAN_DEPTH_TEXTURE, NULL, 0, NULL, 0},
    {"queries never end", GN_CAN_TIMER_QUERY, NULL, 0, NULL, 0},
    {"discard takes colour too", GN_CAN_DISCARD, NULL, 0, NULL, 0},
};

static void every_lie_is_found_out(void **state)
{
    static const char *const scenes[] = {"build/scenes/cube_point.gltf", "build/scenes/colours.gltf"};
    static uint8_t truthful[4 * WIDTH * HEIGHT], rgba[4 * WIDTH * HEIGHT];
    char message[SCENE_MESSAGE];

    (void)state;
    for (size_t sc = 0; sc < sizeof scenes / sizeof scenes[0]; sc++)
        for (size_t i = 0; i < sizeof told / sizeof told[0]; i++) {
            int differing = 0, status;

            assert_int_equal(draw(scenes[sc], "", told[i].hide, 0, told[i].found_out, 1, truthful, message), 0);
            status =
                draw(scenes[sc], told[i].lie, told[i].hide, told[i].finite_far, told[i].found_out, 0, rgba, message);
            if (told[i].refused) {
                assert_int_equal(status, 3);
                if (!strstr(message, told[i].refused))
                    fail_msg("%s: \"%s\" does not say \"%s\"", told[i].lie, message, told[i].refused);
                continue;
            }
            if (status != 0)
                fail_msg("%s: %s", told[i].lie, message);
            for (int p = 0; p < WIDTH * HEIGHT; p++)
                differing += memcmp(truthful + 4 * p, rgba + 4 * p, 4) != 0;
            if (differing > told[i].moves)
                fail_msg("%s: %d pixels differ", told[i].lie, differing);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_lie_is_found_out)};

    return cmocka_run_group_tests_name("lies", tests, NULL, NULL);
}
