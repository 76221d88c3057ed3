/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Runs of the public code DynFrag1D (tests/data/dynfrag1d), and the same bars in this engine, step
 * by step. */
#ifndef FRACAS_TESTS_SUPPORT_DYNFRAG1D_H
#define FRACAS_TESTS_SUPPORT_DYNFRAG1D_H

#include "tests/support/bar_state.h"
#include "tests/support/test.h"

typedef struct {
    const char *name;
    int elements, steps;
    int every;   /* steps from one kept row of its history to the next; the last step is kept too */
    double rate; /* 1/s */
    double time_step; /* s, 0.1 h/c as that code rounds it */
} dynfrag1d_run;

static const dynfrag1d_run dynfrag1d_runs[] = {
    {"r1e4_N1250", 1250, 2500, 25, 1e4, 4.0000000000000007e-10},
    {"r1e4_N2500", 2500, 5000, 50, 1e4, 2.0000000000000003e-10},
    {"r1e5_N1250", 1250, 500, 1, 1e5, 4.0000000000000007e-10},
};

enum { DYNFRAG1D_RUNS = 3, DYNFRAG1D_MOST_ROWS = 512 };
#define DYNFRAG1D_LENGTH 0.05   /* m */
#define DYNFRAG1D_NOMINAL 300e6 /* Pa */

/* One time, as that code writes it: energies in the laboratory's frame. */
typedef struct {
    double time, potential, kinetic;
    double
        nominal; /* J: its column of dissipated energy, every interface at the nominal strength */
    double dissipated; /* J, every interface at its own strength */
    double stored;     /* J, in openings and in contact */
    double work;
    long fragments; /* 1 + interfaces with D > 0.99 */
} dynfrag1d_row;

static inline FILE *dynfrag1d_open(const dynfrag1d_run *run, const char *end)
{
    char path[512];
    snprintf(path, sizeof path, "%s/tests/data/dynfrag1d/%s_diag%s", FRACAS_SOURCE_DIR, run->name,
             end);
    FILE *file = fopen(path, "r");
    if (!file) fail_msg("cannot open %s", path);
    return file;
}

/* Strengths of the elements - 1 interfaces [Pa], to be freed. */
static inline double *dynfrag1d_strengths(const dynfrag1d_run *run)
{
    FILE *file = dynfrag1d_open(run, "_strength.csv");
    double *strength = zeroed((size_t)run->elements, sizeof *strength);
    char head[256];
    assert_non_null(fgets(head, sizeof head, file));
    for (int i = 0; i < run->elements; i++) {
        int interface;
        assert_int_equal(fscanf(file, "%d,%lf", &interface, &strength[i]), 2);
        assert_int_equal(interface, i);
    }
    fclose(file);
    return strength;
}

/* Its history, without `dissipated` (dynfrag1d_own). */
static inline int dynfrag1d_history(const dynfrag1d_run *run, dynfrag1d_row *row)
{
    FILE *file = dynfrag1d_open(run, "_history.csv");
    char head[512];
    assert_non_null(fgets(head, sizeof head, file));
    int n = 0;
    double reversible, contact;
    while (n < DYNFRAG1D_MOST_ROWS &&
           fscanf(file, "%lf,%lf,%lf,%lf,%lf,%lf,%lf,%ld,%*d,%*f", &row[n].time, &row[n].potential,
                  &row[n].kinetic, &row[n].nominal, &reversible, &contact, &row[n].work,
                  &row[n].fragments) == 8) {
        row[n].stored = reversible + contact;
        n++;
    }
    fclose(file);
    assert_int_equal(n, (run->steps + run->every - 2) / run->every + 1);
    return n;
}

/* A number of its summary. */
static inline double dynfrag1d_summary(const dynfrag1d_run *run, const char *name)
{
    FILE *file = dynfrag1d_open(run, ".json");
    char line[512], key[64];
    double value = NAN;
    snprintf(key, sizeof key, "\"%s\":", name);
    while (fgets(line, sizeof line, file)) {
        const char *at = strstr(line, key);
        if (at) value = strtod(at + strlen(key), NULL);
    }
    fclose(file);
    return value;
}

/* ---- the same bar here ---- */

typedef struct {
    const dynfrag1d_run *run;
    fracas_model *model;
    fracas_batch *batch;
    fracas_record record;
    double *before;     /* velocities of all nodes half a step before the time of the last step */
    double work, power; /* J, W, of the ends */
    int steps;
} dynfrag1d_replay;

#define DYNFRAG1D_UNBREAKABLE \
    2e9 /* Pa: below what either law refuses at 2500 elements, never reached */

/* Its bar by `law`, every element cut into `refine`: the interfaces in between do not break.
 * `courant`: c dt/h of the finer mesh; 0 takes its own time step, to the bit. */
static inline void dynfrag1d_begin(dynfrag1d_replay *replay, const dynfrag1d_run *run,
                                   const fracas_kind *law, int refine, double courant,
                                   const double *strength)
{
    fracas_spec spec = bar_reference(run->elements * refine, run->rate, 1);
    spec.geometry.ends = &fracas_ends_held;
    spec.geometry.area = 1.0;
    spec.cohesive.law = law;
    *replay = (dynfrag1d_replay){.run = run};
    replay->model = make_model(&spec);
    replay->model->time_step = courant > 0 ? courant * replay->model->element_size / BAR_WAVE_SPEED
                                           : run->time_step;
    assert_true(replay->model->time_step < replay->model->critical_step);
    replay->batch = lane_of(replay->model, 0, 0, 0);
    for (size_t i = 1, m = (size_t)refine; i < replay->model->elements; i++)
        bar_set_strength(replay->batch, 0, i - 1,
                         i % m ? DYNFRAG1D_UNBREAKABLE : strength[i / m - 1]);
    OK(fracas_batch_begin(replay->batch));
    fracas_record_init(&replay->record);
    replay->before = zeroed(2 * replay->model->elements, sizeof *replay->before);
}

static inline void dynfrag1d_end(dynfrag1d_replay *replay)
{
    free(replay->before);
    fracas_batch_destroy(replay->batch);
    fracas_model_destroy(replay->model);
}

static inline double dynfrag1d_field(const dynfrag1d_replay *replay, size_t element, int which)
{
    return *field(replay->batch, element, which);
}

static inline double dynfrag1d_stress(const dynfrag1d_replay *replay, size_t e)
{
    double strain = (dynfrag1d_field(replay, e, BAR_W_RIGHT) -
                     dynfrag1d_field(replay, e, BAR_W_LEFT)) /
                    replay->model->element_size;
    return 275e9 * (replay->run->rate * replay->batch->step.time[0] + strain);
}

/* Onsets of interfaces that are not of the original mesh. */
static inline int dynfrag1d_onsets_between(const dynfrag1d_replay *replay)
{
    int count = 0;
    for (size_t e = 0; e + 1 < replay->model->elements; e++)
        count += dynfrag1d_field(replay, e, BAR_STRENGTH) == DYNFRAG1D_UNBREAKABLE &&
                 dynfrag1d_field(replay, e, BAR_DAMAGE) > 0;
    return count;
}

/* The quantities that the other code writes, from our state: its frame is the laboratory's, and a
 * fragment ends where damage exceeds 0.99. */
static inline dynfrag1d_row dynfrag1d_observe(const dynfrag1d_replay *replay)
{
    const fracas_step *step = &replay->batch->step;
    dynfrag1d_row now = {.time = step->time[0],
                         .potential = step->elastic[0],
                         .dissipated = step->dissipated[0],
                         .stored = step->cohesive[0],
                         .work = replay->work,
                         .fragments = 1};
    const double h = replay->model->element_size, nodal = 0.5 * 2750 * h;
    for (size_t e = 0; e < replay->model->elements; e++) {
        for (size_t side = 0; side < 2; side++) {
            double x = h * (double)(e + side) - DYNFRAG1D_LENGTH / 2;
            double after = dynfrag1d_field(replay, e, BAR_V_LEFT + (int)side);
            double v = replay->run->rate * x + 0.5 * (replay->before[2 * e + side] + after);
            now.kinetic += 0.5 * nodal * v * v;
        }
        if (e + 1 == replay->model->elements) break;
        double damage = dynfrag1d_field(replay, e, BAR_DAMAGE);
        now.nominal += 0.5 * DYNFRAG1D_NOMINAL * damage * 2 * 100 /
                       dynfrag1d_field(replay, e, BAR_STRENGTH);
        now.fragments += damage > 0.99;
    }
    return now;
}

/* One step; *now, unless NULL, is what the bar is then. */
static inline void dynfrag1d_step(dynfrag1d_replay *replay, dynfrag1d_row *now)
{
    size_t running;
    for (size_t e = 0; now && e < replay->model->elements; e++)
        for (size_t side = 0; side < 2; side++)
            replay->before[2 * e + side] = dynfrag1d_field(replay, e, BAR_V_LEFT + (int)side);
    OK(fracas_batch_step(replay->batch, &replay->record, &running));
    assert_int_equal(running, 1);
    double power = 0.5 * replay->run->rate * DYNFRAG1D_LENGTH *
                   (dynfrag1d_stress(replay, 0) +
                    dynfrag1d_stress(replay, replay->model->elements - 1));
    if (replay->steps++ > 0)
        replay->work += 0.5 * replay->model->time_step * (replay->power + power);
    replay->power = power;
    if (now) *now = dynfrag1d_observe(replay);
}

/* What the bar is at every kept row of the other code's history, for a time step that divides its.
 */
static inline void dynfrag1d_follow(dynfrag1d_replay *replay, const dynfrag1d_row *reference,
                                    int rows, dynfrag1d_row *now)
{
    for (int n = 0; n < rows; n++) {
        int target = (int)lround(reference[n].time / replay->model->time_step);
        while (replay->steps < target) dynfrag1d_step(replay, NULL);
        dynfrag1d_step(replay, &now[n]);
    }
}

/* Its own-strength dissipated energy, which it wrote for the end only: its column at the nominal
 * strength times the ratio of the two in the replay `replayed`, which hardly depends on which
 * interfaces broke: strengths are within 1/300. */
static inline void dynfrag1d_own(dynfrag1d_row *reference, const dynfrag1d_row *replayed, int rows)
{
    for (int n = 0; n < rows; n++)
        reference[n].dissipated =
            reference[n].nominal *
            (replayed[n].nominal > 0 ? replayed[n].dissipated / replayed[n].nominal : 1.0);
}

#endif
