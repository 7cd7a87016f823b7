/* ways.h - what benches of the selector share: a scene on the stage at 320x240, and frames of it by one way, timed. */
#ifndef WAYS_H
#define WAYS_H
#include "gn_select.h"
#include "stage.h"

typedef struct ways_scene {
    scene loaded;
    stage *stage;
    gn_load *loads; /* [light_count] by the exact method */
    gn_facts *facts;
} ways_scene;

/* A scene of build/scenes, posed at its start. 1, or 0 having said why. */
int ways_open(ways_scene *w, const char *name);
void ways_close(ways_scene *w);

/* All lights by one way; casting 0: without shadows. The plan stays. 1, or 0 where it is not possible. */
int ways_draw(ways_scene *w, int method, int variant, int casting, double *ms);

/* Reads what `gnomon calibrate` wrote. 1, or 0 having said why. */
int ways_read_knowledge(gn_context *context, const char *path, gn_knowledge *out);
#endif
