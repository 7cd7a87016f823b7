/* main.c - the command `gnomon`: finds the sub-command. */
#include "command.h"

#include <string.h>

#include "gnomon.h"

const char help_methods[] =
    "usage: gnomon methods\n"
    "\n"
    "Lists the methods by name: whether they are exact, what they are, what they need. A stencil\n"
    "method's name may end in /one-sided: volumes are then drawn twice, culled, as on boards without\n"
    "two-sided stencil.\n";

static void print_set(const char *what, uint32_t set)
{
    const char *separator = what;

    for (int c = 0; c < GN_CAPABILITY_COUNT; c++)
        if (set >> c & 1) {
            printf("%s%s", separator, gn_capability_name((gn_capability)c));
            separator = ", ";
        }
}

int command_methods(int count, char **arguments)
{
    if (count > 0) {
        say("methods: takes no arguments (%s)", arguments[0]);
        return EXIT_USAGE;
    }
    for (int m = 0; m < GN_METHOD_TOTAL; m++) {
        const gn_method_info *info = gn_method_describe((gn_method)m);

        printf("%-8s %-8s %s\n", info->name, info->exact ? "exact" : "inexact", info->summary);
        print_set("                  needs ", info->needs);
        print_set(", one of ", info->needs_any);
        print_set("; makes do without ", info->likes);
        printf("%s", info->needs ? "\n" : "");
    }
    return EXIT_DONE;
}

static const struct {
    const char *name;
    int (*run)(int count, char **arguments);
    const char *help, *summary;
} commands[] = {
    {"render", command_render, help_render, "draw a glTF scene with shadows into a picture"},
    {"view", command_view, help_view,
     "a scene in a window: walk round it, drag its lights, switch and compare methods"},
    {"probe", command_probe, help_probe, "what the GL contexts of this machine are and can do"},
    {"measure", command_measure, help_measure, "what each method costs here, and how far from the truth it is"},
    {"calibrate", command_calibrate, help_calibrate,
     "what each way to make shadows costs on this board, for the selector"},
    {"select", command_select, help_select, "what the selector takes for a light of given facts, and why"},
    {"methods", command_methods, help_methods, "the methods, and what each needs"},
};
enum { COMMANDS = sizeof commands / sizeof commands[0] };

static int find(const char *name)
{
    for (int i = 0; i < COMMANDS; i++)
        if (strcmp(commands[i].name, name) == 0)
            return i;
    say("no such command: see `gnomon help` (%s)", name);
    return -1;
}

static int help(const char *name)
{
    int i;

    if (!name || strcmp(name, "help") == 0) {
        printf("usage: gnomon COMMAND [arguments]\n\nReal-time shadows in OpenGL ES 2.0.\n\n");
        for (i = 0; i < COMMANDS; i++)
            printf("  %-10s %s\n", commands[i].name, commands[i].summary);
        printf("  %-10s %s\n\n`gnomon COMMAND --help` says more. `gnomon --version` prints the version.\n", "help",
               "this text, or that of a command");
        return EXIT_DONE;
    }
    i = find(name);
    if (i < 0)
        return EXIT_USAGE;
    fputs(commands[i].help, stdout);
    return EXIT_DONE;
}

static int run(int count, char **arguments)
{
    int i;

    if (count < 2) {
        say("a command is missing: see `gnomon help`");
        return EXIT_USAGE;
    }
    if (strcmp(arguments[1], "help") == 0 || strcmp(arguments[1], "--help") == 0)
        return help(count > 2 ? arguments[2] : NULL);
    if (strcmp(arguments[1], "--version") == 0) {
        printf("gnomon %s\n", gn_version());
        return EXIT_DONE;
    }
    i = find(arguments[1]);
    if (i < 0)
        return EXIT_USAGE;
    for (int a = 2; a < count && strcmp(arguments[a], "--") != 0; a++)
        if (strcmp(arguments[a], "--help") == 0)
            return help(arguments[1]);
    return commands[i].run(count - 2, arguments + 2);
}

int main(int count, char **arguments)
{
    const int status = run(count, arguments);

    if (fflush(stdout) != 0 && status == EXIT_DONE) {
        say("standard output: cannot be written");
        return EXIT_FAILED;
    }
    return status;
}
