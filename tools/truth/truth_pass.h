/* truth_pass.h - what the truth's files share: the view, the samples, and one light at work on them. */
#ifndef TRUTH_PASS_H
#define TRUTH_PASS_H
#include "truth.h"
#include "truth_edges.h"
#include "truth_rays.h"

#define TRUTH_SNAP (1.0 / 256.0) /* of a pixel: how finely rasterisers place vertices */

/* What truth_create() finds at a pixel, the same for all lights. */
enum {
    TRUTH_SNAP_VISIBLE = 1,  /* a surface is seen at the centre and none 1/256 pixel beside it, or the reverse */
    TRUTH_SNAP_TRIANGLE = 2, /* another triangle is seen there */
    TRUTH_BEHIND = 4,        /* another surface lies within 2 depth steps */
    TRUTH_CUT_NEAR_BY = 8    /* znear or zfar does */
};

struct truth {
    const scene *scene;
    uint32_t width, height;
    size_t columns, rows;      /* of samples */
    double steps;              /* of the depth buffer */
    double ortho_range;        /* of depths in it */
    double nearest, farthest;  /* depths that are seen */
    double eye[3], axes[3][3]; /* right, up, forward */
    double half[2];            /* half extents of the image, perspective: at depth 1 */
    truth_rays rays;
    truth_edges edges;
    uint32_t *seen;   /* [rows][columns] visible triangle or TRUTH_NOTHING */
    double *depth;    /* [rows][columns] */
    uint8_t *remarks; /* [height][width] */
};

/* One light at work. */
typedef struct truth_pass {
    const truth *t;
    truth_lamp lamp;
    truth_silhouette silhouette;
    uint32_t last; /* what blocked the last ray */
    uint8_t *lit;  /* [rows][columns] 0 or 1 */
} truth_pass;

/* A visible point. */
typedef struct truth_point {
    uint32_t triangle;
    double from[3], along[3], depth; /* the view ray, and where on it */
    double at[3];
} truth_point;

/* x, y in pixels from the upper left corner of the image. `along` advances one unit of depth. */
void truth_view_ray(const truth *t, double x, double y, double from[3], double along[3]);

/* What is seen there: a triangle or TRUTH_NOTHING. See truth_rays_seen(). */
uint32_t truth_see(const truth *t, double x, double y, uint32_t hint, double *depth);

void truth_point_set(truth_point *p, const truth *t, double x, double y, uint32_t triangle, double depth);

/* The depth that lies `count` steps of the depth buffer behind `depth`, or before it if negative. */
double truth_stepped(const truth *t, double depth, double count);

/* From a point towards the light: all the way there, or, directional, as far as the scene is wide. */
void truth_to_light(const truth_pass *p, const double at[3], double out[3]);

/* Whether a caster meets the open segment from the point to the light. seen: the triangle that the point lies on, which
 * does not count. pardon may be NULL. */
int truth_in_shadow(truth_pass *p, const double at[3], uint32_t seen, const truth_pardon *pardon);

/* The cosine between the normal of the face's seen side, and the light; 0 where it is edge-on. */
double truth_facing(const truth_pass *p, const truth_point *at);

int truth_is_lit(truth_pass *p, const truth_point *at);

/* Needs all of p, with lit filled. */
truth_class truth_classify(truth_pass *p, uint32_t x, uint32_t y);
#endif
