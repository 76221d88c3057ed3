/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/worker/link.h"

#include <poll.h>
#include <stdio.h>
#include <sys/socket.h>

enum { DEATHS_MAX = 5 /* servers lost in a row with no segment and no failure in between */ };

/* The message to rank 0 after the death of the server: REPLACED or LOST. */
static fracas_err report_death(fracas_link *link, int rank, fracas_packet **message)
{
    char how[512];
    fracas_trouble trouble = {.code = FRACAS_ENVIRONMENT};
    const int used = snprintf(trouble.text, sizeof trouble.text, "the compute server of rank %d ",
                              rank);
    char *text = trouble.text + used;
    const size_t room = sizeof trouble.text - (size_t)used;
    bool replaced = false;
    if (fracas_supervisor_reap(&link->supervisor, how, sizeof how)) {
        snprintf(text, room, "%s", fracas_message());
        trouble.again = 1;
    } else if (++link->deaths >= DEATHS_MAX) {
        snprintf(text, room,
                 "%s, and %d died before it with no segment in between; it is not started again",
                 how, link->deaths - 1);
        fracas_supervisor_end(&link->supervisor);
    } else if (fracas_supervisor_restart(&link->supervisor)) {
        snprintf(text, room, "%s, and there is no new one: %.400s", how, fracas_message());
    } else {
        snprintf(text, room, "%s; a new one goes on", how);
        link->unacknowledged++;
        replaced = true;
    }
    link->ended = !replaced;
    return fracas_packet_create(replaced ? FRACAS_PACKET_REPLACED : FRACAS_PACKET_LOST, &trouble,
                                sizeof trouble, message);
}

static void note(fracas_link *link, const fracas_packet *message)
{
    switch (message->kind) {
    case FRACAS_PACKET_ENDED:
    case FRACAS_PACKET_TROUBLE: link->ended = true; break;
    case FRACAS_PACKET_FAILED:
    case FRACAS_PACKET_SEGMENT: link->deaths = 0; break; /* safe if the server dies */
    default: break;
    }
}

fracas_err fracas_link_receive(fracas_link *link, int rank, fracas_packet **message)
{
    *message = NULL;
    struct pollfd from = {.fd = link->supervisor.server, .events = POLLIN};
    if (poll(&from, 1, 0) <= 0) return FRACAS_OK;
    TRY(fracas_packet_read(link->supervisor.server, message));
    if (*message) note(link, *message);
    else if (!link->ended) return report_death(link, rank, message);
    else fracas_supervisor_end(&link->supervisor);
    return FRACAS_OK;
}

void fracas_link_send(fracas_link *link, const fracas_packet *message)
{
    if (message->kind == FRACAS_PACKET_FRESH) link->unacknowledged--;
    else if (!link->unacknowledged && link->supervisor.server >= 0 &&
             fracas_packet_write(link->supervisor.server, message))
        shutdown(link->supervisor.server, SHUT_WR); /* without memory: it would wait for the rest */
}
