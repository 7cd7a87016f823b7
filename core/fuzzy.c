/* fuzzy.c - evaluates fuzzy rules: how much each input is of each of its terms; how much each rule holds, AND by the least
 * and OR by the most; each output's terms cut off at the most that a rule says of them; and the centre of gravity of
 * what the highest of them encloses (Mamdani 1975; Rautenbach 2008, section 5.3). Of singletons it is their mean, weighed
 * by all rules that say them, each for itself, as fuzzylite does.
 *
 * The centre is exact. Terms are lines between points, so an output's range falls into slices in which each is one line, cut
 * off level at its degree. Within a slice the highest changes only where two of them cross: between crossings it is a
 * line, whose area and moment are sums. */
#include "gni_rules.h"

#include <math.h>
#include <string.h>

enum { MOST_CROSSINGS = GNI_MOST_TERMS + GNI_MOST_TERMS * (GNI_MOST_TERMS - 1) * 3 / 2 + 2 };

double gni_membership(const gn_rules *r, const gni_term *term, double x)
{
    const double(*p)[2] = r->points + term->first_point;
    uint32_t i = 0;

    if (term->point_count == 1)
        return x == p[0][0] ? 1.0 : 0.0;
    if (!(x > p[0][0])) /* nor what is no number */
        return p[0][1];
    if (x >= p[term->point_count - 1][0])
        return p[term->point_count - 1][1];
    while (p[i][0] < x)
        i++;
    if (p[i][0] == x)
        return p[i][1];
    return p[i - 1][1] + (p[i][1] - p[i - 1][1]) * (x - p[i - 1][0]) / (p[i][0] - p[i - 1][0]);
}

/* ------------------------------------------------------------------ centres of gravity */

typedef struct line {
    double from, to, top; /* values at the slice's ends, cut off at top */
} line;

static double height(const line *l, double t)
{
    return fmin(l->from + (l->to - l->from) * t, l->top);
}

static double highest(const line *lines, int count, double t)
{
    double most = 0.0;

    for (int i = 0; i < count; i++)
        most = fmax(most, height(&lines[i], t));
    return most;
}

/* Where a line is at a level, if that is within the slice: in order among the places that are known. */
static void cross(double *at, int *count, double from, double to)
{
    const double t = from / (from - to);
    int i = *count;

    if (!(from < 0.0 ? to > 0.0 : to < 0.0) || !(t > 0.0 && t < 1.0))
        return;
    for (; i > 0 && at[i - 1] > t; i--)
        at[i] = at[i - 1];
    at[i] = t;
    ++*count;
}

static void add_slice(const line *lines, int count, const gni_slice *slice, double *area, double *moment)
{
    const double width = slice->to - slice->from;
    double at[MOST_CROSSINGS], last, height_last;
    int crossings = 0;

    for (int i = 0; i < count; i++) {
        const line *a = &lines[i];

        cross(at, &crossings, a->from - a->top, a->to - a->top);
        for (int k = 0; k < i; k++) {
            const line *b = &lines[k];

            cross(at, &crossings, a->from - b->from, a->to - b->to);
            cross(at, &crossings, a->from - b->top, a->to - b->top);
            cross(at, &crossings, b->from - a->top, b->to - a->top);
        }
    }
    last = 0.0;
    height_last = highest(lines, count, 0.0);
    for (int i = 0; i <= crossings; i++) {
        const double t = i < crossings ? at[i] : 1.0, h = highest(lines, count, t), step = (t - last) * width;
        const double start = slice->from + last * width;

        *area += step * (height_last + h) / 2.0;
        *moment += step * (start * (height_last + h) / 2.0 + step * (height_last + 2.0 * h) / 6.0);
        last = t;
        height_last = h;
    }
}

static double centre_of_gravity(const gn_rules *r, const gni_variable *v)
{
    const double *degrees = r->degrees + v->first_term;
    double area = 0.0, moment = 0.0;

    for (uint32_t s = v->first_slice; s < (uint32_t)v->first_slice + v->slice_count; s++) {
        const gni_slice *slice = &r->slices[s];
        const double *ends = r->slice_ends + 2 * (size_t)slice->first_end;
        line lines[GNI_MOST_TERMS];
        int count = 0;

        for (uint32_t t = 0; t < v->term_count; t++)
            if (degrees[t] > 0.0 && (ends[2 * t] > 0.0 || ends[2 * t + 1] > 0.0))
                lines[count++] = (line){ends[2 * t], ends[2 * t + 1], degrees[t]};
        if (count > 0)
            add_slice(lines, count, slice, &area, &moment);
    }
    return moment / area; /* NAN of nothing */
}

/* Of singletons. */
static double mean(const gn_rules *r, const gni_variable *v)
{
    double sum = 0.0, weights = 0.0;

    for (uint32_t t = v->first_term; t < (uint32_t)v->first_term + v->term_count; t++) {
        sum += r->degrees[t] * r->points[r->terms[t].first_point][0];
        weights += r->degrees[t];
    }
    return sum / weights;
}

/* ------------------------------------------------------------------ rules */

static double holds(const gn_rules *r, const gni_rule *rule)
{
    double stack[2 * GNI_MOST_NESTED + 3]; /* each parenthesis may wait with the left of an OR and of an AND */
    int top = 0;

    for (uint32_t i = rule->first_code; i < (uint32_t)rule->first_code + rule->code_count; i++)
        switch (r->code[i]) {
        case GNI_RULE_NOT:
            stack[top - 1] = 1.0 - stack[top - 1];
            break;
        case GNI_RULE_AND:
            top--;
            stack[top - 1] = fmin(stack[top - 1], stack[top]);
            break;
        case GNI_RULE_OR:
            top--;
            stack[top - 1] = fmax(stack[top - 1], stack[top]);
            break;
        default:
            stack[top++] = r->degrees[r->code[i]];
        }
    return stack[0] * (double)rule->weight;
}

void gn_rules_evaluate(gn_rules *r, const double *inputs, double *outputs, float *strengths)
{
    for (uint32_t i = 0; i < r->input_count; i++)
        for (uint32_t t = r->inputs[i].first_term; t < (uint32_t)r->inputs[i].first_term + r->inputs[i].term_count; t++)
            r->degrees[t] = gni_membership(r, &r->terms[t], inputs[i]);
    for (uint32_t i = 0; i < r->output_count; i++)
        memset(r->degrees + r->outputs[i].first_term, 0, r->outputs[i].term_count * sizeof *r->degrees);
    for (uint32_t i = 0; i < r->rule_count; i++) {
        const gni_rule *rule = &r->rules[i];
        const double strength = holds(r, rule);

        if (strengths)
            strengths[i] = (float)strength;
        for (uint32_t k = rule->first_then; k < (uint32_t)rule->first_then + rule->then_count; k++) {
            double *degree = &r->degrees[r->thens[k]];

            *degree = r->terms[r->thens[k]].point_count == 1 ? *degree + strength : fmax(*degree, strength);
        }
    }
    for (uint32_t i = 0; i < r->output_count; i++) {
        const gni_variable *v = &r->outputs[i];
        const double centre = v->is_by_singletons ? mean(r, v) : centre_of_gravity(r, v);

        if (!isnan(centre))
            outputs[i] = centre;
        else if (!v->keeps)
            outputs[i] = v->otherwise;
    }
}
