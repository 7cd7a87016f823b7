/* context.c - a port, proven before use, and the sentence of the last failure.
 *
 * Memory: each block carries its size in front, since the port is told the old size when a block is given back. */
#include "gni.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#define HEADER 16u /* bytes in front of a block; keeps the alignment that the port gave */

#define TEXT_OF(number)                   #number
#define VERSION_TEXT(major, minor, patch) TEXT_OF(major) "." TEXT_OF(minor) "." TEXT_OF(patch)

const char *gn_version(void)
{
    return VERSION_TEXT(GN_VERSION_MAJOR, GN_VERSION_MINOR, GN_VERSION_PATCH);
}

/* A port that fails here would fail in the middle of a mesh: better said at start. */
static gn_result prove_port(const gn_port *port)
{
    void *block;

    if (port->version < 1 || port->version > GN_PORT_VERSION || !port->resize)
        return GN_E_ARG;
    block = port->resize(port->user, NULL, 0, 24);
    if (!block)
        return GN_E_MEMORY;
    if ((uintptr_t)block % sizeof(double) != 0) {
        port->resize(port->user, block, 24, 0);
        return GN_E_ARG;
    }
    port->resize(port->user, block, 24, 0);
    if (port->now_us) {
        const uint64_t before = port->now_us(port->user);

        if (port->now_us(port->user) < before)
            return GN_E_ARG;
    }
    return GN_OK;
}

gn_result gn_context_create(const gn_port *port, gn_context **context)
{
    const gn_port libc_port = gn_port_libc();
    gn_result result;

    if (!context)
        return GN_E_ARG;
    *context = NULL;
    if (!port)
        port = &libc_port;
    result = prove_port(port);
    if (result != GN_OK)
        return result;
    *context = port->resize(port->user, NULL, 0, sizeof **context);
    if (!*context)
        return GN_E_MEMORY;
    memset(*context, 0, sizeof **context);
    memcpy(&(*context)->port, port, port->version < 2 ? offsetof(gn_port, setting) : sizeof *port);
    return GN_OK;
}

void gn_context_destroy(gn_context *context)
{
    if (context)
        context->port.resize(context->port.user, context, sizeof *context, 0);
}

const char *gn_message(const gn_context *context)
{
    if (!context)
        return "no context";
    return GNI_HAS_MESSAGES || context->message[0] ? context->message
                                                   : "no sentences: this build lacks the feature messages";
}

const gn_port *gn_context_port(const gn_context *context)
{
    return context ? &context->port : NULL;
}

gn_result(gn_fail)(gn_context *context, gn_result result, const char *format, ...)
{
    va_list args;

    if (!context)
        return result;
    va_start(args, format);
    vsnprintf(context->message, sizeof context->message, format, args);
    va_end(args);
    return result;
}

void *gni_alloc(gn_context *context, size_t count, size_t size)
{
    unsigned char *block;
    size_t bytes;

    if (count > (SIZE_MAX - HEADER) / size)
        return NULL;
    bytes = count * size + HEADER;
    block = context->port.resize(context->port.user, NULL, 0, bytes);
    if (!block)
        return NULL;
    memcpy(block, &bytes, sizeof bytes);
    return block + HEADER;
}

void gni_free(gn_context *context, void *block)
{
    size_t bytes;
    unsigned char *start;

    if (!block)
        return;
    start = (unsigned char *)block - HEADER;
    memcpy(&bytes, start, sizeof bytes);
    context->port.resize(context->port.user, start, bytes, 0);
}
