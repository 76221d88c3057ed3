/* SPDX-License-Identifier: GPL-3.0-or-later */
/* In the place of campaigns/file/memory.c in sanitized builds: a block for each piece, so that the
 * sanitizer sees its end. */
#include "campaigns/file/memory.h"
#include "tests/support/test.h"

typedef struct piece {
    struct piece *next;
    max_align_t bytes[];
} piece;

struct fracas_campaign_memory {
    piece *first;
};

fracas_campaign_memory *fracas_memory_create(void)
{
    return calloc(1, sizeof(fracas_campaign_memory));
}

void fracas_memory_destroy(fracas_campaign_memory *memory)
{
    if (!memory) return;
    while (memory->first) {
        piece *next = memory->first->next;
        free(memory->first);
        memory->first = next;
    }
    free(memory);
}

void *fracas_memory_take(fracas_campaign_memory *memory, size_t count, size_t size)
{
    if (size != 0 && count > (SIZE_MAX / 2) / size) return NULL;
    piece *taken = calloc(1, sizeof *taken + count * size);
    if (!taken) return NULL;
    taken->next = memory->first;
    memory->first = taken;
    return taken->bytes;
}
