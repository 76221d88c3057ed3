/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Output of reindex, merge and merge-studies: actions line by line, then counts of the study. */
#ifndef FRACAS_CLI_UPKEEP_H
#define FRACAS_CLI_UPKEEP_H

#include "cli/cli.h"

#include "base/json.h"
#include "campaigns/scheduler/session/upkeep.h"

typedef struct {
    const char *study;
    fracas_said said; /* for the command; its lines are those of "said" in JSON */
    fracas_json json;
    bool with_json, closed;
} fracas_cli_upkeep;

void fracas_cli_upkeep_begin(fracas_cli_upkeep *upkeep, const char *study, bool json);
/* After the last line. More keys of JSON may follow. */
void fracas_cli_upkeep_counts(fracas_cli_upkeep *upkeep, const fracas_upkeep *end);
/* In words, which command goes on. */
void fracas_cli_upkeep_next(const fracas_cli_upkeep *upkeep, const fracas_upkeep *end);
void fracas_cli_upkeep_end(fracas_cli_upkeep *upkeep); /* after an error, too */

#endif
