/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Work whose k-th allocation fails, for every k. Not under AddressSanitizer, which owns malloc. */
#ifndef FRACAS_TESTS_SUPPORT_FAIL_EACH_H
#define FRACAS_TESTS_SUPPORT_FAIL_EACH_H

#include "base/err.h"
#include "tests/support/failing_malloc.h"
#include "tests/support/test.h"

/* Calls `work` with the first, second, ... allocation failing, until it succeeds without; nothing
 * stays behind. Of more than `each` of them only some are tried, a quarter further on each time. */
static void fail_each_of(fracas_err (*work)(const void *context), const void *context, long each)
{
    for (long k = 1;; k += k < each ? 1 : k / 4) {
        const long before = held;
        has_failed = false;
        countdown = k;
        const fracas_err err = work(context);
        countdown = 0;
        assert_int_equal(held, before);
        if (!has_failed) {
            assert_int_equal(err, FRACAS_OK);
            assert_true(k > 3); /* it did allocate */
            return;
        }
        /* glibc's qsort does without memory of its own when there is none. */
        if (err != FRACAS_ENVIRONMENT && err != FRACAS_OK)
            fail_msg("allocation %ld: %d %s", k, err, fracas_message());
        if (err && !strstr(fracas_message(), "no memory for") &&
            !strstr(fracas_message(), strerror(ENOMEM)))
            fail_msg("allocation %ld: %s", k, fracas_message());
    }
}

#endif
