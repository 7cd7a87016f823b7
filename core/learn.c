/* learn.c - corrects predictions by what frames took: recursive least squares.
 *
 * A frame takes what its host does, plus for each method its gain times what was predicted of it: a gain of all, since a board is
 * faster or slower than it is known to be as a whole, so that what one method shows holds for those that were not tried; and
 * each one's own difference. All wander, so each
 * estimate's variance grows a little with every frame, up to where it started: old frames fade, and what is not seen
 * does not run away. Gains stay between a quarter and four. Two residuals in a row far beyond the usual are taken for the
 * host's, at once: the scene's loads are in the predictions already. */
#include "gni_select.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define LEAST_GAIN 0.25
#define MOST_GAIN  4.0
#define START_GAIN 0.5  /* variance of the common gain before anything is seen */
#define START_OWN  0.02 /* of a method's difference from it */
#define START_HOST 1.0  /* and of the host's time, as a share of a frame's squared */
#define WALK_GAIN  1e-6 /* what a frame adds to them */
#define WALK_HOST  1e-6
#define NOISE      1e-3 /* of a frame's time at least, as a share of it squared */
#define FAR        3.0  /* times the usual residual */
#define SURE       2    /* such frames in a row, on one side */
#define FORGETS    0.02 /* of the usual residual, by a frame */
#define USUAL      0.03 /* before anything is seen */

void gni_learn_start(gni_learner *l)
{
    memset(l, 0, sizeof *l);
    l->deviation = USUAL;
    l->common = 1.0;
    for (int m = 0; m < GN_METHOD_TOTAL; m++)
        l->gains[m] = 1.0;
}

static double start_of(int i, double ms)
{
    return i == 0 ? START_HOST * ms * ms : i == 1 ? START_GAIN : START_OWN;
}

static void start_host(gni_learner *l, double predicted, double ms)
{
    l->host_ms = fmax(ms - predicted, 0.0);
    l->is_started = 1;
    for (int i = 0; i < GNI_LEARNED; i++)
        l->variance[i][i] = start_of(i, ms);
}

double gni_predict(const gni_learner *l, const double parts[GN_METHOD_TOTAL])
{
    double sum = l->host_ms;

    for (int m = 0; m < GN_METHOD_TOTAL; m++)
        sum += l->gains[m] * parts[m];
    return sum;
}

void gni_learn(gni_learner *l, const double parts[GN_METHOD_TOTAL], double ms)
{
    double x[GNI_LEARNED] = {1.0}, gain[GNI_LEARNED], residual, share, predicted = 0.0;
    double spread = fmax(NOISE, l->deviation * l->deviation) * ms * ms;

    for (int m = 0; m < GN_METHOD_TOTAL; m++)
        predicted += parts[m];
    if (!l->is_started) {
        start_host(l, predicted, ms);
        return;
    }
    x[1] = predicted;
    memcpy(x + 2, parts, GN_METHOD_TOTAL * sizeof *x);
    residual = ms - gni_predict(l, parts);
    share = residual / ms;
    l->far = fabs(share) <= FAR * l->deviation ? 0
             : l->far * share > 0              ? l->far + (share > 0 ? 1 : -1)
                                               : (share > 0 ? 1 : -1);
    if (abs(l->far) >= SURE)
        l->variance[0][0] += residual * residual;
    /* of an even spread the mean distance is 0.8 of its deviation; what is far counts as far only */
    l->deviation += FORGETS * (1.25 * fmin(fabs(share), FAR * l->deviation) - l->deviation);
    for (int i = 0; i < GNI_LEARNED; i++) {
        gain[i] = 0.0;
        for (int k = 0; k < GNI_LEARNED; k++)
            gain[i] += l->variance[i][k] * x[k];
        spread += gain[i] * x[i];
    }
    for (int i = 0; i < GNI_LEARNED; i++)
        for (int k = 0; k < GNI_LEARNED; k++)
            l->variance[i][k] -= gain[i] * gain[k] / spread;
    for (int i = 0; i < GNI_LEARNED; i++) {
        const double grown = l->variance[i][i] + (i ? WALK_GAIN : WALK_HOST * ms * ms);

        l->variance[i][i] = fmin(grown, fmax(start_of(i, ms), l->variance[i][i]));
    }
    l->host_ms = fmax(l->host_ms + gain[0] / spread * residual, 0.0);
    l->common = fmin(fmax(l->common + gain[1] / spread * residual, LEAST_GAIN), MOST_GAIN);
    for (int m = 0; m < GN_METHOD_TOTAL; m++) {
        l->own[m] += gain[m + 2] / spread * residual;
        l->gains[m] = fmin(fmax(l->common + l->own[m], LEAST_GAIN), MOST_GAIN);
    }
}
