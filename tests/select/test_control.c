/* test_control.c - the selector from frame to frame, on a board that differs from what it knows (plant.h): it recovers, it
 * settles, and it learns. */
#include "gn_test.h"
#include "plant.h"

#include <math.h>
#include <stdlib.h>

enum { SETTLED = 900 }; /* frames */

static plant_run run;

static void simulate(plant_load load, double noise)
{
    if (!plant_simulate(test_context, load, PLANT_SELECTOR, noise, &run))
        fail_msg("%s", gn_message(test_context));
}

/* Frames from one that is over budget until ten in a row are not. */
static int recovery_from(int start)
{
    int within = 0;

    for (int f = start; f < PLANT_FRAMES; f++) {
        within = run.frames[f].ms <= run.budget_ms ? within + 1 : 0;
        if (within == 10)
            return f - 9 - start;
    }
    return PLANT_FRAMES;
}

static void recovers_within_ten_frames(void **state)
{
    (void)state;
    simulate(PLANT_STEP, 0.02);
    assert_true(plant_over(&run, 300, 600) == 0.0);
    if (recovery_from(600) > 10)
        fail_msg("a step of load is over after %d frames", recovery_from(600));
    simulate(PLANT_HOST, 0.02);
    if (recovery_from(600) > 10)
        fail_msg("a host that takes more is over after %d frames", recovery_from(600));
}

/* When it has settled: two frames in a hundred over budget at most, and one change a second. */
static void settles(void **state)
{
    (void)state;
    for (int load = 0; load < PLANT_LOADS; load++) {
        simulate((plant_load)load, load == PLANT_NOISE ? 0.10 : 0.02);
        print_message("%s: %.4f over, %.3f changes a second, in the last minute half %.3f\n", plant_load_names[load],
                      plant_over(&run, SETTLED, PLANT_FRAMES), plant_changes(&run, SETTLED, PLANT_FRAMES),
                      plant_changes(&run, PLANT_FRAMES / 2, PLANT_FRAMES));
        if (plant_over(&run, SETTLED, PLANT_FRAMES) > 0.02)
            fail_msg("%s: %g of the frames are over budget", plant_load_names[load],
                     plant_over(&run, SETTLED, PLANT_FRAMES));
        for (int f = SETTLED; f + 60 <= PLANT_FRAMES; f++)
            if (load != PLANT_STEP && load != PLANT_HOST && plant_changes(&run, f, f + 60) > 1.0)
                fail_msg("%s: %g changes in the second from frame %d on", plant_load_names[load],
                         plant_changes(&run, f, f + 60), f);
    }
}

/* Under loads that repeat there is a way that fits them all: it is found, and kept. */
static void has_no_limit_cycle(void **state)
{
    static const plant_load loads[] = {PLANT_SINE, PLANT_SQUARE, PLANT_NOISE};

    (void)state;
    for (int i = 0; i < 3; i++) {
        simulate(loads[i], loads[i] == PLANT_NOISE ? 0.10 : 0.02);
        if (plant_changes(&run, PLANT_FRAMES / 2, PLANT_FRAMES) > 3.0 * 60.0 / (PLANT_FRAMES / 2))
            fail_msg("%s: %g changes a second in the last half minute", plant_load_names[loads[i]],
                     plant_changes(&run, PLANT_FRAMES / 2, PLANT_FRAMES));
    }
}

/* What is left of the budget is spent on accuracy again, once the load has gone. */
static void spends_what_there_is(void **state)
{
    (void)state;
    simulate(PLANT_STEP, 0.02);
    assert_true(run.frames[590].accuracy > run.frames[1700].accuracy);
    assert_true(run.frames[PLANT_FRAMES - 1].accuracy >= run.frames[590].accuracy);
}

static void learns_what_frames_take(void **state)
{
    double errors[PLANT_FRAMES];
    int count = 0;

    (void)state;
    simulate(PLANT_RECORDED, 0.02);
    for (int f = 300; f < PLANT_FRAMES; f++)
        errors[count++] = fabs(run.frames[f].predicted_ms / run.frames[f].ms - 1.0);
    for (int i = 0; i < count; i++)
        for (int k = i; k > 0 && errors[k] < errors[k - 1]; k--) {
            const double e = errors[k];

            errors[k] = errors[k - 1];
            errors[k - 1] = e;
        }
    if (!(errors[count / 2] < 0.05))
        fail_msg("predictions are %g off in the median", errors[count / 2]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(recovers_within_ten_frames), cmocka_unit_test(settles),
        cmocka_unit_test(has_no_limit_cycle),         cmocka_unit_test(spends_what_there_is),
        cmocka_unit_test(learns_what_frames_take),
    };

    return cmocka_run_group_tests(tests, test_open_context, test_close_context);
}
