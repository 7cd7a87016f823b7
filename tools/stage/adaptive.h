/* adaptive.h - frames of the stage whose lights' shadows are made as the selector chooses: each light its own way, in as many
 * plans as there are different ones. */
#ifndef ADAPTIVE_H
#define ADAPTIVE_H
#include "gn_select.h"
#include "stage.h"

typedef struct adaptive_options {
    const gn_knowledge *knowledge; /* NULL: the library's own */
    gn_rules *rules;               /* the same; used until the end */
    gn_budget budget;
    double power; /* a fact */
} adaptive_options;

typedef struct adaptive {
    stage *stage;
    gn_selector *selector;
    gn_selection asked;
    double power;
    gn_light_state lights[GN_MOST_SELECTED];
    gn_way ways[GN_MOST_SELECTED];
    gn_light last[GN_MOST_SELECTED]; /* where they were */
    float (*places)[2];              /* [object_count] where objects were on the screen, in halves of its height */
    size_t object_count;
    uint32_t light_count; /* of the last frame; 0: there was none */
    int is_uniform;       /* no way can follow another here: all lights take the first's */
    uint32_t plans;       /* of the last frame, and their traffic */
    gn_traffic traffic;
    uint32_t frames; /* so far */
} adaptive;

/* 0, or an exit status of the command with a message. */
int adaptive_open(adaptive *a, stage *s, const adaptive_options *options, char message[SCENE_MESSAGE]);
void adaptive_close(adaptive *a); /* a zeroed one does nothing */

/* From the next frame on. */
void adaptive_set_budget(adaptive *a, const gn_budget *budget);

/* Chooses, plans and draws a frame of the first light_count lights, as it is posed; like: method, scale and members are not read. 1,
 * or 0 with a message. When it is done, adaptive_measured() is to be told what it took. */
int adaptive_draw(adaptive *a, const stage_wish *like, uint32_t light_count, char message[SCENE_MESSAGE]);
void adaptive_measured(adaptive *a, double frame_ms);
#endif
