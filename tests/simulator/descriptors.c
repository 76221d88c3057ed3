/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "tests/simulator/descriptors.h"

#include <errno.h>
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
    return d->file || d->channel || d->listener || d->socket ? d : NULL;
}

void descriptor_each(const process *p, void (*visit)(channel *side))
{
    for (size_t i = p->descriptors; i; i = all[i].next)
        if (all[i].channel) visit(all[i].channel);
}

void descriptor_give(int fd, process *to)
{
    const size_t i = (size_t)(fd - FIRST_FD);
    disown(i);
    own(i, to);
}

static void shut(size_t i)
{
    descriptor *d = &all[i];
    if (d->channel) channel_close(d->channel);
    if (d->listener) network_shut(d->listener);
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

static double lag(void)
{
    return 5e-4 * roll(DICE_DELAY);
}

void channel_wake(channel *side)
{
    process_wake(side->reader, lag());
    process_wake(side->writer, lag());
}

void channel_close(channel *side)
{
    side->closed = true;
    channel_wake(side->peer);
}

size_t channel_readable(const channel *side)
{
    return network_is_cut(side) ? side->seen : side->size;
}

bool channel_is_gone(const channel *side)
{
    return side->broken || (side->peer->closed && !network_is_cut(side));
}

void channel_fill(channel *to, const void *bytes, size_t size)
{
    if (to->stranger) broken("a stranger is told %zu bytes", size);
    if (to->size + size > to->room) {
        to->room = 2 * (to->size + size);
        to->bytes = realloc(to->bytes, to->room);
        if (!to->bytes) abort();
    }
    memcpy(to->bytes + to->size, bytes, size);
    to->size += size;
    if (network_is_cut(to)) return;
    to->seen = to->size;
    process_wake(to->reader, lag());
}

size_t channel_take(channel *side, void *to, size_t size)
{
    const size_t there = channel_readable(side);
    if (size > there) size = there;
    memcpy(to, side->bytes, size);
    side->size -= size;
    side->seen -= size < side->seen ? size : side->seen;
    memmove(side->bytes, side->bytes + size, side->size);
    process_wake(side->peer->writer, lag());
    return size;
}

ssize_t channel_send(channel *side, const void *from, size_t size)
{
    channel *to = side->peer;
    errno = EPIPE;
    if (channel_is_gone(side)) return -1;
    errno = EAGAIN;
    if (to->size >= to->capacity) return -1;
    if (size > to->capacity - to->size) size = to->capacity - to->size;
    channel_fill(to, from, size);
    return (ssize_t)size;
}

short channel_events(const channel *side, short wanted)
{
    const bool gone = channel_is_gone(side);
    int events = channel_readable(side) || gone ? POLLIN : 0;
    if (side->peer->size < side->peer->capacity || gone) events |= POLLOUT;
    if (gone) events |= POLLRDHUP;
    return (short)((events & wanted) | (side->broken ? POLLERR | POLLHUP : 0));
}
