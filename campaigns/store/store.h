/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The study on disk: immutable HDF5 segments, an SQLite index over them, and the merged study.h5.
 *
 *   STUDY/campaign.yaml  STUDY/index.sqlite  STUDY/lock  STUDY/segments/NAME.h5  STUDY/study.h5
 * STUDY/report/
 *
 * A row of the index marked done means durable bytes: before its rows are committed, a segment is
 * written whole to a temporary name, synced and renamed, and its folder synced. */
#ifndef FRACAS_CAMPAIGNS_STORE_STORE_H
#define FRACAS_CAMPAIGNS_STORE_STORE_H

#include "base/err.h"
#include "base/hash.h"
#include "base/own.h"
#include "campaigns/points.h"
#include "campaigns/store/mesh.h"
#include "campaigns/store/summary.h"
#include "engine/record.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* ---- one HDF5 file: a segment or a study, same schema (docs/formats/study.md) ---- */

/* 5 had no campaign, 4 no shapes of fragments, 3 no damped, 2 no friction */
#define FRACAS_FORMAT_VERSION 6
#define FRACAS_FORMAT_CAMPAIGN 6 /* the first with a campaign */
#define FRACAS_FORMAT_OLDEST 3   /* the first that fracas_reader_open_old reads */

typedef struct {
    fracas_hash campaign; /* campaign hash */
    uint64_t seed;
    int64_t history;      /* as the campaign's output options say: equal intervals of time.end, */
    bool interfaces;      /* and whether the file has an /interface group */
    char version[32];     /* program version */
    int64_t format;       /* format version of a file that was read; a writer has its own */
    bool complete;        /* every realization of every point in the file is present */
    bool reactions;       /* whether the file has a /reaction group */
    fracas_probes probes; /* the campaign's: with one the file has a /probe group */
} fracas_file_header;

/* Size and checksum of a finished file, as the index keeps them. */
typedef struct {
    uint64_t bytes;
    uint64_t checksum; /* fracas_checksum_of its contents */
} fracas_file_seal;

/* One round of a point whose replicas a rule decides (docs/theory/sequential.md): decision, data,
 * rule. X(key, type, stored, meaning), from which struct, comparison and `/decision` are made. */
#define FRACAS_EACH_DECISION(X)                                                                    \
    X(point, INTEGER, INT32, "row of the point in /point")                                         \
    X(round, INTEGER, INT32, "round of the point, from 0")                                         \
    X(replicas, INTEGER, INT64, "replicas that the point had, 0 to this - 1, when it was decided") \
    X(used, INTEGER, INT64,                                                                        \
      "of those, realizations in the mean: FRAGMENTED, INTACT and TIME_LIMIT")                     \
    X(mean, REAL, FLOAT64, "mean of the quantity over them: 1, m or J by the quantity")            \
    X(half_width, REAL, FLOAT64, "half width of the t interval of the mean, in the same unit")     \
    X(stop, INTEGER, INT8, "0 goes on to the next round, 1 precise enough, 2 at the maximum")      \
    X(quantity, INTEGER, INT8, "the rule: 0 mean-count, 1 mean-size, 2 dissipated")                \
    X(minimum, INTEGER, INT64, "the rule: replicas of the first round")                            \
    X(maximum, INTEGER, INT64, "the rule: most replicas")                                          \
    X(relative_half_width, REAL, FLOAT64, "the rule: half width asked for, as part of the mean")   \
    X(confidence, REAL, FLOAT64, "the rule: confidence of the interval")

#define FRACAS_DECISION_MEMBER(key, type, stored, meaning) fracas_sql_##type key;
typedef struct {
    FRACAS_EACH_DECISION(FRACAS_DECISION_MEMBER)
} fracas_decision;

/* True if round, replicas, used, stop and quantity are in range. */
bool fracas_decision_valid(const fracas_decision *decision);

/* half_width/|mean|; 0 if half_width is 0. NaN of fewer than two values. */
double fracas_decision_relative(const fracas_decision *decision);

/* True if all members are equal, NaN equal to NaN. */
bool fracas_decision_same(const fracas_decision *a, const fracas_decision *b);

typedef struct fracas_writer fracas_writer;
typedef struct fracas_reader fracas_reader;

/* Starts `path` under a temporary name in the same folder. `table` must outlive the writer. */
FRACAS_MUST_USE fracas_err fracas_writer_create(const char *path, const fracas_file_header *header,
                                                const fracas_point_table *table,
                                                fracas_writer **writer);
/* Appends one realization; records are buffered by column, so memory stays bounded. */
FRACAS_MUST_USE fracas_err fracas_writer_append(fracas_writer *writer, size_t point,
                                                int64_t replica, const fracas_record *record);
/* The file is a segment: it keeps one JSON object of less than 4 KB as an attribute (where, when
 * and by which program the records were computed, in case the index is lost), and ends with a seal
 * of its own, which fracas_file_version checks. */
FRACAS_MUST_USE fracas_err fracas_writer_provenance(fracas_writer *writer, const char *provenance);
/* The next decisions, in the order of points and rounds. The file has a group /decision if there
 * are any. */
FRACAS_MUST_USE fracas_err fracas_writer_decisions(fracas_writer *writer,
                                                   const fracas_decision *decision, size_t count);
/* The mesh of the next point, points in their order, in a file with interfaces: once for each, or
 * for none of them. The file has a group /mesh if any of them has elements. */
FRACAS_MUST_USE fracas_err fracas_writer_mesh(fracas_writer *writer,
                                              const fracas_stored_mesh *mesh);
/* The campaign, once, in a group /campaign. */
FRACAS_MUST_USE fracas_err fracas_writer_campaign(fracas_writer *writer,
                                                  const fracas_campaign_copy *copy);
/* Closes, syncs, renames to the final name, syncs the folder; frees the writer whatever happens.
 * Equal sequences of calls give equal bytes. */
FRACAS_MUST_USE fracas_err fracas_writer_finish(fracas_writer *writer, bool complete,
                                                fracas_file_seal *seal);
/* Gives up: removes the temporary file, frees the writer. NULL is allowed. */
void fracas_writer_abandon(fracas_writer *writer);
FRACAS_OWNER(fracas_writer, fracas_writer_abandon)

/* *version: the format version in the file, of this program or another. FRACAS_DAMAGED if there is
 * none, or if a segment's own seal does not fit its bytes, found before HDF5 reads one. A file that
 * no index vouches for is opened after this check. */
FRACAS_MUST_USE fracas_err fracas_file_version(const char *path, uint64_t *version);
/* FRACAS_DAMAGED if it is not a fracas file of a known format version, naming the file. */
FRACAS_MUST_USE fracas_err fracas_reader_open(const char *path, fracas_reader **reader);
/* The same, also of format versions from FRACAS_FORMAT_OLDEST on, to look at and not to go on with:
 * what these had not yet is NaN, or 0 of whole numbers (fracas_store_column, `since`). */
FRACAS_MUST_USE fracas_err fracas_reader_open_old(const char *path, fracas_reader **reader);
/* The same for records with these parts at most (FRACAS_READ_...), in half the time or less: the
 * table of points has hashes and replicas but no columns, and there are no decisions or meshes. */
FRACAS_MUST_USE fracas_err fracas_reader_open_records(const char *path, unsigned parts,
                                                      fracas_reader **reader);
void fracas_reader_close(fracas_reader *reader); /* NULL is allowed */
FRACAS_OWNER(fracas_reader, fracas_reader_close)
const fracas_file_header *fracas_reader_header(const fracas_reader *reader);
const fracas_point_table *fracas_reader_points(const fracas_reader *reader);
size_t fracas_reader_realizations(const fracas_reader *reader);

/* Parts of a record to read beside the scalars. */
enum {
    FRACAS_READ_FRAGMENTS = 1,
    FRACAS_READ_HISTORY = 2,
    FRACAS_READ_INTERFACES = 4,
    FRACAS_READ_PROBES = 8,
    FRACAS_READ_REACTIONS = 16,
    FRACAS_READ_ALL = 31
};
/* Realization in row `row` (0 .. realizations-1): its point (index in the file's table), replica
 * and record; `record` initialised by the caller, cleared by the caller (and here before it is
 * filled again). A part not asked for, or not in the file, has 0 rows and NULL. Reads ahead in
 * blocks: rows are cheapest in order. */
FRACAS_MUST_USE fracas_err fracas_reader_record(fracas_reader *reader, size_t row, unsigned parts,
                                                size_t *point, int64_t *replica,
                                                fracas_record *record);

/* One realization of a file or of a study. */
typedef struct {
    size_t row, point;
    int64_t replica;
    fracas_record record; /* a visitor may take rows out of it and leave NULL */
} fracas_result;

/* Visits every realization of the file in the order of its rows, with these parts of its record. */
typedef fracas_err fracas_result_visit(void *context, fracas_result *result);
FRACAS_MUST_USE fracas_err fracas_reader_each(fracas_reader *reader, unsigned parts,
                                              fracas_result_visit *visit, void *context);

/* The text of fracas_writer_provenance, NULL if the file has none; freed by the caller. */
FRACAS_MUST_USE fracas_err fracas_reader_provenance(const fracas_reader *reader, char **provenance);

/* Every decision of the file in its order, none without a group /decision; freed by the caller. */
FRACAS_MUST_USE fracas_err fracas_reader_decisions(fracas_reader *reader,
                                                   fracas_decision **decision, size_t *count);

/* The campaign of a study.h5; all zero if the file has none, as segments and format version 5.
 * Cleared by the caller, after an error too. */
FRACAS_MUST_USE fracas_err fracas_reader_campaign(fracas_reader *reader,
                                                  fracas_campaign_copy *copy);

/* *interfaces: of the mesh of a point, 0 if the file has none of it: a bar, a ring, or no
 * interfaces kept. */
FRACAS_MUST_USE fracas_err fracas_reader_mesh_interfaces(fracas_reader *reader, size_t point,
                                                         size_t *interfaces);
/* The mesh of a point, all zero if the file has none of it. Cleared by the caller. FRACAS_DAMAGED
 * if it is none (fracas_stored_mesh_fault). */
FRACAS_MUST_USE fracas_err fracas_reader_mesh(fracas_reader *reader, size_t point,
                                              fracas_stored_mesh *mesh);

/* Prints the tables of docs/formats/study.md: the datasets of a file, the columns of the index. */
void fracas_study_reference(FILE *out);

/* Versions of the libraries, for provenance, and of the headers that this program was built with.
 */
void fracas_hdf5_version(char text[32]);
const char *fracas_sqlite_version(void);
extern const char fracas_hdf5_built[], fracas_sqlite_built[];

/* ---- a record as bytes, for a pipe between processes of one program ---- */

/* Size of the bytes of fracas_record_pack. */
size_t fracas_record_packed_size(const fracas_record *record);
void fracas_record_pack(const fracas_record *record, void *bytes);
/* FRACAS_BUG if `size` does not fit the counts in the bytes. */
FRACAS_MUST_USE fracas_err fracas_record_unpack(const void *bytes, size_t size,
                                                fracas_record *record);
/* Equal in every bit, all parts. */
bool fracas_record_same(const fracas_record *a, const fracas_record *b);

/* ---- the index ---- */

typedef struct fracas_index fracas_index;

typedef enum {
    FRACAS_PLANNED,
    FRACAS_LEASED,
    FRACAS_DONE,
    FRACAS_FAILED_ROW,
    FRACAS_QUARANTINED
} fracas_row_status;

typedef struct {
    size_t point; /* index in the table given to fracas_index_plan */
    int64_t replica;
    fracas_row_status status;
    int64_t attempts;
} fracas_index_row;

/* A row of a segment as it goes into the index. */
typedef struct {
    fracas_hash point;
    int64_t replica;
    int64_t row; /* in the segment */
    fracas_summary summary;
} fracas_segment_row;

/* Opens (with `create`: creates) STUDY/index.sqlite. Journal: WAL with synchronous FULL on local
 * filesystems, TRUNCATE with FULL and exclusive locking on network ones; the mode is read back.
 * Without `create` it is opened to read, and no statement can change it. A file without a table
 * counts as none. FRACAS_DAMAGED says how to go on. */
FRACAS_MUST_USE fracas_err fracas_index_open(const char *study, bool create, fracas_index **index);
void fracas_index_close(fracas_index *index); /* NULL is allowed */
FRACAS_OWNER(fracas_index, fracas_index_close)

/* True if STUDY/index.sqlite has tables of ours; a run killed at its start leaves one without. */
bool fracas_index_exists(const char *study);
/* True if STUDY/index.sqlite is there, has bytes, and is neither an index nor one begun. */
bool fracas_index_is_foreign(const char *study);

/* Claims the study for the header's program version, seed, history and interfaces, before anything
 * is computed. FRACAS_DAMAGED names the first value in which the study's beginning differs:
 * study.h5 has one of each. */
FRACAS_MUST_USE fracas_err fracas_index_claim(fracas_index *index,
                                              const fracas_file_header *header);

/* Part K of N of the campaign, computed in this study (`fracas run --part`), durable on return. 1
 * of 1, also the default, is all of it. */
FRACAS_MUST_USE fracas_err fracas_index_set_part(fracas_index *index, int part, int parts);
FRACAS_MUST_USE fracas_err fracas_index_part(fracas_index *index, int *part, int *parts);

/* Adds the missing points and realizations of the table (status planned). Turns leased rows back to
 * planned: the caller has the lock, so their holder is gone. */
FRACAS_MUST_USE fracas_err fracas_index_plan(fracas_index *index, const fracas_point_table *table);
/* Every realization of the table in plan order; *row freed by the caller. */
FRACAS_MUST_USE fracas_err fracas_index_rows(fracas_index *index, const fracas_point_table *table,
                                             fracas_index_row **row, size_t *count);
/* One transaction, durable on return: the segment and its rows, which become done (or failed for
 * outcome FAILED). A row that is done already keeps its first segment; the same commit twice
 * changes nothing. `segment`: file name in STUDY/segments, with its .h5. `provenance`: one JSON
 * object (host, pid, versions, CPU, instruction set, lanes, wall times); never in study.h5. */
FRACAS_MUST_USE fracas_err fracas_index_commit(fracas_index *index, const char *segment,
                                               const fracas_file_seal *seal,
                                               const fracas_segment_row *row, size_t count,
                                               const char *provenance);
/* Calls `say` with each realization of the table with status failed or quarantined, in plan order,
 * and the reason ("" if none was given). */
FRACAS_MUST_USE fracas_err fracas_index_failures(
    fracas_index *index, const fracas_point_table *table,
    void (*say)(void *context, const fracas_index_row *row, const char *reason), void *context);
/* Marks the planned ones among `count` replicas from `replica` on as leased. Not durable: the next
 * plan undoes it. */
FRACAS_MUST_USE fracas_err fracas_index_lease(fracas_index *index, const fracas_hash *point,
                                              int64_t replica, int64_t count);
/* Counts an attempt of one realization without a record, and keeps the reason. With `final` the
 * realization becomes failed (in study.h5 outcome FAILED, values NaN), else planned. */
FRACAS_MUST_USE fracas_err fracas_index_fail(fracas_index *index, const fracas_hash *point,
                                             int64_t replica, const char *reason, bool final);
/* Appends to the table `event` (time of day, kind, text). */
FRACAS_MUST_USE fracas_err fracas_index_event(fracas_index *index, const char *kind,
                                              const char *text);
/* FRACAS_DAMAGED, with the remedy, if it has points that are not in the campaign's table: one of
 * the two is damaged, or campaign.yaml was edited. */
FRACAS_MUST_USE fracas_err fracas_index_check_points(fracas_index *index,
                                                     const fracas_point_table *table);
/* The text of the latest event of a kind, NULL if there is none; freed by the caller. */
FRACAS_MUST_USE fracas_err fracas_index_last_event(fracas_index *index, const char *kind,
                                                   char **text);

/* Calls `say` with the time of day (UTC), kind and text of every event, oldest first. */
FRACAS_MUST_USE fracas_err fracas_index_events(fracas_index *index,
                                               void (*say)(void *context, const char *time,
                                                           const char *kind, const char *text),
                                               void *context);

/* ---- decisions in the index ---- */

/* Status of a realization, place of its bytes, and its summary (0 and NaN before it is done). */
typedef struct {
    fracas_row_status status;
    int64_t segment; /* id, 0 if it has none */
    int64_t row;
    fracas_summary summary;
} fracas_place;

/* row[r] of the replicas 0 to count - 1 of a point. FRACAS_DAMAGED if one was never planned. */
FRACAS_MUST_USE fracas_err fracas_index_summaries(fracas_index *index, const fracas_hash *point,
                                                  size_t count, fracas_place *row);

/* row[r - first] = replica r of the point, r from `first` to point->replicas - 1; `p`: number of
 * the point in the table. */
FRACAS_MUST_USE fracas_err fracas_index_rows_from(fracas_index *index,
                                                  const fracas_point_row *point, size_t p,
                                                  int64_t first, fracas_index_row *row);

/* The recorded decisions of a point by round, `point` left 0; freed by the caller. */
FRACAS_MUST_USE fracas_err fracas_index_decisions(fracas_index *index, const fracas_hash *point,
                                                  fracas_decision **decision, size_t *count);

/* Begins and ends a transaction, which waits for the disk once. The end commits if `err` is
 * FRACAS_OK, else it takes all back and returns `err`. */
FRACAS_MUST_USE fracas_err fracas_index_begin(fracas_index *index);
FRACAS_MUST_USE fracas_err fracas_index_end(fracas_index *index, fracas_err err);

/* Within a transaction: records the decision, in place of this and any later round of the point,
 * with the reason in words. Plans point->replicas of it; a decision to stop deletes the rows
 * beyond. */
FRACAS_MUST_USE fracas_err fracas_index_decide(fracas_index *index, const fracas_point_row *point,
                                               const fracas_decision *decision, const char *reason);

typedef struct {
    int64_t points, realizations, done, failed, planned, leased; /* realizations by status */
    int64_t outcome[FRACAS_NOUTCOMES];
    int64_t segments, bytes; /* segments, and their bytes */
} fracas_index_counts;

/* Counts a realization with this outcome, -1: none yet. */
void fracas_index_counts_add(fracas_index_counts *counts, fracas_row_status status,
                             int64_t outcome);
/* Realizations to be computed. */
static inline int64_t fracas_index_missing(const fracas_index_counts *counts)
{
    return counts->planned + counts->leased;
}

FRACAS_MUST_USE fracas_err fracas_index_count(fracas_index *index, fracas_index_counts *counts);
FRACAS_MUST_USE fracas_err fracas_index_count_segments(fracas_index *index, int64_t *segments,
                                                       int64_t *bytes);
/* The same, and of each point of the table (table->npoints of them; segments and bytes 0), by one
 * look at every realization. */
FRACAS_MUST_USE fracas_err fracas_index_count_points(fracas_index *index,
                                                     const fracas_point_table *table,
                                                     fracas_index_counts *counts,
                                                     fracas_index_counts *point);

/* Visits every realization of the table's points in the index, all at one moment: replicas of a
 * point one after the other, from 0. */
typedef fracas_err fracas_index_visit(void *context, size_t point, int64_t replica,
                                      const fracas_place *place);
FRACAS_MUST_USE fracas_err fracas_index_each(fracas_index *index, const fracas_point_table *table,
                                             fracas_index_visit *visit, void *context);

/* The latest run on the study, by the clocks of its hosts. */
typedef struct {
    double began;    /* s since 1970, when it began to compute; NaN: no run did */
    double latest;   /* end of its latest segment; NaN: it has none yet */
    int64_t segment; /* its first; the ids of the others are above */
} fracas_latest_run;
FRACAS_MUST_USE fracas_err fracas_index_latest_run(fracas_index *index, fracas_latest_run *run);

/* ---- the study as a whole ---- */

/* Takes STUDY/lock (created) for this process until fracas_study_unlock or its death, and writes
 * into it who has it: host, pid, time, kernel, Slurm job. FRACAS_IN_USE names the holder's host and
 * pid. A lock left by a dead process of this host, or of this Slurm job before its requeue, is
 * taken over. A lock left by another host is refused unless `force`: its holder may live there,
 * with a filesystem that does not share locks. A holder known to live keeps it. */
FRACAS_MUST_USE fracas_err fracas_study_lock(const char *study, bool force, int *lock);
/* The same without a line in the file, to read a study while nobody else changes it; released by
 * close(). */
FRACAS_MUST_USE fracas_err fracas_study_lock_to_look(const char *study, bool force, int *lock);
/* Empties the file and closes it; -1 is allowed. */
void fracas_study_unlock(int lock);

enum { FRACAS_HOLDER_TEXT = 400 };
/* True if the lock was left by somebody else, "host H, pid N, since T" in *text. */
bool fracas_study_took_over(int lock, char text[FRACAS_HOLDER_TEXT]);

typedef enum {
    FRACAS_LOCK_FREE,
    FRACAS_LOCK_HELD,     /* by a living process */
    FRACAS_LOCK_LEFT,     /* by a dead process of this host */
    FRACAS_LOCK_ELSEWHERE /* by a process of another host, which may live */
} fracas_lock_state;
/* Looks at the lock without taking it; *text as above, "" if it is free, as it is without the file.
 * Not for the holder, who would lose it. FRACAS_ENVIRONMENT if the file cannot be looked at. */
FRACAS_MUST_USE fracas_err fracas_study_lock_state(const char *study, fracas_lock_state *state,
                                                   char text[FRACAS_HOLDER_TEXT]);

/* Removes the temporary files of a study; nobody may be writing one. *report: a line for each, ""
 * if none (freed by caller). */
FRACAS_MUST_USE fracas_err fracas_study_sweep(const char *study, char **report);

/* Sweeps a study after an interruption: plans the table (fracas_index_plan), creates STUDY/segments
 * if it is missing, and then
 * - checks the index (FRACAS_DAMAGED: `fracas reindex`) and removes temporary files;
 * - sets a segment that differs from its seal aside as NAME.damaged and plans its realizations
 *   again, as those of a missing one. It compares every byte if that takes a few seconds, else the
 *   size; a study.h5 with another checksum than its seal loses the seal;
 * - reads a segment that the index does not know, and adopts it (commits its rows) if all its
 *   realizations are planned, or may be where a rule decides their number. It leaves a segment of
 *   another seed, history, interfaces or program version than `header`, and sets a damaged one
 *   aside.
 * *report: a line for each action, "" if none (freed by caller). */
FRACAS_MUST_USE fracas_err fracas_study_recover(const char *study, fracas_index *index,
                                                const fracas_file_header *header,
                                                const fracas_point_table *table, char **report);

/* Writes STUDY/study.h5 from the segments in plan order. A failed realization gets a row of NaN,
 * and `complete` in the file is 0 then. The recorded decisions of points with table->point[p].most
 * > 0 follow, `meshes` (NULL: none) where interfaces are kept, and the campaign (NULL: none). The
 * index keeps the seal of the file. FRACAS_INTERRUPTED if realizations are still to be computed,
 * also after a damaged segment was set aside here. FRACAS_DAMAGED names a segment of another seed,
 * history, interfaces or program version, or a row of the index that differs from its record, with
 * a remedy. */
FRACAS_MUST_USE fracas_err fracas_study_merge(const char *study, fracas_index *index,
                                              const fracas_file_header *header,
                                              const fracas_point_table *table,
                                              const fracas_mesh_source *meshes,
                                              const fracas_campaign_copy *campaign);

/* True if study.h5 and every segment have the size in the index. */
FRACAS_MUST_USE fracas_err fracas_study_sealed(const char *study, fracas_index *index,
                                               bool *sealed);

/* False if somebody has moved or removed the index since it was opened, or one of its segments. */
bool fracas_study_is_kept(const char *study, fracas_index *index);

/* True if every byte of a sealed study fits the checksums in the index. A study that takes long to
 * read is not read, and counts as sound. */
FRACAS_MUST_USE fracas_err fracas_study_sound(const char *study, fracas_index *index, bool *sound);

typedef struct {
    bool full;                        /* every dataset and every row, too */
    const fracas_point_table *table;  /* the campaign's; NULL: not known ... */
    const fracas_file_header *header; /* ... and of its files */
    /* Called with each problem, its place and its remedy; `note`, which may be NULL, with
     * leftovers, which are no damage. */
    void (*say)(void *context, const char *problem);
    void (*note)(void *context, const char *text);
    void *context;
} fracas_verify_options;

/* Checks a study for `fracas verify`, at one moment of the index; *problems counts the problems.
 * Quick: size, checksum, program version, seed, history and interfaces of every segment and of
 * study.h5 against the index, and their points against the campaign's; quick_check of SQLite, and
 * its rows against each other; points, seed and output of the campaign; the decisions in study.h5
 * against the recorded ones. Full, in addition: every dataset of every segment, the index against
 * the segments row by row, integrity_check, study.h5 against the segments record by record, and the
 * number of interfaces in its meshes. Notes: a lock, temporary files, segments unknown or set
 * aside. */
FRACAS_MUST_USE fracas_err fracas_study_verify(const char *study,
                                               const fracas_verify_options *options,
                                               int64_t *problems);

/* FRACAS_DAMAGED, naming dataset and attribute, unless every dataset has the unit of the schema
 * and, in a file of this program version, its description. */
FRACAS_MUST_USE fracas_err fracas_reader_check_schema(fracas_reader *reader);
/* FRACAS_DAMAGED, naming column and point, unless the points of the file in `table` are the
 * same there: the hashed values, their units and, in a file of this program
 * version, descriptions and derived values. */
FRACAS_MUST_USE fracas_err fracas_reader_check_points(fracas_reader *reader,
                                                      const fracas_point_table *table);

/* FRACAS_DAMAGED, naming point and remedy, unless the meshes of the file equal `meshes`. */
FRACAS_MUST_USE fracas_err fracas_reader_check_meshes(fracas_reader *reader,
                                                      const fracas_mesh_source *meshes);

#endif
