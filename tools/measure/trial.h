/* trial.h - one configuration on one scene: what its frames cost, and how far from the truth their masks and pictures are.
 *
 * A subject is a scene on the stage at one size, with the camera's path, and the truth of its masks in every frame,
 * traced once and kept; a configuration is a way to make shadows; a trial runs one on the other. */
#ifndef TRIAL_H
#define TRIAL_H
#include "frame_clock.h"
#include "spread.h"
#include "stage.h"
#include "true_mask.h"

typedef struct config {
    char name[48]; /* of the three: "count", "count@1/2-bilinear" */
    gn_method method;
    int one_sided;
    uint32_t scale;
    gn_upsample upsample;
} config;

/* How the camera goes: places and what it looks at, a row a frame; or round the scene's centre. */
typedef struct camera_path {
    char name[64];
    double (*views)[6]; /* [count] eye and target; NULL: turned about the vertical axis by 2 degrees a frame */
    uint32_t count;
} camera_path;

/* What is spared, besides method and resolution; and how lights turn, so that it matters. All 0: nothing. */
typedef struct shortcuts {
    double spin;       /* degrees a frame, of every light about the vertical axis */
    double weld_angle; /* degrees */
    uint32_t proxy;    /* triangles */
    gn_shadow_cache_desc cache;
} shortcuts;

typedef struct subject {
    scene loaded;
    stage *stage;
    const camera_path *path;
    uint32_t frames, lights; /* lights: of the scene, or the most that are asked for */
    shortcuts spared;
    frame_clock clock;
    true_mask *truths; /* [frames][lights] */
    uint8_t *surfaces; /* [frames][lights + 1][pixels][3]: ambient light alone, and with it each light, unshadowed */
} subject;

/* How to open one. */
typedef struct subject_desc {
    const char *file;
    const camera_path *path;
    uint32_t width, height, frames, most_lights;
    const char *platform, *hide; /* NULL: the first that works; nothing */
    shortcuts spared;
    void (*progress)(void); /* called before each truth is traced */
} subject_desc;

/* 0, or an exit status of the command, having said why. */
int subject_open(subject *s, const subject_desc *desc);
void subject_close(subject *s);
void subject_pose(subject *s, uint32_t frame);
int subject_keeps(const subject *s); /* whether something is kept from frame to frame */

typedef struct trial {
    char impossible[256]; /* why it cannot run here; else "" */
    char warning[256];    /* of the plan; or "" */
    uint32_t masks;       /* that were compared: frames times lights */
    uint32_t casters, faces;
    spread frame, shadow, plan; /* ms */
    /* of all frames together, a frame on average */
    double fragments, vertices, indices, draws, bytes_sent, traffic;
    double memory; /* bytes of images and masks, and of the plan */
    /* of all masks together; and means over them */
    uint64_t visible, wrong, certain_wrong, interior, boundary, flicker;
    /* of the masks: those that the plan warned of; certain and interior pixels that are wrong in the others */
    uint64_t warned, unwarned_certain, unwarned_interior;
    double iou, precision, recall, boundary_f[2], distance95;
    double psnr, ssim, flip; /* means over frames; of psnr over those that differ, INFINITY where none does */
    uint32_t equal_frames;   /* that look as they ought to, to the last level */
    uint32_t worst_frame, worst_light;
    uint64_t worst_wrong;
} trial;

/* Runs it with the first `lights` of the subject's; times are of `repeat` frames each. 1; 0 having said why. */
int trial_run(subject *s, const config *c, uint32_t lights, uint32_t repeat, trial *out);
#endif
