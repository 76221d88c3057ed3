/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From what the file sets to the values of a point: kinds, defaults, missing and misplaced values.
 */
#ifndef FRACAS_CAMPAIGNS_FILE_RESOLVE_H
#define FRACAS_CAMPAIGNS_FILE_RESOLVE_H

#include "campaigns/file/setting.h"

/* One setting (or NULL) for each leaf of the catalog. */
typedef struct {
    const fracas_setting **base;  /* what the sections of the file set */
    const fracas_setting **swept; /* what the sweep sets for this point */
} fracas_draft;

/* Checks the sections of the file as they stand, also values that every point replaces: each key
 * belongs to its section's kind, each value is in its range. Which models the points are of is not
 * known yet. */
FRACAS_MUST_USE fracas_err fracas_draft_check_base(const fracas_file *file,
                                                   const fracas_draft *draft);

/* Fills the section in its owner: the swept value, else the base's, else the default. Where the
 * sweep has changed the kind, the base's keys of the old kind are dropped; so are, at every point,
 * those that its model has not. */
FRACAS_MUST_USE fracas_err fracas_draft_resolve(const fracas_file *file, const fracas_draft *draft,
                                                const fracas_file_section *section, void *owner);

/* Refuses what the sections of the file set for models that no point of the campaign is of.
 * `draft`: of the last point. */
FRACAS_MUST_USE fracas_err fracas_draft_check_models(const fracas_file *file,
                                                     const fracas_draft *draft,
                                                     const fracas_campaign *campaign);

#endif
