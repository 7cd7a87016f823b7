/* true_mask.c - see true_mask.h. */
#include "true_mask.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The truth knows no lists: what is exempt in a light casts not while that light is traced. common: of lights without;
 * made when it is first needed. */
static int trace(true_mask *m, scene *s, const truth_options *options, uint32_t light, truth **common,
                 char message[SCENE_MESSAGE])
{
    const scene_light *l = &s->lights[light];
    int *casts = malloc((l->exempt_count + 1) * sizeof *casts), ok = 0;
    truth *own = NULL;

    for (size_t i = 0; casts && i < l->exempt_count; i++) {
        casts[i] = s->instances[l->exempt[i]].casts;
        s->instances[l->exempt[i]].casts = 0;
    }
    if (casts && l->exempt_count)
        own = truth_create(s, options, message);
    else if (casts && !*common)
        *common = truth_create(s, options, message);
    for (size_t i = l->exempt_count; casts && i-- > 0;) /* backwards: one may stand twice */
        s->instances[l->exempt[i]].casts = casts[i];
    if (own || (casts && !l->exempt_count && *common))
        ok = truth_light(own ? own : *common, light, m->lit, m->visible, m->classes, message);
    truth_free(own);
    free(casts);
    return ok;
}

int true_mask_trace(true_mask *m, scene *s, const truth_options *options, uint32_t light, truth **common,
                    char message[SCENE_MESSAGE])
{
    const size_t pixels = (size_t)options->width * options->height;

    snprintf(message, SCENE_MESSAGE, "no memory for the truth");
    m->lit = malloc(3 * pixels);
    if (!m->lit)
        return 0;
    m->visible = m->lit + pixels;
    m->classes = m->lit + 2 * pixels;
    if (trace(m, s, options, light, common, message))
        return 1;
    true_mask_free(m);
    return 0;
}

void true_mask_free(true_mask *m)
{
    free(m->lit);
    memset(m, 0, sizeof *m);
}
