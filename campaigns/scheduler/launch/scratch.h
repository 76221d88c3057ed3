/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Folders for the files of Open MPI: its session and its shared memory. Open MPI leaves them behind
 * where mpirun is killed. Here they lose their names once all ranks have opened them. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_LAUNCH_SCRATCH_H
#define FRACAS_CAMPAIGNS_SCHEDULER_LAUNCH_SCRATCH_H

#include "base/err.h"

/* The folders of one start of mpirun. The session is in TMPDIR, the shared memory in /dev/shm. */
typedef struct {
    struct {
        char path[4096]; /* "": none */
        int lock;        /* held while the folder is there; -1: none */
    } session, shared;
} fracas_scratch;
#define FRACAS_SCRATCH_NONE                   \
    {                                         \
        .session.lock = -1, .shared.lock = -1 \
    }

/* Makes both folders, and removes those of this user's killed runs. None in a Slurm job of several
 * nodes, and no `shared` where none can be made: Open MPI then puts its files where it does
 * otherwise. FRACAS_ENVIRONMENT: no `session`, or no room in it. */
FRACAS_MUST_USE fracas_err fracas_scratch_create(fracas_scratch *scratch);

/* In the process about to become mpirun: names the folders to it and to the ranks. */
void fracas_scratch_export(const fracas_scratch *scratch);

/* In a rank, before MPI_Init. */
void fracas_scratch_import(void);

/* Removes both folders: after MPI_Init of all ranks, and, for a run that does not come so far, at
 * its end. */
void fracas_scratch_remove(fracas_scratch *scratch);

#endif
