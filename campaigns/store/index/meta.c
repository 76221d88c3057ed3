/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table `meta`: identity of the study, part of the campaign, seal of study.h5. */
#include "campaigns/store/index/index.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

static const char seal_key[] = "study_seal";

fracas_err fracas_index_read_meta(fracas_index *index, const char *key, char *value, size_t size)
{
    OWNED char *found = NULL;
    TRY(fracas_sql_text(index, "SELECT value FROM meta WHERE key = ?1", SQL_VALUES(SQL_TEXT(key)),
                        &found));
    snprintf(value, size, "%s", found ? found : "");
    return FRACAS_OK;
}

/* Durable on return, outside of a transaction. */
static fracas_err write_meta(fracas_index *index, const char *key, const char *value)
{
    return fracas_sql_do(index, "INSERT OR REPLACE INTO meta VALUES (?1, ?2)",
                         SQL_VALUES(SQL_TEXT(key), SQL_TEXT(value)));
}

/* ---- identity ---- */

const char *const fracas_identity_name[FRACAS_IDENTITY_VALUES] = {
    "program_version", "seed", "history", "interfaces", "probes", "reactions"};

void fracas_identity_of(const fracas_file_header *header, fracas_identity *identity)
{
    snprintf(identity->value[0], FRACAS_IDENTITY_TEXT, "%s", header->version);
    snprintf(identity->value[1], FRACAS_IDENTITY_TEXT, "%" PRIu64, header->seed);
    snprintf(identity->value[2], FRACAS_IDENTITY_TEXT, "%" PRId64, header->history);
    snprintf(identity->value[3], FRACAS_IDENTITY_TEXT, "%d", header->interfaces);
    snprintf(identity->value[5], FRACAS_IDENTITY_TEXT, "%d", header->reactions);
    if (header->probes.count) fracas_probes_write(&header->probes, identity->value[4]);
    else snprintf(identity->value[4], FRACAS_IDENTITY_TEXT, "none");
}

bool fracas_identity_differs(const fracas_identity *found, const fracas_identity *wanted,
                             char text[FRACAS_DIFFERENCE_TEXT])
{
    for (int v = 0; v < FRACAS_IDENTITY_VALUES; v++) {
        const char *a = found->value[v], *b = wanted->value[v];
        if (!*a || !*b || strcmp(a, b) == 0) continue;
        snprintf(text, FRACAS_DIFFERENCE_TEXT, "%s %.40s, not %.40s", fracas_identity_name[v], a,
                 b);
        return true;
    }
    return false;
}

fracas_err fracas_index_identity(fracas_index *index, fracas_identity *identity)
{
    for (int v = 0; v < FRACAS_IDENTITY_VALUES; v++)
        TRY(fracas_index_read_meta(index, fracas_identity_name[v], identity->value[v],
                                   FRACAS_IDENTITY_TEXT));
    return FRACAS_OK;
}

fracas_err fracas_index_claim(fracas_index *index, const fracas_file_header *header)
{
    fracas_identity found, wanted;
    char text[FRACAS_DIFFERENCE_TEXT];
    TRY(fracas_index_identity(index, &found));
    fracas_identity_of(header, &wanted);
    if (fracas_identity_differs(&found, &wanted, text))
        return fracas_fail(FRACAS_DAMAGED,
                           "%s: the study was begun with %s; go on with the program and the "
                           "campaign that began it, or choose another --study",
                           index->path, text);
    TRY(fracas_index_begin(index));
    fracas_err err = FRACAS_OK;
    for (int v = 0; !err && v < FRACAS_IDENTITY_VALUES; v++)
        err = write_meta(index, fracas_identity_name[v], wanted.value[v]);
    return fracas_index_end(index, err);
}

/* ---- which part of the campaign it computes ---- */

static const char part_key[] = "part";

fracas_err fracas_index_set_part(fracas_index *index, int part, int parts)
{
    char text[32] = "", before[32];
    if (parts > 1) snprintf(text, sizeof text, "%d/%d", part, parts);
    TRY(fracas_index_read_meta(index, part_key, before, sizeof before));
    return strcmp(text, before) ? write_meta(index, part_key, text) : FRACAS_OK;
}

fracas_err fracas_index_part(fracas_index *index, int *part, int *parts)
{
    char text[32];
    TRY(fracas_index_read_meta(index, part_key, text, sizeof text));
    const bool is_part = sscanf(text, "%d/%d", part, parts) == 2 && *part >= 1 && *part <= *parts;
    if (!is_part) *part = *parts = 1;
    return FRACAS_OK;
}

/* ---- SQLite ---- */

const char fracas_sqlite_built[] = SQLITE_VERSION;

const char *fracas_sqlite_version(void)
{
    return sqlite3_libversion();
}

bool fracas_index_is_json(fracas_index *index, const char *text)
{
    int64_t valid;
    return !fracas_sql_numbers(index, "SELECT json_valid(?1)", SQL_VALUES(SQL_TEXT(text)), &valid,
                               NULL) &&
           valid;
}

fracas_err fracas_index_quick_check(fracas_index *index)
{
    OWNED char *text = NULL;
    TRY(fracas_sql_text(index, "PRAGMA quick_check(1)", NULL, 0, &text));
    if (!text || !strcmp(text, "ok")) return FRACAS_OK;
    return fracas_fail(FRACAS_DAMAGED,
                       "%s: damaged: %s; `fracas reindex` makes it anew from the segments",
                       index->path, text);
}

/* ---- the seal of study.h5 ---- */

fracas_err fracas_index_seal_study(fracas_index *index, const fracas_file_seal *seal)
{
    char text[64] = "";
    if (seal) snprintf(text, sizeof text, "%" PRIu64 " %016" PRIx64, seal->bytes, seal->checksum);
    return write_meta(index, seal_key, text);
}

fracas_err fracas_index_study_seal(fracas_index *index, bool *sealed, fracas_file_seal *seal)
{
    char text[64];
    *seal = (fracas_file_seal){0};
    TRY(fracas_index_read_meta(index, seal_key, text, sizeof text));
    *sealed = sscanf(text, "%" SCNu64 " %" SCNx64, &seal->bytes, &seal->checksum) == 2;
    return FRACAS_OK;
}
