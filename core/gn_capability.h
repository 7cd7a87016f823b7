/* gn_capability.h - what a GL context and the target that it draws into may be able to do, by name.
 *
 * A capability is advertised (by version, extension or bits), proven (drawn into a few pixels and read back), and
 * hidden (someone pretends that it is absent). Only what is proven and not hidden is used (DESIGN.md, decision 15). The
 * rooms above find out (gles/gnomon_gles.h); plans read. Sets are words with bit 1u << capability. */
#ifndef GN_CAPABILITY_H
#define GN_CAPABILITY_H
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Once each: the constant, the name that --hide takes, what it is. */
#define GN_CAPABILITIES(F)                                                                                             \
    F(GN_CAN_STENCIL, "stencil", "8 bits of stencil that test, replace and count")                                     \
    F(GN_CAN_STENCIL_WRAP, "stencil-wrap", "INCR_WRAP and DECR_WRAP")                                                  \
    F(GN_CAN_TWO_SIDED_STENCIL, "two-sided-stencil", "front and back faces count each their own way in one draw")      \
    F(GN_CAN_DEPTH, "depth", "a depth buffer that hides what is behind")                                               \
    F(GN_CAN_DEPTH_CLAMP, "depth-clamp", "depth out of range is clamped and not clipped")                              \
    F(GN_CAN_W0, "w0", "vertices at infinity, w = 0, are not clipped")                                                 \
    F(GN_CAN_ALPHA, "alpha", "alpha in the target, kept, and a factor of blending")                                    \
    F(GN_CAN_BLEND_SUBTRACT, "blend-subtract", "adding and REVERSE_SUBTRACT by single steps")                          \
    F(GN_CAN_BLEND_MINMAX, "blend-minmax", "MIN and MAX")                                                              \
    F(GN_CAN_BLEND_ROUNDING, "blend-rounding", "full, halved as often as there are bits, doubles back")                \
    F(GN_CAN_FRONT_FACING, "front-facing", "gl_FrontFacing")                                                           \
    F(GN_CAN_FBO_RGBA8, "fbo-rgba8", "framebuffer objects of 8, 8, 8, 8 bits")                                         \
    F(GN_CAN_FBO_RGBA4, "fbo-rgba4", "framebuffer objects of 4, 4, 4, 4 bits")                                         \
    F(GN_CAN_FBO_RGB5A1, "fbo-rgb5a1", "framebuffer objects of 5, 5, 5, 1 bits")                                       \
    F(GN_CAN_FBO_RGB565, "fbo-rgb565", "framebuffer objects of 5, 6, 5 bits")                                          \
    F(GN_CAN_PACKED_DEPTH_STENCIL, "packed-depth-stencil", "depth and stencil in one renderbuffer")                    \
    F(GN_CAN_SHARED_DEPTH, "shared-depth", "one depth renderbuffer under two framebuffer objects")                     \
    F(GN_CAN_DEPTH_TEXTURE, "depth-texture", "depth drawn into a texture")                                             \
    F(GN_CAN_UINT_INDICES, "uint-indices", "indices of 32 bits")                                                       \
    F(GN_CAN_FRAGMENT_HIGHP, "fragment-highp", "highp in fragment shaders, 16 bits of mantissa and more")              \
    F(GN_CAN_PARTIAL_CLEAR, "partial-clear", "clears under scissor and write masks")                                   \
    F(GN_CAN_TIMER_QUERY, "timer-query", "the time that drawing takes")                                                \
    F(GN_CAN_DISCARD, "discard", "buffers dropped after use")                                                          \
    F(GN_CAN_DEPTH_BOUNDS, "depth-bounds", "pixels whose depth is out of bounds are left out")

typedef enum gn_capability {
#define GN_CAPABILITY_CONSTANT(constant, name, summary) constant,
    GN_CAPABILITIES(GN_CAPABILITY_CONSTANT)
#undef GN_CAPABILITY_CONSTANT
        GN_CAPABILITY_COUNT
} gn_capability;

/* "" when it is not one of gn_capability. */
const char *gn_capability_name(gn_capability capability);
const char *gn_capability_summary(gn_capability capability);

/* Adds the capabilities of a list of names, separated by commas, to *set. NULL and "" are empty lists. Returns NULL, or
 * where the first name starts that is none; *set is then untouched. */
const char *gn_capability_parse(const char *list, uint32_t *set);

#ifdef __cplusplus
}
#endif
#endif
