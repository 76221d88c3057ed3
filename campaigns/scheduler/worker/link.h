/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A rank's end of the connection to its compute server, which may die and be replaced. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_WORKER_LINK_H
#define FRACAS_CAMPAIGNS_SCHEDULER_WORKER_LINK_H

#include "campaigns/scheduler/types/packet.h"
#include "campaigns/scheduler/worker/supervisor.h"

#include <stdbool.h>

typedef struct {
    fracas_supervisor supervisor; /* with the connection */
    bool ended;                   /* the server has sent its last message: ENDED or TROUBLE */
    int unacknowledged; /* restarts that rank 0 has not confirmed (FRESH): drop its messages */
    int deaths;         /* servers lost since the last segment or failure report */
} fracas_link;

/* *message, freed by the caller, is NULL if none of the server has come. After an unexpected end of
 * the server of rank `rank` it is REPLACED, and a new server starts, or LOST: there is none, or
 * five died in a row with no segment and no failure in between. FRACAS_ENVIRONMENT if it cannot be
 * read or without memory. */
FRACAS_MUST_USE fracas_err fracas_link_receive(fracas_link *link, int rank,
                                               fracas_packet **message);

/* Sends a message of rank 0 to the server, unless it is for a server before. FRACAS_PACKET_FRESH
 * ends here: rank 0 knows of one new server more, of which two may have died meanwhile.
 * If it cannot be sent, the connection is closed, so that the server ends. fracas_link_receive will
 * notice if the server is gone. */
void fracas_link_send(fracas_link *link, const fracas_packet *message);

#endif
