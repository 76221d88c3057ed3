/* A child: the process that computes one lease with its server's model (copy-on-write) and sends the records. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_CHILD_H
#define FRACAS_CAMPAIGNS_SCHEDULER_CHILD_H

#include "campaigns/campaign.h"
#include "campaigns/scheduler/packet.h"
#include "campaigns/scheduler/run.h"
#include "engine/engine.h"

#include <stdbool.h>
#include <sys/types.h>

typedef struct {
    pid_t pid; /* 0: none runs */
    int fd;    /* its records come here */
    fracas_lease lease;
    size_t width;         /* realizations that it computes side by side */
    double began;         /* fracas_now */
    unsigned char *bytes; /* received so far */
    size_t size, capacity;
} fracas_child;

/* Forks a child that computes `lease` of `model`, with strengths of `field`. It closes `server_fd`, its server's own connection.
 * FRACAS_ENVIRONMENT if no process or pipe can be had.
 *
 * For tests: FRACAS_TEST_CRASH=POINT:REPLICA in the environment (point counted from 0 in plan order) makes every
 * child that is about to compute this realization die of SIGSEGV. FRACAS_TEST_LOG=FILE, where FILE is there, appends a line for
 * every batch that is begun: pid, pid of the parent, point, replicas. */
FRACAS_MUST_USE fracas_err fracas_child_start(fracas_child *child, const fracas_campaign *campaign,
                                              const fracas_run_options *options, const fracas_model *model,
                                              const fracas_field *field, const fracas_lease *lease, int server_fd);

/* Takes what the child has sent, blocking until there is something; *ended when nothing more will come. */
FRACAS_MUST_USE fracas_err fracas_child_receive(fracas_child *child, bool *ended);

/* After the end: waits for the process. record[i], of *count, is the message for lease.replica[i]; the caller frees each, and
 * record with free(). *good is true when there is one for every realization; else failure says where the lease ended and by which
 * signal or error. */
FRACAS_MUST_USE fracas_err fracas_child_collect(fracas_child *child, bool *good, fracas_packet ***record, size_t *count,
                                                fracas_lease_failure *failure);

/* Kills the child if one runs and frees its buffer. */
void fracas_child_clear(fracas_child *child);

#endif
