/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The segments of a study and the records in them, as merge and verify read them. Private to the
 * store. */
#ifndef FRACAS_CAMPAIGNS_STORE_STUDY_SEGMENTS_H
#define FRACAS_CAMPAIGNS_STORE_STUDY_SEGMENTS_H

#include "campaigns/store/index/index.h"

#include <stdio.h>

typedef struct fracas_segments fracas_segments;

/* A segment of another identity is FRACAS_DAMAGED. `study` must outlive it; the index may be closed
 * after. With `only_records` segments are opened for their records alone
 * (fracas_reader_open_records), with the parts asked for. */
FRACAS_MUST_USE fracas_err fracas_segments_create(const char *study, fracas_index *index,
                                                  const fracas_identity *identity,
                                                  bool only_records, fracas_segments **segments);
void fracas_segments_destroy(fracas_segments *segments); /* NULL is allowed */
FRACAS_OWNER(fracas_segments, fracas_segments_destroy)

/* Forgets lost segments: a missing one, and one of another size or (with `seals`, which reads every
 * byte) checksum than in the index, which is set aside as NAME.damaged. *rows: realizations planned
 * again. Each loss is a line in `report`. */
FRACAS_MUST_USE fracas_err fracas_segments_sweep(const char *study, fracas_index *index, bool seals,
                                                 FILE *report, int64_t *rows);

/* Opens a segment by its id and closes the one before; *reader belongs to the segments. The first
 * time, its bytes are compared with the seal in the index. FRACAS_DAMAGED names it, with a remedy
 * when it is found first. */
FRACAS_MUST_USE fracas_err fracas_segments_open(fracas_segments *segments, int64_t id,
                                                fracas_reader **reader);
/* True after fracas_segments_open has found it damaged. */
bool fracas_segments_is_bad(const fracas_segments *segments, int64_t id);

/* A copy of an open segment, whole under a temporary name first, durable on return. */
FRACAS_MUST_USE fracas_err fracas_segment_copy(int from, const fracas_file_seal *seal,
                                               const char *path);

/* True for a study.h5 that is the segment of all its realizations (fracas_study_fold). */
bool fracas_segment_is_study(const char *name);

/* The record in a place, checked to be of this realization; parts as fracas_reader_record. Cheapest
 * by segment and row. */
FRACAS_MUST_USE fracas_err fracas_segments_record(fracas_segments *segments,
                                                  const fracas_row_place *place,
                                                  const fracas_hash *point, int64_t replica,
                                                  unsigned parts, fracas_record *record);
/* File name of a segment, "" for an unknown id. */
const char *fracas_segments_name(const fracas_segments *segments, int64_t id);
/* Bytes of these parts of a record in memory; an estimate for interfaces. */
uint64_t fracas_segments_size(const fracas_segments *segments, const fracas_row_place *place,
                              unsigned parts);
/* FRACAS_DAMAGED for a failed realization with another outcome than FAILED. */
FRACAS_MUST_USE fracas_err fracas_segments_check_failed(const fracas_segments *segments,
                                                        const fracas_row_place *place,
                                                        int64_t replica);

/* True if study.h5 has the size in its seal. */
FRACAS_MUST_USE fracas_err fracas_study_file_sealed(const char *study, fracas_index *index,
                                                    bool *sealed);

/* ---- the walk over a study ---- */

/* One realization on the walk. */
typedef struct {
    fracas_result result; /* its record is empty unless the realization is done and can be read */
    fracas_row_place place;
    bool damaged; /* done, but its record cannot be read */
} fracas_visit;

/* Realizations to walk over, parts of their records to read (FRACAS_READ_...), functions to call.
 * `next` gives result.point, result.replica and place of the row result.row, *more false after the
 * last row; with `damaged` set the record is not read.
 * `damaged` hears of a damaged record while fracas_message() says why; NULL: the walk ends with
 * FRACAS_DAMAGED. */
typedef struct {
    const fracas_point_table *table;
    unsigned parts;
    fracas_err (*next)(void *source, fracas_visit *visit, bool *more);
    void *source;
    fracas_result_visit *damaged;
    fracas_err (*visit)(void *context, fracas_visit *visit);
    void *context;
} fracas_want;

/* Visits the realizations in the order of `next`. Records are read by segment and row, as many
 * ahead as fit some 128 MiB: each segment is opened a few times only, however its realizations are
 * spread. */
FRACAS_MUST_USE fracas_err fracas_study_each(fracas_segments *segments, const fracas_want *want);

/* The same for every realization of want->table in plan order, with places from the index;
 * want->next is not used. In a transaction of its own, if the caller has begun none. */
FRACAS_MUST_USE fracas_err fracas_study_each_planned(fracas_segments *segments, fracas_index *index,
                                                     const fracas_want *want);

#endif
