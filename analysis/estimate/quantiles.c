/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/estimate/pooled.h"

#include "analysis/data/room.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double share[FRACAS_NQUANTILES] = {0.05, 0.25, 0.5, 0.75, 0.95};

enum { CELLS = 256 };

typedef struct {
    double number, mass;
} amount;

/* Fragments of one size in one unit of resampling. */
typedef struct {
    double size;
    amount of;
    size_t unit;
} entry;

/* A resample looks at the cells first, runs of entries, and at the entries of those alone in which
 * a quantile lies: it costs units x cells, not fragments. No size is in two cells, and none of them
 * lies on both sides of the cut. */
typedef struct {
    double lattice, cut;
    size_t units, count, cells;
    entry *entry;  /* count of them, ascending in size, then in unit */
    size_t *begin; /* for each cell, and the end */
    amount *part;  /* [unit][cell] */
    amount *total; /* for each cell in a resample */
} merged;

static int by_size(const void *a, const void *b)
{
    const entry *left = a, *right = b;
    if (left->size != right->size) return left->size < right->size ? -1 : 1;
    return (left->unit > right->unit) - (left->unit < right->unit);
}

static void add(amount *to, const amount *more, double times)
{
    to->number += times * more->number;
    to->mass += times * more->mass;
}

/* On a lattice sizes are whole numbers of steps until they are shown: equal sizes differ in their
 * last digits. */
static void merge(const fracas_ensemble *ensemble, merged *all)
{
    for (size_t i = 0; i < ensemble->nrealizations; i++)
        for (size_t f = ensemble->first[i]; f < ensemble->first[i + 1]; f++) {
            const double size = all->lattice > 0
                                    ? all->lattice * round(ensemble->size[f] / all->lattice)
                                    : ensemble->size[f];
            all->entry[f] = (entry){
                size, {1, ensemble->mass[f]}, fracas_pooled_unit(i, ensemble->nrealizations)};
        }
    qsort(all->entry, ensemble->nfragments, sizeof *all->entry, by_size);
    for (size_t f = 0; f < ensemble->nfragments; f++) {
        if (all->count > 0 && by_size(&all->entry[all->count - 1], &all->entry[f]) == 0)
            add(&all->entry[all->count - 1].of, &all->entry[f].of, 1);
        else all->entry[all->count++] = all->entry[f];
    }
}

static void divide(merged *all)
{
    const size_t least = all->count / CELLS + 1;
    for (size_t e = 0; e < all->count; e++) {
        const entry *now = &all->entry[e];
        const bool another = e == 0 || now->size != now[-1].size;
        const bool crosses = e > 0 && now->size > all->cut && !(now[-1].size > all->cut);
        if (e == 0 || crosses || (another && e - all->begin[all->cells - 1] >= least))
            all->begin[all->cells++] = e;
    }
    all->begin[all->cells] = all->count;
}

static fracas_err prepare(const fracas_ensemble *ensemble, fracas_room *room, merged *all)
{
    FRACAS_TAKE(room, all->entry, ensemble->nfragments);
    FRACAS_TAKE(room, all->begin, CELLS + 2);
    FRACAS_TAKE(room, all->total, CELLS + 2);
    FRACAS_TAKE(room, all->part, all->units * (CELLS + 3));
    TRY(fracas_room_check(room, "the sizes of a point's fragments"));
    merge(ensemble, all);
    divide(all);
    for (size_t c = 0; c < all->cells; c++)
        for (size_t e = all->begin[c]; e < all->begin[c + 1]; e++)
            add(&all->part[all->entry[e].unit * all->cells + c], &all->entry[e].of, 1);
    return FRACAS_OK;
}

/* One row of quantiles as the scan of ascending sizes passes them. */
typedef struct {
    double floor, total; /* summed below the first size, and in the end */
    int next;
    double *value;
} row;

static double wanted_by(const row *of)
{
    return of->floor + share[of->next] * (of->total - of->floor);
}

/* A sum equal to the wanted one to rounding reaches it: equal elements make such ties, and there
 * may be a gap beyond one. */
static bool reaches(const row *of, double sum)
{
    return of->next < FRACAS_NQUANTILES && sum >= wanted_by(of) - 1e-12 * of->total;
}

/* The sum goes from `before` to `after` at a size: the quantiles in between lie at it, on a lattice
 * as if its fragments were spread evenly over half a step to either side (estimators.16). */
static void pass(row *of, double before, double after, double size, double lattice)
{
    while (after > before && reaches(of, after)) {
        const double value = size + lattice * ((wanted_by(of) - before) / (after - before) - 0.5);
        of->value[of->next++] = value;
    }
}

enum { NUMBER, MASS, NROWS = 4, NVALUES = NROWS * FRACAS_NQUANTILES }; /* all, above the cut */

static void begin(row of[2], const amount *floor, const amount *total, double *value)
{
    of[NUMBER] = (row){floor->number, total->number,
                       total->number > floor->number ? 0 : FRACAS_NQUANTILES, value};
    of[MASS] = (row){floor->mass, total->mass, total->mass > floor->mass ? 0 : FRACAS_NQUANTILES,
                     value + FRACAS_NQUANTILES};
}

/* Through a cell, size by size; `sum` is the sum below it. */
static void scan(const merged *all, size_t cell, const uint32_t *weight, amount sum, row *of,
                 int rows)
{
    for (size_t e = all->begin[cell]; e < all->begin[cell + 1];) {
        const double size = all->entry[e].size;
        const amount before = sum;
        for (; e < all->begin[cell + 1] && all->entry[e].size == size; e++)
            add(&sum, &all->entry[e].of, weight[all->entry[e].unit]);
        for (int r = 0; r < rows; r += 2) {
            pass(&of[r + NUMBER], before.number, sum.number, size, all->lattice);
            pass(&of[r + MASS], before.mass, sum.mass, size, all->lattice);
        }
    }
}

static void quantiles(void *context, const uint32_t *weight, double *value)
{
    const merged *all = context;
    const amount nothing = {0, 0};
    amount whole = nothing, sum = nothing;
    row of[NROWS];
    int rows = 2;
    for (int v = 0; v < NVALUES; v++) value[v] = NAN;
    for (size_t c = 0; c < all->cells; c++) all->total[c] = nothing;
    for (size_t u = 0; u < all->units; u++) {
        const amount *part = all->part + u * all->cells;
        const double w = weight[u];
        if (weight[u])
            for (size_t c = 0; c < all->cells; c++) add(&all->total[c], &part[c], w);
    }
    for (size_t c = 0; c < all->cells; c++) add(&whole, &all->total[c], 1);
    begin(of, &nothing, &whole, value);
    for (size_t c = 0; c < all->cells; c++) {
        if (rows == 2 && all->entry[all->begin[c]].size > all->cut) {
            begin(of + 2, &sum, &whole, value + 2 * FRACAS_NQUANTILES);
            rows = NROWS;
        }
        amount after = sum;
        add(&after, &all->total[c], 1);
        bool here = false;
        for (int r = 0; r < rows; r += 2)
            here = here || reaches(&of[r + NUMBER], after.number) ||
                   reaches(&of[r + MASS], after.mass);
        if (here) scan(all, c, weight, sum, of, rows);
        sum = after;
    }
}

fracas_err fracas_quantiles_of(const fracas_ensemble *ensemble, double cut, uint64_t seed,
                               fracas_pooled *pooled)
{
    merged all = {.lattice = ensemble->lattice,
                  .cut = cut,
                  .units = fracas_pooled_units(ensemble->nrealizations)};
    fracas_interval interval[NVALUES];
    FRACAS_CLEARED(fracas_room) room = {0};
    TRY(prepare(ensemble, &room, &all));
    TRY(fracas_bootstrap(all.units, NVALUES, quantiles, &all,
                         &(fracas_bootstrap_options){.seed = seed}, interval));
    memcpy(pooled->all.quantile, interval, sizeof pooled->all.quantile);
    memcpy(pooled->all.mass_quantile, interval + FRACAS_NQUANTILES,
           sizeof pooled->all.mass_quantile);
    memcpy(pooled->above.quantile, interval + 2 * FRACAS_NQUANTILES, sizeof pooled->above.quantile);
    memcpy(pooled->above.mass_quantile, interval + 3 * FRACAS_NQUANTILES,
           sizeof pooled->above.mass_quantile);
    return FRACAS_OK;
}
