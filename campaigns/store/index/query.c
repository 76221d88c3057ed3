/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/store/index/query.h"

static fracas_err check(fracas_index *index, int code)
{
    return code == SQLITE_OK ? FRACAS_OK : fracas_index_error(index, "read or write");
}

fracas_err fracas_query_begin(fracas_index *index, const char *text, sqlite3_stmt **statement)
{
    *statement = NULL;
    return check(index, sqlite3_prepare_v2(index->db, text, -1, statement, NULL));
}

fracas_err fracas_query_bind_text(fracas_index *index, sqlite3_stmt *statement, int n,
                                  const char *text)
{
    return check(index, sqlite3_bind_text(statement, n, text, -1, SQLITE_TRANSIENT));
}

fracas_err fracas_query_bind_hash(fracas_index *index, sqlite3_stmt *statement, int n,
                                  const fracas_hash *hash)
{
    char hex[FRACAS_HASH_HEX];
    fracas_hash_hex(hash, hex);
    return fracas_query_bind_text(index, statement, n, hex);
}

fracas_err fracas_query_bind(fracas_index *index, sqlite3_stmt *statement, int n, int64_t value)
{
    return check(index, sqlite3_bind_int64(statement, n, value));
}

fracas_err fracas_query_step(fracas_index *index, sqlite3_stmt *statement, bool *row)
{
    const int code = sqlite3_step(statement);
    *row = code == SQLITE_ROW;
    return code == SQLITE_ROW || code == SQLITE_DONE ? FRACAS_OK
                                                     : fracas_index_error(index, "read or write");
}

fracas_err fracas_query_do(fracas_index *index, sqlite3_stmt *statement)
{
    bool row = true;
    fracas_err err = FRACAS_OK;
    while (!err && row) err = fracas_query_step(index, statement, &row);
    sqlite3_reset(statement); /* repeats the error, which was reported */
    return err;
}

fracas_err fracas_query_all(fracas_index *index, const char *text)
{
    return check(index, sqlite3_exec(index->db, text, NULL, NULL, NULL));
}

fracas_err fracas_query_number(fracas_index *index, const char *text, int64_t *number)
{
    sqlite3_stmt *statement;
    bool row = false;
    fracas_err err = fracas_query_begin(index, text, &statement);
    if (!err) err = fracas_query_step(index, statement, &row);
    *number = row ? sqlite3_column_int64(statement, 0) : 0;
    sqlite3_finalize(statement);
    return err;
}

fracas_err fracas_query_checkpoint(fracas_index *index)
{
    return check(
        index, sqlite3_wal_checkpoint_v2(index->db, NULL, SQLITE_CHECKPOINT_TRUNCATE, NULL, NULL));
}
