/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/types/transport.h"

#include "base/param.h"
#include "campaigns/scheduler/types/environment.h"

#include <errno.h>
#include <mpi.h>
#include <poll.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { TAG = 0, PAUSE_MAX = 8 /* ms */ };

struct fracas_letter {
    fracas_letter *next;
    MPI_Request request;
    unsigned char bytes[];
};

static fracas_err failed(const char *what, int code)
{
    char reason[MPI_MAX_ERROR_STRING];
    int length;
    if (MPI_Error_string(code, reason, &length)) snprintf(reason, sizeof reason, "error %d", code);
    return fracas_fail(FRACAS_ENVIRONMENT, "MPI cannot %s a message: %s", what, reason);
}

/* Number of ranks by the launcher's variables; 0: unknown. */
static int ranks_told(void)
{
    static const char *const told[] = {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"};
    for (size_t i = 0; i < FRACAS_COUNT(told); i++)
        if (getenv(told[i])) return atoi(getenv(told[i]));
    return 0;
}

/* Written from a signal handler, which may do no more. */
static char waits_for[400];

static void say_waiting(int signal)
{
    (void)signal;
    const int saved = errno;
    const ssize_t written = write(STDERR_FILENO, waits_for, strlen(waits_for));
    (void)written;
    errno = saved;
}

/* Later, says once: others have not come. Rank 0 is the first, lest all ranks of a slow start do.
 */
static void warn_later(void)
{
    enum { WAIT = 5, WAIT_OF_OTHERS = 30 /* s */ };
    const int all = ranks_told();
    const char *rank = getenv("OMPI_COMM_WORLD_RANK");
    if (all < 2 || getenv(FRACAS_LAUNCHER_MARK)) return;
    char missing[64] = "1 more process";
    if (all > 2) snprintf(missing, sizeof missing, "one or more of the %d processes", all);
    snprintf(waits_for, sizeof waits_for,
             "fracas: waits for %s of the mpirun that started this one; " FRACAS_OTHER_JOB "\n",
             missing);
    struct sigaction say = {.sa_handler = say_waiting, .sa_flags = SA_RESTART};
    sigaction(SIGALRM, &say, NULL);
    alarm(rank && strcmp(rank, "0") != 0 ? WAIT_OF_OTHERS : WAIT);
}

static void open_box(fracas_mailbox *box)
{
    struct sigaction before;
    sigaction(SIGALRM, NULL, &before);
    warn_later();
    const int code = MPI_Init(NULL, NULL);
    alarm(0);
    sigaction(SIGALRM, &before, NULL);
    if (!code && !MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN) &&
        !MPI_Comm_rank(MPI_COMM_WORLD, &box->rank) && !MPI_Comm_size(MPI_COMM_WORLD, &box->size))
        return;
    fputs("fracas: MPI does not start\n", stderr);
    _exit(FRACAS_ENVIRONMENT); /* ending with 0, it would leave the others waiting */
}

static bool is_elsewhere(const fracas_whereabouts *mine, const fracas_whereabouts *lead)
{
    const bool one_host = fracas_hash_equal(&mine->host, &lead->host);
    return !fracas_hash_equal(one_host ? &mine->path : &mine->given,
                              one_host ? &lead->path : &lead->given);
}

static int stranger(fracas_mailbox *box, const fracas_whereabouts *mine)
{
    struct {
        fracas_whereabouts place;
        uint8_t known;
    } lead = {.known = mine != NULL};
    if (mine) lead.place = *mine;
    if (MPI_Bcast(&lead, sizeof lead, MPI_BYTE, 0, MPI_COMM_WORLD)) return -1;
    const int none = box->size;
    const int own = mine && lead.known && is_elsewhere(mine, &lead.place) ? box->rank : none;
    int lowest = none;
    if (MPI_Allreduce(&own, &lowest, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD)) return -1;
    return lowest == none ? -1 : lowest;
}

static void close_box(fracas_mailbox *box)
{
    (void)box;
    MPI_Finalize();
}

static void abort_all(const fracas_mailbox *box)
{
    (void)box;
    MPI_Abort(MPI_COMM_WORLD, FRACAS_ENVIRONMENT);
}

static fracas_err post(fracas_mailbox *box, int to, const fracas_packet *message)
{
    const size_t size = fracas_packet_bytes(message);
    OWNED fracas_letter *letter = malloc(sizeof *letter + size);
    if (!letter) return fracas_no_memory("a message");
    memcpy(letter->bytes, message, size);
    const int code = MPI_Isend(letter->bytes, (int)size, MPI_BYTE, to, TAG, MPI_COMM_WORLD,
                               &letter->request);
    if (code != MPI_SUCCESS) return failed("send", code);
    letter->next = box->outbox;
    box->outbox = letter;
    letter = NULL;
    return FRACAS_OK;
}

static fracas_err clear(fracas_mailbox *box)
{
    for (fracas_letter **at = &box->outbox; *at;) {
        fracas_letter *letter = *at;
        int taken;
        const int code = MPI_Test(&letter->request, &taken, MPI_STATUS_IGNORE);
        if (code != MPI_SUCCESS) return failed("send", code);
        if (!taken) {
            at = &letter->next;
            continue;
        }
        *at = letter->next;
        free(letter);
    }
    return FRACAS_OK;
}

static fracas_err receive(fracas_mailbox *box, int *from, fracas_packet **message)
{
    *message = NULL;
    int come, bytes;
    MPI_Status status;
    int code = MPI_Iprobe(MPI_ANY_SOURCE, TAG, MPI_COMM_WORLD, &come, &status);
    if (code == MPI_SUCCESS && !come) return FRACAS_OK;
    if (code == MPI_SUCCESS) code = MPI_Get_count(&status, MPI_BYTE, &bytes);
    if (code != MPI_SUCCESS) return failed("probe", code);
    OWNED fracas_packet *m = malloc((size_t)bytes);
    if (!m) return fracas_no_memory("a message");
    code = MPI_Recv(m, bytes, MPI_BYTE, status.MPI_SOURCE, TAG, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    if (code != MPI_SUCCESS) return failed("receive", code);
    *from = status.MPI_SOURCE;
    *message = m;
    m = NULL;
    box->pause = 0;
    return FRACAS_OK;
}

/* MPI is polled: the pause doubles while nothing happens. */
static void wait_for_any(fracas_mailbox *box, int fd, int most)
{
    struct pollfd from = {.fd = fd, .events = POLLIN};
    box->pause = box->pause ? 2 * box->pause : 1;
    if (box->pause > PAUSE_MAX) box->pause = PAUSE_MAX;
    if (poll(&from, 1, box->pause < most ? box->pause : most) > 0) box->pause = 0;
}

const fracas_transport fracas_transport_mpi = {
    open_box, stranger, close_box, abort_all, post, clear, receive, wait_for_any,
};

void fracas_mailbox_version(char *text, size_t size)
{
    char version[MPI_MAX_LIBRARY_VERSION_STRING] = "unknown";
    int length;
    if (MPI_Get_library_version(version, &length) != MPI_SUCCESS) strcpy(version, "unknown");
    snprintf(text, size, "%.*s", (int)strcspn(version, ",\n"), version);
}
