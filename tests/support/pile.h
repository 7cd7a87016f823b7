/* pile.h - the scene that benches draw: a cube of closed lumps over a floor, under lights that circle.
 *
 * k * k * k copies of one lump of extent 1, spaced 1.5, float from y = 0.9 over a floor of 32 x 32 quads; everything
 * moves: each lump turns about its own axis, the lights go round. */
#ifndef PILE_H
#define PILE_H
#include "gnomon.h"

enum { PILE_MOST_OBJECTS = 1 + 27, PILE_MOST_LIGHTS = 4 };

/* A mesh in arrays: what the library and a host's drawing need. */
typedef struct pile_mesh {
    float *positions, *normals; /* [vertex_count][3] */
    uint32_t *indices;
    size_t vertex_count, triangle_count;
    gn_mesh *mesh;
} pile_mesh;

/* A lump: a sphere of rings and sectors with smooth hills and hollows; closed, outward, 2 sectors (rings - 1)
 * triangles. */
int pile_make_lump(pile_mesh *m, gn_context *context, uint32_t rings, uint32_t sectors);
/* quads * quads of them, from -half to half at y = 0. */
int pile_make_floor(pile_mesh *m, gn_context *context, uint32_t quads, float half);
void pile_drop(pile_mesh *m);

typedef struct pile {
    const pile_mesh *meshes[2]; /* lump, floor */
    uint32_t side, light_count; /* side: k */
    uint32_t object_count;      /* the floor is the last */
    gn_object objects[PILE_MOST_OBJECTS];
    gn_light lights[PILE_MOST_LIGHTS];
    gn_camera camera;
} pile;

/* Camera to world: upright, and not straight up or down. */
void pile_look_at(double world[16], const double eye[3], const double at[3]);
double pile_floor_half(uint32_t side);
void pile_pose(pile *p, uint32_t frame, double aspect);
#endif
