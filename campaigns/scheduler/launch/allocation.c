/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/launch/allocation.h"

#include "base/param.h"
#include "campaigns/scheduler/launch/quota.h"

#include <ctype.h>
#include <inttypes.h>
#include <limits.h>
#include <math.h>
#include <sched.h>
#include <stdlib.h>

long fracas_allocation_sum(const char *list)
{
    long sum = 0;
    while (*list) {
        char *end;
        if (!isdigit((unsigned char)*list)) return 0;
        long number = strtol(list, &end, 10), times = 1;
        if (end[0] == '(' && end[1] == 'x' && isdigit((unsigned char)end[2])) {
            times = strtol(end + 2, &end, 10);
            if (*end++ != ')') return 0;
        }
        if (number > INT_MAX || times > INT_MAX) return 0;
        sum += number * times;
        if (*end == ',' && end[1]) end++;
        else if (*end) return 0;
        list = end;
    }
    return sum <= INT_MAX ? sum : 0;
}

/* Tasks of the surrounding Slurm job; 0: none. */
static int slurm_tasks(void)
{
    const char *tasks = getenv("SLURM_NTASKS"), *cores = getenv("SLURM_JOB_CPUS_PER_NODE");
    if (!getenv("SLURM_JOB_ID")) return 0;
    if (tasks && fracas_allocation_sum(tasks) > 0) return (int)fracas_allocation_sum(tasks);
    return cores ? (int)fracas_allocation_sum(cores) : 0;
}

/* Cores of the process's affinity mask. */
static int cores_of_mask(void)
{
    enum { FIRST = 1024, LAST = 1 << 20 }; /* CPUs that a kernel may have: it refuses a small set */
    for (int most = FIRST; most <= LAST; most *= 2) {
        const size_t size = CPU_ALLOC_SIZE(most);
        cpu_set_t *set = CPU_ALLOC(most);
        if (!set) return 1;
        const int count = sched_getaffinity(0, size, set) ? 0 : CPU_COUNT_S(size, set);
        CPU_FREE(set);
        if (count) return count;
    }
    return 1;
}

int fracas_allocation_within(int mask, double quota)
{
    return quota >= mask ? mask : quota > 1 ? (int)floor(quota) : 1;
}

int fracas_allocation_cores(void)
{
    return fracas_allocation_within(cores_of_mask(),
                                    fracas_quota_cores(FRACAS_QUOTA_GROUPS, FRACAS_QUOTA_MOUNT));
}

fracas_err fracas_allocation_jobs(int wanted, int64_t parts, int *jobs)
{
    enum { MOST_A_CORE = 32 };
    const int cores = fracas_allocation_cores(), tasks = slurm_tasks();
    const int64_t most = parts > 1 ? cores / parts : cores;
    *jobs = wanted ? wanted : tasks ? tasks : most > 1 ? (int)most : 1;
    if (!tasks && parts > 1 && *jobs * parts > cores)
        return fracas_fail(FRACAS_USAGE,
                           "--jobs %d of parallel.parts %" PRId64 " are %" PRId64
                           " threads, and this machine gives the run %d cores: give less of either",
                           *jobs, parts, *jobs * parts, cores);
    if (tasks || *jobs <= MOST_A_CORE * cores) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE,
                       "--jobs %d: this machine gives the run %d cores; %d processes are the most, "
                       "one a core is the best",
                       *jobs, cores, MOST_A_CORE * cores);
}

bool fracas_allocation_spreads(void)
{
    static const char *const hosts[] = {"PBS_NODEFILE",
                                        "PE_HOSTFILE",
                                        "LSB_HOSTS",
                                        "LSB_DJOB_HOSTFILE",
                                        "OMPI_MCA_orte_default_hostfile",
                                        "PRTE_MCA_prte_default_hostfile"};
    for (size_t i = 0; i < FRACAS_COUNT(hosts); i++)
        if (getenv(hosts[i])) return true;
    const char *nodes = getenv("SLURM_JOB_NUM_NODES");
    return nodes && atoi(nodes) > 1;
}

fracas_err fracas_allocation_check(void)
{
    const char *tasks = getenv("SLURM_STEP_NUM_TASKS");
    if (!getenv("SLURM_STEP_ID") || !tasks || atoi(tasks) < 2) return FRACAS_OK;
    return fracas_fail(
        FRACAS_USAGE,
        "srun started %s processes without MPI, and each would run the whole campaign: run `fracas "
        "run` in the job without srun, or as `srun --mpi=pmix fracas run`",
        tasks);
}
