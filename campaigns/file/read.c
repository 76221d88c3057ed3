/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From a file to a campaign. */
#include "campaigns/campaign.h"

#include "campaigns/file/cap.h"
#include "campaigns/file/chosen.h"
#include "campaigns/file/extent.h"
#include "campaigns/file/identity.h"
#include "campaigns/file/probes.h"
#include "campaigns/file/report_keys.h"
#include "campaigns/file/resolve.h"
#include "campaigns/file/sweep.h"
#include "campaigns/file/words.h"
#include "engine/integrator/frequencies.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

static const char *const own_keys[] = {"name",     "seed",   "random_numbers", "sweep",
                                       "replicas", "report", "probes"};

/* The contents of a file. */
typedef struct {
    fracas_file file;
    const char *text; /* its bytes, `size` of them; NULL: to be read */
    size_t size;
    fracas_settings base;
    fracas_sweep sweep;
    fracas_replicas replicas;              /* count 0: not given */
    bool doubtful[FRACAS_COUNT(own_keys)]; /* an unknown key may mean this one */
} reading;

/* ---- the top of the file ---- */

/* Doubts all that an unknown key may mean: the nearest, the leaf of its name; if it has a section
 * or nothing that can be read, any section that is not there; or the model. */
static void doubt_key(reading *read, const fracas_node *entry, const char *nearest)
{
    const fracas_file *file = &read->file;
    const fracas_catalog *catalog = file->catalog;
    const char *text = entry->key->text;
    for (size_t k = 0; nearest && k < FRACAS_COUNT(own_keys); k++)
        read->doubtful[k] = read->doubtful[k] || strcmp(own_keys[k], nearest) == 0;
    const bool any = !nearest && entry->type != FRACAS_SCALAR;
    for (size_t s = 0; s < catalog->nsections; s++) {
        const fracas_section *table = catalog->section[s].table;
        bool meant = (nearest && strcmp(table->name, nearest) == 0) ||
                     (any && !fracas_node_find(file->root, table->name));
        for (size_t k = 0; s == 0 && k < table->nkinds; k++)
            meant = meant || strcmp(table->kinds[k]->name, fracas_node_text(entry)) == 0;
        if (meant) fracas_file_doubt_section(file, &catalog->section[s], true);
    }
    for (size_t i = 0; i < catalog->nleaves; i++)
        if (strcmp(catalog->leaf[i].key, text) == 0 || strcmp(catalog->leaf[i].path, text) == 0)
            fracas_file_doubt(file, &catalog->leaf[i]);
    if (nearest && strcmp(nearest, "sweep") == 0) fracas_file_doubt_section(file, NULL, true);
}

/* The name of the section of a key such as `mesh {elements`; NULL: it is no such key. */
static const char *section_opened(const fracas_catalog *catalog, const char *key)
{
    const size_t length = strcspn(key, " {[");
    if (key[length + strspn(key + length, " ")] != '{') return NULL;
    for (size_t s = 0; s < catalog->nsections; s++) {
        const char *name = catalog->section[s].table->name;
        if (strlen(name) == length && strncmp(name, key, length) == 0) return name;
    }
    return NULL;
}

/* A section that follows another is written in its list. */
static fracas_err in_list(const fracas_file *file, const fracas_file_section *section,
                          const fracas_node *key)
{
    const fracas_section *first = section->table;
    while (first->follows) first = first->follows;
    fracas_file_doubt_section(file, section, true);
    return fracas_file_error(file, key,
                             "`%s` is no key at the top of the file: write `%s: [{...}, {...}]`, "
                             "whose items after the first are `%s_2` and so on in a sweep",
                             key->text, first->name, first->name);
}

static fracas_err check_section(reading *read, const fracas_node *entry)
{
    const fracas_file *file = &read->file;
    const fracas_catalog *catalog = file->catalog;
    const fracas_node *key = entry->key;
    fracas_words words;
    fracas_words_init(&words, key->text);
    for (size_t k = 0; k < FRACAS_COUNT(own_keys); k++) {
        if (strcmp(own_keys[k], key->text) == 0) return FRACAS_OK;
        fracas_words_add(&words, own_keys[k]);
    }
    const fracas_file_section *known = fracas_catalog_section(catalog, key->text);
    if (known && known->table->follows) return in_list(file, known, key);
    if (known) return FRACAS_OK;
    for (size_t s = 0; s < catalog->nsections; s++)
        if (!catalog->section[s].table->follows)
            fracas_words_add(&words, catalog->section[s].table->name);
    const char *opened = section_opened(catalog, key->text);
    doubt_key(read, entry, opened ? opened : words.nearest);
    if (opened)
        return fracas_file_error(file, key,
                                 "unknown key `%s` at the top of the file: a colon is missing; "
                                 "write `%s: {`",
                                 key->text, opened);
    if (entry->type == FRACAS_UNREADABLE) return fracas_file_untold(file);
    for (size_t i = 0; i < catalog->nleaves; i++) {
        const fracas_leaf *leaf = &catalog->leaf[i];
        if (strcmp(leaf->key, key->text) == 0 || strcmp(leaf->path, key->text) == 0)
            return fracas_file_error(
                file, key,
                "unknown key `%s` at the top of the file; write `%s:` indented below `%s:`",
                key->text, leaf->key, leaf->section->table->name);
    }
    return fracas_file_error(file, key, "unknown key `%s` at the top of the file%s", key->text,
                             fracas_words_hint(&words, "known are"));
}

static fracas_err read_seed(const fracas_file *file, const fracas_node *node, uint64_t *seed)
{
    const char *text = fracas_node_text(node);
    errno = 0;
    unsigned long long value = strtoull(text, NULL, 10);
    if (!*text || strspn(text, "0123456789") != strlen(text) || errno == ERANGE)
        return fracas_file_expected(file, node, "seed",
                                    "a whole number from 0 to 18446744073709551615, in digits");
    *seed = value;
    return FRACAS_OK;
}

static fracas_err read_random_numbers(const fracas_file *file, const fracas_node *node,
                                      bool *common)
{
    const char *text = fracas_node_text(node);
    *common = strcmp(text, "common") == 0;
    if (*common || strcmp(text, "independent") == 0) return FRACAS_OK;
    return fracas_file_expected(file, node, "random_numbers",
                                "independent (each point draws its own) or common (replica r "
                                "draws the same at every point)");
}

/* The entry `key`, which must exist. */
static fracas_err need(const reading *read, const char *key, const char *remedy,
                       const fracas_node **node)
{
    bool unknown = false;
    for (size_t k = 0; k < FRACAS_COUNT(own_keys); k++)
        unknown = unknown || (read->doubtful[k] && strcmp(own_keys[k], key) == 0);
    return fracas_file_need(&read->file, read->file.root, key, unknown, node,
                            "the file has no `%s`; %s", key, remedy);
}

static fracas_err read_heading(reading *read, fracas_campaign *campaign)
{
    const fracas_file *file = &read->file;
    const fracas_node *node;
    for (node = file->root->first; node; node = node->next)
        TRY(fracas_file_note(file, check_section(read, node)));
    TRY(fracas_file_note(
        file,
        need(read, "name",
             "give the campaign a name, which becomes its folder, as `name: bar-rates`", &node)));
    if (node) TRY(fracas_file_note(file, fracas_setting_name(file, node, &campaign->name)));
    TRY(fracas_file_note(
        file, need(read, "seed",
                   "give the seed of its random numbers, a whole number, as `seed: 1`", &node)));
    if (node) TRY(fracas_file_note(file, read_seed(file, node, &campaign->seed)));
    node = fracas_node_find(file->root, "random_numbers");
    if (node)
        TRY(fracas_file_note(file,
                             read_random_numbers(file, node, &campaign->common_random_numbers)));
    node = fracas_node_find(file->root, "replicas");
    if (node) TRY(fracas_file_note(file, fracas_replicas_read(file, node, &read->replicas)));
    node = fracas_node_find(file->root, "probes");
    if (node)
        TRY(fracas_file_note(file, fracas_campaign_probes_read(file, node, &campaign->probes)));
    node = fracas_node_find(file->root, "report");
    if (node) TRY(fracas_file_note(file, fracas_report_keys_read(file, node, &campaign->report)));
    return FRACAS_OK;
}

static fracas_err read_sections(reading *read)
{
    const fracas_file *file = &read->file;
    for (const fracas_node *node = file->root->first; node; node = node->next) {
        const fracas_file_section *section = fracas_catalog_section(file->catalog, node->key->text);
        if (!section || section->table->follows) continue;
        const fracas_leaf *leaf = fracas_catalog_leaf(file->catalog, node->key->text);
        TRY(leaf ? fracas_settings_read(file, leaf, node, &read->base)
                 : fracas_settings_add_section(file, section, node, &read->base));
    }
    return FRACAS_OK;
}

/* ---- points ---- */

static void fill_slots(const fracas_file *file, const fracas_setting *settings,
                       const fracas_setting **slots)
{
    for (const fracas_setting *s = settings; s; s = s->next)
        slots[s->leaf - file->catalog->leaf] = s;
}

/* Replicas of a point: those of its case, else of the campaign. */
static fracas_err count_replicas(const reading *read, size_t index, fracas_point *point)
{
    fracas_replicas replicas = read->replicas;
    bool owned = false;
    for (size_t a = 0; a < read->sweep.naxes; a++) {
        const fracas_choice *choice = fracas_sweep_choice(&read->sweep, index, a);
        if (choice->replicas.count > 0 && owned)
            return fracas_file_error(&read->file, choice->node,
                                     "cases of two axes give `replicas`; keep them in one axis");
        if (choice->replicas.count > 0) replicas = choice->replicas;
        owned = owned || choice->replicas.count > 0;
    }
    point->replicas = replicas.count;
    point->rule = replicas.rule;
    const fracas_node *none;
    if (point->replicas > 0) return FRACAS_OK;
    return need(read, "replicas", "say how many realizations each point gets, as `replicas: 32`",
                &none);
}

static fracas_err make_point(const reading *read, fracas_draft *draft, size_t index,
                             fracas_point *point)
{
    const fracas_catalog *catalog = read->file.catalog;
    for (size_t i = 0; i < catalog->nleaves; i++) draft->swept[i] = NULL;
    for (size_t a = 0; a < read->sweep.naxes; a++)
        fill_slots(&read->file, fracas_sweep_choice(&read->sweep, index, a)->settings,
                   draft->swept);
    for (size_t s = 0; s < catalog->nsections; s++)
        if (catalog->section[s].table->hashed)
            TRY(fracas_file_note(&read->file, fracas_draft_resolve(&read->file, draft,
                                                                   &catalog->section[s], point)));
    return fracas_file_note(&read->file, count_replicas(read, index, point));
}

/* Gives a point its time.end where its rule needs none and the file has none. */
static fracas_err end_point(const reading *read, fracas_known_extent *known, fracas_point *point)
{
    const fracas_file *file = &read->file;
    const fracas_node *time = fracas_node_find(file->root, "time");
    const double rate = fracas_spec_strain_rate(&point->spec);
    if (!isnan(point->spec.time.end)) return FRACAS_OK;
    fracas_err err = fracas_extent_find(point, known);
    if (err) return err == FRACAS_USAGE ? fracas_file_error_within(file, file->root, "mesh") : err;
    if (!point->strength.factor) point->spec.time.end = fracas_point_cap(point, known->extent);
    if (!isnan(point->spec.time.end)) return FRACAS_OK;
    return fracas_file_error(file, time ? time->key : file->root,
                             "time with stop %s needs `end` here, when it ends at the latest: %s",
                             point->spec.time.stop->name,
                             !(fabs(rate) > 0)        ? "the load has no strain rate at the start"
                             : point->strength.factor ? "none is reckoned with strength.factor"
                                                      : "these strengths have no mean");
}

static fracas_err end_points(const reading *read, fracas_campaign *campaign)
{
    fracas_known_extent known = {0};
    for (size_t p = 0; p < campaign->npoints && fracas_file_noted(&read->file) == 0; p++) {
        fracas_faults_point(read->file.faults, p);
        TRY(fracas_file_note(&read->file, end_point(read, &known, &campaign->point[p])));
    }
    return FRACAS_OK;
}

static fracas_err make_points(reading *read, fracas_campaign *campaign)
{
    const fracas_file *file = &read->file;
    const fracas_catalog *catalog = file->catalog;
    fracas_draft draft = {fracas_memory_take(file->memory, catalog->nleaves, sizeof *draft.base),
                          fracas_memory_take(file->memory, catalog->nleaves, sizeof *draft.swept)};
    campaign->npoints = read->sweep.npoints;
    campaign->point = fracas_memory_take(file->memory, campaign->npoints, sizeof *campaign->point);
    if (!draft.base || !draft.swept || !campaign->point)
        return fracas_no_memory("the points of the campaign");
    fill_slots(file, read->base, draft.base);
    TRY(fracas_draft_check_base(file, &draft));
    for (size_t s = 0; s < catalog->nsections; s++)
        if (!catalog->section[s].table->hashed)
            TRY(fracas_file_note(
                file, fracas_draft_resolve(file, &draft, &catalog->section[s], campaign)));
    for (size_t p = 0; p < campaign->npoints; p++) {
        fracas_faults_point(file->faults, p);
        TRY(make_point(read, &draft, p, &campaign->point[p]));
    }
    TRY(fracas_draft_check_models(file, &draft, campaign));
    return end_points(read, campaign);
}

/* Names of a point's cases, joined by '/'; "" if none has a name. */
static fracas_err name_case(const reading *read, size_t index, const char **name)
{
    *name = "";
    for (size_t a = 0; a < read->sweep.naxes; a++) {
        const char *part = fracas_sweep_choice(&read->sweep, index, a)->name;
        if (!part) continue;
        size_t length = strlen(*name);
        char *joined = fracas_memory_take(read->file.memory, length + 1 + strlen(part) + 1, 1);
        if (!joined) return fracas_no_memory("the names of the cases");
        memcpy(joined, *name, length);
        if (length > 0) joined[length++] = '/';
        memcpy(joined + length, part, strlen(part));
        *name = joined;
    }
    if (strlen(*name) <= FRACAS_LONGEST_TEXT) return FRACAS_OK;
    return fracas_file_error(&read->file, fracas_node_find(read->file.root, "sweep"),
                             "point %zu is named %.40s..., by its cases together, with %zu "
                             "letters; at most are %d: give them shorter names",
                             index, *name, strlen(*name), FRACAS_LONGEST_TEXT);
}

static fracas_err repeated(const reading *read, size_t earlier, size_t later)
{
    const fracas_node *here = read->file.root, *there = read->file.root;
    for (size_t a = read->sweep.naxes; a-- > 0;) {
        const fracas_choice *now = fracas_sweep_choice(&read->sweep, later, a);
        const fracas_choice *before = fracas_sweep_choice(&read->sweep, earlier, a);
        if (now == before) continue;
        here = now->node;
        there = before->node;
    }
    if (here == there)
        return fracas_file_error(
            &read->file, here,
            "points %zu and %zu of the sweep have the same values, as a design of "
            "whole numbers has few to choose from; give it fewer points, or a "
            "parameter that is not a whole number",
            earlier + 1, later + 1);
    return fracas_file_error(
        &read->file, here,
        "points %zu and %zu of the sweep have the same values (compare line %d, "
        "column %d); remove one, and raise `replicas` for more realizations",
        earlier + 1, later + 1, there->line, there->column);
}

static int by_hash(const void *a, const void *b)
{
    const fracas_point *x = *(const fracas_point *const *)a, *y = *(const fracas_point *const *)b;
    const int order = memcmp(x->hash.byte, y->hash.byte, sizeof x->hash.byte);
    return order ? order : (x > y) - (x < y);
}

/* Refuses two points of equal hash: the first two, in plan order of the later one. */
static fracas_err check_repeated(const reading *read, const fracas_campaign *campaign)
{
    const fracas_point *earlier = NULL, *later = NULL;
    OWNED const fracas_point **sorted = malloc(campaign->npoints * sizeof *sorted);
    if (!sorted) return fracas_no_memory("the points of the campaign");
    for (size_t p = 0; p < campaign->npoints; p++) sorted[p] = &campaign->point[p];
    qsort(sorted, campaign->npoints, sizeof *sorted, by_hash);
    for (size_t i = 1; i < campaign->npoints; i++) {
        if (!fracas_hash_equal(&sorted[i]->hash, &sorted[i - 1]->hash)) continue;
        if (later && sorted[i] > later) continue;
        earlier = sorted[i - 1];
        later = sorted[i];
    }
    if (!later) return FRACAS_OK;
    return repeated(read, (size_t)(earlier - campaign->point), (size_t)(later - campaign->point));
}

static fracas_err identify(reading *read, fracas_campaign *campaign)
{
    const char **name = fracas_memory_take(read->file.memory, campaign->npoints, sizeof *name);
    if (!name) return fracas_no_memory("the names of the cases");
    for (size_t p = 0; p < campaign->npoints; p++) TRY(name_case(read, p, &name[p]));
    for (size_t p = 0; p < campaign->npoints; p++)
        TRY(fracas_point_identify(read->file.catalog, &campaign->point[p]));
    TRY(check_repeated(read, campaign));
    fracas_err err = fracas_campaign_tabulate(read->file.catalog, name, campaign);
    if (err)
        return err == FRACAS_USAGE ? fracas_file_error_within(&read->file, read->file.root, "mesh")
                                   : err;
    TRY(fracas_report_keys_check(&read->file, &campaign->report, &campaign->table));
    TRY(fracas_file_note(&read->file, fracas_fields_check(&read->file, campaign)));
    return fracas_campaign_identify(read->file.catalog, campaign);
}

/* ---- the whole file ---- */

static fracas_err read_file(reading *read, fracas_campaign *campaign)
{
    fracas_file *file = &read->file;
    fracas_node *root;
    TRY(fracas_catalog_make(file->memory, &file->catalog));
    file->doubtful = fracas_memory_take(file->memory, file->catalog->nleaves,
                                        sizeof *file->doubtful);
    if (!file->doubtful) return fracas_no_memory("the campaign");
    TRY(read->text ? fracas_node_parse(file->name, read->text, read->size, file->memory,
                                       file->faults, &root)
                   : fracas_node_read(file->name, file->memory, file->faults, &root));
    file->root = root;
    TRY(read_heading(read, campaign));
    TRY(read_sections(read));
    TRY(fracas_sweep_read(file, fracas_node_find(root, "sweep"), &read->sweep));
    TRY(make_points(read, campaign));
    return fracas_file_noted(file) ? FRACAS_OK : identify(read, campaign);
}

/* `text` NULL: of the file `path`; `copy` NULL: the files that it names are read. */
static fracas_err make(const fracas_units *units, const char *path, const char *text, size_t size,
                       const fracas_campaign_copy *copy, fracas_campaign **campaign)
{
    OWN(fracas_campaign) made = calloc(1, sizeof *made);
    if (!made || !(made->memory = fracas_memory_create())) return fracas_no_memory("the campaign");
    TRY(fracas_frequencies_create(&made->frequencies));
    reading read = {.file = {.name = path,
                             .memory = made->memory,
                             .units = units,
                             .campaign = made,
                             .copy = copy},
                    .text = text,
                    .size = size};
    read.file.faults = fracas_faults_create(made->memory);
    if (!read.file.faults) return fracas_no_memory("the campaign");
    TRY(fracas_faults_note(read.file.faults, read_file(&read, made)));
    TRY(fracas_faults_report(read.file.faults, path));
    *campaign = made;
    made = NULL;
    return FRACAS_OK;
}

fracas_err fracas_campaign_read_with(const fracas_units *units, const char *path,
                                     fracas_campaign **campaign)
{
    return make(units, path, NULL, 0, NULL, campaign);
}

fracas_err fracas_campaign_read(const char *path, fracas_campaign **campaign)
{
    OWN(fracas_units) units = NULL;
    TRY(fracas_units_create(&units));
    return make(units, path, NULL, 0, NULL, campaign);
}

fracas_err fracas_campaign_read_text(const char *text, size_t size, const char *name,
                                     fracas_campaign **campaign)
{
    OWN(fracas_units) units = NULL;
    TRY(fracas_units_create(&units));
    return make(units, name, text, size, NULL, campaign);
}

fracas_err fracas_campaign_copy_read(const fracas_campaign_copy *copy, const char *name,
                                     fracas_campaign **campaign)
{
    OWN(fracas_units) units = NULL;
    TRY(fracas_units_create(&units));
    return make(units, name, copy->text, copy->size, copy, campaign);
}
