/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Invariants of a farm, each checked when it could break:
 *
 * - a commit returns: its segment and the segment's name are durable, with the bytes of the seal;
 * - a segment in the index is never removed or written over;
 * - a lease goes out: none of its realizations is done, and none is with a living server that
 *   has not given it back, unless it has been there for 10 s (an overdue lease);
 * - a study is opened again: what a commit had returned is still done, every row that is done has
 *   durable bytes, no segment is damaged, and none that is whole is left out; no checkpoint is
 *   damaged or of another version;
 * - a checkpoint is finished: one is there, whole and durable;
 * - a checkpoint is removed: it is of no use, or the record of its realization is durable;
 * - a realization begins: it does so at its checkpoint, if there is one;
 * - a lease fails: a realization, or a fault, is the reason. */
#ifndef FRACAS_TESTS_SIMULATOR_ORACLE_H
#define FRACAS_TESTS_SIMULATOR_ORACLE_H

#include "tests/simulator/machine.h"

#include "campaigns/campaign.h"

void oracle_begin(const fracas_campaign *campaign);
void oracle_power_failed(void);
void oracle_removes(const char *path, bool replaced);
/* Steps in the durable checkpoint of a realization; 0: there is none. */
uint64_t oracle_checkpoint(uint64_t point, int64_t replica);
/* It begins at a step; `before`: that of its checkpoint when it was looked for. */
void oracle_begins(uint64_t point, int64_t replica, uint64_t before, uint64_t steps);

/* Realizations done or failed for good. */
int64_t oracle_ended(void);
/* A process with this lease may be killed, or held up until its time is over: no realization would
 * come to its third attempt by that. Notes the attempt. */
bool oracle_may_hurt(const process *child);

#endif
