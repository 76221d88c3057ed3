/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fourier transforms against sums in long double, and K_nu against GSL. */
#include "sampler/special/bessel.h"
#include "sampler/special/fft.h"
#include "tests/support/test.h"

#include <float.h>
#include <gsl/gsl_sf_bessel.h>

enum { LONGEST = 1000 };

/* Numbers that are alike in no way, in [-1, 1). */
static double scattered(size_t i)
{
    return (double)(int64_t)((uint64_t)(i + 1) * 0x9e3779b97f4a7c15u) * 0x1p-63;
}

/* The transform has sqrt(n) times the norm of x. A transform of 2^p numbers goes through p steps,
 * each with an error below 3 units u of rounding of the norm (Higham, Accuracy and Stability of
 * Numerical Algorithms, 24.1). Other lengths go through two transforms with p < log2(4 n) and three
 * products, 3 u each, and the filter was transformed itself: below (9 p + 9) u, and 12 p u is
 * plenty. */
static void transforms_are_the_sums(void **state)
{
    static const size_t lengths[] = {1,  2,  3,  4,   5,   6,   7,   8,      12,
                                     17, 64, 97, 128, 360, 512, 641, LONGEST};
    static double x[LONGEST][2];
    for (size_t l = 0; l < sizeof lengths / sizeof *lengths; l++) {
        const size_t n = lengths[l];
        OWN(fracas_fft) fft;
        double norm2 = 0.0, worst = 0.0;
        OK(fracas_fft_create(n, &fft));
        for (size_t k = 0; k < n; k++) {
            x[k][0] = scattered(2 * k);
            x[k][1] = scattered(2 * k + 1);
            norm2 += x[k][0] * x[k][0] + x[k][1] * x[k][1];
        }
        OK(fracas_fft_transform(fft, x));
        for (size_t j = 0; j < n; j++) {
            long double real = 0.0L, imaginary = 0.0L;
            for (size_t k = 0; k < n; k++) {
                const long double angle = -2.0L * M_PIl * (long double)(j * k % n) / (long double)n,
                                  c = cosl(angle), s = sinl(angle);
                real += c * scattered(2 * k) - s * scattered(2 * k + 1);
                imaginary += s * scattered(2 * k) + c * scattered(2 * k + 1);
            }
            worst = fmax(worst, hypot((double)(real - x[j][0]), (double)(imaginary - x[j][1])));
        }
        const double bound = 12.0 * log2(4.0 * (double)n) * 0.5 * DBL_EPSILON * sqrt(norm2) *
                             sqrt((double)n);
        print_message("%zu numbers: %.2e, bound %.2e\n", n, worst, bound);
        assert_true(worst <= bound);
    }
    fracas_fft_destroy(NULL);
}

/* GSL's own error is 1e-13 at most here (its documentation's estimates, which the comparison
 * confirms). */
static void bessel_is_that_of_gsl(void **state)
{
    static const double orders[] = {0, 0.1, 0.3, 0.5, 1, 1.3, 1.5, 2, 2.5, 3.7, 5, 7.9, 10};
    double worst = 0.0;
    for (size_t o = 0; o < sizeof orders / sizeof *orders; o++)
        for (double x = 1e-6; x < 700; x *= 1.37)
            worst = fmax(worst, fabs(fracas_bessel_k_scaled(orders[o], x) /
                                         gsl_sf_bessel_Knu_scaled(orders[o], x) -
                                     1.0));
    print_message("K_nu: %.2e\n", worst);
    assert_true(worst < 1e-12);
    /* K_(1/2)(x) e^x = sqrt(pi/(2 x)), from the smallest x to the largest; some hundred terms
     * round. */
    for (double x = 1e-20; x < 1000; x *= 11)
        assert_true(fabs(fracas_bessel_k_scaled(0.5, x) / sqrt(M_PI / (2 * x)) - 1.0) < 1e-13);
}

TESTS(transforms_are_the_sums, bessel_is_that_of_gsl)
