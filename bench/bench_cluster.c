/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A run on a simulated cluster: the real scheduler (campaigns/scheduler/lease/scheduler.h)
 * gives leases to workers that are simulated, by a rank 0 that does one thing at a time, through
 * ranks that poll, with segments that a filesystem takes so many of a second.
 *
 *   bench_cluster [name=value ...]          the names and what they mean: bench_cluster help
 *
 * Prints one line for each number of workers. docs/results/scheduling.md has the figures, and where
 * the costs come from. */
#include "base/isa.h"
#include "bench/bench.h"
#include "bench/synthetic_load.h"

#include "campaigns/scheduler/lease/scheduler.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

/* ---- what is asked ---- */

typedef struct {
    double work;                                        /* s of realizations for each worker */
    double task, share, longer;                         /* s of one, as in bench_scheduler */
    double lease, age;                                  /* s: --lease-time, --segment-age */
    double message, give, give_row, commit, commit_row; /* s of rank 0 */
    double fork, batch,
        row; /* s of a worker for a lease, a batch, a realization beside computing it */
    double write, write_row, files; /* s of a worker to write a segment; files/s that the filesystem
                                       takes from all, 0: no bound */
    double poll;                    /* s, longest pause of a rank that looks for messages */
    double start, merge_row; /* s of mpirun's start and end for any number of workers; s of the
                                merge for a realization */
    double width, points;
} costs;

static const struct {
    const char *name, *doc;
    size_t at;
    double value;
} setting[] = {
#define SETTING(name, value, doc)                \
    {                                            \
#name, doc, offsetof(costs, name), value \
    }
    SETTING(work, 600, "s of realizations for each worker"),
    SETTING(task, 1, "s of a realization"),
    SETTING(share, 0, "share of realizations that take `longer`"),
    SETTING(longer, 10, "s of those"),
    SETTING(lease, 1, "s that a lease should take"),
    SETTING(age, 5, "s after which a segment is written"),
    SETTING(message, 30e-6, "s of rank 0 for a message"),
    SETTING(give, 60e-6, "s of rank 0 for a lease"),
    SETTING(give_row, 2e-6, "... and each realization of it"),
    SETTING(commit, 1e-3, "s of rank 0 for a segment"),
    SETTING(commit_row, 3.5e-6, "... and each realization of it"),
    SETTING(fork, 1.5e-3, "s of a worker for a lease"),
    SETTING(batch, 0.1e-3, "... each batch of it"),
    SETTING(row, 5e-6, "... and each realization"),
    SETTING(write, 4e-3, "s of a worker for a segment"),
    SETTING(write_row, 8e-6, "... and each realization of it"),
    SETTING(files, 0, "segments/s that the filesystem takes from all workers; 0: any number"),
    SETTING(poll, 8e-3, "s, the longest pause of a rank that waits for messages"),
    SETTING(start, 0.4, "s of mpirun's start and end"),
    SETTING(merge_row, 3e-6, "s of the merge for a realization"),
    SETTING(width, 8, "realizations of a batch"),
    SETTING(points, 1, "points of the campaign"),
};
enum { NSETTINGS = sizeof setting / sizeof *setting, MOST_TIMES = 1000000 };

static double times[MOST_TIMES]; /* s of realizations that were measured: times=FILE */
static size_t ntimes;

static double *value_of(costs *c, size_t i)
{
    return (double *)(void *)((char *)c + setting[i].at);
}

static void read_times(const char *path)
{
    FILE *in = fopen(path, "r");
    while (in && ntimes < MOST_TIMES && fscanf(in, "%lf", &times[ntimes]) == 1 &&
           times[ntimes] >= 0)
        ntimes++;
    const bool good = in && feof(in) && ntimes > 0;
    if (in) fclose(in);
    if (!good) demand(fracas_fail(FRACAS_USAGE, "%s is no list of times [s], one a line", path));
}

/* ---- the simulated world ---- */

typedef enum { HEAR_COMPUTED, HEAR_SEGMENT, LEAD_IS_FREE, GET_LEASE, COMPUTED, WRITTEN } event_kind;

typedef struct {
    double time;
    uint64_t order; /* among those at the same time */
    event_kind kind;
    size_t worker;
    uint64_t lease;
    double seconds; /* duration of the lease */
    size_t rows;    /* in a lease or a segment */
} event;

typedef struct {
    uint64_t lease[FRACAS_LEASES_HELD];
    double seconds[FRACAS_LEASES_HELD]; /* their durations */
    size_t rows[FRACAS_LEASES_HELD], nheld;
    bool computing;
    size_t kept;   /* realizations in its memory */
    double oldest; /* time of the first of them */
    bool writing;
} worker;

typedef struct {
    const costs *c;
    fracas_scheduler *scheduler;
    double *cost; /* one realization of each point: the scheduler's */
    worker *worker;
    size_t workers;
    event *heap;
    size_t nheap, room;
    uint64_t order, dice;
    double now, free_at; /* free_at: when rank 0 can turn to the next message */
    event *queue;        /* messages that wait for rank 0, a ring */
    size_t first, waiting, queue_room;
    double disk;   /* when the filesystem takes the next segment */
    double busy;   /* s of rank 0 */
    double policy; /* s that this program spent in the scheduler itself */
    size_t leases, commits, messages, committed, total;
    double delay; /* s that messages waited for rank 0, sum */
    bool stopped;
} world;

static double any(world *w) /* 0 to 1 */
{
    uint64_t x = (w->dice += 0x9e3779b97f4a7c15u);
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return (double)((x ^ (x >> 31)) >> 11) * 0x1p-53;
}

static bool earlier(const event *a, const event *b)
{
    return a->time < b->time || (a->time == b->time && a->order < b->order);
}

static void push(world *w, event e)
{
    demand(fracas_grow(&w->heap, sizeof *w->heap, w->nheap, &w->room, "the events"));
    e.order = w->order++;
    size_t i = w->nheap++;
    for (; i && earlier(&e, &w->heap[(i - 1) / 2]); i = (i - 1) / 2)
        w->heap[i] = w->heap[(i - 1) / 2];
    w->heap[i] = e;
}

static event pop(world *w)
{
    const event first = w->heap[0], e = w->heap[--w->nheap];
    size_t i = 0, child;
    for (; (child = 2 * i + 1) < w->nheap; i = child) {
        if (child + 1 < w->nheap && earlier(&w->heap[child + 1], &w->heap[child])) child++;
        if (!earlier(&w->heap[child], &e)) break;
        w->heap[i] = w->heap[child];
    }
    w->heap[i] = e;
    return first;
}

/* ---- workers ---- */

static double seconds_of_lease(const world *w, const fracas_lease *lease)
{
    const costs *c = w->c;
    const synthetic_load load = {c->task, c->share, c->longer};
    double sum = c->fork + c->batch * ceil((double)lease->count / c->width) +
                 c->row * (double)lease->count;
    for (size_t i = 0; i < lease->count; i++)
        sum += ntimes ? times[(size_t)lease->replica[i] % ntimes]
                      : synthetic_seconds(&load, lease->point, lease->replica[i]);
    return sum;
}

static void start_next(world *w, size_t n)
{
    worker *me = &w->worker[n];
    if (me->computing || !me->nheld) return;
    me->computing = true;
    push(w, (event){.time = w->now + me->seconds[0],
                    .kind = COMPUTED,
                    .worker = n,
                    .lease = me->lease[0],
                    .seconds = me->seconds[0],
                    .rows = me->rows[0]});
}

static void get_lease(world *w, const event *e)
{
    worker *me = &w->worker[e->worker];
    me->lease[me->nheld] = e->lease;
    me->seconds[me->nheld] = e->seconds;
    me->rows[me->nheld++] = e->rows;
    start_next(w, e->worker);
}

/* The filesystem takes one segment after another, as fast as it can. */
static void write_segment(world *w, size_t n)
{
    worker *me = &w->worker[n];
    if (me->writing || !me->kept) return;
    me->writing = true;
    const double from = fmax(w->now, w->disk);
    if (w->c->files > 0) w->disk = from + 1 / w->c->files;
    push(w, (event){.time = (w->c->files > 0 ? from : w->now) + w->c->write +
                            w->c->write_row * (double)me->kept,
                    .kind = WRITTEN,
                    .worker = n,
                    .rows = me->kept});
    me->kept = 0;
}

/* A message reaches rank 0 when this one, which sleeps while nothing comes, looks again. */
static void tell_lead(world *w, event e, event_kind kind)
{
    const bool idle = w->free_at <= w->now;
    e.kind = kind;
    e.time = w->now + (idle ? any(w) * w->c->poll : 0);
    push(w, e);
}

static void computed(world *w, const event *e)
{
    worker *me = &w->worker[e->worker];
    if (w->stopped) return; /* a copy of what another has computed: it is killed */
    me->nheld--;
    memmove(me->lease, me->lease + 1, me->nheld * sizeof *me->lease);
    memmove(me->seconds, me->seconds + 1, me->nheld * sizeof *me->seconds);
    memmove(me->rows, me->rows + 1, me->nheld * sizeof *me->rows);
    me->computing = false;
    if (!me->kept) me->oldest = w->now;
    me->kept += e->rows;
    tell_lead(w, *e, HEAR_COMPUTED);
    start_next(w, e->worker);
    if (w->now - me->oldest >= w->c->age) write_segment(w, e->worker);
}

/* ---- rank 0 ---- */

static void offer(world *w, size_t n)
{
    static fracas_lease lease;
    for (;;) {
        bool given;
        const double began = seconds_of(CLOCK_MONOTONIC);
        demand(fracas_scheduler_next(w->scheduler, n, w->free_at, &lease, &given));
        w->policy += seconds_of(CLOCK_MONOTONIC) - began;
        if (!given) return;
        w->leases++;
        w->free_at += w->c->give + w->c->give_row * (double)lease.count;
        push(w, (event){.time = w->free_at + any(w) * w->c->poll,
                        .kind = GET_LEASE,
                        .worker = n,
                        .lease = lease.id,
                        .seconds = seconds_of_lease(w, &lease),
                        .rows = (size_t)lease.count});
    }
}

static void hear(world *w, const event *e)
{
    const double began = w->now;
    w->messages++;
    w->delay += w->now - e->time;
    w->free_at = w->now + w->c->message;
    if (e->kind == HEAR_COMPUTED) {
        demand(fracas_scheduler_computed(w->scheduler, e->worker, e->lease, w->now, e->seconds));
        offer(w, e->worker);
    } else {
        w->commits++;
        w->committed += e->rows;
        w->free_at += w->c->commit + w->c->commit_row * (double)e->rows;
        if (!w->worker[e->worker].kept) fracas_scheduler_durable(w->scheduler, e->worker);
    }
    w->busy += w->free_at - began;
    if (w->stopped || !fracas_scheduler_computed_all(w->scheduler)) return;
    w->stopped = true;
    for (size_t n = 0; n < w->workers; n++) write_segment(w, n);
}

/* In the order in which they came, one at a time. */
static void arrive(world *w, const event *e)
{
    if (w->waiting == w->queue_room) {
        const size_t room = 2 * w->queue_room + 1024;
        event *queue = malloc(room * sizeof *queue);
        if (!queue) demand(fracas_no_memory("the messages"));
        for (size_t i = 0; i < w->waiting; i++) queue[i] = w->queue[(w->first + i) % w->queue_room];
        free(w->queue);
        w->queue = queue;
        w->queue_room = room;
        w->first = 0;
    }
    w->queue[(w->first + w->waiting++) % w->queue_room] = *e;
    if (w->waiting == 1) push(w, (event){.time = fmax(w->now, w->free_at), .kind = LEAD_IS_FREE});
}

static void serve_next(world *w)
{
    const event e = w->queue[w->first];
    w->first = (w->first + 1) % w->queue_room;
    w->waiting--;
    hear(w, &e);
    if (w->waiting) push(w, (event){.time = w->free_at, .kind = LEAD_IS_FREE});
}

/* ---- a run ---- */

static void make(world *w, const costs *c, size_t workers, double mean)
{
    const size_t points = (size_t)c->points,
                 each = (size_t)fmax(1, c->work * (double)workers / mean / c->points);
    double *cost = malloc(points * sizeof *cost);
    fracas_index_row *row = malloc(points * each * sizeof *row);
    *w = (world){.c = c,
                 .workers = workers,
                 .worker = calloc(workers, sizeof *w->worker),
                 .total = points * each,
                 .dice = 1,
                 .cost = cost};
    if (!cost || !row || !w->worker) demand(fracas_no_memory("the campaign"));
    for (size_t p = 0; p < points; p++) cost[p] = 1;
    for (size_t i = 0; i < w->total; i++)
        row[i] = (fracas_index_row){i / each, (int64_t)(i % each), FRACAS_PLANNED, 0};
    const fracas_scheduler_options options = {.cost = cost,
                                              .npoints = points,
                                              .workers = workers,
                                              .width = (size_t)c->width,
                                              .seconds = c->lease};
    demand(fracas_scheduler_create(row, w->total, &options, &w->scheduler));
    free(row);
}

static double run(world *w)
{
    for (size_t n = 0; n < w->workers; n++) offer(w, n);
    while (w->nheap) {
        const event e = pop(w);
        w->now = e.time;
        switch (e.kind) {
        case GET_LEASE: get_lease(w, &e); break;
        case COMPUTED: computed(w, &e); break;
        case WRITTEN:
            w->worker[e.worker].writing = false;
            tell_lead(w, e, HEAR_SEGMENT);
            if (w->stopped) write_segment(w, e.worker);
            break;
        case LEAD_IS_FREE: serve_next(w); break;
        default: arrive(w, &e);
        }
    }
    return w->free_at;
}

static void simulate(const costs *c, size_t workers, double mean, bool head)
{
    world w;
    make(&w, c, workers, mean);
    const double working = run(&w), wall = working + c->start + c->merge_row * (double)w.total,
                 work = mean * (double)w.total;
    if (w.committed < w.total)
        demand(fracas_fail(FRACAS_BUG, "%zu of %zu realizations were committed", w.committed,
                           w.total));
    if (head)
        puts("workers  working [s]  efficiency  with start and merge  rank 0 busy  messages/s  "
             "leases/s  commits/s  delay [s]  policy [us/lease]");
    printf("%7zu %12.3f %11.4f %21.4f %12.4f %11.1f %9.1f %10.2f %10.4f %18.2f\n", workers, working,
           work / ((double)workers * working), work / ((double)workers * wall), w.busy / working,
           (double)w.messages / working, (double)w.leases / working, (double)w.commits / working,
           w.delay / (double)w.messages, 1e6 * w.policy / (double)w.leases);
    fracas_scheduler_destroy(w.scheduler);
    free(w.cost);
    free(w.worker);
    free(w.heap);
    free(w.queue);
}

static void help(void)
{
    puts("bench_cluster [workers=N,N,...] [times=FILE] [NAME=VALUE ...]");
    for (size_t i = 0; i < NSETTINGS; i++)
        printf("  %-11s %-10g %s\n", setting[i].name, setting[i].value, setting[i].doc);
    puts("  times                  file of times [s] of realizations that were measured, one a "
         "line, instead of task, share, longer");
    exit(0);
}

static void read_setting(costs *c, const char *argument, const char **workers)
{
    const char *is = strchr(argument, '=');
    char *end;
    if (!strcmp(argument, "help")) help();
    if (!strncmp(argument, "workers=", 8)) *workers = is + 1;
    if (!strncmp(argument, "times=", 6)) read_times(is + 1);
    if (!strncmp(argument, "workers=", 8) || !strncmp(argument, "times=", 6)) return;
    for (size_t i = 0; is && i < NSETTINGS; i++) {
        if (strlen(setting[i].name) != (size_t)(is - argument) ||
            strncmp(setting[i].name, argument, (size_t)(is - argument)))
            continue;
        *value_of(c, i) = strtod(is + 1, &end);
        if (!*end && end > is + 1 && *value_of(c, i) >= 0) return;
    }
    demand(fracas_fail(FRACAS_USAGE, "`%s` is no setting; see bench_cluster help", argument));
}

int main(int argc, char **argv)
{
    costs c;
    const char *workers = "100,1000,10000";
    for (size_t i = 0; i < NSETTINGS; i++) *value_of(&c, i) = setting[i].value;
    for (int i = 1; i < argc; i++) read_setting(&c, argv[i], &workers);
    double mean = c.share * c.longer + (1 - c.share) * c.task;
    for (size_t i = 0; i < ntimes; i++) mean = (i ? mean : 0) + times[i] / (double)ntimes;
    if (!(mean > 0) || c.width < 1 || c.width > FRACAS_LANES_MAX || c.points < 1)
        demand(fracas_fail(FRACAS_USAGE,
                           "a realization must take some time, a batch have 1 to %d of them, and a "
                           "campaign a point",
                           FRACAS_LANES_MAX));
    bool head = true;
    for (char *end; *workers; workers = *end ? end + 1 : end, head = false) {
        const long count = strtol(workers, &end, 10);
        if (end == workers || count < 1 || (*end && *end != ','))
            demand(fracas_fail(FRACAS_USAGE, "workers= takes numbers, such as 10,100"));
        simulate(&c, (size_t)count, mean, head);
    }
    return 0;
}
