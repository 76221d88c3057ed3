/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Samples of strengths against their exact laws: Kolmogorov-Smirnov, moments, minima. Seeds are
 * fixed, so a result is the same in every run; every bound is the one that a right sampler exceeds
 * with probability ALPHA or less. */
#ifndef FRACAS_TESTS_SUPPORT_STRENGTH_SAMPLES_H
#define FRACAS_TESTS_SUPPORT_STRENGTH_SAMPLES_H

#include "tests/support/laws.h"
#include "tests/support/strengths.h"

#define ALPHA 1e-6
static const double normal_bound = 4.8916; /* |z| exceeds it with probability ALPHA */

enum { N = 100000, CHAINS = 10000, LONGEST = 64 };
static double sample[N], volume[N];

static inline fracas_stream stream(uint64_t seed)
{
    return (fracas_stream){
        .seed = seed, .purpose = FRACAS_PURPOSE_STRENGTH, .point = {11, 22}, .replica = 3};
}

/* Fills `sample`, of interfaces of the volume `each` [m3]. */
static inline void draw(const fracas_strength *law, uint64_t seed, double each)
{
    const fracas_stream named = stream(seed);
    for (size_t i = 0; i < N; i++) volume[i] = each;
    OK(sample_strengths(law, &named, N, volume, NULL, 1, sample));
}

static inline int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* P(strength <= s); with an atom at the maximum, just below it. */
typedef double law_cdf(const fracas_strength *law, double s);

/* D = sup |F_n - F|, F that of the weakest of `size`. P(D > d) <= 2 exp(-2 n d^2) for every n
 * (Massart 1990): d = sqrt(ln(2/alpha)/(2 n)). That holds with an atom at the maximum of flaws,
 * too: F is then the law's just below the maximum and 1, as F_n, at it. */
static inline void assert_follows(const fracas_strength *law, law_cdf *cdf, double size,
                                  double *value, size_t n)
{
    const bool atom = strcmp(law->distribution->name, "flaws") == 0;
    double distance = 0.0;
    qsort(value, n, sizeof *value, ascending);
    for (size_t i = 0; i < n; i++) {
        const double below = -expm1(size * log1p(-cdf(law, value[i]))),
                     f = atom && value[i] == law->maximum ? 1.0 : below;
        distance = fmax(distance, below - (double)i / (double)n);
        distance = fmax(distance, (double)(i + 1) / (double)n - f);
    }
    const double bound = sqrt(log(2.0 / ALPHA) / (2.0 * (double)n));
    print_message("%s, size %g: D = %.2e, bound %.2e\n", law->distribution->name, size, distance,
                  bound);
    assert_true(distance < bound);
}

/* The sample's own moments against those of the law. The mean has the standard error
 * deviation/sqrt(n); the deviation deviation sqrt((kurtosis - 1)/(4 n)), the kurtosis NaN: as the
 * sample has it. */
static inline void assert_moments(double mean, double deviation, double kurtosis)
{
    double sum = 0.0, squares = 0.0, fourths = 0.0;
    for (size_t i = 0; i < N; i++) sum += sample[i] - mean;
    for (size_t i = 0; i < N; i++) {
        const double square = (sample[i] - mean - sum / N) * (sample[i] - mean - sum / N);
        squares += square;
        fourths += square * square;
    }
    const double found = sqrt(squares / (N - 1));
    if (isnan(kurtosis)) kurtosis = N * fourths / (squares * squares);
    print_message("%.2f +- %.2f MPa, exactly %.2f +- %.2f\n", (mean + sum / N) * 1e-6, found * 1e-6,
                  mean * 1e-6, deviation * 1e-6);
    assert_true(fabs(sum / N) < normal_bound * deviation / sqrt(N));
    assert_true(fabs(found - deviation) <
                normal_bound * deviation * sqrt((kurtosis - 1) / (4.0 * N)));
}

/* Fills `sample` with the weakest of n interfaces that share the volume `whole` [m3], CHAINS times,
 * each a replica. */
static inline void draw_weakest(const fracas_strength *law, size_t n, double whole, uint64_t seed)
{
    fracas_stream named = stream(seed);
    for (size_t i = 0; i < n; i++) volume[i] = whole / (double)n;
    for (size_t chain = 0; chain < CHAINS; chain++) {
        double strength[LONGEST];
        named.replica = chain;
        OK(sample_strengths(law, &named, n, volume, NULL, 1, strength));
        sample[chain] = INFINITY;
        for (size_t i = 0; i < n; i++) sample[chain] = fmin(sample[chain], strength[i]);
    }
}

#endif
