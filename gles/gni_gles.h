/* gni_gles.h - what the files of gles/ share with each other and with nobody else. */
#ifndef GNI_GLES_H
#define GNI_GLES_H
#include "gni_features.h"
#include "gnomon_gles.h"

/* The GL state of a pass, as data (state.c sends the difference). */
typedef struct gni_face {
    GLenum depth_fail, depth_pass; /* stencil operations, 0 for KEEP; failing the stencil test keeps */
} gni_face;

typedef struct gni_state {
    unsigned color_mask; /* channels that are written: red 1, green 2, blue 4, alpha 8 */
    GLboolean depth_write;
    GLuint stencil_write;
    GLenum depth_func;   /* 0: no depth test */
    GLenum stencil_func; /* 0: no stencil test */
    GLint stencil_reference;
    GLuint stencil_mask; /* bits that are compared */
    gni_face front, back;
    GLenum blend_source, blend_destination; /* 0, 0: no blending */
    GLenum alpha_source, alpha_destination; /* of alpha, where they differ: 0, 0: they are the same. GNI_ZERO for 0 */
    GLenum blend_equation;                  /* 0: ADD */
    int undithered;                         /* only in plans that may switch it */
    GLenum cull;                            /* the faces that are not drawn; 0: all are */
    int offset;                             /* depth steps by which triangles are moved away from the eye */
    const uint32_t *scissor;                /* x, y, width, height; NULL: no scissor test */
    const double *bounds;                   /* of depth, least and most; NULL: no test */
    int clamp;                              /* depth out of range is clamped */
} gni_state;

typedef struct gni_upload {
    const gn_mesh *mesh;
    GLuint buffer, surface; /* vertices; indices of all triangles as they are drawn */
    uint32_t shape;         /* of the mesh when they were sent */
} gni_upload;

/* Of extensions that gl2.h does not know; desktop OpenGL has the same numbers. */
#define GNI_DEPTH_CLAMP      0x864F
#define GNI_DEPTH24_STENCIL8 0x88F0
#define GNI_DEPTH24          0x81A6 /* GL_DEPTH_COMPONENT24_OES */
#define GNI_MAX              0x8008 /* GL_MAX_EXT */
#define GNI_DEPTH_BOUNDS     0x8890 /* GL_DEPTH_BOUNDS_TEST_EXT */

#define GNI_SYMPTOM 96

/* First vertices in gn_gles.quad, six each: a quad over the target; its corners at w = 0; the upper two alone so. */
enum { GNI_QUAD, GNI_FAR_QUAD = 6, GNI_WALL = 12 };

/* volume.vert over a way of flat.frag. */
typedef struct gni_program {
    GLuint name;
    GLint near_matrix, far_matrix;
    GLint color, side, back; /* where that way has them */
} gni_program;

/* quad.vert over a shader that reads a texture. */
typedef struct gni_reader {
    GLuint name;
    GLint texture, weights, level, unused, dimmed, step;
} gni_reader;

/* fallback/refine.c */
int gni_make_refining_programs(gn_gles *g, const char *defines); /* 0 on failure */
void gni_find_edges(gn_gles *g); /* of the depth in the first mask, into the one that is bound */
void gni_refine_step(gn_gles *g, const gn_step *step);

/* fallback/images.c: what counts and masks are made in, of the size and kind of the plan begun last. */
typedef struct gni_images {
    gn_image image;
    gn_format mask_format;
    gn_upsample upsample;
    int carries_depth;
    uint32_t width, height, mask_count, mask_capacity;
    GLuint borrowed;                  /* the depth renderbuffer that is the target's */
    GLuint framebuffer, count, depth; /* count: a texture; 0 where the image's colour is a mask */
    GLuint mask_framebuffer, *masks;  /* [mask_capacity] textures */
    GLuint attached;                  /* to the framebuffer that was bound last, of the masks */
} gni_images;

struct gn_gles {
    gn_context *context;
    gn_port port; /* the context's */
    gn_gl gl;
    int forgotten;
    GLuint quad, indices, cached; /* cached: of a shadow cache */
    uint32_t cache_id;            /* what is in it, of which version, and how large it is */
    uint32_t cache_version, cached_capacity;
    uint32_t kept_masks[2];         /* of which cache and version the masks are; 0 where none are whole */
    gni_program colored, counted;   /* in one colour, and in none */
    gni_program sided;              /* discards one side of triangles, in no colour; its name is 0 until it is made */
    gni_program sided_color, faced; /* the same in one colour; a colour a side: as are they */
    gni_reader resolve, shade, carry, edges, agree; /* and they */
    gni_images images;
    gn_into into;              /* what is bound */
    uint32_t box[4];           /* around the lights of the pass at hand */
    uint32_t scissor[4];       /* that was last sent */
    const gni_program *in_use; /* while volumes are drawn */
    const gn_mesh *pointed;    /* attribute 0 is at this one's chunk; NULL: elsewhere */
    uint32_t pointed_chunk;
    GLuint bound_indices; /* while volumes are drawn */
    GLuint attribute_arrays;
    gni_upload *uploads; /* sorted by address */
    uint32_t upload_count, upload_capacity;
    uint32_t hidden;                                 /* set of gn_capability */
    char symptoms[GN_CAPABILITY_COUNT][GNI_SYMPTOM]; /* of the target described last: what its failed proofs saw */
    const gn_plan *plan;                             /* the one begun last */
    uint32_t at;                                     /* its next step */
    gni_state state;                                 /* what was last sent */
    unsigned tests_on;                               /* of state.c's switches */
    int state_is_known;
    unsigned may_switch; /* of state.c's switches: those that this plan may touch */
};

#define GNI_ZERO 0xffffu /* GL_ZERO, where 0 means otherwise */

/* state.c. What is no enumerant where its extension is not there: touched by plans that ask for it. */
#define GNI_SWITCH_BOUNDS (1u << 6)
#define GNI_SWITCH_CLAMP  (1u << 7)
#define GNI_SWITCH_DITHER (1u << 8)

/* All is written, and nothing tested. */
extern const gni_state gni_unmasked;
/* Sends what differs from what was last sent since gni_reset_state(). */
void gni_set_state(gn_gles *g, const gni_state *wanted);
/* Sends the state that is the same in all passes, and forgets the rest: the host may have changed anything. */
void gni_reset_state(gn_gles *g);
void gni_leave_state(gn_gles *g); /* as in a new context */

/* program.c: 0 on failure; the driver's log goes to the port under the name given. Attribute 0 is a_position. defines:
 * lines for both shaders, "" mostly. */
GLuint gni_make_program(gn_gles *g, const char *name, const char *defines, const char *vertex, const char *fragment);

/* quad.vert over another. 0 on failure. */
int gni_make_reader(gn_gles *g, gni_reader *out, const char *name, const char *defines, const char *fragment);

/* Of flat.frag's ways, by its defines; NULL: over counted.frag. 0 on failure. */
int gni_make_flat_program(gn_gles *g, gni_program *out, const char *name, const char *defines);

/* buffers.c */
const gni_upload *gni_find_upload(const gn_gles *g, const gn_mesh *mesh);
void gni_delete_upload(gn_gles *g, const gni_upload *upload);

/* volumes.c: draws records with the state as it is; `turned` draws the part of the caps that counts the other way
 * round. */
void gni_begin_volumes(gn_gles *g, const gni_program *program);
void gni_draw_record(gn_gles *g, const gn_plan *plan, const gn_record *record, int turned);
void gni_draw_surface(gn_gles *g, const gn_plan_object *object); /* the object itself, by the same program */
void gni_end_volumes(gn_gles *g);

/* quad.c. Nothing outside a light's bounds is lit: its passes stay in its scissor or in one within, and where the driver
 * can within its depths. */
void gni_bound(gni_state *s, const gn_plan *plan, const gn_plan_light *light, const uint32_t scissor[4]);
/* A quad over the step's light's part of the target, or all of it; color NULL: none is written. */
void gni_fill_quad(gn_gles *g, const gn_step *step, gni_state state, const float color[4]);
/* A program that reads a texture, for gni_draw_reader(); uniforms of its own may be set between. */
void gni_use_reader(gn_gles *g, const gni_reader *reader, GLuint texture);
void gni_draw_reader(gn_gles *g, const gn_step *step, gni_state state);

/* Which faces a draw counts: both at once, else those that count up, then the others. */
typedef enum gni_half { GNI_BOTH, GNI_RISING, GNI_FALLING } gni_half;

/* Counts the records of one caster from first to end. */
typedef void gni_count(gn_gles *g, uint32_t first, uint32_t end, gni_half half);
/* volumes.c: a step's records, caster by caster, up first: what is on the way is one caster's only. */
void gni_count_casters(gn_gles *g, const gn_step *step, int both_sides, gni_count *count);

/* stencil.c: counts in the stencil of whatever is bound. */
gni_state gni_stencil_light(const gn_plan *plan, const gn_plan_light *light, gni_state unmasked);
/* Where the count is the light's, or is not (GL_NOTEQUAL): nothing else is set. */
gni_state gni_where_count(const gn_plan_light *light, GLenum func);
void gni_stencil_step(gn_gles *g, const gn_step *step);
/* A patch's name, in the bits above count and flag. */
GLint gni_patch_name(const gn_stencil_layout *layout, uint32_t patch);
int gni_backs_rise(const gn_record *r, int turned);
int gni_shows_backs(const gn_record *r, int turned, gni_half half);

/* walk.c */
void gni_set_viewport(gn_gles *g); /* of what is bound */

/* fallback/color.c: the same in colour. */
int gni_make_color_programs(gn_gles *g, const gn_plan *plan); /* those that it needs; 0 on failure */
void gni_color_step(gn_gles *g, const gn_step *step);

/* fallback/masks.c: steps that make masks into textures, or dim the frame by masks. */
void gni_mask_step(gn_gles *g, const gn_step *step);

/* fallback/images.c: makes what the plan needs and is not there. */
gn_result gni_prepare_images(gn_gles *g, const gn_plan *plan);
void gni_delete_images(gn_gles *g);
/* Binds what the step draws into. */
void gni_bind_for(gn_gles *g, const gn_step *step);

/* host_state.c: keeps what proofs disturb, and puts it back. */
typedef struct gni_host_state {
    GLint switches[9], stencil[2][7], viewport[4], scissor[4], color_mask[4];
    GLenum blend[6];
    GLfloat clear_color[4], clear_depth, depth_range[2], offset[2];
    GLint clear_stencil, depth_mask, pack, unpack;
    GLenum depth_func, front_face, cull_mode, active_texture;
    GLuint program, array_buffer, element_buffer, framebuffer, renderbuffer, texture;
    uint32_t arrays; /* those enabled */
    GLint array_size, array_type, array_normalized, array_stride, array_source;
    void *array_pointer;
} gni_host_state;
void gni_keep_host(const gn_gles *g, gni_host_state *kept);
void gni_put_host_back(const gn_gles *g, const gni_host_state *kept);

/* advertised.c: a set of gn_capability; reads the target's bits. */
uint32_t gni_advertised(const gn_gles *g, const gn_target *target);
/* Bits of depth that a renderbuffer may have. */
int gni_image_depth(const gn_gles *g);

/* saved.c: 1 when the text is of this driver and target and knows all that is offered now; then proven, mediump_bits
 * and the symptoms are what it says. */
int gni_read_saved(gn_gles *g, const char *saved, gn_target *target);

/* proofs/proofs.c: draws into the bound framebuffer, reads back, and fills proven, mediump_bits and the symptoms.
 * Leaves any GL state. */
void gni_prove(gn_gles *g, gn_target *target);
#endif
