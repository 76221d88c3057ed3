/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The figures of a report. Each fills a chart initialised by fracas_chart_init; one without data
 * has no panel. */
#ifndef FRACAS_ANALYSIS_REPORT_FIGURES_H
#define FRACAS_ANALYSIS_REPORT_FIGURES_H

#include "analysis/fit/fits.h"
#include "analysis/data/format.h"
#include "analysis/draw/chart.h"
#include "analysis/summary/study.h"

/* Drawings of one figure, beside each other with the same axes. */
typedef struct {
    size_t count;
    fracas_chart *chart;
    size_t left_out; /* drawings beyond the most */
} fracas_charts;

enum { FRACAS_MOST_DRAWINGS = 12, FRACAS_MOST_PANELS = 36 }; /* most in a figure */
void fracas_charts_clear(fracas_charts *charts);

typedef enum {
    FRACAS_MEANS_SIZE,       /* mean fragment size in metres */
    FRACAS_MEANS_NORMALISED, /* s/s0 against edot/edot0; none against anything else */
    FRACAS_MEANS_COUNT,      /* mean number of fragments, with and without dust */
    FRACAS_MEANS_OTHER       /* for fracas_figure_ordinate */
} fracas_means;

/* Means with their 95 % intervals against the abscissa of analysis->axes, in its series and
 * drawings; against the strain rate with the scaling laws, fitted powers and crossovers. No chart
 * without an abscissa. Cleared by the caller, after an error too. */
FRACAS_MUST_USE fracas_err fracas_figure_means(const fracas_analysis *analysis, fracas_means of,
                                               fracas_charts *charts);

/* The same of a statistic, without laws and powers. No chart where it is a number nowhere. */
FRACAS_MUST_USE fracas_err fracas_figure_ordinate(const fracas_analysis *analysis,
                                                  const fracas_ordinate *ordinate,
                                                  fracas_charts *charts);

/* A figure of one point; or a drawing of a figure of the study, of this number in place of the
 * point, without a panel after the last one. */
typedef fracas_err fracas_figure_draw(const fracas_analysis *analysis, size_t point,
                                      fracas_chart *chart);

/* True for a point with a curve in this drawing of all drawn points, at most FRACAS_MEANS_SERIES of
 * them; *look: its look. */
bool fracas_figure_takes(const fracas_analysis *analysis, size_t point, size_t drawing,
                         unsigned *look);
/* "sizes", "sizes-2": the file and title of a drawing. */
void fracas_figure_name_drawing(const char *file, const char *title, size_t drawing,
                                fracas_chart *chart);

/* Complementary cumulative share of the fragments of all drawn points, sizes over the point's mean.
 */
fracas_figure_draw fracas_figure_sizes_together;
/* N(>= m) of all drawn points: fragments of a body that have a mass of m or more. */
fracas_figure_draw fracas_figure_masses;
/* The same share of one point, sizes in metres. */
fracas_figure_draw fracas_figure_sizes;
/* Mean number of fragments over time with its band, and the estimate of the final one. */
fracas_figure_draw fracas_figure_fragments;
/* Energies of the point's typical replica over time, and below them the residual of their balance.
 */
fracas_figure_draw fracas_figure_energies;
/* Displacements of the probes in the point's typical replica over time, a panel a component that
 * moves. */
fracas_figure_draw fracas_figure_probes;
/* Reactions of edges, likewise. */
fracas_figure_draw fracas_figure_reactions;
/* Length of all cracks and of the longest in the point's typical replica over time, and the speed
 * of its tip over that of Rayleigh waves. */
fracas_figure_draw fracas_figure_cracks;
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

/* All figures but those of means and fits, in the order of the page; ends with section NULL. A new
 * figure is a function and a line in figures.c. */
extern const fracas_figure fracas_figures[];

enum {
    FRACAS_FIGURE_LOW = 200,
    FRACAS_FIGURE_TALL = 300
}; /* pixels of a panel: of one point, of all */

/* "16 to 64", or "64" */
fracas_number_text fracas_figure_range(size_t least, size_t most);

/* Adds steps: the number of the n ascending values that are v or more, over `whole`, against
 * v/unit. Values equal to rounding (1e-9) are one: they are the same number of elements. */
FRACAS_MUST_USE fracas_err fracas_figure_steps(const double *value, size_t n, double unit,
                                               double whole, unsigned look, fracas_panel *panel);

/* File name and title of a figure of one point. */
void fracas_figure_name(const fracas_analysis *analysis, size_t point, const char *file,
                        const char *title, fracas_chart *chart);

#endif
