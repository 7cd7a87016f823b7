/* test_rules.c - the reader of rules and their engine, without an oracle: what is refused, and where; laws of what is said;
 * Rautenbach's worked example (2008, section 5.3). fuzzylite judges the rest: test_fuzzylite.c. */
#include "gn_rules.h"
#include "gn_test.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define HEAD                                                                                                           \
    "FUNCTION_BLOCK f\nVAR_INPUT\n x : REAL;\n y : REAL;\nEND_VAR\nVAR_OUTPUT\n z : REAL;\nEND_VAR\n"                  \
    "FUZZIFY x\n TERM low := (0, 1) (1, 0);\n TERM high := (0, 0) (1, 1);\nEND_FUZZIFY\n"                              \
    "FUZZIFY y\n TERM low := (0, 1) (1, 0);\n TERM high := (0, 0) (1, 1);\nEND_FUZZIFY\n"
#define OUT                                                                                                            \
    "DEFUZZIFY z\n RANGE := (0 .. 8);\n TERM a := (0, 1) (4, 0);\n TERM b := (4, 0) (8, 1);\n METHOD : COG;\n"         \
    " DEFAULT := 3;\nEND_DEFUZZIFY\n"
#define BLOCK(rules) "RULEBLOCK\n" rules "END_RULEBLOCK\nEND_FUNCTION_BLOCK\n"

static gn_rules *read_text(const char *text)
{
    gn_rules *rules;

    if (gn_rules_create(test_context, text, strlen(text), &rules) != GN_OK)
        fail_msg("%s", gn_message(test_context));
    return rules;
}

static void refuses_with_line_and_column(void **state)
{
    static const struct {
        const char *text, *message;
    } cases[] = {
        {"", "line 1, column 1: FUNCTION_BLOCK is missing at the end"},
        {"FUNCTION_BLOCK f\nEND_FUNCTION_BLOCK\nmore", "line 3, column 1:  is missing before 'more'"},
        {HEAD BLOCK(""), "output z has no DEFUZZIFY"},
        {HEAD OUT BLOCK(" RULE 1 : if q is low then z is a;\n"), "line 25, column 14: no input has that name (q)"},
        {HEAD OUT BLOCK(" RULE 1 : if x is some then z is a;\n"),
         "line 25, column 19: x has no term of that name (some)"},
        {HEAD OUT BLOCK(" RULE 1 : if x is low then x is a;\n"), "line 25, column 28: no output has that name (x)"},
        {HEAD OUT BLOCK(" RULE 1 : if x is low then z is a with 2;\n"),
         "column 11: a rule's weight is from 0 to 1 (2)"},
        {HEAD OUT BLOCK(" RULE 1 : if (x is low then z is a;\n"), "column 24: ) is missing before 'then'"},
        {HEAD OUT BLOCK(" RULE 1 : if x is low then z is a\n"),
         "line 26, column 1: ; is missing before 'END_RULEBLOCK'"},
        {HEAD OUT BLOCK(" AND : PROD;\n"), "line 25, column 8: MIN is missing before 'PROD'"},
        {HEAD OUT BLOCK(" RULE 1 : if x is very low then z is a;\n"), "x has no term of that name (very)"},
        {HEAD OUT BLOCK(" (* no end"), "line 25, column 2: a comment has no end"},
        {HEAD OUT OUT BLOCK(""), "line 24, column 11: z has terms already"},
        {HEAD "DEFUZZIFY z\n TERM a := 3;\n METHOD : COG;\nEND_DEFUZZIFY\n" BLOCK(""), "COG takes terms of points"},
        {HEAD "DEFUZZIFY z\n TERM a := (0, 1) (1, 0);\n METHOD : COGS;\nEND_DEFUZZIFY\n" BLOCK(""),
         "COGS takes terms of one number each"},
        {HEAD "DEFUZZIFY z\n METHOD : LM;\nEND_DEFUZZIFY\n" BLOCK(""),
         "line 18, column 11: z: METHOD is COG or COGS here (LM)"},
        {HEAD "DEFUZZIFY z\n RANGE := (3 .. 3);\nEND_DEFUZZIFY\n" BLOCK(""), "the range of z is empty (3 .. 3)"},
        {HEAD "DEFUZZIFY z\n TERM a := (0, 2) (1, 0);\nEND_DEFUZZIFY\n" BLOCK(""), "a membership is from 0 to 1 (2)"},
        {HEAD "DEFUZZIFY z\n TERM a := (0, 1) (-1, 0);\nEND_DEFUZZIFY\n" BLOCK(""), "its points go back from 0 to -1"},
        {HEAD "DEFUZZIFY z\n TERM a := (0, 1);\nEND_DEFUZZIFY\n" BLOCK(""), "term a: one point is none"},
        {HEAD "DEFUZZIFY z\n TERM a := (0, 1e999) (1, 1);\nEND_DEFUZZIFY\n" BLOCK(""),
         "the number is too large (1e999)"},
        {HEAD "DEFUZZIFY z\n TERM a := x;\nEND_DEFUZZIFY\n" BLOCK(""), "line 18, column 12: a number is missing ('x')"},
        {"FUNCTION_BLOCK f\nVAR_INPUT\n x : BOOL;\n", "line 3, column 6: REAL is missing before 'BOOL'"},
        {"FUNCTION_BLOCK f\nVAR_INPUT\n x : REAL;\n x : REAL;\n", "there is a variable of that name already (x)"},
    };

    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        gn_rules *rules = NULL;

        assert_int_equal(gn_rules_create(test_context, cases[i].text, strlen(cases[i].text), &rules), GN_E_ARG);
        assert_null(rules);
        if (!strstr(gn_message(test_context), cases[i].message))
            fail_msg("case %d: '%s' has no '%s'", (int)i, gn_message(test_context), cases[i].message);
    }
}

/* Every text that is cut short, and every one with a byte changed, is read or refused. */
static void survives_any_text(void **state)
{
    static const char text[] =
        HEAD OUT BLOCK(" RULE 1 : if x is not low and (y is high or x is high) then z is a with 0.5;\n");
    char broken[sizeof text];
    uint32_t seed = 3;
    gn_rules *rules;
    int refused = 0;

    (void)state;
    for (size_t length = 0; length < sizeof text - 1; length++) {
        /* all but the last line's end */
        assert_int_equal(gn_rules_create(test_context, text, length, &rules),
                         length < sizeof text - 2 ? GN_E_ARG : GN_OK);
        gn_rules_destroy(rules);
    }
    for (int i = 0; i < 5000; i++) {
        double in[2] = {0.3, 0.6}, out[4] = {0};

        memcpy(broken, text, sizeof text);
        for (int k = 0; k < 1 + i % 3; k++)
            broken[test_random(&seed) % (sizeof text - 1)] = (char)(32 + test_random(&seed) % 95);
        if (gn_rules_create(test_context, broken, sizeof text - 1, &rules) != GN_OK) {
            refused++;
            continue;
        }
        if (gn_rules_input_count(rules) <= 2 && gn_rules_output_count(rules) <= 4)
            gn_rules_evaluate(rules, in, out, NULL);
        gn_rules_destroy(rules);
    }
    assert_in_range(refused, 1000, 4999);
}

static void nests_to_a_limit(void **state)
{
    char text[2048], deep[64] = "", close[64] = "";
    gn_rules *rules;

    (void)state;
    for (int depth = 1; depth <= 17; depth++) {
        double in[2] = {0.25, 0}, out[1];

        deep[depth - 1] = '(';
        close[depth - 1] = ')';
        snprintf(text, sizeof text, "%s RULE 1 : if x is high and %sx is low or x is high%s then z is a;\n%s",
                 HEAD OUT "RULEBLOCK\n", deep, close, "END_RULEBLOCK END_FUNCTION_BLOCK");
        if (depth == 17) {
            assert_int_equal(gn_rules_create(test_context, text, strlen(text), &rules), GN_E_ARG);
            break;
        }
        rules = read_text(text);
        gn_rules_evaluate(rules, in, out, NULL);
        assert_true(out[0] < 2.0);
        gn_rules_destroy(rules);
    }
}

static void says_what_it_is_of(void **state)
{
    gn_rules *rules =
        read_text(HEAD OUT BLOCK(" RULE first : IF x IS low\n   AND (* both *) y IS NOT high THEN z IS a;\n"
                                 " RULE 2 : if y is high then z is b;\n"));
    double range[2];
    char text[64];

    (void)state;
    assert_int_equal(gn_rules_input_count(rules), 2);
    assert_int_equal(gn_rules_output_count(rules), 1);
    assert_int_equal(gn_rules_count(rules), 2);
    assert_string_equal(gn_rules_input(rules, 1), "y");
    assert_null(gn_rules_input(rules, 2));
    assert_int_equal(gn_rules_find_output(rules, "z"), 0);
    assert_int_equal(gn_rules_find_input(rules, "z"), UINT32_MAX);
    assert_true(gn_rules_range(rules, 0, range) && range[0] == 0.0 && range[1] == 1.0); /* from its points */
    assert_int_equal(gn_rules_term_count(rules, 0), 2);
    assert_string_equal(gn_rules_term(rules, 0, 1), "high");
    assert_true(gn_rules_membership(rules, 0, 1, 0.25) == 0.25);
    assert_true(gn_rules_membership(rules, 0, 0, -7.0) == 1.0);
    assert_true(gn_rules_concludes(rules, 1, 0));
    assert_false(gn_rules_concludes(rules, 2, 0));
    assert_int_equal(gn_rules_sentence(rules, 1, text, 10), strlen("if y is high then z is b"));
    assert_string_equal(text, "if y is h");
    gn_rules_sentence(rules, 1, text, sizeof text);
    assert_string_equal(text, "if y is high then z is b");
    gn_rules_destroy(rules);
}

static void keeps_or_takes_its_default(void **state)
{
    static const struct {
        const char *line;
        double then;
    } cases[] = {{" DEFAULT := 3;\n", 3.0}, {" DEFAULT := NC;\n", 7.5}, {"", NAN}};

    (void)state;
    for (int i = 0; i < 3; i++) {
        char text[1024];
        double in[2] = {0, 0}, out[1] = {7.5};
        gn_rules *rules;

        snprintf(text, sizeof text, "%s%s%s%s", HEAD "DEFUZZIFY z\n TERM a := 4;\n METHOD : COGS;\n", cases[i].line,
                 "END_DEFUZZIFY\n", BLOCK(" RULE 1 : if x is high then z is a;\n"));
        rules = read_text(text);
        gn_rules_evaluate(rules, in, out, NULL);
        assert_true(isnan(cases[i].then) ? isnan(out[0]) : out[0] == cases[i].then);
        in[0] = 0.1;
        gn_rules_evaluate(rules, in, out, NULL);
        assert_true(fabs(out[0] - 4.0) < 1e-12);
        gn_rules_destroy(rules);
    }
}

/* A centre does not depend on the order of terms and rules; it moves with the range; it lies within what is enclosed. */
static void obeys_laws(void **state)
{
    static const char form[] =
        HEAD "DEFUZZIFY z\n RANGE := (%g .. %g);\n TERM %s := (%g, 0) (%g, 1) (%g, 0);\n TERM %s := (%g, 0) "
             "(%g, 1) (%g, 0);\n METHOD : COG;\nEND_DEFUZZIFY\nRULEBLOCK\n%s%sEND_RULEBLOCK\nEND_FUNCTION_BLOCK";
    static const char *const rule[2] = {" RULE 1 : if x is high then z is a;\n",
                                        " RULE 2 : if y is high then z is b;\n"};
    uint32_t seed = 11;

    (void)state;
    for (int i = 0; i < 2000; i++) {
        double at[2][3], in[2] = {test_uniform(&seed, 0.01, 1), test_uniform(&seed, 0.01, 1)}, out[3];
        char text[2048];

        for (int t = 0; t < 2; t++) {
            at[t][0] = test_uniform(&seed, 0, 4);
            at[t][1] = test_uniform(&seed, at[t][0], 8);
            at[t][2] = test_uniform(&seed, at[t][1], 10);
        }
        for (int way = 0; way < 3; way++) {
            const double move = way == 2 ? 100.0 : 0.0, grow = way == 2 ? 8.0 : 1.0;
            const int a = way == 1, b = way != 1;
            gn_rules *rules;

            snprintf(text, sizeof text, form, move, move + grow * 10, a ? "b" : "a", move + grow * at[a][0],
                     move + grow * at[a][1], move + grow * at[a][2], b ? "b" : "a", move + grow * at[b][0],
                     move + grow * at[b][1], move + grow * at[b][2], rule[a], rule[b]);
            rules = read_text(text);
            gn_rules_evaluate(rules, in, &out[way], NULL);
            gn_rules_destroy(rules);
        }
        assert_true(fabs(out[1] - out[0]) < 1e-9);
        assert_true(fabs(out[2] - (100.0 + 8.0 * out[0])) < 2e-2); /* six digits are written */
        assert_true(out[0] >= fmin(at[0][0], at[1][0]) && out[0] <= fmax(at[0][2], at[1][2]));
    }
}

/* Sixty lights of a hundred, 28 frames a second, 550 polygons: rule 1 holds by nothing, rule 2 by 0.067, rule 3 by
 * nothing. (He says 0.5 of rule 1, which is the membership of an average number in what asks for few.) */
static void works_rautenbachs_example(void **state)
{
    gn_rules *rules =
        read_text("FUNCTION_BLOCK example\nVAR_INPUT\n lights : REAL; polygons : REAL; rate : REAL;\nEND_VAR\n"
                  "VAR_OUTPUT\n mapping : REAL; volumes : REAL;\nEND_VAR\n"
                  "FUZZIFY lights\n TERM few := (0, 1) (50, 0); TERM average := (30, 0) (50, 1) (70, 0); TERM many := "
                  "(50, 0) (100, 1);\n"
                  "END_FUZZIFY\n"
                  "FUZZIFY polygons\n TERM low := (0, 1) (600, 0); TERM average := (200, 0) (500, 1) (800, 0); TERM "
                  "high := (600, 0) "
                  "(1000, 1);\nEND_FUZZIFY\n"
                  "FUZZIFY rate\n TERM low := (0, 1) (30, 0); TERM average := (20, 0) (40, 1) (60, 0); TERM high := "
                  "(50, 0) (80, 1);\n"
                  "END_FUZZIFY\n"
                  "DEFUZZIFY mapping\n RANGE := (0 .. 100); TERM surely := (0, 0) (100, 1); METHOD : COG; DEFAULT := "
                  "0;\nEND_DEFUZZIFY\n"
                  "DEFUZZIFY volumes\n RANGE := (0 .. 100); TERM surely := (0, 0) (100, 1); METHOD : COG; DEFAULT := "
                  "0;\nEND_DEFUZZIFY\n"
                  "RULEBLOCK his\n"
                  " RULE 1 : IF lights IS few THEN mapping IS surely;\n"
                  " RULE 2 : IF lights IS many AND polygons IS average AND rate IS low THEN volumes IS surely;\n"
                  " RULE 3 : IF lights IS average AND polygons IS high AND rate IS average THEN mapping IS surely;\n"
                  "END_RULEBLOCK\nEND_FUNCTION_BLOCK\n");
    const double in[3] = {60, 550, 28};
    double out[2];
    float strengths[3];

    (void)state;
    gn_rules_evaluate(rules, in, out, strengths);
    assert_true(fabs(gn_rules_membership(rules, 0, 1, 60) - 0.5) < 1e-12);
    assert_true(strengths[0] == 0.0f && strengths[2] == 0.0f);
    assert_true(fabs((double)strengths[1] - 1.0 / 15.0) < 1e-6);
    assert_true(out[0] == 0.0 && out[1] > 50.0);
    gn_rules_destroy(rules);
}

/* No memory at any call: nothing is left, and it says so. Evaluating asks for none. */
static void gives_memory_back(void **state)
{
    test_port counter = {0, 0, 0};
    static const char text[] = HEAD OUT BLOCK(" RULE 1 : if x is low then z is a;\n");
    const gn_port port = test_port_make(&counter);
    gn_context *context;
    gn_rules *rules;
    double in[2] = {0}, out[1];
    size_t calls, live;

    (void)state;
    assert_int_equal(gn_context_create(&port, &context), GN_OK);
    live = counter.live_bytes;
    calls = counter.calls;
    assert_int_equal(gn_rules_create(context, text, strlen(text), &rules), GN_OK);
    calls = counter.calls - calls;
    {
        const size_t before = counter.calls;

        gn_rules_evaluate(rules, in, out, NULL);
        assert_int_equal(counter.calls, before);
    }
    gn_rules_destroy(rules);
    assert_int_equal(counter.live_bytes, live);
    for (size_t i = 1; i <= calls; i++) {
        size_t before = counter.calls;

        counter.fail_at = before + i;
        if (gn_rules_create(context, text, strlen(text), &rules) == GN_OK)
            gn_rules_destroy(rules); /* calls that give back are counted too */
        else
            assert_null(rules);
        counter.fail_at = 0;
        assert_int_equal(counter.live_bytes, live);
    }
    gn_context_destroy(context);
}

/* What the build made tables of is what the reader makes of the file. */
static void has_rules_of_its_own(void **state)
{
    static char text[65536];
    FILE *f = fopen("rules/default.fcl", "rb");
    const size_t length = f ? fread(text, 1, sizeof text, f) : 0;
    gn_rules *own, *read;
    uint32_t seed = 3;

    (void)state;
    assert_non_null(f);
    fclose(f);
    assert_int_equal(gn_rules_create(test_context, text, length, &read), GN_OK);
    assert_int_equal(gn_rules_default(test_context, &own), GN_OK);
    assert_int_equal(gn_rules_count(own), gn_rules_count(read));
    assert_int_equal(gn_rules_input_count(own), gn_rules_input_count(read));
    assert_int_equal(gn_rules_output_count(own), gn_rules_output_count(read));
    for (uint32_t i = 0; i < gn_rules_input_count(own); i++) {
        assert_string_equal(gn_rules_input(own, i), gn_rules_input(read, i));
        assert_int_equal(gn_rules_term_count(own, i), gn_rules_term_count(read, i));
        for (uint32_t t = 0; t < gn_rules_term_count(own, i); t++)
            assert_string_equal(gn_rules_term(own, i, t), gn_rules_term(read, i, t));
    }
    for (uint32_t i = 0; i < gn_rules_output_count(own); i++)
        assert_string_equal(gn_rules_output(own, i), gn_rules_output(read, i));
    for (uint32_t r = 0; r < gn_rules_count(own); r++) {
        char a[512], b[512];

        assert_int_equal(gn_rules_sentence(own, r, a, sizeof a), gn_rules_sentence(read, r, b, sizeof b));
        assert_string_equal(a, b);
        for (uint32_t i = 0; i < gn_rules_output_count(own); i++)
            assert_int_equal(gn_rules_concludes(own, r, i), gn_rules_concludes(read, r, i));
    }
    for (int n = 0; n < 1000; n++) {
        double in[16], a[16], b[16];

        for (uint32_t i = 0; i < gn_rules_input_count(own); i++) {
            double of_own[2], of_read[2];

            gn_rules_range(own, i, of_own);
            gn_rules_range(read, i, of_read);
            assert_memory_equal(of_own, of_read, sizeof of_own);
            in[i] = test_uniform(&seed, of_own[0], of_own[1]);
        }
        gn_rules_evaluate(own, in, a, NULL);
        gn_rules_evaluate(read, in, b, NULL);
        assert_memory_equal(a, b, gn_rules_output_count(own) * sizeof *a);
    }
    gn_rules_destroy(own);
    gn_rules_destroy(read);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(refuses_with_line_and_column),
        cmocka_unit_test(survives_any_text),
        cmocka_unit_test(has_rules_of_its_own),
        cmocka_unit_test(nests_to_a_limit),
        cmocka_unit_test(says_what_it_is_of),
        cmocka_unit_test(keeps_or_takes_its_default),
        cmocka_unit_test(obeys_laws),
        cmocka_unit_test(works_rautenbachs_example),
        cmocka_unit_test(gives_memory_back),
    };

    return cmocka_run_group_tests(tests, test_open_context, test_close_context);
}
