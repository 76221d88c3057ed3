/* Charts as SVG: panels of series over two axes. */
#ifndef FRACAS_ANALYSIS_REPORT_CHART_H
#define FRACAS_ANALYSIS_REPORT_CHART_H

#include "base/err.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

typedef enum {
    FRACAS_CURVE, /* straight lines from value to value */
    FRACAS_STEPS, /* from a value down to the next one's y, then across: a complementary cumulative */
    FRACAS_MARKS  /* a mark a value, with a bar from low to high; open below where low is off a log axis */
} fracas_series_kind;

typedef struct {
    char name[128];      /* in the legend and on hover */
    fracas_series_kind kind;
    unsigned look;       /* which colour, dash or shape of mark: each look is another */
    size_t n;
    double *x, *y;
    double *low, *high;  /* of MARKS; NaN: no bar */
} fracas_series;

typedef struct {
    char label[96];      /* "": none */
    bool log;
} fracas_axis;

typedef struct {
    fracas_axis x, y;
    double height;  /* pixels of the plot area */
    double y_floor; /* smaller values are not shown; 0 for none */
    size_t nseries, capacity;
    fracas_series *series;
} fracas_panel;

enum { FRACAS_MAX_PANELS = 2 };

typedef struct {
    char file[64];    /* name of the SVG file without its ending */
    char title[256];
    char caption[1024];
    int width;        /* pixels of the drawing's own coordinates; a page scales it */
    size_t npanels;   /* one above the other */
    fracas_panel panel[FRACAS_MAX_PANELS];
} fracas_chart;

enum { FRACAS_CHART_WIDE = 470, FRACAS_CHART_NARROW = 380 }; /* narrow enough for text to be readable on a phone */

enum { FRACAS_CHART_COLOURS = 6 }; /* classes c0 to c5 of the style sheet */

/* A wide chart without panels. */
void fracas_chart_init(fracas_chart *chart);
void fracas_chart_clear(fracas_chart *chart);

/* Adds a panel (at most FRACAS_MAX_PANELS). */
fracas_panel *fracas_chart_add(fracas_chart *chart, double height);
/* Adds a series with room for n values in x and y (and low and high for MARKS), n >= 0. */
FRACAS_MUST_USE fracas_err fracas_panel_add(fracas_panel *panel, fracas_series_kind kind, unsigned look, size_t n,
                                            fracas_series **series);

/* Opens the <svg> element of a drawing of so many pixels; who draws closes it. `standalone`: a file of its own, with its
 * style, on white; else for a page that has fracas_chart_style, light or dark as the reader has it. */
void fracas_svg_begin(const char *title, int width, double height, bool standalone, FILE *out);
/* Writes the whole element. */
void fracas_chart_write(const fracas_chart *chart, bool standalone, FILE *out);

/* Style sheet of the charts of a page: light, then dark inside its media query. Colours of Okabe and Ito (2008). */
void fracas_chart_style(FILE *out);

/* Writes text with &, <, > and " escaped. */
void fracas_markup_text(const char *text, FILE *out);

#endif
