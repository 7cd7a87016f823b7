/* suitability.c - asks the rules how much each knob of a way suits a light; a way suits as much as the least of its knobs. */
#include "gni_select.h"

#include <math.h>
#include <string.h>

/* Outputs of rules by what they speak of: methods in gn_method's order from stencil on, then the rest. */
enum {
    METHODS = GN_METHOD_TOTAL - GN_METHOD_STENCIL,
    FULL = METHODS,
    HALF,
    QUARTER,
    BILINEAR,
    DEPTH,
    LATE,
    PROXIES,
    KNOBS
};

static const char *const rest[] = {"full", "half", "quarter", "bilinear", "depth", "late", "proxies"};

static const char *const fact_names[GN_FACT_COUNT] = {"lights",   "moving", "layers",   "faces", "edges",
                                                      "nearness", "motion", "headroom", "power"};

const char *gn_fact_name(int fact)
{
    return fact >= 0 && fact < GN_FACT_COUNT ? fact_names[fact] : NULL;
}

double *gn_fact(gn_facts *f, int fact)
{
    double *const of[GN_FACT_COUNT] = {&f->lights,   &f->moving, &f->layers,   &f->faces, &f->edges,
                                       &f->nearness, &f->motion, &f->headroom, &f->power};

    return fact >= 0 && fact < GN_FACT_COUNT ? of[fact] : NULL;
}

void gni_find_knobs(const gn_rules *rules, gni_suits *out)
{
    for (int i = 0; i < KNOBS; i++)
        out->knobs[i] =
            rules
                ? gn_rules_find_output(rules, i < METHODS ? gn_method_describe((gn_method)(i + GN_METHOD_STENCIL))->name
                                                          : rest[i - METHODS])
                : UINT32_MAX;
}

gn_result gni_check_rules(gn_context *context, const gn_rules *rules)
{
    const gni_suits *room = NULL;

    for (uint32_t i = 0; i < gn_rules_input_count(rules); i++) {
        int is_fact = 0;

        for (int f = 0; f < GN_FACT_COUNT; f++)
            is_fact |= strcmp(fact_names[f], gn_rules_input(rules, i)) == 0;
        if (!is_fact)
            return gn_fail(context, GN_E_ARG, "rules: no fact has that name (%s)", gn_rules_input(rules, i));
    }
    if (gn_rules_output_count(rules) > sizeof room->outputs / sizeof room->outputs[0] ||
        gn_rules_count(rules) > sizeof room->strengths / sizeof room->strengths[0])
        return gn_fail(context, GN_E_ARG, "rules: more than 64 outputs or 256 rules (%lu, %lu)",
                       (unsigned long)gn_rules_output_count(rules), (unsigned long)gn_rules_count(rules));
    return GN_OK;
}

void gni_evaluate_facts(gn_rules *rules, gni_suits *suits)
{
    double inputs[GN_FACT_COUNT];

    for (uint32_t i = 0; i < gn_rules_input_count(rules); i++)
        for (int k = 0; k < GN_FACT_COUNT; k++)
            if (strcmp(fact_names[k], gn_rules_input(rules, i)) == 0)
                inputs[i] = *gn_fact(&suits->facts, k);
    gn_rules_evaluate(rules, inputs, suits->outputs, suits->strengths);
}

static void least(const gni_suits *s, int knob, double *suits, uint32_t *output)
{
    const uint32_t at = s->knobs[knob];

    if (at == UINT32_MAX || !(s->outputs[at] < *suits))
        return;
    *suits = s->outputs[at];
    *output = at;
}

double gni_suitability(const gni_suits *s, const gn_way *way, uint32_t *output)
{
    double suits = 100.0;

    *output = UINT32_MAX;
    least(s, (int)way->method - GN_METHOD_STENCIL, &suits, output);
    if (way->method != GN_METHOD_REFINE) {
        least(s, way->scale == 1 ? FULL : way->scale == 2 ? HALF : QUARTER, &suits, output);
        if (way->scale > 1)
            least(s, way->upsample == GN_UPSAMPLE_DEPTH ? DEPTH : BILINEAR, &suits, output);
    }
    if (way->update_every > 1)
        least(s, LATE, &suits, output);
    if (way->proxies)
        least(s, PROXIES, &suits, output);
    return suits;
}

uint32_t gni_strongest_rule(const gn_rules *rules, const gni_suits *s, uint32_t output)
{
    uint32_t best = UINT32_MAX;

    for (uint32_t r = 0; r < gn_rules_count(rules) && output != UINT32_MAX; r++)
        if (s->strengths[r] > 0.0f && gn_rules_concludes(rules, r, output) &&
            (best == UINT32_MAX || s->strengths[r] > s->strengths[best]))
            best = r;
    return best;
}
