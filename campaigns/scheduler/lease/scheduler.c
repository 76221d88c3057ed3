/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/lease/scheduler.h"

#include "campaigns/scheduler/lease/backlog.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Realizations leased now, or leased before and waiting again. A task lives as long as a worker
 * holds it or has it in memory. */
typedef struct task {
    struct task *next; /* in the queue of waiting tasks */
    uint64_t id, point;
    int64_t attempts; /* with a single realization */
    bool isolated;
    bool done;         /* durable, by whichever worker was first */
    size_t held, kept; /* numbers of workers: computing it, with it in memory */
    size_t returned;   /* failures while another worker had it */
    size_t count;
    int64_t replica[];
} task;

typedef struct {
    task *task;
    double began; /* start of its run; of one ahead, of its lease */
} slot;

/* A task in the memory of a worker. */
typedef struct note {
    task *task;
    double since;
    struct note *next;
} note;

typedef struct {
    slot held[FRACAS_LEASES_HELD]; /* the first runs */
    size_t nheld;
    note *memory;
    bool lost; /* its server died, and it has not asked for a lease since */
} worker_state;

struct fracas_scheduler {
    fracas_scheduler_options options;
    uint64_t state; /* for the shuffle */
    uint64_t nextid;
    fracas_backlog *backlog; /* realizations never leased */
    task *again, **end;      /* queue of waiting tasks */
    size_t waiting;          /* realizations in both */
    size_t uncomputed;       /* tasks held, and neither in memory nor durable */
    worker_state *worker;
    fracas_counts count;
    double cost, computed; /* predicted: of all, and of those computed or failed for good */
};

static const double OVERDUE = 4, OVERDUE_LEAST = 10; /* x the prediction; s */
static const double LIMIT = 50, LIMIT_LEAST = 600;   /* x the prediction; s */
static const double SLOWEST = 1e6; /* element-steps/s, below any machine's speed */

/* ---- tasks ---- */

/* `replica` NULL: the caller fills in the replicas. NULL without memory. */
static task *create_task(fracas_scheduler *s, uint64_t point, const int64_t *replica, size_t count)
{
    task *t = malloc(sizeof *t + count * sizeof *t->replica);
    if (t) *t = (task){.id = s->nextid++, .point = point, .count = count};
    if (t && replica) memcpy(t->replica, replica, count * sizeof *replica);
    return t;
}

static double cost_of(const fracas_scheduler *s, const task *t)
{
    return s->options.cost[t->point] * (double)t->count;
}

static void wait_first(fracas_scheduler *s, task *t)
{
    t->next = s->again;
    s->again = t;
    if (!t->next) s->end = &t->next;
    s->waiting += t->count;
}

static void wait_last(fracas_scheduler *s, task *t)
{
    t->next = NULL;
    *s->end = t;
    s->end = &t->next;
    s->waiting += t->count;
}

static task *take_again(fracas_scheduler *s)
{
    task *t = s->again;
    s->again = t->next;
    if (!s->again) s->end = &s->again;
    s->waiting -= t->count;
    return t;
}

/* No worker has computed it before the one that holds it. */
static bool is_open(const task *t)
{
    return !t->kept && !t->done;
}

static void destroy_if_unused(task *t)
{
    if (!t->held && !t->kept) free(t);
}

/* s; NAN while nothing is measured. */
static double predicted(const fracas_scheduler *s, const task *t)
{
    if (!fracas_backlog_measured(s->backlog)) return NAN;
    return fracas_backlog_estimate(s->backlog, t->point) * (double)t->count;
}

static double limit_of(const fracas_scheduler *s, const task *t)
{
    if (s->options.limit > 0) return s->options.limit;
    const double expected = predicted(s, t);
    return LIMIT_LEAST + LIMIT * (isnan(expected) ? cost_of(s, t) / SLOWEST : expected);
}

/* ---- create ---- */

/* Counts one row by its state; a row with attempts waits alone, a fresh one is for the backlog. */
static fracas_err add_row(fracas_scheduler *s, const fracas_index_row *row, bool *fresh)
{
    *fresh = false;
    s->count.total++;
    if (row->status == FRACAS_DONE) {
        s->count.done++;
        return FRACAS_OK;
    }
    if (row->status == FRACAS_FAILED_ROW || row->status == FRACAS_QUARANTINED) {
        s->count.failed++;
        return FRACAS_OK;
    }
    s->cost += s->options.cost[row->point];
    *fresh = row->attempts == 0;
    if (*fresh) return FRACAS_OK;
    task *t = create_task(s, row->point, &row->replica, 1);
    if (!t) return fracas_no_memory("the plan");
    t->attempts = row->attempts;
    wait_last(s, t);
    return FRACAS_OK;
}

/* Rows of one point; `replica` has room for as many. */
static fracas_err add_point(fracas_scheduler *s, const fracas_index_row *row, size_t count,
                            int64_t *replica)
{
    size_t fresh = 0;
    for (size_t i = 0; i < count; i++) {
        bool is_fresh;
        TRY(add_row(s, &row[i], &is_fresh));
        if (is_fresh) replica[fresh++] = row[i].replica;
    }
    TRY(fracas_backlog_add(s->backlog, row->point, replica, fresh));
    s->waiting += fresh;
    if (s->options.shuffle && fresh) fracas_backlog_shuffle(s->backlog, row->point, &s->state);
    return FRACAS_OK;
}

fracas_err fracas_scheduler_add(fracas_scheduler *scheduler, const fracas_index_row *row,
                                size_t count)
{
    OWNED int64_t *replica = malloc((count + 1) * sizeof *replica);
    if (!replica) return fracas_no_memory("the plan");
    for (size_t from = 0, to; from < count; from = to) {
        for (to = from; to < count && row[to].point == row[from].point; to++)
            ;
        TRY(add_point(scheduler, row + from, to - from, replica));
    }
    return FRACAS_OK;
}

fracas_err fracas_scheduler_create(const fracas_index_row *row, size_t count,
                                   const fracas_scheduler_options *options,
                                   fracas_scheduler **scheduler)
{
    OWN(fracas_scheduler) s = calloc(1, sizeof *s);
    if (!s) return fracas_no_memory("the plan");
    s->options = *options;
    s->state = options->seed;
    s->end = &s->again;
    s->worker = calloc(options->workers, sizeof *s->worker);
    if (!s->worker) return fracas_no_memory("the workers");
    TRY(fracas_backlog_create(options->cost, options->first, options->npoints, &s->backlog));
    TRY(fracas_scheduler_add(s, row, count));
    *scheduler = s;
    s = NULL;
    return FRACAS_OK;
}

/* ---- tasks of workers ---- */

static task *drop_held(worker_state *w, size_t i)
{
    task *t = w->held[i].task;
    w->nheld--;
    memmove(w->held + i, w->held + i + 1, (w->nheld - i) * sizeof *w->held);
    t->held--;
    return t;
}

static task *drop_memory(worker_state *w)
{
    note *n = w->memory;
    task *t = n->task;
    w->memory = n->next;
    free(n);
    t->kept--;
    return t;
}

void fracas_scheduler_destroy(fracas_scheduler *scheduler)
{
    if (!scheduler) return;
    while (scheduler->again) free(take_again(scheduler));
    for (size_t i = 0; scheduler->worker && i < scheduler->options.workers; i++) {
        worker_state *w = &scheduler->worker[i];
        while (w->nheld) destroy_if_unused(drop_held(w, 0));
        while (w->memory) destroy_if_unused(drop_memory(w));
    }
    fracas_backlog_destroy(scheduler->backlog);
    free(scheduler->worker);
    free(scheduler);
}

/* ---- the next lease ---- */

static size_t smaller(size_t a, size_t b)
{
    return a < b ? a : b;
}

/* Predicted seconds until the worker has computed its tasks; NAN while nothing is measured. */
static double left(const fracas_scheduler *s, const worker_state *w, double now)
{
    double seconds = 0;
    for (size_t h = 0; h < w->nheld; h++) {
        const double one = predicted(s, w->held[h].task);
        seconds += h ? one : fmax(one - (now - w->held[h].began), 0);
    }
    return seconds;
}

/* Workers predicted to be free within half the time of a batch of the point, or free now while
 * nothing is measured: at least one. */
static size_t free_workers(const fracas_scheduler *s, size_t point, double now)
{
    const bool measured = fracas_backlog_measured(s->backlog);
    const double within = fracas_backlog_estimate(s->backlog, point) * (double)s->options.width / 2;
    size_t count = 0;
    for (size_t i = 0; i < s->options.workers; i++) {
        const worker_state *w = &s->worker[i];
        count += !w->lost && (measured ? left(s, w, now) <= within : w->nheld == 0);
    }
    return count ? count : 1;
}

/* The formula at fracas_scheduler_next. */
static size_t choose_count(const fracas_scheduler *s, size_t point, double now)
{
    const size_t width = s->options.width, there = fracas_backlog_waiting(s->backlog, point),
                 workers = s->options.workers;
    const double one = fracas_backlog_estimate(s->backlog, point), parts = 2 * (double)workers;
    double most = 0;
    if (fracas_backlog_measured(s->backlog))
        most = one > 0 ? fmin(s->options.seconds, fracas_backlog_work(s->backlog) / parts) / one
                       : (double)s->waiting / parts;
    const size_t batches = (size_t)fmin(most, FRACAS_LEASE_MAX) / width * width;
    if (batches) return smaller(there, batches);
    const size_t shared = s->waiting < workers * width ? free_workers(s, point, now) : 1;
    return smaller(there, smaller(width, (s->waiting + shared - 1) / shared));
}

static size_t shuffled_most(const fracas_scheduler *s)
{
    return s->options.seconds > 0 ? 2 * s->options.width : s->options.width;
}

/* From the backlog, which is not empty; NULL without memory. */
static task *cut(fracas_scheduler *s, double now)
{
    size_t point, count;
    if (s->options.shuffle) {
        point = fracas_backlog_any(s->backlog, &s->state);
        count = smaller(fracas_backlog_waiting(s->backlog, point),
                        1 + (size_t)(fracas_backlog_random(&s->state) % shuffled_most(s)));
    } else {
        point = fracas_backlog_longest(s->backlog);
        count = choose_count(s, point, now);
    }
    task *t = create_task(s, point, NULL, count); /* first: without memory no replica is lost */
    if (!t) return NULL;
    memcpy(t->replica, fracas_backlog_take(s->backlog, point, count), count * sizeof *t->replica);
    s->waiting -= count;
    return t;
}

/* Time from which a task is overdue, had by one worker since `since` and `kept` seconds in its
 * memory at most; INFINITY: never. After each failure elsewhere it has the time of another lease:
 * this worker's attempt must end alone, or two would take turns with an endless one. */
static double overdue_at(const fracas_scheduler *s, const task *t, double since, double kept)
{
    const double expected = predicted(s, t);
    if (t->held + t->kept > 1 || t->done || isnan(expected)) return INFINITY;
    return since + kept + fmax(OVERDUE_LEAST, OVERDUE * expected) +
           (t->returned ? (double)t->returned * limit_of(s, t) : 0);
}

/* The worker's first overdue task, at time *at; NULL if none ever is. */
static task *first_overdue(const fracas_scheduler *s, const worker_state *w, double *at)
{
    task *first = NULL;
    *at = INFINITY;
    for (size_t h = 0; h < w->nheld; h++) {
        const double then = overdue_at(s, w->held[h].task, w->held[h].began, 0);
        if (then < *at) *at = then, first = w->held[h].task;
    }
    for (const note *n = w->memory; n; n = n->next) {
        const double then = overdue_at(s, n->task, n->since, s->options.memory);
        if (then < *at) *at = then, first = n->task;
    }
    return first;
}

/* The formula at fracas_scheduler_next, for a worker that has its lease. */
static size_t choose_parts(const fracas_scheduler *s, const task *t)
{
    const size_t workers = s->options.workers;
    size_t busy = t->attempts ? workers : s->waiting;
    if (s->options.parts) return s->options.parts;
    for (size_t i = 0; i < workers && busy < workers; i++) busy += s->worker[i].nheld > 0;
    return busy < workers ? workers / busy : 1;
}

static void lease_out(fracas_scheduler *s, worker_state *w, task *t, double now,
                      fracas_lease *lease)
{
    s->uncomputed += !t->held && !t->kept;
    t->held++;
    w->held[w->nheld++] = (slot){t, now};
    lease->id = t->id;
    lease->point = t->point;
    lease->count = t->count;
    lease->isolated = t->isolated;
    lease->limit = limit_of(s, t);
    lease->parts = choose_parts(s, t);
    memcpy(lease->replica, t->replica, t->count * sizeof *t->replica);
}

fracas_err fracas_scheduler_next(fracas_scheduler *scheduler, size_t worker, double now,
                                 fracas_lease *lease, bool *given)
{
    worker_state *w = &scheduler->worker[worker];
    const size_t spare = scheduler->options.workers * scheduler->options.width;
    *given = false;
    w->lost = false;
    if (w->nheld >= (scheduler->waiting > spare ? FRACAS_LEASES_HELD : 1)) return FRACAS_OK;
    if (!scheduler->waiting) return FRACAS_OK;
    task *t = scheduler->again ? take_again(scheduler) : cut(scheduler, now);
    if (!t) return fracas_no_memory("a lease");
    lease_out(scheduler, w, t, now, lease);
    *given = true;
    return FRACAS_OK;
}

void fracas_scheduler_overdue(fracas_scheduler *scheduler, size_t worker, double now,
                              fracas_lease *lease, size_t *late, bool *given)
{
    worker_state *w = &scheduler->worker[worker];
    *given = false;
    if (w->nheld || scheduler->waiting) return;
    task *worst = NULL;
    double first = now;
    for (size_t i = 0; i < scheduler->options.workers; i++) {
        double at;
        task *t = i == worker ? NULL : first_overdue(scheduler, &scheduler->worker[i], &at);
        if (!t || at >= first) continue;
        first = at;
        worst = t;
        *late = i;
    }
    if (!worst) return;
    lease_out(scheduler, w, worst, now, lease);
    *given = true;
}

/* ---- ends of leases ---- */

static fracas_err find(const fracas_scheduler *s, size_t worker, uint64_t id, size_t *place)
{
    const worker_state *w = &s->worker[worker];
    for (*place = 0; *place < w->nheld; (*place)++)
        if (w->held[*place].task->id == id) return FRACAS_OK;
    return fracas_fail(FRACAS_BUG, "worker %zu returned lease %llu, which it did not hold", worker,
                       (unsigned long long)id);
}

/* Takes a lease from the worker, whose lease ahead begins to run. */
static task *release(fracas_scheduler *s, size_t worker, size_t place, double now)
{
    worker_state *w = &s->worker[worker];
    const bool was_open = is_open(w->held[place].task);
    task *t = drop_held(w, place);
    s->uncomputed -= was_open && !t->held;
    if (place == 0 && w->nheld) w->held[0].began = now;
    return t;
}

/* Into the worker's memory; owns the note. */
static void keep(fracas_scheduler *s, size_t worker, task *t, double now, note *n)
{
    if (!t->kept && !t->done) {
        s->uncomputed -= t->held > 0;
        s->count.memory += (int64_t)t->count;
        s->computed += cost_of(s, t);
    }
    t->kept++;
    *n = (note){t, now, s->worker[worker].memory};
    s->worker[worker].memory = n;
}

fracas_err fracas_scheduler_computed(fracas_scheduler *scheduler, size_t worker, uint64_t id,
                                     double now, double seconds)
{
    size_t place;
    TRY(find(scheduler, worker, id, &place));
    note *n = malloc(sizeof *n);
    if (!n) return fracas_no_memory("a lease");
    task *t = release(scheduler, worker, place, now);
    fracas_backlog_measure(scheduler->backlog, t->point, t->count, seconds);
    keep(scheduler, worker, t, now, n);
    return FRACAS_OK;
}

/* Parts of a failed lease: computed, the two halves of the batch at fault, not begun. */
enum { KEPT, HALF, OTHER_HALF, REST, NPARTS };
typedef struct {
    task *part[NPARTS];
    note *kept; /* for the computed part */
} pieces;

static fracas_err split(fracas_scheduler *s, const task *t, size_t kept, size_t count, pieces *made)
{
    const size_t at[NPARTS + 1] = {0, kept, kept + (count + 1) / 2, kept + count, t->count};
    made->kept = kept ? malloc(sizeof *made->kept) : NULL;
    bool good = !kept || made->kept;
    for (size_t i = 0; i < NPARTS; i++) {
        const size_t size = at[i + 1] - at[i];
        task *part = size ? create_task(s, t->point, t->replica + at[i], size) : NULL;
        if (part) part->isolated = t->isolated && i != REST;
        good = good && (part || !size);
        made->part[i] = part;
    }
    if (good) return FRACAS_OK;
    for (size_t i = 0; i < NPARTS; i++) free(made->part[i]);
    free(made->kept);
    return fracas_no_memory("a lease");
}

/* One realization alone. */
static void try_again(fracas_scheduler *s, task *t, bool *final)
{
    *final = ++t->attempts >= FRACAS_ATTEMPTS_MAX;
    if (*final) {
        s->count.failed++;
        s->computed += cost_of(s, t);
        free(t);
    } else {
        wait_last(s, t); /* behind the other failed leases: the cause may be gone by then */
    }
}

/* The batch at fault is tried in two halves, or was one realization alone. */
static void bisect(fracas_scheduler *s, size_t worker, double now, size_t count, const pieces *made,
                   bool *final)
{
    if (made->part[KEPT]) keep(s, worker, made->part[KEPT], now, made->kept);
    if (made->part[REST]) wait_first(s, made->part[REST]);
    if (made->part[OTHER_HALF]) wait_first(s, made->part[OTHER_HALF]);
    if (count > 1) wait_first(s, made->part[HALF]);
    else try_again(s, made->part[HALF], final); /* this was its attempt */
}

fracas_err fracas_scheduler_failed(fracas_scheduler *scheduler, size_t worker, uint64_t id,
                                   double now, size_t kept, size_t count, fracas_lease *lease,
                                   bool *final)
{
    size_t place;
    pieces made = {0};
    TRY(find(scheduler, worker, id, &place));
    task *t = scheduler->worker[worker].held[place].task;
    if (!count || kept > t->count || count > t->count - kept)
        return fracas_fail(
            FRACAS_BUG,
            "worker %zu says that of a lease of %zu realizations %zu are kept and %zu failed",
            worker, t->count, kept, count);
    const bool alone = t->held == 1 && is_open(t), single = t->count == 1;
    if (alone && !single) TRY(split(scheduler, t, kept, count, &made));
    release(scheduler, worker, place, now);
    *final = false;
    *lease = (fracas_lease){.id = t->id, .point = t->point, .count = alone ? count : 0};
    memcpy(lease->replica, t->replica + kept, lease->count * sizeof *t->replica);
    if (!alone) {
        t->returned++;
        destroy_if_unused(t);
    } else if (single) {
        try_again(scheduler, t, final);
    } else {
        free(t);
        bisect(scheduler, worker, now, count, &made, final);
    }
    return FRACAS_OK;
}

void fracas_scheduler_durable(fracas_scheduler *scheduler, size_t worker)
{
    worker_state *w = &scheduler->worker[worker];
    while (w->memory) {
        task *t = drop_memory(w);
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
    w->lost = true;
    while (w->nheld) {
        const bool was_open = is_open(w->held[w->nheld - 1].task);
        task *t = drop_held(w, w->nheld - 1);
        t->isolated = true;
        if (was_open && !t->held) {
            scheduler->uncomputed--;
            wait_first(scheduler, t);
        } else {
            destroy_if_unused(t);
        }
    }
    while (w->memory) {
        task *t = drop_memory(w);
        if (t->kept || t->done) {
            destroy_if_unused(t);
            continue;
        }
        scheduler->count.memory -= (int64_t)t->count;
        scheduler->computed -= cost_of(scheduler, t);
        if (t->held) scheduler->uncomputed++; /* a copy runs */
        else wait_first(scheduler, t);
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

double fracas_scheduler_predicted(const fracas_scheduler *scheduler, size_t worker, double now)
{
    if (!fracas_backlog_measured(scheduler->backlog)) return NAN;
    const double seconds = left(scheduler, &scheduler->worker[worker], now);
    if (scheduler->again) return seconds + predicted(scheduler, scheduler->again);
    const size_t longest = fracas_backlog_longest(scheduler->backlog);
    if (longest == SIZE_MAX) return seconds;
    const size_t count = scheduler->options.shuffle ? shuffled_most(scheduler)
                                                    : choose_count(scheduler, longest, now);
    return seconds + fracas_backlog_estimate(scheduler->backlog, longest) * (double)count;
}

fracas_counts fracas_scheduler_count(const fracas_scheduler *scheduler)
{
    fracas_counts count = scheduler->count;
    count.work = scheduler->cost > 0 ? scheduler->computed / scheduler->cost : 1;
    return count;
}
