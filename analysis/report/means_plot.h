/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A figure of means in the making; for figures_means.c, and means_words.c, which names it. */
#ifndef FRACAS_ANALYSIS_REPORT_MEANS_PLOT_H
#define FRACAS_ANALYSIS_REPORT_MEANS_PLOT_H

#include "analysis/report/figures.h"
#include "analysis/scaling/scaling.h"

#include <math.h>

typedef struct {
    size_t point;
    size_t series;  /* for the whole figure, in the order of first points */
    size_t drawing; /* likewise */
    size_t panel;   /* likewise */
    char name[128]; /* slopes and crossovers know its series by this */
} fracas_mean_mark;

/* Marks of a figure, or of one of its drawings. */
typedef struct {
    const fracas_analysis *analysis;
    const fracas_means_axes *axes;
    fracas_means of;
    fracas_ordinate ordinate;
    bool same_scales;           /* one curve of a law serves all marks */
    double factor;              /* from the SI value to the axis */
    size_t n, nseries, npanels; /* series and panels: for the whole figure */
    fracas_mean_mark *mark;
    double x[2]; /* least and greatest of the whole figure */
    fracas_size_slope *slope;
    size_t nslopes;
    fracas_size_crossover *crossover;
    size_t ncrossovers;
} fracas_means_plot;

/* True if one curve of a scaling law serves all marks of the series. */
bool fracas_means_series_serves(const fracas_means_plot *plot, size_t series);

static inline bool fracas_means_normalised(const fracas_means_plot *plot)
{
    return plot->of == FRACAS_MEANS_NORMALISED;
}

static inline const fracas_point_statistics *fracas_means_statistics(const fracas_means_plot *plot,
                                                                     size_t mark)
{
    return &plot->analysis->point[plot->mark[mark].point];
}

static inline bool fracas_means_has(const fracas_means_plot *plot, size_t point)
{
    const double x = plot->analysis->axes.value[point];
    double low, high;
    return isfinite(x) && (!plot->analysis->axes.log || x > 0) &&
           isfinite(
               fracas_ordinate_at(&plot->ordinate, &plot->analysis->point[point], &low, &high));
}

/* Lines from mark to mark for the eye; none where laws and powers of the rate are, nor against a
 * text. */
static inline bool fracas_means_joined(const fracas_means_plot *plot)
{
    return !plot->axes->nnames && (!plot->axes->rate || plot->of == FRACAS_MEANS_OTHER);
}

/* True if one series holds all marks of the figure. */
static inline bool fracas_means_alone(const fracas_means_plot *plot)
{
    return plot->nseries == 1 && plot->npanels == 1 && plot->axes->drawings.count == 0;
}

/* File, title and caption of a drawing, by the marks of its own. */
void fracas_means_name(const fracas_means_plot *plot, size_t drawing, fracas_chart *chart);
/* Labels, ranges and scales of the axes of its panel, by all marks of the figure; `sign`: prefix of
 * the ordinate. */
void fracas_means_set_axes(const fracas_means_plot *plot, const char *sign, fracas_chart *chart,
                           fracas_panel *panel);
/* Title of a panel of small multiples, by its marks. */
void fracas_means_name_panel(const fracas_means_plot *plot, fracas_panel *panel);

#endif
