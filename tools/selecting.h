/* selecting.h - what commands that select share: rules and knowledge from files, and the options of a budget. */
#ifndef SELECTING_H
#define SELECTING_H
#include "gn_select.h"

/* As options give it; NULL and 0: not given. */
typedef struct selecting {
    const char *rules, *knowledge, *quality;
    double budget_ms, budget_mw, budget_mb;
} selecting;

typedef struct selecting_files {
    gn_rules *rules; /* until the context ends */
    gn_knowledge knowledge;
    gn_budget budget;
} selecting_files;

/* 0, or an exit status having said why. */
int selecting_load(const selecting *given, gn_context *context, selecting_files *out);
void selecting_free(selecting_files *files);
#endif
