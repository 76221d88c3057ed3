/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Settings of a campaign file: one value of one leaf, converted and checked by its own table. */
#ifndef FRACAS_CAMPAIGNS_FILE_SETTING_H
#define FRACAS_CAMPAIGNS_FILE_SETTING_H

#include "campaigns/file/file.h"

typedef struct fracas_setting {
    const fracas_leaf *leaf;
    const fracas_node *node; /* its place */
    const fracas_kind *kind; /* for the name of a kind, and for a choice */
    double value;            /* for any other leaf, SI */
    const char *expression;  /* gives the value from other keys; NULL: it is known */
    const void *object;      /* for a file or a list, which the campaign owns */
    bool wrong;              /* an error tells of it: its value is not known */
    size_t drawn;            /* number of the design's point, from 1; 0: not drawn */
    struct fracas_setting *next;
} fracas_setting;

/* Settings of the same point, no leaf twice; NULL: none. */
typedef fracas_setting *fracas_settings;

/* Converts the scalar `node` for `leaf`, or keeps its expression. Does not check ranges, which may
 * depend on the kind. */
FRACAS_MUST_USE fracas_err fracas_setting_read(const fracas_file *file, const fracas_leaf *leaf,
                                               const fracas_node *node, fracas_setting *setting);

/* The same for a place where no expression can stand. */
FRACAS_MUST_USE fracas_err fracas_setting_read_known(const fracas_file *file,
                                                     const fracas_leaf *leaf,
                                                     const fracas_node *node,
                                                     fracas_setting *setting);

/* The scalar `node` as a whole number from `minimum` to `maximum`; `key` is its name in messages.
 */
FRACAS_MUST_USE fracas_err fracas_setting_integer(const fracas_file *file, const char *key,
                                                  const fracas_node *node, int64_t minimum,
                                                  int64_t maximum, int64_t *value);

/* The one of `count` kinds with the name in `node`, the value of `key`. */
FRACAS_MUST_USE fracas_err fracas_setting_kind(const fracas_file *file, const char *key,
                                               const fracas_node *node,
                                               const fracas_kind *const *kinds, size_t count,
                                               const fracas_kind **kind);

/* A name fit for a folder: letters, digits, '.', '_', '-', starting with a letter or digit. */
FRACAS_MUST_USE fracas_err fracas_setting_name(const fracas_file *file, const fracas_node *node,
                                               const char **name);

/* The name of a case: one such name, or several joined by '/'. */
FRACAS_MUST_USE fracas_err fracas_setting_case_name(const fracas_file *file,
                                                    const fracas_node *node, const char **name);

/* Adds a copy of `setting`. FRACAS_USAGE if its leaf is set already. */
FRACAS_MUST_USE fracas_err fracas_settings_add(const fracas_file *file,
                                               const fracas_setting *setting,
                                               fracas_settings *settings);

/* Adds what `node` says of the leaf. An error is noted, and the setting wrong. */
FRACAS_MUST_USE fracas_err fracas_settings_read(const fracas_file *file, const fracas_leaf *leaf,
                                                const fracas_node *node, fracas_settings *settings);

/* Adds wrong settings at `node` for the leaf, or for all of `section`, which have none there. */
FRACAS_MUST_USE fracas_err fracas_settings_doubt(const fracas_file *file,
                                                 const fracas_file_section *section,
                                                 const fracas_leaf *leaf, const fracas_node *node,
                                                 fracas_settings *settings);

/* Adds every key of the map `node`, a section or a part of one. Errors are noted. */
FRACAS_MUST_USE fracas_err fracas_settings_add_section(const fracas_file *file,
                                                       const fracas_file_section *section,
                                                       const fracas_node *node,
                                                       fracas_settings *settings);

/* Products of three values that are not 0 are numbers, too, if each lies within this and its
 * inverse.
 */
#define FRACAS_GREATEST 1e100
bool fracas_setting_computable(double value);

/* The number for fracas_param_set: of a choice its index, NaN where `param` has it not. */
double fracas_setting_number(const fracas_setting *setting, const fracas_param *param);

/* FRACAS_USAGE unless the value lies in the range or among the choices of `param`, and can be
 * computed with. */
FRACAS_MUST_USE fracas_err fracas_setting_check(const fracas_file *file,
                                                const fracas_setting *setting,
                                                const fracas_param *param);

#endif
