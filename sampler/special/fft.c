/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Powers of two by Cooley's and Tukey's algorithm, radix 2; other lengths as a convolution
 * (Bluestein, IEEE Trans. Audio Electroacoustics 18, 451-455, 1970). */
#include "sampler/special/fft.h"

#include "base/elementary.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>

struct fracas_fft {
    size_t n;
    size_t size;         /* n if it is a power of two; else the length of the convolution */
    double (*turn)[2];   /* [size/2] e^(-2 pi i k/size) */
    double (*chirp)[2];  /* [n] e^(-pi i k^2/n); NULL where n is a power of two */
    double (*filter)[2]; /* [size] transform of the chirp's conjugate, by size */
};

size_t fracas_fft_power_of_two(size_t n)
{
    size_t size = 1;
    while (size < n) size *= 2;
    return size;
}

static inline void multiply(double x[2], const double by[2])
{
    const double real = x[0] * by[0] - x[1] * by[1];
    x[1] = x[0] * by[1] + x[1] * by[0];
    x[0] = real;
}

static void exchange(double (*x)[2], size_t i, size_t j)
{
    const double real = x[i][0], imaginary = x[i][1];
    x[i][0] = x[j][0];
    x[i][1] = x[j][1];
    x[j][0] = real;
    x[j][1] = imaginary;
}

/* (fields.6) */
static void power_of_two(const fracas_fft *fft, double (*x)[2])
{
    const size_t n = fft->size;
    for (size_t i = 1, reversed = 0; i < n; i++) {
        size_t bit = n / 2;
        for (; reversed & bit; bit /= 2) reversed ^= bit;
        reversed ^= bit;
        if (i < reversed) exchange(x, i, reversed);
    }
    for (size_t half = 1; half < n; half *= 2)
        for (size_t from = 0; from < n; from += 2 * half)
            for (size_t k = 0; k < half; k++) {
                double *even = x[from + k], *odd = x[from + k + half];
                multiply(odd, fft->turn[k * (n / (2 * half))]);
                const double real = odd[0], imaginary = odd[1];
                odd[0] = even[0] - real;
                odd[1] = even[1] - imaginary;
                even[0] += real;
                even[1] += imaginary;
            }
}

/* (fields.7) j k = (j^2 + k^2 - (j - k)^2)/2; the inverse transform of the product is a transform
 * of its conjugate. */
static void convolve(const fracas_fft *fft, double (*x)[2], double (*y)[2])
{
    for (size_t k = 0; k < fft->n; k++) {
        y[k][0] = x[k][0];
        y[k][1] = x[k][1];
        multiply(y[k], fft->chirp[k]);
    }
    power_of_two(fft, y);
    for (size_t k = 0; k < fft->size; k++) {
        multiply(y[k], fft->filter[k]);
        y[k][1] = -y[k][1];
    }
    power_of_two(fft, y);
    for (size_t k = 0; k < fft->n; k++) {
        x[k][0] = y[k][0];
        x[k][1] = -y[k][1];
        multiply(x[k], fft->chirp[k]);
    }
}

fracas_err fracas_fft_transform(const fracas_fft *fft, double (*x)[2])
{
    if (!fft->chirp) {
        power_of_two(fft, x);
        return FRACAS_OK;
    }
    double(*y)[2] = calloc(fft->size, sizeof *y);
    if (!y) return fracas_no_memory("a Fourier transform");
    convolve(fft, x, y);
    free(y);
    return FRACAS_OK;
}

/* k^2 modulo 2n is exact: the chirp has no rounded large angle. */
static void make_chirp(fracas_fft *fft)
{
    const uint64_t n = fft->n;
    for (uint64_t k = 0; k < n; k++) {
        const double angle = (double)(k * k % (2 * n)) / (double)n;
        fft->chirp[k][0] = fracas_cospi(angle);
        fft->chirp[k][1] = -fracas_sinpi(angle);
        for (int side = 0; side < (k > 0 ? 2 : 1); side++) {
            double *at = fft->filter[side == 0 ? k : fft->size - k];
            at[0] = fft->chirp[k][0] / (double)fft->size;
            at[1] = -fft->chirp[k][1] / (double)fft->size;
        }
    }
    power_of_two(fft, fft->filter);
}

fracas_err fracas_fft_create(size_t n, fracas_fft **fft)
{
    const bool whole = fracas_fft_power_of_two(n) == n;
    const size_t size = fracas_fft_power_of_two(whole ? n : 2 * n - 1);
    fracas_fft *made = calloc(1, sizeof *made);
    if (!made) return fracas_no_memory("a Fourier transform");
    *made = (fracas_fft){.n = n, .size = size, .turn = malloc((size / 2 + 1) * sizeof *made->turn)};
    if (!whole) {
        made->chirp = malloc(n * sizeof *made->chirp);
        made->filter = calloc(size, sizeof *made->filter);
    }
    if (!made->turn || (!whole && (!made->chirp || !made->filter))) {
        fracas_fft_destroy(made);
        return fracas_no_memory("a Fourier transform");
    }
    for (size_t k = 0; k < size / 2; k++) {
        const double angle = 2.0 * (double)k / (double)size;
        made->turn[k][0] = fracas_cospi(angle);
        made->turn[k][1] = -fracas_sinpi(angle);
    }
    if (!whole) make_chirp(made);
    *fft = made;
    return FRACAS_OK;
}

void fracas_fft_destroy(fracas_fft *fft)
{
    if (!fft) return;
    free(fft->turn);
    free(fft->chirp);
    free(fft->filter);
    free(fft);
}
