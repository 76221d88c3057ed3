/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bars of one lane, on elements of any lengths, for tests of their state. */
#ifndef FRACAS_TESTS_SUPPORT_BAR_STATE_H
#define FRACAS_TESTS_SUPPORT_BAR_STATE_H

#include "engine/formulation/chain/bar_sweep.h"
#include "tests/support/bar.h"
#include "tests/support/listed_laws.h"

enum { MOST = 2000 }; /* elements */

static const fracas_kind *const ends[] = {&fracas_ends_periodic, &fracas_ends_held};

/* Ends joined, held, free, free between walls at a gap. */
enum { ENDS = 4, ENDS_FREE = 2, ENDS_WALLS };
static inline const char *set_ends(fracas_spec *spec, int which, double gap)
{
    static const char *const name[ENDS] = {"periodic", "held", "free", "between walls"};
    spec->geometry.ends = which < 2 ? ends[which] : &fracas_ends_free;
    spec->geometry.gap = which == ENDS_WALLS ? gap : NAN;
    return name[which];
}

/* The meshes of most tests: graded either way, moved by the most that is allowed. UNIFORM leaves
 * the spec as it is. */
enum { MESHES = 3, UNIFORM = MESHES };
static const char *const mesh_name[]
    __attribute__((unused)) = {"graded", "graded backwards", "perturbed", "uniform"};

static inline fracas_model *model_on(fracas_spec *spec, int mesh)
{
    double noise[MOST + 1];
    if (mesh == 0) bar_grade(spec, 100);
    if (mesh == 1) bar_grade(spec, 0.01);
    if (mesh == 2) bar_perturb(spec, 0.45, 1, noise);
    return make_model(spec);
}

static inline bool has_flux(const fracas_spec *spec)
{
    return fracas_law_of(spec)->flux;
}

static inline double length_of(const fracas_model *model, size_t e)
{
    return model->sizes ? model->sizes[e] : model->element_size;
}

/* All strengths alike, to be changed before it begins. */
static inline fracas_batch *batch_of(const fracas_model *model, double sigma_c)
{
    fracas_batch *batch = lane_of(model, 0, 0, 0);
    for (size_t i = 0; i < model->interfaces; i++) bar_set_strength(batch, 0, i, sigma_c);
    return batch;
}

static inline fracas_batch *begun_with(const fracas_model *model, double sigma_c)
{
    fracas_batch *batch = batch_of(model, sigma_c);
    OK(fracas_batch_begin(batch));
    return batch;
}

static inline double *field(const fracas_batch *batch, size_t element, int which)
{
    return batch->step.state + element * BAR_FIELDS + (size_t)which;
}

static inline void step(fracas_batch *batch, fracas_record *record)
{
    size_t running;
    OK(fracas_batch_step(batch, record, &running));
}

/* No load, v = sin(kx) at the start: after a quarter of a period w = sin(kx)/(k c). The L2 error of
 * that, relative. */
static inline double wave_error(fracas_spec spec, int mesh, double k)
{
    const double quarter = M_PI / (2 * k * BAR_WAVE_SPEED);
    spec.time.end = 10 * quarter;
    OWN(fracas_model) model = model_on(&spec, mesh);
    const double steps = ceil(quarter / model->time_step);
    model->time_step = quarter / steps;
    OWN(fracas_batch) batch = begun_with(model, 5e7);
    double x = 0, sum = 0, norm = 0;
    for (size_t e = 0; e < model->elements;
         e++) { /* w(0) = 0, so v(-dt/2) = v(0) to second order */
        *field(batch, e, BAR_V_LEFT) = e > 0 ? *field(batch, e - 1, BAR_V_RIGHT) : 0;
        x += length_of(model, e);
        *field(batch, e, BAR_V_RIGHT) = e + 1 < model->elements ? sin(k * x) : 0;
    }
    RECORD(record);
    for (int s = 0; s <= (int)steps; s++) step(batch, &record);
    x = 0;
    for (size_t e = 0; e < model->elements; e++) {
        const double h = length_of(model, e);
        for (int g = 0; g < 2; g++) { /* two Gauss points */
            double xi = 0.5 + (g ? 0.5 : -0.5) / sqrt(3);
            double w = (1 - xi) * *field(batch, e, BAR_W_LEFT) + xi * *field(batch, e, BAR_W_RIGHT);
            double exact = sin(k * (x + xi * h)) / (k * BAR_WAVE_SPEED);
            sum += h * (w - exact) * (w - exact);
            norm += h * exact * exact;
        }
        x += h;
    }
    assert_int_equal(batch->step.cracked[0], 0);
    return sqrt(sum / norm);
}

/* Linear elements: order 2 in h, from n elements to twice and to four times as many. */
static inline void check_waves(fracas_spec spec, int mesh, double k, double bound)
{
    double error[3];
    for (int finer = 0; finer < 3; finer++) {
        error[finer] = wave_error(spec, mesh, k);
        spec.mesh.elements *= 2;
    }
    const double slope[2] = {log2(error[0] / error[1]), log2(error[1] / error[2])};
    print_message("[  figures ] %s, %s, beta %g, %s: L2 errors %.3e %.3e %.3e, slopes %.3f %.3f\n",
                  spec.cohesive.law->name, spec.geometry.ends->name, spec.cohesive.beta,
                  mesh_name[mesh], error[0], error[1], error[2], slope[0], slope[1]);
    assert_true(fabs(slope[0] - 2) < bound && fabs(slope[1] - 2) < bound);
}

#endif
