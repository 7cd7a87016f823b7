/* gni_plan.h - what the files that make a plan share: plan.c the frame, plan_light.c a light, plan_volumes.c a caster's
 * records, batches.c and cells.c counts that the stencil's bits do not hold. */
#ifndef GNI_PLAN_H
#define GNI_PLAN_H
#include "gni.h"

enum { GNI_IN_CAST = 1, GNI_IN_LIT = 2 }; /* what an object is to a light */

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

#define GNI_BINS 4096 /* of sweep.c */

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
    gni_hull *boxes;         /* [object_count] of objects, in view space */
    uint8_t *is_in;          /* [object_count] of the light at hand: GNI_IN_* */
    gni_hull all_lit;        /* a box around all that receives and is lit by it */
    int8_t *casting, *group; /* of the caster at hand; group: those of one volume of it */
    uint8_t *end_of;
    gni_region *region; /* NULL: volumes need not end */
    gni_ends *ends;
    gni_layers *layers; /* NULL: nothing can nest too much; nor are there the six arrays that follow */
    int8_t *piece;      /* of the volume at hand: those of one piece */
    uint32_t *order, *parent, *end, *ring;
    uint32_t *cheap_of; /* [object_count] layers of each caster of the light at hand, a cheap bound */
    gni_choice choice;
    double projection[16], view[16];
    int receivers_are_known; /* some object is said to receive: then those are all that do */
    gni_stain stain;

    /* the light at hand */
    uint32_t light;
    gni_bounds bounds;
    gni_view seen; /* through its scissor */
    int is_batched;
    uint32_t first_of_batch; /* record */
    uint64_t casting_count, cheap_layers;
} gni_draft;

/* plan.c */
void gni_add_step(gni_draft *d, gn_step_kind kind, gn_draw draw, uint32_t light, int receivers);

/* plan_check.c: whether all numbers of a scene are such that a plan can be made. */
gn_result gni_check_scene(gn_context *context, const gn_scene *scene);

/* plan_light.c: steps and records of light d->light. */
gn_result gni_add_light(gni_draft *d, uint32_t light);
/* Homogeneous, in view space, the eye subtracted first. */
void gni_light_in_view(const gni_draft *d, const gn_light *light, double out[4]);

/* receivers.c: for a flat caster, its plane in view space, positive where the light is, if the eye is there too and all
 * of the caster is drawn; else 0. */
int gni_lit_side(const gni_draft *d, uint32_t object, double plane[4]);
/* Whether the volume may touch something that receives, is seen and lit. plane: of gni_lit_side(), or NULL. */
int gni_shadows_anything(const gni_draft *d, uint32_t object, const gni_hull *volume, const double *plane);

/* A closed volume of the caster at hand. */
typedef struct gni_volume {
    uint32_t object;
    const gni_case *at_hand;
    gn_far far_end;
    const double *end_plane; /* view space; not read where there is a reach */
    double end_reach;
} gni_volume;

/* plan_volumes.c: the volumes of one caster, whose triangles are in d->casting. */
gn_result gni_add_caster(gni_draft *d, uint32_t object, const gni_case *at_hand);
/* Records of one volume: a record for each chunk that has any of it. Returns the sum of the silhouette's weights, or
 * GNI_NONE where no sides are drawn. */
uint32_t gni_add_records(gni_draft *d, const gni_volume *volume, const int8_t *casting);

/* sweep.c: no point has more layers of the records from first_record on than this; UINT32_MAX where that is not known. */
uint32_t gni_sweep_layers(gni_draft *d, uint32_t first_record);

/* batches.c: the same, cut so that each piece keeps within the bits, and folded before the batch would not. */
void gni_add_batched(gni_draft *d, const gni_volume *volume, const int8_t *casting);
/* Whether the light's casters, all with their records made from first_record on, surely keep within `limit` layers. */
int gni_layers_fit(gni_draft *d, uint32_t limit, uint32_t first_record);
/* Ends a batch: its step of volumes, and one that folds it if more follows. */
void gni_end_batch(gni_draft *d, int more_follows);
/* At most so many pieces of a caster with so many ends. */
size_t gni_most_pieces(const gn_mesh *mesh, size_t ends, uint32_t limit);
#endif
