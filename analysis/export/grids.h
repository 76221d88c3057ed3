/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stored realizations as grids for ParaView. */
#ifndef FRACAS_ANALYSIS_EXPORT_GRIDS_H
#define FRACAS_ANALYSIS_EXPORT_GRIDS_H

#include "analysis/data/flight.h"

#include <stdio.h>

/* Writes, for each of `count` times [s], folder/STEM-body-K.hdf (elements where their fragments
 * have moved, each with nodes of its own: displacement [m], velocity [m/s]; fragment, its elements
 * and fragment_mass [kg]) and folder/STEM-interfaces-K.hdf (interfaces half-way between their
 * sides: state 0 closed, 1 cracked, 2 broken; strength [Pa], damage_at_end, onset_time and
 * break_time [s], NaN: never), K from 1, and STEM-body.hdf.series, STEM-interfaces.hdf.series,
 * which list them with their times. Prints their names. */
FRACAS_MUST_USE fracas_err fracas_grids_write(const fracas_flight *flight, const double *time,
                                              size_t count, const char *folder, const char *stem,
                                              FILE *out);

#endif
