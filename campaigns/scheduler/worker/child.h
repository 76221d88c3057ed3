/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A child: the process that computes one lease with its server's model (copy-on-write) and sends
 * the records. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_WORKER_CHILD_H
#define FRACAS_CAMPAIGNS_SCHEDULER_WORKER_CHILD_H

#include "campaigns/scheduler/worker/compute.h"

#include <stdbool.h>
#include <sys/types.h>

typedef struct {
    pid_t pid; /* 0: none runs */
    int fd;    /* its records come here */
    int said;  /* memory file, what it wrote on standard error; -1: none could be had */
    fracas_lease lease;
    size_t width;           /* realizations that it computes side by side */
    double began;           /* fracas_now */
    double deadline;        /* fracas_now when it has had lease.limit seconds; INFINITY: no limit */
    bool late;              /* killed at its deadline */
    fracas_packet **record; /* lease.count, of which `count` have come whole */
    size_t count;
    char fault[1024];     /* what it said was wrong; "" if nothing */
    unsigned char *bytes; /* received, not yet whole */
    size_t size, capacity;
} fracas_child;

/* Forks a child that computes the lease (copied), batch after batch, sends the records of each and
 * ends. It takes the model from `models`, its server's, or builds it if that has not, and closes
 * `server_fd`, its server's own connection, dies with its server, and is the first that the kernel
 * kills where memory runs out. FRACAS_ENVIRONMENT if no process, memory or pipe can be had. */
FRACAS_MUST_USE fracas_err fracas_child_start(fracas_child *child,
                                              const fracas_computation *computation,
                                              fracas_models *models, int server_fd);

/* Takes what the child has sent, blocking until there is something; *ended when nothing more will
 * come. */
FRACAS_MUST_USE fracas_err fracas_child_receive(fracas_child *child, bool *ended);

/* Kills the child for its time is over: fracas_child_receive will see its end. */
void fracas_child_expire(fracas_child *child);

/* After the end: waits for the process. record[i], of *count, is the message for lease.replica[i];
 * the caller frees each, and record with free(). *good is true when there is one for every
 * realization; else failure says where the lease ended and by which signal or error, and what the
 * child said on standard error. */
FRACAS_MUST_USE fracas_err fracas_child_collect(fracas_child *child, bool *good,
                                                fracas_packet ***record, size_t *count,
                                                fracas_lease_failure *failure);

/* Kills the child if one runs and frees what it sent. */
void fracas_child_clear(fracas_child *child);

#endif
