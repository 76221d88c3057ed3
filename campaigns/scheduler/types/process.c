/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/types/process.h"

#include "base/own.h"

#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

fracas_err fracas_process_fork(const char *name, int oom_score, const char *purpose, pid_t *pid)
{
    const pid_t parent = getpid();
    *pid = fork();
    if (*pid < 0)
        return fracas_fail(FRACAS_ENVIRONMENT,
                           "no process for %s: %s; use fewer --jobs, or raise the limits on "
                           "processes and memory",
                           purpose, strerror(errno));
    if (*pid > 0) return FRACAS_OK;
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(FRACAS_INTERRUPTED); /* the parent died before the line above */
    prctl(PR_SET_NAME, name);
    if (oom_score == FRACAS_OOM_SAME) return FRACAS_OK;
    OWN(FILE) file = fopen("/proc/self/oom_score_adj", "we");
    if (file) fprintf(file, "%d", oom_score);
    return FRACAS_OK;
}

void fracas_process_end_text(int status, char *text, size_t size)
{
    if (!WIFSIGNALED(status)) snprintf(text, size, "ended with status %d", WEXITSTATUS(status));
    else
        snprintf(text, size, "died of signal %d (%s%s)", WTERMSIG(status),
                 strsignal(WTERMSIG(status)),
                 WTERMSIG(status) == SIGKILL ? "; memory may have run out" : "");
}
