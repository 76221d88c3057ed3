/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A record as bytes: the struct with its pointers taken out, then its arrays. For one program
 * on one machine. */
#include "campaigns/store/file/schema.h"
#include "campaigns/store/pack.h"

#include <stdlib.h>
#include <string.h>

static size_t row_size(int part)
{
    return fracas_store_sets[fracas_record_parts[part].offsets + 1].row_size;
}

static const void *bytes_of(const fracas_record *record, int part, size_t *size)
{
    size_t count;
    const void *rows = fracas_ragged_get(&fracas_record_parts[part], record, &count);
    *size = count * row_size(part);
    return rows;
}

static fracas_record scalars_of(const fracas_record *record)
{
    fracas_record scalars = *record;
    scalars.fragment = NULL;
    scalars.history = NULL;
    scalars.interface = NULL;
    scalars.probe = NULL;
    scalars.reaction = NULL;
    return scalars;
}

size_t fracas_record_packed_size(const fracas_record *record)
{
    size_t all = sizeof *record;
    for (int p = 0; p < FRACAS_NPARTS; p++) {
        size_t size;
        bytes_of(record, p, &size);
        all += size;
    }
    return all;
}

void fracas_record_pack(const fracas_record *record, void *bytes)
{
    const fracas_record scalars = scalars_of(record);
    char *to = memcpy(bytes, &scalars, sizeof scalars);
    to += sizeof scalars;
    for (int p = 0; p < FRACAS_NPARTS; p++) {
        size_t size;
        const void *from = bytes_of(record, p, &size);
        if (size) memcpy(to, from, size);
        to += size;
    }
}

fracas_err fracas_record_unpack(const void *bytes, size_t size, fracas_record *record)
{
    fracas_record scalars;
    fracas_record_clear(record);
    bool fits = size >= sizeof scalars;
    if (fits) memcpy(&scalars, bytes, sizeof scalars);
    for (int p = 0; fits && p < FRACAS_NPARTS; p++) { /* alone: so the sum cannot wrap around */
        size_t count;
        fracas_ragged_get(&fracas_record_parts[p], &scalars, &count);
        fits = count <= size / row_size(p);
    }
    if (!fits || fracas_record_packed_size(&scalars) != size)
        return fracas_fail(FRACAS_BUG, "a packed record of %zu bytes does not fit its own counts",
                           size);
    *record = scalars_of(&scalars);
    const char *from = (const char *)bytes + sizeof scalars;
    for (int p = 0; p < FRACAS_NPARTS; p++) {
        size_t count, part;
        fracas_ragged_get(&fracas_record_parts[p], &scalars, &count);
        part = count * row_size(p);
        void *rows = part ? malloc(part) : NULL;
        if (part && !rows) {
            fracas_record_clear(record);
            return fracas_no_memory("a record");
        }
        if (part) memcpy(rows, from, part);
        from += part;
        fracas_ragged_set(&fracas_record_parts[p], record, rows, count);
    }
    return FRACAS_OK;
}

bool fracas_record_same(const fracas_record *a, const fracas_record *b)
{
    const fracas_record x = scalars_of(a), y = scalars_of(b);
    bool same = memcmp(&x, &y, sizeof x) == 0;
    for (int p = 0; same && p < FRACAS_NPARTS; p++) {
        size_t size; /* the same of both, whose counts are */
        const void *here = bytes_of(a, p, &size), *there = bytes_of(b, p, &size);
        same = size == 0 || memcmp(here, there, size) == 0;
    }
    return same;
}
