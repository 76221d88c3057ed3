#include "analysis/estimate/quantiles.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const double fracas_quantile_share[FRACAS_NQUANTILES] = {0.05, 0.25, 0.5, 0.75, 0.95};

static const double most_visits = 5e7;
enum { FEWEST = 300, MOST = 2000 };

/* Fragments of one size in one realization. */
typedef struct {
    double size;
    double mass;          /* of them together */
    uint32_t realization;
    uint32_t number;
} entry;

typedef struct {
    double lattice, cut;
    size_t n;       /* realizations */
    size_t count;   /* entries, ascending in size, then in realization */
    entry *entry;
    double *number, *mass; /* of each realization: a total is found without a visit of every entry */
} merged;

static int by_size(const void *a, const void *b)
{
    const entry *left = a, *right = b;
    if (left->size != right->size) return left->size < right->size ? -1 : 1;
    return (left->realization > right->realization) - (left->realization < right->realization);
}

/* On a lattice sizes are whole numbers of steps until they are shown: equal sizes differ in their last digits. */
static fracas_err merge(const fracas_ensemble *ensemble, merged *all)
{
    size_t count = 0;
    all->entry = malloc((ensemble->nfragments + 1) * sizeof *all->entry);
    all->number = calloc(all->n + 1, sizeof *all->number);
    all->mass = calloc(all->n + 1, sizeof *all->mass);
    if (!all->entry || !all->number || !all->mass) return fracas_no_memory("the sizes of a point's fragments");
    for (size_t i = 0; i < all->n; i++)
        for (size_t f = ensemble->first[i]; f < ensemble->first[i + 1]; f++) {
            const double size = all->lattice > 0 ? all->lattice * round(ensemble->size[f] / all->lattice) : ensemble->size[f];
            all->entry[f] = (entry){size, ensemble->mass[f], (uint32_t)i, 1};
            all->number[i]++;
            all->mass[i] += ensemble->mass[f];
        }
    qsort(all->entry, ensemble->nfragments, sizeof *all->entry, by_size);
    for (size_t f = 0; f < ensemble->nfragments; f++) {
        if (count > 0 && by_size(&all->entry[count - 1], &all->entry[f]) == 0) {
            all->entry[count - 1].mass += all->entry[f].mass;
            all->entry[count - 1].number++;
        } else {
            all->entry[count++] = all->entry[f];
        }
    }
    all->count = count;
    return FRACAS_OK;
}

/* One row of quantiles as the scan of ascending sizes passes them. */
typedef struct {
    double floor, total; /* summed below the first size, and in the end */
    int next;
    double *value;
} row;

/* What was summed goes from `before` to `after` at a size: the quantiles passed lie at it, on a lattice as if its fragments were spread evenly over half
 * a step to either side (estimators.16). */
static inline void pass(row *of, double before, double after, double size, double lattice)
{
    while (of->next < FRACAS_NQUANTILES) {
        const double wanted = of->floor + fracas_quantile_share[of->next] * (of->total - of->floor);
        if (!(after >= wanted)) return;
        of->value[of->next++] = size + lattice * ((wanted - before) / (after - before) - 0.5);
    }
}

enum { NUMBER, MASS, NROWS = 4, NVALUES = NROWS * FRACAS_NQUANTILES }; /* of all, then of those above the cut */

static void begin(row *of, double floor, double total, double *value)
{
    *of = (row){.floor = floor, .total = total, .value = value, .next = total > floor ? 0 : FRACAS_NQUANTILES};
}

static void quantiles(void *context, const uint32_t *weight, double *value)
{
    const merged *all = context;
    row of[NROWS];
    double total[2] = {0, 0}, sum[2] = {0, 0};
    bool above = false;
    for (int v = 0; v < NVALUES; v++) value[v] = NAN;
    for (size_t i = 0; i < all->n; i++) {
        total[NUMBER] += weight[i] * all->number[i];
        total[MASS] += weight[i] * all->mass[i];
    }
    for (int r = 0; r < 2; r++) begin(&of[r], 0, total[r], value + r * FRACAS_NQUANTILES);
    for (size_t e = 0; e < all->count;) {
        const double size = all->entry[e].size;
        if (!above && size > all->cut) {
            above = true;
            for (int r = 0; r < 2; r++) begin(&of[2 + r], sum[r], total[r], value + (2 + r) * FRACAS_NQUANTILES);
        }
        const double before[2] = {sum[NUMBER], sum[MASS]};
        for (; e < all->count && all->entry[e].size == size; e++) {
            const double w = weight[all->entry[e].realization];
            sum[NUMBER] += w * all->entry[e].number;
            sum[MASS] += w * all->entry[e].mass;
        }
        for (int r = 0; r < (above ? NROWS : 2); r++)
            if (sum[r & 1] > before[r & 1]) pass(&of[r], before[r & 1], sum[r & 1], size, all->lattice);
    }
}

static int64_t resamples_of(size_t entries)
{
    const double wanted = most_visits / (double)(entries + 1);
    return wanted >= MOST ? MOST : wanted <= FEWEST ? FEWEST : (int64_t)wanted;
}

fracas_err fracas_quantiles_of(const fracas_ensemble *ensemble, double cut, uint64_t seed, fracas_pooled *pooled)
{
    merged all = {.lattice = ensemble->lattice, .cut = cut, .n = ensemble->nrealizations};
    fracas_interval interval[NVALUES];
    fracas_err err = merge(ensemble, &all);
    if (!err) {
        const fracas_bootstrap_options options = {.seed = seed, .resamples = resamples_of(all.count)};
        err = fracas_bootstrap(all.n, NVALUES, quantiles, &all, &options, interval);
    }
    if (!err) {
        memcpy(pooled->all.quantile, interval, sizeof pooled->all.quantile);
        memcpy(pooled->all.mass_quantile, interval + FRACAS_NQUANTILES, sizeof pooled->all.mass_quantile);
        memcpy(pooled->above.quantile, interval + 2 * FRACAS_NQUANTILES, sizeof pooled->above.quantile);
        memcpy(pooled->above.mass_quantile, interval + 3 * FRACAS_NQUANTILES, sizeof pooled->above.mass_quantile);
    }
    free(all.entry);
    free(all.number);
    free(all.mass);
    return err;
}
