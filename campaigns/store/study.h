/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The study on disk: immutable HDF5 segments, an SQLite index over them, and the merged study.h5.
 *
 *   STUDY/campaign.yaml  STUDY/index.sqlite  STUDY/lock  STUDY/segments/NAME.h5  STUDY/study.h5
 *   STUDY/report/
 *
 * A row of the index marked done means durable bytes: before its rows are committed, a segment is
 * written whole to a temporary name, synced and renamed, and its folder synced. */
#ifndef FRACAS_CAMPAIGNS_STORE_STUDY_H
#define FRACAS_CAMPAIGNS_STORE_STUDY_H

#include "campaigns/store/index.h"
#include "campaigns/store/mesh.h"

#include <stdbool.h>
#include <stdint.h>

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

#endif
