/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Vecchia's approximation in an order from coarse to fine: F. Schaefer, M. Katzfuss, H. Owhadi,
 * SIAM J. Sci. Comput. 43, A2019-A2046 (2021). In this order the value at a site is its mean given
 * those at the nearest sites before it, plus an independent rest; the coarsest sites are drawn
 * together. All members are in this order, by place. */
#include "sampler/field/sparse_factor.h"

#include "sampler/field/dense_factor.h"
#include "sampler/field/order.h"
#include "sampler/field/variance.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SMALLEST 1e-7 /* least variance of a near site given nearer ones: less is but rounding */
enum { STARTS = 32, STEPS = 4, M = FRACAS_NEAR_SITES };

struct fracas_sparse_factor {
    fracas_unscaled_factor field;
    uint32_t *order; /* [n] sites */
    double *norm;    /* [n] standard deviation of the unscaled field */
    double error;
};

/* Cholesky factor of the correlations of the near sites kept, with the site itself below them. */
typedef struct {
    size_t kept;
    double row[M + 1][M];
    size_t of[M]; /* which of the near sites */
} local_factor;

/* The row of L of the site at x, given the rows before; returns the variance left. */
static double next_row(const fracas_covariance *covariance, const double (*near)[3],
                       const double x[3], local_factor *l)
{
    double *row = l->row[l->kept], left = 1.0;
    for (size_t q = 0; q < l->kept; q++) {
        const double c = fracas_covariance_at(covariance, fracas_distance(near[l->of[q]], x));
        row[q] = (c - fracas_dot(q, row, l->row[q])) / l->row[q][q];
        left -= row[q] * row[q];
    }
    return left;
}

/* (fields.13) weight[a] of the near sites, and the standard deviation of the rest. */
static double condition(const fracas_covariance *covariance, const double (*near)[3],
                        const double x[3], double weight[M])
{
    local_factor l = {.kept = 0};
    for (size_t a = 0; a < M; a++) {
        const double left = next_row(covariance, near, near[a], &l);
        if (left < SMALLEST) continue;
        l.row[l.kept][l.kept] = sqrt(left);
        l.of[l.kept++] = a;
    }
    const double left = next_row(covariance, near, x, &l);
    double *y = l.row[l.kept];
    for (size_t a = 0; a < M; a++) weight[a] = 0.0;
    for (size_t q = l.kept; q-- > 0;) {
        y[q] /= l.row[q][q];
        weight[l.of[q]] = y[q];
        for (size_t r = 0; r < q; r++) y[r] -= y[q] * l.row[q][r];
    }
    return sqrt(fmax(0.0, left));
}

/* The dense factor has put the coarsest sites into another order. */
static fracas_err factorise_coarse(fracas_sparse_factor *factor,
                                   const fracas_covariance *covariance, const double (*position)[3])
{
    fracas_unscaled_factor *field = &factor->field;
    OWNED uint32_t *before = malloc((field->coarse + 1) * sizeof *before);
    OWNED uint32_t *place = malloc((field->n + 1) * sizeof *place);
    if (!before || !place) return fracas_no_memory("a correlated field");
    memcpy(before, factor->order, field->coarse * sizeof *before);
    TRY(fracas_dense_factor_init(covariance, position, field->coarse, factor->order,
                                 &field->dense));
    for (size_t k = 0; k < field->coarse; k++) place[factor->order[k]] = (uint32_t)k;
    for (size_t k = 0; k < (field->n - field->coarse) * M; k++)
        if (field->near[k] < field->coarse) field->near[k] = place[before[field->near[k]]];
    return FRACAS_OK;
}

static void factorise_fine(fracas_sparse_factor *factor, const fracas_covariance *covariance,
                           const double (*position)[3])
{
    const fracas_unscaled_factor *field = &factor->field;
    for (size_t k = field->coarse; k < field->n; k++) {
        const size_t fine = k - field->coarse;
        double near[M][3];
        for (size_t a = 0; a < M; a++)
            memcpy(near[a], position[factor->order[field->near[fine * M + a]]], sizeof near[a]);
        field->rest[fine] = condition(covariance, (const double(*)[3])near,
                                      position[factor->order[k]], &field->weight[fine * M]);
    }
}

/* The largest error of the pairs of a site with all, and the other site of the pair. */
static fracas_err probe(fracas_sparse_factor *factor, const fracas_covariance *covariance,
                        const double (*position)[3], size_t site, double *correlation,
                        size_t *worst)
{
    double largest = 0.0;
    *worst = site;
    TRY(fracas_sparse_factor_correlation(factor, site, correlation));
    for (size_t i = 0; i < factor->field.n; i++) {
        const double wrong = fabs(
            correlation[i] -
            fracas_covariance_at(covariance, fracas_distance(position[site], position[i])));
        if (wrong <= largest) continue;
        largest = wrong;
        *worst = i;
    }
    factor->error = fmax(factor->error, largest);
    return FRACAS_OK;
}

/* All of a few sites are looked at; among many some, from the coarsest to the finest: from each the
 * search goes on to its worst partner. */
static fracas_err measure_error(fracas_sparse_factor *factor, const fracas_covariance *covariance,
                                const double (*position)[3])
{
    const size_t n = factor->field.n;
    OWNED double *correlation = malloc((n + 1) * sizeof *correlation);
    if (!correlation) return fracas_no_memory("a correlated field");
    for (size_t k = 0, starts = n <= FRACAS_DENSE_SITES ? n : STARTS; k < starts; k++) {
        size_t site = factor->order[(k + 1) * n / starts - 1];
        for (size_t step = 0; step < (starts < n ? STEPS : 1); step++)
            TRY(probe(factor, covariance, position, site, correlation, &site));
    }
    return FRACAS_OK;
}

static fracas_err fill(fracas_sparse_factor *factor, const fracas_covariance *covariance,
                       const double (*position)[3])
{
    fracas_unscaled_factor *field = &factor->field;
    TRY(fracas_order_sites(field->n, position, field->coarse, M, factor->order, field->near));
    TRY(factorise_coarse(factor, covariance, position));
    factorise_fine(factor, covariance, position);
    TRY(fracas_unscaled_variances(field, factor->order, position, factor->norm));
    for (size_t k = 0; k < field->n; k++) factor->norm[k] = sqrt(factor->norm[k]);
    return measure_error(factor, covariance, position);
}

fracas_err fracas_sparse_factor_create(const fracas_covariance *covariance, size_t n,
                                       const double (*position)[3], fracas_sparse_factor **factor)
{
    const size_t coarse = n < FRACAS_DENSE_SITES ? n : FRACAS_DENSE_SITES, fine = n - coarse;
    fracas_sparse_factor *made = calloc(1, sizeof *made);
    if (!made) return fracas_no_memory("a correlated field");
    made->field = (fracas_unscaled_factor){
        .n = n,
        .coarse = coarse,
        .near = malloc((fine * M + 1) * sizeof *made->field.near),
        .weight = malloc((fine * M + 1) * sizeof *made->field.weight),
        .rest = malloc((fine + 1) * sizeof *made->field.rest)};
    made->order = malloc((n + 1) * sizeof *made->order);
    made->norm = malloc((n + 1) * sizeof *made->norm);
    const fracas_unscaled_factor *field = &made->field;
    const bool ready = field->near && field->weight && field->rest && made->order && made->norm;
    fracas_err err = ready ? fill(made, covariance, position)
                           : fracas_no_memory("a correlated field");
    if (err) fracas_sparse_factor_destroy(made);
    else *factor = made;
    return err;
}

void fracas_sparse_factor_destroy(fracas_sparse_factor *factor)
{
    if (!factor) return;
    fracas_dense_factor_clear(&factor->field.dense);
    free(factor->field.near);
    free(factor->field.weight);
    free(factor->field.rest);
    free(factor->order);
    free(factor->norm);
    free(factor);
}

double fracas_sparse_factor_error(const fracas_sparse_factor *factor)
{
    return factor->error;
}

/* (fields.14) value[k], of all places, by those of the coarse sites, and rest[k] at the others. */
static void draw_fine(const fracas_unscaled_factor *field, const double *rest, double *value)
{
    for (size_t k = field->coarse; k < field->n; k++) {
        const double *weight = &field->weight[(k - field->coarse) * M];
        const uint32_t *near = &field->near[(k - field->coarse) * M];
        double sum[2] = {0};
        for (size_t a = 0; a < M; a += 2) {
            sum[0] += weight[a] * value[near[a]];
            sum[1] += weight[a + 1] * value[near[a + 1]];
        }
        value[k] = (sum[0] + sum[1]) + field->rest[k - field->coarse] * rest[k];
    }
}

fracas_err fracas_sparse_factor_apply(const fracas_sparse_factor *factor, const double *w,
                                      double *z)
{
    const fracas_unscaled_factor *field = &factor->field;
    const fracas_dense_factor *dense = &field->dense;
    OWNED double *normal = malloc((field->n + 1) * sizeof *normal);
    OWNED double *value = malloc((field->n + 1) * sizeof *value);
    if (!normal || !value) return fracas_no_memory("a correlated field");
    for (size_t k = 0; k < field->n; k++) normal[k] = w[factor->order[k]];
    for (size_t k = 0; k < field->coarse; k++)
        value[k] = fracas_dot(k < dense->rank ? k + 1 : dense->rank, &dense->row[k * dense->rank],
                              normal);
    draw_fine(field, normal, value);
    for (size_t k = 0; k < field->n; k++) z[factor->order[k]] = value[k] / factor->norm[k];
    return FRACAS_OK;
}

/* (fields.15) A^T e of a site, by place, from the finest to the coarsest. x, row: room for n. */
static void find_row(const fracas_sparse_factor *factor, size_t site, double *x, double *row)
{
    const fracas_unscaled_factor *field = &factor->field;
    const fracas_dense_factor *dense = &field->dense;
    for (size_t k = 0; k < field->n; k++) {
        x[k] = factor->order[k] == site ? 1.0 / factor->norm[k] : 0.0;
        row[k] = 0.0;
    }
    for (size_t k = field->n; k-- > field->coarse;) {
        const size_t fine = k - field->coarse;
        row[k] = field->rest[fine] * x[k];
        for (size_t a = 0; a < M; a++)
            x[field->near[fine * M + a]] += field->weight[fine * M + a] * x[k];
    }
    for (size_t k = 0; k < field->coarse; k++)
        for (size_t q = 0; q <= k && q < dense->rank; q++)
            row[q] += dense->row[k * dense->rank + q] * x[k];
}

fracas_err fracas_sparse_factor_correlation(const fracas_sparse_factor *factor, size_t site,
                                            double *correlation)
{
    const size_t n = factor->field.n;
    OWNED double *row = malloc((n + 1) * sizeof *row);
    OWNED double *w = malloc((n + 1) * sizeof *w);
    if (!row || !w) return fracas_no_memory("a correlated field");
    find_row(factor, site, w, row);
    for (size_t k = 0; k < n; k++) w[factor->order[k]] = row[k];
    return fracas_sparse_factor_apply(factor, w, correlation);
}
