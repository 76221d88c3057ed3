/* SPDX-License-Identifier: GPL-3.0-or-later */
/* ctest-labels: ci slow-sanitize */
/* Bars and rings to many times the time of their break-up (docs/theory/balance.md): the ledger
 * closes by the dissipated and by the vibrating energy, and the state is that of a small step. */
#include "tests/support/long_times.h"

/* 100 times the time of break-up at the default step: 1e-3 of the dissipated and 1e-2 of the
 * vibrating energy, which the run without the balance misses by 5 and more. */
static void a_bar_closes_its_ledger_at_long_times(void **unused)
{
    fracas_spec spec = bar_reference(800, 1e4, 100 * break_up_time(1e4));
    spec.geometry.length = 0.02;
    const figures balanced = run_long(spec, 1e4, 0.25, true),
                  plain = run_long(spec, 1e4, 0.25, false),
                  small = run_long(spec, 1e4, 0.0625, true);
    assert_true(balanced.by_dissipated < 1e-3 && balanced.by_vibrating < 1e-2);
    assert_true(plain.by_dissipated > 5e-3 && plain.by_vibrating > 5e-2);
    /* Steps part chaotic paths: means of 8 bars with some 45 breaks each scatter by 1 %, their
     * vibration by 5 %. A body that is heated has more: 1.1 to 2 times in schemes that fail. */
    assert_true(fabs(balanced.dissipated / small.dissipated - 1) < 0.01);
    assert_true(fabs(balanced.vibrating / small.vibrating - 1) < 0.05);
    assert_true(fabs((double)balanced.broken / (double)small.broken - 1) < 0.02);
}

/* A fine ring that breaks up fast, to 40 times that: pieces of pinned springs without (ring.19)
 * fold up from 25 on, and end at a thousand times their energy. */
static void a_ring_does_not_fold(void **unused)
{
    fracas_spec spec = ring_reference(4190, 1e5, 40 * break_up_time(1e5));
    spec.geometry.radius = 0.5 * RING_RADIUS;
    spec.loading.radial = 1e5 * spec.geometry.radius;
    const figures balanced = run_long(spec, 1e5, 0.25, true);
    assert_true(balanced.by_dissipated < 1e-3 && balanced.by_vibrating < 1e-2);
    assert_true(balanced.broken > 8 * 160);
}

TESTS(a_bar_closes_its_ledger_at_long_times, a_ring_does_not_fold)
