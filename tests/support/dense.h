/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Vectors and small dense matrices. */
#ifndef FRACAS_TESTS_SUPPORT_DENSE_H
#define FRACAS_TESTS_SUPPORT_DENSE_H

#include "tests/support/test.h"

#include <gsl/gsl_eigen.h>

/* n zeros; the caller frees. */
static inline double *vector_of(size_t n)
{
    double *v = zeroed(n, sizeof *v);
    return v;
}

static inline double dot_of(const double *a, const double *b, size_t n)
{
    double sum = 0;
    for (size_t i = 0; i < n; i++) sum += a[i] * b[i];
    return sum;
}

static inline double largest_of(const double *v, size_t n)
{
    double largest = 0;
    for (size_t i = 0; i < n; i++) largest = fmax(largest, fabs(v[i]));
    return largest;
}

/* Eigenvalues of a symmetric matrix, ascending. */
static inline double *eigenvalues_of(const double *matrix, size_t n)
{
    gsl_matrix *copy = gsl_matrix_alloc(n, n);
    gsl_vector *values = gsl_vector_alloc(n);
    gsl_eigen_symm_workspace *work = gsl_eigen_symm_alloc(n);
    assert_true(copy && values && work);
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++)
            gsl_matrix_set(copy, i, j, 0.5 * (matrix[i * n + j] + matrix[j * n + i]));
    gsl_eigen_symm(copy, values, work);
    double *sorted = vector_of(n);
    for (size_t i = 0; i < n; i++) {
        size_t at = i;
        const double value = gsl_vector_get(values, i);
        for (; at > 0 && sorted[at - 1] > value; at--) sorted[at] = sorted[at - 1];
        sorted[at] = value;
    }
    gsl_eigen_symm_free(work);
    gsl_vector_free(values);
    gsl_matrix_free(copy);
    return sorted;
}

#endif
