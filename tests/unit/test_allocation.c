/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the parent takes from its surroundings: the size of a Slurm job, and why mpirun says that it
 * ended. */
#include "campaigns/scheduler/launch/allocation.h"
#include "campaigns/scheduler/launch/mpirun.h"
#include "tests/support/test.h"

static void lists_of_slurm(void **state)
{
    assert_int_equal(fracas_allocation_sum("4"), 4);
    assert_int_equal(fracas_allocation_sum("16(x2)"), 32);
    assert_int_equal(fracas_allocation_sum("72(x2),36,8(x10)"), 260);
    static const char *const wrong[] = {"",
                                        "x",
                                        "4,",
                                        "4(2)",
                                        "4(x",
                                        "4(x2",
                                        "-1",
                                        "4 5",
                                        "99999999999",
                                        "2000000000(x4)",
                                        "4(x99999999999)"};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
        assert_int_equal(fracas_allocation_sum(wrong[i]), 0);
}

static void jobs_of_an_allocation(void **state)
{
    int jobs;
    unsetenv("SLURM_NTASKS");
    setenv("SLURM_JOB_ID", "7", 1);
    setenv("SLURM_JOB_CPUS_PER_NODE", "128(x3)", 1);
    OK(fracas_allocation_jobs(0, 0, &jobs));
    assert_int_equal(jobs, 384); /* whole nodes: a process a core */
    setenv("SLURM_NTASKS", "96", 1);
    OK(fracas_allocation_jobs(0, 0, &jobs));
    assert_int_equal(jobs, 96);
    OK(fracas_allocation_jobs(100000, 0, &jobs)); /* the bound is that of one machine */
    assert_int_equal(jobs, 100000);
    setenv("SLURM_NTASKS", "many", 1);
    OK(fracas_allocation_jobs(0, 0, &jobs));
    assert_int_equal(jobs, 384);
    setenv("SLURM_NTASKS", "96", 1);
    unsetenv("SLURM_JOB_ID"); /* left over from a job: no allocation */
    OK(fracas_allocation_jobs(0, 0, &jobs));
    assert_true(jobs >= 1 && jobs != 96);
    const int cores = jobs; /* parts times jobs are never more */
    assert_int_equal(fracas_allocation_jobs(1000000, 0, &jobs), FRACAS_USAGE);
    for (int parts = 1; parts <= cores; parts++) {
        OK(fracas_allocation_jobs(0, parts, &jobs));
        assert_true(jobs * parts <= cores && (jobs + 1) * parts > cores);
    }
    assert_int_equal(fracas_allocation_jobs(0, cores + 1, &jobs), FRACAS_USAGE);
    assert_int_equal(fracas_allocation_jobs(1, cores + 1, &jobs), FRACAS_USAGE);
    OK(fracas_allocation_jobs(cores + 1, 1, &jobs));
    unsetenv("SLURM_NTASKS");
    unsetenv("SLURM_JOB_CPUS_PER_NODE");
}

static void a_task_of_srun_without_mpi(void **state)
{
    setenv("SLURM_STEP_ID", "0", 1);
    unsetenv("SLURM_STEP_NUM_TASKS");
    OK(fracas_allocation_check());
    setenv("SLURM_STEP_NUM_TASKS", "1", 1);
    OK(fracas_allocation_check());
    setenv("SLURM_STEP_NUM_TASKS", "4", 1);
    FAILS(fracas_allocation_check(), FRACAS_USAGE, "--mpi=pmix");
    unsetenv("SLURM_STEP_ID"); /* the batch script itself */
    OK(fracas_allocation_check());
    unsetenv("SLURM_STEP_NUM_TASKS");
}

/* As Open MPI 4.1.4 said them. */
static void the_line_that_tells(void **state)
{
    static const struct {
        const char *said, *reason;
    } known[] = {
        {"[vm:1] *** Process received signal ***\n[vm:1] Signal: Segmentation fault (11)\n"
         "--------------------------------------------------------------------------\n"
         "Primary job  terminated normally, but 1 process returned\na non-zero exit code. Per "
         "user-direction, the job has been aborted.\n"
         "--------------------------------------------------------------------------\n"
         "mpirun noticed that process rank 1 with PID 15149 on node node1 exited on signal 11 "
         "(Segmentation fault).\n",
         "mpirun noticed that process rank 1 with PID 15149 on node node1 exited on signal 11 "
         "(Segmentation fault)"},
        {"--------------------------------------------------------------------------\nORTE has "
         "lost communication with a remote daemon.\n\n"
         "  HNP daemon   : [[1,0],0] on node vm\n",
         "ORTE has lost communication with a remote daemon"},
        {"-----\nThere are not enough slots available in the system to satisfy the 9\nslots that "
         "were requested by the application:\n",
         "There are not enough slots available in the system to satisfy the 9"},
        {"-----\n  [a line]\nanother\n", "[a line]"},
        {"", ""},
        {"---\n\n---", ""},
    };
    char text[512];
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        fracas_mpirun_reason(known[i].said, text, sizeof text);
        assert_string_equal(text, known[i].reason);
    }
    char small[12];
    fracas_mpirun_reason("a long line of many words\n", small, sizeof small);
    assert_string_equal(small, "a long line");
}

TESTS(lists_of_slurm, jobs_of_an_allocation, a_task_of_srun_without_mpi, the_line_that_tells)
