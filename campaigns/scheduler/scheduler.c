#include "campaigns/scheduler/scheduler.h"

#include <stdlib.h>
#include <string.h>

#define NONE SIZE_MAX

/* A lease is in one list at a time: the waiting one, or the memory of a worker. */
typedef struct {
    fracas_lease lease; /* id = index in the array */
    double cost;
    int64_t attempts;   /* of a single realization */
    size_t next;
} entry;

typedef struct {
    size_t first, last;
} list;

typedef struct {
    size_t held[FRACAS_LEASES_HELD], nheld;
    list memory;
} worker_state;

struct fracas_scheduler {
    fracas_scheduler_options options;
    uint64_t state; /* of the shuffle */
    entry *entry;
    size_t nentry, room;
    list waiting;
    size_t nwaiting, nheld; /* leases */
    worker_state *worker;
    size_t nworker;
    fracas_scheduler_counts count;
    double cost, computed; /* predicted, of all leases and of those computed or failed for good */
};

static void list_append(fracas_scheduler *scheduler, list *to, size_t id)
{
    scheduler->entry[id].next = NONE;
    if (to->first == NONE)
        to->first = id;
    else
        scheduler->entry[to->last].next = id;
    to->last = id;
}

static size_t list_take(fracas_scheduler *scheduler, list *from)
{
    size_t id = from->first;
    if (id != NONE) from->first = scheduler->entry[id].next;
    return id;
}

static void wait_last(fracas_scheduler *scheduler, size_t id)
{
    list_append(scheduler, &scheduler->waiting, id);
    scheduler->nwaiting++;
}

static void wait_first(fracas_scheduler *scheduler, size_t id)
{
    if (scheduler->waiting.first == NONE) scheduler->waiting.last = id;
    scheduler->entry[id].next = scheduler->waiting.first;
    scheduler->waiting.first = id;
    scheduler->nwaiting++;
}

/* ---- the leases of a plan ---- */

/* splitmix64 (Steele, Lea and Flood 2014): only orders work, so it need not be one of the sampler's streams. */
static uint64_t next_random(uint64_t *state)
{
    uint64_t x = (*state += 0x9e3779b97f4a7c15u);
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

static void shuffle_rows(const fracas_index_row **row, size_t count, uint64_t *state)
{
    for (size_t i = count; i > 1; i--) {
        size_t j = (size_t)(next_random(state) % i);
        const fracas_index_row *swap = row[i - 1];
        row[i - 1] = row[j];
        row[j] = swap;
    }
}

static int longest_first(const void *a, const void *b)
{
    const entry *x = a, *y = b;
    if (x->cost != y->cost) return x->cost < y->cost ? 1 : -1;
    return x->lease.id < y->lease.id ? -1 : 1; /* plan order: qsort need not be stable */
}

/* Cuts planned rows into leases of one point each, which wait last. */
static void make_leases(fracas_scheduler *scheduler, const fracas_index_row **row, size_t count)
{
    const fracas_scheduler_options *options = &scheduler->options;
    const size_t first = scheduler->nentry;
    for (size_t from = 0, to; from < count; from = to) {
        for (to = from; to < count && row[to]->point == row[from]->point; to++)
            ;
        if (options->shuffle) shuffle_rows(row + from, to - from, &scheduler->state);
        entry *open = NULL;
        for (size_t i = from; i < to; i++) {
            bool alone = row[i]->attempts > 0;
            if (!open || alone || open->lease.count == options->width) {
                open = &scheduler->entry[scheduler->nentry];
                *open = (entry){.lease = {.id = scheduler->nentry++, .point = row[i]->point},
                                .attempts = row[i]->attempts};
            }
            open->lease.replica[open->lease.count++] = row[i]->replica;
            open->cost = options->cost[open->lease.point] * (double)open->lease.count;
            if (alone) open = NULL;
        }
    }
    if (options->shuffle)
        for (size_t i = first; i < scheduler->nentry; i++)
            scheduler->entry[i].cost = (double)(next_random(&scheduler->state) >> 11);
    if (scheduler->nentry > first) qsort(scheduler->entry + first, scheduler->nentry - first, sizeof *scheduler->entry, longest_first);
    for (size_t i = first; i < scheduler->nentry; i++) {
        scheduler->entry[i].lease.id = i;
        scheduler->cost += scheduler->entry[i].cost;
        wait_last(scheduler, i);
    }
}

/* Counts the rows and picks those to do. */
static size_t select_planned(fracas_scheduler *scheduler, const fracas_index_row *row, size_t count,
                             const fracas_index_row **planned)
{
    size_t nplanned = 0;
    for (size_t i = 0; i < count; i++) {
        if (row[i].status == FRACAS_DONE)
            scheduler->count.done++;
        else if (row[i].status == FRACAS_FAILED_ROW || row[i].status == FRACAS_QUARANTINED)
            scheduler->count.failed++;
        else
            planned[nplanned++] = &row[i];
    }
    scheduler->count.total += (int64_t)count;
    return nplanned;
}

fracas_err fracas_scheduler_create(const fracas_index_row *row, size_t count, const fracas_scheduler_options *options,
                                   fracas_scheduler **scheduler)
{
    fracas_scheduler *s = calloc(1, sizeof *s);
    if (s) s->worker = malloc(options->workers * sizeof *s->worker);
    if (!s || !s->worker) {
        fracas_scheduler_destroy(s);
        return fracas_no_memory("the plan");
    }
    s->options = *options;
    s->state = options->seed;
    s->nworker = options->workers;
    s->waiting = (list){NONE, NONE};
    for (size_t w = 0; w < s->nworker; w++) s->worker[w] = (worker_state){.memory = {NONE, NONE}};
    fracas_err err = fracas_scheduler_add(s, row, count);
    if (err) fracas_scheduler_destroy(s);
    else *scheduler = s;
    return err;
}

fracas_err fracas_scheduler_add(fracas_scheduler *scheduler, const fracas_index_row *row, size_t count)
{
    const fracas_index_row **planned = malloc((count + 1) * sizeof *planned);
    /* In the worst case every lease is split into its realizations: room for all, so that no failure
     * needs memory when it is scarce. */
    const size_t room = scheduler->room + 2 * count;
    entry *bigger = planned ? realloc(scheduler->entry, (room + 1) * sizeof *bigger) : NULL;
    if (bigger) {
        scheduler->entry = bigger;
        scheduler->room = room;
        make_leases(scheduler, planned, select_planned(scheduler, row, count, planned));
    }
    free(planned);
    return bigger ? FRACAS_OK : fracas_no_memory("the plan");
}

void fracas_scheduler_destroy(fracas_scheduler *scheduler)
{
    if (!scheduler) return;
    free(scheduler->entry);
    free(scheduler->worker);
    free(scheduler);
}

/* ---- its life ---- */

bool fracas_scheduler_next(fracas_scheduler *scheduler, size_t worker, fracas_lease *lease)
{
    worker_state *w = &scheduler->worker[worker];
    size_t enough = scheduler->nwaiting > scheduler->nworker ? FRACAS_LEASES_HELD : 1;
    if (!scheduler->nwaiting || w->nheld >= enough) return false;
    size_t id = list_take(scheduler, &scheduler->waiting);
    scheduler->nwaiting--;
    scheduler->nheld++;
    w->held[w->nheld++] = id;
    *lease = scheduler->entry[id].lease;
    return true;
}

/* Takes lease `id` out of the worker's hands. */
static fracas_err let_go(fracas_scheduler *scheduler, size_t worker, uint64_t id)
{
    worker_state *w = &scheduler->worker[worker];
    for (size_t i = 0; i < w->nheld; i++) {
        if (w->held[i] != id) continue;
        w->held[i] = w->held[--w->nheld];
        scheduler->nheld--;
        return FRACAS_OK;
    }
    return fracas_fail(FRACAS_BUG, "worker %zu returned lease %llu, which it did not hold", worker,
                       (unsigned long long)id);
}

fracas_err fracas_scheduler_computed(fracas_scheduler *scheduler, size_t worker, uint64_t id)
{
    TRY(let_go(scheduler, worker, id));
    list_append(scheduler, &scheduler->worker[worker].memory, (size_t)id);
    scheduler->count.memory += (int64_t)scheduler->entry[id].lease.count;
    scheduler->computed += scheduler->entry[id].cost;
    return FRACAS_OK;
}

fracas_err fracas_scheduler_failed(fracas_scheduler *scheduler, size_t worker, uint64_t id, fracas_lease *lease,
                                   bool *final)
{
    TRY(let_go(scheduler, worker, id));
    entry *failed = &scheduler->entry[id];
    *lease = failed->lease;
    *final = false;
    if (lease->count > 1) {
        for (size_t i = lease->count; i-- > 0;) { /* backwards, so that the first comes first */
            size_t single = scheduler->nentry++;
            scheduler->entry[single] = (entry){.lease = {.id = single, .point = lease->point, .count = 1},
                                                 .cost = failed->cost / (double)lease->count};
            scheduler->entry[single].lease.replica[0] = lease->replica[i];
            wait_first(scheduler, single);
        }
    } else if (++failed->attempts >= FRACAS_ATTEMPTS_MAX) {
        *final = true;
        scheduler->count.failed++;
        scheduler->computed += failed->cost;
    } else {
        wait_last(scheduler, (size_t)id); /* the cause may be gone by then */
    }
    return FRACAS_OK;
}

void fracas_scheduler_durable(fracas_scheduler *scheduler, size_t worker)
{
    list *memory = &scheduler->worker[worker].memory;
    for (size_t id; (id = list_take(scheduler, memory)) != NONE;) {
        int64_t count = (int64_t)scheduler->entry[id].lease.count;
        scheduler->count.memory -= count;
        scheduler->count.done += count;
    }
}

void fracas_scheduler_lost(fracas_scheduler *scheduler, size_t worker)
{
    worker_state *w = &scheduler->worker[worker];
    while (w->nheld) {
        wait_first(scheduler, w->held[--w->nheld]);
        scheduler->nheld--;
    }
    for (size_t id; (id = list_take(scheduler, &w->memory)) != NONE;) {
        scheduler->count.memory -= (int64_t)scheduler->entry[id].lease.count;
        scheduler->computed -= scheduler->entry[id].cost;
        wait_first(scheduler, id);
    }
}

bool fracas_scheduler_idles(const fracas_scheduler *scheduler, size_t worker)
{
    return scheduler->worker[worker].nheld == 0;
}

bool fracas_scheduler_keeps(const fracas_scheduler *scheduler, size_t worker)
{
    return scheduler->worker[worker].memory.first != NONE;
}

bool fracas_scheduler_computed_all(const fracas_scheduler *scheduler)
{
    return !scheduler->nwaiting && !scheduler->nheld;
}

fracas_scheduler_counts fracas_scheduler_count(const fracas_scheduler *scheduler)
{
    fracas_scheduler_counts count = scheduler->count;
    count.work = scheduler->cost > 0 ? scheduler->computed / scheduler->cost : 1;
    return count;
}
