/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A study while it is computed: states, means and the latest run, from the index alone. */
#include "analysis/summary/unfinished.h"
#include "base/file.h"
#include "tests/support/test.h"

#include <math.h>
#include <time.h>
#include <unistd.h>

enum { REPLICAS = 7, POINTS = 2 };
#define CIRCUMFERENCE 5e-2

static const fracas_column column[] = {{"derived.length", "m", "length", false},
                                       {"derived.surface", "1", "1 of a surface", false}};
static const fracas_value value[POINTS][2] = {{{CIRCUMFERENCE, ""}, {0, ""}}, {{NAN, ""}, {1, ""}}};

static char folder[32];
static fracas_point_row point_row[POINTS];
static const fracas_point_table table = {2, column, POINTS, point_row};

static int set_up(void **state)
{
    for (size_t p = 0; p < POINTS; p++)
        point_row[p] = (fracas_point_row){fracas_hash_of(&p, sizeof p), REPLICAS, value[p], 0};
    snprintf(folder, sizeof folder, "/tmp/unfinished-XXXXXX");
    return mkdtemp(folder) ? 0 : -1;
}

static int tear_down(void **state)
{
    fracas_folder_remove(folder);
    return 0;
}

/* Point 0 is a ring, point 1 a surface. Outcomes of replicas: those of NONFINITE and FAILED are in
 * no mean, replica 5 is leased, replica 6 planned. */
static const int64_t outcome[] = {FRACAS_FRAGMENTED, FRACAS_NONFINITE, FRACAS_INTACT,
                                  FRACAS_TIME_LIMIT, FRACAS_FAILED};
enum { COMMITTED = sizeof outcome / sizeof *outcome };

static fracas_summary summary_of(size_t p, int64_t replica)
{
    return (fracas_summary){.outcome = outcome[replica],
                            .fragments = 4 + replica * replica + (int64_t)p,
                            .size = 1e-3 * (double)(1 + replica)};
}

static void commit(fracas_index *index, int64_t first, int64_t end, const char *name,
                   const char *provenance)
{
    fracas_segment_row row[2 * COMMITTED];
    size_t count = 0;
    for (size_t p = 0; p < POINTS; p++)
        for (int64_t r = first; r < end; r++, count++)
            row[count] = (fracas_segment_row){point_row[p].hash, r, (int64_t)count,
                                              summary_of(p, r)};
    const fracas_file_seal seal = {1000, 1};
    OK(fracas_index_commit(index, name, &seal, row, count, provenance));
}

/* Two segments: one of an earlier run, one of the latest. */
static void make(double now)
{
    char provenance[128];
    OWN(fracas_index) index = NULL;
    OK(fracas_index_open(folder, true, &index));
    OK(fracas_index_plan(index, &table));
    OK(fracas_index_event(index, "started", "the first run"));
    snprintf(provenance, sizeof provenance, "{\"began\": %.3f, \"wall_seconds\": 5}", now - 1000);
    commit(index, 0, 2, "a.h5", provenance);
    OK(fracas_index_event(index, "resumed", "the latest"));
    snprintf(provenance, sizeof provenance, "{\"began\": %.3f, \"wall_seconds\": 2}", now + 10);
    commit(index, 2, COMMITTED, "b.h5", provenance);
    commit(index, 2, COMMITTED, "c.h5", "{\"adopted\": true}");
    for (size_t p = 0; p < POINTS; p++) OK(fracas_index_lease(index, &point_row[p].hash, 5, 1));
}

static void means_are_of_what_counts(const fracas_unfinished *unfinished)
{
    for (size_t p = 0; p < POINTS; p++) {
        double count[3], size[3];
        for (int i = 0, r = 0; r < COMMITTED; r++) {
            if (outcome[r] == FRACAS_NONFINITE || outcome[r] == FRACAS_FAILED) continue;
            count[i] = 4 + r * r + (int)p;
            size[i] = p ? 1e-3 * (1 + r) : CIRCUMFERENCE / count[i];
            i++;
        }
        const fracas_estimate of_count = fracas_estimate_of(count, 1, 3),
                              of_size = fracas_estimate_of(size, 1, 3);
        const fracas_unfinished_point *point = &unfinished->point[p];
        assert_int_equal(point->count.n, 3);
        assert_true(point->count.mean == of_count.mean &&
                    point->count.half_width == of_count.half_width);
        assert_int_equal(point->size.n, 3);
        assert_true(fabs(point->size.mean / of_size.mean - 1) < 1e-15);
        assert_true(fabs(point->size.half_width / of_size.half_width - 1) < 1e-13);
        assert_int_equal(point->computed, 3);
        assert_int_equal(point->counts.done, 4);
        assert_int_equal(point->counts.failed, 1);
        assert_int_equal(point->counts.outcome[FRACAS_NONFINITE], 1);
        assert_int_equal(unfinished->state[point->first + 4], FRACAS_FAILED_ROW);
        assert_int_equal(unfinished->state[point->first + 6], FRACAS_PLANNED);
    }
}

static void an_index_tells_how_far_a_study_is(void **unused)
{
    struct timespec clock;
    clock_gettime(CLOCK_REALTIME, &clock);
    const double now = (double)clock.tv_sec + 1e-9 * (double)clock.tv_nsec;
    make(now);
    for (int going = 0; going < 2; going++) {
        FRACAS_CLEARED(fracas_unfinished) unfinished = {0};
        OWN(fracas_index) index = NULL;
        OK(fracas_index_open(folder, false, &index));
        OK(fracas_unfinished_read(index, &table, going, &unfinished));
        means_are_of_what_counts(&unfinished);
        assert_int_equal(unfinished.all.realizations, 2 * REPLICAS);
        assert_int_equal(unfinished.all.leased, going ? 2 : 0); /* without a run nobody has them */
        assert_int_equal(unfinished.all.planned, going ? 2 : 4);
        assert_int_equal(unfinished.all.segments, 3);
        assert_int_equal(unfinished.all.bytes, 3000);
        assert_true(fabs(unfinished.run.began - now) < 5);
        assert_true(fabs(unfinished.run.latest - (now + 12)) < 0.01);
    }
}

static void a_new_study_has_no_run(void **unused)
{
    OWN(fracas_index) index = NULL;
    OK(fracas_index_open(folder, true, &index));
    FRACAS_CLEARED(fracas_unfinished) unfinished = {0};
    FAILS(fracas_unfinished_read(index, &table, true, &unfinished), FRACAS_DAMAGED, "has no point");
    fracas_unfinished_clear(&unfinished);
    OK(fracas_index_plan(index, &table));
    OK(fracas_unfinished_read(index, &table, true, &unfinished));
    assert_true(isnan(unfinished.run.began) && isnan(unfinished.run.latest));
    assert_int_equal(unfinished.point[0].count.n, 0);
    assert_true(isnan(unfinished.point[0].count.mean));
    assert_int_equal(unfinished.point[0].computed, 0);
}

TESTS_EACH(set_up, tear_down, an_index_tells_how_far_a_study_is, a_new_study_has_no_run)
