/* test_fuzzylite.c - our engine and fuzzylite's say the same of the same files: the library's own rules, Rautenbach's, and
 * each in tests/rules.
 *
 * fuzzylite sums an output's centre over a hundred places. It is told to take 20,000, since ours is exact. */
#include "gn_rules.h"
#include "gn_test.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { SIDE = 21, ROWS = SIDE * SIDE, MOST = 16 };
#define TOLERANCE 1e-4

static char folder[] = "/tmp/gnomon-rules-XXXXXX";
static double inputs[ROWS][MOST];

static gn_rules *read_rules(const char *path)
{
    static char text[65536];
    FILE *f = fopen(path, "rb");
    size_t length;
    gn_rules *rules;

    assert_non_null(f);
    length = fread(text, 1, sizeof text, f);
    fclose(f);
    if (gn_rules_create(test_context, text, length, &rules) != GN_OK)
        fail_msg("%s: %s", path, gn_message(test_context));
    return rules;
}

/* Two inputs on a grid; more of them at random, often at their ends. */
static void choose_inputs(const gn_rules *rules)
{
    const uint32_t count = gn_rules_input_count(rules);
    uint32_t seed = 7;

    assert_in_range(count, 1, MOST);
    for (int row = 0; row < ROWS; row++)
        for (uint32_t i = 0; i < count; i++) {
            double range[2], share = fmin(fmax(test_uniform(&seed, -0.2, 1.2), 0.0), 1.0);

            if (count == 2)
                share = (double)(i ? row / SIDE : row % SIDE) / (SIDE - 1);
            assert_true(gn_rules_range(rules, i, range));
            inputs[row][i] = range[0] + share * (range[1] - range[0]);
        }
}

static FILE *open_in_folder(const char *name, const char *mode)
{
    char path[256];
    FILE *f;

    snprintf(path, sizeof path, "%s/%s", folder, name);
    f = fopen(path, mode);
    assert_non_null(f);
    return f;
}

/* Its outputs for the inputs, a row a line, into out.txt. */
static void ask_fuzzylite(const char *path, uint32_t input_count)
{
    char command[1024];
    FILE *f = open_in_folder("in.txt", "w");

    for (int row = 0; row < ROWS; row++)
        for (uint32_t i = 0; i < input_count; i++)
            fprintf(f, "%.17g%c", inputs[row][i], i + 1 < input_count ? ' ' : '\n');
    fclose(f);
    snprintf(command, sizeof command,
             "fuzzylite -i %s -if fcl -o %s/rules.fll -of fll -decimals 12 && sed -i 's/Centroid 100$/Centroid 20000/' "
             "%s/rules.fll && fuzzylite -i %s/rules.fll -if fll -o %s/out.txt -of fld -d %s/in.txt -dheader false "
             "-dinputs false "
             "-decimals 12",
             path, folder, folder, folder, folder, folder);
    if (system(command) != 0)
        fail_msg("fails: %s", command);
}

static void compare(const char *path)
{
    gn_rules *rules = read_rules(path);
    const uint32_t input_count = gn_rules_input_count(rules), output_count = gn_rules_output_count(rules);
    double low[MOST], high[MOST], worst = 0.0;
    FILE *f;

    choose_inputs(rules);
    ask_fuzzylite(path, input_count);
    f = open_in_folder("out.txt", "r");
    for (uint32_t o = 0; o < output_count; o++) {
        low[o] = INFINITY;
        high[o] = -INFINITY;
    }
    for (int row = 0; row < ROWS; row++) {
        double ours[MOST];

        gn_rules_evaluate(rules, inputs[row], ours, NULL);
        for (uint32_t o = 0; o < output_count; o++) {
            double theirs;

            if (fscanf(f, "%lf", &theirs) != 1)
                fail_msg("%s: fuzzylite has no row %d of output %s", path, row, gn_rules_output(rules, o));
            if (isnan(theirs) != isnan(ours[o]) || fabs(theirs - ours[o]) > TOLERANCE)
                fail_msg("%s: %s is %.9g at row %d (%g, %g ...), by fuzzylite %.9g", path, gn_rules_output(rules, o),
                         ours[o], row, inputs[row][0], inputs[row][input_count > 1], theirs);
            worst = fmax(worst, isnan(theirs) ? 0.0 : fabs(theirs - ours[o]));
            low[o] = fmin(low[o], isnan(theirs) ? low[o] : theirs);
            high[o] = fmax(high[o], isnan(theirs) ? high[o] : theirs);
        }
    }
    fclose(f);
    for (uint32_t o = 0; o < output_count; o++)
        if (!(low[o] < high[o]))
            fail_msg("%s: %s never changes: nothing is compared", path, gn_rules_output(rules, o));
    print_message("%s: at most %.2g apart\n", path, worst);
    gn_rules_destroy(rules);
}

static void is_fuzzylites(void **state)
{
    compare(*state);
}

int main(void)
{
    static const char *const names[] = {"rules/default",          "rules/rautenbach",       "tests/rules/beyond",
                                        "tests/rules/blocks",     "tests/rules/faint",      "tests/rules/fine",
                                        "tests/rules/negations",  "tests/rules/nine",       "tests/rules/outputs",
                                        "tests/rules/overlaps",   "tests/rules/singletons", "tests/rules/steps",
                                        "tests/rules/trapezoids", "tests/rules/triangles",  "tests/rules/weights"};
    enum { COUNT = sizeof names / sizeof names[0] };
    static char paths[COUNT][64];
    struct CMUnitTest tests[COUNT];
    char command[256];
    int failed;

    if (!mkdtemp(folder))
        return 1;
    for (int i = 0; i < COUNT; i++) {
        snprintf(paths[i], sizeof paths[i], "%s.fcl", names[i]);
        tests[i] = (struct CMUnitTest){names[i], is_fuzzylites, NULL, NULL, paths[i]};
    }
    failed = cmocka_run_group_tests(tests, test_open_context, test_close_context);
    snprintf(command, sizeof command, "rm -r %s", folder);
    return system(command) != 0 || failed;
}
