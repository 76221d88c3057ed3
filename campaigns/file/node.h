/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A YAML file as a tree with lines and columns. */
#ifndef FRACAS_CAMPAIGNS_FILE_NODE_H
#define FRACAS_CAMPAIGNS_FILE_NODE_H

#include "base/err.h"
#include "campaigns/file/faults.h"
#include "campaigns/file/memory.h"

#include <stddef.h>

enum { FRACAS_LONGEST_TEXT = 200 }; /* bytes of a scalar */

/* FRACAS_UNREADABLE: a value that is refused already. */
typedef enum { FRACAS_SCALAR, FRACAS_LIST, FRACAS_MAP, FRACAS_UNREADABLE } fracas_node_type;

typedef struct fracas_node {
    fracas_node_type type;
    int line, column;          /* its place, from 1; a column counts characters */
    const char *text;          /* scalar: UTF-8 without control characters, within the above */
    struct fracas_node *key;   /* entry of a map: the scalar before the colon */
    struct fracas_node *first; /* entries of a list or map, in file order */
    struct fracas_node *next;  /* the next entry beside this one */
    size_t count;              /* number of entries */
    bool told;                 /* an error of it is noted: another need not be */
} fracas_node;

/* Reads one YAML document whose top is a map. FRACAS_USAGE, with file:line:column, for anything but
 * YAML in UTF-8; above 16 MiB, a million values or 16 levels; for several documents and keys other
 * than plain text. Anchors, aliases, tags, repeated keys and texts that are no value are noted, and
 * reading goes on; a section given twice is read as one. FRACAS_ENVIRONMENT if the file cannot be
 * read, or without memory. `name`: path of the file, also for messages. */
FRACAS_MUST_USE fracas_err fracas_node_read(const char *name, fracas_campaign_memory *memory,
                                            fracas_faults *faults, fracas_node **root);
/* The same of the `size` bytes of a file. */
FRACAS_MUST_USE fracas_err fracas_node_parse(const char *name, const void *bytes, size_t size,
                                             fracas_campaign_memory *memory, fracas_faults *faults,
                                             fracas_node **root);

/* The text of a scalar; "" of anything else. */
static inline const char *fracas_node_text(const fracas_node *node)
{
    return node->type == FRACAS_SCALAR ? node->text : "";
}

/* The entry of `map` with this key; NULL if there is none, or `map` is none. */
fracas_node *fracas_node_find(const fracas_node *map, const char *key);

#endif
