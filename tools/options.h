/* options.h - long options in the GNU manner, in any order: `--name value`, `--name=value`, `--` ends them. */
#ifndef OPTIONS_H
#define OPTIONS_H

typedef enum option_kind { OPTION_TEXT, OPTION_WHOLE, OPTION_NUMBER, OPTION_SIZE, OPTION_FLAG } option_kind;

/* One option of a command. `value` points to: const char * (TEXT), long (WHOLE), double (NUMBER), long[2] (SIZE),
 * int (FLAG). */
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
#endif
