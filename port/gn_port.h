/* gn_port.h - all that gnomon asks of a machine: memory, a log, a clock, settings. New board: copy
 * port/port_template.c.
 *
 * threads   gnomon calls a port only from inside the calls that a host makes, on the host's thread
 * lifetime  the struct is copied when a context is made; what `user` points to must outlive the context */
#ifndef GN_PORT_H
#define GN_PORT_H
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define GN_PORT_VERSION 2

typedef enum gn_log_level { GN_LOG_ERROR, GN_LOG_WARNING, GN_LOG_INFO } gn_log_level;

/* A member in [brackets] may be NULL and then means what the brackets say. */
typedef struct gn_port {
    uint32_t version; /* GN_PORT_VERSION; members are only ever added at the end */
    void *user;       /* first argument of every call below */
    /* Allocates (block NULL), resizes, or frees (new_size 0; returns NULL). old_size is what was last asked for, so
     * that an arena needs no headers. Blocks are aligned for any type. On failure NULL, and the old block is intact. */
    void *(*resize)(void *user, void *block, size_t old_size, size_t new_size);
    /* One line without newline, for a person. Must not call gnomon. [dropped] */
    void (*log)(void *user, int level, const char *line);
    /* Microseconds that never go backwards; only differences are used. [no time is measured] */
    uint64_t (*now_us)(void *user);
    /* Since version 2. A setting that comes from outside the program, such as an environment variable: GNOMON_HIDE
     * names capabilities to pretend absent. NULL where there is none. [no settings] */
    const char *(*setting)(void *user, const char *name);
} gn_port;

/* The port for hosted systems: realloc, standard error, the C clock, environment variables. */
gn_port gn_port_libc(void);

#ifdef __cplusplus
}
#endif
#endif
