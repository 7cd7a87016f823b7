/* gni_gles.h - what the files of gles/ share with each other and with nobody else. */
#ifndef GNI_GLES_H
#define GNI_GLES_H
#include "gnomon_gles.h"

/* The GL state of a pass, as data (state.c sends the difference). */
typedef struct gni_face {
    GLenum depth_fail, depth_pass; /* stencil operations, 0 for KEEP; failing the stencil test keeps */
} gni_face;

typedef struct gni_state {
    GLboolean color_write, depth_write;
    GLuint stencil_write;
    GLenum depth_func;   /* 0: no depth test */
    GLenum stencil_func; /* 0: no stencil test */
    GLint stencil_reference;
    GLuint stencil_mask; /* bits that are compared */
    gni_face front, back;
    GLenum blend_source, blend_destination; /* 0, 0: no blending */
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
#define GNI_DEPTH_BOUNDS     0x8890 /* GL_DEPTH_BOUNDS_TEST_EXT */

#define GNI_SYMPTOM 96

/* First vertices in gn_gles.quad, six each: a quad over the target; its corners at w = 0; the upper two alone so. */
enum { GNI_QUAD, GNI_FAR_QUAD = 6, GNI_WALL = 12 };

/* volume.vert over a way of flat.frag. */
typedef struct gni_program {
    GLuint name;
    GLint near_matrix, far_matrix;
    GLint color, side; /* where that way has them */
} gni_program;

struct gn_gles {
    gn_context *context;
    gn_port port; /* the context's */
    gn_gl gl;
    int forgotten;
    GLuint quad, indices, cached; /* cached: of a shadow cache */
    uint32_t cache_id;            /* what is in it, of which version, and how large it is */
    uint32_t cache_version, cached_capacity;
    gni_program colored, counted; /* in one colour, and in none */
    gni_program sided;            /* discards one side of triangles, in no colour; its name is 0 until it is made */
    const gni_program *in_use;    /* while volumes are drawn */
    const gn_mesh *pointed;       /* attribute 0 is at this one's chunk; NULL: elsewhere */
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

/* state.c. What is no enumerant where its extension is not there: touched by plans that ask for it. */
#define GNI_SWITCH_BOUNDS (1u << 6)
#define GNI_SWITCH_CLAMP  (1u << 7)

/* Sends what differs from what was last sent since gni_reset_state(). */
void gni_set_state(gn_gles *g, const gni_state *wanted);
/* Sends the state that is the same in all passes, and forgets the rest: the host may have changed anything. */
void gni_reset_state(gn_gles *g);
void gni_leave_state(gn_gles *g); /* as in a new context */

/* program.c: 0 on failure; the driver's log goes to the port under the name given. Attribute 0 is a_position. defines:
 * lines for the fragment shader, "" mostly. */
GLuint gni_make_program(gn_gles *g, const char *name, const char *defines, const char *vertex, const char *fragment);

/* Of flat.frag's ways, by its defines. 0 on failure. */
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

/* saved.c: 1 when the text is of this driver and target and knows all that is offered now; then proven, mediump_bits
 * and the symptoms are what it says. */
int gni_read_saved(gn_gles *g, const char *saved, gn_target *target);

/* proofs/proofs.c: draws into the bound framebuffer, reads back, and fills proven, mediump_bits and the symptoms.
 * Leaves any GL state. */
void gni_prove(gn_gles *g, gn_target *target);
#endif
