/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "tests/simulator/descriptors.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static descriptor *all; /* the first is none */
static size_t nall = 1, room, free_ones;

static void own(size_t i, process *p)
{
    all[i].owner = p;
    if (!p) return;
    all[i].next = p->descriptors;
    p->descriptors = i;
}

static void disown(size_t i)
{
    if (!all[i].owner) return;
    size_t *at = &all[i].owner->descriptors;
    while (*at != i) at = &all[*at].next;
    *at = all[i].next;
}

int descriptor_new(descriptor what)
{
    size_t i = free_ones;
    if (i) free_ones = all[i].next;
    else if (fracas_grow(&all, sizeof *all, nall, &room, "descriptors")) abort();
    else i = nall++;
    all[i] = what;
    own(i, world.current);
    return FIRST_FD + (int)i;
}

descriptor *descriptor_of(int fd)
{
    const size_t i = (size_t)(fd - FIRST_FD);
    if (fd < FIRST_FD || i >= nall) return NULL;
    descriptor *d = &all[i];
    return d->file || d->channel ? d : NULL;
}

void descriptor_give(int fd, process *to)
{
    const size_t i = (size_t)(fd - FIRST_FD);
    disown(i);
    own(i, to);
}

static void wake(process *p)
{
    process_wake(p, 5e-4 * roll(DICE_DELAY));
}

static void channel_close(channel *side)
{
    side->closed = true;
    wake(side->peer->reader);
    wake(side->peer->writer);
}

static void shut(size_t i)
{
    descriptor *d = &all[i];
    if (d->channel) channel_close(d->channel);
    if (d->file && d->file->locked_by == d->owner) d->file->locked_by = NULL;
    disown(i);
    *d = (descriptor){.next = free_ones};
    free_ones = i;
}

void descriptor_shut(int fd)
{
    if (descriptor_of(fd)) shut((size_t)(fd - FIRST_FD));
}

void descriptors_end(const process *p)
{
    while (p->descriptors) shut(p->descriptors);
}

/* ---- connections ---- */

void channel_pair(channel *side[2], size_t capacity)
{
    for (int s = 0; s < 2; s++) {
        side[s] = calloc(1, sizeof *side[s]);
        if (!side[s]) abort();
        side[s]->capacity = capacity;
    }
    side[0]->peer = side[1];
    side[1]->peer = side[0];
}

bool channel_is_ready(const channel *side)
{
    return side->size || side->peer->closed;
}

void channel_fill(channel *to, const void *bytes, size_t size)
{
    if (to->size + size > to->room) {
        to->room = 2 * (to->size + size);
        to->bytes = realloc(to->bytes, to->room);
        if (!to->bytes) abort();
    }
    memcpy(to->bytes + to->size, bytes, size);
    to->size += size;
    wake(to->reader);
}

ssize_t channel_read(channel *side, void *to, size_t size)
{
    for (side->reader = world.current; !channel_is_ready(side);) process_wait(INFINITY);
    if (!side->size) return 0;
    if (size > side->size) size = side->size;
    memcpy(to, side->bytes, size);
    side->size -= size;
    memmove(side->bytes, side->bytes + size, side->size);
    wake(side->peer->writer);
    return (ssize_t)size;
}

ssize_t channel_write(channel *side, const void *from, size_t size)
{
    channel *to = side->peer;
    for (side->writer = world.current; !to->closed && to->size >= to->capacity;)
        process_wait(INFINITY);
    errno = EPIPE;
    if (to->closed) return -1;
    if (size > to->capacity - to->size) size = to->capacity - to->size;
    channel_fill(to, from, size);
    return (ssize_t)size;
}
