/* stage.h - the demo stage: a host of the library that draws glTF scenes with shaders of its own, under the library's
 * masks.
 *
 * It owns a platform's context, the GL objects of a scene, and the memory of the plan. It holds no shadow logic: it
 * asks for a plan and draws what the walk tells it to. */
#ifndef STAGE_H
#define STAGE_H
#include "gnomon_gles.h"
#include "platform.h"
#include "scene.h"

#define STAGE_LIGHTS 4 /* lights in one shader at most; more are added in further passes */

typedef struct stage_program {
    GLuint name; /* 0: not made yet */
    GLint clip, world, normal, base, flat, ambient, emits, emissive, cutoff, shininess, specular, metallic, two_sided,
        texture;
    GLint light_position, light_color, light_axis, light_cone, mask, channels, mask_size, mask_depth, mask_sharpness;
} stage_program;

/* What a program does beyond placing vertices: an index into stage.programs. */
enum {
    STAGE_TEXTURED = 1,
    STAGE_CUT = 2,
    STAGE_FLAT = 4,
    STAGE_MASKED = 8,     /* under masks in a texture */
    STAGE_MEDIUMP = 16,   /* no highp */
    STAGE_UPSAMPLED = 32, /* masks by depth */
    STAGE_DEPTH = 64,     /* the depth that they carry */
    STAGE_SHARPENED = 128,
    STAGE_LIGHT_SHIFT = 8,
    STAGE_PROGRAMS = (STAGE_LIGHTS + 1) << 8
};

/* Part of a range that 16-bit indices reach. */
typedef struct stage_batch {
    uint32_t first_vertex, first_index, triangle_count, first_triangle; /* first_triangle: of the scene's mesh */
    int material;
} stage_batch;

typedef struct stage_mesh {
    gn_mesh *mesh;  /* the solid triangles */
    gn_mesh *proxy; /* casts in its place, if there is one */
    double proxy_error;
    GLuint vertices, indices;
    uint16_t *index_copy; /* to pick triangles from */
    stage_batch *batches;
    size_t batch_count;
} stage_mesh;

/* A light as it stands in this frame, and as shaders want it; of soft lights one of their parts. */
typedef struct stage_light {
    float shader_position[4], color[3], axis[4], cone[2];
} stage_light;

typedef struct stage {
    scene *scene;
    platform *platform;
    gn_context *context;
    gn_gles *gles;
    const gn_gl *gl;
    gn_target target;
    uint64_t allocations; /* by the library so far */

    stage_mesh *meshes;
    GLuint *textures;
    stage_program programs[STAGE_PROGRAMS], lines;
    GLuint picked; /* indices of picked triangles, or positions of lines */
    void *scratch; /* for them: the largest mesh's */
    int8_t *facing;
    gn_object *objects;   /* [scene.instance_count] */
    gn_light *planned;    /* [light_count] as the last plan had them */
    gn_light *lights;     /* [light_count]: the scene's, or soft_count for each of them in a row */
    stage_light *shading; /* the same */
    uint32_t light_count, soft_count;
    double soft_radius;
    double brightest; /* what a material gives back of a light at most */
    double centre[3]; /* of the scene at its start */
    double exposure;
    uint32_t shader_lights; /* lights in one shader here: as many as the GL has uniforms for */
    double finite_far;      /* as in the options */
    int shader_refused;     /* a surface was left out because the GL refuses its shader */
    gn_shadow_cache *cache;
    gn_shadow_cache_desc cache_desc;
    double weld_angle;
    uint32_t proxy_triangles;
    void *plan_memory;
    size_t plan_size;
    const gn_plan *plan;
    uint32_t *members; /* [member_count] the plan's lights, by their numbers in the stage; 0: as they stand there */
    uint32_t member_count;
} stage;

typedef struct stage_options {
    const char *platform; /* NULL: the first that works */
    uint32_t width, height;
    double exposure; /* 0: the brightest light gives 1 at the scene's centre */
    int depth_bits, stencil_bits;
    const char *hide;  /* capabilities to pretend absent, or NULL */
    double finite_far; /* the camera's own far plane, there and nowhere else; 0: as the scene says */
    gn_proc (*replace)(const char *name, gn_proc real); /* tests: a function of GL to take instead; NULL: none */
    uint32_t soft_count;                                /* lights in place of each; 0: 1 */
    double soft_radius;
    gn_shadow_cache_desc cache;
    double weld_angle;        /* of meshes: see gn_mesh_desc */
    uint32_t proxy_triangles; /* what has more casts by a mesh of about so many; 0: all cast themselves */
    const int *color_bits;    /* [4] of the target; NULL: 8 each */
} stage_options;

/* Opens a context and uploads the scene. Returns 0, or an exit status of the command (1 or 3) with a message; *out
 * is then NULL. The scene stays the caller's and must outlive the stage. */
int stage_open(stage **out, scene *s, const stage_options *options, char message[SCENE_MESSAGE]);
void stage_close(stage *s);

/* Forgets what shadows were kept. 1, or 0 without memory. */
int stage_renew_cache(stage *s);

/* Poses scene, lights and camera: seconds into the animation, the lights turned about the vertical axis through the
 * centre. */
void stage_pose(stage *s, double seconds, double spin_degrees);

/* Lights alone, as they stand in the scene: after they were moved there. */
void stage_place_lights(stage *s, double spin_degrees);
/* The target is of another size, the platform's. 1, or 0 with a message. */
int stage_resize(stage *s, char message[SCENE_MESSAGE]);

/* What to plan. casting 0: the same passes, and no volumes. */
typedef struct stage_wish {
    gn_method method;
    int one_sided, casting;
    uint32_t first_light, light_count; /* of the stage's lights */
    int unbounded;                     /* lights have no range, cone or reach: for masks */
    int blend_once;
    double least_light;
    unsigned without; /* of gn_measure */
    int keeps;        /* shadows from frame to frame, in the stage's cache */
    gn_shade shade;
    double dimmed; /* 0: a half */
    int merges_lights;
    uint32_t scale; /* of masks; 0: 1 */
    gn_upsample upsample;
    int sharpen;
    /* A part of a frame: of so many lights, by their numbers in the stage; NULL: those from first_light on. */
    const uint32_t *members;
    int follows, precedes;
    int full_casters;         /* proxies do not cast, if there are any */
    uint32_t lights_per_pass; /* under a mask in a texture; 0: as many as the shader can */
} stage_wish;

/* Returns 0, or an exit status of the command (1 or 3) with a message. */
int stage_plan(stage *s, const stage_wish *wish, char message[SCENE_MESSAGE]);

/* ---- Walking the plan: each draws one frame into the target ---- */

/* The lit frame. first_light: of the plan, in the scene. Returns 0 with a message when the walk does not start. */
int stage_draw_lit(stage *s, uint32_t first_light, char message[SCENE_MESSAGE]);
/* Red where the plan's one light reaches, green where a surface is; every colour else 0. */
int stage_draw_mask(stage *s, uint32_t light, char message[SCENE_MESSAGE]);
/* Grey: the share of the plan's lights that reach each pixel. */
int stage_draw_shares(stage *s, char message[SCENE_MESSAGE]);
/* One pass with all lights and no shadows, without the library. */
void stage_draw_plain(stage *s);

/* Over the frame that was just drawn: volumes, in one colour or by McGuire's case; or silhouettes as lines. */
void stage_show_volumes(stage *s);
void stage_show_cases(stage *s); /* 1 green, 2 orange, 3 red */
void stage_show_silhouettes(stage *s);

/* How many fragments were rasterised at each pixel, up to 255: red of the plan's volumes, green of the scene's
 * surfaces. Spoils the frame just drawn. */
void stage_draw_layers(stage *s);

/* Counts fragments of the plan's volumes in the frame that was just drawn, spoiling its colours: all that are
 * rasterised, and those in front of what is seen (they pass the depth test). 1, or 0 when memory or the GL failed. */
int stage_count_fragments(stage *s, uint64_t *rasterised, uint64_t *passed);

/* ---- stage_draw.c, used by the walks ---- */

typedef enum stage_pass { STAGE_PASS_SOLID, STAGE_PASS_BLEND } stage_pass;

typedef struct stage_look {
    int ambient;                       /* with ambient and emitted light */
    uint32_t first_light, light_count; /* in the scene */
    const uint32_t *picked;            /* not those in a row, but first_light + picked[i]; NULL: in a row */
    uint32_t picked_count;
    uint32_t mask, channel; /* GL's name of their masks' texture, 0 for none; of what is flat its channel */
    const float *flat;      /* one colour instead, or NULL */
    int receivers;          /* 1: objects that receive; 0: the rest; -1: all */
    int facing_light;       /* only triangles whose seen side looks at this light; -1: all */
    int carries_depth;      /* writes the depth that masks carry */
    int only_lit;           /* only objects that a light of the plan in `picked` may light */
    int backs;              /* after the fronts the backs of objects that say they are drawn */
} stage_look;

void stage_draw_objects(stage *s, stage_pass pass, const stage_look *look);
int stage_upload(stage *s, char message[SCENE_MESSAGE]); /* stage_upload.c */
/* stage_proxy.c: 1, also where it makes none; 0 when the library or memory refuses. */
int stage_make_proxy(stage *s, const scene_mesh *m, stage_mesh *out);
/* Which object of the plan is drawn for an instance: with a proxy another than the one that casts, which has its
 * number. */
size_t stage_drawn_object(const stage *s, size_t instance);
void stage_release(stage *s);                      /* stage_upload.c */
stage_program *stage_use(stage *s, unsigned kind); /* stage_program.c; NULL when a driver refuses it */
stage_program *stage_use_lines(stage *s);
#endif
