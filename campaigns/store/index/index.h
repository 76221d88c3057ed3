/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Inside the index: the database handle, its statements, and queries of recover, merge and verify.
 */
#ifndef FRACAS_CAMPAIGNS_STORE_INDEX_INDEX_H
#define FRACAS_CAMPAIGNS_STORE_INDEX_INDEX_H

#include "campaigns/store/file/identity.h"

#include <sqlite3.h>

/* Statements, prepared once when the index is opened (text in index.c). */
typedef enum {
    FRACAS_SQL_BEGIN,
    FRACAS_SQL_BEGIN_READING,
    FRACAS_SQL_COMMIT,
    FRACAS_SQL_POINT_ADD,
    FRACAS_SQL_POINT_FIND,
    FRACAS_SQL_POINT_COUNT,
    FRACAS_SQL_POINT_ALL,
    FRACAS_SQL_ROW_COUNT,
    FRACAS_SQL_ROW_ADD,
    FRACAS_SQL_ROW_FIND,
    FRACAS_SQL_ROW_OF_POINT,
    FRACAS_SQL_ROW_FAILED,
    FRACAS_SQL_ROW_BY_SEGMENT,
    FRACAS_SQL_ROW_UNLEASE,
    FRACAS_SQL_ROW_LEASE,
    FRACAS_SQL_ROW_FAIL,
    FRACAS_SQL_ROW_DONE,
    FRACAS_SQL_ROW_FORGET,
    FRACAS_SQL_TALLY,
    FRACAS_SQL_SEGMENT_ADD,
    FRACAS_SQL_SEGMENT_FIND,
    FRACAS_SQL_SEGMENT_ALL,
    FRACAS_SQL_SEGMENT_LOSE,
    FRACAS_SQL_SEGMENT_FORGET,
    FRACAS_SQL_SEGMENT_TOTAL,
    FRACAS_SQL_EVENT_ADD,
    FRACAS_SQL_EVENT_LAST,
    FRACAS_SQL_ROW_OF_POINT_PLACE,
    FRACAS_SQL_ROW_TRIM,
    FRACAS_SQL_DECISION_ADD,
    FRACAS_SQL_DECISION_DROP,
    FRACAS_SQL_DECISION_OF_POINT,
    FRACAS_NSQL
} fracas_sql;

struct fracas_index {
    sqlite3 *db;
    char *path;
    bool local;   /* WAL: a filesystem of this machine */
    bool reading; /* the study cannot be written */
    sqlite3_stmt *statement[FRACAS_NSQL];
};

/* fracas_index_open with the kind of filesystem given. */
FRACAS_MUST_USE fracas_err fracas_index_open_as(const char *study, bool create, bool local,
                                                fracas_index **index);

/* The last SQLite failure as our message. */
FRACAS_MUST_USE fracas_err fracas_index_error(const fracas_index *index, const char *doing);
/* Steps a statement: *row says whether a row is there. The caller resets with fracas_index_reset.
 */
FRACAS_MUST_USE fracas_err fracas_index_step(fracas_index *index, fracas_sql sql, bool *row);
void fracas_index_reset(fracas_index *index, fracas_sql sql);
/* Steps a statement without rows, and resets it. */
FRACAS_MUST_USE fracas_err fracas_index_do(fracas_index *index, fracas_sql sql);
/* Binds argument `n` (from 1). */
FRACAS_MUST_USE fracas_err fracas_index_bind(fracas_index *index, fracas_sql sql, int n,
                                             int64_t value);
FRACAS_MUST_USE fracas_err fracas_index_bind_real(fracas_index *index, fracas_sql sql, int n,
                                                  double value);
FRACAS_MUST_USE fracas_err fracas_index_bind_text(fracas_index *index, fracas_sql sql, int n,
                                                  const char *text);

/* The value under `key` in meta, cut to `size`; "" if there is none. */
FRACAS_MUST_USE fracas_err fracas_index_read_meta(fracas_index *index, const char *key, char *value,
                                                  size_t size);
/* Identity of the study, as fracas_index_claim left it. */
FRACAS_MUST_USE fracas_err fracas_index_identity(fracas_index *index, fracas_identity *identity);
/* Keeps the seal of study.h5, durable on return; NULL takes it away. */
FRACAS_MUST_USE fracas_err fracas_index_seal_study(fracas_index *index,
                                                   const fracas_file_seal *seal);
FRACAS_MUST_USE fracas_err fracas_index_study_seal(fracas_index *index, bool *sealed,
                                                   fracas_file_seal *seal);

/* FRACAS_DAMAGED with the first finding of SQLite's quick_check. */
FRACAS_MUST_USE fracas_err fracas_index_quick_check(fracas_index *index);
/* True for JSON, which the table `segment` takes as provenance. */
bool fracas_index_is_json(fracas_index *index, const char *text);
FRACAS_MUST_USE fracas_err fracas_index_points(fracas_index *index, int64_t *points);

/* Id of a point, 0 if it is not there. */
FRACAS_MUST_USE fracas_err fracas_index_find_point(fracas_index *index, const fracas_hash *point,
                                                   int64_t *id);

/* Plans the missing replicas of a point, within a transaction. */
FRACAS_MUST_USE fracas_err fracas_index_plan_point(fracas_index *index,
                                                   const fracas_point_row *point);

/* Status of a realization, the place of its bytes, and its summary (0 and NaN before it is done).
 */
typedef struct {
    fracas_row_status status;
    int64_t segment; /* id, 0 if it has none */
    int64_t row;
    fracas_summary summary;
} fracas_place;

/* The place in a row with FRACAS_PLACE_COLUMNS from column `first` on. */
fracas_place fracas_place_read(sqlite3_stmt *row, int first);

/* True if place and record agree: a flipped bit in the index, which SQLite does not see, gets no
 * further. `sized`: the record has its fragments, and the mean size counts, too. */
bool fracas_place_fits(const fracas_place *place, const fracas_record *record, bool sized);

/* Visits the realizations of every segment by its id, in the order of their rows; *point is NULL
 * where the index has no valid hash. */
FRACAS_MUST_USE fracas_err
fracas_index_each_by_segment(fracas_index *index,
                             fracas_err (*visit)(void *context, const fracas_hash *point,
                                                 int64_t replica, const fracas_place *place),
                             void *context);

/* FRACAS_DAMAGED if the index has no such realization. */
FRACAS_MUST_USE fracas_err fracas_index_place(fracas_index *index, const fracas_hash *point,
                                              int64_t replica, fracas_place *place);
fracas_row_status fracas_index_status(const unsigned char *text);
/* Value of a column, NaN for NULL. */
double fracas_index_real(sqlite3_stmt *row, int column);

/* A segment in the index. */
typedef struct {
    int64_t id;
    char *name;
    fracas_file_seal seal;
    int64_t rows; /* realizations in it */
} fracas_known_segment;

/* All of them by id; freed with fracas_index_segments_free. */
FRACAS_MUST_USE fracas_err fracas_index_segments(fracas_index *index,
                                                 fracas_known_segment **segment, size_t *count);
void fracas_index_segments_free(fracas_known_segment *segment, size_t count);
/* The same by name. */
FRACAS_MUST_USE fracas_err fracas_index_segments_by_name(fracas_index *index,
                                                         fracas_known_segment **segment,
                                                         size_t *count);
/* The one of this name among those, NULL if there is none. */
const fracas_known_segment *fracas_segment_is_known(const fracas_known_segment *segment,
                                                    size_t count, const char *name);
/* True if its file is there and has its size. */
FRACAS_MUST_USE fracas_err fracas_segment_is_there(const char *study,
                                                   const fracas_known_segment *segment,
                                                   bool *there);
/* FRACAS_DAMAGED, naming it, unless its bytes fit the checksum in the index. */
FRACAS_MUST_USE fracas_err fracas_segment_check(const char *study,
                                                const fracas_known_segment *segment);
/* Turns the rows of these segments back to planned and forgets the segments; one transaction. *rows
 * counts them. */
FRACAS_MUST_USE fracas_err fracas_index_forget(fracas_index *index, const int64_t *segment,
                                               size_t count, int64_t *rows);

#endif
