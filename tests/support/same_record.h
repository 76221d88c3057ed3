/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Records bit for bit. */
#ifndef FRACAS_TESTS_SUPPORT_SAME_RECORD_H
#define FRACAS_TESTS_SUPPORT_SAME_RECORD_H

#include "engine/record.h"
#include "tests/support/test.h"

/* Every scalar, then every row, byte by byte; pointers apart. */
static inline void assert_same_record(const fracas_record *a, const fracas_record *b)
{
    assert_memory_equal(a, b, offsetof(fracas_record, fragment));
    assert_memory_equal(a->fragment, b->fragment, a->nfragment * sizeof *a->fragment);
    assert_memory_equal(a->history, b->history, a->nhistory * sizeof *a->history);
    assert_memory_equal(a->interface, b->interface, a->ninterface * sizeof *a->interface);
}

#endif
