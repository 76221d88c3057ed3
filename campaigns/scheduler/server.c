#include "campaigns/scheduler/server.h"

#include "campaigns/scheduler/child.h"
#include "campaigns/scheduler/packet.h"
#include "campaigns/scheduler/models.h"
#include "campaigns/scheduler/segment.h"

#include "campaigns/scheduler/clock.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <unistd.h>

typedef struct {
    int rank; /* connection to the rank */
    const fracas_campaign *campaign;
    const fracas_run_options *options;
    const char *study;
    fracas_lease waiting[FRACAS_LEASES_HELD];
    size_t first, nwaiting; /* a ring */
    fracas_child child;
    fracas_models models;
    fracas_segment segment;
    bool stopping; /* STOP came */
    bool alone;    /* the rank is gone */
} server;

static fracas_err say_failed(server *s, const fracas_lease_failure *failure)
{
    return fracas_packet_send(s->rank, FRACAS_PACKET_FAILED, failure, sizeof *failure);
}

static fracas_err write_segment(server *s)
{
    fracas_packet *note;
    TRY(fracas_segment_write(&s->segment, s->study, s->campaign, s->options, &note));
    fracas_err err = fracas_packet_write(s->rank, note);
    free(note);
    return err;
}

/* Starts the next lease. A model that cannot be built fails the lease, not the server. */
static fracas_err start_next(server *s)
{
    const fracas_lease *lease = &s->waiting[s->first];
    s->first = (s->first + 1) % FRACAS_LEASES_HELD;
    s->nwaiting--;
    const fracas_model *model;
    const fracas_field *field;
    if (fracas_models_get(&s->models, s->campaign, (size_t)lease->point, &model, &field)) {
        fracas_lease_failure failure = {.lease = lease->id, .count = lease->count < FRACAS_BATCH_MAX ? lease->count : FRACAS_BATCH_MAX};
        strncpy(failure.reason, fracas_message(), sizeof failure.reason - 1);
        return say_failed(s, &failure);
    }
    return fracas_child_start(&s->child, s->campaign, s->options, model, field, lease, s->rank);
}

/* The child sent something, or ended: then its records go to the segment and rank 0 hears of the lease. */
static fracas_err hear_child(server *s)
{
    bool ended, good;
    TRY(fracas_child_receive(&s->child, &ended));
    if (!ended) return FRACAS_OK;
    const fracas_lease lease = s->child.lease;
    const double seconds = fracas_now() - s->child.began;
    fracas_packet **record;
    size_t count;
    fracas_lease_failure failure;
    TRY(fracas_child_collect(&s->child, &good, &record, &count, &failure));
    fracas_err err = FRACAS_OK;
    for (size_t i = 0; i < count; i++) {
        if (err)
            free(record[i]);
        else
            err = fracas_segment_add(&s->segment, (size_t)lease.point, lease.replica[i], record[i]);
    }
    free(record);
    s->segment.compute += seconds;
    if (err) return err;
    if (!good) return say_failed(s, &failure);
    const fracas_lease_report report = {lease.id, seconds};
    return fracas_packet_send(s->rank, FRACAS_PACKET_COMPUTED, &report, sizeof report);
}

static fracas_err hear_rank(server *s)
{
    fracas_packet *message;
    TRY(fracas_packet_read(s->rank, &message));
    fracas_err err = FRACAS_OK;
    if (!message) {
        s->alone = true;
    } else if (message->kind == FRACAS_PACKET_STOP) {
        int32_t kill = 0;
        err = fracas_packet_expect(message, sizeof kill);
        if (!err) memcpy(&kill, message->body, sizeof kill);
        if (kill) fracas_child_clear(&s->child);
        s->stopping = true;
    } else if (message->kind == FRACAS_PACKET_FLUSH) {
        if (s->segment.count) err = write_segment(s);
    } else if (message->kind == FRACAS_PACKET_LEASE && s->nwaiting < FRACAS_LEASES_HELD) {
        fracas_lease *lease = &s->waiting[(s->first + s->nwaiting) % FRACAS_LEASES_HELD];
        err = message->size <= sizeof *lease ? fracas_packet_expect(message, offsetof(fracas_lease, replica) + sizeof *lease->replica)
                                             : fracas_fail(FRACAS_BUG, "a lease of %u bytes", message->size);
        if (!err) memcpy(lease, message->body, message->size);
        if (!err && fracas_lease_bytes(lease) != message->size) err = fracas_fail(FRACAS_BUG, "a lease of %u bytes", message->size);
        if (!err) s->nwaiting++;
    } else {
        err = fracas_fail(FRACAS_BUG, "a compute server got a message of kind %u", message->kind);
    }
    free(message);
    return err;
}

/* Sleeps until something comes or the segment is old enough. */
static fracas_err wait_and_hear(server *s)
{
    struct pollfd from[2] = {{.fd = s->rank, .events = POLLIN}, {.fd = s->child.fd, .events = POLLIN}};
    double wait = fracas_segment_wait(&s->segment, s->options);
    int timeout = isinf(wait) ? -1 : (int)fmin(ceil(fmax(wait, 0) * 1e3), 1e6);
    int ready = poll(from, s->child.pid ? 2 : 1, timeout);
    if (ready < 0 && errno != EINTR)
        return fracas_fail(FRACAS_ENVIRONMENT, "a compute server cannot wait: %s", strerror(errno));
    if (ready <= 0) return FRACAS_OK;
    if (s->child.pid && from[1].revents) TRY(hear_child(s));
    if (from[0].revents) TRY(hear_rank(s));
    return FRACAS_OK;
}

/* Until STOP is obeyed or the rank is gone. */
static fracas_err serve(server *s)
{
    TRY(fracas_packet_send(s->rank, FRACAS_PACKET_READY, &s->campaign->hash, sizeof s->campaign->hash));
    while (!s->alone) {
        if (!s->child.pid && s->stopping) {
            if (s->segment.count) TRY(write_segment(s));
            return fracas_packet_send(s->rank, FRACAS_PACKET_ENDED, NULL, 0);
        }
        while (!s->child.pid && s->nwaiting && !s->stopping) TRY(start_next(s));
        if (fracas_segment_wait(&s->segment, s->options) <= 0) TRY(write_segment(s));
        TRY(wait_and_hear(s));
    }
    return FRACAS_OK;
}

/* The life of the server process. Draining is rank 0's decision, so signals that mpirun or a terminal sends to
 * everybody are not for it, nor for the children, which inherit this. */
static _Noreturn void run_server(server *s, pid_t rank)
{
    static const int ignored[] = {SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGUSR2,
                                  SIGPIPE, SIGXFSZ}; /* the last two: an error of write will do */
    for (size_t i = 0; i < FRACAS_COUNT(ignored); i++) signal(ignored[i], SIG_IGN);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != rank) _exit(0); /* it died before the line above */
    int null = open("/dev/null", O_RDWR | O_CLOEXEC);
    if (null >= 0) {
        dup2(null, STDIN_FILENO);
        dup2(null, STDOUT_FILENO); /* rank 0's, on which the parent reads lines */
    }
    fracas_err err = serve(s);
    if (err) {
        fracas_trouble trouble;
        fracas_trouble_take(err, &trouble);
        fracas_child_clear(&s->child);
        err = fracas_packet_send(s->rank, FRACAS_PACKET_TROUBLE, &trouble, sizeof trouble);
    }
    fracas_child_clear(&s->child);
    fracas_segment_clear(&s->segment);
    fracas_models_clear(&s->models);
    _exit(err ? FRACAS_ENVIRONMENT : 0); /* not exit: what the rank registered is not for this process */
}

fracas_err fracas_server_start(const fracas_campaign *campaign, const fracas_run_options *options, const char *study,
                               int *fd, pid_t *pid)
{
    int pair[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair))
        return fracas_fail_system(errno, "no connection to a compute server");
    pid_t rank = getpid();
    *pid = fork();
    if (*pid < 0) {
        fracas_err err = fracas_fail(FRACAS_ENVIRONMENT, "no process for a compute server: %s; use fewer --jobs, or "
                                     "raise the limits on processes and memory", strerror(errno));
        close(pair[0]);
        close(pair[1]);
        return err;
    }
    if (*pid == 0) {
        close(pair[0]);
        server s = {.rank = pair[1], .campaign = campaign, .options = options, .study = study};
        run_server(&s, rank);
    }
    close(pair[1]);
    *fd = pair[0];
    return FRACAS_OK;
}
