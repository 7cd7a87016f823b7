/* bench_control.c - the selector beside other controllers, on a board that nobody knows (plant.h): one row of a CSV for each load and
 * controller; a picture of the frames of some.
 *
 *     bench_control [FILE.svg]
 *
 * over: share of frames over budget when it has settled, after 15 s; recovery: frames from the step of load until ten in a row
 * are within it; accuracy: mean class of the least accurate light, 4 exact to 0 none. Frames take what the plant says, no clock
 * is read: the same in every run. */
#include <stdio.h>
#include <stdlib.h>

#include "plant.h"
#include "plotter.h"

enum { SETTLED = 900, STEP = 600 };

static plant_run runs[PLANT_LOADS][PLANT_CONTROLS];

static int recovery_of(const plant_run *run)
{
    int within = 0;

    for (int f = STEP; f < PLANT_FRAMES; f++) {
        within = run->frames[f].ms <= run->budget_ms ? within + 1 : 0;
        if (within == 10)
            return f - 9 - STEP;
    }
    return -1;
}

static double accuracy_of(const plant_run *run)
{
    double sum = 0.0;

    for (int f = SETTLED; f < PLANT_FRAMES; f++)
        sum += run->frames[f].accuracy;
    return sum / (PLANT_FRAMES - SETTLED);
}

static void put_panel(FILE *f, int load)
{
    static const char *const colors[PLANT_CONTROLS] = {"#b5482a", "#888888", "#bbbbbb", "#2b3a67"};

    for (int c = 0; c < PLANT_CONTROLS; c++) {
        fprintf(f, "$c%d << EOD\n", c);
        for (int i = 0; i < PLANT_FRAMES; i += 6)
            fprintf(f, "%g %.3f\n", i / 60.0, runs[load][c].frames[i].ms);
        fprintf(f, "EOD\n");
    }
    fprintf(
        f, "set title '%s'\nset xlabel 'seconds'\nset ylabel 'ms a frame'\nset yrange [0:40]\nset key top right\nplot ",
        plant_load_names[load]);
    for (int c = PLANT_CONTROLS; c-- > 0;)
        fprintf(f, "$c%d using 1:2 with lines lc '%s' lw %d title '%s', ", c, colors[c], c == 0 ? 2 : 1,
                plant_control_names[c]);
    fprintf(f, "%g with lines lc '#000000' dt 2 title 'budget'\n", runs[load][0].budget_ms);
}

int main(int count, char **arguments)
{
    static const int shown[] = {PLANT_STEP, PLANT_SINE, PLANT_SQUARE, PLANT_NOISE, PLANT_HOST, PLANT_RECORDED};
    gn_context *context;
    plotter p;

    if (gn_context_create(NULL, &context) != GN_OK)
        return 1;
    printf("load,controller,over,changes_a_second,recovery_frames,accuracy\n");
    for (int l = 0; l < PLANT_LOADS; l++)
        for (int c = 0; c < PLANT_CONTROLS; c++) {
            plant_run *run = &runs[l][c];
            char recovery[16] = "";

            if (!plant_simulate(context, (plant_load)l, (plant_control)c, l == PLANT_NOISE ? 0.10 : 0.02, run))
                return fprintf(stderr, "bench_control: %s\n", gn_message(context)), 1;
            if ((l == PLANT_STEP || l == PLANT_HOST) && recovery_of(run) >= 0)
                snprintf(recovery, sizeof recovery, "%d", recovery_of(run));
            else if (l == PLANT_STEP || l == PLANT_HOST)
                snprintf(recovery, sizeof recovery, "never");
            printf("%s,%s,%.4f,%.3f,%s,%.2f\n", plant_load_names[l], plant_control_names[c],
                   plant_over(run, SETTLED, PLANT_FRAMES), plant_changes(run, SETTLED, PLANT_FRAMES), recovery,
                   accuracy_of(run));
        }
    gn_context_destroy(context);
    if (count < 2)
        return 0;
    if (!plotter_start(&p, arguments[1], 2, 3))
        return 1;
    for (size_t i = 0; i < sizeof shown / sizeof shown[0]; i++)
        put_panel(p.pipe, shown[i]);
    return !plotter_finish(&p);
}
