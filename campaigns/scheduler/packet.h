/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Messages between the processes of a run: the same bytes go through pipes and through MPI, so that
 * a rank only forwards between its compute server and rank 0.
 *
 *   rank 0 -> server   LEASE                         a lease to compute
 *                      FLUSH                         write the segment now
 *                      STOP                          drop what waits, finish (or kill) what runs,
 * write the segment, end rank 0 -> rank     QUIT                          the run is over FRESH the
 * answer to REPLACED: what follows is for the new server server -> rank 0   READY up, with the hash
 * of the campaign that it read COMPUTED, FAILED, SEGMENT     what became of leases FLUSHED the
 * answer to FLUSH where everything is in segments already TROUBLE                       this server
 * or rank cannot go on, and why ENDED                         the answer to STOP: nothing comes any
 * more rank -> rank 0     REPLACED                      its server died, of a new one READY will
 * come LOST                          its server died and there will be no other DRAIN the rank was
 * signalled child -> server    RECORD, FAULT                 a packed record for each realization,
 * or why there is none */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_PACKET_H
#define FRACAS_CAMPAIGNS_SCHEDULER_PACKET_H

#include "base/err.h"
#include "campaigns/scheduler/lease/scheduler.h"
#include "campaigns/store/store.h"

#include <stddef.h>
#include <stdint.h>

typedef enum {
    FRACAS_PACKET_LEASE = 1, /* fracas_lease, its first fracas_lease_bytes */
    FRACAS_PACKET_STOP,      /* int32_t: not 0: what runs is not needed, kill it */
    FRACAS_PACKET_QUIT,      /* empty */
    FRACAS_PACKET_READY,     /* fracas_hash */
    FRACAS_PACKET_COMPUTED,  /* fracas_lease_report */
    FRACAS_PACKET_FAILED,    /* fracas_lease_failure */
    FRACAS_PACKET_SEGMENT,   /* fracas_segment_note, its rows, its provenance with the final '\0' */
    FRACAS_PACKET_TROUBLE,   /* fracas_trouble */
    FRACAS_PACKET_ENDED,     /* empty */
    FRACAS_PACKET_LOST,      /* fracas_trouble */
    FRACAS_PACKET_DRAIN,     /* empty */
    FRACAS_PACKET_RECORD,    /* a packed record */
    FRACAS_PACKET_FAULT,     /* fracas_trouble */
    FRACAS_PACKET_FLUSH,     /* empty */
    FRACAS_PACKET_REPLACED,  /* fracas_trouble */
    FRACAS_PACKET_FRESH,     /* empty */
    FRACAS_PACKET_FLUSHED    /* empty */
} fracas_packet_kind;

/* One block of memory: its first fracas_packet_bytes are what travels. Freed with free(). */
typedef struct {
    uint32_t kind;
    uint32_t size; /* of body */
    _Alignas(8) unsigned char body[];
} fracas_packet;

typedef struct {
    int32_t code; /* fracas_err */
    char text[1024];
} fracas_trouble;

typedef struct {
    uint64_t lease;
    double seconds; /* that it took */
} fracas_lease_report;

typedef struct {
    uint64_t lease;
    uint64_t kept;  /* realizations that were computed before, whose records the server has */
    uint64_t count; /* of those after them that were computed together when it happened, 1 to
                       FRACAS_BATCH_MAX */
    char reason[1024];
} fracas_lease_failure;

typedef struct {
    char name[128];
    fracas_file_seal seal;
    uint64_t rows;
} fracas_segment_note;

/* A message with a copy of `size` bytes of `body`; FRACAS_ENVIRONMENT without memory. */
FRACAS_MUST_USE fracas_err fracas_packet_create(fracas_packet_kind kind, const void *body,
                                                size_t size, fracas_packet **message);

/* Bytes of the whole message. */
size_t fracas_packet_bytes(const fracas_packet *message);

/* FRACAS_BUG unless the body has `size` bytes at least. */
FRACAS_MUST_USE fracas_err fracas_packet_expect(const fracas_packet *message, size_t size);

/* This thread's message as a body. */
void fracas_trouble_take(fracas_err code, fracas_trouble *trouble);

/* Writes one message whole, blocking. FRACAS_ENVIRONMENT if the other end is gone. */
FRACAS_MUST_USE fracas_err fracas_packet_write(int fd, const fracas_packet *message);
FRACAS_MUST_USE fracas_err fracas_packet_send(int fd, fracas_packet_kind kind, const void *body,
                                              size_t size);

/* Reads one message whole, blocking; *message is NULL when the other end is gone. */
FRACAS_MUST_USE fracas_err fracas_packet_read(int fd, fracas_packet **message);

#endif
