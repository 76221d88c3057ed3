/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A YAML file as a tree in which everything knows its line and column. */
#ifndef FRACAS_CAMPAIGNS_FILE_NODE_H
#define FRACAS_CAMPAIGNS_FILE_NODE_H

#include "base/err.h"
#include "campaigns/file/memory.h"

#include <stddef.h>

typedef enum { FRACAS_SCALAR, FRACAS_LIST, FRACAS_MAP } fracas_node_type;

typedef struct fracas_node {
    fracas_node_type type;
    int line, column; /* where it starts, from 1; a column counts characters */
    const char *text; /* of a scalar: at most 200 bytes of UTF-8 without control characters */
    struct fracas_node *key;   /* of an entry of a map: the scalar before the colon */
    struct fracas_node *first; /* entries of a list or map, in file order */
    struct fracas_node *next;  /* the next entry beside this one */
    size_t count;              /* of entries */
} fracas_node;

/* Reads one YAML document whose top is a map. Refused, as FRACAS_USAGE with file:line:column: what
 * is not YAML or not UTF-8, files over 16 MiB or a million values, nesting over 16, several
 * documents, anchors, aliases and tags, keys that are not plain text, repeated keys.
 * FRACAS_ENVIRONMENT when the file cannot be opened or read, or without memory. `name`: the file's,
 * as it is opened and as messages call it. */
FRACAS_MUST_USE fracas_err fracas_node_read(const char *name, fracas_campaign_memory *memory,
                                            fracas_node **root);

/* The entry of `map` with this key; NULL if there is none. */
fracas_node *fracas_node_find(const fracas_node *map, const char *key);

#endif
