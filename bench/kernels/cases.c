/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/kernels/cases.h"

#include "base/elementary.h"
#include "bench/kernels/timing.h"
#include "engine/cohesive/law.h"
#include "engine/formulation/chain/chain.h"
#include "engine/formulation/chain/ring_sweep.h"
#include "engine/formulation/surface/surface.h"
#include "engine/integrator/integrator.h"
#include "engine/loading/loading.h"
#include "engine/mesh/body.h"
#include "engine/mesh/make.h"

#include <math.h>

/* Uniform in [0, 1). */
static double next_random(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) * 0x1p-53;
}

/* Random numbers for a perturbed mesh, in place of those it had; the caller frees mesh.noise. */
static fracas_err perturb(fracas_spec *spec)
{
    spec->mesh.noise = NULL;
    TRY(fracas_mesh_noise_count(spec, &spec->mesh.nnoise));
    double *noise = malloc(spec->mesh.nnoise * sizeof *noise);
    if (!noise) return fracas_no_memory("the mesh of a benchmark");
    uint64_t state = 7;
    for (size_t i = 0; i < spec->mesh.nnoise; i++) noise[i] = 2 * next_random(&state) - 1;
    spec->mesh.noise = noise;
    return FRACAS_OK;
}

/* A square plate with edges of 0.1 mm, whatever their number. */
static fracas_spec plate(int64_t order, int64_t elements, double rate)
{
    const int64_t divisions = (int64_t)(sqrt(0.5 * (double)elements) + 0.5);
    const double side = 1e-4 * (double)divisions;
    fracas_spec spec = {.formulation = &fracas_formulation_membrane.kind,
                        .geometry = {.shape = &fracas_shape_plate,
                                     .width = side,
                                     .height = side,
                                     .thickness = 1e-4},
                        .mesh = {.spacing = &fracas_spacing_triangles,
                                 .divisions = divisions,
                                 .order = order,
                                 .amplitude = 0.2},
                        .material = {275e9, 2750, 0.22},
                        .cohesive = {.law = &fracas_law_nitsche.kind,
                                     .fracture_energy = 100,
                                     .beta = 10,
                                     .onset = &fracas_onset_mean,
                                     .coupling = 1},
                        .loading = {.type = &fracas_loading_expansion,
                                    .rate = rate,
                                    .ratio = 1,
                                    .ratio_z = NAN,
                                    .start = &fracas_start_moving},
                        .time = {.stop = &fracas_stop_time,
                                 .end = 1,
                                 .safety = 0.25,
                                 .integrator = &fracas_integrator_central_difference,
                                 .mass = &fracas_mass_lumped}};
    return spec;
}

/* An octant of a sphere with edges of 0.1 mm, whatever their number, and the thickness of the
 * paper's (Becker and Noels). */
static fracas_spec shell(int64_t elements, double rate)
{
    const int64_t divisions = (int64_t)(sqrt((double)elements) + 0.5);
    fracas_spec spec = plate(2, 8, rate);
    spec.formulation = &fracas_formulation_shell.kind;
    /* area: pi/2 R^2 = divisions^2 sqrt(3)/4 (0.1 mm)^2 */
    spec.geometry = (fracas_geometry){.shape = &fracas_shape_sphere,
                                      .part = &fracas_part_octant,
                                      .radius = 0.525e-4 * (double)divisions,
                                      .thickness = 1e-4};
    spec.mesh.divisions = divisions;
    spec.cohesive.beta_shear = 1;
    return spec;
}

/* A periodic bar. */
static fracas_spec bar(int64_t elements, double rate)
{
    return (fracas_spec){
        .formulation = &fracas_formulation_bar.kind,
        .geometry = {.shape = &fracas_shape_bar,
                     .ends = &fracas_ends_periodic,
                     .length = 0.05,
                     .area = 1e-6},
        .mesh = {.spacing = &fracas_spacing_uniform, .elements = elements},
        .material = {275e9, 2750},
        .cohesive = {.law = &fracas_law_nitsche.kind, .fracture_energy = 100, .beta = 4},
        .loading = {.type = &fracas_loading_imposed_rate, .rate = rate},
        .time = {.stop = &fracas_stop_time, .end = 1, .safety = 0.25}};
}

/* A free ring of the same length. */
static fracas_spec ring(int64_t elements, double rate)
{
    const double radius = 0.05 / (2 * FRACAS_PI);
    fracas_spec spec = bar(elements, rate);
    spec.formulation = &fracas_formulation_ring.kind;
    spec.geometry = (fracas_geometry){.shape = &fracas_shape_ring,
                                      .direction = &fracas_direction_current,
                                      .radius = radius,
                                      .area = 1e-6};
    spec.loading = (fracas_loading){.type = &fracas_loading_initial_velocity,
                                    .radial = rate * radius};
    return spec;
}

/* The same with Stershic's algorithm. */
static fracas_spec stershic(int64_t elements, double rate)
{
    fracas_spec spec = ring(elements, rate);
    spec.cohesive = (fracas_cohesive){.law = &fracas_law_stershic.kind,
                                      .fracture_energy = 100,
                                      .own = {1, 0.25}, /* penalty, refinement */
                                      .own_choice = &fracas_zone_steep};
    return spec;
}

static fracas_spec linear(int64_t elements, double rate)
{
    return plate(1, elements, rate);
}
static fracas_spec quadratic(int64_t elements, double rate)
{
    return plate(2, elements, rate);
}

const char *const fracas_bench_model[FRACAS_BENCH_MODELS] = {"bar",    "ring",      "stershic",
                                                             "linear", "quadratic", "shell"};
static fracas_spec (*const spec_of[FRACAS_BENCH_MODELS])(int64_t elements, double rate) = {
    bar, ring, stershic, linear, quadratic, shell};

/* Strengths 300 MPa +- 0.33 %; on surfaces a random half is too strong to crack. */
static void fill_strengths(fracas_bench_body *body, int lanes)
{
    uint64_t state = 42;
    size_t stride;
    for (int l = 0; l < lanes; l++) {
        double *strength = fracas_batch_strength(body->batch, (size_t)l, &stride);
        for (size_t i = 0; i < fracas_model_interfaces(body->model); i++) {
            strength[i * stride] = 300e6 + 2e6 * (next_random(&state) - 0.5);
            if (body->model->surface && next_random(&state) < 0.5) strength[i * stride] = 1.5e9;
        }
    }
}

fracas_err fracas_bench_body_run(fracas_bench_body *body, int64_t steps, double *seconds)
{
    fracas_record record[FRACAS_LANES_MAX];
    size_t running;
    const double start = seconds_of(CLOCK_PROCESS_CPUTIME_ID);
    for (int64_t s = 0; s < steps; s++) TRY(fracas_batch_step(body->batch, record, &running));
    *seconds = seconds_of(CLOCK_PROCESS_CPUTIME_ID) - start;
    return FRACAS_OK;
}

fracas_err fracas_bench_body_init(const fracas_bench_case *wanted, fracas_bench_body *body)
{
    const fracas_batch_options options = {.width = wanted->lanes, .isa = wanted->isa};
    double unused;
    *body = (fracas_bench_body){
        .spec = spec_of[wanted->model](wanted->elements, wanted->cracked ? 1e5 : 1)};
    if (body->spec.mesh.divisions) TRY(perturb(&body->spec));
    TRY(fracas_model_create(&body->spec, &body->model));
    body->model->tolerance = 1e300; /* a broken ring that flies on and on would end: ENERGY_DRIFT */
    TRY(fracas_batch_create(body->model, (size_t)wanted->lanes, &options, &body->batch));
    fill_strengths(body, wanted->lanes);
    TRY(fracas_batch_begin(body->batch));
    /* crossings are never balanced: a body at rest in its clock would soon be at long times */
    for (int l = 0; l < FRACAS_LANES_MAX; l++) body->batch->lane[l].first_break = INFINITY;
    const fracas_step *step = &body->batch->step;
    const double enough = wanted->cracked ? (body->model->surface ? 0.475 : 0.5) *
                                                (double)fracas_model_interfaces(body->model)
                                          : 0;
    while (step->cracked[0] < (int64_t)enough ||
           (double)step->broken[0] < wanted->broken * (double)step->cracked[0])
        TRY(fracas_bench_body_run(body, 1, &unused));
    return FRACAS_OK;
}

void fracas_bench_body_clear(fracas_bench_body *body)
{
    fracas_batch_destroy(body->batch);
    fracas_model_destroy(body->model);
    free((void *)body->spec.mesh.noise);
    *body = (fracas_bench_body){0};
}

static fracas_bench_traffic traffic_of_chain(const fracas_model *model)
{
    const double fields = (double)model->chain->fields;
    return (fracas_bench_traffic){
        .read = fields, .written = fields - 1, .tables = model->table ? RING_TABLE : 0};
}

static fracas_bench_traffic traffic_of_surface(const fracas_model *model)
{
    const fracas_surface_constants c = fracas_surface_constants_of(model);
    const fracas_surface_tables *t = c.tables;
    const size_t bulk = (size_t)SURFACE_BULK(t->order) * t->body->bulk_table +
                        2 * (size_t)SURFACE_NODES(t->order),
                 interface = t->body->head + (size_t)SURFACE_EDGE(t->order) * t->body->point_table;
    const double n = (double)t->nelements;
    return (fracas_bench_traffic){
        .read = (double)fracas_surface_state_fields(&c) / n,
        .written = (double)fracas_surface_strengths_at(&c) / n,
        .tables = (double)(t->nelements * bulk + t->ninterfaces * interface +
                           t->nrims * t->body->rim_table) /
                  n};
}

fracas_bench_traffic fracas_bench_traffic_of(const fracas_bench_body *body)
{
    fracas_bench_traffic numbers = body->model->surface ? traffic_of_surface(body->model)
                                                        : traffic_of_chain(body->model);
    numbers.read *= sizeof(double);
    numbers.written *= sizeof(double);
    numbers.tables *= sizeof(double);
    return numbers;
}
