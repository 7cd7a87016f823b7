/* gn_glsl.h - what the host pastes into its shaders: the one statement of positions, and how a light's pass reads masks
 * (GLSL ES 1.00).
 *
 * Positions are compared for equality between passes (DESIGN.md, decision 4): every shader that draws a surface computes
 * gl_Position by GN_GLSL_POSITION, pasted after the #version and precision lines of its vertex shader.
 *
 * Masks, whatever kind they are: paste GN_GLSL_MASK_VERTEX into the vertex shader and call gn_mask_place() with what is
 * written to gl_Position; paste GN_GLSL_MASK_FRAGMENT into the fragment shader and multiply light i of the pass
 * (gn_step.lights[i]) with channel i of gn_mask(). Where gn_plan.mask is GN_MASK_TEXTURE and the step says receivers, a
 * program with GN_MASKED defined before both, and the texture gn_gles_mask() bound to the unit in the uniform
 * gn_mask_texture. Else, without GN_MASKED, the mask is 1, and stencil test or blending do the rest. Defined with it:
 *
 *     GN_UPSAMPLED    masks upsampled by depth (gn_plan.carries_depth). Uniforms gn_mask_depth and gn_mask_size: the
 *                     plan's mask_depth and mask_size
 *     GN_SHARPENED    what lies between 0 and 1 is narrowed to a pixel of the frame: uniforms gn_mask_sharpness, the
 *                     plan's scale, and gn_mask_size. Under a bilinear texture four places are read and averaged first,
 *                     so that edges that the small mask has in steps are straight again
 *     GN_MEDIUMP      places are mediump even where fragment shaders have highp
 *     GN_DEPTH_COLOR  in place of GN_MASKED, in a GN_DRAW_DEPTH of a plan that carries depth: the colour to write is
 *                     gn_mask_depth_color(). Uniform gn_mask_depth
 *
 * By depth, each of the four masks around counts the more the less its depth differs from the receiver's own; all as by
 * bilinear where they lie in its plane: depth is linear on the image of a plane, so interpolated it is then the
 * receiver's, however it slopes. Half floats cannot tell where between four texels they are (DESIGN.md, decision 12):
 * there, and where edges are sharpened, four places about the pixel are read straight from varyings, turned so that the
 * mask nearest to it is read twice. That takes four varying vectors of the host's, and a float; the other ways one and a
 * float. */
#ifndef GN_GLSL_H
#define GN_GLSL_H

#define GN_GLSL_POSITION                                                                                               \
    "vec4 gn_position(highp mat4 gn_matrix, highp vec3 gn_vertex)\n"                                                   \
    "{\n"                                                                                                              \
    "    return gn_matrix * vec4(gn_vertex, 1.0);\n"                                                                   \
    "}\n"

/* What both shaders must agree upon. */
#define GN_GLSL_MASK_WAYS                                                                                              \
    "#if defined(GL_FRAGMENT_PRECISION_HIGH) && !defined(GN_MEDIUMP)\n"                                                \
    "#define GN_PLACE highp\n"                                                                                         \
    "#define GN_ALIKE vec2(0.001, 0.00003)\n"                                                                          \
    "#else\n"                                                                                                          \
    "#define GN_PLACE mediump\n"                                                                                       \
    "#define GN_ALIKE vec2(0.004, 0.0002)\n"                                                                           \
    "#define GN_HALF_FLOATS\n"                                                                                         \
    "#endif\n"                                                                                                         \
    "#ifdef GN_MASKED\n"                                                                                               \
    "#if defined(GN_UPSAMPLED) && (defined(GN_SHARPENED) || defined(GN_HALF_FLOATS))\n"                                \
    "#define GN_MASK_TAPS vec4(0.5, 0.1, -0.1, 0.5)\n"                                                                 \
    "#elif defined(GN_SHARPENED)\n"                                                                                    \
    "#define GN_MASK_TAPS vec4(0.4, 0.4, -0.4, 0.4)\n"                                                                 \
    "#endif\n"                                                                                                         \
    "#endif\n"                                                                                                         \
    "#if defined(GN_DEPTH_COLOR) || (defined(GN_MASKED) && !defined(GN_MASK_TAPS))\n"                                  \
    "#define GN_MASK_PLACE\n"                                                                                          \
    "#endif\n"                                                                                                         \
    "#if defined(GN_UPSAMPLED) || defined(GN_DEPTH_COLOR)\n"                                                           \
    "#define GN_MASK_DEPTH\n"                                                                                          \
    "#endif\n"

#define GN_GLSL_MASK_VERTEX                                                                                            \
    GN_GLSL_MASK_WAYS                                                                                                  \
    "#ifdef GN_MASK_PLACE\n"                                                                                           \
    "varying highp vec3 gn_mask_at;\n"                                                                                 \
    "#endif\n"                                                                                                         \
    "#ifdef GN_MASK_DEPTH\n"                                                                                           \
    "uniform highp vec2 gn_mask_depth;\n"                                                                              \
    "varying highp float gn_mask_over_w;\n"                                                                            \
    "#endif\n"                                                                                                         \
    "#ifdef GN_MASK_TAPS\n"                                                                                            \
    "uniform highp vec2 gn_mask_size;\n"                                                                               \
    "varying highp vec3 gn_mask_a, gn_mask_b, gn_mask_c, gn_mask_d;\n"                                                 \
    "#endif\n"                                                                                                         \
    "void gn_mask_place(highp vec4 gn_clip)\n"                                                                         \
    "{\n"                                                                                                              \
    "#if defined(GN_MASKED) || defined(GN_DEPTH_COLOR)\n"                                                              \
    "    highp vec3 gn_at = vec3(0.5 * (gn_clip.xy + gn_clip.ww), gn_clip.w);\n"                                       \
    "#endif\n"                                                                                                         \
    "#ifdef GN_MASK_PLACE\n"                                                                                           \
    "    gn_mask_at = gn_at;\n"                                                                                        \
    "#endif\n"                                                                                                         \
    "#ifdef GN_MASK_DEPTH\n"                                                                                           \
    "    gn_mask_over_w = gn_mask_depth.x + gn_mask_depth.y * gn_clip.z;\n"                                            \
    "#endif\n"                                                                                                         \
    "#ifdef GN_MASK_TAPS\n"                                                                                            \
    "    highp vec4 gn_taps = GN_MASK_TAPS;\n"                                                                         \
    "    highp vec3 gn_one = vec3(gn_taps.xy * (gn_clip.w / gn_mask_size), 0.0);\n"                                    \
    "    highp vec3 gn_other = vec3(gn_taps.zw * (gn_clip.w / gn_mask_size), 0.0);\n"                                  \
    "    gn_mask_a = gn_at + gn_one;\n"                                                                                \
    "    gn_mask_b = gn_at - gn_one;\n"                                                                                \
    "    gn_mask_c = gn_at + gn_other;\n"                                                                              \
    "    gn_mask_d = gn_at - gn_other;\n"                                                                              \
    "#endif\n"                                                                                                         \
    "}\n"

#define GN_GLSL_MASK_FRAGMENT                                                                                          \
    GN_GLSL_MASK_WAYS                                                                                                  \
    "#ifdef GN_MASK_PLACE\n"                                                                                           \
    "varying GN_PLACE vec3 gn_mask_at;\n"                                                                              \
    "#endif\n"                                                                                                         \
    "#ifdef GN_MASK_DEPTH\n"                                                                                           \
    "varying GN_PLACE float gn_mask_over_w;\n"                                                                         \
    "#endif\n"                                                                                                         \
    "#ifdef GN_MASK_TAPS\n"                                                                                            \
    "varying GN_PLACE vec3 gn_mask_a, gn_mask_b, gn_mask_c, gn_mask_d;\n"                                              \
    "#endif\n"                                                                                                         \
    "#ifdef GN_DEPTH_COLOR\n"                                                                                          \
    "GN_PLACE vec4 gn_mask_depth_color()\n"                                                                            \
    "{\n"                                                                                                              \
    "    GN_PLACE float gn_steps = 255.0 * min(gn_mask_over_w / gn_mask_at.z, 1.0);\n"                                 \
    "    return vec4(1.0, 1.0, floor(gn_steps) / 255.0, fract(gn_steps));\n"                                           \
    "}\n"                                                                                                              \
    "#endif\n"                                                                                                         \
    "#ifdef GN_MASKED\n"                                                                                               \
    "uniform GN_PLACE sampler2D gn_mask_texture;\n"                                                                    \
    "#ifdef GN_SHARPENED\n"                                                                                            \
    "uniform mediump float gn_mask_sharpness;\n"                                                                       \
    "#endif\n"                                                                                                         \
    "#if defined(GN_UPSAMPLED) && !defined(GN_MASK_TAPS)\n"                                                            \
    "uniform GN_PLACE vec2 gn_mask_size;\n"                                                                            \
    "#endif\n"                                                                                                         \
    "#ifdef GN_UPSAMPLED\n"                                                                                            \
    "GN_PLACE vec3 gn_mask_texel(GN_PLACE vec4 gn_read)\n"                                                             \
    "{\n"                                                                                                              \
    "    return vec3(gn_read.rg, gn_read.b + gn_read.a / 255.0);\n"                                                    \
    "}\n"                                                                                                              \
    "mediump vec4 gn_mask_read()\n"                                                                                    \
    "{\n"                                                                                                              \
    "#ifdef GN_MASK_TAPS\n"                                                                                            \
    "    GN_PLACE float gn_own = min(gn_mask_over_w / gn_mask_a.z, 1.0);\n"                                            \
    "#else\n"                                                                                                          \
    "    GN_PLACE float gn_own = min(gn_mask_over_w / gn_mask_at.z, 1.0);\n"                                           \
    "#endif\n"                                                                                                         \
    "    GN_PLACE float gn_alike = GN_ALIKE.x * gn_own + GN_ALIKE.y;\n"                                                \
    "#ifdef GN_MASK_TAPS\n"                                                                                            \
    "    GN_PLACE vec3 gn_a = gn_mask_texel(texture2DProj(gn_mask_texture, gn_mask_a));\n"                             \
    "    GN_PLACE vec3 gn_b = gn_mask_texel(texture2DProj(gn_mask_texture, gn_mask_b));\n"                             \
    "    GN_PLACE vec3 gn_c = gn_mask_texel(texture2DProj(gn_mask_texture, gn_mask_c));\n"                             \
    "    GN_PLACE vec3 gn_d = gn_mask_texel(texture2DProj(gn_mask_texture, gn_mask_d));\n"                             \
    "    GN_PLACE vec4 gn_part = vec4(0.25);\n"                                                                        \
    "#else\n"                                                                                                          \
    "    GN_PLACE vec2 gn_at = gn_mask_at.xy / gn_mask_at.z * gn_mask_size - 0.5;\n"                                   \
    "    GN_PLACE vec2 gn_low = floor(gn_at), gn_in = gn_at - gn_low, gn_step = 1.0 / gn_mask_size;\n"                 \
    "    GN_PLACE vec2 gn_first = (gn_low + 0.5) * gn_step;\n"                                                         \
    "    GN_PLACE vec3 gn_a = gn_mask_texel(texture2D(gn_mask_texture, gn_first));\n"                                  \
    "    GN_PLACE vec3 gn_b = gn_mask_texel(texture2D(gn_mask_texture, gn_first + vec2(gn_step.x, 0.0)));\n"           \
    "    GN_PLACE vec3 gn_c = gn_mask_texel(texture2D(gn_mask_texture, gn_first + vec2(0.0, gn_step.y)));\n"           \
    "    GN_PLACE vec3 gn_d = gn_mask_texel(texture2D(gn_mask_texture, gn_first + gn_step));\n"                        \
    "    GN_PLACE vec4 gn_part = vec4((1.0 - gn_in.y) * (1.0 - gn_in.x), (1.0 - gn_in.y) * gn_in.x,\n"                 \
    "                                 gn_in.y * (1.0 - gn_in.x), gn_in.y * gn_in.x);\n"                                \
    "#endif\n"                                                                                                         \
    "    GN_PLACE vec4 gn_depth = vec4(gn_a.z, gn_b.z, gn_c.z, gn_d.z);\n"                                             \
    "    GN_PLACE vec4 gn_weight = gn_part / (gn_alike + abs(gn_depth - gn_own));\n"                                   \
    "    gn_weight /= dot(gn_weight, vec4(1.0));\n"                                                                    \
    "    gn_weight = abs(dot(gn_depth, gn_part) - gn_own) < gn_alike ? gn_part : gn_weight;\n"                         \
    "    return vec4(gn_weight.x * gn_a.xy + gn_weight.y * gn_b.xy + gn_weight.z * gn_c.xy + gn_weight.w * gn_d.xy,\n" \
    "                1.0, 1.0);\n"                                                                                     \
    "}\n"                                                                                                              \
    "#elif defined(GN_MASK_TAPS)\n"                                                                                    \
    "mediump vec4 gn_mask_read()\n"                                                                                    \
    "{\n"                                                                                                              \
    "    return 0.25 * (texture2DProj(gn_mask_texture, gn_mask_a) + texture2DProj(gn_mask_texture, gn_mask_b) +\n"     \
    "                   texture2DProj(gn_mask_texture, gn_mask_c) + texture2DProj(gn_mask_texture, gn_mask_d));\n"     \
    "}\n"                                                                                                              \
    "#else\n"                                                                                                          \
    "mediump vec4 gn_mask_read()\n"                                                                                    \
    "{\n"                                                                                                              \
    "    return texture2DProj(gn_mask_texture, gn_mask_at);\n"                                                         \
    "}\n"                                                                                                              \
    "#endif\n"                                                                                                         \
    "#endif\n"                                                                                                         \
    "mediump vec4 gn_mask()\n"                                                                                         \
    "{\n"                                                                                                              \
    "#ifndef GN_MASKED\n"                                                                                              \
    "    return vec4(1.0);\n"                                                                                          \
    "#elif defined(GN_SHARPENED)\n"                                                                                    \
    "    return clamp(gn_mask_sharpness * (gn_mask_read() - 0.5) + 0.5, 0.0, 1.0);\n"                                  \
    "#else\n"                                                                                                          \
    "    return gn_mask_read();\n"                                                                                     \
    "#endif\n"                                                                                                         \
    "}\n"
#endif
