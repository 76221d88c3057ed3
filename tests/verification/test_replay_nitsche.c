/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Law nitsche on the strengths of another code's runs (tests/data/dynfrag1d), beside that code and
 * its algorithm.
 *
 * It prints the tables of docs/results/ring.md; with FRACAS_WRITE_REPLAY=FOLDER it writes their
 * figures there. */
#include "analysis/draw/chart.h"
#include "tests/support/dynfrag1d.h"
#include "tests/support/test.h"

enum { MOST_INTERFACES = 2500 };

typedef dynfrag1d_row history[DYNFRAG1D_MOST_ROWS];

/* What a run came to, at every row of theirs. */
typedef struct {
    const char *name;
    unsigned look; /* in the figure */
    history at;
    bool broken[MOST_INTERFACES]; /* at the end, of the original mesh */
} curve;

static double size_of(const dynfrag1d_row *row)
{
    return DYNFRAG1D_LENGTH / (double)row->fragments;
}

static double count_difference(const dynfrag1d_row *ours, const dynfrag1d_row *theirs)
{
    return (double)ours->fragments / (double)theirs->fragments - 1;
}

static double dissipated_difference(const dynfrag1d_row *ours, const dynfrag1d_row *theirs)
{
    return ours->dissipated / theirs->dissipated - 1;
}

/* ---- runs ---- */

static void compute(const dynfrag1d_run *run, const fracas_kind *law, int refine, double courant,
                    const curve *theirs, int rows, curve *ours)
{
    OWNED double *strength = dynfrag1d_strengths(run);
    dynfrag1d_replay bar;
    dynfrag1d_begin(&bar, run, law, refine, courant, strength);
    dynfrag1d_follow(&bar, theirs->at, rows, ours->at);
    assert_int_equal(dynfrag1d_onsets_between(&bar), 0);
    for (int i = 0; i + 1 < run->elements; i++)
        ours->broken[i] = dynfrag1d_field(&bar, (size_t)((i + 1) * refine - 1), BAR_DAMAGE) > 0.99;
    dynfrag1d_end(&bar);
}

static int common_breaks(const dynfrag1d_run *run, const curve *a, const curve *b)
{
    int count = 0;
    for (int i = 0; i + 1 < run->elements; i++) count += a->broken[i] && b->broken[i];
    return count;
}

/* Of one bar: theirs, and both laws on some mesh. */
enum { THEIRS, RIGID, NITSCHE, CURVES };

static const fracas_kind *const law_of[CURVES] = {NULL, &fracas_law_rigid_link.kind,
                                                  &fracas_law_nitsche.kind};

/* On its own mesh and time step. Returns the rows. */
static int compute_all(const dynfrag1d_run *run, curve *curves)
{
    static const char *const name[CURVES] = {"DynFrag1D", "rigid-link", "nitsche"};
    static const unsigned look[CURVES] = {10, 2, 0};
    for (int k = 0; k < CURVES; k++) curves[k].name = name[k], curves[k].look = look[k];
    int rows = dynfrag1d_history(run, curves[THEIRS].at);
    for (int k = RIGID; k <= NITSCHE; k++)
        compute(run, law_of[k], 1, 0, &curves[THEIRS], rows, &curves[k]);
    dynfrag1d_own(curves[THEIRS].at, curves[RIGID].at, rows);
    return rows;
}

/* ---- tables and figures ---- */

static void print_rows(const dynfrag1d_run *run, const curve *curves, int rows, const int *shown,
                       int nshown)
{
    print_message(
        "[  figures ] %s: time [ns] | count, mean size [um], dissipated [J]: %s | %s | %s\n",
        run->name, curves[THEIRS].name, curves[RIGID].name, curves[NITSCHE].name);
    for (int i = 0; i <= nshown; i++) {
        const int n = i < nshown ? shown[i] : rows - 1;
        print_message("| %.1f ", 1e9 * curves[THEIRS].at[n].time);
        for (int k = 0; k < CURVES; k++)
            print_message("| %ld | %.1f | %.1f ", curves[k].at[n].fragments,
                          1e6 * size_of(&curves[k].at[n]), curves[k].at[n].dissipated);
        print_message("|\n");
    }
}

static fracas_err add_curve(fracas_panel *panel, const curve *one, int rows, bool energy)
{
    fracas_series *series;
    TRY(fracas_panel_add(panel, FRACAS_CURVE, one->look, (size_t)rows, &series));
    if (energy)
        snprintf(series->name, sizeof series->name, "%s", one->name); /* the legend stands once */
    for (int n = 0; n < rows; n++) {
        series->x[n] = 1e6 * one->at[n].time;
        series->y[n] = energy ? 1e-3 * one->at[n].dissipated : (double)one->at[n].fragments;
    }
    return FRACAS_OK;
}

static void write_figure(const dynfrag1d_run *run, const curve *const *curves, int ncurves,
                         int rows)
{
    const char *folder = getenv("FRACAS_WRITE_REPLAY");
    if (!folder) return;
    char path[512];
    snprintf(path, sizeof path, "%s/replay-%s.svg", folder, run->name);
    FILE *file = fopen(path, "w");
    if (!file) fail_msg("cannot write %s", path);
    FRACAS_CLEARED(fracas_chart) chart;
    fracas_chart_init(&chart);
    snprintf(chart.title, sizeof chart.title, "Dissipated energy and fragments of run %s",
             run->name);
    fracas_panel *energy = fracas_chart_add(&chart, 200), *count = fracas_chart_add(&chart, 200);
    snprintf(energy->y.label, sizeof energy->y.label, "dissipated [kJ]");
    snprintf(count->y.label, sizeof count->y.label, "fragments");
    snprintf(count->x.label, sizeof count->x.label, "time [µs]");
    for (int k = 0; k < ncurves; k++) {
        OK(add_curve(energy, curves[k], rows, true));
        OK(add_curve(count, curves[k], rows, false));
    }
    fracas_chart_write(&chart, true, file);
    assert_int_equal(fclose(file), 0);
}

/* ---- tests ---- */

/* 11 and 22 elements a fragment. 5 % of count and energy is less than two standard deviations of
 * the count of bars that have strengths of their own (3 %, docs/results/bar.md), and about what may
 * tell the two runs apart: round-off: a fragment or two, 1 %, and 1e-3 of the energy (test_replay);
 *   onset 2 to 3 steps late there, by E rate dt = 1.1 or 0.55 MPa each: 1 or 0.5 % of the strength;
 *   contact of E/(12 h) or E/(23 h) there, 4 E/h here: with E/h there, 1 to 3 % more fragments and
 * energy (docs/results/ring.md). Measured: 0.9 and 0.9 % of the count, 0.4 and 1.2 % of the energy.
 */
static void nitsche_breaks_the_same_bars_as_dynfrag1d(void **unused)
{
    static const int shown[] = {20, 22, 24, 30, 40, 60, 80};
    static curve curves[CURVES];
    const curve *const drawn[] = {&curves[THEIRS], &curves[RIGID], &curves[NITSCHE]};
    for (int r = 0; r < 2; r++) {
        const dynfrag1d_run *run = &dynfrag1d_runs[r];
        int rows = compute_all(run, curves), last = rows - 1;
        print_rows(run, curves, rows, shown, 7);
        write_figure(run, drawn, 3, rows);
        double count = count_difference(&curves[NITSCHE].at[last], &curves[THEIRS].at[last]);
        double energy = curves[NITSCHE].at[last].dissipated /
                            dynfrag1d_summary(run, "dissipated_own_strength") -
                        1;
        int common = common_breaks(run, &curves[RIGID], &curves[NITSCHE]);
        print_message("[  figures ] %s: nitsche against DynFrag1D: count %+.2f %%, dissipated "
                      "%+.2f %%; breaks in common with rigid-link: %d\n",
                      run->name, 100 * count, 100 * energy, common);
        assert_true(fabs(count) < 0.05);
        assert_true(fabs(energy) < 0.05);
        /* by chance: 111 * 112/1249 = 10 or 109 * 110/2499 = 5 */
        assert_true(common > (int)curves[NITSCHE].at[last].fragments / 2);
    }
}

static void print_pair(const char *what, const dynfrag1d_row *rigid, const dynfrag1d_row *nitsche,
                       int common)
{
    print_message("| %s | %ld | %.0f | %ld | %.0f | %+.1f %% | %+.1f %% | %d |\n", what,
                  rigid->fragments, rigid->dissipated, nitsche->fragments, nitsche->dissipated,
                  100 * count_difference(nitsche, rigid),
                  100 * dissipated_difference(nitsche, rigid), common);
}

/* Three elements a fragment: too coarse to compare but with the same mesh. So both laws are
 * computed on finer meshes and with a shorter time step, the same 1249 interfaces being the only
 * ones that can break.
 *
 * The onset of rigid-link is late by 2 to 3 steps, each of E rate dt = 11 MPa, 4 % of the strength:
 * all interfaces open under more stress than they hold, and dissipate more. That error is of first
 * order in the time step; with a quarter of it, a half of the difference at most may be left (a
 * quarter, and what single breaks do). */
static void nitsche_and_rigid_link_converge_to_each_other(void **unused)
{
    static const int shown[] = {100, 150, 175, 200, 250, 350};
    enum { COARSE, BRIEF, TWICE, FINE, LEVELS };
    static const struct {
        const char *what;
        int refine;
        double courant;
    } level[LEVELS] = {{"1250", 1, 0.1},
                       {"1250, an eighth of the time step", 1, 0.0125},
                       {"2500", 2, 0.1},
                       {"5000", 4, 0.1}};
    static curve own[CURVES], finer[LEVELS][CURVES];
    const dynfrag1d_run *run = &dynfrag1d_runs[2];
    int rows = compute_all(run, own), last = rows - 1;
    print_rows(run, own, rows, shown, 6);
    double count[LEVELS], energy[LEVELS];
    for (int i = 0; i < LEVELS; i++) {
        for (int k = RIGID; k <= NITSCHE; k++)
            compute(run, law_of[k], level[i].refine, level[i].courant, &own[THEIRS], rows,
                    &finer[i][k]);
        const dynfrag1d_row *rigid = &finer[i][RIGID].at[last],
                            *nitsche = &finer[i][NITSCHE].at[last];
        count[i] = fabs(count_difference(nitsche, rigid));
        energy[i] = fabs(dissipated_difference(nitsche, rigid));
        print_pair(level[i].what, rigid, nitsche,
                   common_breaks(run, &finer[i][RIGID], &finer[i][NITSCHE]));
    }
    finer[FINE][RIGID].name = "rigid-link, 4 x elements", finer[FINE][RIGID].look = 8;
    finer[FINE][NITSCHE].name = "nitsche, 4 x elements", finer[FINE][NITSCHE].look = 6;
    const curve *const drawn[] = {&own[THEIRS], &own[RIGID], &own[NITSCHE], &finer[FINE][RIGID],
                                  &finer[FINE][NITSCHE]};
    write_figure(run, drawn, 5, rows);
    assert_true(count[FINE] < 0.05 && energy[FINE] < 0.05);
    assert_true(count[FINE] < count[COARSE] && energy[FINE] < 0.5 * energy[COARSE]);
    assert_true(energy[BRIEF] < 0.5 * energy[COARSE]); /* the time step alone */
}

TESTS(nitsche_breaks_the_same_bars_as_dynfrag1d, nitsche_and_rigid_link_converge_to_each_other)
