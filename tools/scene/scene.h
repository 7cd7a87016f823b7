/* scene.h - a glTF 2.0 scene as the tools see it: triangles under transforms, a camera, lights, textures.
 *
 * The reader (gltf_*.c) fills a `scene`; scene_pose() places it at a time of its animation; the demo stage draws it and
 * the truth traces it. Nothing here knows shadows, GL, or the library beyond its matrices.
 *
 * space     positions and normals in mesh space; matrices take mesh space to world space
 * order     instances and lights stand in the order of a depth-first walk of the scene's root nodes (CLI.md)
 * lifetime  scene_free() frees all; a zeroed scene may be freed
 * errors    0 on failure, with one line "what: why (number or name)" in `message`; nothing is left allocated then */
#ifndef SCENE_H
#define SCENE_H
#include <stddef.h>
#include <stdint.h>

#define SCENE_NONE    (-1)
#define SCENE_MESSAGE 512 /* bytes in a message */

typedef enum scene_alpha { SCENE_OPAQUE, SCENE_MASK, SCENE_BLEND } scene_alpha;
typedef enum scene_light_kind { SCENE_POINT, SCENE_SPOT, SCENE_DIRECTIONAL } scene_light_kind;
typedef enum scene_wrap { SCENE_REPEAT, SCENE_CLAMP, SCENE_MIRROR } scene_wrap;

/* Decoded and, where it was not so already, resampled to powers of two (OpenGL ES 2.0 repeats nothing else). */
typedef struct scene_texture {
    uint32_t width, height; /* powers of two */
    uint8_t *rgba;          /* [height][width][4], row 0 first in the file (v = 0), sRGB-encoded colour, linear alpha */
    scene_wrap wrap[2];     /* s, t */
    int nearest;            /* magnified by the nearest texel, not linearly */
} scene_texture;

typedef struct scene_material {
    double base_color[4]; /* linear factor */
    double metallic, roughness;
    double emissive[3];
    int texture; /* of base colour, index into textures, or SCENE_NONE */
    scene_alpha alpha;
    double alpha_cutoff;
    int double_sided;
} scene_material;

/* Part of a mesh under one material. */
typedef struct scene_range {
    uint32_t first_triangle, triangle_count;
    int material; /* index into materials, never SCENE_NONE: the default material is the last one */
} scene_range;

/* One glTF mesh, its triangle primitives together; ranges of BLEND materials come last. Where a primitive has no
 * normals its vertices are its own for each triangle, with the flat normal. */
typedef struct scene_mesh {
    uint32_t vertex_count, triangle_count;
    uint32_t solid_triangle_count; /* those before the first BLEND range: they are seen in the mask, and may cast */
    float *positions;              /* [vertex_count][3] */
    float *normals;                /* [vertex_count][3], unit length (a zero-area triangle's may be any unit vector) */
    float *uvs;                    /* [vertex_count][2], the set that the material's base texture names; 0 without */
    float *colors;                 /* [vertex_count][4], COLOR_0, 1 without */
    uint32_t *indices;             /* [triangle_count][3], all < vertex_count */
    scene_range *ranges;
    size_t range_count;
} scene_mesh;

/* A mesh at a node. */
typedef struct scene_instance {
    int node,
        mesh; /* node SCENE_NONE: of a scene that was not read; it stands where it is, and bounds know nothing of it */
    int casts, receives, is_static; /* from the node's extras */
    double world[16];               /* set by scene_pose() */
} scene_instance;

typedef struct scene_light {
    int node; /* or SCENE_NONE for the one that scene_ensure_view() placed */
    scene_light_kind kind;
    double color[3];     /* linear */
    double intensity;    /* candela (point, spot) or lux (directional) */
    double range;        /* 0: unlimited */
    double inner, outer; /* cone angles from the axis, radians */
    double position[3];  /* world, set by scene_pose(); 0 for directional */
    double towards[3];   /* world unit vector, against the direction in which the light shines; set by scene_pose() */
    uint32_t *exempt;    /* [exempt_count] instances that do not cast in it, from the extras of the light's node */
    size_t exempt_count;
} scene_light;

typedef struct scene_camera {
    int node; /* or SCENE_NONE for the one that scene_ensure_view() placed */
    int orthographic;
    double yfov; /* radians, whole angle */
    double xmag, ymag;
    double znear, zfar; /* zfar 0: infinite */
    double world[16];   /* camera to world, orthonormal, right-handed, scale removed; set by scene_pose() */
} scene_camera;

typedef struct scene_animation scene_animation; /* private to the reader */
typedef struct scene_node scene_node;           /* private to the reader */

typedef struct scene {
    scene_texture *textures;
    size_t texture_count;
    scene_material *materials;
    size_t material_count;
    scene_mesh *meshes;
    size_t mesh_count;
    scene_instance *instances;
    size_t instance_count;
    scene_light *lights;
    size_t light_count;
    scene_camera camera;
    int has_camera;
    scene_node *nodes;
    size_t node_count;
    scene_animation *animation;
    double duration;                     /* seconds; 0: nothing moves */
    double bounds_min[3], bounds_max[3]; /* of all instances at the last scene_pose(), world */
} scene;

/* Reads SCENE.gltf (with its buffers and images beside it or in data URIs) or SCENE.glb, and poses it at time 0. What
 * is lawful but not used here (say, a JPEG) is told to `warn`, one line each; warn may be NULL. Returns 1 or 0. */
int scene_load(scene *out, const char *path, void (*warn)(const char *line), char message[SCENE_MESSAGE]);

/* Places instances, lights and the camera as they are `seconds` into the animation (held before its start and after its
 * end). Allocates nothing. */
void scene_pose(scene *s, double seconds);

/* Without a camera, places one that sees the whole scene at the given aspect (width / height); without a light, a point
 * light above and beside the camera. Each is told to `warn`. Call after scene_pose(); for a scene that has both it does
 * nothing. Returns 1, or 0 when memory ran out. */
int scene_ensure_view(scene *s, double aspect, void (*warn)(const char *line));

/* Alpha of a material at a texture coordinate and vertex alpha, as the stage's fragment shader computes it: base
 * factor times vertex alpha times the texture's alpha, sampled linearly (or nearest, as the texture says) in its
 * first level. */
double scene_alpha_at(const scene *s, int material, const double uv[2], double vertex_alpha);

void scene_free(scene *s);
#endif
