/* SPDX-License-Identifier: GPL-3.0-or-later */
/* ctest-labels: storm */
/* The table of docs/theory/balance.md: bars and rings to 100 times the time of their break-up at
 * the default step, without the balance, and at a step four times smaller. Five minutes. */
#include "tests/support/long_times.h"

static const struct {
    const char *name;
    double rate;
    int64_t elements;
    bool ring, compared; /* with a small step, and bars as they are */
} bodies[] = {{"bar", 1e4, 5000, false, true},
              {"bar", 1e5, 8000, false, true},
              {"bar", 1e6, 32000, false, false},
              {"ring", 1e4, 2510, true, true},
              {"ring", 1e5, 8380, true, true}};

/* 1.1e-2: the vibration of a fast bar and ring falls to 5 % of the dissipated energy. Against the
 * small step dissipated energy within 0.1 %, vibrating within 3 %: means of eight with 900 breaks
 * or more. */
static void ledgers_close_and_states_are_right(void **unused)
{
    for (size_t b = 0; b < sizeof bodies / sizeof *bodies; b++) {
        const double rate = bodies[b].rate, end = 100 * break_up_time(rate);
        const fracas_spec spec = bodies[b].ring ? ring_reference(bodies[b].elements, rate, end)
                                                : bar_reference(bodies[b].elements, rate, end);
        print_message("%s at %.0e /s, %ld elements\n", bodies[b].name, rate,
                      (long)bodies[b].elements);
        const figures is = run_long(spec, rate, 0.25, true);
        assert_true(is.by_dissipated < 1e-3 && is.by_vibrating < 1.1e-2);
        if (!bodies[b].compared) continue;
        if (!bodies[b].ring) assert_true(run_long(spec, rate, 0.25, false).by_dissipated > 5e-3);
        const figures small = run_long(spec, rate, 0.0625, true);
        assert_true(fabs(is.dissipated / small.dissipated - 1) < 1e-3);
        assert_true(fabs(is.vibrating / small.vibrating - 1) < 0.03);
    }
}

TESTS(ledgers_close_and_states_are_right)
