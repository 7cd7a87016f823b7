/* configs.h - which configurations are measured: all methods at all scales and upsamplings that are asked for. */
#ifndef CONFIGS_H
#define CONFIGS_H
#include "trial.h"

enum { MOST_CONFIGS = 128 };

typedef struct config_list {
    config of[MOST_CONFIGS];
    int count;
} config_list;

/* Comma-separated lists: names of methods, "all" for each of them but auto; scales; upsamplings. Scale 1 stands once whatever
 * the upsamplings, refine at scales 2 and 4 without. 1, or 0 having said what is wrong. */
int list_configs(const char *methods, const char *scales, const char *upsamples, config_list *out);

/* Whole numbers of a comma-separated list, each from low to high. Returns how many, or 0 having said what is wrong. */
int parse_numbers(const char *option, const char *list, long low, long high, long *out, int most);
#endif
