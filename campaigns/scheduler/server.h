/* The compute server of a rank: builds models, forks a child per lease, writes segments. It knows neither MPI nor
 * the index. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_SERVER_H
#define FRACAS_CAMPAIGNS_SCHEDULER_SERVER_H

#include "campaigns/campaign.h"
#include "campaigns/scheduler/run.h"

#include <sys/types.h>

/* Forks the server, before MPI_Init: *fd is the connection, to be closed to end it. The server dies with this
 * process. FRACAS_ENVIRONMENT if there is no process or socket. */
FRACAS_MUST_USE fracas_err fracas_server_start(const fracas_campaign *campaign, const fracas_run_options *options,
                                               const char *study, int *fd, pid_t *pid);

#endif
