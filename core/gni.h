/* gni.h - what the files of core/ share with each other and with nobody else. */
#ifndef GNI_H
#define GNI_H
#include "gn_matrix.h"
#include "gni_features.h"
#include "gnomon.h"

#define GNI_NONE 0xffffffffu
#define GNI_MOST 1e100 /* of places and lengths: their third powers are numbers still */

struct gn_context {
    gn_port port;
    char message[256];
    uint32_t caches; /* made so far */
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
    int8_t is_closed;                        /* and wound alike: it may be solid */
    float box_min[3], box_max[3];
} gni_part;

/* facing.c and casting.c: of the triangles of a mesh, in its own order. */
typedef struct gni_casting {
    int8_t *of;         /* [triangle_count + 1] 1, -1, 0: as gn_casting() has it; then GNI_UNLIKE */
    uint64_t *bits;     /* [cluster_count] those that cast */
    uint64_t *spare;    /* [cluster_count] of backs, while facing is looked at */
    int is_plain;       /* all that cast are turned alike, and of closed parts: clusters that cast whole have no
                              silhouette inside */
    int8_t turn;        /* if so: 1 or -1, of those that cast */
    uint32_t count;     /* of those that cast */
    uint32_t looked_at; /* triangles whose facing was computed: the others were known by their clusters */
} gni_casting;

/* clusters.c */
#define GNI_CLUSTER     64u /* triangles: a bit each in a word */
#define GNI_UNLIKE      2   /* the casting of what is no triangle: like none */
#define GNI_MOST_LEVELS 9   /* of eights: GN_MAX_TRIANGLES in clusters */

typedef struct gni_cluster {
    float planes[4][64]; /* of the triangle of bit 8 l + j in slot 8 (7 - j) + l; normals' components below 1 */
    double most;         /* of the last row */
} gni_cluster;

/* A ball around triangles, and a cone around their normals; cosine 0: of more than half a sphere. */
typedef struct gni_node {
    double centre[3], radius;
    double axis[3], cosine, sine;
} gni_node;

/* Triangles, planes, uses, parts, chunks and clusters are in the mesh's own order. */
struct gn_mesh {
    gn_context *context;
    gn_mesh_info info;
    float *positions; /* [vertex_count][3] */
    uint32_t *given;  /* [triangle_count][3], as described */
    uint32_t *welded; /* [given_count] the vertex that each one described has become; GNI_NONE of those unused */
    uint32_t given_count;
    uint32_t *first_given;   /* [vertex_count] scratch of update.c */
    uint32_t *order;         /* [triangle_count] the number in the description of each */
    uint32_t *triangles;     /* [triangle_count][3] */
    double *planes;          /* [triangle_count][4]: normal (not of unit length) and -normal . vertex */
    double *facing_planes;   /* the same, or where edges are welded the sum of each one's group */
    uint32_t *group_of;      /* NULL, or [triangle_count] the first triangle of each one's group */
    uint32_t *edge_uses;     /* [edge_count + 1]: where an edge's uses start */
    uint32_t odd_edge_count; /* that are not between two neighbours */
    uint32_t *uses;
    uint32_t
        *edge_of;     /* [triangle_count][3]: the edge from each corner to the next; GNI_NONE of degenerate triangles */
    uint32_t *across; /* [triangle_count][3]: the triangle beyond that edge, if the two alone share it as neighbours do;
                         else triangle_count */
    gni_cluster *clusters;
    uint32_t cluster_count;
    gni_node *nodes; /* of clusters, then of eights of them, and so on */
    uint32_t levels[GNI_MOST_LEVELS], level_count;
    uint32_t *border_starts; /* [cluster_count + 1] in borders */
    uint8_t *borders;        /* corners, counted in their cluster, whose edge is not between two triangles of it */
    gni_casting scratch;     /* for the public functions of casting.c */
    uint32_t largest;        /* the triangle of the largest area */
    double radius;           /* of a ball about the hub */
    double longest_edge;
    double thickness; /* of the thinnest part: see thin.c */
    gni_part *parts;
    uint32_t *part_triangles; /* sorted by part; degenerate triangles are in none */
    uint32_t part_triangle_count;
    gn_chunk *chunks;
    uint32_t *chunk_vertices;
    uint16_t
        *corners; /* [triangle_count][3]: twice the index in the chunk, that of the near vertex; one more follows */
};

/* weld.c: positions less the centre, and the triangles' indices into them. */
gn_result gni_weld(gn_mesh *mesh, const gn_mesh_desc *desc);
/* From positions as they were given; finds the box too. */
void gni_subtract_centre(gn_mesh *mesh);

/* mesh.c: planes, what they say of the whole, and the hub, of positions and triangles. */
void gni_find_planes(gn_mesh *mesh);

/* order.c: mesh->order and mesh->triangles, from mesh->given. */
gn_result gni_order_triangles(gn_mesh *mesh);

/* edges.c: edges and their uses. */
gn_result gni_make_edges(gn_mesh *mesh);

/* parts.c: connected parts, which of them are solid. */
gn_result gni_make_parts(gn_mesh *mesh);
/* The same after the mesh has changed its shape, without memory: solid are only parts that are stars. */
void gni_judge_parts(gn_mesh *mesh);

/* embedded.c: 1 when the part is proven not to touch or pass through itself but where its triangles share vertices;
 * 0 when that is not so or not sure; -1 when memory ran out. */
int gni_part_is_embedded(const gn_mesh *mesh, const gni_part *part);
/* star.c: the same of those that a point inside sees all of: quickly, and without memory. */
int gni_part_is_star(const gn_mesh *mesh, const gni_part *part);

/* groups.c: mesh->facing_planes. */
gn_result gni_make_groups(gn_mesh *mesh, double angle);
void gni_sum_groups(gn_mesh *mesh);

/* clusters.c */
gn_result gni_make_clusters(gn_mesh *mesh);
/* Lanes and nodes, from planes and positions. */
void gni_fill_clusters(gn_mesh *mesh);

/* facing.c: bits of triangles that show front, or back, to the light; [cluster_count] each. Returns how many triangles were looked at. */
uint32_t gni_find_facing(const gn_mesh *mesh, const double light[4], uint64_t *front, uint64_t *back);
/* The truth, of one cluster: triangle by triangle in double. */
void gni_look_closely(const gn_mesh *mesh, uint32_t cluster, const double light[4], uint64_t *front, uint64_t *back);

/* facing_floats.c: the same, by the tree, and without. */
uint32_t gni_search_facing(const gn_mesh *mesh, const double light[4], uint64_t *front, uint64_t *back);
uint32_t gni_scan_facing(const gn_mesh *mesh, const double light[4], uint64_t *front, uint64_t *back);

/* casting.c */
void gni_find_casting(const gn_mesh *mesh, const double light[4], gni_casting *c);
/* From facing: bits of fronts, spare of backs. */
void gni_cast(const gn_mesh *mesh, const double light[4], gni_casting *c);
void gni_find_object_casting(const gn_object *object, const gn_light *light, gni_casting *c);
/* The light in the space of an object's mesh, less its centre: independent of the camera. 0 when the matrix is
 * singular. */
int gni_light_in_object(const gn_light *light, const gn_object *object, double out[4]);
/* Whether it is surely outside the box of the object's mesh. */
int gni_light_is_outside(const gn_light *light, const gn_object *object);
/* From `of`: all else. */
void gni_find_bits(const gn_mesh *mesh, gni_casting *c);

/* Of a word that is not 0. */
static inline uint32_t gni_lowest_bit(uint64_t word)
{
#if defined(__GNUC__)
    return (uint32_t)__builtin_ctzll(word);
#else
    uint32_t i = 0;

    while (!(word >> i & 1))
        i++;
    return i;
#endif
}

static inline uint32_t gni_count_bits(uint64_t word)
{
    word -= word >> 1 & 0x5555555555555555u;
    word = (word & 0x3333333333333333u) + (word >> 2 & 0x3333333333333333u);
    return (uint32_t)(((word + (word >> 4)) & 0x0f0f0f0f0f0f0f0fu) * 0x0101010101010101u >> 56);
}

/* chunks.c: 16-bit indices. */
gn_result gni_make_chunks(gn_mesh *mesh);
uint32_t gni_chunk_of(const gn_mesh *mesh, uint32_t triangle);

/* The corner from which the edge's first casting use starts; GNI_NONE where there is none. */
static inline uint32_t gni_first_caster(const gn_mesh *mesh, uint32_t edge, const int8_t *casting)
{
    for (uint32_t u = mesh->edge_uses[edge]; u < mesh->edge_uses[edge + 1]; u++) {
        const uint32_t corner = mesh->uses[u] & GNI_USE_CORNER;

        if (casting[corner / 3])
            return corner;
    }
    return GNI_NONE;
}

/* The corner of the same triangle that comes next. */
static inline uint32_t gni_next_corner(uint32_t corner)
{
    return corner % 3 == 2 ? corner - 2 : corner + 1;
}

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

/* A welded vertex by a matrix, mostly into view space. */
static inline void gni_vertex(double out[3], const gn_mesh *mesh, uint32_t vertex, const double matrix[16])
{
    const float *p = mesh->positions + 3 * (size_t)vertex;
    const double given[3] = {(double)p[0], (double)p[1], (double)p[2]};

    gn_mat4_transform(out, matrix, given, 1.0);
}

/* volume.c: the index stream of one chunk of a volume, piece by piece. Each returns the indices written; a few more may
 * be overwritten. */

/* At most this many indices for a triangle: a light cap, three sides of two triangles each, and two caps over them, a
 * triangle for each. */
#define GNI_MOST_INDICES 39u
#define GNI_SLACK        4u /* indices behind the last */

/* converging: all far vertices are one point (a directional light to infinity): sides are single triangles and the dark
 * cap has no area. */
uint32_t gni_put_sides(const gn_mesh *mesh, uint32_t chunk, const gni_casting *c, int converging, uint16_t *out);
uint32_t gni_put_dark_cap(const gn_mesh *mesh, uint32_t chunk, const gni_casting *c, uint16_t *out);
/* Of the triangles whose casting is `turn`. */
uint32_t gni_put_light_cap(const gn_mesh *mesh, uint32_t chunk, const gni_casting *c, int8_t turn, uint16_t *out);

/* A build without culling has no others than perspective cameras whose far plane is at infinity. */
static inline int gni_is_orthographic(const gn_camera *camera)
{
    return GNI_HAS_CULLING && camera->orthographic;
}

static inline int gni_has_finite_far(const gn_camera *camera)
{
    return GNI_HAS_CULLING && camera->finite_far;
}

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

/* casting.c: where a directional light or a cone comes from, in the world, of a length whose powers are numbers. A
 * power of two times what was given: no bit is lost. */
void gni_towards(double out[3], const gn_light *light);

/* plan_light.c: homogeneous, in view space, the eye subtracted first. */
void gni_light_in_view(const gn_camera *camera, const gn_light *light, double out[4]);

/* extrude.c */
/* The matrix that moves a point away from the light onto a plane: (plane . light) I - light plane^T. */
void gni_extrusion(double out[16], const double light[4], const double plane[4]);
/* ends.c: the matrix that moves a point away from the light by a factor of its distance, or, directional, by a distance. */
void gni_extrusion_by(double out[16], const double light[4], double reach);

/* text.c: writes like snprintf, piece by piece. */
typedef struct gni_text {
    char *text;
    size_t capacity, length; /* length: of the whole, whether there is room or not */
} gni_text;

void gni_start_text(gni_text *t, char *text, size_t capacity); /* text may be NULL */
void gni_put(gni_text *t, const char *format, ...)
#ifdef __GNUC__
    __attribute__((format(printf, 2, 3)))
#endif
    ;
#if !GNI_HAS_MESSAGES
#define gni_put(text, ...) (0 ? (gni_put)((text), __VA_ARGS__) : (void)0)
#endif

/* Whether it leaves out what a scene does not require. */
static inline int gni_models_less(gn_method method)
{
    return GNI_HAS_CULLING && method != GN_METHOD_ZFAIL && method != GN_METHOD_ZPASS;
}

static inline int gni_counts_in_color(gn_method method)
{
    return GNI_HAS_FALLBACK && method >= GN_METHOD_COUNT && method < GN_METHOD_TOTAL;
}

/* That are too much alone: of those that count in colour. */
static inline int gni_cuts_casters(gn_method method)
{
    return method == GN_METHOD_COUNT || method == GN_METHOD_SIGNED;
}

/* choose.c */
typedef struct gni_choice {
    gn_method method;
    gn_stencil_layout stencil;
    gn_color_layout color;
    gn_mask mask;
    gn_image image;
    gn_format mask_format;
    int is_refined; /* masks are small ones first, and counted anew where those are contested */
    uint32_t lights_per_mask;
    double dimmed;    /* what a shadow leaves of a frame that is not GN_SHADE_ADDITIVE */
    char reason[256]; /* as in gn_plan_light */
    gni_text text;    /* into it */
} gni_choice;

/* choose_color.c: those of methods that count in colour; and for all how masks reach the frame. */
int gni_color_is_possible(const gn_scene *s, gn_method method, gni_text *why);
int gni_stencil_is_possible(const gn_scene *s, const char *name, gni_text *why);
void gni_choose_color(const gn_scene *s, gni_choice *choice);
void gni_choose_masks(const gn_scene *s, gni_choice *choice);
/* The same layout in another channel of the target's colour. */
void gni_choose_channel(const gn_scene *s, gn_color_layout *layout, uint32_t channel);
int gni_format_bytes(gn_format format); /* of a pixel */
/* gn_color_layout.limit that a method would have. */
uint32_t gni_color_limit(const gn_scene *s, gn_method method);

/* kept_masks.c: whether masks are to be used for several frames. */
int gni_keeps_masks(const gn_scene *s);

/* Whether masks carry depth. */
int gni_carries_depth(const gn_scene *s);
/* What is meant where AUTO is asked for; AUTO when nothing is possible. */
gn_method gni_pick(const gn_scene *scene);
/* Counts of wrapping bits, and above them as many as name a patch. */
void gni_patch_layout(gn_stencil_layout *layout, uint32_t patch_count);
/* Counts of one bit less, and a flag above them. */
void gni_split_layout(gn_stencil_layout *layout);
/* The method that is meant and its way here. GN_E_DEVICE when the target lacks what it needs. */
gn_result gni_choose(gn_context *context, const gn_scene *scene, gni_choice *choice);
/* Whether volumes may not reach infinity unless they are clamped. */
int gni_must_end(const gn_scene *scene);
/* "is hidden", "fails its proof" or "is not offered". */
const char *gni_why_not(const gn_target *target, gn_capability capability);

/* explain.c: a word for machines, "" for what is not skipped. */
const char *gni_skip_name(gn_skip skip);

/* hull.c: convex bodies of view space. */
#define GNI_MARGIN                                                                                                     \
    1e-6 /* of the greatest coordinate: double precision leaves a wide gap to it, float and pixels a small one */

#define GNI_HULL_POINTS 16 /* a box and its end */

typedef struct gni_hull {
    double points[GNI_HULL_POINTS][3];
    int point_count;
    double directions[8][3]; /* in which it goes on without end */
    int direction_count;
    double edges[3][3]; /* of a box: from its first corner */
} gni_hull;

void gni_cross(double out[3], const double a[3], const double b[3]); /* matrix.c */
static inline double gni_dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
/* Three axes of unit length, at right angles, the third along `axis` (not 0). */
void gni_make_axes(double axes[3][3], const double axis[3]);
/* camera.c: the box around a mesh, in view space. */
void gni_box_hull(gni_hull *out, const gn_mesh_info *info, const double model_view[16]);
/* The most that a matrix stretches a length, or a little more. */
double gni_stretch(const double m[16]);
/* Centre and radius of a ball around a mesh, whose box is given, in view space. */
void gni_find_ball(double out[4], const gni_hull *box, const gn_mesh *mesh, const double model_view[16]);
/* A box along view space's axes. */
void gni_hull_around(gni_hull *out, const double low[3], const double high[3]);
/* The box and all that is behind it as the light sees it. */
void gni_volume_hull(gni_hull *out, const gni_hull *box, const double light[4]);
/* Whether the axis separates two bodies, of which at most one is without end. */
int gni_separates(const double axis[3], const gni_hull *a, const gni_hull *b);
/* 1: they are apart. 0: not, or not sure. */
int gni_volume_misses(const gni_hull *volume, const double light[4], const gni_hull *box);
/* Whether all of it lies where the plane is negative. */
int gni_is_outside(const gni_hull *hull, const double plane[4]);
/* Whether all of a body without directions lies where the plane is positive, or as good as 0: in doubt 1; in doubt
 * 0. */
int gni_lies_before(const gni_hull *hull, const double plane[4]);
int gni_is_before(const gni_hull *hull, const double plane[4]);

/* fan.c: scratch of a walk along a silhouette. */
typedef struct gni_walk {
    uint32_t vertex_count; /* of the largest chunk, at least */
    uint32_t *first;       /* [vertex_count] of each vertex, an edge that starts there; GNI_NONE between calls */
    uint32_t *next;        /* [edges] another from the same vertex */
    uint16_t *loop;        /* [edges + 1] */
} gni_walk;

/* sides: as written, of_a_side indices each. No more triangles than sides. */
uint32_t gni_put_fan(const gn_mesh *mesh, uint32_t chunk, const uint16_t *sides, uint32_t count, uint32_t of_a_side,
                     const gni_walk *walk, uint16_t *out);
/* The same fan of near vertices, seen from the other side. */
void gni_put_near_fan(const uint16_t *fan, uint32_t count, uint16_t *out);

/* Whether all sides run round the hub the same way as the light sees them. light: view space, outside the
 * caster's box, not directional. */
int gni_runs_round_hub(const gn_mesh *mesh, uint32_t chunk, const uint16_t *sides, uint32_t count, uint32_t of_a_side,
                       const double model_view[16], const double light[4]);

/* cases.c: how a caster is counted. */
typedef struct gni_view {
    gni_hull near_rectangle;
    double planes[5][4]; /* its four sides and the near plane; > 0 inside */
} gni_view;

enum { GNI_SEES_CASTER = 1, GNI_SEES_FAR = 2, GNI_SEES_VOLUME = 4 }; /* FAR: its image at infinity */

typedef struct gni_case {
    int number;    /* McGuire's: 1 before what is seen, 2 behind it and the caster out of view, 3 behind it */
    unsigned seen; /* what of it may be in view */
    int is_drawn;  /* to depth, by the host: all of it that casts */
} gni_case;

/* What is seen through the scissor. */
void gni_make_view(gni_view *view, const gn_camera *camera, const gn_target *target, const uint32_t scissor[4]);
int gni_may_be_seen(const gni_view *view, const gni_hull *hull);
/* volume: without end, or a box and its end. light: view space. Conservative in all: what is not sure touches, or is
 * seen. */
void gni_find_case(gni_case *out, const gni_view *view, const gni_hull *box, const gni_hull *volume,
                   const double light[4]);

/* bounds.c: what a light can reach. */
#define GNI_BOUND_PLANES 15

typedef struct gni_bounds {
    double light[4];                     /* view space */
    double reach;                        /* INFINITY: no bound */
    double planes[GNI_BOUND_PLANES][4];  /* view space: of its cone and box; nothing is lit where one is negative */
    uint32_t plane_count, caster_planes; /* the first ones: nor does anything outside cast on what is lit */
    uint32_t scissor[4];
    double distances[2]; /* view distances between which it lights; [1] may be INFINITY */
    gn_skip skip;        /* GN_SKIP_OUT_OF_VIEW, GN_SKIP_FAINT or GN_SKIP_NOT */
} gni_bounds;

/* Pixels in which the body may be seen, and one more on each side: x, y, width, height; all 0 for none. */
void gni_find_rectangle(uint32_t out[4], const gni_hull *hull, const gn_camera *camera, const gn_target *target);
/* The same of two balls (centre, radius) and all that is between them; both before the near plane, or one and the
 * same. */
void gni_find_balls_rectangle(uint32_t out[4], const double a[4], const double b[4], const gn_camera *camera,
                              const gn_target *target);
/* plan_light.c: of a light that no bound is known of, or asked for. */
void gni_no_bounds(gni_bounds *out, const gn_scene *scene, const double light[4]);
/* view: from world to view space. */
void gni_find_bounds(gni_bounds *out, const gn_scene *scene, uint32_t light_index, const double light[4],
                     const double view[16]);
/* Whether something may be lit there, or may cast on what is lit. */
int gni_may_be_lit(const gni_bounds *bounds, const gni_hull *box);
int gni_may_cast(const gni_bounds *bounds, const gni_hull *box);
/* The most that the light adds to a pixel of what lies in the box; INFINITY where its color is not given. */
double gni_most_light(const gni_bounds *bounds, const gn_light *light, const gni_hull *box);

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
 * GNI_MAX_ENDS for one that shadows nothing visible. Returns 0 when nothing ends them all before the region's limit:
 * one end where the region is deep, else GNI_MAX_ENDS planes. */
int gni_choose_ends(gni_ends *ends, const gni_region *region, const gn_mesh *mesh, const double model_view[16],
                    const double light[4], const int8_t *casting, uint8_t *end_of);
#endif
