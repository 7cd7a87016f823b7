/* text.c - sentences put together into a buffer that may be too small, or absent: then only the length is told. */
#include "gni.h"

#include <stdarg.h>
#include <stdio.h>

void gni_start_text(gni_text *t, char *text, size_t capacity)
{
    *t = (gni_text){text, text ? capacity : 0, 0};
    if (t->capacity)
        text[0] = '\0';
}

void(gni_put)(gni_text *t, const char *format, ...)
{
    const size_t room = t->length < t->capacity ? t->capacity - t->length : 0;
    va_list args;
    int length;

    va_start(args, format);
    length = vsnprintf(room ? t->text + t->length : NULL, room, format, args);
    va_end(args);
    t->length += length > 0 ? (size_t)length : 0;
}
