#include "campaigns/scheduler/child.h"

#include "campaigns/plan/point_model.h"
#include "campaigns/scheduler/clock.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

/* ---- in the child ---- */

/* Documented at fracas_child_start. */
static void crash_if_asked(const fracas_lease *lease)
{
    const char *victim = getenv("FRACAS_TEST_CRASH");
    unsigned long long point;
    long long replica;
    if (!victim || sscanf(victim, "%llu:%lld", &point, &replica) != 2 || lease->point != point) return;
    for (size_t i = 0; i < lease->count; i++) {
        if (lease->replica[i] != replica) continue;
        signal(SIGSEGV, SIG_DFL); /* a sanitizer would report it and exit instead */
        raise(SIGSEGV);
    }
}

static fracas_err fill_strengths(const fracas_campaign *campaign, const fracas_field *field, const fracas_lease *lease,
                                 fracas_batch *batch)
{
    for (size_t lane = 0; lane < lease->count; lane++) {
        size_t stride;
        double *strength = fracas_batch_strength(batch, lane, &stride);
        const fracas_stream stream =
            fracas_point_stream(campaign, (size_t)lease->point, FRACAS_PURPOSE_STRENGTH, (uint64_t)lease->replica[lane]);
        TRY(fracas_field_sample(field, &stream, stride, strength));
    }
    return FRACAS_OK;
}

static fracas_err send_record(int fd, const fracas_record *record)
{
    size_t size = fracas_record_packed_size(record);
    void *bytes = malloc(size);
    if (!bytes) return fracas_no_memory("a packed record");
    fracas_record_pack(record, bytes);
    fracas_err err = fracas_packet_send(fd, FRACAS_PACKET_RECORD, bytes, size);
    free(bytes);
    return err;
}

static fracas_err compute(const fracas_campaign *campaign, const fracas_run_options *options,
                          const fracas_model *model, const fracas_field *field, const fracas_lease *lease, int fd)
{
    fracas_batch_options batch_options = {.history = campaign->output.history,
                                          .interfaces = campaign->output.interfaces,
                                          .width = options->width,
                                          .isa = options->isa};
    fracas_batch *batch;
    TRY(fracas_batch_create(model, lease->count, &batch_options, &batch));
    fracas_err err = fill_strengths(campaign, field, lease, batch);
    crash_if_asked(lease);
    fracas_record record[FRACAS_LEASE_MAX];
    for (size_t lane = 0; lane < lease->count; lane++) fracas_record_init(&record[lane]);
    if (!err) err = fracas_batch_run(batch, record);
    for (size_t lane = 0; lane < lease->count; lane++) {
        if (!err) err = send_record(fd, &record[lane]);
        fracas_record_clear(&record[lane]);
    }
    fracas_batch_destroy(batch);
    return err;
}

/* ---- in the server ---- */

fracas_err fracas_child_start(fracas_child *child, const fracas_campaign *campaign, const fracas_run_options *options,
                              const fracas_model *model, const fracas_field *field, const fracas_lease *lease, int server_fd)
{
    int fd[2];
    if (pipe2(fd, O_CLOEXEC)) return fracas_fail(FRACAS_ENVIRONMENT, "no pipe for a lease: %s", strerror(errno));
    pid_t server = getpid(), pid = fork();
    if (pid < 0) {
        fracas_err err = fracas_fail(FRACAS_ENVIRONMENT, "no process for a lease: %s; use fewer --jobs, or raise the "
                                     "limits on processes and memory", strerror(errno));
        close(fd[0]);
        close(fd[1]);
        return err;
    }
    if (pid == 0) {
        prctl(PR_SET_PDEATHSIG, SIGKILL);
        if (getppid() != server) _exit(FRACAS_INTERRUPTED); /* it died before the line above */
        close(fd[0]);
        close(server_fd);
        fracas_err err = compute(campaign, options, model, field, lease, fd[1]);
        fracas_trouble fault;
        if (err) fracas_trouble_take(err, &fault);
        if (err && fracas_packet_send(fd[1], FRACAS_PACKET_FAULT, &fault, sizeof fault))
            _exit(FRACAS_ENVIRONMENT); /* nobody is there to hear more */
        _exit(0);
    }
    close(fd[1]);
    *child = (fracas_child){.pid = pid, .fd = fd[0], .lease = *lease, .began = fracas_now()};
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
        return fracas_fail(FRACAS_ENVIRONMENT, "cannot read from the process of a lease: %s", strerror(errno));
    *ended = n == 0;
    if (n > 0) child->size += (size_t)n;
    return FRACAS_OK;
}

/* Cuts the bytes of a child that ended by itself into messages; a fault or a wrong number of records is a failure. */
static fracas_err unpack(const fracas_child *child, bool *good, fracas_packet *record[FRACAS_LEASE_MAX],
                         fracas_lease_failure *failure)
{
    size_t at = 0, n = 0;
    fracas_packet head;
    *good = true;
    while (*good && child->size - at >= sizeof head) {
        memcpy(&head, child->bytes + at, sizeof head);
        const unsigned char *body = child->bytes + at + sizeof head;
        at += fracas_packet_bytes(&head);
        if (at > child->size) break;
        if (head.kind == FRACAS_PACKET_FAULT && head.size == sizeof(fracas_trouble)) {
            *good = false;
            memcpy(failure->reason, body + offsetof(fracas_trouble, text), sizeof failure->reason);
        } else if (head.kind == FRACAS_PACKET_RECORD && n < child->lease.count) {
            TRY(fracas_packet_create(FRACAS_PACKET_RECORD, body, head.size, &record[n++]));
        } else {
            break;
        }
    }
    if (!*good || (n == child->lease.count && at == child->size)) return FRACAS_OK;
    *good = false;
    snprintf(failure->reason, sizeof failure->reason, "its process sent %zu of %llu records", n,
             (unsigned long long)child->lease.count);
    return FRACAS_OK;
}

fracas_err fracas_child_collect(fracas_child *child, bool *good, fracas_packet *record[FRACAS_LEASE_MAX],
                                fracas_lease_failure *failure)
{
    memset(failure, 0, sizeof *failure);
    failure->lease = child->lease.id;
    for (size_t i = 0; i < FRACAS_LEASE_MAX; i++) record[i] = NULL;
    int status = 0;
    while (waitpid(child->pid, &status, 0) < 0)
        if (errno != EINTR) return fracas_fail(FRACAS_BUG, "cannot wait for a lease: %s", strerror(errno));
    child->pid = 0;
    *good = WIFEXITED(status) && WEXITSTATUS(status) == 0;
    fracas_err err = FRACAS_OK;
    if (*good)
        err = unpack(child, good, record, failure);
    else if (WIFSIGNALED(status))
        snprintf(failure->reason, sizeof failure->reason, "its process died of signal %d (%s)", WTERMSIG(status),
                 strsignal(WTERMSIG(status)));
    else
        snprintf(failure->reason, sizeof failure->reason, "its process ended with status %d", WEXITSTATUS(status));
    for (size_t i = 0; i < FRACAS_LEASE_MAX && (err || !*good); i++) {
        free(record[i]);
        record[i] = NULL;
    }
    fracas_child_clear(child);
    return err;
}

void fracas_child_clear(fracas_child *child)
{
    if (child->pid) {
        kill(child->pid, SIGKILL);
        while (waitpid(child->pid, NULL, 0) < 0 && errno == EINTR)
            ;
    }
    if (child->fd > 0) close(child->fd);
    free(child->bytes);
    *child = (fracas_child){0};
}
