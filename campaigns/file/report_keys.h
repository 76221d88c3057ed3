/* SPDX-License-Identifier: GPL-3.0-or-later */
/* `report: {x: ..., series: ..., panels: ..., y: ...}` of a campaign file: keys of the figures of
 * means. */
#ifndef FRACAS_CAMPAIGNS_FILE_REPORT_KEYS_H
#define FRACAS_CAMPAIGNS_FILE_REPORT_KEYS_H

#include "campaigns/file/file.h"

#include <stdio.h>

/* Reads the map `node`; the texts belong to the file's memory. */
FRACAS_MUST_USE fracas_err fracas_report_keys_read(const fracas_file *file, const fracas_node *node,
                                                   fracas_report_keys *keys);
/* FRACAS_USAGE if a key names a parameter of the campaign file that the points do not differ in, or
 * series and panels none. Other names of x, and all of y, are statistics, which a report knows.
 * `table`: of all points. */
FRACAS_MUST_USE fracas_err fracas_report_keys_check(const fracas_file *file,
                                                    const fracas_report_keys *keys,
                                                    const fracas_point_table *table);
/* Nothing without keys. */
void fracas_report_keys_write(const fracas_report_keys *keys, FILE *out);

#endif
