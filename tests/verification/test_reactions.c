/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Forces of held edges: the balance of momentum, step by step, and closed forms
 * (docs/theory/probes.md). */
#include "tests/support/lanes.h"
#include "tests/support/loads.h"
#include "tests/support/membrane_elastic.h"
#include "tests/support/shell.h"
#include "tests/support/test.h"

static fracas_spec loaded(fracas_spec spec, const fracas_kind *type)
{
    spec.loading = bare_load(type);
    return spec;
}

static fracas_spec plate_of(bool shell, int64_t divisions)
{
    fracas_spec spec = shell ? shell_spec(&fracas_shape_plate)
                             : membrane_spec(&fracas_shape_plate, 2, divisions);
    spec.mesh.divisions = divisions;
    return spec;
}

static fracas_spec pushed(fracas_spec spec, double x, double y, double z)
{
    spec = loaded(spec, &fracas_loading_body_force);
    memcpy(load_number(&spec.loading, "x"), (double[3]){x, y, z}, 3 * sizeof(double));
    return spec;
}

static fracas_spec pulled(fracas_spec spec, double normal, double shear, double across)
{
    static const fracas_kind right = {"right", ""};
    spec = loaded(spec, &fracas_loading_traction);
    spec.loading.edge = &right;
    memcpy(load_number(&spec.loading, "normal"), (double[3]){normal, shear, across},
           3 * sizeof(double));
    return spec;
}

/* Strengths alike. */
static fracas_batch *begin(const fracas_model *model, double strength, int64_t history)
{
    fracas_batch *batch = batch_with(
        model, 1, (fracas_batch_options){.width = 1, .history = history, .reactions = true});
    for (size_t k = 0; k < strengths_of(model); k++) bar_set_strength(batch, 0, k, strength);
    return batch;
}

typedef struct {
    double sum[3], size; /* size: sum of absolute values */
} vector_sum;

static void add(vector_sum *to, int i, double value)
{
    to->sum[i] += value;
    to->size += fabs(value);
}

static vector_sum momentum_of(const fracas_batch *batch)
{
    const fracas_surface_tables *t = batch->model->plan;
    const size_t nodes = batch->model->surface->corners, dimension = (size_t)t->body->dimension;
    vector_sum p = {{0}};
    for (size_t e = 0; e < t->nelements; e++)
        for (size_t k = 0; k < nodes; k++)
            for (size_t l = 0; l < nodes; l++)
                for (size_t i = 0; i < dimension; i++)
                    add(&p, (int)i,
                        fracas_surface_mass(t, e, k, l) *
                            *surface_value(batch->model, &batch->step, e, SURFACE_V,
                                           (int)(dimension * l + i), 0));
    return p;
}

static vector_sum forces_of(const fracas_batch *batch, size_t *edges)
{
    const fracas_model *model = batch->model;
    const fracas_surface_tables *t = model->plan;
    int64_t tag[FRACAS_HOLDERS];
    double force[FRACAS_HOLDERS][3];
    vector_sum all = {{0}};
    *edges = model->formulation->held_edges(model, tag);
    model->formulation->reactions(model, &batch->step, 0, force);
    for (size_t n = 0; n < *edges; n++)
        for (int i = 0; i < 3; i++) add(&all, i, force[n][i]);
    for (size_t e = 0; t->load_row && e < t->nelements; e++)
        for (size_t i = 0; t->load_row[e] && i < fracas_surface_unknowns(t); i++)
            add(&all, (int)i % t->body->dimension,
                t->load[(t->load_row[e] - 1) * fracas_surface_unknowns(t) + i]);
    return all;
}

/* sum of reactions + load = (p(t_n+1/2) - p(t_n-1/2))/dt of leapfrog, while the body bends, cracks
 * and breaks; by the sums of absolute values: round-off of some 1e3 terms, p's by dt. */
static void check_momentum(fracas_spec spec, double strength, int64_t steps, size_t edges,
                           bool breaks)
{
    fracas_model *model = distorted_model(spec, 0.2, 5);
    fracas_batch *batch = begin(model, strength, 0);
    RECORD(record);
    OK(fracas_batch_begin(batch));
    double worst = 0, largest = 0;
    size_t running = 1, found;
    vector_sum before = {{0}};
    for (int64_t s = 0; s < steps && running > 0; s++) {
        OK(fracas_batch_step(batch, &record, &running));
        const vector_sum p = momentum_of(batch), all = forces_of(batch, &found);
        const double dt = batch->step.kick[0];
        for (int i = 0; i < 3 && s > 0; i++)
            worst = fmax(worst, fabs((p.sum[i] - before.sum[i]) / dt - all.sum[i]) /
                                    (all.size + (p.size + before.size) / dt));
        largest = fmax(largest, all.size);
        before = p;
    }
    print_message("%s: %zu edges, %lld cracked, %lld broken, momentum within %.1e\n",
                  model->formulation->kind.name, found, (long long)batch->step.cracked[0],
                  (long long)batch->step.broken[0], worst);
    assert_true(worst < 1e-13 && largest > 0);
    assert_int_equal(found, edges);
    assert_true((batch->step.broken[0] > 0) == breaks);
    fracas_batch_destroy(batch);
    fracas_model_destroy(model);
}

/* A free edge moved by a load is held by it: its forces lead it along. */
static void momentum_changes_by_edges_that_move(void **unused)
{
    for (int shell = 0; shell < 2; shell++) {
        fracas_spec spec = plate_of(shell, 4);
        spec.geometry.edge[1] = &fracas_edge_fixed;
        spec.loading = (fracas_loading){
            .type = &fracas_loading_edge_motion,
            .edge = motion_choice("edge", "right"),
            .direction = motion_choice("direction", shell ? "across" : "along"),
            .rise_by = motion_choice("rise_by", "smooth"),
            .displacement = shell ? 0.01 : 1e-6,
            .rise = shell ? 0.5 : 2e-6};
        spec.cohesive.fracture_energy = 1e12;
        spec.time.end = shell ? 100 : 1;
        check_momentum(spec, shell ? 1e6 : 1e12, 300, 2, false);
        spec.time.mass = shell ? spec.time.mass : &fracas_mass_consistent;
        spec.time.rotary_inertia = shell ? 1 : spec.time.rotary_inertia;
        check_momentum(spec, shell ? 1e6 : 1e12, 300, 2, false);
    }
}

/* Nodes inside that a load moves along y, others that rest along x, beside a fixed edge, of which
 * the nodes' components are the edge's; of a body that cracks, too. */
static void momentum_changes_by_nodes_that_loads_hold(void **unused)
{
    for (int shell = 0; shell < 2; shell++) {
        const fracas_kind *const type = &fracas_loading_node_motion;
        fracas_spec spec = plate_of(shell, 4);
        const double w = spec.geometry.width;
        fracas_loading nodes = bare_load(type);
        for (int i = 0; i < FRACAS_LOAD_OWN; i++) nodes.own[i] = NAN;
        nodes.rise_by = load_choice(type, "rise_by", "smooth");
        nodes.direction = load_choice(type, "direction", "x");
        nodes.own_choice = load_choice(type, "holds", "along");
        *load_number(&nodes, "to_x") = -0.2 * w;
        spec.also[0] = spec.loading = nodes;
        *load_number(&spec.loading, "to_x") = 0.5 * w;
        *load_number(&spec.loading, "from_x") = 0.2 * w;
        spec.loading.direction = load_choice(type, "direction", "y");
        spec.loading.displacement = shell ? 0.01 : 1e-6;
        spec.loading.rise = shell ? 0.5 : 2e-6;
        spec.geometry.edge[1] = &fracas_edge_fixed;
        spec.cohesive.fracture_energy = 1e12;
        spec.time.end = shell ? 100 : 1;
        check_momentum(spec, shell ? 1e6 : 1e12, 300, 3, false);
        spec.time.mass = shell ? spec.time.mass : &fracas_mass_consistent;
        spec.time.rotary_inertia = shell ? 1 : spec.time.rotary_inertia;
        check_momentum(spec, shell ? 1e6 : 1e12, 300, 3, false);
        if (shell) continue;
        spec.cohesive.fracture_energy = 100;
        spec.loading.displacement = 0.01 * w;
        spec.time.safety = 0.5;
        spec.time.end = 1e-5;
        spec.mesh.divisions = 6;
        check_momentum(spec, 300e6, 400, 3, true);
    }
}

static void momentum_changes_by_reactions_and_load(void **unused)
{
    fracas_spec clamped = loaded(plate_of(true, 4), &fracas_loading_pressure);
    for (int tag = 1; tag <= PLATE_SIDES; tag++) clamped.geometry.edge[tag] = &fracas_edge_clamped;
    *load_number(&clamped.loading, "pressure") = 1;
    clamped.geometry.thickness = 0.02;
    check_momentum(clamped, 1e6, 300, 4, false);
    clamped.time.rotary_inertia = 1;
    check_momentum(clamped, 1e6, 300, 4, false);
    fracas_spec mirrored = pushed(plate_of(true, 4), 1, 2, 3); /* some components of each edge */
    mirrored.geometry.edge[1] = &fracas_edge_symmetry;
    mirrored.geometry.edge[3] = &fracas_edge_symmetry;
    mirrored.geometry.edge[2] = &fracas_edge_fixed;
    mirrored.time.rotary_inertia = 1;
    check_momentum(mirrored, 1e6, 300, 3, false);
    fracas_spec strip = pulled(plate_of(false, 3), 1e6, 2e6, 0);
    strip.geometry.edge[1] = &fracas_edge_fixed;
    strip.time.end = 1;
    strip.cohesive.fracture_energy = 1e12;
    check_momentum(strip, 1e12, 300, 1, false);
    strip.time.mass = &fracas_mass_consistent;
    strip.geometry.edge[3] = &fracas_edge_sliding;
    check_momentum(strip, 1e12, 300, 2, false);
    fracas_spec torn = plate_of(false, 6); /* edges that move apart, by strengths of 300 MPa */
    torn.geometry.edge[1] = torn.geometry.edge[2] = &fracas_edge_held;
    torn.cohesive.fracture_energy = 100;
    torn.time.end = 1e-6;
    torn.time.safety = 0.5;
    check_momentum(torn, 300e6, 100, 2, true);
}

/* ---- closed forms ---- */

/* Means over [0, T] of a record's rows, by the trapezoid. */
static void means_of(const fracas_record *record, double end, double mean[3])
{
    mean[0] = mean[1] = mean[2] = 0;
    for (size_t n = 1; n < record->nreaction && record->reaction[n].time <= end * (1 + 1e-9); n++)
        for (int i = 0; i < 3; i++)
            mean[i] += 0.5 * (record->reaction[n].force[i] + record->reaction[n - 1].force[i]) *
                       (record->reaction[n].time - record->reaction[n - 1].time) / end;
}

static void run(fracas_spec spec, double strength, int64_t history, fracas_record *record)
{
    fracas_model *model = make_model(&spec);
    fracas_batch *batch = begin(model, strength, history);
    OK(fracas_batch_run(batch, record));
    assert_int_equal(record->nreaction, record->nhistory);
    for (size_t n = 0; n < record->nreaction; n++)
        assert_true(record->reaction[n].edge == 1 &&
                    record->reaction[n].time == record->history[n].time);
    fracas_batch_destroy(batch);
    fracas_model_destroy(model);
}

/* A strip of length L, fixed at its left end, pulled by s at its right, nu 0: after L/c its end is
 * pulled back by 2 s, from 3 L/c to 5 L/c by nothing, and so on. Two elements of 40 by 2 mm along
 * and the ringing of a front behind it: means of the plateaus within 2 %, of a period, when its
 * momentum is back to 0, within 1 %. */
static void a_pulled_strip_pulls_its_end(void **unused)
{
    fracas_spec spec = pulled(plate_of(false, 2), 1e6, 0, 0);
    spec.geometry.width = 40e-3;
    spec.geometry.height = 2e-3;
    spec.material.poisson = 0;
    spec.geometry.edge[1] = &fracas_edge_fixed;
    spec.cohesive.fracture_energy = 1e12;
    const double length = spec.geometry.width, push = 1e6 * 2e-3 * spec.geometry.thickness,
                 c = sqrt(spec.material.young / spec.material.density), period = 4 * length / c;
    spec.time.end = period;
    RECORD(record);
    run(spec, 1e12, 800, &record);
    double pulls = 0, rests = 0, mean[3];
    size_t pulling = 0, resting = 0;
    for (size_t n = 0; n < record.nreaction; n++) {
        const double turn = record.reaction[n].time / period * 4,
                     force = record.reaction[n].force[0];
        if (turn > 1.1 && turn < 2.9) pulls += force, pulling++;
        if (turn < 0.9 || turn > 3.1) rests += force, resting++;
    }
    means_of(&record, period, mean);
    print_message("strip: %.4f and %.4f s h b, mean %.4f\n", pulls / (double)pulling / push,
                  rests / (double)resting / push, mean[0] / push);
    assert_true(fabs(pulls / (double)pulling / push + 2) < 0.04);
    assert_true(fabs(rests / (double)resting / push) < 0.04);
    assert_true(fabs(mean[0] / push + 1) < 0.01 && fabs(mean[1] / push) < 0.01 && mean[2] == 0);
}

/* The mean force under a body of mass m that hangs by an edge is -m g; over a time T it is that but
 * for its momentum by T, which stays below that of the first quarter of a period, m g T_1/4: with T
 * of 25 periods within 1 %. */
static void a_hanging_plate_is_held_by_its_weight(void **unused)
{
    fracas_spec spec = pushed(plate_of(false, 3), 9.81, 0, 0);
    spec.geometry.edge[1] = &fracas_edge_fixed;
    spec.cohesive.fracture_energy = 1e12;
    const double c = sqrt(spec.material.young / spec.material.density);
    const double weight = 9.81 * spec.material.density * spec.geometry.width *
                          spec.geometry.height * spec.geometry.thickness;
    spec.time.end = 25 * 4 * spec.geometry.width / c;
    RECORD(record);
    run(spec, 1e12, 2000, &record);
    double mean[3];
    means_of(&record, spec.time.end, mean);
    print_message("plate: mean %.5f m g\n", mean[0] / weight);
    assert_true(fabs(mean[0] / weight + 1) < 0.01 && fabs(mean[1]) < 0.01 * weight);
}

static void bodies_without_held_edges_are_refused(void **unused)
{
    fracas_spec spec = plate_of(false, 3);
    fracas_model *model = make_model(&spec);
    fracas_batch *batch = NULL;
    FAILS(fracas_batch_create(model, 1, &(fracas_batch_options){.reactions = true}, &batch),
          FRACAS_USAGE, "none is held; leave it out, or hold one");
    fracas_model_destroy(model);
    spec = bar_reference(10, 1e4, 1e-7);
    model = make_model(&spec);
    FAILS(fracas_batch_create(model, 1, &(fracas_batch_options){.reactions = true}, &batch),
          FRACAS_USAGE, "surfaces alone have edges; leave it out");
    fracas_model_destroy(model);
}

/* Lanes and parts change no bit of the forces; forces change no bit of the rest. */
static void reactions_depend_on_their_lane_alone(void **unused)
{
    enum { COUNT = 3 };
    fracas_spec spec = plate_of(false, 10);
    spec.geometry.edge[1] = spec.geometry.edge[2] = &fracas_edge_held;
    spec.cohesive.fracture_energy = 100;
    spec.time.end = 3e-7;
    spec.time.safety = 0.5;
    fracas_model *model = make_model(&spec);
    fracas_record alone[COUNT], beside[COUNT], plain[COUNT];
    for (size_t l = 0; l < COUNT; l++)
        run_replicas(model, l, 1, 0.1,
                     (fracas_batch_options){.width = 1, .history = 20, .reactions = true},
                     &alone[l]);
    run_replicas(model, 0, COUNT, 0.1,
                 (fracas_batch_options){.history = 20, .reactions = true, .parts = 3}, beside);
    run_replicas(model, 0, COUNT, 0.1, (fracas_batch_options){.history = 20}, plain);
    for (size_t l = 0; l < COUNT; l++) {
        assert_true(alone[l].broken > 0 && alone[l].nreaction == 2 * alone[l].nhistory);
        assert_same_record(&alone[l], &beside[l]);
        assert_memory_equal(&alone[l], &plain[l], offsetof(fracas_record, nfragment));
        fracas_record_clear(&alone[l]);
        fracas_record_clear(&beside[l]);
        fracas_record_clear(&plain[l]);
    }
    fracas_model_destroy(model);
}

/* Without an expansion a sliding edge rests, as one in a plane of symmetry does: equal bits. */
static void membranes_have_planes_of_symmetry(void **unused)
{
    const fracas_kind *const edge[2] = {&fracas_edge_sliding, &fracas_edge_symmetry};
    double sum[2][3];
    for (int k = 0; k < 2; k++) {
        fracas_spec spec = pulled(plate_of(false, 4), 1e6, 2e5, 0);
        spec.geometry.edge[1] = spec.geometry.edge[3] = edge[k];
        OWN(fracas_model) model = make_model(&spec);
        const fracas_surface_tables *t = model->plan;
        OWN(fracas_batch) batch = begin(model, 300e6, 0);
        RECORD(record);
        size_t running = 1, edges;
        OK(fracas_batch_begin(batch));
        for (int s = 0; s < 200; s++) OK(fracas_batch_step(batch, &record, &running));
        const vector_sum all = forces_of(batch, &edges);
        memcpy(sum[k], all.sum, sizeof sum[k]);
        assert_true(edges == 2 && t->nrims == 0 && all.size > 0);
    }
    assert_memory_equal(sum[0], sum[1], sizeof sum[0]);
    fracas_spec leaning = membrane_spec(&fracas_shape_annulus, 2, 4);
    leaning.geometry.edge[1] = &fracas_edge_symmetry;
    OWN(fracas_model) none = NULL;
    FAILS(fracas_model_create(&leaning, &none), FRACAS_USAGE,
          "an edge with tag 1 is `symmetry`, but at", "that the body meets at a right angle");
}

TESTS(momentum_changes_by_nodes_that_loads_hold, membranes_have_planes_of_symmetry,
      momentum_changes_by_reactions_and_load, momentum_changes_by_edges_that_move,
      a_pulled_strip_pulls_its_end, a_hanging_plate_is_held_by_its_weight,
      bodies_without_held_edges_are_refused, reactions_depend_on_their_lane_alone)
