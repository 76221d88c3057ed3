/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cracks of a membrane through the batch: when interfaces crack and break, what that dissipates,
 * and what is said of fragments. */
#include "tests/support/listed_laws.h"
#include "tests/support/membrane_cracks.h"
#include "tests/support/plane_point.h"
#include "tests/support/test.h"

enum { MOST = 8 };
static const fracas_kind *const onsets[] = {&fracas_onset_mean, &fracas_onset_flux};
static const fracas_kind *const schemes[] = {&fracas_integrator_central_difference,
                                             &fracas_integrator_hulbert_chung};

/* Unit normal of interface i from its first element outward, from its nodes: straight edges. */
static void normal_of(const fracas_model *model, size_t i, double normal[2])
{
    double n[2];
    edge_normal(model, model->surface->interface[i].element[0],
                model->surface->interface[i].edge[0], 0.5, n);
    for (int k = 0; k < 2; k++) normal[k] = n[k] / hypot(n[0], n[1]);
}

/* Along the normal and the edge. */
static void resolve(const double normal[2], const double v[2], double to[2])
{
    to[0] = v[0] * normal[0] + v[1] * normal[1];
    to[1] = v[1] * normal[0] - v[0] * normal[1];
}

/* ---- a plate of which all edges move with the expansion ---- */

/* Growth of what interface i is judged by [Pa/s]: u = t (rate x, ratio rate y) satisfies the
 * equations of motion, its stress is uniform and balanced by those who hold the edges, and nothing
 * jumps. */
static double growth_of(const fracas_model *model, size_t i)
{
    const fracas_loading *load = &model->spec.loading;
    double by[2][2] = {{load->rate, 0}, {0, load->ratio * load->rate}}, stress[3], normal[2],
           traction[2];
    hooke(&model->spec.material, by, stress);
    normal_of(model, i, normal);
    resolve(normal, (double[2]){stress[0] * normal[0], stress[1] * normal[1]}, traction);
    return judged_of(traction, model->spec.cohesive.coupling, model->spec.cohesive.friction);
}

/* A different interface, or Gauss point, is the weakest in each lane. What it is judged by grows as
 * t, so that the crossing between two steps is exact. Round-off: stresses are differences of
 * displacements, which are up to 10 times as large as those over an element, and sums of some 100
 * steps: 1e-14 of the strength; in the flux a jump of 1.1e-16 u is multiplied by K, which is beta
 * body/element = 40 times stress/u: 1e-14; 1e-12 of the time. */
static void check_onsets(const fracas_spec *spec)
{
    OWN(fracas_model) model = distorted_model(*spec, DISTORTION, 9);
    double fastest = 0, expected[MOST], end = 0;
    size_t weak[MOST], count = 0;
    for (size_t i = 0; i < model->interfaces; i++) fastest = fmax(fastest, growth_of(model, i));
    for (size_t i = 0; i < model->interfaces && count < MOST; i += 3)
        if (growth_of(model, i) > 0.1 * fastest) weak[count++] = i;
    assert_true(count > 3);
    OWN(fracas_batch) batch = batch_with(
        model, count, (fracas_batch_options){.interfaces = true, .isa = FRACAS_ISA_BEST});
    for (size_t l = 0; l < count; l++) {
        const double strength = 300e6 * (1 + 0.01 * (double)l);
        const size_t weakest = weak[l] * model->strengths + l % model->strengths;
        for (size_t k = 0; k < strengths_of(model); k++)
            bar_set_strength(batch, l, k, k == weakest ? strength : 4e9);
        expected[l] = strength / growth_of(model, weak[l]);
        end = fmax(end, 1.1 * expected[l]);
    }
    model->spec.time.end = end;
    fracas_record record[MOST];
    for (size_t l = 0; l < count; l++) fracas_record_init(&record[l]);
    OK(fracas_batch_run(batch, record));
    double worst = 0;
    for (size_t l = 0; l < count; l++) {
        assert_int_equal(record[l].cracked, 1);
        assert_true(record[l].interface[weak[l]].strength == 300e6 * (1 + 0.01 * (double)l));
        assert_true(record[l].onset_time == record[l].interface[weak[l]].onset_time);
        worst = fmax(worst, fabs(record[l].onset_time / expected[l] - 1));
        for (size_t i = 0; i < model->interfaces; i++)
            assert_true(i == weak[l] || isnan(record[l].interface[i].onset_time));
        fracas_record_clear(&record[l]);
    }
    print_message("order %d, onset %s, ratio %4.1f, beta_c %.1f, mu_c %.1f, %s, %zu strengths: %zu "
                  "interfaces, onsets within %.1e\n",
                  (int)spec->mesh.order, spec->cohesive.onset->name, spec->loading.ratio,
                  spec->cohesive.coupling, spec->cohesive.friction, spec->time.integrator->name,
                  model->strengths, count, worst);
    assert_true(worst < 1e-12);
}

static void onsets_under_uniform_stress(void **unused)
{
    static const struct {
        double ratio, coupling, friction;
    } cases[] = {{1, 1, 0}, {0.4, 1, 0}, {0.4, 2, 0}, {-0.6, 0.6, 0.3}, {-1.5, 1, 0.2}};
    for (int64_t order = 1; order <= 2; order++)
        for (int o = 0; o < 4; o++)
            for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
                fracas_spec spec = brittle_plate(order, 5, 1e4, 1);
                spec.strength_per_point = o / 2;
                hold_edges(&spec, &fracas_edge_held);
                spec.cohesive.fracture_energy = 2e4; /* for strengths of 4 GPa */
                spec.cohesive.onset = onsets[o % 2];
                spec.loading.ratio = cases[c].ratio;
                spec.cohesive.coupling = cases[c].coupling;
                spec.cohesive.friction = cases[c].friction;
                set_listed_law(&spec, (int)c);
                spec.time.integrator = schemes[c % 2];
                check_onsets(&spec);
            }
}

/* ---- two triangles that are moved as a test likes ---- */

/* Rates at the Gauss points of the only interface: of the mean traction, of the jump, along the
 * normal and the edge. */
typedef struct {
    double mean[2][2], jump[2][2];
} rates;

static rates rates_of(const fracas_model *model, double velocity[2][6])
{
    const fracas_surface_interface *joint = &model->surface->interface[0];
    double normal[2], mean[2] = {0};
    rates r;
    normal_of(model, 0, normal);
    for (int side = 0; side < 2; side++) {
        double stress[3];
        const membrane_place p = place_at(model, joint->element[side], 0.3, 0.3);
        stress_at(model, &p, velocity[side], stress);
        mean[0] += 0.5 * (stress[0] * normal[0] + stress[2] * normal[1]);
        mean[1] += 0.5 * (stress[2] * normal[0] + stress[1] * normal[1]);
    }
    for (int g = 0; g < 2; g++) {
        const double s = 0.5 +
                         (g ? 0.5 : -0.5) / sqrt(3); /* from the first end of element 0's edge */
        double jump[2] = {0};
        for (int side = 0; side < 2; side++) {
            double at[2];
            on_edge(joint->edge[side], side ? 1 - s : s, at);
            const membrane_place p = place_at(model, joint->element[side], at[0], at[1]);
            for (int k = 0; k < 3; k++)
                for (int i = 0; i < 2; i++)
                    jump[i] += (side ? 1 : -1) * p.shape.value[k] * velocity[side][2 * k + i];
        }
        resolve(normal, mean, r.mean[g]);
        resolve(normal, jump, r.jump[g]);
    }
    return r;
}

/* When a point cracks and breaks, and its peak: everything grows as t, but what the law keeps from
 * the onset is that of the step at which it was seen. */
typedef struct {
    double onset, seen, broken, peak;
} fate;

static fate fate_of(const fracas_model *model, const rates *r, int g, double strength)
{
    const fracas_cohesive *law = &model->spec.cohesive;
    const double stiffness = tables_of(model)->interface[SURFACE_STIFFNESS], beta_c = law->coupling;
    const double k_n = stiffness * fmax(1, 1 / (beta_c * beta_c)), k_t = beta_c * beta_c * k_n,
                 dt = model->time_step;
    const double flux[2] = {r->mean[g][0] + k_n * r->jump[g][0],
                            r->mean[g][1] + k_t * r->jump[g][1]};
    const bool by_mean = law->onset == &fracas_onset_mean,
               in_series = fracas_law_of(&model->spec)->flux;
    const double judged = judged_of(by_mean ? r->mean[g] : flux, beta_c, law->friction);
    fate f = {.onset = strength / judged};
    const double seen = f.seen = (floor(f.onset / dt) + 1) * dt;
    if (in_series)
        f.peak = by_mean ? fmax(strength,
                                (judged_of(flux, beta_c, law->friction) - judged) * seen + strength)
                         : strength;
    else f.peak = judged * seen;
    const double delta_c = fracas_spec_critical_opening(&model->spec, f.peak);
    if (in_series) f.broken = delta_c * k_n / effective_of(flux, beta_c);
    else f.broken = seen + delta_c / hypot(fmax(0, r->jump[g][0]), beta_c * r->jump[g][1]);
    return f;
}

/* Of the extrinsic laws only what opens from the start: the opening is then linear in time. The
 * peak may not be cut  (cohesive.13). */
static bool is_of_use(const fracas_model *model, const rates *r, const double strength[2])
{
    const fracas_cohesive *law = &model->spec.cohesive;
    const double stiffness = tables_of(model)->interface[SURFACE_STIFFNESS],
                 steepest = fracas_law_steepest(law);
    for (int g = 0; g < 2; g++) {
        const fate f = fate_of(model, r, g, strength[g]);
        const bool opens = r->jump[g][0] > 0 && r->mean[g][0] > 0;
        const double most = /* p where k_n = steepest p/(G_c/p) */
            law->critical_opening > 0
                ? stiffness * fracas_spec_fracture_energy(&model->spec, 1) / steepest
                : sqrt(stiffness * law->fracture_energy / steepest);
        if (!(f.broken < 400 * steepest * model->time_step) ||
            !(f.onset + model->time_step < f.broken) || !(f.peak < most))
            return false;
        if (!fracas_law_of(&model->spec)->flux && !opens) return false;
    }
    return true;
}

/* As run_to_end; checks at which step each point cracks. */
static void run_points(fracas_batch *batch, const fate f[2], fracas_record *record)
{
    bool cracked[2] = {false, false};
    for (size_t running = 1; running > 0;) {
        OK(fracas_batch_step(batch, record, &running));
        for (int g = 0; g < 2; g++) {
            if (cracked[g] ||
                !(*surface_point(batch->model, &batch->step, 0, g, SURFACE_PEAK, 0) > 0))
                continue;
            cracked[g] = true;
            assert_true(fabs(batch->step.time[0] - f[g].seen) < 0.5 * batch->model->time_step);
        }
    }
    assert_true(cracked[0] && cracked[1]);
}

/* Runs it until it is broken, while it all moves with 100 m/s along x and y: that does not matter.
 * Every quantity that times are found from is linear in t: round-off as above, and of a break the
 * time of a crossing of something up to 10 times the strength; the motion adds 1.1e-16 of 100 times
 * the displacements; 1e-11. */
static void check_fate(fracas_model *model, double velocity[2][6], const double strength[2],
                       double *worst)
{
    const rates r = rates_of(model, velocity);
    const fate f[2] = {fate_of(model, &r, 0, strength[0]), fate_of(model, &r, 1, strength[1])};
    const double onset = fmin(f[0].onset, f[1].onset), broken = fmax(f[0].broken, f[1].broken);
    model->spec.time.end = broken + 1.5 * model->time_step;
    OWN(fracas_batch) batch = lane_of(model, 0, 0, 0);
    RECORD(record);
    for (size_t k = 0; k < model->strengths; k++) bar_set_strength(batch, 0, k, strength[k]);
    OK(fracas_batch_begin(batch));
    for (size_t side = 0; side < 2; side++)
        for (size_t i = 0; i < 6; i++)
            *value_at(batch, model->surface->interface[0].element[side], SURFACE_V,
                      i) = 100 + velocity[side][i];
    run_points(batch, f, &record);
    const double area = sqrt(2) * 1e-3 * model->spec.geometry.thickness;
    const double energy = 0.5 * (fracas_spec_fracture_energy(&model->spec, f[0].peak) +
                                 fracas_spec_fracture_energy(&model->spec, f[1].peak));
    assert_true(record.broken == 1 && record.cracked == 1 && record.fragments == 2 &&
                record.fragments_dust == 2);
    assert_true(record.interface[0].strength == fmin(strength[0], strength[1]));
    assert_true(record.interface[0].damage == 1 &&
                record.onset_time == record.interface[0].onset_time);
    worst[0] = fmax(worst[0], fabs(record.onset_time / onset - 1));
    worst[1] = fmax(worst[1], fabs(record.interface[0].break_time / broken - 1));
    worst[2] = fmax(worst[2], fabs(record.dissipated / (energy * area) - 1));
}

static void two_triangles_crack_and_break_in_time(void **unused)
{
    for (int which = 0; which < 16 * MEMBRANE_LAWS; which++) { /* the second half with a strength
                                                  for each Gauss point, the weaker first or last */
        fracas_spec spec = brittle_plate(1, 1, 0, 1);
        spec.strength_per_point = which / (8 * MEMBRANE_LAWS);
        spec.geometry.width = spec.geometry.height = 1e-3;
        spec.geometry.edge[1] = &fracas_edge_held;
        set_listed_law(&spec, which);
        spec.cohesive.onset = onsets[which / MEMBRANE_LAWS % 2];
        spec.cohesive.coupling = which / (2 * MEMBRANE_LAWS) % 2 ? 0.6 : 1.5;
        if (which / (4 * MEMBRANE_LAWS) % 2) {
            spec.cohesive.fracture_energy = 0;
            spec.cohesive.critical_opening = 1.2e-6;
        }
        const double steepest = fracas_law_steepest(
            &spec.cohesive); /* for peaks that are not cut */
        spec.cohesive.fracture_energy *= steepest * steepest;
        spec.cohesive.critical_opening *= steepest * steepest;
        spec.time.integrator = schemes[which % 7 % 2];
        fracas_model *model = distorted_model(spec, 0, 0);
        assert_true(model->elements == 2 && model->interfaces == 1);
        for (size_t e = 0; e < 2; e++)
            tables_of(model)->held[e] = 0x3f; /* every node: edges alone may not */
        const fracas_stream stream = {.seed = 4, .purpose = FRACAS_PURPOSE_MESH};
        double worst[3] = {0};
        int tried = 0, used = 0;
        for (; used < 20 && tried < 80000; tried++) {
            double velocity[2][6];
            for (size_t i = 0; i < 12; i++)
                velocity[i / 6][i % 6] =
                    2 * fracas_stream_uniform(&stream, (uint64_t)(12 * tried) + i) - 1;
            const double speed = 2 + 4 * fracas_stream_uniform(&stream, 1000000 + (uint64_t)tried);
            const double strong = 250e6 + 1e6 * (tried % 20000) / 100,
                         weak = spec.strength_per_point ? 0.9 * strong : strong;
            const double strength[2] = {tried % 2 ? weak : strong, tried % 2 ? strong : weak};
            for (size_t i = 0; i < 12; i++) velocity[i / 6][i % 6] *= speed;
            const rates r = rates_of(model, velocity);
            if (!is_of_use(model, &r, strength)) continue;
            check_fate(model, velocity, strength, worst);
            used++;
        }
        print_message("%-23s onset %s, beta_c %.1f, %s, %zu strengths: %d motions of %d, onsets "
                      "within %.1e, breaks %.1e, dissipated %.1e\n",
                      spec.cohesive.law->name, spec.cohesive.onset->name, spec.cohesive.coupling,
                      which / (4 * MEMBRANE_LAWS) % 2 ? "delta_c" : "G_c", model->strengths, used,
                      tried, worst[0], worst[1], worst[2]);
        assert_true(used == 20);
        assert_true(worst[0] < 1e-11 && worst[1] < 1e-11 && worst[2] < 1e-11);
        fracas_model_destroy(model);
    }
}

/* ---- a row of weak interfaces ---- */

enum { OPENS, SLIDES, MODES };

/* Both halves move apart with `speed`, or along each other; edges that are held go on like that. */
static void move_halves(fracas_batch *batch, int mode, double speed)
{
    const fracas_model *model = batch->model;
    for (size_t e = 0; e < model->elements; e++) {
        const double sign =
            node_at(model, e, 0)[1] + node_at(model, e, 1)[1] + node_at(model, e, 2)[1] > 0 ? 1
                                                                                            : -1;
        for (size_t k = 0; k < model->surface->corners; k++)
            *value_at(batch, e, SURFACE_V, 2 * k + (mode == OPENS)) = sign * speed;
    }
}

/* What full breaks of the row dissipate: G_c of its area, or delta_c/2 times the peaks of its
 * points by their weights. */
static double energy_of_row(const fracas_batch *batch, const fracas_record *record,
                            const bool *in_row)
{
    const fracas_model *model = batch->model;
    const fracas_cohesive *law = &model->spec.cohesive;
    static const double weight[2][3] = {{0.5, 0.5}, {5.0 / 18, 8.0 / 18, 5.0 / 18}};
    const int order = model->surface->order;
    double energy = 0;
    for (size_t i = 0; i < model->interfaces; i++) {
        const fracas_surface_interface *joint = &model->surface->interface[i];
        if (!in_row[i]) continue;
        const double *a = node_at(model, joint->element[0], joint->edge[0]),
                     *b = node_at(model, joint->element[0], (joint->edge[0] + 1) % 3);
        const double area = hypot(b[0] - a[0], b[1] - a[1]) * model->spec.geometry.thickness;
        for (int g = 0; g < order + 1; g++) {
            const double peak = *surface_point(model, &batch->step, i, g, SURFACE_PEAK, 0);
            if (law->onset == &fracas_onset_flux)
                assert_true(peak == record->interface[i].strength);
            energy += weight[order - 1][g] * area *
                      (law->critical_opening > 0 ? law->critical_opening * peak / 2
                                                 : law->fracture_energy);
        }
    }
    return energy;
}

/* The row breaks and nothing else: what that dissipates does not depend on how each point gets
 * there. Sums of some 40 terms. The two pieces are half the plate each; their centres have moved as
 * far as those who hold them at most, or a little more as they vibrate. */
static void check_row(const fracas_model *model, int mode, int64_t in_the_row)
{
    const double speed = 2, *size = &model->spec.geometry.width;
    OWN(fracas_batch) batch = lane_of(model, 0.2, 6, 10);
    OWNED bool *in_row = zeroed(model->interfaces, sizeof *in_row);
    double(*at)[3] = taken(model->interfaces * sizeof *at);
    fracas_model_interface_positions(model, at);
    int64_t row = 0;
    for (size_t i = 0; i < model->interfaces; i++) {
        in_row[i] = fabs(at[i][1]) < 1e-9;
        row += in_row[i];
        bar_set_strength(batch, 0, i, in_row[i] ? (120 + 5.0 * (double)(i % 13)) * 1e6 : 8e8);
    }
    RECORD(record);
    OK(fracas_batch_begin(batch));
    move_halves(batch, mode, speed);
    run_to_end(batch, &record);
    const double energy = energy_of_row(batch, &record, in_row), half = size[0] * size[1] / 2;
    print_message("order %d, %s, onset %s, beta_c %.1f, %s: %lld broken of %lld cracked, "
                  "dissipated within %.1e, residual %.1e of it, created %.1e\n",
                  model->surface->order, mode == OPENS ? "opens" : "slides",
                  model->spec.cohesive.onset->name, model->spec.cohesive.coupling,
                  model->spec.cohesive.critical_opening > 0 ? "delta_c" : "G_c",
                  (long long)record.broken, (long long)record.cracked,
                  fabs(record.dissipated / energy - 1), record.residual / record.dissipated,
                  record.created / record.dissipated);
    assert_true(row == in_the_row && record.cracked == row && record.broken == row &&
                record.outcome == FRACAS_FRAGMENTED);
    assert_true(fabs(record.dissipated / energy - 1) < 1e-13);
    if (model->spec.cohesive.critical_opening == 0)
        assert_true(fabs(record.dissipated / (model->spec.cohesive.fracture_energy * size[0] *
                                              model->spec.geometry.thickness) -
                         1) < 1e-12);
    double first = INFINITY;
    for (size_t i = 0; i < model->interfaces; i++) {
        const fracas_interface_row *r = &record.interface[i];
        assert_true(r->damage == (in_row[i] ? 1 : 0) && isnan(r->break_time) == !in_row[i] &&
                    isnan(r->onset_time) == !in_row[i]);
        if (in_row[i])
            assert_true(0 < r->onset_time && r->onset_time < r->break_time &&
                        r->break_time <= record.end_time);
        first = fmin(first, r->onset_time);
    }
    assert_true(record.onset_time == first && record.fragments == 2 && record.fragments_dust == 0);
    for (int f = 0; f < 2; f++) {
        const fracas_fragment *part = &record.fragment[f];
        const double sign = part->position[1] > 0 ? 1 : -1, moved = 2 * speed * record.end_time;
        assert_true(fabs(part->mass / (half * 3300 * 1e-3) - 1) < 1e-12 &&
                    fabs(part->size / sqrt(half) - 1) < 1e-12 && part->dust == 0);
        assert_int_equal(part->elements, model->elements / 2);
        assert_true(fabs(part->position[0]) < moved &&
                    fabs(part->position[1] - sign * size[1] / 4) < moved);
        assert_true(
            sign * (mode == OPENS ? part->position[1] - sign * size[1] / 4 : part->position[0]) >
            0);
        assert_true(part->position[2] == 0 && part->velocity[2] == 0);
    }
    assert_true(record.fragment[0].position[1] * record.fragment[1].position[1] < 0);
    free(at);
}

static void a_row_of_weak_interfaces(void **unused)
{
    for (int which = 0; which < 16; which++) {
        fracas_spec spec = brittle_plate(which % 2 + 1, which % 2 ? 2 : 4, 0, 2e-6);
        spec.geometry.height = 1.5e-3; /* flat: the halves of a higher one roll on each other */
        spec.geometry.edge[3] = spec.geometry.edge[4] = &fracas_edge_held;
        spec.cohesive.onset = onsets[which / 4 % 2];
        if (which / 8) {
            spec.cohesive.fracture_energy = 0;
            spec.cohesive.critical_opening = 1.2e-6;
        }
        OWN(fracas_model) model = distorted_model(spec, 0, 0);
        check_row(model, which / 2 % 2,
                  which % 2 ? 8 : 16); /* squares along x: 4 times those along y */
    }
}

/* ---- fragments and histories ---- */

static bool close_to(double a, double b, double scale)
{
    return fabs(a - b) <= 1e-12 * scale;
}

/* Fragments anew, from the state and the interfaces' damage. Sums of some 1000 terms: 1e-13 of the
 * largest, 1e-12. */
static void check_fragments(const fracas_batch *batch, const fracas_record *record,
                            const size_t *label)
{
    const fracas_model *model = batch->model;
    double momentum[2] = {0}, scale = 0;
    int64_t dust = 0;
    size_t f = 0;
    for (size_t root = 0; root < model->elements;
         root++) { /* in the order of their smallest elements */
        membrane_sums sums = {0};
        if (label[root] != root) continue;
        for (size_t e = 0; e < model->elements; e++)
            if (label[e] == root) add_sums(batch, e, &sums);
        const fracas_fragment *part = &record->fragment[f++];
        double area = sums.mass / (3300 * 1e-3), x[2], v[2];
        for (int i = 0; i < 2; i++) {
            x[i] = sums.centre[i] / sums.mass;
            v[i] = sums.momentum[i] / sums.mass;
            momentum[i] += sums.momentum[i];
            assert_true(close_to(part->position[i], x[i], 3e-3) &&
                        close_to(part->velocity[i], v[i], sums.scale / sums.mass));
        }
        scale += sums.scale;
        const double spin = sums.moment_moved - sums.mass * (x[0] * v[1] - x[1] * v[0]);
        assert_true(close_to(part->angular_momentum[2], spin, 3e-3 * sums.scale) && fabs(spin) > 0);
        assert_true(close_to(part->mass, sums.mass, sums.mass) &&
                    close_to(part->size, sqrt(area), sqrt(area)));
        assert_true(part->elements == sums.elements && part->dust == (sums.elements <= 2));
        dust += sums.elements <= 2;
    }
    assert_true(f == record->nfragment && record->fragments == (int64_t)f &&
                record->fragments_dust == dust && dust > 0);
    for (int i = 0; i < 2; i++) assert_true(close_to(record->momentum[i], momentum[i], scale));
}

/* A row's counts are those of the interfaces that had broken by then; an interface's mean damage is
 * 1 only when it is broken. */
static void check_history(const fracas_model *model, const fracas_record *record, size_t *label)
{
    int64_t before = 0;
    for (size_t h = 0; h < record->nhistory; h++) {
        const fracas_history_row *row = &record->history[h];
        int64_t broken = 0;
        for (size_t i = 0; i < model->interfaces; i++)
            broken += record->interface[i].break_time <= row->time;
        assert_int_equal(row->broken, broken);
        assert_int_equal(row->fragments, label_fragments(model, record->interface, is_not_broken_by,
                                                         row->time, label));
        assert_true(row->broken >= before);
        before = row->broken;
    }
    double first = INFINITY;
    int64_t cracked = 0, broken = 0;
    for (size_t i = 0; i < model->interfaces; i++) {
        const fracas_interface_row *r = &record->interface[i];
        first = fmin(first, r->onset_time);
        cracked += !isnan(r->onset_time);
        broken += !isnan(r->break_time);
        assert_true((r->damage == 1) == !isnan(r->break_time) && !(r->break_time < r->onset_time));
    }
    assert_true(record->onset_time == first && record->cracked == cracked &&
                record->broken == broken);
    assert_true(record->history[record->nhistory - 1].time == record->end_time);
}

static void fragments_and_histories_of_a_plate(void **unused)
{
    for (int which = 0; which < 4 * MEMBRANE_LAWS; which++) {
        fracas_spec spec = brittle_plate(which % 2 + 1, which % 2 ? 5 : 8, 2e4, 6e-7);
        if (which / 2 % 2) spec.time.mass = &fracas_mass_consistent;
        set_listed_law(&spec, which / 4);
        if (!fracas_law_of(&spec)->flux) spec.time.safety = 0.1;
        OWN(fracas_model) model = distorted_model(spec, DISTORTION, 3);
        OWN(fracas_batch) batch = lane_of(model, 0.3, (uint64_t)which, 60);
        RECORD(record);
        OK(fracas_batch_run(batch, &record));
        OWNED size_t *label = taken(model->elements * sizeof *label);
        assert_int_equal(record.fragments,
                         label_fragments(model, record.interface, is_not_broken, 0, label));
        print_message("order %d, %s, %s: %lld fragments, %zu rows\n", model->surface->order,
                      spec.cohesive.law->name, spec.time.mass->name, (long long)record.fragments,
                      record.nhistory);
        assert_true(record.fragments > 10 && record.nhistory > 50);
        check_fragments(batch, &record, label);
        check_history(model, &record, label);
    }
}

/* Two of three points broken, the third by the last bit not: the weighted mean rounds to 1, but it
 * holds. At rest nothing changes. */
static void an_interface_holds_by_its_last_point(void **unused)
{
    fracas_spec spec = brittle_plate(2, 1, 0, 1e-7);
    OWN(fracas_model) model = distorted_model(spec, 0, 0);
    OWN(fracas_batch) batch = lane_of(model, 0, 0, 0);
    RECORD(record);
    OK(fracas_batch_begin(batch));
    for (size_t i = 0; i < model->interfaces; i++)
        for (int g = 0; g < 3; g++) {
            *surface_point(model, &batch->step, i, g, SURFACE_PEAK, 0) = BAR_STRENGTH_MEAN;
            *surface_point(model, &batch->step, i, g, SURFACE_DAMAGE, 0) = g < 2 ? 1 : 1 - 0x1p-53;
        }
    run_to_end(batch, &record);
    assert_true(record.fragments == 1 && record.nfragment == 1 && record.broken == 0 &&
                record.interface[0].damage < 1);
}

/* A row for every step shows the first maximum of the elastic energy that is followed by a fall of
 * `drop` of it, and that the run ends at the first step after that fall and from `multiple` of the
 * maximum's time on. */
static void check_stop(const fracas_model *model, uint64_t replica)
{
    const fracas_time *rule = &model->spec.time;
    OWN(fracas_batch) batch = lane_of(model, 0.3, replica, 100000);
    RECORD(record);
    OK(fracas_batch_run(batch, &record));
    assert_int_equal(record.nhistory, record.steps + 1);
    double peak = 0, time = 0;
    bool fallen = false;
    for (size_t h = 0; h < record.nhistory; h++) {
        const fracas_history_row *row = &record.history[h];
        const double elastic = row->elastic;
        if (!fallen && elastic > peak) peak = elastic, time = row->time;
        fallen = fallen || elastic < (1 - rule->drop) * peak;
        assert_true((fallen && row->time >= rule->multiple * time) == (h + 1 == record.nhistory));
    }
    print_message("multiple %.1f, drop %.2f: peak at %.2f ns of %.2f ns\n", rule->multiple,
                  rule->drop, 1e9 * time, 1e9 * record.end_time);
    assert_true(record.outcome == (record.broken > 0 ? FRACAS_FRAGMENTED : FRACAS_INTACT) &&
                time > record.onset_time && record.end_time < rule->end);
}

static void it_stops_at_the_multiple_of_the_peak(void **unused)
{
    for (int which = 0; which < 2; which++) {
        fracas_spec spec = brittle_plate(1, 8, 2e4, 2e-6);
        spec.time.safety = 0.1;
        spec.time.stop = &fracas_stop_peak_multiple;
        spec.time.multiple = which ? 1 : 1.7;
        spec.time.drop = which ? 0.5 : 0.05;
        OWN(fracas_model) model = distorted_model(spec, DISTORTION, 3);
        for (uint64_t replica = 0; replica < 4; replica++) check_stop(model, replica);
    }
}

TESTS(onsets_under_uniform_stress, two_triangles_crack_and_break_in_time, a_row_of_weak_interfaces,
      fragments_and_histories_of_a_plate, an_interface_holds_by_its_last_point,
      it_stops_at_the_multiple_of_the_peak)
