/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A child of a server: a process for one lease. It computes with the server's model (copy-on-write)
 * and sends the records. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_WORKER_CHILD_H
#define FRACAS_CAMPAIGNS_SCHEDULER_WORKER_CHILD_H

#include "campaigns/scheduler/worker/compute.h"
#include "campaigns/scheduler/worker/models.h"

#include <stdbool.h>
#include <sys/types.h>

typedef struct {
    pid_t pid;  /* 0: none runs */
    int fd;     /* its records come here */
    int errors; /* memory file of its standard error; -1: none */
    fracas_lease lease;
    size_t width;           /* realizations side by side */
    double began;           /* fracas_now */
    double deadline;        /* fracas_now after lease.limit seconds; INFINITY: none */
    bool late;              /* killed at its deadline */
    fracas_packet **record; /* lease.count, of which `count` are complete */
    size_t count;
    char fault[1024];     /* its FAULT message; "": none */
    unsigned char *bytes; /* incomplete messages */
    size_t size, capacity;
} fracas_child;

/* Forks a child to compute the lease (copied) batch by batch, send the records of each batch and
 * end. It takes the model from its server's `models`, or builds it; it closes `server_fd`, its
 * server's own connection, dies with its server, and is killed first by the kernel when memory
 * runs out. FRACAS_ENVIRONMENT without process, memory or pipe. */
FRACAS_MUST_USE fracas_err fracas_child_start(fracas_child *child,
                                              const fracas_computation *computation,
                                              fracas_models *models, int server_fd);

/* The life of the child: computes the lease and sends to `fd` the records of each batch when it is
 * done, or a FAULT message. false: the server is gone. */
bool fracas_child_live(const fracas_computation *computation, fracas_models *models, int fd);

/* Reads from the child, blocking until something comes; *ended at the end of its records. */
FRACAS_MUST_USE fracas_err fracas_child_receive(fracas_child *child, bool *ended);

/* Kills the child at its deadline: fracas_child_receive will see its end. */
void fracas_child_expire(fracas_child *child);

/* After the end: reaps the process. child->record[i], of child->count, is the message for
 * lease.replica[i]; the caller may take them (and set `count` to 0). *good is true when there is
 * one for every realization. Else `failure` has the place, the signal or error, and the child's
 * standard error. */
FRACAS_MUST_USE fracas_err fracas_child_collect(fracas_child *child, bool *good,
                                                fracas_lease_failure *failure);

/* Kills the child if one runs and frees its messages. */
void fracas_child_clear(fracas_child *child);

#endif
