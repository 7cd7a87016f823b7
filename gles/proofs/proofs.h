/* proofs.h - what the proofs share. A proof draws into a cell of 16x16 pixels of the target, or into a framebuffer
 * object of its own, and looks at the pixels afterwards.
 *
 * Cells lie side by side, as many as the target holds, and are read back together: waiting for the GL is what costs. A
 * target smaller than a cell shows a part of it; what is not seen is not asked for. */
#ifndef PROOFS_H
#define PROOFS_H
#include "gni_gles.h"

enum { CELL = 16 };

typedef struct gni_proofs {
    gn_gles *g;
    const gn_gl *gl;
    gn_target *target; /* proven and mediump_bits grow */
    uint32_t offered;  /* advertised and not hidden */
    uint32_t untried;  /* offered, and failed for want of another */
    /* The cell at hand: where it is, how much of it the target holds, and, once read, its pixels. */
    GLint x, y;
    int width, height;
    uint8_t pixels[CELL * CELL * 4];              /* [height][width][4] */
    int highp_bits, front_is_front, back_is_back; /* what the trial of shaders left */
    char *symptom;                                /* [GNI_SYMPTOM] of the proof at hand */
    /* What rectangles are drawn with: the program of volumes, or one of the proof's own. */
    GLuint program;
    GLint near_matrix, color;
} gni_proofs;

/* A proof in a cell. Both functions start from the state of a new context, with dither off. */
typedef struct gni_cell_proof {
    gn_capability capability;
    uint32_t uses;               /* capabilities that must be offered too, and proven */
    void (*draw)(gni_proofs *p); /* the cell is 0 in colour and stencil, 1 in depth */
    int (*holds)(gni_proofs *p); /* 1, or 0 having said why */
} gni_cell_proof;

extern const gni_cell_proof gni_proofs_of_stencil[3], gni_proofs_of_depth[3], gni_proofs_of_blending[4];
extern const gni_cell_proof gni_proofs_of_shaders[3];
extern const gni_cell_proof gni_trial_of_shaders; /* of no capability: those of shaders read what it left */

/* Those that no other may stand beside: 1, or 0 having said why. They start from the same state, the cell at hand being
 * the first, and may leave another framebuffer bound. */
typedef struct gni_lone_proof {
    gn_capability capability;
    uint32_t uses;
    uint32_t touches; /* capabilities of framebuffers of its own: whatever the target has, they must not be hidden */
    int (*holds)(gni_proofs *p);
} gni_lone_proof;

extern const gni_lone_proof gni_proofs_of_framebuffers[7], gni_proofs_of_extensions[3], gni_proof_of_partial_clears[1];

int gni_proofs_can(const gni_proofs *p, gn_capability c); /* offered */

/* A rectangle of the cell in one colour, at a depth of clip space: -1 nearest, 1 farthest. `back`: its back is seen. */
void gni_draw_rectangle(gni_proofs *p, int x, int y, int width, int height, float depth, int back,
                        const float color[4]);

/* The same from the corners (+-1, +-1, 0) by a matrix. */
void gni_draw_quad(gni_proofs *p, int x, int y, int width, int height, const float matrix[16], const float color[4]);

/* Rectangles are drawn with another fragment shader from here on: 1, or 0 when the GL refuses it. Its uniforms other
 * than u_color are the caller's to set. */
int gni_use_shader(gni_proofs *p, const char *name, const char *defines, const char *fragment);
GLint gni_uniform(const gni_proofs *p, const char *name);
void gni_use_own_shader(gni_proofs *p); /* and back; the other one is deleted */

extern const float gni_red[4], gni_green[4], gni_blue[4], gni_white[4];

/* 1 when the seen pixels of a rectangle of the cell are of this colour to the last bit; -1 in a channel is any. Else 0,
 * and the symptom is made of `what`, which says what was tried. */
int gni_is_color(gni_proofs *p, int x, int y, int width, int height, const int rgba[4], const char *what);
int gni_failed(gni_proofs *p, const char *format, ...)
#ifdef __GNUC__
    __attribute__((format(printf, 2, 3)))
#endif
    ; /* sets the symptom; 0 */

/* The state of a new context with dither off. */
void gni_fresh_state(gni_proofs *p);
#endif
