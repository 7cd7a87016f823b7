/* command.h - what the sub-commands share: exit statuses, messages, files written whole or not at all. */
#ifndef COMMAND_H
#define COMMAND_H
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* The command's contract. */
enum { EXIT_DONE = 0, EXIT_FAILED = 1, EXIT_USAGE = 2, EXIT_MISSING = 3 };

/* "gnomon: ..." and a newline on standard error. */
void say(const char *format, ...)
#ifdef __GNUC__
    __attribute__((format(printf, 1, 2)))
#endif
    ;
void say_line(const char *line); /* for callbacks */

/* A file beside the one that is meant; renamed onto it, or removed. */
typedef struct fresh_file {
    FILE *file;
    char *path, *temporary;
} fresh_file;

int fresh_open(fresh_file *f, const char *path); /* 1, or 0 having said why */
int fresh_close(fresh_file *f, int keep);        /* 1 when kept and whole; says why not */

/* channels: 2 grey and alpha, 3 RGB; rows from the top. 1, or 0 having said why. */
int write_png(const char *path, const uint8_t *pixels, uint32_t width, uint32_t height, int channels);

/* Sub-commands: arguments from the one after their name. */
int command_render(int count, char **arguments);
int command_probe(int count, char **arguments);
int command_methods(int count, char **arguments);
int command_measure(int count, char **arguments);
int command_calibrate(int count, char **arguments);
int command_select(int count, char **arguments);
int command_view(int count, char **arguments);

/* The text of --help of each. */
extern const char help_render[], help_probe[], help_methods[], help_measure[], help_calibrate[], help_select[],
    help_view[];
#endif
