/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Files named in a campaign file. */
#ifndef FRACAS_CAMPAIGNS_FILE_ATTACH_H
#define FRACAS_CAMPAIGNS_FILE_ATTACH_H

#include "campaigns/file/file.h"

/* Reads a file whole into the memory of the campaign, once. Its path is the text of `node`,
 * relative to the folder of the campaign file. FRACAS_USAGE, with the place in the campaign file,
 * when it is absent, no file, empty, above 256 MiB, or a damaged copy in a study
 * (fracas_campaign_write). FRACAS_ENVIRONMENT when it cannot be read. */
FRACAS_MUST_USE fracas_err fracas_attachment_read(const fracas_file *file, const char *key,
                                                  const fracas_node *node, const void **attachment);

#endif
