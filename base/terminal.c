/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/terminal.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

fracas_terminal fracas_terminal_of(int fd)
{
    struct winsize size;
    const char *term = getenv("TERM"), *refused = getenv("NO_COLOR");
    /* Open MPI gives its ranks a terminal, of which nobody sees the size. */
    if (!isatty(fd) || getenv("OMPI_COMM_WORLD_RANK")) return (fracas_terminal){0};
    fracas_terminal found = {
        .draws = !term || strcmp(term, "dumb") != 0, .columns = 80, .rows = 24};
    found.colour = found.draws && !(refused && *refused);
    if (ioctl(fd, TIOCGWINSZ, &size)) return found;
    if (size.ws_col > 1) found.columns = size.ws_col;
    if (size.ws_row > 1) found.rows = size.ws_row;
    return found;
}

const char *fracas_colour_code(bool on, fracas_colour colour)
{
    static const char *const code[] = {
        [FRACAS_PLAIN] = "\033[0m", [FRACAS_BOLD] = "\033[1m",   [FRACAS_DIM] = "\033[2m",
        [FRACAS_RED] = "\033[31m",  [FRACAS_GREEN] = "\033[32m", [FRACAS_YELLOW] = "\033[33m",
        [FRACAS_CYAN] = "\033[36m",
    };
    return on ? code[colour] : "";
}

void fracas_paint(fracas_colour colour)
{
    const char *code = fracas_colour_code(fracas_terminal_of(STDOUT_FILENO).colour, colour);
    if (!*code || fflush(stdout)) return;
    if (write(STDOUT_FILENO, code, strlen(code)) < 0) return; /* the text tells of it, too */
}
