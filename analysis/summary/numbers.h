/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Values and means of the numbers of a realization (analysis/data/numbers.h). */
#ifndef FRACAS_ANALYSIS_SUMMARY_NUMBERS_H
#define FRACAS_ANALYSIS_SUMMARY_NUMBERS_H

#include "analysis/summary/statistics.h"
#include "campaigns/store/datafile.h"

/* All numbers of a usable realization of the point; `record` with its fragments. */
fracas_replica_values fracas_numbers_of(const fracas_point_statistics *point,
                                        const fracas_record *record);

/* Mean of a number over the usable realizations of the point. */
const fracas_estimate *fracas_number_mean(const fracas_number *number,
                                          const fracas_point_statistics *point);

/* True if its mean is above 0 at one of the points. */
bool fracas_number_above_0(const fracas_number *number, const fracas_point_statistics *point,
                           size_t npoints);

#endif
