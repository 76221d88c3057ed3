/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "sampler/field/dense_factor.h"

#include <stdlib.h>
#include <string.h>

#define SMALLEST 1e-13 /* largest variance left of a site given those before it */

double fracas_dot(size_t n, const double *a, const double *b)
{
    double sum[4] = {0};
    size_t i = 0;
    for (; i + 4 <= n; i += 4)
        for (int k = 0; k < 4; k++) sum[k] += a[i + k] * b[i + k];
    for (; i < n; i++) sum[0] += a[i] * b[i];
    return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

/* The variance left at each site is largest at the next pivot. */
typedef struct {
    const fracas_covariance *covariance;
    const double (*position)[3];
    uint32_t *order;
    double *left; /* [n] */
    fracas_dense_factor *factor;
} elimination;

static void swap_sites(elimination *e, size_t i, size_t j)
{
    const size_t n = e->factor->n;
    if (i == j) return;
    const uint32_t site = e->order[i];
    e->order[i] = e->order[j];
    e->order[j] = site;
    const double left = e->left[i];
    e->left[i] = e->left[j];
    e->left[j] = left;
    for (size_t k = 0; k < i; k++) { /* later columns are not there yet */
        const double entry = e->factor->row[i * n + k];
        e->factor->row[i * n + k] = e->factor->row[j * n + k];
        e->factor->row[j * n + k] = entry;
    }
}

/* (fields.12) */
static void eliminate(elimination *e)
{
    fracas_dense_factor *factor = e->factor;
    const size_t n = factor->n;
    for (size_t i = 0; i < n; i++) e->left[i] = 1.0;
    for (size_t k = 0; k < n; k++) {
        size_t pivot = k;
        for (size_t i = k + 1; i < n; i++)
            if (e->left[i] > e->left[pivot]) pivot = i;
        if (e->left[pivot] <= SMALLEST) return;
        swap_sites(e, k, pivot);
        const double diagonal = sqrt(e->left[k]);
        factor->row[k * n + k] = diagonal;
        for (size_t i = k + 1; i < n; i++) {
            double *row = &factor->row[i * n];
            const double d = fracas_distance(e->position[e->order[i]], e->position[e->order[k]]);
            row[k] = (fracas_covariance_at(e->covariance, d) -
                      fracas_dot(k, row, &factor->row[k * n])) /
                     diagonal;
            e->left[i] -= row[k] * row[k];
        }
        factor->rank = k + 1;
    }
}

fracas_err fracas_dense_factor_init(const fracas_covariance *covariance,
                                    const double (*position)[3], size_t n, uint32_t *order,
                                    fracas_dense_factor *factor)
{
    OWNED double *left = malloc((n + 1) * sizeof *left);
    *factor = (fracas_dense_factor){.n = n, .row = calloc(n * n + 1, sizeof *factor->row)};
    if (!left || !factor->row) return fracas_no_memory("a correlated field");
    eliminate(&(elimination){covariance, position, order, left, factor});
    for (size_t i = 0; i < n; i++) { /* rows of n become rows of `rank`, of norm 1 */
        double *row = &factor->row[i * factor->rank];
        memmove(row, &factor->row[i * n], factor->rank * sizeof *row);
        const double norm = sqrt(fracas_dot(factor->rank, row, row));
        for (size_t k = 0; k < factor->rank; k++) row[k] /= norm;
    }
    return FRACAS_OK;
}

void fracas_dense_factor_clear(fracas_dense_factor *factor)
{
    free(factor->row);
    *factor = (fracas_dense_factor){0};
}

double fracas_dense_factor_product(const fracas_dense_factor *factor, size_t i, size_t j)
{
    const size_t shorter = (i < j ? i : j) + 1;
    return fracas_dot(shorter < factor->rank ? shorter : factor->rank,
                      &factor->row[i * factor->rank], &factor->row[j * factor->rank]);
}
