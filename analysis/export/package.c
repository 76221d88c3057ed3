/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A study as a Frictionless Data Package: its tables as CSV, and datapackage.json, their schema. */
#include "analysis/export/csv.h"
#include "analysis/data/output.h"
#include "analysis/export/sha256.h"

#include "base/file.h"
#include "base/json.h"
#include "base/own.h"
#include "campaigns/store/file/disk.h"

#include <errno.h>
#include <inttypes.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char package_file[] = "datapackage.json";

static void put_field(void *context, const fracas_field *field)
{
    static const char *const type[] = {
        [FRACAS_FIELD_INTEGER] = "integer", [FRACAS_FIELD_INDEX] = "integer",
        [FRACAS_FIELD_NUMBER] = "number",   [FRACAS_FIELD_TEXT] = "string",
        [FRACAS_FIELD_CHARS] = "string",
    };
    fracas_json *json = context;
    fracas_json_object(json, NULL);
    fracas_json_text(json, "name", field->key);
    fracas_json_text(json, "type", type[field->type]);
    if (*field->unit) fracas_json_text(json, "unit", field->unit);
    fracas_json_text(json, "description", field->doc);
    if (field->outcome) {
        fracas_json_object(json, "constraints");
        fracas_json_array(json, "enum");
        for (int o = 0; o < FRACAS_NOUTCOMES; o++)
            fracas_json_text(json, NULL, fracas_outcome_name(o));
        fracas_json_close(json);
        fracas_json_close(json);
    }
    fracas_json_close(json);
}

static void put_key(fracas_json *json, const char *name, const char *const *key)
{
    fracas_json_array(json, name);
    for (size_t i = 0; i < FRACAS_TABLE_KEY && key[i]; i++) fracas_json_text(json, NULL, key[i]);
    fracas_json_close(json);
}

static void put_schema(fracas_json *json, const fracas_csv_table *table,
                       const fracas_analysis *analysis)
{
    fracas_json_object(json, "schema");
    fracas_json_array(json, "fields");
    fracas_csv_fields(table, analysis, put_field, json);
    fracas_json_close(json);
    fracas_json_array(json, "missingValues");
    fracas_json_text(json, NULL, "");
    fracas_json_close(json);
    put_key(json, "primaryKey", table->key);
    if (table->parent) {
        fracas_json_array(json, "foreignKeys");
        fracas_json_object(json, NULL);
        put_key(json, "fields", table->parent->key);
        fracas_json_object(json, "reference");
        fracas_json_text(json, "resource", table->parent->name);
        put_key(json, "fields", table->parent->key);
        fracas_json_close(json);
        fracas_json_close(json);
        fracas_json_close(json);
    }
    fracas_json_close(json);
}

static fracas_err put_resource(fracas_json *json, const fracas_csv_table *table,
                               const fracas_analysis *analysis, const char *folder)
{
    char name[64], digest[FRACAS_SHA256_HEX], hash[FRACAS_SHA256_HEX + 8];
    OWNED char *path = NULL;
    uint64_t bytes;
    FRACAS_PRINT(name, "%s.csv", table->name);
    TRY(fracas_disk_join(folder, name, &path));
    TRY(fracas_sha256_of_file(path, digest, &bytes));
    FRACAS_PRINT(hash, "sha256:%s", digest);
    fracas_json_object(json, NULL);
    fracas_json_text(json, "profile", "tabular-data-resource");
    fracas_json_text(json, "name", table->name);
    fracas_json_text(json, "path", name);
    fracas_json_text(json, "description", table->doc);
    fracas_json_text(json, "format", "csv");
    fracas_json_text(json, "mediatype", "text/csv");
    fracas_json_text(json, "encoding", "utf-8");
    fracas_json_integer(json, "bytes", (int64_t)bytes);
    fracas_json_text(json, "hash", hash);
    put_schema(json, table, analysis);
    fracas_json_close(json);
    return FRACAS_OK;
}

/* Where the numbers come from. Nothing of the folder, the host or the time of day: equal studies
 * have equal packages. */
static void put_source(fracas_json *json, const fracas_analysis *analysis)
{
    char text[192], seed[24];
    const fracas_hash_text hash = fracas_hash_hex(&analysis->header.campaign);
    FRACAS_PRINT(seed, "%" PRIu64, analysis->header.seed);
    FRACAS_PRINT(text, "fracas-%s", hash.text);
    fracas_json_text(json, "profile", "tabular-data-package");
    fracas_json_text(json, "name", text);
    fracas_json_text(json, "title", "Fragments of a campaign of fracas");
    fracas_json_text(
        json, "description",
        "Numbers in SI units to 15 digits; an empty field is a number that does not exist.");
    fracas_json_array(json, "sources");
    fracas_json_object(json, NULL);
    FRACAS_PRINT(text, "study.h5 of fracas %s: campaign %s, seed %s", analysis->header.version,
                 hash.text, seed);
    fracas_json_text(json, "title", text);
    fracas_json_close(json);
    fracas_json_close(json);
    fracas_json_text(json, "campaign", hash.text);
    fracas_json_text(json, "seed", seed); /* text: of 64 bits */
    fracas_json_text(json, "program_version", analysis->header.version);
    fracas_json_boolean(json, "complete", analysis->header.complete);
}

static fracas_err put_package(const fracas_analysis *analysis, const fracas_csv_table *const *table,
                              const char *folder, FILE *out)
{
    fracas_json json;
    fracas_json_begin(&json, out);
    put_source(&json, analysis);
    fracas_json_array(&json, "resources");
    for (; *table; table++) TRY(put_resource(&json, *table, analysis, folder));
    fracas_json_end(&json);
    return FRACAS_OK;
}

/* Tables of some packages alone. */
enum { SOMETIMES = 5 };
static const fracas_csv_table *const sometimes[SOMETIMES] = {
    &fracas_csv_table_probes, &fracas_csv_table_reactions, &fracas_csv_table_histories,
    &fracas_csv_table_cracks, &fracas_csv_table_breaks};

static fracas_err remove_file(const char *folder, const char *name)
{
    OWNED char *path = NULL;
    TRY(fracas_disk_join(folder, name, &path));
    if (!unlink(path) || errno == ENOENT) return FRACAS_OK;
    return fracas_fail_system(errno, "cannot replace %s", path);
}

/* Whether the package of the folder names each of these tables; a file without its name there is
 * somebody else's, unless a package was begun and cut off. */
static fracas_err find_named(const char *folder, bool named[SOMETIMES])
{
    OWNED char *path = NULL;
    OWNED char *line = NULL;
    size_t room = 0;
    const bool begun = fracas_output_begun(folder, package_file);
    for (size_t i = 0; i < SOMETIMES; i++) named[i] = begun;
    TRY(fracas_disk_join(folder, package_file, &path));
    OWN(FILE) in = fracas_file_stream(fracas_file_open(path), "r");
    while (in && getline(&line, &room, in) >= 0)
        for (size_t i = 0; i < SOMETIMES; i++) {
            char name[64];
            FRACAS_PRINT(name, "\"path\": \"%s.csv\"", sometimes[i]->name);
            named[i] = named[i] || strstr(line, name);
        }
    return FRACAS_OK;
}

/* Removes the files of an earlier package: the new one must not name them, and its histories and
 * probes are others. */
static fracas_err remove_package(const char *folder, const bool named[SOMETIMES])
{
    TRY(remove_file(folder, package_file));
    for (size_t i = 0; i < SOMETIMES; i++) {
        char name[64];
        FRACAS_PRINT(name, "%s.csv", sometimes[i]->name);
        if (named[i]) TRY(remove_file(folder, name));
    }
    return FRACAS_OK;
}

enum { ALWAYS = 6, TABLES = ALWAYS + SOMETIMES };

/* The tables of an export, up to a NULL. */
static void choose_tables(const fracas_analysis *analysis, fracas_export_more more,
                          const fracas_csv_table *table[TABLES + 1])
{
    const fracas_csv_table *const all[ALWAYS] = {
        &fracas_csv_table_points,    &fracas_csv_table_realizations,
        &fracas_csv_table_fragments, &fracas_csv_table_statistics,
        &fracas_csv_table_energies,  &fracas_csv_table_convergence};
    size_t count = 0;
    while (count < ALWAYS) table[count] = all[count], count++;
    const bool has[SOMETIMES] = {analysis->header.probes.count > 0, analysis->header.reactions,
                                 more.histories, more.cracks, more.cracks};
    for (size_t i = 0; i < SOMETIMES; i++)
        if (has[i]) table[count++] = sometimes[i];
    table[count] = NULL;
}

/* FRACAS_USAGE for a file of such a table that is of no package. */
static fracas_err check_named(const fracas_csv_table *const *table, const char *folder)
{
    bool named[SOMETIMES];
    TRY(find_named(folder, named));
    for (; *table; table++)
        for (size_t i = 0; i < SOMETIMES; i++) {
            OWNED char *path = NULL;
            if (*table != sometimes[i] || named[i]) continue;
            TRY(fracas_path(&path, "%s/%s.csv", folder, sometimes[i]->name));
            if (access(path, F_OK) == 0 || !fracas_file_is_own(path))
                return fracas_output_refuse(path);
        }
    return FRACAS_OK;
}

fracas_err fracas_export_free(const fracas_analysis *analysis, const char *folder,
                              fracas_export_more more)
{
    const fracas_csv_table *table[TABLES + 1];
    choose_tables(analysis, more, table);
    TRY(fracas_output_free(folder, &(const char *){package_file}, 1));
    TRY(check_named(table, folder));
    return fracas_csv_free(table, folder);
}

/* FRACAS_USAGE for cracks of a study without them. */
static fracas_err check_cracks(const fracas_analysis *analysis)
{
    if (!fracas_analysis_any_surface(analysis))
        return fracas_fail(FRACAS_USAGE, "bars and rings have no cracks that run: leave --cracks "
                                         "out; where they broke is in /interface of study.h5");
    if (!analysis->header.interfaces)
        return fracas_fail(FRACAS_USAGE,
                           "the study keeps no interfaces, by which cracks are known: "
                           "set `output: {interfaces: true}` and run it into another "
                           "folder, or leave --cracks out");
    if (fracas_results_partial(analysis->results))
        return fracas_fail(FRACAS_INTERRUPTED,
                           "meshes, which cracks run along, are in study.h5, and "
                           "the study has none yet: finish its run first, or "
                           "leave --cracks out");
    return FRACAS_OK;
}

/* Without a package or a page they would be somebody's own. */
static void drop_tables(const fracas_csv_table *const *table, const char *folder)
{
    for (; *table; table++) {
        char path[PATH_MAX];
        if (FRACAS_PRINT(path, "%s/%s.csv", folder, (*table)->name) < (int)sizeof path)
            unlink(path);
    }
}

fracas_err fracas_export_write(const fracas_analysis *analysis, const char *folder,
                               fracas_export_more more)
{
    const fracas_csv_table *table[TABLES + 1];
    fracas_output_file output;
    if (more.cracks) TRY(check_cracks(analysis));
    choose_tables(analysis, more, table);
    TRY(fracas_output_folder(folder));
    bool named[SOMETIMES];
    TRY(find_named(folder, named));
    TRY(fracas_output_open(folder, package_file, &output)); /* first: it tells whose tables are */
    fracas_err err = remove_package(folder, named);
    for (size_t i = 0; !err && table[i]; i++) err = fracas_csv_file(table[i], analysis, folder);
    if (!err) err = put_package(analysis, table, folder, output.file);
    err = fracas_output_close(&output, err);
    if (err && !fracas_output_is_ours(folder)) drop_tables(table, folder);
    return err;
}
