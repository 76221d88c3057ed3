/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Streams of random numbers: even, uncorrelated, independent of streams of neighbouring names. The
 * long batteries are in docs/results/random-numbers.md. Names are fixed, so a result is the same in
 * every run; a right generator fails any one of the checks with probability ALPHA. */
#include "base/param.h"
#include "sampler/stream.h"
#include "tests/support/test.h"

#include <gsl/gsl_cdf.h>

#define ALPHA 1e-6

enum { N = 1 << 19, CELLS = 4096, BITS = 52 };
static double u[N], v[N];

/* The hash of a point is as good as random, the rest of a name is small numbers. */
static const fracas_stream here = {
    1, FRACAS_PURPOSE_STRENGTH, {0x243f6a8885a308d3, 0x13198a2e03707344}, 0};

/* The 52 bits that u is made of. */
static uint64_t bits_of(double number)
{
    return (uint64_t)(number * 0x1p52); /* the half is cut off */
}

/* Too small a sum is as wrong as too large a one. */
static void assert_chi_square(const char *what, double sum, double freedom)
{
    const double above = gsl_cdf_chisq_Q(sum, freedom), below = gsl_cdf_chisq_P(sum, freedom);
    print_message("%s: chi^2 = %.1f of %g, p = %.2g\n", what, sum, freedom, above);
    assert_true(above > 0.5 * ALPHA && below > 0.5 * ALPHA);
}

/* Of equally likely cells; N/CELLS = 128 in each. */
static void assert_even(const char *what, const uint32_t count[CELLS])
{
    double sum = 0.0, expected = (double)N / CELLS;
    for (size_t c = 0; c < CELLS; c++)
        sum += ((double)count[c] - expected) * ((double)count[c] - expected) / expected;
    assert_chi_square(what, sum, CELLS - 1);
}

/* The highest 12 bits, those in the middle and the lowest as the number of a cell. */
static void numbers_are_even(void **state)
{
    fracas_stream_fill(&here, 0, N, u);
    static const struct {
        const char *what;
        unsigned shift;
    } part[] = {{"highest bits", 40}, {"middle bits", 20}, {"lowest bits", 0}};
    for (size_t k = 0; k < FRACAS_COUNT(part); k++) {
        uint32_t count[CELLS] = {0};
        for (size_t i = 0; i < N; i++) count[bits_of(u[i]) >> part[k].shift & (CELLS - 1)]++;
        assert_even(part[k].what, count);
    }
}

/* The correlations at lags 1 ... LAGS of independent numbers are, times sqrt(N), independent and
 * normal, but for O(LAGS/N). */
static void numbers_are_uncorrelated(void **state)
{
    enum { LAGS = 200 };
    fracas_stream_fill(&here, 0, N, u);
    double squares = 0.0;
    for (size_t lag = 1; lag <= LAGS; lag++) {
        double sum = 0.0;
        for (size_t i = 0; i + lag < N; i++) sum += 12.0 * (u[i] - 0.5) * (u[i + lag] - 0.5);
        squares += sum * sum / (double)(N - lag);
    }
    assert_chi_square("correlations of successive sites", squares, LAGS);
}

/* Pairs of numbers of two streams, of one site and of neighbouring ones, in 64 x 64 cells by their
 * highest and by their lowest 6 bits. */
static void assert_independent(const char *what)
{
    static const unsigned shifts[] = {46, 0};
    for (size_t k = 0; k < FRACAS_COUNT(shifts); k++)
        for (size_t off = 0; off < 3; off++) {
            uint32_t count[CELLS] = {0};
            for (size_t i = 0; i < N; i++)
                count[(bits_of(u[(i + (off == 1)) % N]) >> shifts[k] & 63) * 64 +
                      (bits_of(v[(i + (off == 2)) % N]) >> shifts[k] & 63)]++;
            assert_even(what, count);
        }
}

static void neighbouring_streams_are_independent(void **state)
{
    enum { NEXT = 10 };
    fracas_stream next[NEXT];
    for (size_t k = 0; k < NEXT; k++) next[k] = here;
    static const char *const what[NEXT] = {"next replica",
                                           "replica 2^32",
                                           "next seed",
                                           "other half of seeds",
                                           "next purpose",
                                           "next point, first word",
                                           "next point, second word",
                                           "other half of points, first word",
                                           "other half of points, second word",
                                           "words of the point swapped"};
    next[0].replica++;
    next[1].replica += (uint64_t)1 << 32;
    next[2].seed++;
    next[3].seed ^= (uint64_t)1 << 63;
    next[4].purpose++;
    next[5].point[0]++;
    next[6].point[1]++;
    next[7].point[0] ^= (uint64_t)1 << 63;
    next[8].point[1] ^= (uint64_t)1 << 63;
    next[9].point[0] = here.point[1], next[9].point[1] = here.point[0];
    fracas_stream_fill(&here, 0, N, u);
    for (size_t k = 0; k < NEXT; k++) {
        fracas_stream_fill(&next[k], 0, N, v);
        assert_independent(what[k]);
    }
    fracas_stream_fill(&here, fracas_stream_site(0, 1), N, v);
    assert_independent("next Gauss point");
    fracas_stream_fill(&next[2], 0, N, u);
    fracas_stream_fill(&next[4], 0, N, v);
    assert_independent("next seed and next purpose");
    fracas_stream_fill(&here, 0, N, u);
    fracas_stream turned = here;
    for (size_t i = 0; i < N; i++) {
        turned.replica = i;
        v[i] = fracas_stream_uniform(&turned,
                                     i > 0 ? 0 : N); /* site 0 of replica 0 is u[0] itself */
    }
    assert_independent("site and replica exchanged");
    for (size_t i = 0; i < N; i++) { /* each site in one pair */
        u[i] = fracas_stream_uniform(&here, 2 * i);
        v[i] = fracas_stream_uniform(&here, 2 * i + 1);
    }
    assert_independent("next site");
}

/* The bits of a name of six words. */
static uint64_t bits_of_name(const uint64_t name[6])
{
    const fracas_stream stream = {name[1], name[2], {name[3], name[4]}, name[5]};
    return bits_of(fracas_stream_uniform(&stream, name[0]));
}

/* Every bit of a name turns over every bit of the number in half of all names: with n names, the
 * flips of each of the 64 x 52 pairs are binomial, (flips - n/2)^2/(n/4) has mean 1, and they are
 * independent. */
static void every_bit_of_a_name_counts(void **state)
{
    enum { NAMES = 4096 };
    static const char *const what[6] = {"bits of the site",
                                        "bits of the seed",
                                        "bits of the purpose",
                                        "bits of the point, first word",
                                        "bits of the point, second word",
                                        "bits of the replica"};
    for (size_t w = 0; w < 6; w++) {
        double sum = 0.0;
        for (unsigned bit = 0; bit < 64; bit++) {
            uint32_t flips[BITS] = {0};
            for (uint64_t i = 0; i < NAMES; i++) {
                uint64_t name[6] = {64 * w + bit,  here.seed,     here.purpose,
                                    here.point[0], here.point[1], 0};
                name[w == 5 ? 0 : 5] += 512 * i; /* no name twice */
                uint64_t turned = bits_of_name(name);
                name[w] ^= (uint64_t)1 << bit;
                turned ^= bits_of_name(name);
                for (unsigned b = 0; b < BITS; b++) flips[b] += turned >> b & 1;
            }
            for (unsigned b = 0; b < BITS; b++)
                sum += (flips[b] - 0.5 * NAMES) * (flips[b] - 0.5 * NAMES) / (0.25 * NAMES);
        }
        assert_chi_square(what[w], sum, 64 * BITS);
    }
}

TESTS(numbers_are_even, numbers_are_uncorrelated, neighbouring_streams_are_independent,
      every_bit_of_a_name_counts)
