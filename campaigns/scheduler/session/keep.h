/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The files of a study folder that may be a user's own: the folder before the first run, and its
 * campaign.yaml. A file that no run wrote is not replaced. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_SESSION_KEEP_H
#define FRACAS_CAMPAIGNS_SCHEDULER_SESSION_KEEP_H

#include "campaigns/campaign.h"

/* FRACAS_USAGE if `study` is a folder that no run has made, with files or folders where a study has
 * its own. Writes nothing. The remains of a run that was killed at any moment pass. */
FRACAS_MUST_USE fracas_err fracas_study_place(const char *study);

/* Writes the resolved campaign as FOLDER/NAME, and copies of its attachments beside it; each whole
 * or not at all. Creates missing folders. A file that is of the same campaign already stays as it
 * is. One with changes by hand gets another name, which *said tells, freed by the caller; without
 * `said` it is refused as by fracas_campaign_keeps. */
FRACAS_MUST_USE fracas_err fracas_campaign_keep(const fracas_campaign *campaign, const char *folder,
                                                const char *name, char **said);

/* FRACAS_USAGE if fracas_campaign_keep would replace a link, a write-protected file, or one that is
 * not as fracas writes it. Writes nothing. */
FRACAS_MUST_USE fracas_err fracas_campaign_keeps(const fracas_campaign *campaign,
                                                 const char *folder, const char *name);

/* Creates a folder and those above it, which may be there, durable on return. */
FRACAS_MUST_USE fracas_err fracas_folder_make(const char *path);
/* Makes FOLDER/NAME, which may be there and is no link, durable on return. */
FRACAS_MUST_USE fracas_err fracas_folder_make_own(const char *folder, const char *name,
                                                  char **path);

#endif
