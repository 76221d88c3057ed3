/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Simulated farms, each from its seed: docs/decisions/simulator.md.
 *
 *   simulate FIRST COUNT [--workers N] [--jobs N]   farms of seeds FIRST to FIRST + COUNT - 1
 *   simulate SEED --trace [--workers N] [--faults N]   all that happens in one, with N faults at
 *                                                      most
 *
 * Prints the trace of the first farm in which something did not hold, with the fewest faults that
 * show it, and ends with 1. */
#include "tests/simulator/farm.h"
#include "tests/simulator/vfs.h"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { MOST_JOBS = 64, MANY = 100 /* workers: a campaign of its own */ };

static struct {
    uint64_t first, count;
    int workers, jobs;
    int64_t faults; /* at most; -1: as the seed says */
    bool trace;
} asked = {.first = 1, .count = 100, .jobs = 1, .faults = -1};

static void read_arguments(int argc, char **argv)
{
    for (int i = 1, plain = 0; i < argc; i++) {
        const bool more = i + 1 < argc;
        if (!strcmp(argv[i], "--trace")) asked.trace = true;
        else if (!strcmp(argv[i], "--workers") && more) asked.workers = atoi(argv[++i]);
        else if (!strcmp(argv[i], "--jobs") && more) asked.jobs = atoi(argv[++i]);
        else if (!strcmp(argv[i], "--faults") && more) asked.faults = atoll(argv[++i]);
        else if (plain++ == 0) asked.first = strtoull(argv[i], NULL, 10);
        else asked.count = strtoull(argv[i], NULL, 10);
    }
    if (asked.jobs < 1 || asked.jobs > MOST_JOBS) asked.jobs = 1;
}

/* ---- farms in processes of their own, as they leave their memory behind ---- */

typedef enum { SILENT, VERDICT, TRACE } loudness;

static pid_t start(uint64_t seed, int64_t faults, loudness loud)
{
    fflush(stdout);
    const pid_t pid = fork();
    if (pid < 0) exit(70);
    if (pid) return pid;
    const int null = open("/dev/null", O_WRONLY); /* the launcher repeats the words of mpirun */
    if (null >= 0) dup2(null, STDERR_FILENO);
    if (null >= 0 && loud == SILENT) dup2(null, STDOUT_FILENO);
    const uint64_t hash = farm_run(seed, asked.workers, faults, loud == TRACE);
    if (loud == TRACE)
        fprintf(stdout, "farm %llu: %016llx\n", (unsigned long long)seed, (unsigned long long)hash);
    fflush(stdout);
    _exit(0);
}

static bool holds(uint64_t seed, int64_t faults, loudness loud)
{
    int status;
    const pid_t pid = start(seed, faults, loud);
    return waitpid(pid, &status, 0) == pid && status == 0;
}

/* The seed of the first failure, UINT64_MAX without any. */
static uint64_t run_many(void)
{
    struct {
        pid_t pid;
        uint64_t seed;
    } now[MOST_JOBS];
    uint64_t next = asked.first, failed = UINT64_MAX;
    const uint64_t end = asked.first + asked.count;
    for (int running = 0, status; running || (next < end && failed == UINT64_MAX);) {
        for (; running < asked.jobs && next < end && failed == UINT64_MAX; running++, next++) {
            now[running].pid = start(next, -1, VERDICT);
            now[running].seed = next;
        }
        const pid_t ended = wait(&status);
        int i = 0;
        while (i < running && now[i].pid != ended) i++;
        if (i == running) continue;
        if (status && now[i].seed < failed) failed = now[i].seed;
        now[i] = now[--running];
    }
    return failed;
}

/* ---- study.h5 of an undisturbed farm ---- */

/* Drawn by the seed: the campaign. */
static void compute(uint64_t seed, int workers)
{
    struct {
        size_t kind, bytes;
        uint64_t checksum;
    } found;
    int ends[2], status;
    if (pipe(ends)) exit(70);
    fflush(stdout);
    const pid_t pid = fork();
    if (pid == 0) {
        farm_run(seed, workers, 0, false);
        found.kind = (size_t)(farm.kind - farm_campaign);
        found.bytes = farm.kind->bytes;
        found.checksum = farm.kind->checksum;
        _exit(write(ends[1], &found, sizeof found) != sizeof found);
    }
    close(ends[1]);
    const bool good = read(ends[0], &found, sizeof found) == sizeof found;
    close(ends[0]);
    if (pid < 0 || waitpid(pid, &status, 0) != pid || status || !good) {
        fprintf(stdout, "the undisturbed farm of seed %llu fails\n", (unsigned long long)seed);
        exit(1);
    }
    farm_campaign[found.kind].bytes = found.bytes;
    farm_campaign[found.kind].checksum = found.checksum;
}

/* Seeds are tried until each campaign has been drawn; the last one is that of many workers. */
static void compute_all(void)
{
    size_t known = 0;
    for (uint64_t seed = 1; known < MOST_CAMPAIGNS; seed++) {
        compute(seed, known + 1 == MOST_CAMPAIGNS ? MANY : 0);
        known = 0;
        for (size_t k = 0; k < MOST_CAMPAIGNS; k++) known += farm_campaign[k].bytes > 0;
    }
}

static int report(uint64_t failed)
{
    const unsigned long long seed = failed;
    int64_t faults = 0;
    while (holds(failed, faults, SILENT) && faults < 1000) faults++;
    fprintf(stdout, "seed %llu fails, with %lld faults; again: simulate %llu --trace", seed,
            (long long)faults, seed);
    if (asked.workers) fprintf(stdout, " --workers %d", asked.workers);
    fprintf(stdout, " --faults %lld\n", (long long)faults);
    holds(failed, faults, TRACE);
    return 1;
}

int main(int argc, char **argv)
{
    struct timespec began, ended;
    read_arguments(argc, argv);
    clock_gettime(CLOCK_MONOTONIC, &began);
    vfs_register();
    farm_prepare();
    compute_all();
    if (asked.trace) return !holds(asked.first, asked.faults, TRACE);
    const uint64_t failed = run_many();
    if (failed != UINT64_MAX) return report(failed);
    clock_gettime(CLOCK_MONOTONIC, &ended);
    fprintf(stdout, "%llu farms from seed %llu on: all held, %lld s\n",
            (unsigned long long)asked.count, (unsigned long long)asked.first,
            (long long)(ended.tv_sec - began.tv_sec));
    return 0;
}
