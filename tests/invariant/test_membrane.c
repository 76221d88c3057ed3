/* Membranes that break: lanes do not depend on each other, momenta are kept, ledgers close, and the numbers of nodes and
 * elements and the directions of axes do not matter. */
#include "tests/support/gmsh.h"
#include "tests/support/membrane_cracks.h"

/* ---- lanes ---- */

typedef struct {
    int64_t order;
    const fracas_kind *law;
    double friction;
    const fracas_kind *onset, *integrator, *mass;
} variant;

#define N &fracas_law_nitsche
#define S &fracas_law_camacho_ortiz_standard
#define P &fracas_law_camacho_ortiz
#define MEAN &fracas_onset_mean
#define FLUX &fracas_onset_flux
#define CD &fracas_integrator_central_difference
#define HC &fracas_integrator_hulbert_chung
#define L &fracas_mass_lumped
#define C &fracas_mass_consistent
/* Every order with every law with and without friction; onsets, schemes and masses in all pairs. */
static const variant variants[] = {
    {1, N, 0, MEAN, CD, L}, {2, N, 0, FLUX, HC, C}, {1, S, 0, FLUX, CD, C}, {2, S, 0, MEAN, HC, L},
    {1, P, 0, MEAN, HC, C}, {2, P, 0, FLUX, CD, L}, {1, N, 0.3, FLUX, HC, L}, {2, N, 0.3, MEAN, CD, C},
    {1, S, 0.3, MEAN, HC, C}, {2, S, 0.3, FLUX, CD, L}, {1, P, 0.3, FLUX, CD, L}, {2, P, 0.3, MEAN, HC, C}};
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
    return spec;
}

/* Replicas first, first + 1, ...; replica r is in place r - first. */
static void run(const fracas_model *model, uint64_t first, size_t count, int width, fracas_isa isa, fracas_record *record)
{
    fracas_batch *batch = batch_with(model, count, (fracas_batch_options){.history = 20, .interfaces = true, .width = width, .isa = isa});
    for (size_t l = 0; l < count; l++) bar_draw(batch, l, 0.3, first + l);
    for (size_t l = 0; l < count; l++) fracas_record_init(&record[l]);
    assert_ok(fracas_batch_run(batch, record));
    fracas_batch_destroy(batch);
}

static void assert_same(const fracas_record *a, const fracas_record *b)
{
    /* every scalar, then every row, byte by byte; pointers apart */
    assert_memory_equal(a, b, offsetof(fracas_record, fragment));
    assert_memory_equal(a->fragment, b->fragment, a->nfragment * sizeof *a->fragment);
    assert_memory_equal(a->history, b->history, a->nhistory * sizeof *a->history);
    assert_memory_equal(a->interface, b->interface, a->ninterface * sizeof *a->interface);
}

/* Replicas first to first + count - 1 in every place they can have in such a batch. */
static void check_batch(const fracas_model *model, const fracas_record alone[8], uint64_t first, size_t count, int width, fracas_isa isa)
{
    fracas_record together[8];
    run(model, first, count, width, isa, together);
    for (size_t l = 0; l < count; l++) {
        assert_same(&alone[first + l], &together[l]);
        fracas_record_clear(&together[l]);
    }
}

static void a_lane_is_its_run_alone(void **unused)
{
    (void)unused;
    for (int v = 0; v < VARIANTS; v++) {
        fracas_model *model = membrane_model(spec_of(&variants[v], variants[v].order == 1 ? 10 : 6, 3e4, 4e-7), DISTORTION, 3);
        fracas_record alone[8];
        int64_t fewest = INT64_MAX, most = 0, cracked = 0;
        for (size_t r = 0; r < 8; r++) {
            run(model, r, 1, 1, FRACAS_ISA_BASELINE, &alone[r]);
            fewest = alone[r].fragments < fewest ? alone[r].fragments : fewest;
            most = alone[r].fragments > most ? alone[r].fragments : most;
            cracked += alone[r].cracked;
        }
        print_message("variant %2d: %zu elements, %lld to %lld fragments, %lld cracked interfaces a lane\n", v, model->elements,
                      (long long)fewest, (long long)most, (long long)cracked / 8);
        assert_true(fewest > 1 && most > fewest); /* they break, and are different */
        for (fracas_isa isa = FRACAS_ISA_BASELINE; isa <= FRACAS_ISA_AVX512; isa++) {
            fracas_isa had;
            if (fracas_isa_choose(isa, &had)) {
                if (v == 0) print_message("[  skipped ] this CPU has no %s\n", fracas_isa_name[isa]);
                continue;
            }
            check_batch(model, alone, 7, 1, 1, isa);
            check_batch(model, alone, 2, 4, 4, isa);
            check_batch(model, alone, 0, 8, 8, isa);
        }
        check_batch(model, alone, 5, 3, 8, FRACAS_ISA_BEST); /* another place, and lanes that repeat the first */
        for (size_t r = 0; r < 8; r++) fracas_record_clear(&alone[r]);
        fracas_model_destroy(model);
    }
}

/* ---- momenta ---- */

/* Every force is a derivative by the displacements of an expression in strains and jumps, whose traction and carried opening may be
 * anything: a translation or a small rotation of the body as it was at the start changes neither, so that sums of M v and X x M v do
 * not change, in each law, cracked or not. The sum of x x M v with x = X + u differs from that of X by u x M v: not kept, the
 * formulation is linear.
 * Round-off: in each step each velocity is rounded, 1.1e-16 of it, and gets the rounded sum of some 20 forces that cancel in part, of
 * which none kicks by more than the velocity itself; the steps are independent of each other, but were they not, 20 x 1.1e-16 of the
 * sum of |M v| in each of some 500 steps would be 1e-12: the bound. */
static void momenta_are_kept_to_round_off(void **unused)
{
    (void)unused;
    for (int v = 0; v < VARIANTS; v++) {
        fracas_model *model = membrane_model(spec_of(&variants[v], 6, 3e4, 4e-7), DISTORTION, 3);
        fracas_batch *batch = lane_of(model, 0.3, 1, 0);
        fracas_record record;
        fracas_record_init(&record);
        assert_ok(fracas_batch_begin(batch));
        const double spin = 2e4, drift[2] = {20, -35}; /* 1/s, m/s: velocities as large as those of the expansion */
        for (size_t e = 0; e < model->elements; e++)
            for (size_t k = 0; k < model->surface->corners; k++) {
                const double *x = node_at(model, e, k);
                *membrane_state(batch, e, k, MEMBRANE_V, 0) += drift[0] - spin * x[1];
                *membrane_state(batch, e, k, MEMBRANE_V, 1) += drift[1] + spin * x[0];
            }
        const membrane_sums before = sums_of(batch);
        double worst = 0, turn = 0;
        const double arm = 3e-3;
        for (size_t running = 1; running > 0;) {
            assert_ok(fracas_batch_step(batch, &record, &running));
            const membrane_sums now = sums_of(batch);
            for (int i = 0; i < 2; i++) worst = fmax(worst, fabs(now.momentum[i] - before.momentum[i]) / before.scale);
            turn = fmax(turn, fabs(now.moment_at - before.moment_at) / (arm * before.scale));
        }
        const membrane_sums after = sums_of(batch);
        print_message("variant %2d: %lld fragments, momentum within %.1e, moment of momentum within %.1e\n", v, (long long)record.fragments,
                      worst, turn);
        assert_true(record.fragments > 3);
        assert_true(worst < 1e-12 && turn < 1e-12);
        assert_true(fabs(after.moment_at) > 1e-3 * arm * after.scale); /* there is one */
        double sum[2] = {0}, moment = 0;
        for (size_t f = 0; f < record.nfragment; f++) {
            const fracas_fragment *part = &record.fragment[f];
            for (int i = 0; i < 2; i++) sum[i] += part->mass * part->velocity[i];
            moment += part->angular_momentum[2] + part->mass * (part->position[0] * part->velocity[1] - part->position[1] * part->velocity[0]);
        }
        for (int i = 0; i < 2; i++) {
            assert_true(fabs(sum[i] - before.momentum[i]) < 1e-12 * before.scale);
            assert_true(fabs(record.momentum[i] - before.momentum[i]) < 1e-12 * before.scale);
        }
        assert_true(fabs(moment - after.moment_moved) < 1e-12 * arm * after.scale);
        fracas_record_clear(&record);
        fracas_batch_destroy(batch);
        fracas_model_destroy(model);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_lane_is_its_run_alone), cmocka_unit_test(momenta_are_kept_to_round_off)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
