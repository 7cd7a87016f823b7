/* gltf.h - what the files of the glTF reader share: the open document, and the reading of its parts.
 *
 * Private to gltf_*.c and scene_*.c. scene.h is the header for everybody else.
 *
 * The parts run one way:
 *
 *   scene.c -> gltf_node.c -> gltf_view.c                        nodes, cameras, lights
 *           -> gltf_mesh.c, gltf_animation.c -> gltf_accessor.c  numbers out of buffers
 *           -> gltf_material.c -> gltf_image.c                   colours and textures
 *           -> gltf_file.c -> gltf_uri.c                         .gltf, .glb, buffers
 *   all of them -> gltf_json.c                                   checked reading of JSON, messages
 *
 * Functions that can fail return 1, or 0 (NULL) with the document's message set. A file is not to be trusted: every
 * number is checked where it is read, so that whoever uses it later need not. */
#ifndef GLTF_H
#define GLTF_H
#include "scene.h"

#include <cjson/cJSON.h>

#ifdef __GNUC__
#define GLTF_PRINTF(text, first) __attribute__((format(printf, text, first)))
#else
#define GLTF_PRINTF(text, first)
#endif

/* Far above what a small board draws, and low enough that a few hostile bytes cannot ask for all memory: 2^24 vertices
 * are 0.8 GiB in a scene_mesh. */
#define GLTF_VERTICES_MAX  16777216u   /* in a scene, and in an accessor */
#define GLTF_TRIANGLES_MAX 16777216u   /* in a scene */
#define GLTF_ELEMENTS_MAX  1073741824u /* read from accessors, over the whole load: bounds its time */
#define GLTF_TEXTURE_MAX   8192u       /* texels along a side */
#define GLTF_TEXELS_MAX    268435456u  /* of all textures together: four of the largest, 1 GiB */
#define GLTF_FILE_MAX      1073741824u /* bytes of one file */

#define GLTF_WHERE 64 /* bytes for the name of a place, such as "mesh 3 primitive 1" */

/* The top-level arrays of the document, and the lights of KHR_lights_punctual. */
typedef enum gltf_kind {
    GLTF_ACCESSOR,
    GLTF_ANIMATION,
    GLTF_BUFFER,
    GLTF_VIEW,
    GLTF_CAMERA,
    GLTF_IMAGE,
    GLTF_LIGHT,
    GLTF_MATERIAL,
    GLTF_MESH,
    GLTF_NODE,
    GLTF_SAMPLER,
    GLTF_SCENE,
    GLTF_TEXTURE,
    GLTF_KINDS
} gltf_kind;

/* cJSON's arrays are linked lists: the n-th element costs n steps. These are looked up by index all the time. */
typedef struct gltf_list {
    const cJSON **items; /* each is an object */
    size_t count;
} gltf_list;

typedef struct gltf_bytes {
    uint8_t *data;
    size_t size;
} gltf_bytes;

/* How a material's base texture finds its coordinates: they are baked into each primitive's uvs. */
typedef struct gltf_uv_source {
    int set;                                  /* n of TEXCOORD_n, or SCENE_NONE without a texture */
    double offset[2], scale[2], cosine, sine; /* KHR_texture_transform */
} gltf_uv_source;

typedef struct gltf {
    const char *path;
    void (*warn)(const char *line); /* may be NULL */
    char *message;                  /* [SCENE_MESSAGE] */

    gltf_bytes file;
    cJSON *root;
    gltf_list lists[GLTF_KINDS];
    gltf_bytes *buffers; /* [count of GLTF_BUFFER]; data is NULL where the document gives none */
    uint8_t *glb_chunk;  /* the binary chunk of a .glb, inside `file`: buffer 0 may borrow it */
    size_t glb_chunk_size;

    gltf_uv_source *uv_sources; /* [material_count] */
    double (*boxes)[2][3];      /* [mesh_count] lowest and highest position, where the mesh has triangles */
    size_t vertices, triangles, elements, texels; /* so far, against the limits above */
} gltf;

/* --- gltf_json.c --- */

/* Sets the message to "file: " and the formatted text, one line whatever the names in it. Returns 0. */
int gltf_fail(gltf *g, const char *format, ...) GLTF_PRINTF(2, 3);
int gltf_fail_memory(gltf *g, size_t bytes);
void gltf_warn(gltf *g, const char *format, ...) GLTF_PRINTF(2, 3);

/* malloc for count elements of `size` bytes each; sets the message when it cannot. A count of 0 gives memory too. */
void *gltf_alloc(gltf *g, size_t count, size_t size);
void *gltf_alloc_zeroed(gltf *g, size_t count, size_t size);

/* A member, or NULL without it (or where `object` is NULL or no object). */
const cJSON *gltf_get(const cJSON *object, const char *key);
const cJSON *gltf_get_extension(const cJSON *object, const char *name);
const char *gltf_get_string(const cJSON *object, const char *key);

/* Each of these leaves *out as it is, and returns 1, when the member is absent: set the default first. They fail when
 * it has another type or is out of range; `where` says in the message where that was. */
int gltf_get_bool(gltf *g, const char *where, const cJSON *object, const char *key, int *out);
int gltf_get_number(gltf *g, const char *where, const cJSON *object, const char *key, double lowest, double highest,
                    double *out);
int gltf_get_numbers(gltf *g, const char *where, const cJSON *object, const char *key, size_t count, double *out);
int gltf_get_size(gltf *g, const char *where, const cJSON *object, const char *key, size_t *out);
int gltf_get_index(gltf *g, const char *where, const cJSON *object, const char *key, gltf_kind kind, int *out);

/* An array member as cJSON has it: *out is NULL when absent. */
int gltf_get_array(gltf *g, const char *where, const cJSON *object, const char *key, const cJSON **out);

/* An index written as a bare number, such as a node's child. */
int gltf_index(gltf *g, const char *where, const char *key, const cJSON *item, gltf_kind kind, int *out);

/* --- gltf_uri.c --- */

/* Reads a whole regular file; a NUL stands after its last byte. */
int gltf_read_file(gltf *g, const char *where, const char *path, gltf_bytes *out);

/* Reads what a URI names: a file beside the document, or base64 data in the URI itself. */
int gltf_read_uri(gltf *g, const char *where, const char *uri, gltf_bytes *out);

/* --- gltf_file.c --- */

/* Opens a document: container, JSON, version, required extensions, lists, buffers. gltf_close() after either result. */
int gltf_open(gltf *g);
void gltf_close(gltf *g);

/* A buffer view's bytes, borrowed until gltf_close(), and its byteStride, 0 when it has none. */
int gltf_view_bytes(gltf *g, int view, const uint8_t **data, size_t *size, size_t *stride);

/* --- gltf_accessor.c --- */

/* Bits for what a place allows an accessor to be. */
#define GLTF_WIDE(components) (1u << (components)) /* 1 SCALAR, 2 VEC2, 3 VEC3, 4 VEC4 */
#define GLTF_INT8             (1u << 8)
#define GLTF_UINT8            (1u << 9)
#define GLTF_INT16            (1u << 10)
#define GLTF_UINT16           (1u << 11)
#define GLTF_UINT32           (1u << 13)
#define GLTF_FLOAT            (1u << 14)
#define GLTF_NORMALIZED       (1u << 16) /* integers only if the accessor says "normalized" */
#define GLTF_SMALL_INTEGERS   (GLTF_INT8 | GLTF_UINT8 | GLTF_INT16 | GLTF_UINT16)
#define GLTF_INDICES          (GLTF_UINT8 | GLTF_UINT16 | GLTF_UINT32)

typedef struct gltf_accessor {
    int index;
    size_t count;
    unsigned components, type; /* type: glTF's number, 5120 to 5126 */
    int normalized;
    size_t stride;
    const uint8_t *data; /* NULL: all zero, but for the sparse elements */
    size_t sparse_count;
    unsigned sparse_type;
    const uint8_t *sparse_indices, *sparse_values;
} gltf_accessor;

/* Checks everything about an accessor: after it, no read of its elements can leave its buffer. */
int gltf_open_accessor(gltf *g, const char *where, const char *what, int index, unsigned allowed, size_t count_max,
                       gltf_accessor *out);

/* [count][components], to be freed by the caller; NULL on failure. */
float *gltf_read_floats(gltf *g, const gltf_accessor *a);
uint32_t *gltf_read_indices(gltf *g, const gltf_accessor *a);

/* --- gltf_image.c --- */

/* Decodes image `image` for a texture whose wrap and nearest are set. On success out->rgba is NULL when the image is
 * no PNG, which has been told to warn. */
int gltf_read_image(gltf *g, int image, scene_texture *out);

/* --- gltf_material.c, gltf_mesh.c, gltf_node.c, gltf_view.c, gltf_animation.c: each fills its part of the scene --- */
int gltf_read_materials(gltf *g, scene *s);
int gltf_read_meshes(gltf *g, scene *s);
int gltf_read_nodes(gltf *g, scene *s);
int gltf_read_camera(gltf *g, int camera, scene_camera *out);
int gltf_read_light(gltf *g, int light, scene_light *out);
int gltf_read_animations(gltf *g, scene *s);

/* --- what scene_pose.c needs of nodes and animations --- */

typedef enum scene_path { SCENE_TRANSLATION, SCENE_ROTATION, SCENE_SCALE } scene_path;
typedef enum scene_steps { SCENE_STEP, SCENE_LINEAR, SCENE_CUBIC } scene_steps;

struct scene_node {
    int parent, first_child, next_sibling; /* SCENE_NONE at the ends */
    int order;                             /* node k's `order` is the k-th node of the scene's walk, or SCENE_NONE */
    int mesh, camera, light;               /* of the document, or SCENE_NONE */
    int casts, receives, is_static;
    int moves; /* itself animated */
    int has_matrix;
    double translation[3], rotation[4], scale[3]; /* as posed last */
    double local[16];                             /* of a node with a matrix */
    double world[16];
    double box[2][3]; /* of its mesh */
};

typedef struct scene_channel {
    int node;
    scene_path path;
    scene_steps steps;
    size_t count;  /* of keys, at least 1 */
    float *times;  /* [count], never falling */
    float *values; /* [count][3 or 4]; cubic: [count][3][3 or 4], tangent in, value, tangent out */
} scene_channel;

struct scene_animation {
    scene_channel *channels;
    size_t count;
};

/* scene_pose.c: the value of a channel at a time: 3 or 4 numbers, a rotation of unit length. */
void scene_sample(const scene_channel *c, double seconds, double out[4]);

/* scene.c: samples a picture of any size at a texture coordinate: 4 values from 0 to 255. */
void scene_sample_texture(const scene_texture *t, const double uv[2], double out[4]);
#endif
