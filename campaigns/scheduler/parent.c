#include "campaigns/scheduler/parent.h"

#include "campaigns/scheduler/clock.h"
#include "campaigns/scheduler/mpirun.h"
#include "campaigns/scheduler/progress.h"
#include "campaigns/scheduler/voice.h"

#include <errno.h>
#include <poll.h>
#include <sched.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

/* Times that SIGINT, SIGTERM or SIGHUP came. */
static volatile sig_atomic_t asked;

static void count_signal(int signal_number)
{
    (void)signal_number;
    asked++;
}

static const int caught[] = {SIGINT, SIGTERM, SIGHUP};
enum { NCAUGHT = sizeof caught / sizeof *caught, HANGUP = 2 /* in caught */, NOISE = 16384 };

typedef struct {
    fracas_mpirun mpirun;
    fracas_progress progress;
    fracas_verdict verdict;
    bool speaks;  /* rank 0 has said something: every rank can be signalled */
    int obeyed;   /* signals acted upon: 1 draining, 2 killed */
    double asked; /* when the first signal was noticed, s */
    double began; /* when mpirun was started, s */
    bool warned;  /* of its silence */
    char line[4096];
    size_t nline;
    char noise[NOISE]; /* the first of stderr and of lines that are not rank 0's */
    size_t nnoise;
} parent;

static void keep_noise(parent *p, const char *text, size_t size)
{
    size_t room = sizeof p->noise - 1 - p->nnoise;
    if (size > room) size = room;
    memcpy(p->noise + p->nnoise, text, size);
    p->nnoise += size;
}

/* Reads what is there; false at the end of the stream. */
static bool read_some(int fd, char *buffer, size_t size, size_t *got)
{
    ssize_t n = read(fd, buffer, size);
    *got = n > 0 ? (size_t)n : 0;
    return n > 0 || (n < 0 && errno == EINTR);
}

static bool read_lines(parent *p)
{
    char buffer[4096];
    size_t n;
    bool more = read_some(p->mpirun.out, buffer, sizeof buffer, &n);
    for (size_t i = 0; i < n; i++) {
        if (buffer[i] != '\n') {
            if (p->nline < sizeof p->line - 1) p->line[p->nline++] = buffer[i];
            continue;
        }
        p->line[p->nline] = '\0';
        if (fracas_voice_hear(p->line, &p->progress, &p->verdict)) {
            p->speaks = true;
        } else {
            keep_noise(p, p->line, p->nline);
            keep_noise(p, "\n", 1);
        }
        p->nline = 0;
    }
    return more;
}

static bool read_errors(parent *p)
{
    char buffer[4096];
    size_t n;
    bool more = read_some(p->mpirun.errors, buffer, sizeof buffer, &n);
    keep_noise(p, buffer, n);
    return more;
}

/* MPI that does not come up within these times [s]: with a signal waiting it is killed, else something is said. */
enum { PATIENCE_ASKED = 5, PATIENCE = 60 };

static void mind_silence(parent *p)
{
    if (p->speaks || p->obeyed == 2) return;
    if (asked && p->asked == 0) p->asked = fracas_now();
    if (asked && fracas_now() - p->asked > PATIENCE_ASKED) {
        kill(-p->mpirun.pid, SIGKILL); /* nothing has begun */
        p->obeyed = 2;
    } else if (!p->warned && fracas_now() - p->began > PATIENCE) {
        fracas_progress_say(&p->progress, "MPI has not started for a minute; check the limits on open files and file sizes "
                            "(ulimit -n, ulimit -f), or stop with Ctrl-C");
        p->warned = true;
    }
}

/* The first signal drains, as soon as the ranks can take it; the next one kills. */
static void obey_signals(parent *p)
{
    if (asked >= 1 && p->obeyed == 0 && p->speaks) {
        fracas_progress_say(&p->progress, "draining: leases that run are finished and kept (again: stop at once)");
        kill(p->mpirun.pid, SIGUSR1); /* mpirun hands it on to the ranks */
        p->obeyed = 1;
    }
    if (asked >= 2 && p->obeyed < 2) {
        kill(-p->mpirun.pid, SIGKILL); /* ranks, servers and children die with it */
        p->obeyed = 2;
    }
}

/* Until both streams of mpirun have ended. */
static void listen(parent *p)
{
    struct pollfd from[2] = {{.fd = p->mpirun.out, .events = POLLIN}, {.fd = p->mpirun.errors, .events = POLLIN}};
    while (from[0].fd >= 0 || from[1].fd >= 0) {
        obey_signals(p);
        mind_silence(p);
        /* A signal that comes just before poll waits 0.2 s at most. */
        if (poll(from, 2, 200) <= 0) continue;
        if (from[0].revents && !read_lines(p)) from[0].fd = -1;
        if (from[1].revents && !read_errors(p)) from[1].fd = -1;
    }
}

/* How the run ended when rank 0 did not say so. */
static fracas_err explain(const parent *p, int status)
{
    if (asked)
        return fracas_fail(FRACAS_INTERRUPTED, "stopped at once: what was done is kept; the same command goes on from "
                           "there");
    if (WIFEXITED(status) && WEXITSTATUS(status) == FRACAS_MPIRUN_MISSING && !p->speaks)
        return fracas_fail(FRACAS_ENVIRONMENT, "there is no mpirun; install Open MPI (Debian: openmpi-bin)");
    fprintf(stderr, "%s", p->noise);
    if (WIFSIGNALED(status))
        return fracas_fail(FRACAS_ENVIRONMENT, "mpirun died of signal %d (%s); what was done is kept; the same command "
                           "goes on from there", WTERMSIG(status), strsignal(WTERMSIG(status)));
    return fracas_fail(FRACAS_ENVIRONMENT, "mpirun ended with status %d before the run was over (above: what it said); "
                       "what was done is kept; the same command goes on from there", WEXITSTATUS(status));
}

static fracas_err choose_jobs(int wanted, int *jobs)
{
    enum { MOST_A_CORE = 32 };
    cpu_set_t set;
    const int cores = sched_getaffinity(0, sizeof set, &set) ? 1 : CPU_COUNT(&set);
    *jobs = wanted ? wanted : cores;
    if (*jobs <= MOST_A_CORE * cores) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE, "--jobs %d: this machine gives the run %d cores; %d processes are the most, one a core "
                       "is the best", *jobs, cores, MOST_A_CORE * cores);
}

/* Waits until mpirun and whatever it left behind have ended, so that the study is free when this process ends: ranks,
 * servers and children die with their parents and come to this process, their reaper. Returns mpirun's status. */
static int wait_for_all(pid_t mpirun)
{
    int status = 0, one;
    for (;;) {
        pid_t pid = waitpid(-1, &one, 0);
        if (pid == mpirun) status = one;
        if (pid < 0 && errno != EINTR) return status;
    }
}

/* mpirun from start to end. */
static fracas_err run(parent *p, const fracas_run_options *options, int argc, char **argv, bool *ran)
{
    fracas_progress_init(&p->progress, stderr);
    prctl(PR_SET_CHILD_SUBREAPER, 1);
    p->began = fracas_now();
    int jobs;
    TRY(choose_jobs(options->jobs, &jobs));
    TRY(fracas_mpirun_start(jobs, argc, argv, &p->mpirun));
    listen(p);
    close(p->mpirun.out);
    close(p->mpirun.errors);
    int status = wait_for_all(p->mpirun.pid);
    fracas_progress_end(&p->progress);
    if (!p->verdict.ended) return explain(p, status);
    *ran = p->verdict.ran;
    return p->verdict.err ? fracas_fail(p->verdict.err, "%s", p->verdict.text) : FRACAS_OK;
}

fracas_err fracas_parent_run(const fracas_run_options *options, int argc, char **argv, bool *ran)
{
    parent *p = calloc(1, sizeof *p);
    if (!p) return fracas_no_memory("the run");
    struct sigaction count = {.sa_handler = count_signal}, before[NCAUGHT], pipe_before;
    struct sigaction ignore = {.sa_handler = SIG_IGN}; /* a run goes on when nobody reads its progress */
    sigemptyset(&count.sa_mask);
    sigemptyset(&ignore.sa_mask);
    for (size_t i = 0; i < NCAUGHT; i++) sigaction(caught[i], &count, &before[i]);
    if (before[HANGUP].sa_handler == SIG_IGN) /* nohup */
        sigaction(SIGHUP, &ignore, NULL);
    sigaction(SIGPIPE, &ignore, &pipe_before);
    fracas_err err = run(p, options, argc, argv, ran);
    for (size_t i = 0; i < NCAUGHT; i++) sigaction(caught[i], &before[i], NULL);
    sigaction(SIGPIPE, &pipe_before, NULL);
    free(p);
    return err;
}
