/* gni_gles.h - what the files of gles/ share with each other and with nobody else. */
#ifndef GNI_GLES_H
#define GNI_GLES_H
#include "gnomon_gles.h"

/* The GL state of a pass, as data (state.c sends the difference). */
typedef struct gni_face {
    GLenum depth_fail, depth_pass; /* stencil operations; failing the stencil test keeps */
} gni_face;

typedef struct gni_state {
    GLboolean color_write, depth_write;
    GLenum depth_func;   /* 0: no depth test */
    GLenum stencil_func; /* 0: no stencil test. Reference 0, all bits */
    GLuint stencil_write;
    gni_face front, back;
    GLenum blend_source, blend_destination; /* 0, 0: no blending */
    int offset;                             /* depth steps by which triangles are moved away from the eye */
} gni_state;

typedef struct gni_upload {
    const gn_mesh *mesh;
    GLuint buffer;
} gni_upload;

struct gn_gles {
    gn_context *context;
    gn_port port; /* the context's */
    gn_gl gl;
    int forgotten;
    GLuint program, quad, indices;
    GLint near_matrix, far_matrix, color;
    GLuint attribute_arrays;
    gni_upload *uploads; /* sorted by address */
    uint32_t upload_count, upload_capacity;
    const gn_plan *plan; /* the one begun last */
    uint32_t at;         /* its next step */
    gni_state state;     /* what was last sent */
    unsigned tests_on;   /* depth 1, stencil 2, blending 4, offset 8 */
    int state_is_known;
};

/* state.c: sends what differs from what was last sent since gni_reset_state(). */
void gni_set_state(gn_gles *g, const gni_state *wanted);
/* Sends the state that is the same in all passes, and forgets the rest: the host may have changed anything. */
void gni_reset_state(gn_gles *g);
void gni_leave_state(gn_gles *g); /* as in a new context */

/* program.c: 0 on failure; the driver's log goes to the port under the name given. Attribute 0 is a_position. */
GLuint gni_make_program(gn_gles *g, const char *name, const char *vertex, const char *fragment);

/* buffers.c */
const gni_upload *gni_find_upload(const gn_gles *g, const gn_mesh *mesh);

/* volumes.c: draws records with the state as it is; `turned` draws the part of the caps that counts the other way
 * round. */
void gni_begin_volumes(gn_gles *g, const float color[4]);
void gni_draw_record(gn_gles *g, const gn_plan *plan, const gn_record *record, int turned);
void gni_end_volumes(gn_gles *g);
#endif
