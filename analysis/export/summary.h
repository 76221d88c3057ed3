/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The JSON summary of a study (docs/formats/summary.md). */
#ifndef FRACAS_ANALYSIS_EXPORT_SUMMARY_H
#define FRACAS_ANALYSIS_EXPORT_SUMMARY_H

#include "analysis/fit/fits.h"
#include "analysis/summary/study.h"

/* The whole document. `fits`: rows of STUDY/fits.csv kept by fracas_fits_keep, NULL without any;
 * `stale`: number of points without kept rows. */
void fracas_summary_write(const fracas_analysis *analysis, const fracas_fits *fits, size_t stale,
                          FILE *out);

#endif
