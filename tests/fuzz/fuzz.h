/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the fuzz targets share. */
#ifndef FRACAS_TESTS_FUZZ_H
#define FRACAS_TESTS_FUZZ_H

#include "tests/support/test.h"

#include <signal.h>
#include <sys/time.h>
#include <unistd.h>

/* libFuzzer's door: called with one input after another; an abort is a finding. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

#define FUZZ_DEMAND(condition, text) fuzz_demand((condition), __FILE__, __LINE__, (text))

/* The call succeeds. */
#define FUZZ_OK(call) FUZZ_DEMAND((call) == FRACAS_OK, fracas_message())

static inline void fuzz_demand(int holds, const char *file, int line, const char *text)
{
    if (holds) return;
    fprintf(stderr, "%s:%d: %s\n", file, line, text);
    abort();
}

static inline void fuzz_too_long(int signal_number)
{
    static const char text[] = "this input takes too long\n";
    if (write(2, text, sizeof text - 1) < 0) _exit(1);
    abort();
}

/* Five seconds of processor time for each input from here on: other processes do not count, as they
 * do in libFuzzer's own limit. */
static inline void fuzz_limit(void)
{
    static const struct itimerval most = {.it_value = {.tv_sec = 5}};
    signal(SIGPROF, fuzz_too_long);
    FUZZ_DEMAND(setitimer(ITIMER_PROF, &most, NULL) == 0, "a limit of time");
}

static char fuzz_made[64];

static inline void fuzz_remove(void)
{
    char command[100];
    snprintf(command, sizeof command, "rm -rf %s", fuzz_made);
    if (system(command)) fputs("a folder of the fuzzer stays behind\n", stderr);
}

/* A folder of this process, in memory where there is such a place, removed at its end. */
static inline void fuzz_folder(char path[64])
{
    snprintf(path, 64, "%s/fracas-fuzz-XXXXXX",
             access("/dev/shm", W_OK) == 0 ? "/dev/shm" : "/tmp");
    FUZZ_DEMAND(mkdtemp(path) != NULL, "a folder");
    snprintf(fuzz_made, sizeof fuzz_made, "%s", path);
    atexit(fuzz_remove);
}

#endif
