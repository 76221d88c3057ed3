/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Operations of an element-step: sums and differences, products, quotients, roots, as the unit of
 * one lane without AVX executes them, ledger included. tests/verification/test_flops.c takes a step
 * of meshes of 200 elements one instruction at a time, and counts. Larger meshes have fewer
 * borders: those of 2500 elements have 5 % more interfaces an element. */
#ifndef FRACAS_BENCH_KERNELS_FLOPS_H
#define FRACAS_BENCH_KERNELS_FLOPS_H

typedef struct {
    double sums, products, quotients, roots;
} fracas_bench_flops;

/* [model][cracked], in the order of fracas_bench_model. */
extern const fracas_bench_flops fracas_bench_flops_of[][2];

#endif
