/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A campaign file being read, and its errors: place, finding, allowed values. */
#ifndef FRACAS_CAMPAIGNS_FILE_FILE_H
#define FRACAS_CAMPAIGNS_FILE_FILE_H

#include "base/units.h"
#include "campaigns/file/catalog.h"
#include "campaigns/file/node.h"

typedef struct {
    const char *name;
    fracas_campaign_memory *memory;
    const fracas_units *units;
    fracas_campaign *campaign; /* being made */
    const fracas_catalog *catalog;
    const fracas_node *root;
} fracas_file;

/* FRACAS_USAGE with "name:line:column: ..." of the node. */
FRACAS_MUST_USE fracas_err fracas_file_error(const fracas_file *file, const fracas_node *at,
                                             const char *format, ...) FRACAS_PRINTF(3, 4);

/* Puts "name:line:column: `key`" before the present message; returns FRACAS_USAGE. */
FRACAS_MUST_USE fracas_err fracas_file_error_within(const fracas_file *file, const fracas_node *at,
                                                    const char *key);

/* FRACAS_USAGE: "`KEY`: found ...; expected FORM". */
FRACAS_MUST_USE fracas_err fracas_file_expected(const fracas_file *file, const fracas_node *at,
                                                const char *key, const char *form);

/* "`text`" of a scalar, "nothing" if it is empty, "a list", "a section". */
const char *fracas_node_found(const fracas_node *node, char text[256]);

/* FRACAS_USAGE at the first entry of `map` outside `keys`, a list up to NULL; `subject` is the name
 * of the map in messages, "a range". */
FRACAS_MUST_USE fracas_err fracas_file_check_keys(const fracas_file *file, const fracas_node *map,
                                                  const char *const *keys, const char *subject);

#endif
