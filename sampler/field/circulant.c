/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Circulant embedding: C. R. Dietrich, G. N. Newsam, SIAM J. Sci. Comput. 18, 1088-1107 (1997); A.
 * T. A. Wood, G. Chan, J. Comput. Graph. Stat. 3, 409-432 (1994). */
#include "sampler/field/circulant.h"

#include "base/elementary.h"
#include "sampler/special/fft.h"

#include <math.h>

#define NEGATIVE 1e-12 /* largest variance lost to clipped eigenvalues; above, a larger circle */
enum { LARGEST = 1 << 17 }; /* circle for few sites; for many, 4 times the smallest possible */

struct fracas_circulant {
    size_t n;    /* sites */
    size_t size; /* sites of the circle */
    fracas_fft *fft;
    double *root; /* [size] of the eigenvalues, by size */
    double error;
};

void fracas_circulant_destroy(fracas_circulant *circulant)
{
    if (!circulant) return;
    fracas_fft_destroy(circulant->fft);
    free(circulant->root);
    free(circulant);
}

/* (fields.9) row[i], a row of the covariance; *lost: variance of the eigenvalues below 0, which
 * become 0. */
static fracas_err factorise(fracas_circulant *circulant, const double *row, double *lost)
{
    const size_t size = circulant->size;
    double sum = 0.0;
    OWNED double(*x)[2] = malloc(size * sizeof *x);
    if (!x) return fracas_no_memory("a correlated field");
    for (size_t i = 0; i < size; i++) {
        x[i][0] = row[i];
        x[i][1] = 0.0;
    }
    TRY(fracas_fft_transform(circulant->fft, x));
    *lost = 0.0;
    for (size_t k = 0; k < size; k++) {
        *lost += fmax(0.0, -x[k][0]) / (double)size;
        sum += fmax(0.0, x[k][0]);
    }
    for (size_t k = 0; k < size; k++) {
        x[k][0] = fmax(0.0, x[k][0]) / sum; /* they sum to 1, the variance */
        x[k][1] = 0.0;
        circulant->root[k] = sqrt(x[k][0] / (double)size);
    }
    TRY(fracas_fft_transform(circulant->fft, x)); /* even eigenvalues: the inverse is the same */
    circulant->error = 0.0;
    for (size_t i = 0; i < circulant->n; i++)
        circulant->error = fmax(circulant->error, fabs(x[i][0] - row[i]));
    return FRACAS_OK;
}

static fracas_err from_row(const double *row, size_t n, size_t size, fracas_circulant **circulant,
                           double *lost)
{
    OWN(fracas_circulant) made = calloc(1, sizeof *made);
    if (!made) return fracas_no_memory("a correlated field");
    *made = (fracas_circulant){.n = n, .size = size, .root = malloc(size * sizeof *made->root)};
    if (!made->root) return fracas_no_memory("a correlated field");
    TRY(fracas_fft_create(size, &made->fft));
    TRY(factorise(made, row, lost));
    *circulant = made;
    made = NULL;
    return FRACAS_OK;
}

/* (fields.8) */
fracas_err fracas_circulant_circle(const fracas_covariance *covariance, size_t n, double radius,
                                   fracas_circulant **circulant)
{
    double lost;
    OWNED double *row = malloc(n * sizeof *row);
    if (!row) return fracas_no_memory("a correlated field");
    for (size_t i = 0; i < n; i++)
        row[i] = fracas_covariance_at(
            covariance, 2.0 * radius * fracas_sinpi((double)(i < n - i ? i : n - i) / (double)n));
    return from_row(row, n, n, circulant, &lost);
}

/* The line on a circle of `size` sites. */
static fracas_err embed(const fracas_covariance *covariance, size_t n, double spacing, size_t size,
                        fracas_circulant **circulant, double *lost)
{
    OWNED double *row = malloc(size * sizeof *row);
    if (!row) return fracas_no_memory("a correlated field");
    for (size_t i = 0; i < size; i++)
        row[i] = fracas_covariance_at(covariance, spacing * (double)(i < size - i ? i : size - i));
    return from_row(row, n, size, circulant, lost);
}

/* (fields.10) */
fracas_err fracas_circulant_line(const fracas_covariance *covariance, size_t n, double spacing,
                                 fracas_circulant **circulant)
{
    const size_t smallest = fracas_fft_power_of_two(2 * (n - 1));
    const size_t largest = 4 * smallest > LARGEST ? 4 * smallest : LARGEST;
    double lost = INFINITY;
    for (size_t size = smallest; size <= largest; size *= 2) {
        fracas_circulant *made;
        TRY(embed(covariance, n, spacing, size, &made, &lost));
        if (lost <= NEGATIVE || size == largest) {
            *circulant = made;
            break;
        }
        fracas_circulant_destroy(made);
    }
    return FRACAS_OK;
}

size_t fracas_circulant_normals(const fracas_circulant *circulant)
{
    return circulant->size;
}

double fracas_circulant_error(const fracas_circulant *circulant)
{
    return circulant->error;
}

/* (fields.11) */
fracas_err fracas_circulant_apply(const fracas_circulant *circulant, const double *w, double *z)
{
    OWNED double(*x)[2] = malloc(circulant->size * sizeof *x);
    if (!x) return fracas_no_memory("a correlated field");
    for (size_t i = 0; i < circulant->size; i++) {
        x[i][0] = w[i];
        x[i][1] = 0.0;
    }
    TRY(fracas_fft_transform(circulant->fft, x));
    for (size_t k = 0; k < circulant->size; k++) {
        const double real = x[k][0];
        x[k][0] = circulant->root[k] * x[k][1]; /* exchanged: the next transform is the inverse */
        x[k][1] = circulant->root[k] * real;
    }
    TRY(fracas_fft_transform(circulant->fft, x));
    for (size_t i = 0; i < circulant->n; i++) z[i] = x[i][1];
    return FRACAS_OK;
}
