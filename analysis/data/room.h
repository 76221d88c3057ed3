/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Arrays of one purpose, freed together. */
#ifndef FRACAS_ANALYSIS_DATA_ROOM_H
#define FRACAS_ANALYSIS_DATA_ROOM_H

#include "base/err.h"
#include "base/own.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { FRACAS_ROOM_BLOCKS = 16 };

typedef struct {
    void *block[FRACAS_ROOM_BLOCKS];
    size_t count;
    bool lacking; /* some array could not be had */
} fracas_room;    /* {0}: without arrays */

/* Zeroed array of count + 1 elements; NULL without memory, and `lacking` is set. At most
 * FRACAS_ROOM_BLOCKS of them. */
void *fracas_room_array(fracas_room *room, size_t count, size_t size);
#define FRACAS_TAKE(room, array, count) ((array) = fracas_room_array(room, count, sizeof *(array)))

/* The numbers 0 to count - 1 by their groups, below ngroups; SIZE_MAX: in none. Those of group g
 * are
 * (*of)[(*first)[g]] to (*of)[(*first)[g + 1] - 1], ascending. */
FRACAS_MUST_USE fracas_err fracas_room_groups(fracas_room *room, const size_t *group, size_t count,
                                              size_t ngroups, size_t **first, size_t **of);

/* FRACAS_ENVIRONMENT with "no memory for <purpose>" if an array is lacking. */
FRACAS_MUST_USE fracas_err fracas_room_check(const fracas_room *room, const char *what);
void fracas_room_clear(fracas_room *room);

#endif
