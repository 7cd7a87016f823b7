/* slices.c - cuts the range of an output by COG at the points of its terms: what lies between two of them fuzzy.c sums. */
#include "gni_rules.h"

#include <string.h>

/* The term on one side of a place: steps, two points at one x, have two values there. */
static double beside(const gn_rules *r, const gni_term *term, double x, int is_right)
{
    const double(*p)[2] = r->points + term->first_point;
    uint32_t last;

    if (x < p[0][0] || x > p[term->point_count - 1][0])
        return gni_membership(r, term, x);
    for (uint32_t i = 0; i < term->point_count; i++)
        if (p[i][0] == x) {
            for (last = i; last + 1 < term->point_count && p[last + 1][0] == x;)
                last++;
            return p[is_right ? last : i][1];
        }
    return gni_membership(r, term, x);
}

/* The places of an output's range, rising, where a term has a point; its ends too. */
static uint32_t find_places(const gn_rules *r, const gni_variable *v, double *places)
{
    uint32_t count = 0;

    places[count++] = v->low;
    places[count++] = v->high;
    for (uint32_t t = v->first_term; t < (uint32_t)v->first_term + v->term_count; t++)
        for (uint32_t p = 0; p < r->terms[t].point_count; p++) {
            const double x = r->points[r->terms[t].first_point + p][0];
            uint32_t i = 0;

            while (i < count && places[i] < x)
                i++;
            if (x < v->low || x > v->high || (i < count && places[i] == x))
                continue;
            memmove(places + i + 1, places + i, (count - i) * sizeof *places);
            places[i] = x;
            count++;
        }
    return count;
}

gn_result gni_slice_outputs(gn_rules *r, gni_variable *outputs, double *places)
{
    size_t count = 0, ends = 0;
    gni_slice *slices;
    double *slice_ends;

    for (uint32_t i = 0; i < r->output_count; i++)
        if (!outputs[i].is_by_singletons) {
            outputs[i].slice_count = (uint16_t)(find_places(r, &outputs[i], places) - 1);
            count += outputs[i].slice_count;
            ends += (size_t)outputs[i].slice_count * outputs[i].term_count;
        }
    if (!count)
        return GN_OK;
    r->own = slices = gni_alloc(r->context, 1, count * sizeof *slices + 2 * ends * sizeof *slice_ends);
    if (!slices)
        return gn_fail(r->context, GN_E_MEMORY, "rules: no memory for %lu slices", (unsigned long)count);
    slice_ends = (double *)(void *)(slices + count);
    r->slices = slices;
    r->slice_ends = slice_ends;
    ends = 0;
    for (uint32_t i = 0; i < r->output_count; i++) {
        gni_variable *v = &outputs[i];

        v->first_slice = (uint16_t)r->slice_count;
        if (v->is_by_singletons)
            continue;
        find_places(r, v, places);
        for (uint32_t k = 0; k < v->slice_count; k++) {
            slices[r->slice_count++] = (gni_slice){places[k], places[k + 1], (uint32_t)ends};
            for (uint32_t t = 0; t < v->term_count; t++, ends++)
                for (uint32_t side = 0; side < 2; side++)
                    slice_ends[2 * ends + side] = beside(r, &r->terms[v->first_term + t], places[k + side], !side);
        }
    }
    return GN_OK;
}
