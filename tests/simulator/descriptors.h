/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Descriptors of simulated processes: files, pipes and connections. */
#ifndef FRACAS_TESTS_SIMULATOR_DESCRIPTORS_H
#define FRACAS_TESTS_SIMULATOR_DESCRIPTORS_H

#include "tests/simulator/disk.h"

enum { FIRST_FD = 1000000 };

/* One side of a connection: the messages there. */
typedef struct channel {
    struct channel *peer;
    process *reader, *writer; /* who waits */
    unsigned char *bytes;
    size_t size, room, capacity;
    bool closed; /* nobody has this side any more */
} channel;

typedef struct {
    process *owner;
    size_t next; /* of its owner's, or of the free ones; 0: the last */
    node *file;
    size_t at;
    channel *channel;
} descriptor;

/* Of the present process. */
int descriptor_new(descriptor what);
descriptor *descriptor_of(int fd); /* NULL: none */
void descriptor_give(int fd, process *to);
void descriptor_shut(int fd);
/* The process has ended. */
void descriptors_end(const process *p);

/* Two connected sides, each of which takes `capacity` bytes. */
void channel_pair(channel *side[2], size_t capacity);
/* Something can be read, or the other side is gone. */
bool channel_is_ready(const channel *side);
/* Appends all, whatever the capacity. */
void channel_fill(channel *to, const void *bytes, size_t size);
/* As read and write, which wait. */
ssize_t channel_read(channel *side, void *to, size_t size);
ssize_t channel_write(channel *side, const void *from, size_t size);

#endif
