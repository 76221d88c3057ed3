/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Messages between the ranks of a run, by one of two transports: MPI, or sockets between the ranks
 * that one process of this machine has started. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_TYPES_MAILBOX_H
#define FRACAS_CAMPAIGNS_SCHEDULER_TYPES_MAILBOX_H

#include "campaigns/scheduler/types/packet.h"

#include <stdbool.h>

typedef struct fracas_letter fracas_letter;
typedef struct fracas_sockets fracas_sockets;
typedef struct fracas_transport fracas_transport;

typedef struct {
    const fracas_transport *transport; /* set before fracas_mailbox_open */
    int rank, size;                    /* this rank, and the number of all */
    fracas_letter *outbox;             /* messages under way */
    fracas_sockets *sockets;           /* local ranks only */
    int pause;                         /* MPI is polled [ms] */
} fracas_mailbox;

/* Place of a rank's study, as hashes: the host's name, the folder's absolute path without links,
 * the folder as given. */
typedef struct {
    fracas_hash host, path, given;
} fracas_whereabouts;

/* Joins the other ranks; a process in which MPI does not start ends with FRACAS_ENVIRONMENT. Once.
 * Without the others it says so after some seconds. */
void fracas_mailbox_open(fracas_mailbox *box);
/* The lowest rank with another study than rank 0, the same for all ranks, each of which calls this
 * once; -1: none. On one host paths are compared, across hosts the folders as given: a disk may
 * have another path there. `mine` NULL: this rank does not know. */
int fracas_mailbox_stranger(fracas_mailbox *box, const fracas_whereabouts *mine);
/* Leaves them; MPI waits here until every rank does. */
void fracas_mailbox_close(fracas_mailbox *box);
/* Ends every rank at once: the others would wait for this one. */
void fracas_mailbox_abort(const fracas_mailbox *box);

/* Sends a copy of the message to any rank, without waiting for it: a hung one must not hold up the
 * others. Messages between two ranks keep their order. FRACAS_ENVIRONMENT if the transport fails or
 * without memory. */
FRACAS_MUST_USE fracas_err fracas_mailbox_post(fracas_mailbox *box, int to,
                                               const fracas_packet *message);
/* Goes on with what is under way, and frees the delivered messages; box->outbox is NULL when none
 * is left. */
FRACAS_MUST_USE fracas_err fracas_mailbox_clear(fracas_mailbox *box);

/* *message, freed by the caller, is NULL when none has come. */
FRACAS_MUST_USE fracas_err fracas_mailbox_receive(fracas_mailbox *box, int *from,
                                                  fracas_packet **message);

/* Sleeps until a message may have come, fd (-1: none) can be read, messages under way can go on, a
 * signal comes, or `most` ms are over. Sockets end the sleep at once, MPI within 8 ms. */
void fracas_mailbox_wait(fracas_mailbox *box, int fd, int most);

/* "Open MPI v4.1.4", also before fracas_mailbox_open, and without MPI. */
void fracas_mailbox_version(char *text, size_t size);

#endif
