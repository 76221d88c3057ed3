/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Looking after a study: the index made anew, what nobody needs removed, two studies made one,
 * failures forgotten.
 *
 * The caller holds the lock of every study that is named, and has opened the indexes that are
 * given. Whatever kills a command, the study is as before or as after, or the same command goes on.
 */
#ifndef FRACAS_CAMPAIGNS_STORE_UPKEEP_H
#define FRACAS_CAMPAIGNS_STORE_UPKEEP_H

#include "campaigns/store/store.h"

/* What was done, for people: calls `line` with each, without its end. */
typedef struct {
    void (*line)(void *context, const char *text);
    void *context;
} fracas_said;

void fracas_say_line(const fracas_said *said, const char *format, ...) FRACAS_PRINTF(2, 3);
/* Each line of `text`. */
void fracas_say_lines(const fracas_said *said, const char *text);

/* ---- the index ---- */

#define FRACAS_REINDEX_FOLDER ".reindex" /* in the study, in which a new index grows */

/* Makes STUDY/index.sqlite anew from the segments, which are read whole (fracas_study_recover). If
 * the one before can be read and is of this study, then the attempts and reasons of realizations,
 * failures, provenance and events are taken over from it; if not, it stays as
 * index.sqlite.before-TIME. The new one grows in STUDY/.reindex and takes the place of the old when
 * it is durable. The seal of study.h5 and decisions are not taken over: a merge makes the one, the
 * realizations the others. Nobody may have the index open. FRACAS_DAMAGED, naming file and
 * versions, if the segments are of another format version. */
FRACAS_MUST_USE fracas_err fracas_study_reindex(const char *study, const fracas_file_header *header,
                                                const fracas_point_table *table,
                                                const fracas_said *said);

/* Makes the realizations that failed for good (of `point`, NULL: of all) planned ones, with no
 * attempts behind them, and forgets the decisions that were made with them; one transaction,
 * durable on return. *rows counts them. */
FRACAS_MUST_USE fracas_err fracas_index_retry(fracas_index *index, const fracas_hash *point,
                                              int64_t *rows);

/* ---- what nobody needs ---- */

/* One file or folder that fracas_study_collect came by. */
typedef struct {
    const char *path; /* STUDY/... */
    uint64_t bytes;
    const char *why; /* it is removed, or left */
    bool removed;
} fracas_collected;

typedef struct {
    const char *const *attachment; /* digests of the files that the campaign names */
    size_t nattachments;
    bool dry; /* only says what it would remove */
    void (*found)(void *context, const fracas_collected *item);
    void *context;
} fracas_collect_options;

/* Removes temporaries, what interrupted commands left, segments that no row of the index names any
 * more and attachments that no one names; gives free pages of the index back to the system. What it
 * does not know it leaves; `found` is called for both. A segment leaves the index before its file
 * goes: killed in between, it is found and known again. *freed: bytes. */
FRACAS_MUST_USE fracas_err fracas_study_collect(const char *study, fracas_index *index,
                                                const fracas_collect_options *options,
                                                uint64_t *freed);

/* ---- two studies of one campaign ---- */

/* Reads every record of `from` (those of `table`, as many replicas as it has there) with the
 * checksums of their segments, and compares those that `into` has, too: FRACAS_DAMAGED names the
 * first realization that differs in any bit, or a damaged segment. *both counts the compared.
 * Writes nothing. */
FRACAS_MUST_USE fracas_err fracas_study_compare(const char *into, fracas_index *into_index,
                                                const char *from, fracas_index *from_index,
                                                const fracas_file_header *header,
                                                const fracas_point_table *table, int64_t *both);

typedef struct {
    int64_t realizations; /* that `into` did not have done */
    int64_t segments;     /* taken over */
    int64_t failed;       /* realizations that are failed in `from` and were planned in `into` */
} fracas_joined;

/* Takes the segments of `from` with realizations that `into` has not done (all planned there) over
 * into it, by link or by copy, and their rows; then the failures of what is not done there. Only
 * after fracas_study_compare. `table` is that of `from`. */
FRACAS_MUST_USE fracas_err fracas_study_join(const char *into, fracas_index *into_index,
                                             const char *from, fracas_index *from_index,
                                             const fracas_point_table *table,
                                             fracas_joined *joined);

#endif
