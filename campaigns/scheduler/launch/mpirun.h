/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The words of mpirun and of the ranks. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_LAUNCH_MPIRUN_H
#define FRACAS_CAMPAIGNS_SCHEDULER_LAUNCH_MPIRUN_H

#include <stdbool.h>
#include <stddef.h>

enum { FRACAS_MPIRUN_MISSING = 127 }; /* its exit status when there is no mpirun */

/* True, with the reason and its remedy in `text`, if no further start can help: the output names
 * a missing component of Open MPI. */
bool fracas_mpirun_hopeless(const char *output, char *text, size_t size);

/* The reason for an early end: the most telling line of the output of a starter and the ranks; ""
 * without any. */
void fracas_mpirun_reason(const char *output, char *text, size_t size);

#endif
