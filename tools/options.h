/* options.h - long options in the GNU manner, in any order: `--name value`, `--name=value`, `--` ends them. */
#ifndef OPTIONS_H
#define OPTIONS_H
#include "gn_plan.h"

typedef enum option_kind {
    OPTION_TEXT,
    OPTION_WHOLE,
    OPTION_NUMBER,
    OPTION_SIZE,
    OPTION_FLAG,
    OPTION_LIST
} option_kind;

enum { TEXT_LIST_MOST = 32 };
typedef struct text_list {
    const char *of[TEXT_LIST_MOST];
    int count;
} text_list;

/* One option of a command. `value` points to: const char * (TEXT), long (WHOLE), double (NUMBER), long[2] (SIZE),
 * int (FLAG), text_list (LIST: as often as it is given). */
typedef struct option {
    const char *name; /* with its dashes */
    option_kind kind;
    void *value;
    double low, high; /* of what is counted or measured, both ends included */
} option;

/* Fills values and puts what is no option first into arguments. Returns how many those are, or -1 having said what
 * is wrong. */
int parse_options(int count, char **arguments, const option *options, int option_count);

/* 1 when a list of capabilities to hide names none that is not there; else 0, having said so. from: who gave it. */
int check_hidden(const char *from, const char *names);

/* The same of a scale and of an upsampling's name, which becomes *upsample. */
int check_small(long scale, const char *name, gn_upsample *upsample);
#endif
