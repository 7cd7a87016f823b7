/* advertised.c - what a driver says that it can do: by version, by whole words of its extensions, by bits of the
 * target.
 *
 * OSMesa's contexts are desktop OpenGL, so each row knows both families. */
#include "gni_gles.h"

#include <stdlib.h>
#include <string.h>

#define ALWAYS 20 /* as a version of OpenGL ES: all that gnomon runs on */
#define NEVER  999

static const struct {
    gn_capability capability;
    int es, desktop; /* from this version on, 10 times major plus minor */
    const char *extensions[3];
} rows[] = {
    {GN_CAN_DEPTH_CLAMP, NEVER, 32, {"GL_EXT_depth_clamp", "GL_ARB_depth_clamp", "GL_NV_depth_clamp"}},
    {GN_CAN_W0, ALWAYS, ALWAYS, {NULL}},
    {GN_CAN_BLEND_SUBTRACT, ALWAYS, ALWAYS, {NULL}},
    {GN_CAN_BLEND_MINMAX, 30, 14, {"GL_EXT_blend_minmax"}},
    {GN_CAN_BLEND_ROUNDING, ALWAYS, ALWAYS, {NULL}},
    {GN_CAN_FRONT_FACING, ALWAYS, ALWAYS, {NULL}},
    {GN_CAN_FBO_RGBA8, ALWAYS, ALWAYS, {NULL}},
    {GN_CAN_FBO_RGBA4, ALWAYS, ALWAYS, {NULL}},
    {GN_CAN_FBO_RGB5A1, ALWAYS, ALWAYS, {NULL}},
    {GN_CAN_FBO_RGB565, ALWAYS, ALWAYS, {NULL}},
    {GN_CAN_PACKED_DEPTH_STENCIL, 30, 30, {"GL_OES_packed_depth_stencil", "GL_EXT_packed_depth_stencil"}},
    {GN_CAN_SHARED_DEPTH, ALWAYS, ALWAYS, {NULL}},
    {GN_CAN_DEPTH_TEXTURE, 30, 14, {"GL_OES_depth_texture", "GL_ANGLE_depth_texture", "GL_ARB_depth_texture"}},
    {GN_CAN_UINT_INDICES, 30, 11, {"GL_OES_element_index_uint"}},
    {GN_CAN_PARTIAL_CLEAR, ALWAYS, ALWAYS, {NULL}},
    {GN_CAN_TIMER_QUERY, NEVER, 33, {"GL_EXT_disjoint_timer_query", "GL_ARB_timer_query"}},
    {GN_CAN_DEPTH_BOUNDS, NEVER, NEVER, {"GL_EXT_depth_bounds_test"}},
    {GN_CAN_DISCARD, NEVER, 43, {"GL_EXT_discard_framebuffer", "GL_ARB_invalidate_subdata"}},
};

static int has_word(const char *list, const char *word)
{
    const size_t length = strlen(word);

    for (const char *at = list; (at = strstr(at, word)) != NULL; at += length)
        if ((at == list || at[-1] == ' ') && (at[length] == ' ' || at[length] == '\0'))
            return 1;
    return 0;
}

/* 10 times major plus minor; negative for OpenGL ES. 0 when it cannot be read. */
static int version_of(const char *text)
{
    static const char es[] = "OpenGL ES ";
    const int is_es = strncmp(text, es, sizeof es - 1) == 0;
    char *end;
    const long major = strtol(text + (is_es ? sizeof es - 1 : 0), &end, 10);
    const long minor = *end == '.' ? strtol(end + 1, NULL, 10) : 0;

    if (major < 1 || major > 99 || minor < 0 || minor > 9)
        return 0;
    return (int)(is_es ? -1 : 1) * (int)(10 * major + minor);
}

static const char *text_of(const gn_gl *gl, GLenum name)
{
    const GLubyte *const text = gl->glGetString(name);

    return text ? (const char *)text : "";
}

/* By version and extensions. */
static uint32_t offered(const gn_gl *gl)
{
    const char *const extensions = text_of(gl, GL_EXTENSIONS);
    const int version = version_of(text_of(gl, GL_VERSION));
    GLint range[2] = {0, 0}, precision = 0;
    uint32_t set = 0;

    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        int is_there = version < 0 ? -version >= rows[i].es : version >= rows[i].desktop;

        for (int e = 0; e < 3 && rows[i].extensions[e]; e++)
            is_there |= has_word(extensions, rows[i].extensions[e]);
        set |= (uint32_t)is_there << rows[i].capability;
    }
    gl->glGetShaderPrecisionFormat(GL_FRAGMENT_SHADER, GL_HIGH_FLOAT, range, &precision);
    if (precision >= 16)
        set |= 1u << GN_CAN_FRAGMENT_HIGHP;
    return set;
}

uint32_t gni_advertised(const gn_gles *g, const gn_target *t)
{
    /* without culling no plan asks for an extension */
    uint32_t set = GNI_HAS_CULLING ? offered(&g->gl) : 1u << GN_CAN_W0 | 1u << GN_CAN_FRONT_FACING;

    if (t->stencil_bits >= 8)
        set |= 1u << GN_CAN_STENCIL | 1u << GN_CAN_STENCIL_WRAP | 1u << GN_CAN_TWO_SIDED_STENCIL;
    if (t->depth_bits > 0)
        set |= 1u << GN_CAN_DEPTH;
    if (t->alpha_bits > 0)
        set |= 1u << GN_CAN_ALPHA;
    if (t->samples > 0) /* a mask has one sample a pixel, and shares no depth with many */
        set &= ~(1u << GN_CAN_SHARED_DEPTH);
    return set;
}

int gni_image_depth(const gn_gles *g)
{
    const int version = version_of(text_of(&g->gl, GL_VERSION));

    return version > 0 || version <= -30 || has_word(text_of(&g->gl, GL_EXTENSIONS), "GL_OES_depth24") ? 24 : 16;
}
