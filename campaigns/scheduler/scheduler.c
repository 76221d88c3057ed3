#include "campaigns/scheduler/scheduler.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A number of realizations that is given out, or was and waits again. It lives until nobody holds it or has it in memory. */
typedef struct task {
    uint64_t id, point;
    size_t count;
    int64_t *replica;
    int64_t attempts; /* of a single realization */
    bool isolated;
    bool done;        /* durable, by whichever worker was first */
    size_t held, kept; /* by so many workers: at work, in memory */
    double began;     /* when it was given out last */
    struct task *next; /* of those that wait again */
} task;

/* A task in the memory of a worker. */
typedef struct note {
    task *task;
    struct note *next;
} note;

typedef struct {
    task *held[FRACAS_LEASES_HELD]; /* the first one runs */
    size_t nheld;
    note *memory;
} worker_state;

/* What waits of a point, never given out before. */
typedef struct {
    int64_t *replica;
    size_t from, to, room;
    double seconds; /* measured, of `measured` realizations */
    int64_t measured;
} point_state;

struct fracas_scheduler {
    fracas_scheduler_options options;
    uint64_t state; /* of the shuffle */
    uint64_t nextid;
    point_state *point;
    size_t waiting;       /* realizations, in `point` and `again` */
    task *again, *last;   /* tasks that wait again */
    size_t uncomputed;    /* tasks held that nobody has in memory or durable */
    worker_state *worker;
    double seconds, measured; /* of all points: s, and the cost that took so long */
    fracas_scheduler_counts count;
    double cost, computed;    /* predicted, of all realizations and of those computed or failed for good */
};

static const double OVERDUE = 4, OVERDUE_LEAST = 10; /* times the prediction; s */
static const double LIMIT = 50, LIMIT_LEAST = 600;   /* the same of the time that a lease may take */
static const double SLOWEST = 1e6;                   /* element-steps/s, where nothing is measured: any machine is faster */

size_t fracas_lease_bytes(const fracas_lease *lease)
{
    return offsetof(fracas_lease, replica) + (size_t)lease->count * sizeof *lease->replica;
}

/* splitmix64 (Steele, Lea and Flood 2014): only orders work, so it need not be one of the sampler's streams. */
static uint64_t next_random(uint64_t *state)
{
    uint64_t x = (*state += 0x9e3779b97f4a7c15u);
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

/* ---- tasks ---- */

static task *create_task(fracas_scheduler *s, uint64_t point, const int64_t *replica, size_t count)
{
    task *t = calloc(1, sizeof *t);
    if (t) t->replica = malloc(count * sizeof *replica);
    if (!t || !t->replica) {
        free(t);
        return NULL;
    }
    *t = (task){.id = s->nextid++, .point = point, .count = count, .replica = t->replica};
    memcpy(t->replica, replica, count * sizeof *replica);
    return t;
}

static void destroy_task(task *t)
{
    if (!t) return;
    free(t->replica);
    free(t);
}

static double cost_of(const fracas_scheduler *s, const task *t) { return s->options.cost[t->point] * (double)t->count; }

static void wait_first(fracas_scheduler *s, task *t)
{
    t->next = s->again;
    s->again = t;
    if (!s->last) s->last = t;
    s->waiting += t->count;
}

static void wait_last(fracas_scheduler *s, task *t)
{
    t->next = NULL;
    if (s->last) s->last->next = t;
    else s->again = t;
    s->last = t;
    s->waiting += t->count;
}

static task *take_again(fracas_scheduler *s)
{
    task *t = s->again;
    s->again = t->next;
    if (!s->again) s->last = NULL;
    t->next = NULL;
    s->waiting -= t->count;
    return t;
}

static void destroy_if_unused(task *t)
{
    if (!t->held && !t->kept) destroy_task(t);
}

/* ---- what leases take ---- */

/* s, or element-steps while nothing is measured: est_p. */
static double estimate(const fracas_scheduler *s, size_t point)
{
    const point_state *p = &s->point[point];
    if (p->measured) return p->seconds / (double)p->measured;
    return s->measured > 0 ? s->options.cost[point] * s->seconds / s->measured : s->options.cost[point];
}

static double predicted(const fracas_scheduler *s, const task *t)
{
    return s->measured > 0 ? estimate(s, t->point) * (double)t->count : NAN;
}

static double limit_of(const fracas_scheduler *s, const task *t)
{
    if (s->options.limit > 0) return s->options.limit;
    const double expected = predicted(s, t);
    return LIMIT_LEAST + LIMIT * (isnan(expected) ? cost_of(s, t) / SLOWEST : expected);
}

static void measure(fracas_scheduler *s, const task *t, size_t count, double seconds)
{
    if (!count || !(seconds >= 0)) return;
    s->point[t->point].seconds += seconds;
    s->point[t->point].measured += (int64_t)count;
    s->seconds += seconds;
    s->measured += s->options.cost[t->point] * (double)count;
}

/* ---- create ---- */

static bool grow(point_state *p, size_t more)
{
    if (p->to + more <= p->room) return true;
    const size_t room = p->to + more;
    int64_t *replica = realloc(p->replica, room * sizeof *replica);
    if (!replica) return false;
    p->replica = replica;
    p->room = room;
    return true;
}

static void shuffle(int64_t *replica, size_t count, uint64_t *state)
{
    for (size_t i = count; i > 1; i--) {
        const size_t j = (size_t)(next_random(state) % i);
        const int64_t swap = replica[i - 1];
        replica[i - 1] = replica[j];
        replica[j] = swap;
    }
}

/* Rows `from` to `to` of one point. */
static fracas_err add_point(fracas_scheduler *s, const fracas_index_row *row, size_t from, size_t to)
{
    point_state *p = &s->point[row[from].point];
    if (!grow(p, to - from)) return fracas_no_memory("the plan");
    const size_t first = p->to;
    for (size_t i = from; i < to; i++) {
        s->count.total++;
        if (row[i].status == FRACAS_DONE) {
            s->count.done++;
        } else if (row[i].status == FRACAS_FAILED_ROW || row[i].status == FRACAS_QUARANTINED) {
            s->count.failed++;
        } else {
            s->cost += s->options.cost[row[i].point];
            if (row[i].attempts > 0) {
                task *t = create_task(s, row[i].point, &row[i].replica, 1);
                if (!t) return fracas_no_memory("the plan");
                t->attempts = row[i].attempts;
                wait_last(s, t);
            } else {
                p->replica[p->to++] = row[i].replica;
            }
        }
    }
    s->waiting += p->to - first;
    if (s->options.shuffle) shuffle(p->replica + p->from, p->to - p->from, &s->state);
    return FRACAS_OK;
}

fracas_err fracas_scheduler_add(fracas_scheduler *scheduler, const fracas_index_row *row, size_t count)
{
    for (size_t from = 0, to; from < count; from = to) {
        for (to = from; to < count && row[to].point == row[from].point; to++)
            ;
        TRY(add_point(scheduler, row, from, to));
    }
    return FRACAS_OK;
}

fracas_err fracas_scheduler_create(const fracas_index_row *row, size_t count, const fracas_scheduler_options *options,
                                   fracas_scheduler **scheduler)
{
    fracas_scheduler *s = calloc(1, sizeof *s);
    if (!s) return fracas_no_memory("the plan");
    s->options = *options;
    s->state = options->seed;
    s->worker = calloc(options->workers, sizeof *s->worker);
    s->point = calloc(options->npoints + 1, sizeof *s->point);
    fracas_err err = s->worker && s->point ? fracas_scheduler_add(s, row, count) : fracas_no_memory("the plan");
    if (err) fracas_scheduler_destroy(s);
    else *scheduler = s;
    return err;
}

static void drop_held(worker_state *w, size_t i)
{
    w->nheld--;
    memmove(w->held + i, w->held + i + 1, (w->nheld - i) * sizeof *w->held);
}

void fracas_scheduler_destroy(fracas_scheduler *scheduler)
{
    if (!scheduler) return;
    while (scheduler->again) destroy_task(take_again(scheduler));
    for (size_t i = 0; scheduler->worker && i < scheduler->options.workers; i++) {
        worker_state *w = &scheduler->worker[i];
        while (w->nheld) {
            task *t = w->held[0];
            drop_held(w, 0);
            t->held--;
            destroy_if_unused(t);
        }
        for (note *n; (n = w->memory);) {
            w->memory = n->next;
            n->task->kept--;
            destroy_if_unused(n->task);
            free(n);
        }
    }
    for (size_t p = 0; scheduler->point && p < scheduler->options.npoints; p++) free(scheduler->point[p].replica);
    free(scheduler->point);
    free(scheduler->worker);
    free(scheduler);
}

/* ---- the next lease ---- */

static size_t waiting_of(const point_state *p) { return p->to - p->from; }

/* The point whose realizations take longest, or any; npoints if nothing waits. */
static size_t choose_point(fracas_scheduler *s)
{
    size_t best = s->options.npoints, seen = 0;
    for (size_t p = 0; p < s->options.npoints; p++) {
        if (!waiting_of(&s->point[p])) continue;
        seen++;
        if (best == s->options.npoints || (s->options.shuffle ? next_random(&s->state) % seen == 0 : estimate(s, p) > estimate(s, best)))
            best = p;
    }
    return best;
}

/* Of all that waits, in the unit of estimate(). */
static double waiting_work(const fracas_scheduler *s)
{
    double work = 0;
    for (size_t p = 0; p < s->options.npoints; p++)
        if (waiting_of(&s->point[p])) work += (double)waiting_of(&s->point[p]) * estimate(s, p);
    return work;
}

static size_t smaller(size_t a, size_t b) { return a < b ? a : b; }

/* The formula at fracas_scheduler_next. */
static size_t choose_count(fracas_scheduler *s, size_t point)
{
    const size_t width = s->options.width, there = waiting_of(&s->point[point]), workers = s->options.workers;
    if (s->options.shuffle) return smaller(there, 1 + (size_t)(next_random(&s->state) % (s->options.seconds > 0 ? 2 * width : width)));
    const double one = estimate(s, point), share = waiting_work(s) / (2 * (double)workers);
    double most = s->measured > 0 ? fmin(s->options.seconds, share) / one : 0;
    if (!(most < FRACAS_LEASE_MAX)) most = FRACAS_LEASE_MAX;
    const size_t batches = (size_t)most / width * width, even = (s->waiting + workers - 1) / workers;
    return smaller(there, batches ? batches : smaller(width, even));
}

static task *cut(fracas_scheduler *s)
{
    const size_t point = choose_point(s);
    point_state *p = &s->point[point];
    const size_t count = choose_count(s, point);
    task *t = create_task(s, point, p->replica + p->from, count);
    if (!t) return NULL;
    p->from += count;
    s->waiting -= count;
    return t;
}

/* A lease that somebody else runs far longer than predicted; the one that is overdue most. NULL if none is. */
static task *overdue(const fracas_scheduler *s, double now)
{
    task *worst = NULL;
    double most = 0;
    for (size_t i = 0; i < s->options.workers; i++) {
        for (size_t h = 0; h < s->worker[i].nheld; h++) {
            task *t = s->worker[i].held[h];
            const double expected = predicted(s, t);
            if (t->held > 1 || t->kept || t->done || isnan(expected)) continue;
            const double late = now - t->began - fmax(OVERDUE_LEAST, OVERDUE * expected);
            if (late > most) worst = t, most = late;
        }
    }
    return worst;
}

static void give(fracas_scheduler *s, worker_state *w, task *t, double now, fracas_lease *lease)
{
    if (t->held++ == 0 && !t->kept && !t->done) s->uncomputed++;
    w->held[w->nheld++] = t;
    t->began = now;
    lease->id = t->id;
    lease->point = t->point;
    lease->count = t->count;
    lease->isolated = t->isolated;
    lease->limit = limit_of(s, t);
    memcpy(lease->replica, t->replica, t->count * sizeof *t->replica);
}

fracas_err fracas_scheduler_next(fracas_scheduler *scheduler, size_t worker, double now, fracas_lease *lease, bool *given)
{
    worker_state *w = &scheduler->worker[worker];
    const size_t spare = scheduler->options.workers * scheduler->options.width;
    const size_t enough = scheduler->waiting > spare ? FRACAS_LEASES_HELD : 1;
    *given = false;
    if (w->nheld >= enough) return FRACAS_OK;
    task *t;
    if (scheduler->again) t = take_again(scheduler);
    else if (scheduler->waiting) t = cut(scheduler);
    else if (!(t = overdue(scheduler, now))) return FRACAS_OK;
    if (!t) return fracas_no_memory("a lease");
    give(scheduler, w, t, now, lease);
    *given = true;
    return FRACAS_OK;
}

/* ---- its life ---- */

/* Takes lease `id` out of the worker's hands. What it has ahead begins to run. */
static fracas_err let_go(fracas_scheduler *s, size_t worker, uint64_t id, task **found)
{
    worker_state *w = &s->worker[worker];
    for (size_t i = 0; i < w->nheld; i++) {
        if (w->held[i]->id != id) continue;
        *found = w->held[i];
        drop_held(w, i);
        if (--(*found)->held == 0 && !(*found)->kept && !(*found)->done) s->uncomputed--;
        return FRACAS_OK;
    }
    return fracas_fail(FRACAS_BUG, "worker %zu returned lease %llu, which it did not hold", worker, (unsigned long long)id);
}

/* Into the worker's memory: takes over the note. */
static void keep(fracas_scheduler *s, size_t worker, task *t, note *n)
{
    if (t->kept++ == 0 && !t->done) {
        if (t->held) s->uncomputed--;
        s->count.memory += (int64_t)t->count;
        s->computed += cost_of(s, t);
    }
    *n = (note){t, s->worker[worker].memory};
    s->worker[worker].memory = n;
}

fracas_err fracas_scheduler_computed(fracas_scheduler *scheduler, size_t worker, uint64_t id, double now, double seconds)
{
    task *t;
    note *n = malloc(sizeof *n);
    if (!n) return fracas_no_memory("a lease");
    fracas_err err = let_go(scheduler, worker, id, &t);
    if (err) {
        free(n);
        return err;
    }
    measure(scheduler, t, t->count, seconds);
    keep(scheduler, worker, t, n);
    if (scheduler->worker[worker].nheld) scheduler->worker[worker].held[0]->began = now; /* the one ahead */
    return FRACAS_OK;
}

/* Parts of a lease that failed: what was computed, the two halves of what is at fault, what was not begun. */
enum { KEPT, HALF, OTHER_HALF, REST, NPARTS };

static fracas_err split(fracas_scheduler *s, const task *t, size_t kept, size_t count, task *part[NPARTS])
{
    const size_t half = (count + 1) / 2;
    const size_t at[NPARTS + 1] = {0, kept, kept + half, kept + count, t->count};
    bool good = true;
    for (size_t i = 0; i < NPARTS; i++) {
        part[i] = NULL;
        if (at[i + 1] == at[i]) continue;
        part[i] = create_task(s, t->point, t->replica + at[i], at[i + 1] - at[i]);
        if (part[i]) part[i]->isolated = t->isolated && i != KEPT && i != REST;
        good &= part[i] != NULL;
    }
    if (good) return FRACAS_OK;
    for (size_t i = 0; i < NPARTS; i++) destroy_task(part[i]);
    return fracas_no_memory("a lease");
}

/* One realization alone. */
static void try_again(fracas_scheduler *s, task *t, bool *final)
{
    *final = ++t->attempts >= FRACAS_ATTEMPTS_MAX;
    if (*final) {
        s->count.failed++;
        s->computed += cost_of(s, t);
        destroy_task(t);
    } else {
        wait_last(s, t); /* the cause may be gone by then */
    }
}

fracas_err fracas_scheduler_failed(fracas_scheduler *scheduler, size_t worker, uint64_t id, size_t kept, size_t count,
                                   fracas_lease *lease, bool *final)
{
    task *t, *part[NPARTS];
    *final = false;
    TRY(let_go(scheduler, worker, id, &t));
    if (!count || kept + count > t->count)
        return fracas_fail(FRACAS_BUG, "worker %zu says that realizations %zu to %zu of the %zu of a lease failed", worker, kept,
                           kept + count, t->count);
    *lease = (fracas_lease){.id = t->id, .point = t->point, .count = count};
    memcpy(lease->replica, t->replica + kept, count * sizeof *t->replica);
    if (t->held || t->kept || t->done) { /* somebody else has it, or will tell */
        destroy_if_unused(t);
        return FRACAS_OK;
    }
    if (t->count == 1) {
        try_again(scheduler, t, final);
        return FRACAS_OK;
    }
    note *n = kept ? malloc(sizeof *n) : NULL;
    if (kept && !n) return fracas_no_memory("a lease");
    fracas_err err = split(scheduler, t, kept, count, part);
    if (err) {
        free(n);
        return err;
    }
    destroy_task(t);
    if (part[KEPT]) keep(scheduler, worker, part[KEPT], n);
    for (size_t i = NPARTS; i-- > HALF;) /* backwards, so that the first comes first */
        if (part[i]) wait_first(scheduler, part[i]);
    if (count == 1) { /* alone already: it has had its attempt */
        task *single = take_again(scheduler);
        try_again(scheduler, single, final);
    }
    return FRACAS_OK;
}

void fracas_scheduler_durable(fracas_scheduler *scheduler, size_t worker)
{
    worker_state *w = &scheduler->worker[worker];
    for (note *n; (n = w->memory);) {
        task *t = n->task;
        w->memory = n->next;
        free(n);
        t->kept--;
        if (t->done) {
            scheduler->count.duplicates += (int64_t)t->count;
        } else {
            t->done = true;
            scheduler->count.memory -= (int64_t)t->count;
            scheduler->count.done += (int64_t)t->count;
        }
        destroy_if_unused(t);
    }
}

void fracas_scheduler_lost(fracas_scheduler *scheduler, size_t worker)
{
    worker_state *w = &scheduler->worker[worker];
    while (w->nheld) {
        task *t = w->held[w->nheld - 1];
        drop_held(w, w->nheld - 1);
        t->isolated = true;
        if (--t->held || t->kept || t->done) {
            destroy_if_unused(t);
            continue;
        }
        scheduler->uncomputed--;
        wait_first(scheduler, t);
    }
    for (note *n; (n = w->memory);) {
        task *t = n->task;
        w->memory = n->next;
        free(n);
        if (--t->kept == 0 && !t->done) {
            scheduler->count.memory -= (int64_t)t->count;
            scheduler->computed -= cost_of(scheduler, t);
            if (t->held) scheduler->uncomputed++;
            else wait_first(scheduler, t);
        } else {
            destroy_if_unused(t);
        }
    }
}

bool fracas_scheduler_idles(const fracas_scheduler *scheduler, size_t worker)
{
    return scheduler->worker[worker].nheld == 0;
}

bool fracas_scheduler_keeps(const fracas_scheduler *scheduler, size_t worker)
{
    return scheduler->worker[worker].memory != NULL;
}

bool fracas_scheduler_computed_all(const fracas_scheduler *scheduler)
{
    return !scheduler->waiting && !scheduler->uncomputed;
}

double fracas_scheduler_remaining(const fracas_scheduler *scheduler, double now)
{
    double longest = 0;
    if (!(scheduler->measured > 0)) return 0;
    for (size_t i = 0; i < scheduler->options.workers; i++) {
        const worker_state *w = &scheduler->worker[i];
        double left = 0;
        for (size_t h = 0; h < w->nheld; h++) left += predicted(scheduler, w->held[h]);
        if (w->nheld) left = fmax(left - (now - w->held[0]->began), 0);
        longest = fmax(longest, left);
    }
    return longest;
}

double fracas_scheduler_predicted(const fracas_scheduler *scheduler)
{
    if (!(scheduler->measured > 0)) return NAN;
    double longest = 0;
    for (size_t p = 0; p < scheduler->options.npoints; p++)
        if (waiting_of(&scheduler->point[p]))
            longest = fmax(longest, fmax(scheduler->options.seconds, estimate(scheduler, p) * (double)scheduler->options.width));
    return longest;
}

fracas_scheduler_counts fracas_scheduler_count(const fracas_scheduler *scheduler)
{
    fracas_scheduler_counts count = scheduler->count;
    count.work = scheduler->cost > 0 ? scheduler->computed / scheduler->cost : 1;
    return count;
}
