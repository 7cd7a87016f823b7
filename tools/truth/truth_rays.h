/* truth_rays.h - the solid triangles of a scene, seen from the eye, and what rays meet among them.
 *
 * space      world axes, with the eye as origin: a scene far from the world's origin keeps its last bits
 * triangles  those that may be seen or cast: no BLEND ranges, none without area. Named by their index in triangles[]
 * t          along a ray in units of its direction's length */
#ifndef TRUTH_RAYS_H
#define TRUTH_RAYS_H
#include "scene.h"
#include "truth_bvh.h"

#define TRUTH_NOTHING UINT32_MAX /* no triangle */

enum {
    TRUTH_CASTS = 1,     /* of a casting instance */
    TRUTH_RECEIVES = 2,  /* of a receiving instance */
    TRUTH_ONE_SIDED = 4, /* not seen from behind */
    TRUTH_CUT = 8,       /* seen only where its alpha reaches the cutoff */
    TRUTH_MIRRORED = 16  /* its front is clockwise */
};

typedef struct truth_triangle {
    double v[3][3]; /* in the mesh's order */
    uint32_t flags;
    uint32_t instance, index; /* which triangle of which instance's mesh */
    int material;
} truth_triangle;

typedef struct truth_rays {
    const scene *scene;
    truth_triangle *triangles;
    size_t count;
    truth_bvh bvh;
    double extent; /* greatest distance between two points, or a little more; 1 without triangles */
} truth_rays;

typedef struct truth_ray {
    double from[3], along[3];
    double inverse[3]; /* of along; huge for 0 */
    int axis[3];       /* axis[2]: where `along` is longest; the others in order */
    double shear[3];   /* takes `along` to 0, 0, 1 in the order of axis[] */
} truth_ray;

/* Triangles that do not count as blocking although the ray meets them. For points moved off the surface on which they
 * were seen: see truth_class.c. */
typedef struct truth_pardon {
    double seen_at[3]; /* the visible point: triangles in whose planes it lies are pardoned */
    uint32_t seen;     /* the visible triangle: those that share a vertex with it are pardoned... */
    double reach;      /* ...where they are met no farther than this (t) */
} truth_pardon;

/* Gathers the triangles of a posed scene. Returns 1, or 0 when memory ran out. */
int truth_rays_build(truth_rays *out, const scene *s, const double eye[3]);
void truth_rays_free(truth_rays *r); /* a zeroed one does nothing */

void truth_ray_set(truth_ray *ray, const double from[3], const double along[3]);

/* The nearest triangle that is seen along a ray within [least, most]: back faces of single-sided materials, and what is
 * cut by its alpha, are not seen; nor is `skip`. Returns TRUTH_NOTHING or the triangle, with its t. `hint`, which is
 * probably the answer, saves time; it may be TRUTH_NOTHING. */
uint32_t truth_rays_seen(const truth_rays *r, const truth_ray *ray, double least, double most, uint32_t skip,
                         uint32_t hint, double *t);

/* All that would be seen along a ray within [least, most] if nothing hid it, in no order, `skip` left out: up to `room`
 * triangles with their t. Returns how many. */
size_t truth_rays_within(const truth_rays *r, const truth_ray *ray, double least, double most, uint32_t skip,
                         uint32_t *found, double *t, size_t room);

/* Whether a casting triangle other than `skip` meets the ray strictly within (least, most). *last is tried first and
 * receives what was found; start it as TRUTH_NOTHING. pardon may be NULL. */
int truth_rays_blocked(const truth_rays *r, const truth_ray *ray, double least, double most, uint32_t skip,
                       const truth_pardon *pardon, uint32_t *last);

/* Not of unit length: twice the area. Towards the side from which the mesh's order of vertices is counter-clockwise. */
void truth_normal(double out[3], const truth_triangle *f);
#endif
