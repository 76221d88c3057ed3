/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/worker/fault.h"

#include "campaigns/scheduler/lease/scheduler.h"

#include <fcntl.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* In large blocks, each of which points to the one before: a sanitizer needs some memory to tell
 * that there is none. */
static fracas_err exhaust_memory(void)
{
    enum { BLOCK = 64 << 20, BLOCKS = 16 };
    void **last = NULL;
    int count = 0;
    for (void **block; count < BLOCKS && (block = malloc(BLOCK)); count++) {
        *block = last;
        last = block;
    }
    while (last) {
        void **block = last;
        last = *block;
        free(block);
    }
    return count == BLOCKS ? FRACAS_OK : fracas_no_memory("what a test asked for");
}

static void crash(void)
{
    signal(SIGSEGV, SIG_DFL); /* a sanitizer would report it and exit instead */
    raise(SIGSEGV);
}

static fracas_err happen(const char *what)
{
    if (!strcmp(what, "crash")) {
        crash();
    } else if (!strcmp(what, "abort")) {
        fputs("a test asked for this abort\n", stderr);
        abort();
    } else if (!strcmp(what, "exit")) {
        _exit(0);
    } else if (!strcmp(what, "hang")) {
        for (;;) pause();
    } else if (!strcmp(what, "memory")) {
        return exhaust_memory();
    } else if (!strcmp(what, "model")) {
        return FRACAS_OK;
    }
    return fracas_fail(
        FRACAS_BUG,
        "FRACAS_TEST_FAULT asks for `%s`; it must be crash, abort, exit, hang, memory or model",
        what);
}

/* True unless it has happened already, and may happen only once. */
static bool is_due(const char *file)
{
    if (!*file) return true;
    const int fd = open(file, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (fd < 0) return false;
    close(fd);
    return true;
}

fracas_err fracas_fault_if_asked(uint64_t point, const int64_t *replica, size_t count)
{
    const char *asked = getenv("FRACAS_TEST_FAULT");
    char what[16], file[1024] = "";
    unsigned long long its_point;
    long long its_replica;
    if (!asked) return FRACAS_OK;
    if (sscanf(asked, "%15[a-z]:%llu:%lld:%1023s", what, &its_point, &its_replica, file) < 3)
        return fracas_fail(
            FRACAS_BUG,
            "FRACAS_TEST_FAULT is `%s`; it must be WHAT:POINT:REPLICA or WHAT:POINT:REPLICA:FILE",
            asked);
    for (size_t i = 0; i < count; i++)
        if (point == its_point && replica[i] == its_replica && is_due(file)) return happen(what);
    return FRACAS_OK;
}

void fracas_fault_of_model(uint64_t point)
{
    const char *asked = getenv("FRACAS_TEST_FAULT");
    unsigned long long its_point;
    if (asked && sscanf(asked, "model:%llu:", &its_point) == 1 && point == its_point) crash();
}

/* One write, so that lines of several processes do not mix. */
void fracas_log_if_asked(uint64_t point, const int64_t *replica, size_t count)
{
    const char *path = getenv("FRACAS_TEST_LOG");
    int fd = path ? open(path, O_WRONLY | O_APPEND | O_CLOEXEC) : -1;
    if (fd < 0) return;
    char line[64 + 24 * FRACAS_BATCH_MAX];
    int at = sprintf(line, "%ld %ld %llu", (long)getpid(), (long)getppid(),
                     (unsigned long long)point);
    for (size_t i = 0; i < count && i < FRACAS_BATCH_MAX; i++)
        at += sprintf(line + at, " %lld", (long long)replica[i]);
    line[at++] = '\n';
    if (write(fd, line, (size_t)at) != at) abort(); /* a test that counts must not miss one */
    close(fd);
}
