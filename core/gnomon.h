/* gnomon.h - shadow volumes, the part with no GL in it. Its second half, methods and plans, is gn_plan.h, which it
 * includes.
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
 * features  a library may be built to do less (FEATURES in the Makefile; core/gni_features.h). What it lacks it refuses with
 *           GN_E_DEVICE, or the linker does: functions of rules, the selector, explanations and JSON are not there
 *           then. `pkg-config --variable=features gnomon` lists what it has
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
    GN_E_DEVICE /* this target, or this build of the library (FEATURES), cannot do it; the message names what is missing */
} gn_result;

/* ---- Context: a port and the last message ---- */

typedef struct gn_context gn_context;

/* Copies port (NULL: gn_port_libc()). Proves it first: one block is asked for, checked and given back, the clock is
 * read twice. Returns GN_OK, GN_E_ARG, GN_E_MEMORY; *context is NULL unless GN_OK. */
gn_result gn_context_create(const gn_port *port, gn_context **context);
void gn_context_destroy(gn_context *context);

/* The last failure, as a sentence. Never NULL; valid until the next call on the context. A build without the feature
 * messages has one sentence for all, and sends no compiler's log to the port. */
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
    int planar;                     /* 1: all triangles lie in one plane; 2: and are wound alike. 0 without culling */
    const float *positions;         /* [vertex_count][3], welded, less the centre */
    const uint32_t *triangles;      /* [triangle_count][3], into positions */
    const gn_chunk *chunks;         /* [chunk_count] */
    const uint32_t *chunk_vertices; /* into positions */
    const uint16_t
        *corners; /* [triangle_count][3]: index of each corner's near vertex, in its chunk. Not in the order of
                                `triangles`, but in the mesh's own, in which chunks are runs */
} gn_mesh_info;

/* Copies what it needs. Vertices are welded by exact position (-0 equals 0). Degenerate and duplicate triangles are
 * lawful; a mesh may have no triangle at all. Returns GN_OK, GN_E_ARG, GN_E_MESH, GN_E_MEMORY; GN_E_DEVICE for a
 * weld angle in a library without the feature welding; *mesh is NULL unless GN_OK. Time O(triangles log triangles); holds about 150 bytes a triangle. */
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
    /* A choice of its own: masks in textures are made anew only in every so many frames, and used as they are in between,
     * whatever has moved: gn_plan.mask_age. gn_scene.reads_masks must be set [1: in each] */
    uint32_t masks_every;
} gn_shadow_cache_desc;

/* Returns GN_OK, GN_E_ARG, GN_E_MEMORY; GN_E_DEVICE in a library without the feature cache; *cache is NULL unless GN_OK. Without
 * memory later the cache keeps less. */
gn_result gn_shadow_cache_create(gn_context *context, const gn_shadow_cache_desc *desc, gn_shadow_cache **cache);
void gn_shadow_cache_destroy(gn_shadow_cache *cache);

/* The next plan makes its masks anew: what was drawn of them is gone, with a lost context or since another plan has made
 * masks. gn_gles_begin() refuses a plan whose masks are gone. */
void gn_shadow_cache_forget_masks(gn_shadow_cache *cache);

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
 * borrowed. out: [count]. Returns GN_OK, GN_E_ARG; GN_E_DEVICE for several in a library without the feature culling. */
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
 * all in others; in a library without the feature solids none casts, and plans refuse it. */
void gn_object_facing(const gn_object *object, const gn_light *light, int8_t *facing);
void gn_object_casting(const gn_object *object, const gn_light *light, int8_t *casting);

/* What is drawn into, and what can be done there. gn_gles_describe_target() fills it. */
typedef struct gn_target {
    uint32_t width, height;
    int red_bits, green_bits, blue_bits, alpha_bits;
    int depth_bits, stencil_bits;
    int image_depth_bits;  /* the most that a framebuffer object of the library's own has: 24 or 16; 0: none */
    uint32_t framebuffer;  /* the GL's name of it */
    uint32_t shared_depth; /* of a depth renderbuffer that is its depth, and can be another's too; 0: none */
    int samples;
    int mediump_bits;                    /* of mantissa that mediump keeps in fragment shaders; 0: not known */
    uint32_t advertised, proven, hidden; /* sets of gn_capability */
} gn_target;

/* Proven and not hidden. */
int gn_target_can(const gn_target *target, gn_capability capability);

#ifdef __cplusplus
}
#endif

#include "gn_plan.h"
#endif
