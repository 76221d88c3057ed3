/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The lock of a study. */
#ifndef FRACAS_CAMPAIGNS_STORE_LOCK_H
#define FRACAS_CAMPAIGNS_STORE_LOCK_H

#include "base/err.h"

#include <stdbool.h>

/* Takes STUDY/lock (created) for this process until fracas_study_unlock or its death, and writes
 * into it who has it: host, pid, time, kernel, Slurm job. FRACAS_IN_USE names the holder's host and
 * pid. A lock left by a dead process of this host, or of this Slurm job before its requeue, is
 * taken over. A lock left by another host is refused unless `force`: its holder may live there,
 * with a filesystem that does not share locks. A holder known to live keeps it. */
FRACAS_MUST_USE fracas_err fracas_study_lock(const char *study, bool force, int *lock);
/* The same without a line in the file, to read a study while nobody else changes it; released by
 * close(). */
FRACAS_MUST_USE fracas_err fracas_study_lock_to_look(const char *study, bool force, int *lock);
/* Empties the file and closes it; -1 is allowed. */
void fracas_study_unlock(int lock);

enum { FRACAS_HOLDER_TEXT = 400 };
/* True if the lock was left by somebody else, "host H, pid N, since T" in *text. */
bool fracas_study_took_over(int lock, char text[FRACAS_HOLDER_TEXT]);

typedef enum {
    FRACAS_LOCK_FREE,
    FRACAS_LOCK_HELD,     /* by a living process */
    FRACAS_LOCK_LEFT,     /* by a dead process of this host */
    FRACAS_LOCK_ELSEWHERE /* by a process of another host, which may live */
} fracas_lock_state;
/* Looks at the lock without taking it; *text as above, "" if it is free, as it is without the file.
 * Not for the holder, who would lose it. FRACAS_ENVIRONMENT if the file cannot be looked at. */
FRACAS_MUST_USE fracas_err fracas_study_lock_state(const char *study, fracas_lock_state *state,
                                                   char text[FRACAS_HOLDER_TEXT]);

#endif
