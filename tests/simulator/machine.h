/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The machines of a simulated farm: processes that start and end each other, mpirun and the
 * mailboxes of its ranks, compute servers, signals. */
#ifndef FRACAS_TESTS_SIMULATOR_MACHINE_H
#define FRACAS_TESTS_SIMULATOR_MACHINE_H

#include "tests/simulator/world.h"

#include "campaigns/scheduler/types/packet.h"

/* One start of mpirun. */
struct run {
    process *launcher, *mpirun;
    int jobs, nopen, nclosed, nended; /* ranks: all, behind MPI_Init, in MPI_Finalize, ended */
    int living;                       /* processes for the launcher to reap */
    bool failing;                     /* mpirun is about to kill it */
    process **rank, **keeper;         /* by rank */
    struct servers {
        process **started;         /* every server of the rank, the last one lives */
        size_t count, room, known; /* known: the one that rank 0 takes for the present one */
    } * servers;                   /* by rank */
};

/* A message of another rank waits for the present process, a rank. */
bool machine_mail(void);
/* The stdout of the present process, a rank, leads somewhere: mpirun lives. */
bool machine_is_heard(void);
/* `signal_number` reaches a process: it dies, or takes note. */
void machine_signal(process *p, int signal_number);
/* Called when a process has ended; when the power has failed; before a file goes. */
void machine_ended(process *p);
void machine_power_failed(void);
void machine_removes(const char *path, bool replaced);

#endif
