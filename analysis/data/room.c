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

fracas_err fracas_room_check(const fracas_room *room, const char *what)
{
    return room->lacking ? fracas_no_memory(what) : FRACAS_OK;
}

void fracas_room_clear(fracas_room *room)
{
    for (size_t i = 0; i < room->count; i++) free(room->block[i]);
    *room = (fracas_room){0};
}
