/* gn_plan.h - methods, and the plan of a frame: what will be drawn, as data, decided before any GL call. Part of
 * gnomon.h, whose conventions hold here. */
#ifndef GN_PLAN_H
#define GN_PLAN_H
#include "gnomon.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Methods ---- */

typedef enum gn_method {
    GN_METHOD_AUTO,  /* the best exact one that the target can do */
    GN_METHOD_ZFAIL, /* stencil, closed volumes, counted behind what is seen (Everitt 2002) */
    GN_METHOD_ZPASS, /* stencil, counted before what is seen: wrong where a volume meets the near plane (Hoxley 2003) */
    GN_METHOD_STENCIL, /* stencil, before or behind what is seen for each caster, by the occlusion pyramid (McGuire 2003) */
    /* The same, at full size only where a small mask is contested: its neighbours differ, or depth is cut through there
     * (Chan and Durand's idea, there with a shadow map) */
    GN_METHOD_REFINE,
    /* Without a stencil. Fronts and backs are counted in two channels of an image of the library's own. */
    GN_METHOD_COUNT,
    GN_METHOD_SIGNED, /* added and subtracted about a level, in the target's alpha or in an image */
    GN_METHOD_ALPHA,  /* halved and doubled in the target's alpha (Roettger 2002) */
    GN_METHOD_SCREEN, /* the same in its colour, which is copied before the scene's own is drawn (Roettger 2002) */
    GN_METHOD_TOTAL
} gn_method;

typedef struct gn_method_info {
    const char *name;    /* what --method takes */
    const char *summary; /* one line */
    uint32_t needs;      /* capabilities that it cannot do without */
    uint32_t needs_any;  /* and one of these, if there are any */
    uint32_t likes;      /* and those that it does with less, or more slowly, without */
    int exact;
} gn_method_info;

/* NULL when method is not one of gn_method. */
const gn_method_info *gn_method_describe(gn_method method);

/* GN_METHOD_TOTAL when there is no such name. A stencil method's name may end in "/one-sided": *one_sided is then 1,
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

/* How a light's mask limits the host's drawing. */
typedef enum gn_mask {
    GN_MASK_STENCIL, /* by the stencil test */
    GN_MASK_ALPHA,   /* by the target's alpha, a factor of blending */
    GN_MASK_TEXTURE  /* by a texture with a light in each channel: GN_GLSL_MASK_FRAGMENT in gnomon_gles.h reads it */
} gn_mask;

#define GN_MOST_MASKED 4 /* lights of one pass, one in each channel of a mask */

/* What a colour buffer of the library's own holds: bits of red, green, blue and alpha. */
typedef enum gn_format {
    GN_FORMAT_NONE,
    GN_FORMAT_RGBA8,
    GN_FORMAT_RGBA4,
    GN_FORMAT_RGB5A1,
    GN_FORMAT_RGB565
} gn_format;

/* Where volumes are counted. */
typedef enum gn_place {
    GN_PLACE_STENCIL, /* of the target, or of the image when the plan has one */
    GN_PLACE_ALPHA,   /* of the target */
    GN_PLACE_COLOR,   /* of the target, before the scene's is drawn */
    GN_PLACE_IMAGE    /* the plan's image */
} gn_place;

/* Of a count in colour (DESIGN.md, decision 11). A level is a whole number from 0 to `top`; a pixel is lit where the
 * count is `start` again, or by count where both channels are the same. */
typedef struct gn_color_layout {
    gn_place place;
    int both_sides; /* 1: one draw counts fronts and backs, told by gl_FrontFacing. 0: what counts up first, then the rest */
    int discard;       /* then the other side is discarded by gl_FrontFacing; 0: culled, which may lose slivers */
    int top, start;    /* the greatest level; that of a pixel which no volume holds */
    int other_top;     /* count: of green, where backs or fronts are; 0: there is one channel */
    int limit;         /* the most that is surely kept at a pixel: fragments of either side, or the sum on the way */
    unsigned channels; /* that are written: red 1, green 2, blue 4, alpha 8 */
    int quads;         /* that take levels back to 0 or full, where they are not an image's */
    int by_maximum; /* a shadow's level becomes the shade by MAX, and no fold is needed before (Roettger 2002, 4.4) */
} gn_color_layout;

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
    GN_MEASURE_INTERVALS = 8,
    /* several lights are added in one pass, if the host reads masks, under stencils taken to a texture */
    GN_MEASURE_MASKS = 16
};

#define GN_MOST_PATCHES 3 /* planes whose flat receivers need no volumes; two bits of stencil name them */

/* ---- Plan: what will be drawn, as data, decided before any GL call ---- */

/* How a mask that is smaller than the frame is read (Roettger 2002, section 4.5). */
typedef enum gn_upsample {
    GN_UPSAMPLE_NEAREST,  /* blocks of pixels have one mask */
    GN_UPSAMPLE_BILINEAR, /* between them it is neither 0 nor 1 */
    /* The same where the four masks around lie in the receiver's plane; elsewhere the more of a mask the nearer it is to
     * the receiver in depth, which masks carry: at most two lights in a pass */
    GN_UPSAMPLE_DEPTH
} gn_upsample;

/* What shadows do to a frame (Roettger 2002, section 4.3). */
typedef enum gn_shade {
    GN_SHADE_ADDITIVE,  /* lights are added to ambient where they reach */
    GN_SHADE_ATTENUATE, /* what receives is lit fully, and dimmed in each light's shadow, as if no light had bounds */
    GN_SHADE_BLACK      /* and there is set to black */
} gn_shade;

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
    int reads_masks;          /* 1: the host's light passes read masks from a texture. Some methods make no other */
    uint32_t lights_per_pass; /* that they add at once then, at most GN_MOST_MASKED [as many] */
    /* 1: lights under stencils are added in passes of several too, by masks in textures, where the target can. 0: where
     * the plan finds that cheaper */
    int merges_lights;
    /* A choice: masks have one pixel for 2 x 2 or 4 x 4 of the frame's, in a texture: 1, 2 or 4 [1; GN_METHOD_REFINE takes 0 and 1 for 2] */
    uint32_t scale;
    gn_upsample upsample;
    int sharpen; /* 1: not NEAREST, nor of frames that are dimmed; what is between 0 and 1 then is narrowed to a pixel of the frame (GN_SHARPENED) */
    gn_shade shade;
    double dimmed; /* GN_SHADE_ATTENUATE: what a shadow leaves of the light, more than 0, less than 1 [0.5] */
    /* A frame may be made of several plans, each with lights of its own and another method or scale, drawn one after the other into
     * the target. follows: an earlier one has drawn depth and ambient light; this one adds its lights. precedes: a later one
     * follows, to which the last pass is left. Only GN_SHADE_ADDITIVE; what makes masks in the target itself follows nothing
     * [0, 0: the whole frame] */
    int follows, precedes;
    int discards; /* 1: the host reads neither depth nor stencil of the target after the frame: they may be dropped */
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
    int unpatched;    /* counted only where no patch is seen, or what is contested */
    int slivers;      /* of the light cap only triangles that are seen nearly edge-on */
    int mcguire_case; /* 1: by z-pass; 2, 3: by z-fail; 0: on a patch */
    int mirrored;     /* the model matrix swaps front and back */
    int detached;     /* it starts on start_plane, and not at the caster */
    int thin;         /* GN_METHOD_REFINE: a small mask may miss its shadow */
    gn_far far_end;
    double start_plane[4]; /* world */
    double end_plane[4];   /* world; the volume ends there. 0 0 0 1 is the plane at infinity */
    double end_reach; /* not 0: no plane; it ends at so many times its distance from the light, or so much farther */
    float near_matrix[16]; /* a near vertex's clip position is this times its position: the object's, if not detached */
    float far_matrix[16];  /* a far vertex's */
    uint32_t scissor[4];   /* x, y, width, height in pixels: within the light's; nothing outside needs it */
} gn_record;

typedef enum gn_step_kind {
    GN_STEP_CLEAR,   /* colour and depth, unmasked; and the stencil, to the reference of light 0, if it counts there */
    GN_STEP_ZERO,    /* the count becomes that of a pixel which no volume of `light` holds, by a quad in its scissor */
    GN_STEP_VOLUMES, /* records are counted */
    GN_STEP_DRAW,    /* the host's: see gn_draw */
    GN_STEP_FOLD,    /* where the count is not nought it becomes nought and the flag is set, by a quad in the scissor */
    GN_STEP_MARK,    /* patches are named in the stencil of the pixels where they are seen */
    /* GN_METHOD_REFINE: pixels of the light's scissor are named where its small mask is unanimous, and lit or shadowed as
     * that says; where it is contested, or what is seen or shadows is thin, they have no name, and volumes are counted */
    GN_STEP_REFINE,
    GN_STEP_DARKEN,      /* all of `patch` that is in the light's scissor is shadow: its seen side looks away */
    GN_STEP_CLEAR_IMAGE, /* the image: its count to `start`, depth and stencil unless it borrows the target's depth */
    /* All of a mask texture is lit; of those that are refined, blue is 1 where no edge of depth is */
    GN_STEP_CLEAR_MASK,
    GN_STEP_CLEAR_COLOR, /* the target's colour alone */
    GN_STEP_RESOLVE,     /* the light's channel of its mask texture becomes 0 where the image's count says shadow */
    GN_STEP_NORMALISE, /* levels in the target become full where lit and 0 in shadow, or the shade (by_maximum), by quads */
    GN_STEP_COPY,      /* the target's colour becomes the mask texture */
    GN_STEP_SHADE,     /* the frame is dimmed in the shadows of `lights` */
    GN_STEP_OPAQUE,  /* the target's alpha becomes 1, in the light's scissor; with no light everywhere */
    GN_STEP_DISCARD, /* what is left of depth and stencil is not needed: of the image, or of the target */
    GN_STEP_KIND_COUNT
} gn_step_kind;

typedef enum gn_draw {
    GN_DRAW_NOTHING, /* the step is the library's own */
    GN_DRAW_AMBIENT, /* every opaque object: depth and ambient light together */
    GN_DRAW_LIGHT,   /* objects that receive (or those that do not), added, under the mask of `lights` */
    GN_DRAW_FINAL,   /* transparent things and labels: McGuire's last pass */
    /* Every opaque object, depth alone, into whatever is bound. If the plan carries_depth gn_mask_depth_color() is written,
     * else no colour */
    GN_DRAW_DEPTH,
    /* As if nothing cast, for GN_SHADE_ATTENUATE and BLACK: depth and all light of every opaque object; and again, once
     * shadows have dimmed that, of those that do not receive (receivers 0), over it */
    GN_DRAW_LIT,
    GN_DRAW_COUNT
} gn_draw;

/* What a step draws into. */
typedef enum gn_into {
    GN_INTO_TARGET,
    GN_INTO_IMAGE,
    GN_INTO_MASK,
    GN_INTO_CORNER /* of the target: as large as a mask, at the lower left */
} gn_into;

typedef struct gn_step {
    gn_step_kind kind;
    gn_draw draw;
    gn_into into;
    uint32_t light; /* index into the scene's lights, where it matters; GN_NO_LIGHT: none */
    int receivers; /* GN_DRAW_LIGHT: 1 draw what receives, under the mask; 0 draw the rest, unmasked. See GN_DRAW_LIT */
    uint32_t first_record, record_count; /* GN_STEP_VOLUMES */
    uint32_t patch;                      /* GN_STEP_DARKEN */
    uint32_t mask;                       /* of the plan's mask textures: which; GN_NO_MASK: what is lit needs none */
    /* GN_DRAW_LIGHT, GN_STEP_SHADE: lights that are added at once, mostly one. The mask of lights[i] is in the channel
     * of its gn_plan_light.mask_channel, which with a texture is i. */
    uint32_t lights[GN_MOST_MASKED], light_count;
} gn_step;

#define GN_NO_LIGHT UINT32_MAX
#define GN_NO_MASK  UINT32_MAX

/* An image that counts are made in, of a mask's size. */
typedef struct gn_image {
    gn_format format; /* GN_FORMAT_NONE: there is none. With a stencil its colour is the mask itself */
    int depth_bits;   /* of its own depth; 0: it borrows the target's */
    int stencil_bits;
} gn_image;

/* Bytes a frame writes and reads, estimated: each surface covers the target once, each record its scissor once a side. */
typedef struct gn_traffic {
    double target_color, target_depth, image_color, image_depth, masks; /* written and read */
    double written, read;                                               /* of all */
} gn_traffic;

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
    GN_SKIP_ENDLESS,     /* an object: its volume has no end under an orthographic camera: a warning */
    GN_SKIP_KEPT         /* an object: its shadow is in a mask that is kept from an earlier frame */
} gn_skip;

typedef struct gn_plan_light {
    gn_method method;
    char reason[256];          /* why this method, and this way of it: a sentence */
    gn_skip skip;              /* not GN_SKIP_NOT: there is no step for it */
    gn_stencil_layout stencil; /* of methods that count there */
    gn_color_layout color;     /* of the others; place is GN_PLACE_STENCIL for the former */
    /* GN_MASK_TEXTURE, and the small masks of GN_METHOD_REFINE: where its mask is; GN_NO_MASK where nothing shadows */
    uint32_t mask_texture, mask_channel;
    int is_shadowed; /* something is counted for it */
    double reach;    /* what is farther is not lit, and a little more for rounding; INFINITY: no bound */
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
    uint32_t fragments;       /* counts in colour: of a batch no pixel takes more of one side than this */
    uint32_t batches;         /* in which volumes are counted, folded into the flag between */
    /* Cut into pieces, as no count holds them whole. Pieces have sides back to back: where a surface meets such a seam
     * within a few steps of depth, single pixels may be wrong. */
    uint32_t cut_casters;
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
     * behind each other on some line of sight. Without the feature batches also where more may be than a stencil counts. */
    GN_WARN_OVERFLOW,
    /* Volumes of orthographic cameras that were left out, because the light is so close to so many large triangles that
     * their ends need too many planes. */
    GN_WARN_ENDLESS,
    /* From some distance on four steps of depth are larger than half a pixel, and something that receives is seen there:
     * edges of shadows may stray by more than half a pixel, and thin things lose theirs. */
    GN_WARN_DEPTH,
    /* Something in view has vertices so far from the plane of the eye, before it or behind, that a float of a vertex
     * shader does not tell their depth from infinity (znear times 2^21): all of such triangles may be too deep. */
    GN_WARN_FLOAT,
    /* A caster's volume may put more fragments of one side over a pixel than doubling and halving keep apart: shadows
     * may be wrong there. gn_plan_light.fragments says how many, gn_color_layout.limit how many are kept. */
    GN_WARN_RANGE,
    GN_WARNING_COUNT
} gn_warning;

typedef struct gn_plan_object {
    const gn_mesh *mesh;
    unsigned flags;
    int mirrored;
    uint8_t patch;    /* of GN_MOST_PATCHES, which it is part of; 0: of none */
    uint8_t thin;     /* GN_METHOD_REFINE: a small mask may miss it */
    float matrix[16]; /* positions less the mesh's centre to clip space: for every pass of this object */
} gn_plan_object;

/* Lives in the memory that was given to gn_plan_make(), and as long. Plain data; may be copied out, compared,
 * printed. */
typedef struct gn_plan {
    gn_target target;
    int blend_once; /* as in the scene */
    gn_mask mask;   /* of all lights */
    gn_shade shade;
    double dimmed; /* what a shadow leaves, 0 for GN_SHADE_BLACK; not read for GN_SHADE_ADDITIVE */
    gn_image image;
    gn_format mask_format;
    uint32_t mask_count; /* textures */
    uint32_t scale;      /* pixels of the frame for one of a mask, in each direction */
    gn_upsample upsample;
    /* Frames since the masks were made, if they are kept (gn_shadow_cache_desc.masks_every), and of which making they are */
    uint32_t mask_age, mask_version;
    int sharpen;       /* as in the scene, where masks are smaller */
    int carries_depth; /* GN_DRAW_DEPTH writes gn_mask_depth_color(), which masks keep in blue and alpha */
    /* Of the host's passes: the target's size, or a little more, so that masks have whole pixels: matrices are made for it */
    uint32_t viewport[2];
    uint32_t mask_size[2]; /* viewport / scale: of images and mask textures */
    /* What masks carry is (mask_depth[0] + mask_depth[1] z) / w of clip space, from 0 to 1, which is
     * linear on the image */
    double mask_depth[2];
    gn_traffic traffic; /* all 0 in a library without the feature selector */
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
    double depth_limit;      /* the view distance from which on four steps of depth are larger than half a pixel */
    double farthest_vertex;  /* the greatest distance from the plane of the eye of anything that may be seen */
    double deepest_receiver; /* the view distance of the farthest thing that receives and may be seen */
} gn_plan;

/* Bytes that gn_plan_make() may need for this scene at most, whatever the camera, the lights' places and the model
 * matrices are: it depends on the counts, the meshes, the flags, camera.orthographic, camera.finite_far, the target's bits
 * and capabilities, the method, and what the host says of masks (reads_masks, blend_once, scale). 0 when scene is NULL or
 * the size does not fit size_t. */
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
