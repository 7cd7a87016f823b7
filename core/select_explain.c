/* select_explain.c - says of a choice what was chosen and why: a sentence, or all that led to it (Rautenbach 2008, section 6.2: the
 * explanation system). */
#include "gni_select.h"

#include <math.h>

size_t gn_way_name(const gn_way *way, char *text, size_t capacity)
{
    gni_text t;

    gni_start_text(&t, text, capacity);
    if (way->is_dropped) {
        gni_put(&t, "none");
        return t.length;
    }
    gni_put(&t, "%s", gn_method_describe(way->method) ? gn_method_describe(way->method)->name : "?");
    if (way->scale > 1)
        gni_put(&t, "@1/%lu%s", (unsigned long)way->scale,
                way->method == GN_METHOD_REFINE         ? ""
                : way->upsample == GN_UPSAMPLE_DEPTH    ? "-depth"
                : way->upsample == GN_UPSAMPLE_BILINEAR ? "-bilinear"
                                                        : "-nearest");
    if (way->update_every > 1)
        gni_put(&t, ", masks for %lu frames", (unsigned long)way->update_every);
    if (way->proxies)
        gni_put(&t, ", proxies");
    return t.length;
}

static void put_way(gni_text *t, const gn_way *way)
{
    char name[80];

    gn_way_name(way, name, sizeof name);
    gni_put(t, "%s", name);
}

static void put_rule(gni_text *t, const gn_selection *s, uint32_t rule)
{
    char sentence[200];

    gn_rules_sentence(s->rules, rule, sentence, sizeof sentence);
    gni_put(t, "%s", sentence);
}

static void put_budget(gni_text *t, const gn_selection *s)
{
    const gn_budget *b = &s->budget;
    const char *separator = " of ";

    if (b->frame_ms > 0.0) {
        gni_put(t, "%s%.3g ms a frame, %.3g of them the host's", separator, b->frame_ms, s->host_ms);
        separator = " and ";
    }
    if (b->energy_mw > 0.0) {
        gni_put(t, "%s%.3g mW", separator, b->energy_mw);
        separator = " and ";
    }
    if (b->memory > 0.0)
        gni_put(t, "%s%.0f bytes", separator, b->memory);
}

static void put_sentence(gni_text *t, const gn_selection *s, const gn_choice *c, const gni_suits *suits)
{
    put_way(t, &c->way);
    if (c->way.is_dropped) {
        gni_put(t, ": no shadow, since no way of the %u that are possible is left in the budget%s",
                (unsigned)c->feasible, s->budget.frame_ms > 0.0 || s->budget.energy_mw > 0.0 ? "," : "");
        put_budget(t, s);
        return;
    }
    gni_put(t, ": %s, %.3g ms and %.3g mJ predicted", gn_accuracy_name(c->accuracy), c->cost.ms, c->cost.mj);
    put_budget(t, s);
    if (c->is_over_budget)
        gni_put(t, "; over budget: the cheapest that is %s at least", gn_accuracy_name(s->budget.quality));
    gni_put(t, "; of %u ways that are possible %u are affordable, %u of them as accurate and as cheap",
            (unsigned)c->feasible, (unsigned)c->affordable, (unsigned)c->equal);
    if (s->rules && c->rule != UINT32_MAX) {
        gni_put(t, "; suits by %.0f of 100: ", c->suitability);
        put_rule(t, s, c->rule);
        gni_put(t, " (%.2f)", (double)suits->strengths[c->rule]);
    } else if (s->rules) {
        gni_put(t, "; no rule speaks of it");
    }
}

static void put_facts(gni_text *t, const gn_selection *s, uint32_t light, gni_suits *suits)
{
    gni_put(t, "\nfacts:");
    for (int f = 0; f < GN_FACT_COUNT; f++) {
        const uint32_t input = s->rules ? gn_rules_find_input(s->rules, gn_fact_name(f)) : UINT32_MAX;

        gni_put(t, "\n  %s %.4g", gn_fact_name(f), *gn_fact(&suits->facts, f));
        for (uint32_t term = 0; s->rules && term < gn_rules_term_count(s->rules, input); term++)
            gni_put(t, "%s%s %.2f", term ? ", " : ": ", gn_rules_term(s->rules, input, term),
                    gn_rules_membership(s->rules, input, term, *gn_fact(&suits->facts, f)));
    }
    gni_put(t, "\nload: %.0f indices, %.0f fragments, %.0f of borders, %.0f pixels", s->lights[light].load.indices,
            s->lights[light].load.fragments, s->lights[light].load.borders, s->lights[light].load.pixels);
}

static void put_rules(gni_text *t, const gn_selection *s, const gni_suits *suits)
{
    gni_put(t, "\nrules that hold:");
    for (uint32_t r = 0; s->rules && r < gn_rules_count(s->rules); r++)
        if (suits->strengths[r] > 0.0f) {
            gni_put(t, "\n  %.2f ", (double)suits->strengths[r]);
            put_rule(t, s, r);
        }
}

/* Each way, and why it is not the one. */
static void put_candidates(gni_text *t, const gn_selection *s, uint32_t light, const gn_choice *c,
                           const gni_suits *suits)
{
    gni_put(t, "\nways:");
    for (uint32_t n = 0; n < GNI_WAYS; n++) {
        gni_candidate candidate;
        uint32_t output;
        const gni_refusal refusal = gni_consider(s, light, n, &candidate);

        if (refusal == GNI_WAY_UNKNOWN || refusal == GNI_WAY_UNWANTED ||
            (refusal == GNI_WAY_IMPOSSIBLE && candidate.way.update_every > 1) ||
            (refusal == GNI_WAY_IMPOSSIBLE && candidate.way.proxies))
            continue;
        gni_put(t, "\n  ");
        put_way(t, &candidate.way);
        if (refusal == GNI_WAY_IMPOSSIBLE) {
            gni_put(t, ": not possible here");
            continue;
        }
        gni_put(t, ": %s, %.3g ms, %.3g mJ, suits by %.0f: ", gn_accuracy_name(candidate.accuracy), candidate.cost.ms,
                candidate.cost.mj, gni_suitability(suits, &candidate.way, &output));
        if (refusal == GNI_WAY_TOO_LARGE)
            gni_put(t, "needs %.0f bytes", candidate.cost.memory);
        else if (candidate.way.method == c->way.method && candidate.way.scale == c->way.scale &&
                 candidate.way.upsample == c->way.upsample && candidate.way.update_every == c->way.update_every &&
                 candidate.way.proxies == c->way.proxies && !c->way.is_dropped)
            gni_put(t, "taken");
        else if (candidate.accuracy > c->accuracy)
            gni_put(t, "over budget, or not next in turn");
        else if (candidate.accuracy < c->accuracy && !s->prefers)
            gni_put(t, "less accurate");
        else if (candidate.cost.ms > c->cost.ms)
            gni_put(t, "dearer, or suits less");
        else
            gni_put(t, "suits less");
    }
}

size_t gn_explain_choice(const gn_selection *s, const gn_choice *choices, uint32_t light, int derivation, char *text,
                         size_t capacity)
{
    double used_ms = 0.0;
    gni_suits suits;
    gni_text t;

    gni_start_text(&t, text, capacity);
    if (!s || !choices || light >= s->light_count)
        return 0;
    for (uint32_t i = 0; i < s->light_count; i++) /* as gn_select() serves them */
        if (s->lights[i].importance > s->lights[light].importance ||
            (s->lights[i].importance == s->lights[light].importance && i < light))
            used_ms += choices[i].cost.ms;
    gni_suit_light(s, light, used_ms, &suits);
    put_sentence(&t, s, &choices[light], &suits);
    if (derivation) {
        put_facts(&t, s, light, &suits);
        put_rules(&t, s, &suits);
        put_candidates(&t, s, light, &choices[light], &suits);
    }
    return t.length;
}
