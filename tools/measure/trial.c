/* trial.c - see trial.h. What is counted and compared is the same in every run; times are not. */
#include "trial.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "command.h"
#include "counted_gl.h"
#include "image_metrics.h"
#include "mask_metrics.h"
#include "picture.h"
#include "truth.h"

static stage_wish wish_for(const subject *s, const config *c, int casting)
{
    const stage_wish wish = {.method = c->method,
                             .one_sided = c->one_sided,
                             .casting = casting,
                             .keeps = casting && subject_keeps(s),
                             .scale = c->scale,
                             .upsample = c->upsample};

    return wish;
}

static size_t pixels_of(const subject *s)
{
    return (size_t)s->stage->target.width * s->stage->target.height;
}

/* Frames with and without shadows in turn; the shadow part is the difference of the two: of the GL's own times where its
 * clock is believed. The first of each warms up. */
static int measure_times(subject *s, const config *c, uint32_t lights, uint32_t repeat, trial *out,
                         char message[SCENE_MESSAGE])
{
    const size_t count = (size_t)s->frames * repeat;
    double *const frame = malloc(3 * count * sizeof *frame), *const shadow = frame + count,
                  *const plan = shadow + count;
    stage_wish with = wish_for(s, c, 1), without = wish_for(s, c, 0);
    int ok = frame != NULL;

    with.light_count = without.light_count = lights;
    for (size_t i = 0; ok && i < count + 1; i++) {
        const size_t at = i ? i - 1 : 0;
        frame_times plain, all;

        subject_pose(s, (uint32_t)(at / repeat));
        ok = frame_clock_draw(&s->clock, s->stage, &without, &plain, message) &&
             frame_clock_draw(&s->clock, s->stage, &with, &all, message);
        if (ok) {
            frame[at] = all.frame;
            plan[at] = all.plan;
            shadow[at] = s->clock.query ? all.gl - plain.gl : all.frame - plain.frame;
        }
    }
    if (ok) {
        out->frame = spread_of(frame, count);
        out->shadow = spread_of(shadow, count);
        out->plan = spread_of(plan, count);
    }
    free(frame);
    return ok;
}

static double bytes_of(const gn_plan *plan, size_t plan_size)
{
    static const double of_format[] = {0, 4, 2, 2, 2};
    const double pixels = (double)plan->mask_size[0] * plan->mask_size[1];
    const double image =
        plan->image.format == GN_FORMAT_NONE ? 0.0
        : plan->image.stencil_bits
            ? 4.0
            : of_format[plan->image.format] + (plan->image.depth_bits > 16 ? 4.0 : plan->image.depth_bits / 8);

    return pixels * (image + plan->mask_count * of_format[plan->mask_format]) + (double)plan_size;
}

static void count_casters(const subject *s, trial *out)
{
    const gn_plan *plan = s->stage->plan;

    out->casters = out->faces = 0;
    for (uint32_t i = 0; i < plan->object_count; i++)
        if (plan->objects[i].flags & GN_CASTS) {
            out->casters++;
            out->faces += gn_mesh_get_info(plan->objects[i].mesh)->triangle_count;
        }
}

/* What a light adds, under its true mask, to ambient light: the frame as it ought to be. */
static void put_right_picture(const subject *s, uint32_t frame, uint32_t lights, uint8_t *rgb)
{
    const size_t pixels = pixels_of(s), bytes = 3 * pixels;
    const uint8_t *const ambient = s->surfaces + (size_t)frame * (s->lights + 1) * bytes;

    for (size_t i = 0; i < bytes; i++) {
        int sum = ambient[i];

        for (uint32_t l = 0; l < lights; l++)
            if (s->truths[(size_t)frame * s->lights + l].lit[i / 3])
                sum += ambient[(l + 1) * bytes + i] - ambient[i];
        rgb[i] = (uint8_t)(sum > 255 ? 255 : sum);
    }
    encode_picture(rgb, pixels);
}

/* One frame: what it draws, and how it looks beside the right one. Into sums. */
static int measure_frame(subject *s, const config *c, uint32_t lights, uint32_t frame, uint8_t *pictures, trial *out,
                         char message[SCENE_MESSAGE])
{
    const uint32_t width = s->stage->target.width, height = s->stage->target.height;
    uint8_t *const right = pictures + 3 * pixels_of(s);
    stage_wish wish = wish_for(s, c, 1);
    uint64_t fragments, passed;
    gl_counts before, after;
    double psnr;

    wish.light_count = lights;
    wish.unbounded = 1;
    subject_pose(s, frame);
    before = counted_gl_read();
    if (stage_plan(s->stage, &wish, message) != 0 || !stage_draw_lit(s->stage, 0, message))
        return 0;
    after = counted_gl_read();
    out->draws += (double)(after.draws - before.draws);
    out->vertices += (double)(after.vertices - before.vertices);
    out->indices += (double)(after.indices - before.indices);
    out->bytes_sent += (double)(after.bytes_sent - before.bytes_sent);
    out->traffic += s->stage->plan->traffic.written + s->stage->plan->traffic.read;
    out->memory = fmax(out->memory, bytes_of(s->stage->plan, s->stage->plan_size));
    count_casters(s, out);
    for (int w = 0; w < GN_WARNING_COUNT && !out->warning[0]; w++)
        gn_plan_explain_warning(s->stage->plan, (gn_warning)w, out->warning, sizeof out->warning);
    if (!read_picture(s->stage, pictures) || !stage_count_fragments(s->stage, &fragments, &passed)) {
        snprintf(message, SCENE_MESSAGE, "the frame cannot be read back");
        return 0;
    }
    out->fragments += (double)fragments / (c->method == GN_METHOD_REFINE ? 1.0 : (double)c->scale * c->scale);
    put_right_picture(s, frame, lights, right);
    psnr = image_psnr(pictures, right, width, height);
    out->psnr += isinf(psnr) ? 0.0 : psnr;
    out->equal_frames += isinf(psnr) ? 1 : 0;
    out->ssim += image_ssim(pictures, right, width, height);
    out->flip += image_flip(pictures, right, width, height);
    return 1;
}

/* One light in one frame: draws its mask and compares it. Into sums. */
static int measure_mask(subject *s, const config *c, uint32_t light, uint32_t frame, uint8_t *lit, const uint8_t *last,
                        uint8_t *visible, trial *out, char message[SCENE_MESSAGE])
{
    const true_mask *t = &s->truths[(size_t)frame * s->lights + light];
    const uint32_t width = s->stage->target.width, height = s->stage->target.height;
    const mask_pair pair = {width, height, lit, t->lit, t->visible, t->classes};
    stage_wish wish = wish_for(s, c, 1);
    uint64_t certain = 0;
    mask_metrics m;

    wish.first_light = light;
    wish.light_count = 1;
    wish.unbounded = 1;
    subject_pose(s, frame);
    if (stage_plan(s->stage, &wish, message) != 0 || !stage_draw_mask(s->stage, light, message) ||
        !read_mask(s->stage, lit, visible) || !mask_measure(&pair, &m))
        return 0;
    for (size_t i = 0; i < pixels_of(s); i++)
        certain += t->classes[i] == TRUTH_CERTAIN && (lit[i] != t->lit[i] || visible[i] != t->visible[i]);
    out->masks++;
    out->visible += m.visible;
    out->wrong += m.wrong;
    out->interior += m.interior;
    out->boundary += m.boundary;
    out->certain_wrong += certain;
    out->warned += s->stage->plan->warnings != 0;
    out->unwarned_certain += s->stage->plan->warnings ? 0 : certain;
    out->unwarned_interior += s->stage->plan->warnings ? 0 : m.interior;
    out->iou += m.iou;
    out->precision += m.precision;
    out->recall += m.recall;
    out->boundary_f[0] += m.boundary_f[0];
    out->boundary_f[1] += m.boundary_f[1];
    out->distance95 += m.distance95;
    if (frame > 0) {
        const true_mask *before = t - s->lights;
        const mask_pair pair_before = {width, height, last, before->lit, before->visible, NULL};

        out->flicker += mask_flicker(&pair_before, &pair);
    }
    if (m.wrong > out->worst_wrong) {
        out->worst_wrong = m.wrong;
        out->worst_frame = frame;
        out->worst_light = light;
    }
    return 1;
}

/* Each light's masks in the order of frames, so that what is kept from one to the next is that light's. */
static int measure_masks(subject *s, const config *c, uint32_t lights, trial *out, char message[SCENE_MESSAGE])
{
    const size_t pixels = pixels_of(s);
    uint8_t *masks = malloc(3 * pixels);
    int ok = masks != NULL;

    for (uint32_t light = 0; ok && light < lights; light++) {
        ok = stage_renew_cache(s->stage);
        for (uint32_t frame = 0; ok && frame < s->frames; frame++)
            ok = measure_mask(s, c, light, frame, masks + frame % 2 * pixels, masks + (frame + 1) % 2 * pixels,
                              masks + 2 * pixels, out, message);
    }
    free(masks);
    return ok;
}

static void divide(trial *t, uint32_t frames)
{
    double *const of_frames[] = {&t->fragments,  &t->vertices, &t->indices, &t->draws,
                                 &t->bytes_sent, &t->traffic,  &t->ssim,    &t->flip};
    double *const of_masks[] = {&t->iou,           &t->precision,     &t->recall,
                                &t->boundary_f[0], &t->boundary_f[1], &t->distance95};

    for (size_t i = 0; i < sizeof of_frames / sizeof of_frames[0]; i++)
        *of_frames[i] /= frames;
    for (size_t i = 0; i < sizeof of_masks / sizeof of_masks[0] && t->masks; i++)
        *of_masks[i] /= t->masks;
    t->psnr = t->equal_frames < frames ? t->psnr / (frames - t->equal_frames) : INFINITY;
}

int trial_run(subject *s, const config *c, uint32_t lights, uint32_t repeat, trial *out)
{
    const stage_wish wish = wish_for(s, c, 1);
    stage_wish probe = wish;
    char message[SCENE_MESSAGE] = "";
    uint8_t *pictures = malloc(6 * pixels_of(s));
    int ok = pictures != NULL;

    memset(out, 0, sizeof *out);
    subject_pose(s, 0);
    probe.light_count = lights;
    if (stage_plan(s->stage, &probe, message) != 0) {
        snprintf(out->impossible, sizeof out->impossible, "%.255s", message);
        free(pictures);
        return 1;
    }
    ok = ok && stage_renew_cache(s->stage);
    for (uint32_t f = 0; ok && f < s->frames; f++)
        ok = measure_frame(s, c, lights, f, pictures, out, message);
    ok = ok && measure_masks(s, c, lights, out, message) && stage_renew_cache(s->stage) &&
         measure_times(s, c, lights, repeat, out, message);
    divide(out, s->frames);
    free(pictures);
    if (!ok)
        say("%s: %s", c->name, message[0] ? message : "no memory");
    return ok;
}
