/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Speed of strength fields: values a second, in blocks of 2500 interfaces, one replica after the
 * other.
 *
 *   bench_sampler [--distribution NAME] [--stride N] [--isa baseline|avx2|avx512|best] [--seconds
 * S]
 *
 * The median of five measurements, by the clock and by the time of the CPU (the two agree on a
 * quiet machine). */
#include "bench/bench.h"

#include "sampler/api/sampler.h"

#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { INTERFACES = 2500, MOST_STRIDE = 8 };

static fracas_strength strength_of(const char *name)
{
    fracas_strength strength = {.value = 300e6,
                                .minimum = 264e6,
                                .maximum = 364e6,
                                .scale = 50e6,
                                .shape = 2,
                                .median = 300e6,
                                .sigma = 0.1};
    /* elsewhere the moments replace a distribution's own numbers */
    if (strcmp(name, "normal") == 0) strength.mean = 10 * (strength.deviation = 30e6);
    else memcpy(strength.own, (double[]){1e9, 3}, 2 * sizeof *strength.own);
    for (size_t i = 0; i < fracas_strength_section.nkinds; i++)
        if (strcmp(fracas_strength_section.kinds[i]->name, name) == 0)
            strength.distribution = fracas_strength_section.kinds[i];
    if (strength.distribution && !fracas_strength_is_given(&strength)) return strength;
    fprintf(stderr, "bench_sampler: no distribution %s that is drawn\n", name);
    exit(2);
}

static void measure(const fracas_field *field, size_t stride, double seconds, double *by_clock,
                    double *by_cpu)
{
    static double sigma_c[INTERFACES * MOST_STRIDE];
    fracas_stream stream = {1, FRACAS_PURPOSE_STRENGTH, {2, 3}, 0};
    const double start = seconds_of(CLOCK_MONOTONIC), cpu = seconds_of(CLOCK_PROCESS_CPUTIME_ID);
    double spent;
    do {
        for (int i = 0; i < 16; i++, stream.replica++)
            demand(fracas_field_sample(field, &stream, stride, sigma_c + stream.replica % stride));
    } while ((spent = seconds_of(CLOCK_MONOTONIC) - start) < seconds);
    *by_clock = (double)(stream.replica * INTERFACES) / spent;
    *by_cpu = (double)(stream.replica * INTERFACES) / (seconds_of(CLOCK_PROCESS_CPUTIME_ID) - cpu);
}

int main(int argc, char **argv)
{
    static const struct option known[] = {{"distribution", required_argument, NULL, 'd'},
                                          {"stride", required_argument, NULL, 'l'},
                                          {"isa", required_argument, NULL, 'i'},
                                          {"seconds", required_argument, NULL, 's'},
                                          {0}};
    const char *name = "weibull", *isa_name = "best";
    double seconds = 2.5;
    size_t stride = 1;
    for (int o; (o = getopt_long(argc, argv, "", known, NULL)) != -1;) {
        if (o == 'd') name = optarg;
        else if (o == 'l') stride = (size_t)atoi(optarg);
        else if (o == 'i') isa_name = optarg;
        else if (o == 's') seconds = atof(optarg);
        else return 2;
    }
    fracas_isa isa = 0;
    while (isa < FRACAS_NISAS && strcmp(isa_name, fracas_isa_name[isa]) != 0) isa++;
    if (isa == FRACAS_ISA_BEST && strcmp(isa_name, "best") != 0) return 2;
    if (stride < 1 || stride > MOST_STRIDE) return 2;
    const fracas_strength strength = strength_of(name);
    static fracas_extent extent[INTERFACES];
    static double position[INTERFACES][3];
    for (size_t i = 0; i < INTERFACES; i++) extent[i] = (fracas_extent){1e-9, 1e-6};
    const fracas_sites sites = {
        .n = INTERFACES, .points = 1, .extent = extent, .position = (const double(*)[3])position};
    fracas_field *field;
    demand(fracas_field_create(&strength, &sites, &field));
    demand(fracas_field_use(field, isa));
    double by_clock[5], by_cpu[5];
    for (int i = 0; i < 5; i++) measure(field, stride, seconds / 5, &by_clock[i], &by_cpu[i]);
    qsort(by_clock, 5, sizeof *by_clock, by_value);
    qsort(by_cpu, 5, sizeof *by_cpu, by_value);
    printf("%-10s stride %zu %-8s %.3g values/s, %.3g by the time of the CPU\n", name, stride,
           isa_name, by_clock[2], by_cpu[2]);
    fracas_field_destroy(field);
}
