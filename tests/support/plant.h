/* plant.h - frames that nobody draws: what a board would take for them, so that controllers can be tried on any load.
 *
 * The board is as the selector knows it, but each method has a factor of its own that no controller is told, and every frame
 * differs by noise. Loads are multiples of a usual one, by frame. */
#ifndef PLANT_H
#define PLANT_H
#include "gn_select.h"

enum { PLANT_FRAMES = 3600, PLANT_LIGHTS = 3 };

typedef enum plant_load {
    PLANT_STEP,
    PLANT_RAMP,
    PLANT_SINE,
    PLANT_SQUARE,
    PLANT_NOISE,
    PLANT_HOST,
    PLANT_RECORDED,
    PLANT_LOADS
} plant_load;
typedef enum plant_control { PLANT_SELECTOR, PLANT_FULL, PLANT_HALF, PLANT_PID, PLANT_CONTROLS } plant_control;

extern const char *const plant_load_names[PLANT_LOADS];
extern const char *const plant_control_names[PLANT_CONTROLS];

typedef struct plant_frame {
    double load, ms;     /* of usual; measured */
    double predicted_ms; /* by the selector */
    int accuracy;        /* the least of its lights */
    int changes;         /* lights whose way is another than in the frame before */
} plant_frame;

typedef struct plant_run {
    double budget_ms;
    plant_frame frames[PLANT_FRAMES];
} plant_run;

/* 1, or 0 where the selector fails. noise: the deviation of a frame, as a share. */
int plant_simulate(gn_context *context, plant_load load, plant_control control, double noise, plant_run *out);

/* From one frame to another: the share over budget, and changes a second at 60 frames. */
double plant_over(const plant_run *run, int from, int to);
double plant_changes(const plant_run *run, int from, int to);
#endif
