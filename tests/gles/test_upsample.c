/* test_upsample.c - what a frame makes of masks at half its size: by depth nothing leaks across its edges, sharpened
 * edges are nearer to the truth, and half floats do as well. Against full masks, in scenes with edges of all kinds. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "gn_test.h"
#include "staged.h"

#define WIDTH  240
#define HEIGHT 180

static const char *const scenes[] = {"colours",   "torus_knot", "cube_point", "pile_of_8",
                                     "courtyard", "street",     "hall",       "slats"};
enum { SCENES = sizeof scenes / sizeof scenes[0] };

static staged drawn;

/* Where the first light reaches, as the frame shows it: 0 or 1. Row 0 on top. */
typedef struct picture {
    uint8_t lit[HEIGHT][WIDTH];
} picture;

static void draw_frame(const char *name, stage_wish wish, int casting)
{
    char message[SCENE_MESSAGE] = "";

    wish.method = GN_METHOD_COUNT;
    wish.casting = casting;
    wish.light_count = 1;
    wish.unbounded = 1;
    if (stage_plan(drawn.stage, &wish, message) != 0 || !stage_draw_mask(drawn.stage, 0, message))
        fail_msg("%s: %s", name, message);
    assert_int_equal(drawn.stage->gl->glGetError(), GL_NO_ERROR);
}

static void draw_of(const char *name, stage_wish wish, int casting, picture *out)
{
    static uint8_t rgba[4 * WIDTH * HEIGHT];

    draw_frame(name, wish, casting);
    assert_true(platform_read_back(drawn.stage->platform, rgba));
    for (size_t i = 0; i < (size_t)WIDTH * HEIGHT; i++)
        out->lit[i / WIDTH][i % WIDTH] = rgba[4 * i] > 127;
}

static void draw(const char *name, stage_wish wish, picture *out)
{
    draw_of(name, wish, 1, out);
}

/* The full mask, and the depth of each pixel: what masks of a frame twice as large carry. */
typedef struct truth {
    picture mask;
    double depth[HEIGHT][WIDTH];
    uint8_t near_edge[HEIGHT][WIDTH], near_border[HEIGHT][WIDTH]; /* of depth; of a shadow on the same surface */
} truth;

static void read_depth(const char *name, truth *t)
{
    const stage_wish wish = {.scale = 2, .upsample = GN_UPSAMPLE_DEPTH};
    uint8_t *rgba;

    staged_open(&drawn, name, 2 * WIDTH, 2 * HEIGHT);
    draw_frame(name, wish, 1);
    rgba = staged_read_mask(&drawn, 0);
    for (size_t i = 0; i < (size_t)WIDTH * HEIGHT; i++)
        t->depth[i / WIDTH][i % WIDTH] = rgba[4 * i + 2] / 255.0 + rgba[4 * i + 3] / 65025.0;
    free(rgba);
    staged_close(&drawn);
}

/* Depth is linear on the image of a plane: where it bends there is an edge. */
static int is_edge(const truth *t, int x, int y)
{
    const double at = t->depth[y][x];

    return fabs(t->depth[y][x - 1] + t->depth[y][x + 1] - 2.0 * at) > 0.02 * at ||
           fabs(t->depth[y - 1][x] + t->depth[y + 1][x] - 2.0 * at) > 0.02 * at;
}

/* By how much depth changes on the surface that a pixel shows, from one pixel to the next: the lesser way on each axis. */
static double slope_at(const truth *t, int x, int y)
{
    const double at = t->depth[y][x];

    return fmin(fabs(t->depth[y][x - 1] - at), fabs(t->depth[y][x + 1] - at)) +
           fmin(fabs(t->depth[y - 1][x] - at), fabs(t->depth[y + 1][x] - at));
}

static void classify(truth *t)
{
    memset(t->near_edge, 0, sizeof t->near_edge);
    memset(t->near_border, 0, sizeof t->near_border);
    for (int y = 3; y < HEIGHT - 3; y++)
        for (int x = 3; x < WIDTH - 3; x++) {
            const double alike = 0.0005 + 0.005 * t->depth[y][x] + 3.0 * slope_at(t, x, y);

            for (int dy = -2; dy <= 2; dy++)
                for (int dx = -2; dx <= 2; dx++) {
                    t->near_edge[y][x] |= (uint8_t)is_edge(t, x + dx, y + dy);
                    t->near_border[y][x] |= t->mask.lit[y + dy][x + dx] != t->mask.lit[y][x] &&
                                            fabs(t->depth[y + dy][x + dx] - t->depth[y][x]) < alike;
                }
        }
}

typedef struct errors {
    size_t near_edge, leaked, elsewhere; /* leaked: near an edge, and near no border of a shadow on the same surface */
} errors;

static void add_errors(errors *e, const truth *t, const picture *p)
{
    for (int y = 3; y < HEIGHT - 3; y++)
        for (int x = 3; x < WIDTH - 3; x++) {
            const int wrong = p->lit[y][x] != t->mask.lit[y][x];

            *(t->near_edge[y][x] ? &e->near_edge : &e->elsewhere) += (size_t)wrong;
            e->leaked += wrong && t->near_edge[y][x] && !t->near_border[y][x];
        }
}

/* ---- gn_mask() as half floats compute it, line by line (gn_glsl.h) ---- */

static double half(double v)
{
    int exponent;

    if (v == 0.0)
        return 0.0;
    frexp(v, &exponent);
    exponent = exponent < -13 ? -13 : exponent; /* denormals */
    return ldexp(nearbyint(ldexp(v, 11 - exponent)), exponent - 11);
}

/* What a mask carries of a depth: gn_mask_depth_color(), in bytes, read again. */
static double half_texel(double own)
{
    const double steps = half(255.0 * own), low = floor(steps);

    return half(nearbyint(255.0 * half(low / 255.0)) / 255.0 +
                half(half(nearbyint(255.0 * (steps - low)) / 255.0) / 255.0));
}

static double half_over_w(double depth)
{
    const double near_w = 1.7; /* any: what counts is that both are rounded */

    return half(fmin(half(near_w) / half(near_w / depth), 1.0));
}

/* small: the plan's mask, with the depth that floats gave it. */
static int half_mask(const uint8_t *small, double depth, int x, int y)
{
    static const double taps[4][2] = {{0.5, 0.1}, {-0.5, -0.1}, {-0.1, 0.5}, {0.1, -0.5}};
    const double own = half_over_w(depth), alike = half(half(0.004 * own) + half(0.0002));
    double off[4], mask[4], weight[4], sum = 0.0, mean = 0.0, lit = 0.0;

    for (int i = 0; i < 4; i++) {
        const double at[2] = {(x + 0.5) / 2.0 + taps[i][0], (y + 0.5) / 2.0 - taps[i][1]}; /* row 0 is on top */
        const uint8_t *texel = small + 4 * ((size_t)(WIDTH / 2) * (size_t)floor(at[1]) + (size_t)floor(at[0]));
        const double tap = half_texel(half_over_w(fmax(texel[2] / 255.0 + texel[3] / 65025.0, 1.0 / 65025.0)));

        mask[i] = texel[0] / 255.0;
        off[i] = half(fabs(half(tap - own)));
        mean = half(mean + half(0.25 * tap));
    }
    for (int i = 0; i < 4; i++) {
        weight[i] = half(0.25 / half(alike + off[i]));
        sum = half(sum + weight[i]);
    }
    for (int i = 0; i < 4; i++)
        lit = half(lit + half((half(fabs(half(mean - own))) < alike ? 0.25 : half(weight[i] / sum)) * mask[i]));
    return 255.0 * lit > 127.0;
}

static void draw_in_halves(const char *name, const truth *t, picture *out)
{
    const stage_wish by_depth = {.scale = 2, .upsample = GN_UPSAMPLE_DEPTH}, unshadowed = {.scale = 1};
    picture facing;
    uint8_t *small;

    draw_of(name, unshadowed, 0, &facing);
    draw(name, by_depth, out);
    small = staged_read_mask(&drawn, 0);
    for (int y = 3; y < HEIGHT - 3; y++)
        for (int x = 3; x < WIDTH - 3; x++)
            out->lit[y][x] = facing.lit[y][x] && half_mask(small, t->depth[y][x], x, y);
    free(small);
}

enum { BILINEAR, BY_DEPTH, SHARP, SHARP_BY_DEPTH, HALVES, EMULATED, WAYS };

/* Errors of each way, in all scenes together. */
static void measure(errors of[WAYS])
{
    static const stage_wish wishes[WAYS] = {
        [BILINEAR] = {.scale = 2, .upsample = GN_UPSAMPLE_BILINEAR},
        [BY_DEPTH] = {.scale = 2, .upsample = GN_UPSAMPLE_DEPTH},
        [SHARP] = {.scale = 2, .upsample = GN_UPSAMPLE_BILINEAR, .sharpen = 1},
        [SHARP_BY_DEPTH] = {.scale = 2, .upsample = GN_UPSAMPLE_DEPTH, .sharpen = 1},
        [HALVES] = {.scale = 2, .upsample = GN_UPSAMPLE_DEPTH},
    };
    static truth t;
    static picture p;

    memset(of, 0, WAYS * sizeof *of);
    for (int sc = 0; sc < SCENES; sc++) {
        const stage_wish full = {.scale = 1};

        read_depth(scenes[sc], &t);
        staged_open(&drawn, scenes[sc], WIDTH, HEIGHT);
        draw(scenes[sc], full, &t.mask);
        classify(&t);
        for (int way = 0; way < EMULATED; way++) {
            if (way == HALVES)
                drawn.stage->target.hidden |= 1u << GN_CAN_FRAGMENT_HIGHP;
            draw(scenes[sc], wishes[way], &p);
            add_errors(&of[way], &t, &p);
        }
        draw_in_halves(scenes[sc], &t, &p);
        add_errors(&of[EMULATED], &t, &p);
        staged_close(&drawn);
    }
}

static errors found[WAYS];

static int measure_once(void **state)
{
    (void)state;
    static const char *const names[WAYS] = {"bilinear", "depth",       "sharpened",
                                            "both",     "half floats", "half floats, emulated"};

    measure(found);
    for (int way = 0; way < WAYS; way++)
        print_message("           %s: %lu wrong near edges, %lu of them leaked; %lu elsewhere\n", names[way],
                      (unsigned long)found[way].near_edge, (unsigned long)found[way].leaked,
                      (unsigned long)found[way].elsewhere);
    return 0;
}

/* Near edges of depth, where no border of a shadow happens to lie, a tenth of bilinear's errors and less; with those
 * borders fewer; elsewhere none more. */
static void nothing_leaks_by_depth(void **state)
{
    (void)state;
    assert_true(found[BILINEAR].leaked > 200);
    assert_true(10 * found[BY_DEPTH].leaked <= found[BILINEAR].leaked);
    assert_true(3 * found[BY_DEPTH].near_edge < 2 * found[BILINEAR].near_edge);
    assert_true(found[BY_DEPTH].elsewhere <= found[BILINEAR].elsewhere);
}

static void sharpened_edges_are_nearer(void **state)
{
    (void)state;
    assert_true(5 * found[SHARP].elsewhere < 4 * found[BILINEAR].elsewhere);
    assert_true(found[SHARP].near_edge < found[BILINEAR].near_edge);
    assert_true(10 * found[SHARP_BY_DEPTH].elsewhere < 9 * found[BY_DEPTH].elsewhere);
    assert_true(10 * found[SHARP_BY_DEPTH].leaked <= found[BILINEAR].leaked);
}

/* The shader for half floats, which Mesa computes in floats; and in half floats, here. */
static void half_floats_do(void **state)
{
    (void)state;
    for (int way = HALVES; way <= EMULATED; way++) {
        assert_true(10 * found[way].leaked <= found[BILINEAR].leaked);
        assert_true(found[way].elsewhere <= found[BILINEAR].elsewhere);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(nothing_leaks_by_depth),
                                       cmocka_unit_test(sharpened_edges_are_nearer), cmocka_unit_test(half_floats_do)};

    return cmocka_run_group_tests_name("upsample", tests, measure_once, NULL);
}
