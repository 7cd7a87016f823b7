/* rules.c - reads Fuzzy Control Language (IEC 61131-7) into what fuzzy.c evaluates. gn_rules.h says which part of it.
 *
 * Room is cut before anything is read: no text holds more variables than colons, more terms and points than equals signs and
 * parentheses, more rules than semicolons, more steps of a rule than words. */
#include "gni_rules.h"
#include "scan.h"

#include <math.h>
#include <string.h>

/* What is being read: what the rules have as constants. */
typedef struct reader {
    gni_scan scan;
    gn_rules *r;
    char *text, *names;
    gni_variable *inputs, *outputs;
    gni_term *terms;
    double (*points)[2];
    gni_rule *rules;
    uint16_t *code, *thens;
    double *places;
    size_t name_size;
    int nested; /* parentheses around the place at hand */
} reader;

static int is_ok(const reader *p)
{
    return p->scan.result == GN_OK;
}

/* ------------------------------------------------------------------ names */

static const char *name_of(const reader *p, uint16_t name)
{
    return p->names + name;
}

static uint16_t copy_name(reader *p)
{
    char *name = p->names + p->name_size;
    const uint16_t start = (uint16_t)p->name_size;

    if (p->scan.token.kind != GNI_WORD) {
        gni_scan_fail(&p->scan, p->scan.token.at, "a name is missing ('%.*s')", (int)p->scan.token.length,
                      p->scan.token.at);
        return 0;
    }
    memcpy(name, p->scan.token.at, p->scan.token.length);
    name[p->scan.token.length] = '\0';
    p->name_size += p->scan.token.length + 1;
    gni_scan_next(&p->scan);
    return start;
}

/* Whether the token is exactly that name. */
static int is_name(const reader *p, uint16_t at)
{
    const char *name = name_of(p, at);

    return p->scan.token.kind == GNI_WORD && strlen(name) == p->scan.token.length &&
           memcmp(name, p->scan.token.at, p->scan.token.length) == 0;
}

static gni_variable *find(const reader *p, gni_variable *variables, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        if (is_name(p, variables[i].name))
            return &variables[i];
    return NULL;
}

static gni_variable *expect_variable(reader *p, gni_variable *variables, uint32_t count, const char *kind)
{
    gni_variable *v = find(p, variables, count);

    if (v)
        gni_scan_next(&p->scan);
    else
        gni_scan_fail(&p->scan, p->scan.token.at, "no %s has that name (%.*s)", kind, (int)p->scan.token.length,
                      p->scan.token.at);
    return v;
}

static uint16_t expect_term(reader *p, const gni_variable *v)
{
    for (uint32_t t = v->first_term; t < (uint32_t)v->first_term + v->term_count; t++)
        if (is_name(p, p->terms[t].name)) {
            gni_scan_next(&p->scan);
            return (uint16_t)t;
        }
    gni_scan_fail(&p->scan, p->scan.token.at, "%s has no term of that name (%.*s)", name_of(p, v->name),
                  (int)p->scan.token.length, p->scan.token.at);
    return 0;
}

/* ------------------------------------------------------------------ variables */

static void read_variables(reader *p, gni_variable *variables, uint32_t *count)
{
    while (is_ok(p) && !gni_scan_take(&p->scan, "END_VAR")) {
        gni_variable *v = &variables[*count];

        if (find(p, p->inputs, p->r->input_count) || find(p, p->outputs, p->r->output_count))
            gni_scan_fail(&p->scan, p->scan.token.at, "there is a variable of that name already (%.*s)",
                          (int)p->scan.token.length, p->scan.token.at);
        memset(v, 0, sizeof *v);
        v->name = copy_name(p);
        v->low = INFINITY;
        v->high = -INFINITY;
        v->otherwise = NAN;
        gni_scan_expect(&p->scan, ": REAL ;");
        *count += is_ok(p) ? 1 : 0;
    }
}

static void read_range(reader *p, gni_variable *v)
{
    const char *at = p->scan.token.at;

    gni_scan_expect(&p->scan, ":= (");
    v->low = gni_scan_number(&p->scan);
    gni_scan_expect(&p->scan, "..");
    v->high = gni_scan_number(&p->scan);
    gni_scan_expect(&p->scan, ") ;");
    if (!(v->low < v->high))
        gni_scan_fail(&p->scan, at, "the range of %s is empty (%g .. %g)", name_of(p, v->name), v->low, v->high);
}

static void read_points(reader *p, gni_term *term)
{
    gn_rules *r = p->r;

    while (is_ok(p) && gni_scan_is(&p->scan, "(")) {
        const char *at = p->scan.token.at;
        double *point = p->points[r->point_count];

        gni_scan_next(&p->scan);
        point[0] = gni_scan_number(&p->scan);
        gni_scan_expect(&p->scan, ",");
        point[1] = gni_scan_number(&p->scan);
        gni_scan_expect(&p->scan, ")");
        if (!(point[1] >= 0.0 && point[1] <= 1.0))
            gni_scan_fail(&p->scan, at, "term %s: a membership is from 0 to 1 (%g)", name_of(p, term->name), point[1]);
        if (term->point_count > 0 && point[0] < point[-2])
            gni_scan_fail(&p->scan, at, "term %s: its points go back from %g to %g", name_of(p, term->name), point[-2],
                          point[0]);
        term->point_count++;
        r->point_count++;
    }
    if (term->point_count == 1)
        gni_scan_fail(&p->scan, p->scan.token.at, "term %s: one point is none: a number alone is a singleton",
                      name_of(p, term->name));
}

static void read_term(reader *p, gni_variable *v)
{
    gn_rules *r = p->r;
    gni_term *term = &p->terms[r->term_count];

    for (uint32_t t = v->first_term; t < (uint32_t)v->first_term + v->term_count; t++)
        if (is_name(p, p->terms[t].name))
            gni_scan_fail(&p->scan, p->scan.token.at, "%s has a term of that name already (%s)", name_of(p, v->name),
                          name_of(p, p->terms[t].name));
    if (v->term_count == GNI_MOST_TERMS)
        gni_scan_fail(&p->scan, p->scan.token.at, "%s has more than %d terms", name_of(p, v->name), GNI_MOST_TERMS);
    term->name = copy_name(p);
    term->first_point = (uint16_t)r->point_count;
    term->point_count = 0;
    gni_scan_expect(&p->scan, ":=");
    if (gni_scan_is(&p->scan, "(")) {
        read_points(p, term);
    } else {
        p->points[r->point_count][0] = gni_scan_number(&p->scan);
        p->points[r->point_count++][1] = 1.0;
        term->point_count = 1;
    }
    gni_scan_expect(&p->scan, ";");
    r->term_count++;
    v->term_count++;
}

static void read_method(reader *p, gni_variable *v)
{
    gni_scan_expect(&p->scan, ":");
    v->is_by_singletons = (uint8_t)gni_scan_take(&p->scan, "COGS");
    if (!v->is_by_singletons && !gni_scan_take(&p->scan, "COG"))
        gni_scan_fail(&p->scan, p->scan.token.at, "%s: METHOD is COG or COGS here (%.*s)", name_of(p, v->name),
                      (int)p->scan.token.length, p->scan.token.at);
    gni_scan_expect(&p->scan, ";");
}

static void read_default(reader *p, gni_variable *v)
{
    gni_scan_expect(&p->scan, ":=");
    v->keeps = (uint8_t)gni_scan_take(&p->scan, "NC");
    if (!v->keeps)
        v->otherwise = gni_scan_number(&p->scan);
    gni_scan_expect(&p->scan, ";");
}

/* A range that is not given is from the first point to the last. An output's terms are of the kind of its METHOD. */
static void check_terms(reader *p, gni_variable *v, const char *at, int is_output)
{
    const int is_ranged = v->low <= v->high;

    if (v->term_count == 0)
        gni_scan_fail(&p->scan, at, "%s has no term", name_of(p, v->name));
    for (uint32_t t = v->first_term; t < (uint32_t)v->first_term + v->term_count; t++) {
        const gni_term *term = &p->terms[t];

        if (is_output && (term->point_count == 1) != v->is_by_singletons)
            gni_scan_fail(&p->scan, at, "%s: METHOD %s", name_of(p, v->name),
                          v->is_by_singletons ? "COGS takes terms of one number each" : "COG takes terms of points");
        for (uint32_t i = term->first_point; !is_ranged && i < (uint32_t)term->first_point + term->point_count; i++) {
            v->low = fmin(v->low, p->points[i][0]);
            v->high = fmax(v->high, p->points[i][0]);
        }
    }
}

static void read_block_of_variable(reader *p, int is_output)
{
    gn_rules *r = p->r;
    const char *at = p->scan.token.at, *const end = is_output ? "END_DEFUZZIFY" : "END_FUZZIFY";
    gni_variable *v = is_output ? expect_variable(p, p->outputs, r->output_count, "output")
                                : expect_variable(p, p->inputs, r->input_count, "input");

    if (!v)
        return;
    if (v->term_count)
        gni_scan_fail(&p->scan, at, "%s has terms already", name_of(p, v->name));
    v->first_term = (uint16_t)r->term_count;
    while (is_ok(p) && !gni_scan_take(&p->scan, end)) {
        if (gni_scan_take(&p->scan, "RANGE"))
            read_range(p, v);
        else if (gni_scan_take(&p->scan, "TERM"))
            read_term(p, v);
        else if (is_output && gni_scan_take(&p->scan, "METHOD"))
            read_method(p, v);
        else if (is_output && gni_scan_take(&p->scan, "DEFAULT"))
            read_default(p, v);
        else if (is_output && gni_scan_take(&p->scan, "ACCU"))
            gni_scan_expect(&p->scan, ": MAX ;");
        else
            gni_scan_expect(&p->scan, end);
    }
    if (is_ok(p))
        check_terms(p, v, at, is_output);
}

/* ------------------------------------------------------------------ rules */

static void put_code(reader *p, gni_rule *rule, uint16_t code)
{
    p->code[p->r->code_count++] = code;
    rule->code_count++;
}

static void read_or(reader *p, gni_rule *rule);

/* NOT x, (x OR y), variable IS term, variable IS NOT term */
static void read_proposition(reader *p, gni_rule *rule)
{
    if (!is_ok(p))
        return;
    if (gni_scan_is(&p->scan, "NOT") || gni_scan_is(&p->scan, "(")) {
        const int is_not = gni_scan_is(&p->scan, "NOT");

        if (++p->nested > GNI_MOST_NESTED)
            gni_scan_fail(&p->scan, p->scan.token.at, "more than %d parentheses in each other", GNI_MOST_NESTED);
        gni_scan_next(&p->scan);
        if (is_not) {
            read_proposition(p, rule);
            put_code(p, rule, GNI_RULE_NOT);
        } else {
            read_or(p, rule);
            gni_scan_expect(&p->scan, ")");
        }
        p->nested--;
    } else {
        const gni_variable *v = expect_variable(p, p->inputs, p->r->input_count, "input");
        int is_not;

        gni_scan_expect(&p->scan, "IS");
        is_not = gni_scan_take(&p->scan, "NOT");
        if (!v || !is_ok(p))
            return;
        put_code(p, rule, expect_term(p, v));
        if (is_not)
            put_code(p, rule, GNI_RULE_NOT);
    }
}

static void read_and(reader *p, gni_rule *rule)
{
    read_proposition(p, rule);
    while (gni_scan_take(&p->scan, "AND")) {
        read_proposition(p, rule);
        put_code(p, rule, GNI_RULE_AND);
    }
}

static void read_or(reader *p, gni_rule *rule)
{
    read_and(p, rule);
    while (gni_scan_take(&p->scan, "OR")) {
        read_and(p, rule);
        put_code(p, rule, GNI_RULE_OR);
    }
}

/* What follows from it: output IS term, joined by AND or commas. */
static void read_thens(reader *p, gni_rule *rule)
{
    gn_rules *r = p->r;

    do {
        const gni_variable *v = expect_variable(p, p->outputs, r->output_count, "output");

        gni_scan_expect(&p->scan, "IS");
        if (!v || !is_ok(p))
            return;
        p->thens[r->then_count++] = expect_term(p, v);
        rule->then_count++;
    } while (gni_scan_take(&p->scan, "AND") || gni_scan_take(&p->scan, ","));
}

/* RULE 7 : IF ... THEN ... WITH 0.5; its number or name is anything. */
static void read_rule(reader *p)
{
    gn_rules *r = p->r;
    gni_rule *rule = &p->rules[r->rule_count];
    const char *at;

    memset(rule, 0, sizeof *rule);
    rule->first_code = (uint16_t)r->code_count;
    rule->first_then = (uint16_t)r->then_count;
    rule->weight = 1.0f;
    if (!gni_scan_is(&p->scan, ":"))
        gni_scan_next(&p->scan);
    gni_scan_expect(&p->scan, ":");
    at = p->scan.token.at;
    rule->text = (uint32_t)(at - p->scan.text);
    gni_scan_expect(&p->scan, "IF");
    read_or(p, rule);
    gni_scan_expect(&p->scan, "THEN");
    read_thens(p, rule);
    if (gni_scan_take(&p->scan, "WITH")) {
        const double weight = gni_scan_number(&p->scan);

        rule->weight = (float)weight;
        if (!(weight >= 0.0 && weight <= 1.0))
            gni_scan_fail(&p->scan, at, "a rule's weight is from 0 to 1 (%g)", weight);
    }
    rule->text_length = (uint32_t)(p->scan.token.at - at);
    gni_scan_expect(&p->scan, ";");
    if (r->rule_count == GNI_MOST_OF_RULES)
        gni_scan_fail(&p->scan, at, "more than %d rules", GNI_MOST_OF_RULES);
    r->rule_count++;
}

static void read_block_of_rules(reader *p)
{
    static const char *const starts[] = {"RULE", "AND", "OR", "ACT", "ACCU", "END_RULEBLOCK"};
    int is_named = p->scan.token.kind == GNI_WORD;

    for (size_t i = 0; i < sizeof starts / sizeof starts[0]; i++)
        is_named = is_named && !gni_scan_is(&p->scan, starts[i]);
    if (is_named)
        gni_scan_next(&p->scan);
    while (is_ok(p) && !gni_scan_take(&p->scan, "END_RULEBLOCK")) {
        if (gni_scan_take(&p->scan, "RULE"))
            read_rule(p);
        else if (gni_scan_take(&p->scan, "AND") || gni_scan_take(&p->scan, "ACT"))
            gni_scan_expect(&p->scan, ": MIN ;");
        else if (gni_scan_take(&p->scan, "OR") || gni_scan_take(&p->scan, "ACCU"))
            gni_scan_expect(&p->scan, ": MAX ;");
        else
            gni_scan_expect(&p->scan, "END_RULEBLOCK");
    }
}

static void read_text(reader *p)
{
    gn_rules *r = p->r;

    gni_scan_expect(&p->scan, "FUNCTION_BLOCK");
    if (!gni_scan_is(&p->scan, "VAR_INPUT") && p->scan.token.kind == GNI_WORD)
        gni_scan_next(&p->scan);
    while (is_ok(p) && !gni_scan_take(&p->scan, "END_FUNCTION_BLOCK")) {
        if (gni_scan_take(&p->scan, "VAR_INPUT"))
            read_variables(p, p->inputs, &r->input_count);
        else if (gni_scan_take(&p->scan, "VAR_OUTPUT"))
            read_variables(p, p->outputs, &r->output_count);
        else if (gni_scan_take(&p->scan, "FUZZIFY"))
            read_block_of_variable(p, 0);
        else if (gni_scan_take(&p->scan, "DEFUZZIFY"))
            read_block_of_variable(p, 1);
        else if (gni_scan_take(&p->scan, "RULEBLOCK"))
            read_block_of_rules(p);
        else
            gni_scan_expect(&p->scan, "END_FUNCTION_BLOCK");
    }
    gni_scan_expect(&p->scan, "");
    for (uint32_t i = 0; is_ok(p) && i < r->input_count; i++)
        if (p->inputs[i].term_count == 0)
            gni_scan_fail(&p->scan, p->scan.end, "input %s has no FUZZIFY", name_of(p, p->inputs[i].name));
    for (uint32_t i = 0; is_ok(p) && i < r->output_count; i++)
        if (p->outputs[i].term_count == 0)
            gni_scan_fail(&p->scan, p->scan.end, "output %s has no DEFUZZIFY", name_of(p, p->outputs[i].name));
}

/* ------------------------------------------------------------------ memory */

/* How many of each character there are, and at most how many words. */
typedef struct counts {
    size_t of[128], words, length;
} counts;

static void count(counts *c, const char *text, size_t length)
{
    memset(c, 0, sizeof *c);
    c->words = 1;
    c->length = length;
    for (size_t i = 0; i < length; i++) {
        c->of[(unsigned char)text[i] & 127u]++;
        c->words += strchr(" \t\r\n()", text[i]) != NULL; /* one of these is between any two words of a rule */
    }
}

static void *cut(void *block, size_t *used, size_t number, size_t size)
{
    void *at = block ? (unsigned char *)block + *used : NULL;

    *used += (number * size + 7) / 8 * 8;
    return at;
}

/* The rules, and the arrays behind them, in a block; block NULL: only how much they are. */
static size_t lay_out(reader *p, void *block, const counts *c)
{
    const size_t points = c->of['='] + c->of['('] + 1;
    size_t used = 0;
    double *degrees;

    memset(p, 0, sizeof *p);
    p->r = cut(block, &used, 1, sizeof *p->r);
    p->text = cut(block, &used, c->length + 1, 1);
    p->names = cut(block, &used, c->length + 2, 1);
    p->inputs = cut(block, &used, c->of[':'] + 1, sizeof *p->inputs);
    p->outputs = cut(block, &used, c->of[':'] + 1, sizeof *p->outputs);
    p->terms = cut(block, &used, c->of['='] + 1, sizeof *p->terms);
    p->points = cut(block, &used, points, sizeof *p->points);
    p->rules = cut(block, &used, c->of[';'] + 2, sizeof *p->rules);
    p->code = cut(block, &used, c->words, sizeof *p->code);
    p->thens = cut(block, &used, c->words, sizeof *p->thens);
    p->places = cut(block, &used, points + 2, sizeof *p->places);
    degrees = cut(block, &used, c->of['='] + 1, sizeof *degrees);
    if (block)
        *p->r = (gn_rules){.text = p->text,
                           .names = p->names,
                           .inputs = p->inputs,
                           .outputs = p->outputs,
                           .terms = p->terms,
                           .points = (const double(*)[2])p->points,
                           .rules = p->rules,
                           .code = p->code,
                           .thens = p->thens,
                           .degrees = degrees};
    return used;
}

gn_result gn_rules_create(gn_context *context, const char *text, size_t length, gn_rules **rules)
{
    void *block;
    counts c;
    reader p;

    if (!context || !text || !rules)
        return gn_fail(context, GN_E_ARG, "gn_rules_create: NULL argument");
    *rules = NULL;
    if (length > 65535)
        return gn_fail(context, GN_E_ARG, "rules: a text of at most 65535 bytes (%lu)", (unsigned long)length);
    count(&c, text, length);
    block = gni_alloc(context, lay_out(&p, NULL, &c), 1);
    if (!block)
        return gn_fail(context, GN_E_MEMORY, "rules: no memory for a text of %lu bytes", (unsigned long)length);
    lay_out(&p, block, &c);
    p.r->context = context;
    memcpy(p.text, text, length);
    p.text[length] = '\0';
    gni_scan_start(&p.scan, context, "rules", p.text, length);
    read_text(&p);
    if (is_ok(&p))
        p.scan.result = gni_slice_outputs(p.r, p.outputs, p.places);
    if (is_ok(&p))
        *rules = p.r;
    else
        gn_rules_destroy(p.r);
    return p.scan.result;
}
