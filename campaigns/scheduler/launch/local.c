/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The starter of ranks on one machine. It passes on signals, and ends with the first rank that dies
 * before the run is over; the others die with it. */
#include "base/own.h"
#include "base/param.h"
#include "campaigns/scheduler/launch/signals.h"
#include "campaigns/scheduler/launch/starter.h"
#include "campaigns/scheduler/status/channel.h"
#include "campaigns/scheduler/types/process.h"
#include "campaigns/scheduler/types/transport.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

static fracas_err check(int jobs)
{
    enum { FILES = 40, FILES_A_JOB = 3 };
    return fracas_starter_raise_files(FILES + FILES_A_JOB * (unsigned long)jobs);
}

/* A rank. Signals for its starter reach it from here on. */
static _Noreturn void live(const fracas_ranks *ranks, fracas_sockets *sockets, int rank,
                           const sigset_t *awaited)
{
    fracas_mailbox box;
    fracas_signals_catch_rank();
    sigprocmask(SIG_UNBLOCK, awaited, NULL);
    fracas_sockets_take(sockets, rank, &box);
    exit(ranks->life(ranks->options, &box, ranks->facts));
}

static fracas_err fork_ranks(const fracas_ranks *ranks, const sigset_t *awaited, pid_t *pid)
{
    OWN(fracas_sockets) sockets = NULL;
    TRY(fracas_sockets_create(ranks->jobs, &sockets));
    for (int r = 0; r < ranks->jobs; r++) {
        char name[32]; /* the system keeps 15 bytes */
        snprintf(name, sizeof name, "fracas-rank-%d", r);
        TRY(fracas_process_fork(name, FRACAS_OOM_SAME, "a rank", &pid[r]));
        if (pid[r] == 0) live(ranks, sockets, r, awaited);
    }
    return FRACAS_OK;
}

/* Returns the number of ranks ended well. */
static int reap(const fracas_ranks *ranks, pid_t *pid)
{
    int ended = 0, status;
    for (pid_t one; (one = waitpid(-1, &status, WNOHANG)) > 0; ended++) {
        int r = 0;
        while (r < ranks->jobs && pid[r] != one) r++;
        if (status) {
            char how[256];
            fracas_process_end_text(status, how, sizeof how);
            fprintf(stderr, "%srank %d %s\n",
                    WIFSIGNALED(status) ? "the starter noticed that " : "", r, how);
            _exit(FRACAS_ENVIRONMENT);
        }
        pid[r] = 0;
    }
    return ended;
}

static _Noreturn void start_ranks(const fracas_ranks *ranks)
{
    static const int passed[] = {SIGUSR1, SIGUSR2, SIGTERM, SIGINT, SIGHUP};
    sigset_t awaited;
    sigemptyset(&awaited);
    sigaddset(&awaited, SIGCHLD);
    for (size_t i = 0; i < FRACAS_COUNT(passed); i++) sigaddset(&awaited, passed[i]);
    sigprocmask(SIG_BLOCK, &awaited, NULL);
    setenv(FRACAS_LAUNCHER_MARK, "1", 1);
    OWNED pid_t *pid = calloc((size_t)ranks->jobs, sizeof *pid);
    if (!pid || fork_ranks(ranks, &awaited, pid)) {
        fprintf(stderr, "fracas: %s\n", pid ? fracas_message() : "no memory for the ranks");
        _exit(FRACAS_ENVIRONMENT);
    }
    for (int left = ranks->jobs; left > 0;) {
        const int number = sigwaitinfo(&awaited, NULL);
        if (number == SIGCHLD) left -= reap(ranks, pid);
        for (int r = 0; number > 0 && number != SIGCHLD && r < ranks->jobs; r++)
            if (pid[r]) kill(pid[r], SIGUSR1);
    }
    _exit(0);
}

static fracas_err start(const fracas_ranks *ranks, fracas_scratch *scratch, fracas_starter *starter)
{
    (void)scratch;
    fflush(stdout); /* or the ranks would write it, too */
    TRY(fracas_starter_fork(starter));
    if (starter->pid == 0) start_ranks(ranks);
    return FRACAS_OK;
}

const fracas_starter_kind fracas_starter_local = {"the starter", check, start};
