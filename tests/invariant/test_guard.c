/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The energy guard: which energy it counts, whom it ends, and which numbers it keeps
 * (docs/decisions/energy-guard.md). */
#include "tests/support/ring.h"
#include "tests/support/surface_state.h"
#include "tests/support/test.h"

#include "engine/formulation/chain/bar_sweep.h"
#include "engine/formulation/chain/chain.h"
#include "engine/formulation/chain/ring_sweep.h"
#include "engine/integrator/integrator.h"

/* A free plate of 6 mm x 5 mm, or a sphere of 1.5 mm, 0.3 mm thick. */
static fracas_spec body_of(bool sphere, bool shell, int64_t order, int64_t divisions, double rate)
{
    fracas_spec spec = surface_spec(shell ? &fracas_formulation_shell
                                          : &fracas_formulation_membrane,
                                    sphere ? &fracas_shape_sphere : &fracas_shape_plate);
    if (sphere) spec.geometry.radius = 1.5e-3;
    else spec.geometry.width = 6e-3, spec.geometry.height = 5e-3;
    spec.geometry.thickness = 3e-4;
    spec.mesh.order = order;
    spec.mesh.divisions = divisions;
    spec.loading.rate = rate;
    spec.time.end = 1e-8;
    return spec;
}

/* ---- energy able to break things ---- */

/* Energy beside stored and lost ones, as if nothing were broken, or as if something far off were.
 */
static double beside_of(fracas_batch *batch, bool whole)
{
    double energy;
    batch->step.broken[0] = !whole;
    OK(fracas_guard_beside(batch->model, &batch->step, 0, &energy));
    return energy;
}

static double *chain_field(const fracas_batch *batch, size_t element, int which)
{
    return batch->step.state + element * (size_t)batch->model->chain->fields + (size_t)which;
}

/* A free surface that expands by (rate x, ratio rate y) about its middle, flies and turns: before
 * the first break all of the expansion counts, afterwards nothing; random velocities keep their
 * energy but for the part of twelve motions, 1/10 of it for some 100 nodes. */
static void check_surface(fracas_model *model)
{
    const size_t n = unknowns_of(model), dimension = (size_t)tables_of(model)->body->dimension;
    OWN(fracas_batch) batch = lane_of(model, 0, 0, 0);
    OK(fracas_batch_begin(batch));
    assert_int_equal(model->rigid_part, FRACAS_MOTION_RIGID);
    const double expansion = beside_of(batch, true);
    assert_true(expansion > 0);
    assert_true(fabs(beside_of(batch, false)) < 1e-24 * expansion);
    for (size_t i = 0; i < n; i++) {
        const double *x = place_of(model, i), rate = model->spec.loading.rate;
        const double turned[3] = {-rate * x[1], rate * x[0], 0};
        *value_of(batch, i, SURFACE_V) += turned[i % dimension] + 3 * rate * model->longest;
    }
    assert_true(fabs(beside_of(batch, true) / expansion - 1) < 1e-10);
    assert_true(fabs(beside_of(batch, false)) < 1e-24 * expansion);
    uint64_t noise = 1;
    double random = 0;
    for (size_t i = 0; i < n; i++) {
        const double v = 2 * next_share(&noise) - 1;
        *value_of(batch, i, SURFACE_V) = v;
        random += 0.5 * mass_of(model, i) * v * v;
    }
    const double left = beside_of(batch, false);
    if (!tables_of(model)->consistent) assert_true(left < random && left > 0.8 * random);
}

static void flight_and_expansion_of_surfaces_do_not_count(void **unused)
{
    for (int which = 0; which < 4; which++) {
        fracas_spec spec = body_of(which == 3, which == 3, which ? 2 : 1, 4, 1e4);
        if (which == 2) spec.time.mass = &fracas_mass_consistent;
        OWN(fracas_model) model = make_model(&spec);
        check_surface(model);
    }
}

/* The radial motion of a free ring, 1/2 m (rate R_n)^2, counts before the first break; that of a
 * ring which is held never does. */
static void the_expansion_of_rings_counts_until_they_break(void **unused)
{
    for (int driven = 0; driven < 2; driven++) {
        fracas_spec spec = ring_reference(60, 1e4, 1e-7);
        if (driven) spec.loading.type = &fracas_loading_imposed_rate, spec.loading.rate = 1e4;
        OWN(fracas_model) model = make_model(&spec);
        OWN(fracas_batch) batch = lane_of(model, 0, 0, 0);
        OK(fracas_batch_begin(batch));
        const double radius = model->element_size / (2 * sin(PI / 60)),
                     energy = 0.5 * model->mass * 1e8 * radius * radius;
        if (driven) assert_true(beside_of(batch, true) < 1e-24 * energy);
        else assert_true(fabs(beside_of(batch, true) / energy - 1) < 1e-13);
        assert_true(beside_of(batch, false) < 1e-24 * energy);
    }
}

/* Chains whose elements are all alone hold nothing that could break: their elastic energy is taken
 * off, and so is all that they swing. */
static void lone_elements_do_not_count(void **unused)
{
    for (int ring = 0; ring < 2; ring++) {
        const fracas_spec spec = ring ? ring_reference(30, 1e4, 1e-7)
                                      : bar_reference(30, 1e4, 1e-7);
        OWN(fracas_model) model = make_model(&spec);
        OWN(fracas_batch) batch = lane_of(model, 0, 0, 0);
        OK(fracas_batch_begin(batch));
        double elastic = 0;
        for (size_t e = 0; e < model->elements; e++) {
            const double h = model->element_size, by = 1e-3 * h * (double)(e + 1);
            *chain_field(batch, e, ring ? RING_DAMAGE : BAR_DAMAGE) = e == 2 || e == 3 ? 0 : 1;
            *chain_field(batch, e, ring ? RING_V_LEFT : BAR_V_LEFT) = (double)e;
            if (ring) { /* along the chord */
                const double *start = model->table + e * RING_TABLE + RING_START_X;
                *chain_field(batch, e, RING_U_RIGHT) = by * (start[0] / h);
                *chain_field(batch, e, RING_U_RIGHT + 1) = by * (start[1] / h);
            } else {
                *chain_field(batch, e, BAR_W_RIGHT) = by;
            }
            /* elements 2, 3 and 4 are one fragment, at rest but for 2, 3 and 4 m/s */
            const double strain = by / h;
            if (e < 2 || e > 4)
                elastic += 0.5 * spec.material.young * strain * strain * spec.geometry.area * h;
        }
        const double found = beside_of(batch, false);
        batch->step.broken[0] = 0;
        assert_true(found > -elastic);
        for (size_t e = 2; e < 5; e++) /* nothing swings in it any more */
            for (int i = 0; i < (ring ? 4 : 2); i++)
                *chain_field(batch, e, (ring ? RING_V_LEFT : BAR_V_LEFT) + i) = 0;
        assert_true(fabs(beside_of(batch, false) / -elastic - 1) < 1e-10);
    }
}

/* ---- whom it ends ---- */

/* Bodies that fly apart so fast that each step stretches them beyond their strength many times
 * over: what is out of balance is a small part of their motion, and many times what broke them. */
static void absurd_runs_end_as_drift(void **unused)
{
    const double rates[] = {1e8, 1e9, 1e15, 1e100};
    for (int r = 0; r < 4; r++)
        for (int shell = 0; shell < 2; shell++) {
            const fracas_spec spec = body_of(false, shell, shell ? 2 : 1, 6, rates[r]);
            OWN(fracas_model) model = make_model(&spec);
            RECORD(record);
            OWN(fracas_batch) batch = lane_of(model, 0.1, 0, 10);
            OK(fracas_batch_run(batch, &record));
            assert_int_equal(record.outcome, FRACAS_ENERGY_DRIFT);
            assert_true(record.residual < 0.05 * record.kinetic); /* as it was judged before */
        }
    for (int dense = 0; dense < 2; dense++) { /* a bar 1e16 times as heavy */
        fracas_spec spec = bar_reference(100, 1e5, 2e-7);
        spec.geometry.length = 1e-3;
        if (dense) spec.material.density = 1e20, spec.time.end = 10;
        OWN(fracas_model) model = make_model(&spec);
        RECORD(record);
        OWN(fracas_batch) batch = lane_of(model, 0.1, 0, 10);
        OK(fracas_batch_run(batch, &record));
        assert_int_equal(record.outcome, dense ? FRACAS_ENERGY_DRIFT : FRACAS_FRAGMENTED);
    }
}

/* ---- long times ---- */

/* A ring under pressure, 4 mm in radius. */
static fracas_spec pressed_ring(double safety)
{
    fracas_spec spec = ring_reference(400, 1e4, 5e-5);
    spec.time.safety = safety;
    spec.geometry.radius = 4e-3;
    spec.loading = (fracas_loading){
        .type = &fracas_loading_force, .direction = &fracas_axis_radial, .force = 1e5};
    return spec;
}

/* Its parts are pressed for ten times as long as they took to break. Without (balance.3) and
 * (ring.19) it drifted within 10 us. */
static void a_pressed_ring_keeps_its_balance(void **unused)
{
    const fracas_spec spec = pressed_ring(0.25);
    OWN(fracas_model) model = make_model(&spec);
    OWN(fracas_batch) batch = batch_with(model, 1, (fracas_batch_options){0});
    RECORD(record);
    bar_draw(batch, 0, 0.1, 0);
    OK(fracas_batch_run(batch, &record));
    assert_int_equal(record.outcome, FRACAS_FRAGMENTED);
    assert_true(record.residual < 1e-3 * record.dissipated);
}

/* ---- numbers kept ---- */

/* A ring under pressure slides apart at its cracks and folds, long after its last break. Its
 * numbers are kept as they were with a sound balance, and are those of a run that was to end there.
 * Other lanes of the batch do not notice. */
static void numbers_that_were_final_are_kept(void **unused)
{
    const fracas_spec spec = pressed_ring(0.8); /* at the default step nothing drifts */
    OWN(fracas_model) model = make_model(&spec);
    fracas_record kept[2];
    OWN(fracas_batch) pair = batch_with(model, 2, (fracas_batch_options){.history = 50});
    for (size_t l = 0; l < 2; l++) {
        fracas_record_init(&kept[l]);
        bar_draw(pair, l, 0.1, l);
    }
    OK(fracas_batch_run(pair, kept));
    for (size_t l = 0; l < 2; l++) {
        print_message("[  figures ] outcome %d, %d fragments at %.3g us, residual %.1e of the "
                      "dissipated energy\n",
                      (int)kept[l].outcome, (int)kept[l].fragments, 1e6 * kept[l].end_time,
                      kept[l].residual / kept[l].dissipated);
        assert_int_equal(kept[l].outcome, FRACAS_TIME_LIMIT);
        assert_true(kept[l].end_time < spec.time.end && kept[l].fragments > 20);
        assert_true(fabs(kept[l].residual_end) <= FRACAS_GUARD_SOUND * kept[l].dissipated);
        fracas_spec shorter = spec;
        shorter.time.end = kept[l].end_time;
        OWN(fracas_model) other = make_model(&shorter);
        OWN(fracas_batch) alone = batch_with(other, 1, (fracas_batch_options){.history = 50});
        RECORD(record);
        bar_draw(alone, 0, 0.1, l);
        OK(fracas_batch_run(alone, &record));
        assert_int_equal(record.outcome, FRACAS_FRAGMENTED);
        assert_true(record.steps == kept[l].steps && record.broken == kept[l].broken &&
                    record.nfragment == kept[l].nfragment);
        assert_memory_equal(record.energy, kept[l].energy, sizeof record.energy);
        assert_memory_equal(record.fragment, kept[l].fragment,
                            record.nfragment * sizeof *record.fragment);
    }
    for (size_t l = 0; l < 2; l++) fracas_record_clear(&kept[l]);
}

TESTS(flight_and_expansion_of_surfaces_do_not_count, the_expansion_of_rings_counts_until_they_break,
      lone_elements_do_not_count, absurd_runs_end_as_drift, a_pressed_ring_keeps_its_balance,
      numbers_that_were_final_are_kept)
