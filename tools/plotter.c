/* plotter.c - see plotter.h. */
#include "plotter.h"

#include <stdlib.h>

#include "command.h"

int plotter_start(plotter *p, const char *path, size_t columns, size_t rows)
{
    p->path = path;
    snprintf(p->part, sizeof p->part, "%s.part", path);
    if (system("command -v gnuplot > /dev/null 2>&1") != 0) {
        say("%s: needs gnuplot, which is not installed", path);
        return 0;
    }
    p->pipe = popen("gnuplot 2> /dev/null", "w");
    if (!p->pipe) {
        say("%s: gnuplot cannot be started", path);
        return 0;
    }
    fprintf(p->pipe,
            "set terminal svg size %lu,%lu dynamic font 'sans-serif,12' background '#ffffff'\nset output '%s'\n"
            "set multiplot layout %lu,%lu\nset grid lc '#dddddd'\nset border lc '#555555'\nset key off\n",
            (unsigned long)(560 * columns), (unsigned long)(380 * rows), p->part, (unsigned long)rows,
            (unsigned long)columns);
    return 1;
}

int plotter_finish(plotter *p)
{
    fprintf(p->pipe, "unset multiplot\nset output\n");
    if (pclose(p->pipe) == 0 && rename(p->part, p->path) == 0)
        return 1;
    say("%s: gnuplot fails", p->path);
    remove(p->part);
    return 0;
}

void plotter_put_name(FILE *f, const char *name)
{
    for (; *name; name++)
        fputc(*name == '\'' || *name == '"' || *name == '\\' || *name < ' ' ? '-' : *name, f);
}
