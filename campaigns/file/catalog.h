/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Everything a campaign file can say, gathered from the parameter tables of the engine, the sampler
 * and the output. */
#ifndef FRACAS_CAMPAIGNS_FILE_CATALOG_H
#define FRACAS_CAMPAIGNS_FILE_CATALOG_H

#include "base/param.h"
#include "campaigns/campaign.h"
#include "campaigns/file/memory.h"

/* A section and the struct that holds its values. A hashed section is part of a point: its owner is
 * a fracas_point; the owner of any other is the campaign's fracas_output. */
typedef struct {
    const fracas_section *table;
    size_t offset; /* of the section's struct in its owner */
} fracas_file_section;

/* A scalar or enum that a file can set. Kinds of one section that have a key in common (`minimum`)
 * share its leaf: type and unit are the same, range and default may differ. */
typedef struct {
    const fracas_file_section *section;
    const char *path; /* dotted; for a section that is a kind and no more (`model`), its name */
    const char *key;  /* in its section */
    const fracas_param
        *param; /* NULL: names the section's kind. Of several kinds, the first one's */
} fracas_leaf;

typedef struct {
    size_t nsections;
    const fracas_file_section *section; /* in the order of a written file; the first, `model`,
                                           restricts the kinds of others */
    size_t nleaves;
    const fracas_leaf *leaf; /* sorted by path */
} fracas_catalog;

/* The catalog belongs to `memory`. */
FRACAS_MUST_USE fracas_err fracas_catalog_make(fracas_campaign_memory *memory,
                                               const fracas_catalog **catalog);

/* NULL if there is none of that name. */
const fracas_file_section *fracas_catalog_section(const fracas_catalog *catalog, const char *name);
const fracas_leaf *fracas_catalog_leaf(const fracas_catalog *catalog, const char *path);
const fracas_leaf *fracas_catalog_key(const fracas_catalog *catalog,
                                      const fracas_file_section *section, const char *key);
/* The leaf that names the section's kind; NULL for a section without kinds. */
const fracas_leaf *fracas_catalog_selector(const fracas_catalog *catalog,
                                           const fracas_file_section *section);

/* The parameter `key` of a section of this kind (NULL: no kinds) at points of this model (NULL: of
 * whichever model has it); NULL if there is none. */
const fracas_param *fracas_section_param(const fracas_section *section, const fracas_kind *kind,
                                         const fracas_kind *model, const char *key);
/* True if points of this model have the parameter whatever the kind, be it in the section's own
 * table or in those of all kinds that go with the model. */
bool fracas_section_common(const fracas_section *section, const fracas_kind *model,
                           const char *key);

/* The section's struct within its owner. */
void *fracas_section_at(const fracas_file_section *section, void *owner);
/* The kind that the section has in its owner; NULL without kinds. */
const fracas_kind *fracas_section_kind(const fracas_file_section *section, const void *owner);

/* True for a leaf whose values are text: a kind's name, a choice, an attachment. */
bool fracas_leaf_is_text(const fracas_leaf *leaf);

/* The leaf's value in its owner; false if the owner's kind or model has no such value. */
bool fracas_leaf_get(const fracas_leaf *leaf, const void *owner, fracas_value *value);

#define FRACAS_LEAF_TEXT 64 /* bytes that fracas_leaf_write needs: a kind's name is shorter */
/* The value as it is hashed: its text, true or false, or a number as "%.15g". */
void fracas_leaf_write(const fracas_leaf *leaf, const fracas_value *value,
                       char text[FRACAS_LEAF_TEXT]);

#endif
