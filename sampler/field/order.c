/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sites are taken level by level: on a level of spacing r, all at least r away from every site
 * taken before. Taken sites are kept in the cells of a grid as wide as r, found by a hash, since
 * surfaces fill few of the cells around them. */
#include "sampler/field/order.h"

#include "base/own.h"

#include <math.h>
#include <stdbool.h>

#define RATIO 0.8 /* ratio of the spacings of two levels */
#define NONE UINT32_MAX

typedef struct {
    const double (*position)[3];
    size_t first, m;
    uint32_t *order, *near;
    size_t taken;
    double middle[3], size; /* the box around all sites, m */
    double cell;            /* m */
    size_t mask;            /* the hash's */
    uint32_t *head;         /* [mask + 1] place in the order, or NONE */
    uint32_t *next;         /* [n] */
    int32_t (*cell_of)[3];  /* [n] of the site at a place in the order */
    uint32_t *waiting;      /* [n] sites not yet taken */
    size_t nwaiting;
} hierarchy;

static void hierarchy_clear(hierarchy *h)
{
    free(h->head);
    free(h->next);
    free(h->cell_of);
    free(h->waiting);
}

static size_t bucket(const hierarchy *h, const int32_t cell[3])
{
    const uint64_t key = (uint64_t)(uint32_t)cell[0] * 0x9e3779b97f4a7c15u ^
                         (uint64_t)(uint32_t)cell[1] * 0xc2b2ae3d27d4eb4fu ^
                         (uint64_t)(uint32_t)cell[2] * 0x165667b19e3779f9u;
    return (size_t)(key >> 20) & h->mask;
}

/* A cell is at least 1e-9 of the box: its number fits. */
static void find_cell(const hierarchy *h, const double x[3], int32_t cell[3])
{
    for (int a = 0; a < 3; a++) cell[a] = (int32_t)floor((x[a] - h->middle[a]) / h->cell);
}

static void insert(hierarchy *h, size_t place)
{
    find_cell(h, h->position[h->order[place]], h->cell_of[place]);
    uint32_t *head = &h->head[bucket(h, h->cell_of[place])];
    h->next[place] = *head;
    *head = (uint32_t)place;
}

static void lay_grid(hierarchy *h, double cell)
{
    h->cell = cell;
    for (size_t b = 0; b <= h->mask; b++) h->head[b] = NONE;
    for (size_t k = 0; k < h->taken; k++) insert(h, k);
}

static double distance2(const double a[3], const double b[3])
{
    const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
    return x * x + y * y + z * z;
}

/* The nearest sites so far, the nearest first; of two equally far, the one taken first. */
typedef struct {
    size_t count, wanted;
    double *distance2;
    uint32_t *place;
} nearest;

static void offer(nearest *found, double d2, uint32_t place)
{
    size_t at = found->count;
    while (at > 0 && (d2 < found->distance2[at - 1] ||
                      (d2 == found->distance2[at - 1] && place < found->place[at - 1])))
        at--;
    if (at == found->wanted) return;
    if (found->count < found->wanted) found->count++;
    for (size_t k = found->count - 1; k > at; k--) {
        found->distance2[k] = found->distance2[k - 1];
        found->place[k] = found->place[k - 1];
    }
    found->distance2[at] = d2;
    found->place[at] = place;
}

static void look_into(const hierarchy *h, const double x[3], const int32_t cell[3], nearest *found)
{
    for (uint32_t k = h->head[bucket(h, cell)]; k != NONE; k = h->next[k])
        if (h->cell_of[k][0] == cell[0] && h->cell_of[k][1] == cell[1] &&
            h->cell_of[k][2] == cell[2])
            offer(found, distance2(h->position[h->order[k]], x), k);
}

/* All cells `ring` cells away from the cell of x. */
static void look_around(const hierarchy *h, const double x[3], int32_t ring, nearest *found)
{
    int32_t middle[3];
    find_cell(h, x, middle);
    for (int32_t i = -ring; i <= ring; i++)
        for (int32_t j = -ring; j <= ring; j++) {
            const bool face = i == -ring || i == ring || j == -ring || j == ring;
            for (int32_t k = -ring; k <= ring; k += face || ring == 0 ? 1 : 2 * ring)
                look_into(h, x, (const int32_t[3]){middle[0] + i, middle[1] + j, middle[2] + k},
                          found);
        }
}

/* Sites outside the cells within `ring` are further away than ring*cell. Once there are more cells
 * to look into than sites, sites are looked at one by one. */
static void find_nearest(const hierarchy *h, const double x[3], nearest *found)
{
    for (int32_t ring = 0; ring < 2 || (size_t)ring * (size_t)ring * (size_t)ring < h->taken / 8;
         ring++) {
        look_around(h, x, ring, found);
        const double seen = ring * h->cell;
        if (found->count == found->wanted && found->distance2[found->wanted - 1] <= seen * seen)
            return;
    }
    found->count = 0;
    for (size_t k = 0; k < h->taken; k++)
        offer(found, distance2(h->position[h->order[k]], x), (uint32_t)k);
}

static bool is_free(const hierarchy *h, const double x[3], double r)
{
    double d2;
    uint32_t place;
    nearest found = {.wanted = 1, .distance2 = &d2, .place = &place};
    for (int32_t ring = 0; ring < 2; ring++) {
        look_around(h, x, ring, &found);
        if (found.count > 0 && d2 < r * r) return false;
    }
    return true;
}

static void take(hierarchy *h, uint32_t site, double *room)
{
    if (h->taken >= h->first) {
        nearest found = {
            .wanted = h->m, .distance2 = room, .place = &h->near[(h->taken - h->first) * h->m]};
        find_nearest(h, h->position[site], &found);
    }
    h->order[h->taken] = site;
    insert(h, h->taken++);
}

/* A level of spacing r; r = 0 takes all sites left. Cells are twice as wide as r: few hold the m
 * nearest sites. */
static void take_level(hierarchy *h, double r, double *room)
{
    size_t left = 0;
    for (size_t k = 0; k < h->nwaiting; k++) {
        const uint32_t site = h->waiting[k];
        if (r > 0.0 && !is_free(h, h->position[site], r)) h->waiting[left++] = site;
        else take(h, site, room);
    }
    h->nwaiting = left;
}

static size_t common_divisor(size_t a, size_t b)
{
    return b == 0 ? a : common_divisor(b, a % b);
}

/* All sites in steps of about 0.618 n, which keeps neighbours far apart; the one nearest to the
 * middle of the box is taken. */
static void begin(hierarchy *h, size_t n, double *room)
{
    double low[3], high[3], size2 = 0.0;
    for (int a = 0; a < 3; a++) {
        low[a] = high[a] = h->position[0][a];
        for (size_t i = 1; i < n; i++) {
            low[a] = fmin(low[a], h->position[i][a]);
            high[a] = fmax(high[a], h->position[i][a]);
        }
        h->middle[a] = 0.5 * (low[a] + high[a]);
        size2 += (high[a] - low[a]) * (high[a] - low[a]);
    }
    h->size = sqrt(size2);
    size_t step = (size_t)(0.6180339887 * (double)n) + 1, start = 0;
    while (common_divisor(step, n) > 1) step++;
    for (size_t i = 1; i < n; i++)
        if (distance2(h->position[i], h->middle) < distance2(h->position[start], h->middle))
            start = i;
    for (size_t k = 1, i = start; k < n; k++) {
        i = (i + step) % n;
        h->waiting[h->nwaiting++] = (uint32_t)i;
    }
    lay_grid(h, h->size > 0.0 ? 2.0 * h->size : 1.0);
    take(h, (uint32_t)start, room);
}

fracas_err fracas_order_sites(size_t n, const double (*position)[3], size_t first, size_t m,
                              uint32_t *order, uint32_t *near)
{
    size_t buckets = 1;
    while (buckets < 2 * n) buckets *= 2;
    FRACAS_CLEARED(hierarchy)
    h = {.position = position,
         .first = first,
         .m = m,
         .order = order,
         .near = near,
         .mask = buckets - 1};
    if (n == 0) return FRACAS_OK;
    h.head = malloc(buckets * sizeof *h.head);
    h.next = malloc(n * sizeof *h.next);
    h.cell_of = malloc(n * sizeof *h.cell_of);
    h.waiting = malloc(n * sizeof *h.waiting);
    OWNED double *room = malloc((m + 1) * sizeof *room);
    if (!h.head || !h.next || !h.cell_of || !h.waiting || !room)
        return fracas_no_memory("the order of sites");
    begin(&h, n, room);
    /* Sites closer than 1e-3 of the usual distance are left to the end. */
    for (double r = h.size * RATIO; h.nwaiting > 0 && r > 1e-3 * h.size / (double)n; r *= RATIO) {
        lay_grid(&h, 2.0 * r);
        take_level(&h, r, room);
    }
    if (h.nwaiting > 0) {
        lay_grid(&h, h.size > 0.0 ? 2.0 * h.size / sqrt((double)n) : 1.0);
        take_level(&h, 0.0, room);
    }
    return FRACAS_OK;
}
