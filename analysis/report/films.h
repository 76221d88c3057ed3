/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Films of stored realizations, as they move. */
#ifndef FRACAS_ANALYSIS_REPORT_FILMS_H
#define FRACAS_ANALYSIS_REPORT_FILMS_H

#include "analysis/data/flight.h"

#include <stddef.h>

/* Bytes of a film with so many instants. */
double fracas_flight_film_bytes(const fracas_flight *flight, size_t count);

/* Most instants of a film of FRACAS_FILM_BYTES. */
size_t fracas_flight_film_most(const fracas_flight *flight);

/* Writes the page FOLDER/NAME: at each time [s] the body where its fragments are. */
FRACAS_MUST_USE fracas_err fracas_flight_film(const fracas_flight *flight, const double *time,
                                              size_t count, const char *folder, const char *name,
                                              const char *title);

#endif
