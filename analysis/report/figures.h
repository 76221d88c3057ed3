/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The figures of a report. Each fills a chart initialised by fracas_chart_init; one without data
 * has no panel. */
#ifndef FRACAS_ANALYSIS_REPORT_FIGURES_H
#define FRACAS_ANALYSIS_REPORT_FIGURES_H

#include "analysis/fit/fits.h"
#include "analysis/draw/chart.h"
#include "analysis/summary/study.h"

/* Mean fragment size against strain rate with the scaling laws: in metres, or s/s0 against
 * edot/edot0. A series for each combination of the other parameters with different values. */
FRACAS_MUST_USE fracas_err fracas_figure_rate(const fracas_analysis *analysis, bool normalised,
                                              fracas_chart *chart);

/* A figure of the study, without a look at the point, or of one point. */
typedef fracas_err fracas_figure_draw(const fracas_analysis *analysis, size_t point,
                                      fracas_chart *chart);

/* Complementary cumulative share of the fragments of all points, sizes over the point's mean. */
fracas_figure_draw fracas_figure_sizes_together;
/* The same of one point, sizes in metres. */
fracas_figure_draw fracas_figure_sizes;
/* Energies of the point's typical replica over time, and below them the residual of their balance.
 */
fracas_figure_draw fracas_figure_energies;
/* Energies of all usable realizations over time: mean and band of each. */
fracas_figure_draw fracas_figure_bands;
/* The headline numbers of the point from its first 4, 8, 16, ... replicas, over their values from
 * all. */
fracas_figure_draw fracas_figure_convergence;
/* Sizes above the cut and the best families. */
FRACAS_MUST_USE fracas_err fracas_figure_fits(const fracas_analysis *analysis,
                                              const fracas_fits *fits, size_t point,
                                              fracas_chart *chart);

/* One line of the table of figures: a figure of the study, or `each` of its points. */
typedef struct {
    const char *section; /* id in page.c */
    const char *grid;    /* "wide", "small": figures side by side */
    bool each;
    fracas_figure_draw *draw;
} fracas_figure;

/* All figures but those of fits, in the order of the page; ends with section NULL. A new figure is
 * a function and a line in figures.c. */
extern const fracas_figure fracas_figures[];

enum { FRACAS_FIGURE_LOW = 200 }; /* pixels of a panel of one point */

/* File name and title of a figure of one point. */
void fracas_figure_name(const fracas_analysis *analysis, size_t point, const char *file,
                        const char *title, fracas_chart *chart);

#endif
