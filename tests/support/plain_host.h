/* plain_host.h - as little of a host as there can be: flat surfaces, and light added under whatever mask the plan has. */
#ifndef PLAIN_HOST_H
#define PLAIN_HOST_H
#include "gnomon_gles.h"

typedef struct plain_host {
    gn_gles *gles;
    const gn_gl *gl;
    struct {
        GLuint name;
        GLint clip, color, channels, mask, depth;
    } programs[3]; /* bare; under a mask in a texture; the depth that masks carry */
} plain_host;

/* 1, or 0 when the GL refuses its shaders. */
int plain_host_open(plain_host *h, gn_gles *gles);
void plain_host_close(plain_host *h);

/* Walks the plan: surfaces are black, and each light adds `share` where it reaches, to fronts; no mirrored objects. The meshes
 * must be uploaded. 1, or 0 with a sentence in the context. */
int plain_host_draw(plain_host *h, const gn_plan *plan, float share);
#endif
