/* SPDX-License-Identifier: GPL-3.0-or-later */
/* value = A w: the variance at a place is the square of the norm of its row of A. A row is found
 * from its end to the coarse places, only where it is not zero: at few, since a value depends on
 * coarser ones, further away the coarser they are. Eight rows are found at once, of sites close to
 * each other, which have about the same places. */
#include "sampler/field/variance.h"

#include <math.h>
#include <stdlib.h>

/* Entries of a row below this times s_k, the place's own standard deviation (1 or less), are left
 * out. Without the terms e_k s_k the variance is wrong by less than 2 sum |e_k|, below 2e-15 times
 * the number of places left out. */
#define NOTHING 1e-15
enum { ROWS = 8, M = FRACAS_NEAR_SITES };
typedef double rows __attribute__((vector_size(ROWS * sizeof(double))));
typedef double pair __attribute__((vector_size(2 * sizeof(double))));
typedef union {
    rows all;
    pair pair[ROWS / 2];
} split_rows;

typedef struct {
    const fracas_unscaled_factor *field;
    double *product;   /* [coarse*coarse] L L^T */
    split_rows *reach; /* [n] contribution of a place to each of the values, by its own */
    uint64_t *reached; /* [n/64 + 1] bits: the places */
    uint32_t *support; /* [coarse] the coarse ones of them */
} sweep;

static void mark(sweep *s, size_t k)
{
    s->reached[k / 64] |= (uint64_t)1 << (k % 64);
}

/* The last place reached; it is unmarked. False if there is none up to *word. */
static bool last_reached(sweep *s, size_t *word, size_t *k)
{
    while (s->reached[*word] == 0)
        if ((*word)-- == 0) return false;
    const int bit = 63 - __builtin_clzll(s->reached[*word]);
    s->reached[*word] ^= (uint64_t)1 << bit;
    *k = *word * 64 + (size_t)bit;
    return true;
}

/* True for a place left out. */
static bool is_nothing(const sweep *s, size_t k)
{
    double largest = 0.0;
    for (int r = 0; r < ROWS; r++) largest = fmax(largest, fabs(s->reach[k].all[r]));
    return largest < NOTHING;
}

/* sum product[k] reach[k] of k = support[0 ... count-1]. Pairs stay in registers; of whole rows
 * compilers keep the sum in memory. */
static rows coarse_sum(const sweep *s, size_t count, const double *product)
{
    pair a = {0}, b = {0}, c = {0}, d = {0};
    for (size_t q = 0; q < count; q++) {
        const size_t k = s->support[q];
        const pair *x = s->reach[k].pair;
        a += product[k] * x[0];
        b += product[k] * x[1];
        c += product[k] * x[2];
        d += product[k] * x[3];
    }
    return (split_rows){.pair = {a, b, c, d}}.all;
}

/* x^T L L^T x of the places in the support, which are cleared. */
static rows coarse_variances(sweep *s, size_t count)
{
    rows sum = {0};
    for (size_t p = 0; p < count; p++) {
        const rows x = s->reach[s->support[p]].all;
        const double *product = &s->product[s->support[p] * s->field->coarse];
        sum += x * (product[s->support[p]] * x + 2.0 * coarse_sum(s, p, product));
    }
    for (size_t p = 0; p < count; p++) s->reach[s->support[p]].all = (rows){0};
    return sum;
}

/* (fields.16) The variances at `count` places. */
static rows variances(sweep *s, const uint32_t *place, size_t count)
{
    const fracas_unscaled_factor *field = s->field;
    size_t word = field->n / 64, nsupport = 0, k;
    rows sum = {0};
    for (size_t r = 0; r < count; r++) {
        s->reach[place[r]].all[r] = 1.0;
        mark(s, place[r]);
    }
    while (last_reached(s, &word, &k)) {
        if (is_nothing(s, k)) {
            s->reach[k].all = (rows){0};
            continue;
        }
        if (k < field->coarse) {
            s->support[nsupport++] = (uint32_t)k;
            continue;
        }
        const rows x = s->reach[k].all, own = field->rest[k - field->coarse] * x;
        const double *weight = &field->weight[(k - field->coarse) * M];
        const uint32_t *near = &field->near[(k - field->coarse) * M];
        sum += own * own;
        s->reach[k].all = (rows){0};
        for (size_t a = 0; a < M; a++) {
            s->reach[near[a]].all += weight[a] * x;
            mark(s, near[a]);
        }
    }
    return sum + coarse_variances(s, nsupport);
}

/* A place, and where its site lies along Morton's curve through the box of all sites. */
typedef struct {
    uint64_t along;
    uint32_t place;
} spot;

static int by_spot(const void *a, const void *b)
{
    const spot *x = a, *y = b;
    if (x->along != y->along) return x->along < y->along ? -1 : 1;
    return (x->place > y->place) - (x->place < y->place);
}

/* The places with the sites of neighbours next to each other. */
static void find_spots(const fracas_unscaled_factor *field, const uint32_t *order,
                       const double (*position)[3], spot *spots)
{
    double low[3] = {INFINITY, INFINITY, INFINITY}, size = 0.0;
    for (int a = 0; a < 3; a++) {
        for (size_t i = 0; i < field->n; i++) low[a] = fmin(low[a], position[i][a]);
        for (size_t i = 0; i < field->n; i++) size = fmax(size, position[i][a] - low[a]);
    }
    for (size_t k = 0; k < field->n; k++) {
        spots[k] = (spot){0, (uint32_t)k};
        for (int a = 0; a < 3; a++) {
            const uint64_t x = size > 0.0
                                   ? (uint64_t)((position[order[k]][a] - low[a]) / size * 65535.0)
                                   : 0;
            for (int bit = 0; bit < 16; bit++) spots[k].along |= (x >> bit & 1) << (3 * bit + a);
        }
    }
    qsort(spots, field->n, sizeof *spots, by_spot);
}

static void sweep_all(sweep *s, const spot *spots, double *variance)
{
    const fracas_unscaled_factor *field = s->field;
    for (size_t p = 0; p < field->coarse; p++)
        for (size_t q = 0; q <= p; q++)
            s->product[p * field->coarse + q] = s->product[q * field->coarse + p] =
                fracas_dense_factor_product(&field->dense, p, q);
    for (size_t from = 0; from < field->n; from += ROWS) {
        const size_t count = field->n - from < ROWS ? field->n - from : ROWS;
        uint32_t place[ROWS];
        for (size_t r = 0; r < count; r++) place[r] = spots[from + r].place;
        const rows sum = variances(s, place, count);
        for (size_t r = 0; r < count; r++) variance[place[r]] = sum[r];
    }
}

fracas_err fracas_unscaled_variances(const fracas_unscaled_factor *field, const uint32_t *order,
                                     const double (*position)[3], double *variance)
{
    const size_t n = field->n;
    OWNED double *product = malloc((field->coarse * field->coarse + 1) * sizeof *product);
    OWNED split_rows *reach = aligned_alloc(sizeof(rows), (n + 1) * sizeof *reach);
    OWNED uint64_t *reached = calloc(n / 64 + 1, sizeof *reached);
    OWNED uint32_t *support = malloc((field->coarse + 1) * sizeof *support);
    OWNED spot *spots = malloc((n + 1) * sizeof *spots);
    if (!product || !reach || !reached || !support || !spots)
        return fracas_no_memory("a correlated field");
    for (size_t k = 0; k < n; k++) reach[k].all = (rows){0};
    find_spots(field, order, position, spots);
    sweep_all(&(sweep){field, product, reach, reached, support}, spots, variance);
    return FRACAS_OK;
}
