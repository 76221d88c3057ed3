/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/data/room.h"

#include <stdlib.h>

void *fracas_room_array(fracas_room *room, size_t count, size_t size)
{
    void *made = room->count < FRACAS_ROOM_BLOCKS ? calloc(count + 1, size) : NULL;
    if (made) room->block[room->count++] = made;
    else room->lacking = true;
    return made;
}

fracas_err fracas_room_groups(fracas_room *room, const size_t *group, size_t count, size_t ngroups,
                              size_t **first, size_t **of)
{
    FRACAS_TAKE(room, *first, ngroups + 1);
    FRACAS_TAKE(room, *of, count);
    TRY(fracas_room_check(room, "the order of a list"));
    /* Counted two places further on: the filling leaves each start where it belongs. */
    for (size_t i = 0; i < count; i++)
        if (group[i] != SIZE_MAX) (*first)[group[i] + 2]++;
    for (size_t g = 0; g < ngroups; g++) (*first)[g + 2] += (*first)[g + 1];
    for (size_t i = 0; i < count; i++)
        if (group[i] != SIZE_MAX) (*of)[(*first)[group[i] + 1]++] = i;
    return FRACAS_OK;
}

fracas_err fracas_room_check(const fracas_room *room, const char *what)
{
    return room->lacking ? fracas_no_memory(what) : FRACAS_OK;
}

void fracas_room_clear(fracas_room *room)
{
    for (size_t i = 0; i < room->count; i++) free(room->block[i]);
    *room = (fracas_room){0};
}
