/* gnomon_gles.h - walks a plan with OpenGL ES 2.0: counts volumes into the stencil buffer and hands the host its own
 * drawing, step by step, with the state for it already set.
 *
 *     gn_gles_begin(gl, plan);
 *     while (gn_gles_next(gl, &step))
 *         switch (step.draw) {
 *         case GN_DRAW_AMBIENT: draw_everything(AMBIENT);                       break;
 *         case GN_DRAW_LIGHT:   draw_lit(step.lights, step.receivers);          break;
 *         case GN_DRAW_FINAL:   draw_transparent_and_labels();                  break;
 *         case GN_DRAW_DEPTH:   draw_everything(DEPTH);                         break;  masks in textures
 *         case GN_DRAW_LIT:     draw_everything(ALL_LIGHT);                     break;  frames that are dimmed
 *         }
 *
 * Positions: depth is compared for equality between the host's passes and ours, so every shader that draws an object's
 * surface computes its position by GN_GLSL_POSITION, from vertices less the mesh's centre (gn_mesh_info.centre), with
 * gn_plan_object.matrix.
 *
 * In a light's passes only objects need be drawn whose gn_plan_caster.is_lit says so. Masks in textures have gn_plan.mask_size,
 * and a light in each channel: GN_GLSL_MASK_VERTEX and GN_GLSL_MASK_FRAGMENT read them.
 *
 * GL state. Between gn_gles_begin() and the end of the walk the host may change anything but the bound framebuffer.
 *
 *     on entry   the framebuffer that the plan's target describes is bound, to draw and to read; no GL error is
 *                pending; the depth range is 0 to 1, and depth clamp, sample coverage and sample alpha to coverage are
 *                off, as in a new context; for plans with masks in textures, or refined, no sampler object on unit 0 and no buffer
 *                to unpack pixels from (OpenGL ES 3). Any other state
 *     clear      before the first step but DEPTH colour (to the host's clear colour), depth and, if the plan counts there,
 *                stencil are cleared, unmasked
 *     DEPTH      depth test LESS, depth written; no colour written (where the plan carries depth all of it, dither off); stencil test and blending off. A framebuffer object
 *                of the library's own is bound, unless the plan has no image
 *     AMBIENT    depth test LESS, depth written; stencil test and blending off. After a DEPTH into the target: EQUAL, and
 *     LIT        depth not written
 *     LIGHT      depth test EQUAL, depth not written; blending ONE, ONE; receivers: stencil test EQUAL to the light's
 *                stencil.reference, stencil not written; the others: stencil test off. A plan that has blend_once:
 *                stencil test EQUAL for both, and INCR where it passes. Scissor test on where the light's scissor is
 *                not the whole target, around all of them where they are several; depth bounds test where its depth bounds are not 0
 *                and 1. Under a mask in alpha: blending DST_ALPHA, ONE for colour; alpha is not written, or by
 *                blend_once ZERO, ZERO. Under one in a texture: no stencil test
 *     FINAL      depth test LESS, depth not written; blending SRC_ALPHA, ONE_MINUS_SRC_ALPHA; stencil test off
 *     in each    viewport 0, 0 and gn_plan.viewport, the target's size where masks are not smaller (in a DEPTH that is not
 *                into the target gn_plan.mask_size); colour written (but where said); the target's framebuffer
 *                bound (but where said); where counts are made in colour, or refined, dither on; culling, polygon offset and depth clamp
 *                off, and so are scissor test and depth bounds test but in LIGHT; front face CCW; blend equation ADD;
 *                no program in use; no buffer bound; all vertex attribute arrays disabled
 *     on exit    after gn_gles_next() has returned 0: all of these, cull face, polygon offset, depth clamp, depth
 *                bounds, clear depth and clear stencil are as in a new context, but the viewport and the scissor's box,
 *                which are the target's; the target's framebuffer is bound. Of plans that count in colour, or refine, dither is on
 *                and the target's alpha 1 if the count was there; with masks in textures, or refined, TEXTURE0 is active,
 *                without a 2D texture, from the first step after them on; where gn_gles_begin() made images no renderbuffer is
 *                bound. Nothing else was ever touched: other textures, clear colour, pixel store, attribute pointers
 *                but that of array 0
 *
 * Errors come as gn_result, sentences from gn_message() of the context; drivers' logs go to its port. Walking allocates
 * nothing and asks GL nothing, but where gn_gles_begin() makes images: for the first plan that needs them, or others. */
#ifndef GNOMON_GLES_H
#define GNOMON_GLES_H
#include "gn_gl.h"
#include "gn_glsl.h"
#include "gnomon.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct gn_gles gn_gles;

/* Start from {0}. */
typedef struct gn_gles_desc {
    gn_get_proc get_proc;
    void *user;       /* its first argument */
    const char *hide; /* capabilities to pretend absent: names with commas between. Borrowed for the call. [none] */
} gn_gles_desc;

/* Loads the functions, compiles the programs, makes the buffers. The GL context must be current, here and in every
 * call below but gn_gles_forget(). Leaves the state as gn_gles_next() does on exit. What the port's setting GNOMON_HIDE
 * names is hidden too. Returns GN_OK; GN_E_ARG, also for the name of no capability; GN_E_MEMORY; GN_E_DEVICE when a
 * function is missing or a shader is refused. *gl is NULL unless GN_OK. */
gn_result gn_gles_create(gn_context *context, const gn_gles_desc *desc, gn_gles **gl);

/* Deletes what create and upload made. After gn_gles_forget() without any GL call. */
void gn_gles_destroy(gn_gles *gl);

/* The context is lost, or gone: drops all GL names without a GL call. Then only gn_gles_destroy() is left. */
void gn_gles_forget(gn_gles *gl);

/* The functions that it calls, for hosts that want the same table. Lives as long as gl. */
const gn_gl *gn_gles_functions(const gn_gles *gl);

/* Finds out what the bound framebuffer is and what can be done there: bits, what is advertised, and, by drawing and
 * reading back, what is proven. Once for each target: the contents of the framebuffer are lost, and the GL waits. GL
 * state is as before; on entry the framebuffer is bound to draw and to read, depth clamp is off, no GL error is
 * pending, no query of time runs, and pixels are not packed into a buffer.
 *
 * width, height  of the framebuffer, which the GL does not tell
 * saved          a text of gn_gles_save_target(): if it is of this driver and such a target, nothing is drawn. Anything
 *                else, NULL too, is passed over; a library without the feature proofs refuses it
 * Tells the port's log of each capability that is found, by drawing, to be advertised and to fail. Framebuffers that
 * cannot be read as plain levels (multisampled objects, floats, integers, sRGB), and those under 16 pixels wide or
 * high, are proven on a framebuffer object of 8 bits a channel, 24 of depth and 8 of stencil; what blending does to
 * levels that are not plain counts as not advertised. Returns GN_OK; GN_E_ARG; GN_E_DEVICE when the framebuffer is not
 * complete. A library without the feature culling asks for no extension. */
gn_result gn_gles_describe_target(gn_gles *gl, uint32_t width, uint32_t height, const char *saved, gn_target *target);

/* What a failed proof saw, in the target described last: "0 - 1 is not 255 (0 255 0 255)". "" when it did not fail. */
const char *gn_gles_symptom(const gn_gles *gl, gn_capability capability);

/* Writes what was proven of the target described last as a text of some lines, to be given back on the next start. Like
 * snprintf: always terminated when capacity > 0; returns the length that the whole has. Not there without proofs. */
size_t gn_gles_save_target(const gn_gles *gl, const gn_target *target, char *text, size_t capacity);

/* Puts a mesh into buffers: 32 bytes a chunk vertex (near and far), 6 a triangle. Once before the first plan that has
 * it, and again after each gn_mesh_update(). The mesh must outlive its upload. Returns GN_OK (also when it was there
 * already), GN_E_ARG, GN_E_MEMORY, GN_E_DEVICE. */
gn_result gn_gles_upload(gn_gles *gl, const gn_mesh *mesh);
void gn_gles_unload(gn_gles *gl, const gn_mesh *mesh); /* does nothing for one that is not there */

/* Starts a frame: checks that every caster of the plan is uploaded (and what is on a patch, or thin) and sends the plan's indices. The first plan that
 * counts one side at a time, or in colour, also has shaders compiled, and one with masks in textures has images made, of
 * the target's size: kept until a plan needs others. The plan must stay until the walk has ended. Returns GN_OK; GN_E_ARG, also for a plan
 * with masks of an earlier frame that are gone;
 * GN_E_MEMORY; GN_E_DEVICE when a shader or a framebuffer is refused. */
gn_result gn_gles_begin(gn_gles *gl, const gn_plan *plan);

/* Does what the plan says up to the next step that is the host's. Returns 1 with that step, or 0 at the frame's end. */
int gn_gles_next(gn_gles *gl, gn_step *step);

/* The GL's name of a mask texture of the plan last begun (gn_step.mask), of gn_plan.mask_size, to be bound for a light's
 * pass; 0 for what is none. Channel i is 1 where gn_step.lights[i] reaches, else 0. Its filter is LINEAR with
 * GN_UPSAMPLE_BILINEAR at scale 2 or 4, else NEAREST; it lives until gn_gles_begin() has a plan that needs others. */
uint32_t gn_gles_mask(const gn_gles *gl, uint32_t mask);

/* Draws the volumes of some records of the plan last begun in one colour, each in its scissor, to look at or to
 * count. Depth, stencil, blending, masks and culling are the host's; depth clamp is on where a record needs it and off
 * afterwards; scissor, program, buffers and attribute arrays as on exit above. */
void gn_gles_draw_volumes(gn_gles *gl, const gn_plan *plan, uint32_t first_record, uint32_t record_count,
                          const float color[4]);

#ifdef __cplusplus
}
#endif
#endif
