/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/worker/child.h"

#include "campaigns/scheduler/types/clock.h"
#include "campaigns/scheduler/types/process.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

enum { ERRORS_MAX = 4096 /* bytes kept of a child's standard error */ };

/* ---- in the child ---- */

static fracas_err send_all(int fd, fracas_packet **record, size_t count)
{
    fracas_err err = FRACAS_OK;
    for (size_t i = 0; i < count; i++) {
        if (!err) err = fracas_packet_write(fd, record[i]);
        free(record[i]);
    }
    return err;
}

static fracas_err compute(const fracas_computation *computation, fracas_models *models, int fd)
{
    fracas_computation own = *computation;
    TRY(fracas_models_get(models, &own));
    for (size_t from = 0, count; from < own.lease->count; from += count) {
        fracas_packet *record[FRACAS_LANES_MAX];
        TRY(fracas_compute_batch(&own, from, record, &count));
        TRY(send_all(fd, record, count));
    }
    return FRACAS_OK;
}

bool fracas_child_live(const fracas_computation *computation, fracas_models *models, int fd)
{
    fracas_err err = compute(computation, models, fd);
    fracas_trouble fault;
    if (err) fracas_trouble_take(err, &fault);
    return !err || !fracas_packet_send(fd, FRACAS_PACKET_FAULT, &fault, sizeof fault);
}

/* ---- in the server ---- */

/* A memory file of fixed size: endless output fills no more. */
static int create_errors(void)
{
    const int fd = memfd_create("fracas-errors", MFD_CLOEXEC | MFD_ALLOW_SEALING);
    if (fd < 0) return -1;
    if (!ftruncate(fd, ERRORS_MAX) && !fcntl(fd, F_ADD_SEALS, F_SEAL_GROW | F_SEAL_SHRINK))
        return fd;
    close(fd);
    return -1;
}

fracas_err fracas_child_start(fracas_child *child, const fracas_computation *computation,
                              fracas_models *models, int server_fd)
{
    const fracas_lease *lease = computation->lease;
    fracas_packet **record = calloc(lease->count, sizeof(fracas_packet *));
    int fd[2];
    if (!record) return fracas_no_memory("the records of a lease");
    if (pipe2(fd, O_CLOEXEC)) {
        free(record);
        return fracas_fail_system(errno, "no pipe for a lease");
    }
    const int errors = create_errors();
    pid_t pid;
    fracas_err err = fracas_process_fork("fracas-lease", FRACAS_OOM_CHILD, "a lease", &pid);
    if (pid == 0) {
        close(fd[0]);
        close(server_fd);
        if (errors >= 0) dup2(errors, STDERR_FILENO);
        _exit(fracas_child_live(computation, models, fd[1]) ? 0 : FRACAS_ENVIRONMENT);
    }
    close(fd[1]);
    const double now = fracas_now();
    *child = (fracas_child){.pid = pid > 0 ? pid : 0,
                            .fd = fd[0],
                            .errors = errors,
                            .width = fracas_run_width(computation->options),
                            .began = now,
                            .deadline = lease->limit > 0 ? now + lease->limit : INFINITY,
                            .record = record};
    if (err) fracas_child_clear(child);
    else memcpy(&child->lease, lease, fracas_lease_bytes(lease));
    return err;
}

/* Takes the complete messages off the front of the bytes. A wrong message ends the child. */
static fracas_err cut(fracas_child *child)
{
    size_t at = 0;
    fracas_packet head;
    while (child->size - at >= sizeof head) {
        memcpy(&head, child->bytes + at, sizeof head);
        const unsigned char *body = child->bytes + at + sizeof head;
        if (child->size - at < fracas_packet_bytes(&head)) break;
        if (head.kind == FRACAS_PACKET_FAULT && head.size == sizeof(fracas_trouble)) {
            memcpy(child->fault, body + offsetof(fracas_trouble, text), sizeof child->fault);
        } else if (head.kind == FRACAS_PACKET_RECORD && child->count < child->lease.count) {
            TRY(fracas_packet_create(FRACAS_PACKET_RECORD, body, head.size,
                                     &child->record[child->count]));
            child->count++;
        } else {
            kill(child->pid, SIGKILL);
            snprintf(child->fault, sizeof child->fault, "its process sent a message of kind %u",
                     head.kind);
        }
        at += fracas_packet_bytes(&head);
    }
    child->size -= at;
    memmove(child->bytes, child->bytes + at, child->size);
    return FRACAS_OK;
}

fracas_err fracas_child_receive(fracas_child *child, bool *ended)
{
    *ended = false;
    if (child->capacity - child->size < 65536) { /* as much as a pipe holds */
        size_t capacity = 2 * child->capacity + 65536;
        unsigned char *bytes = realloc(child->bytes, capacity);
        if (!bytes) return fracas_no_memory("the records of a lease");
        child->bytes = bytes;
        child->capacity = capacity;
    }
    ssize_t n = read(child->fd, child->bytes + child->size, child->capacity - child->size);
    if (n < 0 && errno != EINTR)
        return fracas_fail(FRACAS_ENVIRONMENT, "cannot read from the process of a lease: %s",
                           strerror(errno));
    *ended = n == 0;
    if (n > 0) child->size += (size_t)n;
    return cut(child);
}

void fracas_child_expire(fracas_child *child)
{
    child->late = true;
    child->deadline = INFINITY;
    kill(child->pid, SIGKILL);
}

/* Reaps the process; `reason` is its end unless it ended well. */
static fracas_err reap(fracas_child *child, char *reason, size_t size)
{
    int status = 0;
    while (waitpid(child->pid, &status, 0) < 0)
        if (errno != EINTR)
            return fracas_fail(FRACAS_BUG, "cannot wait for a lease: %s", strerror(errno));
    child->pid = 0;
    if (WIFEXITED(status) && !WEXITSTATUS(status)) return FRACAS_OK;
    if (child->late && WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL) {
        snprintf(reason, size,
                 "its process was killed after the %g s that a lease may take (--lease-limit)",
                 child->lease.limit);
    } else {
        const int used = snprintf(reason, size, "its process ");
        fracas_process_end_text(status, reason + used, size - (size_t)used);
    }
    return FRACAS_OK;
}

/* Appends the child's standard error, on one line. */
static void quote(const fracas_child *child, char *reason, size_t size)
{
    char text[ERRORS_MAX + 1];
    const ssize_t n = child->errors < 0 ? 0 : pread(child->errors, text, ERRORS_MAX, 0);
    text[n > 0 ? n : 0] = '\0';
    for (char *c = text; *c; c++)
        if (*c < ' ' || *c > '~') *c = ' ';
    for (size_t end = strlen(text); end && text[end - 1] == ' ';) text[--end] = '\0';
    if (!*text) return;
    const size_t used = strlen(reason);
    snprintf(reason + used, size - used, "; it said: %s", text);
}

/* Completes the failure of a lease with an early end. */
static void explain(fracas_child *child, fracas_lease_failure *failure)
{
    const size_t wanted = (size_t)child->lease.count;
    if (child->count == wanted) free(child->record[--child->count]); /* doubtful: it ended badly */
    const size_t end = (child->count / child->width + 1) * child->width; /* end of the batch */
    failure->kept = child->count;
    failure->count = (end < wanted ? end : wanted) - child->count;
    if (child->fault[0]) memcpy(failure->reason, child->fault, sizeof failure->reason);
    if (!failure->reason[0])
        snprintf(failure->reason, sizeof failure->reason,
                 "its process ended after %zu of %zu records", child->count, wanted);
    quote(child, failure->reason, sizeof failure->reason);
}

fracas_err fracas_child_collect(fracas_child *child, bool *good, fracas_lease_failure *failure)
{
    memset(failure, 0, sizeof *failure);
    failure->lease = child->lease.id;
    TRY(reap(child, failure->reason, sizeof failure->reason));
    *good = child->count == child->lease.count && !failure->reason[0] && !child->fault[0];
    if (!*good) explain(child, failure);
    return FRACAS_OK;
}

void fracas_child_clear(fracas_child *child)
{
    if (child->pid) {
        kill(child->pid, SIGKILL);
        while (waitpid(child->pid, NULL, 0) < 0 && errno == EINTR)
            ;
    }
    if (child->fd > 0) close(child->fd);
    if (child->errors > 0) close(child->errors);
    for (size_t i = 0; child->record && i < child->count; i++) free(child->record[i]);
    free(child->record);
    free(child->bytes);
    *child = (fracas_child){0};
}
