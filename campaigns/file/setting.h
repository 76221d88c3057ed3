/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a campaign file sets: one value of one leaf, converted and checked as far as its own table
 * goes. */
#ifndef FRACAS_CAMPAIGNS_FILE_SETTING_H
#define FRACAS_CAMPAIGNS_FILE_SETTING_H

#include "base/units.h"
#include "campaigns/file/catalog.h"
#include "campaigns/file/node.h"

/* A campaign file being read. */
typedef struct {
    const char *name;
    fracas_campaign_memory *memory;
    const fracas_units *units;
    fracas_campaign *campaign; /* being made */
    const fracas_catalog *catalog;
    const fracas_node *root;
} fracas_file;

typedef struct fracas_setting {
    const fracas_leaf *leaf;
    const fracas_node *node;             /* where it was written */
    const fracas_kind *kind;             /* of a leaf that names a kind */
    double value;                        /* of any other, SI; of a choice, its index */
    const fracas_attachment *attachment; /* of a file */
    size_t drawn; /* by a design: number of its point, from 1; 0: it is written */
    struct fracas_setting *next;
} fracas_setting;

/* What is set together; no leaf twice. */
typedef struct {
    fracas_setting *first;
} fracas_settings;

/* Converts the scalar `node` for `leaf`. Ranges, which may depend on the kind, are not checked
 * here. */
FRACAS_MUST_USE fracas_err fracas_setting_read(const fracas_file *file, const fracas_leaf *leaf,
                                               const fracas_node *node, fracas_setting *setting);

/* The whole number that the scalar `node` stands for, from `minimum` to `maximum`; `key` is how
 * messages call it. */
FRACAS_MUST_USE fracas_err fracas_setting_integer(const fracas_file *file, const char *key,
                                                  const fracas_node *node, int64_t minimum,
                                                  int64_t maximum, int64_t *value);

/* A name that may become a folder: letters, digits, '.', '_', '-', starting with a letter or digit.
 */
FRACAS_MUST_USE fracas_err fracas_setting_name(const fracas_file *file, const fracas_node *node,
                                               const char **name);

/* Adds a copy of `setting`; an error if its leaf is there already. */
FRACAS_MUST_USE fracas_err fracas_settings_add(const fracas_file *file,
                                               const fracas_setting *setting,
                                               fracas_settings *settings);

/* Adds every key of the map `node`, a section or a part of one. */
FRACAS_MUST_USE fracas_err fracas_settings_add_section(const fracas_file *file,
                                                       const fracas_file_section *section,
                                                       const fracas_node *node,
                                                       fracas_settings *settings);

/* NULL if the leaf is not set. */
const fracas_setting *fracas_settings_find(const fracas_settings *settings,
                                           const fracas_leaf *leaf);

/* FRACAS_USAGE unless the value lies in the range of `param`. */
FRACAS_MUST_USE fracas_err fracas_setting_check(const fracas_file *file,
                                                const fracas_setting *setting,
                                                const fracas_param *param);

/* The error that the key of `setting` does not belong to `kind`, which was chosen at `chosen`
 * (NULL: the default). */
FRACAS_MUST_USE fracas_err fracas_setting_misplaced(const fracas_file *file,
                                                    const fracas_setting *setting,
                                                    const fracas_kind *kind,
                                                    const fracas_setting *chosen);

/* The same where the kind would have the key, but not at points of this model. */
FRACAS_MUST_USE fracas_err fracas_setting_of_others(const fracas_file *file,
                                                    const fracas_setting *setting,
                                                    const fracas_param *param,
                                                    const fracas_kind *model,
                                                    const fracas_setting *chosen);

#endif
