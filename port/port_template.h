/* port_template.h - the state of port_template.c: one block of memory that the board sets aside. */
#ifndef PORT_TEMPLATE_H
#define PORT_TEMPLATE_H
#include "gn_port.h"

typedef struct gn_port_block {
    unsigned char *base; /* aligned to 16 */
    size_t size;
    size_t used; /* start from 0 */
    size_t live; /* blocks handed out, start from 0 */
    uint64_t ticks;
} gn_port_block;

gn_port gn_port_template(gn_port_block *block);
#endif
