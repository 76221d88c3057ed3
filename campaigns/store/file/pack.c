/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A record as bytes: the struct with its pointers taken out, then its three arrays. For one program
 * on one machine. */
#include "campaigns/store/store.h"

#include <stdlib.h>
#include <string.h>

size_t fracas_record_packed_size(const fracas_record *record)
{
    return sizeof *record + record->nfragment * sizeof *record->fragment +
           record->nhistory * sizeof *record->history +
           record->ninterface * sizeof *record->interface;
}

static char *put(char *to, const void *from, size_t size)
{
    if (size) memcpy(to, from, size);
    return to + size;
}

void fracas_record_pack(const fracas_record *record, void *bytes)
{
    fracas_record scalars = *record;
    scalars.fragment = NULL;
    scalars.history = NULL;
    scalars.interface = NULL;
    char *to = put(bytes, &scalars, sizeof scalars);
    to = put(to, record->fragment, record->nfragment * sizeof *record->fragment);
    to = put(to, record->history, record->nhistory * sizeof *record->history);
    put(to, record->interface, record->ninterface * sizeof *record->interface);
}

/* Copies `count` rows out of the rest of the bytes; false without memory. */
static bool take(const char **from, size_t count, size_t row_size, void **rows)
{
    size_t size = count * row_size;
    *rows = NULL;
    if (!size) return true;
    *rows = malloc(size);
    if (*rows) memcpy(*rows, *from, size);
    *from += size;
    return *rows != NULL;
}

fracas_err fracas_record_unpack(const void *bytes, size_t size, fracas_record *record)
{
    fracas_record scalars;
    fracas_record_clear(record);
    bool fits = size >= sizeof scalars;
    if (fits) {
        memcpy(&scalars, bytes, sizeof scalars);
        /* Each count alone first, so that the sum cannot wrap around. */
        fits = scalars.nfragment <= size / sizeof *scalars.fragment &&
               scalars.nhistory <= size / sizeof *scalars.history &&
               scalars.ninterface <= size / sizeof *scalars.interface &&
               fracas_record_packed_size(&scalars) == size;
    }
    if (!fits)
        return fracas_fail(FRACAS_BUG, "a packed record of %zu bytes does not fit its own counts",
                           size);
    const char *from = (const char *)bytes + sizeof scalars;
    void *fragment = NULL, *history = NULL, *interface = NULL;
    bool taken = take(&from, scalars.nfragment, sizeof(fracas_fragment), &fragment) &&
                 take(&from, scalars.nhistory, sizeof(fracas_history_row), &history) &&
                 take(&from, scalars.ninterface, sizeof(fracas_interface_row), &interface);
    *record = scalars;
    record->fragment = fragment;
    record->history = history;
    record->interface = interface;
    if (taken) return FRACAS_OK;
    fracas_record_clear(record);
    return fracas_no_memory("a record");
}

static bool same_bytes(const void *a, const void *b, size_t size)
{
    return size == 0 || memcmp(a, b, size) == 0;
}

bool fracas_record_same(const fracas_record *a, const fracas_record *b)
{
    fracas_record x = *a, y = *b;
    x.fragment = y.fragment = NULL;
    x.history = y.history = NULL;
    x.interface = y.interface = NULL;
    return same_bytes(&x, &y, sizeof x) &&
           same_bytes(a->fragment, b->fragment, a->nfragment * sizeof *a->fragment) &&
           same_bytes(a->history, b->history, a->nhistory * sizeof *a->history) &&
           same_bytes(a->interface, b->interface, a->ninterface * sizeof *a->interface);
}
