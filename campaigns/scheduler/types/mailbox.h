/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Messages between the ranks of a run. Only mailbox.c knows MPI. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_TYPES_MAILBOX_H
#define FRACAS_CAMPAIGNS_SCHEDULER_TYPES_MAILBOX_H

#include "campaigns/scheduler/types/packet.h"

#include <stdbool.h>

typedef struct fracas_letter fracas_letter;

typedef struct {
    int rank, size;        /* this rank, and the number of all */
    fracas_letter *outbox; /* messages under way */
} fracas_mailbox;

/* Starts MPI; a process in which it does not start ends with FRACAS_ENVIRONMENT. Once. */
void fracas_mailbox_open(fracas_mailbox *box);
/* Ends MPI, when every rank does. */
void fracas_mailbox_close(fracas_mailbox *box);
/* Ends every rank at once: the others would wait for this one. */
void fracas_mailbox_abort(void);

/* Sends a copy of the message without waiting for the rank: a hung one must not hold up the others.
 * Messages between two ranks keep their order. FRACAS_ENVIRONMENT if MPI fails or without memory.
 */
FRACAS_MUST_USE fracas_err fracas_mailbox_post(fracas_mailbox *box, int to,
                                               const fracas_packet *message);
/* Frees the delivered messages; box->outbox is NULL when none is under way. */
FRACAS_MUST_USE fracas_err fracas_mailbox_clear(fracas_mailbox *box);

/* *message, freed by the caller, is NULL when none has come. */
FRACAS_MUST_USE fracas_err fracas_mailbox_receive(fracas_mailbox *box, int *from,
                                                  fracas_packet **message);

/* "Open MPI v4.1.4", also before fracas_mailbox_open. */
void fracas_mailbox_version(char *text, size_t size);

#endif
