/* gni_select.h - what the files of the selector share: ways that may be taken, and what is known of each. */
#ifndef GNI_SELECT_H
#define GNI_SELECT_H
#include "gn_select.h"
#include "gni.h"

enum {
    GNI_UPDATES = 3, /* 1, 2, 4 frames */
    /* method by variant by update by proxies */
    GNI_WAYS = GN_METHOD_TOTAL * GN_VARIANT_COUNT * GNI_UPDATES * 2
};

/* Why a way is not taken; GNI_WAY_MAY if it may. */
typedef enum gni_refusal {
    GNI_WAY_MAY,
    GNI_WAY_UNKNOWN,
    GNI_WAY_IMPOSSIBLE,
    GNI_WAY_TOO_LARGE,
    GNI_WAY_UNWANTED
} gni_refusal;

typedef struct gni_candidate {
    gn_way way;
    int variant;
    gn_accuracy accuracy;
    gn_cost cost;
    double setup_ms; /* of cost: this light's part of its passes, as if all lights were made this way */
    double pass_ms;  /* and all of one pass */
    double
        share; /* of the budget that is left for shadows: the greater of time's and energy's; 0 where there is none */
} gni_candidate;

/* knowledge.c: whether a method can be so; refine has small masks of its own, that are not upsampled. */
int gni_way_exists(int method, int variant);

/* select.c: what a budget leaves for shadows; INFINITY: any. */
void gni_allowance(const gn_selection *s, double *ms, double *mj);
/* Way number n of a light. */
gni_refusal gni_consider(const gn_selection *s, uint32_t light, uint32_t n, gni_candidate *out);
/* The same for a way that is at hand. */
gni_refusal gni_consider_way(const gn_selection *s, uint32_t light, const gn_way *way, gni_candidate *out);

/* suitability.c: what rules say of a light. */
typedef struct gni_suits {
    gn_facts facts;     /* with headroom */
    uint32_t knobs[16]; /* outputs of the rules by knob; UINT32_MAX: not named */
    double outputs[64];
    float strengths[256];
} gni_suits;

void gni_find_knobs(const gn_rules *rules, gni_suits *out);
void gni_evaluate_facts(gn_rules *rules, gni_suits *suits);
/* 0 to 100; *output: the one that bounds it, UINT32_MAX if none does. */
double gni_suitability(const gni_suits *s, const gn_way *way, uint32_t *output);
/* The rule that holds most of those that conclude on the output. */
uint32_t gni_strongest_rule(const gn_rules *rules, const gni_suits *s, uint32_t output);
/* select.c: what rules say of it when so many ms are used by lights that matter more. */
void gni_suit_light(const gn_selection *s, uint32_t light, double used_ms, gni_suits *suits);
/* Whether the rules ask for facts that there are, and are not more than there is room for. */
gn_result gni_check_rules(gn_context *context, const gn_rules *rules);

/* learn.c: the host's time of a frame, the gain of all methods, and by how much each one's is another; by what frames took. */
enum { GNI_LEARNED = 2 + GN_METHOD_TOTAL };
typedef struct gni_learner {
    int is_started;
    double host_ms, common, own[GN_METHOD_TOTAL];
    double gains[GN_METHOD_TOTAL]; /* common + own, within bounds */
    double variance[GNI_LEARNED][GNI_LEARNED];
    double deviation; /* of frames from their predictions, as a share */
    int far;          /* residuals in a row that are far beyond that: above 0, or below */
} gni_learner;

void gni_learn_start(gni_learner *l);
double gni_predict(const gni_learner *l, const double parts[GN_METHOD_TOTAL]);
void gni_learn(gni_learner *l, const double parts[GN_METHOD_TOTAL], double ms);
#endif
