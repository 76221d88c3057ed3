/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Connected sets of things numbered from 0, by union-find: elements over unbroken interfaces are
 * fragments, vertices over broken ones cracks. Here, not in one room, because the engine counts
 * fragments and the analysis draws them. */
#ifndef FRACAS_BASE_PARTITION_H
#define FRACAS_BASE_PARTITION_H

#include "base/err.h"

#include <stddef.h>
#include <stdint.h>

typedef struct {
    size_t elements;
    uint32_t *parent; /* union-find forest; the root of a set is its smallest element */
    uint32_t *label;  /* set of each element, after fracas_partition_label */
} fracas_partition;

/* Every element a set of its own. */
FRACAS_MUST_USE fracas_err fracas_partition_init(fracas_partition *partition, size_t elements);
void fracas_partition_reset(fracas_partition *partition); /* again */
void fracas_partition_clear(fracas_partition *partition);

/* Elements `a` and `b` belong together. */
void fracas_partition_unite(fracas_partition *partition, uint32_t a, uint32_t b);

/* The smallest element of the set of `e`. */
uint32_t fracas_partition_root(fracas_partition *partition, uint32_t e);

/* Numbers the sets 0 .. count-1 by their smallest element, fills label, returns count. */
size_t fracas_partition_label(fracas_partition *partition);

#endif
