/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/export/side_tables.h"

#include "analysis/scaling/crossover.h"
#include "analysis/scaling/slope.h"
#include "analysis/scaling/windows.h"
#include "base/param.h"

#include <stdio.h>
#include <stdlib.h>

const char *const fracas_slope_table_legend[] = {
    "slope: of log(mean size) against log(strain rate), weighted least squares, each point by the "
    "standard error of its mean over replicas, from one relative variance pooled over the points "
    "that have less than eight; points where no body came apart are left out; after it the half "
    "width of its 95 % interval (Student's t with points - 2 degrees of freedom).",
    "chi2/dof: scatter of the points about the line over what their errors explain; where it is "
    "above 1 the interval is wider by its square root. Mott, Grady: exponents of the theories.",
    NULL,
};
const char *const fracas_window_table_legend[] = {
    "slope: of log(mean size) against log(strain rate) between two neighbouring rates; after it "
    "the half width of its 95 % interval, from the standard errors of the two means (Student's t, "
    "degrees of freedom by Welch and Satterthwaite).",
    "from, to: the rates, and as parts of the characteristic rate edot0 of the material.",
    NULL,
};
const char *const fracas_crossover_table_legend[] = {
    "s = s_q/(1 + (rate/crossover)^k), by least squares of log(mean size), weighted as slopes are: "
    "s_q is the size at low rates (exponent 0), -k the exponent at high rates. In brackets 95 % "
    "intervals by the parametric bootstrap: means drawn again by their standard errors, Student's. "
    "/s0, /edot0: as parts of the characteristic size and rate of the material.",
    "chi2/dof: scatter of the points about the curve over what their errors explain; where it is "
    "above 1 the intervals are wider by its square root. At least five rates with the bend among "
    "them are needed; else the last column says what is missing.",
    NULL,
};
const char *const fracas_motion_table_legend[] = {
    "Velocities of the fragments' centres of mass at the end, each fragment weighed by its mass; "
    "means over replicas with their 95 % intervals, n: replicas with two fragments or more. "
    "outward: mean velocity along the direction from the centre of the ring. scatter: its standard "
    "deviation over fragments.",
    "along: root mean square of the velocity along the ring. spin: mean |angular velocity| about "
    "the centre of mass, with the moment of inertia of an arc.",
    NULL,
};

/* Columns of the struct `type`. */
#define PLACE(type, member) offsetof(type, member)

fracas_err fracas_slope_table_create(const fracas_analysis *analysis, bool unicode,
                                     fracas_result_table *table)
{
#define AT(member) PLACE(fracas_size_slope, member)
    static const fracas_table_column column[] = {
        {"slope", "", FRACAS_CELL_PLUS_MINUS, AT(slope.slope), 0, AT(slope.half_width)},
        {"Mott", "", FRACAS_CELL_NUMBER, AT(mott)},
        {"Grady", "", FRACAS_CELL_NUMBER, AT(grady), 3},
        {"points", "", FRACAS_CELL_INTEGER, AT(slope.n)},
        {"chi2/dof", "", FRACAS_CELL_NUMBER, AT(slope.chi2), 2, AT(slope.freedom)},
        {"series", "", FRACAS_CELL_TEXT, AT(name)},
    };
#undef AT
    fracas_size_slope *list;
    fracas_table_rows rows = {.size = sizeof *list};
    TRY(fracas_size_slopes(analysis, &list, &rows.count));
    rows.first = list;
    const fracas_err err = fracas_table_make(column, FRACAS_COUNT(column), &rows, unicode, table);
    free(list);
    return err;
}

static const char edot0[] = "/edot0", edot0_unicode[] = "/\u03b5\u0307\u2080";

fracas_err fracas_window_table_create(const fracas_analysis *analysis, bool unicode,
                                      fracas_result_table *table)
{
#define AT(member) PLACE(fracas_size_window, member)
    static const fracas_table_column column[] = {
        {"slope", "", FRACAS_CELL_PLUS_MINUS, AT(window.slope), 0, AT(window.half_width)},
        {"from", "[1/s]", FRACAS_CELL_NUMBER, AT(rate[0])},
        {"to", "[1/s]", FRACAS_CELL_NUMBER, AT(rate[1])},
        {"from", edot0, FRACAS_CELL_NUMBER, AT(normalised[0]), 3, .unicode = edot0_unicode},
        {"to", edot0, FRACAS_CELL_NUMBER, AT(normalised[1]), 3, .unicode = edot0_unicode},
        {"series", "", FRACAS_CELL_TEXT, AT(name)},
    };
#undef AT
    fracas_size_window *list;
    fracas_table_rows rows = {.size = sizeof *list};
    TRY(fracas_size_windows(analysis, &list, &rows.count));
    rows.first = list;
    const fracas_err err = fracas_table_make(column, FRACAS_COUNT(column), &rows, unicode, table);
    free(list);
    return err;
}

/* A series of one rate has nothing to cross over from. */
static bool has_rates(const void *row)
{
    return ((const fracas_size_crossover *)row)->n > 1;
}

static void series_text(const fracas_analysis *analysis, size_t index, const void *row, char *text)
{
    const fracas_size_crossover *of = row;
    (void)analysis, (void)index;
    snprintf(text, FRACAS_CELL, "%.60s%s%.60s", of->name, *of->reason ? ": " : "", of->reason);
}

fracas_err fracas_crossover_table_create(const fracas_analysis *analysis, bool unicode,
                                         fracas_result_table *table)
{
#define AT(member) PLACE(fracas_size_crossover, member)
    static const fracas_table_column column[] = {
        {"crossover", "[1/s]", FRACAS_CELL_INTERVAL, AT(rate)},
        {"crossover", edot0, FRACAS_CELL_INTERVAL, AT(rate_normalised), .unicode = edot0_unicode},
        {"s_q", "m", FRACAS_CELL_INTERVAL, AT(size), .prefixed = 1},
        {"s_q", "/s0", FRACAS_CELL_INTERVAL, AT(size_normalised), .unicode = "/s\u2080"},
        {"exponent", "", FRACAS_CELL_INTERVAL, AT(exponent)},
        {"points", "", FRACAS_CELL_INTEGER, AT(n)},
        {"chi2/dof", "", FRACAS_CELL_NUMBER, AT(chi2), 2, AT(freedom)},
        {"series", "", FRACAS_CELL_FORMAT, .format = series_text},
    };
#undef AT
    fracas_size_crossover *list;
    fracas_table_rows rows = {.size = sizeof *list, .keep = has_rates};
    TRY(fracas_size_crossovers(analysis, true, &list, &rows.count));
    rows.first = list;
    const fracas_err err = fracas_table_make(column, FRACAS_COUNT(column), &rows, unicode, table);
    free(list);
    return err;
}

static bool is_ring(const void *row)
{
    return ((const fracas_point_statistics *)row)->radius > 0;
}

fracas_err fracas_motion_table_create(const fracas_analysis *analysis, bool unicode,
                                      fracas_result_table *table)
{
#define AT(member) PLACE(fracas_point_statistics, member)
    static const fracas_table_column column[] = {
        {"n", "", FRACAS_CELL_INTEGER, AT(radial_velocity.n)},
        {"outward", "[m/s]", FRACAS_CELL_ESTIMATE, AT(radial_velocity)},
        {"scatter", "[m/s]", FRACAS_CELL_ESTIMATE, AT(radial_scatter)},
        {"along", "[m/s]", FRACAS_CELL_ESTIMATE, AT(circumferential_velocity)},
        {"spin", "rad/s", FRACAS_CELL_ESTIMATE, AT(angular_velocity), .prefixed = 1},
        {"point", "", FRACAS_CELL_FORMAT, .format = fracas_cell_label},
    };
#undef AT
    const fracas_table_rows rows = {analysis->point, analysis->table->npoints,
                                    sizeof *analysis->point, analysis, is_ring};
    return fracas_table_make(column, FRACAS_COUNT(column), &rows, unicode, table);
}
