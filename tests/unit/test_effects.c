/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Effects of parameters: settings, levels, intervals by their equations. */
#include "analysis/summary/effects.h"
#include "tests/support/test.h"

#include <gsl/gsl_cdf.h>

enum { RATES = 2, LAWS = 2, MOST = 40, NCOLUMNS = 3 };

static const fracas_column column[NCOLUMNS] = {{"cohesive.law", "", "", true},
                                               {"loading.rate", "1/s", "", false},
                                               {"strength.shape", "1", "", false}};

typedef struct {
    fracas_value value[MOST][NCOLUMNS];
    fracas_point_row row[MOST];
    fracas_point_table table;
    fracas_point_statistics point[MOST];
    fracas_analysis analysis;
} made;

static fracas_estimate mean_of(double mean, double deviation, int64_t n)
{
    return (fracas_estimate){n, mean, deviation, NAN};
}

static void add(made *of, const char *law, double rate, double shape, double count, double size)
{
    const size_t p = of->table.npoints++;
    of->value[p][0] = (fracas_value){NAN, law};
    of->value[p][1] = (fracas_value){rate, ""};
    of->value[p][2] = (fracas_value){shape, ""};
    of->row[p] = (fracas_point_row){.value = of->value[p]};
    of->point[p].count = mean_of(count, 0.1 * count, 4 + (int64_t)p);
    of->point[p].size = mean_of(size, 0.2 * size, 3);
}

static void begin(made *of)
{
    *of = (made){.table = {NCOLUMNS, column, 0, of->row}};
    of->analysis = (fracas_analysis){.table = &of->table, .point = of->point};
}

static void assert_row(const fracas_effect *effect, const char *words, const char *from,
                       const char *to, const char *at, int64_t settings, double count)
{
    assert_string_equal(effect->words, words);
    assert_string_equal(effect->from, from);
    assert_string_equal(effect->to, to);
    assert_string_equal(effect->at, at);
    assert_int_equal(effect->settings, settings);
    assert_true(fabs(effect->count.value - count) <= 1e-14 * (1 + fabs(count)));
}

/* Two laws by two rates by three shapes, given out of order; the count is that of a product, but
 * for one setting. Values ascend, texts stay in their order. */
static void settings_are_pairs(void **state)
{
    static made of;
    static const double shape[] = {20, 5, 10}, rate[] = {1e4, 1e3};
    OWNED fracas_effect *effect = NULL;
    size_t count;
    begin(&of);
    for (int l = 0; l < 2; l++)
        for (int r = 0; r < 2; r++)
            for (int s = 0; s < 3; s++)
                add(&of, l ? "nitsche" : "stershic", rate[r], shape[s],
                    100 * (l ? 2 : 1) * (r ? 0.5 : 1) * (shape[s] == 20 && !l ? 3 : 1),
                    1e-3 / (l ? 2 : 1));
    OK(fracas_columns_create(&of.table, &of.analysis.shown));
    OK(fracas_effects(&of.analysis, &effect, &count));
    assert_int_equal(count, (1 + 6) + (1 + 6) + 3 * (1 + 4));
    assert_row(effect, "rate", "1e3 1/s", "1e4 1/s", "", 6, 1);
    assert_row(effect + 1, "rate", "1e3 1/s", "1e4 1/s", "law stershic, shape of the strengths 20",
               1, 1);
    assert_true(effect->count.least == 1 && effect->count.most == 1);
    /* 3 falls to 1 by the law at shape 20: 2 in four of six settings, 2/3 in two */
    assert_row(effect + 7, "law", "stershic", "nitsche", "", 6, cbrt(2 * 2 * 2.0 / 3) - 1);
    assert_true(effect[7].count.least == 2.0 / 3 - 1 && effect[7].count.most == 1);
    assert_true(fabs(effect[7].size.value + 0.5) < 1e-15);
    assert_row(effect + 14, "shape of the strengths", "5", "10", "", 4, 0);
    assert_row(effect + 19, "shape of the strengths", "10", "20", "", 4, sqrt(3) - 1);
    assert_string_equal(effect[19].key, "strength.shape");
    /* over the range: to three times as much under stershic, to as much under nitsche */
    assert_row(effect + 24, "shape of the strengths", "5", "20", "", 4, sqrt(3) - 1);
    assert_true(effect[24].headline && effect[28].headline && effect[0].headline);
    assert_true(!effect[14].headline && !effect[19].headline && effect[7].headline);
    fracas_columns_clear(&of.analysis.shown);
}

/* (estimators.29) and (estimators.30), written out for two settings. */
static void intervals_are_of_the_settings(void **state)
{
    static made of;
    OWNED fracas_effect *effect = NULL;
    size_t count;
    double log_ratio = 0, v = 0, squares = 0;
    begin(&of);
    for (int s = 0; s < 2; s++)
        for (int r = 0; r < 2; r++)
            add(&of, "nitsche", r ? 1e4 : 1e3, s ? 10 : 5, 10 + 3 * s + 7 * r * (s + 1), NAN);
    OK(fracas_columns_create(&of.table, &of.analysis.shown));
    OK(fracas_effects(&of.analysis, &effect, &count));
    assert_int_equal(count, 3 + 3);
    for (size_t p = 0; p < 4; p++) {
        const double n = 4 + (double)p, u = 0.1 * 0.1 / n;
        log_ratio += (p % 2 ? 1 : -1) * log(of.point[p].count.mean);
        v += u;
        squares += u * u / (n - 1);
    }
    const double t = gsl_cdf_tdist_Pinv(0.975, v * v / squares), half = t * sqrt(v) / 2;
    assert_row(effect, "rate", "1e3 1/s", "1e4 1/s", "", 2, exp(log_ratio / 2) - 1);
    assert_true(fabs(effect->count.low - (exp(log_ratio / 2 - half) - 1)) < 1e-12);
    assert_true(fabs(effect->count.high - (exp(log_ratio / 2 + half) - 1)) < 1e-12);
    assert_true(isnan(effect->size.value) && isnan(effect->size.low) && isnan(effect->size.least));
    fracas_columns_clear(&of.analysis.shown);
}

/* A mean of one replica has no interval, nor have equal replicas; a point without a mean
 * makes no setting, nor does one without a partner; too many values are no levels. */
static void odd_points(void **state)
{
    static made of;
    OWNED fracas_effect *effect = NULL;
    size_t count;
    begin(&of);
    add(&of, "nitsche", 1e3, 5, 10, 1);
    add(&of, "nitsche", 1e4, 5, 20, 1);
    add(&of, "nitsche", 1e3, 10, 10, 1);
    add(&of, "nitsche", 1e4, 10, NAN, 0);
    add(&of, "nitsche", 1e5, 20, 10, 1);
    of.point[0].count = mean_of(10, NAN, 1);
    of.point[0].size = mean_of(1, 0, 3);
    of.point[1].size = mean_of(2, 0, 3);
    OK(fracas_columns_create(&of.table, &of.analysis.shown));
    OK(fracas_effects(&of.analysis, &effect, &count));
    assert_int_equal(count, 2);
    assert_row(effect, "rate", "1e3 1/s", "1e4 1/s", "", 1, 1);
    assert_true(isnan(effect->count.low) && isnan(effect->count.high));
    assert_true(effect->size.value == 1 && isnan(effect->size.low) && isnan(effect->size.high));
    assert_row(effect + 1, "shape of the strengths", "5", "10", "", 1, 0);
    fracas_columns_clear(&of.analysis.shown);
    free(effect);
    for (size_t levels = FRACAS_MOST_LEVELS; levels <= FRACAS_MOST_LEVELS + 1; levels++) {
        begin(&of);
        for (size_t l = 0; l < levels; l++) add(&of, "nitsche", 1e3, (double)(levels - l), 10, 1);
        OK(fracas_columns_create(&of.table, &of.analysis.shown));
        OK(fracas_effects(&of.analysis, &effect, &count));
        assert_int_equal(count, levels > FRACAS_MOST_LEVELS ? 0 : levels);
        fracas_columns_clear(&of.analysis.shown);
        if (levels == FRACAS_MOST_LEVELS) free(effect);
    }
}

/* Parameters that change along at all points share the effect and are named; where they change by
 * themselves, too, they make settings. A parameter that one law has not is no difference. */
static void partners_are_named(void **state)
{
    static made of;
    OWNED fracas_effect *effect = NULL;
    size_t count;
    begin(&of);
    add(&of, "nitsche", 1e3, 5, 10, 1); /* rates and shapes zipped */
    add(&of, "nitsche", 1e4, 10, 20, 1);
    add(&of, "stershic", 1e3, 5, 30, 1);
    add(&of, "stershic", 1e4, 10, 60, 1);
    OK(fracas_columns_create(&of.table, &of.analysis.shown));
    OK(fracas_effects(&of.analysis, &effect, &count));
    assert_int_equal(count, 6);
    assert_row(effect, "rate, with shape of the strengths", "1e3 1/s", "1e4 1/s", "", 2, 1);
    assert_row(effect + 1, "rate, with shape of the strengths", "1e3 1/s", "1e4 1/s", "law nitsche",
               1, 1);
    assert_row(effect + 3, "law", "nitsche", "stershic", "", 2, 2);
    fracas_columns_clear(&of.analysis.shown);
    free(effect);
    begin(&of);
    add(&of, "nitsche", 1e3, 5, 10,
        1); /* two corners and one between: no two differ in one alone */
    add(&of, "nitsche", 1e4, 10, 20, 1);
    add(&of, "nitsche", 1e3, 10, 30, 1);
    OK(fracas_columns_create(&of.table, &of.analysis.shown));
    OK(fracas_effects(&of.analysis, &effect, &count));
    assert_int_equal(count, 2);
    assert_row(effect, "rate", "1e3 1/s", "1e4 1/s", "", 1, 20.0 / 30 - 1); /* at shape 10 */
    assert_row(effect + 1, "shape of the strengths", "5", "10", "", 1, 2);  /* at rate 1e3 */
    fracas_columns_clear(&of.analysis.shown);
    free(effect);
    begin(&of);
    add(&of, "nitsche", 1e3, NAN, 10, 1); /* without a shape */
    add(&of, "stershic", 1e3, 5, 20, 1);
    add(&of, "stershic", 1e3, 10, 40, 1);
    OK(fracas_columns_create(&of.table, &of.analysis.shown));
    OK(fracas_effects(&of.analysis, &effect, &count));
    assert_row(effect, "law", "nitsche", "stershic", "", 2, sqrt(2 * 4) - 1);
    fracas_columns_clear(&of.analysis.shown);
}

/* A parameter of some points, the same in all of them, goes along with none; settings that share a
 * point are named by the other, and its error counts in both: c = 2. Common random numbers leave
 * several settings without an interval. */
static void shared_points(void **state)
{
    static made of;
    OWNED fracas_effect *effect = NULL;
    size_t count;
    begin(&of);
    add(&of, "nitsche", 1e3, 5, 30, 1);
    add(&of, "nitsche", 1e3, 10, 40, 1);
    add(&of, "stershic", 1e3, NAN, 60, 1);
    OK(fracas_columns_create(&of.table, &of.analysis.shown));
    OK(fracas_effects(&of.analysis, &effect, &count));
    assert_row(effect, "law", "nitsche", "stershic", "", 2, sqrt(2 * 1.5) - 1);
    assert_string_equal(effect[1].at, "shape of the strengths 5");
    double v = 0, squares = 0;
    for (size_t p = 0; p < 3; p++) {
        const double c = p == 2 ? 2 : 1, n = 4 + (double)p, u = c * c * 0.1 * 0.1 / n;
        v += u;
        squares += u * u / (n - 1);
    }
    const double half = gsl_cdf_tdist_Pinv(0.975, v * v / squares) * sqrt(v) / 2;
    assert_true(fabs(log1p(effect->count.high) - log1p(effect->count.value) - half) < 1e-12);
    free(effect);
    of.analysis.common = true;
    OK(fracas_effects(&of.analysis, &effect, &count));
    assert_true(isnan(effect->count.low) && isnan(effect->count.high) && effect->count.value > 0);
    assert_true(effect[1].count.low < effect[1].count.value);
    fracas_columns_clear(&of.analysis.shown);
    free(effect);
    begin(&of);
    for (int s = 0; s < 2; s++) {
        add(&of, "nitsche", 1e3, s ? 10 : 5, 30 + 10 * s, 1);
        add(&of, "stershic", NAN, s ? 10 : 5, 60 + 10 * s, 1);
    }
    OK(fracas_columns_create(&of.table, &of.analysis.shown));
    OK(fracas_effects(&of.analysis, &effect, &count));
    for (size_t i = 0; i < count; i++) assert_null(strstr(effect[i].words, "with rate"));
    assert_string_equal(effect[count - 3].words, "shape of the strengths");
    fracas_columns_clear(&of.analysis.shown);
}

TESTS(settings_are_pairs, intervals_are_of_the_settings, odd_points, partners_are_named,
      shared_points)
