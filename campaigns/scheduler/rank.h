/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One rank: a proxy between its compute server and rank 0, which also directs the run. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_RANK_H
#define FRACAS_CAMPAIGNS_SCHEDULER_RANK_H

#include "base/err.h"
#include "campaigns/scheduler/types/facts.h"
#include "campaigns/scheduler/types/mailbox.h"
#include "campaigns/scheduler/types/options.h"

/* The life of this rank, which opens and closes the mailbox. It finds the facts that nobody has
 * found yet. Rank 0 returns the result of the run. The other ranks, and rank 0 under a launcher,
 * which gets the result through the status channel, return FRACAS_OK with facts->ran false. */
FRACAS_MUST_USE fracas_err fracas_rank_run(const fracas_run_options *options,
                                           const fracas_mailbox *box, fracas_run_facts *facts);

#endif
