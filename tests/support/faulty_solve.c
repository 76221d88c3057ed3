/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Linked into the program build/<preset>/faulty/fracas (ld --wrap): faults of realizations on
 * request, and a log of all batches.
 *
 * FRACAS_TEST_FAULT=KIND:POINT:REPLICA[:FILE] strikes the process that is about to compute this
 * realization (points counted from 0 in plan order):
 *   crash   SIGSEGV
 *   abort   abort(), after a sentence on standard error
 *   exit    the process ends with status 0, as a library might do it
 *   hang    it never returns
 *   memory  it allocates 1 GiB, and fails with FRACAS_ENVIRONMENT where this is impossible
 *   model   SIGSEGV of the process that is about to build the model of the point
 * With FILE, at most 1023 bytes, the fault strikes once: the process that creates this file.
 *
 * With FRACAS_TEST_LOG=FILE, where FILE exists, a line is appended for each batch that begins: pid,
 * pid of the parent, point, replicas.
 *
 * With FRACAS_TEST_PAUSE=SECONDS each batch begins so much later, for those who watch a run.
 *
 * With FRACAS_TEST_GATE=FILE a batch waits before it begins, and after each of its checkpoints. It
 * appends a byte to FILE.arrived, n of all, and goes on when FILE has n bytes or more, or is not
 * there: hold of campaigns.sh. */
#include "campaigns/scheduler/worker/models.h"
#include "campaigns/scheduler/worker/solve.h"
#include "campaigns/store/checkpoint.h"
#include "tests/support/test.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

fracas_err __real_fracas_solve(const fracas_computation *computation, const int64_t *replica,
                               size_t count, fracas_record *record);
fracas_err __wrap_fracas_solve(const fracas_computation *computation, const int64_t *replica,
                               size_t count, fracas_record *record);
fracas_err __real_fracas_checkpoint_finish(fracas_checkpoint *checkpoint);
fracas_err __wrap_fracas_checkpoint_finish(fracas_checkpoint *checkpoint);
fracas_err __real_fracas_models_get(fracas_models *models, fracas_computation *computation);
fracas_err __wrap_fracas_models_get(fracas_models *models, fracas_computation *computation);

static fracas_err exhaust_memory(void)
{
    void *volatile block = malloc((size_t)1 << 30);
    if (!block) return fracas_no_memory("what a test asked for");
    free(block);
    return FRACAS_OK;
}

static void crash(void)
{
    signal(SIGSEGV, SIG_DFL); /* a sanitizer would report it and exit instead */
    raise(SIGSEGV);
}

static fracas_err strike(const char *kind)
{
    if (!strcmp(kind, "crash")) {
        crash();
    } else if (!strcmp(kind, "abort")) {
        fputs("a test asked for this abort\n", stderr);
        abort();
    } else if (!strcmp(kind, "exit")) {
        _exit(0);
    } else if (!strcmp(kind, "hang")) {
        for (;;) pause();
    } else if (!strcmp(kind, "memory")) {
        return exhaust_memory();
    } else if (!strcmp(kind, "model")) {
        return FRACAS_OK;
    }
    return fracas_fail(
        FRACAS_BUG,
        "FRACAS_TEST_FAULT asks for `%s`; it must be crash, abort, exit, hang, memory or model",
        kind);
}

/* True unless the fault may strike only once and has. */
static bool is_due(const char *file)
{
    if (!*file) return true;
    const int fd = open(file, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (fd < 0) return false;
    close(fd);
    return true;
}

static fracas_err strike_if_asked(uint64_t point, const int64_t *replica, size_t count)
{
    const char *asked = getenv("FRACAS_TEST_FAULT");
    char kind[16], file[1024] = "";
    unsigned long long its_point;
    long long its_replica;
    if (!asked) return FRACAS_OK;
    if (sscanf(asked, "%15[a-z]:%llu:%lld:%1023s", kind, &its_point, &its_replica, file) < 3)
        return fracas_fail(
            FRACAS_BUG,
            "FRACAS_TEST_FAULT is `%s`; it must be KIND:POINT:REPLICA or KIND:POINT:REPLICA:FILE",
            asked);
    for (size_t i = 0; i < count; i++)
        if (point == its_point && replica[i] == its_replica && is_due(file)) return strike(kind);
    return FRACAS_OK;
}

/* One write, so that lines of several processes do not mix. */
static void log_batch(uint64_t point, const int64_t *replica, size_t count)
{
    const char *path = getenv("FRACAS_TEST_LOG");
    int fd = path ? open(path, O_WRONLY | O_APPEND | O_CLOEXEC) : -1;
    if (fd < 0) return;
    char line[64 + 24 * FRACAS_LANES_MAX];
    int at = sprintf(line, "%ld %ld %llu", (long)getpid(), (long)getppid(),
                     (unsigned long long)point);
    for (size_t i = 0; i < count && i < FRACAS_LANES_MAX; i++)
        at += sprintf(line + at, " %lld", (long long)replica[i]);
    line[at++] = '\n';
    if (write(fd, line, (size_t)at) != at) abort(); /* a test that counts must not miss one */
    close(fd);
}

static void pause_if_asked(void)
{
    const char *asked = getenv("FRACAS_TEST_PAUSE");
    if (asked) usleep((useconds_t)(1e6 * atof(asked)));
}

/* The place of this batch in the row before the gate, from 1. */
static off_t arrive(const char *gate)
{
    char row[1024];
    if (snprintf(row, sizeof row, "%s.arrived", gate) >= (int)sizeof row) abort();
    const int fd = open(row, O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0666);
    if (fd < 0 || write(fd, "\n", 1) != 1) abort(); /* a test that counts must not miss one */
    const off_t place = lseek(fd, 0, SEEK_CUR);     /* behind its own byte */
    close(fd);
    return place;
}

static void wait_at_gate(void)
{
    const char *gate = getenv("FRACAS_TEST_GATE");
    struct stat of;
    if (!gate || stat(gate, &of)) return;
    const off_t place = arrive(gate);
    while (!stat(gate, &of) && of.st_size < place)
        nanosleep(&(struct timespec){.tv_nsec = 5000000}, NULL);
}

fracas_err __wrap_fracas_solve(const fracas_computation *computation, const int64_t *replica,
                               size_t count, fracas_record *record)
{
    pause_if_asked();
    wait_at_gate();
    log_batch(computation->lease->point, replica, count);
    TRY(strike_if_asked(computation->lease->point, replica, count));
    return __real_fracas_solve(computation, replica, count, record);
}

fracas_err __wrap_fracas_checkpoint_finish(fracas_checkpoint *checkpoint)
{
    fracas_err err = __real_fracas_checkpoint_finish(checkpoint);
    wait_at_gate();
    return err;
}

fracas_err __wrap_fracas_models_get(fracas_models *models, fracas_computation *computation)
{
    const char *asked = getenv("FRACAS_TEST_FAULT");
    unsigned long long its_point;
    if (asked && sscanf(asked, "model:%llu:", &its_point) == 1 &&
        computation->lease->point == its_point)
        crash();
    return __real_fracas_models_get(models, computation);
}
