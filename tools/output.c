/* output.c - messages, and files that appear whole or not at all: written beside and renamed. */
#define _POSIX_C_SOURCE 200809L
#include "command.h"

#include <errno.h>
#include <png.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

void say(const char *format, ...)
{
    char line[2048];
    va_list args;

    va_start(args, format);
    vsnprintf(line, sizeof line, format, args);
    va_end(args);
    for (char *c = line; *c; c++)
        if ((unsigned char)*c < ' ') /* a name may hold a newline; a message is one line */
            *c = '?';
    fprintf(stderr, "gnomon: %s\n", line);
}

void say_line(const char *line)
{
    say("%s", line);
}

int fresh_open(fresh_file *f, const char *path)
{
    const size_t length = strlen(path) + 32;

    memset(f, 0, sizeof *f);
    f->path = malloc(length);
    f->temporary = malloc(length);
    if (f->path && f->temporary) {
        strcpy(f->path, path);
        snprintf(f->temporary, length, "%s.part%ld", path, (long)getpid());
        f->file = fopen(f->temporary, "wb");
    }
    if (f->file)
        return 1;
    say("%s: cannot be written: %s", path, strerror(errno));
    free(f->path);
    free(f->temporary);
    return 0;
}

int fresh_close(fresh_file *f, int keep)
{
    int whole = keep && !ferror(f->file);

    if (fclose(f->file) != 0)
        whole = 0;
    if (whole && rename(f->temporary, f->path) != 0)
        whole = 0;
    if (!whole) {
        if (keep)
            say("%s: cannot be written: %s", f->path, strerror(errno));
        remove(f->temporary);
    }
    free(f->path);
    free(f->temporary);
    return whole;
}

int write_png(const char *path, const uint8_t *pixels, uint32_t width, uint32_t height, int channels)
{
    png_image image;
    fresh_file f;
    int ok;

    memset(&image, 0, sizeof image);
    image.version = PNG_IMAGE_VERSION;
    image.width = width;
    image.height = height;
    image.format = channels == 2 ? PNG_FORMAT_GA : PNG_FORMAT_RGB;
    if (!fresh_open(&f, path))
        return 0;
    ok = png_image_write_to_stdio(&image, f.file, 0, pixels, 0, NULL);
    if (!ok)
        say("%s: %s", path, image.message);
    return fresh_close(&f, ok);
}
