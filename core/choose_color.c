/* choose_color.c - counts without a stencil: where they are made, what they keep, and how their masks reach the frame
 * (DESIGN.md, decision 11; Roettger 2002, section 4).
 *
 *     count   fronts in red, backs in green of an image, each up to its channel's top. Shadow where the two differ
 *     signed  up by one step for one side, down for the other, from the middle: in alpha 127 of 8 bits, 7 of 4
 *     alpha   halved for one side, doubled for the other, from full: 1, 1/2, 1/4 ... are levels 255, 128, 64 ... 1 of 8
 *             bits, which come back exactly: 128 / 255 of such a level rounds to the next whatever the driver's way of
 *             rounding, and 2 * 128 stops at 255. As many halvings as there are bits; Roettger's quarters leave room
 *             for two
 *     screen  the same in the colour of the frame itself, before the scene is drawn
 *
 * Masks of a stencil are taken to a texture too where that saves more than it costs: with many lights that reach most of
 * what is seen. */
#include "gni.h"

#include <string.h>

#define LEAST_ALPHA 4 /* bits: fewer count nothing worth a pass */
#define LEAST_COLOR 4
#define WORTH       1.3 /* bytes saved are an estimate, and a framebuffer more is not free: only where they are many */

static int can(const gn_scene *s, gn_capability c)
{
    return gn_target_can(&s->target, c);
}

/* From the most exact to the least, or from the smallest to the largest. */
static gn_format find_format(const gn_scene *s, const gn_format *wanted, int count)
{
    static const gn_capability needs[] = {GN_CAPABILITY_COUNT, GN_CAN_FBO_RGBA8, GN_CAN_FBO_RGBA4, GN_CAN_FBO_RGB5A1,
                                          GN_CAN_FBO_RGB565};

    for (int i = 0; i < count; i++)
        if (can(s, needs[wanted[i]]))
            return wanted[i];
    return GN_FORMAT_NONE;
}

static gn_format find_count_format(const gn_scene *s)
{
    static const gn_format wanted[] = {GN_FORMAT_RGBA8, GN_FORMAT_RGB565, GN_FORMAT_RGB5A1, GN_FORMAT_RGBA4};

    return find_format(s, wanted, 4);
}

static gn_format find_mask_format(const gn_scene *s)
{
    static const gn_format wanted[] = {GN_FORMAT_RGBA4, GN_FORMAT_RGB5A1, GN_FORMAT_RGBA8, GN_FORMAT_RGB565};

    return find_format(s, wanted, 4);
}

/* What a shadow leaves of the light that it takes from the frame. */
static double find_dimmed(const gn_scene *s)
{
    if (s->shade != GN_SHADE_ATTENUATE)
        return 0.0;
    return s->dimmed > 0.0 ? s->dimmed : 0.5;
}

/* Of red, green, blue, alpha. */
static int bits_of(gn_format format, int channel)
{
    static const int bits[][4] = {{0, 0, 0, 0}, {8, 8, 8, 8}, {4, 4, 4, 4}, {5, 5, 5, 1}, {5, 6, 5, 0}};

    return bits[format][channel];
}

int gni_format_bytes(gn_format format)
{
    return format == GN_FORMAT_NONE ? 0 : format == GN_FORMAT_RGBA8 ? 4 : 2;
}

static int shares_depth(const gn_scene *s)
{
    return s->scale <= 1 && s->target.shared_depth && can(s, GN_CAN_SHARED_DEPTH);
}

static int is_small(const gn_scene *s)
{
    return s->scale > 1;
}

int gni_carries_depth(const gn_scene *s)
{
    return is_small(s) && (s->upsample == GN_UPSAMPLE_DEPTH || s->method == GN_METHOD_REFINE);
}

/* Whether masks can carry depth, where they must. */
static int can_carry_depth(const gn_scene *s, const char *name, gni_text *why)
{
    if (!gni_carries_depth(s) || can(s, GN_CAN_FBO_RGBA8))
        return 1;
    gni_put(why, "%s upsampled by depth needs %s, which %s", name, gn_capability_name(GN_CAN_FBO_RGBA8),
            gni_why_not(&s->target, GN_CAN_FBO_RGBA8));
    return 0;
}

static int counts_in_alpha(const gn_scene *s)
{
    return !is_small(s) && can(s, GN_CAN_ALPHA) && s->target.alpha_bits >= LEAST_ALPHA;
}

/* Whether a texture can bring masks to the host. */
static int reaches_host(const gn_scene *s, const char *name, gni_text *why)
{
    if (!s->reads_masks) {
        gni_put(why, "%s makes its mask in a texture, which the host does not read", name);
        return 0;
    }
    if (s->blend_once) {
        gni_put(why, "%s makes its mask in a texture, under which coincident surfaces cannot be lit once", name);
        return 0;
    }
    return 1;
}

static int can_have_image(const gn_scene *s, const char *name, gni_text *why)
{
    if (find_count_format(s) == GN_FORMAT_NONE) {
        gni_put(why, "%s needs framebuffer objects: %s %s", name, gn_capability_name(GN_CAN_FBO_RGBA8),
                gni_why_not(&s->target, GN_CAN_FBO_RGBA8));
        return 0;
    }
    if (!shares_depth(s) && s->target.image_depth_bits == 0) {
        gni_put(why, "%s needs a depth buffer in framebuffer objects (0 bits)", name);
        return 0;
    }
    return can_carry_depth(s, name, why) && reaches_host(s, name, why);
}

int gni_color_is_possible(const gn_scene *s, gn_method method, gni_text *why)
{
    const gn_target *t = &s->target;
    const int least = t->red_bits < t->blue_bits ? t->red_bits : t->blue_bits;

    switch (method) {
    case GN_METHOD_COUNT:
        return can_have_image(s, "count", why);
    case GN_METHOD_SIGNED:
        return counts_in_alpha(s) || can_have_image(s, "signed", why);
    case GN_METHOD_ALPHA:
        if (is_small(s)) /* in an image */
            return can_have_image(s, "alpha", why);
        if (!counts_in_alpha(s))
            gni_put(why, "alpha needs %d bits of alpha (%d)", LEAST_ALPHA, t->alpha_bits);
        return counts_in_alpha(s);
    default:
        if (least < LEAST_COLOR)
            gni_put(why, "screen needs %d bits of colour (%d)", LEAST_COLOR, least);
        if (gni_carries_depth(s))
            gni_put(why, "screen has no room for depth in its masks: upsample by nearest or bilinear");
        return least >= LEAST_COLOR && !gni_carries_depth(s) && reaches_host(s, "screen", why);
    }
}

static int top_of(int bits)
{
    return (1 << (bits < 8 ? bits : 8)) - 1;
}

void gni_choose_channel(const gn_scene *s, gn_color_layout *layout, uint32_t channel)
{
    const gn_target *t = &s->target;
    const int bits = channel == 0 ? t->red_bits : channel == 1 ? t->green_bits : t->blue_bits;

    layout->top = layout->start = top_of(bits);
    layout->limit = bits < 8 ? bits : 8;
    layout->channels = 1u << channel;
}

/* What gles/fallback/color.c draws: signed subtracts, doubles up to the start, multiplies and doubles three times. */
static int count_quads(gn_method method, const gn_color_layout *layout)
{
    int doublings = 0;

    if (method != GN_METHOD_SIGNED)
        return layout->by_maximum ? 1 : 4;
    while (1 << doublings < layout->start)
        doublings++;
    return 1 + doublings + 1 + 3;
}

static void choose_levels(const gn_scene *s, gni_choice *choice)
{
    gn_color_layout *layout = &choice->color;
    const int bits = layout->place == GN_PLACE_ALPHA ? s->target.alpha_bits : bits_of(choice->image.format, 0);

    layout->channels = layout->place == GN_PLACE_ALPHA ? 8u : 15u;
    layout->top = top_of(bits);
    switch (choice->method) {
    case GN_METHOD_COUNT:
        layout->channels = 3;
        layout->other_top = top_of(bits_of(choice->image.format, 1));
        layout->limit = layout->top < layout->other_top ? layout->top : layout->other_top;
        break;
    case GN_METHOD_SIGNED:
        layout->start = (layout->top + 1) / 2;
        layout->limit = layout->start - 1; /* from 0, where a batch before found shadow, no sum looks lit */
        break;
    case GN_METHOD_ALPHA:
        layout->start = layout->top;
        layout->limit = bits < 8 ? bits : 8;
        layout->by_maximum = layout->place == GN_PLACE_ALPHA && s->shade == GN_SHADE_ATTENUATE &&
                             can(s, GN_CAN_BLEND_MINMAX) && choice->dimmed * layout->top + 0.5 >= (layout->top + 1) / 2;
        break;
    default:
        gni_choose_channel(s, layout, 0);
    }
    layout->quads = count_quads(choice->method, layout);
}

/* A depth buffer of the image's own, as near to the target's as there is. */
static int choose_depth(const gn_scene *s)
{
    return s->target.depth_bits > 16 && s->target.image_depth_bits > 16 ? 24 : 16;
}

void gni_choose_color(const gn_scene *s, gni_choice *choice)
{
    gn_color_layout *layout = &choice->color;

    choice->dimmed = find_dimmed(s);
    layout->place = choice->method == GN_METHOD_SCREEN                        ? GN_PLACE_COLOR
                    : choice->method != GN_METHOD_COUNT && counts_in_alpha(s) ? GN_PLACE_ALPHA
                                                                              : GN_PLACE_IMAGE;
    if (layout->place == GN_PLACE_IMAGE) {
        choice->image.format = find_count_format(s);
        choice->image.depth_bits = shares_depth(s) ? 0 : choose_depth(s);
    }
    choose_levels(s, choice);
    layout->both_sides = choice->method == GN_METHOD_COUNT && !s->one_sided && can(s, GN_CAN_FRONT_FACING);
    layout->discard = !layout->both_sides && can(s, GN_CAN_FRONT_FACING);
    if (!can(s, GN_CAN_FRONT_FACING))
        gni_put(&choice->text, "; culled, which may lose slivers, since %s %s", gn_capability_name(GN_CAN_FRONT_FACING),
                gni_why_not(&s->target, GN_CAN_FRONT_FACING));
}

uint32_t gni_color_limit(const gn_scene *s, gn_method method)
{
    gni_choice choice;

    memset(&choice, 0, sizeof choice);
    gni_start_text(&choice.text, NULL, 0);
    choice.method = method;
    gni_choose_color(s, &choice);
    return choice.color.limit > 0 ? (uint32_t)choice.color.limit : 1; /* 0: it will be refused */
}

/* An image of depth and stencil, and a host that reads masks. */
static int can_have_stencil_image(const gn_scene *s)
{
    return s->reads_masks && !s->blend_once && s->target.depth_bits >= 24 && can(s, GN_CAN_PACKED_DEPTH_STENCIL) &&
           (can(s, GN_CAN_FBO_RGBA4) || can(s, GN_CAN_FBO_RGBA8));
}

int gni_stencil_is_possible(const gn_scene *s, const char *name, gni_text *why)
{
    if (is_small(s) && !can_have_stencil_image(s))
        gni_put(why,
                "%s at scale %lu needs packed-depth-stencil, 24 bits of depth (%d) and a host that reads masks from a "
                "texture",
                name, (unsigned long)s->scale, s->target.depth_bits);
    return !is_small(s) || (can_have_stencil_image(s) && can_carry_depth(s, name, why));
}

static int keeps_masks(const gn_scene *s)
{
    return GNI_HAS_CACHE && gni_keeps_masks(s);
}

static int may_take_stencil_to_texture(const gn_scene *s, const gni_choice *choice)
{
    const int adds_several = s->light_count > 1 && s->lights_per_pass != 1 && !(s->without & GN_MEASURE_MASKS);

    return choice->method == GN_METHOD_STENCIL && (adds_several || keeps_masks(s)) && can_have_stencil_image(s);
}

/* Pixels that the lights reach, together; counts those that reach any. */
static double find_areas(const gn_scene *s, uint32_t *count)
{
    static const double identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    static const float no_centre[3] = {0, 0, 0};
    double view[16], sum = 0.0;

    gni_model_view(view, &s->camera, identity, no_centre);
    for (uint32_t i = 0; i < s->light_count; i++) {
        double light[4];
        gni_bounds bounds;

        gni_light_in_view(&s->camera, &s->lights[i], light);
        gni_find_bounds(&bounds, s, i, light, view);
        if (bounds.skip != GN_SKIP_NOT)
            continue;
        (*count)++;
        sum += (double)bounds.scissor[2] * bounds.scissor[3];
    }
    return sum;
}

/* Stencil counts in an image whose colour is the mask. Cheaper, by the bytes of traffic.c: a pass of depth, clears, and
 * each light resolved, against a pass that blends for each light and not for several. */
static int takes_stencil_to_texture(const gn_scene *s, const gni_choice *choice)
{
    const double color = s->target.red_bits + s->target.green_bits + s->target.blue_bits > 16 ? 4.0 : 2.0, depth = 4.0;
    const double mask = can(s, GN_CAN_FBO_RGBA4) ? 2.0 : 4.0, whole = (double)s->target.width * s->target.height;
    uint32_t count = 0, group = s->lights_per_pass ? s->lights_per_pass : GN_MOST_MASKED;
    double areas, passes;

    if (!may_take_stencil_to_texture(s, choice) || s->merges_lights || keeps_masks(s))
        return may_take_stencil_to_texture(s, choice);
    areas = find_areas(s, &count);
    passes = (count + group - 1) / group;
    return WORTH * (whole * (3.0 * depth + 2.0 * mask + passes * (2.0 * color + depth + mask)) + areas * 2.0 * mask) <
           areas * (2.0 * color + depth);
}

/* Depth in the first texture; in the others two masks, and where that depth is cut through. */
static void choose_refined(const gn_scene *s, gni_choice *choice)
{
    choice->image.format = choice->mask_format = GN_FORMAT_RGBA8;
    choice->image.depth_bits = 24;
    choice->image.stencil_bits = 8;
    choice->lights_per_mask = 2;
    gni_put(&choice->text, "; counted at full size where a mask at scale 1/%lu is contested", (unsigned long)s->scale);
}

void gni_choose_masks(const gn_scene *s, gni_choice *choice)
{
    uint32_t most = GN_MOST_MASKED;

    choice->dimmed = find_dimmed(s);
    choice->lights_per_mask = 1;
    if (choice->is_refined)
        choose_refined(s, choice);
    else if (choice->color.place == GN_PLACE_STENCIL && (is_small(s) || takes_stencil_to_texture(s, choice))) {
        choice->image.format = choice->mask_format =
            can(s, GN_CAN_FBO_RGBA4) && !gni_carries_depth(s) ? GN_FORMAT_RGBA4 : GN_FORMAT_RGBA8;
        choice->image.depth_bits = 24;
        choice->image.stencil_bits = 8;
        if (keeps_masks(s))
            gni_put(&choice->text, "; masks are made in a texture, to be kept");
        else if (!is_small(s))
            gni_put(&choice->text, "; masks are made in a texture, so that one pass adds several lights");
    } else if (choice->color.place == GN_PLACE_IMAGE) {
        choice->mask_format = gni_carries_depth(s) ? GN_FORMAT_RGBA8 : find_mask_format(s);
    } else if (choice->color.place == GN_PLACE_COLOR) {
        choice->mask_format = GN_FORMAT_RGB565;
    }
    choice->mask = choice->is_refined                      ? GN_MASK_STENCIL
                   : choice->mask_format != GN_FORMAT_NONE ? GN_MASK_TEXTURE
                   : choice->color.place == GN_PLACE_ALPHA ? GN_MASK_ALPHA
                                                           : GN_MASK_STENCIL;
    if (is_small(s) && !choice->is_refined)
        gni_put(&choice->text, "; masks at scale 1/%lu, as asked for: not exact", (unsigned long)s->scale);
    if (choice->mask != GN_MASK_TEXTURE) {
        if (keeps_masks(s))
            gni_put(&choice->text, "; masks are made in each frame, being no textures that the host reads");
        return;
    }
    if (bits_of(choice->mask_format, 3) == 0)
        most = 3;
    if (gni_carries_depth(s)) /* in blue and alpha */
        most = 2;
    choice->lights_per_mask = s->lights_per_pass && s->lights_per_pass < most ? s->lights_per_pass : most;
}
