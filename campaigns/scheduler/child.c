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

/* Realizations of a lease that are computed side by side. */
typedef struct {
    const int64_t *replica;
    size_t count;
} lanes;

/* Documented at fracas_child_start. */
static void crash_if_asked(const fracas_lease *lease, const lanes *batch)
{
    const char *victim = getenv("FRACAS_TEST_CRASH");
    unsigned long long point;
    long long replica;
    if (!victim || sscanf(victim, "%llu:%lld", &point, &replica) != 2 || lease->point != point) return;
    for (size_t i = 0; i < batch->count; i++) {
        if (batch->replica[i] != replica) continue;
        signal(SIGSEGV, SIG_DFL); /* a sanitizer would report it and exit instead */
        raise(SIGSEGV);
    }
}

static fracas_err fill_strengths(const fracas_campaign *campaign, const fracas_field *field, size_t point, const lanes *realizations,
                                 fracas_batch *batch)
{
    for (size_t lane = 0; lane < realizations->count; lane++) {
        size_t stride;
        double *strength = fracas_batch_strength(batch, lane, &stride);
        const fracas_stream stream =
            fracas_point_stream(campaign, point, FRACAS_PURPOSE_STRENGTH, (uint64_t)realizations->replica[lane]);
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

static fracas_err compute_batch(const fracas_campaign *campaign, const fracas_run_options *options, const fracas_model *model,
                                const fracas_field *field, const fracas_lease *lease, const lanes *realizations, int fd)
{
    fracas_batch_options batch_options = {.history = campaign->output.history,
                                          .interfaces = campaign->output.interfaces,
                                          .width = options->width,
                                          .isa = options->isa};
    fracas_batch *batch;
    TRY(fracas_batch_create(model, realizations->count, &batch_options, &batch));
    fracas_err err = fill_strengths(campaign, field, (size_t)lease->point, realizations, batch);
    crash_if_asked(lease, realizations);
    fracas_record record[FRACAS_BATCH_MAX];
    for (size_t lane = 0; lane < realizations->count; lane++) fracas_record_init(&record[lane]);
    if (!err) err = fracas_batch_run(batch, record);
    for (size_t lane = 0; lane < realizations->count; lane++) {
        if (!err) err = send_record(fd, &record[lane]);
        fracas_record_clear(&record[lane]);
    }
    fracas_batch_destroy(batch);
    return err;
}

static size_t width_of(const fracas_run_options *options)
{
    return options->width ? (size_t)options->width : FRACAS_BATCH_MAX;
}

/* Batch after batch; the records of each are sent when it is done. */
static fracas_err compute(const fracas_campaign *campaign, const fracas_run_options *options, const fracas_model *model,
                          const fracas_field *field, const fracas_lease *lease, int fd)
{
    const size_t width = width_of(options), count = (size_t)lease->count;
    for (size_t from = 0; from < count; from += width) {
        const lanes realizations = {lease->replica + from, count - from < width ? count - from : width};
        TRY(compute_batch(campaign, options, model, field, lease, &realizations, fd));
    }
    return FRACAS_OK;
}

/* ---- in the server ---- */

fracas_err fracas_child_start(fracas_child *child, const fracas_campaign *campaign, const fracas_run_options *options,
                              const fracas_model *model, const fracas_field *field, const fracas_lease *lease, int server_fd)
{
    int fd[2];
    if (pipe2(fd, O_CLOEXEC)) return fracas_fail_system(errno, "no pipe for a lease");
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
    *child = (fracas_child){.pid = pid, .fd = fd[0], .width = width_of(options), .began = fracas_now()};
    memcpy(&child->lease, lease, fracas_lease_bytes(lease));
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

/* Cuts what the child has sent into messages, as far as they are whole; a fault is a failure. */
static fracas_err unpack(const fracas_child *child, fracas_packet **record, size_t *count, fracas_lease_failure *failure)
{
    size_t at = 0;
    fracas_packet head;
    while (child->size - at >= sizeof head) {
        memcpy(&head, child->bytes + at, sizeof head);
        const unsigned char *body = child->bytes + at + sizeof head;
        at += fracas_packet_bytes(&head);
        if (at > child->size) break;
        if (head.kind == FRACAS_PACKET_FAULT && head.size == sizeof(fracas_trouble)) {
            memcpy(failure->reason, body + offsetof(fracas_trouble, text), sizeof failure->reason);
        } else if (head.kind == FRACAS_PACKET_RECORD && *count < child->lease.count) {
            TRY(fracas_packet_create(FRACAS_PACKET_RECORD, body, head.size, &record[*count]));
            ++*count;
        } else {
            break;
        }
    }
    return FRACAS_OK;
}

/* Waits for the process; says how it ended unless it ended well. */
static fracas_err reap(fracas_child *child, char *reason, size_t size)
{
    int status = 0;
    while (waitpid(child->pid, &status, 0) < 0)
        if (errno != EINTR) return fracas_fail(FRACAS_BUG, "cannot wait for a lease: %s", strerror(errno));
    child->pid = 0;
    if (WIFSIGNALED(status))
        snprintf(reason, size, "its process died of signal %d (%s)", WTERMSIG(status), strsignal(WTERMSIG(status)));
    else if (WEXITSTATUS(status))
        snprintf(reason, size, "its process ended with status %d", WEXITSTATUS(status));
    return FRACAS_OK;
}

fracas_err fracas_child_collect(fracas_child *child, bool *good, fracas_packet ***record, size_t *count, fracas_lease_failure *failure)
{
    const size_t wanted = (size_t)child->lease.count, width = child->width;
    memset(failure, 0, sizeof *failure);
    failure->lease = child->lease.id;
    *count = 0;
    *record = calloc(wanted, sizeof **record);
    fracas_err err = *record ? reap(child, failure->reason, sizeof failure->reason) : fracas_no_memory("the records of a lease");
    if (!err) err = unpack(child, *record, count, failure);
    *good = !err && *count == wanted && !failure->reason[0];
    if (!err && !*good) {
        if (*count == wanted) free((*record)[--*count]); /* it ended badly after its last record: of that one we are not sure */
        const size_t end = (*count / width + 1) * width; /* of the batch */
        failure->kept = *count;
        failure->count = (end < wanted ? end : wanted) - *count;
        if (!failure->reason[0])
            snprintf(failure->reason, sizeof failure->reason, "its process sent %zu of %zu records", *count, wanted);
    }
    for (size_t i = 0; err && *record && i < *count; i++) free((*record)[i]);
    if (err) free(*record), *record = NULL, *count = 0;
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
