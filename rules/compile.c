/* compile.c - a step of the build, run where the library is built and not where it runs: reads rules with the library's own
 * reader and writes them as constant tables of C, for core/rules_default.c. Names, and points of terms, that are alike
 * are written once.
 *
 *     compile < rules/default.fcl > default.fcl.h */
#include "gni_rules.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void must(int ok, const char *what)
{
    if (ok)
        return;
    fprintf(stderr, "compile: %s\n", what);
    exit(1);
}

/* ------------------------------------------------------------------ names */

typedef struct names {
    char text[8192];
    size_t size;
} names;

static size_t place_of(names *n, const char *name)
{
    for (size_t at = 0; at < n->size; at += strlen(n->text + at) + 1)
        if (strcmp(n->text + at, name) == 0)
            return at;
    must(n->size + strlen(name) < sizeof n->text, "too many names");
    strcpy(n->text + n->size, name);
    n->size += strlen(name) + 1;
    return n->size - strlen(name) - 1;
}

static void print_names(const names *n)
{
    printf("static const char own_names[] =");
    for (size_t at = 0; at < n->size; at += strlen(n->text + at) + 1)
        printf("\n    \"%s\\0\"", n->text + at);
    printf(";\n");
}

/* ------------------------------------------------------------------ tables */

static void print_number(double x)
{
    if (isnan(x))
        printf("NAN");
    else
        printf("%.17g", x);
}

static void print_variables(const gn_rules *r, const char *name, const gni_variable *v, uint32_t count, names *n)
{
    printf("static const gni_variable %s[] = {\n", name);
    for (uint32_t i = 0; i < count; i++) {
        printf("    {");
        print_number(v[i].low);
        printf(", ");
        print_number(v[i].high);
        printf(", ");
        print_number(v[i].otherwise);
        printf(", %lu, %u, %u, %u, %u, %u, %u},\n", (unsigned long)place_of(n, r->names + v[i].name), v[i].first_term,
               v[i].term_count, v[i].first_slice, v[i].slice_count, v[i].keeps, v[i].is_by_singletons);
    }
    printf("};\n");
}

static uint32_t print_points(const gn_rules *r, uint16_t *first)
{
    uint32_t count = 0;

    printf("static const double own_points[][2] = {\n");
    for (uint32_t t = 0; t < r->term_count; t++) {
        const gni_term *term = &r->terms[t];
        uint32_t like = 0;

        while (like < t && (r->terms[like].point_count != term->point_count ||
                            memcmp(r->points[r->terms[like].first_point], r->points[term->first_point],
                                   term->point_count * sizeof r->points[0]) != 0))
            like++;
        first[t] = like < t ? first[like] : (uint16_t)count;
        for (uint32_t p = 0; like == t && p < term->point_count; p++, count++) {
            printf("    {");
            print_number(r->points[term->first_point + p][0]);
            printf(", ");
            print_number(r->points[term->first_point + p][1]);
            printf("},\n");
        }
    }
    printf("};\n");
    return count;
}

static void print_terms(const gn_rules *r, const uint16_t *first, names *n)
{
    printf("static const gni_term own_terms[] = {\n");
    for (uint32_t t = 0; t < r->term_count; t++)
        printf("    {%lu, %u, %u},\n", (unsigned long)place_of(n, r->names + r->terms[t].name), first[t],
               r->terms[t].point_count);
    printf("};\n");
}

static void print_rules(const gn_rules *r)
{
    size_t at = 0;

    printf("static const gni_rule own_rules[] = {\n");
    for (uint32_t i = 0; i < r->rule_count; i++) {
        const gni_rule *rule = &r->rules[i];
        const size_t length = gn_rules_sentence(r, i, NULL, 0);

        printf("    {(float)%.9g, %u, %u, %u, %u, %lu, %lu},\n", (double)rule->weight, rule->first_code,
               rule->code_count, rule->first_then, rule->then_count, (unsigned long)at, (unsigned long)length);
        at += length;
    }
    printf("};\n");
}

/* As characters: strings of C99 end at 4,095. */
static void print_sentences(const gn_rules *r)
{
    char text[4096];

    printf("static const char own_text[] = {");
    for (uint32_t i = 0; i < r->rule_count; i++) {
        must(gn_rules_sentence(r, i, text, sizeof text) < sizeof text, "a rule is too long");
        printf("\n    ");
        for (const char *c = text; *c; c++)
            printf("%d,", *c);
    }
    printf("\n    0};\n");
}

static void print_words(const char *name, const uint16_t *words, uint32_t count)
{
    printf("static const uint16_t %s[] = {", name);
    for (uint32_t i = 0; i < count; i++)
        printf("%s%u,", i % 16 ? " " : "\n    ", words[i]);
    printf("\n};\n");
}

int main(void)
{
    static char text[65536];
    static names n;
    static uint16_t first[65536];
    const size_t length = fread(text, 1, sizeof text, stdin);
    gn_context *context = NULL;
    gn_rules *r = NULL;
    uint32_t points;

    must(gn_context_create(NULL, &context) == GN_OK, "no memory");
    must(gn_rules_create(context, text, length, &r) == GN_OK, gn_message(context));
    must(r->slice_count == 0, "outputs are by COGS here: no table of slices is written");
    printf("/* Made by rules/compile.c. */\n#include <math.h>\n\n");
    print_variables(r, "own_inputs", r->inputs, r->input_count, &n);
    print_variables(r, "own_outputs", r->outputs, r->output_count, &n);
    points = print_points(r, first);
    print_terms(r, first, &n);
    print_rules(r);
    print_words("own_code", r->code, r->code_count);
    print_words("own_thens", r->thens, r->then_count);
    print_sentences(r);
    print_names(&n);
    printf("static const gn_rules gni_default_rules = {\n    .text = own_text,\n    .names = own_names,\n    .inputs = "
           "own_inputs,\n"
           "    .outputs = own_outputs,\n    .terms = own_terms,\n    .points = own_points,\n    .rules = own_rules,\n "
           "   .code = own_code,\n"
           "    .thens = own_thens,\n    .input_count = %lu,\n    .output_count = %lu,\n    .term_count = %lu,\n"
           "    .point_count = %lu,\n    .rule_count = %lu,\n    .code_count = %lu,\n    .then_count = %lu};\n",
           (unsigned long)r->input_count, (unsigned long)r->output_count, (unsigned long)r->term_count,
           (unsigned long)points, (unsigned long)r->rule_count, (unsigned long)r->code_count,
           (unsigned long)r->then_count);
    gn_rules_destroy(r);
    gn_context_destroy(context);
    return fflush(stdout) != 0 || ferror(stdout);
}
