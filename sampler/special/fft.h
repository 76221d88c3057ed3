/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Discrete Fourier transforms of any length, same bits on every CPU. */
#ifndef FRACAS_SAMPLER_FFT_H
#define FRACAS_SAMPLER_FFT_H

#include "base/own.h"
#include "base/err.h"

#include <stddef.h>

typedef struct fracas_fft fracas_fft;

/* The transform of n numbers, 1 <= n <= 2^30. FRACAS_ENVIRONMENT without memory. */
FRACAS_MUST_USE fracas_err fracas_fft_create(size_t n, fracas_fft **fft);
void fracas_fft_destroy(fracas_fft *fft); /* NULL is allowed */
FRACAS_OWNER(fracas_fft, fracas_fft_destroy)

/* x[j] <- sum_k x[k] e^(-2 pi i j k/n), x[k] = {real, imaginary part}; to some 1e-16 log2(n) of the
 * norm of x. The inverse is the transform with the parts exchanged before and after, by n.
 * FRACAS_ENVIRONMENT without memory. */
FRACAS_MUST_USE fracas_err fracas_fft_transform(const fracas_fft *fft, double (*x)[2]);

/* The smallest power of two >= n. */
size_t fracas_fft_power_of_two(size_t n);

#endif
