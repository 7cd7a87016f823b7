/* gn_rules.h - fuzzy rules: read from a text, evaluated as Mamdani did. gnomon.h's conventions hold here.
 *
 * The text is Fuzzy Control Language (IEC 61131-7), of which this is taken: one FUNCTION_BLOCK; VAR_INPUT and VAR_OUTPUT of
 * REAL; FUZZIFY and DEFUZZIFY with RANGE and TERMs of points, TERM x := (0, 1) (2, 0); that are joined by lines and level
 * beyond; METHOD COG, or COGS where terms are single numbers, each weighed by the sum of the rules that say it; DEFAULT a
 * number or NC, which leaves an output as it is; RULEBLOCKs with AND : MIN, OR : MAX, ACT : MIN, ACCU : MAX; rules of IS,
 * NOT, AND, OR, parentheses, WITH a weight; comments (* *), // and #. Keywords in any case, names in theirs. Anything else
 * is refused with its line and column.
 *
 * (Rautenbach 2008, section 5.3: rules, and-by-least, centre of gravity.) */
#ifndef GN_RULES_H
#define GN_RULES_H
#include "gnomon.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct gn_rules gn_rules;

/* Reads the text, which need not stay [length: of it]. Returns GN_OK; GN_E_ARG with the line and column of what is wrong;
 * GN_E_MEMORY. *rules is NULL unless GN_OK. */
gn_result gn_rules_create(gn_context *context, const char *text, size_t length, gn_rules **rules);
/* The library's own, rules/default.fcl, which were read when it was built: a program that calls this alone has no reader in
 * it. Returns GN_OK; GN_E_MEMORY. */
gn_result gn_rules_default(gn_context *context, gn_rules **rules);
void gn_rules_destroy(gn_rules *rules);

/* inputs: [gn_rules_input_count()] finite. outputs: [gn_rules_output_count()]; one that no rule reaches becomes its DEFAULT, or NAN
 * where there is none. strengths: [gn_rules_count()] how much each rule holds, 0 to 1, its weight in it; may be NULL.
 * Allocates nothing. Cost: O(terms + rules), and for outputs by COG the square of terms that overlap. */
void gn_rules_evaluate(gn_rules *rules, const double *inputs, double *outputs, float *strengths);

/* Names are terminated and live as long as the rules; NULL for what is not there. */
uint32_t gn_rules_input_count(const gn_rules *rules);
uint32_t gn_rules_output_count(const gn_rules *rules);
uint32_t gn_rules_count(const gn_rules *rules);
const char *gn_rules_input(const gn_rules *rules, uint32_t input);
const char *gn_rules_output(const gn_rules *rules, uint32_t output);
/* UINT32_MAX when there is none of that name. */
uint32_t gn_rules_find_input(const gn_rules *rules, const char *name);
uint32_t gn_rules_find_output(const gn_rules *rules, const char *name);
/* What an input may be, as its RANGE says or, without one, from its first point to its last. 0 when it is none. */
int gn_rules_range(const gn_rules *rules, uint32_t input, double range[2]);

/* Terms of an input and how much of each a value is, 0 to 1. */
uint32_t gn_rules_term_count(const gn_rules *rules, uint32_t input);
const char *gn_rules_term(const gn_rules *rules, uint32_t input, uint32_t term);
double gn_rules_membership(const gn_rules *rules, uint32_t input, uint32_t term, double value);

/* Whether a rule says something of an output. */
int gn_rules_concludes(const gn_rules *rules, uint32_t rule, uint32_t output);
/* A rule as it is written, with single spaces; like snprintf. */
size_t gn_rules_sentence(const gn_rules *rules, uint32_t rule, char *text, size_t capacity);

#ifdef __cplusplus
}
#endif
#endif
