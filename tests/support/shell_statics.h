/* SPDX-License-Identifier: GPL-3.0-or-later */
/* K of a shell as a sparse matrix, K u = f, and its lowest frequencies: by CHOLMOD. */
#ifndef FRACAS_TESTS_SUPPORT_SHELL_STATICS_H
#define FRACAS_TESTS_SUPPORT_SHELL_STATICS_H

#include "tests/support/shell.h"

#include <cholmod.h>

typedef struct {
    const fracas_model *model;
    size_t n, nfree;
    int *row;        /* of each unknown; -1: held */
    size_t *unknown; /* of each row */
    cholmod_common common;
    cholmod_sparse *matrix;
    cholmod_factor *factor;
    double asymmetry; /* largest |K_ij - K_ji| by the largest |K_ij| */
} shell_statics;

/* The elements that an element has edges with, and itself: [element][4], count. */
static inline void list_neighbours(const fracas_surface *surface, uint32_t (*next)[4],
                                   uint8_t *count)
{
    for (size_t e = 0; e < surface->nelements; e++) {
        next[e][0] = (uint32_t)e;
        count[e] = 1;
    }
    for (size_t i = 0; i < surface->ninterfaces; i++)
        for (int side = 0; side < 2; side++) {
            const uint32_t e = surface->interface[i].element[side];
            next[e][count[e]++] = surface->interface[i].element[1 - side];
        }
}

/* Elements of one colour have no neighbour in common, so that the forces of unit displacements of
 * all of them can be told apart: K couples an element to its neighbours alone. Returns the number
 * of colours. */
static inline int colour(const fracas_surface *surface, uint32_t (*next)[4], const uint8_t *count,
                         int *of)
{
    int colours = 0;
    for (size_t e = 0; e < surface->nelements; e++) of[e] = -1;
    for (size_t e = 0; e < surface->nelements; e++) {
        uint64_t taken = 0;
        for (int a = 0; a < count[e]; a++)
            for (int b = 0; b < count[next[e][a]]; b++) {
                const int there = of[next[next[e][a]][b]];
                if (there >= 0) taken |= UINT64_C(1) << there;
            }
        of[e] = __builtin_ctzll(~taken);
        colours = of[e] >= colours ? of[e] + 1 : colours;
    }
    return colours;
}

/* `pin`: an unknown that is held as well, against a rigid motion that no load drives; SIZE_MAX:
 * none. */
static inline void number_free(shell_statics *s, size_t pin)
{
    s->row = taken(s->n * sizeof *s->row);
    s->unknown = taken(s->n * sizeof *s->unknown);
    for (size_t i = 0; i < s->n; i++) {
        s->row[i] = i == pin || is_held(s->model, i) ? -1 : (int)s->nfree;
        if (s->row[i] >= 0) s->unknown[s->nfree++] = i;
    }
}

/* block[element][neighbour][i][j]: force i of the neighbour by displacement j of the element. */
static inline double *stiffness_blocks(shell_statics *s, uint32_t (*next)[4], const uint8_t *count)
{
    const size_t size = SHELL_UNKNOWNS, elements = s->model->elements;
    double *block = vector_of(elements * 4 * size * size);
    OWNED double *u = vector_of(s->n), *f = vector_of(s->n);
    OWNED int *of = taken(elements * sizeof *of);
    fracas_surface_operator *op = open_operator(s->model);
    const int colours = colour(s->model->surface, next, count, of);
    for (int c = 0; c < colours; c++)
        for (size_t j = 0; j < size; j++) {
            for (size_t e = 0; e < elements; e++)
                u[e * size + j] = of[e] == c && !is_held(s->model, e * size + j);
            apply_stiffness(s->model, op, u, f);
            for (size_t e = 0; e < elements; e++) {
                u[e * size + j] = 0;
                for (int a = 0; a < count[e] && of[e] == c; a++)
                    for (size_t i = 0; i < size; i++)
                        block[((4 * e + (size_t)a) * size + i) * size + j] =
                            f[next[e][a] * size + i];
            }
        }
    fracas_surface_operator_close(op);
    return block;
}

static inline double entry_of(const double *block, const uint32_t (*next)[4], size_t i, size_t j)
{
    const size_t size = SHELL_UNKNOWNS, e = j / size, to = i / size;
    for (size_t a = 0; a < 4; a++)
        if (next[e][a] == to) return block[((4 * e + a) * size + i % size) * size + j % size];
    return 0;
}

/* The upper triangle of (K + K^T)/2, free rows and columns. */
static inline void fill_matrix(shell_statics *s)
{
    const size_t elements = s->model->elements, size = SHELL_UNKNOWNS;
    uint32_t(*next)[4] = taken(elements * sizeof *next);
    OWNED uint8_t *count = taken(elements);
    list_neighbours(s->model->surface, next, count);
    double *block = stiffness_blocks(s, next, count), largest = 0, difference = 0;
    cholmod_triplet *t = cholmod_allocate_triplet(s->nfree, s->nfree, elements * 4 * size * size, 1,
                                                  CHOLMOD_REAL, &s->common);
    assert_non_null(t);
    for (size_t j = 0; j < s->n; j++)
        for (size_t a = 0; a < count[j / size] && s->row[j] >= 0; a++)
            for (size_t k = 0; k < size; k++) {
                const size_t i = next[j / size][a] * size + k;
                if (s->row[i] < 0 || s->row[i] > s->row[j]) continue;
                const double ij = entry_of(block, (const uint32_t(*)[4])next, i, j),
                             ji = entry_of(block, (const uint32_t(*)[4])next, j, i);
                largest = fmax(largest, fabs(ij));
                difference = fmax(difference, fabs(ij - ji));
                ((int *)t->i)[t->nnz] = s->row[i];
                ((int *)t->j)[t->nnz] = s->row[j];
                ((double *)t->x)[t->nnz++] = 0.5 * (ij + ji);
            }
    s->asymmetry = difference / largest;
    s->matrix = cholmod_triplet_to_sparse(t, t->nnz, &s->common);
    assert_non_null(s->matrix);
    cholmod_free_triplet(&t, &s->common);
    free(block);
    free(next);
}

static inline shell_statics *statics_open_pinned(const fracas_model *model, size_t pin)
{
    shell_statics *s = zeroed(1, sizeof *s);
    s->model = model;
    s->n = unknowns_of(model);
    cholmod_start(&s->common);
    number_free(s, pin);
    fill_matrix(s);
    s->factor = cholmod_analyze(s->matrix, &s->common);
    assert_non_null(s->factor);
    assert_true(cholmod_factorize(s->matrix, s->factor, &s->common));
    assert_int_equal(s->common.status, CHOLMOD_OK); /* positive */
    return s;
}

static inline shell_statics *statics_open(const fracas_model *model)
{
    return statics_open_pinned(model, SIZE_MAX);
}

static inline void statics_close(shell_statics *s)
{
    cholmod_free_factor(&s->factor, &s->common);
    cholmod_free_sparse(&s->matrix, &s->common);
    cholmod_finish(&s->common);
    free(s->row);
    free(s->unknown);
    free(s);
}

/* u = K^-1 f; 0 where nodes are held. */
static inline void statics_solve(shell_statics *s, const double *f, double *u)
{
    cholmod_dense *right = cholmod_allocate_dense(s->nfree, 1, s->nfree, CHOLMOD_REAL, &s->common);
    assert_non_null(right);
    for (size_t i = 0; i < s->nfree; i++) ((double *)right->x)[i] = f[s->unknown[i]];
    cholmod_dense *x = cholmod_solve(CHOLMOD_A, s->factor, right, &s->common);
    assert_non_null(x);
    for (size_t i = 0; i < s->n; i++) u[i] = s->row[i] < 0 ? 0 : ((double *)x->x)[s->row[i]];
    cholmod_free_dense(&right, &s->common);
    cholmod_free_dense(&x, &s->common);
}

static inline double mass_product(const fracas_model *model, const double *a, const double *b)
{
    const size_t n = unknowns_of(model);
    OWNED double *p = vector_of(n);
    multiply_mass(model, b, p);
    return dot_of(a, p, n);
}

/* The `count` lowest omega [rad/s] of K u = omega^2 M u: orthogonal iteration with K^-1 M, `more`
 * vectors, until those change by less than 1e-7. `mode` [more][unknowns] has the start, and the
 * modes of u.M u = 1 after. */
static inline void lowest_frequencies(shell_statics *s, int count, int more, double *mode,
                                      double *omega)
{
    double *f = vector_of(s->n), change = 1;
    for (int k = 0; k < more; k++) omega[k] = 0;
    for (int round = 0; round < 400 && change > 1e-7; round++) {
        change = 0;
        for (int k = 0; k < more; k++) {
            double *u = mode + (size_t)k * s->n;
            multiply_mass(s->model, u, f);
            statics_solve(s, f, u);
            for (int twice = 0; twice < 2; twice++)
                for (int l = 0; l < k; l++) {
                    const double *other = mode + (size_t)l * s->n,
                                 part = mass_product(s->model, u, other);
                    for (size_t i = 0; i < s->n; i++) u[i] -= part * other[i];
                }
            /* |K^-1 M u| comes to 1/omega^2 */
            const double length = sqrt(mass_product(s->model, u, u)), now = 1 / sqrt(length);
            if (k < count) change = fmax(change, fabs(now / omega[k] - 1));
            omega[k] = now;
            for (size_t i = 0; i < s->n; i++) u[i] /= length;
        }
    }
    assert_true(change <= 1e-7);
    free(f);
}

static inline double *random_start(const shell_statics *s, int count)
{
    double *mode = vector_of((size_t)count * s->n);
    uint64_t noise = 17;
    for (size_t i = 0; i < (size_t)count * s->n; i++)
        mode[i] = is_held(s->model, i % s->n) ? 0 : next_share(&noise) - 0.5;
    return mode;
}

#endif
