/* gni_plan.h - what the files that make a plan share: plan.c the frame, plan_light.c a light, plan_volumes.c a caster's
 * records, batches.c and cells.c counts that the stencil's bits do not hold. */
#ifndef GNI_PLAN_H
#define GNI_PLAN_H
#include "gni.h"

enum { GNI_IN_CAST = 1, GNI_IN_LIT = 2 }; /* what an object is to a light */
enum { GNI_DRAWS_RECEIVERS = 1, GNI_DRAWS_OTHERS = 2 };

/* cells.c: cells of light space, and how many layers there are in each at most. */
#define GNI_PLANE_SIDE 58
#define GNI_CUBE_SIDE  24
#define GNI_ZOOM_SIDE  16
#define GNI_CELLS      (6 * GNI_CUBE_SIDE * GNI_CUBE_SIDE) /* not less than the square of a plane's side */

typedef struct gni_cells {
    int face_count, side;
    double rows[6][3][4]; /* view space to cell coordinates times w, and w */
} gni_cells;

typedef struct gni_grid {
    uint16_t layers[GNI_CELLS];
} gni_grid;

#define GNI_BINS 16384 /* of sweep.c */

#define GNI_MOST_ZOOMS 32 /* each costs as much as a look at all cells */

/* Around the boxes that is_in says may cast, as seen from the light. */
void gni_fit_cells(gni_cells *cells, const gni_hull *boxes, const uint8_t *is_in, uint32_t count,
                   const double light[4]);
/* Cells that part one of `from`. */
void gni_zoom_cells(gni_cells *out, const gni_cells *from, int cell);
void gni_cells_add_box(const gni_cells *cells, gni_grid *grid, const gni_hull *box, uint32_t amount);
/* The layers of the triangles of list[count]; casting holds 0 for all others. `touches` is scratch. Returns the most of
 * a cell. */
uint32_t gni_measure_triangles(const gni_cells *cells, gni_grid *grid, gni_grid *touches, const gn_mesh *mesh,
                               const double model_view[16], const int8_t *casting, const uint32_t *list,
                               uint32_t count);
/* The most that a cell has in both together; b may be NULL. */
uint32_t gni_most_layers(const gni_cells *cells, const gni_grid *a, const gni_grid *b);
void gni_add_grid(const gni_cells *cells, gni_grid *to, const gni_grid *grid);

/* What only scenes need that may nest more than the bits hold. */
typedef struct gni_layers {
    gni_cells cells;
    gni_grid batch, piece, scratch, zoomed; /* what is counted since the last fold; the piece at hand */
    int32_t bins[GNI_BINS + 1];             /* sweep.c */
} gni_layers;

/* Where the stencil may differ from the reference: x0, y0, x1, y1; nowhere where x0 is not less than x1. */
typedef struct gni_stain {
    uint32_t at[4];
    int reference;
} gni_stain;

/* patches.c: flat receivers of one plane. */
typedef enum gni_patch_use {
    GNI_PATCH_NONE, /* as good as in the light's plane: volumes cover it */
    GNI_PATCH_LIT,  /* light and eye are on the same side */
    GNI_PATCH_DARK  /* they are not */
} gni_patch_use;

typedef struct gni_patch {
    double plane[4]; /* view space, unit normal, positive where the eye is */
    uint32_t rectangle[4];
    double of_light; /* the plane's value of the light at hand */
    gni_patch_use use;
} gni_patch;

/* What a caster does to a patch in a light. */
typedef enum gni_on_patch {
    GNI_FILLS_PATCH, /* its volume must cover it */
    GNI_SPARES_PATCH,
    GNI_FANS_PATCH /* its projection is its shadow there */
} gni_on_patch;

/* cache.c */
#define GNI_CACHED_CHUNKS 4
enum {
    GNI_STREAM_FAN,
    GNI_STREAM_CAP,
    GNI_STREAM_CONVERGING,
    GNI_STREAM_KINDS
}; /* what its dark cap is: the last has none */

typedef struct gni_stream {
    uint32_t first, room, count; /* count 0: not made */
    struct {
        uint32_t light_cap, sides, dark_cap, near_cap, turned_cap; /* indices, in this order */
    } parts[GNI_CACHED_CHUNKS];
} gni_stream;

/* Of one object in one light. */
typedef struct gni_slot {
    const gn_mesh *mesh;
    uint32_t shape;                 /* of the mesh, when it was asked */
    double light[4];                /* in the space of the mesh */
    int is_made;                    /* some stream is */
    uint32_t made;                  /* in which frame, or when it was first asked for */
    uint32_t triangles, silhouette; /* that cast; weights of edges */
    int runs_round;                 /* its sides, round the hub */
    gni_stream streams[GNI_STREAM_KINDS];
} gni_slot;

/* kept_masks.c: the masks that were made last, and how many frames ago. */
typedef struct gni_kept_masks {
    uint32_t age, version; /* version 0: none was ever made */
    gn_method method;
    gn_format format;
    gn_image image;
    gn_upsample upsample;
    uint32_t size[2], lights_per_mask, mask_count;
    double depth[2];                              /* gn_plan.mask_depth of what they carry */
    uint32_t light_count, capacity, (*lights)[2]; /* texture and channel of each */
} gni_kept_masks;

struct gn_shadow_cache {
    gn_context *context;
    uint32_t id;
    gn_shadow_cache_desc desc;
    gni_slot *slots; /* [light][object] */
    uint32_t slot_count, object_count, frame;
    uint16_t *indices;
    uint32_t capacity, used, wanted; /* of indices; wanted: from the next frame on */
    uint32_t version, base_version, dirty[2], built;
    gni_kept_masks masks;
};

/* fronts.c: of an object, what is seen. */
typedef struct gni_fronts {
    gni_hull box;
    uint32_t rectangle[4];
} gni_fronts;

/* What a volume may touch, and between which levels of intervals.c it is. */
typedef struct gni_touched {
    uint32_t object;
    double start, end;
} gni_touched;

/* The silhouette of a cap on a patch: sides, of which it takes the first two indices. */
typedef struct gni_outline {
    uint32_t first, count, of_a_side; /* in the plan's indices, or the cache's */
} gni_outline;

#define GNI_COLUMNS     1024 /* fragments.c: of the image */
#define GNI_COLUMN_WAYS 4
#define GNI_SECTORS     2048 /* of what a caster fills of the planes through eye and light */

/* A plan while it is made. */
typedef struct gni_draft {
    gn_context *context;
    const gn_scene *scene;
    gn_plan *plan;
    gn_step *steps;
    gn_record *records;
    uint16_t *indices;
    gn_plan_light *lights;
    gn_plan_object *objects;
    gn_plan_caster *casters;
    gni_hull *boxes;                       /* [object_count] of objects, in view space */
    double (*balls)[4];                    /* [object_count] centre and radius of a ball around each */
    gni_fronts *fronts;                    /* [object_count] */
    uint64_t *facing[2];                   /* [clusters of the largest] scratch of fronts.c */
    gni_touched *touched;                  /* [object_count] by the extent at hand */
    uint32_t (*rectangles)[4];             /* [object_count] pixels in which they may be seen */
    uint8_t *is_in;                        /* [object_count] of the light at hand: GNI_IN_* */
    double (*heights)[GN_MOST_PATCHES][2]; /* [object_count] over each patch; NAN: not known yet */
    gni_patch patches[GN_MOST_PATCHES];
    uint32_t patch_count;
    int are_marked;        /* patches, in the stencil as it is now */
    gn_record *flats;      /* caps on patches, until the light's volumes are all made */
    gni_outline *outlines; /* of each */
    uint32_t flat_count;
    gni_walk walk;
    gni_hull all_lit;           /* a box around all that receives and is lit by it */
    gni_casting casting, group; /* of the caster at hand; group: those of one volume of it */
    uint8_t *end_of;
    gni_region *region; /* NULL: volumes need not end */
    gni_ends *ends;
    gni_layers *layers; /* NULL: nothing can nest too much; nor are there the six arrays that follow */
    gni_casting piece;  /* of the volume at hand: those of one piece */
    uint32_t *order, *parent, *end, *ring;
    uint32_t *cheap_of; /* [object_count] layers of each caster of the light at hand, a cheap bound */
    int8_t *seen_cap;   /* fragments.c, of methods that count in colour; and so the next four */
    int32_t *seams[2];  /* [vertices of the largest caster] */
    int32_t (*columns)[2][GNI_COLUMNS + 1]; /* [GNI_COLUMN_WAYS] */
    int32_t (*sectors)[GNI_SECTORS + 1];    /* [2] */
    uint32_t *tiles;                        /* [GNI_TILES^2] of the target: fragments of the batch at hand */
    uint8_t *draws;                         /* [light_count] of GNI_DRAWS_*: what the light adds to */
    uint32_t mask_count;                    /* lights that have a channel of a mask */
    int image_is_used;                      /* something was counted in it */
    gni_slot *slot;                         /* of the caster at hand in the cache; NULL: it is not kept */
    int casting_is_known;                   /* d->casting is the slot's, or there is none */
    gni_choice choice;
    uint32_t whole[4]; /* the target's pixels */
    double projection[16], view[16];
    int receivers_are_known; /* some object is said to receive: then those are all that do */
    gni_stain stain;

    /* the light at hand */
    uint32_t light;
    gni_bounds bounds;
    gni_view seen;                            /* through its scissor */
    int is_batched, uses_patches, is_colored; /* is_colored: its method counts in colour */
    int reuses_masks, must_remake;            /* those of an earlier frame; but of some light they say nothing */
    int is_refining;                          /* small masks are made: steps are the target's */
    uint32_t first_of_batch;                  /* record */
    uint64_t casting_count, cheap_layers;
} gni_draft;

/* What a build without the feature never is. */
static inline int gni_is_colored(const gni_draft *d)
{
    return GNI_HAS_FALLBACK && d->is_colored;
}

static inline int gni_is_refined(const gni_draft *d)
{
    return GNI_HAS_REFINE && d->choice.is_refined;
}

static inline int gni_is_batched(const gni_draft *d)
{
    return GNI_HAS_BATCHES && d->is_batched;
}

static inline int gni_uses_patches(const gni_draft *d)
{
    return GNI_HAS_CULLING && d->uses_patches;
}

/* Whether volumes must end. */
static inline int gni_has_region(const gni_draft *d)
{
    return GNI_HAS_CULLING && d->region;
}

static inline int gni_has_slot(const gni_draft *d)
{
    return GNI_HAS_CACHE && d->slot;
}

static inline int gni_has_layers(const gni_draft *d)
{
    return GNI_HAS_BATCHES && d->layers;
}

/* Whether lights are added to ambient, and shadows dim nothing. */
static inline int gni_is_additive(const gni_draft *d)
{
    return !GNI_HAS_FALLBACK || d->scene->shade == GN_SHADE_ADDITIVE;
}

/* Whether the host's passes read masks. */
static inline int gni_reads_masks(const gni_draft *d)
{
    return GNI_HAS_FALLBACK && d->plan->mask == GN_MASK_TEXTURE;
}

/* Whether masks become textures. */
static inline int gni_makes_textures(const gni_draft *d)
{
    return GNI_HAS_FALLBACK && d->choice.mask_format != GN_FORMAT_NONE;
}

/* plan.c */
gn_step *gni_add_step(gni_draft *d, gn_step_kind kind, gn_draw draw, uint32_t light, int receivers);

/* plan_passes.c: the frame's steps. */
gn_result gni_add_passes(gni_draft *d);
/* Depth and ambient light, or all light. */
void gni_add_surfaces(gni_draft *d);
/* The clear and they, unless an earlier plan has drawn them. */
void gni_start_frame(gni_draft *d);
/* What a light under a stencil or alpha adds, before the next one's mask. */
void gni_add_own_passes(gni_draft *d, uint32_t light);
/* Ends a batch: its step of volumes, and one that folds it if more follows. */
void gni_end_batch(gni_draft *d, int more_follows);
/* Takes back the steps that were to make masks, and their image: no light has a shadow. */
void gni_need_no_masks(gni_draft *d, uint32_t first_step);
/* The steps before the first light of a mask texture. */
void gni_start_mask(gni_draft *d);

/* plan_refine.c: the steps before lights, of small masks; after them all, the frame's. */
void gni_start_refined(gni_draft *d);
void gni_refine(gni_draft *d, uint32_t first_step);

/* kept_masks.c: whether those of an earlier frame may serve in this one; then, where that is of the light at hand (0: nothing
 * is known of it), and what the plan says of them. And what is made is noted. */
int gni_may_reuse_masks(const gni_draft *d);
int gni_take_kept_mask(gni_draft *d);
void gni_reuse_masks(gni_draft *d);
void gni_note_masks(gni_draft *d);

/* traffic.c */
void gni_estimate_traffic(gn_plan *plan);

/* plan_check.c: whether all numbers of a scene are such that a plan can be made. */
gn_result gni_check_scene(gn_context *context, const gn_scene *scene);

/* plan_light.c: records of a light, and the steps that make its mask. Fills d->draws. */
gn_result gni_add_light(gni_draft *d, uint32_t light);

/* stain.c: where the stencil is not clean at the start; a step that zeroes a light's scissor, where the stencil may differ from its reference; and that it may. */
void gni_start_stain(gni_draft *d);
void gni_clean_stencil(gni_draft *d, uint32_t light);
void gni_stain_stencil(gni_draft *d, uint32_t light);

void gni_join_rectangles(uint32_t a[4], const uint32_t b[4]);
void gni_meet_rectangles(uint32_t a[4], const uint32_t b[4]);
int gni_do_rectangles_meet(const uint32_t a[4], const uint32_t b[4]);

/* Where something is to be counted whose image and whose use are known: what they have in common, or the light's
 * scissor where that saves little; nothing where they have nothing in common. */
void gni_choose_scissor(uint32_t out[4], const gni_draft *d, const uint32_t image[4], const uint32_t needed[4]);

/* extent.c: how far the volume of a caster goes, and where that matters. */
#define GNI_NORMALS 4 /* of planes that may end it */

typedef struct gni_extent {
    gni_on_patch on[GN_MOST_PATCHES];    /* of each patch of the frame */
    uint32_t shadow[GN_MOST_PATCHES][4]; /* where a fan is seen */
    int is_ended, is_detached;           /* detached: it starts on a plane, and not at the caster */
    double start_plane[4];               /* view space, positive where the caster is */
    double end_plane[4];                 /* the same */
    uint32_t scissor[4];                 /* pixels where it must be counted, or more */
    uint32_t image[4], end_image[4];     /* of them, those in which it may be seen, and its end */

    /* while it is found */
    double normals[GNI_NORMALS][3], lowest[GNI_NORMALS]; /* of what is touched, along the normals */
    double deepest, greatest;                            /* view distance and coordinate of what is touched */
    double moves[2];             /* of vertices to the end, least and most: factors of their distance from the light, or
                            distances */
    double start_move;           /* the least to the start */
    uint32_t touched, needed[4]; /* how many, in gni_draft.touched, and the pixels of their images */
} gni_extent;

/* Of a caster. */
void gni_start_extent(gni_extent *e, const gni_draft *d, uint32_t object);
/* Whether all of an object surely lies where the plane, of unit normal, is positive. */
int gni_is_object_before(const gni_draft *d, uint32_t object, const double plane[4]);
/* Its volume may touch what is seen of this object. */
void gni_touch(gni_extent *e, const gni_draft *d, uint32_t object);
/* Chooses end and scissor. volume: on entry without end; becomes what is drawn. Returns 0 when nothing is seen of
 * what it may shadow. */
int gni_end_extent(gni_extent *e, const gni_draft *d, uint32_t object, gni_hull *volume);
/* The same of one whose start and end are known. */
int gni_see_extent(gni_extent *e, const gni_draft *d, uint32_t object, gni_hull *volume);
/* The least value along a normal of what lies in both box and ball. */
double gni_lowest_of(const double normal[3], const gni_hull *box, const double ball[4]);
/* A level along a normal below another, by more than depth can confuse. */
double gni_behind(const gni_extent *e, const gni_draft *d, double lowest);
/* The least and the most that the caster's vertices are moved to a level: as gni_extent.moves. */
void gni_find_moves(double moves[2], const gni_draft *d, uint32_t object, const double normal[3], double level);

/* fronts.c */
void gni_find_fronts(gni_draft *d);
/* The least value along a normal of what is seen of an object. */
double gni_lowest_seen(const double normal[3], const gni_draft *d, uint32_t object);

/* intervals.c */
#define GNI_MOST_INTERVALS 4
/* Cuts an ended extent into those that are needed and seen. Returns how many. */
uint32_t gni_cut_extent(gni_extent out[GNI_MOST_INTERVALS], const gni_extent *e, const gni_draft *d, uint32_t object);

/* patches.c */
void gni_find_patches(gni_draft *d);
/* What they are to the light at hand. */
void gni_light_patches(gni_draft *d);
/* rectangle: where the fan is seen. */
gni_on_patch gni_cast_on_patch(const gni_draft *d, uint32_t object, const gni_patch *patch, uint32_t rectangle[4]);
/* The plane of a planar mesh in view space, its normal of unit length; 0 when it has none. */
int gni_plane_in_view(const gn_object *object, const gn_camera *camera, double plane[4]);
/* On which side of it the eye is: the sign. */
double gni_eye_side(const gn_camera *camera, const double plane[4]);
/* Whether all of a planar object is drawn as seen from a side of plane_in_view(). */
int gni_shows_side(const gn_object *object, int mirrored, double of_eye);

/* cache.c: a new frame. */
void gni_start_cache(gn_shadow_cache *cache, const gn_scene *scene);
/* What the plan says of it. */
void gni_end_cache(const gn_shadow_cache *cache, gn_plan *plan);
/* The slot of an object in the light at hand, whose streams may be used, or made; NULL where nothing is kept of it
 * now. */
gni_slot *gni_find_slot(gni_draft *d, uint32_t object);
/* Where a stream of at most so many indices may be written; NULL where there is no room. */
uint16_t *gni_take_room(gn_shadow_cache *cache, gni_stream *stream, uint32_t most);
void gni_note_change(gn_shadow_cache *cache, const gni_stream *stream);

/* streams.c: makes a stream of the slot at hand if it is not made yet; NULL where there is no room. */
const gni_stream *gni_make_stream(gni_draft *d, uint32_t object, int kind);

/* receivers.c: for a flat caster, its plane in view space, positive where the light is, if the eye is there too and all
 * of the caster is drawn; else 0. */
int gni_lit_side(const gni_draft *d, uint32_t object, double plane[4]);
/* What the volume may touch of that which receives, is seen and lit. plane: of gni_lit_side(), or NULL. Returns 0 when
 * there is nothing. */
int gni_find_extent(gni_extent *e, const gni_draft *d, uint32_t object, gni_hull *volume, const double *plane);

/* A closed volume of the caster at hand. */
typedef struct gni_volume {
    uint32_t object;
    const gni_case *at_hand;
    const gni_extent *extent; /* its scissor and image */
    gn_far far_end;
    const double *start_plane; /* NULL: it starts at the caster */
    const double *end_plane;   /* view space; not read where there is a reach */
    double end_reach;
    int unpatched; /* as in gn_record */
} gni_volume;

/* Where the parts of a chunk are, one behind the other, the turned cap wherever. */
typedef struct gni_run {
    uint32_t first, first_turned, light_cap, sides, dark_cap, near_cap, turned_cap; /* indices */
    int fan;
} gni_run;

/* fragments.c: no pixel gets more fragments of one side of a volume than this. */
uint32_t gni_most_fragments(gni_draft *d, const gni_volume *v, const gni_casting *casting);

/* batches_color.c: batches of counts in colour. */
#define GNI_TILES        16
#define GNI_SPARE_PIECES 16 /* of a caster that is cut: pieces made smaller for their rings */
void gni_start_color(gni_draft *d);
/* A caster's volume, in this batch or in the next, or cut. */
void gni_add_colored(gni_draft *d, const gni_volume *v, const gni_casting *casting);
/* Room for so many fragments in the scissor; ends the batch if there is none. */
void gni_make_room(gni_draft *d, const uint32_t scissor[4], uint32_t fragments);
/* The steps behind a batch, and before the next if more follows. */
void gni_fold_color(gni_draft *d, int more_follows);

/* slivers.c: the eye in the space of the volume's mesh, and between which of its heights over a triangle's plane that
 * is drawn in a light cap by z-pass. 0 where all must be drawn. */
int gni_find_slivers(const gni_draft *d, const gni_volume *volume, double eye[4], double heights[2]);
uint32_t gni_put_slivers(const gn_mesh *mesh, uint32_t chunk, const gni_casting *c, const double eye[4],
                         const double heights[2], uint16_t *out);

/* thin.c: whether a small mask may miss an object, or its shadow in the light at hand. */
int gni_is_thin_image(const gni_draft *d, uint32_t object);
int gni_is_thin_shadow(const gni_draft *d, uint32_t object, const gni_extent *extent);

/* plan_volumes.c */
/* Which parts of a volume its way of counting takes, and what way that is. */
unsigned gni_choose_parts(const gni_draft *d, const gni_volume *v, int *mcguire_case);
/* d->casting is that of this object in the light at hand. */
void gni_know_casting(gni_draft *d, uint32_t object);
/* The volumes of one caster, whose triangles are in d->casting. */
gn_result gni_add_caster(gni_draft *d, uint32_t object, const gni_case *at_hand, const gni_extent *extent);
/* records.c */
/* Planes go the other way: a plane p of view space is p m in the space that m takes to view space. */
void gni_plane_before(double out[4], const double plane[4], const double m[16]);
/* A bound on the layers of a caster that costs no more than to look: half the silhouette, seen from outside. GNI_NONE:
 * it is not known. */
void gni_note_layers(gni_draft *d, uint32_t object, uint32_t triangles, uint32_t silhouette);
/* Records of volumes of one caster, which share their indices: a record for each chunk that has any of each. Returns
 * the sum of the silhouette's weights, or GNI_NONE where no sides are drawn. */
uint32_t gni_add_records(gni_draft *d, const gni_volume *volumes, uint32_t count, const gni_casting *casting);
/* A record before its indices; what it takes of them; and one whose counts are known becomes one of the plan's. */
void gni_start_record(gn_record *r, const gni_draft *d, const gni_volume *v, const uint32_t scissor[4], uint32_t chunk);
void gni_use_run(gn_record *r, const gni_run *run, unsigned parts);
void gni_keep_record(gni_draft *d, gn_record *r);
/* Whether the dark cap of a volume that ends on a plane is better a fan. */
int gni_is_better_fan(const gn_mesh *mesh, uint32_t edges, uint32_t triangles);

/* kept_records.c: from the slot at hand; 0 where it has no room. */
int gni_add_kept_records(gni_draft *d, const gni_volume *volumes, uint32_t count);
/* What a stream has of a chunk. *at: where that starts; on return where it ends. */
gni_run gni_find_run(const gni_stream *stream, int kind, uint32_t chunk, uint32_t *at);
/* Of closed meshes a fan; but counts in colour stop at the ends, and a fan's triangles may lie on each other. */
int gni_kind_of_cap(const gni_draft *d, const gn_mesh *mesh);

/* flats.c: fans of the same caster on patches, into d->flats. first_record: of its volume, if it has one. */
void gni_add_flats(gni_draft *d, uint32_t object, const gni_extent *extent, uint32_t first_record);

/* sweep.c: no point has more layers of the records from first_record on than this; UINT32_MAX where that is not
 * known. */
uint32_t gni_sweep_layers(gni_draft *d, uint32_t first_record);
/* The same of one caster's. */
uint32_t gni_sweep_caster(gni_draft *d, uint32_t first_record, uint32_t object);

/* batches.c: the same, cut so that each piece keeps within the bits, and folded before the batch would not. */
void gni_add_batched(gni_draft *d, const gni_volume *volume, const gni_casting *casting);
/* Whether the light's casters, all with their records made from first_record on, surely keep within `limit` layers. */
int gni_layers_fit(gni_draft *d, uint32_t limit, uint32_t first_record);
/* At most so many pieces of a caster with so many ends. */
size_t gni_most_pieces(const gn_mesh *mesh, size_t ends, uint32_t limit);
#endif
