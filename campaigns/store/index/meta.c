/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table `meta`: identity of the study, part of the campaign, seal of study.h5. */
#include "campaigns/store/index/index.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

static const char seal_key[] = "study_seal";

fracas_err fracas_index_read_meta(fracas_index *index, const char *key, char *value, size_t size)
{
    sqlite3_stmt *statement;
    int code = sqlite3_prepare_v2(index->db, "SELECT value FROM meta WHERE key = ?1", -1,
                                  &statement, NULL);
    if (code == SQLITE_OK) code = sqlite3_bind_text(statement, 1, key, -1, SQLITE_STATIC);
    if (code == SQLITE_OK) code = sqlite3_step(statement);
    const char *found = code == SQLITE_ROW ? (const char *)sqlite3_column_text(statement, 0) : NULL;
    snprintf(value, size, "%s", found ? found : "");
    fracas_err err = code == SQLITE_ROW || code == SQLITE_DONE
                         ? FRACAS_OK
                         : fracas_index_error(index, "read `meta`");
    sqlite3_finalize(statement);
    return err;
}

/* Durable on return, outside of a transaction. */
static fracas_err write_meta(fracas_index *index, const char *key, const char *value)
{
    char *text = sqlite3_mprintf("INSERT OR REPLACE INTO meta VALUES (%Q, %Q)", key, value);
    if (!text) return fracas_no_memory("a statement");
    int code = sqlite3_exec(index->db, text, NULL, NULL, NULL);
    sqlite3_free(text);
    return code == SQLITE_OK ? FRACAS_OK : fracas_index_error(index, "write `meta`");
}

/* ---- identity ---- */

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
    TRY(fracas_index_do(index, FRACAS_SQL_BEGIN));
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

const char *fracas_sqlite_version(void)
{
    return sqlite3_libversion();
}

bool fracas_index_is_json(fracas_index *index, const char *text)
{
    sqlite3_stmt *statement;
    bool valid = false;
    if (sqlite3_prepare_v2(index->db, "SELECT json_valid(?1)", -1, &statement, NULL) == SQLITE_OK &&
        sqlite3_bind_text(statement, 1, text, -1, SQLITE_STATIC) == SQLITE_OK &&
        sqlite3_step(statement) == SQLITE_ROW)
        valid = sqlite3_column_int(statement, 0) == 1;
    sqlite3_finalize(statement);
    return valid;
}

fracas_err fracas_index_quick_check(fracas_index *index)
{
    sqlite3_stmt *statement;
    if (sqlite3_prepare_v2(index->db, "PRAGMA quick_check(1)", -1, &statement, NULL) != SQLITE_OK)
        return fracas_index_error(index, "check");
    fracas_err err = FRACAS_OK;
    const int code = sqlite3_step(statement);
    const char *text = code == SQLITE_ROW ? (const char *)sqlite3_column_text(statement, 0) : NULL;
    if (code != SQLITE_ROW && code != SQLITE_DONE) err = fracas_index_error(index, "check");
    else if (text && strcmp(text, "ok") != 0)
        err = fracas_fail(FRACAS_DAMAGED,
                          "%s: damaged: %s; `fracas reindex` makes it anew from the segments",
                          index->path, text);
    sqlite3_finalize(statement);
    return err;
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
