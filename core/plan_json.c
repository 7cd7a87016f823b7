/* plan_json.c - a plan as JSON, for people, for tools and for comparing two plans. Written like snprintf: it may be
 * called with no room to learn the length. */
#include "gni.h"

#include <math.h>

static void put_number(gni_text *w, double value) /* JSON has no infinity */
{
    if (isfinite(value))
        gni_put(w, "%.17g", value);
    else
        gni_put(w, "null");
}

static void put_plane(gni_text *w, const double plane[4])
{
    for (int i = 0; i < 4; i++) {
        gni_put(w, "%s", i ? ", " : "[");
        put_number(w, plane[i]);
    }
    gni_put(w, "]");
}

static void put_rectangle(gni_text *w, const uint32_t at[4])
{
    gni_put(w, "[%lu, %lu, %lu, %lu]", (unsigned long)at[0], (unsigned long)at[1], (unsigned long)at[2],
            (unsigned long)at[3]);
}

static void put_record(gni_text *w, const gn_record *r)
{
    static const char *const names[] = {"sides", "light cap", "dark cap", "near cap"};
    static const char *const far_ends[] = {"infinite", "clamped", "ended"};
    const char *separator = "";

    gni_put(w, "\n  {\"light\": %lu, \"object\": %lu, \"chunk\": %lu, \"parts\": [", (unsigned long)r->light,
            (unsigned long)r->object, (unsigned long)r->chunk);
    for (int part = 0; part < 4; part++)
        if (r->parts >> part & 1) {
            gni_put(w, "%s\"%s\"", separator, names[part]);
            separator = ", ";
        }
    gni_put(
        w,
        "], \"first_index\": %lu, \"indices\": {\"sides\": %lu, \"dark_cap\": %lu, \"light_cap\": %lu, \"turned_cap\": "
        "%lu, \"near_cap\": %lu},",
        (unsigned long)r->first_index, (unsigned long)r->side_count, (unsigned long)r->dark_cap_count,
        (unsigned long)r->light_cap_count, (unsigned long)r->turned_cap_count, (unsigned long)r->near_cap_count);
    gni_put(w, " \"fan\": %s, \"case\": %d, \"mirrored\": %s, \"far_end\": \"%s\", \"end_plane\": ",
            r->fan ? "true" : "false", r->mcguire_case, r->mirrored ? "true" : "false", far_ends[r->far_end]);
    put_plane(w, r->end_plane);
    gni_put(w, ", \"start_plane\": ");
    put_plane(w, r->start_plane);
    gni_put(w, ", \"end_reach\": ");
    put_number(w, r->end_reach);
    gni_put(w, ", \"cached\": %s", r->is_cached ? "true" : "false");
    gni_put(w, ", \"slivers\": %s, \"patch\": %lu, \"unpatched\": %s, \"thin\": %s, \"scissor\": ",
            r->slivers ? "true" : "false", (unsigned long)r->patch, r->unpatched ? "true" : "false",
            r->thin ? "true" : "false");
    put_rectangle(w, r->scissor);
    gni_put(w, "}");
}

static void put_step(gni_text *w, const gn_step *s)
{
    static const char *const kinds[GN_STEP_KIND_COUNT] = {
        "clear",      "zero",        "volumes", "draw",      "fold", "mark",  "refine", "darken", "clear image",
        "clear mask", "clear color", "resolve", "normalise", "copy", "shade", "opaque", "discard"};
    static const char *const draws[GN_DRAW_COUNT] = {"nothing", "ambient", "light", "final", "depth", "lit"};
    static const char *const intos[] = {"target", "image", "mask", "corner"};

    gni_put(w, "\n  {\"step\": \"%s\", \"into\": \"%s\"", kinds[s->kind], intos[s->into]);
    if (s->kind == GN_STEP_DRAW)
        gni_put(w, ", \"draw\": \"%s\"", draws[s->draw]);
    if (s->light_count) {
        gni_put(w, ", \"lights\": [");
        for (uint32_t i = 0; i < s->light_count; i++)
            gni_put(w, "%s%lu", i ? ", " : "", (unsigned long)s->lights[i]);
        gni_put(w, "]");
    } else if (s->light != GN_NO_LIGHT) {
        gni_put(w, ", \"light\": %lu", (unsigned long)s->light);
    }
    if (s->into == GN_INTO_MASK || s->kind == GN_STEP_COPY || s->kind == GN_STEP_SHADE || s->draw == GN_DRAW_LIGHT)
        gni_put(w, ", \"mask\": %lu", (unsigned long)s->mask);
    if (s->draw == GN_DRAW_LIGHT)
        gni_put(w, ", \"receivers\": %s", s->receivers ? "true" : "false");
    if (s->kind == GN_STEP_VOLUMES)
        gni_put(w, ", \"first_record\": %lu, \"records\": %lu", (unsigned long)s->first_record,
                (unsigned long)s->record_count);
    if (s->kind == GN_STEP_DARKEN)
        gni_put(w, ", \"patch\": %lu", (unsigned long)s->patch);
    gni_put(w, "}");
}

static void put_caster(gni_text *w, const gn_plan *plan, uint32_t light, uint32_t object)
{
    const gn_plan_caster *c = &plan->casters[(size_t)light * plan->object_count + object];

    gni_put(w, "%s{\"skip\": \"%s\", \"case\": %d, \"patches\": %d, \"lit\": %s}", object ? ", " : "",
            gni_skip_name((gn_skip)c->skip), c->mcguire_case, c->patches, c->is_lit ? "true" : "false");
}

/* Of a light that is counted in colour. */
static void put_color(gni_text *w, const gn_plan_light *l)
{
    static const char *const places[] = {"stencil", "alpha", "color", "image"};
    const gn_color_layout *c = &l->color;

    gni_put(w,
            ",\n   \"color\": {\"place\": \"%s\", \"both_sides\": %s, \"discard\": %s, \"levels\": %d, \"start\": %d, "
            "\"limit\": %d, \"channels\": %u, \"by_maximum\": %s}, \"fragments\": %lu",
            places[c->place], c->both_sides ? "true" : "false", c->discard ? "true" : "false", c->top, c->start,
            c->limit, c->channels, c->by_maximum ? "true" : "false", (unsigned long)l->fragments);
}

static void put_traffic(gni_text *w, const gn_traffic *t)
{
    gni_put(w,
            " \"traffic_bytes_estimated\": {\"target_color\": %.0f, \"target_depth\": %.0f, \"image_color\": %.0f, "
            "\"image_depth\": %.0f, \"masks\": %.0f, \"written\": %.0f, \"read\": %.0f},\n",
            t->target_color, t->target_depth, t->image_color, t->image_depth, t->masks, t->written, t->read);
}

static void put_light(gni_text *w, const gn_plan *plan, uint32_t light)
{
    const gn_plan_light *l = &plan->lights[light];
    const gn_stencil_layout *s = &l->stencil;

    gni_put(w, "%s\n  {\"method\": \"%s\", \"reason\": \"%s\", \"skip\": \"%s\", \"reach\": ", light ? "," : "",
            gn_plan_method_name(plan, light), l->reason, gni_skip_name(l->skip));
    put_number(w, l->reach);
    gni_put(w, ", \"scissor\": ");
    put_rectangle(w, l->scissor);
    gni_put(w, ", \"depth_bounds\": [");
    put_number(w, l->depth_bounds[0]);
    gni_put(w, ", ");
    put_number(w, l->depth_bounds[1]);
    gni_put(w, "], \"caster_error\": ");
    put_number(w, l->caster_error);
    gni_put(w, ", \"light_moved\": ");
    put_number(w, l->light_moved);
    gni_put(w, ", \"possible_error\": ");
    put_number(w, l->possible_error);
    gni_put(
        w,
        ",\n   \"stencil\": {\"two_sided\": %s, \"discard\": %s, \"wrap\": %s, \"reference\": %d, \"range\": [%d, %d], "
        "\"bits\": %d, \"flag\": %d, \"patch_bits\": %d}",
        s->two_sided ? "true" : "false", s->discard ? "true" : "false", s->wrap ? "true" : "false", s->reference,
        s->low, s->high, s->bits, s->flag, s->patch_bits);
    if (l->color.place != GN_PLACE_STENCIL)
        put_color(w, l);
    gni_put(w, ",\n  ");
    if (plan->mask == GN_MASK_TEXTURE)
        gni_put(w, " \"mask_texture\": %lu, \"mask_channel\": %lu,", (unsigned long)l->mask_texture,
                (unsigned long)l->mask_channel);
    gni_put(w,
            " \"layers\": %lu, \"batches\": %lu, \"cut_casters\": %lu,\n   \"casters\": %lu, \"skipped_casters\": %lu, "
            "\"case1\": %lu, "
            "\"case2\": %lu, \"case3\": %lu, \"objects\": [",
            (unsigned long)l->layers, (unsigned long)l->batches, (unsigned long)l->cut_casters,
            (unsigned long)l->casters, (unsigned long)l->skipped_casters, (unsigned long)l->cases[0],
            (unsigned long)l->cases[1], (unsigned long)l->cases[2]);
    for (uint32_t o = 0; o < plan->object_count; o++)
        put_caster(w, plan, light, o);
    gni_put(w, "]}");
}

static void put_warnings(gni_text *w, const gn_plan *plan)
{
    const char *separator = "";

    gni_put(w, " \"warnings\": [");
    for (int i = 0; i < GN_WARNING_COUNT; i++) {
        char text[256];

        if (gn_plan_explain_warning(plan, (gn_warning)i, text, sizeof text)) {
            gni_put(w, "%s\"%s\"", separator, text);
            separator = ", ";
        }
    }
    gni_put(w, "],\n");
}

static void put_masks(gni_text *w, const gn_plan *plan)
{
    static const char *const masks[] = {"stencil", "alpha", "texture"};
    static const char *const shades[] = {"additive", "attenuate", "black"};
    static const char *const upsamples[] = {"nearest", "bilinear", "depth"};
    static const char *const formats[] = {"none", "rgba8", "rgba4", "rgb5a1", "rgb565"};

    gni_put(w,
            " \"mask\": \"%s\", \"shade\": \"%s\", \"dimmed\": %g, \"mask_format\": \"%s\", \"mask_textures\": %lu, "
            "\"mask_age\": %lu, \"scale\": %lu, \"upsample\": \"%s\", \"sharpen\": %s, \"mask_size\": [%lu, %lu],\n"
            " \"image\": {\"format\": \"%s\", \"depth_bits\": %d, \"stencil_bits\": %d},\n",
            masks[plan->mask], shades[plan->shade], plan->dimmed, formats[plan->mask_format],
            (unsigned long)plan->mask_count, (unsigned long)plan->mask_age, (unsigned long)plan->scale,
            upsamples[plan->upsample], plan->sharpen ? "true" : "false", (unsigned long)plan->mask_size[0],
            (unsigned long)plan->mask_size[1], formats[plan->image.format], plan->image.depth_bits,
            plan->image.stencil_bits);
}

size_t gn_plan_json(const gn_plan *plan, char *text, size_t capacity)
{
    gni_text w;

    gni_start_text(&w, text, capacity);
    if (!plan)
        return 0;
    gni_put(&w, "{\"target\": {\"width\": %lu, \"height\": %lu, \"depth_bits\": %d, \"stencil_bits\": %d},\n",
            (unsigned long)plan->target.width, (unsigned long)plan->target.height, plan->target.depth_bits,
            plan->target.stencil_bits);
    put_warnings(&w, plan);
    put_masks(&w, plan);
    put_traffic(&w, &plan->traffic);
    gni_put(&w, " \"blend_once\": %s, \"clear_depth\": ", plan->blend_once ? "true" : "false");
    put_number(&w, plan->clear_depth);
    gni_put(&w, ", \"depth_range\": [");
    put_number(&w, plan->depth_range[0]);
    gni_put(&w, ", ");
    put_number(&w, plan->depth_range[1]);
    gni_put(&w, "], \"depth_limit\": ");
    put_number(&w, plan->depth_limit);
    gni_put(&w, ", \"deepest_receiver\": ");
    put_number(&w, plan->deepest_receiver);
    gni_put(&w, ", \"farthest_vertex\": ");
    put_number(&w, plan->farthest_vertex);
    gni_put(&w, ", \"patches\": [");
    for (uint32_t p = 0; p < plan->patch_count; p++) {
        gni_put(&w, "%s", p ? ", " : "");
        put_plane(&w, plan->patches[p]);
    }
    gni_put(&w,
            "], \"indices\": %lu, \"cached_indices\": %lu, \"streams_built\": %lu, \"endless_casters\": %lu,\n "
            "\"lights\": [",
            (unsigned long)plan->index_count, (unsigned long)plan->cached_index_count, (unsigned long)plan->cache_built,
            (unsigned long)plan->endless_casters);
    for (uint32_t i = 0; i < plan->light_count; i++)
        put_light(&w, plan, i);
    gni_put(&w, "],\n \"steps\": [");
    for (uint32_t i = 0; i < plan->step_count; i++) {
        gni_put(&w, "%s", i ? "," : "");
        put_step(&w, &plan->steps[i]);
    }
    gni_put(&w, "],\n \"records\": [");
    for (uint32_t i = 0; i < plan->record_count; i++) {
        gni_put(&w, "%s", i ? "," : "");
        put_record(&w, &plan->records[i]);
    }
    gni_put(&w, "]}\n");
    return w.length;
}
