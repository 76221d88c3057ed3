/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Charts as SVG and as CSV, both from the same values: panels of series over two axes. */
#ifndef FRACAS_ANALYSIS_DRAW_CHART_H
#define FRACAS_ANALYSIS_DRAW_CHART_H

#include "analysis/data/text.h"
#include "base/err.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

typedef enum {
    FRACAS_CURVE, /* straight lines from value to value */
    FRACAS_STEPS, /* down to the next y, then across: a complementary cumulative */
    FRACAS_MARKS, /* a mark a value, with a bar from low to high, open below a log axis */
    FRACAS_BAND,  /* an area from low to high, and the line y within it */
    FRACAS_BOXES  /* a narrow area a value, from low to high */
} fracas_series_kind;

typedef struct {
    char name[128]; /* in the legend and on hover */
    fracas_series_kind kind;
    unsigned look; /* which colour, dash or shape of mark: each look is another */
    bool open;     /* MARKS: outlines, in the legend with the filled series of this look */
    size_t n;
    double *x, *y;
    double *low, *high; /* for MARKS, BAND and BOXES; NaN: no bar, a gap in the area, no box */
} fracas_series;

typedef struct {
    char label[96]; /* "": none */
    bool log;
    size_t nnames; /* on x: values about 1, 2, ... nnames have names; 0: an ordinary axis */
    const char *const *name; /* these; they outlive the chart */
    double show[2];          /* least and greatest value to show beside the data; equal: none */
} fracas_axis;

typedef struct {
    fracas_axis x, y;
    char title[128];  /* above it; "": none */
    double height;    /* pixels of the plot area */
    double y_floor;   /* smaller values are not shown; 0 for none */
    const char *bars; /* meaning of low to high, as on hover: "95 %"; NULL is the same */
    size_t nseries, capacity;
    fracas_series *series;
} fracas_panel;

enum { FRACAS_MAX_PANELS = 12 };

/* Axes offered on a page beside the logarithmic ones of the figure. */
typedef enum {
    FRACAS_AXES_OWN = 0,     /* as the panels have them */
    FRACAS_AXES_SEMILOG = 1, /* x linear */
    FRACAS_AXES_LINEAR = 2
} fracas_axes;

typedef struct {
    char file[96]; /* name of the SVG, PDF and CSV files without their endings */
    char title[256];
    char caption[1024]; /* sentences: subject, n, meaning of the bars */
    unsigned offers;    /* FRACAS_AXES_SEMILOG | FRACAS_AXES_LINEAR as far as sensible; 0: none */
    int width;          /* pixels of the drawing's own coordinates; a page scales it */
    size_t columns;     /* small multiples: so many panels beside each other, with one legend, and
                           labels of the axes at the edges alone; 0: one above the other */
    size_t npanels;
    fracas_panel panel[FRACAS_MAX_PANELS];
} fracas_chart;

enum {
    FRACAS_CHART_WIDE = 470,
    FRACAS_CHART_NARROW = 380,
    FRACAS_CHART_MULTIPLES = 760
}; /* narrow enough for text to be readable on a phone */

enum { FRACAS_CHART_COLOURS = 6 }; /* classes c0 to c5 of the style sheet */
enum { FRACAS_CHART_GREY = 100 };  /* looks from here on are grey, class cg: no data */

/* A wide chart without panels. */
void fracas_chart_init(fracas_chart *chart);
void fracas_chart_clear(fracas_chart *chart);

/* Adds a panel (at most FRACAS_MAX_PANELS). */
fracas_panel *fracas_chart_add(fracas_chart *chart, double height);
/* Adds a series with room for n values in x and y (and low and high for MARKS, BAND and BOXES), n
 * >= 0. */
FRACAS_MUST_USE fracas_err fracas_panel_add(fracas_panel *panel, fracas_series_kind kind,
                                            unsigned look, size_t n, fracas_series **series);

/* Opens the <svg> element of a drawing of so many pixels; the caller closes it. `standalone`: a
 * file of its own, with its style, on white; else for a page with the style sheets below,
 * light or dark as the reader has it. */
void fracas_svg_begin(const char *title, int width, double height, bool standalone, FILE *out);
/* Writes the whole element. */
void fracas_chart_write(const fracas_chart *chart, bool standalone, FILE *out);
/* The same for a page, with these axes. */
void fracas_chart_write_axes(const fracas_chart *chart, fracas_axes axes, FILE *out);

/* The data of fracas_chart_write, a line a value: panel (from 1), series, kind (mark, curve, steps,
 * band, box), x (or its name), y, low, high; of small multiples the panel's title. The first line
 * names them with the labels of the axes and their units, separated by " | " where panels differ.
 * An empty field is NaN. */
void fracas_chart_csv(const fracas_chart *chart, FILE *out);

/* True if value i of the series is drawn: finite, above 0 on a log axis, not below the panel's
 * floor. */
bool fracas_panel_shows(const fracas_panel *panel, const fracas_series *series, size_t i);

/* Least and greatest shown value on both axes, bars included; {INFINITY, -INFINITY}: none. */
void fracas_panel_extent(const fracas_panel *panel, double x[2], double y[2]);

/* Gives the first panels of all charts the same axes; of small multiples all panels. */
void fracas_charts_align(fracas_chart *chart, size_t count);

/* The name of a value on an axis with names; NULL on any other. */
const char *fracas_axis_name(const fracas_axis *axis, double value);

extern const char fracas_chart_style[];   /* every drawing: Colours of Okabe and Ito */
extern const char fracas_surface_style[]; /* pictures of surfaces, beside it */
extern const char fracas_page_style[];    /* for the page; drawings in the dark, too */
extern const char fracas_page_script[];
extern const char fracas_film_script[]; /* the film of a body that moves */

#endif
