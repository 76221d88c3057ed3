/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Costs of one body in parts, and the speedup that they predict
 * (docs/decisions/bodies-in-parts.md):
 *
 *   build/release/bench_parts [ELEMENTS]   an octant of a shell of about so many (145161), one lane
 *
 * Parts are computed one after another here, each timed alone, by processor time. */
#include "bench/bench.h"
#include "bench/kernels/cases.h"

#include "engine/formulation/surface/surface.h"

#include <math.h>
#include <string.h>

enum { ROUNDS = 5, DOUBLINGS = 6 /* up to 64 parts */ };

typedef struct {
    double rate, ghost; /* element-steps/s; share of an element's time that a ghost takes */
    double meeting;     /* s, of a thread in a meeting */
    double front;       /* ghosts of a part / sqrt(elements) */
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
    demand(fracas_surface_model_divide(body->model, parts, &step.division));
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

/* ---- meetings ---- */

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

/* ---- the model ---- */

/* s a step in so many parts, whose sweeps take `sweep`. */
static double step_of(const costs *k, double parts, double sweep)
{
    return sweep + (parts > 1 ? 3 * k->meeting * parts : 0);
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
    demand(fracas_bench_body_init(&wanted, &body));
    const double n = (double)fracas_model_elements(body.model);
    costs k = {.meeting = time_meeting()};
    part_times t[DOUBLINGS + 1];
    for (int i = 0; i <= DOUBLINGS; i++) t[i] = time_parts(&body, (size_t)1 << i);
    k.rate = n / t[0].mean;
    k.ghost = (t[DOUBLINGS].mean * k.rate - n / (1 << DOUBLINGS)) / t[DOUBLINGS].ghosts;
    k.front = t[DOUBLINGS].ghosts / sqrt(n);
    printf("%.0f elements: %.3g element-steps/s; a ghost takes %.2f of an element; %.2f sqrt(n) "
           "ghosts a part\nmeeting %.2g s a thread\n\nparts  ghosts/part  model ms  measured ms "
           "(mean, slowest)  speedup   weak: time of 10000 elements a part to one part's\n",
           n, k.rate, k.ghost, k.front, k.meeting);
    for (int i = 0; i <= DOUBLINGS; i++) {
        const double parts = 1 << i, each = 1e4, all = each * parts;
        printf("%5.0f %12.0f %9.3f %12.3f %9.3f %15.1f %9.2f\n", parts, t[i].ghosts,
               1e3 * sweep_of(&k, n / parts, parts > 1 ? k.front * sqrt(n) : 0), 1e3 * t[i].mean,
               1e3 * t[i].slowest, t[0].mean / step_of(&k, parts, t[i].slowest),
               step_of(&k, parts, sweep_of(&k, each, parts > 1 ? k.front * sqrt(all) : 0)) /
                   sweep_of(&k, each, 0));
    }
    fracas_bench_body_clear(&body);
    return 0;
}
