/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/worker/process.h"

#include "base/err.h"
#include "base/own.h"

#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

void fracas_process_begin(const char *name, pid_t parent, int oom_score)
{
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(FRACAS_INTERRUPTED); /* the parent died before the line above */
    prctl(PR_SET_NAME, name);
    if (oom_score == FRACAS_OOM_SAME) return;
    OWN(FILE) file = fopen("/proc/self/oom_score_adj", "we");
    if (file) fprintf(file, "%d", oom_score);
}

void fracas_process_end_text(int status, char *text, size_t size)
{
    if (!WIFSIGNALED(status)) snprintf(text, size, "ended with status %d", WEXITSTATUS(status));
    else
        snprintf(text, size, "died of signal %d (%s%s)", WTERMSIG(status),
                 strsignal(WTERMSIG(status)),
                 WTERMSIG(status) == SIGKILL ? "; memory may have run out" : "");
}
