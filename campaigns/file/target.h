/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Target of a path of the sweep: one value of a point, or a section of values. */
#ifndef FRACAS_CAMPAIGNS_FILE_TARGET_H
#define FRACAS_CAMPAIGNS_FILE_TARGET_H

#include "campaigns/file/setting.h"

typedef struct {
    const fracas_file_section *section; /* a whole section ... */
    const fracas_leaf *leaf;            /* ... or one leaf */
} fracas_target;

/* Finds the target of the path in `key`, a part of a point. `also`: other words allowed in its
 * place, a list up to NULL. */
FRACAS_MUST_USE fracas_err fracas_target_find(const fracas_file *file, const fracas_node *key,
                                              const char *const *also, fracas_target *found);

#endif
