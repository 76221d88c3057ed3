/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/launch/starter.h"

#include "base/param.h"
#include "campaigns/scheduler/launch/allocation.h"
#include "campaigns/scheduler/types/process.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

const fracas_starter_kind *fracas_starter_choose(void)
{
    const char *asked = getenv("FRACAS_MPIRUN");
    const bool mpirun = asked && *asked ? strcmp(asked, "0") != 0 : fracas_allocation_spreads();
    return mpirun ? &fracas_starter_mpirun : &fracas_starter_local;
}

static void close_all(const int *fd, size_t n)
{
    for (size_t i = 0; i < n; i++)
        if (fd[i] >= 0) close(fd[i]);
}

fracas_err fracas_starter_fork(fracas_starter *starter)
{
    int fd[] = {-1, -1, -1, -1}, *const out = fd, *const errors = fd + 2;
    fracas_err err = FRACAS_OK;
    if (pipe2(out, O_CLOEXEC) || pipe2(errors, O_CLOEXEC))
        err = fracas_fail_system(errno, "no pipe to the processes of the run");
    if (!err)
        err = fracas_process_fork("fracas-starter", FRACAS_OOM_SAME, "the start of the run",
                                  &starter->pid);
    if (err) {
        close_all(fd, FRACAS_COUNT(fd));
        return err;
    }
    setpgid(starter->pid, starter->pid); /* both processes do, whoever comes first */
    if (starter->pid > 0) {
        close(out[1]);
        close(errors[1]);
        starter->out = out[0];
        starter->errors = errors[0];
        return FRACAS_OK;
    }
    const int null = open("/dev/null", O_RDONLY | O_CLOEXEC);
    if (null >= 0) dup2(null, STDIN_FILENO);
    dup2(out[1], STDOUT_FILENO);
    dup2(errors[1], STDERR_FILENO);
    close_all(&null, 1);
    close_all(fd, FRACAS_COUNT(fd));
    return FRACAS_OK;
}

fracas_err fracas_starter_raise_files(unsigned long files)
{
    struct rlimit limit;
    if (getrlimit(RLIMIT_NOFILE, &limit) || limit.rlim_cur >= files) return FRACAS_OK;
    const struct rlimit raised = {limit.rlim_max < 2 * files ? limit.rlim_max : 2 * files,
                                  limit.rlim_max};
    if (raised.rlim_cur >= files && !setrlimit(RLIMIT_NOFILE, &raised)) return FRACAS_OK;
    return fracas_fail(FRACAS_ENVIRONMENT,
                       "a process may open %llu files, this run needs %lu; raise the limit on open "
                       "files (`ulimit -n`), or use fewer --jobs",
                       (unsigned long long)limit.rlim_cur, files);
}
