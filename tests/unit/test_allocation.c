/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The parent and its surroundings: the size of a Slurm job, quotas of processor time,
 * and why mpirun says that it ended. */
#define FOLDER "fracas-allocation"
#include "campaigns/scheduler/launch/allocation.h"
#include "campaigns/scheduler/launch/mpirun.h"
#include "campaigns/scheduler/launch/quota.h"
#include "tests/support/folder.h"
#include "tests/support/test.h"

#include <math.h>
#include <sys/stat.h>

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

/* A path in the test's folder, of the last two. */
static const char *in(const char *name)
{
    static char path[2][4096];
    static int last;
    last = !last;
    snprintf(path[last], sizeof path[last], "%s/%s", folder, name);
    return path[last];
}

static void write_line(const char *group, const char *name, const char *text)
{
    char path[4096];
    for (const char *end = group; end;) { /* makes the groups */
        end = strchr(end + 1, '/');
        snprintf(path, sizeof path, "%.*s", end ? (int)(end - group) : 4000, group);
        mkdir(in(path), 0777);
    }
    snprintf(path, sizeof path, "%s/%s/%s", folder, group, name);
    FILE *out = fopen(path, "w");
    assert_non_null(out);
    fputs(text, out);
    assert_int_equal(fclose(out), 0);
}

/* The quota of `groups`, lines as of /proc/self/cgroup, of the file systems in the folder `groups`.
 */
static double quota_of(const char *groups)
{
    write_line("groups", "../mine", groups);
    return fracas_quota_cores(in("mine"), in("groups"));
}

static void processor_time_of_control_groups(void **state)
{
    assert_int_equal(fracas_allocation_within(8, INFINITY), 8);
    assert_int_equal(fracas_allocation_within(8, 64), 8);
    assert_int_equal(fracas_allocation_within(8, 2.5), 2);
    assert_int_equal(fracas_allocation_within(8, 0.5), 1);
    assert_int_equal(fracas_allocation_within(1, 0.5), 1);
    assert_true(fracas_allocation_cores() <=
                fmax(1, fracas_quota_cores(FRACAS_QUOTA_GROUPS, FRACAS_QUOTA_MOUNT)));
    assert_true(isinf(fracas_quota_cores(in("no such file"), in("groups"))));
    assert_true(isinf(quota_of("")));
    assert_true(isinf(quota_of("nonsense\n:\n::\n")));

    /* Version 2: the least of a group and those above it; `max` is no limit. */
    write_line("groups/a/b/c", "cpu.max", "max 100000\n");
    assert_true(isinf(quota_of("0::/a/b/c\n")));
    write_line("groups/a/b", "cpu.max", "250000 100000\n");
    assert_close(quota_of("0::/a/b/c\n"), 2.5, 0);
    write_line("groups/a/b/c", "cpu.max", "300000 100000\n");
    assert_close(quota_of("0::/a/b/c\n"), 2.5, 0);
    write_line("groups/a", "cpu.max", "50000 100000\n");
    assert_close(quota_of("0::/a/b/c\n"), 0.5, 0);
    assert_true(isinf(quota_of("0::/\n")));
    /* In a container the group is the root. */
    write_line("groups", "cpu.max", "150000 50000\n");
    assert_close(quota_of("0::/\n"), 3, 0);
    assert_close(quota_of("0::/docker/of the host\n"), 3, 0);
    write_line("groups", "cpu.max", "max 100000\n");

    /* Version 1, of which the other controllers are nothing to us, and beside version 2. */
    write_line("groups/cpu,cpuacct/job", "cpu.cfs_quota_us", "-1\n");
    write_line("groups/cpu,cpuacct/job", "cpu.cfs_period_us", "100000\n");
    assert_true(isinf(quota_of("4:cpu,cpuacct:/job\n")));
    write_line("groups/cpu,cpuacct/job", "cpu.cfs_quota_us", "1600000\n");
    assert_close(quota_of("5:memory:/job\n4:cpu,cpuacct:/job\n0::/\n"), 16, 0);
    assert_true(isinf(quota_of("4:cpuset,cpuacct:/job\n")));
    write_line("groups/cpu", "cpu.cfs_quota_us", "200000\n");
    write_line("groups/cpu", "cpu.cfs_period_us", "100000\n");
    assert_close(quota_of("1:cpuacct,cpu:/docker/of the host\n"), 2, 0);
    write_line("groups/unified", "cpu.max", "100000 100000\n");
    assert_close(quota_of("1:cpu:/\n0::/\n"), 1, 0);
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

TESTS_ALL(make_folder, remove_folder, lists_of_slurm, jobs_of_an_allocation,
          a_task_of_srun_without_mpi, processor_time_of_control_groups, the_line_that_tells)
