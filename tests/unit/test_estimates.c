/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Estimates of a point whose every number is worked out by hand; convergence with replicas and its
 * warning; energies over time. */
#include "analysis/estimate/convergence.h"
#include "analysis/estimate/pooled.h"
#include "analysis/data/bands.h"
#include "analysis/summary/study.h"
#include "base/param.h"
#include "tests/support/test.h"

#include <unistd.h>

/* A few roundings of sums of some ten numbers, relative. */
static const double rounding = 1e-14;

static void assert_near(double value, double expected)
{
    assert_true(fabs(value - expected) <= rounding * (1 + fabs(expected)));
}

static void add(fracas_ensemble *ensemble, const fracas_replica_values *value, const double *size,
                size_t count)
{
    fracas_fragment fragment[8] = {{.mass = 0}};
    fracas_record record;
    fracas_record_init(&record);
    for (size_t f = 0; f < count; f++)
        fragment[f] = (fracas_fragment){
            .size = size[f], .mass = 2 * size[f], .elements = (int64_t)size[f]};
    record.fragment = fragment;
    record.nfragment = count;
    OK(fracas_ensemble_add(ensemble, 0, 0, value, &record));
}

/* Sizes 1 2 3, 2 4, 1, 6. */
static void make_four(double lattice, fracas_ensemble *ensemble)
{
    fracas_ensemble_init(ensemble, lattice);
    const fracas_replica_values value = {0};
    add(ensemble, &value, (double[]){1, 2, 3}, 3);
    add(ensemble, &value, (double[]){2, 4}, 2);
    add(ensemble, &value, (double[]){1}, 1);
    add(ensemble, &value, (double[]){6}, 1);
}

/* 7 of sum 19 and squares 71; 1 1 2 2 3 4 6 in order, whose sums are 2 6 9 13 19. */
static void sizes_by_number_and_by_mass(void **state)
{
    FRACAS_CLEARED(fracas_ensemble) ensemble;
    fracas_pooled pooled;
    make_four(0, &ensemble);
    OK(fracas_pooled_of(&ensemble, 1, &pooled));
    assert_int_equal(pooled.number, 7);
    assert_near(pooled.all.mean.value, 19.0 / 7);
    assert_near(pooled.all.mass_mean.value, 71.0 / 19);
    assert_near(pooled.all.variation.value, sqrt(71.0 / 7 - 19.0 * 19 / 49) * 7 / 19);
    const double quantile[] = {1, 1, 2, 4, 6}, mass_quantile[] = {1, 2, 4, 6, 6};
    for (int q = 0; q < FRACAS_NQUANTILES; q++) {
        assert_true(pooled.all.quantile[q].value == quantile[q]);
        assert_true(pooled.all.mass_quantile[q].value == mass_quantile[q]);
        assert_true(pooled.all.quantile[q].low <= quantile[q] &&
                    pooled.all.quantile[q].high >= quantile[q]);
    }
    assert_true(pooled.all.mean.low < 19.0 / 7 && pooled.all.mean.high > 19.0 / 7);
}

/* On a lattice of step 1 the cut is 1.5: 2 2 3 4 6 are above it, of sum 17 and squares 69. Share q
 * of the number w of a size lies at the size + (q 7 - number before)/w - 1/2, and above the cut
 * numbers count from there. */
static void sizes_on_a_lattice_and_above_the_cut(void **state)
{
    FRACAS_CLEARED(fracas_ensemble) ensemble;
    fracas_pooled pooled;
    make_four(1, &ensemble);
    ensemble.size[3] = nextafter(2, 3); /* as roundings have it: the same size */
    OK(fracas_pooled_of(&ensemble, 1, &pooled));
    assert_true(pooled.cut == 1.5);
    assert_int_equal(pooled.resolved, 5);
    const double quantile[] = {0.675, 1.375, 2.25, 3.75, 6.15};
    const double above[] = {1.5 + 0.25 / 2, 1.5 + 1.25 / 2, 3, 4.25, 6.25};
    const double mass_above[] = {1.5 + 0.85 / 4, 2.5 + 0.25 / 3, 3.5 + 1.5 / 4, 5.5 + 1.75 / 6,
                                 5.5 + 5.15 / 6};
    for (int q = 0; q < FRACAS_NQUANTILES; q++) {
        assert_near(pooled.all.quantile[q].value, quantile[q]);
        assert_near(pooled.above.quantile[q].value, above[q]);
        assert_near(pooled.above.mass_quantile[q].value, mass_above[q]);
    }
    assert_near(pooled.above.mean.value, 17.0 / 5);
    assert_near(pooled.above.mass_mean.value, 69.0 / 17);
    assert_near(pooled.above.variation.value, sqrt(69.0 / 5 - 17.0 * 17 / 25) * 5 / 17);
    assert_near(pooled.unresolved.value, 2.0 / 7);
    assert_near(pooled.unresolved_mass.value, 2.0 / 19);
}

/* Within: (2 + 2)/(7 - 4). Among: 3 (2 - 19/7)^2 + 2 (3 - 19/7)^2 + (1 - 19/7)^2 + (6 - 19/7)^2 =
 * 108/7 over 3. m0 = (7 - 15/7)/3 = 34/21. */
static void variance_of_unequal_groups(void **state)
{
    FRACAS_CLEARED(fracas_ensemble) ensemble;
    fracas_pooled pooled;
    make_four(0, &ensemble);
    OK(fracas_pooled_of(&ensemble, 1, &pooled));
    assert_near(pooled.variance.within.value, 4.0 / 3);
    assert_near(pooled.variance.group, 34.0 / 21);
    assert_near(pooled.variance.between.value, 40.0 / 17);
    assert_near(pooled.variance.intraclass.value, 30.0 / 47);
    assert_near(pooled.variance.design_effect.value, 1 + 13.0 / 21 * 30 / 47);
    assert_near(pooled.variance.effective, 7 / (1 + 13.0 / 21 * 30 / 47));
}

/* Equal means: the least intraclass correlation, -1/(m0 - 1), and no design effect. Of none and of
 * one there is little to say, and nothing fails. */
static void estimates_at_their_ends(void **state)
{
    const fracas_replica_values value = {0};
    FRACAS_CLEARED(fracas_ensemble) ensemble;
    fracas_pooled pooled;
    fracas_replica_convergence convergence;
    fracas_ensemble_init(&ensemble, 0);
    OK(fracas_pooled_of(&ensemble, 1, &pooled));
    assert_true(isnan(pooled.all.mean.value) && isnan(pooled.all.quantile[0].value) &&
                pooled.number == 0 && isnan(pooled.cut));
    OK(fracas_replica_convergence_of(&ensemble, 1, &convergence));
    assert_true(convergence.count == 0 && convergence.unconverged == 0);
    add(&ensemble, &value, (double[]){1, 3}, 2);
    OK(fracas_pooled_of(&ensemble, 1, &pooled));
    assert_true(pooled.all.mean.value == 2 && isnan(pooled.all.mean.low) &&
                isnan(pooled.variance.intraclass.value));
    for (int i = 0; i < 7; i++) add(&ensemble, &value, (double[]){1, 3}, 2);
    OK(fracas_pooled_of(&ensemble, 1, &pooled));
    assert_true(pooled.variance.intraclass.value == -1 && pooled.variance.design_effect.value == 0);
    assert_true(pooled.all.mean.low == 2 && pooled.all.mean.high == 2);
    assert_int_equal(pooled.all.mean.resamples, 2000);
}

/* Of 40 replicas: counts alternate about 100; sizes about 1 in the first half and 1.1 in the
 * second; dissipated 1 or 3. Four of 100 -+ 1 have deviation 1.1547 and half width 3.182446
 * (tabulated t of 3) x 1.1547/2. Sizes: 1.05 +- 0.016 (deviation 0.0506), of halves that nothing
 * but 2 of the C(40, 20) deals of these replicas have; dissipated 2 +- 0.32, of equal halves. What
 * all replicas have alike is converged. */
static void numbers_that_settle_and_others(void **state)
{
    FRACAS_CLEARED(fracas_ensemble) ensemble;
    FRACAS_CLEARED(fracas_replica_convergence) of;
    fracas_ensemble_init(&ensemble, 0);
    for (int i = 0; i < 40; i++) {
        const fracas_replica_values value = {.count = i % 2 ? 101 : 99,
                                             .size = i < 20 ? 1 : 1.1,
                                             .dissipated = i % 2 ? 1 : 3,
                                             .largest_share = 0.5};
        add(&ensemble, &value, (double[]){1, 2, 3}, 3);
    }
    OK(fracas_replica_convergence_of(&ensemble, 1, &of));
    const int64_t rows[] = {4, 8, 16, 32, 40};
    assert_int_equal(of.count, FRACAS_COUNT(rows));
    for (size_t r = 0; r < of.count; r++) assert_int_equal(of.row[r].replicas, rows[r]);
    const fracas_running_value *count = &of.row[0].number[FRACAS_HEADLINE_COUNT];
    assert_true(count->value == 100 &&
                fabs(0.5 * (count->high - count->low) - 3.182446 * sqrt(4.0 / 3) / 2) < 1e-6);
    assert_true(of.alike[FRACAS_HEADLINE_COUNT] == 1);
    assert_true(fabs(of.alike[FRACAS_HEADLINE_SIZE] * 137846528820.0 / 2 - 1) <
                1e-9); /* C(40, 20) */
    assert_true(fabs(of.row[4].number[FRACAS_HEADLINE_SIZE].value - 1.05) < 1e-14);
    const int64_t converged[FRACAS_NHEADLINES] = {1, 0, 0, 1, 1, 1, 1};
    for (int h = 0; h < FRACAS_NHEADLINES; h++) assert_int_equal(of.converged[h], converged[h]);
    assert_int_equal(of.unconverged, 2);

    fracas_point_table table = {.npoints = 1, .point = &(fracas_point_row){.value = NULL}};
    fracas_point_statistics point = {.usable = 40, .elements = 100, .convergence = of};
    fracas_analysis analysis = {.table = &table, .point = &point, .header.complete = true};
    fracas_warning *warning;
    size_t warnings;
    OK(fracas_analysis_warnings(&analysis, &warning, &warnings));
    assert_int_equal(warnings, 1);
    assert_string_equal(warning->text, "unconverged with 40 replicas, known size to 1.5 % "
                                       "(drifts), dissipated to 16 %: raise replicas");
    free(warning);

    /* Of two, count is 100 -+ t_(0.975, 1) = 12.7 and dissipated 2 -+ 12.7; what they have alike
     * may be so by chance, and nothing says whether halves differ. */
    ensemble.nrealizations = 2;
    OK(fracas_replica_convergence_of(&ensemble, 1, &point.convergence));
    assert_true(point.convergence.count == 1 && point.convergence.unconverged == 7 &&
                isnan(point.convergence.alike[FRACAS_HEADLINE_SIZE]));
    OK(fracas_analysis_warnings(&analysis, &warning, &warnings));
    assert_int_equal(warnings, 1);
    assert_string_equal(warning->text,
                        "unconverged with 2 replicas, known count to 13 %, size to 0 % (all "
                        "alike), dissipated to 635 %, largest_share to 0 % (all alike), "
                        "fragment.mean to 0 % (all alike), fragment.mass_mean to 0 % (all alike), "
                        "fragment.variation to 0 % (all alike): raise replicas");
    free(warning);
    fracas_replica_convergence_clear(&point.convergence);
    ensemble.nrealizations = 1;
    OK(fracas_replica_convergence_of(&ensemble, 1, &point.convergence));
    OK(fracas_analysis_warnings(&analysis, &warning, &warnings));
    assert_true(warnings == 1 && strstr(warning->text, "one usable replica cannot say"));
    free(warning);
    fracas_replica_convergence_clear(&point.convergence);
}

/* ---- energies over time ---- */

enum { INTERVALS = 4, MOST = 30 };

/* Replica i: rows a little after the times 0, 1, 2 and 3, the last at 2 for odd i, with extra rows
 * in between that no time must find. Kinetic energy is i, in another order of replicas; dissipated
 * the number of the time. Nothing runs until 4. */
static void make_history(int64_t replica, fracas_record *record)
{
    fracas_record_init(record);
    record->outcome = FRACAS_FRAGMENTED;
    record->fragments = 0;
    record->fragments_dust = 0;
    record->history = zeroed(8, sizeof *record->history);
    const int last = replica % 2 ? 2 : 3;
    for (int j = 0; j <= last; j++) {
        record->history[record->nhistory++] = (fracas_history_row){
            .time = j ? j + 0.001 * (double)replica : 0,
            .kinetic = (double)(replica * 7 % MOST),
            .elastic = -1,
            .cohesive = 2,
            .dissipated = j,
            .dissipated_bending = 0.25 * j};
        if (j < last)
            record->history[record->nhistory++] = (fracas_history_row){
                .time = j + 0.5, .kinetic = 99, .elastic = 99, .dissipated = 99};
    }
}

static void read_bands(int64_t replicas, fracas_bands *bands)
{
    fracas_bands_collector collector;
    OK(fracas_bands_begin(INTERVALS, INTERVALS, (size_t)replicas, bands, &collector));
    for (int64_t replica = 0; replica < replicas; replica++) {
        FRACAS_CLEARED(fracas_record) record;
        make_history(replica, &record);
        fracas_bands_add(&collector, &record);
    }
    fracas_bands_end(&collector);
}

/* 0 to 29: mean 14.5, quantiles at 1.45 and 27.55 of the order. */
static void band_of_many(void **state)
{
    FRACAS_CLEARED(fracas_bands) bands;
    read_bands(MOST, &bands);
    assert_int_equal(bands.count, 4); /* all have ended before 4 */
    assert_int_equal(bands.realizations, MOST);
    assert_false(bands.extremes);
    const int64_t running[] = {30, 30, 30, 15};
    for (size_t j = 0; j < bands.count; j++) {
        assert_true(bands.time[j] == (double)j);
        assert_int_equal(bands.running[j], running[j]);
        const fracas_band *kinetic = &bands.energy[j][FRACAS_ENERGY_kinetic],
                          *dissipated = &bands.energy[j][FRACAS_ENERGY_dissipated];
        assert_near(kinetic->mean, 14.5);
        assert_near(kinetic->low, 1.45);
        assert_near(kinetic->high, 27.55);
        assert_near(bands.energy[j][FRACAS_ENERGY_elastic].mean, -1);
        assert_near(bands.energy[j][FRACAS_ENERGY_cohesive].high, 2);
        assert_near(dissipated->mean, j < 3 ? (double)j : 2.5); /* half of them held at 2 */
        assert_near(dissipated->low, j < 3 ? (double)j : 2);
        assert_near(dissipated->high, (double)j);
        assert_near(bands.energy[j][FRACAS_ENERGY_dissipated_bending].high, 0.25 * (double)j);
    }
}

/* Kinetic 0, 7, 14. */
static void band_of_few(void **state)
{
    FRACAS_CLEARED(fracas_bands) bands;
    read_bands(3, &bands);
    assert_true(bands.extremes && bands.count == 4 && bands.running[3] == 2);
    assert_near(bands.energy[2][FRACAS_ENERGY_kinetic].mean, 7);
    assert_near(bands.energy[2][FRACAS_ENERGY_kinetic].low, 0);
    assert_near(bands.energy[2][FRACAS_ENERGY_kinetic].high, 14);
}

TESTS(sizes_by_number_and_by_mass, sizes_on_a_lattice_and_above_the_cut, variance_of_unequal_groups,
      estimates_at_their_ends, numbers_that_settle_and_others, band_of_many, band_of_few)
