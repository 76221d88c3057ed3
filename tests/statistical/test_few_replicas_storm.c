/* SPDX-License-Identifier: GPL-3.0-or-later */
/* ctest-labels: storm */
/* ctest-timeout: 3600 */
/* Crossovers from few replicas, of 3000 repetitions each: the table of docs/theory/scaling-laws.md.
 */
#include "tests/support/few_replicas.h"
#include "tests/support/test.h"

static void crossovers(void **state)
{
    for (size_t c = 0; c < FEW_CLAIMS; c++) few_assert_bends(&few_claims[c], 3000, 3000 + c);
}

TESTS(crossovers)
