/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A step of the membrane in a batch: what its kick and energies are by the operator, and what edges
 * hold. */
#include "tests/support/listed_laws.h"
#include "tests/support/membrane_elastic.h"
#include "tests/support/test.h"

static void a_step_is_the_operator(void **unused)
{
    const int widths[] = {1, 4, 8};
    for (int which = 0; which < BODIES; which++)
        for (int law = 0; law < MEMBRANE_LAWS; law++)
            for (int w = 0; w < 3; w++)
                for (int consistent = 0; consistent < 2; consistent++) {
                    fracas_spec spec = body_of(which, 2);
                    set_listed_law(&spec, law);
                    spec.time.mass = consistent ? &fracas_mass_consistent : &fracas_mass_lumped;
                    spec.geometry.edge[1] = consistent ? &fracas_edge_held : NULL;
                    spec.cohesive.fracture_energy = 1e12;
                    check_first_step(distorted_model(spec, DISTORTION, 9), widths[w], 1e12, 1e-3);
                }
}

/* left held, right sliding, bottom fixed, top free */
static fracas_spec held_plate(int64_t order, bool consistent, bool rest)
{
    fracas_spec spec = membrane_spec(&fracas_shape_plate, order, 3);
    const fracas_kind *const edge[FRACAS_EDGES] = {NULL, &fracas_edge_held, &fracas_edge_sliding,
                                                   &fracas_edge_fixed, &fracas_edge_free};
    memcpy(spec.geometry.edge, edge, sizeof edge);
    spec.cohesive.fracture_energy = 1e12;
    spec.loading.ratio = 0.5;
    if (rest) spec.loading.start = &fracas_start_rest;
    if (consistent) spec.time.mass = &fracas_mass_consistent;
    return spec;
}

/* What an unknown should be held at by the edges of its element: NaN for nothing. An edge that is
 * fixed has the last word. */
static double expected_velocity(const fracas_model *model, size_t unknown)
{
    const size_t size = 2 * model->surface->corners, e = unknown / size, k = unknown % size / 2,
                 i = unknown % 2;
    const double place = node_at(model, e, k)[i],
                 of_loading = model->spec.loading.rate * (i ? 0.5 : 1) * place;
    double held = NAN;
    for (size_t b = 0; b < model->surface->nborders; b++) {
        const fracas_surface_border *border = &model->surface->border[b];
        if (border->element != e ||
            (k != border->edge && k != (border->edge + 1) % 3 && k != 3 + border->edge))
            continue;
        if (border->tag == 3) return 0;
        if (border->tag == 1 || (border->tag == 2 && i == 0)) held = of_loading;
    }
    return held;
}

/* Held unknowns move as u = v t, each step rounding u and v dt once: 1e-14 after 40. All the others
 * start with the loading's velocity or none. The ledger has the power of what holds, and what
 * Hulbert-Chung damps (membrane.21): 1e-12 of its largest term, as sums round. */
static void check_edges_hold(int64_t order, bool consistent, bool rest,
                             const fracas_kind *integrator)
{
    fracas_spec spec = held_plate(order, consistent, rest);
    spec.time.integrator = integrator;
    spec.time.spectral_radius = 0.5;
    one_run run = begin_run(distorted_model(spec, DISTORTION, 9), 1, 1e12);
    const size_t n = unknowns_of(run.model);
    size_t count[2] = {0, 0};
    for (size_t i = 0; i < n; i++) {
        const double held = expected_velocity(run.model, i), *x = place_of(run.model, i);
        const double free_start = rest ? 0 : spec.loading.rate * (i % 2 ? 0.5 : 1) * x[i % 2];
        assert_int_equal(is_held(run.model, i), !isnan(held));
        assert_true(fabs(*value_of(run.batch, i, SURFACE_V) - (isnan(held) ? free_start : held)) <
                    1e-14);
    }
    for (int s = 0; s < 40; s++) step_run(&run);
    const double time = run.batch->step.time[0];
    for (size_t i = 0; i < n; i++) {
        const double held = expected_velocity(run.model, i);
        if (!isnan(held))
            assert_true(fabs(*value_of(run.batch, i, SURFACE_U) - held * time) <
                        1e-14 * fmax(1e-9, fabs(held * time)));
        if (!isnan(held)) count[held != 0]++;
        else count[0] += *value_of(run.batch, i, SURFACE_U) == 0;
    }
    assert_true(count[0] > 0 && count[1] > 0);
    const fracas_ledger *ledger = &run.batch->lane[0].ledger;
    print_message("order %d, %s, %s, %s: residual %.1e of %.2e J, damped %.1e of it\n", (int)order,
                  spec.time.mass->name, spec.loading.start->name, integrator->name,
                  ledger->largest_residual / fmax(ledger->kinetic, ledger->elastic),
                  fmax(ledger->kinetic, ledger->elastic),
                  ledger->damped / fmax(ledger->kinetic, ledger->elastic));
    assert_true(integrator == &fracas_integrator_central_difference
                    ? ledger->damped == 0
                    : ledger->damped > 1e-9 * ledger->kinetic);
    assert_true(fabs(ledger->work) > 0.01 * ledger->kinetic);
    assert_true(ledger->largest_residual <
                1e-12 * fmax(fabs(ledger->work), fmax(ledger->kinetic, ledger->elastic)));
    clear_run(&run);
}

static void edges_hold_what_they_should(void **unused)
{
    for (int order = 1; order <= 2; order++)
        for (int which = 0; which < 8; which++)
            check_edges_hold(order, which % 2, which / 2 % 2,
                             which / 4 ? &fracas_integrator_hulbert_chung
                                       : &fracas_integrator_central_difference);
}

/* Nodes that are free do not know what is held elsewhere: lumped, their accelerations are those of
 * the free plate; with consistent masses M a = -K u on them, where a is 0 on those that are held.
 */
static void held_edges_change_nothing_else(void **unused)
{
    for (int order = 1; order <= 2; order++)
        for (int consistent = 0; consistent < 2; consistent++) {
            const fracas_spec spec = held_plate(order, consistent, false);
            OWN(fracas_model) held = distorted_model(spec, DISTORTION, 9);
            OWN(fracas_model) loose = distorted_model(membrane_spec(&fracas_shape_plate, order, 3),
                                                      DISTORTION, 9);
            const size_t n = unknowns_of(held);
            OWNED double *u = vector_of(n), *a = vector_of(n), *force = vector_of(n),
                         *balance = vector_of(n);
            uint64_t noise = 5;
            for (size_t i = 0; i < n; i++) u[i] = next_share(&noise) - 0.5;
            fracas_surface_operator *op = open_operator(held), *free_op = open_operator(loose);
            fracas_surface_operator_apply(op, u, a);
            apply_stiffness(loose, free_op, u, force);
            multiply_mass(held, a, balance);
            const double scale = largest_of(force, n);
            for (size_t i = 0; i < n; i++) {
                if (is_held(held, i)) assert_true(a[i] == 0);
                else assert_true(fabs(balance[i] + force[i]) < 1e-12 * scale);
            }
            fracas_surface_operator_close(op);
            fracas_surface_operator_close(free_op);
        }
}

/* Only straight edges along an axis can slide. */
static void a_circle_does_not_slide(void **unused)
{
    fracas_spec spec = membrane_spec(&fracas_shape_annulus, 1, 1);
    fracas_model *model;
    spec.geometry.edge[2] = &fracas_edge_sliding;
    assert_int_equal(fracas_model_create(&spec, &model), FRACAS_USAGE);
    assert_non_null(strstr(fracas_message(), "is `sliding`"));
}

TESTS(a_step_is_the_operator, edges_hold_what_they_should, held_edges_change_nothing_else,
      a_circle_does_not_slide)
