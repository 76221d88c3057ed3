/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Correlated strength fields: time to make one, time of a realization, and error of the
 * correlation.
 *
 *   bench_field        fields on chains, a plate (edges of a grid) and an octant (spread sites)
 *   bench_field N      the surfaces with about N sites
 *   bench_field N L    with this l/h alone, and a gaussian covariance as well */
#include "bench/bench.h"

#include "sampler/api/sampler.h"
#include "sampler/field/covariance.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Sites of an element size of 1; their number. */
static size_t make_plate(size_t n, double (*x)[3])
{
    const size_t side = (size_t)sqrt((double)n / 3.0);
    static const double middle[3][2] = {{0.5, 0}, {0, 0.5}, {0.5, 0.5}};
    for (size_t k = 0; k < 3 * side * side; k++)
        for (int a = 0; a < 3; a++)
            x[k][a] = a < 2 ? (double)(a ? k / 3 / side : k / 3 % side) + middle[k % 3][a] : 0.0;
    return 3 * side * side;
}

static size_t make_octant(size_t n, double (*x)[3])
{
    const double radius = sqrt((double)n / 3.0 /
                               (M_PI / 2.0)); /* three edges for each square of the element size */
    size_t count = 0;
    for (size_t i = 0; i < 8 * n && count < n; i++) {
        const double z = 1.0 - (2.0 * (double)i + 1.0) / (8.0 * (double)n), r = sqrt(1.0 - z * z),
                     turn = 2.399963229728653 * (double)i;
        if (!(z > 0.0 && cos(turn) > 0.0 && sin(turn) > 0.0)) continue;
        memcpy(x[count++], (double[3]){radius * r * cos(turn), radius * r * sin(turn), radius * z},
               sizeof *x);
    }
    return count;
}

static size_t make_line(size_t n, double (*x)[3])
{
    for (size_t i = 0; i < n; i++) memcpy(x[i], (double[3]){(double)i, 0.0, 0.0}, sizeof *x);
    return n;
}

static void measure(const char *body, size_t n, const double (*x)[3], double period,
                    const fracas_kind *covariance, double length)
{
    enum { REALIZATIONS = 10 };
    fracas_strength strength = {.distribution = fracas_strength_section.kinds[0],
                                .scale = 300e6,
                                .shape = 10,
                                .covariance = covariance,
                                .correlation_length = length,
                                .smoothness = NAN};
    fracas_extent *extent = calloc(n, sizeof *extent);
    double *sigma_c = malloc(n * sizeof *sigma_c);
    fracas_field *field;
    const double start = seconds_of(CLOCK_PROCESS_CPUTIME_ID);
    const fracas_sites sites = {
        .n = n, .points = 1, .extent = extent, .position = x, .period = period};
    if (!extent || !sigma_c || fracas_field_create(&strength, &sites, &field)) exit(1);
    const double made = seconds_of(CLOCK_PROCESS_CPUTIME_ID);
    for (uint64_t r = 0; r < REALIZATIONS; r++)
        if (fracas_field_sample(field, &(fracas_stream){.seed = 1, .replica = r}, 1, sigma_c))
            exit(1);
    printf("%-7s %7zu  %-11s %4g  %7.2f s  %7.2f ms  %.1e\n", body, n, covariance->name, length,
           made - start, (seconds_of(CLOCK_PROCESS_CPUTIME_ID) - made) / REALIZATIONS * 1e3,
           fracas_field_error(field));
    fflush(stdout);
    fracas_field_destroy(field);
    free(sigma_c);
    free(extent);
}

int main(int argc, char **argv)
{
    double lengths[] = {2, 5, 20};
    const fracas_kind *const kinds[] = {&fracas_covariance_exponential, &fracas_covariance_matern,
                                        &fracas_covariance_gaussian};
    const bool one = argc > 2;
    if (one) lengths[0] = strtod(argv[2], NULL);
    const size_t n = argc > 1 ? strtoul(argv[1], NULL, 10) : 10000;
    double(*x)[3] = malloc((n > 100000 ? n : 100000) * sizeof *x);
    if (!x) return 1;
    printf("body      sites  covariance   l/h       make  realization  error\n");
    for (int k = 0; k < (one ? 3 : 2); k++)
        for (int l = 0; l < (one ? 1 : 3); l++) {
            const size_t plate = make_plate(n, x);
            measure("plate", plate, (const double(*)[3])x, 0.0, kinds[k], lengths[l]);
            const size_t octant = make_octant(n, x);
            measure("octant", octant, (const double(*)[3])x, 0.0, kinds[k], lengths[l]);
        }
    for (int k = 0; k < 2 && argc == 1; k++) {
        make_line(100000, x);
        measure("line", 100000, (const double(*)[3])x, 0.0, kinds[k], 20.0);
        measure("circle", 99999, (const double(*)[3])x, 99999.0, kinds[k], 20.0);
    }
    free(x);
    return 0;
}
