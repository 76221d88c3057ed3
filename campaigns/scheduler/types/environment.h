/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Names of the environment by which the launcher speaks to the ranks. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_TYPES_ENVIRONMENT_H
#define FRACAS_CAMPAIGNS_SCHEDULER_TYPES_ENVIRONMENT_H

#define FRACAS_LAUNCHER_MARK "FRACAS_LAUNCHER"
#define FRACAS_DEADLINE "FRACAS_DEADLINE" /* end of --walltime, s since 1970 */
#define FRACAS_FREQUENCIES \
    "FRACAS_FREQUENCIES"                    /* fracas_frequencies_write; not on other machines */
#define FRACAS_OF "FRACAS_OF"               /* hash of the campaign, and folder of the study */
#define FRACAS_RESTARTED "FRACAS_RESTARTED" /* the reason for this restart */

/* The remedy where a process of somebody's MPI job starts fracas, which becomes a rank by mistake.
 */
#define FRACAS_JOB_VARIABLES "OMPI_*, PMIX_* and PMI_* (under srun SLURM_STEP_* as well)"
#define FRACAS_OTHER_JOB                                                    \
    "if a process of an MPI job started fracas, take " FRACAS_JOB_VARIABLES \
    " out of its environment; see the how-to for clusters"

#endif
