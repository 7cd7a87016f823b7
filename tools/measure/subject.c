/* subject.c - a scene with its truth: see trial.h. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "command.h"
#include "picture.h"
#include "trial.h"

#define FULL                                                                                                           \
    2 /* lights that may be as bright as white together: of more each is less, so that pictures are not all white */
#define DEGREE (3.14159265358979323846 / 180.0)
#define STEP   2.0 /* degrees of the path round the centre, a frame */

/* A camera's axes from where it is and what it looks at: its -z that way, y up. */
static void look_at(double world[16], const double view[6])
{
    double z[3], x[3], y[3], length;

    for (int i = 0; i < 3; i++)
        z[i] = view[i] - view[3 + i];
    length = sqrt(z[0] * z[0] + z[1] * z[1] + z[2] * z[2]);
    for (int i = 0; i < 3; i++)
        z[i] /= length;
    length = hypot(z[0], z[2]);
    x[0] = length > 0.0 ? z[2] / length : 1.0; /* straight up or down: x stays */
    x[1] = 0.0;
    x[2] = length > 0.0 ? -z[0] / length : 0.0;
    for (int i = 0; i < 3; i++)
        y[i] = z[(i + 1) % 3] * x[(i + 2) % 3] - z[(i + 2) % 3] * x[(i + 1) % 3];
    for (int i = 0; i < 3; i++) {
        world[i] = x[i];
        world[4 + i] = y[i];
        world[8 + i] = z[i];
        world[12 + i] = view[i];
    }
}

static void turn(double v[3], double angle, const double centre[3], int is_point)
{
    const double x = v[0] - (is_point ? centre[0] : 0.0), z = v[2] - (is_point ? centre[2] : 0.0);

    v[0] = x * cos(angle) + z * sin(angle) + (is_point ? centre[0] : 0.0);
    v[2] = z * cos(angle) - x * sin(angle) + (is_point ? centre[2] : 0.0);
}

void subject_pose(subject *s, uint32_t frame)
{
    const double spin = s->spared.spin * frame;
    double *world = s->loaded.camera.world;

    stage_pose(s->stage, frame / 60.0, spin);
    for (size_t i = 0; i < s->loaded.light_count; i++) { /* of the scene too, which the truth is traced of */
        turn(s->loaded.lights[i].position, spin * DEGREE, s->stage->centre, 1);
        turn(s->loaded.lights[i].towards, spin * DEGREE, s->stage->centre, 0);
    }
    if (s->path->views)
        look_at(world, s->path->views[frame % s->path->count]);
    for (int axis = 0; axis < 4 && !s->path->views; axis++)
        turn(world + 4 * axis, STEP * DEGREE * frame, s->stage->centre, axis == 3);
}

int subject_keeps(const subject *s)
{
    const gn_shadow_cache_desc *d = &s->spared.cache;

    return d->update_every > 1 || d->update_distance > 0.0 || d->masks_every > 1;
}

static int trace_frame(subject *s, uint32_t frame, void (*progress)(void), char message[SCENE_MESSAGE])
{
    const truth_options options = {
        s->stage->target.width, s->stage->target.height, s->stage->target.depth_bits, {0, 0}};
    truth *common = NULL;
    int ok = 1;

    subject_pose(s, frame);
    for (uint32_t light = 0; ok && light < s->lights; light++) {
        progress();
        ok = true_mask_trace(&s->truths[(size_t)frame * s->lights + light], &s->loaded, &options, light, &common,
                             message);
    }
    truth_free(common);
    return ok;
}

/* The frame without shadows: in ambient light, and with one light each. */
static int draw_surfaces(subject *s, uint32_t frame, char message[SCENE_MESSAGE])
{
    const size_t bytes = (size_t)3 * s->stage->target.width * s->stage->target.height;

    subject_pose(s, frame);
    for (uint32_t i = 0; i <= s->lights; i++) {
        const stage_wish wish = {
            .method = GN_METHOD_AUTO, .first_light = i ? i - 1 : 0, .light_count = i ? 1 : 0, .unbounded = 1};

        if (stage_plan(s->stage, &wish, message) != 0 || !stage_draw_lit(s->stage, wish.first_light, message) ||
            !read_levels(s->stage, s->surfaces + ((size_t)frame * (s->lights + 1) + i) * bytes))
            return 0;
    }
    return 1;
}

/* Truth and surfaces of every frame. */
static int prepare(subject *s, const subject_desc *d, char message[SCENE_MESSAGE])
{
    const size_t bytes = (size_t)3 * d->width * d->height;
    stage_wish plain = {.method = GN_METHOD_AUTO};

    s->frames = d->frames;
    s->lights = s->loaded.light_count < d->most_lights ? (uint32_t)s->loaded.light_count : d->most_lights;
    s->stage->exposure *= s->lights > FULL ? (double)FULL / s->lights : 1.0;
    s->truths = calloc((size_t)s->frames * s->lights + 1, sizeof *s->truths);
    s->surfaces = malloc((size_t)s->frames * (s->lights + 1) * bytes);
    if (!s->truths || !s->surfaces) {
        snprintf(message, SCENE_MESSAGE, "no memory for %lu frames", (unsigned long)s->frames);
        return EXIT_FAILED;
    }
    for (uint32_t f = 0; f < s->frames; f++)
        if (!trace_frame(s, f, d->progress, message) || !draw_surfaces(s, f, message))
            return EXIT_FAILED;
    subject_pose(s, 0);
    plain.light_count = s->lights;
    return frame_clock_open(&s->clock, s->stage, &plain, message) ? EXIT_DONE : EXIT_FAILED;
}

int subject_open(subject *s, const subject_desc *d)
{
    const stage_options options = {.platform = d->platform,
                                   .width = d->width,
                                   .height = d->height,
                                   .depth_bits = 24,
                                   .stencil_bits = 8,
                                   .hide = d->hide,
                                   .cache = d->spared.cache,
                                   .weld_angle = d->spared.weld_angle * DEGREE,
                                   .proxy_triangles = d->spared.proxy};
    char message[SCENE_MESSAGE] = "";
    int status;

    memset(s, 0, sizeof *s);
    if (!scene_load(&s->loaded, d->file, say_line, message) ||
        !scene_ensure_view(&s->loaded, (double)d->width / d->height, say_line)) {
        say("%s", message);
        return EXIT_FAILED;
    }
    s->path = d->path;
    s->spared = d->spared;
    status = stage_open(&s->stage, &s->loaded, &options, message);
    if (status == 0)
        status = prepare(s, d, message);
    if (status != 0) {
        say("%s: %s", d->file, message);
        subject_close(s);
    }
    return status;
}

void subject_close(subject *s)
{
    for (size_t i = 0; s->truths && i < (size_t)s->frames * s->lights; i++)
        true_mask_free(&s->truths[i]);
    free(s->truths);
    free(s->surfaces);
    if (s->stage)
        frame_clock_close(&s->clock, s->stage);
    stage_close(s->stage);
    scene_free(&s->loaded);
}
