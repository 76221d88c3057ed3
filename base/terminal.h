/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The terminal of a stream: its size, and whether it takes colours. */
#ifndef FRACAS_BASE_TERMINAL_H
#define FRACAS_BASE_TERMINAL_H

#include <stdbool.h>

typedef struct {
    bool draws;        /* a terminal that moves its cursor: TERM is not `dumb` */
    bool colour;       /* and NO_COLOR is not set, or empty (no-color.org) */
    int columns, rows; /* columns 0: no terminal; 80 by 24 where it does not say */
} fracas_terminal;

fracas_terminal fracas_terminal_of(int fd);

typedef enum {
    FRACAS_PLAIN,
    FRACAS_BOLD,
    FRACAS_DIM,
    FRACAS_RED,
    FRACAS_GREEN,
    FRACAS_YELLOW,
    FRACAS_CYAN
} fracas_colour;

/* The sequence that begins a colour; FRACAS_PLAIN ends it. "" without `on`. */
const char *fracas_colour_code(bool on, fracas_colour colour);

/* Begins a colour on standard output, past its guard (base/text.h); nothing where that takes none.
 */
void fracas_paint(fracas_colour colour);

#endif
