/* The figures of a report. Each fills a chart initialised by fracas_chart_init; one without data has no panel. */
#ifndef FRACAS_ANALYSIS_REPORT_FIGURES_H
#define FRACAS_ANALYSIS_REPORT_FIGURES_H

#include "analysis/report/chart.h"
#include "analysis/study/study.h"

/* Mean fragment size against strain rate with the size laws: in metres, or s/s0 against edot/edot0. A series for
 * each combination of the other parameters that differ between points. */
FRACAS_MUST_USE fracas_err fracas_figure_rate(const fracas_analysis *analysis, bool normalised, fracas_chart *chart);

/* Complementary cumulative share of the fragments of all points, sizes over the point's mean. */
FRACAS_MUST_USE fracas_err fracas_figure_sizes_together(const fracas_analysis *analysis, fracas_chart *chart);
/* The same of one point, sizes in metres. */
FRACAS_MUST_USE fracas_err fracas_figure_sizes(const fracas_analysis *analysis, size_t point, fracas_chart *chart);

/* Energies of the point's typical replica over time, and below them the residual of their balance. */
FRACAS_MUST_USE fracas_err fracas_figure_energies(const fracas_analysis *analysis, size_t point, fracas_chart *chart);

#endif
