/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Descriptors of simulated processes: files, pipes and connections, and sockets that listen. */
#ifndef FRACAS_TESTS_SIMULATOR_DESCRIPTORS_H
#define FRACAS_TESTS_SIMULATOR_DESCRIPTORS_H

#include "tests/simulator/disk.h"

#include <poll.h>

enum { FIRST_FD = 1000000 };

/* One side of a connection: the messages there. */
typedef struct channel {
    struct channel *peer;
    process *reader, *writer; /* who waits */
    process *end;             /* of a connection between processes of any host: who has this side */
    unsigned char *bytes;
    size_t size, room, capacity;
    size_t seen;     /* bytes that came before the network was cut */
    double patience; /* of a blocking recv [s]; 0: endless */
    bool closed;     /* nobody has this side any more */
    bool broken;     /* the network was cut for too long */
    bool stranger;   /* no process of fracas has this side */
} channel;

typedef struct listener listener; /* network.c */

typedef struct {
    process *owner;
    size_t next; /* of its owner's, or of the free ones; 0: the last */
    node *file;
    size_t at;
    channel *channel;
    listener *listener;
    bool socket; /* neither connected nor listening yet */
} descriptor;

/* Of the present process. */
int descriptor_new(descriptor what);
descriptor *descriptor_of(int fd); /* NULL: none */
/* Visits the connections of a process. */
void descriptor_each(const process *p, void (*visit)(channel *side));
void descriptor_give(int fd, process *to);
void descriptor_shut(int fd);
/* The process has ended. */
void descriptors_end(const process *p);

/* Two connected sides, each of which takes `capacity` bytes. */
void channel_pair(channel *side[2], size_t capacity);
/* Bytes that can be read now; the other side is gone, and all that can is read before. */
size_t channel_readable(const channel *side);
bool channel_is_gone(const channel *side);
/* Appends all, whatever the capacity. */
void channel_fill(channel *to, const void *bytes, size_t size);
size_t channel_take(channel *side, void *to, size_t size);
/* As much as goes now; -1, and errno, if the other side is gone. */
ssize_t channel_send(channel *side, const void *from, size_t size);
short channel_events(const channel *side, short wanted);
void channel_close(channel *side);
void channel_wake(channel *side);

/* network.c */
bool network_is_cut(const channel *side);
void network_shut(listener *at);
/* A listening process; NULL without. */
const process *network_listener(uint64_t port);
/* The messages of a process of a lease, to and from others, do not arrive before `until`. */
void network_cut(process *p, double until);
bool network_has(const process *p); /* connections */

#endif
