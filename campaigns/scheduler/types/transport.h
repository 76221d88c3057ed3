/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The two transports of mailboxes. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_TYPES_TRANSPORT_H
#define FRACAS_CAMPAIGNS_SCHEDULER_TYPES_TRANSPORT_H

#include "base/own.h"
#include "campaigns/scheduler/types/mailbox.h"

/* fracas_mailbox_open and its like, of one transport. */
struct fracas_transport {
    void (*open)(fracas_mailbox *box);
    int (*stranger)(fracas_mailbox *box, const fracas_whereabouts *mine);
    void (*close)(fracas_mailbox *box);
    void (*abort)(const fracas_mailbox *box);
    fracas_err (*post)(fracas_mailbox *box, int to, const fracas_packet *message);
    fracas_err (*clear)(fracas_mailbox *box);
    fracas_err (*receive)(fracas_mailbox *box, int *from, fracas_packet **message);
    void (*wait)(fracas_mailbox *box, int fd, int most);
};

/* Ranks of mpirun or srun. Only mailbox_mpi.c knows MPI. */
extern const fracas_transport fracas_transport_mpi;

/* Sockets of `size` local ranks, made by the process that forks them. Each rank has an inbox, into
 * which all can write. FRACAS_ENVIRONMENT without sockets or memory. */
FRACAS_MUST_USE fracas_err fracas_sockets_create(int size, fracas_sockets **sockets);
/* NULL is allowed. */
void fracas_sockets_destroy(fracas_sockets *sockets);
FRACAS_OWNER(fracas_sockets, fracas_sockets_destroy)
/* In the forked rank: its mailbox, to be opened, which owns the sockets from here on. */
void fracas_sockets_take(fracas_sockets *sockets, int rank, fracas_mailbox *box);

#endif
