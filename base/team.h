/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A fixed number of threads for one task after another, together. A waiting one sleeps. */
#ifndef FRACAS_BASE_TEAM_H
#define FRACAS_BASE_TEAM_H

#include "base/err.h"
#include "base/own.h"

#include <stddef.h>

typedef struct fracas_team fracas_team;
typedef void fracas_team_task(void *context, size_t member);

/* The caller is member 0; members 1 .. members - 1 are threads without signals. *team is
 * NULL for one member; all functions here take NULL. FRACAS_ENVIRONMENT if a thread cannot start.
 */
FRACAS_MUST_USE fracas_err fracas_team_create(size_t members, fracas_team **team);
void fracas_team_destroy(fracas_team *team); /* NULL is allowed */
FRACAS_OWNER(fracas_team, fracas_team_destroy)

/* Runs task(context, m) for all members m at once; returns when all have returned. */
void fracas_team_run(fracas_team *team, fracas_team_task *task, void *context);

/* Within a task: returns when every member has called it. */
void fracas_team_meet(fracas_team *team);

#endif
