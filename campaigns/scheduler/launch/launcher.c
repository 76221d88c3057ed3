/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/launch/launcher.h"

#include "base/text.h"
#include "campaigns/scheduler/launch/allocation.h"
#include "campaigns/scheduler/launch/mpirun.h"
#include "campaigns/scheduler/launch/reap.h"
#include "campaigns/scheduler/launch/scratch.h"
#include "campaigns/scheduler/launch/signals.h"
#include "campaigns/scheduler/status/channel.h"
#include "campaigns/scheduler/types/clock.h"

#include <errno.h>
#include <math.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

/* Seconds until a start counts as hung: before a message of rank 0, once a signal asks to end;
 * then, before a warning; after the last message of rank 0 or the end of the starter. */
enum { PATIENCE_ASKED = 5, PATIENCE = 60, PATIENCE_END = 10 };

enum { NOISE = 16384, MOST_IN_VAIN = 3 };

/* One start of the ranks. */
typedef struct {
    fracas_starter starter;
    fracas_scratch scratch;
    fracas_ending ending;
    bool speaks;          /* rank 0 has sent a message: every rank can be signalled */
    bool drained, killed; /* by this process */
    bool gone;            /* the starter was reaped: its number may be another process's */
    bool warned;          /* about its silence */
    bool gained;          /* realizations became durable */
    double began;
    double ended; /* time of the ending, or of the starter's end; 0: not yet */
    char line[4096];
    size_t nline;
    char noise[NOISE]; /* the last of stderr and of foreign lines on stdout */
    size_t nnoise;
} launch;

typedef struct {
    const fracas_starter_kind *kind;
    launch now;
    fracas_reap reap;
    fracas_progress progress;
    double asked;             /* time of the first signal to end, or of drain_at; 0: not yet */
    double drain_at, kill_at; /* by the walltime; INFINITY: there is none */
    int64_t durable;          /* maximum of realizations done or failed for good; -1: unknown */
    int starts, in_vain;      /* in_vain: starts in a row without gain */
} launcher;

/* Keeps the last of it, a part of NOISE at a time: a starter prints the reason at its end. */
static void keep_noise(launch *now, const char *text, size_t size)
{
    const size_t room = sizeof now->noise - 1;
    if (now->nnoise + size > room) {
        const size_t lost = now->nnoise + size - room;
        memmove(now->noise, now->noise + lost, now->nnoise - lost);
        now->nnoise -= lost;
    }
    memcpy(now->noise + now->nnoise, text, size);
    now->nnoise += size;
    now->noise[now->nnoise] = '\0';
}

/* Reads the available bytes; false at the end of the stream. */
static bool read_some(int fd, char *buffer, size_t size, size_t *got)
{
    ssize_t n = read(fd, buffer, size);
    *got = n > 0 ? (size_t)n : 0;
    return n > 0 || (n < 0 && errno == EINTR);
}

static void receive(launcher *p, char *line)
{
    launch *now = &p->now;
    if (!fracas_channel_receive(line, &p->progress, &now->ending)) {
        keep_noise(now, line, strlen(line));
        keep_noise(now, "\n", 1);
        return;
    }
    if (!now->speaks) fracas_scratch_remove(&now->scratch);
    now->speaks = true;
    if (now->ending.ended && now->ended == 0) now->ended = fracas_now();
    const int64_t durable = p->progress.last.done + p->progress.last.failed;
    if (!p->progress.any || durable <= p->durable) return;
    now->gained |= p->durable >= 0;
    p->durable = durable;
}

static bool read_lines(launcher *p)
{
    launch *now = &p->now;
    char buffer[4096];
    size_t n;
    bool more = read_some(now->starter.out, buffer, sizeof buffer, &n);
    for (size_t i = 0; i < n; i++) {
        if (buffer[i] != '\n') {
            if (now->nline < sizeof now->line - 1) now->line[now->nline++] = buffer[i];
            continue;
        }
        now->line[now->nline] = '\0';
        now->nline = 0;
        receive(p, now->line);
    }
    return more;
}

static bool read_errors(launch *now)
{
    char buffer[4096];
    size_t n;
    bool more = read_some(now->starter.errors, buffer, sizeof buffer, &n);
    keep_noise(now, buffer, n);
    return more;
}

/* The run is to end: by a signal or the walltime. */
static bool is_asked(launcher *p)
{
    const double now = fracas_now();
    if (p->asked == 0 && (fracas_signals_ask() || now >= p->drain_at)) p->asked = now;
    return p->asked > 0;
}

/* All processes of the run on this machine die with the starter, others when they lose it. */
static void kill_run(launch *now)
{
    if (now->killed) return;
    if (!now->gone) kill(-now->starter.pid, SIGKILL);
    now->killed = true;
}

/* Drains as soon as the ranks can take the signal; kills at the second signal. */
static void obey(launcher *p)
{
    launch *now = &p->now;
    if (!is_asked(p)) return;
    if (now->speaks && !now->drained && !now->gone) {
        fracas_progress_message(
            &p->progress,
            fracas_signals_ask()
                ? "draining: leases that run are finished and kept (again: stop at once)"
                : "draining: leases that run are finished and kept, as the walltime is nearly "
                  "over");
        kill(now->starter.pid, SIGUSR1); /* which forwards it to the ranks */
        now->drained = true;
    }
    const bool nothing_begun = !now->speaks && fracas_now() - p->asked > PATIENCE_ASKED;
    if (fracas_signals_insist() || fracas_now() >= p->kill_at || nothing_begun) kill_run(now);
}

static void mind_silence(launcher *p)
{
    launch *now = &p->now;
    if (now->ended > 0 && fracas_now() - now->ended > PATIENCE_END) kill_run(now);
    if (now->speaks || now->warned || fracas_now() - now->began <= PATIENCE) return;
    fracas_progress_message(
        &p->progress, "the ranks have not started for a minute; check the limits on open files and "
                      "file sizes (ulimit -n, ulimit -f), or stop with Ctrl-C");
    now->warned = true;
}

/* The starter ended PATIENCE_END ago, while its streams are still open. */
static bool is_overdue(launch *now)
{
    siginfo_t info = {.si_pid = 0};
    if (waitid(P_PID, (id_t)now->starter.pid, &info, WEXITED | WNOHANG | WNOWAIT) ||
        info.si_pid == 0)
        return false;
    if (now->ended == 0) now->ended = fracas_now();
    return fracas_now() - now->ended > PATIENCE_END;
}

/* Reads both streams of the starter to their ends. */
static void read_streams(launcher *p)
{
    launch *now = &p->now;
    struct pollfd from[2] = {{.fd = now->starter.out, .events = POLLIN},
                             {.fd = now->starter.errors, .events = POLLIN}};
    while ((from[0].fd >= 0 || from[1].fd >= 0) && !is_overdue(now)) {
        obey(p);
        mind_silence(p);
        /* A signal just before poll waits at most 0.2 s. */
        if (poll(from, 2, 200) <= 0) continue;
        if (from[0].revents && !read_lines(p)) from[0].fd = -1;
        if (from[1].revents && !read_errors(now)) from[1].fd = -1;
    }
}

/* Reaps the starter and all its descendants, which frees the study. Returns the starter's status.
 */
static int wait_for_all(launcher *p)
{
    launch *now = &p->now;
    int status = -1; /* no process has this one */
    const double began = fracas_now();
    while (fracas_reap_wait(&p->reap, now->starter.pid, &status)) {
        now->gone |= status != -1;
        obey(p);
        if (fracas_now() - began > PATIENCE_END || now->killed) {
            kill_run(now);
            fracas_reap_kill(&p->reap);
        }
        poll(NULL, 0, 10);
    }
    return status == -1 ? 0 : status;
}

/* The ranks from start to end. */
static fracas_err start(launcher *p, const fracas_ranks *ranks, int *status)
{
    p->now = (launch){.scratch = FRACAS_SCRATCH_NONE, .began = fracas_now()};
    p->starts++;
    fracas_err err = p->kind->start(ranks, &p->now.scratch, &p->now.starter);
    if (!err) {
        read_streams(p);
        close(p->now.starter.out);
        close(p->now.starter.errors);
        *status = wait_for_all(p);
    }
    fracas_scratch_remove(&p->now.scratch);
    return err;
}

/* The reason for an early end. */
static void explain(const launcher *p, int status, char *text, size_t size)
{
    const launch *now = &p->now;
    if (now->ending.ended) {
        snprintf(text, size, "%.600s", now->ending.text);
        return;
    }
    if (WIFSIGNALED(status)) {
        snprintf(text, size, "%s died of signal %d (%s)", p->kind->name, WTERMSIG(status),
                 strsignal(WTERMSIG(status)));
        return;
    }
    char reason[512];
    fracas_mpirun_reason(now->noise, reason, sizeof reason);
    if (*reason) snprintf(text, size, "%s", reason);
    else
        snprintf(text, size, "%s ended with status %d before the run was over", p->kind->name,
                 WEXITSTATUS(status));
}

/* The run is over, unless it lost its last worker, or processes of the last start still hold the
 * study on another machine. */
static bool is_over(const launcher *p)
{
    const fracas_ending *ending = &p->now.ending;
    return ending->ended && !ending->again && !(ending->err == FRACAS_IN_USE && p->starts > 1);
}

static fracas_err stopped(const launcher *p)
{
    return fracas_fail(FRACAS_INTERRUPTED,
                       "%s: what was done is kept; the same command goes on from there",
                       p->drain_at <= p->asked ? "the walltime is over" : "stopped at once");
}

/* After an early end: FRACAS_OK to start again. */
static fracas_err go_on(launcher *p, int status)
{
    launch *now = &p->now;
    char reason[700], text[900];
    if (is_asked(p)) return stopped(p);
    if (WIFEXITED(status) && WEXITSTATUS(status) == FRACAS_MPIRUN_MISSING && !now->speaks)
        return fracas_fail(FRACAS_ENVIRONMENT,
                           "there is no mpirun; install Open MPI (Debian: openmpi-bin)");
    if (!now->speaks && fracas_mpirun_hopeless(now->noise, reason, sizeof reason))
        return fracas_fail(FRACAS_ENVIRONMENT, "%s", reason);
    explain(p, status, reason, sizeof reason);
    p->in_vain = now->gained ? 0 : p->in_vain + 1;
    if (p->in_vain == MOST_IN_VAIN) {
        char shown[2 * NOISE];
        fracas_text_show(now->noise, shown, sizeof shown);
        fprintf(stderr, "%s", shown);
        return fracas_fail(
            FRACAS_ENVIRONMENT,
            "%s; the ranks were started %d times, the last %d in vain; what was done "
            "is kept; the same command goes on from there",
            reason, p->starts, MOST_IN_VAIN);
    }
    snprintf(text, sizeof text, "%s; the ranks are started again", reason);
    fracas_progress_message(&p->progress, text);
    setenv(FRACAS_RESTARTED, reason, 1);
    for (const double until = fracas_now() + p->in_vain; fracas_now() < until && !is_asked(p);)
        poll(NULL, 0, 50);
    return is_asked(p) ? stopped(p) : FRACAS_OK;
}

/* The walltime, for this process and, as seconds since 1970, for rank 0. */
static void set_deadline(launcher *p, double walltime, double began)
{
    p->drain_at = p->kill_at = INFINITY;
    unsetenv(FRACAS_DEADLINE);
    unsetenv(FRACAS_RESTARTED);
    if (walltime <= 0) return;
    const double end = began + walltime;
    p->drain_at = end - fmin(5, walltime / 2);
    p->kill_at = end - fmin(1, walltime / 10);
    struct timespec t;
    clock_gettime(CLOCK_REALTIME, &t);
    char text[64];
    snprintf(text, sizeof text, "%.3f",
             (double)t.tv_sec + 1e-9 * (double)t.tv_nsec + (end - fracas_now()));
    setenv(FRACAS_DEADLINE, text, 1);
}

static fracas_err run(launcher *p, const fracas_ranks *ranks, bool *ran)
{
    if (is_asked(p)) return stopped(p);
    do {
        int status;
        TRY(start(p, ranks, &status));
        if (!is_over(p)) TRY(go_on(p, status));
    } while (!is_over(p));
    const fracas_ending *ending = &p->now.ending;
    *ran = ending->ran || p->starts > 1;
    return ending->err ? fracas_fail(ending->err, "%s", ending->text) : FRACAS_OK;
}

fracas_err fracas_launcher_run(const fracas_starter_kind *kind, const fracas_ranks *ranks,
                               double began, bool *ran)
{
    OWNED launcher *p = calloc(1, sizeof *p);
    if (!p) return fracas_no_memory("the run");
    p->kind = kind;
    p->durable = -1;
    fracas_progress_init(&p->progress, stderr);
    p->progress.quiet = ranks->options->quiet;
    fracas_reap_begin(&p->reap);
    set_deadline(p, ranks->options->walltime, began);
    fracas_err err = run(p, ranks, ran);
    fracas_progress_end(&p->progress);
    return err;
}
