/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Invariants of a farm, each checked when it could break:
 *
 * - a commit returns: its segment and the segment's name are durable, with the bytes of the seal;
 * - a segment in the index is never removed or written over;
 * - a lease goes out: none of its realizations is done, and none is with a living server that
 *   has not given it back, unless it has been there for 10 s (an overdue lease);
 * - a worker is sent to help another: that is one of another host;
 * - a study is opened again: what a commit had returned is still done, every row that is done has
 *   durable bytes, no segment is damaged, and none that is whole is left out. */
#ifndef FRACAS_TESTS_SIMULATOR_ORACLE_H
#define FRACAS_TESTS_SIMULATOR_ORACLE_H

#include "tests/simulator/machine.h"

#include "campaigns/campaign.h"

void oracle_begin(const fracas_campaign *campaign);
void oracle_power_failed(void);
void oracle_removes(const char *path);

/* Realizations done or failed for good. */
int64_t oracle_settled(void);
/* A process with this lease may be killed, or held up until its time is over: no realization would
 * come to its third attempt by that. Notes the attempt. */
bool oracle_may_hurt(const process *child);

#endif
