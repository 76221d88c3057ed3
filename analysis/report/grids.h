/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Broken surfaces as grids for ParaView. */
#ifndef FRACAS_ANALYSIS_REPORT_GRIDS_H
#define FRACAS_ANALYSIS_REPORT_GRIDS_H

#include "analysis/report/page.h"

#include <stdio.h>

/* Writes, for each of `count` times [s], folder/STEM-fragments-K.hdf (triangles with the number
 * and the elements of their fragment) and folder/STEM-cracks-K.hdf (interfaces with state:
 * 0 closed, 1 cracked, 2 broken; strength [Pa], damage at the end, onset_time and break_time [s],
 * NaN: never), K from 1, and STEM-fragments.hdf.series, STEM-cracks.hdf.series, which list
 * them with their times. The surface is as it was before any motion. Prints their names. */
FRACAS_MUST_USE fracas_err fracas_grids_write(const fracas_broken_surface *surface,
                                              const double *time, size_t count, const char *folder,
                                              const char *stem, FILE *out);

#endif
