/* proof_blending.c - alpha as a factor; adding and subtracting by single steps; MIN and MAX; doubling and halving.
 *
 * Counts without a stencil rest on these (Roettger 2002, and DESIGN.md, decision 11), each over every level that the
 * target's red has: a ramp is drawn, blended, and read. */
#include "proofs.h"

static int top_level(const gni_proofs *p)
{
    return (1 << (p->target->red_bits < 8 ? p->target->red_bits : 8)) - 1;
}

/* The level that the ramp has at a pixel of the cell, and the one that is there now. */
static int ramp_level(const gni_proofs *p, int x, int y)
{
    return (x + CELL * y) & top_level(p);
}

static int channel_level(const gni_proofs *p, int x, int y, int channel)
{
    return (p->pixels[4 * (p->width * y + x) + channel] * top_level(p) + 127) / 255;
}

/* Alpha is counted in as red is, where it has as many bits: -1 where the two went different ways. */
static int level_at(const gni_proofs *p, int x, int y)
{
    const int red = channel_level(p, x, y, 0);

    return p->target->alpha_bits != p->target->red_bits || channel_level(p, x, y, 3) == red ? red : -1;
}

/* The bits of a level one by one, added to the pixels whose number has them. No shader does it: one that reads
 * gl_FragCoord costs the drivers of processors more than all other proofs of blending. */
static void draw_ramp(gni_proofs *p)
{
    const int top = top_level(p);

    p->gl->glEnable(GL_BLEND);
    p->gl->glBlendFunc(GL_ONE, GL_ONE);
    for (int bit = 1; bit <= top; bit *= 2) {
        const float value = (float)bit / (float)top, color[4] = {value, value, value, value};
        const int length = bit < CELL ? bit : bit / CELL; /* of a run of columns, or of rows */

        for (int at = length; at < CELL; at += 2 * length)
            if (bit < CELL)
                gni_draw_rectangle(p, at, 0, length, CELL, 0.0f, 0, color);
            else
                gni_draw_rectangle(p, 0, at, CELL, length, 0.0f, 0, color);
    }
    p->gl->glDisable(GL_BLEND);
}

static void blend(gni_proofs *p, GLenum equation, GLenum source, GLenum destination, int level)
{
    const float value = (float)level / (float)top_level(p), color[4] = {value, value, value, value};

    p->gl->glEnable(GL_BLEND);
    p->gl->glBlendEquation(equation);
    p->gl->glBlendFunc(source, destination);
    gni_draw_rectangle(p, 0, 0, CELL, CELL, 0.0f, 0, color);
    p->gl->glDisable(GL_BLEND);
}

static int levels_are(gni_proofs *p, int (*wanted)(int level, int top), const char *what)
{
    for (int y = 0; y < p->height; y++)
        for (int x = 0; x < p->width; x++) {
            const int level = ramp_level(p, x, y), right = wanted(level, top_level(p)), got = level_at(p, x, y);

            if (got != right)
                return gni_failed(p, "%s level %d gave %d, not %d", what, level, got, right);
        }
    return 1;
}

#define REVERSE_SUBTRACT 0x800B /* GL_FUNC_REVERSE_SUBTRACT */

static void draw_steps(gni_proofs *p)
{
    draw_ramp(p);
    blend(p, REVERSE_SUBTRACT, GL_ONE, GL_ONE, 1);
    blend(p, GL_FUNC_ADD, GL_ONE, GL_ONE, 2);
    blend(p, REVERSE_SUBTRACT, GL_ONE, GL_ONE, 2);
}

static int stepped(int level, int top) /* clamped at both ends */
{
    const int less = level > 0 ? level - 1 : 0, more = less + 2 < top ? less + 2 : top;

    return more - 2;
}

static int steps(gni_proofs *p)
{
    return levels_are(p, stepped, "-1 +2 -2:");
}

#define BLEND_MIN 0x8007 /* GL_MIN_EXT */
#define BLEND_MAX 0x8008 /* GL_MAX_EXT */

static void draw_limits(gni_proofs *p)
{
    draw_ramp(p);
    blend(p, BLEND_MAX, GL_ONE, GL_ONE, top_level(p) / 4);
    blend(p, BLEND_MIN, GL_ONE, GL_ONE, top_level(p) / 2);
}

static int limited(int level, int top)
{
    return level < top / 4 ? top / 4 : level > top / 2 ? top / 2 : level;
}

static int limits(gni_proofs *p)
{
    return levels_are(p, limited, "the largest with 1/4, then the smallest with 1/2:");
}

static int level_bits(const gni_proofs *p)
{
    return p->target->red_bits < 8 ? p->target->red_bits : 8;
}

static void blend_part(gni_proofs *p, int x, int height, GLenum source, GLenum destination, int level)
{
    const float value = (float)level / (float)top_level(p), color[4] = {value, value, value, value};

    p->gl->glBlendFunc(source, destination);
    gni_draw_rectangle(p, x, 0, CELL - x, height, 0.0f, 0, color);
}

/* From full: column i is halved i times, by 128/255 (16/31 ...), and the lower rows are doubled as often. */
static void draw_halves(gni_proofs *p)
{
    gni_draw_rectangle(p, 0, 0, CELL, CELL, 0.0f, 0, gni_white);
    p->gl->glEnable(GL_BLEND);
    for (int i = 1; i <= level_bits(p); i++)
        blend_part(p, i, CELL, GL_ZERO, GL_SRC_COLOR, (top_level(p) + 1) / 2);
    for (int i = 1; i <= level_bits(p); i++)
        blend_part(p, i, CELL / 2, GL_DST_COLOR, GL_ONE, top_level(p));
    p->gl->glDisable(GL_BLEND);
}

static int halves(gni_proofs *p)
{
    const int top = top_level(p), bits = level_bits(p);

    for (int y = 0; y < p->height; y++)
        for (int x = 0; x < p->width; x++) {
            const int times = x < bits ? x : bits, halved = times ? (top + 1) >> times : top;
            const int right = y < CELL / 2 ? top : halved, got = level_at(p, x, y);

            if (got != right)
                return gni_failed(p, "full halved %d times%s is %d, not %d", times,
                                  y < CELL / 2 ? " and doubled as often" : "", got, right);
        }
    return 1;
}

/* Left half alpha 0, right half alpha 1; then white times the alpha that is there, alpha left alone. */
static void draw_alpha(gni_proofs *p)
{
    static const float clear[4] = {0, 0, 0, 0}, opaque[4] = {0, 0, 0, 1};

    gni_draw_rectangle(p, 0, 0, 8, CELL, 0.0f, 0, clear);
    gni_draw_rectangle(p, 8, 0, 8, CELL, 0.0f, 0, opaque);
    p->gl->glEnable(GL_BLEND);
    p->gl->glBlendFuncSeparate(GL_DST_ALPHA, GL_ONE, GL_ZERO, GL_ONE);
    gni_draw_rectangle(p, 0, 0, CELL, CELL, 0.0f, 0, gni_white);
}

static int multiplies_by_alpha(gni_proofs *p)
{
    static const int dark[4] = {0, 0, 0, 0}, bright[4] = {255, 255, 255, 255};

    return gni_is_color(p, 0, 0, 8, CELL, dark, "white times alpha 0 is not 0") &&
           gni_is_color(p, 8, 0, 8, CELL, bright, "white times alpha 1 is not white");
}

const gni_cell_proof gni_proofs_of_blending[4] = {
    {GN_CAN_ALPHA, 0, draw_alpha, multiplies_by_alpha},
    {GN_CAN_BLEND_SUBTRACT, 0, draw_steps, steps},
    {GN_CAN_BLEND_MINMAX, 0, draw_limits, limits},
    {GN_CAN_BLEND_ROUNDING, 0, draw_halves, halves},
};
