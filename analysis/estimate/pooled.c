/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/estimate/pooled.h"
#include "base/own.h"

#include <math.h>
#include <stdlib.h>

enum { SINGLE = 1000, GROUPS = 500 };

size_t fracas_pooled_units(size_t realizations)
{
    return realizations > SINGLE ? GROUPS : realizations;
}

size_t fracas_pooled_unit(size_t i, size_t realizations)
{
    return i * fracas_pooled_units(realizations) / realizations;
}

/* Sums over one unit, or a resample; sizes less `shift`, which gives equal sizes a deviation of
 * exactly 0. */
typedef struct {
    double number, size, squares, mass, moment; /* over all fragments: 1, s, s^2, m, m s */
    double resolved, resolved_size, resolved_squares, resolved_mass,
        resolved_moment; /* the same over those above the cut */
    double between;      /* (sum s)^2/number of each realization */
    double group;        /* number^2 of each */
    double realizations;
} sums;

enum { NSUMS = sizeof(sums) / sizeof(double) };

typedef struct {
    size_t units;
    sums *of; /* each unit */
    double shift;
} summed;

enum {
    RESOLVED = FRACAS_NPOOLED,
    UNRESOLVED = 2 * FRACAS_NPOOLED,
    UNRESOLVED_MASS,
    WITHIN,
    BETWEEN,
    INTRACLASS,
    DESIGN_EFFECT,
    NVALUES
};

/* (estimators.15) */
static void means(double number, double size, double squares, double mass, double moment,
                  double shift, double *value)
{
    const double mean = size / number;
    value[FRACAS_POOLED_MEAN] = shift + mean;
    value[FRACAS_POOLED_MASS_MEAN] = shift + moment / mass;
    value[FRACAS_POOLED_VARIATION] = sqrt(fmax(squares / number - mean * mean, 0)) / (shift + mean);
}

/* m0 (estimators.19) */
static double typical_group(const sums *all)
{
    return (all->number - all->group / all->number) / (all->realizations - 1);
}

/* (estimators.19), (estimators.20) */
static void components(const sums *all, double *value)
{
    const double m0 = typical_group(all), a = all->realizations;
    const double within = fmax(all->squares - all->between, 0) / (all->number - a);
    const double among = fmax(all->between - all->size * all->size / all->number, 0) / (a - 1);
    value[WITHIN] = within;
    value[BETWEEN] = (among - within) / m0;
    value[INTRACLASS] = (among - within) / (among + (m0 - 1) * within);
    value[DESIGN_EFFECT] = 1 + (m0 - 1) * value[INTRACLASS];
}

static void add(sums *to, const sums *more, double times)
{
    double *into = &to->number;
    const double *from = &more->number;
    for (int k = 0; k < NSUMS; k++) into[k] += times * from[k];
}

static void of_sums(void *context, const uint32_t *weight, double *value)
{
    const summed *of = context;
    sums all = {0};
    for (size_t u = 0; u < of->units; u++)
        if (weight[u]) add(&all, &of->of[u], weight[u]);
    means(all.number, all.size, all.squares, all.mass, all.moment, of->shift, value);
    means(all.resolved, all.resolved_size, all.resolved_squares, all.resolved_mass,
          all.resolved_moment, of->shift, value + RESOLVED);
    value[UNRESOLVED] = 1 - all.resolved / all.number; /* (estimators.17) */
    value[UNRESOLVED_MASS] = 1 - all.resolved_mass / all.mass;
    components(&all, value);
}

static sums sums_of(const fracas_ensemble *ensemble, size_t i, double shift, double cut)
{
    sums of = {0};
    for (size_t f = ensemble->first[i]; f < ensemble->first[i + 1]; f++) {
        const double size = ensemble->size[f] - shift, mass = ensemble->mass[f];
        of.number++;
        of.size += size;
        of.squares += size * size;
        of.mass += mass;
        of.moment += mass * size;
        if (!(ensemble->size[f] > cut)) continue;
        of.resolved++;
        of.resolved_size += size;
        of.resolved_squares += size * size;
        of.resolved_mass += mass;
        of.resolved_moment += mass * size;
    }
    of.between = of.number > 0 ? of.size * of.size / of.number : 0;
    of.group = of.number * of.number;
    of.realizations = 1;
    return of;
}

/* Sums of each unit of realizations begin to begin + n - 1, freed by the caller. */
static fracas_err sum_units(const fracas_ensemble *ensemble, size_t begin, size_t n, double cut,
                            summed *context)
{
    *context = (summed){.units = fracas_pooled_units(n),
                        .shift = ensemble->nfragments ? ensemble->size[0] : 0};
    sums *of = calloc(context->units + 1, sizeof *of);
    if (!of) return fracas_no_memory("the sums of the realizations of a point");
    for (size_t i = 0; i < n; i++) {
        const sums one = sums_of(ensemble, begin + i, context->shift, cut);
        add(&of[fracas_pooled_unit(i, n)], &one, 1);
    }
    context->of = of;
    return FRACAS_OK;
}

static fracas_err resample_sums(const fracas_ensemble *ensemble, size_t n, double cut,
                                uint64_t seed, fracas_interval *interval, sums *all)
{
    summed context;
    TRY(sum_units(ensemble, 0, n, cut, &context));
    *all = (sums){0};
    for (size_t u = 0; u < context.units; u++) add(all, &context.of[u], 1);
    OWNED sums *of = context.of;
    return fracas_bootstrap(context.units, NVALUES, of_sums, &context,
                            &(fracas_bootstrap_options){.seed = seed}, interval);
}

static void put_means(const fracas_interval *interval, fracas_sizes *sizes)
{
    sizes->mean = interval[FRACAS_POOLED_MEAN];
    sizes->mass_mean = interval[FRACAS_POOLED_MASS_MEAN];
    sizes->variation = interval[FRACAS_POOLED_VARIATION];
}

fracas_err fracas_pooled_of(const fracas_ensemble *ensemble, uint64_t seed, fracas_pooled *pooled)
{
    fracas_interval interval[NVALUES];
    sums all;
    *pooled = (fracas_pooled){.cut = ensemble->nfragments ? fracas_ensemble_cut(ensemble) : NAN};
    TRY(resample_sums(ensemble, ensemble->nrealizations, pooled->cut, seed, interval, &all));
    put_means(interval, &pooled->all);
    put_means(interval + RESOLVED, &pooled->above);
    pooled->number = (int64_t)all.number;
    pooled->resolved = (int64_t)all.resolved;
    pooled->unresolved = interval[UNRESOLVED];
    pooled->unresolved_mass = interval[UNRESOLVED_MASS];
    pooled->variance = (fracas_variance){
        .within = interval[WITHIN],
        .between = interval[BETWEEN],
        .intraclass = interval[INTRACLASS],
        .design_effect = interval[DESIGN_EFFECT],
        .group = typical_group(&all),
        .effective = all.number / interval[DESIGN_EFFECT].value, /* (estimators.21) */
    };
    return fracas_quantiles_of(ensemble, pooled->cut, seed, pooled);
}

fracas_err fracas_pooled_first(const fracas_ensemble *ensemble, size_t realizations, uint64_t seed,
                               fracas_interval interval[FRACAS_NPOOLED])
{
    fracas_interval found[NVALUES];
    sums all;
    TRY(resample_sums(ensemble, realizations, 0, seed, found, &all));
    for (int v = 0; v < FRACAS_NPOOLED; v++) interval[v] = found[v];
    return FRACAS_OK;
}

fracas_err fracas_pooled_part(const fracas_ensemble *ensemble, size_t begin, size_t end,
                              fracas_part part[FRACAS_NPOOLED])
{
    fracas_jackknifed found[NVALUES];
    summed context;
    TRY(sum_units(ensemble, begin, end - begin, 0, &context));
    OWNED sums *of = context.of;
    TRY(fracas_jackknife(context.units, NVALUES, of_sums, &context, found));
    const double n = (double)(end - begin);
    for (int v = 0; v < FRACAS_NPOOLED; v++) {
        const bool known = isfinite(found[v].standard_error);
        part[v] = (fracas_part){found[v].value, n,
                                known ? n * found[v].standard_error * found[v].standard_error : NAN,
                                known ? (double)(found[v].groups - 1) : 0};
    }
    return FRACAS_OK;
}
