/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Figures of a point: energies of a replica and of all, convergence, fits. */
#include "analysis/report/figures.h"

#include "analysis/data/format.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { STRIP = 80 }; /* pixels */

/* ---- energies ---- */

/* Curves of energies over time, of a replica or of all. Kinetic energy and its parts are drawn less
 * their `start`, as of a flying ring: it would dwarf all other energies. */
typedef struct {
    double start[FRACAS_ENERGIES], largest[FRACAS_ENERGIES]; /* J; |value - start| at most */
} energy_curves;

/* The whole of a part; any other energy itself. */
static size_t whole_of(size_t energy)
{
    while (fracas_energies[energy].role == FRACAS_ROLE_PART) energy--;
    return energy;
}

/* At a time of the curve: its value, and the one farthest from it [J]. */
static void add_value(energy_curves *curves, size_t energy, double time, double value, double far)
{
    double *start = &curves->start[energy], *largest = &curves->largest[energy];
    if (time == 0 && fracas_energies[whole_of(energy)].role == FRACAS_ROLE_KINETIC) *start = value;
    *largest = fmax(*largest, fabs(far - *start));
}

/* A part, damping, or a sink after the first, has a curve if it is ever above 0; created energy and
 * its parts have none. */
static bool has_curve(const energy_curves *curves, size_t energy)
{
    const fracas_energy_role role = fracas_energies[energy].role;
    const bool later = role == FRACAS_ROLE_DAMPING ||
                       (role == FRACAS_ROLE_SINK && energy > 0 &&
                        fracas_energies[whole_of(energy - 1)].role == FRACAS_ROLE_SINK);
    if (fracas_energies[whole_of(energy)].role == FRACAS_ROLE_SOURCE) return false;
    return !(role == FRACAS_ROLE_PART || later) || curves->largest[energy] > 0;
}

static double largest_of(const energy_curves *curves)
{
    double largest = 0;
    for (size_t e = 0; e < FRACAS_ENERGIES; e++)
        if (has_curve(curves, e)) largest = fmax(largest, curves->largest[e]);
    return largest;
}

/* A part has the colour of its whole and other dashes, each its own; the look of FRACAS_ENERGIES is
 * that of a curve after all. */
static unsigned look_of(size_t energy)
{
    const size_t whole = energy < FRACAS_ENERGIES ? whole_of(energy) : energy;
    unsigned look = (unsigned)(energy - whole) * FRACAS_CHART_COLOURS;
    for (size_t e = 0; e < whole; e++)
        look += fracas_energies[e].role != FRACAS_ROLE_PART &&
                fracas_energies[e].role != FRACAS_ROLE_SOURCE;
    return look;
}

static fracas_err add_curve(const energy_curves *curves, size_t energy, fracas_series_kind kind,
                            size_t rows, fracas_panel *panel, fracas_series **series)
{
    const char *key = fracas_energies[energy].key;
    const int length = (int)strcspn(key, "_"); /* "dissipated_bending": "dissipated, bending" */
    TRY(fracas_panel_add(panel, kind, look_of(energy), rows, series));
    FRACAS_PRINT((*series)->name, "%.*s%s%s%s", length, key, key[length] ? ", " : "",
                 key[length] ? key + length + 1 : "", curves->start[energy] > 0 ? " - start" : "");
    return FRACAS_OK;
}

/* The curves of all energies, and of the residual of their balance (bar.14) below them. */
static fracas_err add_energies(const fracas_point_statistics *statistics,
                               const energy_curves *curves, double time, double joule,
                               fracas_chart *chart)
{
    fracas_panel *panel = fracas_chart_add(chart, FRACAS_FIGURE_LOW);
    const size_t rows = statistics->nhistory;
    const fracas_history_row *row = statistics->history;
    fracas_series *series;
    for (size_t e = 0; e < FRACAS_ENERGIES; e++) {
        if (!has_curve(curves, e)) continue;
        TRY(add_curve(curves, e, FRACAS_CURVE, rows, panel, &series));
        for (size_t i = 0; i < rows; i++) {
            series->x[i] = row[i].time * time;
            series->y[i] = (row[i].energy[e] - curves->start[e]) * joule;
        }
    }
    TRY(fracas_panel_add(fracas_chart_add(chart, STRIP), FRACAS_CURVE, look_of(FRACAS_ENERGIES),
                         rows, &series));
    FRACAS_PRINT(series->name, "|residual|");
    for (size_t i = 0; i < rows; i++) {
        series->x[i] = row[i].time * time;
        series->y[i] = fabs(row[i].residual * joule);
    }
    return FRACAS_OK;
}

/* A residual so far below the largest energy is rounding; it would stretch the axis. */
static const double residual_floor = 1e-12;

fracas_err fracas_figure_energies(const fracas_analysis *analysis, size_t point,
                                  fracas_chart *chart)
{
    const fracas_point_statistics *statistics = &analysis->point[point];
    energy_curves curves = {0};
    fracas_figure_name(analysis, point, "energies", "Energies", chart);
    for (size_t i = 0; i < statistics->nhistory; i++)
        for (size_t e = 0; e < FRACAS_ENERGIES; e++)
            add_value(&curves, e, statistics->history[i].time, statistics->history[i].energy[e],
                      statistics->history[i].energy[e]);
    const double largest = largest_of(&curves);
    if (!(largest > 0)) return FRACAS_OK;
    fracas_prefix time = fracas_prefix_for(&statistics->history[statistics->nhistory - 1].time, 1);
    fracas_prefix joule = fracas_prefix_for(&largest, 1);
    TRY(add_energies(statistics, &curves, time.factor, joule.factor, chart));
    fracas_panel *lower = &chart->panel[1];
    lower->y.log = true;
    lower->y_floor = residual_floor * largest * joule.factor;
    FRACAS_PRINT(lower->x.label, "time [%ss]", time.sign);
    for (size_t p = 0; p < chart->npanels; p++)
        FRACAS_PRINT(chart->panel[p].y.label, "energy [%sJ]", joule.sign);
    char motion[128] =
        "Kinetic energy is that of the motion beside the imposed stretching, work likewise.";
    const double start = curves.start[FRACAS_ENERGY_kinetic];
    if (start > 0)
        FRACAS_PRINT(motion, "Kinetic energy less the %.4g J that the %s starts with.", start,
                     statistics->surface ? "surface" : "ring");
    else if (statistics->surface) motion[0] = '\0';
    FRACAS_PRINT(
        chart->caption,
        "Replica %lld of %lld, the one whose dissipated energy is the nearest to the mean. "
        "%s%sBelow: |residual| of the energy balance; its largest value over all replicas is "
        "%s of the dissipated energy, %s of the largest total energy.",
        (long long)statistics->typical_replica, (long long)statistics->usable, motion,
        *motion ? " " : "", fracas_digits(statistics->residual, 2).text,
        fracas_digits(statistics->residual_total, 2).text);
    return FRACAS_OK;
}

fracas_err fracas_figure_bands(const fracas_analysis *analysis, size_t point, fracas_chart *chart)
{
    const fracas_bands *bands = &analysis->point[point].bands;
    energy_curves curves = {0};
    fracas_figure_name(analysis, point, "bands", "Energies of all realizations", chart);
    for (size_t j = 0; j < bands->count; j++)
        for (size_t e = 0; e < FRACAS_ENERGIES; e++)
            add_value(&curves, e, bands->time[j], bands->energy[j][e].mean,
                      bands->energy[j][e].high);
    const double largest = largest_of(&curves);
    if (bands->realizations < 2 || !(largest > 0)) return FRACAS_OK;
    const fracas_prefix time = fracas_prefix_for(&bands->time[bands->count - 1], 1),
                        joule = fracas_prefix_for(&largest, 1);
    fracas_panel *panel = fracas_chart_add(chart, FRACAS_FIGURE_LOW);
    panel->bars = bands->extremes ? "least to greatest" : "5 to 95 %";
    for (size_t e = 0; e < FRACAS_ENERGIES; e++) {
        const double start = curves.start[e];
        fracas_series *series;
        if (!has_curve(&curves, e)) continue;
        TRY(add_curve(&curves, e, FRACAS_BAND, bands->count, panel, &series));
        for (size_t j = 0; j < bands->count; j++) {
            const fracas_band *band = &bands->energy[j][e];
            series->x[j] = bands->time[j] * time.factor;
            series->y[j] = (band->mean - start) * joule.factor;
            series->low[j] = (band->low - start) * joule.factor;
            series->high[j] = (band->high - start) * joule.factor;
        }
    }
    FRACAS_PRINT(panel->x.label, "time [%ss]", time.sign);
    FRACAS_PRINT(panel->y.label, "energy [%sJ]", joule.sign);
    FRACAS_PRINT(chart->caption,
                 "Lines: means over n = %lld realizations; areas: %s. A realization that has ended "
                 "counts with what it had in the end%s.",
                 (long long)bands->realizations,
                 bands->extremes ? "from the least to the greatest"
                                 : "between the quantiles 5 % and 95 %",
                 bands->running[bands->count - 1] < bands->realizations
                     ? "; at the last times some are still running"
                     : "");
    return FRACAS_OK;
}

/* ---- fragments ---- */

/* The estimate of the final count at the time where it is expected, held fragments added. */
static fracas_err add_final(const fracas_final *final, double factor, fracas_panel *panel)
{
    fracas_series *series;
    if (isnan(final->count.value)) return FRACAS_OK;
    TRY(fracas_panel_add(panel, FRACAS_MARKS, 1, 1, &series));
    FRACAS_PRINT(series->name, "final count, estimated");
    series->x[0] = fmax(final->reach, final->end) * factor;
    series->y[0] = final->count.value + final->held;
    series->low[0] = final->count.low + final->held;
    series->high[0] = final->count.high + final->held;
    return FRACAS_OK;
}

fracas_err fracas_figure_fragments(const fracas_analysis *analysis, size_t point,
                                   fracas_chart *chart)
{
    const fracas_bands *bands = &analysis->point[point].bands;
    const fracas_final *final = &analysis->point[point].final;
    fracas_figure_name(analysis, point, "fragments", "Fragments over time", chart);
    if (bands->count < 2 || final->verdict == FRACAS_FINAL_NONE) return FRACAS_OK;
    const fracas_prefix time = fracas_prefix_for(&bands->time[bands->count - 1], 1);
    fracas_panel *panel = fracas_chart_add(chart, FRACAS_FIGURE_LOW);
    fracas_series *series;
    panel->bars = bands->extremes ? "least to greatest" : "5 to 95 %";
    TRY(fracas_panel_add(panel, FRACAS_BAND, 0, bands->count, &series));
    FRACAS_PRINT(series->name, "fragments");
    for (size_t j = 0; j < bands->count; j++) {
        series->x[j] = bands->time[j] * time.factor;
        series->y[j] = bands->fragments[j].mean;
        series->low[j] = bands->fragments[j].low;
        series->high[j] = bands->fragments[j].high;
    }
    TRY(add_final(final, time.factor, panel));
    FRACAS_PRINT(panel->x.label, "time [%ss]", time.sign);
    FRACAS_PRINT(panel->y.label, "fragments");
    FRACAS_PRINT(chart->caption,
                 "Mean of n = %lld realizations; at the end %s transits of a mean fragment since "
                 "the first crack, of whose time the last half added %s %%. Mark: where %s more "
                 "breaks would bring the count.",
                 (long long)bands->realizations, fracas_digits(final->transits, 2).text,
                 fracas_digits(100 * final->growth, 2).text,
                 fracas_digits(final->count.value - final->seen, 2).text);
    return FRACAS_OK;
}

/* ---- convergence ---- */

fracas_err fracas_figure_convergence(const fracas_analysis *analysis, size_t point,
                                     fracas_chart *chart)
{
    const fracas_replica_convergence *of = &analysis->point[point].convergence;
    fracas_figure_name(analysis, point, "convergence", "Convergence with replicas", chart);
    if (of->count < 2) return FRACAS_OK;
    const fracas_running *all = &of->row[of->count - 1];
    chart->width = FRACAS_CHART_NARROW;
    fracas_panel *panel = fracas_chart_add(chart, FRACAS_FIGURE_LOW);
    for (unsigned h = 0; h < FRACAS_NHEADLINES; h++) {
        const double last = all->number[h].value;
        fracas_series *series;
        if (!(fabs(last) > 0) || !isfinite(last)) continue;
        TRY(fracas_panel_add(panel, FRACAS_CURVE, h, of->count, &series));
        FRACAS_PRINT(series->name, "%s", fracas_headline_key[h]);
        for (size_t i = 0; i < of->count; i++) {
            series->x[i] = (double)of->row[i].replicas;
            series->y[i] = 100 * (of->row[i].number[h].value / last - 1);
        }
    }
    panel->x.log = true;
    FRACAS_PRINT(panel->x.label, "replicas");
    FRACAS_PRINT(panel->y.label, "change to all replicas [%%]");
    const int64_t open = of->unconverged;
    char verdict[64] = "all are converged";
    if (open > 0)
        FRACAS_PRINT(verdict, "%lld %s not converged", (long long)open, open > 1 ? "are" : "is");
    FRACAS_PRINT(chart->caption,
                 "Headline numbers from the first so many replicas, against those of all %lld: %s "
                 "(half width at most 5 %%, and no drift between the halves).",
                 (long long)all->replicas, verdict);
    return FRACAS_OK;
}

/* ---- fits ---- */

enum { BEST = 3, CURVE_VALUES = 160 };

/* The n sizes above the cut: P(size >= s | size > cut), each size of a lattice at the lower edge of
 * its cell. */
static fracas_err add_above(const fracas_point_statistics *statistics, size_t n, double cut,
                            double factor, fracas_panel *panel, size_t *above)
{
    const double *size = statistics->fragment_size, half = statistics->ensemble.lattice / 2;
    size_t first = 0, vertex = 0;
    while (first < n && !(size[first] > cut)) first++;
    *above = n - first;
    fracas_series *series;
    /* k elements count as spread over k -+ 1/2 of them, as in the likelihood: the shares at these
     * ends are known */
    const bool lattice = half > 0;
    TRY(fracas_panel_add(panel, lattice ? FRACAS_MARKS : FRACAS_STEPS, 0, *above, &series));
    FRACAS_PRINT(series->name, "fragments");
    for (size_t i = first; i < n; i++) {
        if (i > first && size[i] <= size[i - 1] * (1 + 1e-9)) continue; /* equal */
        series->x[vertex] = (size[i] - half) * factor;
        series->y[vertex] = (double)(n - i) / (double)*above;
        if (lattice) series->low[vertex] = series->high[vertex] = NAN;
        vertex++;
    }
    series->n = vertex;
    return FRACAS_OK;
}

static bool read_parameters(const fracas_fits *fits, size_t point, const fracas_family *family,
                            double parameter[FRACAS_FAMILY_PARAMETERS])
{
    for (size_t i = 0; i < family->nparameters; i++) {
        parameter[i] = fracas_fits_value(fits, (int64_t)point, family->name,
                                         family->parameter[i].name);
        if (isnan(parameter[i])) return false;
    }
    return true;
}

/* From size range[0] to range[1]. */
static fracas_err add_family(const fracas_family *family, const double *parameter, double cut,
                             const double range[2], double factor, unsigned look,
                             fracas_panel *panel)
{
    double below, at_cut;
    fracas_series *series;
    TRY(fracas_panel_add(panel, FRACAS_CURVE, look, CURVE_VALUES, &series));
    FRACAS_PRINT(series->name, "%s", family->name);
    family->tails(parameter, cut, cut, &below, &at_cut);
    for (size_t i = 0; i < CURVE_VALUES; i++) {
        const double size = range[0] * pow(range[1] / range[0], (double)i / (CURVE_VALUES - 1));
        double above;
        family->tails(parameter, cut, size, &below, &above);
        series->x[i] = size * factor;
        series->y[i] = above / at_cut;
    }
    return FRACAS_OK;
}

fracas_err fracas_figure_fits(const fracas_analysis *analysis, const fracas_fits *fits,
                              size_t point, fracas_chart *chart)
{
    const fracas_point_statistics *statistics = &analysis->point[point];
    fracas_figure_name(analysis, point, "fits", "Fits to fragment sizes", chart);
    if (!fits) return FRACAS_OK;
    const fracas_fits_row *mean = fracas_fits_find(fits, (int64_t)point, "data", "mean");
    const fracas_fits_row *cut = fracas_fits_find(fits, (int64_t)point, "data", "cut");
    if (!mean || !cut || !(cut->value > 0) || !fracas_fits_ranked(fits, (int64_t)point, 1))
        return FRACAS_OK;
    const fracas_prefix prefix = fracas_prefix_for(&mean->value, 1);
    const fracas_fits_row *whole = fracas_fits_find(fits, (int64_t)point, "data", "whole");
    const size_t n = statistics->nfragments - (whole ? (size_t)whole->value : 0); /* the last */
    size_t above;
    fracas_panel *panel = fracas_chart_add(chart, FRACAS_FIGURE_LOW);
    TRY(add_above(statistics, n, cut->value, prefix.factor, panel, &above));
    const double range[2] = {fmax(cut->value, 0.8 * statistics->fragment_size[n - above]),
                             1.1 * statistics->fragment_size[n - 1]};
    for (int rank = 1; rank <= BEST; rank++) {
        const char *name = fracas_fits_ranked(fits, (int64_t)point, rank);
        const fracas_family *family = name ? fracas_family_find(name) : NULL;
        double parameter[FRACAS_FAMILY_PARAMETERS];
        if (family && read_parameters(fits, point, family, parameter))
            TRY(add_family(family, parameter, cut->value, range, prefix.factor, (unsigned)rank,
                           panel));
    }
    panel->x.log = panel->y.log = true;
    panel->y_floor = 0.3 / (double)above;
    chart->offers = FRACAS_AXES_SEMILOG | FRACAS_AXES_LINEAR;
    FRACAS_PRINT(panel->x.label, "fragment size s [%sm]", prefix.sign);
    FRACAS_PRINT(panel->y.label, "share of fragments \u2265 s");
    FRACAS_PRINT(
        chart->caption,
        "Of the n = %zu fragments larger than %.4g %sm, below which the mesh decides, of %lld "
        "replicas together: the share that is at least of size s%s. Lines: the %d families of "
        "least AICc, by maximum likelihood.",
        above, cut->value * prefix.factor, prefix.sign,
        (long long)statistics->usable - (whole ? (long long)whole->value : 0),
        statistics->ensemble.lattice > 0
            ? ", at half an element from the sizes, which are whole numbers of elements"
            : "",
        BEST);
    return FRACAS_OK;
}
