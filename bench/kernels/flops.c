/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/kernels/flops.h"

#include "bench/kernels/cases.h"

/* bar, ring, stershic, linear, quadratic, shell */
const fracas_bench_flops fracas_bench_flops_of[FRACAS_BENCH_MODELS][2] = {
    {{28.0, 17.8, 1.0, 0.0}, {27.5, 17.1, 1.1, 0.0}},
    {{62.5, 67.4, 3.1, 2.0}, {61.4, 66.4, 3.1, 2.0}},
    {{58.4, 76.3, 8.1, 4.0}, {62.4, 76.4, 8.1, 4.0}},
    {{145.4, 156.9, 0.0, 0.0}, {181.4, 210.7, 5.9, 1.3}},
    {{429.6, 434.7, 0.0, 0.0}, {482.1, 513.0, 7.8, 2.1}},
    {{1685.4, 1668.3, 4.2, 0.0}, {1985.3, 1999.8, 26.7, 6.3}}};
