/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/file/memory.h"

#include <stdint.h>
#include <stdlib.h>

typedef struct block {
    struct block *next;
    size_t size, used;
    max_align_t bytes[];
} block;

struct fracas_campaign_memory {
    block *first; /* the one in use */
};

enum { BLOCK = 65536 }; /* bytes, at least */

fracas_campaign_memory *fracas_memory_create(void)
{
    return calloc(1, sizeof(fracas_campaign_memory));
}

void fracas_memory_destroy(fracas_campaign_memory *memory)
{
    if (!memory) return;
    while (memory->first) {
        block *next = memory->first->next;
        free(memory->first);
        memory->first = next;
    }
    free(memory);
}

void *fracas_memory_take(fracas_campaign_memory *memory, size_t count, size_t size)
{
    const size_t grain = sizeof(max_align_t);
    if (size != 0 && count > (SIZE_MAX / 2) / size) return NULL;
    size_t need = (count * size + grain - 1) / grain * grain;
    block *in_use = memory->first;
    if (!in_use || in_use->size - in_use->used < need) {
        size_t room = need > BLOCK ? need : BLOCK;
        block *added = calloc(1, sizeof *added + room);
        if (!added) return NULL;
        *added = (block){.next = in_use, .size = room};
        memory->first = in_use = added;
    }
    void *piece = (char *)in_use->bytes + in_use->used;
    in_use->used += need;
    return piece;
}
