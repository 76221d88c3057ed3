/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Inside the index: the database handle, its statements, and queries of recover, merge and verify.
 */
#ifndef FRACAS_CAMPAIGNS_STORE_INDEX_INDEX_H
#define FRACAS_CAMPAIGNS_STORE_INDEX_INDEX_H

#include "campaigns/store/datafile.h"
#include "campaigns/store/index.h"

#include <sqlite3.h>

/* ---- identity of a study: values on which records depend beside their point and replica ----
 *
 * The hash of a point does not hold it, so files and the index are compared by it. */

enum {
    FRACAS_IDENTITY_VALUES = 6,
    FRACAS_IDENTITY_TEXT = FRACAS_PROBES_TEXT,
    FRACAS_DIFFERENCE_TEXT = 128
};

/* Names of the values, as attributes of the root group and as keys of `meta`. */
extern const char *const fracas_identity_name[FRACAS_IDENTITY_VALUES];

/* The values as text; "" where one is not known. */
typedef struct {
    char value[FRACAS_IDENTITY_VALUES][FRACAS_IDENTITY_TEXT];
} fracas_identity;

void fracas_identity_of(const fracas_file_header *header, fracas_identity *identity);
/* True if a value known to both differs; then *text is the first, "NAME FOUND, not WANTED". */
bool fracas_identity_differs(const fracas_identity *found, const fracas_identity *wanted,
                             char text[FRACAS_DIFFERENCE_TEXT]);

/* ---- the database ---- */

typedef struct {
    const char *text;
    sqlite3_stmt *prepared; /* at its first use */
} fracas_statement;

struct fracas_index {
    sqlite3 *db;
    char *path;
    bool local;   /* WAL: a filesystem of this machine */
    bool reading; /* nothing is changed */
    bool opened;  /* false while fracas_index_open is at work */
    fracas_statement *statement;
    size_t nstatements, room;
};

/* fracas_index_open with the kind of filesystem given. */
FRACAS_MUST_USE fracas_err fracas_index_open_as(const char *study, bool create, bool local,
                                                fracas_index **index);

/* The last SQLite failure as our message: "cannot DOING". */
FRACAS_MUST_USE fracas_err fracas_index_error(const fracas_index *index, const char *doing);

/* An argument of a statement: SQL_INTEGER(5), SQL_REAL(NAN), SQL_TEXT("5"), SQL_HASH(&hash); {0} is
 * NULL, as are a NaN and an absent hash or text. */
typedef struct {
    int type; /* SQLITE_INTEGER, ...; SQLITE_BLOB: a hash */
    int64_t integer;
    double real;
    const char *text;
    const fracas_hash *hash;
} fracas_sql_value;
#define SQL_INTEGER(value) ((fracas_sql_value){.type = SQLITE_INTEGER, .integer = (value)})
#define SQL_REAL(value) ((fracas_sql_value){.type = SQLITE_FLOAT, .real = (value)})
#define SQL_TEXT(value) ((fracas_sql_value){.type = SQLITE_TEXT, .text = (value)})
#define SQL_HASH(value) ((fracas_sql_value){.type = SQLITE_BLOB, .hash = (value)})
#define SQL_VALUES(...)                      \
    (const fracas_sql_value[]){__VA_ARGS__}, \
        sizeof((const fracas_sql_value[]){__VA_ARGS__}) / sizeof(fracas_sql_value)

/* Starts a statement, whose `text` lives as long as the index and is known by its address, with
 * these arguments; *statement belongs to the index. FRACAS_BUG if it is started and not ended. */
FRACAS_MUST_USE fracas_err fracas_sql_start(fracas_index *index, const char *text,
                                            const fracas_sql_value *value, size_t count,
                                            sqlite3_stmt **statement);
/* Steps it: true if a row is there to be read. It ends without one, and after an error. */
bool fracas_sql_next(fracas_index *index, sqlite3_stmt *statement, fracas_err *err);
/* FRACAS_ENVIRONMENT if a text of the row at hand found no memory: it was read as NULL then. The
 * next step says so, too. */
FRACAS_MUST_USE fracas_err fracas_sql_whole(const fracas_index *index);
/* Ends it before its last row; NULL is allowed. */
void fracas_sql_end(sqlite3_stmt *statement);
FRACAS_OWNER(sqlite3_stmt, fracas_sql_end)
/* Runs a statement that gives no rows. */
FRACAS_MUST_USE fracas_err fracas_sql_do(fracas_index *index, const char *text,
                                         const fracas_sql_value *value, size_t count);
/* The first columns of its first row, 0 without one; second: NULL is allowed. */
FRACAS_MUST_USE fracas_err fracas_sql_numbers(fracas_index *index, const char *text,
                                              const fracas_sql_value *value, size_t count,
                                              int64_t *first, int64_t *second);
/* The text in the first column of its first row, NULL without one; freed by the caller. */
FRACAS_MUST_USE fracas_err fracas_sql_text(fracas_index *index, const char *text,
                                           const fracas_sql_value *value, size_t count,
                                           char **found);
/* Several statements without arguments. */
FRACAS_MUST_USE fracas_err fracas_sql_script(fracas_index *index, const char *text);
/* Puts the write-ahead log back into the database and empties it; nothing is done where there is
 * none. */
FRACAS_MUST_USE fracas_err fracas_sql_checkpoint(fracas_index *index);

/* fracas_index_begin for a transaction that only reads. */
FRACAS_MUST_USE fracas_err fracas_index_begin_reading(fracas_index *index);

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

/* Id of a point, 0 if it is not there. */
FRACAS_MUST_USE fracas_err fracas_index_find_point(fracas_index *index, const fracas_hash *point,
                                                   int64_t *id);

/* The same; FRACAS_DAMAGED if it is missing. */
FRACAS_MUST_USE fracas_err fracas_index_need_point(fracas_index *index, const fracas_hash *point,
                                                   int64_t *id);

/* Counts the points. */
FRACAS_MUST_USE fracas_err fracas_index_points(fracas_index *index, int64_t *points);

/* Plans the missing replicas of a point, within a transaction. */
FRACAS_MUST_USE fracas_err fracas_index_plan_point(fracas_index *index,
                                                   const fracas_point_row *point);

/* The place in a row with FRACAS_PLACE_COLUMNS from column `first` on. */
fracas_row_place fracas_place_read(sqlite3_stmt *row, int first);

/* One column: a status, planned for a text with a flipped bit (the tables' CHECK allows none); a
 * number, NaN for NULL. */
fracas_row_status fracas_status_read(sqlite3_stmt *row, int column);
double fracas_real_read(sqlite3_stmt *row, int column);

/* True if place and record agree: a flipped bit in the index, which SQLite does not see, gets no
 * further. `sized`: the record has its fragments, and the mean size counts, too. */
bool fracas_place_fits(const fracas_row_place *place, const fracas_record *record, bool sized);

/* Visits the realizations of every segment by its id, in the order of their rows; *point is NULL
 * where the index has no valid hash. */
typedef fracas_err fracas_place_visit(void *context, const fracas_hash *point, int64_t replica,
                                      const fracas_row_place *place);
FRACAS_MUST_USE fracas_err fracas_index_each_by_segment(fracas_index *index,
                                                        fracas_place_visit *visit, void *context);

/* One transaction, durable on return: the segment, and all `count` rows as its rows, which are done
 * already, in place of those of other segments. FRACAS_DAMAGED if one is not. */
FRACAS_MUST_USE fracas_err fracas_index_fold(fracas_index *index, const char *segment,
                                             const fracas_file_seal *seal,
                                             const fracas_segment_row *row, size_t count);
/* FRACAS_DAMAGED if the index has no such realization. */
FRACAS_MUST_USE fracas_err fracas_index_place(fracas_index *index, const fracas_hash *point,
                                              int64_t replica, fracas_row_place *place);

/* A segment in the index. */
typedef struct {
    int64_t id;
    char *name;
    fracas_file_seal seal;
    int64_t rows; /* realizations in it */
} fracas_known_segment;

typedef struct {
    fracas_known_segment *segment;
    size_t count;
} fracas_known_segments;

/* All of them, cleared by the caller, after an error too. */
FRACAS_MUST_USE fracas_err fracas_index_segments_by_id(fracas_index *index,
                                                       fracas_known_segments *known);
FRACAS_MUST_USE fracas_err fracas_index_segments_by_name(fracas_index *index,
                                                         fracas_known_segments *known);
void fracas_known_segments_clear(fracas_known_segments *known);
/* The one of this id or name in a list in that order; NULL if there is none. */
const fracas_known_segment *fracas_segment_of_id(const fracas_known_segments *known, int64_t id);
const fracas_known_segment *fracas_segment_of_name(const fracas_known_segments *known,
                                                   const char *name);
/* True if its file is there and has its size. */
FRACAS_MUST_USE fracas_err fracas_segment_is_there(const char *study,
                                                   const fracas_known_segment *segment,
                                                   bool *there);
/* Turns the rows of these segments back to planned and forgets the segments; one transaction. *rows
 * counts them. */
FRACAS_MUST_USE fracas_err fracas_index_forget(fracas_index *index, const int64_t *segment,
                                               size_t count, int64_t *rows);

/* ---- the tables, each column described once (tables.c) ---- */

/* ", outcome, fragments ...", and the same as assignments; each `?` takes the next number. */
#define FRACAS_SQL_NAME(key, type, value, meaning) ", " #key
#define FRACAS_SQL_SET(key, type, value, meaning) ", " #key " = ?"
#define FRACAS_SQL_UNSET(key, type, value, meaning) ", " #key " = NULL"

/* The columns of a fracas_row_place, and assignments to forget it. */
#define FRACAS_PLACE_COLUMNS "status, segment, row" FRACAS_EACH_SUMMARY(FRACAS_SQL_NAME)
#define FRACAS_UNSET_PLACE \
    "status = 'planned', segment = NULL, row = NULL" FRACAS_EACH_SUMMARY(FRACAS_SQL_UNSET)

/* Prints statements: to create missing tables, and to read every column of each. */
void fracas_index_print_schema(FILE *out);
void fracas_index_print_check(FILE *out);

#endif
