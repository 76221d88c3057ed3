/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The schema of segments and studies: one const table for writer, reader, verification and
 * docs/formats/study.md. For the store alone, for analysis/export, whose tables have the same
 * columns, and for the sizes of a plan. */
#ifndef FRACAS_CAMPAIGNS_STORE_FILE_SCHEMA_H
#define FRACAS_CAMPAIGNS_STORE_FILE_SCHEMA_H

#include "campaigns/points.h"
#include "engine/record.h"

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* How a value is stored (little-endian). In memory integers are int64_t, reals double. */
typedef enum {
    FRACAS_INT8,
    FRACAS_INT32,
    FRACAS_INT64,
    FRACAS_FLOAT64,
    FRACAS_TEXT
} fracas_stored_type;

extern const char *const fracas_stored_type_name[]; /* "int8" ... by fracas_stored_type */

/* One dataset. */
typedef struct {
    const char *path; /* "/fragment/mass" */
    fracas_stored_type type;
    size_t width;     /* values in a row; of FRACAS_TEXT: bytes, padded with NUL */
    const char *unit; /* as UDUNITS-2 reads it; "" for text */
    const char *description;
    size_t offset; /* in memory: of the first value in the row's struct */
    int since;     /* format version that brought it; 0: all have it */
} fracas_store_column;

/* A set of datasets, which grow together, row by row. */
typedef enum {
    FRACAS_SET_REALIZATION,
    FRACAS_SET_FRAGMENT_OFFSET,
    FRACAS_SET_FRAGMENT,
    FRACAS_SET_HISTORY_OFFSET,
    FRACAS_SET_HISTORY,
    FRACAS_SET_INTERFACE_OFFSET, /* this and the next only in files with interfaces */
    FRACAS_SET_INTERFACE,
    FRACAS_SET_PROBE_OFFSET, /* the same with probes */
    FRACAS_SET_PROBE,
    FRACAS_SET_REACTION_OFFSET, /* the same with reactions */
    FRACAS_SET_REACTION,
    FRACAS_SET_DECISION,         /* only in a study.h5 with points whose replicas a rule decided */
    FRACAS_SET_MESH_NODE_OFFSET, /* from here on only in a study.h5 with meshes of surfaces */
    FRACAS_SET_MESH_NODE,
    FRACAS_SET_MESH_ELEMENT_OFFSET,
    FRACAS_SET_MESH_ELEMENT,
    FRACAS_SET_MESH_INTERFACE_OFFSET,
    FRACAS_SET_MESH_INTERFACE,
    FRACAS_SET_MESH_BORDER_OFFSET,
    FRACAS_SET_MESH_BORDER,
    FRACAS_NSETS
} fracas_set_name;

#define FRACAS_MAX_COLUMNS 32 /* in a set */

typedef struct {
    const fracas_store_column *column;
    size_t ncolumns;
    size_t chunk;    /* rows in a chunk of every dataset of the set */
    size_t row_size; /* bytes of a row's struct in memory */
} fracas_store_set;

extern const fracas_store_set fracas_store_sets[FRACAS_NSETS];

/* A ragged set: each realization has some rows of it, or each point, between two offsets. Its rows
 * are the set behind that of its offsets. */
typedef struct {
    fracas_set_name offsets;
    const char *group;  /* "/fragment" */
    size_t rows, count; /* offsets of the pointer to the rows and of their number in the owner */
} fracas_ragged;

enum { FRACAS_NPARTS = 5 };
extern const fracas_ragged fracas_record_parts[FRACAS_NPARTS]; /* by the bits of FRACAS_READ_ALL */
enum {
    FRACAS_MESH_NODES,
    FRACAS_MESH_ELEMENTS,
    FRACAS_MESH_INTERFACES,
    FRACAS_MESH_BORDERS,
    FRACAS_NMESH_PARTS
};
extern const fracas_ragged fracas_mesh_parts[FRACAS_NMESH_PARTS]; /* for a fracas_stored_mesh */

/* The rows of an owner and their number. */
const void *fracas_ragged_get(const fracas_ragged *ragged, const void *owner, size_t *count);
/* Gives it these. */
void fracas_ragged_set(const fracas_ragged *ragged, void *owner, void *rows, size_t count);

/* A row of FRACAS_SET_REALIZATION in memory; rows of the others are fracas_fragment,
 * fracas_history_row, fracas_interface_row, fracas_probe_row,
 * fracas_reaction_row, fracas_decision, those of
 * campaigns/store/mesh.h, and an int64_t for the offsets. */
typedef struct {
    int64_t point, replica;
    fracas_record record; /* its scalars */
} fracas_stored_realization;

/* /point: these two, then one dataset a column of the point table. */
extern const fracas_store_column fracas_store_point_hash, fracas_store_point_replicas;
#define FRACAS_POINT_CHUNK 64

/* Bytes of a row as stored. */
size_t fracas_stored_size(const fracas_store_column *column);

/* Puts `count` rows (structs of `row_size` bytes) into `stored`, NaNs in one bit pattern.
 * Returns the number of integers too large for the stored type. */
size_t fracas_rows_store(const fracas_store_column *column, const void *rows, size_t row_size,
                         size_t count, void *stored);
/* The inverse. */
void fracas_rows_load(const fracas_store_column *column, const void *stored, size_t count,
                      void *rows, size_t row_size);
/* The same of a column that the file has not: NaN, or 0 of integers. */
void fracas_rows_lack(const fracas_store_column *column, size_t count, void *rows, size_t row_size);

/* Names of columns and groups that files of this format version have not, "damped, volume"; cut to
 * `size`. */
void fracas_store_lacks(int64_t format, char *text, size_t size);

/* Bytes of a row of the set, and about those of a file with so many rows of each set (0: without
 * it) and the points of the table. A file has whole chunks: the smallest has a third of a megabyte.
 */
double fracas_row_bytes(fracas_set_name set);
double fracas_file_bytes(const double rows[FRACAS_NSETS], const fracas_point_table *table);

/* A worker writes its segment at this age [s], or size [bytes]. */
#define FRACAS_SEGMENT_AGE 5
#define FRACAS_SEGMENT_BYTES (64.0 * 1024 * 1024)

/* The table of datasets in docs/formats/study.md. */
void fracas_schema_reference(FILE *out);

#endif
