/* gnomon.h - shadow volumes, the part with no GL in it.
 *
 * Turns meshes, lights and a camera into a plan: which volumes are drawn, how, in which order, with their index
 * streams. It does not draw (gles/gnomon_gles.h does), load models, open files or make contexts.
 *
 * space     mesh positions in object space; lights, cameras and model matrices in world space; names ending in _px
 *           count pixels from the lower left. Column vectors; matrices as in gn_matrix.h
 * winding   counter-clockwise is the front of a triangle, in object space
 * light     double[4] homogeneous where it stands alone: w = 1 a position, w = 0 a direction towards the light
 * units     lengths in scene units, angles in radians, sizes in bytes
 * lifetime  who creates destroys; gn_*_destroy(NULL) does nothing. "Borrowed": keep it alive and unchanged. "Copied":
 *           yours to free once the call returns
 * threads   no globals. A context and all made from it: one thread at a time. Different contexts: different threads
 * errors    gn_result from all that can fail; outputs stay untouched unless a comment says otherwise. gn_message() has
 *           the sentence with the numbers in it
 * floats    compile this library without -ffast-math: closed volumes rest on IEEE arithmetic */
#ifndef GNOMON_H
#define GNOMON_H
#include "gn_capability.h"
#include "gn_port.h"
#include <stddef.h>
#include <stdint.h>

#ifdef __FAST_MATH__
#error "gnomon needs IEEE arithmetic: compile without -ffast-math"
#endif

#ifdef __cplusplus
extern "C" {
#endif

#define GN_VERSION_MAJOR 0
#define GN_VERSION_MINOR 1
#define GN_VERSION_PATCH 0

/* "0.1.0", of the library that is linked. */
const char *gn_version(void);

/* Released values keep their numbers; new ones go at the end. */
typedef enum gn_result {
    GN_OK = 0,
    GN_E_ARG,    /* the caller's mistake: fix the call */
    GN_E_MEMORY, /* the port's allocator gave NULL; nothing has changed */
    GN_E_SPACE,  /* the memory or array given is too small; the message says what is needed */
    GN_E_MESH,   /* an index out of range or a vertex not finite; the message names the first */
    GN_E_DEVICE  /* this target cannot do it; the message names what is missing */
} gn_result;

/* ---- Context: a port and the last message ---- */

typedef struct gn_context gn_context;

/* Copies port (NULL: gn_port_libc()). Proves it first: one block is asked for, checked and given back, the clock is
 * read twice. Returns GN_OK, GN_E_ARG, GN_E_MEMORY; *context is NULL unless GN_OK. */
gn_result gn_context_create(const gn_port *port, gn_context **context);
void gn_context_destroy(gn_context *context);

/* The last failure, as a sentence. Never NULL; valid until the next call on the context. */
const char *gn_message(const gn_context *context);

/* For the rooms above (gles, fallback), which fail and allocate through the same context: sets the message and
 * returns result; the port that was given (NULL for NULL). */
gn_result gn_fail(gn_context *context, gn_result result, const char *format, ...)
#ifdef __GNUC__
    __attribute__((format(printf, 3, 4)))
#endif
    ;
const gn_port *gn_context_port(const gn_context *context);

/* ---- Mesh: a triangle soup, once for all frames ---- */

typedef struct gn_mesh gn_mesh;

/* Start from {0}; zero means the default in [brackets]. */
typedef struct gn_mesh_desc {
    const float *positions; /* [vertex_count][3], object space, borrowed for the call */
    size_t vertex_count;
    size_t stride;           /* bytes from one vertex to the next [12] */
    const uint32_t *indices; /* [triangle_count][3], borrowed for the call */
    size_t triangle_count;   /* up to GN_MAX_TRIANGLES */
    /* A choice: neighbours whose normals are within so many radians of another's face the light together, which makes
     * silhouettes shorter. gn_mesh_info.weld_error says how far a shadow's edge may be off. Less than 1 [0: none do] */
    double weld_angle;
} gn_mesh_desc;

#define GN_MAX_TRIANGLES  0x10000000u /* three corners and a sign must fit 32 bits */
#define GN_CHUNK_VERTICES 32767u      /* with the hub each is uploaded twice (near, far); 16-bit indices reach 65536 */

/* Vertices that one set of 16-bit indices reaches. Its vertices are welded vertices; one that several chunks need is in
 * each. Index 2 i is vertex i as it is (near), 2 i + 1 the same vertex moved away from the light (far). After the last
 * comes the mesh's hub, where open ends of its silhouette meet. */
typedef struct gn_chunk {
    uint32_t first_vertex, vertex_count;     /* in gn_mesh_info.chunk_vertices */
    uint32_t first_triangle, triangle_count; /* in gn_mesh_info.corners */
} gn_chunk;

/* What a mesh is. Arrays live as long as the mesh. */
typedef struct gn_mesh_info {
    /* Subtract it from every vertex that you draw: plain float subtraction, without rounding, gives the very positions
     * that the volumes have. 0 on an axis where that could round. Object space. */
    float centre[3];
    float hub[3]; /* the middle of the box, less the centre: in each chunk the vertex that follows its own */
    float box_min[3], box_max[3]; /* less the centre */
    uint32_t vertex_count;        /* after welding */
    uint32_t triangle_count;      /* as given: triangle i is the i-th of the description, whatever it is */
    uint32_t edge_count;
    uint32_t part_count;       /* connected through edges that two triangles share */
    uint32_t solid_part_count; /* closed, wound alike, not passing through themselves: only their lit triangles cast */
    uint32_t outward_part_count; /* solid parts whose front faces look outward */
    uint32_t chunk_count;
    /* The greatest length of what faces the light together; 0 without a weld angle. Object space, of the first shape. */
    double weld_error;
    uint32_t shape;                 /* how often gn_mesh_update() has changed it */
    int planar;                     /* 1: all triangles lie in one plane; 2: and are wound alike */
    const float *positions;         /* [vertex_count][3], welded, less the centre */
    const uint32_t *triangles;      /* [triangle_count][3], into positions */
    const gn_chunk *chunks;         /* [chunk_count] */
    const uint32_t *chunk_vertices; /* into positions */
    const uint16_t
        *corners; /* [triangle_count][3]: index of each corner's near vertex, in its chunk. Not in the order of
                                `triangles`, but in the mesh's own, in which chunks are runs */
} gn_mesh_info;

/* Copies what it needs. Vertices are welded by exact position (-0 equals 0). Degenerate and duplicate triangles are
 * lawful; a mesh may have no triangle at all. Returns GN_OK, GN_E_ARG, GN_E_MESH, GN_E_MEMORY; *mesh is NULL unless
 * GN_OK. Time O(triangles log triangles); holds about 150 bytes a triangle. */
gn_result gn_mesh_create(gn_context *context, const gn_mesh_desc *desc, gn_mesh **mesh);
void gn_mesh_destroy(gn_mesh *mesh);

/* The same triangles in another shape: positions as in the description, stride bytes from one to the next [12],
 * borrowed for the call. Vertices that were at one place must be so still. Centre, box, hub, parts and planarity
 * change; what is shared, chunks and corners do not. A closed part whose triangles are not all seen from the middle of
 * its box counts as not solid from then on: right, but with more fill. Call gn_gles_upload() again before the next
 * frame. Allocates nothing; O(triangles). Returns GN_OK, GN_E_ARG, GN_E_MESH: then nothing has changed. */
gn_result gn_mesh_update(gn_mesh *mesh, const float *positions, size_t stride);

const gn_mesh_info *gn_mesh_get_info(const gn_mesh *mesh);

/* Which side of each triangle looks at the light: 1 its front, -1 its back, 0 neither (the light in its plane, or no
 * area). light: [4] object space less the mesh's centre. facing: [triangle_count]. The sign of one expression in double
 * precision, found in floats where these suffice (DESIGN.md, decision 1); allocates nothing. */
void gn_facing(const gn_mesh *mesh, const double light[4], int8_t *facing);

/* Which triangles cast, and which way they are turned: 1 as wound, -1 turned round, 0 not casting. In a solid part
 * with the light outside the lit triangles cast, turned outward; in any other part every triangle casts, turned
 * towards the light. Then the volume's winding number at a point is the number of casting triangles that block the
 * segment to the light, and is non-zero exactly where some triangle does (DESIGN.md, decision 2; Kim, Kim and Turk
 * 2008). light: [4] object space less the mesh's centre. casting: [triangle_count]. Allocates nothing; O(triangles). */
void gn_casting(const gn_mesh *mesh, const double light[4], int8_t *casting);

/* The chain of casting triangles ends in this edge `weight` times, running from a to b. */
typedef struct gn_edge {
    uint32_t a, b;   /* welded vertices */
    uint32_t weight; /* its multiplicity, at least 1 */
} gn_edge;

/* The silhouette: the boundary of the casting triangles as a chain. At each vertex as much arrives as leaves, whatever
 * `casting` holds, so that the swept sides always close (Bergeron 1986).
 * casting   [triangle_count] from gn_casting()
 * edges     [capacity]; 3 * triangle_count is always enough
 * count     edges written; with GN_E_SPACE the edges needed, and edges[] is partly written
 * Returns GN_OK, GN_E_ARG, GN_E_SPACE. Allocates nothing; O(edges). */
gn_result gn_silhouette(const gn_mesh *mesh, const int8_t *casting, gn_edge *edges, size_t capacity, size_t *count);

/* ---- Shadow cache: what stays from frame to frame ---- */

/* Index streams of casters that do not move as a light does not, so that a moving camera rebuilds nothing and sends no
 * index. Handed to the planner in gn_scene.cache; objects and lights are known by their places in the scene's arrays.
 * Meshes of up to 4 chunks. Holds some 80 to 160 bytes a triangle for each light; grows in a frame that has more to
 * keep, and allocates nothing in others. */
typedef struct gn_shadow_cache gn_shadow_cache;

/* Choices: a shadow is found anew only every so many frames, or when its light has moved so far as the caster sees it
 * (in the world's lengths; a direction at distance 1), whichever comes first. gn_plan_light.light_moved says how far a
 * shadow may be behind. Start from {0}. */
typedef struct gn_shadow_cache_desc {
    uint32_t update_every;  /* frames [when something has changed] */
    double update_distance; /* [any] */
} gn_shadow_cache_desc;

/* Returns GN_OK, GN_E_ARG, GN_E_MEMORY; *cache is NULL unless GN_OK. Without memory later the cache keeps less. */
gn_result gn_shadow_cache_create(gn_context *context, const gn_shadow_cache_desc *desc, gn_shadow_cache **cache);
void gn_shadow_cache_destroy(gn_shadow_cache *cache);

/* ---- The scene of one frame ---- */

/* A camera looks along its -z, y up. Start from {0}. */
typedef struct gn_camera {
    double world[16]; /* camera to world: orthonormal axes and a position */
    int orthographic;
    /* The image's edges: at distance 1 from the eye (perspective), or literally (orthographic). */
    double left, right, bottom, top;
    double znear; /* greater than 0; orthographic: any, less than zfar */
    double zfar;  /* perspective: 0 for infinite. orthographic: greater than znear, or 0 for behind everything */
    /* Perspective: 1 when the host insists on a projection of its own whose far plane is zfar, which must then be
     * given. Volumes must end before it there, or need depth clamp and casters that neither plane cuts: a frame with a
     * caster of neither kind is refused. [0: the projection's far plane is at infinity, zfar the depth to which the
     * buffer is cleared] */
    int finite_far;
} gn_camera;

typedef enum gn_light_kind { GN_LIGHT_POINT, GN_LIGHT_SPOT, GN_LIGHT_DIRECTIONAL } gn_light_kind;

/* Start from {0}: what bounds a light is optional, and a zero there says that nothing does. The method stencil leaves
 * out what lies outside the bounds, so they must hold: nothing outside may be lit. */
typedef struct gn_light {
    gn_light_kind kind;
    double position[3]; /* world; point and spot */
    /* world, any length but 0: towards a directional light; of a spot with a cone, against its axis */
    double towards[3];
    double cone;  /* spot: half the angle of its cone, radians, less than pi / 2 [no cone] */
    double range; /* point and spot: nothing farther is lit [unlimited] */
    /* The most that it adds to a pixel where its attenuation is 1, by channel, 1 being full: its reach is the distance
     * from which on every channel stays under half a step of the target's bits, which then add nothing [unlimited] */
    double color[3];
    double attenuation[3];         /* k of 1 / (k[0] + k[1] d + k[2] d^2) at the distance d [1: none] */
    double box_min[3], box_max[3]; /* world: nothing outside is lit, by a light of any kind [both 0: no box] */
    const uint32_t *exempt;        /* [exempt_count] objects that do not cast in its light; borrowed for the call */
    uint32_t exempt_count;
} gn_light;

/* A light with extent as `count` lights within `radius` of it, each with as much of its color, at jittered places that
 * are the same in every frame (McGuire 2003, section 4). radius: of a directional light, of its disc at distance 1 (the
 * sun's is 0.0047); one light alone stays where it is. Each has the bounds of the whole; the list of the exempt stays
 * borrowed. out: [count]. Returns GN_OK, GN_E_ARG. */
gn_result gn_light_soften(gn_context *context, const gn_light *light, double radius, uint32_t count, gn_light *out);

enum {
    GN_CASTS = 1, /* its triangles block light */
    /* It is drawn under the mask; without: lit as if nothing stood in the way. What does not touch an object with this
     * flag need not be drawn, once any object has it: so all that receives must be among the objects then. */
    GN_RECEIVES = 2,
    GN_DRAWN = 4,      /* every triangle whose front the eye sees is drawn to depth: none is cut by alpha or left out */
    GN_DRAWN_BACKS = 8 /* and so is every one whose back it sees. With both flags z-pass does without its light cap */
};

/* A mesh in the world: caster, receiver, or both. Start from {0}. */
typedef struct gn_object {
    const gn_mesh *mesh; /* borrowed while the plan lives */
    double model[16];    /* object to world; last row 0 0 0 1 */
    unsigned flags;      /* of GN_CASTS, GN_RECEIVES, GN_DRAWN, GN_DRAWN_BACKS */
    double error; /* how far the surface of what it stands for may be from it: of a proxy that casts in the place of
                            something finer. Object space; the plan says what comes of it [0] */
} gn_object;

/* gn_facing() and gn_casting() for an object in the world: [triangle_count]. A model matrix without inverse, which
 * flattens the object, is lawful: fronts are then those of the flattened triangles; lit ones cast in solid parts,
 * all in others. */
void gn_object_facing(const gn_object *object, const gn_light *light, int8_t *facing);
void gn_object_casting(const gn_object *object, const gn_light *light, int8_t *casting);

/* What is drawn into, and what can be done there. gn_gles_describe_target() fills it. */
typedef struct gn_target {
    uint32_t width, height;
    int red_bits, green_bits, blue_bits, alpha_bits;
    int depth_bits, stencil_bits;
    int samples;
    int mediump_bits;                    /* of mantissa that mediump keeps in fragment shaders; 0: not known */
    uint32_t advertised, proven, hidden; /* sets of gn_capability */
} gn_target;

/* Proven and not hidden. */
int gn_target_can(const gn_target *target, gn_capability capability);

/* ---- Methods ---- */

typedef enum gn_method {
    GN_METHOD_AUTO,  /* the best exact one that the target can do */
    GN_METHOD_ZFAIL, /* stencil, closed volumes, counted behind what is seen (Everitt 2002) */
    GN_METHOD_ZPASS, /* stencil, counted before what is seen: wrong where a volume meets the near plane (Hoxley 2003) */
    GN_METHOD_STENCIL, /* stencil, before or behind what is seen for each caster, by the occlusion pyramid (McGuire 2003) */
    GN_METHOD_COUNT
} gn_method;

typedef struct gn_method_info {
    const char *name;    /* what --method takes */
    const char *summary; /* one line */
    uint32_t needs;      /* capabilities that it cannot do without */
    uint32_t likes;      /* and those that it does with less, or more slowly, without */
    int exact;
} gn_method_info;

/* NULL when method is not one of gn_method. */
const gn_method_info *gn_method_describe(gn_method method);

/* GN_METHOD_COUNT when there is no such name. A stencil method's name may end in "/one-sided": *one_sided is then 1,
 * otherwise 0. */
gn_method gn_method_by_name(const char *name, int *one_sided);

/* Of a stencil that tells lit from shadowed by a count in its low bits (DESIGN.md, decision 10). A pixel is lit where
 * the stencil's bits of `mask` equal the reference. */
typedef struct gn_stencil_layout {
    int two_sided;  /* 0: every caster is drawn twice, one side of its volume at a time, what counts up first */
    int discard;    /* then the other side is discarded by gl_FrontFacing; 0: culled, which may lose slivers */
    int wrap;       /* counts go round at 256; 0: they stop at the ends */
    int reference;  /* the value of a pixel that no volume holds; buffers are cleared to it */
    int low, high;  /* counts, from the reference, that are kept. Wrapping: of the sum; else also on the way to it */
    int bits;       /* of the count */
    int flag;       /* the bit above: set where an earlier batch left a count; 0 where there is one batch */
    int patch_bits; /* above the count: they name the patch that is seen; 0: patches are counted as all else */
    int mask;       /* of count and flag */
} gn_stencil_layout;

/* How the far end of a volume survives clipping at the far plane. */
typedef enum gn_far {
    GN_FAR_INFINITE, /* at infinity, w = 0, under a projection that ends there too */
    GN_FAR_CLAMPED,  /* at infinity, drawn under depth clamp */
    GN_FAR_ENDED     /* behind all that is seen and receives */
} gn_far;

/* What the method stencil does to fill no more than a receiver needs. All of it is exact; each moves pixels next to a
 * discontinuity at most. */
enum {
    GN_MEASURE_ENDS = 1,     /* volumes end right behind the last thing that they may shadow, or at the light's reach */
    GN_MEASURE_SCISSORS = 2, /* and are counted only where such things are seen */
    GN_MEASURE_PATCHES = 4,  /* on flat receivers projections are counted, and volumes reach the others only */
    /* ended volumes are left out between the things that they may shadow, of which only what is seen counts */
    GN_MEASURE_INTERVALS = 8
};

#define GN_MOST_PATCHES 3 /* planes whose flat receivers need no volumes; two bits of stencil name them */

/* ---- Plan: what will be drawn, as data, decided before any GL call ---- */

typedef struct gn_scene {
    gn_camera camera;
    const gn_light *lights; /* borrowed for the call */
    uint32_t light_count;
    const gn_object *objects; /* borrowed for the call; their meshes while the plan lives */
    uint32_t object_count;
    gn_target target;
    gn_method method;
    int one_sided; /* 1: one side of volumes at a time, even where two-sided stencil is proven */
    /* 1: of coincident surfaces only the first that is drawn is lit, by counting in the light's pass (Everitt 2002,
     * section 6, step E), and the host may write no stencil of its own; otherwise their light adds up where their
     * depths are the same */
    int blend_once;
    /* A choice: lights that add no more than this to any pixel are left out, by the method stencil. Their bounds,
     * colors and attenuations must be given; gn_plan_light.possible_error says what may be missing [0: none is left
     * out] */
    double least_light;
    gn_shadow_cache *cache; /* borrowed while the plan lives; one plan at a time [NULL: none] */
    unsigned without;       /* to measure them: a set of gn_measure that the method stencil does without */
} gn_scene;

enum { GN_SIDES = 1, GN_LIGHT_CAP = 2, GN_DARK_CAP = 4, GN_NEAR_CAP = 8 };

/* One chunk of one caster's volume for one light, or of an interval of it. Its indices stand in gn_plan.indices, or in
 * gn_plan.cached_indices, from first_index on: light cap, sides, dark cap, near cap. The turned light cap stands apart,
 * the part of the light cap whose triangles cast turned round; it keeps its drawn order of vertices (DESIGN.md, decision
 * 4), so that its front counts as back. The near cap closes an interval that does not start at the caster. */
typedef struct gn_record {
    uint32_t light, object, chunk;
    unsigned parts; /* of GN_SIDES, GN_LIGHT_CAP, GN_DARK_CAP, GN_NEAR_CAP: those with triangles */
    int is_cached;  /* its indices are in gn_plan.cached_indices */
    uint32_t first_index, first_side, first_dark_cap, first_turned_cap;
    uint32_t light_cap_count, side_count, dark_cap_count, near_cap_count, turned_cap_count; /* indices */
    int fan;          /* the dark cap is spanned over the silhouette */
    uint32_t patch;   /* not 0: a projection onto this patch, its dark cap alone, counted where the patch is seen */
    int unpatched;    /* counted only where no patch is seen */
    int slivers;      /* of the light cap only triangles that are seen nearly edge-on */
    int mcguire_case; /* 1: by z-pass; 2, 3: by z-fail; 0: on a patch */
    int mirrored;     /* the model matrix swaps front and back */
    int detached;     /* it starts on start_plane, and not at the caster */
    gn_far far_end;
    double start_plane[4]; /* world */
    double end_plane[4];   /* world; the volume ends there. 0 0 0 1 is the plane at infinity */
    double end_reach; /* not 0: no plane; it ends at so many times its distance from the light, or so much farther */
    float near_matrix[16]; /* a near vertex's clip position is this times its position: the object's, if not detached */
    float far_matrix[16];  /* a far vertex's */
    uint32_t scissor[4];   /* x, y, width, height in pixels: within the light's; nothing outside needs it */
} gn_record;

typedef enum gn_step_kind {
    GN_STEP_CLEAR,   /* colour, depth and stencil, unmasked; the stencil to the reference of light 0 */
    GN_STEP_ZERO,    /* the stencil becomes the reference of `light` again, by a quad in its scissor */
    GN_STEP_VOLUMES, /* records are counted into the stencil */
    GN_STEP_DRAW,    /* the host's: see gn_draw */
    GN_STEP_FOLD,    /* where the count is not nought it becomes nought and the flag is set, by a quad in the scissor */
    GN_STEP_MARK,    /* patches are named in the stencil of the pixels where they are seen */
    GN_STEP_DARKEN   /* all of `patch` that is in the light's scissor is shadow: its seen side looks away */
} gn_step_kind;

typedef enum gn_draw {
    GN_DRAW_NOTHING, /* the step is the library's own */
    GN_DRAW_AMBIENT, /* every opaque object: depth and ambient light together */
    GN_DRAW_LIGHT,   /* objects that receive (or those that do not), added, under the mask of `light` */
    GN_DRAW_FINAL    /* transparent things and labels: McGuire's last pass */
} gn_draw;

typedef struct gn_step {
    gn_step_kind kind;
    gn_draw draw;
    uint32_t light; /* index into the scene's lights, where it matters */
    int receivers;  /* GN_DRAW_LIGHT: 1 draw what receives, under the mask; 0 draw the rest, unmasked */
    uint32_t first_record, record_count; /* GN_STEP_VOLUMES */
    uint32_t patch;                      /* GN_STEP_DARKEN */
} gn_step;

/* Why something is not drawn. */
typedef enum gn_skip {
    GN_SKIP_NOT,          /* it is drawn */
    GN_SKIP_NO_CASTER,    /* an object: it has not the flag GN_CASTS */
    GN_SKIP_EXEMPT,       /* an object: the light's list exempts it */
    GN_SKIP_NO_TRIANGLE,  /* an object: none of its triangles casts in this light, or none on what is seen */
    GN_SKIP_OUT_OF_REACH, /* an object: it lies beyond the light's reach, or outside its cone or box */
    GN_SKIP_OUT_OF_VIEW,  /* an object: its volume misses what is seen. A light: so does all that it reaches */
    GN_SKIP_NO_RECEIVER, /* an object: its volume misses all that receives, is seen and reached. A light: there is nothing
                             such, nor anything else to be lit */
    GN_SKIP_FAINT,       /* a light: it adds less than half a step anywhere */
    GN_SKIP_UNIMPORTANT, /* a light: it adds no more than gn_scene.least_light */
    GN_SKIP_LIGHT,       /* an object: its light is skipped */
    GN_SKIP_ENDLESS      /* an object: its volume has no end under an orthographic camera: a warning */
} gn_skip;

typedef struct gn_plan_light {
    gn_method method;
    char reason[256]; /* why this method, and this way of it: a sentence */
    gn_skip skip;     /* not GN_SKIP_NOT: there is no step for it */
    gn_stencil_layout stencil;
    double reach; /* what is farther is not lit, and a little more for rounding; INFINITY: no bound */
    uint32_t
        scissor[4]; /* x, y, width, height in pixels: nothing outside is lit; the whole target: no bound; all 0: the
                                 light is skipped */
    double depth_bounds[2]; /* window depths of what it lights; 0, 1: no bound */
    double caster_error;   /* how far a shadow's edge may be off where it starts: by proxies' errors and welded edges */
    double light_moved;    /* since the oldest shadow from the cache was found, as its caster sees it */
    double possible_error; /* the most that skipping it takes from a pixel; 0 unless it is GN_SKIP_UNIMPORTANT */
    uint32_t casters;      /* with a volume, or a projection on a patch */
    uint32_t cases[3];     /* of them: McGuire's case 1 (z-pass), 2 (z-fail, no light cap), 3 (z-fail with it) */
    uint32_t skipped_casters; /* that might have cast, and were skipped */
    uint32_t layers;          /* no point is blocked by more casting triangles of one batch than this */
    uint32_t batches;         /* in which volumes are counted, folded into the flag between */
} gn_plan_light;

/* What became of one object in one light. */
typedef struct gn_plan_caster {
    uint8_t skip;         /* gn_skip */
    uint8_t mcguire_case; /* 1 to 3; 0 when it has no volume */
    uint8_t parts;        /* of GN_SIDES, GN_LIGHT_CAP, GN_DARK_CAP, GN_NEAR_CAP: drawn */
    uint8_t fan;          /* its dark cap is a fan */
    uint8_t patches;      /* on which it is projected: bit p for patch p + 1 */
    uint8_t is_ended;     /* its volume ends behind the last thing that it may shadow */
    uint8_t is_lit;       /* 0: out of view or of the light's bounds; the host need not draw it in the light's passes */
} gn_plan_caster;

/* What a plan cannot keep, known before the frame. */
typedef enum gn_warning {
    /* Counting stops at the ends of the range and more triangles cast than that: nothing proves that they are not
     * behind each other on some line of sight. */
    GN_WARN_OVERFLOW,
    /* Volumes of orthographic cameras that were left out, because the light is so close to so many large triangles that
     * their ends need too many planes. */
    GN_WARN_ENDLESS,
    /* From some distance on four steps of depth are larger than a pixel, and something that receives is seen there:
     * edges of shadows may stray by more than a pixel, and thin things lose theirs. */
    GN_WARN_DEPTH,
    /* Something in view has vertices so far from the plane of the eye, before it or behind, that a float of a vertex
     * shader does not tell their depth from infinity (znear times 2^21): all of such triangles may be too deep. */
    GN_WARN_FLOAT,
    GN_WARNING_COUNT
} gn_warning;

typedef struct gn_plan_object {
    const gn_mesh *mesh;
    unsigned flags;
    int mirrored;
    uint8_t patch;    /* of GN_MOST_PATCHES, which it is part of; 0: of none */
    float matrix[16]; /* positions less the mesh's centre to clip space: for every pass of this object */
} gn_plan_object;

/* Lives in the memory that was given to gn_plan_make(), and as long. Plain data; may be copied out, compared,
 * printed. */
typedef struct gn_plan {
    gn_target target;
    int blend_once;     /* as in the scene */
    double clear_depth; /* 1, or the depth of zfar */
    /* View distances that depth 0 and 1 stand for. [0] is znear, or up to an eighth less, so that floats tell it from
     * w; [1] is INFINITY for most perspective cameras. */
    double depth_range[2];
    const gn_step *steps;
    uint32_t step_count;
    const gn_record *records;
    uint32_t record_count;
    const uint16_t *indices;
    uint32_t index_count;
    uint32_t cache_id;              /* 0: there is none; no two of a context are alike */
    const uint16_t *cached_indices; /* until the cache's next plan */
    uint32_t cached_index_count, cached_capacity;
    uint32_t cache_version, cache_base; /* base: that before this plan; since then only [first, end) has changed: */
    uint32_t cache_changed[2];
    uint32_t cache_built; /* streams found anew in this plan */
    const gn_plan_light *lights;
    uint32_t light_count;
    const gn_plan_object *objects;
    uint32_t object_count;
    const gn_plan_caster *casters; /* [light_count][object_count] */
    uint32_t patch_count;
    double patches[GN_MOST_PATCHES][4]; /* world: planes, positive where the eye is */
    uint32_t warnings;                  /* set of gn_warning: bit 1u << warning */
    uint32_t endless_casters;           /* left out with GN_WARN_ENDLESS; one is counted for each light */
    double depth_limit;      /* the view distance from which on four steps of depth are larger than a pixel */
    double farthest_vertex;  /* the greatest distance from the plane of the eye of anything that may be seen */
    double deepest_receiver; /* the view distance of the farthest thing that receives and may be seen */
} gn_plan;

/* Bytes that gn_plan_make() may need for this scene at most, whatever the camera, the lights' places and the model
 * matrices are: it depends on the counts, the meshes, the flags, camera.orthographic, camera.finite_far and the
 * target's capabilities only. 0 when scene is NULL or the size does not fit size_t. */
size_t gn_plan_bound(const gn_scene *scene);

/* Makes the plan of a frame in the given memory (aligned for double). Pure but for the cache: equal scenes give equal
 * bytes. Allocates nothing, but for a cache that grows. Returns GN_OK; GN_E_ARG for what is not finite or out of range;
 * GN_E_SPACE; GN_E_DEVICE when the method needs what the target lacks, or when a volume would be clipped at the far
 * plane. Cost, for each light: O(triangles of casters); boxes of casters against boxes of receivers; a facing
 * of each receiver for the eye, once; and where more layers are possible than the stencil counts, a few
 * times as much again for each batch. */
gn_result gn_plan_make(gn_context *context, const gn_scene *scene, void *memory, size_t size, const gn_plan **plan);

/* The method of one of the plan's lights with its suffix: "zfail", "zfail/one-sided". Static; "" for a light that is
 * none of the plan's. */
const char *gn_plan_method_name(const gn_plan *plan, uint32_t light);

/* Sentences about a plan, into text[capacity]: always terminated when capacity > 0; they return the length that the
 * whole has, like snprintf, and 0 for what is not of the plan.
 *
 * Of a light: its method and why, what bounds it, how it is counted, or why it is skipped. */
size_t gn_plan_explain_light(const gn_plan *plan, uint32_t light, char *text, size_t capacity);
/* Of an object in a light: its case and why, what is drawn of its volume; or why it is skipped. */
size_t gn_plan_explain_caster(const gn_plan *plan, uint32_t light, uint32_t object, char *text, size_t capacity);
/* Of a warning; 0 when it is not among the plan's. */
size_t gn_plan_explain_warning(const gn_plan *plan, gn_warning warning, char *text, size_t capacity);

/* Writes the plan as JSON into text[capacity], always terminated when capacity > 0, and returns the length that the
 * whole has, like snprintf. */
size_t gn_plan_json(const gn_plan *plan, char *text, size_t capacity);

#ifdef __cplusplus
}
#endif
#endif
