/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The results of a study, complete or partial: study.h5 if it has everything, else the segments so
 * far. */
#ifndef FRACAS_CAMPAIGNS_STORE_RESULTS_H
#define FRACAS_CAMPAIGNS_STORE_RESULTS_H

#include "campaigns/store/datafile.h"
#include "campaigns/store/decision.h"

typedef struct fracas_results fracas_results;

/* Opens the results of STUDY, whose campaign (STUDY/campaign.yaml) has this hash and this table,
 * which must outlive them; nothing is written, and a run may be computing the study. The first of
 * these is taken:
 * - study.h5, if it is of this campaign and has the size in its seal, and the index has no
 *   realization left to compute;
 * - the segments in the index, with the realizations done so far, read from it at once;
 * - study.h5 of this campaign beside a lost or damaged index: fracas_results_note says so.
 * FRACAS_INTERRUPTED if no realization is done yet. FRACAS_IN_USE if the index cannot be read while
 * a run has it (network filesystems). FRACAS_DAMAGED, saying how to go on, if there is neither a
 * study.h5 of this campaign nor an index. Both NULL: study.h5 as it is, whatever the index says,
 * also of format versions from FRACAS_FORMAT_OLDEST on, with a note; FRACAS_DAMAGED if it is not
 * there.
 */
FRACAS_MUST_USE fracas_err fracas_results_open(const char *study, const fracas_hash *campaign,
                                               const fracas_point_table *table,
                                               fracas_results **results);
void fracas_results_close(fracas_results *results); /* NULL is allowed */
FRACAS_OWNER(fracas_results, fracas_results_close)

/* True if they are from segments: realizations may be missing, and there are no meshes. NULL stands
 * for no results: this and the functions below that count flaws then count none. */
bool fracas_results_partial(const fracas_results *results);
/* The header; of partial results with the hash of the campaign, seed, history, interfaces and
 * program version of the index, not complete. */
const fracas_file_header *fracas_results_header(const fracas_results *results);
/* The table of points; of partial results the campaign's, with the replicas given so far where a
 * rule decides. */
const fracas_point_table *fracas_results_points(const fracas_results *results);
/* Number of rows, done or FAILED realizations in plan order. */
size_t fracas_results_realizations(const fracas_results *results);

/* Realization in a row, as fracas_reader_record; a failed one is an empty record of outcome FAILED.
 * FRACAS_DAMAGED if its segment is missing or damaged. Slow if the row before was in another
 * segment. */
FRACAS_MUST_USE fracas_err fracas_results_record(fracas_results *results, size_t row,
                                                 unsigned parts, size_t *point, int64_t *replica,
                                                 fracas_record *record);

/* The row of a realization; the number of rows where it is not among them. */
FRACAS_MUST_USE fracas_err fracas_results_find(fracas_results *results, size_t point,
                                               int64_t replica, size_t *row);

/* Calls `visit` with every realization in the order of its row, whatever the segments. Partial ones
 * are read by segment, as many ahead as fit some 128 MiB; one whose segment is missing or damaged
 * is left out, counted by fracas_results_missing, and the segment is named in a note. */
FRACAS_MUST_USE fracas_err fracas_results_walk(fracas_results *results, unsigned parts,
                                               fracas_result_visit *visit, void *context);

/* Done realizations of a point without a readable record so far. */
int64_t fracas_results_missing(const fracas_results *results, size_t point);
/* False if a rule decides the replicas of the point and has not stopped. */
bool fracas_results_decided(const fracas_results *results, size_t point);

/* Notes for readers of the results: damaged segments met so far, a lost index. Text of note 0 to
 * count - 1. */
size_t fracas_results_notes(const fracas_results *results);
const char *fracas_results_note(const fracas_results *results, size_t note);

/* Every decision, by point and round; they belong to the results. */
const fracas_decision *fracas_results_decisions(const fracas_results *results, size_t *count);
/* As fracas_reader_mesh_interfaces and fracas_reader_mesh; partial ones have none. */
FRACAS_MUST_USE fracas_err fracas_results_mesh_interfaces(fracas_results *results, size_t point,
                                                          size_t *interfaces);
FRACAS_MUST_USE fracas_err fracas_results_mesh(fracas_results *results, size_t point,
                                               fracas_stored_mesh *mesh);

#endif
