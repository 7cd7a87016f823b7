/* test_select.c - laws of the choice, over 100,000 random lights, budgets and boards: nothing impossible is chosen, a budget that
 * can be kept is kept, more of it never lowers an accuracy, the same is answered the same, and every reason is a rule that held.
 * And what is written: knowledge, names, sentences. */
#include "gn_select.h"
#include "gn_test.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TRIALS = 100000, LIGHTS = 3 };

typedef struct world {
    gn_knowledge knowledge;
    gn_light_state lights[LIGHTS];
    gn_selection selection;
} world;

static gn_rules *rules;
static uint32_t seed = 5;

static double power_of_ten(double low, double high)
{
    return pow(10.0, test_uniform(&seed, low, high));
}

/* A board on which some ways are possible, all as dear as chance has it, and lights of any kind. */
static void make_world(world *w)
{
    gn_knowledge_default(&w->knowledge);
    memset(&w->selection, 0, sizeof w->selection);
    for (int m = 0; m < GN_METHOD_TOTAL; m++) {
        w->selection.possible.variants[m] = (uint8_t)test_random(&seed);
        w->selection.possible.keeps[m] = (uint8_t)test_random(&seed);
        for (int v = 0; v < GN_VARIANT_COUNT; v++) {
            struct gn_known_way *k = &w->knowledge.ways[m][v];

            for (int c = 0; c < GN_COST_COUNT; c++) {
                k->us[c] *= power_of_ten(-0.5, 0.5);
                k->bytes[c] *= power_of_ten(-0.5, 0.5);
            }
            if (test_random(&seed) % 4 == 0)
                k->accuracy = (gn_accuracy)(1 + test_random(&seed) % (GN_ACCURACY_COUNT - 1));
        }
    }
    w->selection.possible.variants[GN_METHOD_COUNT] |= 1u << GN_VARIANT_FULL; /* there is always something */
    for (int i = 0; i < LIGHTS; i++) {
        gn_light_state *l = &w->lights[i];

        memset(l, 0, sizeof *l);
        for (int f = 0; f < GN_FACT_COUNT; f++)
            *gn_fact(&l->facts, f) = test_random(&seed) % 4 ? test_uniform(&seed, 0, 1) : power_of_ten(-1, 4);
        l->facts.motion = test_random(&seed) % 2 ? 0.0 : test_uniform(&seed, 0, 1);
        l->facts.moving = test_random(&seed) % 2;
        l->load.indices = power_of_ten(1, 5);
        l->load.fragments = power_of_ten(2, 7);
        l->load.borders = power_of_ten(2, 6);
        l->load.pixels = power_of_ten(2, 6);
        l->importance = test_random(&seed) % 3;
    }
    w->selection.knowledge = &w->knowledge;
    w->selection.rules = rules;
    w->selection.target_pixels = 640.0 * 480.0;
    w->selection.has_proxies = (int)(test_random(&seed) % 2);
    w->selection.updates = 1 << test_random(&seed) % 3;
    w->selection.lights = w->lights;
    w->selection.light_count = 1 + test_random(&seed) % LIGHTS;
    w->selection.host_ms = test_random(&seed) % 2 ? test_uniform(&seed, 0, 10) : 0.0;
    if (test_random(&seed) % 4)
        w->selection.budget.frame_ms = power_of_ten(-0.5, 2.5);
    if (test_random(&seed) % 3 == 0)
        w->selection.budget.energy_mw = power_of_ten(-1, 3);
    if (test_random(&seed) % 3 == 0)
        w->selection.budget.memory = power_of_ten(6.7, 7.5);
}

static void check_choice(const world *w, const gn_choice *c)
{
    const gn_way *way = &c->way;

    assert_true(c->granted <= c->accuracy || way->is_dropped);
    if (way->is_dropped) {
        assert_int_equal(c->accuracy, GN_ACCURACY_NONE);
        return;
    }
    assert_true(w->knowledge.ways[way->method][gn_way_variant(way)].is_known);
    assert_true(w->selection.possible.variants[way->method] >> gn_way_variant(way) & 1);
    assert_true(way->update_every == 1 || w->selection.possible.keeps[way->method] >> gn_way_variant(way) & 1);
    assert_true(way->update_every <= (uint32_t)w->selection.updates);
    assert_true(!way->proxies || w->selection.has_proxies);
    assert_true(c->accuracy <= w->knowledge.ways[way->method][gn_way_variant(way)].accuracy);
    assert_true(w->selection.budget.memory == 0.0 || c->cost.memory <= w->selection.budget.memory);
    assert_in_range(c->equal, 1, c->affordable);
    assert_in_range(c->affordable, 1, c->feasible);
}

/* What is chosen is possible, and together within the budget; or the least that was asked for, and says that it is over. */
static void keeps_to_what_is_possible_and_affordable(void **state)
{
    int dropped = 0, over = 0, bounded = 0;

    (void)state;
    for (int t = 0; t < TRIALS; t++) {
        gn_choice choices[LIGHTS];
        double ms = 0.0, mj = 0.0, most_mj;
        world w;

        make_world(&w);
        if (test_random(&seed) % 4 == 0)
            w.selection.budget.quality = GN_ACCURACY_ROUGH;
        if (gn_select(test_context, &w.selection, choices) != GN_OK)
            continue; /* no memory for what alone is possible, or nothing of that quality */
        for (uint32_t i = 0; i < w.selection.light_count; i++) {
            check_choice(&w, &choices[i]);
            ms += choices[i].cost.ms;
            mj += choices[i].cost.mj;
            dropped += choices[i].way.is_dropped;
            if (w.selection.budget.quality)
                assert_true(choices[i].accuracy >= w.selection.budget.quality);
        }
        over += choices[0].is_over_budget;
        if (choices[0].is_over_budget) {
            assert_true(w.selection.budget.quality > GN_ACCURACY_NONE);
            continue;
        }
        bounded += w.selection.budget.frame_ms > 0.0;
        if (w.selection.budget.frame_ms > 0.0)
            assert_true(ms == 0.0 || ms <= (w.selection.budget.frame_ms - w.selection.host_ms) * (1.0 + 1e-9));
        most_mj = w.selection.budget.energy_mw / 60.0;
        if (w.selection.budget.energy_mw > 0.0)
            assert_true(mj <= most_mj * (1.0 + 1e-9));
    }
    assert_true(dropped > TRIALS / 20 && over > TRIALS / 200 && bounded > TRIALS / 4);
}

static void grow(gn_budget *budget, int which)
{
    double *const of[3] = {&budget->frame_ms, &budget->energy_mw, &budget->memory};

    if (*of[which] > 0.0)
        *of[which] = test_random(&seed) % 5 ? *of[which] * power_of_ten(0, 0.7) : 0.0; /* 0: any */
}

/* Of one light its accuracy, of several what the budget grants each; by time alone the accuracy of each. */
static void more_of_a_budget_lowers_no_accuracy(void **state)
{
    int risen = 0;

    (void)state;
    for (int t = 0; t < TRIALS; t++) {
        gn_choice before[LIGHTS], after[LIGHTS];
        int by_time;
        world w;

        make_world(&w);
        if (gn_select(test_context, &w.selection, before) != GN_OK)
            continue;
        by_time = w.selection.budget.energy_mw == 0.0;
        for (int which = 0; which < 3; which++)
            if (which == 0 || test_random(&seed) % 2) {
                by_time &= which == 0 || w.selection.budget.energy_mw + w.selection.budget.memory == 0.0;
                grow(&w.selection.budget, which);
            }
        assert_int_equal(gn_select(test_context, &w.selection, after), GN_OK);
        for (uint32_t i = 0; i < w.selection.light_count; i++) {
            assert_true(after[i].granted >= before[i].granted);
            if (w.selection.light_count == 1 || by_time)
                assert_true(after[i].accuracy >= before[i].accuracy);
            risen += after[i].accuracy > before[i].accuracy;
        }
    }
    assert_true(risen > TRIALS / 20);
}

/* The same selection twice, and with its lights in another order. */
static void answers_the_same(void **state)
{
    (void)state;
    for (int t = 0; t < TRIALS / 5; t++) {
        gn_choice first[LIGHTS], second[LIGHTS];
        gn_light_state swapped[LIGHTS];
        world w;

        make_world(&w);
        for (int i = 0; i < LIGHTS; i++)
            w.lights[i].importance += 0.1 * i; /* no two alike */
        if (gn_select(test_context, &w.selection, first) != GN_OK)
            continue;
        memset(second, 0x55, sizeof second);
        assert_int_equal(gn_select(test_context, &w.selection, second), GN_OK);
        for (uint32_t i = 0; i < w.selection.light_count; i++) {
            assert_memory_equal(&first[i].way, &second[i].way, sizeof first[i].way);
            assert_true(first[i].cost.ms == second[i].cost.ms && first[i].suitability == second[i].suitability);
            swapped[w.selection.light_count - 1 - i] = w.lights[i];
        }
        w.selection.lights = swapped;
        assert_int_equal(gn_select(test_context, &w.selection, second), GN_OK);
        for (uint32_t i = 0; i < w.selection.light_count; i++)
            assert_memory_equal(&first[i].way, &second[w.selection.light_count - 1 - i].way, sizeof first[i].way);
    }
}

/* The rule that a choice names holds, by the facts it was made of; its sentence stands in the explanation. */
static void is_explained_by_rules_that_hold(void **state)
{
    static char text[32768];
    int named = 0;

    (void)state;
    for (int t = 0; t < TRIALS / 10; t++) {
        gn_choice choices[LIGHTS];
        char sentence[200], name[80], strength[16];
        double inputs[GN_FACT_COUNT], outputs[32];
        float strengths[64];
        world w;

        make_world(&w);
        w.selection.light_count = 1;
        if (gn_select(test_context, &w.selection, choices) != GN_OK)
            continue;
        gn_explain_choice(&w.selection, choices, 0, 1, text, sizeof text);
        assert_true(strlen(text) < sizeof text - 1);
        gn_way_name(&choices[0].way, name, sizeof name);
        assert_int_equal(strncmp(text, name, strlen(name)), 0);
        if (choices[0].rule == UINT32_MAX)
            continue;
        named++;
        for (uint32_t i = 0; i < gn_rules_input_count(rules); i++)
            for (int f = 0; f < GN_FACT_COUNT; f++)
                if (strcmp(gn_fact_name(f), gn_rules_input(rules, i)) == 0)
                    inputs[i] = *gn_fact(&w.lights[0].facts, f);
        inputs[gn_rules_find_input(rules, "headroom")] =
            w.selection.budget.frame_ms > 0.0
                ? fmin(fmax(1.0 - w.selection.host_ms / w.selection.budget.frame_ms, 0.0), 1.0)
                : 1.0;
        gn_rules_evaluate(rules, inputs, outputs, strengths);
        assert_true(strengths[choices[0].rule] > 0.0f);
        gn_rules_sentence(rules, choices[0].rule, sentence, sizeof sentence);
        snprintf(strength, sizeof strength, "(%.2f)", (double)strengths[choices[0].rule]);
        if (!strstr(text, sentence) || !strstr(text, strength))
            fail_msg("'%s' names neither '%s' nor %s", text, sentence, strength);
    }
    assert_true(named > TRIALS / 30);
}

static void all_zero_is_exact_whatever_it_costs(void **state)
{
    gn_choice choices[LIGHTS];
    world w;

    (void)state;
    for (int t = 0; t < 1000; t++) {
        make_world(&w);
        memset(&w.selection.budget, 0, sizeof w.selection.budget);
        gn_knowledge_default(&w.knowledge);
        for (int c = 0; c < GN_COST_COUNT; c++)
            w.knowledge.ways[GN_METHOD_COUNT][GN_VARIANT_FULL].us[c] *= 1e6;
        assert_int_equal(gn_select(test_context, &w.selection, choices), GN_OK);
        for (uint32_t i = 0; i < w.selection.light_count; i++)
            assert_int_equal(choices[i].accuracy, GN_ACCURACY_EXACT);
    }
}

static void what_cannot_be_says_so(void **state)
{
    gn_choice choices[LIGHTS];
    world w;

    (void)state;
    make_world(&w);
    memset(&w.selection.possible, 0, sizeof w.selection.possible);
    assert_int_equal(gn_select(test_context, &w.selection, choices), GN_E_DEVICE);
    assert_non_null(strstr(gn_message(test_context), "no way is possible here"));
    w.selection.possible.variants[GN_METHOD_ALPHA] = 1;
    gn_knowledge_default(&w.knowledge);
    memset(&w.selection.budget, 0, sizeof w.selection.budget);
    w.selection.budget.quality = GN_ACCURACY_EXACT;
    assert_int_equal(gn_select(test_context, &w.selection, choices), GN_E_DEVICE);
    assert_string_equal(gn_message(test_context),
                        "gn_select: light 0: no way that is possible here is exact: the best is fair");
    w.selection.budget.frame_ms = -1.0;
    assert_int_equal(gn_select(test_context, &w.selection, choices), GN_E_ARG);
    assert_non_null(strstr(gn_message(test_context), "(-1 ms"));
}

/* What only a struct can say: that z-fail is known. What suits goes no lower than the floor. Outputs that no rule reaches and whose DEFAULT
 * is NC say nothing. */
static void takes_no_liberties(void **state)
{
    static const char text[] =
        "FUNCTION_BLOCK f VAR_INPUT layers : REAL; END_VAR VAR_OUTPUT half : REAL; full : REAL; END_VAR\n"
        "FUZZIFY layers TERM many := (4, 0) (8, 1); END_FUZZIFY\n"
        "DEFUZZIFY half TERM good := 90; METHOD : COGS; DEFAULT := NC; END_DEFUZZIFY\n"
        "DEFUZZIFY full TERM poor := 10; METHOD : COGS; DEFAULT := 10; END_DEFUZZIFY\n"
        "RULEBLOCK RULE 1 : if layers is many then half is good; END_RULEBLOCK END_FUNCTION_BLOCK";
    gn_choice first, second;
    gn_rules *own;
    world w;

    (void)state;
    assert_int_equal(gn_rules_create(test_context, text, strlen(text), &own), GN_OK);
    make_world(&w);
    memset(&w.selection.budget, 0, sizeof w.selection.budget);
    memset(w.selection.possible.variants, 0xff, sizeof w.selection.possible.variants);
    gn_knowledge_default(&w.knowledge);
    w.knowledge.ways[GN_METHOD_ZFAIL][0] = w.knowledge.ways[GN_METHOD_STENCIL][0];
    w.selection.light_count = 1;
    w.selection.updates = 1;
    w.selection.rules = own;
    w.selection.prefers = 1;
    w.lights[0].facts.layers = 10.0;
    assert_int_equal(gn_select(test_context, &w.selection, &first), GN_OK);
    assert_true(first.way.method >= GN_METHOD_STENCIL);
    w.lights[0].facts.layers = 0.0;
    assert_int_equal(gn_select(test_context, &w.selection, &first), GN_OK);
    w.lights[0].facts.layers = 10.0;
    assert_int_equal(gn_select(test_context, &w.selection, &second), GN_OK);
    w.lights[0].facts.layers = 0.0;
    assert_int_equal(gn_select(test_context, &w.selection, &second), GN_OK);
    assert_true(first.suitability == second.suitability);
    w.lights[0].facts.layers = 10.0;
    w.selection.budget.quality = GN_ACCURACY_EXACT;
    assert_int_equal(gn_select(test_context, &w.selection, &first), GN_OK);
    assert_int_equal(first.accuracy, GN_ACCURACY_EXACT);
    gn_rules_destroy(own);
}

#define KNOWLEDGE                                                                                                      \
    "method,scale,upsample,accuracy,us_setup,us_index,us_fragment,us_border,us_pixel,us_switch,bytes_setup,"           \
    "bytes_index,bytes_fragment,bytes_border,bytes_pixel,bytes_switch\n"

static void reads_knowledge(void **state)
{
    static const struct {
        const char *rows, *message;
    } refused[] = {
        {"zfail,1,none,exact,1,1,1,1,1,1,1,1,1,1,1,1\n", "line 2, column 1: there is no such way (zfail, 1, none)"},
        {"stencil,3,bilinear,exact,1,1,1,1,1,1,1,1,1,1,1,1\n", "there is no such way (stencil, 3, bilinear)"},
        {"stencil,1,none,perfect,1,1,1,1,1,1,1,1,1,1,1,1\n", "accuracy is none, rough, fair, fine or exact (perfect)"},
        {"stencil,1,none,exact,1,-1,1,1,1,1,1,1,1,1,1,1\n", "line 2, column 24: a cost is not negative (-1)"},
        {"stencil,1,none,exact,1,1,1,1,1,1,1,1,1,1,1\n", "line 3, column 1: , is missing at the end"},
        {"stencil,1,none,exact,1,1,1,1,1,1,1,1,1,1,1,1\nstencil,1,none,exact,1,1,1,1,1,1,1,1,1,1,1,1\n",
         "line 3, column 1: this way has a row already"},
        {"stencil,1,none,exact,1,x,1,1,1,1,1,1,1,1,1,1\n", "a number is missing ('x')"},
    };
    static const char good[] = KNOWLEDGE
        "stencil,1,none,exact,1,2.5,3e-3,4,5,6,7,8,9,10,11,12\nrefine,2,bilinear,fine,1,1,1,1,1,1,1,1,1,1,1,1\n"
        "count,4,depth,rough,1,1,1,1,1,1,1,1,1,1,1,1\n";
    gn_knowledge k;
    int known = 0;

    (void)state;
    assert_int_equal(gn_knowledge_read(test_context, good, strlen(good), &k), GN_OK);
    for (int m = 0; m < GN_METHOD_TOTAL; m++)
        for (int v = 0; v < GN_VARIANT_COUNT; v++)
            known += k.ways[m][v].is_known;
    assert_int_equal(known, 3);
    assert_true(k.ways[GN_METHOD_STENCIL][GN_VARIANT_FULL].us[GN_COST_INDEX] == 2.5);
    assert_true(fabs(k.ways[GN_METHOD_STENCIL][GN_VARIANT_FULL].us[GN_COST_FRAGMENT] - 3e-3) < 1e-18);
    assert_true(k.ways[GN_METHOD_STENCIL][GN_VARIANT_FULL].bytes[GN_COST_SWITCH] == 12.0);
    assert_int_equal(k.ways[GN_METHOD_COUNT][GN_VARIANT_QUARTER_DEPTH].accuracy, GN_ACCURACY_ROUGH);
    for (size_t i = 0; i < sizeof refused / sizeof refused[0]; i++) {
        char text[1024];
        const gn_knowledge before = k;

        snprintf(text, sizeof text, "%s%s", KNOWLEDGE, refused[i].rows);
        assert_int_equal(gn_knowledge_read(test_context, text, strlen(text), &k), GN_E_ARG);
        if (!strstr(gn_message(test_context), refused[i].message))
            fail_msg("case %d: '%s' has no '%s'", (int)i, gn_message(test_context), refused[i].message);
        assert_memory_equal(&before, &k, sizeof k);
    }
}

static void names_ways(void **state)
{
    static const struct {
        gn_way way;
        const char *name;
    } cases[] = {
        {{1, GN_METHOD_STENCIL, 1, GN_UPSAMPLE_BILINEAR, 1, 0}, "none"},
        {{0, GN_METHOD_STENCIL, 1, GN_UPSAMPLE_BILINEAR, 1, 0}, "stencil"},
        {{0, GN_METHOD_REFINE, 2, GN_UPSAMPLE_BILINEAR, 1, 0}, "refine@1/2"},
        {{0, GN_METHOD_COUNT, 4, GN_UPSAMPLE_DEPTH, 2, 1}, "count@1/4-depth, masks for 2 frames, proxies"},
    };
    char name[80];

    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        assert_int_equal(gn_way_name(&cases[i].way, name, sizeof name), strlen(cases[i].name));
        assert_string_equal(name, cases[i].name);
    }
}

static int open_rules(void **state)
{
    return test_open_context(state) || gn_rules_default(test_context, &rules) != GN_OK;
}

static int close_rules(void **state)
{
    gn_rules_destroy(rules);
    return test_close_context(state);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(keeps_to_what_is_possible_and_affordable),
        cmocka_unit_test(more_of_a_budget_lowers_no_accuracy),
        cmocka_unit_test(answers_the_same),
        cmocka_unit_test(is_explained_by_rules_that_hold),
        cmocka_unit_test(all_zero_is_exact_whatever_it_costs),
        cmocka_unit_test(what_cannot_be_says_so),
        cmocka_unit_test(takes_no_liberties),
        cmocka_unit_test(reads_knowledge),
        cmocka_unit_test(names_ways),
    };

    return cmocka_run_group_tests(tests, open_rules, close_rules);
}
