/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Costs of one body in parts, and the speedup that they predict
 * (docs/decisions/bodies-in-parts.md):
 *
 *   build/release/bench_parts [ELEMENTS]   an octant of a shell of about so many (145161), one lane
 *
 * Parts are computed one after another here, each timed alone, by processor time. */
#include "bench/bench.h"
#include "bench/kernels/cases.h"

#include "campaigns/scheduler/worker/group.h"
#include "engine/formulation/surface/surface.h"

#include <math.h>
#include <string.h>
#include <sys/wait.h>

enum { CORES = 32 /* of a node, in the prediction */, ROUNDS = 5 };

typedef struct {
    double rate, ghost; /* element-steps/s; share of an element's time that a ghost takes */
    double meeting;     /* s, of a thread in a meeting */
    double latency, call, bandwidth; /* s, s of a processor, B/s: an exchange between processes */
    double front;                    /* ghosts of a part / sqrt(elements) */
} costs;

/* ---- parts ---- */

typedef struct {
    double slowest, mean, ghosts; /* s a step; ghosts of a part, mean */
} part_times;

static double step_part(fracas_step *step, fracas_surface_sweep *sweep,
                        const fracas_surface_constants *c, size_t p)
{
    const fracas_surface_division *division = step->division.plan;
    const fracas_surface_part *part = &division->part[p];
    const double began = seconds_of(CLOCK_PROCESS_CPUTIME_ID);
    for (size_t i = 0; i < part->copies; i++)
        memcpy(step->state + part->copy[i].to, step->state + part->copy[i].from,
               part->copy[i].count * sizeof(double));
    sweep(c, step, 0, p);
    return seconds_of(CLOCK_PROCESS_CPUTIME_ID) - began;
}

/* The body is divided anew; the least of some rounds counts for each part. */
static part_times time_parts(fracas_bench_body *body, size_t parts)
{
    const fracas_surface_constants c = fracas_surface_constants_of(body->model);
    fracas_step *own = &body->batch->step, step = *own;
    fracas_surface_sweep *sweep =
        (*c.tables->body->kernels)[own->isa][1]->sweep[c.law][c.tables->order - 1];
    part_times t = {0};
    demand(fracas_surface_model_divide(body->model, parts, NULL, &step.division));
    step.state = aligned_alloc(64, (step.division.fields * sizeof(double) + 63) / 64 * 64);
    double *least = malloc(parts * sizeof *least);
    if (!step.state || !least) demand(fracas_no_memory("a benchmark"));
    memcpy(step.state, own->state, fracas_surface_state_fields(&c) * sizeof(double));
    const fracas_surface_division *division = step.division.plan;
    for (int round = 0; round < ROUNDS; round++)
        for (size_t p = 0; p < division->parts; p++) {
            const double s = step_part(&step, sweep, &c, p);
            least[p] = round ? fmin(least[p], s) : s;
        }
    for (size_t p = 0; p < division->parts; p++) {
        t.slowest = fmax(t.slowest, least[p]);
        t.mean += least[p] / (double)division->parts;
        t.ghosts += (double)division->part[p].turns / (double)division->parts;
    }
    t.ghosts -= (double)c.tables->nelements / (double)division->parts;
    free(least);
    free(step.state);
    fracas_surface_division_destroy(step.division.plan);
    return t;
}

/* ---- meetings and messages ---- */

enum { MEETINGS = 20 };

static void meet(void *team, size_t member)
{
    (void)member;
    for (int i = 0; i < MEETINGS; i++) fracas_team_meet(team);
}

/* A quarter of the rounds are faster: a busy machine lets threads wait. */
static double time_meeting(void)
{
    enum { TIMES = 500 };
    double round[TIMES];
    fracas_team *team;
    demand(fracas_team_create(2, &team));
    for (int i = 0; i < TIMES; i++) {
        const double began = seconds_of(CLOCK_MONOTONIC);
        fracas_team_run(team, meet, team);
        round[i] = seconds_of(CLOCK_MONOTONIC) - began;
    }
    fracas_team_destroy(team);
    qsort(round, TIMES, sizeof *round, by_value);
    return round[TIMES / 4] / MEETINGS / 2;
}

/* Another process of this host in a group with this one, which it leaves with it; 0 in the other.
 */
static pid_t start_group(fracas_group *group)
{
    fracas_meeting meeting = {0};
    size_t from;
    fracas_group_init(group);
    demand(fracas_group_open(group, FRACAS_PEERS_MAX, &meeting));
    const pid_t pid = fork();
    if (!pid) {
        fracas_group_init(group);
        demand(fracas_group_join(group, &meeting, &from));
        return 0;
    }
    while (!fracas_group_has_come(group)) usleep(1000);
    demand(fracas_group_start(group, 0));
    return pid;
}

/* s of an exchange of `size` bytes each way; *cpu: of this processor. */
static double time_exchange(size_t size, int times, double *cpu)
{
    fracas_group group;
    const pid_t pid = start_group(&group);
    const fracas_peers *peers = fracas_group_peers(&group);
    char *bytes = calloc(2, size);
    if (!bytes) exit(1);
    fracas_parcel out[2] = {{0}}, in[2] = {{0}};
    out[!peers->number] = (fracas_parcel){bytes, size};
    in[!peers->number] = (fracas_parcel){bytes + size, size};
    const double began = seconds_of(CLOCK_MONOTONIC),
                 cpu_began = seconds_of(CLOCK_PROCESS_CPUTIME_ID);
    for (int i = 0; i < times; i++) demand(peers->exchange(peers->context, out, in));
    const double seconds = seconds_of(CLOCK_MONOTONIC) - began;
    *cpu = (seconds_of(CLOCK_PROCESS_CPUTIME_ID) - cpu_began) / times;
    if (!pid) _exit(0);
    waitpid(pid, NULL, 0);
    fracas_group_leave(&group);
    free(bytes);
    return seconds / times;
}

/* ---- the model ---- */

/* s a step of n elements in so many parts, whose sweeps take `sweep`. */
static double step_of(const costs *k, double n, double parts, double sweep)
{
    const double threads = fmin(parts, CORES), nodes = ceil(parts / CORES);
    double seconds = sweep + (parts > 1 ? 3 * k->meeting * threads : 0);
    if (nodes > 1) /* cuts on both sides, an element's 36 fields, and branches of blocks' sums */
        seconds += k->latency + (nodes - 2) * k->call +
                   (k->front * sqrt(n) * 36 + 2 * log2(n / 64) * SURFACE_SUMS * nodes) *
                       sizeof(double) / k->bandwidth;
    return seconds;
}

static double sweep_of(const costs *k, double own, double ghosts)
{
    return (own + k->ghost * ghosts) / k->rate;
}

int main(int argc, char **argv)
{
    const fracas_bench_case wanted = {.model = 5,
                                      .elements = argc > 1 ? atoll(argv[1]) : 145161,
                                      .lanes = 1,
                                      .isa = FRACAS_ISA_BEST,
                                      .cracked = true};
    fracas_bench_body body;
    double cpu, unused;
    demand(fracas_bench_body_init(&wanted, &body));
    const double n = (double)fracas_model_elements(body.model);
    costs k = {.meeting = time_meeting(), .latency = time_exchange(64, 2000, &cpu), .call = cpu};
    k.bandwidth = (4 << 20) / time_exchange(4 << 20, 50, &unused);
    part_times t[11];
    for (int i = 0; i <= 10; i++) t[i] = time_parts(&body, (size_t)1 << i);
    k.rate = n / t[0].mean;
    k.ghost = (t[6].mean * k.rate - n / 64) / t[6].ghosts;
    k.front = t[6].ghosts / sqrt(n);
    printf("%.0f elements: %.3g element-steps/s; a ghost takes %.2f of an element; %.2f sqrt(n) "
           "ghosts a part\nmeeting %.2g s a thread, exchange %.2g s (%.2g s of a processor), %.3g "
           "B/s\n\nparts  ghosts/part  model ms  measured ms (mean, slowest)  speedup   weak: time "
           "of 10000 elements a part to one part's\n",
           n, k.rate, k.ghost, k.front, k.meeting, k.latency, k.call, k.bandwidth);
    for (int i = 0; i <= 10; i++) {
        const double parts = 1 << i, each = 1e4, all = each * parts;
        printf("%5.0f %12.0f %9.3f %12.3f %9.3f %15.1f %9.2f\n", parts, t[i].ghosts,
               1e3 * sweep_of(&k, n / parts, parts > 1 ? k.front * sqrt(n) : 0), 1e3 * t[i].mean,
               1e3 * t[i].slowest, t[0].mean / step_of(&k, n, parts, t[i].slowest),
               step_of(&k, all, parts, sweep_of(&k, each, parts > 1 ? k.front * sqrt(all) : 0)) /
                   sweep_of(&k, each, 0));
    }
    fracas_bench_body_clear(&body);
    return 0;
}
