/* library.c - shared libraries opened at run time. */
#define _POSIX_C_SOURCE 200809L
#include "platform.h"

#include <dlfcn.h>
#include <stddef.h>
#include <string.h>

void *platform_library(const char *const *names)
{
    for (; *names; names++) {
        void *const library = dlopen(*names, RTLD_NOW | RTLD_LOCAL);

        if (library)
            return library;
    }
    return NULL;
}

void (*platform_symbol(void *library, const char *name))(void)
{
    void *const symbol = dlsym(library, name);
    void (*function)(void) = NULL;

    memcpy(&function, &symbol,
           sizeof function); /* POSIX lets a function stand in an object pointer; C99 does not convert it */
    return function;
}

void platform_release(void *library)
{
    if (library)
        dlclose(library);
}
