/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Messages between the processes of a run. The same bytes go through pipes and through MPI, so a
 * rank only forwards between its compute server and rank 0. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_TYPES_PACKET_H
#define FRACAS_CAMPAIGNS_SCHEDULER_TYPES_PACKET_H

#include "base/err.h"
#include "campaigns/scheduler/types/lease.h"
#include "campaigns/store/datafile.h"

/* Each with its body. */
typedef enum {
    /* rank 0 -> compute server */
    FRACAS_PACKET_LEASE = 1, /* a lease to compute: fracas_lease, its first fracas_lease_bytes */
    FRACAS_PACKET_FLUSH,     /* write the segment now: empty */
    FRACAS_PACKET_STOP,      /* drop waiting leases, finish the running one, write the segment and
                                end: int32_t, not 0: kill the running lease instead */
    /* rank 0 -> rank */
    FRACAS_PACKET_QUIT,  /* the run is over: empty; the rank answers with the same */
    FRACAS_PACKET_FRESH, /* answer to REPLACED, later messages are for the new server: empty */
    /* compute server -> rank 0 */
    FRACAS_PACKET_READY,    /* up: fracas_hash, of the campaign that it has read */
    FRACAS_PACKET_COMPUTED, /* fracas_lease_report */
    FRACAS_PACKET_FAILED,   /* fracas_lease_failure */
    FRACAS_PACKET_SEGMENT,  /* fracas_segment_note, its rows, its provenance with the final '\0' */
    FRACAS_PACKET_FLUSHED,  /* answer to FLUSH where all is in segments already: empty */
    FRACAS_PACKET_TROUBLE,  /* this server or rank cannot go on: fracas_trouble */
    FRACAS_PACKET_ENDED,    /* answer to STOP, nothing follows: empty */
    /* rank -> rank 0 */
    FRACAS_PACKET_REPLACED, /* its server died, READY of a new one follows: fracas_trouble */
    FRACAS_PACKET_LOST,     /* its server died, there is no other: fracas_trouble */
    FRACAS_PACKET_DRAIN,    /* the rank has a signal to drain: empty */
    /* process of a lease -> compute server */
    FRACAS_PACKET_RECORD, /* a packed record, one for each realization */
    FRACAS_PACKET_FAULT   /* the reason for its absence: fracas_trouble */
} fracas_packet_kind;

/* One block of memory, of which the first fracas_packet_bytes travel. Freed with free(). */
typedef struct {
    uint32_t kind;
    uint32_t size; /* bytes of the body */
    _Alignas(8) unsigned char body[];
} fracas_packet;

typedef struct {
    int32_t code;  /* fracas_err */
    int32_t again; /* not 0: another start of MPI helps */
    char text[1024];
} fracas_trouble;

typedef struct {
    uint64_t lease;
    double seconds; /* spent on it */
} fracas_lease_report;

typedef struct {
    uint64_t lease;
    uint64_t kept;  /* its first realizations, computed: the server has their records */
    uint64_t count; /* the batch after them, at fault: 1 to FRACAS_LANES_MAX realizations */
    char reason[1024];
} fracas_lease_failure;

typedef struct {
    char name[128];
    fracas_file_seal seal;
    uint64_t rows;
} fracas_segment_note;

/* A message with a copy of `size` bytes of `body`; NULL: the caller fills them in.
 * FRACAS_ENVIRONMENT without memory, or if it is too long for MPI. */
FRACAS_MUST_USE fracas_err fracas_packet_create(fracas_packet_kind kind, const void *body,
                                                size_t size, fracas_packet **message);

/* Bytes of the whole message. */
size_t fracas_packet_bytes(const fracas_packet *message);

/* Copies the first `size` bytes of the body. FRACAS_BUG if it has fewer. */
FRACAS_MUST_USE fracas_err fracas_packet_body(const fracas_packet *message, void *body,
                                              size_t size);

/* Keeps this thread's error message: as a body, or over other calls. */
void fracas_trouble_take(fracas_err code, fracas_trouble *trouble);
/* The error again; FRACAS_OK if it was none. */
FRACAS_MUST_USE fracas_err fracas_trouble_fail(const fracas_trouble *trouble);

/* Writes one message whole, blocking. FRACAS_ENVIRONMENT if the other end is gone. */
FRACAS_MUST_USE fracas_err fracas_packet_write(int fd, const fracas_packet *message);
FRACAS_MUST_USE fracas_err fracas_packet_send(int fd, fracas_packet_kind kind, const void *body,
                                              size_t size);

/* Reads one message whole, blocking; *message is NULL when the other end is gone. */
FRACAS_MUST_USE fracas_err fracas_packet_read(int fd, fracas_packet **message);

#endif
