/* The parent: owns terminal, signals and exit status, and starts mpirun. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_PARENT_H
#define FRACAS_CAMPAIGNS_SCHEDULER_PARENT_H

#include "campaigns/scheduler/run.h"

/* Runs `mpirun -n jobs <this program> argv[1] ...` to its end and returns how rank 0 says the run ended. SIGINT,
 * SIGTERM and SIGHUP drain; the second one kills the run, and nothing that is done is lost. */
FRACAS_MUST_USE fracas_err fracas_parent_run(const fracas_run_options *options, int argc, char **argv, bool *ran);

#endif
