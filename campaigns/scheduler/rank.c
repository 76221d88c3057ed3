/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/rank.h"

#include "base/param.h"
#include "campaigns/campaign.h"
#include "campaigns/scheduler/director/director.h"
#include "campaigns/scheduler/session/prepare.h"
#include "campaigns/scheduler/types/clock.h"
#include "campaigns/scheduler/types/packet.h"
#include "campaigns/scheduler/worker/supervisor.h"

#include <limits.h>
#include <mpi.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <time.h>
#include <unistd.h>

enum {
    TAG = 0,
    WAIT_MAX = 8,  /* ms */
    DEATHS_MAX = 5 /* servers lost in a row with nothing settled in between */
};

/* Set by SIGUSR1 (the launcher, through mpirun), SIGUSR2, SIGTERM and SIGINT (mpirun, srun, a batch
 * system). */
static volatile sig_atomic_t drain_asked;

static void ask_drain(int signal_number)
{
    (void)signal_number;
    drain_asked = 1;
}

/* A message under way to another rank. */
typedef struct posted {
    struct posted *next;
    MPI_Request request;
    unsigned char bytes[];
} posted;

typedef struct {
    const fracas_run_options *options;
    fracas_campaign *campaign;
    char study[4096];
    double began; /* fracas_now at the start of this process */
    int rank, size;
    fracas_supervisor supervisor; /* with the connection to the compute server */
    bool ended;                   /* the server has sent its last message: ENDED or TROUBLE */
    bool fresh;     /* rank 0 does not know the new server: its messages are for the former one */
    int deaths;     /* servers lost since the last segment or failure report */
    int wait;       /* to sleep when no message comes [ms] */
    posted *outbox; /* messages of rank 0 under way */
} rank_state;

/* ---- messages ---- */

static fracas_err mpi_failed(const char *what, int code)
{
    char reason[MPI_MAX_ERROR_STRING];
    int length;
    if (MPI_Error_string(code, reason, &length)) snprintf(reason, sizeof reason, "error %d", code);
    return fracas_fail(FRACAS_ENVIRONMENT, "MPI cannot %s a message: %s", what, reason);
}

static fracas_err mpi_send(int to, const fracas_packet *message)
{
    int code = MPI_Send(message, (int)fracas_packet_bytes(message), MPI_BYTE, to, TAG,
                        MPI_COMM_WORLD);
    return code == MPI_SUCCESS ? FRACAS_OK : mpi_failed("send", code);
}

/* *message is NULL when none has come. */
static fracas_err mpi_receive(int *from, fracas_packet **message)
{
    *message = NULL;
    int come, bytes;
    MPI_Status status;
    int code = MPI_Iprobe(MPI_ANY_SOURCE, TAG, MPI_COMM_WORLD, &come, &status);
    if (code == MPI_SUCCESS && !come) return FRACAS_OK;
    if (code == MPI_SUCCESS) code = MPI_Get_count(&status, MPI_BYTE, &bytes);
    if (code != MPI_SUCCESS) return mpi_failed("probe", code);
    OWNED fracas_packet *m = malloc((size_t)bytes);
    if (!m) return fracas_no_memory("a message");
    code = MPI_Recv(m, bytes, MPI_BYTE, status.MPI_SOURCE, TAG, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    if (code != MPI_SUCCESS) return mpi_failed("receive", code);
    *from = status.MPI_SOURCE;
    *message = m;
    m = NULL;
    return FRACAS_OK;
}

/* ---- the server ---- */

/* The message to rank 0 after the death of the server: REPLACED or LOST. */
static fracas_err report_death(rank_state *rank, fracas_packet **message)
{
    char how[512];
    fracas_trouble trouble = {.code = FRACAS_ENVIRONMENT};
    const int used = snprintf(trouble.text, sizeof trouble.text, "the compute server of rank %d ",
                              rank->rank);
    char *text = trouble.text + used;
    const size_t room = sizeof trouble.text - (size_t)used;
    rank->fresh = false;
    if (fracas_supervisor_reap(&rank->supervisor, how, sizeof how)) {
        snprintf(text, room, "%s", fracas_message());
        trouble.again = 1;
    } else if (++rank->deaths >= DEATHS_MAX) {
        snprintf(text, room,
                 "%s, and %d died before it with no segment in between; it is not started again",
                 how, rank->deaths - 1);
        fracas_supervisor_end(&rank->supervisor);
    } else if (fracas_supervisor_restart(&rank->supervisor)) {
        snprintf(text, room, "%s, and there is no new one: %.400s", how, fracas_message());
    } else {
        snprintf(text, room, "%s; a new one goes on", how);
        rank->fresh = true;
    }
    rank->ended = !rank->fresh;
    return fracas_packet_create(rank->fresh ? FRACAS_PACKET_REPLACED : FRACAS_PACKET_LOST, &trouble,
                                sizeof trouble, message);
}

/* Updates the rank by a message of its server. */
static void note(rank_state *rank, const fracas_packet *message)
{
    switch (message->kind) {
    case FRACAS_PACKET_ENDED:
    case FRACAS_PACKET_TROUBLE: rank->ended = true; break;
    case FRACAS_PACKET_FAILED:
    case FRACAS_PACKET_SEGMENT: rank->deaths = 0; break; /* settled: safe if the server dies */
    default: break;
    }
}

/* Waits up to `wait` ms for a message of the server; *message is NULL if none comes. */
static fracas_err server_receive(rank_state *rank, fracas_packet **message)
{
    *message = NULL;
    struct pollfd from = {.fd = rank->supervisor.server, .events = POLLIN};
    if (poll(&from, 1, rank->wait) <= 0 || !from.revents) return FRACAS_OK;
    TRY(fracas_packet_read(rank->supervisor.server, message));
    if (*message) note(rank, *message);
    else if (!rank->ended) return report_death(rank, message);
    else fracas_supervisor_end(&rank->supervisor);
    return FRACAS_OK;
}

/* server_receive will notice if the server is gone. */
static void server_send(rank_state *rank, const fracas_packet *message)
{
    if (message->kind == FRACAS_PACKET_FRESH) rank->fresh = false;
    else if (!rank->fresh && rank->supervisor.server >= 0 &&
             fracas_packet_write(rank->supervisor.server, message))
        return;
}

/* MPI is polled: the wait doubles while nothing happens. Leases are given one ahead. */
static void pace(rank_state *rank, bool busy)
{
    rank->wait = busy ? 0 : rank->wait ? 2 * rank->wait : 1;
    if (rank->wait > WAIT_MAX) rank->wait = WAIT_MAX;
}

/* ---- ranks but 0 ---- */

static fracas_err tell(fracas_packet_kind kind, const void *body, size_t size)
{
    OWNED fracas_packet *message = NULL;
    TRY(fracas_packet_create(kind, body, size, &message));
    return mpi_send(0, message);
}

/* Forwards a message of rank 0 to the server; *come: there was one. */
static fracas_err receive_lead(rank_state *rank, bool *come, bool *quit)
{
    OWNED fracas_packet *message = NULL;
    int from;
    TRY(mpi_receive(&from, &message));
    *come = message != NULL;
    if (message && message->kind == FRACAS_PACKET_QUIT) *quit = true;
    else if (message) server_send(rank, message);
    return FRACAS_OK;
}

/* Sends to rank 0 and receives meanwhile: long messages wait until the other side receives, and
 * rank 0 may be sending, too. */
static fracas_err send_lead(rank_state *rank, const fracas_packet *message, bool *quit)
{
    const struct timespec rest = {.tv_nsec = 200000};
    MPI_Request request;
    int sent = 0;
    int code = MPI_Isend(message, (int)fracas_packet_bytes(message), MPI_BYTE, 0, TAG,
                         MPI_COMM_WORLD, &request);
    while (code == MPI_SUCCESS) {
        bool come;
        code = MPI_Test(&request, &sent, MPI_STATUS_IGNORE);
        if (code != MPI_SUCCESS || sent) break;
        TRY(receive_lead(rank, &come, quit));
        if (!come) nanosleep(&rest, NULL);
    }
    return code == MPI_SUCCESS ? FRACAS_OK : mpi_failed("send", code);
}

/* One message each way, if there is one. */
static fracas_err forward(rank_state *rank, bool *quit)
{
    OWNED fracas_packet *message = NULL;
    bool come;
    TRY(server_receive(rank, &message));
    if (message) TRY(send_lead(rank, message, quit));
    TRY(receive_lead(rank, &come, quit));
    pace(rank, message || come);
    return FRACAS_OK;
}

static fracas_err follow(rank_state *rank, fracas_err set_up)
{
    if (set_up) {
        fracas_trouble trouble;
        fracas_trouble_take(set_up, &trouble);
        TRY(tell(FRACAS_PACKET_TROUBLE, &trouble, sizeof trouble));
    }
    bool told = false, quit = false;
    while (!quit) {
        if (drain_asked && !told) {
            TRY(tell(FRACAS_PACKET_DRAIN, NULL, 0));
            told = true;
        }
        TRY(forward(rank, &quit));
    }
    return tell(FRACAS_PACKET_QUIT, NULL, 0);
}

/* ---- rank 0 ---- */

/* Frees the delivered messages. */
static fracas_err clear_outbox(rank_state *rank)
{
    for (posted **at = &rank->outbox; *at;) {
        posted *p = *at;
        int taken;
        int code = MPI_Test(&p->request, &taken, MPI_STATUS_IGNORE);
        if (code != MPI_SUCCESS) return mpi_failed("send", code);
        if (!taken) {
            at = &p->next;
            continue;
        }
        *at = p->next;
        free(p);
    }
    return FRACAS_OK;
}

/* Sends without waiting for the rank: a hung one must not hold up the others. */
static fracas_err post(rank_state *rank, int to, const fracas_packet *message)
{
    const size_t size = fracas_packet_bytes(message);
    OWNED posted *p = malloc(sizeof *p + size);
    if (!p) return fracas_no_memory("a message");
    memcpy(p->bytes, message, size);
    int code = MPI_Isend(p->bytes, (int)size, MPI_BYTE, to, TAG, MPI_COMM_WORLD, &p->request);
    if (code != MPI_SUCCESS) return mpi_failed("send", code);
    p->next = rank->outbox;
    rank->outbox = p;
    p = NULL;
    return FRACAS_OK;
}

static fracas_err send_worker(void *context, size_t worker, const fracas_packet *message)
{
    rank_state *rank = context;
    if (worker > 0) return post(rank, (int)worker, message);
    server_send(rank, message);
    return FRACAS_OK;
}

/* Receives from the workers, its own server first, until all have ended. */
static fracas_err direct(rank_state *rank, fracas_director *director)
{
    while (!fracas_director_over(director)) {
        if (drain_asked) fracas_director_drain(director);
        fracas_packet *message;
        int from = 0;
        TRY(server_receive(rank, &message));
        bool busy = message != NULL;
        if (message) fracas_director_receive(director, 0, message);
        free(message);
        do {
            TRY(mpi_receive(&from, &message));
            busy |= message != NULL;
            if (message) fracas_director_receive(director, (size_t)from, message);
            free(message);
        } while (message);
        TRY(clear_outbox(rank));
        fracas_director_tick(director);
        pace(rank, busy);
    }
    return FRACAS_OK;
}

/* End of the walltime by fracas_now; 0: none. It counts from the start of the launcher, or of this
 * process under the user's own launcher. */
static double deadline_of(const rank_state *rank)
{
    const char *text = getenv(FRACAS_DEADLINE);
    struct timespec day;
    clock_gettime(CLOCK_REALTIME, &day);
    if (text)
        return fracas_now() + strtod(text, NULL) - (double)day.tv_sec - 1e-9 * (double)day.tv_nsec;
    return rank->options->walltime > 0 ? rank->began + rank->options->walltime : 0;
}

static fracas_err lead(rank_state *rank, fracas_channel *channel, bool *ran)
{
    fracas_director_setup setup = {.campaign = rank->campaign,
                                   .options = rank->options,
                                   .study = rank->study,
                                   .workers = (size_t)rank->size,
                                   .send = send_worker,
                                   .context = rank,
                                   .channel = channel,
                                   .now = fracas_now,
                                   .deadline = deadline_of(rank)};
    fracas_director *director;
    fracas_err result;
    TRY(fracas_director_create(&setup, &director, &result));
    *ran = director != NULL;
    if (!director) return result;
    const char *restarted = getenv(FRACAS_RESTARTED);
    if (channel->launcher && restarted) fracas_director_note(director, "restarted", restarted);
    result = direct(rank, director);
    if (!result) result = fracas_director_finish(director);
    fracas_director_destroy(director);
    return result;
}

/* Receives until all ranks have answered QUIT: a rank in the middle of a long message could not end
 * otherwise. A hung rank gets PATIENCE. */
static void receive_rest(rank_state *rank)
{
    enum { PATIENCE = 5 /* s */ };
    const struct timespec rest = {.tv_nsec = 1000000};
    const double began = fracas_now();
    for (int left = rank->size - 1; left > 0 && fracas_now() - began < PATIENCE;) {
        fracas_packet *message;
        int from;
        if (clear_outbox(rank) || mpi_receive(&from, &message)) return;
        if (!message) nanosleep(&rest, NULL);
        else if (message->kind == FRACAS_PACKET_QUIT) left--;
        free(message);
    }
}

/* Rank 0 from MPI_Init on: the run, its result on the status channel, and QUIT to the others. */
static fracas_err lead_to_end(rank_state *rank, fracas_err set_up, bool *ran)
{
    fracas_channel channel;
    fracas_channel_init(&channel);
    fracas_err err = set_up;
    if (!err) err = lead(rank, &channel, ran);
    fracas_channel_end(&channel, err, *ran);
    fracas_trouble result;
    fracas_trouble_take(err, &result);
    const fracas_packet quit = {.kind = FRACAS_PACKET_QUIT};
    for (int other = 1; other < rank->size; other++)
        if (mpi_send(other, &quit)) MPI_Abort(MPI_COMM_WORLD, FRACAS_ENVIRONMENT); /* or it waits */
    receive_rest(rank);
    if (!channel.launcher) return fracas_trouble_fail(&result);
    *ran = false;
    return FRACAS_OK;
}

/* ---- every rank ---- */

static void catch_signals(void)
{
    struct sigaction drain = {.sa_handler = ask_drain, .sa_flags = SA_RESTART};
    static const int asking[] = {SIGUSR1, SIGUSR2, SIGTERM, SIGINT};
    sigemptyset(&drain.sa_mask);
    for (size_t i = 0; i < FRACAS_COUNT(asking); i++) sigaction(asking[i], &drain, NULL);
    signal(SIGPIPE, SIG_IGN); /* both become errors of write */
    signal(SIGXFSZ, SIG_IGN);
}

/* Before MPI_Init: the supervisor is forked from a process without MPI. */
static fracas_err set_up(rank_state *rank)
{
    TRY(fracas_run_campaign(rank->options, &rank->campaign));
    TRY(fracas_study_folder(rank->options, rank->campaign, rank->study, sizeof rank->study));
    return fracas_supervisor_start(rank->campaign, rank->options, rank->study, &rank->supervisor);
}

fracas_err fracas_rank_run(const fracas_run_options *options, bool *ran)
{
    *ran = false;
    /* No rank outlives the launcher's mpirun. (Not with other launchers: the signal follows the
     * starting thread, and theirs may end early.) */
    if (getenv(FRACAS_LAUNCHER_MARK)) prctl(PR_SET_PDEATHSIG, SIGKILL);
    catch_signals();
    rank_state rank = {
        .options = options, .began = fracas_now(), .supervisor = {.control = -1, .server = -1}};
    fracas_err err = set_up(&rank);
    fracas_trouble trouble;
    fracas_trouble_take(err, &trouble);
    if (MPI_Init(NULL, NULL) || MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN) ||
        MPI_Comm_rank(MPI_COMM_WORLD, &rank.rank) || MPI_Comm_size(MPI_COMM_WORLD, &rank.size)) {
        fputs("fracas: MPI does not start\n", stderr);
        _exit(FRACAS_ENVIRONMENT); /* ending with 0, it would leave the others waiting */
    }
    err = fracas_trouble_fail(&trouble);
    if (rank.rank == 0) {
        err = lead_to_end(&rank, err, ran);
    } else if (follow(&rank, err)) {
        MPI_Abort(MPI_COMM_WORLD, FRACAS_ENVIRONMENT); /* or rank 0 would wait for this rank */
    } else {
        err = FRACAS_OK;
    }
    fracas_supervisor_end(&rank.supervisor);
    fracas_campaign_destroy(rank.campaign);
    MPI_Finalize();
    return err;
}
