/* test_state.c - the GL state that gnomon_gles.h promises, on a real driver: all of it is read before, at each step,
 * and after, from a context whose every state was turned away from its default first. */
#include "device.h"
#include "frame.h"

#include <stdlib.h>
#include <string.h>

#define SIZE 32

static test_device device;
static gn_context *context;
static gn_gles *gles;
static const gn_gl *gl;

/* State that has one or several numbers, all of it: of OpenGL ES 2.0, tables 6.2 to 6.20, less strings and
 * constants. */
static const struct {
    GLenum name;
    int count;
    int touched; /* the header says what it is on exit */
} states[] = {
    {GL_ARRAY_BUFFER_BINDING, 1, 1},
    {GL_ELEMENT_ARRAY_BUFFER_BINDING, 1, 1},
    {GL_VIEWPORT, 4, 1},
    {GL_DEPTH_RANGE, 2, 0},
    {GL_LINE_WIDTH, 1, 0},
    {GL_CULL_FACE, 1, 1},
    {GL_CULL_FACE_MODE, 1, 1},
    {GL_FRONT_FACE, 1, 1},
    {GL_POLYGON_OFFSET_FACTOR, 1, 1},
    {GL_POLYGON_OFFSET_UNITS, 1, 1},
    {GL_POLYGON_OFFSET_FILL, 1, 1},
    {GL_SAMPLE_ALPHA_TO_COVERAGE, 1, 0},
    {GL_SAMPLE_COVERAGE, 1, 0},
    {GL_SAMPLE_COVERAGE_VALUE, 1, 0},
    {GL_SAMPLE_COVERAGE_INVERT, 1, 0},
    {GL_ACTIVE_TEXTURE, 1, 0},
    {GL_TEXTURE_BINDING_2D, 1, 0},
    {GL_TEXTURE_BINDING_CUBE_MAP, 1, 0},
    {GL_SCISSOR_TEST, 1, 1},
    {GL_SCISSOR_BOX, 4, 0},
    {GL_STENCIL_TEST, 1, 1},
    {GL_STENCIL_FUNC, 1, 1},
    {GL_STENCIL_VALUE_MASK, 1, 1},
    {GL_STENCIL_REF, 1, 1},
    {GL_STENCIL_FAIL, 1, 1},
    {GL_STENCIL_PASS_DEPTH_FAIL, 1, 1},
    {GL_STENCIL_PASS_DEPTH_PASS, 1, 1},
    {GL_STENCIL_BACK_FUNC, 1, 1},
    {GL_STENCIL_BACK_VALUE_MASK, 1, 1},
    {GL_STENCIL_BACK_REF, 1, 1},
    {GL_STENCIL_BACK_FAIL, 1, 1},
    {GL_STENCIL_BACK_PASS_DEPTH_FAIL, 1, 1},
    {GL_STENCIL_BACK_PASS_DEPTH_PASS, 1, 1},
    {GL_DEPTH_TEST, 1, 1},
    {GL_DEPTH_FUNC, 1, 1},
    {GL_BLEND, 1, 1},
    {GL_BLEND_SRC_RGB, 1, 1},
    {GL_BLEND_SRC_ALPHA, 1, 1},
    {GL_BLEND_DST_RGB, 1, 1},
    {GL_BLEND_DST_ALPHA, 1, 1},
    {GL_BLEND_EQUATION_RGB, 1, 1},
    {GL_BLEND_EQUATION_ALPHA, 1, 1},
    {GL_BLEND_COLOR, 4, 0},
    {GL_DITHER, 1, 0},
    {GL_COLOR_WRITEMASK, 4, 1},
    {GL_DEPTH_WRITEMASK, 1, 1},
    {GL_STENCIL_WRITEMASK, 1, 1},
    {GL_STENCIL_BACK_WRITEMASK, 1, 1},
    {GL_COLOR_CLEAR_VALUE, 4, 0},
    {GL_DEPTH_CLEAR_VALUE, 1, 1},
    {GL_STENCIL_CLEAR_VALUE, 1, 1},
    {GL_FRAMEBUFFER_BINDING, 1, 0},
    {GL_RENDERBUFFER_BINDING, 1, 0},
    {GL_UNPACK_ALIGNMENT, 1, 0},
    {GL_PACK_ALIGNMENT, 1, 0},
    {GL_CURRENT_PROGRAM, 1, 1},
    {GL_GENERATE_MIPMAP_HINT, 1, 0},
};
enum { STATES = sizeof states / sizeof states[0] };

typedef struct snapshot {
    GLfloat values[STATES][4];
    GLint arrays[16];
} snapshot;

static void take(snapshot *s)
{
    GLint arrays = 0;

    memset(s, 0, sizeof *s);
    for (int i = 0; i < STATES; i++)
        gl->glGetFloatv(states[i].name, s->values[i]);
    gl->glGetIntegerv(GL_MAX_VERTEX_ATTRIBS, &arrays);
    for (GLint i = 0; i < arrays && i < 16; i++)
        gl->glGetVertexAttribiv((GLuint)i, GL_VERTEX_ATTRIB_ARRAY_ENABLED, &s->arrays[i]);
    assert_int_equal(gl->glGetError(), GL_NO_ERROR);
}

static GLfloat value_of(const snapshot *s, GLenum name)
{
    for (int i = 0; i < STATES; i++)
        if (states[i].name == name)
            return s->values[i][0];
    fail_msg("state 0x%04x is not in the table", name);
    return 0;
}

/* Everything away from its default, so that nothing is right by chance. */
static void disturb(void)
{
    static const GLenum capabilities[] = {GL_CULL_FACE,    GL_POLYGON_OFFSET_FILL, GL_SCISSOR_TEST,
                                          GL_STENCIL_TEST, GL_DEPTH_TEST,          GL_BLEND};

    for (size_t i = 0; i < sizeof capabilities / sizeof capabilities[0]; i++)
        gl->glEnable(capabilities[i]);
    gl->glDisable(GL_DITHER);
    gl->glCullFace(GL_FRONT);
    gl->glFrontFace(GL_CW);
    gl->glPolygonOffset(3, 4);
    gl->glScissor(1, 2, 3, 4);
    gl->glStencilFuncSeparate(GL_FRONT, GL_NEVER, 3, 5);
    gl->glStencilFuncSeparate(GL_BACK, GL_LESS, 4, 6);
    gl->glStencilOpSeparate(GL_FRONT_AND_BACK, GL_INVERT, GL_INVERT, GL_REPLACE);
    gl->glStencilMask(0x55);
    gl->glDepthFunc(GL_GREATER);
    gl->glDepthMask(GL_FALSE);
    gl->glColorMask(GL_FALSE, GL_TRUE, GL_FALSE, GL_TRUE);
    gl->glBlendFunc(GL_DST_COLOR, GL_ONE_MINUS_DST_ALPHA);
    gl->glBlendEquation(GL_FUNC_SUBTRACT);
    gl->glClearColor(0.25f, 0.5f, 0.75f, 0.5f);
    gl->glClearDepthf(0.5f);
    gl->glClearStencil(77);
    gl->glViewport(5, 6, 7, 8);
    gl->glPixelStorei(GL_PACK_ALIGNMENT, 2);
    gl->glActiveTexture(GL_TEXTURE3);
    for (GLuint i = 0; i < 8; i++)
        gl->glEnableVertexAttribArray(i);
}

static void expect(const snapshot *s, GLenum name, GLfloat wanted, const char *where)
{
    if (value_of(s, name) != wanted)
        fail_msg("%s: state 0x%04x is %g, not %g", where, name, (double)value_of(s, name), (double)wanted);
}

static void check_step(const gn_step *step)
{
    static const char *const names[] = {"nothing", "ambient", "light", "final"};
    const char *const where = names[step->draw];
    snapshot s;

    take(&s);
    expect(&s, GL_DEPTH_TEST, 1, where);
    expect(&s, GL_DEPTH_FUNC, step->draw == GN_DRAW_LIGHT ? GL_EQUAL : GL_LESS, where);
    expect(&s, GL_DEPTH_WRITEMASK, step->draw == GN_DRAW_AMBIENT, where);
    expect(&s, GL_BLEND, step->draw != GN_DRAW_AMBIENT, where);
    expect(&s, GL_STENCIL_TEST, step->draw == GN_DRAW_LIGHT && step->receivers, where);
    if (step->draw == GN_DRAW_LIGHT) {
        expect(&s, GL_BLEND_SRC_RGB, GL_ONE, where);
        expect(&s, GL_BLEND_DST_RGB, GL_ONE, where);
    }
    if (step->draw == GN_DRAW_LIGHT && step->receivers) {
        expect(&s, GL_STENCIL_FUNC, GL_EQUAL, where);
        expect(&s, GL_STENCIL_REF, 0, where);
        expect(&s, GL_STENCIL_WRITEMASK, 0, where);
    }
    if (step->draw == GN_DRAW_FINAL) {
        expect(&s, GL_BLEND_SRC_RGB, GL_SRC_ALPHA, where);
        expect(&s, GL_BLEND_DST_RGB, GL_ONE_MINUS_SRC_ALPHA, where);
    }
    expect(&s, GL_COLOR_WRITEMASK, 1, where);
    expect(&s, GL_CULL_FACE, 0, where);
    expect(&s, GL_SCISSOR_TEST, 0, where);
    expect(&s, GL_POLYGON_OFFSET_FILL, 0, where);
    expect(&s, GL_FRONT_FACE, GL_CCW, where);
    expect(&s, GL_BLEND_EQUATION_RGB, GL_FUNC_ADD, where);
    expect(&s, GL_CURRENT_PROGRAM, 0, where);
    expect(&s, GL_ARRAY_BUFFER_BINDING, 0, where);
    expect(&s, GL_ELEMENT_ARRAY_BUFFER_BINDING, 0, where);
    for (int i = 0; i < 16; i++)
        assert_int_equal(s.arrays[i], 0);
}

/* Undoes disturb(), but for what the library touches. */
static void make_fresh(void)
{
    gl->glEnable(GL_DITHER);
    gl->glActiveTexture(GL_TEXTURE0);
}

static gn_target described(void)
{
    gn_target t;

    assert_int_equal(gn_gles_describe_target(gles, SIZE, SIZE, NULL, &t), GN_OK);
    return t;
}

static void the_promised_state_holds(void **state)
{
    snapshot fresh, before, after;
    test_frame f;
    gn_step step;
    int steps = 0;

    (void)state;
    take(&fresh); /* gn_gles_create left it as in a new context */
    assert_int_equal(test_frame_make(&f, context, gles, described()), GN_OK);
    f.objects[1].flags &= ~(unsigned)GN_RECEIVES;
    assert_int_equal(gn_plan_make(context, &f.scene, f.memory, f.size, &f.plan), GN_OK);
    disturb();
    take(&before);
    for (int i = 0; i < STATES; i++) /* a state that disturb() forgot would prove nothing */
        if (states[i].touched && states[i].name != GL_ARRAY_BUFFER_BINDING &&
            states[i].name != GL_ELEMENT_ARRAY_BUFFER_BINDING && states[i].name != GL_CURRENT_PROGRAM)
            assert_memory_not_equal(before.values[i], fresh.values[i], sizeof fresh.values[i]);
    assert_int_equal(gn_gles_begin(gles, f.plan), GN_OK);
    while (gn_gles_next(gles, &step)) {
        check_step(&step);
        disturb();
        steps++;
    }
    assert_int_equal(steps, 6);
    take(&after);
    for (int i = 0; i < STATES; i++) {
        const GLfloat *wanted = states[i].touched ? fresh.values[i] : before.values[i];

        if (states[i].name == GL_VIEWPORT || states[i].name == GL_SCISSOR_BOX) {
            const GLfloat whole[4] = {0, 0, SIZE, SIZE};

            assert_memory_equal(after.values[i], whole, sizeof whole);
        } else if (memcmp(after.values[i], wanted, sizeof after.values[i]) != 0) {
            fail_msg("on exit state 0x%04x is %g, not %g", states[i].name, (double)after.values[i][0],
                     (double)wanted[0]);
        }
    }
    for (int i = 0; i < 16; i++)
        assert_int_equal(after.arrays[i], 0);
    test_frame_drop(&f, gles);
}

/* In a step of a plan that counts in colour. */
static void check_color_step(const gn_step *step, const gn_plan *plan, GLfloat target)
{
    const char *const where = gn_plan_method_name(plan, 0);
    const int is_after_depth = plan->mask == GN_MASK_TEXTURE && plan->image.format == GN_FORMAT_NONE;
    snapshot s;

    take(&s);
    expect(&s, GL_DITHER, 1, where);
    expect(&s, GL_STENCIL_TEST, 0, where);
    expect(&s, GL_CULL_FACE, 0, where);
    expect(&s, GL_POLYGON_OFFSET_FILL, 0, where);
    expect(&s, GL_BLEND_EQUATION_RGB, GL_FUNC_ADD, where);
    expect(&s, GL_BLEND_EQUATION_ALPHA, GL_FUNC_ADD, where);
    expect(&s, GL_COLOR_WRITEMASK, step->draw != GN_DRAW_DEPTH, where);
    if (step->draw == GN_DRAW_DEPTH && plan->image.format != GN_FORMAT_NONE)
        assert_true(value_of(&s, GL_FRAMEBUFFER_BINDING) != target);
    else
        expect(&s, GL_FRAMEBUFFER_BINDING, target, where);
    if (step->draw == GN_DRAW_AMBIENT) {
        expect(&s, GL_DEPTH_FUNC, is_after_depth ? GL_EQUAL : GL_LESS, where);
        expect(&s, GL_DEPTH_WRITEMASK, !is_after_depth, where);
        expect(&s, GL_BLEND, 0, where);
    }
    if (step->draw == GN_DRAW_LIGHT) {
        expect(&s, GL_DEPTH_FUNC, GL_EQUAL, where);
        expect(&s, GL_BLEND_DST_RGB, GL_ONE, where);
        expect(&s, GL_BLEND_SRC_RGB, plan->mask == GN_MASK_ALPHA && step->receivers ? GL_DST_ALPHA : GL_ONE, where);
    }
}

/* Every way to count in colour, and stencils taken to a texture; and each way to use the masks. */
static void the_promised_state_holds_in_colour(void **state)
{
    static const struct {
        gn_method method;
        uint32_t hidden;
        gn_shade shade;
    } ways[] = {
        {GN_METHOD_COUNT, 0, GN_SHADE_ADDITIVE},  {GN_METHOD_COUNT, 1u << GN_CAN_FRONT_FACING, GN_SHADE_BLACK},
        {GN_METHOD_SIGNED, 0, GN_SHADE_ADDITIVE}, {GN_METHOD_SIGNED, 1u << GN_CAN_ALPHA, GN_SHADE_ATTENUATE},
        {GN_METHOD_ALPHA, 0, GN_SHADE_ATTENUATE}, {GN_METHOD_ALPHA, 1u << GN_CAN_BLEND_MINMAX, GN_SHADE_ATTENUATE},
        {GN_METHOD_SCREEN, 0, GN_SHADE_ADDITIVE}, {GN_METHOD_STENCIL, 0, GN_SHADE_ADDITIVE},
        {GN_METHOD_REFINE, 0, GN_SHADE_ADDITIVE}, {GN_METHOD_REFINE, 0, GN_SHADE_ATTENUATE}};

    (void)state;
    for (size_t way = 0; way < sizeof ways / sizeof ways[0]; way++) {
        snapshot fresh, before, after;
        gn_light lights[3];
        test_frame f;
        gn_step step;

        make_fresh();
        take(&fresh);
        assert_int_equal(test_frame_make(&f, context, gles, described()), GN_OK);
        memcpy(lights, f.lights, 2 * sizeof lights[0]);
        lights[2] = lights[0];
        f.scene.lights = lights;
        f.scene.light_count = 3;
        f.scene.reads_masks = f.scene.merges_lights = 1;
        f.scene.method = ways[way].method;
        f.scene.shade = ways[way].shade;
        f.scene.discards = 1;
        f.scene.target.hidden |= ways[way].hidden;
        f.memory = realloc(f.memory, gn_plan_bound(&f.scene));
        f.size = gn_plan_bound(&f.scene);
        assert_int_equal(gn_plan_make(context, &f.scene, f.memory, f.size, &f.plan), GN_OK);
        disturb();
        take(&before);
        assert_int_equal(gn_gles_begin(gles, f.plan), GN_OK);
        while (gn_gles_next(gles, &step)) {
            if (ways[way].method >= GN_METHOD_COUNT)
                check_color_step(&step, f.plan, value_of(&fresh, GL_FRAMEBUFFER_BINDING));
            disturb();
        }
        take(&after);
        for (int i = 0; i < STATES; i++) {
            const int is_texture = states[i].name == GL_ACTIVE_TEXTURE && f.plan->mask_count > 0;
            const int is_fresh = states[i].touched || states[i].name == GL_DITHER || is_texture;

            if (states[i].name == GL_VIEWPORT || states[i].name == GL_SCISSOR_BOX)
                continue;
            if (memcmp(after.values[i], is_fresh ? fresh.values[i] : before.values[i], sizeof after.values[i]) != 0)
                fail_msg("way %lu: on exit state 0x%04x is %g", (unsigned long)way, states[i].name,
                         (double)after.values[i][0]);
        }
        test_frame_drop(&f, gles);
    }
}

/* Proofs draw, bind, enable: the host sees none of it. Everything is away from its default, and bound. */
static void proofs_leave_no_trace(void **state)
{
    static const float vertices[8] = {0};
    snapshot before, after;
    GLuint buffers[2], texture, renderbuffer;
    GLint array[2][6];
    void *pointer[2];

    (void)state;
    disturb();
    gl->glDepthRangef(0.25f, 0.75f);
    gl->glEnable(GL_SAMPLE_COVERAGE);
    gl->glEnable(GL_SAMPLE_ALPHA_TO_COVERAGE);
    gl->glGenBuffers(2, buffers);
    gl->glBindBuffer(GL_ARRAY_BUFFER, buffers[0]);
    gl->glBufferData(GL_ARRAY_BUFFER, sizeof vertices, vertices, GL_STATIC_DRAW);
    gl->glVertexAttribPointer(0, 2, GL_SHORT, GL_TRUE, 20, (const void *)8);
    gl->glBindBuffer(GL_ARRAY_BUFFER, buffers[1]);
    gl->glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers[0]);
    gl->glGenTextures(1, &texture);
    gl->glActiveTexture(GL_TEXTURE0);
    gl->glBindTexture(GL_TEXTURE_2D, texture);
    gl->glActiveTexture(GL_TEXTURE3);
    gl->glGenRenderbuffers(1, &renderbuffer);
    gl->glBindRenderbuffer(GL_RENDERBUFFER, renderbuffer);
    gl->glDisableVertexAttribArray(2);
    gl->glPixelStorei(GL_UNPACK_ALIGNMENT, 8);
    for (int pass = 0; pass < 2; pass++) {
        static const GLenum names[6] = {GL_VERTEX_ATTRIB_ARRAY_SIZE,           GL_VERTEX_ATTRIB_ARRAY_TYPE,
                                        GL_VERTEX_ATTRIB_ARRAY_NORMALIZED,     GL_VERTEX_ATTRIB_ARRAY_STRIDE,
                                        GL_VERTEX_ATTRIB_ARRAY_BUFFER_BINDING, GL_VERTEX_ATTRIB_ARRAY_ENABLED};

        take(pass ? &after : &before);
        for (int i = 0; i < 6; i++)
            gl->glGetVertexAttribiv(0, names[i], &array[pass][i]);
        gl->glGetVertexAttribPointerv(0, GL_VERTEX_ATTRIB_ARRAY_POINTER, &pointer[pass]);
        if (!pass)
            assert_true(described().proven != 0);
    }
    for (int i = 0; i < STATES; i++)
        if (memcmp(before.values[i], after.values[i], sizeof before.values[i]) != 0)
            fail_msg("state 0x%04x was %g and is %g", states[i].name, (double)before.values[i][0],
                     (double)after.values[i][0]);
    assert_memory_equal(before.arrays, after.arrays, sizeof before.arrays);
    assert_memory_equal(array[0], array[1], sizeof array[0]);
    assert_ptr_equal(pointer[0], pointer[1]);
    gl->glActiveTexture(GL_TEXTURE0);
    {
        GLint bound = 0;

        gl->glGetIntegerv(GL_TEXTURE_BINDING_2D, &bound);
        assert_int_equal(bound, texture);
    }
    gl->glDeleteTextures(1, &texture);
    gl->glDeleteRenderbuffers(1, &renderbuffer);
    gl->glDeleteBuffers(2, buffers);
}

/* The target's bits are those that the platform says it gave. */
static void the_target_is_described(void **state)
{
    const gn_target t = described();

    (void)state;
    assert_int_equal(t.stencil_bits, device.platform->actual.stencil_bits);
    assert_int_equal(t.depth_bits, device.platform->actual.depth_bits);
    assert_int_equal(t.alpha_bits, device.platform->actual.alpha_bits);
    assert_int_equal(t.red_bits, 8);
    assert_int_equal(t.samples, 0);
}

static int open_on(const char *name)
{
    const int failed = test_open_device(&device, name, SIZE);

    context = device.context;
    gles = device.gles;
    gl = device.gl;
    return failed;
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
    return test_close_device(&device);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_promised_state_holds), cmocka_unit_test(the_promised_state_holds_in_colour),
        cmocka_unit_test(the_target_is_described), cmocka_unit_test(proofs_leave_no_trace)};

    return cmocka_run_group_tests_name("state, egl", tests, open_egl, close_it) +
           cmocka_run_group_tests_name("state, osmesa", tests, open_osmesa, close_it);
}
