/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/types/mailbox.h"

#include "base/own.h"

#include <mpi.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { TAG = 0 };

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

void fracas_mailbox_open(fracas_mailbox *box)
{
    *box = (fracas_mailbox){0};
    if (!MPI_Init(NULL, NULL) && !MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN) &&
        !MPI_Comm_rank(MPI_COMM_WORLD, &box->rank) && !MPI_Comm_size(MPI_COMM_WORLD, &box->size))
        return;
    fputs("fracas: MPI does not start\n", stderr);
    _exit(FRACAS_ENVIRONMENT); /* ending with 0, it would leave the others waiting */
}

void fracas_mailbox_close(fracas_mailbox *box)
{
    MPI_Finalize();
    *box = (fracas_mailbox){0};
}

void fracas_mailbox_abort(void)
{
    MPI_Abort(MPI_COMM_WORLD, FRACAS_ENVIRONMENT);
}

fracas_err fracas_mailbox_post(fracas_mailbox *box, int to, const fracas_packet *message)
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

fracas_err fracas_mailbox_clear(fracas_mailbox *box)
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

fracas_err fracas_mailbox_receive(fracas_mailbox *box, int *from, fracas_packet **message)
{
    (void)box;
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
    return FRACAS_OK;
}

void fracas_mailbox_version(char *text, size_t size)
{
    char version[MPI_MAX_LIBRARY_VERSION_STRING] = "unknown";
    int length;
    if (MPI_Get_library_version(version, &length) != MPI_SUCCESS) strcpy(version, "unknown");
    snprintf(text, size, "%.*s", (int)strcspn(version, ",\n"), version);
}
