/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/lease/backlog.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Points are kept apart: a measurement changes the estimates of all unmeasured points at once, but
 * not their order by cost. */
enum { UNMEASURED, MEASURED, NKINDS };
enum { NONE = UINT32_MAX };

typedef struct {
    int64_t *replica;
    size_t from, to;
    double seconds; /* total over `measured` realizations */
    int64_t measured;
} point_state;

/* Summary of a range of points: a node of a binary tree with one point in each leaf. */
typedef struct {
    double work[NKINDS];   /* waiting: cost, s */
    uint32_t best[NKINDS]; /* first point to lease; NONE: none waits */
    uint32_t points;       /* with waiting replicas */
} range;

struct fracas_backlog {
    const double *cost;
    const bool *first;
    size_t npoints, nleaves; /* a power of 2 */
    point_state *point;
    range *range;             /* 1: the root; the halves of i are 2 i and 2 i + 1 */
    double seconds, measured; /* totals over all points: s, cost */
};

uint64_t fracas_backlog_random(uint64_t *state)
{
    uint64_t x = (*state += 0x9e3779b97f4a7c15u);
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

/* ---- estimates ---- */

static double rate(const fracas_backlog *b)
{
    return b->measured > 0 ? b->seconds / b->measured : 1;
}

static double own_estimate(const fracas_backlog *b, size_t point)
{
    const point_state *p = &b->point[point];
    return p->measured ? p->seconds / (double)p->measured : b->cost[point];
}

bool fracas_backlog_measured(const fracas_backlog *backlog)
{
    return backlog->measured > 0;
}

double fracas_backlog_estimate(const fracas_backlog *backlog, size_t point)
{
    return own_estimate(backlog, point) * (backlog->point[point].measured ? 1 : rate(backlog));
}

/* ---- the tree ---- */

static range range_of(const fracas_backlog *b, size_t point)
{
    range made = {.best = {NONE, NONE}};
    const point_state *p = &b->point[point];
    const int kind = p->measured ? MEASURED : UNMEASURED;
    if (p->from == p->to) return made;
    made.points = 1;
    made.best[kind] = (uint32_t)point;
    made.work[kind] = own_estimate(b, point) * (double)(p->to - p->from);
    return made;
}

static bool goes_first(const fracas_backlog *b, uint32_t point)
{
    return b->first && b->first[point];
}

/* Ties: the left one, so the order does not depend on the machine. */
static uint32_t better(const fracas_backlog *b, uint32_t left, uint32_t right,
                       double (*estimate)(const fracas_backlog *b, size_t point))
{
    if (left == NONE || right == NONE) return left == NONE ? right : left;
    if (goes_first(b, left) != goes_first(b, right)) return goes_first(b, right) ? right : left;
    return estimate(b, right) > estimate(b, left) ? right : left;
}

static void combine(fracas_backlog *b, size_t i)
{
    const range *left = &b->range[2 * i], *right = left + 1;
    range *made = &b->range[i];
    made->points = left->points + right->points;
    for (int kind = 0; kind < NKINDS; kind++) {
        made->work[kind] = left->work[kind] + right->work[kind];
        made->best[kind] = better(b, left->best[kind], right->best[kind], own_estimate);
    }
}

static void update(fracas_backlog *b, size_t point)
{
    size_t i = b->nleaves + point;
    b->range[i] = range_of(b, point);
    while (i /= 2) combine(b, i);
}

/* ---- create ---- */

fracas_err fracas_backlog_create(const double *cost, const bool *first, size_t npoints,
                                 fracas_backlog **backlog)
{
    OWN(fracas_backlog) b = calloc(1, sizeof *b);
    if (!b) return fracas_no_memory("the plan");
    *b = (fracas_backlog){.cost = cost, .first = first, .npoints = npoints, .nleaves = 1};
    while (b->nleaves < npoints) b->nleaves *= 2;
    b->point = calloc(npoints + 1, sizeof *b->point);
    b->range = malloc(2 * b->nleaves * sizeof *b->range);
    if (!b->point || !b->range) return fracas_no_memory("the plan");
    for (size_t i = 0; i < 2 * b->nleaves; i++) b->range[i] = (range){.best = {NONE, NONE}};
    *backlog = b;
    b = NULL;
    return FRACAS_OK;
}

void fracas_backlog_destroy(fracas_backlog *backlog)
{
    if (!backlog) return;
    for (size_t p = 0; backlog->point && p < backlog->npoints; p++) free(backlog->point[p].replica);
    free(backlog->point);
    free(backlog->range);
    free(backlog);
}

/* ---- waiting replicas ---- */

fracas_err fracas_backlog_add(fracas_backlog *backlog, size_t point, const int64_t *replica,
                              size_t count)
{
    point_state *p = &backlog->point[point];
    if (!count) return FRACAS_OK;
    const size_t left = p->to - p->from;
    int64_t *all = malloc((left + count) * sizeof *all);
    if (!all) return fracas_no_memory("the plan");
    if (left) memcpy(all, p->replica + p->from, left * sizeof *all);
    memcpy(all + left, replica, count * sizeof *replica);
    free(p->replica);
    p->replica = all;
    p->from = 0;
    p->to = left + count;
    update(backlog, point);
    return FRACAS_OK;
}

void fracas_backlog_shuffle(fracas_backlog *backlog, size_t point, uint64_t *state)
{
    const point_state *p = &backlog->point[point];
    for (size_t i = p->to - p->from; i > 1; i--) {
        int64_t *a = &p->replica[p->from + i - 1],
                *b = &p->replica[p->from + (size_t)(fracas_backlog_random(state) % i)];
        const int64_t swap = *a;
        *a = *b;
        *b = swap;
    }
}

const int64_t *fracas_backlog_take(fracas_backlog *backlog, size_t point, size_t count)
{
    point_state *p = &backlog->point[point];
    const int64_t *taken = p->replica + p->from;
    p->from += count;
    update(backlog, point);
    return taken;
}

void fracas_backlog_measure(fracas_backlog *backlog, size_t point, size_t count, double seconds)
{
    point_state *p = &backlog->point[point];
    if (!(seconds >= 0)) return;
    p->seconds += seconds;
    p->measured += (int64_t)count;
    backlog->seconds += seconds;
    backlog->measured += backlog->cost[point] * (double)count;
    update(backlog, point);
}

size_t fracas_backlog_waiting(const fracas_backlog *backlog, size_t point)
{
    return backlog->point[point].to - backlog->point[point].from;
}

double fracas_backlog_work(const fracas_backlog *backlog)
{
    const range *all = &backlog->range[1];
    return all->work[UNMEASURED] * rate(backlog) + all->work[MEASURED];
}

size_t fracas_backlog_longest(const fracas_backlog *backlog)
{
    const uint32_t *best = backlog->range[1].best;
    const bool first = best[UNMEASURED] < best[MEASURED];
    const uint32_t longest = better(backlog, first ? best[UNMEASURED] : best[MEASURED],
                                    first ? best[MEASURED] : best[UNMEASURED],
                                    fracas_backlog_estimate);
    return longest == NONE ? SIZE_MAX : longest;
}

size_t fracas_backlog_any(const fracas_backlog *backlog, uint64_t *state)
{
    const range *r = backlog->range;
    size_t skip = (size_t)(fracas_backlog_random(state) % r[1].points), i = 1;
    while (i < backlog->nleaves) {
        i *= 2;
        if (skip >= r[i].points) skip -= r[i++].points;
    }
    return i - backlog->nleaves;
}
