/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/launch/guard.h"

#include "base/param.h"
#include "campaigns/scheduler/types/environment.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

enum { PASSED = -1 }; /* in the place of a code */

/* The rank's end of a pipe to the guard: its trouble, if any, and PASSED when MPI has started. The
 * rank's children have it, too, and it never ends for the guard: reads do not wait. */
static int to_guard = -1;

/* Ends as the rank did. */
static _Noreturn void end_as(int status)
{
    if (WIFSIGNALED(status)) {
        setrlimit(RLIMIT_CORE, &(struct rlimit){0}); /* the rank has left one */
        signal(WTERMSIG(status), SIG_DFL);
        sigset_t none;
        sigemptyset(&none);
        raise(WTERMSIG(status));
        sigprocmask(SIG_SETMASK, &none, NULL);
    }
    _exit(WIFEXITED(status) ? WEXITSTATUS(status) : FRACAS_ENVIRONMENT);
}

/* Every signal but a process's own faults. */
static sigset_t forwarded(void)
{
    static const int own[] = {SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGSEGV, SIGSYS, SIGTRAP};
    sigset_t all;
    sigfillset(&all);
    for (size_t i = 0; i < FRACAS_COUNT(own); i++) sigdelset(&all, own[i]);
    return all;
}

/* The guard's life; the forwarded signals are blocked. */
static _Noreturn void guard(pid_t rank, int from_rank)
{
    const sigset_t all = forwarded();
    int status, signal;
    while (waitpid(rank, &status, WNOHANG) == 0) {
        siginfo_t info;
        signal = sigwaitinfo(&all, &info);
        if (signal > 0 && signal != SIGCHLD) kill(rank, signal);
    }
    fracas_trouble heard[2] = {{0}}; /* trouble, PASSED, both or none */
    const ssize_t bytes = read(from_rank, heard, sizeof heard);
    const size_t count = bytes > 0 ? (size_t)bytes / sizeof *heard : 0;
    if (!WIFEXITED(status) || (count > 0 && heard[count - 1].code == PASSED)) end_as(status);
    if (count > 0) {
        fprintf(stderr, "fracas: %s\n", heard[0].text);
        _exit(heard[0].code);
    }
    fputs("fracas: MPI does not start, see above: it starts once in each process of "
          "mpirun; " FRACAS_OTHER_JOB "\n",
          stderr);
    _exit(FRACAS_ENVIRONMENT); /* ending with 0, it would leave the others waiting */
}

fracas_err fracas_guard_begin(void)
{
    int fd[2];
    const sigset_t all = forwarded();
    sigset_t before;
    const pid_t guard_pid = getpid();
    if (pipe2(fd, O_CLOEXEC | O_NONBLOCK)) return fracas_fail_system(errno, "no pipe to the rank");
    signal(SIGCHLD, SIG_DFL); /* ignored, it would leave no status */
    sigprocmask(SIG_SETMASK, &all, &before);
    const pid_t rank = fork();
    const int error = errno;
    if (rank > 0) {
        close(fd[1]);
        guard(rank, fd[0]);
    }
    sigprocmask(SIG_SETMASK, &before, NULL);
    close(fd[0]);
    if (rank < 0) {
        close(fd[1]);
        return fracas_fail_system(error, "cannot start the rank");
    }
    setpgid(0, 0); /* a launcher sends signals to the group or to the guard: each comes once */
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != guard_pid) _exit(FRACAS_ENVIRONMENT);
    to_guard = fd[1];
    return FRACAS_OK;
}

static void tell(const fracas_trouble *trouble)
{
    const ssize_t written = to_guard < 0 ? 0 : write(to_guard, trouble, sizeof *trouble);
    (void)written; /* a pipe has room for both */
}

void fracas_guard_tell(const fracas_trouble *trouble)
{
    if (trouble->code) tell(trouble);
}

void fracas_guard_pass(void)
{
    tell(&(fracas_trouble){.code = PASSED});
    if (to_guard >= 0) close(to_guard);
    to_guard = -1;
}
