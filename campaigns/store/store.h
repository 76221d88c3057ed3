/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The study on disk: immutable HDF5 segments, an SQLite index over them, and the merged study.h5.
 *
 *   STUDY/campaign.yaml  STUDY/index.sqlite  STUDY/lock  STUDY/segments/NAME.h5  STUDY/study.h5
 * STUDY/report/
 *
 * A row of the index marked done means durable bytes: a segment is written whole to a temporary
 * name, synced, renamed and its folder synced before its rows are committed. */
#ifndef FRACAS_CAMPAIGNS_STORE_STORE_H
#define FRACAS_CAMPAIGNS_STORE_STORE_H

#include "base/err.h"
#include "base/hash.h"
#include "campaigns/points.h"
#include "campaigns/store/mesh.h"
#include "campaigns/store/summary.h"
#include "engine/record.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* ---- one HDF5 file: a segment or a study, same schema (docs/formats/study.md) ---- */

#define FRACAS_FORMAT_VERSION 2 /* 1 had no /fragment/spin */

typedef struct {
    fracas_hash campaign; /* campaign hash */
    uint64_t seed;
    int64_t history;  /* as the campaign's output options say: equal intervals of time.end, */
    bool interfaces;  /* and whether the file has an /interface group */
    char version[32]; /* program version */
    bool complete;    /* every realization of every point in the file is present */
} fracas_file_header;

/* How a file came out: what the index keeps of it. */
typedef struct {
    uint64_t bytes;
    uint64_t checksum; /* fracas_checksum_of its contents */
} fracas_file_seal;

/* One round of a point whose replicas a rule decides (docs/theory/sequential.md): what was decided,
 * from what, by which rule. */
typedef struct {
    int64_t point;    /* in the table of the file */
    int64_t round;    /* from 0 */
    int64_t replicas; /* that it had: 0 to replicas - 1 */
    int64_t used;     /* realizations in the mean */
    double mean, half_width;
    int64_t stop;                       /* 0 goes on, 1 precise, 2 at the maximum */
    int64_t quantity, minimum, maximum; /* the rule */
    double relative_half_width, confidence;
} fracas_decision;

/* Every number that names something is one of those that do. */
bool fracas_decision_valid(const fracas_decision *decision);

/* Half width as part of the absolute value of the mean; 0 where all values are alike, though they
 * be 0. NaN of fewer than two values. */
double fracas_decision_relative(const fracas_decision *decision);

/* Equal to the bit, NaNs alike. */
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
/* Keeps where, when and by what the records were computed, one JSON object of less than 4 KB, as an
 * attribute: for segments, so that they tell it when the index is lost, and never for study.h5. */
FRACAS_MUST_USE fracas_err fracas_writer_provenance(fracas_writer *writer, const char *provenance);
/* The next decisions, in the order of points and rounds. The file has a group /decision if there
 * are any. */
FRACAS_MUST_USE fracas_err fracas_writer_decisions(fracas_writer *writer,
                                                   const fracas_decision *decision, size_t count);
/* The mesh of the next point, points in their order, in a file with interfaces: once for each, or
 * for none of them. The file has a group /mesh if any of them has elements. */
FRACAS_MUST_USE fracas_err fracas_writer_mesh(fracas_writer *writer,
                                              const fracas_stored_mesh *mesh);
/* The file is a segment: it ends with a seal of its own, which fracas_file_version checks. */
void fracas_writer_own_seal(fracas_writer *writer);
/* Closes, syncs, renames to the final name, syncs the folder; frees the writer whatever happens.
 * Equal sequences of calls give equal bytes. */
FRACAS_MUST_USE fracas_err fracas_writer_finish(fracas_writer *writer, bool complete,
                                                fracas_file_seal *seal);
/* Gives up: removes the temporary file, frees the writer. NULL is allowed. */
void fracas_writer_abandon(fracas_writer *writer);

/* *version: the format version that the file gives itself, of this program or another.
 * FRACAS_DAMAGED if it gives none, or, before HDF5 has seen a byte, if it is a segment whose own
 * seal is not of its bytes: what no index vouches for is opened after this. */
FRACAS_MUST_USE fracas_err fracas_file_version(const char *path, uint64_t *version);
/* FRACAS_DAMAGED if it is not a fracas file of a known format version, naming the file. */
FRACAS_MUST_USE fracas_err fracas_reader_open(const char *path, fracas_reader **reader);
/* The same for who wants records with no more than these parts (FRACAS_READ_...), in half the time
 * or less: the table of points has hashes and replicas and no columns, and decisions and meshes are
 * none. */
FRACAS_MUST_USE fracas_err fracas_reader_open_records(const char *path, unsigned parts,
                                                      fracas_reader **reader);
void fracas_reader_close(fracas_reader *reader); /* NULL is allowed */
const fracas_file_header *fracas_reader_header(const fracas_reader *reader);
const fracas_point_table *fracas_reader_points(const fracas_reader *reader);
size_t fracas_reader_realizations(const fracas_reader *reader);

/* Parts of a record to read beside the scalars. */
enum {
    FRACAS_READ_FRAGMENTS = 1,
    FRACAS_READ_HISTORY = 2,
    FRACAS_READ_INTERFACES = 4,
    FRACAS_READ_ALL = 7
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
FRACAS_MUST_USE fracas_err fracas_reader_each(fracas_reader *reader, unsigned parts,
                                              fracas_err (*visit)(void *context,
                                                                  fracas_result *result),
                                              void *context);

/* The text that fracas_writer_provenance kept, NULL if the file has none; *provenance freed by the
 * caller. */
FRACAS_MUST_USE fracas_err fracas_reader_provenance(const fracas_reader *reader, char **provenance);

/* Every decision of the file in its order, none if it has no group /decision; *decision freed by
 * the caller with free(). */
FRACAS_MUST_USE fracas_err fracas_reader_decisions(fracas_reader *reader,
                                                   fracas_decision **decision, size_t *count);

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

/* Versions of the libraries, for provenance. */
void fracas_hdf5_version(char text[32]);
const char *fracas_sqlite_version(void);

/* ---- a record as bytes, for a pipe between processes of one program ---- */

/* Bytes that fracas_record_pack needs. */
size_t fracas_record_packed_size(const fracas_record *record);
void fracas_record_pack(const fracas_record *record, void *bytes);
/* FRACAS_BUG if `size` does not fit what the bytes say. */
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
 * Without `create` a study that cannot be written is opened to read. A file without a table counts
 * as none. FRACAS_DAMAGED says how to go on. */
FRACAS_MUST_USE fracas_err fracas_index_open(const char *study, bool create, fracas_index **index);
void fracas_index_close(fracas_index *index); /* NULL is allowed */

/* True if STUDY/index.sqlite has tables of ours; a run killed at its start leaves one without. */
bool fracas_index_exists(const char *study);

/* Claims the study for the header's program version, seed, history and interfaces, before anything
 * is computed: FRACAS_DAMAGED naming the first that is not what the study was begun with, for
 * study.h5 is of one of each. */
FRACAS_MUST_USE fracas_err fracas_index_claim(fracas_index *index,
                                              const fracas_file_header *header);

/* Keeps, durable on return, that part K of N of the campaign is computed in this study (`fracas run
 * --part`); 1 of 1 is all of it, as is what nobody has said anything of. */
FRACAS_MUST_USE fracas_err fracas_index_set_part(fracas_index *index, int part, int parts);
FRACAS_MUST_USE fracas_err fracas_index_part(fracas_index *index, int *part, int *parts);

/* Adds the points and realizations of the table that are not there yet (status planned); turns
 * leased rows back to planned (their holder is gone: the caller has the lock). */
FRACAS_MUST_USE fracas_err fracas_index_plan(fracas_index *index, const fracas_point_table *table);
/* Every realization of the table in plan order; *row freed by the caller with free(). */
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
/* Calls `say` with each realization of the table that failed for good, in plan order, and the
 * reason ("" if none was given). */
FRACAS_MUST_USE fracas_err fracas_index_failures(
    fracas_index *index, const fracas_point_table *table,
    void (*say)(void *context, const fracas_index_row *row, const char *reason), void *context);
/* Marks `count` replicas from `replica` on as leased, those that are planned. Not durable: the next
 * plan undoes it. */
FRACAS_MUST_USE fracas_err fracas_index_lease(fracas_index *index, const fracas_hash *point,
                                              int64_t replica, int64_t count);
/* Counts an attempt of one realization that ended without a record, with the reason; with `final`
 * it becomes failed (its row in study.h5 is outcome FAILED, values NaN), else planned. */
FRACAS_MUST_USE fracas_err fracas_index_fail(fracas_index *index, const fracas_hash *point,
                                             int64_t replica, const char *reason, bool final);
/* Appends to the table `event` (time of day, kind, text). */
FRACAS_MUST_USE fracas_err fracas_index_event(fracas_index *index, const char *kind,
                                              const char *text);
/* The text of the latest event of a kind, NULL if there is none; freed by the caller with free().
 */
FRACAS_MUST_USE fracas_err fracas_index_last_event(fracas_index *index, const char *kind,
                                                   char **text);

/* ---- decisions in the index ---- */

/* Status of a realization and its summary: 0, and NaN, before it is done. */
typedef struct {
    fracas_row_status status;
    fracas_summary summary;
} fracas_index_summary;

/* row[r] of the replicas 0 to count - 1 of a point. FRACAS_DAMAGED if one was never planned. */
FRACAS_MUST_USE fracas_err fracas_index_summaries(fracas_index *index, const fracas_hash *point,
                                                  size_t count, fracas_index_summary *row);

/* Every replica of the point that `row` names, from `first` to row->replicas - 1, as
 * fracas_index_rows has them; `p`: number of the point in the table. */
FRACAS_MUST_USE fracas_err fracas_index_rows_from(fracas_index *index,
                                                  const fracas_point_row *point, size_t p,
                                                  int64_t first, fracas_index_row *row);

/* The recorded decisions of a point by round, `point` left 0; *decision freed by the caller with
 * free(). */
FRACAS_MUST_USE fracas_err fracas_index_decisions(fracas_index *index, const fracas_hash *point,
                                                  fracas_decision **decision, size_t *count);

/* Begins and ends what is done whole or not at all, and waits for the disk once: commits if `err`
 * is FRACAS_OK, else takes all back and returns `err`. */
FRACAS_MUST_USE fracas_err fracas_index_begin(fracas_index *index);
FRACAS_MUST_USE fracas_err fracas_index_end(fracas_index *index, fracas_err err);

/* Between these two: records the decision, in place of this and any later round of the point, with
 * the reason in words; plans point->replicas of it; and where it stops, forgets what was planned
 * beyond. */
FRACAS_MUST_USE fracas_err fracas_index_decide(fracas_index *index, const fracas_point_row *point,
                                               const fracas_decision *decision, const char *reason);

typedef struct {
    int64_t points, realizations, done, failed, planned, leased; /* realizations by status */
    int64_t outcome[FRACAS_NOUTCOMES];
    int64_t segments, bytes; /* of segments */
} fracas_index_counts;

FRACAS_MUST_USE fracas_err fracas_index_count(fracas_index *index, fracas_index_counts *counts);
/* The same, and of each point of the table (table->npoints of them; segments and bytes 0), by one
 * look at every realization. */
FRACAS_MUST_USE fracas_err fracas_index_count_points(fracas_index *index,
                                                     const fracas_point_table *table,
                                                     fracas_index_counts *counts,
                                                     fracas_index_counts *point);

/* ---- the study as a whole ---- */

/* Takes STUDY/lock (created) for this process until fracas_study_unlock or its death, and writes
 * into it who has it: host, pid, time, kernel, Slurm job. FRACAS_IN_USE names the holder's host and
 * pid. What a dead process of this host (or of this Slurm job before it was requeued) has left is
 * taken over. What one of another host has left is refused, for it may live there and the
 * filesystem keep its lock to itself, unless `force`; a lock that a living process is known to have
 * is not taken even so. FRACAS_TEST_HOST in the environment stands in for the name of the host, and
 * is then another kernel too: for tests. */
FRACAS_MUST_USE fracas_err fracas_study_lock(const char *study, bool force, int *lock);
/* The same without a word in the file, to look at a study that nobody else changes meanwhile:
 * released by close(). */
FRACAS_MUST_USE fracas_err fracas_study_lock_to_look(const char *study, bool force, int *lock);
/* Empties the file and closes it; -1 is allowed. */
void fracas_study_unlock(int lock);

enum { FRACAS_HOLDER_TEXT = 400 };
/* True if the lock was left by somebody else, "host H, pid N, since T" in *text. */
bool fracas_study_took_over(int lock, char text[FRACAS_HOLDER_TEXT]);

typedef enum {
    FRACAS_LOCK_FREE,
    FRACAS_LOCK_HELD,     /* by a process that lives */
    FRACAS_LOCK_LEFT,     /* by one of this host that died */
    FRACAS_LOCK_ELSEWHERE /* by one of another host, which may live */
} fracas_lock_state;
/* Looks at it without taking it; *text as above, "" where it is free. Not for the process that has
 * it: it would lose it. */
fracas_lock_state fracas_study_lock_state(const char *study, char text[FRACAS_HOLDER_TEXT]);

/* True while another process has the lock: the study is being computed. */
bool fracas_study_held(const char *study);

/* Removes the temporary files of a study: nobody may be writing one. Says what in *report, one line
 * each, "" if nothing (freed by caller). */
FRACAS_MUST_USE fracas_err fracas_study_sweep(const char *study, char **report);

/* Sweeps a study after an interruption. Plans the table (fracas_index_plan), creates STUDY/segments
 * if it is not there, and then: the index is looked over (FRACAS_DAMAGED: `fracas reindex`);
 * temporary files are removed; a segment that is not what the index says (a byte of it, where all
 * take a few seconds to read; else its size) is set aside as NAME.damaged, and its rows, as those
 * of one that is missing, go back to planned; a study.h5 that is not what its seal says loses that;
 * a segment that the index does not know is checked and adopted (its rows committed, with the
 * provenance that it has) if all its realizations are planned or, where a rule decides their
 * number, may be, else set aside, but left where it is if it is of another seed, history,
 * interfaces or program version than `header`. Says what it did in *report, one line each, "" if
 * nothing (freed by caller). */
FRACAS_MUST_USE fracas_err fracas_study_recover(const char *study, fracas_index *index,
                                                const fracas_file_header *header,
                                                const fracas_point_table *table, char **report);

/* Writes STUDY/study.h5 from the segments in plan order; realizations that failed get a row of NaN,
 * and header->complete in the file is 0 if any did; the recorded decisions of points with
 * table->point[p].most > 0 follow. FRACAS_INTERRUPTED if realizations are still to be computed:
 * also when a segment has been found damaged, for it is set aside then and its realizations are
 * planned again. FRACAS_DAMAGED names a segment that is of another seed, history, interfaces or
 * program version, or a row of the index that is not its record, and says what to do. `meshes`
 * (NULL: there are none) are kept where interfaces are. The index keeps the seal of the file:
 * without one, study.h5 is not settled. */
FRACAS_MUST_USE fracas_err fracas_study_merge(const char *study, fracas_index *index,
                                              const fracas_file_header *header,
                                              const fracas_point_table *table,
                                              const fracas_mesh_source *meshes);

/* True if study.h5 has the size that its merge left, and every segment the size that the index
 * says. */
FRACAS_MUST_USE fracas_err fracas_study_sealed(const char *study, fracas_index *index,
                                               bool *sealed);

/* Of a sealed study: its every byte is what the index says. In one that takes long to read nothing
 * is, and it is called sound. */
FRACAS_MUST_USE fracas_err fracas_study_sound(const char *study, fracas_index *index, bool *sound);

typedef struct {
    bool full; /* every dataset and every row, too */
    void (*say)(void *context,
                const char *problem); /* called once with each: what, where, remedy */
    void (*note)(void *context,
                 const char *text); /* the same for what is no damage; NULL: nobody wants to know */
    void *context;
} fracas_verify_options;

/* What `fracas verify` found. Quick: size and checksum of every segment and of study.h5 against the
 * index, all of the program version, seed, history and interfaces that it says; quick_check of
 * SQLite and what the rows of the index say of each other; the decisions in study.h5 against the
 * recorded ones. Full, beside that: every dataset of every segment read, index against segments row
 * by row, integrity_check, study.h5 equal, record by record, to the segments, and its meshes with
 * as many interfaces. Notes: a lock, temporary files and segments that an interrupted run left, and
 * damaged ones that were set aside. *problems counts the problems. */
FRACAS_MUST_USE fracas_err fracas_study_verify(const char *study,
                                               const fracas_verify_options *options,
                                               int64_t *problems);

/* FRACAS_DAMAGED, naming the point and what to do, unless the meshes of the file are those of
 * `meshes`. */
FRACAS_MUST_USE fracas_err fracas_reader_check_meshes(fracas_reader *reader,
                                                      const fracas_mesh_source *meshes);

#endif
