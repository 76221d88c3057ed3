/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Files that a campaign file names. */
#ifndef FRACAS_CAMPAIGNS_FILE_ATTACH_H
#define FRACAS_CAMPAIGNS_FILE_ATTACH_H

#include "campaigns/file/setting.h"

/* Reads the file whose path is the text of `node`, relative to the folder of the campaign file,
 * whole, into the memory of the campaign; a file that was read already is not read again.
 * FRACAS_USAGE, with the place in the campaign file, when it is not there, is no file, is empty or
 * has more than 256 MiB, or when it is the copy in a study (fracas_campaign_write) and damaged;
 * FRACAS_ENVIRONMENT when it cannot be read. */
FRACAS_MUST_USE fracas_err fracas_attachment_read(const fracas_file *file, const char *key,
                                                  const fracas_node *node,
                                                  const fracas_attachment **attachment);

#endif
