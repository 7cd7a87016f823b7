/* rules_about.c - what rules say of themselves: names, terms and sentences, for whoever fills inputs by name and explains. */
#include "gni_rules.h"

#include <string.h>

uint32_t gn_rules_input_count(const gn_rules *rules)
{
    return rules->input_count;
}

uint32_t gn_rules_output_count(const gn_rules *rules)
{
    return rules->output_count;
}

uint32_t gn_rules_count(const gn_rules *rules)
{
    return rules->rule_count;
}

const char *gn_rules_input(const gn_rules *rules, uint32_t input)
{
    return input < rules->input_count ? rules->names + rules->inputs[input].name : NULL;
}

const char *gn_rules_output(const gn_rules *rules, uint32_t output)
{
    return output < rules->output_count ? rules->names + rules->outputs[output].name : NULL;
}

static uint32_t find(const gn_rules *rules, const gni_variable *variables, uint32_t count, const char *name)
{
    for (uint32_t i = 0; i < count; i++)
        if (strcmp(rules->names + variables[i].name, name) == 0)
            return i;
    return UINT32_MAX;
}

uint32_t gn_rules_find_input(const gn_rules *rules, const char *name)
{
    return find(rules, rules->inputs, rules->input_count, name);
}

uint32_t gn_rules_find_output(const gn_rules *rules, const char *name)
{
    return find(rules, rules->outputs, rules->output_count, name);
}

int gn_rules_range(const gn_rules *rules, uint32_t input, double range[2])
{
    if (input >= rules->input_count)
        return 0;
    range[0] = rules->inputs[input].low;
    range[1] = rules->inputs[input].high;
    return 1;
}

uint32_t gn_rules_term_count(const gn_rules *rules, uint32_t input)
{
    return input < rules->input_count ? rules->inputs[input].term_count : 0;
}

const char *gn_rules_term(const gn_rules *rules, uint32_t input, uint32_t term)
{
    return term < gn_rules_term_count(rules, input)
               ? rules->names + rules->terms[rules->inputs[input].first_term + term].name
               : NULL;
}

double gn_rules_membership(const gn_rules *rules, uint32_t input, uint32_t term, double value)
{
    if (term >= gn_rules_term_count(rules, input))
        return 0.0;
    return gni_membership(rules, &rules->terms[rules->inputs[input].first_term + term], value);
}

int gn_rules_concludes(const gn_rules *rules, uint32_t rule, uint32_t output)
{
    const gni_rule *of;

    if (rule >= rules->rule_count || output >= rules->output_count)
        return 0;
    of = &rules->rules[rule];
    for (uint32_t i = of->first_then; i < (uint32_t)of->first_then + of->then_count; i++)
        if (rules->thens[i] >= rules->outputs[output].first_term &&
            rules->thens[i] < rules->outputs[output].first_term + rules->outputs[output].term_count)
            return 1;
    return 0;
}

size_t gn_rules_sentence(const gn_rules *rules, uint32_t rule, char *text, size_t capacity)
{
    size_t length = 0;
    int is_space = 0;

    for (uint32_t i = 0; rule < rules->rule_count && i < rules->rules[rule].text_length; i++) {
        const char c = rules->text[rules->rules[rule].text + i];

        if (strchr(" \t\r\n", c)) {
            is_space = 1;
            continue;
        }
        if (is_space && length++ < capacity)
            text[length - 1] = ' ';
        is_space = 0;
        if (length++ < capacity)
            text[length - 1] = c;
    }
    if (capacity)
        text[length < capacity ? length : capacity - 1] = '\0';
    return length;
}

void gn_rules_destroy(gn_rules *r)
{
    if (!r)
        return;
    gni_free(r->context, r->own);
    gni_free(r->context, r);
}
