/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The film of a realization that is computed again: `replay --film`. */
#ifndef FRACAS_CLI_FILM_H
#define FRACAS_CLI_FILM_H

#include "analysis/film/film.h"
#include "campaigns/scheduler/replay.h"

#include <stdio.h>

/* All zero: none. */
typedef struct {
    const char *path, *name; /* FILE.html, its last part */
    char *folder;            /* owned, as the film */
    fracas_film *film;
    size_t count; /* instants kept */
    double bytes; /* about as many has the page */
    FILE *out;    /* for words; NULL: none */
} fracas_cli_film;

/* FRACAS_USAGE unless the path ends in .html and nothing is there; FRACAS_ENVIRONMENT unless a file
 * can be written there. */
FRACAS_MUST_USE fracas_err fracas_cli_film_open(const char *path, FILE *out, fracas_cli_film *film);
void fracas_cli_film_clear(fracas_cli_film *film);

/* For a fracas_fields_request whose context is the film. FRACAS_USAGE where it would be too large.
 */
FRACAS_MUST_USE fracas_err fracas_cli_film_show(void *context, const fracas_fields *fields,
                                                size_t most);

/* Writes the page after the run, and prints its name. */
FRACAS_MUST_USE fracas_err fracas_cli_film_write(fracas_cli_film *film,
                                                 const fracas_replay *replay);

#endif
