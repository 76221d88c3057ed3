/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bars and rings to many times the time of their break-up (docs/theory/balance.md). */
#ifndef FRACAS_TESTS_SUPPORT_LONG_TIMES_H
#define FRACAS_TESTS_SUPPORT_LONG_TIMES_H

#include "tests/support/ring.h"

enum { REPLICAS = 8 };

/* Largest |residual| of all replicas from ten times the break-up time on, by each energy, and the
 * means of both at the end. */
typedef struct {
    double by_dissipated, by_vibrating, dissipated, vibrating; /* 1, 1, J, J */
    int64_t broken, early; /* of all replicas, at the end and at 20 times the break-up time */
} figures;

/* Time of break-up: onset, and x t_0 with e^x - 1 - x = rate_0/rate (docs/theory/bar.md) [s]. */
static inline double break_up_time(double rate)
{
    const double rate0 = BAR_WAVE_SPEED * pow(300e6, 3) / (275e9 * 275e9 * 100);
    double x = 1;
    for (int i = 0; i < 50; i++) x -= (exp(x) - 1 - x - rate0 / rate) / (exp(x) - 1);
    return 300e6 / (275e9 * rate) + x * BAR_T0;
}

static inline void look_at(fracas_batch *batch, size_t l, figures *f)
{
    const fracas_ledger *ledger = &batch->lane[l].ledger;
    double vibrating;
    fracas_rest rest;
    OK(fracas_settling_energies(batch->model, &batch->step, (int)l, ledger, &vibrating, &rest));
    f->by_dissipated = fmax(f->by_dissipated, fabs(ledger->residual) / ledger->dissipated);
    f->by_vibrating = fmax(f->by_vibrating, fabs(ledger->residual) / vibrating);
    f->dissipated += ledger->dissipated / REPLICAS;
    f->vibrating += vibrating / REPLICAS;
}

/* Strengths of a lane. */
typedef void long_draw(fracas_batch *batch, size_t lane);

static inline void draw_as_reference(fracas_batch *batch, size_t lane)
{
    bar_draw(batch, lane, 1.0 / 300, lane);
}

/* REPLICAS side by side, which break up in `time`; `balanced` false keeps crossings as they are. */
static inline figures run_drawn(fracas_spec spec, double time, long_draw *draw, double safety,
                                bool balanced)
{
    spec.time.safety = safety;
    OWN(fracas_model) model = make_model(&spec);
    model->tolerance = INFINITY;
    OWN(fracas_batch)
    batch = batch_with(model, REPLICAS, (fracas_batch_options){.isa = FRACAS_ISA_BEST});
    fracas_record record[REPLICAS];
    for (size_t l = 0; l < REPLICAS; l++) {
        draw(batch, l);
        fracas_record_init(&record[l]);
    }
    OK(fracas_batch_begin(batch));
    figures f = {0};
    double marks[] = {10, 20, 40, 60, 80, INFINITY}; /* times the time of break-up; and the end */
    size_t mark = 0;
    for (size_t running = REPLICAS; running > 0;) {
        OK(fracas_batch_step(batch, record, &running));
        for (size_t l = 0; !balanced && l < FRACAS_LANES_MAX; l++) batch->lane[l].first_break = 0;
        if (running > 0 && batch->step.time[0] < marks[mark] * time) continue;
        if (marks[mark++] == 20)
            for (size_t l = 0; l < REPLICAS; l++) f.early += batch->step.broken[l];
        f.dissipated = f.vibrating = 0;
        for (size_t l = 0; l < REPLICAS; l++) look_at(batch, l, &f);
    }
    for (size_t l = 0; l < REPLICAS; l++) {
        f.broken += record[l].broken;
        fracas_record_clear(&record[l]);
    }
    print_message("[  figures ] safety %g, %s: residual %.1e of the dissipated, %.1e of the "
                  "vibrating energy; %.4g and %.4g mJ, %ld breaks, %ld at 20 times\n",
                  safety, balanced ? "balanced" : "as it is", f.by_dissipated, f.by_vibrating,
                  1e3 * f.dissipated, 1e3 * f.vibrating, (long)f.broken, (long)f.early);
    return f;
}

/* The same, with strengths of 300 MPa +- 0.33 %. */
static inline figures run_long(fracas_spec spec, double rate, double safety, bool balanced)
{
    return run_drawn(spec, break_up_time(rate), draw_as_reference, safety, balanced);
}

#endif
