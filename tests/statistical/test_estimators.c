/* SPDX-License-Identifier: GPL-3.0-or-later */
/* ctest-labels: ci slow-sanitize */
/* How often the intervals of a point's estimates hold the truth, where fragments of one realization
 * are alike. docs/theory/estimators.md states it from 1000 repetitions, which
 * tests/statistical/coverage.sh repeats (FRACAS_REPETITIONS=1000, minutes); the ordinary run has
 * fewer.
 */
#include "analysis/data/estimate.h"
#include "analysis/estimate/pooled.h"
#include "tests/support/test.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>

/* Realization i has a scale A_i, lognormal of deviation SIGMA, and 10 + Poisson(30/A_i) fragments
 * of size A_i x, x gamma of shape 3 and mean 1: the larger the fragments, the fewer. Masses are as
 * sizes. */
#define SIGMA 0.2
enum { SHAPE = 3, LEAST = 10, REST = 30, ORDINARY = 100, STATED = 1000 };

typedef enum {
    COUNT,
    MEAN,
    MASS_MEAN,
    VARIATION,
    MEDIAN,
    UPPER,
    MASS_MEDIAN,
    INTRACLASS,
    NNUMBERS
} number;
static const char *const name[NNUMBERS] = {
    "mean count", "mean size",     "mass mean",   "variation",
    "median",     "quantile 0.95", "mass median", "intraclass correlation"};

/* E f(A) g(x) over scales and fragments, weighed by their mean number: sums over realizations are
 * ratios of those. Trapezia over a normal density, of which every derivative vanishes at the ends,
 * err by less than rounding. */
static double over_scales(double (*of)(double scale, double argument), double argument)
{
    double sum = 0;
    for (int k = -800; k <= 800; k++) {
        const double z = k / 100.0, scale = exp(SIGMA * z);
        sum += 0.01 * gsl_ran_ugaussian_pdf(z) * (LEAST + REST / scale) * of(scale, argument);
    }
    return sum;
}

static double power(double scale, double exponent)
{
    return pow(scale, exponent);
}
static double below(double scale, double size)
{
    return gsl_cdf_gamma_P(size / scale, SHAPE, 1.0 / SHAPE);
}
/* By mass: x f(x) of a gamma density is that of shape + 1. */
static double mass_below(double scale, double size)
{
    return scale * gsl_cdf_gamma_P(size / scale, SHAPE + 1, 1.0 / SHAPE);
}

static double quantile(double (*of)(double, double), double total, double share)
{
    double low = 0, high = 20;
    for (int i = 0; i < 60; i++) {
        const double middle = 0.5 * (low + high);
        *(over_scales(of, middle) < share * total ? &low : &high) = middle;
    }
    return low;
}

/* E x^2 = (shape + 1)/shape, var x = 1/shape. The intraclass correlation is that of very many
 * realizations: mean squares among them E A^2 var x + E N (A - mean)^2, within them E (N - 1) A^2
 * var x/E (N - 1), and groups of E N. */
static void truths(double truth[NNUMBERS])
{
    const double n = over_scales(power, 0), size = over_scales(power, 1),
                 squares = over_scales(power, 2) * (SHAPE + 1) / SHAPE;
    truth[COUNT] = n;
    truth[MEAN] = size / n;
    truth[MASS_MEAN] = squares / size;
    truth[VARIATION] = sqrt(squares / n - size / n * (size / n)) / (size / n);
    truth[MEDIAN] = quantile(below, n, 0.5);
    truth[UPPER] = quantile(below, n, 0.95);
    truth[MASS_MEDIAN] = quantile(mass_below, size, 0.5);
    const double mean = size / n, square = exp(2 * SIGMA * SIGMA), variance = 1.0 / SHAPE;
    const double among = square * variance + over_scales(power, 2) - 2 * mean * size +
                         mean * mean * n;
    const double within = (over_scales(power, 2) - square) * variance / (n - 1);
    truth[INTRACLASS] = (among - within) / (among + (n - 1) * within);
}

/* Each realization's fragments, or each fragment a realization of its own. */
static void draw(gsl_rng *random, size_t n, bool apart, fracas_ensemble *ensemble)
{
    enum { MOST = 400 };
    fracas_fragment fragment[MOST];
    fracas_record record;
    fracas_record_init(&record);
    fracas_ensemble_clear(ensemble);
    for (size_t i = 0; i < n; i++) {
        const double scale = gsl_ran_lognormal(random, 0, SIGMA);
        size_t count = LEAST + gsl_ran_poisson(random, REST / scale);
        if (count > MOST) count = MOST;
        for (size_t f = 0; f < count; f++) {
            const double size = scale * gsl_ran_gamma(random, SHAPE, 1.0 / SHAPE);
            fragment[f] = (fracas_fragment){.size = size, .mass = size, .elements = 1000};
        }
        const fracas_replica_values value = {.count = (double)count};
        for (size_t f = 0; f < count; f += record.nfragment) {
            record.fragment = fragment + f;
            record.nfragment = apart ? 1 : count;
            OK(fracas_ensemble_add(ensemble, i, (int64_t)i, &value, &record));
        }
    }
}

typedef struct {
    double held[NNUMBERS], value[NNUMBERS], squares[NNUMBERS], width[NNUMBERS];
    int repetitions;
} tally;

static void count_one(tally *of, number v, double truth, double value, double low, double high)
{
    of->held[v] += low <= truth && truth <= high;
    of->value[v] += value;
    of->squares[v] += (value - truth) * (value - truth);
    of->width[v] += 0.5 * (high - low);
}

static void repeat(size_t n, bool apart, int repetitions, const double truth[NNUMBERS], tally *of)
{
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    gsl_rng_set(random, (unsigned long)(20261122 + n + apart));
    FRACAS_CLEARED(fracas_ensemble) ensemble;
    fracas_ensemble_init(&ensemble, 0);
    *of = (tally){.repetitions = repetitions};
    for (int r = 0; r < repetitions; r++) {
        fracas_pooled pooled;
        draw(random, n, apart, &ensemble);
        const fracas_estimate count = fracas_estimate_of(
            &ensemble.value->count, FRACAS_REPLICA_STRIDE, ensemble.nrealizations);
        OK(fracas_pooled_of(&ensemble, (uint64_t)r, &pooled));
        const fracas_interval *interval[NNUMBERS] = {
            [MEAN] = &pooled.all.mean,
            [MASS_MEAN] = &pooled.all.mass_mean,
            [VARIATION] = &pooled.all.variation,
            [MEDIAN] = &pooled.all.quantile[2],
            [UPPER] = &pooled.all.quantile[4],
            [MASS_MEDIAN] = &pooled.all.mass_quantile[2],
            [INTRACLASS] = &pooled.variance.intraclass,
        };
        count_one(of, COUNT, truth[COUNT], count.mean, count.mean - count.half_width,
                  count.mean + count.half_width);
        for (int v = MEAN; v < NNUMBERS; v++)
            count_one(of, (number)v, truth[v], interval[v]->value, interval[v]->low,
                      interval[v]->high);
    }
    gsl_rng_free(random);
}

/* Of 16 realizations and more, whose intervals are BCa; and of a few, whose intervals are Student's
 * and cost so little that every run has all repetitions. */
enum { CASES = 4, APART = CASES - 1, FEWS = 6, COLUMNS = FEWS };
static const struct {
    size_t n;
    bool apart;
} make[CASES] = {{16, false}, {50, false}, {100, false}, {16, true}};
static const size_t few[FEWS] = {2, 3, 4, 5, 6, 7};

/* What the theory page states of a number in the table of this head, "| mean size | 0.94 | 0.95 |
 * 0.95 | 0.6 |", NaN for what is no number there. */
static void read_stated(const char *head, const char *what, size_t columns, double stated[COLUMNS])
{
    static char page[1 << 16];
    char row[80], *end;
    FILE *in = fopen(FRACAS_SOURCE_DIR "/docs/theory/estimators.md", "r");
    assert_non_null(in);
    page[fread(page, 1, sizeof page - 1, in)] = '\0';
    fclose(in);
    snprintf(row, sizeof row, "\n| %s |", what);
    const char *table = strstr(page, head), *at = table ? strstr(table, row) : NULL;
    if (!at) fail_msg("the page states nothing for %s", what);
    at += strlen(row);
    for (size_t c = 0; c < columns; c++) {
        stated[c] = strtod(at, &end);
        if (end == at) stated[c] = NAN;
        at = strchr(at, '|');
        assert_non_null(at);
        at++;
    }
}

static void print_row(number v, size_t realizations, bool apart, double truth, const tally *of)
{
    const double n = of->repetitions;
    printf("%-22s n %3zu%s: truth %.4f, bias %+.4f, rms error %.4f, half width %.4f, held %.3f\n",
           name[v], realizations, apart ? " apart" : "", truth, of->value[v] / n - truth,
           sqrt(of->squares[v] / n), of->width[v] / n, of->held[v] / n);
}

/* Coverage c of R repetitions is known to e = sqrt(c (1 - c)/R). In 1000 it is within 93 to 97 %
 * from 50 realizations on, and what the page states, but for its three digits and a few repetitions
 * of other roundings: 0.004. In fewer it is that within 4.9 e (alpha 1e-6), of c = 0.9 at the
 * least. The bias is below a tenth of the half width, beside 4.9 of its own errors. Fragment by
 * fragment, intervals of mean sizes hold the truth in less than 0.8. */
static void check(number v, int c, double truth, double stated, const tally *of)
{
    const bool all = of->repetitions >= STATED;
    const double n = of->repetitions, held = of->held[v] / n, bias = of->value[v] / n - truth;
    if (make[c].apart) {
        assert_true(v == MEAN || v == MASS_MEAN ? held < 0.8 : true);
        return;
    }
    assert_true(fabs(held - stated) <= (all ? 0.004 : 4.9 * sqrt(0.9 * 0.1 / n)));
    assert_true(!all || make[c].n < 50 || (held >= 0.93 && held <= 0.97));
    assert_true(fabs(bias) < 0.1 * of->width[v] / n + 4.9 * sqrt(of->squares[v] / n / n));
}

static void intervals_hold_the_truth_as_often_as_stated(void **state)
{
    const char *asked = getenv("FRACAS_REPETITIONS");
    const int repetitions = asked ? atoi(asked) : ORDINARY;
    double truth[NNUMBERS], stated[COLUMNS];
    tally of[CASES] = {{.repetitions = 0}};
    truths(truth);
    for (int c = 0; c < CASES; c++)
        if (repetitions >= STATED || make[c].n <= 50)
            repeat(make[c].n, make[c].apart,
                   make[c].apart ? (repetitions >= STATED ? ORDINARY : ORDINARY / 4) : repetitions,
                   truth, &of[c]);
    for (int v = 0; v < NNUMBERS; v++)
        for (int c = 0; c < CASES; c++)
            if (of[c].repetitions) print_row((number)v, make[c].n, make[c].apart, truth[v], &of[c]);
    for (int v = 0; v < NNUMBERS; v++) {
        read_stated("\n| number | n = 16 |", name[v], v == INTRACLASS ? APART : CASES,
                    stated); /* of groups of one there is no correlation */
        for (int c = 0; c < CASES; c++)
            if (of[c].repetitions) check((number)v, c, truth[v], stated[c], &of[c]);
    }
}

/* With two realizations and more: what the page states, to its three digits and a few repetitions
 * of other roundings; and of the mean size and the median, whose intervals are the ones that are
 * read most, 93 % but for 4.9 errors of a share of 0.93 in 1000 repetitions, 0.040, where
 * resampling held 83 to 91 % of means of four and five, and less of the others. */
static void intervals_of_few_realizations(void **state)
{
    double truth[NNUMBERS], stated[COLUMNS];
    tally of[FEWS];
    truths(truth);
    for (int c = 0; c < FEWS; c++) repeat(few[c], false, STATED, truth, &of[c]);
    for (int v = 0; v < NNUMBERS; v++)
        for (int c = 0; c < FEWS; c++) print_row((number)v, few[c], false, truth[v], &of[c]);
    for (int v = 0; v < NNUMBERS; v++) {
        read_stated("\n| number | n = 2 |", name[v], FEWS, stated);
        for (int c = 0; c < FEWS; c++) {
            const double held = of[c].held[v] / STATED;
            if (v == INTRACLASS && few[c] == 2)
                assert_true(held == 0 && isnan(stated[c])); /* there is none without one of two */
            else assert_true(fabs(held - stated[c]) <= 0.004);
            if (v == MEAN || v == MEDIAN) assert_true(held >= 0.93 - 0.040);
        }
    }
}

TESTS(intervals_hold_the_truth_as_often_as_stated, intervals_of_few_realizations)
