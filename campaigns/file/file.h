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
    fracas_campaign *campaign;        /* being made */
    const fracas_campaign_copy *copy; /* has the files that it names; NULL: they are read */
    const fracas_catalog *catalog;
    const fracas_node *root;
    fracas_faults *faults;     /* NULL: the first error ends the reading */
    bool *doubtful;            /* a flag a leaf, see fracas_file_doubt; NULL: none is */
    const fracas_node *within; /* the case or zip being read; NULL: none */
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

/* Notes an error of the file, FRACAS_USAGE, so that reading goes on: FRACAS_OK. Other codes, and
 * all without a list of errors, are returned. */
FRACAS_MUST_USE fracas_err fracas_file_note(const fracas_file *file, fracas_err err);
/* Number of errors that were noted, those that nobody need hear of included. */
size_t fracas_file_noted(const fracas_file *file);
/* FRACAS_USAGE: the present message follows from an error that is noted, and is not told. */
FRACAS_MUST_USE fracas_err fracas_file_untold(const fracas_file *file);

/* An error may be about this leaf, as a key near its name: that it is missing, or what it has in
 * the sections, is not judged any more. */
void fracas_file_doubt(const fracas_file *file, const fracas_leaf *leaf);
bool fracas_file_doubts(const fracas_file *file, const fracas_leaf *leaf);
/* All leaves of a section (NULL: of all), with or without the one that names its kind. */
void fracas_file_doubt_section(const fracas_file *file, const fracas_file_section *section,
                               bool kind);

/* "`text`" of a scalar, "nothing" if it is empty, "a list", "a section". */
const char *fracas_node_found(const fracas_node *node, char text[256]);

/* Notes every entry of `map` outside `keys`, a list up to NULL; *unknown: there is one. `subject`
 * is the name of the map in messages, "a range". */
FRACAS_MUST_USE fracas_err fracas_file_check_keys(const fracas_file *file, const fracas_node *map,
                                                  const char *const *keys, const char *subject,
                                                  bool *unknown);

/* The entry `key` of `map`. If there is none: the message is fracas_file_error's, untold where the
 * map has a key that is `unknown`. */
FRACAS_MUST_USE fracas_err fracas_file_need(const fracas_file *file, const fracas_node *map,
                                            const char *key, bool unknown,
                                            const fracas_node **found, const char *format, ...)
    FRACAS_PRINTF(6, 7);

#endif
