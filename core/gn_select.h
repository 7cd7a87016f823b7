/* gn_select.h - chooses, for each light, how its shadows are made: the most accurate way that a budget of time, energy and
 * memory can pay for, and of equally accurate ones that which suits. gnomon.h's conventions hold here.
 *
 *     facts, load   what a light's shadows are like and how much there is of them, from the plan of the last frame
 *     knowledge     what each way costs on this board, measured (`gnomon calibrate`), and how accurate it is
 *     rules         what suits, where numbers alone do not decide (gn_rules.h)
 *     selector      all of it from frame to frame: predicts, decides, steps no faster than the eye forgives, and
 *                   learns from what frames took
 *
 * (Rautenbach 2008, chapter 6: facts, knowledge base, inference engine, explanation.) */
#ifndef GN_SELECT_H
#define GN_SELECT_H
#include "gn_rules.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Ways and their accuracy ---- */

/* A way to make a light's shadows: its knobs. */
typedef struct gn_way {
    int is_dropped; /* no shadow; the rest means nothing */
    gn_method method;
    uint32_t scale; /* of gn_scene: 1, 2 or 4 */
    gn_upsample upsample;
    uint32_t update_every; /* frames for which a mask is used: gn_shadow_cache_desc.masks_every */
    int proxies;           /* casters that have one cast by it */
} gn_way;

/* Classes, by what `gnomon measure` finds. */
typedef enum gn_accuracy {
    GN_ACCURACY_NONE,  /* no shadow */
    GN_ACCURACY_ROUGH, /* borders stray by more than a pixel */
    GN_ACCURACY_FAIR,  /* by about one */
    GN_ACCURACY_FINE,  /* a few pixels are wrong */
    GN_ACCURACY_EXACT, /* none that the truth is certain of */
    GN_ACCURACY_COUNT
} gn_accuracy;

const char *gn_accuracy_name(gn_accuracy accuracy);
/* GN_ACCURACY_COUNT when there is none of that name. */
gn_accuracy gn_accuracy_by_name(const char *name);
/* "stencil", "count@1/2-depth, masks for 2 frames, proxies", "none"; like snprintf. */
size_t gn_way_name(const gn_way *way, char *text, size_t capacity);

/* ---- Facts and loads ---- */

/* Of a light, by these names in rules too. */
typedef struct gn_facts {
    double lights;   /* that cast shadows in this frame */
    double moving;   /* of them */
    double layers;   /* shadow volumes over a pixel of the light's scissor, on average */
    double faces;    /* triangles of its casters */
    double edges;    /* of their silhouettes */
    double nearness; /* how large what casts is on the screen, 0 to 1: the borders of its shadows are as long */
    double motion;   /* how fast things cross the screen, 0 to 1: a fiftieth of its height in a frame, or more */
    double headroom; /* of the budget for a frame's time, before this choice: 1, none is used */
    double power;    /* from the host: 0, hot or low; 1, mains */
} gn_facts;

enum { GN_FACT_COUNT = 9 };
/* The fact's name and place; NULL past the last. */
const char *gn_fact_name(int fact);
double *gn_fact(gn_facts *facts, int fact);

/* How much there is to draw for a light's mask at full size. */
typedef struct gn_load {
    double indices;   /* of volumes */
    double fragments; /* that they rasterise */
    double borders;   /* pixels round their triangles: fragments are made in blocks, and these are not full */
    double pixels;    /* in the light's scissor */
} gn_load;

/* A light's load and facts in a plan; of the facts not `lights`, `moving`, `motion`, `headroom`, `power`, which no single plan
 * knows. Fragments are estimated from `samples` pieces of its volumes, of as many as there are [128]. 1; 0, and nothing is
 * written, of a plan that uses masks which are kept: it has no volumes, and what was measured last still holds. */
int gn_plan_measure(const gn_plan *plan, uint32_t light, uint32_t samples, gn_load *load, gn_facts *facts);

/* ---- Knowledge ---- */

/* Coefficients: shadow time or memory traffic of a light's mask is their sum over what there is of each. */
enum {
    GN_COST_SETUP,    /* of a pass, shared by its lights: see gn_count_passes() */
    GN_COST_INDEX,    /* of volumes */
    GN_COST_FRAGMENT, /* of volumes, at the mask's size */
    GN_COST_BORDER,   /* the same, of their triangles' borders */
    GN_COST_PIXEL,    /* of the mask */
    GN_COST_SWITCH,   /* of target or pass: 1 for a stencil's, 2 for a mask's in a texture */
    GN_COST_COUNT
};

/* Scales and upsamplings that are known apart. */
enum {
    GN_VARIANT_FULL,
    GN_VARIANT_HALF,
    GN_VARIANT_HALF_DEPTH,
    GN_VARIANT_QUARTER,
    GN_VARIANT_QUARTER_DEPTH,
    GN_VARIANT_COUNT
};

/* Of a variant; and the variant of a way that has a shadow, GN_VARIANT_COUNT where there is none (masks by nearest). */
uint32_t gn_variant_scale(int variant);
gn_upsample gn_variant_upsample(int variant);
int gn_way_variant(const gn_way *way);
/* Passes in which so many lights are added that are made this way: four in each, or two where masks carry depth. */
uint32_t gn_count_passes(const gn_way *way, uint32_t lights);
/* How much of each coefficient a light's mask takes by a way, but for its kept masks and proxies; of setup 1: a pass's. */
void gn_count_costs(const gn_way *way, const gn_load *load, double counts[GN_COST_COUNT]);

typedef struct gn_knowledge {
    struct gn_known_way {
        int is_known;                /* 0: it is not chosen */
        double us[GN_COST_COUNT];    /* microseconds of each */
        double bytes[GN_COST_COUNT]; /* written and read */
        gn_accuracy accuracy;
    } ways[GN_METHOD_TOTAL][GN_VARIANT_COUNT];
} gn_knowledge;

/* What is known without measuring: of a slow board, on the safe side. */
void gn_knowledge_default(gn_knowledge *out);

/* Reads what `gnomon calibrate` writes, a CSV with a row for each way: method, scale, upsample, accuracy, us_setup,
 * us_index, us_fragment, us_border, us_pixel, us_switch, bytes_setup, ... bytes_switch. Ways without a row are not known. Returns GN_OK;
 * GN_E_ARG with line and column; *out is untouched unless GN_OK. */
gn_result gn_knowledge_read(gn_context *context, const char *text, size_t length, gn_knowledge *out);

/* ---- Selection ---- */

/* What a light's mask costs by a way. Energy is an estimate: traffic times 100 mW for a gigabyte a second (Arm). */
typedef struct gn_cost {
    double ms, mj;
    double memory; /* bytes of images and masks, of the whole frame */
} gn_cost;

/* All 0: exact, whatever it costs. */
typedef struct gn_budget {
    double frame_ms;     /* of a frame, the host's own drawing in it [any] */
    double energy_mw;    /* estimate, of shadows alone [any] */
    double interval_ms;  /* from one frame to the next, for energy [1000/60] */
    double memory;       /* bytes of images and masks, of each way for itself [any] */
    gn_accuracy quality; /* of no light less than this: also if that is over budget [shadows may be dropped] */
} gn_budget;

typedef struct gn_light_state {
    gn_facts facts; /* headroom is found here */
    gn_load load;
    double importance; /* of lights the greatest is served first [0: the last] */
} gn_light_state;

/* Ways that can be taken here at all: bit v of [m] for variant v of method m. */
typedef struct gn_possible {
    uint8_t variants[GN_METHOD_TOTAL];
    uint8_t keeps[GN_METHOD_TOTAL]; /* their masks can be used in several frames */
} gn_possible;

/* For a scene's target and what its host can do (reads_masks, blend_once, shade ...); its method and scale are not read. */
void gn_find_possible(const gn_scene *scene, gn_possible *out);

typedef struct gn_selection {
    const gn_knowledge *knowledge; /* borrowed */
    gn_rules *rules;               /* borrowed; NULL: all suits alike */
    gn_possible possible;
    double target_pixels;
    gn_budget budget;
    double host_ms;      /* of a frame, without shadows */
    const double *gains; /* [GN_METHOD_TOTAL] by which times are to be multiplied [1] */
    int has_proxies;
    int updates; /* the most frames for which masks may be used: 1, 2, 4 [1] */
    int prefers; /* 1: what suits best, and not what is most accurate, of what can be paid for (Rautenbach) */
    const gn_light_state *lights; /* [light_count] borrowed */
    uint32_t light_count;
} gn_selection;

/* What was chosen for a light, and why. */
typedef struct gn_choice {
    gn_way way;
    gn_cost cost;
    gn_accuracy accuracy; /* of the way: at least the class that the budget grants, which never falls with more of it */
    gn_accuracy granted;
    double suitability; /* 0 to 100 */
    uint32_t rule;      /* that holds most of those that bound its suitability; UINT32_MAX: none does */
    uint16_t feasible, affordable,
        equal;          /* ways: that are possible; that the budget pays too; of them as accurate and as cheap */
    int is_over_budget; /* no way of the least quality asked for is affordable: this is the cheapest of it */
} gn_choice;

enum { GN_MOST_SELECTED = 64 }; /* lights */

/* choices: [light_count]. A way's passes are shared by all lights here, as if they were made alike. Pure: the same selection, the same choices. Accuracy first: the class that all lights can have, then the
 * next class for as many as can be paid, the most important first; so that with more of a budget no light's class falls
 * that is granted to it (gn_choice.granted), nor, of one light or of time alone, that of its way.
 * Within a class, of ways that cost within a tenth of the cheapest, what suits best. Returns GN_OK; GN_E_ARG; GN_E_DEVICE
 * when no way is possible and known. Allocates nothing. */
gn_result gn_select(gn_context *context, const gn_selection *selection, gn_choice *choices);

/* A sentence on a choice, with its numbers; and, with derivation 1, all that led to it: facts and how much of each term they
 * are, rules that hold and by how much, and each way with its cost, accuracy, suitability, or why it was not taken. Like
 * snprintf. */
size_t gn_explain_choice(const gn_selection *selection, const gn_choice *choices, uint32_t light, int derivation,
                         char *text, size_t capacity);

/* ---- Selector: from frame to frame ---- */

typedef struct gn_selector gn_selector;

/* knowledge: copied; rules: used until the selector is destroyed, of facts alone; NULL: the library's own. Returns GN_OK;
 * GN_E_ARG for rules that ask for what is no fact; GN_E_MEMORY. */
gn_result gn_selector_create(gn_context *context, const gn_knowledge *knowledge, gn_rules *rules,
                             gn_selector **selector);
void gn_selector_destroy(gn_selector *selector);

/* What is asked and possible from the next frame on: lights, rules, knowledge and gains in it are not read. Another
 * budget is acted on at once. */
void gn_selector_set(gn_selector *selector, const gn_selection *selection);

/* The ways for the next frame: ways [light_count], at most GN_MOST_SELECTED. A change waits: 8 frames after the last when it saves,
 * 60 when it spends, twice as long each time for what has failed before; it moves one knob of one light. Two frames over
 * budget in a row change all at once to what is predicted to be affordable. */
gn_result gn_selector_next(gn_selector *selector, const gn_light_state *lights, uint32_t light_count, gn_way *ways);

/* What that frame took, all of it: predictions are corrected by it. */
void gn_selector_measured(gn_selector *selector, double frame_ms);

/* What the selector would take if nothing held it back, and by which selection: for gn_explain_choice(). Until the selector's
 * next call. Its budget is less what is kept free because frames differ from predictions. */
void gn_selector_explain(const gn_selector *selector, gn_selection *selection, const gn_choice **choices);
double gn_selector_predicted(const gn_selector *selector); /* ms of the next frame, by the ways taken */

#ifdef __cplusplus
}
#endif
#endif
