/* color.c - volumes counted in colour by blending, for want of a stencil (Roettger 2002, section 4.2; DESIGN.md, decision
 * 11). What the levels mean is in core/choose_color.c; the plan says that they suffice.
 *
 * z-pass counts what lies before the visible surface, z-fail what lies behind it, by the reversed depth test: exactly
 * what the stencil counts (stencil.c has which side counts up, and why volumes are one step of depth farther away).
 *
 * Quads take levels back to full and none. Halved levels: inverted, doubled twice, inverted: what is half or less
 * becomes 0, what is full stays. Signed ones: less all but one of the start, lit is 1; doubled until that is the middle m,
 * everything else being 0 or full; times 1 - itself, which leaves m (1 - m) of the middle alone; and doubled until that is
 * full. */
#include "../gni_gles.h"

enum { COLOR = 7, ALPHA = 8 }; /* channels */

static void fill_color(float color[4], float value)
{
    for (int i = 0; i < 4; i++)
        color[i] = value;
}

static gni_state writes(unsigned channels, GLenum source, GLenum destination, GLenum equation)
{
    const gni_state s = {.color_mask = channels,
                         .blend_source = source,
                         .blend_destination = destination,
                         .blend_equation = equation,
                         .undithered = 1};

    return s;
}

static void quad(gn_gles *g, const gn_step *step, gni_state state, float value)
{
    float color[4];

    fill_color(color, value);
    gni_fill_quad(g, step, state, color);
}

/* How much one fragment adds, or the factor that halves. */
static float step_of(const gn_color_layout *layout)
{
    return 1.0f / (float)layout->top;
}

static float half_of(const gn_color_layout *layout)
{
    return (float)((layout->top + 1) / 2) / (float)layout->top;
}

/* What a draw does to the levels of the pixels that it covers. */
static gni_state counting(const gn_plan *plan, const gn_record *r, gni_half half)
{
    const gn_plan_light *l = &plan->lights[r->light];
    const int is_zfail = r->mcguire_case > 1;
    gni_state s = writes(l->color.channels, GL_ONE, GL_ONE, 0);

    if (l->method == GN_METHOD_SIGNED && half == GNI_FALLING)
        s.blend_equation = GL_FUNC_REVERSE_SUBTRACT;
    if (l->method == GN_METHOD_ALPHA || l->method == GN_METHOD_SCREEN) {
        s.blend_source = half == GNI_RISING ? GL_ZERO : GL_DST_COLOR;
        s.blend_destination = half == GNI_RISING ? GL_SRC_COLOR : GL_ONE;
    }
    s.depth_func = is_zfail ? GL_GEQUAL : GL_LESS;
    s.offset = 1;
    s.clamp = r->far_end == GN_FAR_CLAMPED;
    gni_bound(&s, plan, l, r->scissor);
    return s;
}

/* The colour that counts a fragment. */
static void color_for(const gn_plan_light *l, gni_half half, float color[4])
{
    const gn_color_layout *layout = &l->color;

    switch (l->method) {
    case GN_METHOD_COUNT:
        fill_color(color, 0.0f);
        if (half == GNI_RISING)
            color[0] = step_of(layout);
        else
            color[1] = 1.0f / (float)layout->other_top;
        break;
    case GN_METHOD_SIGNED:
        fill_color(color, step_of(layout));
        break;
    default:
        fill_color(color, half == GNI_RISING ? half_of(layout) : 1.0f);
    }
}

static void set_colors(gn_gles *g, const gn_plan_light *l, const gn_record *r, int turned, gni_half half)
{
    const gni_program *program = g->in_use;
    const int backs_rise = gni_backs_rise(r, turned);
    float front[4], back[4];

    if (l->color.both_sides) {
        color_for(l, backs_rise ? GNI_FALLING : GNI_RISING, front);
        color_for(l, backs_rise ? GNI_RISING : GNI_FALLING, back);
        g->gl.glUniform4fv(program->color, 1, front);
        g->gl.glUniform4fv(program->back, 1, back);
        return;
    }
    color_for(l, half, front);
    g->gl.glUniform4fv(program->color, 1, front);
    if (l->color.discard)
        g->gl.glUniform1f(program->side, gni_shows_backs(r, turned, half) ? -1.0f : 1.0f);
}

static void count_records(gn_gles *g, uint32_t first, uint32_t end, gni_half half)
{
    for (uint32_t i = first; i < end; i++)
        for (int turned = 0; turned < 2; turned++) {
            const gn_record *r = &g->plan->records[i];
            const gn_plan_light *l = &g->plan->lights[r->light];
            gni_state state;

            if (turned && !r->turned_cap_count)
                continue;
            state = counting(g->plan, r, half);
            if (!l->color.both_sides && !l->color.discard)
                state.cull = gni_shows_backs(r, turned, half) ? GL_FRONT : GL_BACK;
            gni_set_state(g, &state);
            set_colors(g, l, r, turned, half);
            gni_draw_record(g, g->plan, r, turned);
        }
}

static void count_volumes(gn_gles *g, const gn_step *step)
{
    const gn_color_layout *layout = &g->plan->lights[step->light].color;

    gni_begin_volumes(g, layout->both_sides ? &g->faced : layout->discard ? &g->sided_color : &g->colored);
    gni_count_casters(g, step, layout->both_sides, count_records);
    gni_end_volumes(g);
}

static void invert(gn_gles *g, const gn_step *step, unsigned channels)
{
    quad(g, step, writes(channels, GL_ONE_MINUS_DST_COLOR, GL_ZERO, 0), 1.0f);
}

static void double_levels(gn_gles *g, const gn_step *step, unsigned channels, int times)
{
    for (int i = 0; i < times; i++)
        quad(g, step, writes(channels, GL_DST_COLOR, GL_ONE, 0), 1.0f);
}

static void normalise_signed(gn_gles *g, const gn_step *step, const gn_color_layout *layout)
{
    int doublings = 0;

    while (1 << doublings < layout->start)
        doublings++;
    quad(g, step, writes(layout->channels, GL_ONE, GL_ONE, GL_FUNC_REVERSE_SUBTRACT),
         (float)(layout->start - 1) * step_of(layout));
    double_levels(g, step, layout->channels, doublings);
    quad(g, step, writes(layout->channels, GL_ZERO, GL_ONE_MINUS_DST_COLOR, 0), 0.0f);
    double_levels(g, step, layout->channels, 3);
}

static void normalise(gn_gles *g, const gn_step *step, const gn_plan_light *l, unsigned channels)
{
    if (l->method == GN_METHOD_SIGNED) {
        normalise_signed(g, step, &l->color);
        return;
    }
    invert(g, step, channels);
    double_levels(g, step, channels, 2);
    invert(g, step, channels);
}

/* What is in shadow becomes 0, and stays there; what is lit starts again. */
static void fold(gn_gles *g, const gn_step *step, const gn_plan_light *l)
{
    const gn_color_layout *layout = &l->color;

    normalise(g, step, l, layout->channels);
    if (l->method == GN_METHOD_SIGNED)
        quad(g, step, writes(layout->channels, GL_ZERO, GL_SRC_COLOR, 0), (float)layout->start * step_of(layout));
}

static const gn_plan_light *first_counted(const gn_plan *plan)
{
    uint32_t i = 0;

    while (i + 1 < plan->light_count && plan->lights[i].skip != GN_SKIP_NOT)
        i++;
    return &plan->lights[i];
}

void gni_color_step(gn_gles *g, const gn_step *step)
{
    gn_step everywhere = *step;
    const gn_plan_light *l = step->light == GN_NO_LIGHT ? first_counted(g->plan) : &g->plan->lights[step->light];

    switch (step->kind) {
    case GN_STEP_ZERO:
        if (l->color.place == GN_PLACE_COLOR) /* all of a texture is copied */
            everywhere.light = GN_NO_LIGHT;
        quad(g, &everywhere, writes(l->color.channels, 0, 0, 0), (float)l->color.start * step_of(&l->color));
        break;
    case GN_STEP_FOLD:
        fold(g, step, l);
        break;
    case GN_STEP_NORMALISE:
        if (l->color.by_maximum)
            quad(g, step, writes(l->color.channels, GL_ONE, GL_ONE, GNI_MAX), (float)g->plan->dimmed);
        else
            normalise(g, step, l, step->light == GN_NO_LIGHT ? COLOR : l->color.channels);
        break;
    case GN_STEP_OPAQUE:
        quad(g, step, writes(ALPHA, 0, 0, 0), 1.0f);
        break;
    default:
        count_volumes(g, step);
    }
}

int gni_make_color_programs(gn_gles *g, const gn_plan *plan)
{
    int faced = 0, sided = 0;

    for (uint32_t i = 0; i < plan->light_count; i++) {
        faced |= plan->lights[i].color.both_sides;
        sided |= plan->lights[i].color.discard;
    }
    return (!faced || g->faced.name ||
            gni_make_flat_program(g, &g->faced, "counted in two channels", "#define FACED\n")) &&
           (!sided || g->sided_color.name ||
            gni_make_flat_program(g, &g->sided_color, "one side of volumes in colour", "#define SIDED\n"));
}
