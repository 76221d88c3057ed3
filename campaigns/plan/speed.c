/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/plan/speed.h"

#include "campaigns/plan/point_model.h"
#include "engine/cohesive/law.h"
#include "engine/mesh/body.h"
#include "engine/solver/batch.h"

#include <math.h>
#include <time.h>

double fracas_processor_time(void)
{
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Element-steps and seconds of timed steps. */
typedef struct {
    double element_steps, seconds;
} effort;

/* Times steps of a batch of realizations with equal strengths, for 0.05 s or to its end, by blocks
 * long enough for the clock. The first two, with cold caches and onsets, count only if they are the
 * last. */
static fracas_err time_batch(const fracas_model *model, double strength, size_t lanes, effort *sum)
{
    enum { FIRST = 2 };
    const fracas_batch_options options = {.isa = FRACAS_ISA_BEST};
    const effort before = *sum;
    OWN(fracas_batch) batch = NULL;
    fracas_record record[FRACAS_LANES_MAX];
    size_t running = lanes;
    TRY(fracas_batch_create(model, lanes, &options, &batch));
    for (size_t l = 0; l < lanes; l++) {
        size_t stride, strengths = fracas_model_interfaces(model) *
                                   fracas_model_strengths_per_interface(model);
        double *sigma_c = fracas_batch_strength(batch, l, &stride);
        for (size_t k = 0; k < strengths; k++) sigma_c[k * stride] = strength;
        fracas_record_init(&record[l]);
    }
    fracas_err err = fracas_batch_begin(batch);
    int64_t block = 1;
    for (int i = 0; !err && running > 0 && (i <= FIRST || sum->seconds < 0.05); i++) {
        const double start = fracas_processor_time();
        if (i == FIRST) *sum = before;
        for (int64_t step = 0; step < block && !err && running > 0; step++) {
            err = fracas_batch_step(batch, record, &running);
            sum->element_steps += (double)fracas_model_elements(model) * (double)lanes;
        }
        const double spent = fracas_processor_time() - start;
        sum->seconds += spent;
        if (spent < 1e-4) block *= 2;
    }
    for (size_t l = 0; l < lanes; l++) fracas_record_clear(&record[l]);
    return err;
}

fracas_err fracas_speed_measure(const fracas_campaign *campaign, size_t index,
                                const fracas_model *model, fracas_forecast *forecast)
{
    enum { TIMED = 100000 }; /* elements; above, memory limits the speed */
    const fracas_point *point = &campaign->point[index];
    const bool surface = fracas_model_surface(model) != NULL;
    fracas_spec spec = point->spec;
    OWN(fracas_model) shorter = NULL;
    if (!surface && spec.mesh.elements > TIMED) { /* a bar or ring of equal elements */
        spec.geometry.length *= TIMED / (double)spec.mesh.elements;
        spec.geometry.radius *= TIMED / (double)spec.mesh.elements;
        spec.mesh.elements = TIMED;
        TRY(fracas_point_model_like(campaign, index, &spec, &shorter));
        model = shorter;
    }
    const double strength = surface ? 1e-12 * forecast->mean
                                    : fracas_strength_mean(&point->strength,
                                                           fracas_extents_of(model).mean);
    effort sum = {0};
    for (int i = 0; i < 50 && sum.seconds < 0.01; i++)
        TRY(time_batch(model, strength, fracas_forecast_lanes(point), &sum));
    forecast->speed = sum.element_steps / fmax(sum.seconds, 1e-9);
    return FRACAS_OK;
}

/* True if an element-step costs the same at both points. */
static bool is_similar(const fracas_spec *a, const fracas_spec *b)
{
    if (a->formulation != b->formulation) return false;
    if (!fracas_spec_is_surface(a)) return true;
    return a->mesh.order == b->mesh.order && a->geometry.file == b->geometry.file &&
           a->cohesive.law == b->cohesive.law &&
           (a->cohesive.friction > 0) == (b->cohesive.friction > 0) &&
           a->time.integrator == b->time.integrator && a->time.mass == b->time.mass &&
           (a->time.rotary_inertia > 0) == (b->time.rotary_inertia > 0);
}

double fracas_speed_of_similar(const fracas_campaign *campaign, const fracas_forecast *forecast,
                               size_t point)
{
    for (size_t p = point; p-- > 0;)
        if (is_similar(&campaign->point[p].spec, &campaign->point[point].spec) &&
            fracas_forecast_lanes(&campaign->point[p]) ==
                fracas_forecast_lanes(&campaign->point[point]) &&
            forecast[p].elements <= 2 * forecast[point].elements &&
            forecast[point].elements <= 2 * forecast[p].elements)
            return forecast[p].speed;
    return 0.0;
}
