/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What this machine can do at most, measured with the registers of a kernel's unit. */
#ifndef FRACAS_BENCH_KERNELS_PEAKS_H
#define FRACAS_BENCH_KERNELS_PEAKS_H

#include "base/isa.h"

#include <stddef.h>
#include <stdint.h>

enum { FRACAS_PEAK_CHAINS = 12, FRACAS_PEAK_READS = 3 };
extern const size_t fracas_peak_bytes[FRACAS_PEAK_READS]; /* 512 KiB, 16 MiB, 128 MiB */

/* A unit. Loops of `rounds` rounds, with CHAINS independent chains of registers. */
typedef struct {
    double (*multiply_add)(int64_t rounds); /* a product and a sum a round, of every chain */
    double (*divide)(int64_t rounds);       /* a quotient */
    /* Reads `size` doubles, aligned to 64 bytes, a multiple of 64 of them. */
    double (*read)(const double *from, size_t size);
} fracas_peak_kernel;

typedef struct {
    double multiply_add, divide;    /* operations a second of processor time, all lanes */
    double load;                    /* bytes a second, of 16 KiB */
    double read[FRACAS_PEAK_READS]; /* of more */
} fracas_peaks;

/* Operations a second of the multiply-add loop over about `seconds` [s]. */
double fracas_peak_multiply_add(fracas_isa isa, int lanes, double seconds);

/* Bytes a second of reading `bytes` bytes again and again; the best of five. */
FRACAS_MUST_USE fracas_err fracas_peak_read(fracas_isa isa, int lanes, double bytes, double *rate);

/* All of them, the best of five; about a quarter of a second. */
FRACAS_MUST_USE fracas_err fracas_peaks_measure(fracas_isa isa, int lanes, fracas_peaks *peaks);

#endif
