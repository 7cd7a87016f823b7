/* port_libc.c - the port for any hosted system: realloc and free, lines on standard error, a monotonic clock,
 * environment variables.
 *
 * C99 alone has no monotonic wall clock, so POSIX's is used where it is declared and processor time elsewhere. */
#if defined(__unix__) || defined(__APPLE__)
#define _POSIX_C_SOURCE 200809L
#endif
#include "gn_port.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

static void *libc_resize(void *user, void *block, size_t old_size, size_t new_size)
{
    (void)user;
    (void)old_size;
    if (new_size == 0) {
        free(block);
        return NULL;
    }
    return realloc(block, new_size);
}

static void libc_log(void *user, int level, const char *line)
{
    static const char *const names[] = {"error", "warning", "info"};

    (void)user;
    fprintf(stderr, "gnomon: %s: %s\n", level >= 0 && level <= GN_LOG_INFO ? names[level] : "log", line);
}

static uint64_t libc_now_us(void *user)
{
    (void)user;
#ifdef CLOCK_MONOTONIC
    struct timespec now;

    if (clock_gettime(CLOCK_MONOTONIC, &now) == 0)
        return (uint64_t)now.tv_sec * 1000000u + (uint64_t)now.tv_nsec / 1000u;
#endif
    return (uint64_t)clock() * 1000000u / CLOCKS_PER_SEC;
}

static const char *libc_setting(void *user, const char *name)
{
    (void)user;
    return getenv(name);
}

gn_port gn_port_libc(void)
{
    const gn_port port = {GN_PORT_VERSION, NULL, libc_resize, libc_log, libc_now_us, libc_setting};

    return port;
}
