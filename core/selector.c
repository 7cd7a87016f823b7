/* selector.c - the choice from frame to frame: what select.c wants, reached no faster than is stable.
 *
 * Saving and spending differ. A frame that is predicted to be over budget is answered by one step after 8 frames; two frames that were
 * over it, by all that is wanted at once; but more is spent only when 60 frames were calm, where a tenth of the budget
 * would still be free under the greatest loads of late, and twice as long after each time that it failed. Whatever was wanted, one
 * knob of one light moves at a time. What is kept free of the budget besides is by how much frames differ from their
 * predictions: 2.1 deviations of that. */
#include "gni_select.h"

#include <math.h>
#include <string.h>

#define DOWN_FRAMES 8
#define UP_FRAMES   60
#define MOST_FRAMES 3840 /* that a level which failed is not tried for */
#define FAILS       120  /* frames after spending more in which having to save is its failure */
#define HELD        10   /* times the wait, after which spending more has not failed */
#define PANIC       2    /* frames over budget in a row */
#define FREE        0.9  /* of what is left, that spending more may use */
#define DEVIATIONS  2.1  /* two frames in a hundred are farther off */
#define FADES       0.3  /* share of a peak of load that is forgotten in the frames that spending waits for */
#define CHEAPER     0.8  /* times the cost: as accurate, and worth a change */

struct gn_selector {
    gn_context *context;
    gn_knowledge knowledge;
    gn_rules *rules, *own_rules;
    gn_selection selection; /* as set, with rules and knowledge of its own */
    gni_learner learner;
    gn_light_state lights[GN_MOST_SELECTED];
    gn_load peaks[GN_MOST_SELECTED];
    gn_way ways[GN_MOST_SELECTED];
    gn_choice wanted[GN_MOST_SELECTED], with_less[GN_MOST_SELECTED]; /* of the budget; of a part of it */
    gn_way tried[GN_MOST_SELECTED];
    uint32_t light_count;
    double parts[GN_METHOD_TOTAL];     /* of the frame at hand: ms predicted by method, not corrected */
    uint32_t since, since_up, wait_up; /* frames */
    int has_spent;                     /* the last change was to spend more */
    uint32_t over;                     /* measured ones over budget, in a row */
    int has_changed;                   /* this frame is the first of a change: it makes images and programs */
};

gn_result gn_selector_create(gn_context *context, const gn_knowledge *knowledge, gn_rules *rules,
                             gn_selector **selector)
{
    gn_selector *s;
    gn_result result;

    if (!context || !selector)
        return gn_fail(context, GN_E_ARG, "gn_selector_create: NULL argument");
    *selector = NULL;
    s = gni_alloc(context, 1, sizeof *s);
    if (!s)
        return gn_fail(context, GN_E_MEMORY, "selector: no memory");
    memset(s, 0, sizeof *s);
    s->context = context;
    result = rules ? gni_check_rules(context, rules) : gn_rules_default(context, &s->own_rules);
    if (result != GN_OK) {
        gn_selector_destroy(s);
        return result;
    }
    if (knowledge)
        s->knowledge = *knowledge;
    else
        gn_knowledge_default(&s->knowledge);
    s->rules = rules ? rules : s->own_rules;
    gni_learn_start(&s->learner);
    s->wait_up = UP_FRAMES;
    s->since_up = FAILS;
    *selector = s;
    return GN_OK;
}

void gn_selector_destroy(gn_selector *s)
{
    if (!s)
        return;
    gn_rules_destroy(s->own_rules);
    gni_free(s->context, s);
}

void gn_selector_set(gn_selector *s, const gn_selection *selection)
{
    const int is_other = memcmp(&s->selection.budget, &selection->budget, sizeof selection->budget) != 0 ||
                         memcmp(&s->selection.possible, &selection->possible, sizeof selection->possible) != 0;

    s->selection = *selection;
    if (is_other)
        s->since = s->wait_up = UP_FRAMES;
}

/* ------------------------------------------------------------------ what is used */

/* The selection for a share of the budget, less what frames differ by. */
static gn_selection selection_of(const gn_selector *s, double share)
{
    gn_selection of = s->selection;
    const double kept = 1.0 / (1.0 + fmin(DEVIATIONS * s->learner.deviation, 1.0));

    of.knowledge = &s->knowledge;
    of.rules = s->rules;
    of.gains = s->learner.gains;
    of.host_ms = s->learner.is_started ? s->learner.host_ms : s->selection.host_ms;
    of.lights = s->lights;
    of.light_count = s->light_count;
    of.budget.frame_ms *= share * kept;
    of.budget.energy_mw *= share;
    return of;
}

static int is_same(const gn_way *a, const gn_way *b)
{
    if (a->is_dropped || b->is_dropped)
        return a->is_dropped == b->is_dropped;
    return a->method == b->method && a->scale == b->scale && (a->scale == 1 || a->upsample == b->upsample) &&
           a->update_every == b->update_every && a->proxies == b->proxies;
}

/* What a light's way takes of a frame's time: the passes of all that are made so stand with the first of them. */
static double ms_of(const gn_way *ways, uint32_t light, uint32_t light_count, const gni_candidate *c)
{
    uint32_t alike = 0, before = 0;

    for (uint32_t i = 0; i < light_count; i++)
        if (is_same(&ways[i], &ways[light])) {
            alike++;
            before += i < light;
        }
    return c->cost.ms - c->setup_ms + (before ? 0.0 : gn_count_passes(&ways[light], alike) * c->pass_ms);
}

/* The share of the budget that the ways take; INFINITY where one of them may not be taken. */
static double usage(const gn_selection *of, const gn_way *ways)
{
    double ms = 0.0, mj = 0.0, ms_left, mj_left;

    for (uint32_t i = 0; i < of->light_count; i++) {
        gni_candidate c;

        if (gni_consider_way(of, i, &ways[i], &c) != GNI_WAY_MAY)
            return INFINITY;
        ms += ways[i].is_dropped ? 0.0 : ms_of(ways, i, of->light_count, &c);
        mj += c.cost.mj;
    }
    gni_allowance(of, &ms_left, &mj_left);
    return fmax(isinf(ms_left) ? 0.0 : ms / ms_left, isinf(mj_left) ? 0.0 : mj / mj_left);
}

/* ------------------------------------------------------------------ steps */

static void turn_knob(gn_way *way, const gn_way *to, int knob)
{
    switch (knob) {
    case 0:
        way->scale = to->scale;
        break;
    case 1:
        way->upsample = to->upsample;
        break;
    case 2:
        way->update_every = to->update_every;
        break;
    case 3:
        way->proxies = to->proxies;
        break;
    default:
        way->method = to->method;
        break;
    }
}

/* Small masks are what refine is made of: to it and from it they change together. */
static void turn_refine(gn_way *way, const gn_way *to)
{
    way->method = to->method;
    way->scale = to->scale;
    way->upsample = to->upsample;
}

/* What a way takes of the budget; where there is none, of time. */
static double weight_of(const gni_candidate *c)
{
    return c->share > 0.0 ? c->share : 1e-9 * c->cost.ms;
}

/* The first knob towards another way that leads where one may go, and is neither dearer nor less accurate than both ends; all of it
 * where none does, and where a shadow comes or goes. */
static gn_way step_towards(const gn_selection *of, uint32_t light, const gn_way *from, const gn_way *to)
{
    const int is_refined = (from->method == GN_METHOD_REFINE) != (to->method == GN_METHOD_REFINE);
    gni_candidate ends[2], c;
    gn_accuracy least;
    double most;

    gni_consider_way(of, light, from, &ends[0]);
    gni_consider_way(of, light, to, &ends[1]);
    most = fmax(weight_of(&ends[0]), weight_of(&ends[1]));
    least = ends[0].accuracy < ends[1].accuracy ? ends[0].accuracy : ends[1].accuracy;
    for (int knob = is_refined ? 2 : 0; knob < 5 && !from->is_dropped && !to->is_dropped; knob++) {
        gn_way way = *from;

        if (knob == 4 && is_refined)
            turn_refine(&way, to);
        else
            turn_knob(&way, to, knob);
        if (!is_same(&way, from) && gni_consider_way(of, light, &way, &c) == GNI_WAY_MAY && weight_of(&c) <= most &&
            c.accuracy >= least)
            return way;
    }
    return *to;
}

static void take(gn_selector *s, uint32_t light, const gn_way *way, int spends)
{
    s->ways[light] = *way;
    s->has_changed = 1;
    s->has_spent = spends;
    s->since = 0;
    if (spends) {
        s->since_up = 0;
    } else if (s->since_up < FAILS) {
        s->wait_up = s->wait_up * 2 < MOST_FRAMES ? s->wait_up * 2 : MOST_FRAMES;
        s->since_up = FAILS;
    }
}

/* Whether a light's way takes more than what is wanted for it. */
static int is_dearer(const gn_selector *s, const gn_selection *of, const gn_choice *wanted, uint32_t light)
{
    gni_candidate now, then;

    if (is_same(&s->ways[light], &wanted[light].way))
        return 0;
    gni_consider_way(of, light, &s->ways[light], &now);
    gni_consider_way(of, light, &wanted[light].way, &then);
    return weight_of(&now) > weight_of(&then);
}

/* One step to save: of the least important light, but for one, whose way takes more than what is wanted. spends: it makes room. */
static void save(gn_selector *s, const gn_selection *of, const gn_choice *wanted, uint32_t but, int spends)
{
    uint32_t at = UINT32_MAX;

    for (uint32_t i = 0; i < of->light_count; i++)
        if (i != but && is_dearer(s, of, wanted, i) &&
            (at == UINT32_MAX || of->lights[i].importance < of->lights[at].importance))
            at = i;
    if (at != UINT32_MAX) {
        const gn_way way = step_towards(of, at, &s->ways[at], &wanted[at].way);

        take(s, at, &way, spends);
    }
}

static int is_worth_it(const gn_selector *s, const gn_selection *of, const gn_choice *wanted, uint32_t light)
{
    gni_candidate now, then;

    if (is_same(&s->ways[light], &wanted[light].way))
        return 0;
    if (gni_consider_way(of, light, &s->ways[light], &now) != GNI_WAY_MAY)
        return 1;
    gni_consider_way(of, light, &wanted[light].way, &then);
    return then.accuracy > now.accuracy ||
           (then.accuracy == now.accuracy && weight_of(&then) < CHEAPER * weight_of(&now));
}

/* One step to be more accurate, or as accurate for clearly less: of the most important light that can. Where it does not fit until
 * another gives way, that one's first. */
static void spend(gn_selector *s, const gn_selection *of, const gn_choice *wanted)
{
    uint32_t at = UINT32_MAX;

    for (uint32_t i = 0; i < of->light_count; i++)
        if (is_worth_it(s, of, wanted, i) && (at == UINT32_MAX || of->lights[i].importance > of->lights[at].importance))
            at = i;
    if (at == UINT32_MAX)
        return;
    memcpy(s->tried, s->ways, of->light_count * sizeof *s->tried);
    s->tried[at] = step_towards(of, at, &s->ways[at], &wanted[at].way);
    if (usage(of, s->tried) <= 1.0)
        take(s, at, &s->tried[at], 1);
    else
        save(s, of, wanted, at, 1);
}

/* ------------------------------------------------------------------ frames */

static void note_lights(gn_selector *s, const gn_light_state *lights, uint32_t count)
{
    const double left = 1.0 - FADES / s->wait_up;

    for (uint32_t i = 0; i < count; i++) {
        gn_load *peak = &s->peaks[i];

        if (i >= s->light_count)
            memset(peak, 0, sizeof *peak);
        s->lights[i] = lights[i];
        peak->indices = fmax(left * peak->indices, lights[i].load.indices);
        peak->fragments = fmax(left * peak->fragments, lights[i].load.fragments);
        peak->borders = fmax(left * peak->borders, lights[i].load.borders);
        peak->pixels = fmax(left * peak->pixels, lights[i].load.pixels);
    }
    s->light_count = count;
}

static void swap_loads(gn_selector *s)
{
    for (uint32_t i = 0; i < s->light_count; i++) {
        const gn_load load = s->lights[i].load;

        s->lights[i].load = s->peaks[i];
        s->peaks[i] = load;
    }
}

/* What the ways in use are predicted to take, by method and without gains. Each different way is set up once. */
static void predict(gn_selector *s)
{
    const double ones[GN_METHOD_TOTAL] = {1, 1, 1, 1, 1, 1, 1, 1, 1};
    gn_selection of = selection_of(s, 1.0);

    of.gains = ones;
    memset(s->parts, 0, sizeof s->parts);
    for (uint32_t i = 0; i < s->light_count; i++) {
        gni_candidate c;

        if (!s->ways[i].is_dropped && gni_consider_way(&of, i, &s->ways[i], &c) == GNI_WAY_MAY)
            s->parts[s->ways[i].method] += ms_of(s->ways, i, s->light_count, &c);
    }
}

/* Whether a light is less accurate than one that matters less. */
static int is_upside_down(const gn_selector *s, const gn_selection *of)
{
    gn_accuracy accuracy[GN_MOST_SELECTED];
    gni_candidate c;

    for (uint32_t i = 0; i < s->light_count; i++) {
        gni_consider_way(of, i, &s->ways[i], &c);
        accuracy[i] = c.accuracy;
        for (uint32_t k = 0; k < i; k++) {
            const double more = s->lights[i].importance - s->lights[k].importance;

            if ((more > 0.0 && accuracy[i] < accuracy[k]) || (more < 0.0 && accuracy[i] > accuracy[k]))
                return 1;
        }
    }
    return 0;
}

/* What would be chosen of as much as is used now: nothing needs to be free for what serves a more important light. */
static gn_result redistribute(gn_selector *s, double used)
{
    gn_selection of = selection_of(s, 1.0);
    double ms_left, mj_left;
    gn_result result;

    gni_allowance(&of, &ms_left, &mj_left);
    if (of.budget.frame_ms > 0.0)
        of.budget.frame_ms = of.host_ms + used * ms_left * (1.0 + 1e-9);
    of.budget.energy_mw *= used * (1.0 + 1e-9);
    result = gn_select(s->context, &of, s->with_less);
    if (result == GN_OK)
        spend(s, &of, s->with_less);
    return result;
}

static gn_result decide(gn_selector *s, uint32_t known)
{
    gn_selection of = selection_of(s, 1.0);
    gn_result result = gn_select(s->context, &of, s->wanted);
    const int is_panic = s->over >= PANIC;
    double used;

    if (result != GN_OK)
        return result;
    s->has_changed = 0;
    for (uint32_t i = 0; i < s->light_count; i++) { /* lights that are new, and ways that are possible no more */
        gni_candidate c;

        if (i >= known || gni_consider_way(&of, i, &s->ways[i], &c) != GNI_WAY_MAY) {
            s->ways[i] = s->wanted[i].way;
            s->has_changed = 1;
        }
    }
    used = usage(&of, s->ways);
    if (is_panic && used > 1.0) {
        for (uint32_t i = 0; i < s->light_count; i++)
            if (!is_same(&s->ways[i], &s->wanted[i].way))
                take(s, i, &s->wanted[i].way, 0);
        s->over = 0;
        return GN_OK;
    }
    if (used > 1.0) {
        if (s->since >= DOWN_FRAMES)
            save(s, &of, s->wanted, UINT32_MAX, 0);
        return GN_OK;
    }
    if (s->since < s->wait_up)
        return GN_OK;
    if (used > 0.0 && is_upside_down(s, &of)) {
        result = redistribute(s, used);
        if (result != GN_OK || s->has_changed)
            return result;
    }
    swap_loads(s);
    of = selection_of(s, FREE);
    result = gn_select(s->context, &of, s->with_less);
    if (result == GN_OK)
        spend(s, &of, s->with_less);
    swap_loads(s);
    return result;
}

gn_result gn_selector_next(gn_selector *s, const gn_light_state *lights, uint32_t light_count, gn_way *ways)
{
    const uint32_t known = s ? s->light_count : 0;
    gn_result result;

    if (!s || (light_count && (!lights || !ways)))
        return gn_fail(s ? s->context : NULL, GN_E_ARG, "gn_selector_next: NULL argument");
    if (light_count > GN_MOST_SELECTED)
        return gn_fail(s->context, GN_E_ARG, "gn_selector_next: at most %d lights (%lu)", GN_MOST_SELECTED,
                       (unsigned long)light_count);
    note_lights(s, lights, light_count);
    result = decide(s, known);
    if (result != GN_OK) {
        s->light_count = known < light_count ? known : light_count;
        return result;
    }
    s->since++;
    s->since_up++;
    if (s->has_spent && s->since > HELD * s->wait_up)
        s->wait_up = UP_FRAMES;
    predict(s);
    memcpy(ways, s->ways, light_count * sizeof *ways);
    return GN_OK;
}

void gn_selector_measured(gn_selector *s, double frame_ms)
{
    const double budget = s->selection.budget.frame_ms;

    if (!(frame_ms > 0.0 && isfinite(frame_ms)) || (s->has_changed && s->learner.is_started))
        return;
    gni_learn(&s->learner, s->parts, frame_ms);
    s->over = budget > 0.0 && frame_ms > budget ? s->over + 1 : 0;
}

void gn_selector_explain(const gn_selector *s, gn_selection *selection, const gn_choice **choices)
{
    *selection = selection_of(s, 1.0);
    *choices = s->wanted;
}

double gn_selector_predicted(const gn_selector *s)
{
    return gni_predict(&s->learner, s->parts);
}
