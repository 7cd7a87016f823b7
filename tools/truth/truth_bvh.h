/* truth_bvh.h - a bounding hierarchy over boxes: of triangles for rays, of edges for footprints.
 *
 * It knows nothing of what lies in the boxes. The owner walks nodes[] itself, with a stack of TRUTH_BVH_STACK entries,
 * and keeps its items in the order of order[], so that a leaf's items lie side by side. */
#ifndef TRUTH_BVH_H
#define TRUTH_BVH_H
#include <stddef.h>
#include <stdint.h>

/* No leaf lies deeper, and a walk that pushes one child of each node never holds more: see truth_bvh.c. */
#define TRUTH_BVH_STACK 80

typedef struct truth_bvh_node {
    float box[2][3]; /* lowest and highest corner, rounded outwards */
    uint32_t first;  /* leaf: its first item in order[]; else the first of two children, which stand together */
    uint32_t count;  /* of items in a leaf; 0: not a leaf */
} truth_bvh_node;

typedef struct truth_bvh {
    truth_bvh_node *nodes; /* nodes[0] is the root; NULL when there are no items */
    uint32_t *order;       /* [count] a permutation of the items */
    size_t count;
} truth_bvh;

/* Builds the hierarchy over `count` boxes (lowest x, y, z, highest x, y, z; finite, within +-1e30). Returns 1, or 0
 * when memory ran out or there are 2^31 boxes or more; nothing is left allocated then. */
int truth_bvh_build(truth_bvh *out, const double (*boxes)[6], size_t count);

void truth_bvh_free(truth_bvh *b); /* a zeroed one does nothing */
#endif
