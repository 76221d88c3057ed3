/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Batches whose sweeps are timed: `fracas bench kernels` and bench_sweep. */
#ifndef FRACAS_BENCH_KERNELS_CASES_H
#define FRACAS_BENCH_KERNELS_CASES_H

#include "engine/solver/batch.h"

/* bar, ring, stershic (a ring by that algorithm); plates of linear and of quadratic triangles;
 * shell, an octant of a sphere. Meshes of surfaces are perturbed. */
enum { FRACAS_BENCH_MODELS = 6 };
extern const char *const fracas_bench_model[FRACAS_BENCH_MODELS];

typedef struct {
    int model;        /* number of the name */
    int64_t elements; /* about */
    int lanes;        /* 1, 4, 8 */
    fracas_isa isa;
    /* Cracked: half of a chain's interfaces (within a few steps all), or 95 % of the half of a
     * surface's that can. Else they are strained so slowly that none ever cracks. */
    bool cracked;
    double broken; /* share of the first lane's cracks that are broken, too */
} fracas_bench_case;

typedef struct {
    fracas_spec spec;
    fracas_model *model;
    fracas_batch *batch;
} fracas_bench_body;

/* A batch of that case, in that state; the caller clears it, after an error, too. */
FRACAS_MUST_USE fracas_err fracas_bench_body_init(const fracas_bench_case *wanted,
                                                  fracas_bench_body *body);
void fracas_bench_body_clear(fracas_bench_body *body);

/* Takes `steps` steps; *seconds: processor time that they took [s]. */
FRACAS_MUST_USE fracas_err fracas_bench_body_run(fracas_bench_body *body, int64_t steps,
                                                 double *seconds);

/* Memory that a step goes through, by element [bytes]: `state` of one lane, read, and written but
 * for the strengths; `tables`, the same for all lanes, read. */
typedef struct {
    double read, written, tables;
} fracas_bench_traffic;
fracas_bench_traffic fracas_bench_traffic_of(const fracas_bench_body *body);

#endif
