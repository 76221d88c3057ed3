/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/summary/statistics.h"

#include "analysis/data/columns.h"
#include "analysis/data/strengths.h"
#include "analysis/summary/numbers.h"

#include <gsl/gsl_sort.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#define PLACE(member) offsetof(fracas_point_statistics, member)
#define NUMBER(key, unit, doc, member) \
    FRACAS_FIELD(fracas_point_statistics, NUMBER, key, unit, doc, member)
#define COUNTED(key, doc, member) \
    FRACAS_FIELD(fracas_point_statistics, INTEGER, key, "1", doc, member)
#define INTERVAL(key, unit, doc, member) \
    FRACAS_FIELD_OF(fracas_point_statistics, fracas_interval_fields, key, unit, doc, member)
#define ESTIMATE(key, unit, doc, ...) \
    {#key, FRACAS_FIELD_OBJECT, unit, doc, PLACE(key), &fracas_estimate_fields},
#define CONVERGED(name, key, unit)                      \
    {"converged." key, FRACAS_FIELD_INTEGER, "1",       \
     "1 if " key " is converged with replicas, else 0", \
     PLACE(convergence.converged[FRACAS_HEADLINE_##name])},

#define SIZES(key, unit, doc, member) \
    FRACAS_FIELD_OF(fracas_sizes, fracas_interval_fields, key, unit, doc, member)
static const fracas_field sizes_fields[] = {
    SIZES("mean", "m", "mean size of %s", mean),
    SIZES("mass_mean", "m", "mean size, weighed by mass, of %s", mass_mean),
    SIZES("variation", "1", "standard deviation / mean of the size of %s", variation),
    SIZES("quantile_05", "m", "size below which are 5 % of %s", quantile[0]),
    SIZES("quantile_25", "m", "size below which are 25 % of %s", quantile[1]),
    SIZES("quantile_50", "m", "median size of %s", quantile[2]),
    SIZES("quantile_75", "m", "size below which are 75 % of %s", quantile[3]),
    SIZES("quantile_95", "m", "size below which are 95 % of %s", quantile[4]),
    SIZES("mass_quantile_05", "m", "size below which is 5 % of the mass of %s", mass_quantile[0]),
    SIZES("mass_quantile_25", "m", "size below which is 25 % of the mass of %s", mass_quantile[1]),
    SIZES("mass_quantile_50", "m", "size below which is half of the mass of %s", mass_quantile[2]),
    SIZES("mass_quantile_75", "m", "size below which is 75 % of the mass of %s", mass_quantile[3]),
    SIZES("mass_quantile_95", "m", "size below which is 95 % of the mass of %s", mass_quantile[4]),
};
static const fracas_fields sizes = FRACAS_FIELDS(sizes_fields);

static const fracas_field statistics_fields[] = {
    COUNTED("realizations", "realizations in the study", realizations),
    COUNTED("usable", "realizations that ended FRAGMENTED, INTACT or TIME_LIMIT", usable),
    COUNTED("unusable", "realizations that ended NONFINITE, ENERGY_DRIFT or FAILED", unusable),
    FRACAS_COMPARED_NUMBERS(ESTIMATE)
        NUMBER("residual", "1",
               "largest |residual| of the energy balance / dissipated, over replicas", residual),
    NUMBER("residual_total", "1",
           "largest |residual| of the energy balance / largest total energy (estimators.28), over "
           "replicas",
           residual_total),
    NUMBER("created", "1", "largest created / dissipated, over replicas", created),
    NUMBER("drift", "1", "largest |residual| / largest energy at the end, over replicas", drift),
    NUMBER("heated", "1", "largest |residual at the end| / vibrating energy, over replicas",
           heated),
    COUNTED("drifted", "usable realizations of which that is above 0.01", drifted),
    {"final", FRACAS_FIELD_OBJECT, NULL, NULL, PLACE(final), &fracas_final_fields},
    NUMBER("elements", "1", "elements of a mean fragment", elements),
    NUMBER("dust_share", "1", "dust fragments / all fragments", dust_share),
    FRACAS_LARGEST_NUMBERS(ESTIMATE)
        NUMBER("cut", "m", "fragments of a larger size are resolved by the mesh", pooled.cut),
    COUNTED("fragment.n", "fragments of all usable realizations", pooled.number),
    {"fragment", FRACAS_FIELD_OBJECT, NULL, "all fragments", PLACE(pooled.all), &sizes},
    COUNTED("resolved.n", "fragments above the cut", pooled.resolved),
    {"resolved", FRACAS_FIELD_OBJECT, NULL, "the fragments above the cut", PLACE(pooled.above),
     &sizes},
    INTERVAL("unresolved.share", "1", "share of the fragments that are not above the cut",
             pooled.unresolved),
    INTERVAL("unresolved.mass_share", "1",
             "share of the mass in fragments that are not above the cut", pooled.unresolved_mass),
    INTERVAL("variance.within", "m2", "variance of the fragment sizes within a realization",
             pooled.variance.within),
    INTERVAL("variance.between", "m2", "variance of realizations' mean fragment sizes beyond that",
             pooled.variance.between),
    INTERVAL("variance.intraclass", "1", "between / (within + between)",
             pooled.variance.intraclass),
    INTERVAL("variance.design_effect", "1", "1 + (variance.group - 1) intraclass",
             pooled.variance.design_effect),
    NUMBER("variance.group", "1",
           "fragments of a realization, as the analysis of variance weighs them",
           pooled.variance.group),
    NUMBER("variance.effective", "1", "fragments / design effect", pooled.variance.effective),
    NUMBER("normalised.rate", "1", "strain rate / edot0", normalised.rate),
    NUMBER("normalised.size.mean", "1", "size.mean / s0", normalised.size),
    NUMBER("normalised.size.half_width", "1", "size.half_width / s0", normalised.size_half_width),
    INTERVAL("normalised.mean", "1", "mean size of all fragments / s0", normalised.mean),
    INTERVAL("normalised.mass_mean", "1", "mean size, weighed by mass, of all fragments / s0",
             normalised.mass_mean),
    INTERVAL("normalised.median", "1", "median size of all fragments / s0", normalised.median),
    COUNTED("unconverged", "headline numbers that are not converged with replicas",
            convergence.unconverged),
    FRACAS_HEADLINES(CONVERGED) NUMBER("scale.time", "s", "t0 = E Gc/(sigma_c^2 c)", scales.time),
    NUMBER("scale.size", "m", "s0 = E Gc/sigma_c^2", scales.size),
    NUMBER("scale.rate", "1/s", "edot0 = c sigma_c^3/(E^2 Gc)", scales.rate),
    NUMBER("scale.modulus", "1", "M of the strengths, of Mott's law", scales.modulus),
    NUMBER("law.zmr", "m", "mean size by Zhou, Molinari and Ramesh (APL 2006)",
           law[FRACAS_LAW_ZMR]),
    NUMBER("law.grady", "m", "mean size by Grady", law[FRACAS_LAW_GRADY]),
    NUMBER("law.glenn_chudnovsky", "m", "mean size by Glenn and Chudnovsky",
           law[FRACAS_LAW_GLENN_CHUDNOVSKY]),
    NUMBER("law.zmr2", "m", "mean size by Zhou, Molinari and Ramesh, second form",
           law[FRACAS_LAW_ZMR2]),
    NUMBER("law.mott", "m", "mean size by Mott", law[FRACAS_LAW_MOTT]),
};
const fracas_fields fracas_statistics = FRACAS_FIELDS(statistics_fields);

static const char without_modulus[] =
    "its strengths have no modulus M: they are neither weibull nor flaws that most interfaces "
    "have, or the study does not hold it";

bool fracas_outcome_usable(int64_t outcome)
{
    return outcome == FRACAS_FRAGMENTED || outcome == FRACAS_INTACT || outcome == FRACAS_TIME_LIMIT;
}

const char *fracas_outcome_name(int64_t outcome)
{
    static const char *const name[FRACAS_NOUTCOMES] = {
        [FRACAS_FRAGMENTED] = "FRAGMENTED",     [FRACAS_INTACT] = "INTACT",
        [FRACAS_TIME_LIMIT] = "TIME_LIMIT",     [FRACAS_NONFINITE] = "NONFINITE",
        [FRACAS_ENERGY_DRIFT] = "ENERGY_DRIFT", [FRACAS_FAILED] = "FAILED",
    };
    return outcome >= 0 && outcome < FRACAS_NOUTCOMES ? name[outcome] : "?";
}

/* Strengths by the volume of pieces: Weibull's, of flaws that have a modulus, and uniform ones. An
 * exponent and specimens of NaN: others. */
static fracas_piece_strength pieces_of(const fracas_point_table *table, size_t p)
{
    const double least = fracas_strengths_least(table, p),
                 modulus = fracas_columns_real(table, p, "derived.strength_modulus"),
                 volume = fracas_columns_real(table, p, "strength.reference_volume"),
                 flaws = fracas_columns_real(table, p, "strength.flaw_density");
    fracas_piece_strength of = {
        .mean = fracas_columns_real(table, p, "derived.strength_mean"),
        .least = isfinite(least) ? least : 0,
        .size = fracas_columns_real(table, p, "derived.length") /
                fracas_columns_real(table, p, "mesh.elements"),
        .specimens = NAN,
    };
    of.exponent = modulus * (of.mean - of.least) / of.mean;
    if (isfinite(flaws)) /* by their power law: an interface may have none */
        of.mean = of.least +
                  (fracas_columns_real(table, p, "strength.maximum") - of.least) *
                      tgamma(1 + 1 / of.exponent) *
                      pow(flaws * fracas_columns_real(table, p, "geometry.area") * of.size,
                          -1 / of.exponent);
    if (fracas_strengths_uniform(table, p))
        of.specimens = of.size * fracas_columns_real(table, p, "geometry.area") / volume;
    return of;
}

/* By the strength of a piece s0 long where interfaces have a size effect, else by theirs. */
static void find_scales(const fracas_point_table *table, size_t p,
                        fracas_point_statistics *statistics)
{
    const double young = fracas_columns_real(table, p, "material.young"),
                 density = fracas_columns_real(table, p, "material.density"),
                 mean = fracas_columns_real(table, p, "derived.strength_mean"),
                 modulus = fracas_columns_real(table, p, "derived.strength_modulus"),
                 energy = fracas_columns_real(table, p, "derived.fracture_energy");
    statistics->scales = fracas_scales_of(young, density, mean, energy);
    statistics->scales.modulus = modulus;
    const bool sized = isfinite(fracas_columns_real(table, p, "strength.reference_volume")) ||
                       isfinite(fracas_columns_real(table, p, "strength.flaw_density"));
    if (!sized || statistics->surface || isnan(mean)) return;
    const fracas_piece_strength of = pieces_of(table, p);
    const bool opening = fracas_columns_real(table, p, "cohesive.critical_opening") > 0;
    const double strength = fracas_piece_strength_find(
        &of, young, opening ? energy * of.mean / mean : energy, opening);
    statistics->strength_by = isfinite(strength) ? FRACAS_STRENGTH_OF_PIECE
                                                 : FRACAS_STRENGTH_OF_MESH;
    if (isnan(strength)) return;
    statistics->scales = fracas_scales_of(young, density, strength,
                                          opening ? energy * strength / mean : energy);
    statistics->scales.modulus = isnan(modulus) ? NAN
                                                : of.exponent * strength / (strength - of.least);
}

void fracas_point_statistics_init(const fracas_point_table *table, size_t point,
                                  fracas_point_statistics *statistics)
{
    const double lattice = fracas_columns_real(table, point, "derived.lattice"),
                 modulus = fracas_columns_real(table, point, "derived.strength_modulus");
    *statistics = (fracas_point_statistics){
        .rate = fracas_columns_real(table, point, "derived.strain_rate"),
        .length = fracas_columns_real(table, point, "derived.length"),
        .radius = fracas_columns_real(table, point, "derived.radius"),
        .end = fracas_columns_real(table, point, "time.end"),
        .surface = fracas_columns_surface(table, point),
        .kept_at = {INFINITY, 0},
        .residual = NAN,
        .residual_total = NAN,
        .created = NAN,
        .drift = NAN,
        .heated = NAN,
        .elements = NAN,
        .dust_share = NAN,
        .typical_replica = -1,
        .broken_replica = -1,
    };
    memcpy(&statistics->seed, table->point[point].hash.byte, sizeof statistics->seed);
    find_scales(table, point, statistics);
    statistics->without_mott = statistics->surface       ? "the law is of one dimension"
                               : !(statistics->rate > 0) ? "there is no strain rate"
                               : isnan(modulus)          ? without_modulus
                                                         : NULL;
    fracas_ensemble_init(&statistics->ensemble, lattice > 0 ? lattice : 0);
    statistics->ensemble.surface = statistics->surface;
    for (int law = 0; law < FRACAS_SCALING_LAWS; law++)
        statistics->law[law] = statistics->rate > 0 && !statistics->surface
                                   ? fracas_scaling_law_at((fracas_scaling_law_id)law,
                                                           &statistics->scales, statistics->rate)
                                   : NAN;
}

double fracas_point_statistics_size(const fracas_point_statistics *statistics, int64_t fragments,
                                    double mean)
{
    return statistics->surface ? mean : statistics->length / (double)fragments;
}

/* Against the largest energy of any kind at the end. */
static void add_balance(fracas_point_statistics *statistics, const fracas_record *record)
{
    const double stored = fracas_energy_held(record->energy, 1);
    double drift = record->residual / fmax(record->kinetic, fmax(stored, fabs(record->work)));
    if (drift > FRACAS_DRIFT_LIMIT) statistics->drifted++;
    if (isfinite(drift)) statistics->drift = fmax(statistics->drift, drift); /* not NaN */
    if (record->broken > 0)
        statistics->heated = fmax(statistics->heated,
                                  fabs(record->residual_end) / record->vibrating);
    if (!(record->dissipated > 0)) return;
    statistics->residual = fmax(statistics->residual, record->residual / record->dissipated);
    statistics->created = fmax(statistics->created, record->created / record->dissipated);
}

fracas_err fracas_point_statistics_add(fracas_point_statistics *statistics, size_t row,
                                       int64_t replica, const fracas_record *record)
{
    if (record->outcome < 0 || record->outcome >= FRACAS_NOUTCOMES)
        return fracas_fail(FRACAS_DAMAGED,
                           "realization %zu of the study has outcome %lld, which is none of 0 to "
                           "%d; `fracas verify` checks the study",
                           row, (long long)record->outcome, FRACAS_NOUTCOMES - 1);
    statistics->realizations++;
    statistics->outcome[record->outcome]++;
    if (!fracas_outcome_usable(record->outcome)) {
        statistics->unusable++;
        return FRACAS_OK;
    }
    statistics->usable++;
    if (record->outcome == FRACAS_TIME_LIMIT && record->end_time < statistics->end) {
        statistics->kept++;
        statistics->kept_at[0] = fmin(statistics->kept_at[0], record->end_time);
        statistics->kept_at[1] = fmax(statistics->kept_at[1], record->end_time);
    }
    const fracas_replica_values value = fracas_numbers_of(statistics, record);
    TRY(fracas_ensemble_add(&statistics->ensemble, row, replica, &value, record));
    add_balance(statistics, record);
    fracas_final_add(&statistics->final, record);
    if (record->outcome == FRACAS_FRAGMENTED && statistics->broken_replica < 0) {
        statistics->broken_replica = replica;
        statistics->broken_row = row;
    }
    return FRACAS_OK;
}

/* (settled.2), where the history has rows within a tenth of that time around its half. */
static void add_past(fracas_past *past, const fracas_record *record)
{
    if (isnan(record->onset_time) || isfinite(record->transits) || record->nhistory < 2) return;
    const double half = record->onset_time + (record->end_time - record->onset_time) / 2;
    size_t at = 1;
    while (at + 1 < record->nhistory && record->history[at].time < half) at++;
    const fracas_history_row *before = &record->history[at - 1], *after = &record->history[at];
    const double apart = after->time - before->time, part = (half - before->time) / apart;
    if (apart > 0.1 * (record->end_time - record->onset_time)) past->half = NAN;
    past->realizations++;
    past->time += record->end_time - record->onset_time;
    past->half += (1 - part) * (double)before->fragments + part * (double)after->fragments;
    past->seen += (double)record->fragments;
}

/* (estimators.28) */
void fracas_point_statistics_add_history(fracas_point_statistics *statistics,
                                         const fracas_record *record)
{
    add_past(&statistics->past, record);
    double total = fracas_energy_held(record->energy, 0);
    for (size_t i = 0; i < record->nhistory; i++)
        total = fmax(total, fracas_energy_held(record->history[i].energy, 0));
    if (total > 0)
        statistics->residual_total = fmax(statistics->residual_total, record->residual / total);
}

static fracas_err pool(fracas_point_statistics *statistics)
{
    const fracas_ensemble *ensemble = &statistics->ensemble;
    double elements = 0, dust = 0;
    statistics->nfragments = ensemble->nfragments;
    if (!ensemble->nfragments) return FRACAS_OK;
    statistics->fragment_size = malloc(ensemble->nfragments * sizeof *statistics->fragment_size);
    if (!statistics->fragment_size) return fracas_no_memory("the fragments of a point");
    memcpy(statistics->fragment_size, ensemble->size,
           ensemble->nfragments * sizeof *ensemble->size);
    gsl_sort(statistics->fragment_size, 1, ensemble->nfragments);
    for (size_t i = 0; i < ensemble->nfragments; i++) {
        elements += ensemble->elements[i];
        dust += ensemble->dust[i];
    }
    statistics->elements = elements / (double)ensemble->nfragments;
    statistics->dust_share = dust / (double)ensemble->nfragments;
    return FRACAS_OK;
}

static fracas_interval over(const fracas_interval *interval, double scale)
{
    fracas_interval scaled = *interval;
    scaled.value /= scale;
    scaled.low /= scale;
    scaled.high /= scale;
    scaled.standard_error /= scale;
    return scaled;
}

static void normalise(fracas_point_statistics *statistics)
{
    const double s0 = statistics->scales.size;
    const fracas_sizes *all = &statistics->pooled.all;
    statistics->normalised = (fracas_normalised){
        .rate = statistics->rate / statistics->scales.rate,
        .size = statistics->size.mean / s0,
        .size_half_width = statistics->size.half_width / s0,
        .mean = over(&all->mean, s0),
        .mass_mean = over(&all->mass_mean, s0),
        .median = over(&all->quantile[2], s0),
    };
}

fracas_err fracas_point_statistics_finish(fracas_point_statistics *statistics)
{
    const fracas_ensemble *ensemble = &statistics->ensemble;
    const fracas_replica_values nothing = {0};
    const fracas_replica_values *first = ensemble->nrealizations ? ensemble->value : &nothing;
    const size_t n = ensemble->nrealizations, stride = FRACAS_REPLICA_STRIDE;
#define MEAN(key, unit, doc, ...) statistics->key = fracas_estimate_of(&first->key, stride, n);
    FRACAS_REALIZATION_NUMBERS(MEAN)
    double nearest = INFINITY;
    for (size_t i = 0; i < n; i++) {
        double distance = fabs(ensemble->value[i].dissipated - statistics->dissipated.mean);
        if (!(distance < nearest)) continue;
        nearest = distance;
        statistics->typical_replica = ensemble->replica[i];
        statistics->typical_row = ensemble->row[i];
    }
    fracas_final_count(&statistics->final);
    TRY(pool(statistics));
    TRY(fracas_pooled_of(ensemble, statistics->seed, &statistics->pooled));
    TRY(fracas_replica_convergence_of(ensemble, statistics->seed, &statistics->convergence));
    normalise(statistics);
    return FRACAS_OK;
}

void fracas_point_statistics_clear(fracas_point_statistics *statistics)
{
    fracas_ensemble_clear(&statistics->ensemble);
    fracas_replica_convergence_clear(&statistics->convergence);
    fracas_bands_clear(&statistics->bands);
    free(statistics->fragment_size);
    free(statistics->history);
    free(statistics->probe);
    free(statistics->reaction);
    *statistics = (fracas_point_statistics){.typical_replica = -1, .broken_replica = -1};
}
