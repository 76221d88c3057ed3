/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Names that a file of a section gives to its keys: groups of a mesh file. */
#ifndef FRACAS_CAMPAIGNS_FILE_NAMES_H
#define FRACAS_CAMPAIGNS_FILE_NAMES_H

#include "campaigns/file/file.h"
#include "campaigns/file/words.h"

/* Changes *key, a name in a file of the section, into the key that it stands for; leaves a key of
 * the section's kind, and a name that no file has. The kind and the file are those in `own`, a map
 * of the section (NULL: none), else in file->within, else in the section of the campaign. Without a
 * file in the first two all files that the campaign names for the section count: FRACAS_USAGE, at
 * `at`, unless the name stands for one key in all of them. */
FRACAS_MUST_USE fracas_err fracas_name_to_key(const fracas_file *file,
                                              const fracas_file_section *section,
                                              const fracas_node *own, const fracas_node *at,
                                              const char **key);

/* Adds the names in those files, each after `before`. */
FRACAS_MUST_USE fracas_err fracas_names_add(const fracas_file *file,
                                            const fracas_file_section *section,
                                            const fracas_node *own, const char *before,
                                            fracas_words *words);

typedef struct {
    char text[160];
} fracas_names_question;

/* "; ..." that asks for the file in which an unknown key may be a name; "" if there is one, if no
 * name takes the value, or a known word is near; without "", words have no nearest one. */
FRACAS_MUST_USE fracas_err fracas_names_ask_for_file(const fracas_file *file,
                                                     const fracas_file_section *section,
                                                     const fracas_node *own,
                                                     const fracas_node *value, fracas_words *words,
                                                     fracas_names_question *ask);

#endif
