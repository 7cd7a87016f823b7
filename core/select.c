/* select.c - the choice: for each light the most accurate way that the budget can pay for.
 *
 * Each way of each light costs a share of the budget: the greater of its shares of time and of energy, so that shares which sum to
 * one keep both. Lights are raised together, class by class, as long as the cheapest ways of that class or a better one fit;
 * then one class further as many as fit, the most important first, until one does not. So more of a budget raises the
 * common class, or the number of those beyond it, and lowers no light. What a light then takes is of its class's cheapest
 * ways the one that suits best. (DESIGN.md, decision 16.) */
#include "gni_select.h"

#include <math.h>
#include <string.h>

#define MILLIJOULES_A_BYTE 1e-7 /* 100 mW for a gigabyte a second (Arm; Roettger 2002 has the same cause) */
#define EQUAL              1.1  /* times the cheapest: as cheap */
#define LEAST              1e-6 /* ms: what is left of a budget that the host alone uses, so that cheap is still told from dear */

enum { CLASSES = GN_ACCURACY_COUNT };

void gni_allowance(const gn_selection *s, double *ms, double *mj)
{
    const double interval = s->budget.interval_ms > 0.0 ? s->budget.interval_ms : 1000.0 / 60.0;

    *ms = s->budget.frame_ms > 0.0 ? fmax(s->budget.frame_ms - s->host_ms, LEAST) : INFINITY;
    *mj = s->budget.energy_mw > 0.0 ? s->budget.energy_mw * interval / 1000.0 : INFINITY;
}

/* Bytes of images and of masks, four lights in each. */
static double memory_of(const gn_selection *s, const gn_way *way)
{
    const double pixels = s->target_pixels / ((double)way->scale * way->scale);

    if (way->method == GN_METHOD_STENCIL && way->scale == 1)
        return 0.0;
    return pixels * (8.0 + 4.0 * ((s->light_count + 3) / 4));
}

static void find_cost(const gn_selection *s, const gn_light_state *light, const struct gn_known_way *known,
                      gni_candidate *c)
{
    const gn_way *way = &c->way;
    const double gain = s->gains ? s->gains[way->method] : 1.0;
    double counts[GN_COST_COUNT], us = 0.0, bytes = 0.0, ms_left, mj_left;

    gn_count_costs(way, &light->load, counts);
    counts[GN_COST_SETUP] = (double)gn_count_passes(way, s->light_count) / s->light_count;
    counts[GN_COST_INDEX] *= way->proxies ? 0.5 : 1.0;
    for (int i = 0; i < GN_COST_COUNT; i++) {
        /* a mask that is kept is read all the same */
        const double count = counts[i] / (i == GN_COST_PIXEL ? 1.0 : way->update_every);

        if (i == GN_COST_SETUP) {
            c->setup_ms = gain * known->us[i] * count / 1000.0;
            c->pass_ms = gain * known->us[i] / way->update_every / 1000.0;
        }
        us += known->us[i] * count;
        bytes += known->bytes[i] * count;
    }
    c->cost.ms = gain * us / 1000.0;
    c->cost.mj = bytes * MILLIJOULES_A_BYTE;
    c->cost.memory = memory_of(s, way);
    gni_allowance(s, &ms_left, &mj_left);
    c->share = fmax(isinf(ms_left) ? 0.0 : c->cost.ms / ms_left, isinf(mj_left) ? 0.0 : c->cost.mj / mj_left);
}

/* Masks that are late are wrong while anything moves, and for some frames once it does. */
static gn_accuracy accuracy_of(const gn_light_state *light, const struct gn_known_way *known, const gn_way *way)
{
    const int is_still = light->facts.motion <= 0.0 && light->facts.moving <= 0.0;
    gn_accuracy most = GN_ACCURACY_EXACT;

    if (way->proxies)
        most = GN_ACCURACY_FAIR;
    if (way->update_every > 1) {
        const gn_accuracy late = is_still                 ? GN_ACCURACY_FINE
                                 : way->update_every == 2 ? GN_ACCURACY_FAIR
                                                          : GN_ACCURACY_ROUGH;

        most = late < most ? late : most;
    }
    return known->accuracy < most ? known->accuracy : most;
}

static gni_refusal consider(const gn_selection *s, uint32_t light, gni_candidate *c)
{
    const gn_method method = c->way.method;
    const struct gn_known_way *known = &s->knowledge->ways[method][c->variant];

    if (method < GN_METHOD_STENCIL || !known->is_known) /* z-fail and z-pass are what stencil is measured by */
        return GNI_WAY_UNKNOWN;
    if (!(s->possible.variants[method] >> c->variant & 1))
        return GNI_WAY_IMPOSSIBLE;
    if (c->way.update_every > 1 && !(s->possible.keeps[method] >> c->variant & 1))
        return GNI_WAY_IMPOSSIBLE;
    if (c->way.update_every > (uint32_t)(s->updates > 1 ? s->updates : 1) || (c->way.proxies && !s->has_proxies))
        return GNI_WAY_UNWANTED;
    c->accuracy = accuracy_of(&s->lights[light], known, &c->way);
    find_cost(s, &s->lights[light], known, c);
    return s->budget.memory > 0.0 && c->cost.memory > s->budget.memory ? GNI_WAY_TOO_LARGE : GNI_WAY_MAY;
}

gni_refusal gni_consider(const gn_selection *s, uint32_t light, uint32_t n, gni_candidate *c)
{
    memset(c, 0, sizeof *c);
    c->way.proxies = (int)(n % 2);
    c->way.update_every = 1u << n / 2 % GNI_UPDATES;
    c->variant = (int)(n / (2 * GNI_UPDATES) % GN_VARIANT_COUNT);
    c->way.method = (gn_method)(n / (2 * GNI_UPDATES * GN_VARIANT_COUNT));
    c->way.scale = gn_variant_scale(c->variant);
    c->way.upsample = gn_variant_upsample(c->variant);
    return consider(s, light, c);
}

gni_refusal gni_consider_way(const gn_selection *s, uint32_t light, const gn_way *way, gni_candidate *c)
{
    gni_refusal refusal;

    memset(c, 0, sizeof *c);
    c->way = *way;
    if (way->is_dropped)
        return s->budget.quality > GN_ACCURACY_NONE ? GNI_WAY_UNWANTED : GNI_WAY_MAY;
    c->variant = gn_way_variant(way);
    if (c->variant == GN_VARIANT_COUNT)
        return GNI_WAY_UNKNOWN;
    refusal = consider(s, light, c);
    return refusal == GNI_WAY_MAY && c->accuracy < s->budget.quality ? GNI_WAY_UNWANTED : refusal;
}

/* ------------------------------------------------------------------ classes */

/* Of each light and class: the least share of a way that is as accurate or more, and how accurate it is. */
typedef struct ladder {
    double share[CLASSES];
    uint8_t reaches[CLASSES]; /* of gn_accuracy */
    uint8_t too_large;        /* a way is possible, but for its memory */
    uint16_t feasible;
} ladder;

static int climb(const gn_selection *s, uint32_t light, ladder *l)
{
    int best = GN_ACCURACY_NONE;

    l->feasible = 0;
    l->too_large = 0;
    for (int c = 0; c < CLASSES; c++) {
        l->share[c] = c ? INFINITY : 0.0;
        l->reaches[c] = GN_ACCURACY_NONE;
    }
    for (uint32_t n = 0; n < GNI_WAYS; n++) {
        gni_candidate c;

        const gni_refusal refusal = gni_consider(s, light, n, &c);

        l->too_large |= (uint8_t)(refusal == GNI_WAY_TOO_LARGE);
        if (refusal != GNI_WAY_MAY)
            continue;
        l->feasible++;
        best = (int)c.accuracy > best ? (int)c.accuracy : best;
        for (int k = 1; k <= (int)c.accuracy; k++)
            if (l->reaches[k] == GN_ACCURACY_NONE || c.share < l->share[k] ||
                (c.share == l->share[k] && (int)c.accuracy > l->reaches[k])) {
                l->share[k] = c.share;
                l->reaches[k] = (uint8_t)c.accuracy;
            }
    }
    for (int c = best + 1; c < CLASSES; c++) { /* more there is not */
        l->share[c] = l->share[best];
        l->reaches[c] = l->reaches[best];
    }
    return best > GN_ACCURACY_NONE || l->too_large; /* what memory alone forbids is dropped */
}

static void order_by_importance(const gn_selection *s, uint8_t *order)
{
    for (uint32_t i = 0; i < s->light_count; i++) {
        uint32_t k = i;

        for (; k > 0 && s->lights[order[k - 1]].importance < s->lights[i].importance; k--)
            order[k] = order[k - 1];
        order[k] = (uint8_t)i;
    }
}

/* The class of each light; returns the share that is left. */
static double settle(const gn_selection *s, const ladder *ladders, const uint8_t *order, uint8_t *level, int *is_over)
{
    const int floor = (int)s->budget.quality;
    int common = GN_ACCURACY_EXACT;
    double used = 0.0;

    for (; common >= floor; common--) {
        used = 0.0;
        for (uint32_t i = 0; i < s->light_count; i++)
            used += ladders[i].share[common];
        if (used <= 1.0)
            break;
    }
    *is_over = common < floor;
    if (*is_over)
        common = floor;
    for (uint32_t i = 0; i < s->light_count; i++)
        level[i] = (uint8_t)common;
    for (uint32_t k = 0; k < s->light_count && common < GN_ACCURACY_EXACT && !*is_over; k++) {
        const ladder *l = &ladders[order[k]];

        if (used - l->share[common] + l->share[common + 1] > 1.0)
            break;
        used += l->share[common + 1] - l->share[common];
        level[order[k]] = (uint8_t)(common + 1);
    }
    return 1.0 - used;
}

/* ------------------------------------------------------------------ preference */

static double cheapest_of(const gn_selection *s, uint32_t light, int accuracy, double share)
{
    double least = INFINITY;

    for (uint32_t n = 0; n < GNI_WAYS; n++) {
        gni_candidate c;

        if (gni_consider(s, light, n, &c) == GNI_WAY_MAY && (accuracy < 0 || (int)c.accuracy == accuracy) &&
            c.share <= share)
            least = fmin(least, c.cost.ms);
    }
    return least;
}

/* Of a light's ways of one class (-1: of any) that take no more than the share, and as cheap as there are, what suits best; of
 * those that suit alike the cheapest. */
static void prefer(const gn_selection *s, uint32_t light, int accuracy, double share, const gni_suits *suits,
                   gn_choice *out, double *taken)
{
    const double most = accuracy < 0 ? INFINITY : EQUAL * cheapest_of(s, light, accuracy, share);
    int is_taken = 0;

    for (uint32_t n = 0; n < GNI_WAYS; n++) {
        gni_candidate c;
        uint32_t output;
        double suitability;

        if (gni_consider(s, light, n, &c) != GNI_WAY_MAY || c.share > share || c.accuracy < s->budget.quality)
            continue;
        out->affordable++;
        if ((accuracy >= 0 && (int)c.accuracy != accuracy) || c.cost.ms > most)
            continue;
        out->equal++;
        suitability = gni_suitability(suits, &c.way, &output);
        if (is_taken &&
            (suitability < out->suitability || (suitability == out->suitability && c.cost.ms >= out->cost.ms)))
            continue;
        is_taken = 1;
        out->way = c.way;
        out->cost = c.cost;
        out->accuracy = c.accuracy;
        out->suitability = suitability;
        out->rule = s->rules ? gni_strongest_rule(s->rules, suits, output) : UINT32_MAX;
        *taken = c.share;
    }
}

static int is_sound(const gn_light_state *l)
{
    gn_facts facts = l->facts;
    const double others[] = {l->load.indices, l->load.fragments, l->load.borders, l->load.pixels, l->importance};
    int ok = 1;

    for (int f = 0; f < GN_FACT_COUNT; f++)
        ok &= *gn_fact(&facts, f) >= 0.0 && isfinite(*gn_fact(&facts, f));
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++)
        ok &= others[i] >= 0.0 && isfinite(others[i]);
    return ok;
}

static gn_result check(gn_context *context, const gn_selection *s)
{
    if (!s->knowledge || (s->light_count && !s->lights))
        return gn_fail(context, GN_E_ARG, "gn_select: NULL argument");
    if (s->light_count > GN_MOST_SELECTED)
        return gn_fail(context, GN_E_ARG, "gn_select: at most %d lights (%lu)", GN_MOST_SELECTED,
                       (unsigned long)s->light_count);
    if ((unsigned)s->budget.quality >= GN_ACCURACY_COUNT)
        return gn_fail(context, GN_E_ARG, "gn_select: no accuracy has number %d", (int)s->budget.quality);
    if (!(s->budget.frame_ms >= 0.0 && s->budget.energy_mw >= 0.0 && s->budget.memory >= 0.0 && s->host_ms >= 0.0))
        return gn_fail(context, GN_E_ARG, "gn_select: a budget is not negative (%g ms, %g mW, %g bytes, host %g ms)",
                       s->budget.frame_ms, s->budget.energy_mw, s->budget.memory, s->host_ms);
    for (uint32_t i = 0; i < s->light_count; i++)
        if (!is_sound(&s->lights[i]))
            return gn_fail(context, GN_E_ARG, "gn_select: light %lu: a fact, load or importance is no number from 0 on",
                           (unsigned long)i);
    return s->rules ? gni_check_rules(context, s->rules) : GN_OK;
}

void gni_suit_light(const gn_selection *s, uint32_t light, double used_ms, gni_suits *suits)
{
    for (size_t i = 0; i < sizeof suits->outputs / sizeof suits->outputs[0]; i++)
        suits->outputs[i] = NAN; /* until a rule says something: outputs whose DEFAULT is NC stay so */
    suits->facts = s->lights[light].facts;
    suits->facts.headroom =
        s->budget.frame_ms > 0.0 ? fmin(fmax(1.0 - (s->host_ms + used_ms) / s->budget.frame_ms, 0.0), 1.0) : 1.0;
    gni_find_knobs(s->rules, suits);
    if (s->rules)
        gni_evaluate_facts(s->rules, suits);
}

gn_result gn_select(gn_context *context, const gn_selection *s, gn_choice *choices)
{
    ladder ladders[GN_MOST_SELECTED];
    uint8_t order[GN_MOST_SELECTED], level[GN_MOST_SELECTED];
    double left, used_ms = 0.0;
    int is_over;
    gn_result result;

    if (!s || !choices)
        return gn_fail(context, GN_E_ARG, "gn_select: NULL argument");
    result = check(context, s);
    if (result != GN_OK)
        return result;
    for (uint32_t i = 0; i < s->light_count; i++)
        if (!climb(s, i, &ladders[i]))
            return gn_fail(context, GN_E_DEVICE, "gn_select: no way is possible here, known, and within %g bytes",
                           s->budget.memory);
    for (uint32_t i = 0; i < s->light_count; i++)
        if (ladders[i].reaches[s->budget.quality] < (int)s->budget.quality)
            return gn_fail(context, GN_E_DEVICE,
                           "gn_select: light %lu: no way that is possible here is %s: the best is %s", (unsigned long)i,
                           gn_accuracy_name(s->budget.quality),
                           gn_accuracy_name((gn_accuracy)ladders[i].reaches[s->budget.quality]));
    order_by_importance(s, order);
    left = settle(s, ladders, order, level, &is_over);
    for (uint32_t k = 0; k < s->light_count; k++) {
        const uint32_t i = order[k];
        const ladder *l = &ladders[i];
        gn_choice *c = &choices[i];
        const double own = l->share[level[i]], most = is_over ? own : own + fmax(left, 0.0);
        double taken = own;
        gni_suits suits;

        memset(c, 0, sizeof *c);
        c->rule = UINT32_MAX;
        c->feasible = l->feasible;
        c->is_over_budget = is_over;
        c->granted = (gn_accuracy)(level[i] < l->reaches[level[i]] ? level[i] : l->reaches[level[i]]);
        c->accuracy = (gn_accuracy)l->reaches[level[i]];
        c->way.is_dropped = c->accuracy == GN_ACCURACY_NONE;
        if (c->way.is_dropped && !s->prefers)
            continue;
        gni_suit_light(s, i, used_ms, &suits);
        prefer(s, i, s->prefers ? -1 : (int)c->accuracy, most, &suits, c, &taken);
        left -= is_over ? 0.0 : taken - own;
        used_ms += c->cost.ms;
    }
    return GN_OK;
}
