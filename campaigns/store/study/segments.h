/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The segments of a study and the records in them, as merge and verify read them. Private to the
 * store. */
#ifndef FRACAS_CAMPAIGNS_STORE_STUDY_SEGMENTS_H
#define FRACAS_CAMPAIGNS_STORE_STUDY_SEGMENTS_H

#include "campaigns/store/index/index.h"

#include <stdio.h>

typedef struct fracas_segments fracas_segments;

/* A segment of another identity is FRACAS_DAMAGED. `study` must outlive it, and `index` the walk;
 * the rest goes on when it is closed. */
FRACAS_MUST_USE fracas_err fracas_segments_create(const char *study, fracas_index *index,
                                                  const fracas_identity *identity,
                                                  fracas_segments **segments);
void fracas_segments_destroy(fracas_segments *segments); /* NULL is allowed */
/* From now on segments are opened for their records alone (fracas_reader_open_records), with the
 * parts that each is asked for. */
void fracas_segments_only_records(fracas_segments *segments);

/* Forgets what is lost of the segments that the index knows: those that are missing, and those of
 * another size or (with `seals`, which reads them all) with another byte than the index says, which
 * are set aside as NAME.damaged. *rows: realizations planned again. Each is a line in `report`. */
FRACAS_MUST_USE fracas_err fracas_segments_sweep(const char *study, fracas_index *index, bool seals,
                                                 FILE *report, int64_t *rows);

/* Opens a segment by its id and closes the one before; its bytes are compared with the index's seal
 * the first time. FRACAS_DAMAGED names it and says what to do, or that it was found so before. */
FRACAS_MUST_USE fracas_err fracas_segments_open(fracas_segments *segments, int64_t id);
/* Of the one that is open. */
fracas_reader *fracas_segments_reader(const fracas_segments *segments);
/* True after fracas_segments_open has found it damaged. */
bool fracas_segments_is_bad(const fracas_segments *segments, int64_t id);

/* The record in a place, which must be that of this realization; parts as fracas_reader_record.
 * Cheapest by segment and row. */
FRACAS_MUST_USE fracas_err fracas_segments_record(fracas_segments *segments,
                                                  const fracas_place *place,
                                                  const fracas_hash *point, int64_t replica,
                                                  unsigned parts, fracas_record *record);
/* File name of a segment, "" if there is none of that id; bytes a realization of it takes there. */
const char *fracas_segments_name(const fracas_segments *segments, int64_t id);
uint64_t fracas_segments_share(const fracas_segments *segments, int64_t id);

/* One realization on the walk below. */
typedef struct {
    size_t point; /* index in the table */
    int64_t replica;
    fracas_row_status status;
    fracas_record record; /* empty unless status is FRACAS_DONE */
    bool damaged;         /* it is, but the record cannot be had */
} fracas_step;

/* Calls `visit` for every realization of the table in plan order. Records are read by segment and
 * row, as many ahead as fit some 128 MiB, so that each segment is opened a few times only, however
 * its realizations are spread. FRACAS_DAMAGED for a record that cannot be had, or with `tolerant` a
 * damaged step. */
FRACAS_MUST_USE fracas_err
fracas_segments_walk(fracas_segments *segments, const fracas_point_table *table, bool tolerant,
                     fracas_err (*visit)(void *context, fracas_step *step), void *context);

#endif
