/* Replay of another code: DynFrag1D's rigid links on its own strengths (tests/data/dynfrag1d), step by step. */
#include "tests/support/bar.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { W_LEFT, W_RIGHT, V_LEFT, V_RIGHT, DAMAGE, STRENGTH, FIELDS = 7 };
enum { N = 1250, STEPS = 500 };

#define RATE 1e5
#define LENGTH 0.05
#define NOMINAL 300e6

typedef struct {
    double time, potential, kinetic, dissipated, reversible, contact, work, stress;
    long fragments, inserted;
} history_row;

static FILE *open_data(const char *name)
{
    char path[512];
    snprintf(path, sizeof path, "%s/tests/data/dynfrag1d/r1e5_N1250_diag%s", FRACAS_SOURCE_DIR, name);
    FILE *file = fopen(path, "r");
    if (!file) fail_msg("cannot open %s", path);
    char head[512];
    assert_non_null(fgets(head, sizeof head, file));
    return file;
}

static void read_strengths(double *strength)
{
    FILE *file = open_data("_strength.csv");
    for (int i = 0; i < N; i++) {
        int interface;
        assert_int_equal(fscanf(file, "%d,%lf", &interface, &strength[i]), 2);
        assert_int_equal(interface, i);
    }
    fclose(file);
}

static int read_history(history_row *row)
{
    FILE *file = open_data("_history.csv");
    int n = 0;
    while (n < STEPS && fscanf(file, "%lf,%lf,%lf,%lf,%lf,%lf,%lf,%ld,%ld,%lf", &row[n].time, &row[n].potential, &row[n].kinetic,
                  &row[n].dissipated, &row[n].reversible, &row[n].contact, &row[n].work, &row[n].fragments, &row[n].inserted,
                  &row[n].stress) == 10)
        n++;
    fclose(file);
    return n;
}

static double *field(fracas_batch *batch, size_t element, int which)
{
    return batch->step.state + element * FIELDS + (size_t)which;
}

/* The quantities that the other code writes, from our state: its frame is the laboratory's, its dissipated energy uses the
 * nominal strength, a fragment ends where damage exceeds 0.99, and a link counts as inserted from the next step on. */
static history_row observe(fracas_batch *batch, const double *velocity_before)
{
    history_row now = {.time = batch->step.time[0], .potential = batch->step.elastic[0],
                       .reversible = batch->step.cohesive[0], .fragments = 1};
    const double h = LENGTH / N, nodal = 0.5 * 2750 * h;
    for (size_t e = 0; e < N; e++) {
        for (size_t side = 0; side < 2; side++) {
            double x = h * (double)(e + side) - LENGTH / 2;
            double v = RATE * x + 0.5 * (velocity_before[2 * e + side] + *field(batch, e, V_LEFT + (int)side));
            now.kinetic += 0.5 * nodal * v * v;
        }
        if (e + 1 == N) break;
        double damage = *field(batch, e, DAMAGE);
        now.dissipated += 0.5 * NOMINAL * damage * 2 * 100 / *field(batch, e, STRENGTH);
        now.fragments += damage > 0.99;
    }
    return now;
}

static double end_stress(fracas_batch *batch, size_t e)
{
    return 275e9 * (RATE * batch->step.time[0] + (*field(batch, e, W_RIGHT) - *field(batch, e, W_LEFT)) / (LENGTH / N));
}

static void dynfrag1d_is_replayed_to_1e_8_with_every_count(void **unused)
{
    (void)unused;
    static double strength[N];
    static history_row reference[STEPS];
    read_strengths(strength);
    assert_int_equal(read_history(reference), STEPS);

    fracas_spec spec = bar_reference(N, RATE, 1);
    spec.geometry.ends = &fracas_ends_held;
    spec.geometry.area = 1.0;
    spec.cohesive.law = &fracas_law_rigid_link;
    fracas_model *model;
    assert_ok(fracas_model_create(&spec, &model));
    model->time_step = reference[1].time; /* 0.1 h/c as that code rounds it */
    fracas_batch *batch;
    const fracas_batch_options options = {.width = 1, .isa = FRACAS_ISA_BEST};
    assert_ok(fracas_batch_create(model, 1, &options, &batch));
    for (size_t i = 0; i + 1 < N; i++) bar_set_strength(batch, 0, i, strength[i]);
    assert_ok(fracas_batch_begin(batch));

    double before[2 * N], work = 0, power_before = 0, scale[4] = {0}, worst[4] = {0};
    for (int n = 0; n < STEPS; n++) {
        scale[0] = fmax(scale[0], fabs(reference[n].potential));
        scale[1] = fmax(scale[1], fabs(reference[n].dissipated));
        scale[2] = fmax(scale[2], fabs(reference[n].reversible + reference[n].contact));
        scale[3] = fmax(scale[3], fabs(reference[n].work));
    }
    fracas_record record;
    fracas_record_init(&record);
    double worst_kinetic = 0;
    for (int n = 0; n < STEPS; n++) {
        size_t running;
        for (size_t e = 0; e < N; e++) {
            before[2 * e] = *field(batch, e, V_LEFT);
            before[2 * e + 1] = *field(batch, e, V_RIGHT);
        }
        assert_ok(fracas_batch_step(batch, &record, &running));
        history_row now = observe(batch, before);
        double power = 0.5 * RATE * LENGTH * (end_stress(batch, 0) + end_stress(batch, N - 1));
        if (n > 0) work += 0.5 * model->time_step * (power_before + power);
        power_before = power;
        const double ours[4] = {now.potential, now.dissipated, now.reversible, work};
        const double theirs[4] = {reference[n].potential, reference[n].dissipated,
                                  reference[n].reversible + reference[n].contact, reference[n].work};
        for (int k = 0; k < 4; k++) worst[k] = fmax(worst[k], fabs(ours[k] - theirs[k]) / scale[k]);
        worst_kinetic = fmax(worst_kinetic, fabs(now.kinetic / reference[n].kinetic - 1));
        assert_int_equal(now.fragments, reference[n].fragments);
    }
    print_message("[  figures ] largest difference: potential %.1e, dissipated %.1e, cohesive and contact %.1e, work %.1e "
                  "(of the column's largest value), kinetic %.1e; last count %ld\n", worst[0], worst[1], worst[2], worst[3],
                  worst_kinetic, reference[STEPS - 1].fragments);
    for (int k = 0; k < 4; k++) assert_true(worst[k] < 1e-8);
    /* 1e-8 of the peculiar energies, which are some 1e-3 of this laboratory-frame sum: 1e-11, and its own rounding */
    assert_true(worst_kinetic < 1e-11);
    /* end value of the other code's summary, with each link's own strength */
    assert_true(fabs(batch->step.dissipated[0] / 69731.9789710661 - 1) < 1e-8);
    assert_int_equal(reference[STEPS - 1].fragments, 417);
    fracas_batch_destroy(batch);
    fracas_model_destroy(model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(dynfrag1d_is_replayed_to_1e_8_with_every_count)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
