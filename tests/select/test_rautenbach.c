/* test_rautenbach.c - the changes of algorithm that Rautenbach reports (2008, section 6.4), replayed by rules/rautenbach.fcl over
 * what there is here: full volumes for his spatial subdivision, refine for Chan and Durand's hybrid, a half mask for
 * shadow mapping. There, as here with `prefers`, what suits goes before what is accurate. */
#include "gn_select.h"
#include "gn_test.h"

#include <stdio.h>
#include <string.h>

typedef enum algorithm { SUBDIVISION, HYBRID, MAPPING } algorithm;

static algorithm choose(gn_rules *rules, double moving, double nearness)
{
    gn_light_state light = {.facts = {.lights = 16, .moving = moving, .nearness = nearness, .motion = 0.2},
                            .load = {3000, 200000, 100000, 100000}};
    gn_selection s = {.rules = rules, .target_pixels = 300000, .prefers = 1, .lights = &light, .light_count = 1};
    gn_knowledge knowledge;
    gn_choice choice;

    gn_knowledge_default(&knowledge);
    s.knowledge = &knowledge;
    memset(s.possible.variants, 0xff, sizeof s.possible.variants);
    assert_int_equal(gn_select(test_context, &s, &choice), GN_OK);
    if (choice.way.method == GN_METHOD_REFINE)
        return HYBRID;
    assert_int_equal(choice.way.method, GN_METHOD_STENCIL);
    assert_in_range(choice.way.scale, 1, 2);
    return choice.way.scale == 1 ? SUBDIVISION : MAPPING;
}

static void replays_his_transitions(void **state)
{
    static const double close_by = 0.8, far_off = 0.1;
    const struct {
        double moving, nearness;
        algorithm chosen;
    } steps[] = {
        {0, close_by, SUBDIVISION}, /* static lights */
        {6, close_by, HYBRID},      /* 1: six moving ones, casters close by */
        {13, far_off, MAPPING},     /* 2: thirteen, casters a significant distance away */
        {16, far_off, HYBRID},      /* 3: sixteen, casters where they are */
        {9, close_by, HYBRID},      /* nine, casters close by: it is selected again */
        {16, close_by, HYBRID},     /* in reverse: no other is selected */
        {13, far_off, MAPPING},     /* 4 */
        {6, close_by, HYBRID},      /* back */
        {0, close_by, SUBDIVISION}, /* 5: all lights static */
    };
    char text[8192];
    FILE *f = fopen("rules/rautenbach.fcl", "rb");
    gn_rules *rules;
    size_t length;

    (void)state;
    assert_non_null(f);
    length = fread(text, 1, sizeof text, f);
    fclose(f);
    assert_int_equal(gn_rules_create(test_context, text, length, &rules), GN_OK);
    for (size_t i = 0; i < sizeof steps / sizeof steps[0]; i++)
        if (choose(rules, steps[i].moving, steps[i].nearness) != steps[i].chosen)
            fail_msg("step %d: %g moving lights at nearness %g: %d", (int)i, steps[i].moving, steps[i].nearness,
                     (int)choose(rules, steps[i].moving, steps[i].nearness));
    /* his table 6.1: mapping between two and fourteen where casters are far, the hybrid from fourteen on and close by */
    for (int moving = 1; moving <= 20; moving++) {
        assert_int_equal(choose(rules, moving, 1.0), HYBRID);
        assert_int_equal(choose(rules, moving, 0.0), moving < 14 ? MAPPING : HYBRID);
    }
    gn_rules_destroy(rules);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(replays_his_transitions)};

    return cmocka_run_group_tests(tests, test_open_context, test_close_context);
}
