/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The JSON summary of a study (docs/formats/summary.md). */
#ifndef FRACAS_ANALYSIS_EXPORT_SUMMARY_H
#define FRACAS_ANALYSIS_EXPORT_SUMMARY_H

#include "analysis/fit/fits.h"
#include "analysis/summary/study.h"
#include "base/json.h"

/* The whole document. `fits`: rows of STUDY/fits.csv kept by fracas_fits_keep, NULL without any;
 * `stale`: number of points without kept rows. */
void fracas_summary_write(const fracas_analysis *analysis, const fracas_fits *fits, size_t stale,
                          FILE *out);

/* Keys of a point, in summary_series.c: `fits`; `convergence`; `energies`. */
void fracas_summary_put_fits(fracas_json *json, size_t point, const fracas_fits *fits);
void fracas_summary_put_convergence(fracas_json *json, const fracas_analysis *analysis,
                                    size_t point);
void fracas_summary_put_energies(fracas_json *json, const fracas_analysis *analysis, size_t point);

#endif
