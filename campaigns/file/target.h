/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a path of the sweep names: one value of a point, or a section of them. */
#ifndef FRACAS_CAMPAIGNS_FILE_TARGET_H
#define FRACAS_CAMPAIGNS_FILE_TARGET_H

#include "campaigns/file/setting.h"

typedef struct {
    const fracas_file_section *section; /* a whole section ... */
    const fracas_leaf *leaf;            /* ... or one leaf */
} fracas_target;

/* Finds what the path in `key` names, which must be part of a point. `also`: words that could stand
 * in its place, up to a NULL. */
FRACAS_MUST_USE fracas_err fracas_target_find(const fracas_file *file, const fracas_node *key,
                                              const char *const *also, fracas_target *found);

#endif
