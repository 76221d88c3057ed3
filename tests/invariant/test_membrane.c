/* SPDX-License-Identifier: GPL-3.0-or-later */
/* ctest-labels: slow-sanitize */
/* Membranes that break: lanes do not depend on each other, momenta are kept, ledgers close, and the
 * numbers of nodes and elements and the directions of axes do not matter. */
#include "tests/support/lanes.h"
#include "tests/support/membrane_cracks.h"
#include "tests/support/test.h"

/* ---- lanes ---- */

typedef struct {
    int64_t order;
    const fracas_kind *law;
    double friction;
    const fracas_kind *onset, *integrator, *mass;
} variant;

#define N &fracas_law_nitsche.kind
#define S &fracas_law_camacho_ortiz_standard.kind
#define P &fracas_law_camacho_ortiz.kind
#define MEAN &fracas_onset_mean
#define FLUX &fracas_onset_flux
#define CD &fracas_integrator_central_difference
#define HC &fracas_integrator_hulbert_chung
#define L &fracas_mass_lumped
#define C &fracas_mass_consistent
/* Every order with every law with and without friction; onsets, schemes and masses in all pairs.
 * Every second pair has a strength for each Gauss point. */
static const variant variants[] = {
    {1, N, 0, MEAN, CD, L},   {2, N, 0, FLUX, HC, C},   {1, S, 0, FLUX, CD, C},
    {2, S, 0, MEAN, HC, L},   {1, P, 0, MEAN, HC, C},   {2, P, 0, FLUX, CD, L},
    {1, N, 0.3, FLUX, HC, L}, {2, N, 0.3, MEAN, CD, C}, {1, S, 0.3, MEAN, HC, C},
    {2, S, 0.3, FLUX, CD, L}, {1, P, 0.3, FLUX, CD, L}, {2, P, 0.3, MEAN, HC, C}};
enum { VARIANTS = sizeof variants / sizeof *variants };
#undef N
#undef S
#undef P
#undef MEAN
#undef FLUX
#undef CD
#undef HC
#undef L
#undef C

static fracas_spec spec_of(const variant *v, int64_t divisions, double rate, double end)
{
    fracas_spec spec = brittle_plate(v->order, divisions, rate, end);
    spec.cohesive.law = v->law;
    spec.cohesive.friction = v->friction;
    spec.cohesive.onset = v->onset;
    if (v->friction > 0) spec.cohesive.coupling = 0.8;
    spec.time.integrator = v->integrator;
    spec.time.mass = v->mass;
    spec.strength_per_point = (v - variants) / 2 % 2;
    return spec;
}

static void a_lane_is_its_run_alone(void **unused)
{
    const lane_kind kind = {.scatter = 0.3};
    for (int v = 0; v < VARIANTS; v++) {
        OWN(fracas_model) model = distorted_model(
            spec_of(&variants[v], variants[v].order == 1 ? 10 : 6, 3e4, 4e-7), DISTORTION, 3);
        fracas_record alone[8];
        int64_t fewest = INT64_MAX, most = 0, cracked = 0;
        run_alone(model, &kind, alone);
        for (size_t r = 0; r < 8; r++) {
            fewest = alone[r].fragments < fewest ? alone[r].fragments : fewest;
            most = alone[r].fragments > most ? alone[r].fragments : most;
            cracked += alone[r].cracked;
        }
        print_message(
            "variant %2d: %zu elements, %lld to %lld fragments, %lld cracked interfaces a lane\n",
            v, model->elements, (long long)fewest, (long long)most, (long long)cracked / 8);
        assert_true(fewest > 1 && most > fewest); /* they break, and are different */
        check_lanes(model, &kind, alone);
    }
}

/* ---- momenta ---- */

/* Every force is a derivative by the displacements of an expression in strains and jumps, whose
 * traction and carried opening may be anything: a translation or a small rotation of the body as it
 * was at the start changes neither, so that sums of M v and X x M v do not change, in each law,
 * cracked or not. The sum of x x M v with x = X + u differs from that of X by u x M v: not kept,
 * the formulation is linear. Round-off: in each step each velocity is rounded, 1.1e-16 of it, and
 * gets the rounded sum of some 20 forces that cancel in part, of which none kicks by more than the
 * velocity itself; the steps are independent of each other, but were they not, 20 x 1.1e-16 of the
 * sum of |M v| in each of some 500 steps would be 1e-12: the bound. */
static void momenta_are_kept_to_round_off(void **unused)
{
    for (int v = 0; v < VARIANTS; v++) {
        OWN(fracas_model) model = distorted_model(spec_of(&variants[v], 6, 3e4, 4e-7), DISTORTION,
                                                  3);
        OWN(fracas_batch) batch = lane_of(model, 0.3, 1, 0);
        RECORD(record);
        OK(fracas_batch_begin(batch));
        /* 1/s, m/s: velocities as large as those of the expansion */
        const surface_momenta before = check_momenta(batch, (const double[3]){20, -35, 0},
                                                     (const double[3]){0, 0, 2e4}, &record);
        const membrane_sums after = sums_of(batch);
        double sum[2] = {0}, moment = 0;
        for (size_t f = 0; f < record.nfragment; f++) {
            const fracas_fragment *part = &record.fragment[f];
            for (int i = 0; i < 2; i++) sum[i] += part->mass * part->velocity[i];
            moment += part->angular_momentum[2] +
                      part->mass * (part->position[0] * part->velocity[1] -
                                    part->position[1] * part->velocity[0]);
        }
        for (int i = 0; i < 2; i++)
            assert_true(fabs(sum[i] - before.momentum[i]) < 1e-12 * before.size);
        assert_true(fabs(moment - after.moment_moved) < 1e-12 * 3e-3 * after.scale);
    }
}

/* A plate whose nodes are anywhere near their places, and fly and turn as one body: its spin is how
 * it turns, by whatever masses it moves. Places and velocities are rounded to 1.1e-16 of 3 mm and
 * 200 m/s, sums are of some 400 nodes: 1e-12. */
static void a_body_that_turns_has_that_spin(void **unused)
{
    uint64_t state = 7;
    for (int v = 0; v < VARIANTS; v++) {
        OWN(fracas_model) model = distorted_model(spec_of(&variants[v], 6, 0, 4e-7), DISTORTION, 3);
        OWN(fracas_batch) batch = lane_of(model, 0.3, 1, 0);
        RECORD(record);
        OK(fracas_batch_begin(batch));
        const double spin = v % 2 ? 2e4 : -3e4, drift[2] = {20, -35};
        for (size_t e = 0; e < model->elements; e++)
            for (size_t k = 0; k < model->surface->corners; k++) {
                double x[2];
                for (int i = 0; i < 2; i++) {
                    *value_at(batch, e, SURFACE_U, 2 * k + (size_t)i) = 3e-4 * random_noise(&state);
                    x[i] = node_at(model, e, k)[i] +
                           *value_at(batch, e, SURFACE_U, 2 * k + (size_t)i);
                }
                *value_at(batch, e, SURFACE_V, 2 * k) = drift[0] - spin * x[1];
                *value_at(batch, e, SURFACE_V, 2 * k + 1) = drift[1] + spin * x[0];
            }
        OK(model->formulation->harvest(model, &batch->step, 0, &record));
        assert_int_equal(record.nfragment, 1);
        const fracas_fragment *whole = &record.fragment[0];
        assert_true(fabs(whole->spin[2] / spin - 1) < 1e-12 && whole->spin[0] == 0 &&
                    whole->spin[1] == 0);
    }
}

/* ---- the ledger ---- */

/* Loads and edges of which each puts work into the ledger in its own way. */
enum {
    FREE,
    FREE_FRICTION,
    FREE_CONSISTENT,
    HELD_MOVING,
    HELD_REST,
    SLIDING,
    RUBBING,
    SPINNING,
    LEDGERS
};
static const char *const ledger_name[LEDGERS] = {"free",
                                                 "free, friction",
                                                 "free, consistent, quadratic",
                                                 "held, moving",
                                                 "held, from rest",
                                                 "sliding, friction",
                                                 "sheared, extrinsic",
                                                 "turned"};

static fracas_spec ledger_spec(int which)
{
    fracas_spec spec = brittle_plate(which == FREE_CONSISTENT ? 2 : 1,
                                     which == FREE_CONSISTENT ? 4 : 8, 2e4, 6e-7);
    if (which == FREE_FRICTION || which == SLIDING) spec.cohesive.friction = 0.4;
    if (which == SLIDING) spec.cohesive.coupling = 0.7;
    if (which == FREE_CONSISTENT) spec.time.mass = &fracas_mass_consistent;
    if (which == HELD_MOVING || which == HELD_REST) hold_edges(&spec, &fracas_edge_held);
    if (which == HELD_REST) spec.loading.start = &fracas_start_rest;
    if (which == SLIDING) hold_edges(&spec, &fracas_edge_sliding);
    if (which == RUBBING) { /* pressed along y, so that faces slide on each other */
        hold_edges(&spec, &fracas_edge_held);
        spec.cohesive.law = &fracas_law_camacho_ortiz_standard.kind;
        spec.cohesive.friction = 0.5;
        spec.loading.ratio = -1;
    }
    if (which == SPINNING) {
        spec.loading = (fracas_loading){
            .type = &fracas_loading_centrifugal, .speed = 3e5, .ramp = 2e-7};
        spec.cohesive.onset = &fracas_onset_flux;
    }
    return spec;
}

static ledger_figures ledger_of(int which, const fracas_kind *integrator, double safety)
{
    fracas_spec spec = ledger_spec(which);
    spec.time.integrator = integrator;
    spec.time.safety = which == RUBBING ? safety / 5 : safety; /* cohesive.md */
    OWN(fracas_model) model = distorted_model(spec, DISTORTION, 3);
    return break_up(model, 0, 4, 0.3, NULL);
}

/* Between events the residual is that of central difference with forces that bend (onsets,
 * unloading, contact): dt^2 each, 4 by a halving, and 2.5 because they fall on other instants. A
 * break takes the mean stress m away with it: the forces jump, and half a step of the power of that
 * jump, dt/2 d(m^2/2K)/dt, is missed. With waves as short as the mesh, up to w_max, m^2/2K changes
 * by w_max of itself, and dt/2 w_max = safety: at most safety times what is created, of the first
 * order in dt. It shows where edges start with a jolt, in quadratic elements, which have the higher
 * frequencies, and where the load does not let go. Hulbert-Chung, of which the ledger counts what
 * it damps, keeps the same bounds. */
static void check_ledgers(const fracas_kind *integrator)
{
    for (int which = 0; which < LEDGERS; which++) {
        ledger_figures at[3];
        for (int half = 0; half < 3; half++)
            at[half] = ledger_of(which, integrator, 0.5 / (1 << half));
        print_message("%-18s %-28s %lld broken, residual/dissipated %.2e %.2e %.2e, created %.2e, "
                      "work %.2f\n",
                      integrator->name, ledger_name[which], (long long)at[2].broken, at[0].residual,
                      at[1].residual, at[2].residual, at[2].created, at[2].work);
        assert_true(at[2].broken > 100);
        assert_true((which >= HELD_MOVING) ==
                    (at[2].work > 1)); /* what holds the edges, or turns the plate, does work */
        const bool smooth = which == FREE || which == FREE_FRICTION || which == HELD_MOVING ||
                            which == SLIDING || which == RUBBING;
        for (int half = 0; half < 3; half++) { /* 1e-3 at the step of campaigns */
            const double safety = 0.5 / (1 << half), square = (safety / 0.25) * (safety / 0.25);
            assert_true(at[half].residual < 1e-3 * square + (smooth ? 0 : safety * at[2].created));
        }
        if (smooth) assert_true(at[2].residual < at[0].residual / (2.5 * 2.5));
    }
}

static void ledgers_close_to_second_order(void **unused)
{
    check_ledgers(&fracas_integrator_central_difference);
    check_ledgers(&fracas_integrator_hulbert_chung);
}

/* ---- numbers and axes ---- */

/* The same plate turned by a quarter (x, y) -> (-y, x), or mirrored (x, y) -> (-x, y): exact in
 * floating point. */
static void move(bool mirrored, const double x[3], double to[3])
{
    to[0] = mirrored ? -x[0] : -x[1];
    to[1] = mirrored ? x[1] : x[0];
    to[2] = x[2];
}

/* Elements of a mirrored mesh go round from vertex 0 the other way: their edge k is 2 - k, their
 * vertices and middles swap. */
static fracas_model *moved_model(const fracas_model *model, bool mirrored)
{
    static const size_t turned_round[6] = {0, 2, 1, 5, 4, 3};
    fracas_surface s = *model->surface;
    double(*node)[3] = taken(s.nnodes * sizeof *node);
    OWNED uint32_t *element = taken(s.nelements * s.corners * sizeof *element);
    OWNED fracas_surface_border *border = taken(s.nborders * sizeof *border);
    for (size_t n = 0; n < s.nnodes; n++) move(mirrored, s.node[n], node[n]);
    for (size_t e = 0; e < s.nelements; e++)
        for (size_t k = 0; k < s.corners; k++)
            element[e * s.corners + k] =
                s.element[e * s.corners + (mirrored ? turned_round[k] : k)];
    for (size_t b = 0; b < s.nborders; b++) {
        border[b] = s.border[b];
        if (mirrored) border[b].edge = 2 - border[b].edge;
    }
    s.node = (const double(*)[3])node;
    s.element = element;
    s.border = border;
    fracas_spec spec = model->spec;
    if (!mirrored) {
        spec.loading.rate = model->spec.loading.rate * model->spec.loading.ratio;
        spec.loading.ratio = 1 / model->spec.loading.ratio;
    }
    fracas_model *moved = mesh_model(spec, &s);
    moved->tolerance = 1e300;
    free(node);
    return moved;
}

/* image[k]: strength of the moved model that k has become. */
static size_t *images_of(const fracas_model *model, const fracas_model *moved, bool mirrored)
{
    const size_t n = strengths_of(model);
    double(*from)[3] = malloc(n * sizeof *from), (*to)[3] = malloc(n * sizeof *to);
    size_t *image = malloc(n * sizeof *image);
    assert_true(from && to && image && strengths_of(moved) == n);
    fracas_model_interface_positions(model, from);
    fracas_model_interface_positions(moved, to);
    for (size_t i = 0; i < n; i++) {
        double at[3], nearest = INFINITY;
        move(mirrored, from[i], at);
        for (size_t j = 0; j < n; j++) {
            const double distance = hypot(at[0] - to[j][0], at[1] - to[j][1]);
            if (distance < nearest) nearest = distance, image[i] = j;
        }
        assert_true(nearest < 1e-15); /* of some mm: round-off */
    }
    free(from);
    free(to);
    return image;
}

/* Turned round, sums have their terms in another order: energies differ by the round-off of some
 * 100 steps, 1e-14 of the whole, as long as nothing has broken: 1e-13. Later they may part as
 * trajectories do that meet at events, 1e-10 is what a mistake of the direction in one of 200
 * interfaces would exceed a million times. The extrinsic laws' stiffness has no bound as a crack
 * begins to open; at half the critical step they make 1e-4 of round-off within these times, at a
 * tenth they do not. */
static void check_moved(const variant *v, bool mirrored)
{
    fracas_spec spec = spec_of(v, v->order == 1 ? 8 : 5, 4e4, 4e-7);
    spec.loading.ratio = 0.5;
    if (!fracas_law_of(&spec)->flux) spec.time.safety = 0.1;
    OWN(fracas_model) model = distorted_model(spec, DISTORTION, 3),
                      *moved = moved_model(model, mirrored);
    size_t *image = images_of(model, moved, mirrored), stride;
    moved->time_step = model->time_step; /* Lanczos' iteration starts from numbers of unknowns */
    OWN(fracas_batch) a = lane_of(model, 0.3, 2, 0), *b = lane_of(moved, 0.3, 2, 0);
    const double *from = fracas_batch_strength(a, 0, &stride);
    double *to = fracas_batch_strength(b, 0, &stride);
    for (size_t k = 0; k < strengths_of(model); k++) to[image[k] * stride] = from[k * stride];
    OK(fracas_batch_begin(a));
    OK(fracas_batch_begin(b));
    fracas_record record[2];
    for (int k = 0; k < 2; k++) fracas_record_init(&record[k]);
    double early = 0, late = 0;
    for (size_t running[2] = {1, 1}; running[0] > 0;) {
        OK(fracas_batch_step(a, &record[0], &running[0]));
        OK(fracas_batch_step(b, &record[1], &running[1]));
        assert_true(running[0] == running[1]);
        const fracas_step *s = &a->step, *t = &b->step;
        const double differences[] = {s->kinetic[0] - t->kinetic[0], s->elastic[0] - t->elastic[0],
                                      s->cohesive[0] - t->cohesive[0],
                                      s->dissipated[0] - t->dissipated[0]};
        const double worst = largest_of(differences, 4) / a->lane[0].ledger.initial;
        if (s->broken[0] == 0) early = fmax(early, worst);
        late = fmax(late, worst);
    }
    double times = 0;
    for (size_t i = 0; i < model->interfaces; i++) {
        const fracas_interface_row
            *p = &record[0].interface[i],
            *q = &record[1].interface[image[i * model->strengths] / model->strengths];
        assert_true(p->strength == q->strength);
        assert_int_equal(isnan(p->onset_time), isnan(q->onset_time));
        assert_int_equal(isnan(p->break_time), isnan(q->break_time));
        if (!isnan(p->onset_time))
            times = fmax(times, fabs(p->onset_time - q->onset_time) / record[0].end_time);
    }
    print_message("order %d, %s, %s: %lld steps, %lld cracked, %lld fragments; energies within "
                  "%.1e, %.1e at last, onsets %.1e\n",
                  (int)v->order, v->law->name, mirrored ? "mirrored" : "turned",
                  (long long)record[0].steps, (long long)record[0].cracked,
                  (long long)record[0].fragments, early, late, times);
    assert_true(record[0].fragments == record[1].fragments && record[0].broken > 10);
    assert_true(early < 1e-13 && late < 1e-10 && times < 1e-10);
    for (int k = 0; k < 2; k++) fracas_record_clear(&record[k]);
    free(image);
}

static void numbers_and_axes_do_not_matter(void **unused)
{
    for (int v = 0; v < VARIANTS; v++) {
        check_moved(&variants[v], false);
        check_moved(&variants[v], true);
    }
}

TESTS(a_lane_is_its_run_alone, momenta_are_kept_to_round_off, a_body_that_turns_has_that_spin,
      ledgers_close_to_second_order, numbers_and_axes_do_not_matter)
