/* SPDX-License-Identifier: GPL-3.0-or-later */
/* `probes` of a campaign file: points whose motion is kept, `probes: {tip: [9 mm, 0]}`. */
#ifndef FRACAS_CAMPAIGNS_FILE_PROBES_H
#define FRACAS_CAMPAIGNS_FILE_PROBES_H

#include "campaigns/file/file.h"

/* FRACAS_USAGE, with file:line:column, for anything but names with places. */
FRACAS_MUST_USE fracas_err fracas_campaign_probes_read(const fracas_file *file,
                                                       const fracas_node *node,
                                                       fracas_probes *probes);
/* The same line in SI; nothing without a probe. */
void fracas_campaign_probes_write(const fracas_probes *probes, FILE *out);

#endif
