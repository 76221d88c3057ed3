/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/partition.h"

#include <stdlib.h>

fracas_err fracas_partition_init(fracas_partition *partition, size_t elements)
{
    *partition = (fracas_partition){.elements = elements,
                                    .parent = malloc(elements * sizeof *partition->parent),
                                    .label = malloc(elements * sizeof *partition->label)};
    if (!partition->parent || !partition->label) {
        fracas_partition_clear(partition);
        return fracas_no_memory("the partition into fragments");
    }
    fracas_partition_reset(partition);
    return FRACAS_OK;
}

void fracas_partition_reset(fracas_partition *partition)
{
    for (size_t e = 0; e < partition->elements; e++) partition->parent[e] = (uint32_t)e;
}

void fracas_partition_clear(fracas_partition *partition)
{
    free(partition->parent);
    free(partition->label);
    *partition = (fracas_partition){0};
}

uint32_t fracas_partition_root(fracas_partition *partition, uint32_t e)
{
    uint32_t *parent = partition->parent;
    while (parent[e] != e) {
        parent[e] = parent[parent[e]]; /* halve the path */
        e = parent[e];
    }
    return e;
}

void fracas_partition_unite(fracas_partition *partition, uint32_t a, uint32_t b)
{
    a = fracas_partition_root(partition, a);
    b = fracas_partition_root(partition, b);
    if (a < b) partition->parent[b] = a;
    else partition->parent[a] = b;
}

size_t fracas_partition_label(fracas_partition *partition)
{
    size_t count = 0;
    for (size_t e = 0; e < partition->elements; e++) {
        uint32_t root = fracas_partition_root(partition, (uint32_t)e);
        partition->label[e] = root == e ? (uint32_t)count++ : partition->label[root];
    }
    return count;
}
