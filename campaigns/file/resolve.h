/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From settings to the values of a point: kinds, defaults, missing and misplaced values. */
#ifndef FRACAS_CAMPAIGNS_FILE_RESOLVE_H
#define FRACAS_CAMPAIGNS_FILE_RESOLVE_H

#include "campaigns/file/setting.h"

/* One setting (or NULL) for each leaf of the catalog. */
typedef struct {
    const fracas_setting **base;  /* from the sections of the file */
    const fracas_setting **swept; /* from the sweep, for this point */
} fracas_draft;

/* Checks the sections of the file, also values replaced at every point: each key belongs to its
 * section's kind, each value is in its range. The models of the points are not known yet. Here and
 * below errors are noted; what they leave unknown, as a section of an unknown kind, is not judged.
 */
FRACAS_MUST_USE fracas_err fracas_draft_check_base(const fracas_file *file,
                                                   const fracas_draft *draft);

/* Fills the section in its owner: the swept value, else the base's, else the default. It drops base
 * keys of another kind, if the sweep changes the kind, and of other models. */
FRACAS_MUST_USE fracas_err fracas_draft_resolve(const fracas_file *file, const fracas_draft *draft,
                                                const fracas_file_section *section, void *owner);

/* Notes base settings for models without a point in the campaign. `draft`: of the last point. */
FRACAS_MUST_USE fracas_err fracas_draft_check_models(const fracas_file *file,
                                                     const fracas_draft *draft,
                                                     const fracas_campaign *campaign);

#endif
