/* gni.h - what the files of core/ share with each other and with nobody else. */
#ifndef GNI_H
#define GNI_H
#include "gnomon.h"

#define GNI_NONE 0xffffffffu

struct gn_context {
    gn_port port;
    char message[256];
};

/* Memory from the port that remembers its size; NULL when the port gives none or count * size does not fit. Not
 * cleared. */
void *gni_alloc(gn_context *context, size_t count, size_t size);
void gni_free(gn_context *context, void *block);

/* A use of an edge by a triangle: its corner (3 * triangle + k; the use runs from corner k to the next), and in the
 * top bit whether it runs from the higher to the lower vertex. */
#define GNI_USE_DOWN   0x80000000u
#define GNI_USE_CORNER 0x7fffffffu

typedef struct gni_part {
    uint32_t first_triangle, triangle_count; /* in part_triangles */
    int8_t outward;                          /* solid: 1 or -1, what turns its triangles outward. 0: not solid */
    float box_min[3], box_max[3];
} gni_part;

struct gn_mesh {
    gn_context *context;
    gn_mesh_info info;
    float *positions;    /* [vertex_count][3] */
    uint32_t *triangles; /* [triangle_count][3] */
    double *planes;      /* [triangle_count][4]: normal (not of unit length) and -normal . vertex */
    uint32_t *edge_uses; /* [edge_count + 1]: where an edge's uses start; edges stand in order of chunks */
    uint32_t *uses;
    uint32_t *chunk_edges; /* [chunk_count + 1]: where a chunk's edges start */
    gni_part *parts;
    uint32_t *part_triangles; /* sorted by part; degenerate triangles are in none */
    uint32_t part_triangle_count;
    gn_chunk *chunks;
    uint32_t *chunk_vertices;
    uint16_t *corners; /* [triangle_count][3]: index in the chunk of each corner */
};

/* weld.c: positions less the centre, and the triangles' indices into them. */
gn_result gni_weld(gn_mesh *mesh, const gn_mesh_desc *desc);

/* edges.c: edges and their uses. */
gn_result gni_make_edges(gn_mesh *mesh);

/* parts.c: connected parts, which of them are solid. */
gn_result gni_make_parts(gn_mesh *mesh);

/* embedded.c: 1 when the part is proven not to touch or pass through itself but where its triangles share vertices;
 * 0 when that is not so or not sure; -1 when memory ran out. */
int gni_part_is_embedded(const gn_mesh *mesh, const gni_part *part);

/* chunks.c: 16-bit indices; sorts the edges by chunk. */
gn_result gni_make_chunks(gn_mesh *mesh);

/* How many times, and in which sign, the casting chain runs along an edge from its lower to its higher vertex. */
static inline int32_t gni_edge_weight(const gn_mesh *mesh, uint32_t edge, const int8_t *casting)
{
    int32_t weight = 0;

    for (uint32_t u = mesh->edge_uses[edge]; u < mesh->edge_uses[edge + 1]; u++) {
        const int8_t c = casting[(mesh->uses[u] & GNI_USE_CORNER) / 3];

        weight += mesh->uses[u] & GNI_USE_DOWN ? -c : c;
    }
    return weight;
}

/* volume.c: the index stream of one chunk of a volume. */
typedef struct gni_stream {
    uint32_t sides, dark_cap, light_cap, turned_cap; /* indices of each, in this order */
} gni_stream;

/* At most this many indices for all chunks of a caster, whatever the light. */
size_t gni_volume_bound(const gn_mesh *mesh);

/* parts: which of GN_SIDES, GN_LIGHT_CAP, GN_DARK_CAP. converging: all far vertices are one point (a directional
 * light to infinity): sides are single triangles and the dark cap has no area. Returns the indices written. */
uint32_t gni_volume_indices(const gn_mesh *mesh, uint32_t chunk, const int8_t *casting, unsigned parts, int converging,
                            uint16_t *out, gni_stream *stream);

/* camera.c */
gn_result gni_check_camera(gn_context *context, const gn_camera *camera);
/* World to view with the eye subtracted first: object positions less `centre` to view space. */
void gni_model_view(double out[16], const gn_camera *camera, const double model[16], const float centre[3]);
/* View to clip. range: what the depth buffer spans; the far end is not read for a perspective camera, whose rows z
 * and w are equal in x, y, z: multiplied with any affine matrix they stay so to the last bit (DESIGN.md, decision
 * 3). */
void gni_projection(double out[16], const gn_camera *camera, const double range[2]);
/* Window depth of a view distance, 0 to 1. */
double gni_depth_of(const gn_camera *camera, const double range[2], double distance);

/* extrude.c */
/* The matrix that moves a point away from the light onto a plane: (plane . light) I - light plane^T. */
void gni_extrusion(double out[16], const double light[4], const double plane[4]);
/* The matrix that moves a point away from the light by a factor of its distance, or, directional, by a distance. */
void gni_extrusion_by(double out[16], const double light[4], double reach);

/* choose.c */
typedef struct gni_choice {
    gn_method method;
    gn_stencil_layout stencil;
    char reason[256]; /* as in gn_plan_light */
} gni_choice;

/* The method that is meant and its way here. GN_E_DEVICE when the target lacks what it needs. */
gn_result gni_choose(gn_context *context, const gn_scene *scene, gni_choice *choice);
/* Whether volumes may not reach infinity unless they are clamped. */
int gni_must_end(const gn_scene *scene);
/* "is hidden", "fails its proof" or "is not offered". */
const char *gni_why_not(const gn_target *target, gn_capability capability);

/* cases.c: how a caster is counted. */
typedef struct gni_view {
    double near_corners[4][3]; /* view space: of the near rectangle */
    double planes[5][4];       /* its four sides and the near plane; > 0 inside */
} gni_view;

typedef struct gni_case {
    int number;    /* McGuire's: 1 before what is seen, 2 behind it and the caster out of view, 3 behind it */
    unsigned seen; /* may be in view: 1 the caster, 2 its image at infinity, 4 its volume */
} gni_case;

void gni_make_view(gni_view *view, const gn_camera *camera);
/* light: view space. Conservative in all: what is not sure touches, or is seen. */
void gni_find_case(gni_case *out, const gni_view *view, const gn_mesh_info *info, const double model_view[16],
                   const double light[4]);

/* ends.c: where volumes end that must end. */
#define GNI_MAX_ENDS 250 /* end planes of one caster for one light; a byte names one */

typedef struct gni_region {
    /* view space: faces of two boxes that hold everything visible that receives, and a margin; > 0 inside */
    double planes[12][4];
    double corner_min[2][3], corner_max[2][3]; /* the two boxes: along view axes and along world axes */
    double view_to_axes[16];                   /* turns view space to the world's axes */
    double deepest;                            /* view distance of the farthest thing that can be seen */
    double limit;                              /* view distance that no volume may pass; INFINITY mostly */
    int is_deep;                               /* ends cost no precision as long as they keep the limit; one must do */
    int empty;
} gni_region;

void gni_receiver_region(gni_region *region, const gn_scene *scene);

/* The volumes of one caster's casting triangles. */
typedef struct gni_ends {
    uint32_t count;                 /* of planes; 0: no triangle casts on what is visible */
    double planes[GNI_MAX_ENDS][4]; /* view space */
    double reach;                   /* not 0: there is one end, not on a plane, but so far: see gni_extrusion_by() */
    double deepest;                 /* view distance of the farthest vertex of caster or end */
} gni_ends;

/* Chooses end planes. light: [4] view space. end_of: [triangle_count] receives the plane of each casting triangle, or
 * GNI_MAX_ENDS for one that shadows nothing visible. Returns 0 when nothing ends them all before the region's limit: one
 * end where the region is deep, else GNI_MAX_ENDS planes. */
int gni_choose_ends(gni_ends *ends, const gni_region *region, const gn_mesh *mesh, const double model_view[16],
                    const double light[4], const int8_t *casting, uint8_t *end_of);
#endif
