/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One HDF5 file, a segment or a study, of the same schema (docs/formats/study.md). */
#ifndef FRACAS_CAMPAIGNS_STORE_DATAFILE_H
#define FRACAS_CAMPAIGNS_STORE_DATAFILE_H

#include "base/err.h"
#include "base/hash.h"
#include "base/own.h"
#include "campaigns/points.h"
#include "campaigns/store/decision.h"
#include "campaigns/store/mesh.h"
#include "engine/record.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

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
