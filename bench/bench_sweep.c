/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Speed of the sweeps: element-steps (elements x lanes x steps) a second of processor time, ledger
 * included, interfaces cracked.
 *
 *   bench_sweep [--model bar|ring|stershic|linear|quadratic|shell] [--elements N] [--lanes 1|4|8]
 *               [--isa baseline|avx2|avx512|best] [--seconds S] [--broken SHARE] [--turns STEPS]
 *
 * It prints one line a case: model, elements, lanes, instruction set, cracked interfaces, median
 * and range of five blocks. Processor time makes other work on the machine count little.
 *
 * --broken starts the clock when that share of the first lane's cracks are broken, too. With
 * --turns it runs a block of that many steps for each line that it reads, and prints its rate; at
 * the end it prints a digest of all energies. So bench/compare_sweeps.py runs programs in turn.
 *
 * A batch at 1e5 /s with strengths 300 MPa +- 0.33 % runs until half its interfaces have cracked;
 * within a few steps all have. Linear and quadratic are plates of such triangles, shell is an
 * octant of a sphere, with perturbed meshes. There a random half of the interfaces of each lane is
 * too strong to crack, and timing starts when 95 % of the others have. */
#include "bench/bench.h"

#include "base/elementary.h"
#include "base/hash.h"
#include "engine/cohesive/law.h"
#include "engine/integrator/integrator.h"
#include "engine/loading/loading.h"
#include "engine/mesh/body.h"
#include "engine/mesh/make.h"
#include "engine/solver/batch.h"

#include <getopt.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool is_surface(const char *model)
{
    return strcmp(model, "linear") == 0 || strcmp(model, "quadratic") == 0 ||
           strcmp(model, "shell") == 0;
}

/* Uniform in [0, 1). */
static double next_random(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) * 0x1p-53;
}

/* Random numbers for a perturbed mesh, in place of those it had; the caller frees mesh.noise. */
static void perturb(fracas_spec *spec)
{
    free((void *)spec->mesh.noise);
    demand(fracas_mesh_noise_count(spec, &spec->mesh.nnoise));
    double *noise = malloc(spec->mesh.nnoise * sizeof *noise);
    uint64_t state = 7;
    for (size_t i = 0; noise && i < spec->mesh.nnoise; i++) noise[i] = 2 * next_random(&state) - 1;
    spec->mesh.noise = noise;
}

/* A square plate with edges of 0.1 mm, whatever their number. */
static fracas_spec plate(int64_t order, int64_t elements)
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
                                    .rate = 1e5,
                                    .ratio = 1,
                                    .start = &fracas_start_moving},
                        .time = {.stop = &fracas_stop_time,
                                 .end = 1,
                                 .safety = 0.25,
                                 .integrator = &fracas_integrator_central_difference,
                                 .mass = &fracas_mass_lumped}};
    perturb(&spec);
    return spec;
}

/* An octant of a sphere with edges of 0.1 mm, whatever their number, and the thickness of the
 * paper's (Becker and Noels). */
static fracas_spec shell(int64_t elements)
{
    const int64_t divisions = (int64_t)(sqrt((double)elements) + 0.5);
    fracas_spec spec = plate(2, 8);
    spec.formulation = &fracas_formulation_shell.kind;
    /* area: pi/2 R^2 = divisions^2 sqrt(3)/4 (0.1 mm)^2 */
    spec.geometry = (fracas_geometry){.shape = &fracas_shape_sphere,
                                      .part = &fracas_part_octant,
                                      .radius = 0.525e-4 * (double)divisions,
                                      .thickness = 1e-4};
    spec.mesh.divisions = divisions;
    spec.cohesive.beta_shear = 1;
    perturb(&spec);
    return spec;
}

/* A periodic bar; a free ring of the same length; that with Stershic's algorithm. */
static fracas_spec reference(const char *model, int64_t elements)
{
    const double radius = 0.05 / (2 * FRACAS_PI);
    fracas_spec spec = {
        .formulation = &fracas_formulation_bar.kind,
        .geometry = {.shape = &fracas_shape_bar,
                     .ends = &fracas_ends_periodic,
                     .length = 0.05,
                     .area = 1e-6},
        .mesh = {.spacing = &fracas_spacing_uniform, .elements = elements},
        .material = {275e9, 2750},
        .cohesive = {.law = &fracas_law_nitsche.kind, .fracture_energy = 100, .beta = 4},
        .loading = {.type = &fracas_loading_imposed_rate, .rate = 1e5},
        .time = {.stop = &fracas_stop_time, .end = 1, .safety = 0.25}};
    if (strcmp(model, "bar") == 0) return spec;
    spec.formulation = &fracas_formulation_ring.kind;
    spec.geometry = (fracas_geometry){.shape = &fracas_shape_ring,
                                      .direction = &fracas_direction_current,
                                      .radius = radius,
                                      .area = 1e-6};
    spec.loading = (fracas_loading){.type = &fracas_loading_initial_velocity,
                                    .radial = 1e5 * radius};
    if (strcmp(model, "ring") == 0) return spec;
    if (strcmp(model, "shell") == 0) return shell(elements);
    if (is_surface(model)) return plate(strcmp(model, "quadratic") == 0 ? 2 : 1, elements);
    if (strcmp(model, "stershic") != 0) {
        fprintf(
            stderr,
            "bench_sweep: no model `%s`; there are bar, ring, stershic, linear, quadratic, shell\n",
            model);
        exit(2);
    }
    spec.cohesive = (fracas_cohesive){.law = &fracas_law_stershic.kind,
                                      .fracture_energy = 100,
                                      .penalty = 1,
                                      .refinement = 0.25,
                                      .critical_zone = &fracas_zone_steep};
    return spec;
}

/* Element-steps of a batch a second, of blocks that last `seconds` or have `steps` steps. */
static double rate_of(fracas_batch *batch, int64_t elements, int64_t steps, double seconds)
{
    fracas_record record[FRACAS_LANES_MAX];
    size_t running;
    const double start = seconds_of(CLOCK_PROCESS_CPUTIME_ID);
    double spent;
    int64_t done = 0;
    do {
        for (int64_t s = 0; s < steps; s++) demand(fracas_batch_step(batch, record, &running));
        done += steps;
    } while ((spent = seconds_of(CLOCK_PROCESS_CPUTIME_ID) - start) < seconds);
    return (double)(done * elements * batch->step.width) / spent;
}

/* A block for each line read. */
static void take_turns(fracas_batch *batch, int64_t elements, int64_t steps)
{
    puts("ready");
    fflush(stdout);
    for (int c; (c = getchar()) != EOF;) {
        if (c != '\n') continue;
        printf("%.5g\n", rate_of(batch, elements, steps, 0));
        fflush(stdout);
    }
    const fracas_hash digest = fracas_hash_of(batch->step.energy, sizeof batch->step.energy);
    printf("%lld cracked %lld broken %s\n", (long long)batch->step.cracked[0],
           (long long)batch->step.broken[0], fracas_hash_hex(&digest).text);
}

int main(int argc, char **argv)
{
    const char *name = "bar";
    int64_t elements = 2500, turns = 0;
    int lanes = 8;
    double seconds = 1, broken = 0;
    fracas_isa isa = FRACAS_ISA_BEST;
    static const struct option known[] = {
        {"model", 1, 0, 'm'},   {"elements", 1, 0, 'n'}, {"lanes", 1, 0, 'l'}, {"isa", 1, 0, 'i'},
        {"seconds", 1, 0, 's'}, {"broken", 1, 0, 'b'},   {"turns", 1, 0, 't'}, {0}};
    for (int o; (o = getopt_long(argc, argv, "", known, NULL)) != -1;) {
        if (o == 'm') name = optarg;
        else if (o == 'n') elements = atoll(optarg);
        else if (o == 'l') lanes = atoi(optarg);
        else if (o == 's') seconds = atof(optarg);
        else if (o == 'b') broken = atof(optarg);
        else if (o == 't') turns = atoll(optarg);
        else if (o == 'i') {
            for (isa = 0; isa < FRACAS_NISAS && strcmp(optarg, fracas_isa_name[isa]) != 0;) isa++;
            if (isa == FRACAS_ISA_BEST && strcmp(optarg, "best") != 0) return 2;
        } else return 2;
    }
    fracas_spec spec = reference(name, elements);
    fracas_model *model;
    fracas_batch *batch;
    fracas_batch_options options = {.width = lanes, .isa = isa};
    demand(fracas_model_create(&spec, &model));
    model->tolerance = 1e300; /* a broken ring that flies on and on would end as ENERGY_DRIFT */
    demand(fracas_batch_create(model, (size_t)lanes, &options, &batch));
    size_t stride, running;
    uint64_t state = 42;
    for (int l = 0; l < lanes; l++) {
        double *strength = fracas_batch_strength(batch, (size_t)l, &stride);
        for (size_t i = 0; i < fracas_model_interfaces(model); i++) {
            strength[i * stride] = 300e6 + 2e6 * (next_random(&state) - 0.5);
            if (is_surface(name) && next_random(&state) < 0.5) strength[i * stride] = 1.5e9;
        }
    }
    fracas_record record[FRACAS_LANES_MAX];
    demand(fracas_batch_begin(batch));
    elements = (int64_t)fracas_model_elements(model);
    const double interfaces = (double)fracas_model_interfaces(model),
                 enough = (is_surface(name) ? 0.475 : 0.5) * interfaces;
    while (batch->step.cracked[0] < (int64_t)enough ||
           (double)batch->step.broken[0] < broken * (double)batch->step.cracked[0])
        demand(fracas_batch_step(batch, record, &running));

    double rate[5] = {0};
    if (turns) take_turns(batch, elements, turns);
    for (int block = 0; block < 5 && !turns; block++)
        rate[block] = rate_of(batch, elements, 16, seconds / 5);
    qsort(rate, 5, sizeof *rate, by_value);
    if (!turns)
        printf(
            "%-9s %lld elements %d lanes %-8s %3.0f %% cracked %.4g element-steps/s %.4g to %.4g\n",
            name, (long long)elements, lanes, fracas_isa_name[batch->step.isa],
            100.0 * (double)batch->step.cracked[0] / interfaces, rate[2], rate[0], rate[4]);
    fracas_batch_destroy(batch);
    fracas_model_destroy(model);
    free((void *)spec.mesh.noise);
    return 0;
}
