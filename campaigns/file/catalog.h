/* SPDX-License-Identifier: GPL-3.0-or-later */
/* All keys of a campaign file, from the parameter tables of the engine, the sampler and the output.
 */
#ifndef FRACAS_CAMPAIGNS_FILE_CATALOG_H
#define FRACAS_CAMPAIGNS_FILE_CATALOG_H

#include "base/param.h"
#include "campaigns/campaign.h"
#include "campaigns/file/memory.h"

/* A section and the struct of its values. A hashed section belongs to a fracas_point, any other to
 * the fracas_campaign: its owner. */
typedef struct {
    const fracas_section *table;
    size_t offset; /* to the section's struct in its owner */
} fracas_file_section;

/* A scalar or enum of a file. Kinds of one section with a common key (`minimum`) share its leaf:
 * type and unit are equal, range and default may differ. */
typedef struct {
    const fracas_file_section *section;
    const char *path;          /* dotted; for a section of a kind alone (`model`), its name */
    const char *key;           /* in its section */
    const fracas_param *param; /* the first kind's; NULL: names the section's kind */
} fracas_leaf;

typedef struct {
    size_t nsections;
    const fracas_file_section *section; /* in file order; `model` first: it limits others' kinds */
    size_t nleaves;
    const fracas_leaf *leaf; /* sorted by path */
} fracas_catalog;

/* The catalog belongs to `memory`. */
FRACAS_MUST_USE fracas_err fracas_catalog_make(fracas_campaign_memory *memory,
                                               const fracas_catalog **catalog);

/* The section that follows this one in a list; NULL: none does. */
const fracas_file_section *fracas_catalog_next(const fracas_catalog *catalog,
                                               const fracas_file_section *section);

/* NULL if the name is unknown. `key` NULL: the leaf with the name of the section's kind. */
const fracas_file_section *fracas_catalog_section(const fracas_catalog *catalog, const char *name);
const fracas_leaf *fracas_catalog_leaf(const fracas_catalog *catalog, const char *path);
const fracas_leaf *fracas_catalog_key(const fracas_catalog *catalog,
                                      const fracas_file_section *section, const char *key);

/* The key whose value names the kind. */
static inline const char *fracas_section_selector(const fracas_section *section)
{
    return section->selector ? section->selector : section->name;
}

/* The parameter `key` of a section of this kind (NULL: no kinds) at points of this model (NULL: any
 * model); NULL if there is none. */
const fracas_param *fracas_section_param(const fracas_section *section, const fracas_kind *kind,
                                         const fracas_kind *model, const char *key);
/* True if all points of this model have the parameter: in the section's own table, or in those of
 * all kinds for the model. */
bool fracas_section_common(const fracas_section *section, const fracas_kind *model,
                           const char *key);

/* The section's struct within its owner. */
void *fracas_section_at(const fracas_file_section *section, void *owner);
/* The section's kind in its owner; NULL without kinds, and for an item absent from its list. */
const fracas_kind *fracas_section_kind(const fracas_file_section *section, const void *owner);

/* Choices of the leaf's key, of all kinds of its section together; returns their number. */
enum { FRACAS_MOST_CHOICES = 32 };
size_t fracas_leaf_choices(const fracas_leaf *leaf, const fracas_kind *choice[FRACAS_MOST_CHOICES]);

/* True for a leaf of text: a kind's name, a choice, an attachment. */
bool fracas_leaf_is_text(const fracas_leaf *leaf);

/* The leaf's value in its owner; false if the owner's kind or model has no such value. */
bool fracas_leaf_get(const fracas_leaf *leaf, const void *owner, fracas_value *value);

#define FRACAS_LEAF_TEXT 64 /* bytes for fracas_leaf_write: a kind's name is shorter */
/* The value as text for the hash: its text, true or false, or a number as "%.15g". */
void fracas_leaf_write(const fracas_leaf *leaf, const fracas_value *value,
                       char text[FRACAS_LEAF_TEXT]);

#endif
