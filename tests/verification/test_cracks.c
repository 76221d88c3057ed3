/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cracks over time from planted times of breaks on a grid of squares of 1 m, and the speed of
 * Rayleigh waves at Poisson's ratios with a closed form. */
#include "tests/support/stored_mesh.h"

#include "analysis/data/cracks.h"

static const grid_shape plate = {.nx = 24, .ny = 6}, curved = {.nx = 24, .ny = 6, .middles = true};

/* The interface from (i, j) to (k, l) breaks at this time; 0: it is a notch. */
static void break_at(const grid_shape *shape, const fracas_stored_mesh *mesh, fracas_record *record,
                     const size_t at[4], double time)
{
    assert_true(grid_crack(mesh, record, grid_vertex(shape, at[0], at[1]),
                           grid_vertex(shape, at[2], at[3]), time, time));
}

/* Along row j from column `from` to `to`, at start + (distance from `from`)/v: from its left end.
 */
static void run_right(const grid_shape *shape, const fracas_stored_mesh *mesh,
                      fracas_record *record, size_t j, size_t from, size_t to, double start,
                      double v)
{
    for (size_t i = from; i < to; i++)
        break_at(shape, mesh, record, (size_t[]){i, j, i + 1, j},
                 v > 0 ? start + (double)(i + 1 - from) / v : 0);
}

/* Behind a notch of 4 m a crack runs at 250 m/s: after 8 vertices each break has this speed. Times
 * of up to 0.1 s round by 1e-17 s, so slopes by 1e-15; sums of 20 whole numbers are exact. */
static void a_straight_crack_has_its_speed(void **state)
{
    (void)state;
    const grid_shape *const shapes[] = {&plate, &curved};
    for (int k = 0; k < 2; k++) {
        FRACAS_CLEARED(fracas_stored_mesh) mesh;
        FRACAS_CLEARED(fracas_record) record;
        FRACAS_CLEARED(fracas_cracks) cracks;
        grid_make(shapes[k], &mesh);
        grid_record(&mesh, 1, &record);
        run_right(shapes[k], &mesh, &record, 3, 0, 4, 0, 0);
        run_right(shapes[k], &mesh, &record, 3, 4, 24, 0.01, 250);
        OK(fracas_cracks_find(&mesh, &record, &cracks));
        assert_int_equal(cracks.ncracks, 1);
        assert_int_equal(cracks.nbreaks, 20);
        const fracas_crack *crack = &cracks.crack[0];
        assert_true(fabs(crack->length - 20) < 1e-12 && fabs(crack->notch - 4) < 1e-12);
        assert_true(crack->start[0] == 4 && crack->tip[0] == 24 && crack->branches == 0);
        assert_true(fabs(crack->reach - 20) < 1e-12 && fabs(crack->extent - 20) < 1e-12);
        assert_true(fabs(crack->speed / 250 - 1) < 1e-12);
        assert_true(fabs(crack->between - 20) < 1e-12); /* it cuts the plate in two */
        for (size_t b = 0; b < 20; b++) {
            const fracas_crack_break *row = &cracks.broke[b];
            assert_true(fabs(row->length - (double)(b + 1)) < 1e-12 &&
                        row->tip[0] == 5.0 + (double)b);
            if (b + 1 < FRACAS_CRACK_WINDOW) assert_true(isnan(row->speed));
            else assert_true(fabs(row->speed / 250 - 1) < 1e-12);
        }
    }
}

/* One from the left, one that starts at column 12 and runs to the left: the interface from 8 to 9
 * joins them. The way then leads on to column 12. */
static void cracks_that_meet_are_one(void **state)
{
    (void)state;
    FRACAS_CLEARED(fracas_stored_mesh) mesh;
    FRACAS_CLEARED(fracas_record) record;
    FRACAS_CLEARED(fracas_cracks) cracks;
    grid_make(&plate, &mesh);
    grid_record(&mesh, 100, &record);
    run_right(&plate, &mesh, &record, 2, 1, 8, 0, 1);
    for (size_t i = 9; i < 12; i++)
        break_at(&plate, &mesh, &record, (size_t[]){i, 2, i + 1, 2}, 15.5 - (double)i);
    break_at(&plate, &mesh, &record, (size_t[]){8, 2, 9, 2}, 20);
    OK(fracas_cracks_find(&mesh, &record, &cracks));
    assert_int_equal(cracks.ncracks, 2);
    assert_int_equal(cracks.crack[1].met, 0);
    assert_true(cracks.crack[1].met_time == 20 && fabs(cracks.crack[1].length - 3) < 1e-12);
    assert_true(cracks.crack[1].tip[0] == 9 && fabs(cracks.crack[1].speed - 1) < 0.2);
    assert_true(fabs(cracks.crack[0].length - 11) < 1e-12 && cracks.crack[0].breaks == 11);
    /* from the middle of its first interface, at 1.5, to 12 */
    assert_true(cracks.crack[0].tip[0] == 12 && fabs(cracks.crack[0].reach - 10.5) < 1e-12);
    assert_true(cracks.crack[0].start[0] == 1.5 && cracks.crack[0].between == 0);
    assert_int_equal(fracas_cracks_longest(&cracks), 0);
}

/* From (10, 3) two arms go up and right; a loop of four edges has three that reach a vertex. */
static void branches_and_loops_are_seen(void **state)
{
    (void)state;
    FRACAS_CLEARED(fracas_stored_mesh) mesh;
    FRACAS_CLEARED(fracas_record) record;
    FRACAS_CLEARED(fracas_cracks) cracks;
    grid_make(&plate, &mesh);
    grid_record(&mesh, 100, &record);
    run_right(&plate, &mesh, &record, 3, 5, 11, 0, 1);
    break_at(&plate, &mesh, &record, (size_t[]){10, 3, 10, 4}, 30);
    break_at(&plate, &mesh, &record, (size_t[]){10, 4, 11, 4}, 31);
    break_at(&plate, &mesh, &record, (size_t[]){11, 4, 11, 3}, 32);
    OK(fracas_cracks_find(&mesh, &record, &cracks));
    assert_int_equal(cracks.ncracks, 1);
    assert_int_equal(cracks.crack[0].branches, 1);
    assert_true(fabs(cracks.crack[0].length - 9) < 1e-12);
    assert_true(isnan(cracks.broke[8].speed) &&
                cracks.broke[8].tip[1] == 4);               /* it closes the loop */
    assert_true(fabs(cracks.crack[0].reach - 6.5) < 1e-12); /* 5.5 to (11, 4): 4.5 + 2 */
    assert_true(fabs(cracks.crack[0].between - 4) < 1e-12);
}

/* Two notches that touch are one; one that nothing touches stays, and has no start. */
static void notches_are_no_growth(void **state)
{
    (void)state;
    FRACAS_CLEARED(fracas_stored_mesh) mesh;
    FRACAS_CLEARED(fracas_record) record;
    FRACAS_CLEARED(fracas_cracks) cracks;
    grid_make(&plate, &mesh);
    grid_record(&mesh, 100, &record);
    break_at(&plate, &mesh, &record, (size_t[]){3, 1, 4, 1}, 0);
    break_at(&plate, &mesh, &record, (size_t[]){5, 1, 6, 1}, 0);
    break_at(&plate, &mesh, &record, (size_t[]){4, 1, 5, 1}, 0);
    break_at(&plate, &mesh, &record, (size_t[]){20, 5, 21, 5}, 0);
    OK(fracas_cracks_find(&mesh, &record, &cracks));
    assert_int_equal(cracks.ncracks, 2);
    assert_int_equal(cracks.nbreaks, 0);
    assert_true(cracks.crack[0].notch + cracks.crack[1].notch == 4 && cracks.crack[0].length == 0);
    assert_true(isnan(cracks.crack[0].start_time) && isnan(cracks.crack[1].start[0]));
    assert_true(fracas_cracks_longest(&cracks) == SIZE_MAX);
}

/* (cracks.4): x = 3 - sqrt(5) for nu = 0, 2 - 2/sqrt(3) for nu = 1/3. Roots of the cubic round by
 * some 1e-15. */
static void rayleigh_waves_have_their_speed(void **state)
{
    (void)state;
    assert_true(fabs(fracas_rayleigh_speed(2, 1, 0) - sqrt(3 - sqrt(5))) < 1e-12);
    assert_true(fabs(fracas_rayleigh_speed(8.0 / 3, 1, 1.0 / 3) - sqrt(2 - 2 / sqrt(3))) < 1e-12);
    assert_true(isnan(fracas_rayleigh_speed(NAN, 1, 0.2)));
}

TESTS(a_straight_crack_has_its_speed, cracks_that_meet_are_one, branches_and_loops_are_seen,
      notches_are_no_growth, rayleigh_waves_have_their_speed)
