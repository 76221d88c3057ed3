/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/summary/study.h"

#include "analysis/data/format.h"
#include "analysis/data/strengths.h"
#include "base/own.h"
#include "base/param.h"

#include <math.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const fracas_field fields[] = {
    FRACAS_FIELD(fracas_warning, INDEX, "point", "1",
                 "number of the point; null: the study as a whole", point),
    FRACAS_FIELD(fracas_warning, TEXT, "kind", "",
                 "one word; `report` has one line for all points of a kind", kind),
    FRACAS_FIELD(fracas_warning, CHARS, "text", "", "the warning", text),
};
const fracas_fields fracas_warning_fields = FRACAS_FIELDS(fields);

static const double residual_limit = 1e-3; /* for the dissipated energy */
static const double created_limit = 1e-2;  /* for the dissipated energy */
static const double elements_limit = 10;   /* elements of a mean fragment */
static const double rise_limit = 0.01;     /* part of the dissipated energy */
static const double zone_limit = 0.25;     /* part of a mean fragment (docs/results/ring.md) */

#define NOTABLE_MEAN 0.005 /* relative difference of mean strengths */

static const double vibration_limit = 0.05; /* |residual| at the end, by the vibrating energy */

enum { WARNINGS_PER_POINT = 24, WARNINGS_PER_STUDY = 2 }; /* at most, of a study beside its notes */

typedef struct {
    size_t count;
    fracas_warning *warning;
} warning_list;

FRACAS_PRINTF(5, 6)
static void warn(warning_list *list, size_t point, const char *kind, double badness,
                 const char *format, ...)
{
    fracas_warning *warning = &list->warning[list->count++];
    warning->kind = kind;
    warning->point = point;
    warning->badness = badness;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(warning->text, sizeof warning->text, format, arguments);
    va_end(arguments);
}

static void warn_of_outcomes(const fracas_point_statistics *statistics, size_t p,
                             warning_list *list)
{
    long long all = (long long)statistics->realizations;
    for (int o = FRACAS_NONFINITE; o <= FRACAS_FAILED; o++)
        if (statistics->outcome[o] > 0)
            warn(list, p, fracas_outcome_name(o), (double)statistics->outcome[o] / (double)all,
                 "%lld of %lld realizations ended %s and are left out: the means may be biased",
                 (long long)statistics->outcome[o], all, fracas_outcome_name(o));
    if (statistics->outcome[FRACAS_INTACT] > 0)
        warn(list, p, "INTACT", (double)statistics->outcome[FRACAS_INTACT] / (double)all,
             "%lld of %lld realizations ended INTACT, nothing broken: if that is unexpected, load "
             "harder or raise time.end",
             (long long)statistics->outcome[FRACAS_INTACT], all);
    if (statistics->kept > 0)
        warn(
            list, p, "balance", (double)statistics->kept / (double)all,
            "%lld of %lld realizations lost their energy balance and count as they were before, at "
            "%s to %s (TIME_LIMIT), when nothing had broken for a third of that time: let time.end "
            "be earlier, or lower time.safety if that mends it",
            (long long)statistics->kept, all,
            fracas_with_unit(statistics->kept_at[0], 3, "s", false).text,
            fracas_with_unit(statistics->kept_at[1], 3, "s", false).text);
    const long long stopped = (long long)(statistics->outcome[FRACAS_TIME_LIMIT] -
                                          statistics->kept);
    if (stopped > 0 && statistics->final.verdict != FRACAS_FINAL_YES)
        warn(list, p, "TIME_LIMIT", (double)stopped / (double)all,
             "%lld of %lld realizations were stopped by time.end with cracks still running "
             "(TIME_LIMIT): raise time.end",
             stopped, all);
}

/* A shorter step does not close the ledger of a law that leaves it open. */
static void warn_of_balance(const fracas_point_statistics *statistics, bool open, size_t p,
                            warning_list *list)
{
    if (open) {
        if (!(statistics->residual > 0)) return;
        warn(
            list, p, "open", statistics->residual,
            "its law gains or loses energy on mixed paths, and no ENERGY_DRIFT ends it: |residual| "
            "up to %s of the dissipated, %s of the largest energy: for results give cohesive.law: "
            "nitsche",
            fracas_digits(statistics->residual, 2).text, fracas_digits(statistics->drift, 2).text);
        return;
    }
    if (statistics->residual > residual_limit)
        warn(
            list, p, "residual", statistics->residual,
            "ledger residual up to %s of the dissipated energy (more than 1e-3): lower time.safety",
            fracas_digits(statistics->residual, 2).text);
    if (statistics->drifted > 0)
        warn(list, p, "drift", statistics->drift,
             "energy drift above 1 %%: %lld of %lld usable realizations, their |residual| up to %s "
             "%% of their largest energy: lower time.safety",
             (long long)statistics->drifted, (long long)statistics->usable,
             fracas_digits(100 * statistics->drift, 2).text);
    if (statistics->heated > vibration_limit)
        warn(
            list, p, "vibration", statistics->heated,
            "ledger residual up to %s of the vibrating energy (more than 0.05): late breaks may be "
            "the step's: lower time.safety",
            fracas_digits(statistics->heated, 2).text);
}

/* Nothing is left to break: neither a longer run nor more replicas change the count. */
static bool all_elements_apart(const fracas_point_statistics *statistics)
{
    return statistics->elements == 1; /* a quotient of two equal sums */
}

/* Elements come off held edges, most of all at their corners, where the stress grows with each
 * refinement. */
static void warn_of_sizes(const fracas_point_statistics *statistics, size_t p, warning_list *list)
{
    if (all_elements_apart(statistics)) {
        warn(list, p, "apart", statistics->usable,
             "each element is a fragment, so that the mesh decides the count, and no longer run "
             "changes it: refine the mesh, or let strengths scatter more");
        return;
    }
    if (statistics->elements < elements_limit)
        warn(list, p, "elements", -statistics->elements,
             "a mean fragment has %.1f elements (fewer than 10): refine the mesh",
             statistics->elements);
    if (statistics->dust_share > FRACAS_DUST_LIMIT)
        warn(list, p, "dust", statistics->dust_share,
             "%.1f %% of the fragments are dust, of so few elements that the mesh decides (more "
             "than 5 %%): refine the mesh%s",
             100 * statistics->dust_share,
             statistics->surface ? ", unless the dust came off held edges, most of all at their "
                                   "corners: no mesh mends that"
                                 : "");
}

static void warn_of_point(const fracas_point_table *table,
                          const fracas_point_statistics *statistics, size_t p, warning_list *list)
{
    if (statistics->usable == 0) warn(list, p, "unusable", 1, "no usable realization");
    warn_of_outcomes(statistics, p, list);
    warn_of_balance(statistics, fracas_columns_real(table, p, "derived.open_ledger") == 1, p, list);
    if (statistics->created > created_limit)
        warn(list, p, "created", statistics->created,
             "energy created at breaks up to %s of the dissipated energy (more than 1e-2): refine "
             "the mesh or raise cohesive.beta",
             fracas_digits(statistics->created, 2).text);
    warn_of_sizes(statistics, p, list);
}

static bool has_text(const fracas_point_table *table, size_t p, const char *path)
{
    const size_t column = fracas_point_table_find(table, path);
    return column != SIZE_MAX && *table->point[p].value[column].text;
}

/* True if chance is nowhere: one strength, or those of a file without an interpolation. The mesh is
 * one of a point. */
static bool replicas_are_equal(const fracas_point_table *table, size_t p)
{
    return isfinite(fracas_columns_real(table, p, "strength.value")) ||
           (has_text(table, p, "strength.file") && !has_text(table, p, "strength.interpolation"));
}

/* The headline numbers with a half width above FRACAS_CONVERGED_WIDTH, or with different halves. */
static void warn_of_convergence(const fracas_point_statistics *statistics, size_t p,
                                warning_list *list)
{
    const fracas_replica_convergence *of = &statistics->convergence;
    if (of->unconverged == 0) return;
    if (statistics->outcome[FRACAS_INTACT] == statistics->usable) return; /* nothing broke: said */
    const fracas_running *all = &of->row[of->count - 1];
    if (all->replicas < 2) {
        warn(list, p, "single", 1,
             "one usable replica cannot say how well anything is known: raise replicas");
        return;
    }
    char text[320] = "";
    double widest = 0;
    for (int h = 0; h < FRACAS_NHEADLINES; h++) {
        const fracas_running_value *number = &all->number[h];
        if (of->converged[h] || !isfinite(number->value)) continue;
        const double relative = 0.5 * (number->high - number->low) / fabs(number->value);
        widest = fmax(widest, relative);
        fracas_append(text, sizeof text, ", ", "%s to %s %%%s", fracas_headline_key[h],
                      fracas_digits(number->high > number->low ? 100 * relative : 0, 2).text,
                      fracas_replica_convergence_drifts(of, (fracas_headline)h) ? " (drifts)"
                      : fracas_running_alike(number)                            ? " (all alike)"
                                                                                : "");
    }
    warn(list, p, "unconverged", widest, "unconverged with %lld replicas, known %s: raise replicas",
         (long long)all->replicas, text);
}

/* Bodies that ran until time.end and were still breaking: `stop: time` ends them early. */
static void warn_of_end(const fracas_bands *bands, double end, size_t p, warning_list *list)
{
    if (bands->count == 0 || bands->time[bands->count - 1] < end * (1 - 1e-9)) return;
    const size_t last = bands->count - 1;
    size_t before = last;
    while (before > 0 && bands->time[before - 1] >= 0.9 * end * (1 - 1e-9))
        before--; /* within the last tenth: the end itself of fewer than ten intervals */
    const double dissipated = bands->energy[last][FRACAS_ENERGY_dissipated].mean;
    const double rise = dissipated - bands->energy[before][FRACAS_ENERGY_dissipated].mean;
    if (!(rise > rise_limit * dissipated)) return;
    warn(list, p, "breaking", rise / dissipated,
         "bodies were still breaking at time.end: %s %% of the energy was dissipated in the last "
         "tenth of the time (more than 1 %%): raise time.end",
         fracas_digits(100 * rise / dissipated, 2).text);
}

/* (settled.8); `end`: time.end [s], before which a stop rule may have ended the realizations. */
static void warn_of_final(const fracas_final *final, double dust_share, double end, size_t p,
                          warning_list *list)
{
    const double least = 100 * (final->count.low / final->seen - 1),
                 most = 100 * (final->count.high / final->seen - 1);
    char range[128], text[512];
    if (final->held > 0 && dust_share > 0) /* else these are large, as the body itself */
        warn(list, p, "held", final->held,
             "%.4g fragments a body are on an edge that moves with the load, where elements come "
             "off one by one for ever: their number is the mesh's: take them off the count",
             final->held);
    if (least > 0)
        FRACAS_PRINT(range, "%s to %s", fracas_digits(least, 2).text, fracas_digits(most, 2).text);
    else FRACAS_PRINT(range, "up to %s", fracas_digits(most, 2).text);
    FRACAS_PRINT(text,
                 "%s transits of a mean fragment since the first crack, the last half of that time "
                 "added %s %%, %s %% more may come",
                 fracas_digits(final->transits, 2).text, fracas_digits(100 * final->growth, 2).text,
                 range);
    if (final->verdict == FRACAS_FINAL_CREEP)
        warn(list, p, "creep", final->vibrating,
             "no final count: fragments keep %s of the dissipated energy as vibration and break on "
             "for hundreds of transits: %s: give the count with its transits",
             fracas_digits(final->vibrating, 2).text, text);
    if (final->verdict == FRACAS_FINAL_NO)
        warn(list, p, "final", final->count.value / final->seen, "count not final: %s: let %s %s",
             text, final->reach > end ? "time.end be about" : "the rule time.stop end it at about",
             fracas_with_unit(final->reach, 2, "s", false).text);
}

enum { PAST = 200 };

/* sqrt(A/N) or Lambda/N over the realizations [m]. */
static double mean_fragment(const fracas_point_statistics *statistics)
{
    double area = 0;
    for (size_t i = 0; i < statistics->nfragments; i++)
        area += statistics->fragment_size[i] * statistics->fragment_size[i];
    return statistics->surface ? sqrt(area / (double)statistics->nfragments)
                               : statistics->size.mean;
}

/* k of the mean time and fragment  (settled.1), held ones included, and Delta of the mean count
 * (settled.2) where histories have it; "" without histories. */
static void write_past(const fracas_point_table *table, size_t p,
                       const fracas_point_statistics *statistics, char text[PAST])
{
    const fracas_past *past = &statistics->past;
    const double poisson = statistics->surface ? fracas_columns_real(table, p, "material.poisson")
                                               : 0,
                 wave = sqrt(fracas_columns_real(table, p, "material.young") /
                             fracas_columns_real(table, p, "material.density") /
                             (1 - poisson * poisson)),
                 transits = past->time / past->realizations * wave / mean_fragment(statistics),
                 growth = 100 * (1 - past->half / past->seen);
    *text = 0;
    if (past->realizations == 0) return;
    const int used = snprintf(text, PAST, " after %s transits of a mean fragment",
                              fracas_digits(transits, 2).text);
    if (isfinite(growth))
        snprintf(text + used, PAST - (size_t)used, ", of which the last half added %s %%",
                 fracas_digits(growth, 2).text);
}

/* Studies of format version 3 and less do not say how final their counts are. Bars that 100 ns
 * without a break ended lacked so much (docs/decisions/settled-counts.md). */
static void warn_of_quiet(const fracas_analysis *analysis, size_t p, warning_list *list)
{
    const double quiet = fracas_columns_real(analysis->table, p, "time.quiet");
    const fracas_point_statistics *statistics = &analysis->point[p];
    if (!isfinite(quiet) || analysis->header.format > 3) return;
    char past[PAST];
    write_past(analysis->table, p, statistics, past);
    if (statistics->outcome[FRACAS_FRAGMENTED] > 0)
        warn(
            list, p, "quiet", -quiet,
            "%s without an event ended realizations%s, and the study does not say how final counts "
            "are: bars that 100 ns ended lacked up to 79 %% of their fragments, most at low rates "
            "and with scattered strengths: run it again with time.stop: settled",
            fracas_with_unit(quiet, 3, "s", false).text, past);
}

static void warn_of_decision(const fracas_decision *last, size_t p, warning_list *list)
{
    if (!last || last->stop != 2) return;
    warn(list, p, "maximum", fracas_decision_relative(last) / last->relative_half_width,
         "at the maximum of %lld replicas %s is known to %s %%, not to the %.3g %% asked for: "
         "raise replicas.maximum",
         (long long)last->maximum, fracas_analysis_quantity(last),
         fracas_beside(100 * fracas_decision_relative(last), 100 * last->relative_half_width).text,
         100 * last->relative_half_width);
}

/* The strength of an interface depends on its extent. */
static bool has_size_effect(const fracas_point_table *table, size_t p)
{
    static const char *const by[] = {"strength.reference_volume", "strength.reference_area",
                                     "strength.flaw_density"};
    for (size_t i = 0; i < FRACAS_COUNT(by); i++)
        if (isfinite(fracas_columns_real(table, p, by[i]))) return true;
    return false;
}

/* deviation/mean of the strengths; NaN: equal, of a file, with a size effect or correlated. */
static double scatter_of(const fracas_point_table *table, size_t p)
{
    if (has_size_effect(table, p) ||
        isfinite(fracas_columns_real(table, p, "strength.correlation_length")))
        return NAN;
    return fracas_strengths_scatter(table, p);
}

/* Whether the strengths go down to 0. Known of those with a modulus (weibull) or a sigma
 * (lognormal). */
typedef enum { LEAST_UNKNOWN, LEAST_ZERO, LEAST_ABOVE_ZERO } least_strength;

static least_strength least_of(const fracas_point_table *table, size_t p)
{
    if (fracas_strengths_least(table, p) > 0) return LEAST_ABOVE_ZERO;
    const bool known = isfinite(fracas_columns_real(table, p, "derived.strength_modulus")) ||
                       isfinite(fracas_columns_real(table, p, "strength.sigma"));
    return known ? LEAST_ZERO : LEAST_UNKNOWN;
}

/* On a finer mesh of a bar or ring, interfaces keep the strengths of this one's. */
static void warn_of_mesh(const fracas_analysis *analysis, size_t p, warning_list *list)
{
    const fracas_point_table *table = analysis->table;
    const fracas_point_statistics *statistics = &analysis->point[p];
    const least_strength least = least_of(table, p);
    const double scatter = scatter_of(table, p),
                 effect = fracas_mesh_effect(scatter, statistics->rate / statistics->scales.rate),
                 volume = fracas_columns_real(table, p, "derived.length") *
                          fracas_columns_real(table, p, "geometry.area") /
                          fracas_columns_real(table, p, "mesh.elements");
    const bool notable = least == LEAST_ABOVE_ZERO ? scatter > FRACAS_SCATTER_NOTABLE
                                                   : effect > FRACAS_MESH_EFFECT_NOTABLE;
    if (!notable || !(volume > 0)) return;
    char moves[96];
    if (least == LEAST_ZERO) FRACAS_PRINT(moves, "lowers the count by about %.1f %%", 100 * effect);
    else
        FRACAS_PRINT(moves, "moves the count by up to %.0f %%%s", 100 * FRACAS_MESH_EFFECT_BOUNDED,
                     fracas_strengths_uniform(table, p) ? ", mostly up" : "");
    warn(list, p, "mesh", least == LEAST_ZERO ? effect : scatter,
         "strengths scatter without a reference size: halving the elements %s: give "
         "strength.reference_volume, here %.6g mm3, for a count that stays",
         moves, 1e9 * volume);
}

/* Points of the same strengths. */
typedef struct {
    size_t first;       /* point */
    double least, most; /* range of their mean strengths [Pa] */
} alike;

static bool same_strengths(const fracas_point_table *table, const size_t *column, size_t count,
                           size_t p, size_t q)
{
    for (size_t c = 0; c < count; c++)
        if (!fracas_value_same(&table->point[p].value[column[c]],
                               &table->point[q].value[column[c]]))
            return false;
    return true;
}

/* Adds point p to the group of its strengths, whose number it returns. */
static size_t add_alike(const fracas_point_table *table, const size_t *column, size_t count,
                        size_t p, alike *group, size_t *ngroups)
{
    const double mean = fracas_columns_real(table, p, "derived.strength_mean");
    size_t g = 0;
    while (g < *ngroups && !same_strengths(table, column, count, p, group[g].first)) g++;
    if (g == *ngroups) group[(*ngroups)++] = (alike){p, mean, mean};
    group[g].least = fmin(group[g].least, mean);
    group[g].most = fmax(group[g].most, mean);
    return g;
}

/* With a size effect the mean strength is an interface's, and so is that of scaling laws where no
 * piece has one. */
static fracas_err warn_of_mean_strengths(const fracas_analysis *analysis, warning_list *list)
{
    const fracas_point_table *table = analysis->table;
    size_t count = 0, ngroups = 0;
    OWNED size_t *column = malloc((table->ncolumns + 1) * sizeof *column);
    OWNED alike *group = malloc((table->npoints + 1) * sizeof *group);
    OWNED size_t *of = malloc((table->npoints + 1) * sizeof *of);
    if (!column || !group || !of) return fracas_no_memory("warnings");
    for (size_t c = 0; c < table->ncolumns; c++)
        if (!strncmp(table->column[c].path, "strength.", strlen("strength."))) column[count++] = c;
    for (size_t p = 0; p < table->npoints; p++)
        of[p] = add_alike(table, column, count, p, group, &ngroups);
    for (size_t p = 0; p < table->npoints; p++) {
        const alike *g = &group[of[p]];
        if (!has_size_effect(table, p) || !(g->most > g->least * (1 + NOTABLE_MEAN)) ||
            analysis->point[p].strength_by == FRACAS_STRENGTH_OF_PIECE)
            continue;
        const double own = fracas_columns_real(table, p, "derived.strength_mean");
        warn(list, p, "strength", fabs(log(2 * own / (g->least + g->most))),
             "the mean strength is that of an interface, which a finer mesh makes smaller and "
             "stronger: %s MPa here, %s to %s MPa over points of the same strengths. Scaling laws "
             "are drawn with it, and not at all for points that differ in it: compare them on "
             "elements of one size",
             fracas_digits(1e-6 * own, 4).text, fracas_digits(1e-6 * g->least, 4).text,
             fracas_digits(1e-6 * g->most, 4).text);
    }
    return FRACAS_OK;
}

static void warn_of_study(const fracas_analysis *analysis, warning_list *list)
{
    char text[128];
    const fracas_progress all = fracas_analysis_progress(analysis);
    const bool partial = fracas_analysis_partial(analysis, text, sizeof text);
    if (partial && all.ended)
        warn(list, SIZE_MAX, "study", 0,
             "%s, but study.h5 is not there or not of all of them: `fracas merge` writes it", text);
    else if (partial)
        warn(list, SIZE_MAX, "study", 0,
             "%s: every number is of these alone; `fracas run STUDY/campaign.yaml --study STUDY` "
             "completes the study",
             text);
    else if (!analysis->header.complete)
        warn(list, SIZE_MAX, "study", 0,
             "the study is not complete: realizations are missing or FAILED");
    for (size_t n = 0; n < fracas_results_notes(analysis->results); n++)
        warn(list, SIZE_MAX, "study", 0, "%s", fracas_results_note(analysis->results, n));
}

static void warn_of_progress(const fracas_analysis *analysis, size_t p, warning_list *list)
{
    const fracas_progress progress = fracas_analysis_progress_of(analysis, p);
    const long long here = (long long)(progress.done + progress.failed),
                    planned = (long long)progress.planned;
    if (!fracas_results_partial(analysis->results)) return;
    if (here < planned)
        warn(list, p, "partial", -(double)here / (double)planned,
             "partial: %lld of %lld realizations done", here, planned);
    else if (!fracas_results_decided(analysis->results, p))
        warn(list, p, "undecided", -(double)here,
             "partial: %lld realizations done, and the rule for replicas has not decided whether "
             "these are enough",
             here);
}

fracas_err fracas_analysis_warnings(const fracas_analysis *analysis, fracas_warning **warning,
                                    size_t *count)
{
    size_t npoints = analysis->table->npoints;
    const size_t most = WARNINGS_PER_POINT * npoints + WARNINGS_PER_STUDY +
                        fracas_results_notes(analysis->results);
    warning_list list = {.warning = malloc(most * sizeof *list.warning)};
    if (!list.warning) return fracas_no_memory("warnings");
    warn_of_study(analysis, &list);
    for (size_t p = 0; p < npoints; p++) {
        warn_of_progress(analysis, p, &list);
        warn_of_point(analysis->table, &analysis->point[p], p, &list);
        const double end = fracas_columns_real(analysis->table, p, "time.end");
        warn_of_final(&analysis->point[p].final, analysis->point[p].dust_share, end, p, &list);
        warn_of_quiet(analysis, p, &list);
        if (!replicas_are_equal(analysis->table, p))
            warn_of_convergence(&analysis->point[p], p, &list);
        warn_of_decision(fracas_analysis_decision(analysis, p), p, &list);
        if (analysis->point[p].outcome[FRACAS_TIME_LIMIT] == 0 && /* warned of already */
            !all_elements_apart(&analysis->point[p]))
            warn_of_end(&analysis->point[p].bands, end, p, &list);
        warn_of_mesh(analysis, p, &list);
        const double zones = fracas_columns_real(analysis->table, p, "cohesive.zone") /
                             analysis->point[p].size.mean;
        if (zones > zone_limit)
            warn(&list, p, "zone", zones,
                 "cohesive.zone is %.2g of a mean fragment (more than 0.25): it influences the "
                 "size: shorten it",
                 zones);
    }
    const fracas_err err = warn_of_mean_strengths(analysis, &list);
    if (err) {
        free(list.warning);
        return err;
    }
    *warning = list.warning;
    *count = list.count;
    return FRACAS_OK;
}

/* Points with a warning of the same kind share a line; each warning of the study has its own. */
static bool same_line(const fracas_warning *a, const fracas_warning *b)
{
    return a == b ||
           (a->point != SIZE_MAX && b->point != SIZE_MAX && strcmp(a->kind, b->kind) == 0);
}

/* The line of the kind of all[first], whose other warnings all come later. */
static void write_line(const fracas_analysis *analysis, const fracas_warning *all, size_t count,
                       size_t first, fracas_warning_line *line)
{
    const fracas_warning *worst = &all[first];
    size_t points = 0;
    for (const fracas_warning *next = worst; next < all + count; next++) {
        if (!same_line(next, &all[first])) continue;
        points++;
        if (next->badness > worst->badness) worst = next;
    }
    const fracas_label label = fracas_analysis_label(analysis, worst->point);
    if (points > 1)
        FRACAS_PRINT(line->text, "%zu of %zu points, worst %zu (%s): %s", points,
                     analysis->table->npoints, worst->point, label.text, worst->text);
    else FRACAS_PRINT(line->text, "%s%s%s", label.text, *label.text ? ": " : "", worst->text);
}

fracas_err fracas_analysis_warning_lines(const fracas_analysis *analysis,
                                         fracas_warning_line **line, size_t *count)
{
    OWNED fracas_warning *all = NULL;
    size_t warnings;
    *count = 0;
    TRY(fracas_analysis_warnings(analysis, &all, &warnings));
    *line = malloc((warnings + 1) * sizeof **line);
    if (!*line) return fracas_no_memory("warnings");
    for (size_t i = 0; i < warnings; i++) {
        size_t first = 0;
        while (first < i && !same_line(&all[first], &all[i])) first++;
        if (first == i) write_line(analysis, all, warnings, i, &(*line)[(*count)++]);
    }
    return FRACAS_OK;
}
