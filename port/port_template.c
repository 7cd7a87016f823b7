/* port_template.c - a port for a board without operating system: copy it, rename it, fill it in. It is compiled in
 * every build, and a test makes meshes and plans with it, so it works as it stands.
 *
 * What it shows: memory from one fixed block. Blocks are cut from its front; only the last one can grow, shrink or be
 * given back in place; others are given back when all are. That suits a program that loads its meshes once. gnomon
 * allocates when things are created and never in a frame.
 *
 * Fill in: `board_puts` with the board's way to print a line, `board_ticks_us` with a running timer. */
#include "port_template.h"

#include <string.h>

#define ALIGNMENT 16u

static size_t aligned(size_t size)
{
    return (size + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
}

static void *template_resize(void *user, void *block, size_t old_size, size_t new_size)
{
    gn_port_block *b = user;
    unsigned char *old = block, *fresh;
    const int is_last = old && old + aligned(old_size) == b->base + b->used;
    const size_t start = is_last ? (size_t)(old - b->base) : b->used;

    if (new_size == 0) {
        if (old) {
            b->live--;
            if (is_last)
                b->used = start;
            if (b->live == 0)
                b->used = 0;
        }
        return NULL;
    }
    if (new_size > b->size || aligned(new_size) > b->size - start)
        return NULL;
    fresh = b->base + start;
    if (!old)
        b->live++;
    else if (!is_last)
        memcpy(fresh, old, old_size < new_size ? old_size : new_size);
    b->used = start + aligned(new_size);
    return fresh;
}

static void board_puts(void *user, int level, const char *line)
{
    (void)user;
    (void)level;
    (void)line;
}

static uint64_t board_ticks_us(void *user)
{
    gn_port_block *b = user;

    return ++b->ticks;
}

gn_port gn_port_template(gn_port_block *block)
{
    const gn_port port = {GN_PORT_VERSION, block, template_resize, board_puts, board_ticks_us, NULL};

    return port;
}
