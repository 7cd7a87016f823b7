/* test_selector.c - what the selector keeps from frame to frame, whatever is asked in between: the floor of quality, budgets that
 * change, energy alone, importance; and what it is told that is no number. */
#include "gn_select.h"
#include "gn_test.h"

#include <math.h>
#include <string.h>

typedef struct bed {
    gn_selector *selector;
    gn_selection asked;
    gn_knowledge knowledge;
    gn_light_state lights[3];
    gn_way ways[3];
    uint32_t light_count;
} bed;

/* The library's knowledge; a board that can do all. */
static void open_bed(bed *b, uint32_t light_count)
{
    memset(b, 0, sizeof *b);
    gn_knowledge_default(&b->knowledge);
    b->light_count = light_count;
    for (uint32_t i = 0; i < light_count; i++) {
        b->lights[i].load = (gn_load){5000, 100000, 50000, 40000};
        b->lights[i].facts.motion = 0.2;
        b->lights[i].importance = 1.0 / (i + 1);
    }
    memset(b->asked.possible.variants, 0xff, sizeof b->asked.possible.variants);
    b->asked.target_pixels = 300000;
}

static void start(bed *b)
{
    assert_int_equal(gn_selector_create(test_context, &b->knowledge, NULL, &b->selector), GN_OK);
    gn_selector_set(b->selector, &b->asked);
}

static double cost_ms(const bed *b, uint32_t light)
{
    const gn_way *way = &b->ways[light];
    double counts[GN_COST_COUNT], sum = 0.0;

    if (way->is_dropped)
        return 0.0;
    gn_count_costs(way, &b->lights[light].load, counts);
    for (int c = 0; c < GN_COST_COUNT; c++)
        sum += b->knowledge.ways[way->method][gn_way_variant(way)].us[c] * counts[c];
    return sum / 1000.0;
}

/* Frames that take what is known, and so much for the host. */
static void run(bed *b, int frames, double host_ms)
{
    for (int f = 0; f < frames; f++) {
        double ms = host_ms;

        if (gn_selector_next(b->selector, b->lights, b->light_count, b->ways) != GN_OK)
            fail_msg("%s", gn_message(test_context));
        for (uint32_t i = 0; i < b->light_count; i++)
            ms += cost_ms(b, i);
        gn_selector_measured(b->selector, ms);
    }
}

static gn_accuracy accuracy_of(const bed *b, uint32_t light)
{
    return b->ways[light].is_dropped
               ? GN_ACCURACY_NONE
               : b->knowledge.ways[b->ways[light].method][gn_way_variant(&b->ways[light])].accuracy;
}

static void never_steps_below_the_floor(void **state)
{
    bed b;

    (void)state;
    open_bed(&b, 1);
    b.asked.budget.frame_ms = 14.0;
    b.asked.budget.quality = GN_ACCURACY_FINE;
    b.knowledge.ways[GN_METHOD_STENCIL][GN_VARIANT_FULL].us[GN_COST_FRAGMENT] *=
        6.0; /* dearer than refine under load */
    start(&b);
    for (int f = 0; f < 2400; f++) {
        b.lights[0].load.fragments = f / 300 % 2 ? 400000 : 100000;
        run(&b, 1, 5.0);
        if (accuracy_of(&b, 0) < GN_ACCURACY_FINE)
            fail_msg("frame %d is %s", f, gn_accuracy_name(accuracy_of(&b, 0)));
    }
    gn_selector_destroy(b.selector);
}

static void a_floor_that_is_raised_holds_at_once(void **state)
{
    bed b;

    (void)state;
    open_bed(&b, 1);
    b.asked.budget.frame_ms = 6.9;
    b.lights[0].load.fragments = 700000;
    start(&b);
    run(&b, 600, 5.0);
    assert_true(accuracy_of(&b, 0) < GN_ACCURACY_EXACT);
    b.asked.budget.quality = GN_ACCURACY_EXACT;
    gn_selector_set(b.selector, &b.asked);
    run(&b, 1, 5.0);
    assert_int_equal(accuracy_of(&b, 0), GN_ACCURACY_EXACT);
    gn_selector_destroy(b.selector);
}

static void energy_alone_is_kept(void **state)
{
    gn_selection selection;
    const gn_choice *wanted;
    char wanted_name[80], name[80];
    bed b;

    (void)state;
    open_bed(&b, 1);
    b.asked.budget.energy_mw = 6.0;
    b.lights[0].load.fragments = 20000;
    start(&b);
    run(&b, 600, 5.0);
    assert_int_equal(b.ways[0].scale, 1);
    b.lights[0].load.fragments = 120000;
    run(&b, 30, 5.0);
    gn_selector_explain(b.selector, &selection, &wanted);
    gn_way_name(&b.ways[0], name, sizeof name);
    gn_way_name(&wanted[0].way, wanted_name, sizeof wanted_name);
    assert_string_equal(name, wanted_name);
    assert_true(b.ways[0].scale > 1);
    gn_selector_destroy(b.selector);
}

static void another_budget_is_acted_on(void **state)
{
    bed b;

    (void)state;
    open_bed(&b, 2);
    b.asked.budget.frame_ms = 5.5;
    start(&b);
    for (int i = 0; i < 20; i++) { /* spikes: it backs off */
        run(&b, 100, 4.0);
        run(&b, 20, 12.0);
    }
    run(&b, 60, 5.4);
    assert_true(accuracy_of(&b, 1) < GN_ACCURACY_EXACT);
    memset(&b.asked.budget, 0, sizeof b.asked.budget);
    gn_selector_set(b.selector, &b.asked);
    run(&b, 5 * 60, 5.4);
    assert_int_equal(accuracy_of(&b, 0), GN_ACCURACY_EXACT);
    assert_int_equal(accuracy_of(&b, 1), GN_ACCURACY_EXACT);
    gn_selector_destroy(b.selector);
}

static void importance_that_changes_is_followed(void **state)
{
    bed b;
    int is_followed = 0;

    (void)state;
    open_bed(&b, 2);
    for (int i = 0; i < 2; i++)
        b.lights[i].load = (gn_load){5000, 900000, 300000, 40000};
    for (double budget = 10.0; budget < 20.0; budget += 0.25) { /* one of them is exact, and not the other */
        b.asked.budget.frame_ms = budget;
        start(&b);
        run(&b, 1200, 5.0);
        if (accuracy_of(&b, 0) > accuracy_of(&b, 1)) {
            b.lights[1].importance = 2.0;
            run(&b, 2400, 5.0);
            is_followed++;
            if (accuracy_of(&b, 1) < accuracy_of(&b, 0))
                fail_msg("at %g ms the more important light is %s, the other %s", budget,
                         gn_accuracy_name(accuracy_of(&b, 1)), gn_accuracy_name(accuracy_of(&b, 0)));
            b.lights[1].importance = 0.5;
        }
        gn_selector_destroy(b.selector);
    }
    assert_true(is_followed > 0);
}

static void what_is_no_number_is_refused(void **state)
{
    double before;
    bed b;

    (void)state;
    open_bed(&b, 1);
    b.asked.budget.frame_ms = 16.0;
    start(&b);
    run(&b, 100, 5.0);
    before = gn_selector_predicted(b.selector);
    gn_selector_measured(b.selector, INFINITY);
    gn_selector_measured(b.selector, NAN);
    gn_selector_measured(b.selector, -3.0);
    run(&b, 100, 5.0);
    assert_true(fabs(gn_selector_predicted(b.selector) - before) < 0.05);
    b.lights[0].facts.nearness = NAN;
    assert_int_equal(gn_selector_next(b.selector, b.lights, 1, b.ways), GN_E_ARG);
    assert_non_null(strstr(gn_message(test_context), "light 0: a fact, load or importance is no number"));
    b.lights[0].facts.nearness = 0.0;
    b.lights[0].load.fragments = -1.0;
    assert_int_equal(gn_selector_next(b.selector, b.lights, 1, b.ways), GN_E_ARG);
    gn_selector_destroy(b.selector);
}

/* Lights come and go; none at all is lawful. */
static void lights_come_and_go(void **state)
{
    bed b;

    (void)state;
    open_bed(&b, 3);
    b.asked.budget.frame_ms = 100.0;
    start(&b);
    for (uint32_t i = 0; i < 60; i++) {
        b.light_count = i * 7 % 4;
        run(&b, 3, 5.0);
        for (uint32_t l = 0; l < b.light_count; l++)
            assert_int_equal(accuracy_of(&b, l), GN_ACCURACY_EXACT);
    }
    gn_selector_destroy(b.selector);
}

/* A budget of memory that holds no mask drops them, where the window's own stencil cannot count. */
static void too_little_memory_drops_shadows(void **state)
{
    bed b;

    (void)state;
    open_bed(&b, 1);
    b.asked.possible.variants[GN_METHOD_STENCIL] = 0;
    b.asked.budget.memory = 1e5;
    start(&b);
    run(&b, 3, 5.0);
    assert_true(b.ways[0].is_dropped);
    gn_selector_destroy(b.selector);
}

/* Deciding, learning and explaining ask for no memory; what was given comes back. */
static void allocates_nothing(void **state)
{
    static char text[65536];
    test_port counter = {0, 0, 0};
    const gn_port port = test_port_make(&counter);
    const gn_choice *wanted;
    gn_selection selection;
    gn_context *context;
    size_t before, live;
    bed b;

    (void)state;
    assert_int_equal(gn_context_create(&port, &context), GN_OK);
    live = counter.live_bytes;
    open_bed(&b, 3);
    b.asked.budget.frame_ms = 14.0;
    assert_int_equal(gn_selector_create(context, NULL, NULL, &b.selector), GN_OK);
    before = counter.calls;
    gn_selector_set(b.selector, &b.asked);
    run(&b, 300, 5.0);
    gn_selector_explain(b.selector, &selection, &wanted);
    assert_true(gn_explain_choice(&selection, wanted, 2, 1, text, sizeof text) > 100);
    assert_int_equal(counter.calls, before);
    gn_selector_destroy(b.selector);
    assert_int_equal(counter.live_bytes, live);
    gn_context_destroy(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(allocates_nothing),
        cmocka_unit_test(never_steps_below_the_floor),
        cmocka_unit_test(a_floor_that_is_raised_holds_at_once),
        cmocka_unit_test(energy_alone_is_kept),
        cmocka_unit_test(another_budget_is_acted_on),
        cmocka_unit_test(importance_that_changes_is_followed),
        cmocka_unit_test(what_is_no_number_is_refused),
        cmocka_unit_test(lights_come_and_go),
        cmocka_unit_test(too_little_memory_drops_shadows),
    };

    return cmocka_run_group_tests(tests, test_open_context, test_close_context);
}
