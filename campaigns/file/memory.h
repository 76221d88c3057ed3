/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Memory with the life of a campaign: taken piece by piece, freed at once. */
#ifndef FRACAS_CAMPAIGNS_FILE_MEMORY_H
#define FRACAS_CAMPAIGNS_FILE_MEMORY_H

#include "base/own.h"

#include <stddef.h>

typedef struct fracas_campaign_memory fracas_campaign_memory;

/* NULL without memory. */
fracas_campaign_memory *fracas_memory_create(void);
void fracas_memory_destroy(fracas_campaign_memory *memory); /* NULL is allowed */
FRACAS_OWNER(fracas_campaign_memory, fracas_memory_destroy)

/* `count` objects of `size` bytes, all zero, aligned for any object; NULL without memory (or if the
 * product overflows). Freed with `memory`. */
void *fracas_memory_take(fracas_campaign_memory *memory, size_t count, size_t size);

#endif
