/* truth_edges.h - where shadow edges come from: the silhouette of everything that casts, as one light sees it.
 *
 * A pixel's subsamples miss what is thinner than their distance. Its footprint on the receiver, and with it the pyramid
 * from the light to the footprint, misses nothing: a shadow edge crosses the footprint just where a silhouette edge
 * crosses the pyramid between light and receiver. */
#ifndef TRUTH_EDGES_H
#define TRUTH_EDGES_H
#include "truth_rays.h"

/* A light as the truth sees it: relative to the eye. */
typedef struct truth_lamp {
    int directional;
    double at[3]; /* position; directional: towards the light, of any length */
} truth_lamp;

/* All edges of casting triangles, with the triangles' third vertices. Welded by position, whatever mesh they are of. */
typedef struct truth_edges {
    double (*vertices)[3];
    struct truth_edge {
        uint32_t ends[2]; /* ends[0] < ends[1] */
        uint32_t apex[2]; /* of the first two triangles */
        uint32_t uses;    /* triangles */
    } * edges;
    size_t vertex_count, edge_count;
} truth_edges;

/* Those of them that are silhouette edges for one light. */
typedef struct truth_silhouette {
    double (*segments)[2][3];
    size_t count;
    truth_bvh bvh;
    truth_lamp lamp;
} truth_silhouette;

typedef struct truth_footprint {
    double centre[3], corners[4][3]; /* in one plane, corners in order around the centre */
    double normal[3];                /* of that plane, unit length, towards the light's side */
    double size;                     /* greatest distance of a corner from the centre */
} truth_footprint;

/* The half space where normal . p >= least. */
typedef struct truth_plane {
    double normal[3], least;
} truth_plane;

/* A part of a silhouette edge; other than 0 ends the search. */
typedef int (*truth_part_visitor)(void *user, const double a[3], const double b[3]);

/* Both return 1, or 0 when memory ran out. */
int truth_edges_build(truth_edges *out, const truth_rays *r);
int truth_silhouette_build(truth_silhouette *out, const truth_edges *e, const truth_lamp *lamp);
void truth_edges_free(truth_edges *e);           /* a zeroed one does nothing */
void truth_silhouette_free(truth_silhouette *s); /* a zeroed one does nothing */

/* Calls `each` with the part a, b of every silhouette edge that lies within the pyramid from the light to the
 * footprint, on the light's side of the plane, until it returns other than 0. Returns what it returned last, 0 without
 * any.
 *
 * A part whose shadow lies within a thousandth of the footprint's size from itself is left out: it lies in the surface
 * (the border of a sheet, the seam of a floor, the foot of a box), where what is seen changes with it. */
int truth_silhouette_cross(const truth_silhouette *s, const truth_footprint *f, truth_part_visitor each, void *user);

/* The same for the parts within any five planes. */
int truth_silhouette_within(const truth_silhouette *s, const truth_plane planes[5], truth_part_visitor each,
                            void *user);

/* Where the light puts the shadow of p on the footprint's plane; p must lie between them. */
void truth_project(double out[3], const truth_lamp *lamp, const truth_footprint *f, const double p[3]);
#endif
