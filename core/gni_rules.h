/* gni_rules.h - rules as they are kept: what the reader (rules.c) makes, at run time of a host's text and at build time of
 * rules/default.fcl, and the engine (fuzzy.c) evaluates. */
#ifndef GNI_RULES_H
#define GNI_RULES_H
#include "gn_rules.h"
#include "gni.h"

enum {
    GNI_MOST_TERMS = 9,   /* of one variable: of an output by COG all may overlap */
    GNI_MOST_NESTED = 16, /* parentheses, and so the depth of the stack */
    GNI_MOST_OF_RULES = 4096
};

/* Points of a term are [first_point, first_point + point_count): x never falls. A singleton has one. */
typedef struct gni_term {
    uint16_t name; /* of a term or variable: where it starts in the names */
    uint16_t first_point, point_count;
} gni_term;

typedef struct gni_variable {
    double low, high; /* RANGE; INFINITY, -INFINITY until it is known */
    double otherwise; /* DEFAULT */
    uint16_t name, first_term, term_count;
    uint16_t first_slice, slice_count; /* of an output by COG */
    uint8_t keeps;                     /* DEFAULT is NC */
    uint8_t is_by_singletons;          /* COGS */
} gni_variable;

/* An antecedent is a program for a stack: a term's number pushes its membership. */
enum { GNI_RULE_NOT = 0xfff0, GNI_RULE_AND, GNI_RULE_OR };

typedef struct gni_rule {
    float weight;
    uint16_t first_code, code_count;
    uint16_t first_then, then_count; /* of thens: terms of outputs */
    uint32_t text, text_length;      /* of it, from IF to before the semicolon */
} gni_rule;

/* Between two places of an output's range where no term has a point: each term is a line there, whose ends are in
 * slice_ends[2 * (first_end + term)]. */
typedef struct gni_slice {
    double from, to;
    uint32_t first_end;
} gni_slice;

/* What is constant of them lies in the library, or with them in their block of memory. */
struct gn_rules {
    gn_context *context;
    void *own; /* slices that were asked for */
    const char *text, *names;
    const gni_variable *inputs, *outputs;
    const gni_term *terms;
    const double (*points)[2];
    const gni_rule *rules;
    const uint16_t *code, *thens;
    const gni_slice *slices;
    const double *slice_ends;
    double *degrees; /* [term_count] memberships of inputs' terms, activations of outputs' */
    uint32_t input_count, output_count, term_count, point_count, rule_count, code_count, then_count, slice_count;
};

/* fuzzy.c: how much of a term a value is. */
double gni_membership(const gn_rules *r, const gni_term *term, double x);
/* slices.c: of the outputs by COG, which are the rules' own; places: [points of one output + 2] to work with. */
gn_result gni_slice_outputs(gn_rules *rules, gni_variable *outputs, double *places);
#endif
