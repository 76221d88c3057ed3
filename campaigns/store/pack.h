/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A record as bytes, for a pipe between processes of one program. */
#ifndef FRACAS_CAMPAIGNS_STORE_PACK_H
#define FRACAS_CAMPAIGNS_STORE_PACK_H

#include "base/err.h"
#include "engine/record.h"

#include <stdbool.h>
#include <stddef.h>

/* Size of the bytes of fracas_record_pack. */
size_t fracas_record_packed_size(const fracas_record *record);
void fracas_record_pack(const fracas_record *record, void *bytes);
/* FRACAS_BUG if `size` does not fit the counts in the bytes. */
FRACAS_MUST_USE fracas_err fracas_record_unpack(const void *bytes, size_t size,
                                                fracas_record *record);
/* Equal in every bit, all parts. */
bool fracas_record_same(const fracas_record *a, const fracas_record *b);

#endif
